//! Pairs of primitives: runs the tester of a pair of kinds, hands out contacts under their keys.

use crate::frame::broad_phase::chunk::Chunk;
use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::input::PairContext;
use crate::frame::input::motion::Motion;
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use crate::frame::narrow_phase::nearest_side::{KnownSides, Nearby};
use crate::frame::narrow_phase::side_of_entry::{PolyhedronEntry, TriangleEntry};
use crate::pair_table::has_tester;
use crate::report::FrameCounts;
use crate::state::ContactKey;
use pong_arena::List;
use pong_geometry::Vec3;
use pong_geometry::extension::PrimitiveRef;
use pong_geometry::interference::triangle_features::{Standing, TriangleContact};
use pong_geometry::interference::{
    Feature, Interference, ellipsoid_plane::ellipsoid_plane, ellipsoid_polyhedron::ellipsoid_piece,
    ellipsoid_triangle::ellipsoid_triangle, line_segment_plane::line_segment_plane,
    line_segment_polyhedron::AtWall, line_segment_polyhedron::line_segment_piece,
    point_ellipsoid::point_ellipsoid, point_plane::point_plane, point_polyhedron::point_below_face,
    point_sphere::point_sphere, ray_plane::RayHit, ray_plane::ray_contact, ray_plane::ray_plane,
    ray_polyhedron::ray_polyhedron, ray_triangle::ray_triangle, sphere_plane::sphere_plane,
    sphere_polyhedron::sphere_inside_polyhedron, sphere_polyhedron::sphere_outside_polyhedron,
    sphere_sphere::sphere_sphere, sphere_triangle::sphere_over_face, sphere_triangle::sphere_triangle,
    sphere_triangle_pairs::SphereTrianglePairs,
};
use pong_geometry::primitive::PrimitiveKind::{self, Custom, Plane, Polyhedron, Triangle};
use pong_geometry::primitive::{
    Containment, Ellipsoid, LineSegment, Point, Polyhedron as Solid, Ray, Sphere,
};
use pong_geometry::simd::{LANES, LaneBits, Simd};
use pong_model::box_tree::lanes;
use pong_model::{Body, Item, PrimitiveInfo};

/// What testers find for one chunk of A.
pub(crate) struct Findings<'m> {
    pub list: List<'m, ContactCandidate>,
    /// How many there were, those without room included.
    pub seen: u64,
    /// Whether there was no room for all: then at least the deeper half of what there is room for stays, which is no
    /// less than a frame may keep.
    pub overflowed: bool,
    waiting: &'m mut Waiting,
    sides: KnownSides,
}

/// Spheres that may touch triangles, until eight are together or the batch of B ends.
#[derive(Debug)]
pub(crate) struct Waiting {
    pairs: SphereTrianglePairs,
    /// Of each pair the lane of A and the triangle.
    from: [(u8, Item); LANES],
}

impl Default for Waiting {
    fn default() -> Self {
        let nobody = Item { primitive: 0, element: 0 };
        Self { pairs: SphereTrianglePairs::default(), from: [(0, nobody); LANES] }
    }
}

impl<'m> Findings<'m> {
    pub fn new(list: List<'m, ContactCandidate>, waiting: &'m mut Waiting) -> Self {
        // A panic may have left some.
        waiting.pairs.clear();
        Self { list, seen: 0, overflowed: false, waiting, sides: KnownSides::default() }
    }

    pub fn clear(&mut self) {
        self.list.clear();
        (self.seen, self.overflowed) = (0, false);
    }

    /// Whether anything waits to be tested.
    #[inline]
    pub fn waits(&self) -> bool {
        self.waiting.pairs.count() > 0
    }

    fn add(&mut self, found: ContactCandidate) {
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
        self.list.push(found).expect("halving makes room");
    }
}

/// One element of B against a chunk of A.
pub(crate) struct Target<'a> {
    pub context: &'a PairContext<'a>,
    pub item_b: Item,
    pub kind_b: PrimitiveKind,
}

impl<'a> Target<'a> {
    /// Tests the elements of A whose boxes the element's box meets.
    #[inline(always)]
    pub fn test_lanes<S: Simd>(
        &self,
        simd: S,
        chunk: &Chunk<'_, '_, '_>,
        near: LaneBits,
        found: &mut Findings<'_>,
        counts: &mut FrameCounts,
    ) {
        if (chunk.kind, self.kind_b) == (PrimitiveKind::Sphere, Triangle) {
            counts.note_testers(chunk.kind, self.kind_b, near.count_ones(), 0);
            return self.let_wait(chunk, near, found, counts);
        }
        let tested = near.count_ones();
        let near = self.not_separated(simd, chunk, near);
        let before = found.seen;
        for lane in lanes(near) {
            self.test_one(chunk, lane, found);
        }
        counts.note_testers(chunk.kind, self.kind_b, tested, (found.seen - before) as u32);
    }

    /// Keeps spheres near a triangle until there are eight such pairs.
    #[inline(always)]
    fn let_wait(
        &self,
        chunk: &Chunk<'_, '_, '_>,
        near: LaneBits,
        found: &mut Findings<'_>,
        counts: &mut FrameCounts,
    ) {
        let triangles = &self.context.body_b.triangles;
        for lane in lanes(near) {
            let sphere = chunk.sphere(lane);
            let thickness = thickness_for(self.context, self.item_b, &sphere);
            let Waiting { pairs, from } = &mut *found.waiting;
            from[pairs.count()] = (lane as u8, self.item_b);
            pairs.add(&sphere, triangles, self.item_b.element, thickness);
            if pairs.count() == LANES {
                test_waiting(self.context, chunk, found, counts);
            }
        }
    }

    /// Most points and spheres near a polyhedron end here: apart by the plane of one face.
    #[inline(always)]
    fn not_separated<S: Simd>(&self, simd: S, chunk: &Chunk<'_, '_, '_>, near: LaneBits) -> LaneBits {
        if self.kind_b != Polyhedron {
            return near;
        }
        let polyhedron = &self.context.body_b.polyhedra[self.item_b.element as usize];
        match chunk.kind {
            PrimitiveKind::Point => near & polyhedron.lanes_inside_or_at_wall_in(simd, &chunk.centers),
            PrimitiveKind::Sphere => near & !polyhedron.lanes_outside_in(simd, &chunk.centers, chunk.radii),
            _ => near,
        }
    }

    fn test_one(&self, chunk: &Chunk<'_, '_, '_>, lane: usize, found: &mut Findings<'_>) {
        let side = Side {
            context: self.context,
            item_a: chunk.items[lane],
            item_b: self.item_b,
            kind_b: self.kind_b,
        };
        match chunk.carried(lane) {
            Some(a) if has_tester(chunk.kind, self.kind_b) => side.test(&a, found),
            _ => side.test_custom(found),
        }
    }
}

/// Tests the spheres of a chunk that wait for their triangles, in the order in which they came.
#[inline(never)]
pub(crate) fn test_waiting(
    context: &PairContext<'_>,
    chunk: &Chunk<'_, '_, '_>,
    found: &mut Findings<'_>,
    counts: &mut FrameCounts,
) {
    let before = found.seen;
    let told = found.waiting.pairs.take();
    for place in lanes(told.near) {
        let (lane, item_b) = found.waiting.from[place];
        let lane = usize::from(lane);
        let side = Side { context, item_a: chunk.items[lane], item_b, kind_b: Triangle };
        side.test_sphere_triangle(&chunk.sphere(lane), told.over_face >> place & 1 == 1, found);
    }
    counts.note_testers(PrimitiveKind::Sphere, Triangle, 0, (found.seen - before) as u32);
}

/// How far behind a triangle the centre of a sphere is still pushed to the front, m.
#[inline]
fn thickness_for(context: &PairContext<'_>, triangle: Item, sphere: &Sphere) -> f64 {
    context.body_b.primitives[triangle.primitive as usize].thickness.unwrap_or(sphere.radius)
}

/// How a point in a piece of a body stands among those of the same surface.
fn status_of(containment: Containment) -> CandidateStatus {
    match containment {
        Containment::AtWall => CandidateStatus::AtWall,
        Containment::BeyondWall => CandidateStatus::BeyondWall,
        Containment::Inside | Containment::Outside => CandidateStatus::Front,
    }
}

/// How an end of a segment in a piece of a body stands among those of the same surface.
fn status_of_end(contact: &Interference, at_wall: AtWall, piece: &Solid) -> CandidateStatus {
    match at_wall {
        AtWall::SharedEdge => CandidateStatus::AtWall,
        AtWall::StandsIn => CandidateStatus::BeyondWall,
        AtWall::No if piece.planes().all_active || !contact.feature.is_face() => CandidateStatus::Front,
        AtWall::No => match piece.containment(&contact.point_a) {
            Containment::AtWall | Containment::BeyondWall => CandidateStatus::AtWall,
            Containment::Inside | Containment::Outside => CandidateStatus::Front,
        },
    }
}

/// One element as A against one element as B.
struct Side<'a> {
    context: &'a PairContext<'a>,
    item_a: Item,
    item_b: Item,
    kind_b: PrimitiveKind,
}

impl<'a> Side<'a> {
    fn body_a(&self) -> &'a Body {
        self.context.body_a
    }

    fn body_b(&self) -> &'a Body {
        self.context.body_b
    }

    fn motion(&self) -> &'a Motion {
        self.context.motion
    }

    fn info_b(&self) -> &'a PrimitiveInfo {
        &self.body_b().primitives[self.item_b.primitive as usize]
    }

    fn test(&self, a: &TransformedPrimitive, found: &mut Findings<'_>) {
        let kind_b = self.kind_b;
        match a {
            TransformedPrimitive::Point(point) => self.test_point(point, kind_b, found),
            TransformedPrimitive::Segment(segment) => self.test_segment(segment, kind_b, found),
            TransformedPrimitive::Ray(ray) => self.test_ray(ray, kind_b, found),
            TransformedPrimitive::Sphere(sphere) => self.test_sphere(sphere, kind_b, found),
            TransformedPrimitive::Ellipsoid(ellipsoid) => self.test_ellipsoid(ellipsoid, kind_b, found),
        }
    }

    fn test_point(&self, point: &Point, kind_b: PrimitiveKind, found: &mut Findings<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        match kind_b {
            Plane => self.whole(point_plane(point, &body.planes[b]), found),
            PrimitiveKind::Sphere => self.whole(point_sphere(point, &body.spheres[b]), found),
            PrimitiveKind::Ellipsoid => {
                self.whole(point_ellipsoid(&point.position, &body.ellipsoids[b]), found);
            }
            _ => {
                // Only points inside, or at an inner wall, get here.
                let polyhedron = &body.polyhedra[b];
                let status = match polyhedron.planes().all_active {
                    true => CandidateStatus::Front,
                    false => status_of(polyhedron.containment(&point.position)),
                };
                let local = self.body_a().points[self.item_a.element as usize].position;
                let Some(face) = self.entry_face(&local, &point.position) else { return };
                let contact = point_below_face(&point.position, polyhedron, face.pushes);
                if let Some(contact) = contact {
                    self.emit(&contact, found, |out| {
                        out.entry_face = face.reached as u32;
                        out.status = status;
                    });
                }
            }
        }
    }

    fn test_segment(&self, segment: &LineSegment, kind_b: PrimitiveKind, found: &mut Findings<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        let ends = match kind_b {
            Plane => line_segment_plane(segment, &body.planes[b])
                .map(|contact| contact.map(|contact| (contact, CandidateStatus::Front))),
            _ => {
                let polyhedron = &body.polyhedra[b];
                line_segment_piece(segment, polyhedron).map(|found| {
                    found.map(|(contact, at_wall)| (contact, status_of_end(&contact, at_wall, polyhedron)))
                })
            }
        };
        for (end, found_there) in ends.iter().enumerate() {
            let Some((contact, status)) = found_there else { continue };
            self.emit(contact, found, |out| {
                out.key.end = end as u32;
                out.half = true;
                out.status = *status;
            });
        }
    }

    fn test_ray(&self, ray: &Ray, kind_b: PrimitiveKind, found: &mut Findings<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        let hit: Option<RayHit> = match kind_b {
            Plane => ray_plane(ray, &body.planes[b]),
            Polyhedron => ray_polyhedron(ray, &body.polyhedra[b]),
            _ => {
                let reach = ray.reach.or(self.info_b().thickness).unwrap_or(0.0);
                ray_triangle(ray, &body.triangles, self.item_b.element, reach)
            }
        };
        if let Some(hit) = hit {
            self.emit(&ray_contact(ray, &hit), found, |out| out.ray_distance = hit.distance);
        }
    }

    fn test_sphere(&self, sphere: &Sphere, kind_b: PrimitiveKind, found: &mut Findings<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        match kind_b {
            Plane => self.whole(sphere_plane(sphere, &body.planes[b]), found),
            PrimitiveKind::Sphere => self.whole(sphere_sphere(sphere, &body.spheres[b]), found),
            Polyhedron => self.test_sphere_polyhedron(sphere, found),
            _ => self.test_sphere_triangle(sphere, false, found),
        }
    }

    /// `over_face`: whether the face alone may push.
    fn test_sphere_triangle(&self, sphere: &Sphere, over_face: bool, found: &mut Findings<'_>) {
        let (set, triangle) = (&self.body_b().triangles, self.item_b.element);
        let local = self.body_a().spheres[self.item_a.element as usize].center;
        let mut emit = |contact| self.on_triangle(&local, &sphere.center, contact, found);
        if over_face {
            sphere_over_face(sphere, set, triangle).into_iter().for_each(emit);
        } else {
            let thickness = thickness_for(self.context, self.item_b, sphere);
            sphere_triangle(sphere, set, triangle, thickness, &mut emit);
        }
    }

    fn test_sphere_polyhedron(&self, sphere: &Sphere, found: &mut Findings<'_>) {
        let polyhedron = &self.body_b().polyhedra[self.item_b.element as usize];
        let containment = polyhedron.containment(&sphere.center);
        if matches!(containment, Containment::Outside | Containment::BeyondWall) {
            self.sharing(sphere_outside_polyhedron(sphere, polyhedron), found);
        }
        if containment == Containment::Outside {
            return;
        }
        let local = self.body_a().spheres[self.item_a.element as usize].center;
        let Some(face) = self.entry_face(&local, &sphere.center) else { return };
        let contact = sphere_inside_polyhedron(sphere, polyhedron, face.pushes);
        self.emit(&contact, found, |out| {
            out.shares = true;
            out.status = status_of(containment);
            out.entry_face = face.reached as u32;
        });
    }

    fn test_ellipsoid(&self, ellipsoid: &Ellipsoid, kind_b: PrimitiveKind, found: &mut Findings<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        match kind_b {
            Plane => self.whole(ellipsoid_plane(ellipsoid, &body.planes[b]), found),
            Polyhedron => {
                let Some(contact) = ellipsoid_piece(ellipsoid, &body.polyhedra[b]) else { return };
                self.emit(&contact.interference, found, |out| {
                    out.shares = true;
                    out.status =
                        if contact.stands_in { CandidateStatus::StandIn } else { CandidateStatus::Front };
                });
            }
            _ => {
                let local = self.body_a().ellipsoids[self.item_a.element as usize].center;
                let thickness = self.thickness_for_ellipsoid(ellipsoid);
                let mut emit = |contact| self.on_triangle(&local, &ellipsoid.center, contact, found);
                ellipsoid_triangle(ellipsoid, &body.triangles, self.item_b.element, thickness, &mut emit);
            }
        }
    }

    fn test_custom(&self, found: &mut Findings<'_>) {
        let a = element_ref(self.body_a(), self.item_a);
        let b = element_ref(self.body_b(), self.item_b);
        let extensions = &self.context.scene.extensions;
        let (kind_a, kind_b) = (a.kind_name(), b.kind_name());
        if kind_a == kind_b && !self.context.in_order {
            return;
        }
        let Some(test) = extensions.contact_test(kind_a, kind_b) else { return };
        self.whole(test(a, b, &self.motion().x_ba), found);
    }

    /// A contact of one sphere's or ellipsoid's centre with one triangle, unless the centre came from behind.
    fn on_triangle(&self, local: &Vec3, center: &Vec3, contact: TriangleContact, found: &mut Findings<'_>) {
        let earlier = self.motion().since_commit.map(|since| since.x_ba.point(local));
        if earlier.is_none() && self.is_set_down_in_front(center, &contact, &mut found.sides) {
            return;
        }
        let entry = TriangleEntry {
            memory: self.context.memory,
            body: self.body_b(),
            triangle: self.item_b,
            center: *center,
            earlier,
            touched_behind: &|feature| self.touched_triangle_behind(feature),
        };
        let key = self.key();
        let Some(role) = entry.role(&key, &contact) else { return };
        self.emit(&contact.interference, found, |out| {
            out.shares = true;
            out.role = role;
            out.status = match contact.standing {
                Standing::Front => CandidateStatus::Front,
                Standing::Behind => CandidateStatus::BackFace,
                Standing::Spare => CandidateStatus::Fallback,
                Standing::SpareBehind => CandidateStatus::BackFaceFallback,
                Standing::StandIn => CandidateStatus::StandIn,
            };
        });
    }

    /// Whether the sphere or ellipsoid was behind a feature of the triangle, and over it, at the last commit.
    fn touched_triangle_behind(&self, feature: Feature) -> bool {
        let Some(since) = self.motion().since_commit else { return false };
        let (set, triangle) = (&self.body_b().triangles, self.item_b.element);
        let mut touched = false;
        let mut note = |contact: TriangleContact| {
            touched |= contact.interference.feature == feature && contact.standing == Standing::Behind;
        };
        match TransformedPrimitive::new(self.body_a(), self.item_a, &since.x_ba) {
            Some(TransformedPrimitive::Sphere(sphere)) => {
                let thickness = thickness_for(self.context, self.item_b, &sphere);
                sphere_triangle(&sphere, set, triangle, thickness, &mut note);
            }
            Some(TransformedPrimitive::Ellipsoid(ellipsoid)) => {
                let thickness = self.thickness_for_ellipsoid(&ellipsoid);
                ellipsoid_triangle(&ellipsoid, set, triangle, thickness, &mut note);
            }
            _ => {}
        }
        touched
    }

    /// How far behind a triangle the centre of an ellipsoid is still pushed to the front, m.
    fn thickness_for_ellipsoid(&self, ellipsoid: &Ellipsoid) -> f64 {
        self.info_b().thickness.unwrap_or(ellipsoid.smallest_semi_axis())
    }

    /// Whether a contact would push a centre without an earlier place from behind, though the centre is in front of the
    /// surface at its nearest point.
    fn is_set_down_in_front(&self, center: &Vec3, contact: &TriangleContact, sides: &mut KnownSides) -> bool {
        let nearby = Nearby { body: self.body_b(), item: self.item_b, center: *center };
        nearby.is_behind(contact) && sides.in_front(self.item_a, nearby.surface(), || nearby.is_in_front())
    }

    /// For a point inside B's polyhedron, the face that memory reaches and the one that pushes.
    fn entry_face(
        &self,
        local: &Vec3,
        p: &Vec3,
    ) -> Option<crate::frame::narrow_phase::side_of_entry::EntryFace> {
        PolyhedronEntry {
            memory: self.context.memory,
            body: self.body_b(),
            shell: self.info_b().shell,
            piece: self.item_b.element,
            point: *p,
            earlier: self.motion().since_commit.map(|since| since.x_ba.point(local)),
            remembers: self.context.remembers_entry,
        }
        .face(&self.key())
    }

    fn key(&self) -> ContactKey {
        let info_b = self.info_b();
        let shell_b = match info_b.kind {
            Triangle => self.body_b().triangles.triangles[self.item_b.element as usize].shell,
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

    fn whole(&self, contact: Option<Interference>, found: &mut Findings<'_>) {
        if let Some(contact) = contact {
            self.emit(&contact, found, |_| ());
        }
    }

    fn sharing(&self, contact: Option<Interference>, found: &mut Findings<'_>) {
        if let Some(contact) = contact {
            self.emit(&contact, found, |out| out.shares = true);
        }
    }

    fn emit(
        &self,
        contact: &Interference,
        found: &mut Findings<'_>,
        adjust: impl FnOnce(&mut ContactCandidate),
    ) {
        let mut out = ContactCandidate::new(self.key(), contact);
        out.primitive_b = self.item_b.primitive;
        out.element_a = self.item_a.element;
        out.element_b = self.item_b.element;
        out.kind_b = self.kind_b;
        adjust(&mut out);
        found.add(out);
    }
}

/// An element as registered testers see it.
fn element_ref(body: &Body, item: Item) -> PrimitiveRef<'_> {
    let i = item.element as usize;
    match body.primitives[item.primitive as usize].kind {
        PrimitiveKind::Point => PrimitiveRef::Point(&body.points[i]),
        PrimitiveKind::LineSegment => PrimitiveRef::LineSegment(&body.segments[i]),
        PrimitiveKind::Ray => PrimitiveRef::Ray(&body.rays[i]),
        PrimitiveKind::Sphere => PrimitiveRef::Sphere(&body.spheres[i]),
        PrimitiveKind::Ellipsoid => PrimitiveRef::Ellipsoid(&body.ellipsoids[i]),
        Triangle => PrimitiveRef::Triangle(&body.triangles, item.element),
        Polyhedron => PrimitiveRef::Polyhedron(&body.polyhedra[i]),
        Plane => PrimitiveRef::Plane(&body.planes[i]),
        Custom => PrimitiveRef::Custom(&*body.customs[i]),
    }
}
