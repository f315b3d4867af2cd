//! The wrenches are the sums over the listed contacts to 1e-12 of the largest, however many there are, whoever found them and
//! in however many rounds: added here one by one in the order of the list, in the common frame, with what rounding lost.

mod common;

use common::{model, surface};
use pong_engine::{Config, InterfaceId, State, StatusBits, WorkerSettings, World, WorldBuilder};
use pong_geometry::Vec3;
use pong_testkit::Random;
use std::collections::HashMap;
use std::sync::Arc;
use std::time::Duration;

/// Objects of these model files, all paired.
struct Scene {
    world: World,
    /// Their movable groups.
    groups: Vec<InterfaceId>,
}

impl Scene {
    fn new(models: &[&str], objects: &[usize], workers: usize, capacity: usize) -> Self {
        let settings = WorkerSettings {
            workers,
            oversubscribe: true,
            worker_timeout: Duration::from_secs(60),
            ..WorkerSettings::default()
        };
        let workers = (workers > 0).then_some(settings);
        let config = Config { contact_capacity: Some(capacity), workers, ..Config::default() };
        let mut builder = WorldBuilder::new(config);
        let models: Vec<_> = models
            .iter()
            .map(|text| {
                let made = pong_model::parse(text, "m", None, builder.scene().extensions()).unwrap();
                builder.add_model(Arc::new(made))
            })
            .collect();
        let objects: Vec<_> = (0..)
            .zip(objects)
            .map(|(i, &of)| builder.create_object(models[of], &format!("o{i}")).unwrap())
            .collect();
        for (i, &a) in objects.iter().enumerate() {
            objects[i + 1..].iter().for_each(|&b| _ = builder.pair(a, b).unwrap());
        }
        let (world, _) = builder.seal().unwrap();
        let of_object = |object| ["", "gate"].map(|path| world.scene().interface(object, path).ok());
        let groups = objects.into_iter().flat_map(of_object).flatten().collect();
        Self { world, groups }
    }

    /// Steps and compares; how many contacts there were.
    fn step(&mut self, states: &[State]) -> usize {
        let set: Vec<_> = self.groups.iter().copied().zip(states.iter().copied()).collect();
        self.world.set_states(&set).unwrap();
        // Frames that are rare wake nobody.
        self.world.prewake(Duration::from_secs(60));
        self.world.step().unwrap();
        let contacts = self.world.contacts();
        let mut largest: f64 = 0.0;
        let mut sums: HashMap<InterfaceId, [Exact; 2]> = HashMap::new();
        for contact in &contacts {
            for (side, force) in [(&contact.a, contact.force), (&contact.b, -contact.force)] {
                let [forces, moments] = sums.entry(side.interface).or_default();
                let moment = side.arm.cross(&force);
                forces.add(&force);
                moments.add(&moment);
                largest = largest.max(force.norm()).max(moment.norm());
            }
        }
        for group in &self.groups {
            let [force, moment] = sums.remove(group).unwrap_or_default().map(Exact::sum);
            let got = self.world.wrench_common(*group).unwrap();
            let off = (got.force - force).norm().max((got.moment - moment).norm());
            assert!(off <= 1e-12 * largest, "{group:?}: {got:?}, not {force:?} {moment:?}, {largest}");
        }
        assert!(sums.is_empty());
        contacts.len()
    }

    fn is_shared(&self) -> bool {
        self.world.lane_work().skip(1).any(|lane| lane.blocks > 0)
    }
}

/// A sum with what rounding took from it (A. Neumaier, Z. Angew. Math. Mech. 54 (1974) 39).
#[derive(Clone, Copy, Default)]
struct Exact {
    sum: Vec3,
    lost: Vec3,
}

impl Exact {
    fn add(&mut self, term: &Vec3) {
        for axis in 0..3 {
            let (sum, term) = (self.sum[axis], term[axis]);
            let next = sum + term;
            self.lost[axis] +=
                if sum.abs() >= term.abs() { (sum - next) + term } else { (term - next) + sum };
            self.sum[axis] = next;
        }
    }

    fn sum(self) -> Vec3 {
        self.sum + self.lost
    }
}

fn rough() -> String {
    surface(1e4, "normal: Linear(damping: 20.0), friction: Bristle(mu: 0.4)")
}

/// Somewhere near a place, turned by some angle, on the move.
fn near(random: &mut Random, place: Vec3, reach: f64) -> State {
    let [x, y, z] = (random.vector(0.05)).into();
    let norm = (1.0 + x * x + y * y + z * z).sqrt();
    State {
        position: (place + random.vector(reach)).into(),
        orientation: [1.0 / norm, x / norm, y / norm, z / norm],
        linear_velocity: random.vector(0.1).into(),
        angular_velocity: random.vector(0.1).into(),
    }
}

/// Two brushes and a floor: many spans in each of few directions.
#[test]
fn brushes_on_a_floor() {
    let mut random = Random(41);
    let mut points = |count: usize| {
        let one = |index| {
            let p = random.vector(1.0);
            format!("Point(name: \"p{index}\", position: ({:?},{:?},{:?}))", p.x, p.y, 0.01 * p.z)
        };
        model("brush", &rough(), &(0..count).map(one).collect::<Vec<_>>().join(","))
    };
    let (large, small) = (points(3000), points(700));
    let floor = model("floor", &rough(), "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)");
    for workers in [0, 1, 3] {
        let mut scene = Scene::new(&[&large, &small, &floor], &[0, 1, 2], workers, 8000);
        let mut random = Random(workers as u64);
        let (mut most, mut shared, mut frames) = (0, 0, 0);
        // On a busy machine a worker may come too late for many frames in a row.
        while frames < 12 || (shared < 3 && workers > 0 && frames < 2000) {
            frames += 1;
            let states = [
                near(&mut random, Vec3::zeros(), 0.005),
                near(&mut random, Vec3::z() * 0.02, 0.005),
                near(&mut random, Vec3::zeros(), 0.005),
            ];
            most = most.max(scene.step(&states));
            shared += usize::from(scene.is_shared());
        }
        assert!(most > 1500 && (shared > 0) == (workers > 0), "{most} {shared} {frames}");
    }
}

/// What is left counts: rays of a brush push the nearer of two groups of one Object, and of the points the deepest are kept.
#[test]
fn what_is_left_where_some_are_left_out() {
    let mut random = Random(43);
    let movers = |index| {
        let p = random.vector(1.0);
        let [x, y, z] = [p.x, p.y, 0.01 * p.z];
        format!(
            "Point(name: \"p{index}\", position: ({x:?},{y:?},{z:?})), \
             Ray(name: \"r{index}\", origin: ({x:?},{y:?},0.5), direction: (0,0,-1), length: 1.0)"
        )
    };
    let brush = model("brush", &rough(), &(0..600).map(movers).collect::<Vec<_>>().join(","));
    let plane = "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)";
    let floor = model("floor", &rough(), plane).replace(
        &format!("primitives: [ {plane} ]"),
        &format!(
            "groups: [(name: \"slab\", primitives: [{plane}]), (name: \"gate\", movable: true, primitives: [{plane}])]"
        ),
    );
    for (workers, capacity) in [(0, 2000), (2, 2000), (0, 250), (2, 250)] {
        let mut scene = Scene::new(&[&brush, &floor], &[0, 1], workers, capacity);
        let mut random = Random(capacity as u64);
        for _ in 0..20 {
            let states = [-0.02, 0.0, -0.01].map(|z| near(&mut random, Vec3::z() * z, 0.005));
            let found = scene.step(&states);
            let is_limited = scene.world.report().status.contains(StatusBits::CONTACT_LIMIT);
            assert!(found > 100 && is_limited == (capacity == 250), "{found}");
        }
    }
}

/// A heap of balls that all touch each other: each contact of a direction of its own, in more than one round.
#[test]
fn a_heap_of_balls() {
    const COUNT: usize = 128;
    let ball = model("ball", &rough(), "Sphere(name: \"s\", center: (0.02,0,0), radius: 0.1)");
    for workers in [0, 1, 3] {
        let mut scene = Scene::new(&[&ball], &[0; COUNT], workers, 9000);
        let mut random = Random(workers as u64 + 5);
        let (mut shared, mut frames) = (0, 0);
        while frames < 3 || (shared < 1 && workers > 0 && frames < 200) {
            frames += 1;
            let states: Vec<State> = (0..COUNT).map(|_| near(&mut random, Vec3::zeros(), 0.03)).collect();
            assert_eq!(scene.step(&states), COUNT * (COUNT - 1) / 2);
            shared += usize::from(scene.is_shared());
        }
        assert!((shared > 0) == (workers > 0), "{shared} {frames}");
    }
}
