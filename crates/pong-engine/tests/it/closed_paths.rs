//! Without friction and damping a closed path does no net work (docs/theory.md, 6), because the force is the
//! gradient of a stored energy. With memory, free edges or segment ends it may lose energy, never gain.

use crate::common::*;
use crate::drums_on_triangles::{block, block_of};
use pong_geometry::{Quat, Vec3};
use pong_testkit::{Random, long_samples};

const K: f64 = 1e4;
/// Loops of one pair of parts.
const LOOPS: usize = 10;

/// A closed path of the mover around and into the other body.
struct Loop {
    center: Vec3,
    /// Complex amplitudes of the position and of the rotation vector.
    swing: [Vec3; 4],
}

impl Loop {
    fn random(random: &mut Random, center: Vec3, size: f64, turn: f64) -> Self {
        let swing = [random.vector(size), random.vector(size), random.vector(turn), random.vector(turn)];
        Self { center, swing }
    }

    fn pose(&self, s: f64) -> (Vec3, Quat) {
        let (sin, cos) = (s * std::f64::consts::TAU).sin_cos();
        let position = self.center + self.swing[0] * cos + self.swing[1] * sin;
        (position, Quat::from_scaled_axis(self.swing[2] * cos + self.swing[3] * sin))
    }
}

/// Energies of one lap.
#[derive(Default)]
struct Lap {
    /// Work of the contact wrench on the mover plus the change of stored energy, over smooth stretches: the
    /// error of the quadrature.
    smooth: f64,
    /// Energy that appears (positive) or vanishes (negative) at discontinuities.
    gained: f64,
    lost: f64,
    /// Largest stored energy on the path.
    largest: f64,
}

/// Follows the loop, halving each interval until work and stored energy agree. If very short intervals still
/// disagree, there is a discontinuity.
struct Follower<'a> {
    rig: &'a mut Rig,
    path: &'a Loop,
    tolerance: f64,
    lap: Lap,
}

/// A point of the loop with the engine's results there.
#[derive(Clone, Copy)]
struct Sample {
    s: f64,
    wrench: pong_geometry::Wrench,
    stored: f64,
}

impl Follower<'_> {
    fn sample(&mut self, s: f64) -> Sample {
        let (position, orientation) = self.path.pose(s);
        self.rig.place_a(position, orientation);
        self.rig.world.evaluate().unwrap();
        let stored = self.rig.world.contacts().iter().map(|c| c.stored).sum();
        Sample { s, wrench: self.rig.wrench(0), stored }
    }

    fn commit_at(&mut self, s: f64) -> Sample {
        let sample = self.sample(s);
        self.rig.world.commit().unwrap();
        self.lap.largest = self.lap.largest.max(sample.stored);
        sample
    }

    /// Advances from a committed sample to the point `to`, which is then committed.
    fn advance(&mut self, from: Sample, to: f64, halvings: u32) -> Sample {
        let middle = self.sample(0.5 * (from.s + to));
        let end = self.sample(to);
        let (p0, q0) = self.path.pose(from.s);
        let (p1, q1) = self.path.pose(to);
        let (shift, turn) = (p1 - p0, (q1 * q0.inverse()).scaled_axis());
        let power = |w: &pong_geometry::Wrench| w.force.dot(&shift) + w.moment.dot(&turn);
        let work = (power(&from.wrench) + 4.0 * power(&middle.wrench) + power(&end.wrench)) / 6.0;
        let gain = work + end.stored - from.stored;
        if gain.abs() <= self.tolerance * (to - from.s) {
            self.lap.smooth += gain;
        } else if halvings > 0 {
            let half = self.advance(from, middle.s, halvings - 1);
            return self.advance(half, to, halvings - 1);
        } else if gain > 0.0 {
            self.lap.gained += gain;
        } else {
            self.lap.lost -= gain;
        }
        self.commit_at(to)
    }

    fn lap(mut self) -> Lap {
        const INTERVALS: usize = 200;
        const HALVINGS: u32 = 22;
        let mut at = self.commit_at(0.0);
        for i in 1..=INTERVALS {
            at = self.advance(at, i as f64 / INTERVALS as f64, HALVINGS);
        }
        self.lap
    }
}

/// Permitted energy balance of a path.
#[derive(Clone, Copy, PartialEq)]
enum Allowed {
    Nothing,
    Loss,
}

fn check_closed_paths(
    name: &str,
    a: &str,
    b: &str,
    (center, size, turn): (Vec3, f64, f64),
    allowed: Allowed,
) {
    let mut random = Random(31);
    let mut rig = Rig::new(a, b);
    let (mut touched, mut worst_gain, mut worst_loss) = (0, 0.0_f64, 0.0_f64);
    let (loops, touching) = (long_samples(LOOPS / 6, LOOPS), long_samples(2, 6));
    for number in 0..LOOPS {
        // A short run ends when enough have touched.
        if number >= loops && touched >= touching {
            break;
        }
        let path = Loop::random(&mut random, center, size, turn);
        let object = rig.objects[0];
        rig.world.clear_contact_history(object).unwrap();
        // The first lap sets up the history; the second starts and ends with the same history.
        Follower { rig: &mut rig, path: &path, tolerance: 1e-3, lap: Lap::default() }.lap();
        let tolerance = 1e-6;
        let lap = Follower { rig: &mut rig, path: &path, tolerance, lap: Lap::default() }.lap();
        if lap.largest > 0.0 {
            touched += 1;
            worst_gain = worst_gain.max(lap.gained / lap.largest);
            worst_loss = worst_loss.max(lap.lost / lap.largest);
        }
    }
    println!(
        "{name}: {touched} loops, largest gain {worst_gain:.1e}, loss {worst_loss:.1e} of the stored energy"
    );
    assert!(touched >= touching, "{name}: the loops must touch");
    // Remainder of a mere discontinuity of the force over the shortest intervals.
    const FORCE_JUMP_REST: f64 = 1e-6;
    assert!(worst_gain <= FORCE_JUMP_REST, "{name}: gained {worst_gain:e}");
    assert!(allowed == Allowed::Loss || worst_loss <= FORCE_JUMP_REST, "{name}: lost {worst_loss:e}");
}

fn elastic() -> String {
    surface(K, "friction: None")
}

fn solid() -> String {
    model("box", &elastic(), &box_polyhedron("b", [0.0, 0.0, 0.0], [0.5, 0.4, 0.3], ""))
}

#[test]
fn sphere_around_a_box() {
    let ball = model("ball", &elastic(), "Sphere(name: \"s\", center: (0,0,0), radius: 0.2)");
    check_closed_paths(
        "sphere–box",
        &ball,
        &solid(),
        (Vec3::new(0.55, 0.45, 0.36), 0.15, 0.5),
        Allowed::Nothing,
    );
}

#[test]
fn ellipsoid_around_a_box() {
    let egg = model("egg", &elastic(), "Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: (0.25,0.15,0.1))");
    check_closed_paths(
        "ellipsoid–box",
        &egg,
        &solid(),
        (Vec3::new(0.55, 0.45, 0.36), 0.15, 0.8),
        Allowed::Nothing,
    );
}

/// The path leads the ellipsoid over the end, the rim and the side of the body.
fn ellipsoid_around(name: &str, part: &str) {
    let egg = model("egg", &elastic(), "Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: (0.25,0.15,0.1))");
    let body = model("body", &elastic(), part);
    let path = (Vec3::new(0.5, 0.05, 0.33), 0.12, 0.8);
    check_closed_paths(name, &egg, &body, path, Allowed::Nothing);
}

#[test]
fn ellipsoid_around_an_ellipsoid() {
    ellipsoid_around(
        "ellipsoid–ellipsoid",
        "Ellipsoid(name: \"b\", center: (0,0,0), semi_axes: (0.6,0.3,0.4))",
    );
}

#[test]
fn ellipsoid_around_a_capsule() {
    ellipsoid_around("ellipsoid–capsule", "Capsule(name: \"b\", ends: ((-0.5,0,0),(0.4,0,0)), radius: 0.3)");
}

#[test]
fn ellipsoid_around_a_cylinder() {
    ellipsoid_around(
        "ellipsoid–cylinder",
        "Cylinder(name: \"b\", ends: ((-0.5,0,0),(0.5,0,0)), radius: 0.3)",
    );
}

#[test]
fn ellipsoid_around_a_cone() {
    ellipsoid_around("ellipsoid–cone", "Cone(name: \"b\", ends: ((-0.5,0,0),(0.5,0,0)), radii: (0.5,0.25))");
}

const WHEEL: &str = "Cylinder(name: \"c\", ends: ((0,-0.15,0),(0,0.15,0)), radius: 0.25)";

#[test]
fn wheel_around_a_box() {
    let wheel = model("wheel", &elastic(), WHEEL);
    let path = (Vec3::new(0.5, 0.1, 0.53), 0.04, 0.05);
    check_closed_paths("wheel–box", &wheel, &solid(), path, Allowed::Nothing);
}

#[test]
fn drum_around_a_roller() {
    let wheel = model("wheel", &elastic(), WHEEL);
    let roller =
        model("roller", &elastic(), "Cylinder(name: \"b\", ends: ((0,-0.4,0),(0,0.1,0)), radius: 0.3)");
    let path = (Vec3::new(0.0, 0.05, 0.53), 0.04, 0.3);
    check_closed_paths("cylinder–cylinder", &wheel, &roller, path, Allowed::Nothing);
}

#[test]
fn drum_around_a_cone() {
    let wheel = model("wheel", &elastic(), WHEEL);
    let cone =
        model("cone", &elastic(), "Cone(name: \"b\", ends: ((-0.3,0,0),(0.4,0,0)), radii: (0.35,0.25))");
    let path = (Vec3::new(0.0, 0.05, 0.54), 0.04, 0.3);
    check_closed_paths("cylinder–cone", &wheel, &cone, path, Allowed::Nothing);
}

#[test]
fn wheel_over_a_ridge_of_triangles() {
    let ridge = "TriangleMesh(name: \"m\", vertices: [(0,-1,0.2),(0,1,0.2),(-1,-1,0),(-1,1,0),(1,-1,-0.1),(1,1,0)], \
                 triangles: [(2,0,1),(2,1,3),(0,4,5),(0,5,1)])";
    let ridge = model("ridge", &elastic(), ridge);
    let wheel = model("wheel", &elastic(), WHEEL);
    let path = (Vec3::new(0.0, 0.0, 0.44), 0.04, 0.1);
    check_closed_paths("wheel–ridge", &wheel, &ridge, path, Allowed::Nothing);
}

#[test]
fn sphere_in_a_corner_of_triangles() {
    let valley = "TriangleMesh(name: \"m\", vertices: [(0,0,0),(1,0,0.5),(0.8,0.9,0.4),(-0.9,0.6,0.6),(-0.5,-0.9,0.5),(0.7,-0.8,0.7)], \
                  triangles: [(0,1,2),(0,2,3),(0,3,4),(0,4,5),(0,5,1)])";
    let valley = model("valley", &elastic(), valley);
    let ball = model("ball", &elastic(), "Sphere(name: \"s\", center: (0,0,0), radius: 0.2)");
    check_closed_paths(
        "sphere–valley",
        &ball,
        &valley,
        (Vec3::new(0.0, 0.0, 0.3), 0.1, 0.3),
        Allowed::Nothing,
    );
}

#[test]
fn ellipsoid_over_a_ridge_of_triangles() {
    let ridge = "TriangleMesh(name: \"m\", vertices: [(0,0,0.4),(1,0,0),(0.8,0.9,0),(-0.9,0.6,0),(-0.5,-0.9,0),(0.7,-0.8,0)], \
                 triangles: [(0,1,2),(0,2,3),(0,3,4),(0,4,5),(0,5,1)])";
    let ridge = model("ridge", &elastic(), ridge);
    let egg = model("egg", &elastic(), "Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: (0.25,0.15,0.1))");
    check_closed_paths(
        "ellipsoid–ridge",
        &egg,
        &ridge,
        (Vec3::new(0.0, 0.0, 0.48), 0.08, 0.5),
        Allowed::Nothing,
    );
}

#[test]
fn sphere_over_abutting_pieces() {
    let roof = "Polyhedron(name: \"l\", vertices: [(-1,-1,0),(0,-1,0),(0,1,0),(-1,1,0),(0,-1,0.5),(0,1,0.5)], \
                faces: [[0,3,2,1],[0,4,5,3],[1,2,5,4],[0,1,4],[2,3,5]], inactive_faces: [2]), \
                Polyhedron(name: \"r\", vertices: [(1,-1,0),(0,-1,0),(0,1,0),(1,1,0),(0,-1,0.5),(0,1,0.5)], \
                faces: [[0,1,2,3],[0,3,5,4],[1,4,5,2],[0,4,1],[3,2,5]], inactive_faces: [2])";
    let roof = model("roof", &elastic(), roof);
    let ball = model("ball", &elastic(), "Sphere(name: \"s\", center: (0,0,0), radius: 0.3)");
    check_closed_paths(
        "sphere–roof of two",
        &ball,
        &roof,
        (Vec3::new(0.0, 0.0, 0.7), 0.12, 0.3),
        Allowed::Nothing,
    );
}

#[test]
fn bar_over_a_box() {
    let bar = model("bar", &elastic(), "LineSegment(name: \"l\", ends: ((-0.9,0,0),(0.9,0.1,0)))");
    check_closed_paths("bar–box", &bar, &solid(), (Vec3::new(0.0, 0.0, 0.33), 0.06, 0.1), Allowed::Loss);
}

#[test]
fn bar_over_an_undercut_prism() {
    let prism = "Polyhedron(name: \"b\", vertices: [(-0.3,-0.2,-0.3),(0.35,-0.25,-0.3),(0.0,0.3,-0.3),(-0.5,-0.4,0.3),(0.6,-0.45,0.3),(0.05,0.6,0.3)], \
                 faces: [[0,2,1],[3,4,5],[0,1,4,3],[1,2,5,4],[2,0,3,5]])";
    // The side faces of this frustum must be planar: all edges meet in one point.
    let prism = prism
        .replace("(-0.5,-0.4,0.3)", "(-0.6,-0.4,0.3)")
        .replace("(0.6,-0.45,0.3)", "(0.7,-0.5,0.3)")
        .replace("(0.05,0.6,0.3)", "(0.0,0.6,0.3)");
    let prism = model("prism", &elastic(), &prism);
    let bar = model("bar", &elastic(), "LineSegment(name: \"l\", ends: ((-1.4,0.05,0),(1.5,0.1,0)))");
    check_closed_paths("bar–prism", &bar, &prism, (Vec3::new(0.0, -0.1, 0.33), 0.06, 0.1), Allowed::Loss);
}

#[test]
fn point_in_a_box() {
    let tip = model("tip", &elastic(), "Point(name: \"p\", position: (0.05,0,0))");
    check_closed_paths("point–box", &tip, &solid(), (Vec3::new(0.5, 0.4, 0.3), 0.08, 0.4), Allowed::Loss);
}

const PIN: &str = "Cylinder(name: \"c\", ends: ((-0.5,0.05,0),(0.5,0,0.1)), radius: 0.3)";
const PLUG: &str = "Cone(name: \"c\", ends: ((-0.5,0,0),(0.5,0.05,0)), radii: (0.4,0.15))";
const LOG: &str = "Capsule(name: \"c\", ends: ((-0.5,0,0.02),(0.5,0,0)), radius: 0.3)";

#[test]
fn balls_around_round_parts() {
    let ball = model("ball", &elastic(), "Sphere(name: \"s\", center: (0,0,0), radius: 0.2)");
    for (name, part) in [("pin", PIN), ("plug", PLUG), ("log", LOG)] {
        for center in [Vec3::new(0.5, 0.1, 0.4), Vec3::new(0.1, 0.3, 0.3), Vec3::new(-0.6, 0.0, 0.2)] {
            let part = model(name, &elastic(), part);
            check_closed_paths(name, &ball, &part, (center, 0.15, 0.5), Allowed::Nothing);
        }
    }
}

/// Lying, over an end, on a rim, a tip on a side; as long as the rod is never perpendicular to the part with
/// one of its ends beside an end of the other (docs/theory.md, 2.8).
#[test]
fn rods_around_round_parts() {
    let long = "Capsule(name: \"l\", ends: ((-0.9,0,0),(0.9,0.1,0)), radius: 0.1)";
    let short = "Capsule(name: \"l\", ends: ((-0.3,0,0),(0.3,0.1,0)), radius: 0.1)";
    let line = "LineSegment(name: \"l\", ends: ((-0.9,0,0),(0.9,0.1,0)))";
    let (lying, over_an_end) = (Vec3::new(0.1, 0.0, 0.35), Vec3::new(0.4, 0.2, 0.3));
    for (part, rod, center, size, turn) in [
        (PIN, line, lying, 0.08, 0.1),
        (PIN, short, over_an_end, 0.2, 0.3),
        (PLUG, long, over_an_end, 0.2, 0.3),
    ] {
        let (rod, of) = (model("rod", &elastic(), rod), model("part", &elastic(), part));
        check_closed_paths(part, &rod, &of, (center, size, turn), Allowed::Nothing);
    }
}

/// Lying, over an end, on a tip, deep, and with turns through square axes beside the ends.
#[test]
fn rods_around_capsules() {
    let rod = |half: f64| format!("Capsule(name: \"l\", ends: ((-{half},0,0),({half},0.1,0)), radius: 0.1)");
    let line = "LineSegment(name: \"l\", ends: ((-0.9,0,0),(0.9,0.1,0)))".to_owned();
    let log = model("log", &elastic(), LOG);
    let (lying, over_an_end) = (Vec3::new(0.1, 0.0, 0.35), Vec3::new(0.45, 0.1, 0.3));
    for (name, rod, center, size, turn) in [
        ("a segment on a log", line, lying, 0.08, 2.0),
        ("a long rod on a log", rod(0.9), lying, 0.1, 2.0),
        ("a rod over an end", rod(0.3), over_an_end, 0.2, 2.0),
        ("a rod deep in a log", rod(0.5), Vec3::zeros(), 0.3, 1.0),
    ] {
        let rod = model("rod", &elastic(), &rod);
        check_closed_paths(name, &rod, &log, (center, size, turn), Allowed::Nothing);
    }
}

/// Over a face with one or both ends past its edges, over an edge, past a corner; over seams, in a valley and
/// over a ridge of triangles.
#[test]
fn capsules_on_boxes_and_triangles() {
    let capsule = |half: f64| {
        let ends = format!("ends: ((-{half},0,0),({half},0.1,0))");
        model("rod", &elastic(), &format!("Capsule(name: \"l\", {ends}, radius: 0.1)"))
    };
    let mesh = |height: f64, slope: f64| {
        let rim = [(1.0, 0.0), (0.8, 0.9), (-0.9, 0.6), (-0.5, -0.9), (0.7, -0.8)];
        let rim: String = rim.iter().map(|(x, y)| format!("({x},{y},{}),", height - slope)).collect();
        let triangles = "triangles: [(0,1,2),(0,2,3),(0,3,4),(0,4,5),(0,5,1)]";
        let text = format!("TriangleMesh(name: \"m\", vertices: [(0,0,{height}),{rim}], {triangles})");
        model("mesh", &elastic(), &text)
    };
    for (name, rod, of, center, size, turn) in [
        ("across a box", capsule(0.9), solid(), Vec3::new(0.0, 0.0, 0.38), 0.06, 0.1),
        ("over an edge", capsule(0.3), solid(), Vec3::new(0.45, 0.0, 0.38), 0.08, 0.2),
        ("over a corner", capsule(0.3), solid(), Vec3::new(0.55, 0.45, 0.37), 0.07, 0.2),
        ("on a plate", capsule(0.3), mesh(0.0, 0.0), Vec3::new(0.1, 0.0, 0.08), 0.05, 0.1),
        ("past the rim of a plate", capsule(0.3), mesh(0.0, 0.0), Vec3::new(0.8, 0.0, 0.07), 0.05, 0.1),
        ("in a valley", capsule(0.2), mesh(0.0, -0.5), Vec3::new(0.0, 0.0, 0.2), 0.03, 0.1),
        ("over a ridge", capsule(0.5), mesh(0.0, 0.4), Vec3::new(0.0, 0.0, 0.06), 0.05, 0.2),
    ] {
        check_closed_paths(name, &rod, &of, (center, size, turn), Allowed::Nothing);
    }
}

/// A cylinder or a cone around an axis, from −half to half.
fn drum(axis: &str, half: f64, [first, last]: [f64; 2]) -> String {
    let end = |at: f64| if axis == "x" { format!("({at:?},0,0)") } else { format!("(0,0,{at:?})") };
    let (ends, radii) = (format!("({},{})", end(-half), end(half)), format!("({first:?},{last:?})"));
    model("drum", &elastic(), &format!("Cone(name: \"l\", ends: {ends}, radii: {radii})"))
}

/// On and past the rim of a plate, lying and tipping, over a ridge along and across it, over an edge and a corner of a block.
#[test]
fn drums_on_triangles() {
    let drum = |half: f64, radii| drum("x", half, radii);
    let plate = plate_mesh("m", 3, 2.0, |x, y| Vec3::new(x, y, 0.0));
    let ridge = plate_mesh("m", 2, 2.0, |x, y| Vec3::new(x, y, -0.4 * x.abs()));
    let block = block(1.0, 1.0);
    let (rod, wheel, plug) = (drum(0.5, [0.1, 0.1]), drum(0.1, [0.25, 0.25]), drum(0.4, [0.15, 0.1]));
    for (name, drum, ground, center, size, turn) in [
        ("on a plate", &rod, &plate, Vec3::new(0.1, 0.0, 0.08), 0.04, 0.1),
        ("over both rims", &drum(1.2, [0.1, 0.1]), &plate, Vec3::new(0.1, 0.0, 0.08), 0.04, 0.03),
        ("past a rim", &rod, &plate, Vec3::new(1.02, 0.0, 0.09), 0.03, 0.05),
        ("past a corner", &plug, &plate, Vec3::new(0.95, 0.97, 0.09), 0.04, 0.1),
        ("wheel past a rim", &wheel, &plate, Vec3::new(0.8, 1.0, 0.22), 0.04, 0.1),
        ("across a ridge", &rod, &ridge, Vec3::new(0.05, 0.0, 0.08), 0.04, 0.1),
        ("plug across a ridge", &plug, &ridge, Vec3::new(0.05, 0.0, 0.11), 0.04, 0.1),
        ("wheel over a ridge", &wheel, &ridge, Vec3::new(0.0, 0.0, 0.23), 0.04, 0.3),
        ("over an edge of a block", &rod, &block, Vec3::new(0.9, 0.0, 0.09), 0.03, 0.05),
        ("over a corner of a block", &plug, &block, Vec3::new(0.9, 0.95, 0.13), 0.03, 0.05),
    ] {
        check_closed_paths(
            name,
            drum,
            &model("ground", &elastic(), ground),
            (center, size, turn),
            Allowed::Nothing,
        );
    }
}

/// Standing on a plate, past its rim and a corner, on a ridge, over an edge and a corner of a block, leaning there, and
/// across a valley.
#[test]
fn drums_that_stand_on_triangles() {
    let drum = |half: f64, radii| drum("z", half, radii);
    let plate = plate_mesh("m", 3, 2.0, |x, y| Vec3::new(x, y, 0.0));
    let ridge = plate_mesh("m", 2, 2.0, |x, y| Vec3::new(x, y, -0.4 * x.abs()));
    let block = block_of(1.0, 1.0, 1.0);
    let valley = plate_mesh("m", 2, 2.0, |x, y| Vec3::new(x, y, 0.2 * x.abs()));
    let (drum, plug) = (drum(0.15, [0.25, 0.25]), drum(0.2, [0.15, 0.2]));
    for (name, drum, ground, center, size, turn) in [
        ("on a plate", &drum, &plate, Vec3::new(0.9, 0.0, 0.15), 0.02, 0.05),
        ("past a rim", &drum, &plate, Vec3::new(1.03, 0.0, 0.15), 0.02, 0.05),
        ("past a corner", &plug, &plate, Vec3::new(0.98, 1.01, 0.2), 0.03, 0.05),
        ("on a ridge", &drum, &ridge, Vec3::new(0.02, 0.0, 0.14), 0.02, 0.05),
        ("over an edge of a block", &plug, &block, Vec3::new(1.0, 0.0, 0.19), 0.02, 0.1),
        ("over a corner of a block", &drum, &block, Vec3::new(1.0, 0.97, 0.14), 0.02, 0.05),
        ("leaning over an edge", &drum, &block, Vec3::new(1.1, 0.0, 0.14), 0.03, 0.4),
        ("across a valley", &drum, &valley, Vec3::new(0.02, 0.0, 0.19), 0.005, 0.02),
    ] {
        let ground = model("ground", &elastic(), ground);
        check_closed_paths(name, drum, &ground, (center, size, turn), Allowed::Nothing);
    }
}

const STRAIGHT: &str = "Bore(name: \"b\", ends: ((-0.5,0.05,0),(0.5,0,0.1)), radii: (0.3,0.3))";
const TAPERED: &str = "Bore(name: \"b\", ends: ((-0.5,0,0),(0.5,0.05,0)), radii: (0.4,0.25))";
const SEAT: &str = "Bore(name: \"b\", ends: ((0,0,0),(0.2,0,0)), radii: (0.05,0.5), mouths: (false,true))";

/// On the wall, over a mouth, and in a wide cone, where the two sides share the spring.
#[test]
fn balls_in_bores() {
    let ball = model("ball", &elastic(), "Sphere(name: \"s\", center: (0,0,0), radius: 0.2)");
    let point = model("point", &elastic(), "Point(name: \"p\", position: (0,0,0))");
    for (name, bore, of, center, size) in [
        ("straight", STRAIGHT, &ball, Vec3::new(0.1, 0.1, 0.1), 0.1),
        ("over a mouth", STRAIGHT, &ball, Vec3::new(-0.5, 0.15, 0.05), 0.1),
        ("tapered", TAPERED, &ball, Vec3::new(0.3, 0.1, 0.1), 0.12),
        ("a point", TAPERED, &point, Vec3::new(0.1, 0.2, 0.25), 0.05),
        ("seat", SEAT, &ball, Vec3::new(0.21, 0.0, 0.0), 0.03),
    ] {
        let hole = model(name, &elastic(), bore);
        check_closed_paths(name, of, &hole, (center, size, 0.3), Allowed::Nothing);
    }
}

/// Lying, standing on a disc, on a rim and on a ball, and tilting from one to the other.
#[test]
fn round_parts_on_a_plane() {
    let plane = model("floor", &elastic(), "Plane(name: \"p\", normal: (0,0,1), offset: 0)");
    let standing = "Cylinder(name: \"c\", ends: ((0,0,-0.5),(0,0,0.5)), radius: 0.3)";
    for (part, height, turn) in [(PIN, 0.3, 2.0), (PLUG, 0.3, 2.0), (LOG, 0.3, 0.2), (standing, 0.5, 0.2)] {
        let of = model("part", &elastic(), part);
        check_closed_paths(part, &of, &plane, (Vec3::z() * height, 0.1, turn), Allowed::Nothing);
    }
}

/// In the hole, through one mouth and through both; a segment with its axis behind the wall, and a pin too
/// large for its hole.
#[test]
fn rods_in_bores() {
    let long = "ends: ((-0.8,0,0),(0.8,0,0))";
    let half = "ends: ((-0.9,0,0),(0.2,0,0))";
    let short = "ends: ((-0.25,0,0),(0.25,0,0))";
    let disc = "ends: ((-0.02,0,0),(0.02,0,0))";
    let capsule = |ends: &str| format!("Capsule(name: \"l\", {ends}, radius: 0.2)");
    let segment = |ends: &str| format!("LineSegment(name: \"l\", {ends})");
    let pin = |ends: &str, radius: f64| format!("Cylinder(name: \"l\", {ends}, radius: {radius})");
    let straight = "Bore(name: \"b\", ends: ((-0.5,0,0),(0.5,0,0)), radii: (0.3,0.3))";
    let tapered = "Bore(name: \"b\", ends: ((-0.5,0,0),(0.5,0,0)), radii: (0.33,0.3))";
    let plate = "Bore(name: \"b\", ends: ((-0.02,0,0),(0.02,0,0)), radii: (0.3,0.3), thickness: 0.1)";
    for (name, bore, rod, size, turn) in [
        ("capsule in", straight, capsule(short), 0.12, 0.2),
        ("capsule half in", tapered, capsule(half), 0.1, 0.15),
        ("capsule through", straight, capsule(long), 0.1, 0.15),
        ("segment in", tapered, segment(short), 0.3, 0.3),
        ("segment through", straight, segment(long), 0.3, 0.2),
        ("pin in", straight, pin(short, 0.29), 0.02, 0.04),
        ("pin half in", tapered, pin(half, 0.29), 0.02, 0.04),
        ("pin through", tapered, pin(long, 0.29), 0.02, 0.03),
        ("pin too large", straight, pin(short, 0.302), 0.01, 0.02),
        ("short pin", straight, pin(disc, 0.298), 0.02, 0.15),
        ("short pin too large", tapered, pin(disc, 0.317), 0.02, 0.15),
        ("rod through a plate", plate, pin(long, 0.298), 0.02, 0.15),
    ] {
        let (rod, hole) = (model("rod", &elastic(), &rod), model("hole", &elastic(), bore));
        check_closed_paths(name, &rod, &hole, (Vec3::zeros(), size, turn), Allowed::Nothing);
    }
}
