//! Distance of convex solids: closed forms, and random poses with certificates. The nearest points are members, and the slab
//! between them is empty; both together prove the distance, whoever found it.

use crate::common::Random;
use crate::distance_support::{KINDS, Shape, polyhedra};
use pong_geometry::distance::{Distance, Solid};
use pong_geometry::primitive::{Capsule, LineSegment, Plane, Polyhedron, Sphere};
use pong_geometry::{Transform, Vec3};
use pong_testkit::samples;

/// Accuracy of points, segments, triangles, balls, capsules and polyhedra among each other, relative to coordinates.
const FLAT: f64 = 1e-12;
/// Accuracy with an ellipsoid, a cylinder or a cone, relative to coordinates.
const CURVED: f64 = 1e-9;
/// Excess of nearest points over their solids, relative to coordinates.
const MEMBER: f64 = 1e-14;

/// Two shapes with their poses.
struct Pose2 {
    shapes: [Shape; 2],
    poses: [Transform; 2],
}

impl Pose2 {
    fn distance(&self) -> Distance {
        let [a, b] = self.solids();
        a.to(&b)
    }

    fn solids(&self) -> [Solid<'_>; 2] {
        [0, 1].map(|side| self.shapes[side].solid(&self.poses[side]))
    }

    fn accuracy(&self) -> f64 {
        let is_flat = self.shapes.iter().all(Shape::is_flat);
        if is_flat { FLAT } else { CURVED }
    }

    /// Largest `direction · x` of one of the two, m.
    fn width(&self, side: usize, direction: &Vec3) -> f64 {
        let x = &self.poses[side];
        self.shapes[side].width(&x.rotation.tr_mul(direction)) + direction.dot(&x.translation)
    }

    /// Size of the coordinates, m.
    fn size(&self) -> f64 {
        3.0 + self.poses.iter().map(|x| x.translation.norm()).fold(0.0, f64::max)
    }

    fn describe(&self) -> String {
        format!("{:?} at {:?}", self.shapes, self.poses)
    }

    /// Checks that the nearest points prove the distance; returns the error of the distance relative to the size.
    fn certify(&self, found: &Distance) -> f64 {
        let (size, [p, q]) = (self.size(), found.points);
        for (side, point) in found.points.iter().enumerate() {
            let own = self.poses[side].inverse().point(point);
            let outside = self.shapes[side].outside(&own);
            assert!(outside <= MEMBER * size, "{outside:e} outside solid {side}: {}", self.describe());
        }
        let apart = (p - q).norm();
        assert!((apart - found.distance).abs() <= MEMBER * size, "{apart} is not {found:?}: {}", self.describe());
        // The slab between two planes across the shortest path: empty to the error of the distance.
        let direction = (p - q) / apart;
        let slab = -self.width(0, &-direction) - self.width(1, &direction);
        let error = (found.distance - slab) / size;
        // The direction of a short path is only as exact as its ends.
        let direction_error = 4.0 * f64::EPSILON * size / apart;
        assert!(error <= self.accuracy() + direction_error, "slab {slab:e}, {found:?}: {}", self.describe());
        error
    }
}

fn random_pair(random: &mut Random, kinds: [usize; 2], all: &[Polyhedron]) -> Pose2 {
    let shapes = kinds.map(|kind| Shape::random(kind, random, all));
    let poses = [0, 1].map(|_| Transform { rotation: random.rotation_matrix(), translation: random.vector(1.0) });
    Pose2 { shapes, poses }
}

/// Visits all pairs of kinds with many random poses each.
fn for_each_pair(seed: u64, poses: usize, mut visit: impl FnMut(&mut Random, [usize; 2], Pose2)) {
    let all = polyhedra(&mut Random::new(seed, 0, 0));
    let poses = samples(poses);
    for kinds in (0..KINDS * KINDS).map(|pair| [pair / KINDS, pair % KINDS]) {
        for index in 0..poses {
            let mut random = Random::new(seed, (kinds[0] * KINDS + kinds[1]) as u64 + 1, index as u64);
            let pair = random_pair(&mut random, kinds, &all);
            visit(&mut random, kinds, pair);
        }
    }
}

/// Moves the second solid so that its support plane is `gap` above that of the first, the support points face to face.
fn set_apart(pair: &mut Pose2, direction: &Vec3, gap: f64) {
    let [a, b] = pair.solids();
    let from = a.core_support(direction) + direction * a.margin();
    let to = b.core_support(&-direction) - direction * b.margin();
    pair.poses[1].translation += from + direction * gap - to;
}

#[test]
fn solids_set_apart_along_support_planes_have_that_distance() {
    for_each_pair(1, 300, |random, kinds, mut pair| {
        let direction = random.direction();
        let gap = random.log_between(1e-12, 30.0);
        set_apart(&mut pair, &direction, gap);
        let found = pair.distance();
        let off = (found.distance - gap).abs() / pair.size();
        assert!(off <= pair.accuracy(), "{kinds:?}: {found:?}, not {gap:e}, off {off:e}; {}", pair.describe());
    });
}

#[test]
fn nearest_points_are_members_and_the_slab_between_them_is_empty() {
    let mut worst = [[0.0_f64; KINDS]; KINDS];
    let mut apart = 0;
    for_each_pair(2, 300, |random, kinds, mut pair| {
        pair.poses[1].translation += random.direction() * random.log_between(1e-3, 10.0);
        let found = pair.distance();
        if found.distance > 0.0 {
            apart += 1;
            let worst = &mut worst[kinds[0]][kinds[1]];
            *worst = worst.max(pair.certify(&found));
        }
    });
    let rows: Vec<String> = worst.iter().map(|row| row.iter().map(|e| format!("{e:9.1e}")).collect()).collect();
    println!("{apart} poses apart; largest errors relative to coordinates:\n{}", rows.join("\n"));
}

#[test]
fn solids_with_a_common_point_have_no_distance() {
    for_each_pair(3, 300, |random, kinds, mut pair| {
        let members = [0, 1].map(|side| pair.poses[side].point(&pair.shapes[side].member(random)));
        pair.poses[1].translation += members[0] - members[1];
        let found = pair.distance();
        let distance = found.distance / pair.size();
        assert!(distance <= MEMBER, "{kinds:?}: {found:?}; {}", pair.describe());
    });
}
