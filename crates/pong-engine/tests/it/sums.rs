//! The wrenches are the sums over the listed contacts to 1e-12 of the largest, for any number of contacts,
//! threads and rounds, and so are the sums over the wrenches of single pairs. The reference adds them in list
//! order in the common frame, with compensated summation.

use crate::common::stage::{Path, Scene, Stage, workers};
use crate::common::{model, points, rough};
use pong_engine::{InterfaceId, State, StatusBits};
use pong_geometry::Vec3;
use pong_testkit::Random;
use std::collections::HashMap;
use std::time::Duration;

/// Objects of these model files, all paired, with this many movable groups.
fn all_paired(models: Vec<String>, objects: Vec<usize>, groups: usize, capacity: usize) -> Scene {
    let count = objects.len();
    let mut scene = Scene::new("sums", 0, models);
    scene.pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b))).collect();
    (scene.objects, scene.contact_capacity, scene.ledger) = (objects, Some(capacity), false);
    scene.paths = vec![Path::still([0.0; 3]); groups];
    scene
}

/// Steps and compares; returns the number of contacts.
fn step(stage: &mut Stage<'_>, states: &[State]) -> usize {
    let set: Vec<_> = stage.groups.iter().copied().zip(states.iter().copied()).collect();
    stage.world.set_states(&set).unwrap();
    // Rare frames wake no worker.
    stage.world.prewake(Duration::from_secs(60));
    stage.world.step().unwrap();
    let contacts = stage.world.contacts();
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
    for group in &stage.groups {
        let [force, moment] = sums.remove(group).unwrap_or_default().map(Exact::sum);
        let mut by_pairs = [Exact::default(); 2];
        for other in stage.groups.iter().filter(|other| object_of(stage, **other) != object_of(stage, *group))
        {
            let from = stage.world.wrench_from_common(*group, *other).unwrap();
            by_pairs[0].add(&from.force);
            by_pairs[1].add(&from.moment);
        }
        let got = stage.world.wrench_common(*group).unwrap();
        for [sum_force, sum_moment] in [[got.force, got.moment], by_pairs.map(Exact::sum)] {
            let off = (sum_force - force).norm().max((sum_moment - moment).norm());
            assert!(off <= 1e-12 * largest, "{group:?}: {got:?}, not {force:?} {moment:?}, {largest}");
        }
    }
    assert!(sums.is_empty());
    contacts.len()
}

/// Name of the Object of a movable group.
fn object_of(stage: &Stage<'_>, group: InterfaceId) -> String {
    let name = stage.world.scene().interface_name(group).unwrap();
    name.split('/').next().unwrap().to_owned()
}

fn is_shared(stage: &Stage<'_>) -> bool {
    stage.world.thread_work().skip(1).any(|lane| lane.blocks > 0)
}

/// A compensated sum (A. Neumaier, Z. Angew. Math. Mech. 54 (1974) 39).
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

/// A random moving state near a position, slightly rotated.
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

/// Two brushes and a floor: many contacts in each of few directions.
#[test]
fn brushes_on_a_floor() {
    let brush = |count, seed| model("brush", &rough(1e4), &points(count, 0.02, seed));
    let floor = model("floor", &rough(1e4), "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)");
    let scene = all_paired(vec![brush(3000, 41), brush(700, 42), floor], vec![0, 1, 2], 3, 8000);
    for count in [0, 1, 3] {
        let mut stage = scene.set_up(workers(count));
        let mut random = Random(count as u64);
        let (mut most, mut shared, mut frames) = (0, 0, 0);
        // On a busy machine, workers may come too late for many frames in a row.
        while frames < 12 || (shared < 3 && count > 0 && frames < 2000) {
            frames += 1;
            let states = [
                near(&mut random, Vec3::zeros(), 0.005),
                near(&mut random, Vec3::z() * 0.02, 0.005),
                near(&mut random, Vec3::zeros(), 0.005),
            ];
            most = most.max(step(&mut stage, &states));
            shared += usize::from(is_shared(&stage));
        }
        assert!(most > 1500 && (shared > 0) == (count > 0), "{most} {shared} {frames}");
    }
}

/// Sums after contacts were dropped: rays of a brush push the nearer of two groups of one Object, and of the
/// points the deepest are kept.
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
    let brush = model("brush", &rough(1e4), &(0..600).map(movers).collect::<Vec<_>>().join(","));
    let plane = "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)";
    let floor = model("floor", &rough(1e4), plane).replace(
        &format!("primitives: [ {plane} ]"),
        &format!(
            "groups: [(name: \"slab\", primitives: [{plane}]), (name: \"gate\", movable: true, primitives: [{plane}])]"
        ),
    );
    for (count, capacity) in [(0, 2000), (2, 2000), (0, 250), (2, 250)] {
        let scene = all_paired(vec![brush.clone(), floor.clone()], vec![0, 1], 3, capacity);
        let mut stage = scene.set_up(workers(count));
        let mut random = Random(capacity as u64);
        for _ in 0..20 {
            let states = [-0.02, 0.0, -0.01].map(|z| near(&mut random, Vec3::z() * z, 0.005));
            let found = step(&mut stage, &states);
            let is_limited = stage.world.report().status.contains(StatusBits::CONTACT_LIMIT);
            assert!(found > 100 && is_limited == (capacity == 250), "{found}");
        }
    }
}

/// A heap of balls that all touch each other: each contact in a direction of its own, in more than one round.
#[test]
fn a_heap_of_balls() {
    const COUNT: usize = 128;
    let ball = model("ball", &rough(1e4), "Sphere(name: \"s\", center: (0.02,0,0), radius: 0.1)");
    let scene = all_paired(vec![ball], vec![0; COUNT], COUNT, 9000);
    for count in [0, 1, 3] {
        let mut stage = scene.set_up(workers(count));
        let mut random = Random(count as u64 + 5);
        let (mut shared, mut frames) = (0, 0);
        while frames < 3 || (shared < 1 && count > 0 && frames < 200) {
            frames += 1;
            let states: Vec<State> = (0..COUNT).map(|_| near(&mut random, Vec3::zeros(), 0.03)).collect();
            assert_eq!(step(&mut stage, &states), COUNT * (COUNT - 1) / 2);
            shared += usize::from(is_shared(&stage));
        }
        assert!((shared > 0) == (count > 0), "{shared} {frames}");
    }
}
