//! Wrench of one pair alone: against closed forms, against the list of contacts, and summed over all pairs of a body. Begin and
//! end of contact, and peaks over several frames.

use crate::common::{at, box_polyhedron, load, model, moving, rough, surface};
use pong_engine::{
    Config, EngineError, InterfaceId, ObjectId, PairId, PairMonitor, State, WorkerSettings, World,
    WorldBuilder,
};
use pong_geometry::{Quat, Vec3, Wrench};

/// Objects of one model each, paired as told, with the Interfaces of their roots.
struct Scene {
    world: World,
    objects: Vec<ObjectId>,
    pairs: Vec<PairId>,
    roots: Vec<InterfaceId>,
}

impl Scene {
    fn new(models: &[String], pairs: &[(usize, usize)]) -> Self {
        Self::with(Config::default(), models, pairs)
    }

    fn with(config: Config, models: &[String], pairs: &[(usize, usize)]) -> Self {
        let mut builder = WorldBuilder::new(config);
        let objects: Vec<_> = (models.iter().enumerate())
            .map(|(index, text)| {
                let model = load(&mut builder, text);
                builder.create_object(model, &format!("o{index}")).unwrap()
            })
            .collect();
        let pairs = pairs.iter().map(|&(a, b)| builder.pair(objects[a], objects[b]).unwrap()).collect();
        let roots = objects.iter().map(|&object| builder.scene().interface(object, "").unwrap()).collect();
        Self { world: builder.seal().unwrap().0, objects, pairs, roots }
    }

    fn interface(&self, object: usize, path: &str) -> InterfaceId {
        self.world.scene().interface(self.objects[object], path).unwrap()
    }

    fn set(&mut self, index: usize, state: State) {
        self.world.set_state(self.roots[index], &state).unwrap();
    }
}

fn elastic() -> String {
    surface(2e4, "normal: Linear(damping: 0.0), friction: None")
}

/// Stiffness of two such surfaces in series, N/m.
const STIFFNESS: f64 = 1e4;

fn near(got: &Wrench, force: [f64; 3], moment: [f64; 3], tolerance: f64) {
    let off = (got.force - Vec3::from(force)).norm().max((got.moment - Vec3::from(moment)).norm());
    assert!(off <= tolerance, "{got:?}, not {force:?} {moment:?}");
}

/// A ball of radius 0.1 m between a floor and a ceiling, 1 mm deep in one and 3 mm in the other.
#[test]
fn each_plate_bears_its_own_share_of_a_ball() {
    let ball = model("ball", &elastic(), "Sphere(name: \"s\", center: (0.5,0,0), radius: 0.1)");
    let floor = model("floor", &elastic(), "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)");
    let ceiling = model("ceiling", &elastic(), "Plane(name: \"f\", normal: (0,0,-1), offset: 0.0)");
    // The ball is named first in one pair and second in the other.
    let mut scene = Scene::new(&[ball, floor, ceiling], &[(0, 1), (2, 0)]);
    let turn = Quat::from_axis_angle(&Vec3::x_axis(), std::f64::consts::FRAC_PI_2);
    scene.set(0, at(Vec3::new(0.0, 0.0, 0.099), turn));
    scene.set(1, at(Vec3::zeros(), Quat::identity()));
    scene.set(2, at(Vec3::new(2.0, 0.0, 0.196), Quat::identity()));
    scene.world.step().unwrap();
    let [ball, floor, ceiling] = scene.roots[..] else { unreachable!() };
    let world = &scene.world;
    let (up, down) = (STIFFNESS * 1e-3, STIFFNESS * 3e-3);
    // Arm 0.5 m along x: M = x × F is −0.5·F_z about y.
    near(&world.wrench_from_common(ball, floor).unwrap(), [0.0, 0.0, up], [0.0, -0.5 * up, 0.0], 1e-9);
    near(&world.wrench_from_common(ball, ceiling).unwrap(), [0.0, 0.0, -down], [0.0, 0.5 * down, 0.0], 1e-9);
    // About the ceiling's origin the arm is −1.5 m.
    near(&world.wrench_from_common(ceiling, ball).unwrap(), [0.0, 0.0, down], [0.0, 1.5 * down, 0.0], 1e-9);
    // In the ball's own axes, turned by a quarter about x, up is +y and +y is −z.
    near(&world.wrench_from(ball, floor).unwrap(), [0.0, up, 0.0], [0.0, 0.0, 0.5 * up], 1e-9);
    // On the Object named first: the ball, then the ceiling.
    let [below, above] = scene.pairs[..] else { unreachable!() };
    assert_eq!(world.pair_wrench(below, ball).unwrap(), world.wrench_from(ball, floor).unwrap());
    assert_eq!(world.pair_wrench(above, ceiling).unwrap(), world.wrench_from(ceiling, ball).unwrap());
    near(&world.pair_wrench_common(above, ball).unwrap(), [0.0, 0.0, down], [0.0, -0.5 * down, 0.0], 1e-9);
    near(&world.pair_wrench(above, ball).unwrap(), [0.0, down, 0.0], [0.0, 0.0, 0.5 * down], 1e-9);
    // Both together are the wrench on the ball.
    let both = world.pair_wrench(below, ball).unwrap().force - world.pair_wrench(above, ball).unwrap().force;
    assert!((both - world.wrench(ball).unwrap().force).norm() < 1e-12);
}

/// A box of half edge 0.1 m on four feet, pushed along x by a tip 0.06 m above the feet.
#[test]
fn floor_and_pusher_act_on_a_box_each_for_itself() {
    let foot = |x: f64, y: f64| format!("Point(name: \"p{x}{y}\", position: ({x:?},{y:?},-0.1))");
    let feet = [foot(0.1, 0.1), foot(0.1, -0.1), foot(-0.1, 0.1), foot(-0.1, -0.1)].join(",");
    let shell = box_polyhedron("b", [0.0; 3], [0.1, 0.1, 0.099], "0,1");
    let cube = model("cube", &elastic(), &format!("{feet},{shell}"));
    let floor = model("floor", &elastic(), "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)");
    let pusher = model("pusher", &elastic(), "Point(name: \"tip\", position: (0,0,0))");
    let mut scene = Scene::new(&[cube, floor, pusher], &[(0, 1), (0, 2)]);
    scene.set(0, at(Vec3::new(3.0, 0.0, 0.098), Quat::identity()));
    scene.set(1, at(Vec3::zeros(), Quat::identity()));
    scene.set(2, at(Vec3::new(2.9 + 4e-3, 0.0, 0.06), Quat::identity()));
    scene.world.step().unwrap();
    let [cube, floor, pusher] = scene.roots[..] else { unreachable!() };
    let (load, push) = (4.0 * STIFFNESS * 2e-3, STIFFNESS * 4e-3);
    let world = &scene.world;
    near(&world.wrench_from(cube, floor).unwrap(), [0.0, 0.0, load], [0.0; 3], 1e-9);
    // M = (−0.1 + half the depth, 0, 0.06 − 0.098) × (push, 0, 0).
    near(&world.wrench_from(cube, pusher).unwrap(), [push, 0.0, 0.0], [0.0, -0.038 * push, 0.0], 1e-9);
    near(&world.wrench_from(pusher, cube).unwrap(), [-push, 0.0, 0.0], [0.0; 3], 1e-9);
    near(&world.pair_wrench(scene.pairs[1], pusher).unwrap(), [push, 0.0, 0.0], [0.0; 3], 1e-9);
    // What does not touch gives nothing.
    scene.set(2, at(Vec3::zeros(), Quat::identity()));
    scene.world.evaluate().unwrap();
    assert_eq!(scene.world.wrench_from(cube, pusher).unwrap(), Wrench::zero());
    assert_eq!(scene.world.pair_wrench(scene.pairs[1], cube).unwrap(), Wrench::zero());
    near(&scene.world.wrench_from(cube, floor).unwrap(), [0.0, 0.0, load], [0.0; 3], 1e-9);
}

/// A gripper of three movable groups holds a ball over a floor, all of it on the move and far from the common origin.
fn gripper() -> Scene {
    let finger = |name: &str, x: f64| {
        format!(
            "(name: \"{name}\", movable: true, primitives: [Sphere(name: \"s\", center: ({x:?},0,0), radius: 0.02), \
             Sphere(name: \"t\", center: ({x:?},0.01,0.03), radius: 0.02)])"
        )
    };
    let palm = "Point(name: \"p\", position: (0,0,0))";
    let gripper = model("gripper", &rough(2e4), palm).replace(
        &format!("primitives: [ {palm} ]"),
        &format!(
            "groups: [(name: \"palm\", primitives: [ {palm} ]), {}, {}]",
            finger("left", -0.118),
            finger("right", 0.118)
        ),
    );
    let ball = model("ball", &rough(2e4), "Sphere(name: \"s\", center: (0,0,0), radius: 0.1)");
    let floor = model("floor", &rough(2e4), "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)");
    let mut scene = Scene::new(&[gripper, ball, floor], &[(1, 0), (1, 2), (0, 0)]);
    let origin = Vec3::new(4096.0, -2048.0, 512.0);
    let spin = Vec3::new(0.1, -0.3, 0.2);
    let small = |angle: f64| Quat::from_axis_angle(&Vec3::y_axis(), angle);
    let [left, right] = ["left", "right"].map(|path| scene.interface(0, path));
    for (interface, state) in [
        (scene.roots[0], moving(origin + Vec3::z() * 0.098, small(0.3), spin, spin)),
        (left, moving(origin + Vec3::new(0.001, 0.0, 0.0), small(0.02), Vec3::zeros(), spin)),
        (right, moving(origin - Vec3::new(0.002, 0.0, 0.0), small(-0.03), spin, Vec3::zeros())),
        (scene.roots[1], moving(origin, small(1.2), Vec3::x() * 0.1, spin)),
        (scene.roots[2], at(origin - Vec3::z() * 0.099, small(0.01))),
    ] {
        scene.world.set_state(interface, &state).unwrap();
    }
    scene.world.step().unwrap();
    scene
}

/// Sum over the listed contacts between two sets of movable groups, on the first, about a place of the common frame.
fn listed(world: &World, on: &[InterfaceId], from: &[InterfaceId], about: &Vec3) -> Wrench {
    let mut sum = Wrench::zero();
    for contact in world.contacts_iter() {
        for (side, other, force) in
            [(&contact.a, &contact.b, contact.force), (&contact.b, &contact.a, -contact.force)]
        {
            if on.contains(&side.interface) && from.contains(&other.interface) {
                sum += Wrench::of_force_at(force, &(contact.point - about));
            }
        }
    }
    sum
}

#[test]
fn the_wrench_of_a_pair_is_the_sum_over_its_contacts_about_any_group_of_it() {
    let mut scene = gripper();
    let fingers = [scene.roots[0], scene.interface(0, "left"), scene.interface(0, "right")];
    let [ball, floor] = [scene.roots[1], scene.roots[2]];
    let world = &scene.world;
    let places = |id| world.state(id).unwrap().unwrap().0.position;
    let touching = fingers.iter().filter(|&&f| world.wrench_from(ball, f).unwrap().force.norm() > 1.0);
    assert_eq!(touching.count(), 3);
    for about in fingers.into_iter().chain([ball]) {
        let expected = listed(world, &[ball], &fingers, &places(about));
        let got = world.pair_wrench_common(scene.pairs[0], about).unwrap();
        near(&got, expected.force.into(), expected.moment.into(), 1e-9);
        let turn = world.state(about).unwrap().unwrap().0.orientation;
        let own = world.pair_wrench(scene.pairs[0], about).unwrap();
        let turned = Wrench { force: turn * own.force, moment: turn * own.moment };
        near(&turned, got.force.into(), got.moment.into(), 1e-9);
    }
    // The sum over all that a body can touch is its wrench.
    let all = [fingers.as_slice(), &[ball, floor]].concat();
    for on in &all {
        let mut sum = Wrench::zero();
        let is_unpaired = |from: &InterfaceId| {
            let is = |a: &InterfaceId, b: &InterfaceId| *a == floor && fingers.contains(b);
            from == on || is(on, from) || is(from, on)
        };
        for from in all.iter().filter(|from| !is_unpaired(from)) {
            sum += world.wrench_from(*on, *from).unwrap();
        }
        let whole = world.wrench(*on).unwrap();
        near(&sum, whole.force.into(), whole.moment.into(), 1e-10);
    }
    // Committed, states set anew and not evaluated, pair off: it is still of that frame, as the wrench of a body.
    let before = world.pair_wrench(scene.pairs[0], ball).unwrap();
    scene.set(1, at(Vec3::zeros(), Quat::identity()));
    scene.world.set_pair_enabled(scene.pairs[0], false).unwrap();
    assert_eq!(scene.world.pair_wrench(scene.pairs[0], ball).unwrap(), before);
    scene.world.evaluate().unwrap();
    assert_eq!(scene.world.pair_wrench(scene.pairs[0], ball).unwrap(), Wrench::zero());
}

#[test]
fn a_wrench_of_no_pair_is_refused() {
    let scene = gripper();
    let [gripper, ball, floor] = scene.roots[..] else { unreachable!() };
    let left = scene.interface(0, "left");
    let told = |refused: Result<Wrench, EngineError>| refused.unwrap_err().to_string();
    let world = &scene.world;
    assert!(told(world.wrench_from(ball, ball)).contains("both are the same movable group"));
    let not_paired = told(world.wrench_from(left, floor));
    assert!(not_paired.contains("`o0/") && not_paired.contains("are not paired"), "{not_paired}");
    assert!(told(world.pair_wrench(scene.pairs[2], left)).contains("has no two sides"));
    let elsewhere = told(world.pair_wrench(scene.pairs[1], gripper));
    assert!(elsewhere.contains("of neither Object") && elsewhere.contains("(`o1`, `o2`)"), "{elsewhere}");
    let other = self::gripper();
    assert!(matches!(world.wrench_from(other.roots[0], ball), Err(EngineError::UnknownId { .. })));
    assert!(matches!(world.pair_wrench(other.pairs[0], ball), Err(EngineError::UnknownId { .. })));
    let clone = world.try_clone().unwrap();
    assert!(told(clone.wrench_from(ball, floor)).contains("evaluate or step a frame first"));
    assert!(told(clone.pair_wrench(scene.pairs[0], ball)).contains("evaluate or step a frame first"));
}

/// Two balls over a floor, on heights of the tests' own: o0 and o1 are the balls, o2 the floor.
fn two_balls(workers: usize) -> Scene {
    let ball = model("ball", &rough(2e4), "Sphere(name: \"s\", center: (0,0,0), radius: 0.1)");
    let floor = model("floor", &rough(2e4), "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)");
    let config = Config {
        workers: (workers > 0).then(|| WorkerSettings { workers, oversubscribe: true, ..Default::default() }),
        ..Config::default()
    };
    // Pairs in another order than the bodies.
    let mut scene = Scene::with(config, &[ball.clone(), ball, floor], &[(2, 1), (0, 2), (0, 1)]);
    scene.set(2, State::identity());
    scene
}

impl Scene {
    /// Steps with the balls this deep in the floor, m.
    fn step_at(&mut self, depths: [f64; 2]) {
        for (index, depth) in depths.into_iter().enumerate() {
            self.set(index, at(Vec3::new(index as f64, 0.0, 0.1 - depth), Quat::identity()));
        }
        self.world.step().unwrap();
    }

    /// Places of the pairs that began (true) or ended (false), and that their groups are those of the pair's Objects in turn.
    fn told(&self, monitor: &PairMonitor) -> Vec<(usize, bool)> {
        let told = monitor.changes().map(|change| {
            let pair = self.pairs.iter().position(|pair| *pair == change.pair).unwrap();
            let objects = self.world.scene().objects_of(change.pair).unwrap();
            let roots = objects.map(|object| self.world.scene().interface(object, "").unwrap());
            assert_eq!(change.interfaces, roots);
            (pair, change.begins)
        });
        told.collect()
    }
}

#[test]
fn contact_begins_and_ends_between_committed_frames() {
    for workers in [0, 2] {
        let mut scene = two_balls(workers);
        let mut monitor = PairMonitor::new(&scene.world).unwrap();
        let mut observe = |scene: &mut Scene, depths| {
            scene.step_at(depths);
            monitor.observe(&scene.world, 1e-3).unwrap();
            scene.told(&monitor)
        };
        // The first frame begins all that touch, in the order of the pairs.
        assert_eq!(observe(&mut scene, [1e-3, 2e-3]), [(0, true), (1, true)]);
        assert_eq!(observe(&mut scene, [1e-3, 2e-3]), []);
        assert_eq!(observe(&mut scene, [-1e-3, 2e-3]), [(1, false)]);
        assert_eq!(observe(&mut scene, [1e-3, -1e-3]), [(0, false), (1, true)]);
        // A history that is cleared ends no contact, and a pair that is switched off does, once.
        let saved = {
            let mut block = Vec::new();
            scene.world.save_state_packed(&mut block);
            block
        };
        scene.world.clear_contact_history(scene.objects[0]).unwrap();
        assert_eq!(observe(&mut scene, [1e-3, -1e-3]), []);
        scene.world.set_pair_enabled(scene.pairs[1], false).unwrap();
        assert_eq!(observe(&mut scene, [1e-3, -1e-3]), [(1, false)]);
        assert_eq!(observe(&mut scene, [1e-3, -1e-3]), []);
        scene.world.set_pair_enabled(scene.pairs[1], true).unwrap();
        assert_eq!(observe(&mut scene, [1e-3, -1e-3]), [(1, true)]);
        // A contact state of another time: the next frame is compared with the one observed last.
        assert_eq!(observe(&mut scene, [-1e-3, 1e-3]), [(0, true), (1, false)]);
        scene.world.restore_state(&saved).unwrap();
        assert_eq!(observe(&mut scene, [1e-3, -1e-3]), [(0, false), (1, true)]);
    }
}

#[test]
fn evaluations_that_are_not_committed_begin_and_end_nothing() {
    let mut scene = two_balls(0);
    let mut monitor = PairMonitor::new(&scene.world).unwrap();
    let refused = |monitor: &mut PairMonitor, scene: &Scene, step| {
        let told = format!("{:?}", monitor.changes().collect::<Vec<_>>());
        let error = monitor.observe(&scene.world, step).expect_err("refused");
        assert_eq!(told, format!("{:?}", monitor.changes().collect::<Vec<_>>()), "nothing was taken in");
        error.to_string()
    };
    assert!(refused(&mut monitor, &scene, 1.0).contains("once after each commit"));
    scene.step_at([1e-3, -1e-3]);
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(refused(&mut monitor, &scene, step).contains("give the time since the commit before"));
    }
    monitor.observe(&scene.world, 0.5).unwrap();
    assert_eq!(scene.told(&monitor), [(1, true)]);
    // The same frame again, and one that is only evaluated.
    assert!(refused(&mut monitor, &scene, 0.5).contains("once after each commit"));
    scene.set(0, at(Vec3::z(), Quat::identity()));
    scene.world.evaluate().unwrap();
    assert!(refused(&mut monitor, &scene, 0.5).contains("once after each commit"));
    assert!(refused(&mut monitor, &two_balls(0), 0.5).contains("another world"));
    // A commit that was not observed before the next evaluation.
    scene.world.commit().unwrap();
    scene.world.evaluate().unwrap();
    assert!(refused(&mut monitor, &scene, 0.5).contains("once after each commit"));
    // The states that follow a commit are no matter.
    scene.step_at([1e-3, -1e-3]);
    scene.set(0, at(Vec3::z(), Quat::identity()));
    monitor.observe(&scene.world, 0.5).unwrap();
    assert_eq!(scene.told(&monitor), []);
    assert_eq!(monitor.window(), 1.0);
    // Of some pairs.
    scene.world.commit_pairs(&scene.pairs[..1]).unwrap();
    monitor.observe(&scene.world, 0.5).unwrap();
    assert_eq!(scene.told(&monitor), [(1, false)]);
}

/// A ball at rest in the floor, 1, 3, none and 2 mm deep for 1, 2, 4 and 3 ms.
#[test]
fn peaks_and_means_are_those_of_the_frames_of_the_window() {
    let mut scene = two_balls(0);
    let mut monitor = PairMonitor::new(&scene.world).unwrap();
    for (depth, step) in [(1e-3, 1e-3), (3e-3, 2e-3), (-1e-3, 4e-3), (2e-3, 3e-3)] {
        scene.step_at([depth, -1.0]);
        monitor.observe(&scene.world, step).unwrap();
    }
    let [peaks] = monitor.peaks().collect::<Vec<_>>()[..] else { panic!("one pair") };
    assert_eq!((peaks.pair, peaks.interfaces), (scene.pairs[1], [scene.roots[0], scene.roots[2]]));
    assert_eq!((peaks.touches, peaks.begins, peaks.ends), (true, 2, 1));
    assert!((peaks.peak_normal_force - STIFFNESS * 3e-3).abs() < 1e-9, "{peaks:?}");
    let mean = STIFFNESS * (1e-3 * 1e-3 + 3e-3 * 2e-3 + 2e-3 * 3e-3) / 10e-3;
    near(&peaks.mean, [0.0, 0.0, mean], [0.0; 3], 1e-9);
    assert!((monitor.window() - 10e-3).abs() < 1e-15 && (peaks.contact_time - 6e-3).abs() < 1e-15);
    // A new window: what touches goes on, and what only ends has no peak.
    monitor.begin_window();
    assert_eq!((monitor.peaks().len(), monitor.window()), (0, 0.0));
    scene.step_at([-1e-3, 2e-3]);
    monitor.observe(&scene.world, 1e-3).unwrap();
    let [of_second, of_first] = monitor.peaks().collect::<Vec<_>>()[..] else { panic!("two pairs") };
    assert_eq!((of_first.pair, of_first.begins, of_first.ends), (scene.pairs[1], 0, 1));
    assert_eq!((of_first.peak_normal_force, of_first.touches, of_first.contact_time), (0.0, false, 0.0));
    // The floor was named first in that pair: the ball pushes it down.
    assert_eq!((of_second.pair, of_second.begins, of_second.ends), (scene.pairs[0], 1, 0));
    let force = STIFFNESS * 2e-3;
    near(&of_second.mean, [0.0, 0.0, -force], [0.0, force, 0.0], 1e-9);
}

/// Two feet of one body push against each other's ways: the normal force of the pair is the sum of both.
#[test]
fn the_peak_counts_every_contact_of_the_pair() {
    let feet = "Sphere(name: \"l\", center: (-1,0,0), radius: 0.1), Sphere(name: \"r\", center: (1,0,0), radius: 0.1)";
    let walls = "Plane(name: \"l\", normal: (1,0,0), offset: -1.098), Plane(name: \"r\", normal: (-1,0,0), offset: -1.098)";
    let (a, b) = (model("feet", &elastic(), feet), model("walls", &elastic(), walls));
    let mut scene = Scene::new(&[a, b], &[(0, 1)]);
    (0..2).for_each(|index| scene.set(index, State::identity()));
    scene.world.step().unwrap();
    let mut monitor = PairMonitor::new(&scene.world).unwrap();
    monitor.observe(&scene.world, 1.0).unwrap();
    let peaks = monitor.peaks().next().unwrap();
    assert!((peaks.peak_normal_force - 2.0 * STIFFNESS * 2e-3).abs() < 1e-9, "{peaks:?}");
    assert!(peaks.mean.force.norm() < 1e-9);
}
