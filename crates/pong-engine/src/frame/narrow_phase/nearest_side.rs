//! Side of a surface of triangles on which a centre lies that has no earlier position. The point of the
//! surface nearest to the centre decides.

use pong_geometry::Vec3;
use pong_geometry::interference::Interference;
use pong_geometry::interference::nearest_on_triangle::{is_in_front_at, nearest_on_triangle};
use pong_geometry::interference::triangle_features::{TriangleContact, TriangleView, is_in_front_of_a_face};
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::simd::{LANES, Portable};
use pong_model::box_tree::{Child, lanes};
use pong_model::{Item, MovableGroup};

/// Relative widening of the search box around the centre, so that rounding excludes no triangle.
const REACH_SLACK: f64 = 1e-6;

/// Distance from a plane, relative to the coordinates and distances in the computation, below which a centre
/// counts as in the plane.
pub(crate) const ROUNDING: f64 = 1e-12;

/// A triangle of a movable group, and the centre of a sphere or ellipsoid.
pub(crate) struct Nearby<'a> {
    pub body: &'a MovableGroup,
    pub item: Item,
    /// Centre in the frame of the triangle's movable group, m.
    pub center_b: Vec3,
}

/// A sphere or an ellipsoid (end 0), or one end of a capsule.
type End = (Item, u32);

/// Cache of the sides found in a block: an end of an element of A, a shell of B, and true if the centre is in
/// front of the shell. A new entry replaces the oldest.
#[derive(Default)]
pub(crate) struct KnownSides {
    of: [Option<(End, u32, bool)>; LANES],
    next: usize,
}

impl KnownSides {
    /// Returns true if an element of A is in front of a surface; `find` is called if the cache has no entry.
    pub fn in_front(&mut self, end_a: End, shell: u32, find: impl FnOnce() -> bool) -> bool {
        let known = self.of.iter().flatten().find(|(end, of, _)| (*end, *of) == (end_a, shell));
        if let Some((_, _, in_front)) = known {
            return *in_front;
        }
        let in_front = find();
        self.of[self.next] = Some((end_a, shell, in_front));
        self.next = (self.next + 1) % LANES;
        in_front
    }
}

impl Nearby<'_> {
    /// Returns true if the triangle is the back of a two-sided one.
    pub fn is_mirror(&self) -> bool {
        self.item.element >= self.body.primitives[self.item.primitive as usize].first_mirror
    }

    /// Returns true if the centre is behind the contact point along the normal, and behind all faces that
    /// meet at the contact's feature. A centre in the plane of a two-sided triangle is on its front side,
    /// hence behind its back.
    pub fn is_behind(&self, contact: &TriangleContact) -> bool {
        let Interference { depth, normal_b, deepest_b, feature } = &contact.interference;
        let arm = self.center_b - deepest_b;
        let (height, rounding) = (normal_b.dot(&arm) - depth, ROUNDING * (arm.norm() + self.center_b.amax()));
        let rounding = if self.is_mirror() { -rounding } else { rounding };
        let (set, triangle) = (&self.body.triangles, self.item.element);
        height <= -rounding && !is_in_front_of_a_face(&self.center_b, set, triangle, *feature, rounding)
    }

    /// Returns true if a point is in front of the triangle's plane, or within rounding of it. A point within
    /// rounding of a two-sided triangle is on its front side, so it is not in front of its back.
    pub fn is_in_front_of_triangle(&self, p: &Vec3) -> bool {
        let view = TriangleView::new(&self.body.triangles, self.item.element);
        let rounding = ROUNDING * ((p - view.corners[0]).amax() + p.amax());
        if self.is_mirror() { view.height(p) > rounding } else { view.height(p) >= -rounding }
    }

    /// Shell of the triangle, or of its front triangle if it is the back of a two-sided one.
    pub fn surface(&self) -> u32 {
        self.shell(self.front())
    }

    /// Returns true if the centre is in front of the surface at the surface point nearest to it; always true
    /// if this point is on a two-sided triangle.
    ///
    /// The nearest triangle of the whole surface decides, and of equally near ones the first of the model. So
    /// the result does not depend on bounding volumes, leaves or blocks.
    pub fn is_in_front(&self) -> bool {
        let set = &self.body.triangles;
        let (front, shell) = (self.front(), self.surface());
        let distance = |triangle: u32| nearest_on_triangle(&self.center_b, &set.corners(triangle));
        let (mut square, mut place) = distance(front);
        let mut nearest = Item { element: front, ..self.item };
        let reach = Vec3::repeat(square.sqrt() * (1.0 + REACH_SLACK));
        visit_triangles(self.body, &(self.center_b - reach), &(self.center_b + reach), &mut |item| {
            if self.shell(item.element) == shell {
                let (other, at) = distance(item.element);
                if (other, item.element) < (square, nearest.element) {
                    (square, place, nearest) = (other, at, item);
                }
            }
        });
        // A centre on the surface, within rounding, is in front.
        let rounding = ROUNDING * self.center_b.amax();
        let info = &self.body.primitives[nearest.primitive as usize];
        square <= rounding * rounding
            || info.first_mirror < info.elements.end
            || is_in_front_at(&self.center_b, set, nearest.element, place)
    }

    /// Returns the index of the triangle, or of its front triangle if it is the back of a two-sided one.
    fn front(&self) -> u32 {
        let info = &self.body.primitives[self.item.primitive as usize];
        let element = self.item.element;
        if self.is_mirror() { element - info.first_mirror + info.elements.start } else { element }
    }

    fn shell(&self, triangle: u32) -> u32 {
        self.body.triangles.triangles[triangle as usize].shell
    }
}

/// Calls `visit` for every triangle whose box overlaps the given box.
pub(crate) fn visit_triangles(body: &MovableGroup, low: &Vec3, high: &Vec3, visit: &mut dyn FnMut(Item)) {
    let tree = &body.tree;
    for batch in tree.batches.iter().filter(|batch| batch.kind == PrimitiveKind::Triangle) {
        batch.boxes.visit(Portable, &batch.boxes.narrowed(low, high), |node, met| {
            for lane in lanes(met) {
                if let Child::Element(place) = node.child(lane) {
                    visit(tree.items[(batch.items.start + place) as usize]);
                }
            }
        });
    }
}
