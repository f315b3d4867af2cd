//! Bores in a world: contacts from behind, seams, wedging pins.

use crate::common::*;
use pong_geometry::{Quat, Vec3};

const K: f64 = 1e5;
const HOLE: &str = "Bore(name: \"b\", ends: ((0,0,-0.25),(0,0,0.25)), radii: (0.1,0.1), thickness: 0.05)";

fn rig(a: &str, b: &str) -> Rig {
    let steel = surface(2.0 * K, "friction: None");
    Rig::new(&model("a", &steel, a), &model("b", &steel, b))
}

/// Forces on A along x, over consecutive committed frames.
fn pushes(rig: &mut Rig, places: &[f64]) -> Vec<f64> {
    let push = |x: &f64| {
        rig.place_a(Vec3::new(*x, 0.0, 0.02), Quat::identity());
        rig.world.step().unwrap();
        rig.wrench(0).force.x
    };
    places.iter().map(push).collect()
}

/// A body placed behind the wall is pushed into the hole; one that comes from behind is not, until it has
/// left the wall.
#[test]
fn what_comes_from_behind_is_not_pushed_into_the_hole() {
    for (a, size) in [
        ("Point(name: \"p\", position: (0,0,0))", 0.0),
        ("Sphere(name: \"s\", center: (0,0,0), radius: 0.02)", 0.02),
    ] {
        let expect = |found: Vec<f64>, depths: &[f64]| {
            let is_close =
                found.iter().zip(depths).all(|(found, depth)| (found + K * depth).abs() < 1e-9 * K);
            assert!(is_close, "{a}: {found:?}");
        };
        expect(pushes(&mut rig(a, HOLE), &[0.13, 0.05, 0.11]), &[0.03 + size, 0.0, 0.01 + size]);
        expect(
            pushes(&mut rig(a, HOLE), &[0.2, 0.13, 0.11, 0.09, 0.05, 0.11]),
            &[0.0, 0.0, 0.0, 0.0, 0.0, 0.01 + size],
        );
    }
}

/// A ball too large for a hole feels no force in its middle, and twice the stiffness around it.
#[test]
fn a_ball_too_large_for_a_hole_is_held_in_its_middle() {
    let mut rig = rig("Sphere(name: \"s\", center: (0,0,0), radius: 0.101)", HOLE);
    let expected = [0.0, -2.0 * K * 1e-4, 2.0 * K * 3e-4, -K * 0.006];
    let found = pushes(&mut rig, &[0.0, 1e-4, -3e-4, 0.005]);
    assert!(
        found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-9 * K),
        "{found:?}"
    );
}

/// A ray in a hole is pushed by the wall that its tip has passed, only from inside.
#[test]
fn a_ray_is_pressed_by_the_wall_that_it_comes_to_from_within() {
    let ray = "Ray(name: \"r\", origin: (0,0,0), direction: (1,0,0), length: 0.05)";
    let mut rig = rig(ray, HOLE);
    let found = pushes(&mut rig, &[0.0, 0.06, 0.09, 0.12, 0.2]);
    let expected = [0.0, -K * 0.01, -K * 0.04, -K * 0.07, 0.0];
    assert!(
        found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-9 * K),
        "{found:?}"
    );
}

/// Pose of a pin of 0.1 m that is `depth` deep in a hole 1 mm wider, tilted, with its rim 20 µm in the wall
/// and its side 20 µm in the mouth.
fn jammed(depth: f64) -> (Vec3, Quat) {
    let (diameter, hole, press) = (0.1_f64, 0.101_f64, 2e-5);
    let (mut low, mut high) = (0.0_f64, 0.2_f64);
    for _ in 0..60 {
        let tilt = 0.5 * (low + high);
        let taken = depth * tilt.sin() + diameter * (1.0 - 0.5 * tilt.sin() * tilt.sin());
        *(if taken < (hole + 2.0 * press) * tilt.cos() { &mut low } else { &mut high }) = tilt;
    }
    let tip = Vec3::new(0.5 * hole + press - 0.5 * diameter * low.cos(), 0.0, -depth);
    (tip, Quat::from_scaled_axis(Vec3::y() * -low))
}

/// Stored energy half a second after a jammed pin of 1 kg is released, J.
fn stored_at_last(depth: f64, friction: f64) -> f64 {
    const MASS: f64 = 1.0;
    const STEP: f64 = 5e-5;
    let steel = format!(
        "\"s\": (stiffness: 1e6, normal: Linear(damping: 400.0), friction: Bristle(mu: {friction:?}))"
    );
    let pin = "Cylinder(name: \"p\", ends: ((0,0,0),(0,0,0.2)), radius: 0.05)";
    let hole = "Bore(name: \"b\", ends: ((0,0,-0.15),(0,0,0)), radii: (0.0505,0.0505))";
    let mut rig = Rig::new(&model("a", &steel, pin), &model("b", &steel, hole));
    let inertia = Vec3::new(0.00396, 0.00396, 0.00125);
    let (tip, mut q) = jammed(depth);
    let mut center = tip + q * Vec3::z() * 0.1;
    let (mut v, mut w) = (Vec3::zeros(), Vec3::zeros());
    for _ in 0..10_000 {
        let origin = center - q * Vec3::z() * 0.1;
        let state = moving(origin, q, v - w.cross(&(center - origin)), w);
        rig.place([state, pong_engine::State::identity()]);
        rig.world.step().unwrap();
        let wrench = rig.wrench(0);
        let moment = wrench.moment - (center - origin).cross(&wrench.force);
        v += wrench.force * (STEP / MASS);
        w += q * (q.inverse() * moment).component_div(&inertia) * STEP;
        center += v * STEP;
        q = Quat::from_scaled_axis(w * STEP) * q;
    }
    rig.world.contacts().iter().map(|contact| contact.stored).sum()
}

/// A pin pressed in at two points wedges only if the line between them lies in both friction cones: L < μD.
/// Otherwise it rotates out of its tilt, and no energy is stored.
#[test]
fn a_pin_wedges_only_if_it_is_less_deep_than_friction_times_its_diameter() {
    for (depth, friction, wedges) in
        [(0.03, 0.5, true), (0.08, 0.5, false), (0.03, 0.25, false), (0.05, 1.5, true), (0.03, 0.0, false)]
    {
        let stored = stored_at_last(depth, friction);
        assert_eq!(stored > 1e-6, wedges, "{depth} {friction}: {stored:e} J");
    }
}
