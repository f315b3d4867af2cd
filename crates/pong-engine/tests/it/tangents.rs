//! Tangents of a frame: closed forms, derivatives of an energy, differences, and what is refused. Random scenes of
//! all testers are compared with differences by the claim `tangent` of the invariances.

use crate::common::own_kinds;
use crate::common::*;
use nalgebra::SMatrix;
use pong_engine::{Config, EngineError, PairTangent, State, WorldBuilder};
use pong_geometry::{Quat, Vec3};
use pong_model::Extensions;
use pong_testkit::Random;

type Matrix12 = SMatrix<f64, 12, 12>;

fn whole(blocks: &[[SMatrix<f64, 6, 6>; 2]; 2]) -> Matrix12 {
    Matrix12::from_fn(|row, column| blocks[row / 6][column / 6][(row % 6, column % 6)])
}

fn apart(a: &[PairTangent], b: &[PairTangent], arm: f64) -> f64 {
    assert_eq!(a.len(), b.len());
    let scaled = |matrix: &Matrix12| {
        let unit = |index: usize| if index % 6 < 3 { 1.0 } else { 1.0 / arm };
        Matrix12::from_fn(|row, column| matrix[(row, column)] * unit(row) * unit(column))
    };
    let relative = |a: Matrix12, b: Matrix12| (scaled(&a) - scaled(&b)).amax() / scaled(&b).amax().max(1e-9);
    let pairs = a.iter().zip(b);
    pairs
        .map(|(a, b)| {
            let stiffness = relative(whole(&a.stiffness), whole(&b.stiffness));
            stiffness.max(relative(whole(&a.damping), whole(&b.damping)))
        })
        .fold(0.0, f64::max)
}

const K: f64 = 2e5;

/// A ball of radius 0.3 m whose centre is 0.4 m above its group's origin, on a floor; frictionless.
fn ball(law: &str) -> Rig {
    let smooth = surface(K, &format!("normal: {law}, friction: None"));
    Rig::new(
        &model("ball", &smooth, "Sphere(name: \"b\", center: (0,0,0.4), radius: 0.3)"),
        &model("floor", &smooth, "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)"),
    )
}

/// Two equal surfaces in series: k/2. The vertical force F goes through the centre, 0.4 m above the origin: a tilt by
/// φ about x moves the centre by −0.4·φ along y, and the moment about the origin is −0.4·φ·F.
#[test]
fn a_ball_on_a_floor_has_the_closed_form() {
    let mut rig = ball("Linear(damping: 600.0)");
    let depth = 1e-3;
    rig.place_a(Vec3::new(1.0, 2.0, -0.1 - depth), Quat::identity());
    rig.world.evaluate().unwrap();
    let tangents = rig.world.tangents().unwrap();
    let [tangent] = &tangents[..] else { panic!("one pair touches") };
    let force = 0.5 * K * depth;
    let mut stiffness = SMatrix::<f64, 6, 6>::zeros();
    stiffness[(2, 2)] = 0.5 * K;
    (stiffness[(3, 3)], stiffness[(4, 4)]) = (force * 0.4, force * 0.4);
    assert!((tangent.stiffness[0][0] - stiffness).amax() < 1e-9 * K, "{}", tangent.stiffness[0][0]);
    let mut damping = SMatrix::<f64, 6, 6>::zeros();
    damping[(2, 2)] = 300.0;
    assert!((tangent.damping[0][0] - damping).amax() < 1e-9, "{}", tangent.damping[0][0]);
}

/// Two balls of radius R, centres apart by d: kₙ·n·nᵀ − (F/d)·(1 − n·nᵀ), the geometric stiffness of a strut.
#[test]
fn two_balls_buckle_as_a_strut() {
    let smooth = surface(K, "normal: Linear(damping: 0.0), friction: None");
    let ball = |name: &str| model(name, &smooth, "Sphere(name: \"b\", center: (0,0,0), radius: 0.5)");
    let mut rig = Rig::new(&ball("a"), &ball("b"));
    let (direction, distance) = (Vec3::new(0.6, 0.0, 0.8), 0.99);
    rig.place_a(direction * distance, Quat::identity());
    rig.world.evaluate().unwrap();
    let tangent = rig.world.tangents().unwrap()[0];
    let along = direction * direction.transpose();
    let force = 0.5 * K * (1.0 - distance);
    let wanted = along * (0.5 * K) - (nalgebra::Matrix3::identity() - along) * (force / distance);
    let found = tangent.stiffness[0][0].fixed_view::<3, 3>(0, 0).into_owned();
    assert!((found - wanted).amax() < 1e-9 * K, "{found}");
    // Both groups moved together change nothing.
    let together = tangent.stiffness[0][0] + tangent.stiffness[0][1];
    assert!(together.fixed_view::<6, 3>(0, 0).amax() < 1e-9 * K);
}

/// A force from an energy: the stiffness is symmetric but for half the moments, because rotation vectors do not
/// commute: K − Kᵀ holds the cross product of each group's moment in its block of rotations.
#[test]
fn a_frictionless_contact_derives_from_its_energy() {
    let smooth = surface(K, "normal: HuntCrossley(dissipation: 0.0, exponent: 1.5), friction: None");
    let egg = "Ellipsoid(name: \"e\", center: (0.1,0.2,0.3), semi_axes: (0.2,0.3,0.25), orientation: (0.8,0.0,0.6,0.0))";
    let box_ = box_polyhedron("box", [0.0, 0.0, 0.0], [0.5, 0.5, 0.1], "");
    let mut rig = Rig::new(&model("egg", &smooth, egg), &model("box", &smooth, &box_));
    let a = at(Vec3::new(0.25, 0.1, -0.08), Quat::from_scaled_axis(Vec3::new(0.1, -0.05, 0.2)));
    let b = at(Vec3::new(0.05, -0.02, 0.0), Quat::from_scaled_axis(Vec3::new(-0.02, 0.04, 0.3)));
    rig.place([a, b]);
    rig.world.evaluate().unwrap();
    assert!(rig.world.contact_count() > 0);
    let tangent = rig.world.tangents().unwrap()[0];
    let stiffness = whole(&tangent.stiffness);
    let mut expected = Matrix12::zeros();
    for side in 0..2 {
        let moment = rig.wrench(side).moment;
        let mut block = expected.fixed_view_mut::<3, 3>(6 * side + 3, 6 * side + 3);
        block.copy_from(&moment.cross_matrix());
    }
    let skew = stiffness - stiffness.transpose();
    let off = (skew - expected).amax().min((skew + expected).amax());
    assert!(off < 1e-8 * stiffness.amax(), "{skew}\n{expected}");
}

/// A table with sticking feet that moves, and with feet that slip.
#[test]
fn differences_give_the_same() {
    let feet = "Point(name: \"p\", position: (-0.2,-0.3,0.0)), Point(name: \"q\", position: (0.3,-0.2,0.0)),
        Sphere(name: \"s\", center: (0.0,0.3,0.05), radius: 0.05)";
    let rough = surface(
        K,
        "normal: Linear(damping: 500.0, ramp: 1e-3), friction: Bristle(mu: 0.4, static_excess: 0.2, damping: 60.0)",
    );
    let floor = "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)";
    for step in [2e-5, 2e-3] {
        let mut rig = Rig::new(&model("table", &rough, feet), &model("floor", &rough, floor));
        let state = |t: f64| {
            moving(
                Vec3::new(t, 0.3 * t, -2e-3),
                Quat::from_scaled_axis(Vec3::new(1e-3, 2e-3, t)),
                Vec3::new(0.1, 0.03, -0.01),
                Vec3::new(0.0, 0.02, 0.1),
            )
        };
        for frame in 0..3 {
            rig.place([state(f64::from(frame) * step), State::identity()]);
            rig.world.evaluate().unwrap();
            if frame < 2 {
                rig.world.commit().unwrap();
            }
        }
        let wrench = rig.wrench(0);
        let exact = rig.world.tangents().unwrap();
        assert_eq!(rig.world.complete_tangents().unwrap(), exact);
        let differences = rig.world.tangents_by_differences().unwrap();
        assert!(apart(&exact, &differences, 0.3) < 1e-5, "{exact:?}\n{differences:?}");
        assert_eq!(rig.wrench(0), wrench, "the frame is that of before");
        assert!(rig.world.is_evaluated());
    }
}

/// Bars on a box and on a ridge, sunk in or not: over faces with both ends, overhanging, on edges and corners, on a tip.
#[test]
fn bars_on_solids_have_the_tangents_of_differences() {
    let rough = surface(K, "normal: Linear(damping: 300.0), friction: Bristle(mu: 0.4, damping: 60.0)");
    let box_ = box_polyhedron("box", [0.0, 0.0, -0.2], [0.5, 0.4, 0.2], "");
    let ridge = "Polyhedron(name: \"w\", vertices: [(-1,-0.5,-0.5),(1,-0.5,-0.5),(1,0.5,-0.5),(-1,0.5,-0.5),(0,-0.5,0),(0,0.5,0)], \
                 faces: [[0,3,2,1],[0,4,5,3],[1,2,5,4],[0,1,4],[2,3,5]])";
    let mut random = Random(41);
    for (radius, solid) in [(0.1, &*box_), (0.1, ridge), (0.0, &box_), (0.0, ridge)] {
        let ends = "ends: ((-0.5,0,0),(0.4,0,0))";
        let bar = match radius > 0.0 {
            true => format!("Capsule(name: \"c\", {ends}, radius: {radius:?})"),
            false => format!("LineSegment(name: \"c\", {ends})"),
        };
        let mut rig = Rig::new(&model("bar", &rough, &bar), &model("solid", &rough, solid));
        let (mut compared, mut off) = (0, 0);
        for _ in 0..150 {
            let above = radius - random.between(0.002, 0.04);
            let place = Vec3::new(random.between(-0.7, 0.7), random.between(-0.6, 0.6), above);
            let turn = Quat::from_scaled_axis(Vec3::new(0.3, 0.1, 2.0).component_mul(&random.vector(1.0)));
            rig.world.clear_contact_history(rig.objects[0]).unwrap();
            rig.place([moving(place, turn, random.vector(0.1), random.vector(0.1)), State::identity()]);
            rig.world.evaluate().unwrap();
            if rig.world.contact_count() == 0 {
                continue;
            }
            let exact = rig.world.tangents().unwrap();
            let differences = rig.world.tangents_by_differences().unwrap();
            compared += 1;
            off += usize::from(apart(&exact, &differences, 0.3) > 1e-4);
        }
        // Differences may step over a kink.
        assert!(compared > 50 && off * 20 < compared, "{radius} {solid}: {off} of {compared}");
    }
}

/// A ball that resists rolling and spinning: held, and beyond both limits; in the step in which it lands as well.
#[test]
fn resistance_to_rolling_is_differentiated() {
    let rough = surface(K, "friction: Bristle(mu: 0.6, damping: 60.0, rolling: 2e-3, spinning: 1e-3)");
    let ball = "Sphere(name: \"b\", center: (0.05,0,0.1), radius: 0.3)";
    let hill = "Sphere(name: \"h\", center: (0,0,-2), radius: 2.0)";
    for (turn, frames) in [(1e-6, 3), (3e-3, 3), (1e-6, 1), (3e-3, 1)] {
        let mut rig = Rig::new(&model("ball", &rough, ball), &model("hill", &rough, hill));
        let state = |t: f64| {
            let height = if t == 0.0 { 0.21 } else { 0.198 };
            moving(
                Vec3::new(0.01 + 0.3 * turn * t, 0.02, height),
                Quat::from_scaled_axis(Vec3::new(0.3 * turn * t, turn * t, 0.7 * turn * t)),
                Vec3::new(0.03, 0.01, -0.01),
                Vec3::new(0.02, 0.1, 0.07),
            )
        };
        rig.place([state(0.0), State::identity()]);
        rig.world.step().unwrap();
        for frame in 1..=frames {
            rig.place([state(f64::from(frame)), State::identity()]);
            rig.world.evaluate().unwrap();
            if frame < frames {
                rig.world.commit().unwrap();
            }
        }
        assert_eq!(rig.world.contact_count(), 3, "a contact and a couple");
        let exact = rig.world.tangents().unwrap();
        let differences = rig.world.tangents_by_differences().unwrap();
        let off = apart(&exact, &differences, 0.3);
        assert!(off < 1e-5, "{turn} {frames}: {off:e}\n{exact:?}\n{differences:?}");
    }
}

/// A cube of solid contact, side 0.2 m, flat on a floor: K·A across its face, by differences alone.
#[test]
fn solids_have_a_tangent_by_differences() {
    let soft = "\"s\": (stiffness: 1e6, foundation: 1e7, normal: Linear(damping: 0.0), friction: None)";
    let cube = model("cube", soft, &box_polyhedron("box", [0.0; 3], [0.1; 3], ""));
    let cube = cube.replace("root: (", "root: (contact: Solid, ");
    let floor = model("floor", soft, "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)");
    let mut rig = Rig::new(&cube, &floor);
    rig.place_a(Vec3::new(0.0, 0.0, 0.1 - 1e-3), Quat::identity());
    rig.world.evaluate().unwrap();
    let refused = rig.world.tangents().unwrap_err().to_string();
    assert!(refused.contains("solids") && refused.contains("differences"), "{refused}");
    let tangent = rig.world.complete_tangents().unwrap()[0];
    assert!(tangent.by_differences);
    let force = rig.wrench(0).force.z;
    // Force K·A·δ, linear in the depth.
    let wanted = force / 1e-3;
    assert!((tangent.stiffness[0][0][(2, 2)] - wanted).abs() < 1e-4 * wanted, "{}", tangent.stiffness[0][0]);
}

#[test]
fn what_has_no_tangent_is_named() {
    let mut rig = ball("Linear(damping: 0.0)");
    assert!(matches!(rig.world.tangents(), Err(EngineError::WrongPhase { .. })), "before a frame");
    rig.place_a(Vec3::new(0.0, 0.0, -0.101), Quat::identity());
    rig.world.step().unwrap();
    assert!(matches!(rig.world.tangents(), Err(EngineError::WrongPhase { .. })), "after the commit");
    rig.world.evaluate().unwrap();
    assert!(rig.world.tangents().is_ok());

    let mut builder = WorldBuilder::with_extensions(Config::default(), Extensions::new(), own_kinds::laws());
    let own = surface(1.0, "normal: Custom(name: \"quadratic\", parameters: [3e7]), friction: None");
    let a = load(&mut builder, &model("tip", &own, "Point(name: \"p\", position: (0,0,0))"));
    let b = load(&mut builder, &model("floor", &own, "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)"));
    let [a, b] = [(a, "tip"), (b, "floor")].map(|(m, name)| builder.create_object(m, name).unwrap());
    builder.pair(a, b).unwrap();
    let groups = [a, b].map(|object| builder.scene().interface(object, "").unwrap());
    let (mut world, _) = builder.seal().unwrap();
    world.set_state(groups[0], &at(Vec3::new(0.0, 0.0, -1e-3), Quat::identity())).unwrap();
    world.set_state(groups[1], &State::identity()).unwrap();
    world.evaluate().unwrap();
    let refused = world.tangents().unwrap_err().to_string();
    assert!(refused.contains("`tip/tip`") && refused.contains("law of the host"), "{refused}");
    assert_eq!(world.tangents_by_differences().unwrap().len(), 1);
}

/// Prints the time of the tangents of a frame beside that of the frame, for the scenes of the hash series, in the frame
/// with the most contacts.
#[test]
#[ignore = "prints times, checks nothing"]
fn cost_of_tangents() {
    let shortest = |run: &mut dyn FnMut()| {
        let times = (0..5).map(|_| {
            let start = std::time::Instant::now();
            run();
            start.elapsed().as_secs_f64() * 1e6
        });
        times.fold(f64::INFINITY, f64::min)
    };
    for scene in scenes::all() {
        let mut stage = scene.set_up(None);
        let mut most: Option<(usize, f64, f64)> = None;
        for frame in 0..scene.frames.min(60) {
            stage.prepare(frame);
            let of_frame = shortest(&mut || _ = stage.world.evaluate().unwrap());
            let of_tangents = shortest(&mut || _ = stage.world.tangents());
            let (contacts, known) = (stage.world.contact_count(), stage.world.tangents().is_ok());
            if known && contacts > most.map_or(0, |(most, ..)| most) {
                most = Some((contacts, of_frame, of_tangents));
            }
            stage.world.commit().unwrap();
        }
        if let Some((contacts, of_frame, of_tangents)) = most {
            println!(
                "{:<10} {contacts:>5} contacts, frame {of_frame:.1} us, tangents {of_tangents:.1} us: {:.2} of the frame, {:.2} us a contact",
                scene.name,
                of_tangents / of_frame,
                of_tangents / contacts as f64
            );
        }
    }
}
