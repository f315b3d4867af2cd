//! Solids that touch by overlapped volume: the wrench is the derivative of the stored energy in every pose, continuous,
//! opposite on both bodies, the same for cut bodies, and that of a punch where a flat face presses.

use super::common::Rig;
use pong_engine::{Config, Contact, State, World};
use pong_geometry::{Pose, Quat, Twist, Vec3, Wrench};
use pong_testkit::Random;
use pong_testkit::ron::{box_polyhedron, carried_box};
use pong_testkit::{long_samples, samples};

pub const SOFT: &str = "stiffness: 1e5, foundation: 2e7, friction: None";
pub const STIFF: &str = "stiffness: 1e5, foundation: 5e7, friction: None";
const RIGID: &str = "stiffness: inf, friction: None";

pub fn solid(surface: &str, primitives: &str) -> String {
    format!(
        r#"(format: "pong-model", version: 1, name: "solid", entry_memory: false, surfaces: {{ "s": ({surface}) }},
            root: (name: "solid", surface: "s", contact: Solid, primitives: [{primitives}]))"#
    )
}

fn remembering(text: &str) -> String {
    text.replace("entry_memory: false, ", "")
}

pub fn block(surface: &str, half: [f64; 3]) -> String {
    solid(surface, &box_polyhedron("box", [0.0; 3], half, ""))
}

fn floor(surface: &str) -> String {
    format!(
        r#"(format: "pong-model", version: 1, name: "floor", surfaces: {{ "s": ({surface}) }},
            root: (name: "floor", surface: "s", primitives: [
                Plane(name: "plane", normal: (0.0, 0.0, 1.0), offset: 0.0)]))"#
    )
}

/// Two Objects, of which the second is at the origin.
pub struct Pair {
    pub world: World,
    pub roots: [pong_engine::InterfaceId; 2],
}

impl Pair {
    pub fn new(a: &str, b: &str) -> Self {
        let Rig { world, interfaces: roots, .. } = Rig::with_config(Config::default(), a, b);
        Self { world, roots }
    }

    /// Evaluates with A at a pose, moving with a twist. Returns A's wrench about its origin and the stored energy.
    pub fn evaluate(&mut self, pose: &Pose, twist: &Twist) -> (Wrench, f64) {
        let state = |pose: &Pose, twist: &Twist| State {
            position: pose.position.into(),
            orientation: [pose.orientation.w, pose.orientation.i, pose.orientation.j, pose.orientation.k],
            linear_velocity: twist.linear.into(),
            angular_velocity: twist.angular.into(),
        };
        let still = state(&Pose::identity(), &Twist::zero());
        self.world.set_state(self.roots[0], &state(pose, twist)).unwrap();
        self.world.set_state(self.roots[1], &still).unwrap();
        self.world.evaluate().unwrap();
        let wrench = self.world.wrench_common(self.roots[0]).unwrap();
        (wrench, self.contacts().iter().map(|contact| contact.stored).sum())
    }

    pub fn at(&mut self, pose: &Pose) -> (Wrench, f64) {
        self.evaluate(pose, &Twist::zero())
    }

    pub fn contacts(&self) -> Vec<Contact> {
        self.world.contacts()
    }
}

pub fn pose(position: [f64; 3], turn: [f64; 3]) -> Pose {
    Pose { position: position.into(), orientation: Quat::from_scaled_axis(Vec3::from(turn)) }
}

/// Pose moved by a small twist about its own origin.
pub fn moved(from: &Pose, by: &Twist) -> Pose {
    Pose {
        position: from.position + by.linear,
        orientation: Quat::from_scaled_axis(by.angular) * from.orientation,
    }
}

pub fn random_vector(random: &mut Random, size: f64) -> Vec3 {
    Vec3::from_fn(|_, _| random.between(-size, size))
}

/// Six unit twists.
pub fn directions() -> Vec<Twist> {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let zero = Vec3::zeros();
    let linear = axes.iter().map(|axis| Twist { linear: *axis, angular: zero });
    linear.chain(axes.iter().map(|axis| Twist { linear: zero, angular: *axis })).collect()
}

pub fn power(wrench: &Wrench, along: &Twist) -> f64 {
    wrench.force.dot(&along.linear) + wrench.moment.dot(&along.angular)
}

/// Model pairs over all shares: both soft, one rigid, on a plane, cut, concave against convex.
fn pairs() -> Vec<(&'static str, Pair)> {
    let half = [0.1, 0.08, 0.06];
    let l = |surface: &str| {
        let lower = box_polyhedron("lower", [0.0, 0.0, -0.03], [0.1, 0.08, 0.03], "");
        let upper = box_polyhedron("upper", [-0.05, 0.0, 0.03], [0.05, 0.08, 0.03], "");
        solid(surface, &format!("{lower}, {upper}"))
    };
    vec![
        ("soft and stiff", Pair::new(&block(SOFT, half), &block(STIFF, half))),
        ("rigid on soft", Pair::new(&block(RIGID, half), &block(SOFT, half))),
        ("soft on rigid", Pair::new(&block(SOFT, half), &block(RIGID, half))),
        ("soft on a plane", Pair::new(&block(SOFT, half), &floor(STIFF))),
        ("two of L on a box", Pair::new(&l(RIGID), &block(SOFT, half))),
    ]
}

/// The wrench is the negative derivative of the energy, deep overlaps and aligned faces included.
#[test]
fn wrench_is_the_derivative_of_the_energy() {
    let mut random = Random::new(12, 0, 0);
    let poses = long_samples(5_000, 20_000);
    for (name, mut pair) in pairs() {
        let (mut worst, mut met) = (0.0_f64, 0);
        for number in 0..poses {
            let turn = if number % 3 == 0 { Vec3::zeros() } else { random_vector(&mut random, 2.0) };
            let mut position = random_vector(&mut random, 0.15);
            if name.contains("plane") {
                position.z = random.between(-0.05, 0.12);
            }
            let pose = Pose { position, orientation: Quat::from_scaled_axis(turn) };
            let (wrench, energy) = pair.at(&pose);
            if energy == 0.0 {
                continue;
            }
            met += 1;
            let size = wrench.force.norm() + wrench.moment.norm() / 0.1;
            for along in directions() {
                let step = 1e-7;
                let shifted = |sign: f64| {
                    moved(
                        &pose,
                        &Twist {
                            linear: along.linear * (sign * step),
                            angular: along.angular * (sign * step),
                        },
                    )
                };
                let (plus, minus) = (pair.at(&shifted(1.0)).1, pair.at(&shifted(-1.0)).1);
                let slope = (plus - minus) / (2.0 * step);
                // Within a step the wrench changes by up to K·a·step.
                let error = (power(&wrench, &along) + slope).abs();
                worst = worst.max(error / (1e-6 * size + 5e7 * 0.04 * step));
            }
        }
        println!("{name}: {met} overlaps, worst {worst:.1e}");
        assert!(met > poses / 10 && worst < 1.0, "{name}: {worst}");
    }
}

/// A flat face of area a at the depth δ carries K·a·δ through its centre; tilted by θ it has the moment K·I·θ.
#[test]
fn flat_and_tilted_punch() {
    let half = [0.1, 0.06, 0.05];
    let (area, inertia) = (0.2 * 0.12, 0.2_f64.powi(3) * 0.12 / 12.0);
    for (share, surface, modulus) in [("rigid", RIGID, 2e7), ("equal", SOFT, 1e7)] {
        let mut pair = Pair::new(&block(surface, half), &block(SOFT, [0.5, 0.5, 0.2]));
        let depth = 1e-5;
        let flat = pose([0.03, -0.02, 0.25 - depth], [0.0; 3]);
        let (wrench, _) = pair.at(&flat);
        let force = modulus * area * depth;
        assert!((wrench.force.z / force - 1.0).abs() < 5e-4, "{share}: {wrench:?} for {force}");
        assert!(wrench.moment.norm() < 1e-9 * force && wrench.force.xy().norm() < 1e-9 * force, "{wrench:?}");
        let angle = 2e-5;
        let (tilted, _) = pair.at(&pose([0.03, -0.02, 0.25 - depth], [0.0, angle, 0.0]));
        // The tilt about the box's centre moves the face by angle·0.05 along x, without any moment.
        let moment = modulus * inertia * angle;
        let lever = 0.05 * angle * force;
        println!("{share}: {} for {moment}", tilted.moment.y);
        assert!(
            (tilted.moment.y + moment).abs() < 2e-3 * moment + 2.0 * lever,
            "{share}: {tilted:?} {moment}"
        );
    }
}

/// Both bodies get opposite wrenches about one point.
#[test]
fn wrenches_are_opposite() {
    let mut random = Random::new(4, 0, 0);
    for (name, mut pair) in pairs() {
        for _ in 0..samples(1000) {
            let pose = Pose {
                position: random_vector(&mut random, 0.12),
                orientation: Quat::from_scaled_axis(random_vector(&mut random, 1.0)),
            };
            let (on_a, _) = pair.at(&pose);
            let on_b = pair.world.wrench_common(pair.roots[1]).unwrap();
            let moment = on_a.moment + pose.position.cross(&on_a.force);
            let size = on_a.force.norm().max(1e-9);
            assert!((on_a.force + on_b.force).norm() < 1e-12 * size, "{name}");
            assert!((moment + on_b.moment).norm() < 1e-12 * size, "{name}");
        }
    }
}

/// Equal boxes with coincident faces, edges and corners: moved by T, the wrench changes by no more than a
/// constant times T.
#[test]
fn wrench_is_continuous_at_aligned_faces_and_edges() {
    let half = 0.1;
    let mut pair = Pair::new(&block(SOFT, [half; 3]), &block(SOFT, [half; 3]));
    let mut random = Random::new(7, 0, 0);
    let mut worst = 0.0_f64;
    for _ in 0..samples(3000) {
        let places = [-0.2, -0.1, 0.0, 0.1, 0.2, 0.199, 0.05];
        let mut pick = || places[random.below(places.len())];
        let position = [pick(), pick(), pick()];
        let turns = [0.0, 0.25, 0.5].map(|turn| turn * std::f64::consts::PI);
        let turn = Vec3::z() * turns[random.below(3)];
        let start = Pose { position: position.into(), orientation: Quat::from_scaled_axis(turn) };
        let (here, _) = pair.at(&start);
        let size = 1e-9;
        let by =
            Twist { linear: random_vector(&mut random, size), angular: random_vector(&mut random, size) };
        let (there, _) = pair.at(&moved(&start, &by));
        let change = (there.force - here.force).norm() + (there.moment - here.moment).norm() / half;
        worst = worst.max(change / (1e7 * half * half * 4.0 * 2.0 * size));
    }
    println!("worst change over K·a·T: {worst}");
    assert!(worst < 4.0, "{worst}");
}

/// A box cut into four pieces has the wrench of the whole box.
#[test]
fn cut_body_has_the_wrench_of_the_whole() {
    let piece = |name: &str, x: f64, y: f64, inactive: &str| {
        box_polyhedron(name, [x, y, 0.0], [0.05, 0.04, 0.06], inactive)
    };
    // Faces in the order −z, +z, −y, +y, −x, +x.
    let pieces = [
        piece("a", -0.05, -0.04, "3, 5"),
        piece("b", 0.05, -0.04, "3, 4"),
        piece("c", -0.05, 0.04, "2, 5"),
        piece("d", 0.05, 0.04, "2, 4"),
    ];
    let cut = |surface: &str| solid(surface, &pieces.join(", "));
    let whole = |surface: &str| block(surface, [0.1, 0.08, 0.06]);
    let other = block(STIFF, [0.07, 0.09, 0.05]);
    let mut random = Random::new(21, 0, 0);
    for surface in [SOFT, RIGID] {
        let mut one = Pair::new(&whole(surface), &other);
        let mut four = Pair::new(&cut(surface), &other);
        let mut back = Pair::new(&other, &cut(surface));
        let mut worst = 0.0_f64;
        for _ in 0..samples(3000) {
            let pose = Pose {
                position: random_vector(&mut random, 0.12),
                orientation: Quat::from_scaled_axis(random_vector(&mut random, 1.5)),
            };
            let (expected, _) = one.at(&pose);
            let (got, _) = four.at(&pose);
            let size = expected.force.norm() + expected.moment.norm() / 0.1 + 1.0;
            let apart = |got: &Wrench, expected: &Wrench| {
                ((got.force - expected.force).norm() + (got.moment - expected.moment).norm() / 0.1) / size
            };
            worst = worst.max(apart(&got, &expected));
            // The other way round: the cut body is fixed, and the other has the inverse pose.
            let inverse = pose.inverse();
            back.at(&inverse);
            let on_cut = back.world.wrench_common(back.roots[1]).unwrap();
            let turned = pose.orientation;
            let carried = Wrench { force: turned * on_cut.force, moment: turned * on_cut.moment };
            worst = worst.max(apart(&carried, &expected));
        }
        println!("{surface}: worst {worst:.1e}");
        assert!(worst < 1e-9, "{worst}");
    }
}

/// Damping never pulls and does positive work against any motion of overlapping boxes.
#[test]
fn damping_resists_and_never_pulls() {
    let damped = "stiffness: 1e5, foundation: 2e7, normal: HuntCrossley(dissipation: 2.0, exponent: 1.0), friction: None";
    let mut pair = Pair::new(&block(damped, [0.1; 3]), &block(damped, [0.1; 3]));
    let mut random = Random::new(9, 0, 0);
    for _ in 0..samples(5000) {
        let pose = Pose {
            position: random_vector(&mut random, 0.2),
            orientation: Quat::from_scaled_axis(random_vector(&mut random, 1.0)),
        };
        let (still, energy) = pair.at(&pose);
        if energy == 0.0 {
            continue;
        }
        let twist =
            Twist { linear: random_vector(&mut random, 3.0), angular: random_vector(&mut random, 20.0) };
        let (moving, _) = pair.evaluate(&pose, &twist);
        assert!(pair.contacts().iter().all(|contact| contact.normal_force >= 0.0));
        let lost = power(&still, &twist) - power(&moving, &twist);
        assert!(lost >= -1e-9 * still.force.norm() * 3.0, "{lost}");
    }
}

/// With the side of entry, a plate pushes back to the side of entry however deep the other body is, and
/// without it to the nearest side.
#[test]
fn plate_pushes_back_to_the_side_of_entry() {
    let plate = remembering(&block(SOFT, [0.5, 0.5, 0.001]));
    let cube = remembering(&block(SOFT, [0.05; 3]));
    let mut pair = Pair::new(&cube, &plate);
    pair.at(&pose([0.01, 0.02, 0.06], [0.0; 3]));
    pair.world.commit().unwrap();
    let mut last = 0.0;
    for step in 0..40 {
        let height = 0.051 - 1e-3 * f64::from(step);
        let (wrench, _) = pair.at(&pose([0.01, 0.02, height], [0.0; 3]));
        pair.world.commit().unwrap();
        if step > 0 {
            assert!(wrench.force.z > last, "{height}: {wrench:?}");
            last = wrench.force.z;
        }
    }
}

/// A body that tumbles all the way round on another in unbroken contact has the wrench that it has without the
/// memory of the side of entry.
#[test]
fn tumbling_body_forgets_the_side_on_which_it_began() {
    let half = 0.05;
    for other in [block(SOFT, [0.5, 0.5, 0.1]), floor(SOFT)] {
        let lift = if other.contains("Plane") { 0.0 } else { 0.1 };
        let mut plain = Pair::new(&block(SOFT, [half; 3]), &other);
        let mut with_memory = Pair::new(&remembering(&block(SOFT, [half; 3])), &remembering(&other));
        let mut deepest = 0.0_f64;
        for step in 0..=400 {
            let angle = 2.0 * std::f64::consts::PI * f64::from(step) / 400.0;
            // Lowest corner at a constant depth of 1 mm.
            let reach = half * (angle.sin().abs() + angle.cos().abs());
            let depth = if step == 0 { -1e-3 } else { 1e-3 };
            let pose = pose([0.0, 0.0, lift + reach - depth], [0.0, angle, 0.0]);
            let (expected, _) = plain.at(&pose);
            let (got, _) = with_memory.at(&pose);
            with_memory.world.commit().unwrap();
            let apart = (got.force - expected.force).norm() + (got.moment - expected.moment).norm() / half;
            assert!(apart <= 1e-9 * expected.force.norm(), "{step}: {got:?} for {expected:?}");
            deepest = deepest.max(expected.force.z);
        }
        assert!(deepest > 0.0);
    }
}

/// A body that first touches on an edge and then lies flat is held as if it had come down flat, whatever the tilt at
/// which it first touched: a side face beside the shared volume is never taken for the far side.
#[test]
fn body_that_tips_onto_a_face_has_all_side_faces() {
    let half = 0.05;
    let other = block(SOFT, [0.5, 0.5, 0.1]);
    let mut plain = Pair::new(&block(SOFT, [half; 3]), &other);
    for tenths in (0..=440).step_by(2) {
        let mut with_memory = Pair::new(&remembering(&block(SOFT, [half; 3])), &remembering(&other));
        let angle = (0.1 * f64::from(tenths)).to_radians();
        let reach = half * (angle.sin() + angle.cos());
        for (tilt, height) in
            [(angle, 0.1 + reach + 1e-4), (angle, 0.1 + reach - 1e-4), (0.0, 0.1 + half - 1e-3)]
        {
            let pose = pose([0.0, 0.0, height], [0.0, tilt, 0.0]);
            let (expected, _) = plain.at(&pose);
            let (got, _) = with_memory.at(&pose);
            with_memory.world.commit().unwrap();
            let apart = (got.force - expected.force).norm() + (got.moment - expected.moment).norm() / half;
            assert!(apart <= 1e-9 * expected.force.norm(), "{angle} rad: {got:?} for {expected:?}");
        }
    }
}

/// A cube rolls all the way round on a sheet that is deeper compressed than a quarter of its thickness: the wrench is
/// that on a thick plate. The sheet keeps its side of entry; the cube, which is thick, gets a new one.
#[test]
fn body_that_rolls_on_a_thin_sheet_forgets_its_own_side() {
    let half = 0.05;
    let mut plain = Pair::new(&block(SOFT, [half; 3]), &block(SOFT, [0.5, 0.5, 0.1]));
    let sheet = remembering(&block(SOFT, [0.5, 0.5, 0.001]));
    let mut with_memory = Pair::new(&remembering(&block(SOFT, [half; 3])), &sheet);
    for step in 0..=400 {
        let angle = 2.0 * std::f64::consts::PI * f64::from(step) / 400.0;
        let reach = half * (angle.sin().abs() + angle.cos().abs());
        // Lowest corner 0.7 mm, then 1.9 mm deep in the sheet of 2 mm.
        let depth = if step == 0 { -1e-3 } else { 7e-4 + 3e-6 * f64::from(step) };
        let at = |lift: f64| pose([0.0, 0.0, lift + reach - depth], [0.0, angle, 0.0]);
        let (expected, _) = plain.at(&at(0.1));
        let (got, _) = with_memory.at(&at(0.001));
        with_memory.world.commit().unwrap();
        let at_origin = got.moment - expected.moment;
        let apart = (got.force - expected.force).norm() + at_origin.norm() / half;
        assert!(apart <= 1e-9 * expected.force.norm(), "{step}: {got:?} for {expected:?}");
    }
}

/// Two sheets of the same thickness, of which one is turned until its edge is 0.7 mm deep in the other one, of 2 mm: the flat one keeps
/// its side of entry and the turned one takes it, in either order and with vertices that are turned and rounded.
#[test]
fn side_of_entry_of_equally_thin_sheets_depends_on_no_order_and_no_rounding() {
    let half = [0.05, 0.05, 0.001];
    let sheet = remembering(&block(SOFT, [0.1, 0.1, 0.001]));
    let mut plain = Pair::new(&block(SOFT, half), &block(SOFT, [0.1; 3]));
    let flat = pose([0.07, 0.0, 0.00195], [0.0; 3]);
    for degrees in [75.0_f64, 82.0, 89.0, 100.0] {
        let angle = degrees.to_radians();
        let reach = 0.05 * angle.sin() + 0.001 * angle.cos().abs();
        let turned = |lift: f64| pose([0.0, 0.0, lift + reach - 7e-4], [0.0, angle, 0.0]);
        let (expected, _) = plain.at(&turned(0.1));
        let size = expected.force.norm();
        for axes in [[0.0; 3], [0.3, -0.5, 0.9], [-1.1, 0.4, 0.2]] {
            // The sheet in a group whose axes are turned.
            let (group, to_group) = (pose([0.0; 3], axes), pose([0.0; 3], axes).inverse().orientation);
            let corners = carried_box("box", [Vec3::zeros(), half.into()], "", |corner| to_group * corner);
            let other = remembering(&solid(SOFT, &corners));
            let [mut first, mut second] = [Pair::new(&other, &sheet), Pair::new(&sheet, &other)];
            let at = flat.compose(&group);
            first.at(&at);
            second.at(&at.inverse());
            first.world.commit().unwrap();
            second.world.commit().unwrap();
            let at = turned(0.001).compose(&group);
            let (got, _) = first.at(&at);
            let apart = (got.force - expected.force).norm() + (got.moment - expected.moment).norm() / 0.05;
            assert!(apart <= 1e-9 * size, "{degrees}°, {axes:?}: {got:?} for {expected:?}");
            let opposite = -(at.orientation * second.at(&at.inverse()).0.force);
            assert!(
                (opposite - got.force).norm() <= 1e-9 * size,
                "{degrees}°, {axes:?}: {opposite} for {got:?}"
            );
        }
    }
}

/// Two equal sheets that lie on each other and are then turned by opposite angles, deep and shallow: they are mirror images,
/// so that the force is along the normal of the mirror.
#[test]
fn side_of_entry_of_mirrored_sheets_has_no_preference() {
    let sheet = remembering(&block(SOFT, [0.05, 0.05, 0.001]));
    for (degrees, depth) in
        [(8.0_f64, 1e-4), (8.0, 5.5e-3), (20.0, 3e-4), (20.0, 1.25e-2), (50.0, 7e-4), (50.0, 1.9e-3)]
    {
        let mut pair = Pair::new(&sheet, &sheet);
        pair.at(&pose([0.0, 0.0, 0.00195], [0.0; 3]));
        pair.world.commit().unwrap();
        // Sheet A at (0, 0, h) turned by the angle, B at (0, 0, -h) turned back, seen from B.
        let angle = degrees.to_radians();
        let height = 0.05 * angle.sin() + 0.001 * angle.cos() - 0.5 * depth;
        let [a, b] = [1.0, -1.0].map(|side| pose([0.0, 0.0, side * height], [0.0, side * angle, 0.0]));
        let (wrench, _) = pair.at(&b.inverse().compose(&a));
        let force = b.orientation * wrench.force;
        assert!(force.z > 0.0, "{degrees}°, {depth} m: {force}");
        assert!(force.xy().norm() <= 1e-9 * force.z, "{degrees}°, {depth} m: {force}");
    }
}

/// A soft tetrahedron flat on a rigid block: its edges have 70.5°, so the side of entry takes its other faces away. The
/// bottom carries K·a·δ with its own area a, on a block of any size, and as a potential with the wrench of its walls.
#[test]
fn flat_tetrahedron_has_the_area_of_its_face() {
    let (foundation, edge, delta) = (2e7, 0.1_f64, 1e-6);
    let (radius, height) = (edge / 3.0_f64.sqrt(), edge * (2.0 / 3.0_f64).sqrt());
    let corner = |angle: f64| [radius * angle.cos(), radius * angle.sin(), 0.0];
    let [a, b, c] = [0.0, 2.0, 4.0].map(|third| corner(third * std::f64::consts::FRAC_PI_3));
    let tuple = |[x, y, z]: [f64; 3]| format!("({x:?}, {y:?}, {z:?})");
    let vertices = [a, b, c, [0.0, 0.0, height]].map(tuple).join(", ");
    let faces = "[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]";
    let primitive = format!("Polyhedron(name: \"tetrahedron\", vertices: [{vertices}], faces: {faces})");
    let soft = remembering(&solid(SOFT, &primitive));
    let mut pair = Pair::new(&soft, &remembering(&block(RIGID, [1.0, 1.0, 0.2])));
    pair.at(&pose([0.0, 0.0, 0.2 + 1e-3], [0.0; 3]));
    pair.world.commit().unwrap();
    let (wrench, _) = pair.at(&pose([0.0, 0.0, 0.2 - delta], [0.0; 3]));
    let expected = foundation * 0.25 * 3.0_f64.sqrt() * edge * edge * delta;
    assert!((wrench.force.z / expected - 1.0).abs() < 20.0 * delta / edge, "{wrench:?} for {expected}");
    let here = pose([0.3, -0.2, 0.2 - 0.01], [0.1, -0.2, 0.7]);
    pair.at(&here);
    pair.world.commit().unwrap();
    for along in directions() {
        let step = |by: f64| Twist { linear: along.linear * by, angular: along.angular * by };
        let energy = |by: f64, pair: &mut Pair| pair.at(&moved(&here, &step(by))).1;
        let slope = (energy(1e-6, &mut pair) - energy(-1e-6, &mut pair)) / 2e-6;
        let (wrench, _) = pair.at(&here);
        assert!((power(&wrench, &along) + slope).abs() < 1e-6 * wrench.force.norm(), "{along:?}: {wrench:?}");
    }
}

/// A tilted block slides on the edge between two of its faces, at the depth D: each face has the damping force
/// ¾·c·D·L·v, with c per area, of which the sine of the tilt of that face is drag. The force of the trailing face falls
/// to zero at most.
#[test]
fn linear_damping_drags_a_tilted_edge() {
    let (foundation, damping, depth, length) = (2e7, 1e4, 1e-4, 0.2);
    let damped = "stiffness: 1e5, foundation: 2e7, normal: Linear(damping: 50.0), friction: None";
    let mut pair = Pair::new(&block(damped, [0.05, 0.5 * length, 0.05]), &block(RIGID, [1.0, 1.0, 0.2]));
    for tilt in [0.05, 0.3, std::f64::consts::FRAC_PI_4, 1.2_f64] {
        let (sin, cos) = tilt.sin_cos();
        let at = pose([0.0, 0.0, 0.2 + 0.05 * (sin + cos) - depth], [0.0, tilt, 0.0]);
        // Lengths of the bottom and of the side in the cross-section of the overlap, and the height of their cells.
        let (bottom, side) = (depth / sin, depth / cos);
        let height = bottom * side / (bottom + side);
        let elastic = [bottom, side].map(|along| 0.5 * foundation * along * height * length);
        for speed in [-0.5, -0.05, 0.0, 0.05, 0.5] {
            let rate = 0.75 * damping * depth * length * speed;
            let [bottom, side] = [(elastic[0] - rate).max(0.0), (elastic[1] + rate).max(0.0)];
            let expected = Vec3::new(bottom * sin - side * cos, 0.0, bottom * cos + side * sin);
            let twist = Twist { linear: Vec3::x() * speed, angular: Vec3::zeros() };
            let (wrench, _) = pair.evaluate(&at, &twist);
            println!("{tilt:.2} rad, {speed} m/s: {:.4} N for {:.4} N", wrench.force.x, expected.x);
            assert!(
                (wrench.force - expected).norm() < 2e-3 * expected.norm(),
                "{tilt} rad, {speed} m/s: {wrench:?} for {expected:?}"
            );
        }
    }
}

/// Solids count for the distance of two movable groups, as do solids and planes.
#[test]
fn distance_of_solids() {
    for (other, expected) in [(block(SOFT, [0.1; 3]), 0.05), (floor(SOFT), 0.15)] {
        let mut pair = Pair::new(&block(SOFT, [0.1; 3]), &other);
        pair.at(&pose([0.02, 0.03, 0.25], [0.0; 3]));
        let found = pair.world.distance(pair.roots[0], pair.roots[1]).unwrap();
        assert!((found.distance - expected).abs() < 1e-12, "{found:?}");
    }
}

/// Prints the time of a frame with one pair of boxes, for the page on performance.
#[test]
#[ignore = "prints times"]
fn times_of_a_pair_of_boxes() {
    let rough = "stiffness: 1e5, foundation: 2e7, friction: Bristle(mu: 0.5)";
    let mut pair = Pair::new(&remembering(&block(rough, [0.1; 3])), &remembering(&block(rough, [0.1; 3])));
    let quarter = std::f64::consts::FRAC_PI_4;
    let tilt = tilt_to_corner();
    let cases = [
        ("face on face", pose([0.03, 0.02, 0.2 - 1e-4], [0.0; 3])),
        ("edge on face", pose([0.0, 0.0, 0.1 + 0.1 * 2.0_f64.sqrt() - 1e-4], [quarter, 0.0, 0.0])),
        ("corner on face", pose([0.0, 0.0, 0.1 + 0.1 * 3.0_f64.sqrt() - 1e-4], [quarter, 0.0, 0.0])),
        ("half way in", pose([0.03, 0.02, 0.1], [0.1, 0.2, 0.3])),
        ("apart by 1 mm", pose([0.03, 0.02, 0.201], [0.0; 3])),
        ("far apart", pose([0.0, 0.0, 5.0], [0.0; 3])),
    ];
    for (name, mut place) in cases {
        if name == "corner on face" {
            place.orientation = Quat::from_scaled_axis(Vec3::y() * tilt) * place.orientation;
        }
        pair.at(&place);
        pair.world.commit().unwrap();
        let mut least = f64::INFINITY;
        for _ in 0..20 {
            let start = std::time::Instant::now();
            for _ in 0..2000 {
                pair.world.evaluate().unwrap();
            }
            least = least.min(start.elapsed().as_secs_f64() / 2000.0);
        }
        println!("{name}: {:.3} µs a frame, {} contacts", 1e6 * least, pair.contacts().len());
    }
}

/// Angle by which a cube that stands on an edge is tilted to stand on a corner, rad.
fn tilt_to_corner() -> f64 {
    (1.0 / 2.0_f64.sqrt()).atan()
}

/// A rigid body is pushed by the field of its soft partner alone: turned anyhow, along the normal of the slab.
#[test]
fn rigid_body_is_pushed_along_the_face_of_the_soft_one() {
    let rigid = block(RIGID, [0.1, 0.08, 0.06]);
    let mut pair = Pair::new(&rigid, &block(SOFT, [1.0, 1.0, 0.2]));
    let (wrench, _) = pair.at(&pose([0.02, 0.01, 0.29], [0.3, 0.4, 0.1]));
    assert!(wrench.force.z > 0.0 && wrench.force.xy().norm() < 1e-9 * wrench.force.z, "{wrench:?}");
}

const RUBBING: &str = "stiffness: 1e5, foundation: 2e7, friction: Bristle(mu: 0.5, stiffness: 1e4)";
const RIGID_RUBBING: &str = "stiffness: inf, friction: Bristle(mu: 0.5)";

/// The friction of a patch that grows while it sticks keeps its force: pressing deeper makes no energy.
#[test]
fn growing_patch_keeps_the_force_of_its_bristle() {
    let mut pair = Pair::new(&block(RIGID_RUBBING, [0.1; 3]), &block(RUBBING, [1.0, 1.0, 0.2]));
    let mut held = |y: f64, depth: f64| {
        let height = 0.2 + 0.1 * (0.3_f64.sin() + 0.3_f64.cos()) - depth;
        let wrench = pair.at(&pose([0.0, y, height], [0.0, 0.3, 0.0])).0;
        pair.world.commit().unwrap();
        wrench
    };
    held(0.0, 1e-3);
    let stuck = held(1e-5, 1e-3);
    let deeper = held(1e-5, 2e-3);
    assert!(stuck.force.y < -1e-3 && deeper.force.z > 3.0 * stuck.force.z, "{stuck:?} {deeper:?}");
    assert!((deeper.force.y / stuck.force.y - 1.0).abs() < 1e-9, "{stuck:?} {deeper:?}");
}

/// A flat face that spins about its normal has the couple μ·F·r, with r = 2√2/3 of its radius of gyration.
#[test]
fn spinning_face_has_the_couple_of_its_lever() {
    let half = [0.1, 0.06, 0.05];
    let mut pair = Pair::new(&block(RIGID_RUBBING, half), &block(RUBBING, [1.0, 1.0, 0.2]));
    let at = |turn: f64| pose([0.3, 0.2, 0.25 - 1e-5], [0.0, 0.0, turn]);
    pair.at(&at(0.0));
    pair.world.commit().unwrap();
    let wrench = pair.at(&at(0.5)).0;
    let gyration = ((half[0].powi(2) + half[1].powi(2)) / 3.0).sqrt();
    let couple = 0.5 * wrench.force.z * 8.0_f64.sqrt() / 3.0 * gyration;
    assert!((wrench.moment.z / -couple - 1.0).abs() < 1e-6, "{wrench:?} {couple}");
    assert!(wrench.force.xy().norm() < 1e-6 * wrench.force.z, "{wrench:?}");
}

/// Internal faces bound a field and do not push: across the seam of a slab that is not convex, all forces are
/// along the normal of its face.
#[test]
fn internal_faces_do_not_push() {
    let l = |surface: &str, size: f64, up: f64| {
        let piece = |name: &str, x: f64, z: f64, inactive: &str| {
            box_polyhedron(name, [size * x, 0.0, up * size * z], [0.5 * size, size, 0.5 * size], inactive)
        };
        // Faces in the order −z, +z, −y, +y, −x, +x.
        let (of_row, of_column) = if up > 0.0 { ("1, 5", "0") } else { ("0, 5", "1") };
        let pieces =
            [piece("a", -0.5, 0.5, of_row), piece("b", 0.5, 0.5, "4"), piece("c", -0.5, 1.5, of_column)];
        solid(surface, &pieces.join(", "))
    };
    let mut pair = Pair::new(&l(RIGID, 0.1, 1.0), &l(SOFT, 0.3, -1.0));
    let depth = 5e-3;
    let (wrench, _) = pair.at(&pose([0.01, 0.02, -depth], [0.0; 3]));
    let force = 2e7 * 0.2 * 0.2 * depth;
    assert!((wrench.force.z / force - 1.0).abs() < 1e-9, "{wrench:?} {force}");
    let contacts = pair.contacts();
    assert!(
        contacts.len() >= 3 && contacts.iter().all(|contact| contact.normal.z > 0.999_999),
        "{contacts:?}"
    );
}

/// A flat face that turns about its middle line presses only where 1 + χ·ḋ is positive: from the line at −1/(χ·ω) on, and
/// the more, the farther a point is from it.
#[test]
fn parts_of_a_face_that_separate_fast_do_not_pull() {
    let damped = "stiffness: 1e5, foundation: 2e7, normal: HuntCrossley(dissipation: 1.0, exponent: 1.0), friction: None";
    let mut pair = Pair::new(&block(RIGID, [0.1; 3]), &block(damped, [1.0, 1.0, 0.2]));
    for spin in [1.0, 10.0, 20.0, 100.0, 1e3, 1e6] {
        let twist = Twist { linear: Vec3::zeros(), angular: Vec3::y() * spin };
        let (wrench, _) = pair.evaluate(&pose([0.0, 0.0, 0.299], [0.0; 3]), &twist);
        let (half, elastic) = (0.1, 2e7 * 0.04 * 1e-3);
        let (share, lever) = match spin * half <= 1.0 {
            true => (1.0, spin * half * half / 3.0),
            false => ((1.0 + spin * half).powi(2) / (4.0 * spin * half), (2.0 * half - 1.0 / spin) / 3.0),
        };
        assert!((wrench.force.z / (elastic * share) - 1.0).abs() < 1e-9, "{spin}: {wrench:?}");
        assert!((wrench.moment.y.abs() / wrench.force.z - lever).abs() < 1e-9, "{spin}: {wrench:?}");
    }
}

/// A thin fin beside a face changes its force by as much as the fin presses, also where the end of the fin separates fast:
/// a part of no volume has no force, and no influence on the rest of the cell.
#[test]
fn thin_fin_that_separates_fast_leaves_the_force_of_the_face() {
    let damped = "stiffness: 1e5, foundation: 2e7, normal: HuntCrossley(dissipation: 1.0, exponent: 1.0), friction: None";
    let block = box_polyhedron("block", [0.0; 3], [0.1; 3], "");
    let spin = 5.0;
    let twist = Twist { linear: Vec3::zeros(), angular: Vec3::y() * spin };
    let force = |fin: &str| {
        let mut pair = Pair::new(&solid(RIGID, &format!("{block}{fin}")), &floor(damped));
        let (wrench, _) = pair.evaluate(&pose([0.0, 0.0, 0.099], [0.0; 3]), &twist);
        wrench.force.z
    };
    let alone = force("");
    for width in [1e-2, 1e-4, 1e-6] {
        let fin = box_polyhedron("fin", [-0.5, 0.0, 0.0], [0.4, 0.5 * width, 0.1], "");
        // The fin presses with 1 + χ·ω·x between x = −0.2 and its root at x = −0.1.
        let expected = 2e7 * 1e-3 * width * (0.1 - spin * 0.5 * (0.04 - 0.01));
        let found = force(&format!(", {fin}")) - alone;
        assert!((found - expected).abs() < 1e-9 * alone, "{width}: {found} {expected}");
    }
}
