//! Properties of solids at random poses (docs/theory.md, 2.11): the wrench is the derivative of the stored energy, it
//! is continuous in the pose, a flat face presses like a punch, cutting a body changes nothing, and a closed path does
//! no work. `PONG_TESTS=night` draws 1e5 poses of each property and pair, and prints the worst of them.

mod flat;
mod solid_pair;
mod statistics;

use pong_geometry::{Pose, Quat, Twist, Vec3, Wrench};
use pong_invariance::random::Random;
use pong_testkit::samples::poses;
use solid_pair::{Bodies, Kind, SolidWorld, Start, VARIANTS, Variant, place};
use statistics::Statistics;

/// Length by which moments are divided to compare them with forces, m: the size of the bodies.
const LEVER: f64 = 1.0;

/// Least depth of an overlap that counts, m: many times the rounding of a position, and the shortest step. The error of a
/// central difference is the square of the step over the depth of a corner.
const LEAST_DEPTH: f64 = 1e-5;

/// Poses of one pair of bodies.
const POSES_OF_A_PAIR: usize = 50;

/// Numbers of properties among the random numbers.
const PUNCH: u64 = 3;
const CUTTING: u64 = 4;
const CLOSED_PATH: u64 = 5;

/// Measures a property at random poses of a kind of pair, in the first of two worlds: that of the pieces in the variant
/// that cuts, else that of the whole. For the property of cut bodies the second world has the pieces. `measure` returns
/// the error, or `None` where the bodies do not touch.
fn survey(
    property: u64,
    kind: Kind,
    limit: f64,
    mut measure: impl FnMut(&Bodies, &mut [SolidWorld; 2], &Start, &mut Random) -> Option<f64>,
) {
    let is_cut = |variant: Variant| property == CUTTING || variant == Variant::Cut;
    let mut statistics = Statistics::new(limit);
    let count = poses();
    let group = POSES_OF_A_PAIR.min(count / VARIANTS.len());
    for (number, first) in (0..count).step_by(group).enumerate() {
        let variant = VARIANTS[number % VARIANTS.len()];
        let mut random = Random::new(property, kind as u64, number as u64);
        let mut bodies = Bodies::random(kind, variant, is_cut(variant), &mut random);
        // Closed paths of hulls have no memory of the side of entry: some leave the overlap, where it ends the energy.
        bodies.remembers &= property != CLOSED_PATH || kind != Kind::HullOnHull;
        let mut worlds = [bodies.world(false), bodies.world(is_cut(variant))];
        if variant == Variant::Cut && property != CUTTING {
            worlds.reverse();
        }
        for index in first..(first + group).min(count) {
            let mut random = Random::new(property, 100 + kind as u64, index as u64);
            let start = place(&bodies.shapes, variant, &mut random);
            if let Some(error) = measure(&bodies, &mut worlds, &start, &mut random) {
                statistics.add(variant, index, error);
            }
        }
    }
    statistics.judge(&format!("{kind:?}"), count);
}

/// Sets the memory of the side of entry, where there is one, and returns wrench and energy; `None` without overlap.
fn begin(bodies: &Bodies, world: &mut SolidWorld, start: &Start) -> Option<(Wrench, f64)> {
    if bodies.remembers {
        world.begin(start);
    }
    let found = world.at(&start.here);
    (world.depth() > LEAST_DEPTH).then_some(found)
}

fn difference(a: &Wrench, b: &Wrench) -> f64 {
    (a.force - b.force).norm() + (a.moment - b.moment).norm() / LEVER
}

/// Poses with A moved by a twist about its origin.
fn moved([a, b]: &[Pose; 2], by: &Twist) -> [Pose; 2] {
    let orientation = Quat::from_scaled_axis(by.angular) * a.orientation;
    [Pose { position: a.position + by.linear, orientation }, *b]
}

fn power(wrench: &Wrench, along: &Twist) -> f64 {
    wrench.force.dot(&along.linear) + wrench.moment.dot(&along.angular)
}

/// Unit twist along or about an axis of the common frame.
fn unit_twist(axis: usize) -> Twist {
    let unit = Vec3::ith(axis % 3, 1.0);
    match axis < 3 {
        true => Twist { linear: unit, angular: Vec3::zeros() },
        false => Twist { linear: Vec3::zeros(), angular: unit },
    }
}

/// Largest coordinate of a pose, which rounding is relative to, m.
fn reach(start: &Start) -> f64 {
    start.here.iter().map(|pose| pose.position.norm()).fold(2.0, f64::max)
}

/// The wrench is the negative derivative of the stored energy, to 1e-6 by central differences. The error is a multiple of
/// that and of the rounding. A step over a kink of the wrench is known to half of the kink, so the best of three short
/// steps counts, or their limit, as a kink may be at the pose itself (flush edges).
fn gradient(kind: Kind) {
    survey(1, kind, 1.0, |bodies, [world, _], start, _| {
        const STEPS: [f64; 3] = [3e-7, 3e-8, 3e-9];
        let (wrench, _) = begin(bodies, world, start)?;
        let pressed = world.pressed();
        // Energy is known to the force times the rounding of a position.
        let rounding = 8.0 * f64::EPSILON * reach(start);
        let mut worst = 0.0_f64;
        for axis in 0..6 {
            let along = unit_twist(axis);
            let errors = STEPS.map(|step| {
                let mut energy = |sign: f64| {
                    let [linear, angular] = [along.linear, along.angular].map(|v| v * (sign * step));
                    world.at(&moved(&start.here, &Twist { linear, angular })).1
                };
                let slope = (energy(1.0) - energy(-1.0)) / (2.0 * step);
                (power(&wrench, &along) + slope) / pressed
            });
            let limit = (10.0 * errors[2] - errors[1]) / 9.0;
            let of_steps = errors.iter().zip(STEPS).chain([(&limit, STEPS[2])]);
            let least = of_steps.map(|(error, step)| error.abs() / (1e-6 + rounding / step));
            worst = worst.max(least.fold(f64::INFINITY, f64::min));
        }
        Some(worst)
    });
}

/// The wrench changes by no more than a few K·a·T over a displacement T, a the square of the smaller body's size. A jump
/// would be a multiple of K·a times a length.
fn continuity(kind: Kind) {
    survey(2, kind, 10.0, |bodies, [world, _], start, random| {
        let (here, _) = begin(bodies, world, start)?;
        let step = 1e-8;
        let by = Twist { linear: random.direction() * step, angular: random.direction() * step };
        let (there, _) = world.at(&moved(&start.here, &by));
        Some(difference(&here, &there) / (bodies.modulus() * bodies.area() * step))
    });
}

/// A body cut into pieces has the wrench of the whole, to 1e-9. The error is a multiple of that and of the rounding.
fn cutting(kind: Kind) {
    survey(CUTTING, kind, 1.0, |bodies, [whole, pieces], start, _| {
        let (expected, _) = begin(bodies, whole, start)?;
        let pressed = whole.pressed();
        if bodies.remembers {
            pieces.begin(start);
        }
        let (found, _) = pieces.at(&start.here);
        // A shared volume is known to an area times the rounding of a position, or the height of a bent face.
        let height = 16.0 * f64::EPSILON * reach(start) + bodies.bend();
        let rounding = height * bodies.modulus() * bodies.area();
        Some(difference(&expected, &found) / (1e-9 * pressed + rounding))
    });
}

/// A path through three poses and back does no work: less than 1e-5 of the work that is done to and fro, and of the
/// force at the start along the path. The integral is known to the kinks within 6e-5 of a leg. With a face taken away by
/// the side of entry the energy ends with a jump where the whole bodies no longer overlap (docs/theory.md, 2.12), so a
/// path that leaves the overlap does not count then.
fn closed_path(kind: Kind) {
    survey(CLOSED_PATH, kind, 1e-5, |bodies, [world, _], start, random| {
        begin(bodies, world, start)?;
        let pressed = world.pressed();
        let size = random.log_between(1e-4, 0.3);
        let mut corner = || {
            let by = Twist { linear: random.vector(size), angular: random.vector(0.1 * size) };
            moved(&start.here, &by)
        };
        let corners = [start.here, corner(), corner()];
        let mut work = Work { world, pressed, sum: 0.0, absolute: 0.0, leaves: false };
        for leg in 0..3 {
            work.add(&corners[leg], &corners[(leg + 1) % 3]);
        }
        (!bodies.remembers || !work.leaves).then(|| work.sum.abs() / work.absolute)
    });
}

/// Work along a path, J.
struct Work<'a> {
    world: &'a mut SolidWorld,
    /// Force of the contacts at the start, N.
    pressed: f64,
    sum: f64,
    absolute: f64,
    /// True if the bodies do not overlap somewhere on the path.
    leaves: bool,
}

impl Work<'_> {
    /// Adds the work along a straight leg with a constant angular velocity.
    fn add(&mut self, from: &[Pose; 2], to: &[Pose; 2]) {
        let turn = (to[0].orientation * from[0].orientation.inverse()).scaled_axis();
        let whole = Twist { linear: to[0].position - from[0].position, angular: turn };
        let mut at = |t: f64| {
            let by = Twist { linear: whole.linear * t, angular: whole.angular * t };
            let (wrench, _) = self.world.at(&moved(from, &by));
            self.leaves |= self.world.depth() <= 0.0;
            power(&wrench, &whole)
        };
        let ends = [0.0, 0.5, 1.0].map(|t| (t, at(t)));
        let pressed = self.pressed * (whole.linear.norm() + whole.angular.norm() * LEVER);
        let scale = ends.iter().map(|(_, power)| power.abs()).fold(pressed, f64::max);
        let (sum, absolute) = integrate(&mut at, ends, scale, 0);
        self.sum += sum;
        self.absolute += absolute.max(pressed);
    }
}

/// Integral of a function and of its magnitude by Simpson's rule, halving where the two halves disagree. `scale` is the
/// magnitude of the function over the whole path.
fn integrate(
    f: &mut impl FnMut(f64) -> f64,
    points: [(f64, f64); 3],
    scale: f64,
    depth: usize,
) -> (f64, f64) {
    let [start, middle, end] = points;
    let width = end.0 - start.0;
    let mut between = |from: f64, to: f64| (0.5 * (from + to), f(0.5 * (from + to)));
    let (left, right) = (between(start.0, middle.0), between(middle.0, end.0));
    let coarse = width / 6.0 * (start.1 + 4.0 * middle.1 + end.1);
    let fine = width / 12.0 * (start.1 + 4.0 * left.1 + 2.0 * middle.1 + 4.0 * right.1 + end.1);
    let scale = scale.max(left.1.abs()).max(right.1.abs());
    let is_fine = (fine - coarse).abs() <= 1e-8 * scale * width;
    if depth >= 2 && (is_fine || depth >= 14) {
        let magnitude = width / 4.0
            * (left.1.abs() + right.1.abs() + middle.1.abs() + 0.5 * (start.1.abs() + end.1.abs()));
        return (fine + (fine - coarse) / 15.0, magnitude);
    }
    let first = integrate(f, [start, left, middle], scale, depth + 1);
    let second = integrate(f, [middle, right, end], scale, depth + 1);
    (first.0 + second.0, first.1 + second.1)
}

/// One test of each property and kind of pair.
macro_rules! tests {
    ($($name:ident: $property:expr, $kind:ident;)*) => {
        $(#[test] fn $name() { $property(Kind::$kind); })*
    };
}

tests! {
    wrench_is_the_derivative_of_the_energy_on_a_plane: gradient, OnPlane;
    wrench_is_the_derivative_of_the_energy_of_boxes: gradient, BoxOnBox;
    wrench_is_the_derivative_of_the_energy_of_hulls: gradient, HullOnHull;
    wrench_is_the_derivative_of_the_energy_of_concave_solids: gradient, ConcaveOnBox;
    wrench_is_continuous_on_a_plane: continuity, OnPlane;
    wrench_of_boxes_is_continuous: continuity, BoxOnBox;
    wrench_of_hulls_is_continuous: continuity, HullOnHull;
    wrench_of_concave_solids_is_continuous: continuity, ConcaveOnBox;
    cut_body_on_a_plane_has_the_wrench_of_the_whole: cutting, OnPlane;
    cut_boxes_have_the_wrench_of_the_whole: cutting, BoxOnBox;
    cut_hulls_have_the_wrench_of_the_whole: cutting, HullOnHull;
    cut_concave_solids_have_the_wrench_of_the_whole: cutting, ConcaveOnBox;
    closed_path_on_a_plane_does_no_work: closed_path, OnPlane;
    closed_path_of_boxes_does_no_work: closed_path, BoxOnBox;
    closed_path_of_hulls_does_no_work: closed_path, HullOnHull;
    closed_path_of_concave_solids_does_no_work: closed_path, ConcaveOnBox;
}
