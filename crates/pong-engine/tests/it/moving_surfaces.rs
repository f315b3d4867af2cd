//! Surfaces that move along themselves: belts, tracks and turntables (docs/theory.md, 4).

use crate::common::*;
use pong_engine::{Config, State, SurfaceMotion, WorkerSettings, WrenchCoupling};
use pong_geometry::{Quat, Vec3};
use pong_testkit::ron::box_polyhedron;

const FLOOR: &str = "Plane(name: \"floor\", normal: (0.0,0.0,1.0), offset: 0.0)";

fn rubber(friction: &str) -> String {
    surface(1e5, &format!("foundation: 2e7, normal: Linear(damping: 10.0), friction: {friction}"))
}

/// Movers of every kind, some of which touch z = 0.
fn movers() -> String {
    let parts = [
        "Point(name: \"tip\", position: (0.6,0.0,-0.1))".to_owned(),
        "Sphere(name: \"ball\", center: (0.0,0.0,0.0), radius: 0.1)".to_owned(),
        "LineSegment(name: \"edge\", ends: ((-0.6,0.0,-0.1),(-0.5,0.1,-0.1)))".to_owned(),
        "Capsule(name: \"bar\", ends: ((-0.2,0.3,-0.05),(0.2,0.3,-0.05)), radius: 0.05)".to_owned(),
        "Cylinder(name: \"wheel\", ends: ((0.0,-0.3,0.1),(0.1,-0.3,0.1)), radius: 0.2)".to_owned(),
        "Ellipsoid(name: \"egg\", center: (0.4,0.0,-0.04), semi_axes: (0.1,0.08,0.06))".to_owned(),
        box_polyhedron("box", [0.4, 0.4, 0.0], [0.1; 3], ""),
        "Ray(name: \"plunger\", origin: (0.3,-0.4,0.2), direction: (0.0,0.0,-1.0), length: 0.3)".to_owned(),
    ];
    parts.join(",")
}

fn plate() -> String {
    plate_mesh("plate", 8, 1.0, |x, y| Vec3::new(x, y, 0.0))
}

const BRISTLE: &str = "Bristle(mu: 0.4, static_excess: 0.1, stiffness: 7e4, rolling: 2e-3, spinning: 1e-3)";

fn rig(config: Config, friction: &str) -> Rig {
    let config = Config { moving_surfaces: true, ..config };
    let rubber = rubber(friction);
    Rig::with_config(
        config,
        &model("movers", &rubber, &movers()),
        &model("grounds", &rubber, &[plate(), FLOOR.to_owned()].join(",")),
    )
}

/// Solids: a box on a slab. Their friction has no couples.
fn solids(config: Config, friction: &str) -> Rig {
    solids_with(Config { moving_surfaces: true, ..config }, friction)
}

fn still_solids() -> Rig {
    solids_with(Config::default(), BRISTLE)
}

fn solids_with(config: Config, friction: &str) -> Rig {
    let friction = &friction.replace(", rolling: 2e-3, spinning: 1e-3", "");
    let solid = |name: &str, primitive: &str| {
        // Cells at the edges of the box push sideways, and their dampers would feel the motion of the body.
        let rubber =
            rubber(friction).replace("normal: Linear(damping: 10.0)", "normal: Linear(damping: 0.0)");
        model(name, &rubber, primitive).replace("surface: \"s\",", "surface: \"s\", contact: Solid,")
    };
    let slab = box_polyhedron("slab", [0.0, 0.0, -0.1], [2.0, 2.0, 0.1], "");
    Rig::with_config(
        config,
        &solid("box", &box_polyhedron("box", [0.0; 3], [0.1; 3], "")),
        &solid("slab", &slab),
    )
}

/// Motion of a surface with all three parts at a time, s.
fn surface_at(t: f64) -> SurfaceMotion {
    let mut motion = SurfaceMotion {
        linear_velocity: [0.2, -0.1, 0.0],
        angular_velocity: [0.0, 0.0, 0.5],
        belt_velocity: [0.05, 0.1, 0.0],
        ..SurfaceMotion::default()
    };
    motion.advance(t);
    motion
}

/// Movers that stay over one spot, and press on and off.
fn hover(t: f64) -> State {
    let (z, vz) = (2e-3 * (23.0 * t).sin(), 2e-3 * 23.0 * (23.0 * t).cos());
    moving(Vec3::new(0.0, 0.0, 0.0985 + z), Quat::identity(), Vec3::new(0.0, 0.0, vz), Vec3::zeros())
}

fn step_with(rig: &mut Rig, state: State, surfaces: [SurfaceMotion; 2]) {
    rig.place([state, State::identity()]);
    let [a, b] = rig.interfaces;
    rig.world.set_surface_motions(&[(a, surfaces[0]), (b, surfaces[1])]).unwrap();
    rig.world.step().unwrap();
}

fn saved(rig: &Rig) -> Vec<u8> {
    let mut block = vec![0; rig.world.state_size()];
    rig.world.save_state(&mut block).unwrap();
    block
}

/// A belt that moves the surface against resting movers does what movers do that move against a resting surface:
/// the contacts have the same forces, and the same deflections follow in the frames after.
#[test]
fn a_moving_surface_rubs_as_a_moving_body_does() {
    let pressed = |x: f64, v: f64| {
        moving(Vec3::new(x, 0.0, 0.0985), Quat::identity(), Vec3::new(v, 0.0, 0.0), Vec3::zeros())
    };
    for friction in [
        "Bristle(mu: 0.4, static_excess: 0.1, stiffness: 7e4, damping: 20.0)",
        "Coulomb(mu: 0.4, slip_speed: 0.01)",
    ] {
        for (of_solids, side) in [(false, 0), (false, 1), (true, 0), (true, 1)] {
            let make = || {
                if of_solids { solids(Config::default(), friction) } else { rig(Config::default(), friction) }
            };
            let (mut by_surface, mut by_body) = (make(), make());
            for frame in 0..60 {
                let t = f64::from(frame) * 1e-3;
                // A sine that sticks, slips and comes back.
                let (x, v) = (2e-4 * (60.0 * t).sin(), 2e-4 * 60.0 * (60.0 * t).cos());
                let sign = if side == 0 { 1.0 } else { -1.0 };
                let motion = SurfaceMotion {
                    linear_velocity: [sign * v, 0.0, 0.0],
                    linear_travel: [sign * x, 0.0, 0.0],
                    ..SurfaceMotion::default()
                };
                let mut surfaces = [SurfaceMotion::default(); 2];
                surfaces[side] = motion;
                step_with(&mut by_surface, pressed(0.0, 0.0), surfaces);
                by_body.place([pressed(x, v), State::identity()]);
                by_body.world.step().unwrap();
                let (one, other) = (by_surface.wrench(0).force, by_body.wrench(0).force);
                assert!(
                    (one - other).norm() < 1e-6 * other.norm(),
                    "{friction} {of_solids} {side} {frame}: {one:?} {other:?}"
                );
            }
            assert!(by_body.world.contact_count() >= if of_solids { 3 } else { 8 });
        }
    }
}

/// A turntable under a resting solid resists as a solid that turns on a resting plane.
#[test]
fn a_turning_surface_twists_as_a_turning_body_does() {
    let friction = "Bristle(mu: 0.4, stiffness: 7e4, damping: 20.0)";
    let (mut by_surface, mut by_body) =
        (solids(Config::default(), friction), solids(Config::default(), friction));
    for frame in 0..40 {
        let t = f64::from(frame) * 1e-3;
        let (angle, rate) = (2e-3 * (60.0 * t).sin(), 2e-3 * 60.0 * (60.0 * t).cos());
        let motion = SurfaceMotion {
            angular_velocity: [0.0, 0.0, -rate],
            angular_travel: [0.0, 0.0, -angle],
            ..SurfaceMotion::default()
        };
        step_with(
            &mut by_surface,
            at(Vec3::new(0.0, 0.0, 0.0985), Quat::identity()),
            [SurfaceMotion::default(), motion],
        );
        let turned = Quat::from_scaled_axis(Vec3::z() * angle);
        by_body.place([
            moving(Vec3::new(0.0, 0.0, 0.0985), turned, Vec3::zeros(), Vec3::z() * rate),
            State::identity(),
        ]);
        by_body.world.step().unwrap();
        let (one, other) = (by_surface.wrench(0).moment.z, by_body.wrench(0).moment.z);
        assert!((one - other).abs() < 1e-3 * (1.0 + other.abs()), "{frame}: {one} {other}");
    }
}

/// The belt velocity is that of the outward normal's cross product: along +x on top, −z at the front, −x below.
#[test]
fn a_belt_runs_around_its_group() {
    let tip = "Point(name: \"tip\", position: (0,0,0))";
    let friction = "Coulomb(mu: 0.4, slip_speed: 0.01)";
    for (place, direction) in
        [([0.0, 0.0, 0.099], Vec3::x()), ([0.099, 0.0, 0.0], -Vec3::z()), ([0.0, 0.0, -0.099], -Vec3::x())]
    {
        let belt = box_polyhedron("belt", [0.0; 3], [0.1; 3], "");
        let moving = || Config { moving_surfaces: true, ..Config::default() };
        let mut rig = Rig::with_config(
            moving(),
            &model("tip", &rubber(friction), tip),
            &model("belt", &rubber(friction), &belt),
        );
        let motion = SurfaceMotion { belt_velocity: [0.0, 2.0, 0.0], ..SurfaceMotion::default() };
        step_with(&mut rig, at(Vec3::from(place), Quat::identity()), [SurfaceMotion::default(), motion]);
        let contact = rig.world.contacts()[0];
        assert!(
            (contact.slip_velocity + direction * 2.0).norm() < 1e-12,
            "{direction:?}: {:?}",
            contact.slip_velocity
        );
        assert!(contact.friction_force.dot(&direction) > 0.0);
        // The belt is A: its own normal points the other way.
        let ball = "Sphere(name: \"ball\", center: (0,0,0), radius: 0.1)";
        let mut other = Rig::with_config(
            moving(),
            &model("ball", &rubber(friction), ball),
            &model("floor", &rubber(friction), FLOOR),
        );
        step_with(
            &mut other,
            at(Vec3::new(0.0, 0.0, 0.099), Quat::identity()),
            [motion, SurfaceMotion::default()],
        );
        assert!((other.world.contacts()[0].slip_velocity + Vec3::x() * 2.0).norm() < 1e-12);
        assert!(other.wrench(0).force.x > 0.0);
    }
}

/// Surfaces at rest that were set to be at rest leave every bit; so does a surface that never meets another.
#[test]
fn surfaces_at_rest_leave_every_bit() {
    let (mut never_set, mut at_rest) = (rig(Config::default(), BRISTLE), rig(Config::default(), BRISTLE));
    for frame in 0..100 {
        let state = hover(f64::from(frame) * 2e-3);
        never_set.place([state, State::identity()]);
        never_set.world.step().unwrap();
        step_with(&mut at_rest, state, [SurfaceMotion::default(); 2]);
        assert_eq!(told(&never_set.world), told(&at_rest.world));
        assert_eq!(saved(&never_set), saved(&at_rest));
    }
}

#[test]
fn moving_surfaces_have_the_same_bits_with_workers_and_after_a_restore() {
    for make in [rig, solids] {
        let mut alone = make(Config::default(), BRISTLE);
        let mut crews = [1, 2, 3].map(|workers| {
            let settings = WorkerSettings { workers, oversubscribe: true, ..WorkerSettings::default() };
            make(Config { workers: Some(settings), ..Config::default() }, BRISTLE)
        });
        let mut restored = make(Config::default(), BRISTLE);
        for frame in 0..200 {
            let t = f64::from(frame) * 2e-3;
            let surfaces = [surface_at(-0.5 * t), surface_at(t)];
            step_with(&mut alone, hover(t), surfaces);
            for crew in &mut crews {
                step_with(crew, hover(t), surfaces);
                assert_eq!(saved(&alone), saved(crew), "frame {frame}");
                assert_eq!(told(&alone.world), told(&crew.world), "frame {frame}");
            }
            if frame == 100 {
                restored.world.restore_state(&saved(&alone)).unwrap();
            } else if frame > 100 {
                step_with(&mut restored, hover(t), surfaces);
                assert_eq!(saved(&alone), saved(&restored), "frame {frame}");
            }
        }
        let mut clone = alone.world.try_clone().unwrap();
        let mut extended = pong_engine::WorldBuilder::extending(&alone.world).seal().unwrap().0;
        extended.continue_from(&alone.world).unwrap();
        for world in [&mut alone.world, &mut clone, &mut extended] {
            world.set_surface_motion(alone.interfaces[1], &surface_at(0.41)).ok();
        }
        assert_eq!(
            extended
                .surface_motion(
                    extended.scene().interfaces(extended.scene().object("b").unwrap()).unwrap()[0]
                )
                .unwrap()
                .linear_velocity,
            [0.2, -0.1, 0.0]
        );
    }
}

/// The travels of a pair are those since its own last commit.
#[test]
fn commits_of_some_pairs_keep_the_travels_of_the_others() {
    let friction = "Bristle(mu: 10.0, stiffness: 1e4, damping: 0.0)";
    let make = || solids(Config::default(), friction);
    let belt = |x: f64| SurfaceMotion { linear_travel: [x, 0.0, 0.0], ..SurfaceMotion::default() };
    let pressed = at(Vec3::new(0.0, 0.0, 0.0985), Quat::identity());
    let (mut whole, mut in_part) = (make(), make());
    for rig in [&mut whole, &mut in_part] {
        step_with(rig, pressed, [SurfaceMotion::default(), belt(1.0)]);
    }
    for (rig, travel) in [(&mut whole, 1.0), (&mut in_part, 1.0 + 1e-5)] {
        let interface = rig.interfaces[1];
        rig.world.set_surface_motion(interface, &belt(travel)).unwrap();
        rig.world.commit_pairs(&[]).unwrap();
        rig.world.commit_pairs(&[rig.pair]).unwrap();
        rig.world.set_surface_motion(interface, &belt(1.0 + 2e-5)).unwrap();
        rig.world.step().unwrap();
    }
    let (one, other) = (whole.wrench(0).force, in_part.wrench(0).force);
    assert!(one.x > 0.0 && (one - other).norm() < 1e-9 * one.norm(), "{one:?} {other:?}");
}

/// The drives' work, less what the bodies get, is stored and dissipated, and no step makes energy. The accounts book
/// it as inserted.
#[test]
fn drives_pay_for_what_friction_takes() {
    for make in [rig, solids] {
        let config =
            Config { ledger: true, accounts: Some(WrenchCoupling::SemiImplicit), ..Config::default() };
        let mut rig = make(config, BRISTLE);
        let (mut last, mut lost_in_friction) = (None, 0.0);
        for frame in 0..400 {
            let t = f64::from(frame) * 1e-3;
            step_with(
                &mut rig,
                at(Vec3::new(0.0, 0.0, 0.0985), Quat::identity()),
                [surface_at(-0.5 * t), surface_at(t)],
            );
            let ledger = rig.world.ledger();
            assert!(ledger.work.abs() < 1e-15, "the bodies rest: {}", ledger.work);
            if let Some(last) = last {
                assert!(ledger.dissipated >= last, "frame {frame}: {} J, then {} J", last, ledger.dissipated);
            }
            last = Some(ledger.dissipated);
            let account = rig.world.account();
            let size = account.inserted.abs() + account.friction_loss;
            assert!(account.imbalance().abs() < 1e-12 * size.max(1.0), "{account:?}");
            lost_in_friction = account.friction_loss;
            assert!((ledger.driven() - (ledger.dissipated + ledger.stored)).abs() < 1e-12);
        }
        assert!(lost_in_friction > 1e-2, "{lost_in_friction}");
        assert!(rig.world.pair_accounts().all(|pair| !pair.gains_energy()));
    }
}

#[test]
fn bad_motions_are_refused_and_change_nothing() {
    let mut rig = solids(Config::default(), BRISTLE);
    let [a, b] = rig.interfaces;
    let bad = SurfaceMotion { belt_travel: [0.0, f64::NAN, 0.0], ..SurfaceMotion::default() };
    let error = rig.world.set_surface_motions(&[(a, surface_at(1.0)), (b, bad)]).unwrap_err();
    assert!(error.to_string().contains("the motion of its surface holds NaN"), "{error}");
    assert_eq!(rig.world.surface_motion(a).unwrap(), &SurfaceMotion::default());
    // A world that was sealed without moving surfaces refuses them, and their contact state.
    let mut block = Vec::new();
    rig.world.set_surface_motion(a, &surface_at(1.0)).unwrap();
    rig.place([at(Vec3::new(0.0, 0.0, 0.0985), Quat::identity()), State::identity()]);
    rig.world.step().unwrap();
    rig.world.save_state_packed(&mut block);
    let mut still = self::still_solids();
    let error = still.world.set_surface_motion(still.interfaces[0], &surface_at(1.0)).unwrap_err();
    assert!(error.to_string().contains("moving_surfaces"), "{error}");
    assert!(still.world.restore_state(&block).is_err());
    assert!(still.world.continue_from(&rig.world).unwrap_err().to_string().contains("moving_surfaces"));
}
