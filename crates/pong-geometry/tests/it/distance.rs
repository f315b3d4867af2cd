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
const CURVED: f64 = 1e-10;
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
        let (size, [p, q]) = (self.size(), found.points_b);
        for (side, point) in found.points_b.iter().enumerate() {
            let own = self.poses[side].inverse().point(point);
            let outside = self.shapes[side].outside(&own);
            assert!(outside <= MEMBER * size, "{outside:e} outside solid {side}: {}", self.describe());
        }
        let apart = (p - q).norm();
        assert!(
            (apart - found.distance).abs() <= MEMBER * size,
            "{apart} is not {found:?}: {}",
            self.describe()
        );
        // The slab between two planes across the shortest path: empty to the error of the distance.
        let direction = (p - q) / apart;
        let slab = -self.width(0, &-direction) - self.width(1, &direction);
        let error = (found.distance - slab) / size;
        // The direction of a short path is only as exact as its ends.
        let direction_error = 4.0 * f64::EPSILON * size / apart;
        assert!(found.gap <= self.accuracy() * size, "{found:?}: {}", self.describe());
        assert!(error <= self.accuracy() + direction_error, "slab {slab:e}, {found:?}: {}", self.describe());
        error
    }
}

fn random_pair(random: &mut Random, kinds: [usize; 2], all: &[Polyhedron]) -> Pose2 {
    let shapes = kinds.map(|kind| Shape::random(kind, random, all));
    let poses =
        [0, 1].map(|_| Transform { rotation: random.rotation_matrix(), translation: random.vector(1.0) });
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
        assert!(
            off <= pair.accuracy(),
            "{kinds:?}: {found:?}, not {gap:e}, off {off:e}; {}",
            pair.describe()
        );
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
    let rows: Vec<String> =
        worst.iter().map(|row| row.iter().map(|e| format!("{e:9.1e}")).collect()).collect();
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

/// Axes of which one separates two polytopes in general position, if anything does.
fn axes(pair: &Pose2) -> Vec<Vec3> {
    let [(mut axes, edges), (others, other_edges)] = [0, 1].map(|side| {
        let (normals, edges) = match &pair.shapes[side] {
            Shape::Polyhedron(polyhedron) => {
                let normals = polyhedron.faces.iter().map(|face| face.normal).collect();
                (normals, polyhedron.edges.iter().map(|edge| edge.direction).collect())
            }
            Shape::Triangle([a, b, c]) => {
                (vec![(b - a).cross(&(c - a)).normalize()], vec![b - a, c - b, a - c])
            }
            Shape::Segment(segment) => (Vec::new(), vec![segment.ends[1] - segment.ends[0]]),
            other => panic!("{other:?} is no polytope of this test"),
        };
        let turned =
            |all: Vec<Vec3>| all.iter().map(|v| pair.poses[side].vector(v).normalize()).collect::<Vec<_>>();
        (turned(normals), turned(edges))
    });
    axes.extend(others);
    let crosses = edges.iter().flat_map(|a| other_edges.iter().map(|b| a.cross(b)));
    axes.extend(crosses.filter_map(|axis| axis.try_normalize(1e-9)));
    axes
}

#[test]
fn polytopes_overlap_where_no_axis_separates_them() {
    let all = polyhedra(&mut Random::new(4, 0, 0));
    let kinds = [1, 3, 9];
    let (mut apart, mut together) = (0, 0);
    let count = samples(20_000);
    for index in 0..count {
        let mut random = Random::new(4, 1, index as u64);
        let kinds = [random.pick(&kinds), random.pick(&kinds)];
        let mut pair = random_pair(&mut random, kinds, &all[..6]);
        pair.poses[1].translation = pair.poses[0].translation + random.vector(0.7);
        let slab = |axis: &Vec3| -pair.width(0, &-axis) - pair.width(1, axis);
        let widest =
            axes(&pair).iter().map(|axis| slab(axis).max(slab(&-axis))).fold(f64::NEG_INFINITY, f64::max);
        let found = pair.distance();
        assert!(widest <= found.distance + FLAT, "slab {widest:e}, {found:?}: {}", pair.describe());
        if widest > 1e-13 {
            apart += 1;
            assert!(found.distance > 0.0, "slab {widest:e}, {found:?}: {}", pair.describe());
        } else if widest < -1e-13 {
            together += 1;
            assert_eq!(found.distance, 0.0, "slab {widest:e}: {}", pair.describe());
        }
    }
    println!("{apart} apart, {together} overlap");
    assert!(apart > count / 5 && together > count / 20);
}

#[test]
fn exchanged_and_moved_solids_have_the_same_distance() {
    for_each_pair(5, 50, |random, kinds, mut pair| {
        pair.poses[1].translation += random.direction() * random.log_between(1e-3, 10.0);
        let found = pair.distance();
        let [a, b] = pair.solids();
        let mut accuracy = pair.accuracy() * pair.size();
        let exchanged = b.to(&a);
        assert!(
            (exchanged.distance - found.distance).abs() <= accuracy,
            "{kinds:?}: {exchanged:?}, {found:?}"
        );
        let motion = Transform { rotation: random.rotation_matrix(), translation: random.vector(10.0) };
        pair.poses = pair.poses.map(|x| motion.compose(&x));
        accuracy = pair.accuracy() * pair.size();
        let moved = pair.distance();
        assert!((moved.distance - found.distance).abs() <= accuracy, "{kinds:?}: {moved:?}, {found:?}");
    });
}

#[test]
fn a_search_with_a_limit_ends_where_the_distance_exceeds_it() {
    for_each_pair(6, 20, |random, kinds, mut pair| {
        let direction = random.direction();
        let gap = random.log_between(1e-3, 10.0);
        set_apart(&mut pair, &direction, gap);
        let [a, b] = pair.solids();
        assert!(a.to_within(&b, 0.99 * gap).is_none(), "{kinds:?}, gap {gap}: {}", pair.describe());
        assert!(a.to_within(&b, 1.01 * gap).is_some(), "{kinds:?}, gap {gap}: {}", pair.describe());
        let ((center_a, radius_a), (center_b, radius_b)) = (a.ball(), b.ball());
        let balls = (center_a - center_b).norm() - radius_a - radius_b;
        assert!(
            balls <= gap * (1.0 + 1e-9) + 1e-9,
            "{kinds:?}: balls {balls}, solids {gap}: {}",
            pair.describe()
        );
    });
}

#[test]
fn solids_over_a_plane_are_as_far_as_their_lowest_point() {
    for_each_pair(7, 20, |random, kinds, pair| {
        let normal = random.direction();
        let height = random.between(-0.5, 2.0);
        let plane = Plane { normal, offset: -pair.width(0, &-normal) - height };
        let [solid, _] = pair.solids();
        let found = solid.to_plane(&plane);
        assert!(
            (found.distance - height.max(0.0)).abs() <= 1e-14 * pair.size(),
            "{kinds:?}: {found:?}, {height}"
        );
        if height > 0.0 {
            let [p, q] = found.points_b;
            assert!(((p - q).norm() - height).abs() <= 1e-14 * pair.size(), "{kinds:?}: {found:?}, {height}");
            assert!(plane.height(&q).abs() <= 1e-14 * pair.size(), "{kinds:?}: {found:?}");
            let own = pair.poses[0].inverse().point(&p);
            assert!(pair.shapes[0].outside(&own) <= MEMBER * pair.size(), "{kinds:?}: {found:?}");
        }
    });
}

#[test]
fn closed_forms() {
    let ball = |x: f64, radius: f64| Sphere { center: Vec3::new(x, 0.0, 0.0), radius };
    let two = Solid::sphere(&ball(0.0, 0.5)).to(&Solid::sphere(&ball(2.0, 0.25)));
    assert_eq!((two.distance, two.points_b), (1.25, [Vec3::x() * 0.5, Vec3::x() * 1.75]));
    // Concentric, touching and overlapping balls.
    for (x, radius) in [(0.0, 0.5), (0.75, 0.25), (0.6, 0.25)] {
        assert_eq!(Solid::sphere(&ball(0.0, 0.5)).to(&Solid::sphere(&ball(x, radius))).distance, 0.0);
    }
    let cube = crate::common::cuboid(Vec3::new(-1.0, -1.0, -1.0), Vec3::new(1.0, 1.0, 1.0));
    let cube = Solid::polyhedron(&cube, &Transform::identity());
    // Over a face, over an edge, over a corner: 1, √2, √3 from it.
    for (place, distance) in
        [([2.0, 0.3, 0.2], 1.0), ([2.0, 2.0, 0.1], 2_f64.sqrt()), ([2.0, 2.0, 2.0], 3_f64.sqrt())]
    {
        let ball = Sphere { center: Vec3::from(place), radius: 0.25 };
        let found = Solid::sphere(&ball).to(&cube);
        assert!((found.distance - (distance - 0.25)).abs() <= 1e-15, "{place:?}: {found:?}");
        assert!(
            (found.points_b[1] - Vec3::from(place).map(|x| x.min(1.0))).norm() <= 1e-15,
            "{place:?}: {found:?}"
        );
    }
    let segment = |from: [f64; 3], to: [f64; 3]| LineSegment { ends: [Vec3::from(from), Vec3::from(to)] };
    let along_x = segment([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
    for (other, distance) in [
        // Crossing at a height, parallel, in line, end to inside.
        (segment([0.3, -1.0, 0.5], [0.3, 1.0, 0.5]), 0.5),
        (segment([-1.0, 0.7, 0.0], [1.0, 0.7, 0.0]), 0.7),
        (segment([1.5, 0.0, 0.0], [2.0, 0.0, 0.0]), 0.5),
        (segment([0.25, 0.125, 0.0], [0.25, 3.0, 0.0]), 0.125),
        (segment([0.0, -1.0, 0.0], [0.0, 1.0, 0.0]), 0.0),
    ] {
        let found = Solid::segment(&along_x).to(&Solid::segment(&other));
        assert!((found.distance - distance).abs() <= 1e-15, "{other:?}: {found:?}");
        let rods = [along_x, other].map(|segment| Capsule { ends: segment.ends, radius: 0.0625 });
        let rods = rods.map(|rod| Solid::capsule(&rod));
        let found = rods[0].to(&rods[1]);
        assert!((found.distance - (distance - 0.125).max(0.0)).abs() <= 1e-15, "{other:?}: {found:?}");
    }
}
