//! Springs, loads and prescribed motion against closed forms.

use crate::common::empty_world;
use pong_executive::{
    Axes, BodyId, Integrator, Load, LoadHistory, LoadRow, MassProperties, Oscillation, Path, PathRow,
    PathTable, Pose, Quat, RigidBody, Simulation, Spring, SpringEnd, Twist, Vec3, Wrench,
};

const IDENTITY: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

/// Mass 2 kg on 50 N/m: ω = 5 rad/s, released 1 m away.
fn oscillator(integrator: Integrator, step: f64) -> (Simulation, BodyId) {
    let mut simulation = Simulation::new(empty_world(), integrator, step).unwrap();
    let body = RigidBody::free("mass", MassProperties::sphere(2.0, 0.1));
    let body = simulation.add_body(body.at(Pose::new(Vec3::x(), IDENTITY))).unwrap();
    let ends = (SpringEnd::ground(Pose::identity()), SpringEnd::on(body, Pose::identity()));
    simulation.add_spring(Spring::new(ends.0, ends.1, [50.0, 0.0, 0.0, 0.0, 0.0, 0.0])).unwrap();
    (simulation, body)
}

fn position_error(integrator: Integrator, step: f64) -> f64 {
    let (mut simulation, body) = oscillator(integrator, step);
    simulation.run_for(2.0).unwrap();
    (simulation.pose(body).position.x - 10.0_f64.cos()).abs()
}

#[test]
fn an_oscillator_converges_at_the_order_of_its_integrator() {
    let order = |integrator, h| (position_error(integrator, h) / position_error(integrator, h / 2.0)).log2();
    let first = order(Integrator::SemiImplicitEuler, 1.0 / 512.0);
    assert!((first - 1.0).abs() < 0.1, "order {first}");
    let fourth = order(Integrator::RungeKutta4, 1.0 / 64.0);
    assert!((fourth - 4.0).abs() < 0.1, "order {fourth}");
}

#[test]
fn semi_implicit_euler_keeps_its_own_invariant() {
    // ½mv² + ½kx² − ½h·k·x·v is constant, so the energy only ripples, by ½hω.
    let (mut simulation, body) = oscillator(Integrator::SemiImplicitEuler, 0.01);
    let invariant = |s: &Simulation| {
        let (x, v) = (s.pose(body).position.x, s.twist(body).linear.x);
        v * v + 25.0 * x * x - 0.01 * 25.0 * x * v
    };
    let (start, energy) = (invariant(&simulation), simulation.energy().mechanical());
    let mut ripple = 0.0_f64;
    for _ in 0..100_000 {
        simulation.step().unwrap();
        ripple = ripple.max((simulation.energy().mechanical() / energy - 1.0).abs());
    }
    assert!((invariant(&simulation) / start - 1.0).abs() < 1e-10);
    assert!(ripple < 0.5 * 0.01 * 5.0 * 1.1, "{ripple}");
}

#[test]
fn a_damped_oscillator_dies_by_its_closed_form_and_the_heat_is_counted() {
    let (mut simulation, body) = oscillator(Integrator::RungeKutta4, 1e-3);
    simulation.clear_springs();
    let ends = (SpringEnd::ground(Pose::identity()), SpringEnd::on(body, Pose::identity()));
    let mut spring = Spring::new(ends.0, ends.1, [50.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    spring.damping[0] = 4.0;
    spring.preload[0] = 5.0;
    simulation.add_spring(spring).unwrap();
    let start = simulation.energy().balance();
    simulation.run_for(1.5).unwrap();
    // m = 2, c = 4: decay 1/s, ω_d = √24; rest at 5/50 m.
    let (w, t) = (24.0_f64.sqrt(), 1.5_f64);
    let expected = 0.1 + 0.9 * (-t).exp() * ((w * t).cos() + (w * t).sin() / w);
    assert!((simulation.pose(body).position.x - expected).abs() < 1e-10);
    let energy = simulation.energy();
    assert!(energy.spring_loss > 10.0);
    assert!((energy.balance() / start - 1.0).abs() < 1e-5, "{energy:?}");
}

/// Two bodies joined by a stiff anisotropic spring, off centre, rotated far from rest.
fn tangled(step: f64) -> Simulation {
    let mut simulation = Simulation::new(empty_world(), Integrator::RungeKutta4, step).unwrap();
    let mass = MassProperties::principal(2.0, [0.2, 0.3, 0.4]).with_mass_center(Vec3::new(0.1, 0.0, -0.2));
    let turned = Pose::new(Vec3::new(0.6, -0.3, 0.8), [0.5, 0.7, -0.4, 0.3]);
    let a = simulation.add_body(RigidBody::free("a", mass)).unwrap();
    let twist = Twist { linear: Vec3::new(0.1, 0.5, 0.0), angular: Vec3::new(0.0, 0.3, 1.0) };
    let b = RigidBody::free("b", MassProperties::sphere(1.0, 0.5)).at(turned).moving(twist);
    let b = simulation.add_body(b).unwrap();
    let frame_a = Pose::new(Vec3::new(0.2, 0.1, 0.0), [0.9, 0.1, 0.3, -0.2]);
    let frame_b = Pose::new(Vec3::new(-0.1, 0.0, 0.3), [0.7, -0.5, 0.1, 0.2]);
    let stiffness = [30.0, 50.0, 80.0, 1.0, 2.0, 4.0];
    let mut spring = Spring::new(SpringEnd::on(a, frame_a), SpringEnd::on(b, frame_b), stiffness);
    spring.preload = [1.0, -2.0, 3.0, 0.1, 0.2, -0.3];
    spring.rest = Pose::new(Vec3::new(0.1, 0.2, 0.3), [0.9, 0.2, 0.0, 0.1]);
    simulation.add_spring(spring).unwrap();
    simulation
}

fn total_momentum(simulation: &Simulation) -> (Vec3, Vec3) {
    let mut total = (Vec3::zeros(), Vec3::zeros());
    for (id, body) in simulation.bodies() {
        let (place, velocity) = simulation.mass_center(id).unwrap();
        let momentum = velocity * body.mass().unwrap().mass;
        total.0 += momentum;
        total.1 += place.cross(&momentum) + simulation.angular_momentum(id).unwrap();
    }
    total
}

#[test]
fn a_spring_between_bodies_keeps_energy_and_both_momenta_at_large_angles() {
    let mut simulation = tangled(5e-4);
    let (energy, momentum) = (simulation.energy().balance(), total_momentum(&simulation));
    // A little later the joint exceeds half a turn, where the rotation vector is not continuous.
    simulation.run_for(1.0).unwrap();
    let after = total_momentum(&simulation);
    assert!(
        (simulation.energy().balance() - energy).abs() < 1e-8,
        "{} J",
        simulation.energy().balance() - energy
    );
    assert!((after.0 - momentum.0).norm() < 1e-12);
    // x × p is no linear function of the state: it is kept only to the order of the method, here far below
    // 1e-9.
    assert!((after.1 - momentum.1).norm() < 1e-10, "{}", (after.1 - momentum.1).norm());
}

#[test]
fn a_torsion_spring_swings_at_its_frequency() {
    let mut simulation = Simulation::new(empty_world(), Integrator::RungeKutta4, 1e-3).unwrap();
    let turned = Pose { position: Vec3::zeros(), orientation: Quat::from_scaled_axis(Vec3::z() * 2.0) };
    let disc = RigidBody::free("disc", MassProperties::principal(1.0, [0.5, 0.5, 0.8])).at(turned);
    let disc = simulation.add_body(disc).unwrap();
    let ends = (SpringEnd::ground(Pose::identity()), SpringEnd::on(disc, Pose::identity()));
    simulation.add_spring(Spring::new(ends.0, ends.1, [0.0, 0.0, 0.0, 0.0, 0.0, 7.2])).unwrap();
    simulation.run_for(2.0).unwrap();
    // ω = √(7.2/0.8) = 3, released at 2 rad: linear at any angle.
    let angle = simulation.pose(disc).orientation.scaled_axis().z;
    assert!((angle - 2.0 * 6.0_f64.cos()).abs() < 1e-9, "{angle}");
}

#[test]
fn loads_act_at_their_point_along_their_axes_and_their_work_is_counted() {
    let mut simulation = Simulation::new(empty_world(), Integrator::RungeKutta4, 1e-3).unwrap();
    let rod = RigidBody::free("rod", MassProperties::principal(2.0, [1.0, 1.0, 1.5]));
    let rod = simulation.add_body(rod).unwrap();
    let wrench = Wrench { force: Vec3::zeros(), moment: Vec3::new(0.0, 0.0, 0.5) };
    let rows = [(0.0, 0.0), (1.0, 3.0), (2.0, 3.0)]
        .map(|(time, force)| LoadRow { time, wrench: Wrench { force: Vec3::y() * force, ..wrench } });
    let (axes, history) = (Axes::Body, LoadHistory::Table(rows.to_vec()));
    simulation.add_load(Load { body: rod, point: Vec3::new(2.0, 0.0, 0.0), axes, history }).unwrap();
    simulation.run_for(2.0).unwrap();
    // ∫(2·F + 0.5)dt = 2·(1.5 + 3) + 1 over I = 1.5.
    assert!((simulation.twist(rod).angular.z - 10.0 / 1.5).abs() < 1e-12);
    let energy = simulation.energy();
    assert!((energy.work_in / energy.kinetic - 1.0).abs() < 1e-5, "{energy:?}");
}

/// Loads are about the group's origin, bodies rotate about their mass centre: a force through it causes no
/// rotation, one at the origin does by its lever.
#[test]
fn a_force_turns_about_the_mass_centre() {
    let center = Vec3::new(0.5, -0.2, 0.1);
    let mass = MassProperties::cuboid(3.0, [0.2, 0.4, 0.6]).with_mass_center(center);
    let force = Vec3::new(0.3, -1.1, 2.0);
    let pushed = |point: Vec3, step: f64, duration: f64| {
        let mut simulation = Simulation::new(empty_world(), Integrator::RungeKutta4, step).unwrap();
        let body = simulation.add_body(RigidBody::free("body", mass)).unwrap();
        simulation.add_load(Load { point, ..Load::force(body, force) }).unwrap();
        simulation.run_for(duration).unwrap();
        (simulation.pose(body), simulation.twist(body))
    };
    let (pose, twist) = pushed(center, 0.01, 1.0);
    assert!(pose.orientation.angle() < 1e-15 && twist.angular.norm() < 1e-15, "{twist:?}");
    assert!((pose.position - force * (0.5 / 3.0)).norm() < 1e-14);
    let (_, twist) = pushed(Vec3::zeros(), 1e-6, 1e-6);
    let expected = mass.inertia.try_inverse().unwrap() * -center.cross(&force) * 1e-6;
    assert!((twist.angular - expected).norm() < 1e-9 * expected.norm(), "{twist:?}");
}

/// Checks that the twist is the derivative of the pose.
fn assert_consistent(path: &Path, times: &[f64], tolerance: f64) {
    let h = 1e-5;
    for &time in times {
        let ((before, _), (_, twist), (after, _)) = (path.at(time - h), path.at(time), path.at(time + h));
        let linear = (after.position - before.position) / (2.0 * h);
        let angular = (after.orientation * before.orientation.inverse()).scaled_axis() / (2.0 * h);
        assert!((linear - twist.linear).norm() < tolerance, "{path:?} at {time}");
        assert!(
            (angular - twist.angular).norm() < tolerance,
            "{path:?} at {time}: {angular} {}",
            twist.angular
        );
    }
}

fn winding_table() -> Vec<PathRow> {
    let row = |time, x: f64, q| PathRow { time, pose: Pose::new(Vec3::new(x, x * x, -x), q) };
    vec![
        row(0.0, 0.0, IDENTITY),
        row(1.0, 0.4, [0.9, 0.3, -0.1, 0.2]),
        row(1.5, 1.0, [0.5, 0.5, 0.6, 0.1]),
        row(3.0, 0.7, [-0.5, -0.5, -0.6, 0.3]),
    ]
}

#[test]
fn prescribed_twists_are_the_derivatives_of_prescribed_poses() {
    let pose = Pose::new(Vec3::new(1.0, 2.0, 3.0), [0.9, 0.1, -0.4, 0.2]);
    let twist = Twist { linear: Vec3::new(1.0, -2.0, 0.5), angular: Vec3::new(0.5, 0.2, -1.0) };
    let times = [0.1, 0.5, 1.2, 2.9];
    assert_consistent(&Path::ConstantTwist { pose, twist }, &times, 1e-8);
    let axis = Vec3::new(0.6, 0.0, 0.8);
    let oscillation = Oscillation { pose, axis, travel: 0.2, angle: 0.7, frequency: 0.8, phase: 0.3 };
    assert_consistent(&Path::Oscillation(oscillation), &times, 1e-7);
    let table = Path::Table(PathTable::new(&winding_table()).unwrap());
    assert_consistent(&table, &[0.1, 0.5, 0.999, 1.2, 2.9], 1e-7);
    // Accelerations are discontinuous at the rows, velocities are not.
    assert_consistent(&table, &[1.0, 1.5], 1e-3);
}

#[test]
fn a_table_goes_through_its_rows_and_keeps_a_constant_rate() {
    let rows = winding_table();
    let table = Path::Table(PathTable::new(&rows).unwrap());
    for row in &rows {
        let (pose, _) = table.at(row.time);
        assert!((pose.position - row.pose.position).norm() < 1e-15);
        assert!(pose.orientation.angle_to(&row.pose.orientation) < 1e-7);
    }
    assert_eq!(table.at(-1.0).1, Twist::zero());
    let steady = [0.0, 0.7, 1.0, 2.5].map(|time| PathRow {
        time,
        pose: Pose { position: Vec3::y() * time, orientation: Quat::from_scaled_axis(Vec3::x() * time) },
    });
    let (pose, twist) = Path::Table(PathTable::new(&steady).unwrap()).at(1.9);
    assert!((twist.linear - Vec3::y()).norm() < 1e-13 && (twist.angular - Vec3::x()).norm() < 1e-13);
    assert!((pose.orientation.scaled_axis() - Vec3::x() * 1.9).norm() < 1e-13);
}

#[test]
fn a_prescribed_body_moves_in_the_simulation_and_its_work_is_counted() {
    let mut simulation = Simulation::new(empty_world(), Integrator::RungeKutta4, 1e-3).unwrap();
    let twist = Twist { linear: Vec3::x() * 0.5, angular: Vec3::zeros() };
    let path = Path::ConstantTwist { pose: Pose::identity(), twist };
    let tug = simulation.add_body(RigidBody::prescribed("tug", path)).unwrap();
    let load = simulation.add_body(RigidBody::free("load", MassProperties::sphere(1.0, 0.1))).unwrap();
    let ends = (SpringEnd::on(tug, Pose::identity()), SpringEnd::on(load, Pose::identity()));
    simulation.add_spring(Spring::new(ends.0, ends.1, [100.0, 100.0, 100.0, 0.0, 0.0, 0.0])).unwrap();
    simulation.run_for(1.0).unwrap();
    assert!((simulation.pose(tug).position.x - 0.5).abs() < 1e-15);
    // Seen from the tug the load is an oscillator (ω = 10) that starts with −0.5 m/s.
    let expected = 0.5 - 0.05 * 10.0_f64.sin();
    assert!((simulation.pose(load).position.x - expected).abs() < 1e-9);
    assert!(simulation.energy().work_in > 1e-3);
    assert!(simulation.energy().balance().abs() < 1e-5, "{:?}", simulation.energy());
}

#[test]
fn unusable_things_are_refused_by_name() {
    let mut simulation = Simulation::new(empty_world(), Integrator::RungeKutta4, 1e-3).unwrap();
    let bad = simulation.add_body(RigidBody::free("brick", MassProperties::principal(1.0, [1.0, 1.0, 3.0])));
    assert!(bad.unwrap_err().to_string().contains("brick"));
    let body = simulation.add_body(RigidBody::fixed("wall")).unwrap();
    let end = SpringEnd::on(body, Pose::identity());
    assert!(simulation.add_spring(Spring::new(end, end, [1.0; 6])).is_err());
    assert!(Simulation::new(empty_world(), Integrator::RungeKutta4, 0.0).is_err());
    assert!(PathTable::new(&winding_table()[..1]).is_err());
}

#[test]
fn a_body_that_runs_away_is_reported() {
    let (mut simulation, _) = oscillator(Integrator::RungeKutta4, 10.0);
    let error = simulation.run_for(1e5).unwrap_err();
    assert!(error.to_string().contains("`mass`"), "{error}");
}

#[test]
fn another_mass_and_another_spring_swing_at_their_own_frequency() {
    let (mut simulation, body) = oscillator(Integrator::RungeKutta4, 1e-3);
    simulation.set_mass(body, MassProperties::sphere(8.0, 0.1)).unwrap();
    simulation.run_for(2.0).unwrap();
    // 50 N/m and 8 kg: ω = 2.5 rad/s.
    let (x, v) = (5.0_f64.cos(), -2.5 * 5.0_f64.sin());
    assert!((simulation.pose(body).position.x - x).abs() < 1e-9);
    // In flight pose and twist stay, and the motion goes on from there: 200 N/m and 2 kg, ω = 10 rad/s.
    simulation.set_mass(body, MassProperties::sphere(2.0, 0.1)).unwrap();
    let spring = Spring { stiffness: [200.0, 0.0, 0.0, 0.0, 0.0, 0.0], ..simulation.springs()[0] };
    simulation.set_spring(0, spring).unwrap();
    assert!((simulation.twist(body).linear.x - v).abs() < 1e-8);
    simulation.run_for(0.5).unwrap();
    let expected = x * 5.0_f64.cos() + v / 10.0 * 5.0_f64.sin();
    assert!((simulation.pose(body).position.x - expected).abs() < 1e-7);
}

#[test]
fn a_body_that_turns_keeps_its_angular_velocity_when_its_inertia_changes() {
    let mut simulation = Simulation::new(empty_world(), Integrator::RungeKutta4, 1e-3).unwrap();
    let spin = Vec3::new(0.3, -0.4, 0.5);
    let turned = Pose::new(Vec3::new(1.0, 2.0, 3.0), [0.5, 0.7, -0.4, 0.3]);
    let body = RigidBody::free("body", MassProperties::principal(2.0, [0.2, 0.3, 0.4]));
    let body =
        simulation.add_body(body.at(turned).moving(Twist { linear: Vec3::x(), angular: spin })).unwrap();
    let mass = MassProperties::principal(3.0, [0.5, 0.6, 0.4]).with_mass_center(Vec3::new(0.1, 0.0, -0.2));
    simulation.set_mass(body, mass).unwrap();
    simulation.commit_initial_states().unwrap();
    let twist = simulation.twist(body);
    assert!((twist.angular - spin).norm() < 1e-14 && (twist.linear - Vec3::x()).norm() < 1e-14);
    assert!((simulation.pose(body).position - turned.position).norm() < 1e-14);
    // L = R·I·Rᵀ·ω with the new tensor.
    let rotation = turned.orientation.to_rotation_matrix();
    let momentum = rotation * mass.inertia * rotation.transpose() * spin;
    assert!((simulation.angular_momentum(body).unwrap() - momentum).norm() < 1e-14);
}

#[test]
fn masses_and_springs_that_cannot_be_are_refused_and_change_nothing() {
    let (mut simulation, body) = oscillator(Integrator::RungeKutta4, 1e-3);
    let fixed = simulation.add_body(RigidBody::fixed("wall")).unwrap();
    let refused = |result: Result<(), pong_executive::ExecutiveError>, words: &str| {
        let message = result.unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    };
    refused(simulation.set_mass(body, MassProperties::sphere(-1.0, 0.1)), "the mass is -1 kg");
    refused(simulation.set_mass(fixed, MassProperties::sphere(1.0, 0.1)), "body `wall`: it is not free");
    let spring = simulation.springs()[0];
    refused(simulation.set_spring(1, spring), "there are 1 springs");
    refused(simulation.set_spring(0, Spring { stiffness: [-1.0; 6], ..spring }), "stiffness is below zero");
    assert_eq!(simulation.springs(), [spring]);
    simulation.run_for(2.0).unwrap();
    assert!((simulation.pose(body).position.x - 10.0_f64.cos()).abs() < 1e-9);
}

/// A link of 1 kg whose hinge consists of springs, to a fixed base; its stiffest mode, computed by hand, is
/// that of the lever: k·(1/m + l²/I), 4 times that of the mass alone.
#[test]
fn springs_of_the_scene_count_for_the_step() {
    let link = |integrator, step: f64| {
        let mut simulation = Simulation::new(empty_world(), integrator, step).unwrap();
        let body = RigidBody::free("link", MassProperties::principal(1.0, [1.0 / 12.0; 3]));
        let body = simulation.add_body(body.at(Pose::new(Vec3::x() * 0.5, IDENTITY))).unwrap();
        let hinge = SpringEnd::on(body, Pose::new(Vec3::x() * -0.5, IDENTITY));
        let stiffness = [1e7, 1e7, 1e7, 0.0, 0.0, 0.0];
        simulation.add_spring(Spring::new(SpringEnd::ground(Pose::identity()), hinge, stiffness)).unwrap();
        let moving = Twist { linear: Vec3::zeros(), angular: Vec3::z() * 1e-3 };
        simulation.set_motion(body, simulation.pose(body), moving).unwrap();
        simulation
    };
    let omega = (1e7_f64 * 4.0).sqrt();
    for (integrator, limit) in
        [(Integrator::SemiImplicitEuler, 2.0), (Integrator::RungeKutta4, 8.0_f64.sqrt())]
    {
        let step = limit / omega;
        let simulation = link(integrator, 1.1 * step);
        let told = simulation.step_report(&simulation.step_plan()).unwrap().surely_stable_step();
        assert!((told / step - 1.0).abs() < 1e-2, "{integrator}: {told} {step}");
        let notes = simulation.step_notes();
        assert!(notes.len() == 1 && notes[0].contains("its springs ask for that"), "{notes:?}");
        let mut sure = link(integrator, 0.99 * told);
        assert!(sure.step_notes().is_empty());
        (0..3000).for_each(|_| sure.step().unwrap());
        assert!(sure.energy().mechanical() < 1.0, "{integrator}");
        let mut run = link(integrator, 1.6 * told);
        let error = (0..3000).find_map(|_| run.step().err()).expect("it diverges").to_string();
        assert!(error.contains("the spring of `the ground` and `link`"), "{integrator}: {error}");
    }
}

/// The bound of springs between two bodies against all their modes, in any poses: never below the largest
/// eigenvalue, and not far above.
#[test]
fn the_bound_of_springs_is_above_every_mode() {
    let mut random = pong_testkit::Random(0x5b71);
    let mut shares = Vec::new();
    for number in 0..200 {
        let mut simulation = Simulation::new(empty_world(), Integrator::SemiImplicitEuler, 1e-6).unwrap();
        let bodies = [0, 1].map(|i| {
            let moments = Vec3::from_fn(|_, _| random.between(1.0, 1.9)) * random.log_between(1e-3, 1.0);
            let mass = MassProperties::principal(random.log_between(0.1, 10.0), moments.into());
            let mass = mass.with_mass_center(random.vector(0.3));
            let pose = Pose { position: random.vector(1.0), orientation: random.orientation() };
            simulation.add_body(RigidBody::free(&format!("b{i}"), mass).at(pose)).unwrap()
        });
        let frame = |random: &mut pong_testkit::Random| Pose {
            position: random.vector(0.3),
            orientation: random.orientation(),
        };
        for _ in 0..=random.below(2) {
            // The rest pose is the present one, so that nothing is stretched.
            let (first, second) = (frame(&mut random), frame(&mut random));
            let in_common = |i: usize, frame: &Pose| simulation.pose(bodies[i]).compose(frame);
            let rest = in_common(0, &first).inverse().compose(&in_common(1, &second));
            let stiffness = std::array::from_fn(|axis| {
                let scale = if axis < 3 { 1e5 } else { 1e3 };
                if random.chance(0.3) { 0.0 } else { scale * random.log_between(0.1, 10.0) }
            });
            let ends = (SpringEnd::on(bodies[0], first), SpringEnd::on(bodies[1], second));
            simulation.add_spring(Spring { rest, ..Spring::new(ends.0, ends.1, stiffness) }).unwrap();
        }
        // Semi-implicit Euler without damping: the reported step is 2/√λ.
        let told = simulation.step_report(&simulation.step_plan()).unwrap().surely_stable_step();
        let bound = (2.0 / told) * (2.0 / told);
        let largest = largest_mode(&mut simulation, bodies);
        if largest > 0.0 {
            assert!(bound >= largest * (1.0 - 1e-6), "{number}: {bound} {largest}");
            shares.push((largest / bound).sqrt());
        }
    }
    shares.sort_by(f64::total_cmp);
    println!("told over true: median {:.3}, worst {:.3}", shares[shares.len() / 2], shares[0]);
    assert!(shares[shares.len() / 2] > 0.5);
}

/// ω² of the fastest mode, by power iteration of the numerical derivative of momentum rate by position.
fn largest_mode(simulation: &mut Simulation, bodies: [BodyId; 2]) -> f64 {
    let start = simulation.state_numbers();
    let half = start.len() / 2;
    let count = 12;
    let mut matrix = vec![[0.0_f64; 12]; count];
    let tiny = 1e-6;
    let inverse = bodies.map(|body| {
        let mass = *simulation.bodies().nth(body.index()).unwrap().1.mass().unwrap();
        let turn = simulation.pose(body).orientation.to_rotation_matrix().into_inner();
        (mass.mass, turn * mass.inertia.try_inverse().unwrap() * turn.transpose())
    });
    #[expect(clippy::needless_range_loop, reason = "a column of every row")]
    for column in 0..count {
        let (body, axis) = (column / 6, column % 6);
        let answers = [-tiny, tiny].map(|by| {
            let mut moved = start.clone();
            let at = body * half;
            if axis < 3 {
                moved[at + axis] += by;
            } else {
                let q = Quat::new_normalize(nalgebra_quaternion(&start[at + 6..at + 10]));
                let mut about = Vec3::zeros();
                about[axis - 3] = by;
                let q = Quat::from_scaled_axis(about) * q;
                moved[at + 6..at + 10].copy_from_slice(&[q.w, q.i, q.j, q.k]);
            }
            let mut rates = vec![0.0; start.len()];
            simulation.try_states(0.0, &moved, &mut rates).unwrap();
            rates
        });
        for row in 0..2 {
            let at = row * half;
            let change = |i: usize| (answers[1][at + i] - answers[0][at + i]) / (2.0 * tiny);
            let moment = Vec3::new(change(10), change(11), change(12));
            let spin = inverse[row].1 * moment;
            for axis in 0..3 {
                matrix[6 * row + axis][column] = -change(3 + axis);
                matrix[6 * row + 3 + axis][column] = -spin[axis];
            }
        }
    }
    let mut x = [1.0_f64; 12];
    let mut value = 0.0;
    for _ in 0..4000 {
        let y: Vec<f64> = matrix.iter().map(|row| row.iter().zip(&x).map(|(a, b)| a * b).sum()).collect();
        value = y.iter().map(|v| v * v).sum::<f64>().sqrt();
        if value == 0.0 {
            return 0.0;
        }
        x = std::array::from_fn(|i| y[i] / value);
    }
    value
}

fn nalgebra_quaternion(wxyz: &[f64]) -> nalgebra::Quaternion<f64> {
    nalgebra::Quaternion::new(wxyz[0], wxyz[1], wxyz[2], wxyz[3])
}
