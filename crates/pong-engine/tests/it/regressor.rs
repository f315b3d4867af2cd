//! Derivatives of the wrenches by the numbers of a surface: closed forms, a scaling law, and what is refused.

use crate::common::*;
use pong_engine::{EngineError, State};
use pong_geometry::{Quat, Vec3};

const K: f64 = 2e5;
const FLOOR: &str = "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)";

/// A point that slides on a floor, surfaces `a` and `b`.
fn sliding(a: &str, b: &str) -> Rig {
    let mut rig =
        Rig::new(&model("tip", a, "Point(name: \"p\", position: (0,0,0))"), &model("floor", b, FLOOR));
    let state = |x: f64| {
        moving(Vec3::new(x, 0.0, -1e-3), Quat::identity(), Vec3::new(0.5, 0.0, -0.02), Vec3::zeros())
    };
    rig.place([state(0.0), State::identity()]);
    rig.world.step().unwrap();
    rig.place([state(0.01), State::identity()]);
    rig.world.evaluate().unwrap();
    rig
}

/// Two surfaces in series: k = k_A·k_B/(k_A + k_B), c = c_A·s_A² + c_B·s_B², μ = 2·μ_A·μ_B/(μ_A + μ_B).
#[test]
fn two_surfaces_in_series_have_the_closed_form() {
    let a = surface(K, "normal: Linear(damping: 600.0), friction: Bristle(mu: 0.3)");
    let b = surface(3.0 * K, "normal: Linear(damping: 0.0), friction: Bristle(mu: 0.5)");
    let mut rig = sliding(&a, &b);
    let before = rig.wrench(0);
    let force = before.force;
    let mut slope = |number: &str| {
        let slopes = rig.world.surface_slopes(rig.models[0], "s", number).unwrap();
        let [slope] = &slopes[..] else { panic!("one pair touches") };
        assert_eq!(slope.groups, rig.interfaces);
        assert!(
            (slope.wrenches[0].force + slope.wrenches[1].force).amax()
                < 1e-9 * slope.wrenches[0].force.amax()
        );
        slope.wrenches[0].force
    };
    let (depth, rate, share) = (1e-3, 0.02, 0.75);
    // ∂s_A/∂k_A = −s_A·s_B/k_A, so that c gains 2·c_A·s_A times this.
    let by_stiffness = share * share * depth - 2.0 * 600.0 * share * share * (1.0 - share) / K * rate;
    assert!((slope("stiffness").z - by_stiffness).abs() < 1e-8 * depth, "{}", slope("stiffness"));
    assert!((slope("normal.damping").z - share * share * rate).abs() < 1e-9);
    // Slides: the friction is −μ·F_n.
    let by_mu = -2.0 * (0.5_f64 / 0.8).powi(2) * force.z;
    assert!((slope("friction.mu").x - by_mu).abs() < 1e-8 * force.z, "{}", slope("friction.mu"));
    assert_eq!(rig.wrench(0), before, "the frame is that of before");
    assert!(rig.world.is_evaluated());
    // The damping of the floor is zero: differences upward.
    let floor = rig.world.surface_slopes(rig.models[1], "s", "normal.damping").unwrap();
    assert!((floor[0].wrenches[0].force.z - (1.0 - share) * (1.0 - share) * rate).abs() < 1e-9);
}

/// All stiffnesses and dampings times λ scale the wrench by λ: it is the sum of their products with its derivatives.
#[test]
fn a_wrench_is_homogeneous_in_stiffness_and_damping() {
    let laws = "normal: Linear(damping: 500.0, ramp: 1e-3), friction: Bristle(mu: 0.4, stiffness: 1e5, damping: 60.0)";
    let solid = |name: &str, text: &str| {
        model(name, &surface(K, laws), text).replace("root: (", "root: (contact: Solid, ")
    };
    let cube = box_polyhedron("box", [0.0; 3], [0.1; 3], "");
    for (a, b) in [
        (solid("cube", &cube), solid("floor", FLOOR)),
        (
            model("ball", &surface(K, laws), "Sphere(name: \"b\", center: (0,0,0), radius: 0.1)"),
            model("floor", &surface(0.5 * K, laws), FLOOR),
        ),
    ] {
        let mut rig = Rig::new(&a, &b);
        let state = |x: f64| {
            let turn = Quat::from_scaled_axis(Vec3::new(2e-3, 1e-3, x));
            moving(Vec3::new(x, 0.0, 0.099), turn, Vec3::new(0.1, 0.0, -0.02), Vec3::new(0.1, 0.2, 0.0))
        };
        for frame in 0..3 {
            rig.place([state(f64::from(frame) * 1e-4), State::identity()]);
            rig.world.evaluate().unwrap();
            if frame < 2 {
                rig.world.commit().unwrap();
            }
        }
        let wrench = rig.wrench(0);
        assert!(wrench.force.z > 0.0);
        let mut sum = pong_geometry::Wrench::zero();
        for model in rig.models {
            let values = rig.world.surface(model, "s").unwrap().clone();
            for number in ["stiffness", "normal.damping", "friction.stiffness", "friction.damping"] {
                let value = *values.clone().number_mut(number).unwrap();
                let slope = rig.world.surface_slopes(model, "s", number).unwrap()[0].wrenches[0];
                sum.force += slope.force * value;
                sum.moment += slope.moment * value;
            }
        }
        assert!((sum.force - wrench.force).amax() < 1e-7 * wrench.force.amax(), "{sum:?}\n{wrench:?}");
        assert!((sum.moment - wrench.moment).amax() < 1e-7 * wrench.force.amax() * 0.1);
    }
}

#[test]
fn unknown_numbers_are_refused() {
    let mut rig = sliding(&surface(K, "friction: None"), &surface(K, "friction: None"));
    let [tip, _] = rig.models;
    let refused = rig.world.surface_slopes(tip, "s", "friction.mu").unwrap_err().to_string();
    assert!(refused.contains("friction.mu") && refused.contains("normal.damping"), "{refused}");
    assert!(matches!(rig.world.surface_slopes(tip, "t", "stiffness"), Err(EngineError::UnknownName { .. })));
    rig.world.commit().unwrap();
    assert!(matches!(rig.world.surface_slopes(tip, "s", "stiffness"), Err(EngineError::WrongPhase { .. })));
}
