//! Promises of the step adviser, checked with engine and executive: a hundred random contacts, every
//! coupling.

use pong_advise::{
    Accuracy, ContactAdvice, ContactWish, GroupMass, StepPlan, StepWarning, WrenchCoupling, advise_contact,
    step_report,
};
use pong_engine::{Config, World};
use pong_executive::{Integrator, MassProperties, Pose, RigidBody, Simulation, Twist, Vec3};
use pong_testkit::Random;
use pong_testkit::worlds::paired_with_first;

const GROUND: &str = r#"(format: "pong-model", version: 1, name: "ground",
    surfaces: { "rigid": (stiffness: inf, friction: Bristle(mu: 0.5)) },
    root: (name: "ground", surface: "rigid", primitives: [
        Plane(name: "floor", normal: (0.0, 0.0, 1.0), offset: 0.0)]))"#;

const COUPLINGS: [WrenchCoupling; 5] = [
    WrenchCoupling::Stages,
    WrenchCoupling::SemiImplicit,
    WrenchCoupling::ZeroOrderHold { delay_frames: 0 },
    WrenchCoupling::ZeroOrderHold { delay_frames: 1 },
    WrenchCoupling::ZeroOrderHold { delay_frames: 2 },
];

/// One contact of a mass of points on a plane.
struct Case {
    stiffness: f64,
    wish: ContactWish,
}

impl Case {
    /// Random mass, stiffness, restitution and speed; the depth follows from the stiffness, by the closed
    /// form.
    fn new(random: &mut Random, coupling: WrenchCoupling) -> Self {
        let mass = random.log_between(1e-2, 1e5);
        let stiffness = random.log_between(1e2, 1e9);
        let restitution = random.between(0.1, 1.0);
        let speed = random.log_between(1e-3, 10.0);
        let zeta = zeta_of(restitution);
        let depth = speed / (stiffness / mass).sqrt() * depth_over(zeta);
        let accuracy = Accuracy::default();
        Self {
            stiffness,
            wish: ContactWish { mass, speed, depth, restitution, coupling, step: None, accuracy },
        }
    }
}

/// The inverse of V3's formula, by an independent search.
fn zeta_of(restitution: f64) -> f64 {
    let rebound = |zeta: f64| {
        let s = (1.0 - zeta * zeta).abs().sqrt();
        if zeta < 1.0 {
            (-(zeta / s) * (2.0 * zeta * s).atan2(2.0 * zeta * zeta - 1.0)).exp()
        } else {
            (-(zeta / s) * ((zeta + s) / (zeta - s)).ln()).exp()
        }
    };
    let (mut low, mut high) = (0.0, 10.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if rebound(middle) > restitution { low = middle } else { high = middle }
    }
    low
}

/// Greatest depth over v/ω.
fn depth_over(zeta: f64) -> f64 {
    let s = (1.0 - zeta * zeta).abs().sqrt();
    let time = if zeta < 1.0 { s.atan2(zeta) / s } else { (zeta + s).ln() / s };
    (-zeta * time).exp()
}

fn integrator(coupling: WrenchCoupling) -> Integrator {
    match coupling {
        WrenchCoupling::Stages => Integrator::RungeKutta4,
        WrenchCoupling::SemiImplicit => Integrator::SemiImplicitEuler,
        WrenchCoupling::ZeroOrderHold { delay_frames: late } => {
            Integrator::ZeroOrderHold { substeps: 1, delay_frames: late }
        }
    }
}

/// A world with the advised surface, and the adviser's warnings at mass and step.
fn world(wish: &ContactWish, advice: &ContactAdvice, step: f64) -> (World, Vec<StepWarning>) {
    let ContactAdvice { stiffness, damping, friction_stiffness, friction_damping, .. } = advice;
    let point = format!(
        r#"(format: "pong-model", version: 1, name: "point",
            surfaces: {{ "soft": (stiffness: {stiffness:?}, normal: Linear(damping: {damping:?}),
                friction: Bristle(mu: 0.5, stiffness: {friction_stiffness:?}, damping: {friction_damping:?})) }},
            root: (name: "point", surface: "soft", primitives: [Point(name: "tip", position: (0.0, 0.0, 0.0))]))"#
    );
    let (world, report, interfaces) = paired_with_first(Config::default(), &[&point, GROUND]);
    let masses = [GroupMass::point(wish.mass), GroupMass::immovable()];
    let masses: Vec<_> = interfaces.into_iter().zip(masses).collect();
    assert_eq!(report.warnings, []);
    let warnings = step_report(&world, &StepPlan::new(step, wish.coupling), &masses).unwrap().warnings;
    (world, warnings)
}

/// Greatest depth and rebound speed of a mass that touches at a phase of the step.
fn bounce(world: World, wish: &ContactWish, step: f64, phase: f64) -> (f64, f64) {
    let interfaces: Vec<_> =
        world.scene().objects().map(|object| world.scene().interface(object, "").unwrap()).collect();
    let mut simulation = Simulation::new(world, integrator(wish.coupling), step).unwrap();
    let start = Pose { position: Vec3::z() * (wish.speed * step * phase), ..Pose::identity() };
    let falling = Twist { linear: Vec3::z() * -wish.speed, angular: Vec3::zeros() };
    let body = RigidBody::free("point", MassProperties::sphere(wish.mass, 1.0));
    let body = simulation.add_body(body.at(start).moving(falling).touching(interfaces[0])).unwrap();
    simulation.add_body(RigidBody::fixed("ground").touching(interfaces[1])).unwrap();
    let (mut deepest, mut before) = (0.0_f64, [wish.speed; 4]);
    // It has left when it rises above the plane and even a delayed wrench no longer changes its speed.
    for _ in 0..1_000_000 {
        simulation.step().unwrap();
        let (height, speed) = (simulation.pose(body).position.z, simulation.twist(body).linear.z);
        deepest = deepest.max(-height);
        before.rotate_left(1);
        before[3] = speed;
        if height > 0.0 && speed > 0.0 && before.iter().all(|earlier| *earlier == speed) {
            return (deepest, speed);
        }
    }
    panic!("the mass does not come back");
}

#[test]
fn advised_contacts_keep_their_promises_at_the_advised_step_and_warn_at_three_times_it() {
    let mut random = Random(0x5eed_0bad_cafe_f00d);
    let mut worst = [(0.0_f64, 0.0_f64); COUPLINGS.len()];
    for number in 0..100 {
        for (index, coupling) in COUPLINGS.into_iter().enumerate() {
            let Case { stiffness, wish } = Case::new(&mut random, coupling);
            let advice = advise_contact(&wish).unwrap();
            // A held wrench is never advised without loss.
            let tolerance = if coupling.lag() > 0.0 { 5e-3 } else { 1e-6 };
            assert!((advice.stiffness / stiffness - 1.0).abs() < tolerance, "case {number}: {advice:?}");
            assert!(advice.step < advice.stable_step, "case {number}: {advice:?}");
            let (made, warnings) = world(&wish, &advice, advice.step);
            assert_eq!(warnings, [], "case {number}, {coupling:?}: {wish:?}");
            let (depth, speed) = bounce(made, &wish, advice.step, 3.0 + random.unit());
            let depth_error = (depth / wish.depth - 1.0).abs();
            let rebound_error = (speed / (wish.restitution * wish.speed) - 1.0).abs();
            assert!(depth_error < 0.05, "case {number}: {depth_error} of the depth; {wish:?} {advice:?}");
            assert!(
                rebound_error < 0.02,
                "case {number}: {rebound_error} of the rebound; {wish:?} {advice:?}"
            );
            worst[index] = (worst[index].0.max(depth_error), worst[index].1.max(rebound_error));
            let (_, warnings) = world(&wish, &advice, 3.0 * advice.step);
            assert!(!warnings.is_empty(), "case {number}: no warning; {wish:?} {advice:?}");
        }
    }
    for (coupling, (depth, rebound)) in COUPLINGS.iter().zip(worst) {
        println!("{coupling}: depth within {:.2} %, rebound within {:.2} %", 100.0 * depth, 100.0 * rebound);
    }
}

/// Largest errors of depth and rebound of a point of 1 kg at 1 m/s with a law, at 24 phases of a step. The
/// step is the duration π·√(m/k) of an undamped contact over `steps`.
fn law_errors(
    law: &str,
    (depth, rebound): (f64, f64),
    coupling: WrenchCoupling,
    steps: f64,
    duration: f64,
) -> (f64, f64) {
    let point = format!(
        r#"(format: "pong-model", version: 1, name: "point",
            surfaces: {{ "soft": (stiffness: 1e5, normal: {law}, friction: None) }},
            root: (name: "point", surface: "soft", primitives: [Point(name: "tip", position: (0.0, 0.0, 0.0))]))"#
    );
    let wish = ContactWish {
        mass: 1.0,
        speed: 1.0,
        depth,
        restitution: rebound,
        coupling,
        step: None,
        accuracy: Accuracy::default(),
    };
    let step = duration / steps;
    let mut worst = (0.0_f64, 0.0_f64);
    for phase in 0..24 {
        let (world, ..) = paired_with_first(Config::default(), &[&point, GROUND]);
        let (deepest, speed) = bounce(world, &wish, step, 1.0 + (f64::from(phase) + 0.5) / 24.0);
        worst = (worst.0.max((deepest / depth - 1.0).abs()), worst.1.max((speed / rebound - 1.0).abs()));
    }
    worst
}

/// The table of the user's guide, printed and compared with its round figures.
#[test]
fn steps_per_contact_and_accuracy_of_each_law() {
    let linear = |e: f64| format!("Linear(restitution: (e: {e:?}, mass: 1.0))");
    let crossley = |e: f64, exponent: &str| {
        format!("HuntCrossley(restitution: (e: {e:?}, speed: 1.0), exponent: {exponent})")
    };
    let omega = 1e5_f64.sqrt();
    let half_period = std::f64::consts::PI / omega;
    // Hertz: ½v² = ⅖kδ^(5/2), touched for 2.943·δ/v.
    let hertz = 1.25e-5_f64.powf(0.4);
    let laws = [
        ("Linear, e 1", linear(1.0), 1.0, half_period, Some(1.0 / omega)),
        ("Linear, e 0.7", linear(0.7), 0.7, half_period, Some(depth_over(zeta_of(0.7)) / omega)),
        ("Linear, e 0.3", linear(0.3), 0.3, half_period, Some(depth_over(zeta_of(0.3)) / omega)),
        ("Hunt-Crossley, e 0.7", crossley(0.7, "1.0"), 0.7, half_period, None),
        (
            "Hertz, e 1",
            "HuntCrossley(dissipation: 0.0, exponent: 1.5)".to_owned(),
            1.0,
            2.943 * hertz,
            Some(hertz),
        ),
        ("Hertz, e 0.7", crossley(0.7, "1.5"), 0.7, 2.943 * hertz, None),
    ];
    for (name, law, rebound, duration, depth) in laws {
        for (coupling, counts) in [
            (WrenchCoupling::Stages, [30.0, 100.0, 1000.0]),
            (WrenchCoupling::SemiImplicit, [30.0, 100.0, 1000.0]),
        ] {
            let errors = counts
                .map(|steps| law_errors(&law, (depth.unwrap_or(1.0), rebound), coupling, steps, duration));
            let row: Vec<String> = errors
                .iter()
                .map(|(depth_error, error)| match depth {
                    Some(_) => format!("{error:.1e} ({depth_error:.1e})"),
                    None => format!("{error:.1e}"),
                })
                .collect();
            println!("| {name} | {coupling} | {} |", row.join(" | "));
            // More steps, less error.
            assert!(errors[2].1 < errors[1].1 && errors[1].1 < errors[0].1, "{name}, {coupling}: {errors:?}");
            let most = match (name, coupling) {
                ("Linear, e 0.7", WrenchCoupling::Stages) => 1e-2,
                ("Linear, e 0.3", WrenchCoupling::Stages) => 5e-2,
                (_, WrenchCoupling::Stages) => 1e-3,
                _ => 0.2,
            };
            assert!(errors[0].1 < most, "{name}, {coupling}: {errors:?}");
        }
    }
}
