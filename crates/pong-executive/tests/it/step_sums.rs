//! Contacts that act together need shorter steps than any of them alone: at 0.99 times the step that the
//! adviser calls surely stable no disturbance grows, at 1.01 times it every disturbance does. The scenes are
//! chosen so that the bound is exact.

use pong_engine::Config;
use pong_executive::{BodyId, Integrator, MassProperties, Pose, RigidBody, Simulation, Twist, Vec3};
use pong_testkit::ron;
use pong_testkit::worlds::paired_with_first;

const EULER: Integrator = Integrator::SemiImplicitEuler;
const KUTTA: Integrator = Integrator::RungeKutta4;
const HELD: Integrator = Integrator::ZeroOrderHold { substeps: 1, delay_frames: 0 };

fn model(name: &str, surface: &str, primitives: &str) -> String {
    ron::model(name, &format!("\"s\": ({surface})"), primitives)
}

fn plane(name: &str, up: f64) -> String {
    model(name, "stiffness: inf", &format!(r#"Plane(name: "p", normal: (0, 0, {up:?}), offset: 0)"#))
}

/// A free body between or on Objects that are fixed at some heights, in equilibrium except for a twist.
struct Rig {
    simulation: Simulation,
    body: BodyId,
    rest: Pose,
    integrator: Integrator,
}

impl Rig {
    fn new(
        body: &str,
        others: &[(String, f64)],
        mass: MassProperties,
        load: Vec3,
        (integrator, step): (Integrator, f64),
        rest: Pose,
        twist: Twist,
    ) -> Self {
        let texts: Vec<&str> =
            std::iter::once(body).chain(others.iter().map(|(text, _)| text.as_str())).collect();
        let (world, _, interfaces) = paired_with_first(Config::default(), &texts);
        let mut simulation = Simulation::new(world, integrator, step).unwrap();
        simulation.set_gravity(load / mass.mass);
        let moving = RigidBody::free("body", mass).at(rest).moving(twist).touching(interfaces[0]);
        let body = simulation.add_body(moving).unwrap();
        for (i, (_, height)) in (1..).zip(others) {
            let at = Pose { position: Vec3::z() * *height, ..Pose::identity() };
            let fixed = RigidBody::fixed(&format!("f{i}")).at(at).touching(interfaces[i]);
            simulation.add_body(fixed).unwrap();
        }
        Self { simulation, body, rest, integrator }
    }

    /// Distance from rest, m and rad.
    fn off(&self) -> f64 {
        let pose = self.simulation.pose(self.body);
        (pose.position - self.rest.position).norm().max(pose.orientation.angle_to(&self.rest.orientation))
    }

    /// True if a disturbance grows a hundredfold within 4,000 steps.
    fn grows(&mut self) -> bool {
        let mut first = 0.0_f64;
        for step in 0..4000 {
            self.simulation.step().unwrap();
            let off = self.off();
            if step < 20 {
                first = first.max(off);
            } else if off > 100.0 * first {
                return true;
            }
        }
        false
    }

    /// Checks 0.99 and 1.01 of the reported step: growth has a note, and without a note there is no growth.
    fn holds_to(step: f64, make: impl Fn(f64) -> Self) {
        let rig = make(step);
        let plan = rig.simulation.step_plan();
        let report = rig.simulation.step_report(&plan).unwrap();
        let told = report.surely_stable_step();
        // The growth of Runge-Kutta is flat at its limit, which is found by search.
        assert!((told / step - 1.0).abs() < 1e-5, "{:?}: told {told}, expected {step}", rig.integrator);
        assert!(report.stable_step() > 1.1 * step, "one contact alone is not what limits: {report:?}");
        for (factor, unstable) in [(0.99, false), (1.01, true)] {
            let mut rig = make(factor * step);
            assert_eq!(rig.simulation.step_notes().len(), usize::from(unstable), "{:?}", rig.integrator);
            assert_eq!(rig.simulation.step_warnings(), [""; 0]);
            rig.simulation.commit_initial_states().unwrap();
            let acting = rig.simulation.acting_report(&plan).unwrap();
            assert!((acting.stable_step / step - 1.0).abs() < 1e-5, "{:?}: {acting:?}", rig.integrator);
            assert_eq!(rig.grows(), unstable, "{:?} at {factor} of {step} s", rig.integrator);
        }
    }
}

/// Feet of k and c at the corners of a square of half diagonal R below the mass centre.
fn table((k, c): (f64, f64), inertia: f64, twist: Twist, how: (Integrator, f64)) -> Rig {
    let at = [(R, 0.0), (0.0, R), (-R, 0.0), (0.0, -R)];
    let feet = at.map(|(x, y)| format!(r#"Point(name: "p{x}{y}", position: ({x:?}, {y:?}, 0)),"#));
    let surface = format!("stiffness: {k:?}, normal: Linear(damping: {c:?})");
    let body = model("table", &surface, &feet.concat());
    let mass = MassProperties::principal(MASS, [inertia, inertia, 1.5 * inertia]);
    // Deep enough to keep all feet down.
    let depth = 1e-2;
    let rest = Pose { position: Vec3::z() * -depth, ..Pose::identity() };
    Rig::new(&body, &[(plane("floor", 1.0), 0.0)], mass, Vec3::z() * (-4.0 * k * depth), how, rest, twist)
}

const R: f64 = 0.5;
const MASS: f64 = 3.0;
const K: f64 = 1e6;

/// Heave: ω² = 4k/m, with so much inertia that rocking does not come first.
#[test]
fn four_feet_heave_at_the_fourfold_stiffness() {
    let up = Twist { linear: Vec3::z() * 1e-6, angular: Vec3::zeros() };
    let omega = (4.0 * K / MASS).sqrt();
    for (integrator, limit) in [(EULER, 2.0), (KUTTA, 8.0_f64.sqrt())] {
        Rig::holds_to(limit / omega, |step| table((K, 0.0), 1e3, up, (integrator, step)));
    }
}

/// Rocking: two feet at R on either side, ω² = 2kR²/I; the height of the mass centre has no effect without
/// friction.
#[test]
fn four_feet_rock_by_their_lever() {
    let turn = Twist { linear: Vec3::zeros(), angular: Vec3::x() * 1e-6 };
    let inertia = 0.1;
    let omega = (2.0 * K * R * R / inertia).sqrt();
    assert!(omega > (4.0 * K / MASS).sqrt());
    Rig::holds_to(2.0 / omega, |step| table((K, 0.0), inertia, turn, (EULER, step)));
}

/// Four dampers of c on one mass: held over a frame they are stable to 2m/(4c), one alone to four times that.
#[test]
fn dampers_of_held_wrenches_add() {
    let up = Twist { linear: Vec3::z() * 1e-6, angular: Vec3::zeros() };
    let (k, c) = (1e4, 1e3);
    Rig::holds_to(2.0 * MASS / (4.0 * c), |step| table((k, c), 1e3, up, (HELD, step)));
}

/// A ball between floor and ceiling, of k and 3k: ω² = 4k/m.
#[test]
fn a_ball_between_two_partners_has_both_springs() {
    let up = Twist { linear: Vec3::z() * 1e-6, angular: Vec3::zeros() };
    let make = |how| {
        let ball = model("ball", "stiffness: inf", r#"Sphere(name: "s", center: (0, 0, 0), radius: 0.1)"#);
        let soft = |name, up, k: f64| plane(name, up).replace("stiffness: inf", &format!("stiffness: {k:?}"));
        let mass = MassProperties::principal(MASS, [1e3; 3]);
        let rest = Pose { position: Vec3::z() * 0.097, ..Pose::identity() };
        // 3 mm deep in the floor, 1 mm in the ceiling: the forces of k and 3k are equal.
        let others = [(soft("floor", 1.0, K), 0.0), (soft("ceiling", -1.0, 3.0 * K), 0.196)];
        Rig::new(&ball, &others, mass, Vec3::zeros(), how, rest, up)
    };
    Rig::holds_to(2.0 / (4.0 * K / MASS).sqrt(), |step| make((EULER, step)));
}
