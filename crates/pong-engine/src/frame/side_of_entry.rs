//! From which side something came in: polyhedra push it back there, triangles leave alone what came from behind
//! (physics contract, 2.2 and 2.4).

use crate::state::{ContactKey, ContactMemory, NO_FACE, Role};
use pong_geometry::Vec3;
use pong_geometry::interference::point_polyhedron::{
    entry_of_line, face_most_along, follow, shallowest_face,
};
use pong_geometry::interference::ray_triangle::ray_triangle;
use pong_geometry::interference::triangle_features::{Standing, TriangleContact, TriangleView};
use pong_geometry::primitive::{Polyhedron, PrimitiveKind, Ray, RayResponse};
use pong_geometry::simd::Portable;
use pong_model::Body;
use pong_model::box_tree::{Child, lanes};

/// Which face of a polyhedron memory reaches, and which one pushes.
#[derive(Clone, Copy, Debug)]
pub(super) struct EntryFace {
    pub reached: usize,
    pub pushes: usize,
}

/// A point (or a sphere's centre) inside a piece of B.
pub(super) struct PolyhedronEntry<'a> {
    pub memory: &'a ContactMemory,
    pub body: &'a Body,
    pub shell: u32,
    /// Which polyhedron of the body.
    pub piece: u32,
    /// The point, in B's frame.
    pub point: Vec3,
    /// Where it was at the last commit, in B's frame.
    pub earlier: Option<Vec3>,
    /// Whether the model of B remembers sides of entry.
    pub remembers: bool,
}

impl PolyhedronEntry<'_> {
    /// The faces for a point that is inside the piece; `None` if no face of the piece is active.
    pub fn face(&self, key: &ContactKey) -> Option<EntryFace> {
        let polyhedron = self.polyhedron();
        if !self.remembers {
            let face = shallowest_face(&self.point, polyhedron)?;
            return Some(EntryFace { reached: face, pushes: face });
        }
        let start = match self.remembered(key) {
            Some(face) => face,
            None => self.entered_by()?,
        };
        let reached = follow(&self.point, polyhedron, start);
        Some(EntryFace { reached: reached.face, pushes: reached.pushes })
    }

    fn polyhedron(&self) -> &Polyhedron {
        &self.body.polyhedra[self.piece as usize]
    }

    /// The committed face; carried over if it belongs to another piece of the same surface and the straight line
    /// since the last commit came from there through an inner wall.
    fn remembered(&self, key: &ContactKey) -> Option<usize> {
        let (_, records) = self.memory.under(key);
        let with_face = || records.iter().filter(|record| record.entry_face != NO_FACE);
        let record =
            with_face().find(|record| record.element_b == self.piece).or_else(|| with_face().next())?;
        let faces = &self.body.polyhedra.get(record.element_b as usize)?.faces;
        let old = faces.get(record.entry_face as usize)?;
        if record.element_b == self.piece {
            return Some(record.entry_face as usize).filter(|_| old.active);
        }
        let polyhedron = self.polyhedron();
        let entry = self.earlier.and_then(|earlier| entry_of_line(&earlier, &self.point, polyhedron));
        match entry {
            // Out of the old piece and in again: leaving has ended the memory.
            Some(entry) if polyhedron.faces[entry.face].active => Some(entry.face),
            _ => face_most_along(&old.normal, polyhedron),
        }
    }

    /// The face by which the straight line since the last commit came in; the least deep one without a line.
    fn entered_by(&self) -> Option<usize> {
        let polyhedron = self.polyhedron();
        let entry = self.earlier.and_then(|earlier| entry_of_line(&earlier, &self.point, polyhedron));
        match entry {
            Some(entry) if polyhedron.faces[entry.face].active => Some(entry.face),
            Some(entry) => {
                self.entered_through_wall(entry.at).or_else(|| shallowest_face(&self.point, polyhedron))
            }
            None => shallowest_face(&self.point, polyhedron),
        }
    }

    /// The line came through an inner wall at `at`: the active face by which it had come into the surface, the
    /// nearest one before the wall, carried over into this piece.
    fn entered_through_wall(&self, at: f64) -> Option<usize> {
        let earlier = self.earlier?;
        let wall = earlier + (self.point - earlier) * at;
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
        best.and_then(|(_, normal)| face_most_along(&normal, self.polyhedron()))
    }
}

/// The centre of a sphere or ellipsoid against one triangle of B.
pub(super) struct TriangleEntry<'a> {
    pub memory: &'a ContactMemory,
    pub body: &'a Body,
    pub triangle: u32,
    /// The centre, in B's frame.
    pub center: Vec3,
    /// Where it was at the last commit, in B's frame.
    pub earlier: Option<Vec3>,
}

impl TriangleEntry<'_> {
    /// Whether a contact pushes or is barred; `None` if it does not count at all.
    pub fn role(&self, key: &ContactKey, contact: &TriangleContact) -> Option<Role> {
        let normal = &contact.interference.normal;
        let continues = |role| self.memory.matching(key, normal, role).is_some();
        if continues(Role::Pushes) || continues(Role::Silent) {
            return Some(Role::Pushes);
        }
        let behind = contact.standing == Standing::Behind;
        if continues(Role::Barred) {
            return (!behind).then_some(Role::Barred);
        }
        let Some(earlier) = self.earlier else { return Some(Role::Pushes) };
        let view = TriangleView::new(&self.body.triangles, self.triangle);
        if view.height(&earlier) >= 0.0 {
            return Some(Role::Pushes);
        }
        if behind {
            return None;
        }
        Some(if self.came_from_behind(&earlier, key.shell_b) { Role::Barred } else { Role::Pushes })
    }

    /// Whether the last crossing of the surface by the straight line since the last commit was from behind.
    fn came_from_behind(&self, earlier: &Vec3, shell: u32) -> bool {
        let path = self.center - earlier;
        let length = path.norm();
        if length == 0.0 {
            return false;
        }
        let ray = |origin: Vec3, direction: Vec3| Ray {
            origin,
            direction,
            length,
            reach: None,
            response: RayResponse::Normal,
        };
        let forward = ray(*earlier, path / length);
        let backward = ray(self.center, -path / length);
        // Distances of crossings from the present centre: the smaller came later.
        let (mut from_behind, mut from_front) = (f64::INFINITY, f64::INFINITY);
        self.visit_triangles(&earlier.inf(&self.center), &earlier.sup(&self.center), &mut |triangle| {
            let set = &self.body.triangles;
            if set.triangles[triangle as usize].shell != shell {
                return;
            }
            if let Some(hit) = ray_triangle(&backward, set, triangle, 0.0) {
                from_behind = from_behind.min(hit.distance);
            }
            if let Some(hit) = ray_triangle(&forward, set, triangle, 0.0) {
                from_front = from_front.min(length - hit.distance);
            }
        });
        from_behind < from_front
    }

    /// Calls `visit` with every triangle whose box meets that between two corners.
    fn visit_triangles(&self, low: &Vec3, high: &Vec3, visit: &mut dyn FnMut(u32)) {
        let tree = &self.body.tree;
        for batch in tree.batches.iter().filter(|batch| batch.kind == PrimitiveKind::Triangle) {
            batch.boxes.visit(Portable, &batch.boxes.narrowed(low, high), |node, met| {
                for lane in lanes(met) {
                    if let Child::Element(place) = node.child(lane) {
                        visit(tree.items[(batch.items.start + place) as usize].element);
                    }
                }
            });
        }
    }
}
