//! Table of tested kind pairs: kind of A, kind of B, contact tester and cost. Used by dispatch, block layout,
//! default capacity and seal. A new pair needs a file beside this one and a row here. Blank pairs are
//! ignored, since the author may intend them.
//!
//! ```text
//!  A \ B         Sphere  Ellipsoid  Triangle  Polyhedron  Plane  Capsule  Cylinder  Cone  Bore
//!  Point           x         x                    x         x       x        x       x     x
//!  LineSegment                                    x         x       x        x       x     x
//!  Ray             x         x         x          x         x       x        x       x     x
//!  Sphere          x                   x          x         x       x        x       x     x
//!  Ellipsoid                           x          x         x
//!  Capsule                             x          x         x       x        x       x     x
//!  Cylinder                                                 x                              x
//!  Cone                                                     x
//! ```
//!
//! Point–Triangle is blank on purpose: no depth can be defined.

mod ball_bore;
mod ball_round;
mod capsule_polyhedron;
mod capsule_triangle;
mod ellipsoid_plane;
mod ellipsoid_polyhedron;
pub(crate) mod ellipsoid_triangle;
mod line_segment_plane;
mod line_segment_polyhedron;
mod point_ellipsoid;
mod point_plane;
mod point_polyhedron;
mod point_sphere;
mod ray_bore;
mod ray_plane;
mod ray_polyhedron;
mod ray_round;
mod ray_triangle;
mod round_plane;
mod sphere_plane;
mod sphere_polyhedron;
mod sphere_sphere;
pub(crate) mod sphere_triangle;
mod two_ended_bore;
mod two_ended_round;

use super::element_pair::{ChunkCandidates, ElementPair};
use crate::frame::broad_phase::transformed::TransformedPrimitive;
use pong_geometry::primitive::PrimitiveKind::{self, *};

/// Contact tester: one element of A, in B's frame, against one element of B.
pub(crate) type Test = fn(&ElementPair<'_>, &TransformedPrimitive, &mut ChunkCandidates<'_>);

/// A tested pair of kinds.
pub(crate) struct KindPair {
    pub a: PrimitiveKind,
    pub b: PrimitiveKind,
    pub test: Test,
    /// Rough time for an element of A against a body with elements of B, ns. Used only to split the work into
    /// blocks, and to choose between workers and the calling thread.
    pub cost_ns: u32,
    /// Default capacity in contacts, per primitive of A and shell of B.
    pub contacts: usize,
}

/// Assumed cost, ns, and number of contacts of a registered test.
pub(crate) const REGISTERED: (u32, usize) = (200, 1);

#[rustfmt::skip]
const ROWS: &[KindPair] = &[
    KindPair { a: Point, b: Sphere, test: point_sphere::test, cost_ns: 15, contacts: 1 },
    KindPair { a: Point, b: Ellipsoid, test: point_ellipsoid::test, cost_ns: 15, contacts: 1 },
    KindPair { a: Point, b: Polyhedron, test: point_polyhedron::test, cost_ns: 15, contacts: 1 },
    KindPair { a: Point, b: Plane, test: point_plane::test, cost_ns: 15, contacts: 1 },
    KindPair { a: LineSegment, b: Polyhedron, test: line_segment_polyhedron::test, cost_ns: 50, contacts: 2 },
    KindPair { a: LineSegment, b: Plane, test: line_segment_plane::test, cost_ns: 50, contacts: 2 },
    KindPair { a: Ray, b: Triangle, test: ray_triangle::test, cost_ns: 50, contacts: 1 },
    KindPair { a: Ray, b: Polyhedron, test: ray_polyhedron::test, cost_ns: 50, contacts: 1 },
    KindPair { a: Ray, b: Plane, test: ray_plane::test, cost_ns: 50, contacts: 1 },
    KindPair { a: Sphere, b: Sphere, test: sphere_sphere::test, cost_ns: 15, contacts: 1 },
    KindPair { a: Sphere, b: Triangle, test: sphere_triangle::test, cost_ns: 1000, contacts: 4 },
    KindPair { a: Sphere, b: Polyhedron, test: sphere_polyhedron::test, cost_ns: 15, contacts: 4 },
    KindPair { a: Sphere, b: Plane, test: sphere_plane::test, cost_ns: 15, contacts: 1 },
    KindPair { a: Ellipsoid, b: Triangle, test: ellipsoid_triangle::test, cost_ns: 1000, contacts: 4 },
    KindPair { a: Ellipsoid, b: Polyhedron, test: ellipsoid_polyhedron::test, cost_ns: 200, contacts: 4 },
    KindPair { a: Ellipsoid, b: Plane, test: ellipsoid_plane::test, cost_ns: 200, contacts: 1 },
    KindPair { a: Point, b: Capsule, test: ball_round::test_capsule, cost_ns: 15, contacts: 1 },
    KindPair { a: Point, b: Cylinder, test: ball_round::test_frustum, cost_ns: 30, contacts: 1 },
    KindPair { a: Point, b: Cone, test: ball_round::test_frustum, cost_ns: 30, contacts: 1 },
    KindPair { a: LineSegment, b: Capsule, test: two_ended_round::test_capsule, cost_ns: 100, contacts: 3 },
    KindPair { a: LineSegment, b: Cylinder, test: two_ended_round::test_frustum, cost_ns: 1000, contacts: 3 },
    KindPair { a: LineSegment, b: Cone, test: two_ended_round::test_frustum, cost_ns: 1000, contacts: 3 },
    KindPair { a: Sphere, b: Capsule, test: ball_round::test_capsule, cost_ns: 15, contacts: 1 },
    KindPair { a: Sphere, b: Cylinder, test: ball_round::test_frustum, cost_ns: 30, contacts: 1 },
    KindPair { a: Sphere, b: Cone, test: ball_round::test_frustum, cost_ns: 30, contacts: 1 },
    KindPair { a: Capsule, b: Capsule, test: two_ended_round::test_capsule, cost_ns: 100, contacts: 3 },
    KindPair { a: Capsule, b: Cylinder, test: two_ended_round::test_frustum, cost_ns: 1000, contacts: 3 },
    KindPair { a: Capsule, b: Cone, test: two_ended_round::test_frustum, cost_ns: 1000, contacts: 3 },
    KindPair { a: Point, b: Bore, test: ball_bore::test, cost_ns: 30, contacts: 1 },
    KindPair { a: Ray, b: Bore, test: ray_bore::test, cost_ns: 50, contacts: 1 },
    KindPair { a: Sphere, b: Bore, test: ball_bore::test, cost_ns: 30, contacts: 2 },
    KindPair { a: Capsule, b: Triangle, test: capsule_triangle::test, cost_ns: 2000, contacts: 10 },
    KindPair { a: Capsule, b: Polyhedron, test: capsule_polyhedron::test, cost_ns: 500, contacts: 10 },
    KindPair { a: Capsule, b: Plane, test: round_plane::test, cost_ns: 50, contacts: 2 },
    KindPair { a: Cylinder, b: Plane, test: round_plane::test, cost_ns: 50, contacts: 4 },
    KindPair { a: Cone, b: Plane, test: round_plane::test, cost_ns: 50, contacts: 4 },
    KindPair { a: Ray, b: Sphere, test: ray_round::test_sphere, cost_ns: 50, contacts: 1 },
    KindPair { a: Ray, b: Ellipsoid, test: ray_round::test_ellipsoid, cost_ns: 50, contacts: 1 },
    KindPair { a: Ray, b: Capsule, test: ray_round::test_capsule, cost_ns: 50, contacts: 1 },
    KindPair { a: Ray, b: Cylinder, test: ray_round::test_frustum, cost_ns: 50, contacts: 1 },
    KindPair { a: Ray, b: Cone, test: ray_round::test_frustum, cost_ns: 50, contacts: 1 },
    KindPair { a: LineSegment, b: Bore, test: two_ended_bore::test, cost_ns: 1000, contacts: 2 },
    KindPair { a: Capsule, b: Bore, test: two_ended_bore::test, cost_ns: 1000, contacts: 4 },
    KindPair { a: Cylinder, b: Bore, test: two_ended_bore::test, cost_ns: 3000, contacts: 4 },
];

const KINDS: usize = PrimitiveKind::ALL.len();
const NO_ROW: u8 = u8::MAX;

/// Row index of each pair, by kind numbers. No pair has two rows.
const PLACES: [[u8; KINDS]; KINDS] = {
    let mut places = [[NO_ROW; KINDS]; KINDS];
    let mut row = 0;
    while row < ROWS.len() {
        let place = &mut places[ROWS[row].a as usize][ROWS[row].b as usize];
        assert!(*place == NO_ROW, "a pair of kinds has two rows");
        *place = row as u8;
        row += 1;
    }
    places
};

/// Row of a pair, if it is tested.
#[inline]
pub(crate) fn kind_pair(a: PrimitiveKind, b: PrimitiveKind) -> Option<&'static KindPair> {
    ROWS.get(PLACES[a as usize][b as usize] as usize)
}

/// Testers of all pairs by kind numbers; a frame looks here for every two elements that may touch.
const TESTS: [[Option<Test>; KINDS]; KINDS] = {
    let mut tests = [[None; KINDS]; KINDS];
    let mut row = 0;
    while row < ROWS.len() {
        tests[ROWS[row].a as usize][ROWS[row].b as usize] = Some(ROWS[row].test);
        row += 1;
    }
    tests
};

/// Contact tester of a pair, if any.
#[inline]
pub(crate) fn test_of(a: PrimitiveKind, b: PrimitiveKind) -> Option<Test> {
    TESTS[a as usize][b as usize]
}

/// Maximum contacts of one primitive of kind `a`, as A, with one shell.
pub(crate) fn most_contacts(a: PrimitiveKind) -> usize {
    let registered = if a == Custom { REGISTERED.1 } else { 0 };
    ROWS.iter().filter(|row| row.a == a).map(|row| row.contacts).fold(registered, usize::max)
}

/// Returns true if the engine tests primitives of kind `a` as A against primitives of kind `b` as B.
pub fn has_tester(a: PrimitiveKind, b: PrimitiveKind) -> bool {
    kind_pair(a, b).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table in the head comment of this file matches the rows.
    #[test]
    fn the_written_table_shows_the_rows() {
        let text = include_str!("mod.rs").lines().filter_map(|line| line.strip_prefix("//!  "));
        let mut lines = text.filter(|line| line.starts_with(|c: char| c.is_ascii_uppercase()));
        let head = lines.next().unwrap();
        for line in lines {
            let name = line.split_whitespace().next().unwrap();
            let a = PrimitiveKind::ALL.into_iter().find(|kind| kind.name() == name).unwrap();
            for b in PrimitiveKind::ALL.into_iter().filter(|kind| kind.name() != "Custom") {
                let cross = head.find(&format!(" {}", b.name())).is_some_and(|column| {
                    let end = (column + 1 + b.name().len()).min(line.len());
                    line.get(column..end).is_some_and(|cell| cell.contains('x'))
                });
                assert_eq!(cross, has_tester(a, b), "{name} and {}", b.name());
            }
        }
    }
}
