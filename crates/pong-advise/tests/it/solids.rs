//! The step check of solids before they touch. Expectations are closed forms of boxes that lie flat.

use pong_advise::{GroupMass, StepPlan, StepReport, WrenchCoupling, step_report};
use pong_engine::{Config, WorldBuilder};
use pong_model::Extensions;
use pong_testkit::ron::box_polyhedron;
use pong_testkit::worlds::paired_with_first;
use pong_testkit::{is_near, ron};
use std::sync::Arc;

/// K, N/m³.
const K: f64 = 1.2e8;

fn cube(edge: f64, surface: &str) -> String {
    let solid = box_polyhedron("box", [0.0; 3], [edge / 2.0; 3], "");
    let text = ron::model("cube", &format!("\"s\": (stiffness: 1e6, foundation: {K:?}, {surface})"), &solid);
    text.replace("surface: \"s\", primitives", "surface: \"s\", contact: Solid, primitives")
}

fn floor() -> String {
    let plane = r#"Plane(name: "f", normal: (0, 0, 1), offset: 0)"#;
    ron::model("floor", &ron::surface(f64::INFINITY, ""), plane)
}

fn mass_of(mass: f64, edge: f64) -> GroupMass {
    let moment = mass * edge * edge / 6.0;
    GroupMass { inertia: [moment, moment, moment, 0.0, 0.0, 0.0], ..GroupMass::point(mass) }
}

fn plan(step: f64) -> StepPlan {
    StepPlan { accuracy: None, ..StepPlan::new(step, WrenchCoupling::SemiImplicit) }
}

/// Report of models of which the first meets each of the others.
fn report(models: &[&str], masses: &[GroupMass], plan: &StepPlan) -> StepReport {
    let (world, _, interfaces) = paired_with_first(Config::default(), models);
    let masses: Vec<_> = interfaces.into_iter().zip(masses.iter().copied()).collect();
    step_report(&world, plan, &masses).unwrap()
}

fn close(got: f64, expected: f64) -> bool {
    is_near(got, expected, 1e-12)
}

/// A cube of the edge a on a plane: K·a² on its whole mass, whatever turns it; its friction at the lever a/2.
#[test]
fn a_cube_on_a_plane_has_its_face_and_its_mass() {
    let (edge, mass) = (0.1, 2.0);
    let model = cube(edge, "friction: Bristle(mu: 0.5, stiffness: 4e5, damping: 0.0)");
    let found = report(&[&floor(), &model], &[GroupMass::immovable(), mass_of(mass, edge)], &plan(1e-5));
    let [pair] = &found.pairs[..] else { panic!("{found:?}") };
    let k = K * edge * edge;
    assert!(close(pair.areas[0].unwrap(), edge * edge) && close(pair.normal.spring.stiffness, k), "{pair:?}");
    assert!(
        close(pair.normal.mass, mass) && close(pair.normal.stable_step, 2.0 / (k / mass).sqrt()),
        "{pair:?}"
    );
    // k_t changes by K over stiffness, as K does; 1/m + (a/2)²/I = 2.5/m.
    let friction = pair.friction.unwrap();
    assert!(close(friction.spring.stiffness, 0.4 * k) && close(friction.mass, mass / 2.5), "{pair:?}");
    assert!(found.warnings.is_empty() && found.notes.is_empty(), "{found:?}");
    let late = report(&[&floor(), &model], &[GroupMass::immovable(), mass_of(mass, edge)], &plan(3e-3));
    let told = late.warnings[0].to_string();
    assert!(
        told.contains("flat on 1.000e-2 m²") && told.contains("the longest stable step is 2.5"),
        "{told}"
    );
}

/// The smaller face of two cubes counts.
#[test]
fn two_cubes_touch_on_the_smaller_face() {
    let (large, small) = (cube(0.4, ""), cube(0.1, ""));
    let found = report(&[&large, &small], &[mass_of(8.0, 0.4), mass_of(2.0, 0.1)], &plan(1e-5));
    let pair = &found.pairs[0];
    // Both yield: K/2 in series, and 1/(1/8 + 1/2) kg.
    assert!(
        close(pair.areas[0].unwrap(), 0.01) && close(pair.normal.spring.stiffness, 0.5 * K * 0.01),
        "{pair:?}"
    );
    assert!(close(pair.normal.mass, 1.6), "{pair:?}");
}

/// Objects of one model with one mass are judged once, however many of them may meet.
#[test]
fn equal_cubes_are_judged_once() {
    let model = pong_model::parse(&cube(0.1, ""), "cube.ron", None, &Extensions::new()).unwrap();
    let mut builder = WorldBuilder::new(Config::default());
    let model = builder.add_model(Arc::new(model));
    let objects: Vec<_> =
        (0..4).map(|index| builder.create_object(model, &format!("o{index}")).unwrap()).collect();
    for (index, a) in objects.iter().enumerate() {
        objects[index + 1..].iter().for_each(|b| _ = builder.pair(*a, *b).unwrap());
    }
    let roots: Vec<_> =
        objects.iter().map(|object| builder.scene().interface(*object, "").unwrap()).collect();
    let (world, _) = builder.seal().unwrap();
    let judged = |masses: [f64; 4]| {
        let masses: Vec<_> = roots.iter().copied().zip(masses.map(|mass| mass_of(mass, 0.1))).collect();
        step_report(&world, &plan(1e-5), &masses).unwrap().pairs.len()
    };
    // Equal masses; one that differs: itself with others, and the others with each other.
    assert_eq!((judged([2.0; 4]), judged([2.0, 2.0, 2.0, 3.0])), (1, 2));
}

/// Hunt and Crossley's damping at the depth that a speed gives: c = χ·v·√(k·m), stable to κ + 2γ < 4. From rest the
/// speed of a fall counts, in a note.
#[test]
fn hunt_crossley_damps_at_the_expected_speed() {
    let (edge, mass, dissipation, step) = (0.1, 1.0, 2.0, 1e-3);
    let model = cube(edge, &format!("normal: HuntCrossley(dissipation: {dissipation:?}, exponent: 1.0)"));
    let of =
        |plan: &StepPlan| report(&[&floor(), &model], &[GroupMass::immovable(), mass_of(mass, edge)], plan);
    let k = K * edge * edge;
    // The largest speed at which the step is stable.
    let limit = (4.0 - k * step * step / mass) / (2.0 * dissipation * (k * mass).sqrt() * step / mass);
    for (share, warned) in [(0.99, false), (1.01, true)] {
        let speed = Some(share * limit);
        let closing = of(&StepPlan { closing_speed: speed, ..plan(step) });
        assert_eq!((closing.warnings.len(), closing.notes.len()), (usize::from(warned), 0), "{closing:?}");
        let c = dissipation * share * limit * (k * mass).sqrt();
        assert!(close(closing.pairs[0].normal.spring.damping, c), "{closing:?}");
        let falling = of(&StepPlan { fall_speed: speed, ..plan(step) });
        assert_eq!((falling.warnings.len(), falling.notes.len()), (0, usize::from(warned)), "{falling:?}");
        assert!(
            !warned || falling.notes[0].told.contains("which a fall in the scene can reach"),
            "{falling:?}"
        );
    }
}
