//! Side of entry: a polyhedron pushes an element back to the side from which it came; a triangle does not
//! push an element that came from behind (docs/theory.md, 2.2 and 2.4).

use crate::frame::input::motion::SinceCommit;
use crate::frame::narrow_phase::nearest_side::{Nearby, ROUNDING, visit_triangles};
use crate::state::{ContactRecord, ContactRole, NO_FACE, RecordsOfKey, SAME_WAY_COSINE_MIN};
use pong_geometry::interference::point_polyhedron::{
    entry_of_line, face_most_along, follow, shallowest_face,
};
use pong_geometry::interference::ray_triangle::{ray_back_of_triangle, ray_triangle};
use pong_geometry::interference::triangle_features::{
    Standing, TriangleContact, TriangleView, is_in_front_of_a_face, place_on_feature,
};
use pong_geometry::interference::{Feature, Interference};
use pong_geometry::primitive::{Polyhedron, PrimitiveKind, Ray};
use pong_geometry::{Vec3, divisor};
use pong_model::{Item, MovableGroup};
use std::num::NonZeroU32;

/// Current face of entry of a polyhedron, and the face that pushes. The index has no zero, so that an
/// `Option` of both fits into one register.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EntryFace {
    /// Index of the current face of entry plus one.
    reached: NonZeroU32,
    pushes: u32,
}

impl EntryFace {
    fn new(reached: usize, pushes: usize) -> Self {
        Self { reached: NonZeroU32::MIN.saturating_add(reached as u32), pushes: pushes as u32 }
    }

    /// Face to remember.
    pub fn reached(self) -> u32 {
        self.reached.get() - 1
    }

    /// Face that pushes.
    pub fn pushes(self) -> usize {
        self.pushes as usize
    }
}

/// Distance before the entry into a piece of a declared surface at which its other primitives are searched, in
/// diameters of the piece: above the tolerance of internal faces, so that a path cannot be between two pieces.
const BEFORE_ENTRY: f64 = 4e-6;

/// A point (or a sphere's centre) inside a piece of B.
pub(crate) struct PolyhedronEntry<'a> {
    /// Records of A's primitive with this surface.
    pub records: &'a [ContactRecord],
    pub body: &'a MovableGroup,
    pub shell: u32,
    /// Index of the polyhedron in B's movable group.
    pub piece: u32,
    /// The polyhedron, or the convex solid for which it stands.
    pub polyhedron: &'a Polyhedron,
    /// The point in A's frame. Its earlier position in B's frame is computed only if needed.
    pub point_a: &'a Vec3,
    pub since: Option<&'a SinceCommit>,
    /// The point in B's frame.
    pub point_b: Vec3,
    /// True if B's model remembers sides of entry.
    pub remembers: bool,
}

impl<'a> PolyhedronEntry<'a> {
    /// Current face of entry and pushing face for the point; `None` if the piece has no active face.
    pub fn face(&self) -> Option<EntryFace> {
        let polyhedron = self.polyhedron;
        if !self.remembers {
            let face = shallowest_face(&self.point_b, polyhedron)?;
            return Some(EntryFace::new(face, face));
        }
        let start = match self.remembered() {
            Some(face) => face,
            None => self.entered_by()?,
        };
        let reached = follow(&self.point_b, polyhedron, start);
        Some(EntryFace::new(reached.face, reached.pushes))
    }

    /// Position of the point at the last commit, in B's frame.
    fn earlier_b(&self) -> Option<Vec3> {
        self.since.map(|since| since.x_ba.point(self.point_a))
    }

    /// Face of entry in this piece by the records; `None` without a usable record.
    ///
    /// If the remembered face belongs to another piece of the surface, the result is the active face through
    /// which the straight path since the last commit entered this piece. If there is no such face, it is the
    /// face of this piece whose normal is nearest to that of the remembered face.
    fn remembered(&self) -> Option<usize> {
        let with_face = || self.records.iter().filter(|record| record.entry_face != NO_FACE);
        let record =
            with_face().find(|record| record.element_b == self.piece).or_else(|| with_face().next())?;
        let face_of = |polyhedron: &'a Polyhedron| polyhedron.faces.get(record.entry_face as usize);
        if record.element_b == self.piece {
            return face_of(self.polyhedron).filter(|face| face.active).map(|_| record.entry_face as usize);
        }
        let old = face_of(self.body.polyhedra.get(record.element_b as usize)?)?;
        let polyhedron = self.polyhedron;
        let entry = self.earlier_b().and_then(|earlier| entry_of_line(&earlier, &self.point_b, polyhedron));
        match entry {
            // The path left the body and entered it again: the remembered face no longer counts.
            Some(entry) if self.came_in_by(entry.face, entry.at) => Some(entry.face),
            _ => face_most_along(&old.normal, &self.point_b, polyhedron),
        }
    }

    /// Face of entry in this piece by the straight path since the last commit. If the path did not enter
    /// through an active face of the surface, it is the face of least depth; `None` if the piece has no
    /// active face.
    fn entered_by(&self) -> Option<usize> {
        let polyhedron = self.polyhedron;
        let entry = self.earlier_b().and_then(|earlier| entry_of_line(&earlier, &self.point_b, polyhedron));
        match entry {
            Some(entry) if self.came_in_by(entry.face, entry.at) => Some(entry.face),
            Some(entry) => {
                self.entered_through_wall(entry.at).or_else(|| shallowest_face(&self.point_b, polyhedron))
            }
            None => shallowest_face(&self.point_b, polyhedron),
        }
    }

    /// Returns true if a path that entered this piece through a face, at the parameter `at`, came into the body
    /// there. A path through an internal face did not, nor did one that came out of another primitive of a declared
    /// surface.
    fn came_in_by(&self, face: usize, at: f64) -> bool {
        let polyhedron = self.polyhedron;
        if !polyhedron.faces[face].active || !self.body.is_joint(self.shell) {
            return polyhedron.faces[face].active;
        }
        let Some(earlier) = self.earlier_b() else { return true };
        let path = self.point_b - earlier;
        let before =
            earlier + path * (at - BEFORE_ENTRY * polyhedron.diameter / divisor(path.norm())).max(0.0);
        !self.body.is_in_another(self.shell, self.piece, &before)
    }

    /// Face of entry in this piece for a path that entered it through an internal face, at the parameter
    /// `at`. It is the face whose normal is nearest to that of the last active face through which the path
    /// entered another piece before; `None` if there was none.
    fn entered_through_wall(&self, at: f64) -> Option<usize> {
        let earlier = self.earlier_b()?;
        let wall = earlier + (self.point_b - earlier) * at;
        let mut best: Option<(f64, Vec3)> = None;
        let pieces = self.body.primitives.iter().filter(|info| {
            info.kind == PrimitiveKind::Polyhedron
                && info.shell == self.shell
                && info.elements.start != self.piece
        });
        for piece in pieces {
            let polyhedron = &self.body.polyhedra[piece.elements.start as usize];
            let Some(entry) = entry_of_line(&earlier, &wall, polyhedron) else { continue };
            let face = &polyhedron.faces[entry.face];
            if face.active && best.is_none_or(|(last, _)| entry.at > last) {
                best = Some((entry.at, face.normal));
            }
        }
        best.and_then(|(_, normal)| face_most_along(&normal, &self.point_b, self.polyhedron))
    }
}

/// Centre of a sphere or ellipsoid against one triangle of B.
pub(crate) struct TriangleEntry<'a> {
    /// Records of A's primitive with this surface.
    pub remembered: &'a RecordsOfKey<'a>,
    /// Shell of the surface.
    pub shell: u32,
    pub body: &'a MovableGroup,
    pub triangle: Item,
    /// Centre in B's frame.
    pub center_b: Vec3,
    /// Centre at the last commit, in B's frame.
    pub earlier_b: Option<Vec3>,
    /// Returns true if A touched a feature of the triangle at the last commit with the centre behind it,
    /// whether the contact pushed or not.
    pub touched_behind: &'a dyn Fn(Feature) -> bool,
}

impl TriangleEntry<'_> {
    /// Role of a contact: `Active` or `WrongSide`; `None` if the contact does not count.
    pub fn role(&self, contact: &TriangleContact) -> Option<ContactRole> {
        let nearby = self.nearby();
        let may_be_behind = contact.standing != Standing::Front || nearby.is_mirror();
        if may_be_behind && nearby.is_behind(contact) {
            return self.pushes_from_behind(contact).then_some(ContactRole::Active);
        }
        let Interference { normal_b, feature, .. } = &contact.interference;
        match self.remembered.role_of_nearest(normal_b, *feature) {
            Some(ContactRole::WrongSide) => return Some(ContactRole::WrongSide),
            Some(_) => return Some(ContactRole::Active),
            None => {}
        }
        let Some(earlier) = self.earlier_b else { return Some(ContactRole::Active) };
        let was_in_front = self.was_in_front(&earlier, *feature);
        let barred = !was_in_front && self.came_from_behind(&earlier, self.shell);
        Some(if barred { ContactRole::WrongSide } else { ContactRole::Active })
    }

    /// Returns true if a feature that has the centre behind it pushes the centre back to the front, because
    /// the centre came from there. Without an earlier position it pushes. Otherwise one of these conditions
    /// must hold:
    ///
    /// * At the last commit, a contact with nearly the same normal held the centre from behind.
    /// * At the last commit, the centre was in front of a face at this feature, and it has not passed the
    ///   face's plane beside the face.
    /// * Since the last commit, the path of the centre crossed the surface from the front, and the centre
    ///   lies below this feature by no more than its distance from the crossing.
    ///
    /// If none holds, the feature belongs to a farther sheet of the surface, and the centre has been behind
    /// that sheet all the time. A remembered `WrongSide` contact with nearly the same normal excludes the
    /// last two conditions.
    fn pushes_from_behind(&self, contact: &TriangleContact) -> bool {
        let Some(earlier) = self.earlier_b else { return true };
        let Interference { depth, normal_b, deepest_b, feature } = &contact.interference;
        if self.was_held_behind(&contact.interference, &earlier) {
            return true;
        }
        if self.remembered.matching(normal_b, ContactRole::WrongSide).is_some() {
            return false;
        }
        if self.was_in_front(&earlier, *feature) {
            return self.came_through_or_under(contact, &earlier);
        }
        let below = depth - normal_b.dot(&(self.center_b - deepest_b));
        let in_plane = |height: f64, p: &Vec3| height >= -ROUNDING * p.amax();
        let is_or_was_in_plane =
            || in_plane(self.height_of(&earlier), &earlier) || in_plane(-below, &self.center_b);
        if self.nearby().is_mirror() && is_or_was_in_plane() {
            // A centre in the plane counts as on the front side: no crossing.
            return false;
        }
        if below > (self.center_b - earlier).norm() {
            return false;
        }
        let crossed = self.last_crossings(&earlier, self.shell);
        crossed.from_front < crossed.from_behind && below <= crossed.from_front * (1.0 + ROUNDING)
    }

    /// Returns true if the feature pushes a centre that was in front of the feature's plane at the last
    /// commit and is behind the plane now.
    ///
    /// The plane extends past its face. The centre has passed the plane beside the face if its path did not
    /// cross the surface and it is in front of the surface at its nearest point. The feature does not push
    /// such a centre, unless a record shows that the contact held it before.
    fn came_through_or_under(&self, contact: &TriangleContact, earlier: &Vec3) -> bool {
        let normal_b = &contact.interference.normal_b;
        let held = |role| self.remembered.matching(normal_b, role).is_some();
        held(ContactRole::Active)
            || held(ContactRole::Tracked)
            || self.last_crossings(earlier, self.shell).are_any()
            || !self.nearby().is_in_front()
    }

    /// Returns true if, at the last commit, the centre was in front of a triangle at the feature. A centre in
    /// the plane of a one-sided triangle counts as in front; in the plane of a two-sided triangle, it is in
    /// front of the front only.
    fn was_in_front(&self, earlier: &Vec3, feature: Feature) -> bool {
        let rounding = ROUNDING * earlier.amax() * if self.nearby().is_mirror() { -1.0 } else { 1.0 };
        is_in_front_of_a_face(earlier, &self.body.triangles, self.triangle.element, feature, rounding)
    }

    fn height_of(&self, p: &Vec3) -> f64 {
        TriangleView::new(&self.body.triangles, self.triangle.element).height(p)
    }

    /// Returns true if a remembered contact with nearly the same normal held a centre that was behind its
    /// feature or in its plane. A record of another feature counts only if A did not touch the present
    /// feature from behind at the last commit: a feature that was touched then and did not push does not push
    /// now.
    fn was_held_behind(&self, present: &Interference, earlier: &Vec3) -> bool {
        let records = self.remembered.records;
        let Interference { normal_b, feature, .. } = present;
        let held = |record: &ContactRecord| {
            let place = || place_on_feature(&self.body.triangles, Feature(record.feature));
            let is_behind = |place: Vec3| {
                let arm = earlier - place;
                record.normal_b.dot(&arm) <= ROUNDING * (arm.norm() + earlier.amax())
            };
            record.role != ContactRole::WrongSide
                && record.normal_b.dot(normal_b) > SAME_WAY_COSINE_MIN
                && place().is_some_and(is_behind)
        };
        records.iter().any(|record| record.feature == feature.0 && held(record))
            || (records.iter().any(held) && !(self.touched_behind)(*feature))
    }

    /// Returns true if the last crossing of the surface by the path since the last commit was from behind.
    fn came_from_behind(&self, earlier: &Vec3, shell: u32) -> bool {
        let crossed = self.last_crossings(earlier, shell);
        crossed.from_behind < crossed.from_front
    }

    /// Last crossings of the surface by the straight path since the last commit.
    ///
    /// The crossings in both directions are found on the same line, so that the two sides of a two-sided
    /// triangle agree. A path that starts or ends within rounding of the surface does so in front of it; for
    /// a two-sided triangle, on its front side. A path that enters and leaves at one point, as through a
    /// vertex from outside, does not cross.
    fn last_crossings(&self, earlier: &Vec3, shell: u32) -> LastCrossings {
        let length = (self.center_b - earlier).norm();
        let rounding = ROUNDING * (length + earlier.amax() + self.center_b.amax());
        let mut skipped = 0.0;
        loop {
            let last = self.last_crossings_before(earlier, shell, skipped);
            let LastCrossings { from_behind, from_front } = last;
            // Without a crossing both are infinite, and the comparison alone would never end the loop.
            if !last.are_any() || from_behind.max(from_front) > from_behind.min(from_front) + rounding {
                return last;
            }
            skipped = from_behind.max(from_front) + rounding;
        }
    }

    /// Last crossings that lie more than `skipped` (m) before the end of the path.
    fn last_crossings_before(&self, earlier: &Vec3, shell: u32, skipped: f64) -> LastCrossings {
        let mut last = LastCrossings { from_behind: f64::INFINITY, from_front: f64::INFINITY };
        let Some(line) = Ray::between(earlier, &self.center_b) else { return last };
        let length = line.length;
        // The hit distance of a grazing ray is undefined. So the ray is unbounded, and the heights of the
        // path's ends above the plane show on which side they are.
        let ray = Ray { length: f64::MAX, ..line };
        visit_triangles(self.body, &earlier.inf(&self.center_b), &earlier.sup(&self.center_b), &mut |item| {
            let (set, triangle) = (&self.body.triangles, item.element);
            if set.triangles[triangle as usize].shell != shell {
                return;
            }
            let front = ray_triangle(&ray, set, triangle, f64::MAX);
            let back = || ray_back_of_triangle(&ray, set, triangle, f64::MAX);
            let Some(hit) = front.or_else(back) else { return };
            let ago = (length - hit.distance).clamp(0.0, length);
            if skipped > 0.0 && ago <= skipped {
                return;
            }
            let nearby = Nearby { item, ..self.nearby() };
            match [earlier, &self.center_b].map(|p| nearby.is_in_front_of_triangle(p)) {
                [true, false] => last.from_front = last.from_front.min(ago),
                [false, true] => last.from_behind = last.from_behind.min(ago),
                _ => {}
            }
        });
        last
    }

    fn nearby(&self) -> Nearby<'_> {
        Nearby { body: self.body, item: self.triangle, center_b: self.center_b }
    }
}

/// Distances from the last crossings of a surface to the end of a path, m, by the side from which the path
/// came; infinite without a crossing.
struct LastCrossings {
    from_behind: f64,
    from_front: f64,
}

impl LastCrossings {
    fn are_any(&self) -> bool {
        self.from_behind.min(self.from_front) < f64::INFINITY
    }
}
