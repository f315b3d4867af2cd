//! The step check, before anything touches and for present contacts: sums over contacts, levers, two bodies.
//! Expectations are closed forms.

use pong_advise::{
    ActingReport, GroupMass, StepNote, StepPlan, StepReport, StepWarning, WrenchCoupling, acting_report,
    pressed_report, step_report,
};
use pong_engine::{Config, InterfaceId, State, World};
use pong_geometry::{Pose, Vec3};
use pong_testkit::worlds::paired_with_first;
use pong_testkit::{is_near, ron};

const K: f64 = 1e6;

fn model(name: &str, primitives: &str, stiffness: f64, friction: &str) -> String {
    ron::model(name, &ron::surface(stiffness, &format!("friction: {friction}")), primitives)
}

/// Several Objects, of which the first is paired with each of the others.
struct Meeting {
    world: World,
    interfaces: Vec<InterfaceId>,
    masses: Vec<(InterfaceId, GroupMass)>,
}

impl Meeting {
    fn new(texts: &[&str], masses: &[GroupMass]) -> Self {
        let (world, report, interfaces) = paired_with_first(Config::default(), texts);
        let masses = interfaces.iter().copied().zip(masses.iter().copied()).collect();
        assert_eq!(report.warnings, []);
        Self { world, interfaces, masses }
    }

    /// Evaluates with the origins of the groups at these positions.
    fn at(&mut self, places: &[[f64; 3]], plan: &StepPlan) -> ActingReport {
        for (interface, position) in self.interfaces.iter().zip(places) {
            self.world.set_state(*interface, &State { position: *position, ..State::identity() }).unwrap();
        }
        self.world.evaluate().unwrap();
        self.acting(plan)
    }

    fn acting(&self, plan: &StepPlan) -> ActingReport {
        acting_report(&self.world, plan, &self.masses).unwrap()
    }

    fn report(&self, plan: &StepPlan) -> StepReport {
        step_report(&self.world, plan, &self.masses).unwrap()
    }
}

/// Step report of two models that meet.
fn meet(texts: [&str; 2], masses: [GroupMass; 2], plan: &StepPlan) -> StepReport {
    Meeting::new(&texts, &masses).report(plan)
}

fn close(got: f64, expected: f64) -> bool {
    is_near(got, expected, 1e-12)
}

/// Longest stable step of undamped semi-implicit Euler.
fn longest(omega_squared: f64) -> f64 {
    2.0 / omega_squared.sqrt()
}

fn floor() -> String {
    model("floor", r#"Plane(name: "f", normal: (0, 0, 1), offset: 0)"#, f64::INFINITY, "None")
}

fn points(places: &[[f64; 3]]) -> String {
    let point = |(i, p): (usize, &[f64; 3])| {
        format!(r#"Point(name: "p{i}", position: ({:?}, {:?}, {:?})),"#, p[0], p[1], p[2])
    };
    model("feet", &places.iter().enumerate().map(point).collect::<String>(), K, "None")
}

fn plan(step: f64) -> StepPlan {
    StepPlan { accuracy: None, ..StepPlan::new(step, WrenchCoupling::SemiImplicit) }
}

/// A capsule, cylinder or cone on a plane has one whole spring in any position: n of them on one body are one
/// of n·k.
#[test]
fn round_parts_on_a_floor_are_judged_as_whole_springs() {
    let masses = [GroupMass::point(3.0), GroupMass::immovable()];
    let part = |kind: &str, i: u32| match kind {
        "Cone" => format!("Cone(name: \"p{i}\", ends: (({i},0,0),({i},1,0)), radii: (0.1, 0)),"),
        _ => format!("{kind}(name: \"p{i}\", ends: (({i},0,0),({i},1,0)), radius: 0.1),"),
    };
    for kind in ["Capsule", "Cylinder", "Cone"] {
        for n in 1..=3_u32 {
            let parts: String = (0..n).map(|i| part(kind, i)).collect();
            let step = longest(f64::from(n) * K / 3.0);
            let report = meet([&model("m", &parts, K, "None"), &floor()], masses, &plan(0.999 * step));
            let [group] = &report.groups[..] else { panic!("{kind}: {:?}", report.groups) };
            assert_eq!(group.contacts, n as usize, "{kind}");
            assert!(close(group.stable_step, step) && report.not_judged.is_empty(), "{kind}: {group:?}");
            assert!(close(report.stable_step(), longest(K / 3.0)), "{kind}");
        }
    }
}

/// n springs of k on one mass are one of n·k, for any n; no warning, and a note beyond 2√(m/(n·k)).
#[test]
fn equal_springs_on_one_body_add() {
    let masses = [GroupMass::point(3.0), GroupMass::immovable()];
    for n in 2..=8_u32 {
        let feet: Vec<[f64; 3]> = (0..n).map(|i| [f64::from(i % 3), f64::from(i / 3), 0.0]).collect();
        let step = longest(f64::from(n) * K / 3.0);
        let report = meet([&points(&feet), &floor()], masses, &plan(0.999 * step));
        let group = &report.groups[0];
        assert_eq!((report.groups.len(), group.contacts), (1, n as usize));
        assert!(
            close(group.stable_step, step) && close(group.spring.stiffness, f64::from(n) * K),
            "{group:?}"
        );
        assert!(close(report.stable_step(), longest(K / 3.0)));
        assert!(report.warnings.is_empty() && report.notes.is_empty(), "{:?}", report.notes);
        let report = meet([&points(&feet), &floor()], masses, &plan(1.001 * step));
        let [StepNote { told }] = &report.notes[..] else { panic!("{:?}", report.notes) };
        assert!(told.contains(&format!("up to {step:.3e} s is surely stable")), "{told}");
        assert!(report.warnings.is_empty(), "{:?}", report.warnings);
    }
}

/// The limiting term, among four with known results, for each use of the wrench.
#[test]
fn a_note_tells_which_term_asks_for_the_step() {
    let feet = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let masses = [GroupMass::point(3.0), GroupMass::immovable()];
    let soft = "stiffness: 1000.0, normal: Linear(damping: 1), friction: ";
    let bristle = |k: f64, c: f64| format!("Bristle(mu: 0.5, stiffness: {k:?}, damping: {c:?})");
    let cases = [
        ("normal stiffness", "stiffness: 1e6, normal: Linear(damping: 1), friction: ", bristle(1e3, 1.0)),
        ("normal damping", "stiffness: 1e3, normal: Linear(damping: 2000), friction: ", bristle(1e3, 1.0)),
        ("friction stiffness", soft, bristle(1e6, 1.0)),
        ("friction damping", soft, bristle(1e3, 2000.0)),
        ("normal stiffness and its friction stiffness", "stiffness: 1e6, friction: ", bristle(1e6, 0.0)),
        (
            "normal damping and its friction damping",
            "stiffness: 1e3, normal: Linear(damping: 2000), friction: ",
            bristle(1e3, 2000.0),
        ),
    ];
    for (term, normal, friction) in cases {
        let feet =
            points(&feet).replace("stiffness: 1000000.0, friction: None", &format!("{normal}{friction}"));
        let ground = floor().replace(", friction: None", "");
        for coupling in [WrenchCoupling::SemiImplicit, WrenchCoupling::Stages] {
            let plan = |step| StepPlan { accuracy: None, ..StepPlan::new(step, coupling) };
            let sure = meet([&feet, &ground], masses, &plan(1e-9)).surely_stable_step();
            let report = meet([&feet, &ground], masses, &plan(1.01 * sure));
            let [StepNote { told }] = &report.notes[..] else { panic!("{:?}", report.notes) };
            let asked = format!("its {term} asks for that, most of all between `feet/s` and `floor/s`");
            assert!(told.contains(&asked), "{coupling:?}: {told}");
        }
    }
    // The warning of one contact names the spring, its surfaces and its limiting term.
    let alone = points(&[[0.0; 3]]).replace("friction: None", "normal: Linear(damping: 1e5)");
    let report = meet([&alone, &floor()], masses, &plan(1e-3));
    let told = report.warnings.iter().map(ToString::to_string).collect::<String>();
    assert!(told.contains("(surfaces `feet/s` and `floor/s`)") && told.contains("by its damping"), "{told}");
}

/// At a distance l from the mass centre a contact has the inverse mass 1/m + l²/I: a rod of 3 kg and 4 m
/// struck at its end weighs ¾ kg.
#[test]
fn a_lever_makes_a_contact_quicker() {
    let rod = GroupMass { inertia: [1e-3, 4.0, 4.0, 0.0, 0.0, 0.0], ..GroupMass::point(3.0) };
    let tip = points(&[[2.0, 0.0, 0.0]]);
    let step = longest(K / 0.75);
    let report = meet([&tip, &floor()], [rod, GroupMass::immovable()], &plan(1.001 * step));
    assert!(close(report.surely_stable_step(), step) && close(report.stable_step(), step));
    let told = report.warnings.iter().map(ToString::to_string).collect::<String>();
    assert!(told.contains("on 7.500e-1 kg (where its lever is longest)"), "{told}");
    // The choice of the group's origin does not matter.
    let shifted = GroupMass { mass_center: [0.0, 0.0, 5.0], ..rod };
    let tip = points(&[[2.0, 0.0, 5.0]]);
    let report = meet([&tip, &floor()], [shifted, GroupMass::immovable()], &plan(step));
    assert!(close(report.surely_stable_step(), step));
    // Without an inertia there is no lever.
    let report = meet([&tip, &floor()], [GroupMass::point(3.0), GroupMass::immovable()], &plan(step));
    assert!(close(report.surely_stable_step(), longest(K / 3.0)));
}

/// Springs of k and 3k to two partners are 4k, and friction of k_t > k at two feet is as stiff as twice
/// itself.
#[test]
fn partners_add_and_friction_counts() {
    let ball = model("b", r#"Sphere(name: "s", center: (0, 0, 0), radius: 0.1)"#, f64::INFINITY, "None");
    let wall = |k: f64| floor().replace("stiffness: inf", &format!("stiffness: {k:?}"));
    let masses = [GroupMass::point(2.0), GroupMass::immovable(), GroupMass::immovable()];
    let step = longest(4.0 * K / 2.0);
    let mut between = Meeting::new(&[&ball, &wall(K), &wall(3.0 * K)], &masses);
    let report = between.report(&plan(step));
    assert!(close(report.surely_stable_step(), step) && report.groups[0].contacts == 2, "{report:?}");
    assert!(close(report.stable_step(), longest(1.5 * K)));
    // Between both, and at one alone.
    let acting = between.at(&[[0.0, 0.0, 0.09], [0.0; 3], [0.0; 3]], &plan(step));
    assert!(close(acting.stable_step, step) && acting.contacts == 2, "{acting:?}");
    let acting = between.at(&[[0.0, 0.0, 0.09], [0.0; 3], [0.0, 0.0, -1.0]], &plan(step));
    assert!(close(acting.stable_step, longest(0.5 * K)) && acting.contacts == 1, "{acting:?}");

    let rough = "Bristle(mu: 0.5, stiffness: 4e6)";
    let foot = points(&[[0.0; 3], [1.0, 0.0, 0.0]]).replace("friction: None", &format!("friction: {rough}"));
    let floor = floor().replace("friction: None", "friction: Bristle(mu: 0.5, stiffness: 12e6)");
    let step = longest(2.0 * 3.0 * K / 2.0);
    let mut rubbing = Meeting::new(&[&foot, &floor], &masses[..2]);
    let report = rubbing.report(&plan(step));
    assert!(close(report.surely_stable_step(), step), "{report:?}");
    assert!(close(report.stable_step(), longest(3.0 * K / 2.0)), "{report:?}");
    let acting = rubbing.at(&[[0.0, 0.0, -1e-3], [0.0; 3]], &plan(step));
    assert!(close(acting.stable_step, step), "{acting:?}");
}

/// V2's tripod: heave ω² = 3k/m = 1e6, rock ω² = 1.5kR²/I = 1.875e6 (without gravity), m 3 kg, R 0.5 m, I 0.2 kg·m².
/// Undamped semi-implicit Euler is stable to 2/ω.
#[test]
fn the_feet_of_a_tripod_add_and_rock() {
    let feet = [0.0, 1.0, 2.0].map(|i: f64| {
        let angle = i * std::f64::consts::TAU / 3.0;
        [0.5 * angle.cos(), 0.5 * angle.sin(), 0.0]
    });
    let of = |inertia: f64| GroupMass {
        inertia: [inertia, inertia, 0.3, 0.0, 0.0, 0.0],
        mass_center: [0.0, 0.0, 0.3],
        ..GroupMass::point(3.0)
    };
    for (inertia, squared) in [(0.2_f64, 1.875e6_f64), (0.9, 1e6)] {
        let masses = [of(inertia), GroupMass::immovable()];
        let step = longest(squared);
        let report = meet([&points(&feet), &floor()], masses, &plan(0.999 * step));
        assert_eq!((report.groups.len(), report.groups[0].contacts), (1, 3));
        // Planes through only two feet have a longer lever and less stiffness; the tripod's own mode is the
        // bound.
        let told = report.groups[0].stable_step;
        assert!(told <= step * (1.0 + 1e-9) && told > 0.6 * step, "{told} {step}");
        // One foot alone, pushed across its lever, may have a faster mode than all three.
        let across = f64::max(0.34 / inertia, 0.09 / inertia + 0.25 / 0.3);
        assert!(close(report.stable_step(), longest(K * (1.0 / 3.0 + across))), "{report:?}");
        let plan = plan(1.001 * step);
        let mut stands = Meeting::new(&[&points(&feet), &floor()], &masses);
        let before = stands.report(&plan);
        assert_eq!(before.warnings.len() + before.notes.len(), 1, "{before:?}");
        // Present contacts are judged exactly: on all feet, and in the air.
        let acting = stands.at(&[[0.0, 0.0, -1e-3], [0.0; 3]], &plan);
        assert!(acting.contacts == 3 && (acting.stiffness_rate / squared - 1.0).abs() < 1e-9, "{acting:?}");
        let air = stands.at(&[[0.0, 0.0, 1.0], [0.0; 3]], &plan);
        assert_eq!((air.contacts, air.stable_step), (0, f64::INFINITY));
    }
}

/// One point at the mass centre, on a floor: the bound equals the single contact, which has the warning.
#[test]
fn one_contact_is_its_own_sum() {
    let masses = [GroupMass::point(2.0), GroupMass::immovable()];
    let step = longest(K / 2.0);
    let report = meet([&points(&[[0.0; 3]]), &floor()], masses, &plan(0.999 * step));
    assert!(close(report.groups[0].stable_step, step));
    assert!(report.warnings.is_empty() && report.notes.is_empty());
    let report = meet([&points(&[[0.0; 3]]), &floor()], masses, &plan(1.001 * step));
    assert!(matches!(report.warnings[..], [StepWarning::TooLong { .. }]), "{:?}", report.warnings);
    // A certain failure is not repeated as a possible one.
    assert!(report.notes.is_empty(), "{:?}", report.notes);
}

/// Two balls of m₁ and m₂ on one spring: ω² = k(1/m₁ + 1/m₂), seen from both.
#[test]
fn two_bodies_share_one_spring() {
    let ball = |name| model(name, r#"Sphere(name: "s", center: (0, 0, 0), radius: 0.1)"#, 2.0 * K, "None");
    let masses = [GroupMass::point(2.0), GroupMass::point(8.0)];
    let step = longest(K * (1.0 / 2.0 + 1.0 / 8.0));
    let mut two = Meeting::new(&[&ball("x"), &ball("y")], &masses);
    let report = two.report(&plan(step));
    assert_eq!(report.groups.len(), 2);
    for group in &report.groups {
        assert_eq!(group.contacts, 1);
        assert!((group.stable_step / step - 1.0).abs() < 1e-9, "{group:?}");
    }
    let acting = two.at(&[[0.0; 3], [0.12, 0.12, 0.0]], &plan(step));
    assert!(close(acting.stable_step, step) && acting.contacts == 1, "{acting:?}");
}

/// A bar between two free balls of m: with springs k at its ends, the bar alone has 2k/M in heave; with the
/// balls the mode is k(1/m + 2/M), as they move against it.
#[test]
fn a_chain_of_bodies_has_the_mode_known_by_hand() {
    let ends = |x: f64| format!(r#"Point(name: "p{x}", position: ({x:?}, 0, 0)),"#);
    let bar = model("bar", &(ends(-1.0) + &ends(1.0)), f64::INFINITY, "None");
    let ball = model("ball", r#"Sphere(name: "s", center: (0, 0, 0), radius: 0.1)"#, K, "None");
    let masses = [GroupMass::point(5.0), GroupMass::point(2.0), GroupMass::point(2.0)];
    let step = longest(K * (1.0 / 2.0 + 2.0 / 5.0));
    let mut chain = Meeting::new(&[&bar, &ball, &ball], &masses);
    let acting = chain.at(&[[0.0; 3], [-1.09, 0.0, 0.0], [1.09, 0.0, 0.0]], &plan(step));
    assert!(acting.contacts == 2 && close(acting.stable_step, step), "{acting:?}");
    let surely = chain.report(&plan(step)).surely_stable_step();
    assert!(surely <= step, "a bound above what can happen: {surely} {step}");
}

/// Damping adds: held over a frame, n springs are stable to the lesser of 2c/k and 2m/(n·c).
#[test]
fn damping_adds_too() {
    let damped = |c: f64| {
        points(&[[0.0; 3], [1.0, 0.0, 0.0]])
            .replace("stiffness: 1000000.0,", &format!("stiffness: 1e6, normal: Linear(damping: {c:?}),"))
    };
    let masses = [GroupMass::point(3.0), GroupMass::immovable()];
    for (c, single, sum) in [(1e2, 2e-4, 2e-4), (1e4, 2.0 * 3.0 / 1e4, 3.0 / 1e4)] {
        let held = StepPlan {
            accuracy: None,
            ..StepPlan::new(1e-5, WrenchCoupling::ZeroOrderHold { delay_frames: 0 })
        };
        let report = meet([&damped(c), &floor()], masses, &held);
        assert!(close(report.stable_step(), single) && close(report.surely_stable_step(), sum), "{report:?}");
    }
}

/// Undamped and held over a frame no step is stable; below ω·T = 0.1 there is no warning, for the sum as for
/// one.
#[test]
fn undamped_held_wrenches_are_noted_from_the_same_step_on() {
    let feet = points(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]);
    let masses = [GroupMass::point(4.0), GroupMass::immovable()];
    // ω is 1000 rad/s for all four, half that for one.
    for (step, warnings, notes) in [(0.99e-4, 0, 0), (1.01e-4, 0, 1), (1.99e-4, 0, 1), (2.01e-4, 1, 0)] {
        let held = StepPlan {
            accuracy: None,
            ..StepPlan::new(step, WrenchCoupling::ZeroOrderHold { delay_frames: 0 })
        };
        let report = meet([&feet, &floor()], masses, &held);
        assert_eq!((report.warnings.len(), report.notes.len()), (warnings, notes), "{step}: {report:?}");
    }
}

/// Contacts that cannot be judged are reported, each with its reason.
#[test]
fn what_is_not_known_is_told() {
    let hertz = points(&[[0.0; 3]]).replace(
        "stiffness: 1000000.0,",
        "stiffness: 1e8, normal: HuntCrossley(dissipation: 0, exponent: 1.5),",
    );
    let floor = floor()
        .replace("stiffness: inf,", "stiffness: inf, normal: HuntCrossley(dissipation: 0, exponent: 1.5),");
    let masses = [GroupMass::point(2.0), GroupMass::immovable()];
    let warnings = meet([&hertz, &floor], masses, &plan(1e-4)).warnings;
    assert!(matches!(&warnings[..], [StepWarning::NotJudged { told }] if told.contains("closing speed")));
    // With a speed: ½mv² = ⅖kδ^(5/2), ω² = 1.5k√δ/m.
    let depth = (1.25 * 2.0 * 0.25 / 1e8_f64).powf(0.4);
    let step = longest(1.5e8 * depth.sqrt() / 2.0);
    for (step, count) in [(0.99 * step, 0), (1.01 * step, 1)] {
        let fast = StepPlan { closing_speed: Some(0.5), ..plan(step) };
        assert_eq!(meet([&hertz, &floor], masses, &fast).warnings.len(), count);
    }
    // Present contacts are judged at their depth.
    let mut deep = Meeting::new(&[&hertz, &floor], &masses);
    let acting = deep.at(&[[0.0, 0.0, -depth], [0.0; 3]], &plan(step));
    assert!((acting.stable_step / step - 1.0).abs() < 1e-9, "{acting:?}");
}

/// Laws that follow depth and load are judged at the depth and load of their contacts, without a closing
/// speed: the tangent 1.5·k·√δ of exponent 3/2, μ·N/v_ε of regularised friction, and half of both at each end
/// of a bar.
#[test]
fn what_touches_is_judged_as_it_is() {
    let masses = [GroupMass::point(2.0), GroupMass::immovable()];
    let hertz = |text: &str, friction: &str| {
        let law = format!("normal: HuntCrossley(dissipation: 0, exponent: 1.5), friction: {friction}");
        text.replace("friction: None", &law)
    };
    let slides = "Coulomb(mu: 0.5, slip_speed: 1e-3)";
    let bar = model("bar", r#"LineSegment(name: "s", ends: ((-1, 0, 0), (1, 0, 0)))"#, K, "None");
    let tip = model("tip", r#"Point(name: "p", position: (0, 0, 0))"#, K, "None");
    let rigid = floor();
    for (mover, weight) in [(tip, 1.0), (bar, 0.5)] {
        for (friction, depth) in [("None", 1e-3_f64), ("None", 4e-3), (slides, 1e-3)] {
            let texts = [hertz(&mover, friction), hertz(&rigid, friction)];
            let stiffness = weight * 1.5 * K * depth.sqrt();
            let load = weight * K * depth * depth.sqrt();
            // Once a step, a single damper is stable to γ = 2, and is the limiting one here.
            let step = match friction {
                "None" => longest(stiffness / 2.0),
                _ => 2.0 * 2.0 / (0.5 * load / 1e-3),
            };
            let mut meeting = Meeting::new(&[&texts[0], &texts[1]], &masses);
            meeting.at(&[[0.0, 0.0, -depth], [0.0; 3]], &plan(step));
            for (share, count) in [(0.99, 0), (1.01, 1)] {
                let report = pressed_report(&meeting.world, &plan(share * step), &meeting.masses).unwrap();
                let warnings = report.warnings;
                assert_eq!(warnings.len(), count, "{friction} {depth} {weight} {share}: {warnings:?}");
                assert!(warnings.iter().all(|told| matches!(told, StepWarning::TooLong { .. })));
            }
        }
    }
}

/// A bar on a floor has half its spring at each end: one spring together.
#[test]
fn contacts_that_share_a_spring_act_by_their_weights() {
    let bar = model("bar", r#"LineSegment(name: "s", ends: ((-1, 0, 0), (1, 0, 0)))"#, K, "None");
    let masses = [GroupMass::point(2.0), GroupMass::immovable()];
    let step = longest(K / 2.0);
    let mut lies = Meeting::new(&[&bar, &floor()], &masses);
    let acting = lies.at(&[[0.0, 0.0, -1e-3], [0.0; 3]], &plan(step));
    assert!(acting.contacts == 2 && close(acting.stable_step, step), "{acting:?}");
}

/// A rod leans on a wall: rotated as a whole, with the wall, or with the roles swapped, λ is that of its
/// lever.
#[test]
fn what_acts_is_the_same_from_any_side() {
    let rod = GroupMass { inertia: [1e-3, 4.0, 4.0, 0.0, 0.0, 0.0], ..GroupMass::point(3.0) };
    let tip = points(&[[2.0, 0.0, 0.0]]);
    let plan = plan(1e-4);
    // Rotation about x, and about the diagonal of all axes by a third of a turn.
    for turn in [[0.6, 0.8, 0.0, 0.0], [0.5, 0.5, 0.5, 0.5], [0.8, 0.0, 0.6, 0.0]] {
        let mut leans = Meeting::new(&[&tip, &floor()], &[rod, GroupMass::immovable()]);
        // The rod along the wall's plane, 1 mm deep, both rotated.
        let quaternion = Pose::new(Vec3::zeros(), turn).orientation;
        let depth = quaternion * Vec3::new(0.3, -0.2, -1e-3);
        let states = [depth.into(), [0.0; 3]];
        for (interface, position) in leans.interfaces.iter().zip(states) {
            let state = State { position, orientation: turn, ..State::identity() };
            leans.world.set_state(*interface, &state).unwrap();
        }
        leans.world.evaluate().unwrap();
        let acting = leans.acting(&plan);
        assert!(acting.contacts == 1 && (acting.stiffness_rate * 0.75 / K - 1.0).abs() < 1e-9, "{acting:?}");
        // Only the wall rotated: the rod meets it at an angle, with a shorter lever.
        let state = State { position: [0.0; 3], ..State::identity() };
        leans.world.set_state(leans.interfaces[1], &state).unwrap();
        let tip = quaternion * (2.0 * Vec3::x());
        let position = [-tip.x, -tip.y, -tip.z - 1e-3];
        let state = State { position, orientation: turn, ..State::identity() };
        leans.world.set_state(leans.interfaces[0], &state).unwrap();
        leans.world.evaluate().unwrap();
        let acting = leans.acting(&plan);
        let arm = tip.x * tip.x + tip.y * tip.y;
        let expected = K * (1.0 / 3.0 + 0.25 * arm);
        // A force through the rod's own axis has no lever.
        assert!((acting.stiffness_rate / expected - 1.0).abs() < 1e-9, "{turn:?}: {acting:?} {expected}");
    }
}

/// A rod that lies on another one tilts on up to twice the stiffness that it has on a plane, ½k·l²L²/(l² + L²), however
/// short the overlap: the adviser's bounds hold.
#[test]
fn a_rod_that_rocks_on_another_is_within_the_bounds() {
    // A thin rod of 1 m and 3 kg.
    let rod = GroupMass { inertia: [1e-3, 0.25, 0.25, 0.0, 0.0, 0.0], ..GroupMass::point(3.0) };
    let capsule =
        |half: f64| format!("Capsule(name: \"c\", ends: ((-{half:?},0,0),({half:?},0,0)), radius: 0.1)");
    let upper = model("rod", &capsule(0.5), K, "None");
    for (half, shift) in [(0.5, 0.0), (0.5, 0.9), (10.0, 0.0), (10.0, 10.0), (0.1, 0.55)] {
        let log = model("log", &capsule(half), f64::INFINITY, "None");
        let mut both = Meeting::new(&[&upper, &log], &[rod, GroupMass::immovable()]);
        let plan = plan(1e-4);
        let before = both.report(&plan);
        let acting = both.at(&[[shift, 0.0, 0.1999], [0.0; 3]], &plan);
        let tangent = both.world.tangents().unwrap();
        let found = tangent[0].stiffness[0][0][(4, 4)];
        if shift == 0.0 {
            let square = 4.0 * half * half;
            assert!(is_near(found, 0.5 * K * square / (1.0 + square), 1e-3), "{half}: {found}");
        }
        let rate = found / 0.25;
        assert!(acting.stiffness_rate > rate, "{half} {shift}: {} < {rate}", acting.stiffness_rate);
        assert!(before.surely_stable_step() < longest(rate), "{half} {shift}");
    }
}

/// A light drum under a long bar rocks on the half springs at the ends of the bar, however short the drum is: what acts
/// is judged by them.
#[test]
fn a_drum_that_rocks_under_a_long_bar_is_within_the_bounds() {
    let drum = GroupMass { inertia: [0.1, 0.1, 0.1, 0.0, 0.0, 0.0], ..GroupMass::point(3.0) };
    let bar = model("bar", "Capsule(name: \"c\", ends: ((-2,0,0),(2,0,0)), radius: 0.1)", K, "None");
    let part = "Cylinder(name: \"d\", ends: ((-0.2,0,0),(0.2,0,0)), radius: 0.1)";
    let log = model("log", part, f64::INFINITY, "None");
    for shift in [0.0, 0.1, 1.9] {
        let mut both = Meeting::new(&[&bar, &log], &[GroupMass::immovable(), drum]);
        let acting = both.at(&[[shift, 0.0, 0.1999], [0.0; 3]], &plan(1e-4));
        let tangent = both.world.tangents().unwrap();
        let found = tangent[0].stiffness[1][1][(4, 4)];
        if shift == 0.0 {
            // ¼k·L², but for the force times the lever of the place below the drum's middle.
            assert!(is_near(found, 0.25 * K * 16.0, 1e-3), "{found}");
        }
        // The force times its lever is not counted, here or elsewhere.
        let rate = found / 0.1 * (1.0 - 1e-4);
        assert!(acting.stiffness_rate > rate, "{shift}: {} < {rate}", acting.stiffness_rate);
    }
}
