//! Table of the pairs of kinds that are tested: kind of A, kind of B, contact tester and cost. Dispatch,
//! block layout, default capacity and seal use it. A new pair needs a row here; a tester that does more than
//! its interference test is in `balls` or `axes`. A blank pair is not tested. It is no error, because a model
//! author may intend it.
//!
//! ```text
//!  A \ B         Sphere  Ellipsoid  Triangle  Polyhedron  Plane  Capsule  Cylinder  Cone  Bore
//!  Point           x         x                    x         x       x        x       x     x
//!  LineSegment                                    x         x       x        x       x     x
//!  Ray             x         x         x          x         x       x        x       x     x
//!  Sphere          x         x         x          x         x       x        x       x     x
//!  Ellipsoid                 x         x          x         x       x        x       x
//!  Capsule                             x          x         x       x        x       x     x
//!  Cylinder                            x          x         x                x       x     x
//!  Cone                                x          x         x                        x
//! ```
//!
//! Point–Triangle is blank on purpose: no depth can be defined.

mod axes;
pub(crate) mod balls;

use super::element_pair::{ChunkCandidates, ElementPair, wrong_kind};
use super::registered;
use crate::frame::broad_phase::transformed::TransformedPrimitive;
use axes::{
    axis_in_bore, capsule_polyhedron, capsule_triangle, emit_halves, emit_shares, frustum_polyhedron,
    frustum_triangle, line_segment_polyhedron,
};
use balls::{
    ball_in_bore, ball_of, ellipsoid_polyhedron, ellipsoid_triangle, emit_hit, point_polyhedron,
    ray_on_triangle, sphere_on_triangle, sphere_polyhedron,
};
use pong_geometry::interference::ball_round::{ball_capsule, ball_frustum};
use pong_geometry::interference::ellipsoid_ellipsoid::ellipsoid_ellipsoid;
use pong_geometry::interference::ellipsoid_plane::ellipsoid_plane;
use pong_geometry::interference::ellipsoid_round::{ellipsoid_capsule, ellipsoid_frustum};
use pong_geometry::interference::line_segment_plane::line_segment_plane;
use pong_geometry::interference::point_ellipsoid::point_ellipsoid;
use pong_geometry::interference::point_plane::point_plane;
use pong_geometry::interference::point_sphere::point_sphere;
use pong_geometry::interference::ray_bore::ray_bore;
use pong_geometry::interference::ray_plane::ray_plane;
use pong_geometry::interference::ray_polyhedron::ray_polyhedron;
use pong_geometry::interference::ray_round::{ray_capsule, ray_ellipsoid, ray_frustum, ray_sphere};
use pong_geometry::interference::round_plane::{capsule_plane, frustum_plane};
use pong_geometry::interference::sphere_ellipsoid::sphere_ellipsoid;
use pong_geometry::interference::sphere_plane::sphere_plane;
use pong_geometry::interference::sphere_sphere::sphere_sphere;
use pong_geometry::interference::two_capsules::{capsule_capsule, segment_capsule};
use pong_geometry::interference::two_ended_round::{capsule_frustum, segment_frustum};
use pong_geometry::interference::two_frusta::two_frusta;
use pong_geometry::primitive::PrimitiveKind::{self, *};

/// Contact tester: one element of A, in B's frame, against one element of B.
pub(crate) type Test = fn(&ElementPair<'_>, &TransformedPrimitive, &mut ChunkCandidates<'_>);

/// A tested pair of kinds.
pub(crate) struct KindPair {
    pub a: PrimitiveKind,
    pub b: PrimitiveKind,
    pub test: Test,
    /// Rough time to test an element of A against a movable group with elements of B, ns. Used only to split
    /// the work into blocks, and to choose between workers and the calling thread.
    pub cost_ns: u32,
    /// Number of contacts per primitive of A and shell of B in the default capacity.
    pub contacts: usize,
}

/// Assumed cost, ns, and number of contacts of a registered test.
pub(crate) const REGISTERED: (u32, usize) = (200, 1);

/// Makes a tester from an interference test. Arguments: shape of A, array of B, test, and the function that
/// adds the contacts. Without this function the test gives at most one contact, which has a whole spring.
macro_rules! by {
    ($a:ident, $b:ident, $test:expr) => {{
        fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
            let TransformedPrimitive::$a(a) = a else { wrong_kind(a) };
            if let Some(contact) = ($test)(a, &pair.body_b().$b[pair.item_b.element as usize]) {
                pair.emit(pair.key(), &contact, found, |_| ());
            }
        }
        test
    }};
    ($a:ident, $b:ident, $test:expr, $emit:path) => {{
        fn test(pair: &ElementPair<'_>, a: &TransformedPrimitive, found: &mut ChunkCandidates<'_>) {
            let TransformedPrimitive::$a(a) = a else { wrong_kind(a) };
            $emit(pair, a, ($test)(a, &pair.body_b().$b[pair.item_b.element as usize]), found);
        }
        test
    }};
}

const fn row(a: PrimitiveKind, b: PrimitiveKind, test: Test, cost_ns: u32, contacts: usize) -> KindPair {
    KindPair { a, b, test, cost_ns, contacts }
}

/// Kind of A, kind of B, tester, rough cost in ns, number of contacts.
#[rustfmt::skip]
const ROWS: &[KindPair] = &[
    row(Point, Sphere, by!(Point, spheres, point_sphere), 15, 1),
    row(Point, Ellipsoid, by!(Point, ellipsoids, |a, b| point_ellipsoid(&ball_of(a).center, b)), 15, 1),
    row(Point, Polyhedron, point_polyhedron, 15, 1),
    row(Point, Plane, by!(Point, planes, point_plane), 15, 1),
    row(Point, Capsule, by!(Point, capsules, |a, b| ball_capsule(&ball_of(a), b)), 15, 1),
    row(Point, Cylinder, by!(Point, frusta, |a, b| ball_frustum(&ball_of(a), b)), 30, 1),
    row(Point, Cone, by!(Point, frusta, |a, b| ball_frustum(&ball_of(a), b)), 30, 1),
    row(Point, Bore, ball_in_bore, 30, 1),
    row(LineSegment, Polyhedron, line_segment_polyhedron, 50, 2),
    row(LineSegment, Plane, by!(Segment, planes, line_segment_plane, emit_halves), 50, 2),
    row(LineSegment, Capsule, by!(Segment, capsules, segment_capsule, emit_shares), 100, 2),
    row(LineSegment, Cylinder, by!(Segment, frusta, segment_frustum, emit_shares), 1000, 2),
    row(LineSegment, Cone, by!(Segment, frusta, segment_frustum, emit_shares), 1000, 2),
    row(LineSegment, Bore, axis_in_bore, 1000, 2),
    row(Ray, Sphere, by!(Ray, spheres, ray_sphere, emit_hit), 50, 1),
    row(Ray, Ellipsoid, by!(Ray, ellipsoids, ray_ellipsoid, emit_hit), 50, 1),
    row(Ray, Triangle, ray_on_triangle, 50, 1),
    row(Ray, Polyhedron, by!(Ray, polyhedra, ray_polyhedron, emit_hit), 50, 1),
    row(Ray, Plane, by!(Ray, planes, ray_plane, emit_hit), 50, 1),
    row(Ray, Capsule, by!(Ray, capsules, ray_capsule, emit_hit), 50, 1),
    row(Ray, Cylinder, by!(Ray, frusta, ray_frustum, emit_hit), 50, 1),
    row(Ray, Cone, by!(Ray, frusta, ray_frustum, emit_hit), 50, 1),
    row(Ray, Bore, by!(Ray, bores, ray_bore, emit_hit), 50, 1),
    row(Sphere, Sphere, by!(Sphere, spheres, sphere_sphere), 15, 1),
    row(Sphere, Ellipsoid, by!(Sphere, ellipsoids, sphere_ellipsoid), 50, 1),
    row(Sphere, Triangle, sphere_on_triangle, 1000, 4),
    row(Sphere, Polyhedron, sphere_polyhedron, 15, 4),
    row(Sphere, Plane, by!(Sphere, planes, sphere_plane), 15, 1),
    row(Sphere, Capsule, by!(Sphere, capsules, ball_capsule), 15, 1),
    row(Sphere, Cylinder, by!(Sphere, frusta, ball_frustum), 30, 1),
    row(Sphere, Cone, by!(Sphere, frusta, ball_frustum), 30, 1),
    row(Sphere, Bore, ball_in_bore, 30, 2),
    row(Ellipsoid, Ellipsoid, by!(Ellipsoid, ellipsoids, ellipsoid_ellipsoid), 1000, 1),
    row(Ellipsoid, Triangle, ellipsoid_triangle, 1000, 4),
    row(Ellipsoid, Polyhedron, ellipsoid_polyhedron, 200, 4),
    row(Ellipsoid, Plane, by!(Ellipsoid, planes, ellipsoid_plane), 200, 1),
    row(Ellipsoid, Capsule, by!(Ellipsoid, capsules, ellipsoid_capsule), 200, 1),
    row(Ellipsoid, Cylinder, by!(Ellipsoid, frusta, ellipsoid_frustum), 3000, 1),
    row(Ellipsoid, Cone, by!(Ellipsoid, frusta, ellipsoid_frustum), 3000, 1),
    row(Capsule, Triangle, capsule_triangle, 2000, 10),
    row(Capsule, Polyhedron, capsule_polyhedron, 500, 10),
    row(Capsule, Plane, by!(Capsule, planes, capsule_plane, emit_halves), 50, 2),
    row(Capsule, Capsule, by!(Capsule, capsules, capsule_capsule, emit_shares), 100, 2),
    row(Capsule, Cylinder, by!(Capsule, frusta, capsule_frustum, emit_shares), 1000, 2),
    row(Capsule, Cone, by!(Capsule, frusta, capsule_frustum, emit_shares), 1000, 2),
    row(Capsule, Bore, axis_in_bore, 1000, 4),
    row(Cylinder, Triangle, frustum_triangle, 4000, 14),
    row(Cylinder, Polyhedron, frustum_polyhedron, 2000, 14),
    row(Cylinder, Plane, by!(Frustum, planes, frustum_plane, emit_halves), 50, 4),
    row(Cylinder, Cylinder, by!(Frustum, frusta, two_frusta, emit_shares), 40_000, 4),
    row(Cylinder, Cone, by!(Frustum, frusta, two_frusta, emit_shares), 40_000, 4),
    row(Cylinder, Bore, axis_in_bore, 3000, 4),
    row(Cone, Triangle, frustum_triangle, 4000, 14),
    row(Cone, Polyhedron, frustum_polyhedron, 2000, 14),
    row(Cone, Plane, by!(Frustum, planes, frustum_plane, emit_halves), 50, 4),
    row(Cone, Cone, by!(Frustum, frusta, two_frusta, emit_shares), 40_000, 4),
];

const KINDS: usize = PrimitiveKind::ALL.len();
const NO_ROW: u8 = u8::MAX;

/// Row index of each pair of kinds; no pair has two rows.
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

/// Row of a pair of kinds, if the pair is tested.
#[inline]
pub(crate) fn kind_pair(a: PrimitiveKind, b: PrimitiveKind) -> Option<&'static KindPair> {
    ROWS.get(PLACES[a as usize][b as usize] as usize)
}

/// Contact testers of all pairs of kinds. Pairs without a row have the test that the host has registered, if
/// any.
const TESTS: [[Test; KINDS]; KINDS] = {
    let mut tests = [[registered::test as Test; KINDS]; KINDS];
    let mut row = 0;
    while row < ROWS.len() {
        tests[ROWS[row].a as usize][ROWS[row].b as usize] = ROWS[row].test;
        row += 1;
    }
    tests
};

/// Contact tester of a pair of kinds.
#[inline]
pub(crate) fn test_of(a: PrimitiveKind, b: PrimitiveKind) -> Test {
    TESTS[a as usize][b as usize]
}

/// Maximum number of contacts of one primitive of kind `a`, as A, with one shell of the kinds for which `meets` is
/// true.
pub(crate) fn most_contacts(a: PrimitiveKind, meets: impl Fn(PrimitiveKind) -> bool) -> usize {
    let contacts = |b| kind_pair(a, b).map_or(REGISTERED.1, |row| row.contacts);
    PrimitiveKind::ALL.into_iter().filter(|&b| meets(b)).map(contacts).max().unwrap_or(0)
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
