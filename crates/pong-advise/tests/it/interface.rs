//! Linear interface of preloaded rings of feet against closed forms.

use pong_advise::{Ending, LinearInterface};
use pong_engine::{Config, InterfaceId, State, World};
use pong_geometry::{Pose, Quat, Twist, Vec3};
use pong_testkit::{assert_near, ron, worlds};
use std::f64::consts::TAU;

const FEET: usize = 8;
const RADIUS: f64 = 0.7;
const DEPTH: f64 = 1e-4;
const K: f64 = 2e6;
const K_T: f64 = 1.2e6;
const C: f64 = 3e3;
const MU: f64 = 0.3;
/// Preload, N.
const P: f64 = FEET as f64 * K * DEPTH;

/// Feet of a ring, about `center`; `which` chooses them.
fn ring(name: &str, center: [f64; 2], which: impl Fn(usize) -> bool) -> String {
    let feet: String = (0..FEET)
        .filter(|foot| which(*foot))
        .map(|foot| {
            let angle = TAU * foot as f64 / FEET as f64;
            let (x, y) = (RADIUS * angle.cos() - center[0], RADIUS * angle.sin() - center[1]);
            format!("Point(name: \"foot_{foot}\", position: ({x:?}, {y:?}, 0.0)),")
        })
        .collect();
    ron::model(name, &surface(&format!("{K:?}")), &feet)
}

/// Bristles of two surfaces act in series: each has twice the stiffness of the contact.
fn surface(stiffness: &str) -> String {
    format!(
        "\"s\": (stiffness: {stiffness}, normal: Linear(damping: {C:?}), \
         friction: Bristle(mu: {MU:?}, stiffness: {:?}, damping: 0.0))",
        2.0 * K_T
    )
}

fn floor() -> String {
    ron::model("floor", &surface("inf"), "Plane(name: \"plane\", normal: (0, 0, 1), offset: 0),")
}

/// A world of a floor and other groups whose poses are given relative to it. The floor is turned and far away.
fn world(models: &[&str], places: &[Vec3]) -> (World, Vec<InterfaceId>) {
    let (mut world, _, groups) = worlds::paired_with_first(Config::default(), models);
    let floor =
        Pose { position: Vec3::new(30.0, -20.0, 5.0), orientation: Quat::from_euler_angles(0.4, -1.1, 2.0) };
    let relative = std::iter::once(&Vec3::zeros()).chain(places).copied().collect::<Vec<_>>();
    for (group, place) in groups.iter().zip(relative) {
        let pose = Pose { position: floor.position + floor.orientation * place, ..floor };
        world.set_state(*group, &State::from_motion(&pose, &Twist::zero())).unwrap();
    }
    // Bristles begin with the first commit.
    world.step().unwrap();
    world.evaluate().unwrap();
    (world, groups)
}

fn limit(interface: &LinearInterface, component: usize, sign: f64, ending: Ending) -> f64 {
    let same = interface
        .limits
        .iter()
        .find(|limit| limit.component == component && limit.ending == ending && limit.load * sign > 0.0);
    same.unwrap_or_else(|| panic!("{component} {sign} {ending:?}: {:?}", interface.limits)).load.abs()
}

/// A ring of feet under the preload P opens at the moment P·r/2 and at the axial force P, and slides at μP and μPr.
fn is_that_of_the_ring(interface: &LinearInterface, tolerance: f64) {
    let n = FEET as f64;
    let across = n * RADIUS * RADIUS / 2.0;
    let wanted = [n * K_T, n * K_T, n * K, K * across, K * across, 2.0 * K_T * across];
    for (component, wanted) in wanted.into_iter().enumerate() {
        assert_near(interface.stiffness[(component, component)], wanted, tolerance);
    }
    assert_near(interface.damping[(2, 2)], n * C, tolerance);
    assert_near(interface.preload.force.z, P, tolerance);
    assert_eq!((interface.contacts, interface.slipping, interface.holds), (FEET, 0, [true; 6]));
    assert_near(limit(interface, 2, 1.0, Ending::Opens), P, tolerance);
    for (component, sign) in [(3, 1.0), (3, -1.0), (4, 1.0), (4, -1.0)] {
        assert_near(limit(interface, component, sign, Ending::Opens), P * RADIUS / 2.0, tolerance);
    }
    // Friction acts at a distance of up to DEPTH from the feet, and so tilts the ring a little.
    let tilting = DEPTH / RADIUS;
    for sign in [1.0, -1.0] {
        assert_near(limit(interface, 0, sign, Ending::Slides), MU * P, tilting);
        assert_near(limit(interface, 5, sign, Ending::Slides), MU * P * RADIUS, tilting);
    }
    // Nothing opens under a force that presses.
    assert!(!interface.limits.iter().any(|limit| limit.component == 2 && limit.load < 0.0));
}

fn whole_ring() -> (World, Vec<InterfaceId>) {
    world(&[&floor(), &ring("ring", [0.0; 2], |_| true)], &[Vec3::new(0.0, 0.0, -DEPTH)])
}

#[test]
fn a_preloaded_ring_opens_at_half_the_preload_times_its_radius() {
    let (mut world, groups) = whole_ring();
    let interface = LinearInterface::between(&mut world, &groups[1..], &groups[..1]).unwrap();
    is_that_of_the_ring(&interface, 1e-6);
    // From the other side: the same about the floor's origin, with the opposite wrench.
    let other = LinearInterface::between(&mut world, &groups[..1], &groups[1..]).unwrap();
    assert_near(other.preload.force.z, -P, 1e-9);
    assert_near(limit(&other, 2, -1.0, Ending::Opens), P, 1e-9);
    assert_near(limit(&other, 3, 1.0, Ending::Opens), P * RADIUS / 2.0, 1e-3);
}

/// Two halves of the ring with origins of their own, and a third group at the reference point that touches nothing.
#[test]
fn several_groups_act_as_one_body() {
    let (left, right) = ([0.5, 0.3], [-0.4, 0.2]);
    let center =
        ron::model("center", &surface(&format!("{K:?}")), "Point(name: \"none\", position: (0, 0, 1)),");
    let models =
        [&floor(), &center, &ring("left", left, |foot| foot < 3), &ring("right", right, |foot| foot >= 3)];
    let places = [Vec3::zeros(), Vec3::new(left[0], left[1], 0.0), Vec3::new(right[0], right[1], 0.0)]
        .map(|place| place - Vec3::new(0.0, 0.0, DEPTH));
    let (mut world, groups) = world(&models.map(String::as_str), &places);
    let interface = LinearInterface::between(&mut world, &groups[1..], &groups[..1]).unwrap();
    is_that_of_the_ring(&interface, 1e-6);
    let (mut whole, groups) = whole_ring();
    let whole = LinearInterface::between(&mut whole, &groups[1..], &groups[..1]).unwrap();
    let tolerance = 1e-9 * whole.stiffness.amax();
    assert!(
        (whole.stiffness - interface.stiffness).amax() < tolerance,
        "{}",
        whole.stiffness - interface.stiffness
    );
}

/// Feet without friction hold neither a force along the floor nor a moment about its normal.
#[test]
fn loads_that_nothing_holds_are_named_and_bad_sets_are_refused() {
    let smooth = |text: String| text.replace(&format!("mu: {MU:?}"), "mu: 0.0");
    let models = [smooth(floor()), smooth(ring("ring", [0.0; 2], |_| true))];
    let (mut world, groups) = world(&[&models[0], &models[1]], &[Vec3::new(0.0, 0.0, -DEPTH)]);
    let (floor, ring) = (&groups[..1], &groups[1..]);
    let interface = LinearInterface::between(&mut world, ring, floor).unwrap();
    assert_eq!(interface.holds, [false, false, true, true, true, false]);
    let mut refused = |first: &[InterfaceId], second: &[InterfaceId]| {
        LinearInterface::between(&mut world, first, second).unwrap_err().to_string()
    };
    assert!(refused(&[], floor).contains("the first set has no group"));
    assert!(refused(ring, &groups).contains("a group is in both sets"));
    assert!(refused(ring, &[]).contains("do not touch each other"));
}
