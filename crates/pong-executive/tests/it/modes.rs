//! Modes of the bodies at one instant against closed forms.

use crate::common::empty_world;
use pong_advise::{LinearBody, LinearSystem, ModeKind};
use pong_engine::TangentMatrix;
use pong_executive::scene::{Scene, Variation};
use pong_executive::{
    BodyId, Integrator, MassProperties, Mat3, Pose, RigidBody, Simulation, Spring, SpringEnd, Vec3,
};
use pong_model::Extensions;
use std::f64::consts::TAU;
use std::path::Path;
use std::sync::Arc;

const MASS: f64 = 3.0;
const INERTIA: f64 = 0.02;
/// Half the distance between two feet, m.
const HALF: f64 = 0.1;
/// Height of the mass centre above the feet, m.
const HEIGHT: f64 = 0.08;
const DEPTH: f64 = 1e-4;
const K: f64 = 2e5;
const C: f64 = 30.0;
const K_T: f64 = 1.2e5;
const C_T: f64 = 40.0;

/// A body on four feet that stick to the rigid ground, each `DEPTH` deep. The bristles of both surfaces act in series,
/// so each has twice the stiffness and damping of the contact.
fn on_four_feet() -> Simulation {
    let feet: String = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)]
        .iter()
        .enumerate()
        .map(|(i, (x, y))| {
            format!("Point(name: \"foot{i}\", position: ({:?}, {:?}, {:?})),", x * HALF, y * HALF, -HEIGHT)
        })
        .collect();
    let model = |name: &str, stiffness: &str, primitives: &str| {
        let text = format!(
            r#"(format: "pong-model", version: 1, name: "{name}",
                surfaces: {{ "s": (stiffness: {stiffness}, normal: Linear(damping: {C:?}),
                    friction: Bristle(mu: 0.5, stiffness: {:?}, damping: {:?})) }},
                root: (name: "{name}", surface: "s", primitives: [{primitives}]))"#,
            2.0 * K_T,
            2.0 * C_T,
        );
        let model = pong_model::parse(&text, name, None, &Extensions::new());
        Arc::new(model.unwrap_or_else(|errors| panic!("{errors}")))
    };
    let cube = model("cube", &format!("{K:?}"), &feet);
    let ground = model("ground", "inf", "Plane(name: \"g\", normal: (0, 0, 1), offset: 0)");
    let of_file = |path: &Path| Some(Arc::clone(if path.ends_with("cube.ron") { &cube } else { &ground }));
    let text = format!(
        r#"(format: "pong-scene", version: 1, name: "feet",
        models: {{ "cube": "cube.ron", "ground": "ground.ron" }},
        objects: [
            (name: "cube", model: "cube", bodies: [(motion: Free, mass: {MASS:?},
                inertia: Diagonal({INERTIA:?}, {INERTIA:?}, {INERTIA:?}), position: (0.0, 0.0, {:?}))]),
            (name: "ground", model: "ground", bodies: [(motion: Fixed)])],
        pairs: [("cube", "ground")], integrator: RungeKutta4, step: 1e-4, duration: 0.1)"#,
        HEIGHT - DEPTH
    );
    let scene = Scene::parse(&text, "scene", Path::new("")).unwrap_or_else(|errors| panic!("{errors}"));
    let built = scene.build_varied(&Variation { instead: Some(&of_file), ..Variation::default() });
    built.unwrap_or_else(|errors| panic!("{errors}")).simulation
}

/// Both eigenvalues of a symmetric 2×2 matrix.
fn both(a: f64, b: f64, c: f64) -> [f64; 2] {
    let (mean, apart) = (0.5 * (a + c), (0.25 * (a - c) * (a - c) + b * b).sqrt());
    [mean - apart, mean + apart]
}

/// With h the height of the mass centre above the ground, where the forces act: 4k/m vertically, 4·k_t·2a²/J about the
/// vertical, and two pairs of sliding and rocking with 4k_t, −4k_t·h and 4ka² + 4k_t·h² − N·(h + δ): the feet move by
/// (h + δ)·θ under the normal force N.
#[test]
fn a_cube_on_four_feet_has_the_modes_of_its_closed_form() {
    let mut simulation = on_four_feet();
    let linear = simulation.linearised().unwrap();
    assert!(linear.by_differences.is_none() && linear.contacts == 4);
    let modes = linear.system.modes(linear.tolerance()).unwrap();
    let h = HEIGHT - DEPTH;
    let normal_force = 4.0 * K * DEPTH;
    let rocking = 4.0 * K * HALF * HALF + 4.0 * K_T * h * h - normal_force * HEIGHT;
    let coupled = both(4.0 * K_T / MASS, 4.0 * K_T * h / (MASS * INERTIA).sqrt(), rocking / INERTIA);
    let (vertical, yaw) = (4.0 * K / MASS, 8.0 * K_T * HALF * HALF / INERTIA);
    let mut wanted = [coupled[0], coupled[0], coupled[1], coupled[1], vertical, yaw];
    wanted.sort_by(f64::total_cmp);
    assert_eq!(modes.modes.len(), 6);
    for (mode, wanted) in modes.modes.iter().zip(wanted) {
        let error = mode.frequency / (wanted.sqrt() / TAU) - 1.0;
        assert!(error.abs() < 1e-9, "{} Hz, off by {error}", mode.frequency);
        assert_eq!(mode.kind, ModeKind::Oscillation);
    }
    let damping_of = |rate: f64| {
        let near = |mode: &&pong_advise::Mode| (mode.rate / rate - 1.0).abs() < 1e-9;
        modes.modes.iter().find(near).unwrap().damping_ratio.unwrap()
    };
    let vertical_damping = 4.0 * C / MASS / (2.0 * vertical.sqrt());
    assert!((damping_of(vertical) / vertical_damping - 1.0).abs() < 1e-9);
    let yaw_damping = 8.0 * C_T * HALF * HALF / INERTIA / (2.0 * yaw.sqrt());
    assert!((damping_of(yaw) / yaw_damping - 1.0).abs() < 1e-9);
    assert!(modes.growths.is_empty(), "{:?}", modes.growths);
    // All four feet carry the same in the vertical mode and in the turn.
    for mode in
        modes.modes.iter().filter(|mode| [vertical, yaw].iter().any(|w| (mode.rate / w - 1.0).abs() < 1e-9))
    {
        assert!(mode.shares.iter().all(|share| (share - 0.25).abs() < 1e-9), "{:?}", mode.shares);
    }
    // The largest eigenvalue bounds the step as the closed form of the stiffest mode.
    let rates = linear.system.largest_rates();
    assert!((rates.stiffness / wanted[5] - 1.0).abs() < 1e-9);
}

/// A run after the analysis has the bits of a run without it.
#[test]
fn modes_leave_the_motion_alone() {
    let (mut with, mut without) = (on_four_feet(), on_four_feet());
    for _ in 0..20 {
        with.linearised().unwrap();
        with.step().unwrap();
        without.step().unwrap();
    }
    assert_eq!(with.state_numbers(), without.state_numbers());
}

/// Two masses m and M on a spring: six rigid modes, and √(k·(1/m + 1/M)) along and about each axis.
#[test]
fn two_free_bodies_on_a_spring_have_six_rigid_modes() {
    let mut simulation = Simulation::new(empty_world(), Integrator::RungeKutta4, 1e-3).unwrap();
    let mut body = |name: &str, mass: f64, inertia: f64| {
        let properties = MassProperties::principal(mass, [inertia; 3]);
        simulation.add_body(RigidBody::free(name, properties).at(Pose::identity())).unwrap()
    };
    let (light, heavy) = (body("light", 2.0, 0.3), body("heavy", 5.0, 0.7));
    let on = |body: BodyId| SpringEnd::on(body, Pose::identity());
    let stiffness = [1e3, 2e3, 3e3, 40.0, 50.0, 60.0];
    let damping = [4.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    simulation.add_spring(Spring::new(on(light), on(heavy), stiffness).damped(damping)).unwrap();
    let linear = simulation.linearised().unwrap();
    let modes = linear.system.modes(1e-7).unwrap().modes;
    let (linear_part, angular_part) = (1.0 / 2.0 + 1.0 / 5.0, 1.0 / 0.3 + 1.0 / 0.7);
    let mut wanted: Vec<f64> =
        (0..6).map(|i| stiffness[i] * if i < 3 { linear_part } else { angular_part }).collect();
    wanted.sort_by(f64::total_cmp);
    assert!(modes[..6].iter().all(|mode| mode.kind == ModeKind::Rigid), "{modes:?}");
    for (mode, wanted) in modes[6..].iter().zip(&wanted) {
        assert!((mode.rate / wanted - 1.0).abs() < 1e-8, "{} for {wanted}", mode.rate);
        assert!((mode.shares[0] - 1.0).abs() < 1e-12);
    }
    let along_x = modes.iter().find(|mode| (mode.rate / 700.0 - 1.0).abs() < 1e-8).unwrap();
    let ratio = 4.0 * linear_part / (2.0 * 700.0_f64.sqrt());
    assert!((along_x.damping_ratio.unwrap() - ratio).abs() < 1e-8);
}

/// A body with K = k·[1 b; −b 1] in two directions: s² = −(k/m)·(1 ± ib), which grows for every b.
#[test]
fn unsymmetric_stiffness_is_reported_as_flutter() {
    let body =
        || LinearBody { name: "body".to_owned(), mass: 2.0, inertia: Mat3::identity(), arm: Vec3::zeros() };
    let mut system = LinearSystem::new(vec![body()]).unwrap();
    let mut stiffness = TangentMatrix::from_diagonal_element(800.0);
    (stiffness[(0, 1)], stiffness[(1, 0)]) = (80.0, -80.0);
    let none = TangentMatrix::zeros();
    system.add([Some(0), None], &[[stiffness, none], [none; 2]], &[[none; 2]; 2]);
    let modes = system.modes(1e-10).unwrap();
    let root = nalgebra::Complex::new(-400.0, 40.0).sqrt();
    let [growth] = modes.growths[..] else { panic!("{:?}", modes.growths) };
    assert!(
        (growth.rate / root.re - 1.0).abs() < 1e-9 && (growth.frequency * TAU / root.im - 1.0).abs() < 1e-9
    );
    assert!(modes.modes.iter().any(|mode| mode.damping_ratio.is_some_and(|ratio| ratio < -0.01)));
    let bad = LinearSystem::new(vec![LinearBody { mass: 0.0, ..body() }]).unwrap_err().to_string();
    assert!(bad.contains("its mass is 0 kg"), "{bad}");
}
