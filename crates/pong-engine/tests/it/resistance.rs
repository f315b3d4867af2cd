//! Couples that resist rolling and spinning (docs/theory.md, 4).

use crate::common::*;
use pong_engine::{Config, State, WorkerSettings, World, WorldBuilder};
use pong_geometry::{Quat, Vec3};
use pong_model::FrictionLaw;
use pong_testkit::Random;

/// Balls on a plate of triangles, and a wheel on a plane.
fn models(friction: &str) -> [String; 2] {
    let rubber = surface(1e5, &format!("normal: Linear(damping: 0.0), friction: {friction}"));
    let movers = "Sphere(name: \"ball\", center: (0.0,0.0,0.0), radius: 0.1), \
                  Capsule(name: \"bar\", ends: ((-0.2,0.3,-0.05),(0.2,0.3,-0.05)), radius: 0.05), \
                  Cylinder(name: \"wheel\", ends: ((0.0,-0.3,0.1),(0.1,-0.3,0.1)), radius: 0.2), \
                  Ellipsoid(name: \"egg\", center: (0.4,0.0,-0.04), semi_axes: (0.1,0.08,0.06))";
    let grounds = [
        plate_mesh("plate", 8, 1.0, |x, y| Vec3::new(x, y, 0.0)),
        "Plane(name: \"floor\", normal: (0.0,0.0,1.0), offset: 0.0)".to_owned(),
    ];
    [model("movers", &rubber, movers), model("grounds", &rubber, &grounds.join(","))]
}

/// A ball alone, and the same grounds.
fn balls_and_grounds() -> [String; 2] {
    let [_, grounds] = models(RESISTING);
    let rubber = surface(1e5, &format!("friction: {RESISTING}"));
    [model("ball", &rubber, "Sphere(name: \"ball\", center: (0,0,0), radius: 0.1)"), grounds]
}

const RESISTING: &str = "Bristle(mu: 0.4, stiffness: 7e4, damping: 0.0, rolling: 2e-3, spinning: 1e-3)";

fn rig(config: Config) -> Rig {
    let [a, b] = models(RESISTING);
    Rig::with_config(config, &a, &b)
}

/// Smooth motion in which the deepest contacts last and others come and go.
fn path(t: f64) -> State {
    let wave =
        |amplitude: f64, pace: f64| (amplitude * (pace * t).sin(), amplitude * pace * (pace * t).cos());
    let ((x, vx), (y, vy), (z, vz)) = (wave(0.05, 3.0), wave(0.04, 5.0), wave(2e-3, 23.0));
    let ((roll, _), (pitch, _), (yaw, _)) = (wave(4e-3, 9.0), wave(3e-3, 7.0), wave(0.2, 4.0));
    moving(
        Vec3::new(x, y, 0.0985 + z),
        Quat::from_scaled_axis(Vec3::new(roll, pitch, yaw)),
        Vec3::new(vx, vy, vz),
        Vec3::new(0.0, 0.0, 0.0),
    )
}

fn step(rig: &mut Rig, t: f64) {
    rig.place([path(t), State::identity()]);
    rig.world.step().unwrap();
}

fn saved(world: &World) -> Vec<u8> {
    let mut block = vec![0; world.state_size()];
    world.save_state(&mut block).unwrap();
    block
}

/// Sum of the forces, N, and of the moments about the common origin, N·m, of the couples alone.
fn couples(world: &World) -> (Vec3, Vec3) {
    let couples = world.contacts().into_iter().filter(|contact| contact.end >= 1 << 30);
    couples.fold((Vec3::zeros(), Vec3::zeros()), |(force, moment), contact| {
        (force + contact.force, moment + contact.point.cross(&contact.force))
    })
}

/// A ball that turns about any axis is resisted by b_r·F_n against rolling and b_s·F_n against spinning. The
/// couple has no resultant force, and its forces lie in the contact plane.
#[test]
fn couples_have_their_limits() {
    let ball = "Sphere(name: \"ball\", center: (0,0,0), radius: 0.1)";
    let plane = "Plane(name: \"floor\", normal: (0,0,1), offset: 0)";
    let smooth = surface(1e5, "friction: Bristle(mu: 0, stiffness: 7e4, rolling: 2e-3, spinning: 1e-3)");
    for axis in [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.3, -0.9, 0.1], [1e-9, 0.0, 1.0]] {
        let axis = Vec3::from(axis).normalize();
        let mut rig = Rig::new(&model("ball", &smooth, ball), &model("plane", &smooth, plane));
        for frame in 0..200 {
            let turn = Quat::from_scaled_axis(axis * (f64::from(frame) * 2e-3));
            let state = moving(Vec3::new(0.0, 0.0, 0.099), turn, Vec3::zeros(), axis * 2.0);
            rig.place([state, State::identity()]);
            rig.world.step().unwrap();
        }
        let (force, moment) = couples(&rig.world);
        // Two surfaces with the same lengths have twice the length together; F_n = ½·1e5·1e-3 N. An angle that is
        // too small for the limit stretches the bristle of k_t = 3.5e4 N/m at the lever of 0.1 m.
        let across = Vec3::new(axis.x, axis.y, 0.0);
        let elastic: f64 = 3.5e4 * 0.1 * 0.1 * 199.0 * 2e-3;
        let rolling = across * -elastic.min(50.0 * 4e-3 / across.norm().max(1e-300));
        let expected = rolling + Vec3::new(0.0, 0.0, -50.0 * 2e-3 * if axis.z > 0.0 { 1.0 } else { 0.0 });
        assert!(force.norm() < 1e-13, "{axis:?}: {force:?}");
        assert!((moment - expected).norm() < 1e-9, "{axis:?}: {moment:?} against {expected:?}");
        for contact in rig.world.contacts() {
            assert!(
                contact.friction_force.dot(&contact.normal).abs() <= 1e-6 * contact.friction_force.norm()
            );
        }
    }
}

/// A ball that turns at random about its centre, on a plate of triangles and on a plane, loses energy in every step.
#[test]
fn couples_make_no_energy() {
    let [a, b] = balls_and_grounds();
    let mut rig = Rig::with_config(Config { ledger: true, ..Config::default() }, &a, &b);
    let mut random = Random(7);
    let (mut lost, mut placed, mut orientation) = (0.0, 0.0, Quat::identity());
    for frame in 0..2000 {
        let turn = Vec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        orientation = Quat::from_scaled_axis(turn * 2e-4) * orientation;
        rig.place([at(Vec3::new(0.02, 0.01, 0.0985), orientation), State::identity()]);
        rig.world.step().unwrap();
        // The first frame has no earlier pose, so the energy stored in it was not taken from a body.
        let now = rig.world.ledger().dissipated;
        assert!(frame == 0 || now >= lost - 1e-12, "frame {frame}: {lost} J, then {now} J");
        placed = if frame == 0 { now } else { placed };
        lost = now;
    }
    assert!(lost > placed + 1e-3, "{placed} J, then {lost} J");
}

#[test]
fn couples_have_the_same_bits_with_workers_and_after_a_restore() {
    let settings = WorkerSettings { workers: 2, oversubscribe: true, ..WorkerSettings::default() };
    let mut alone = rig(Config::default());
    let mut crew = rig(Config { workers: Some(settings), ..Config::default() });
    let mut restored = rig(Config::default());
    let mut most = 0;
    for frame in 0..400 {
        let t = f64::from(frame) * 2e-3;
        step(&mut alone, t);
        step(&mut crew, t);
        most = most.max(alone.world.contacts().iter().filter(|contact| contact.end >= 1 << 30).count());
        if frame == 200 {
            restored.world.restore_state(&saved(&alone.world)).unwrap();
        } else if frame > 200 {
            step(&mut restored, t);
            assert_eq!(saved(&alone.world), saved(&restored.world), "frame {frame}");
        }
        assert_eq!(saved(&alone.world), saved(&crew.world), "frame {frame}");
        assert_eq!(alone.wrench(0), crew.wrench(0), "frame {frame}");
    }
    assert!(most >= 10, "{most}");
}

/// Lengths of zero leave every bit and every contact as they are; a host may set them between frames.
#[test]
fn surfaces_without_lengths_have_no_couples() {
    let bristle = |more: &str| format!("Bristle(mu: 0.4, stiffness: 7e4{more})");
    let [a, b] = models(&bristle(""));
    let [zero_a, zero_b] = models(&bristle(", rolling: 0, spinning: 0"));
    let (mut plain, mut zero) = (Rig::new(&a, &b), Rig::new(&zero_a, &zero_b));
    for frame in 0..100 {
        let t = f64::from(frame) * 2e-3;
        step(&mut plain, t);
        step(&mut zero, t);
        assert_eq!(saved(&plain.world), saved(&zero.world), "frame {frame}");
    }
    assert!(plain.world.contacts().iter().all(|contact| contact.end < 1 << 30));
    let ids: Vec<_> = plain.world.scene().models().map(|(id, _)| id).collect();
    let mut rubber = plain.world.surface(ids[0], "s").unwrap().clone();
    if let FrictionLaw::Bristle { rolling, .. } = &mut rubber.friction {
        *rolling = 1e-3;
    }
    plain.world.set_surface(ids[0], &rubber).unwrap();
    step(&mut plain, 0.2);
    assert!(plain.world.contacts().iter().any(|contact| contact.end >= 1 << 30));
    if let FrictionLaw::Bristle { rolling, .. } = &mut rubber.friction {
        *rolling = -1e-3;
    }
    plain.world.set_surface(ids[0], &rubber).unwrap_err();
}

#[test]
fn solids_with_a_length_are_refused() {
    let rubber = surface(1e5, "friction: Bristle(mu: 0.4, spinning: 1e-3)");
    let block = box_polyhedron("block", [0.0; 3], [0.1; 3], "");
    let solid = model("block", &rubber, &block).replace("root: (", "root: (contact: Solid, ");
    let plane = model("plane", &rubber, "Plane(name: \"floor\", normal: (0,0,1), offset: 0)");
    let mut builder = WorldBuilder::new(Config::default());
    let objects = [&solid, &plane].map(|text| {
        let model = load(&mut builder, text);
        builder.create_object(model, if text == &solid { "block" } else { "plane" }).unwrap()
    });
    builder.pair(objects[0], objects[1]).unwrap();
    let refused = builder.seal().err().expect("sealing refuses it").to_string();
    assert!(refused.contains("`spinning`") && refused.contains("contact: Marked"), "{refused}");
}
