//! An FMU as an importer calls it, through the C functions of FMI 3.0.

use crate::support::{DISCARD, ERROR, Importer, OK, Unpacked, make, scratch, unpack, write_scene};
use pong_executive::Simulation;
use pong_executive::scene::Scene;
use pong_fmu::{Fmi, Options};
use pong_testkit::meshes::{l_shape, obj};
use std::path::Path;

fn simulation(scene: &Path) -> Simulation {
    let scene = Scene::load(scene).unwrap_or_else(|errors| panic!("{errors}"));
    scene.build().unwrap_or_else(|errors| panic!("{errors}")).simulation
}

fn unit(test: &str, options: &Options) -> (std::path::PathBuf, Unpacked) {
    let folder = scratch(test);
    let scene = write_scene(&folder, "");
    let unit = unpack(&make(&scene, Fmi::V3, options), &folder.join("unit"));
    (scene, unit)
}

const BALL: &str = "'my ball'";

#[test]
fn co_simulation_is_the_executive_of_the_scene_to_the_bit() {
    let (scene, unit) = unit("co_simulation", &Options::default());
    let mut executive = simulation(&scene);
    let ball = executive.bodies().next().unwrap().0;
    let mut fmu = Importer::new(&unit, false).unwrap();
    assert_eq!(fmu.begin(0.0), OK, "{}", fmu.last());
    // Communication steps of one, seven and many steps of the scene, and their sum is rounded.
    let mut time = 0.0;
    let mut touched = false;
    for steps in [1, 7, 92, 200, 3, 97] {
        let length = f64::from(steps) * 1e-4;
        assert_eq!(fmu.do_step(time, length), OK, "{}", fmu.last());
        time += length;
        (0..steps).for_each(|_| executive.step().unwrap());
        let pose = executive.pose(ball);
        assert_eq!(fmu.get_vector(&format!("{BALL}.position")), <[f64; 3]>::from(pose.position));
        let q = pose.orientation;
        assert_eq!(fmu.get_vector(&format!("{BALL}.orientation")), [q.w, q.i, q.j, q.k]);
        let wrench = executive.contact_wrench(ball);
        assert_eq!(fmu.get_vector(&format!("{BALL}.contact_force")), <[f64; 3]>::from(wrench.force));
        assert_eq!(fmu.get_vector(&format!("{BALL}.contact_moment")), <[f64; 3]>::from(wrench.moment));
        let depth = executive.world().contacts_iter().map(|contact| contact.depth).fold(0.0, f64::max);
        assert_eq!(fmu.get("contact.largest_depth"), depth);
        assert_eq!(fmu.get("contact.count"), executive.world().contact_count() as f64);
        assert_eq!(fmu.get_flag("contact.touching"), depth > 0.0);
        touched |= depth > 0.0;
    }
    assert!(touched, "the ball never reached the ground");
    assert_eq!(fmu.terminate(), OK);
}

#[test]
fn a_step_that_is_no_multiple_ends_where_it_should() {
    let (scene, unit) = unit("odd_steps", &Options::default());
    let mut odd = Importer::new(&unit, false).unwrap();
    assert_eq!(odd.begin(0.0), OK);
    // The same by hand: two steps of 1e-4 s and the rest to the communication point, with the same rounding
    // of times.
    let mut executive = simulation(&scene);
    let ball = executive.bodies().next().unwrap().0;
    let mut touched = false;
    for i in 0..100 {
        let from = f64::from(i) * 2.5e-4;
        assert_eq!(odd.do_step(from, 2.5e-4), OK, "{}", odd.last());
        (0..2).for_each(|_| executive.step().unwrap());
        executive.set_step(from + 2.5e-4 - executive.time()).unwrap();
        executive.step().unwrap();
        executive.set_step(1e-4).unwrap();
        assert_eq!(
            odd.get_vector(&format!("{BALL}.position")),
            <[f64; 3]>::from(executive.pose(ball).position)
        );
        touched |= executive.world().contact_count() > 0;
    }
    assert!(touched, "the ball never reached the ground");
    assert!((odd.get("time") - 0.025).abs() < 1e-15);
    assert_eq!(odd.do_step(0.5, 1e-4), ERROR);
    assert!(odd.last().contains("begins at 0.5 s, and the instance is at 0.025"), "{}", odd.last());
    assert_eq!(odd.do_step(0.025, f64::NAN), ERROR);
    assert_eq!(odd.do_step(0.025, -1.0), ERROR);
    // The limit is a hundred million steps of the scene, so that a wrong unit of time is refused at once.
    for length in [1e300, 2e4] {
        assert_eq!(odd.do_step(0.025, length), ERROR);
        assert!(odd.last().contains("steps of the scene (0.0001 s)"), "{}", odd.last());
    }
    assert_eq!(odd.do_step(0.025, 1e-4), OK, "what was refused has changed nothing");
}

/// Classic Runge-Kutta as an importer does it: derivatives at each stage, completed step at the end, events
/// on request.
fn run_exchange(fmu: &mut Importer, from: u32, to: u32, h: f64) -> u32 {
    let mut events = 0;
    let mut x = fmu.states();
    for step in from..to {
        let t = f64::from(step) * h;
        let mut rates = vec![fmu.try_rates().unwrap()];
        for share in [0.5, 0.5, 1.0] {
            let last = rates.last().unwrap();
            let trial: Vec<f64> = x.iter().zip(last).map(|(x, k)| x + share * h * k).collect();
            assert_eq!((fmu.set_time(t + share * h), fmu.set_states(&trial)), (OK, OK));
            rates.push(fmu.try_rates().unwrap());
        }
        for (i, x) in x.iter_mut().enumerate() {
            *x += h / 6.0 * (rates[0][i] + 2.0 * rates[1][i] + 2.0 * rates[2][i] + rates[3][i]);
        }
        assert_eq!((fmu.set_time(f64::from(step + 1) * h), fmu.set_states(&x)), (OK, OK));
        if fmu.completed() {
            assert_eq!(fmu.enter_event(), OK);
            assert!(!fmu.update(), "no quaternion has left unit length");
            assert_eq!(fmu.enter_continuous(), OK);
            events += 1;
        }
    }
    events
}

fn begin_exchange(fmu: &mut Importer) {
    assert_eq!(fmu.begin(0.0), OK, "{}", fmu.last());
    assert!(!fmu.update());
    assert_eq!(fmu.enter_continuous(), OK);
}

#[test]
fn model_exchange_gets_where_the_executive_gets() {
    let (scene, unit) = unit("model_exchange", &Options::default());
    let mut executive = simulation(&scene);
    let ball = executive.bodies().next().unwrap().0;
    let mut fmu = Importer::new(&unit, true).unwrap();
    begin_exchange(&mut fmu);
    let events = run_exchange(&mut fmu, 0, 1000, 1e-4);
    executive.run_for(0.1).unwrap();
    assert!(executive.world().contact_count() > 0 && fmu.get_flag("contact.touching"));
    assert!((1..10).contains(&events), "{events} events: one for each touch and release");
    let position: [f64; 3] = fmu.get_vector(&format!("{BALL}.position"));
    let apart = (executive.pose(ball).position - pong_executive::Vec3::from(position)).norm();
    assert!(apart < 1e-9, "{apart} m");
}

#[test]
fn saved_states_go_on_to_the_same_bits_in_both_kinds() {
    let (_, unit) = unit("states", &Options::default());
    for is_exchange in [true, false] {
        let mut fmu = Importer::new(&unit, is_exchange).unwrap();
        let run = |fmu: &mut Importer, from: u32, to: u32| match is_exchange {
            true => {
                run_exchange(fmu, from, to, 1e-4);
            }
            false => {
                let length = f64::from(to - from) * 1e-4;
                assert_eq!(fmu.do_step(f64::from(from) * 1e-4, length), OK, "{}", fmu.last());
            }
        };
        match is_exchange {
            true => begin_exchange(&mut fmu),
            false => assert_eq!(fmu.begin(0.0), OK),
        }
        assert_eq!(fmu.set_vector(&format!("{BALL}.applied_force"), &[0.5, 0.0, -3.0]), OK);
        run(&mut fmu, 0, 400);
        assert!(fmu.get_flag("contact.touching"), "saved out of contact");
        let middle = fmu.save();
        run(&mut fmu, 400, 600);
        let end = fmu.save();
        assert_ne!(middle, end);
        assert_eq!(fmu.restore(&middle), OK, "{}", fmu.last());
        assert_eq!(fmu.save(), middle);
        run(&mut fmu, 400, 600);
        assert_eq!(fmu.save(), end, "the same instance");
        let mut other = Importer::new(&unit, is_exchange).unwrap();
        assert_eq!(other.restore(&middle), OK, "{}", other.last());
        let depth = other.get("contact.largest_depth");
        assert!(depth > 0.0, "outputs are those of the saved instant");
        run(&mut other, 400, 600);
        assert_eq!(other.save(), end, "another instance");

        // Bytes that are not a state of this instance are refused, and nothing changes.
        let mut damaged = middle.clone();
        damaged[200] ^= 4;
        for (bytes, told) in [
            (&middle[..middle.len() - 8], "damaged"),
            (&damaged[..], "damaged"),
            (&middle[..3], "no state of an FMU"),
            (&[], "no state of an FMU"),
        ] {
            assert_eq!(other.restore(bytes), ERROR);
            assert!(other.last().contains(told), "{}", other.last());
        }
        assert_eq!(other.save(), end);
        let mut kind = Importer::new(&unit, !is_exchange).unwrap();
        assert_eq!(kind.restore(&middle), ERROR);
        assert!(kind.last().contains("the other kind"), "{}", kind.last());
    }
}

/// A scene with long frames is a slow host for an importer that calls at 50 Hz: its copies are in the saved state.
#[test]
fn long_frames_are_those_of_the_executive_and_are_saved() {
    let folder = scratch("long_frames");
    let scene = write_scene(&folder, "");
    let text = std::fs::read_to_string(&scene).unwrap();
    let text = text.replace("RungeKutta4, step: 1e-4", "LongFrame(substeps_max: 500), step: 0.02");
    std::fs::write(&scene, text).unwrap();
    let unit = unpack(&make(&scene, Fmi::V3, &Options::default()), &folder.join("unit"));
    let mut executive = simulation(&scene);
    let ball = executive.bodies().next().unwrap().0;
    let mut fmu = Importer::new(&unit, false).unwrap();
    assert_eq!(fmu.begin(0.0), OK, "{}", fmu.last());
    let mut middle = Vec::new();
    for frame in 0..20_u32 {
        if frame == 8 {
            middle = fmu.save();
        }
        assert_eq!(fmu.do_step(f64::from(frame) * 0.02, 0.02), OK, "{}", fmu.last());
        executive.step().unwrap();
        let position = executive.pose(ball).position;
        assert_eq!(fmu.get_vector(&format!("{BALL}.position")), <[f64; 3]>::from(position));
        assert!(position.z > 0.09 && position.z < 0.11, "{position}");
    }
    let end = fmu.save();
    let mut other = Importer::new(&unit, false).unwrap();
    assert_eq!(other.restore(&middle), OK, "{}", other.last());
    (8..20).for_each(|frame| assert_eq!(other.do_step(f64::from(frame) * 0.02, 0.02), OK));
    assert_eq!(other.save(), end);
}

/// The impulse of contact in a communication step is the mean force times the step: the change of momentum
/// less that by gravity. The wrench at an instant misses a bounce that begins and ends within the step.
#[test]
fn mean_forces_are_momentum_over_the_step() {
    let options = Options { step_means: true, ..Options::default() };
    for integrator in ["RungeKutta4", "SemiImplicitEuler", "ZeroOrderHold(delay_frames: 1)"] {
        let folder = scratch(&format!("means_{}", &integrator[..4]));
        let scene = write_scene(&folder, "");
        let text = std::fs::read_to_string(&scene).unwrap();
        std::fs::write(&scene, text.replace("integrator: RungeKutta4", &format!("integrator: {integrator}")))
            .unwrap();
        let unit = unpack(&make(&scene, Fmi::V3, &options), &folder.join("unit"));
        let mut fmu = Importer::new(&unit, false).unwrap();
        assert_eq!(fmu.begin(0.0), OK, "{}", fmu.last());
        let mean = |fmu: &mut Importer| fmu.get_vector::<3>(&format!("{BALL}.mean_contact_force"));
        assert_eq!(
            mean(&mut fmu),
            fmu.get_vector(&format!("{BALL}.contact_force")),
            "of the instant at the start"
        );
        let (length, mut time, mut bounced) = (0.03, 0.0, false);
        for _ in 0..3 {
            let before: [f64; 3] = fmu.get_vector(&format!("{BALL}.state.velocity"));
            assert_eq!(fmu.do_step(time, length), OK, "{}", fmu.last());
            time += length;
            let after: [f64; 3] = fmu.get_vector(&format!("{BALL}.state.velocity"));
            let (mean, instant) = (mean(&mut fmu), fmu.get_vector::<3>(&format!("{BALL}.contact_force")));
            for (axis, gravity) in [0.0, 0.0, -9.81].into_iter().enumerate() {
                // The mass is 1 kg.
                let expected = (after[axis] - before[axis]) / length - gravity;
                assert!(
                    (mean[axis] - expected).abs() < 1e-10 * (1.0 + expected.abs()),
                    "{integrator}, {axis}: {mean:?}"
                );
            }
            bounced |= mean[2] > 0.1 && (instant[2] - mean[2]).abs() > 0.1 * mean[2];
            let saved = fmu.save();
            let mut other = Importer::new(&unit, false).unwrap();
            assert_eq!(other.restore(&saved), OK, "{}", other.last());
            assert_eq!(other.get_vector::<3>(&format!("{BALL}.mean_contact_force")), mean);
        }
        assert!(bounced, "{integrator}: no bounce that the instant misses");
    }
    let (_, plain) = unit("no_means", &Options::default());
    assert!(!plain.references.keys().any(|name| name.contains("mean_contact")));
}

#[test]
fn reset_is_a_new_instance() {
    let (_, unit) = unit("reset", &Options::default());
    let mut fresh = Importer::new(&unit, false).unwrap();
    let mut used = Importer::new(&unit, false).unwrap();
    assert_eq!(used.set("surface.ball.skin.friction_scale", 0.5), OK);
    assert_eq!(used.set(&format!("{BALL}.start.position[3]"), 0.3), OK);
    assert_eq!((used.begin(0.0), used.do_step(0.0, 0.05), used.reset()), (OK, OK, OK));
    assert_eq!((fresh.begin(0.0), used.begin(0.0)), (OK, OK));
    assert_eq!((fresh.do_step(0.0, 0.05), used.do_step(0.0, 0.05)), (OK, OK));
    assert_eq!(fresh.save(), used.save());
}

#[test]
fn parameters_set_the_start_and_the_surfaces() {
    let (_, unit) = unit("parameters", &Options::default());
    let mut fmu = Importer::new(&unit, false).unwrap();
    let z = format!("{BALL}.position[3]");
    assert_eq!(fmu.set(&format!("{BALL}.start.position[3]"), 0.0999), OK);
    assert_eq!(fmu.enter_initialization(), OK);
    assert_eq!(fmu.get(&z), 0.0999);
    // 1e5 N/m, 0.1 mm deep, approaching at ω × r: the damping adds to it.
    let force = fmu.get(&format!("{BALL}.contact_force[3]"));
    assert_eq!(fmu.set("surface.ball.skin.stiffness_scale", 3.0), OK);
    let stiffer = fmu.get(&format!("{BALL}.contact_force[3]"));
    assert!((stiffer - force - 2.0 * 1e5 * 1e-4).abs() < 1e-6, "{force} N, {stiffer} N");
    assert_eq!(fmu.set("surface.ball.skin.stiffness_scale", 0.0), DISCARD);
    assert!(fmu.last().contains("above zero"), "{}", fmu.last());
    assert_eq!(fmu.exit_initialization(), OK);
    assert_eq!(fmu.set("surface.ball.skin.stiffness_scale", 1.0), ERROR);
    assert!(fmu.last().contains("call it before initialization or in initialization mode"), "{}", fmu.last());

    let mut turned = Importer::new(&unit, false).unwrap();
    assert_eq!(turned.set(&format!("{BALL}.start.orientation[1]"), 2.0), OK);
    assert_eq!(turned.begin(0.0), DISCARD);
    assert!(turned.last().contains("`my ball`") && turned.last().contains("norm 2"), "{}", turned.last());
    assert_eq!(turned.set(&format!("{BALL}.start.orientation[1]"), 1.0), OK);
    assert_eq!(turned.exit_initialization(), OK, "what was refused can be mended");
}

#[test]
fn the_importer_moves_the_bodies_that_it_says() {
    let options = Options { inputs: vec!["my ball".to_owned()], ..Options::default() };
    let (_, unit) = unit("inputs", &options);
    assert!(!unit.references.keys().any(|name| name.contains("der(") || name.contains("applied")));
    for is_exchange in [true, false] {
        let mut fmu = Importer::new(&unit, is_exchange).unwrap();
        let twist = |fmu: &mut Importer| fmu.set_vector(&format!("{BALL}.angular_velocity"), &[0.0; 3]);
        assert_eq!((fmu.set(&format!("{BALL}.position[3]"), 0.0999), twist(&mut fmu)), (OK, OK));
        assert_eq!(fmu.set(&format!("{BALL}.linear_velocity[1]"), 0.01), OK);
        match is_exchange {
            true => begin_exchange(&mut fmu),
            false => assert_eq!(fmu.begin(0.0), OK),
        }
        // No vertical velocity: k·δ. Sideways the bristle has not moved yet, but its damper acts: c·v.
        let force = |fmu: &mut Importer| fmu.get_vector::<3>(&format!("{BALL}.contact_force"));
        let [x, _, z] = force(&mut fmu);
        assert!((z - 10.0).abs() < 1e-9 && (x + 0.05).abs() < 1e-3, "{x} N, {z} N");
        // 0.1 ms later it has moved by 1 µm; the bristle's stiffness is ⅔ of the normal one.
        if is_exchange {
            assert_eq!((fmu.set_time(1e-4), fmu.set(&format!("{BALL}.position[1]"), 1e-6)), (OK, OK));
        } else {
            assert_eq!(fmu.do_step(0.0, 1e-4), OK, "{}", fmu.last());
        }
        let [moved, ..] = force(&mut fmu);
        assert!((moved - x + 1e5 * 2.0 / 3.0 * 1e-6).abs() < 1e-3 * 0.07, "{is_exchange}: {x} N, {moved} N");

        // An invalid quaternion.
        assert_eq!(fmu.set(&format!("{BALL}.orientation[2]"), 0.5), OK);
        let status = match is_exchange {
            true => fmu.try_get(&format!("{BALL}.contact_force[1]")).unwrap_err(),
            false => fmu.do_step(1e-4, 1e-4),
        };
        assert_eq!(status, DISCARD);
        assert!(fmu.last().contains("give a unit quaternion"), "{}", fmu.last());
        assert_eq!(fmu.set(&format!("{BALL}.orientation[2]"), 0.0), OK);
        if !is_exchange {
            assert_eq!(fmu.do_step(1e-4, 1e-4), OK, "{}", fmu.last());
        }
    }
}

#[test]
fn a_quaternion_that_has_left_unit_length_is_normalised_at_an_event() {
    let (_, unit) = unit("quaternion", &Options::default());
    let mut fmu = Importer::new(&unit, true).unwrap();
    begin_exchange(&mut fmu);
    let mut x = fmu.states();
    x[6..10].iter_mut().for_each(|part| *part *= 1.01);
    assert_eq!((fmu.set_time(1e-4), fmu.set_states(&x)), (OK, OK));
    assert!(fmu.completed());
    assert_eq!(fmu.enter_event(), OK);
    assert!(fmu.update());
    let norm = fmu.states()[6..10].iter().map(|part| part * part).sum::<f64>();
    assert!((norm - 1.0).abs() < 1e-15);
    // Invalid states are refused, and others may succeed.
    let good = fmu.states();
    assert_eq!(fmu.enter_event(), OK);
    for quaternion in [0.0, f64::NAN, f64::INFINITY, 1e200] {
        let mut none = good.clone();
        none[6..10].fill(quaternion);
        assert_eq!((fmu.set_states(&none), fmu.try_update()), (OK, Err(DISCARD)), "{quaternion}");
        assert!(fmu.last().contains("`my ball`") && fmu.last().contains("no direction"), "{}", fmu.last());
        assert_eq!(fmu.try_rates(), Err(DISCARD), "{quaternion}");
    }
    assert_eq!((fmu.set_states(&good), fmu.try_update()), (OK, Ok(false)));
    assert_eq!(fmu.enter_continuous(), OK);
    x[0] = f64::NAN;
    assert_eq!(fmu.set_states(&x), OK);
    assert_eq!(fmu.try_rates(), Err(DISCARD));
    assert!(fmu.last().contains("my ball"), "{}", fmu.last());
    assert_eq!(fmu.set_states(&good), OK);
    assert!(fmu.try_rates().is_ok());
}

#[test]
fn calls_that_are_wrong_are_told_and_change_nothing() {
    let (_, unit) = unit("refused", &Options::default());
    let mut fmu = Importer::new(&unit, false).unwrap();
    assert_eq!(fmu.do_step(0.0, 1e-3), ERROR);
    assert!(fmu.last().contains("DoStep: the instance is before initialization"), "{}", fmu.last());
    assert_eq!(fmu.begin(0.0), OK);
    let before = fmu.save();
    for (status, told) in [
        (fmu.set(&format!("{BALL}.position[1]"), 0.0), "cannot be set"),
        (fmu.set("time", 0.0), "cannot be set"),
        (fmu.set(&format!("{BALL}.applied_force[1]"), f64::INFINITY), "give a finite number"),
        (fmu.set_time(1.0), "SetTime: the instance is between communication steps"),
        (fmu.get_as_integer("contact.count"), "Int32"),
        (fmu.try_get("contact.touching").unwrap_err(), "a Boolean"),
        (fmu.enter_initialization(), "the instance is between communication steps"),
    ] {
        assert!(status == ERROR || status == DISCARD);
        assert!(fmu.told.iter().any(|(_, text)| text.contains(told)), "{told}: {:?}", fmu.told);
    }
    // All or nothing.
    let force = format!("{BALL}.applied_force");
    assert_eq!(fmu.set_vector(&force, &[1.0, 2.0, f64::NAN]), DISCARD);
    assert_eq!(fmu.save(), before);
}

/// The ball flies 0.5 m down in a step of the scene, through the arm.
#[test]
fn the_warning_of_tunnelling_names_object_and_primitive() {
    let (_, unit) = unit("tunnelled", &Options::default());
    let mut fmu = Importer::new(&unit, false).unwrap();
    assert_eq!(fmu.set(&format!("{BALL}.start.position[3]"), 0.8), OK);
    assert_eq!(fmu.set(&format!("{BALL}.start.linear_velocity[3]"), -5e3), OK);
    assert_eq!((fmu.begin(0.0), fmu.get_flag("contact.tunnelled")), (OK, false));
    assert_eq!(fmu.do_step(0.0, 1e-4), OK, "{}", fmu.last());
    assert!(fmu.get_flag("contact.tunnelled"));
    assert!(fmu.last().contains("between two steps, `my ball/ball/s` through `arm/tile`;"), "{}", fmu.last());
    let count = fmu.told.len();
    assert_eq!((fmu.do_step(1e-4, 1e-4), fmu.get_flag("contact.tunnelled")), (OK, false), "{}", fmu.last());
    assert_eq!(fmu.told.len(), count, "{:?}", fmu.told);
}

/// An L 40 mm deep in the upper end of another one. The regions below its bottom are 30 mm high.
#[test]
fn a_solid_deep_in_a_mesh_is_named_and_stays_in_a_saved_state() {
    let folder = scratch("deep_in_mesh");
    std::fs::create_dir_all(&folder).unwrap();
    let model = r#"(format: "pong-model", version: 1, name: "l", surfaces: { "s": (stiffness: 1e5) },
    root: (name: "l", surface: "s", contact: Solid, primitives: [TriangleMesh(name: "mesh", file: "l.obj")]))"#;
    let scene = r#"(format: "pong-scene", version: 1, name: "deep", models: { "l": "l.ron" },
    objects: [
        (name: "lower", model: "l", bodies: [(motion: Fixed)]),
        (name: "upper", model: "l", bodies: [(motion: Fixed, position: (0, 0, 0.119))])],
    pairs: [("lower", "upper")], integrator: SemiImplicitEuler, step: 1e-3, duration: 1e-3)"#;
    for (file, text) in [("l.obj", obj(&l_shape())), ("l.ron", model.into()), ("scene.ron", scene.into())] {
        std::fs::write(folder.join(file), text).unwrap();
    }
    let options = Options { inputs: vec!["upper".into()], ..Options::default() };
    let unit = unpack(&make(&folder.join("scene.ron"), Fmi::V3, &options), &folder.join("unit"));
    let mut fmu = Importer::new(&unit, false).unwrap();
    assert_eq!((fmu.begin(0.0), fmu.get_flag("contact.deep_in_mesh")), (OK, false));
    assert_eq!(fmu.set("upper.position[3]", 0.08), OK);
    assert_eq!(fmu.do_step(0.0, 1e-3), OK, "{}", fmu.last());
    assert!(fmu.get_flag("contact.deep_in_mesh"));
    assert!(fmu.last().contains("than its facets push, `upper/l` in `lower/l`, and"), "{}", fmu.last());
    let mut other = Importer::new(&unit, false).unwrap();
    assert_eq!(other.restore(&fmu.save()), OK, "{}", other.last());
    assert!(other.get_flag("contact.deep_in_mesh"));
}

#[test]
fn files_that_have_changed_are_refused_with_their_names() {
    let (_, unit) = unit("changed", &Options::default());
    assert!(
        Importer::with_token(&unit, false, "0123456789abcdef")
            .is_err_and(|told| { told.contains("instantiation token") && told.contains("0123456789abcdef") })
    );
    for file in ["models/0/ball.ron", "models/2/tile.obj", "scene.ron", "contents.ron"] {
        let path = unit.resources.join(file);
        let good = std::fs::read(&path).unwrap();
        let mut other = good.clone();
        other.push(b'\n');
        std::fs::write(&path, &other).unwrap();
        let told =
            Importer::new(&unit, true).err().unwrap_or_else(|| panic!("{file} has changed, and it runs"));
        let named = if file == "contents.ron" { "instantiation token" } else { file };
        assert!(told.contains(named) && told.contains("make it anew"), "{told}");
        std::fs::remove_file(&path).unwrap();
        let told = Importer::new(&unit, true).err().unwrap();
        assert!(told.contains(file) && told.contains("cannot be read"), "{told}");
        std::fs::write(&path, good).unwrap();
    }
    assert!(Importer::new(&unit, true).is_ok());
}

/// A list that names files outside, with a matching token: none of them is opened or revealed.
#[test]
fn nothing_outside_its_folder_is_read() {
    let (scene, unit) = unit("outside", &Options::default());
    let list = unit.resources.join("contents.ron");
    let good = std::fs::read_to_string(&list).unwrap();
    let outside = std::fs::canonicalize(&scene).unwrap().with_file_name("ball.ron").display().to_string();
    let refused = |text: &str, told: &str| {
        std::fs::write(&list, text).unwrap();
        let token = format!("{:016x}", pong_model::Fnv::of(text.as_bytes()));
        let line =
            Importer::with_token(&unit, true, &token).err().unwrap_or_else(|| panic!("{told}: it runs"));
        assert!(line.contains(told), "{line}");
        let plain = Importer::new(&unit, true).err().unwrap();
        assert!(text == good || !plain.contains(&token), "the token that fits is told: {plain}");
    };
    for place in [outside.as_str(), "../../ball.ron", "models/../../../ball.ron", "./models/0/ball.ron", ""] {
        refused(&good.replace("\"models/0/ball.ron\"", &format!("{place:?}")), "leads out of the folder");
    }
    refused(&good.replacen("\"models/0/ball.ron\"", "\"models/9/ball.ron\"", 1), "not among its files");
    // A link that leads out, in place of each file.
    for file in ["models/0/ball.ron", "models/2/tile.obj", "scene.ron", "contents.ron"] {
        let path = unit.resources.join(file);
        std::fs::write(&list, &good).unwrap();
        let away = scene.with_file_name("away");
        std::fs::rename(&path, &away).unwrap();
        std::os::unix::fs::symlink(std::fs::canonicalize(&away).unwrap(), &path).unwrap();
        let line =
            Importer::new(&unit, true).err().unwrap_or_else(|| panic!("{file} is a link, and it runs"));
        assert!(line.contains(file) && line.contains("outside the folder"), "{line}");
        std::fs::remove_file(&path).unwrap();
        std::fs::rename(&away, &path).unwrap();
    }
    std::fs::write(&list, &good).unwrap();
    assert!(Importer::new(&unit, true).is_ok());
}
