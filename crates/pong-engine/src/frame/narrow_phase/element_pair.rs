//! Pair of an element of A and an element of B; candidates of a chunk of A.

use super::candidate::{CandidateStatus, ContactCandidate};
use super::nearest_side::KnownSides;
use super::side_of_entry::{EntryFace, PolyhedronEntry};
use crate::frame::broad_phase::chunk::Ellipsoidal;
use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::input::PairContext;
use crate::frame::input::motion::Motion;
use crate::state::{ContactKey, RecordsOfKey};
use pong_arena::Table;
use pong_geometry::Vec3;
use pong_geometry::interference::Interference;
use pong_geometry::interference::ellipsoid_triangle_pairs::EllipsoidTrianglePairs;
use pong_geometry::interference::sphere_triangle_pairs::{PairsTold, SphereTrianglePairs};
use pong_geometry::primitive::{Capsule, Containment, Polyhedron, PrimitiveKind, Sphere, TriangleSet};
use pong_geometry::simd::{LANES, Simd};
use pong_model::{Item, MovableGroup, PrimitiveInfo};

/// Candidates that the contact testers find for one chunk of A.
pub(crate) struct ChunkCandidates<'m> {
    pub list: &'m mut Table<ContactCandidate>,
    /// Number of candidates, including those dropped for lack of room.
    pub seen: u64,
    /// True if there was not enough room. The deepest candidates have then been kept, at least half of the
    /// capacity; a frame keeps no more contacts than that.
    pub overflowed: bool,
    pub deferred: &'m mut DeferredPairs,
    pub sides: KnownSides,
}

/// Pairs of a sphere or ellipsoid and a triangle whose tests are deferred until there are eight pairs, or
/// until the search has found no more. The pairs are all of one kind, that of the chunk.
#[derive(Debug)]
pub(crate) struct DeferredPairs {
    pub spheres: SphereTrianglePairs,
    pub ellipsoids: EllipsoidTrianglePairs,
    /// Lane of A's element and triangle of B, by pair.
    pub from: [(u8, Item); LANES],
}

impl Default for DeferredPairs {
    fn default() -> Self {
        let nobody = Item { primitive: 0, element: 0 };
        Self {
            spheres: SphereTrianglePairs::default(),
            ellipsoids: EllipsoidTrianglePairs::default(),
            from: [(0, nobody); LANES],
        }
    }
}

impl DeferredPairs {
    /// Number of pairs.
    #[inline]
    pub fn count(&self) -> usize {
        self.spheres.count() + self.ellipsoids.count()
    }

    /// Adds a pair of an element and a triangle, and returns the index of the pair. `thickness`, m, is that
    /// of the triangle for this element.
    #[inline(always)]
    pub fn add(&mut self, element: &Ellipsoidal<'_>, triangle: u32, thickness: f64) -> usize {
        match element {
            Ellipsoidal::Ellipsoid(ellipsoid) => self.ellipsoids.add(ellipsoid, triangle, thickness),
            Ellipsoidal::Sphere(sphere) => self.spheres.add(sphere, triangle, thickness),
        }
    }

    /// Sets the element of the pairs that `push` adds, and the thickness of the triangles for it, m.
    #[inline(always)]
    pub fn begin<S: Simd>(&mut self, simd: S, element: &Ellipsoidal<'_>, thickness: f64) {
        match element {
            Ellipsoidal::Ellipsoid(ellipsoid) => self.ellipsoids.begin_in(simd, ellipsoid, thickness),
            Ellipsoidal::Sphere(sphere) => self.spheres.begin_in(simd, sphere, thickness),
        }
    }

    /// Adds a pair of the element set by `begin` and a triangle; returns the index of the pair.
    #[inline(always)]
    pub fn push(&mut self, element: &Ellipsoidal<'_>, triangle: u32) -> usize {
        match element {
            Ellipsoidal::Ellipsoid(_) => self.ellipsoids.push(triangle),
            Ellipsoidal::Sphere(_) => self.spheres.push(triangle),
        }
    }

    /// Removes all pairs and returns which of them may touch. `set` contains the triangles of the pairs.
    #[inline(always)]
    pub fn tell(&mut self, set: &TriangleSet) -> PairsTold {
        if self.ellipsoids.count() > 0 {
            return PairsTold { near: self.ellipsoids.take(set), over_face: 0 };
        }
        self.spheres.take(set)
    }

    fn clear(&mut self) {
        self.spheres.clear();
        self.ellipsoids.clear();
    }
}

impl<'m> ChunkCandidates<'m> {
    pub fn new(list: &'m mut Table<ContactCandidate>, deferred: &'m mut DeferredPairs) -> Self {
        // A panic in an earlier frame may have left candidates behind.
        list.clear();
        deferred.clear();
        Self { list, seen: 0, overflowed: false, deferred, sides: KnownSides::default() }
    }

    pub fn clear(&mut self) {
        self.list.clear();
        (self.seen, self.overflowed) = (0, false);
    }

    /// Returns true if tests are deferred.
    #[inline]
    pub fn has_deferred(&self) -> bool {
        self.deferred.count() > 0
    }

    /// Returns the memory of one more candidate; the caller writes all fields. If the list is full, its less
    /// deep half is dropped first.
    pub fn slot(&mut self) -> &mut ContactCandidate {
        self.seen += 1;
        if self.list.len() == self.list.capacity() {
            self.overflowed = true;
            let half = self.list.capacity() / 2;
            let deeper_first = |a: &ContactCandidate, b: &ContactCandidate| {
                b.depth.total_cmp(&a.depth).then(a.order().cmp(&b.order()))
            };
            self.list.select_nth_unstable_by(half, deeper_first);
            self.list.truncate(half);
        }
        self.list.slot().expect("halving makes room")
    }
}

/// Value of [`ContactKey::end`] for a contact of a capsule between its ends.
pub(crate) const BETWEEN_ENDS: u32 = 2;

/// Value of [`ContactKey::end`] for a contact of the side of a cylinder between its end discs. Ends 0 and 1 are the
/// lowest points of the two discs, ends 2 and 3 the highest.
pub(crate) const BETWEEN_DISCS: u32 = 4;

/// A sphere, or the end sphere of a capsule.
pub(crate) struct Ball<'s> {
    /// Sphere in B's frame; borrowed, because a copy would stall on store forwarding.
    pub sphere: &'s Sphere,
    /// End index, for a capsule.
    pub end: Option<u32>,
}

impl<'s> Ball<'s> {
    /// A sphere.
    pub fn of(sphere: &'s Sphere) -> Self {
        Self { sphere, end: None }
    }

    /// The two end spheres of a capsule.
    pub fn at_ends([first, second]: &'s [Sphere; 2]) -> [Self; 2] {
        [Self { sphere: first, end: Some(0) }, Self { sphere: second, end: Some(1) }]
    }
}

/// Spheres at the ends of a capsule.
pub(crate) fn end_spheres(capsule: &Capsule) -> [Sphere; 2] {
    capsule.ends.map(|center| Sphere { center, radius: capsule.radius })
}

/// One element of A against one element of B.
pub(crate) struct ElementPair<'a> {
    pub context: &'a PairContext<'a>,
    pub item_a: Item,
    /// Index of A's element in its chunk.
    pub lane: u8,
    pub item_b: Item,
    pub kind_b: PrimitiveKind,
}

impl<'a> ElementPair<'a> {
    pub fn body_a(&self) -> &'a MovableGroup {
        self.context.body_a
    }

    pub fn body_b(&self) -> &'a MovableGroup {
        self.context.body_b
    }

    pub fn motion(&self) -> &'a Motion {
        self.context.motion
    }

    pub fn info_b(&self) -> &'a PrimitiveInfo {
        &self.body_b().primitives[self.item_b.primitive as usize]
    }

    /// Current face of entry and pushing face for a point inside B's polyhedron; `None` if the polyhedron has
    /// no active face. The point is `local` in A's frame and `p` in B's frame.
    #[inline]
    pub fn entry_face(
        &self,
        polyhedron: &Polyhedron,
        remembered: &RecordsOfKey<'_>,
        local: &Vec3,
        p: &Vec3,
    ) -> Option<EntryFace> {
        PolyhedronEntry {
            records: remembered.records,
            body: self.body_b(),
            shell: self.info_b().shell,
            piece: self.item_b.element,
            polyhedron,
            point_b: *p,
            point_a: local,
            since: self.motion().since_commit.as_ref(),
            remembers: self.context.remembers_entry,
        }
        .face()
    }

    /// Returns the convex solid to which B's polyhedron belongs, and the pair with the piece that stands for it; `None`
    /// if its pieces act one by one.
    pub fn on_solid(&self) -> Option<(Self, &'a Polyhedron)> {
        let (item_b, solid) = self.body_b().convex_solid(self.item_b)?;
        Some((Self { item_b, ..*self }, solid))
    }

    /// Returns true if another piece of a convex solid has found the contacts of A's element with it.
    pub fn is_done(&self, found: &ChunkCandidates<'_>) -> bool {
        let has_walls = !self.body_b().polyhedra[self.item_b.element as usize].planes().all_active;
        let key = |other: &ContactCandidate| ContactKey { end: 0, ..other.key };
        has_walls && found.list.iter().any(|other| key(other) == self.key())
    }

    pub fn key(&self) -> ContactKey {
        let info_b = self.info_b();
        let shell_b = match info_b.kind {
            PrimitiveKind::Triangle => self.body_b().triangles.triangles[self.item_b.element as usize].shell,
            _ => info_b.shell,
        };
        ContactKey {
            group_pair: self.context.group_pair,
            flipped: self.context.flipped,
            primitive_a: self.item_a.primitive,
            shell_b,
            end: 0,
        }
    }

    /// Key at one end of A's element.
    pub fn key_at(&self, end: u32) -> ContactKey {
        ContactKey { end, ..self.key() }
    }

    /// Centre of a sphere or capsule end sphere of A, in A's frame, m.
    pub fn center_a(&self, ball: &Ball<'_>) -> &'a Vec3 {
        let element = self.item_a.element as usize;
        match ball.end {
            None => &self.body_a().spheres[element].center,
            Some(end) => &self.body_a().capsules[element].ends[end as usize],
        }
    }

    /// Adds the contact of a sphere, which shares its spring with the other contacts of the sphere with the
    /// same surface.
    pub fn sharing(&self, ball: &Ball<'_>, contact: &Interference, found: &mut ChunkCandidates<'_>) {
        let key = self.key_at(ball.end.unwrap_or(0));
        self.emit(key, contact, found, |out| out.share(ball.end.is_some()));
    }

    /// Adds the contact of a capsule's axis, or of a cylinder's side, with an edge; `part` is [`BETWEEN_ENDS`] or
    /// [`BETWEEN_DISCS`].
    pub fn between(
        &self,
        part: u32,
        crossing: &Interference,
        status: CandidateStatus,
        found: &mut ChunkCandidates<'_>,
    ) {
        self.emit(self.key_at(part), crossing, found, |out| {
            out.share(true);
            out.status = status;
        });
    }

    /// Adds the candidate of a contact under `key`; `adjust` sets the fields that depend on the tester.
    #[inline]
    pub fn emit(
        &self,
        key: ContactKey,
        contact: &Interference,
        found: &mut ChunkCandidates<'_>,
        adjust: impl FnOnce(&mut ContactCandidate),
    ) {
        let out = found.slot();
        *out = ContactCandidate {
            key,
            primitive_b: self.item_b.primitive,
            element_a: self.item_a.element,
            element_b: self.item_b.element,
            feature: contact.feature,
            kind_b: self.kind_b,
            lane: self.lane,
            depth: contact.depth,
            normal_b: contact.normal_b,
            deepest_b: contact.deepest_b,
            ..ContactCandidate::NOTHING
        };
        adjust(out);
    }
}

/// Candidate status of a point in a piece of a body, by its containment in the piece.
pub(crate) fn status_of(containment: Containment) -> CandidateStatus {
    match containment {
        Containment::AtWall => CandidateStatus::AtWall,
        Containment::BeyondWall => CandidateStatus::BeyondWall,
        Containment::Inside | Containment::Outside => CandidateStatus::Front,
    }
}

/// Panics: a tester was called with a kind of primitive that its table row does not name.
#[cold]
pub(crate) fn wrong_kind(a: &TransformedPrimitive) -> ! {
    unreachable!("the row of this test in the table of pairs names another kind than that of {a:?}")
}
