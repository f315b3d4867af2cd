//! Frames that visit only near pairs give bit-identical results to frames that visit all pairs: worlds of
//! many groups that rest, fly, spin, are far from the origin or drift together, while pairs are switched off,
//! contact histories cleared and contact states saved.

use super::swept::Bounds;
use super::tree::BoundsTree;
use crate::{Config, FrameReport, InterfaceId, Laws, PairId, State, World, WorldBuilder};
use pong_geometry::Vec3;
use pong_model::Extensions;
use std::sync::Arc;

/// Random numbers from a fixed seed.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }

    fn within(&mut self, most: f64) -> f64 {
        most * (2.0 * self.unit() - 1.0)
    }

    fn vec3(&mut self, most: f64) -> Vec3 {
        Vec3::new(self.within(most), self.within(most), self.within(most))
    }
}

const CUBE: &str = "Polyhedron(name: \"c\", vertices: [(0.2,-0.1,-0.1),(0.4,-0.1,-0.1),(0.2,0.1,-0.1),(0.4,0.1,-0.1),\
                    (0.2,-0.1,0.1),(0.4,-0.1,0.1),(0.2,0.1,0.1),(0.4,0.1,0.1)], \
                    faces: [[0,2,3,1],[4,5,7,6],[0,1,5,4],[2,6,7,3],[0,4,6,2],[1,3,7,5]])";

/// Five models: a ball, a cube beside its origin, rods with a ray, two movable groups, a half-space.
fn models() -> [String; 5] {
    let ball = |r: f64| format!("Sphere(name: \"b\", center: (0,0,0), radius: {r:?})");
    let rods = "LineSegment(name: \"l\", ends: ((0,-0.3,0),(0,0.3,0))), Point(name: \"p\", position: (0.1,0,0)), \
                Ray(name: \"r\", origin: (0,0,0), direction: (1,0,0), length: 0.4)";
    let hand = format!(
        "groups: [(name: \"palm\", primitives: [{}]), (name: \"finger\", movable: true, primitives: [{CUBE}])]",
        ball(0.15)
    );
    let plane = "Plane(name: \"h\", normal: (0,0,1), offset: 0.0)";
    let [a, b, c, d] =
        [&ball(0.2), CUBE, rods, plane].map(|primitives| format!("primitives: [{primitives}]"));
    [a, b, c, hand, d].map(|group| {
        format!(
            "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{\"s\": (stiffness: 1e4, \
             normal: Linear(damping: 10.0), friction: Bristle(mu: 0.3))}}, root: (name: \"root\", surface: \"s\", {group}))"
        )
    })
}

/// A world and the states of all its movable groups.
struct Flock {
    world: World,
    interfaces: Vec<InterfaceId>,
    pairs: Vec<PairId>,
    states: Vec<State>,
}

/// Initial positions and motion of a flock.
struct Regime {
    /// Half the edge of the initial cube, m.
    room: f64,
    /// Offset of the origin, m.
    origin: f64,
    /// Common displacement per frame, m.
    drift: f64,
    /// Displacement of each group per frame, m.
    way: f64,
    /// Greatest rotation of each group per frame, rad.
    turn: f64,
}

impl Flock {
    fn new(config: Config, plane: bool, regime: &Regime, random: &mut Random) -> Self {
        let config = Config { contact_capacity: Some(1000), ..config };
        let mut builder = WorldBuilder::with_extensions(config, Extensions::new(), Laws::default());
        let made = models().map(|text| {
            let model = pong_model::parse(&text, "m", None, builder.scene().extensions()).unwrap();
            builder.add_model(Arc::new(model))
        });
        let kinds = (0..44).map(|i| if i == 7 && plane { 4 } else { i % 4 });
        let objects: Vec<_> = kinds
            .enumerate()
            .map(|(i, kind)| builder.create_object(made[kind], &format!("o{i}")).unwrap())
            .collect();
        let mut pairs = Vec::new();
        for (i, &a) in objects.iter().enumerate() {
            for &b in &objects[i + 1..] {
                // Pair almost all Objects, named in either order.
                if random.below(20) > 0 {
                    let (a, b) = if random.below(2) == 0 { (a, b) } else { (b, a) };
                    pairs.push(builder.pair(a, b).unwrap());
                }
            }
        }
        let interfaces: Vec<_> =
            objects.iter().flat_map(|object| builder.scene().interfaces(*object).unwrap()).collect();
        let mut states = Vec::new();
        for _ in &interfaces {
            let place = random.vec3(regime.room) + Vec3::repeat(regime.origin);
            states.push(State { position: place.into(), ..State::identity() });
        }
        let (world, _) = builder.seal().unwrap();
        Self { world, interfaces, pairs, states }
    }

    fn fly(&mut self, regime: &Regime, random: &mut Random) {
        for state in &mut self.states {
            let way = random.vec3(regime.way) + Vec3::repeat(regime.drift);
            let turn = random.vec3(0.5 * regime.turn);
            state.position = (Vec3::from(state.position) + way).into();
            state.linear_velocity = (way * 1e3).into();
            state.angular_velocity = (turn * 2e3).into();
            let [w, x, y, z] = state.orientation;
            let (v, w2) = (Vec3::new(x, y, z), 1.0);
            let turned = v * w2 + turn * w + turn.cross(&v);
            let scalar = w * w2 - turn.dot(&v);
            let norm = (scalar * scalar + turned.norm_squared()).sqrt();
            state.orientation =
                [(w * w2 - turn.dot(&v)) / norm, turned.x / norm, turned.y / norm, turned.z / norm];
        }
    }

    fn set(&mut self, states: &[State]) {
        let named: Vec<_> = self.interfaces.iter().copied().zip(states.iter().copied()).collect();
        self.world.set_states(&named).unwrap();
    }

    /// All results of a frame, and its contact state.
    fn told(&self, report: FrameReport) -> (String, Vec<u8>) {
        let wrench = |interface: &InterfaceId| self.world.wrench(*interface).unwrap();
        let wrenches: Vec<_> = self.interfaces.iter().map(wrench).collect();
        let energies: Vec<_> = self.world.pair_accounts().map(|pair| (pair.total, pair.episodes)).collect();
        let mut block = Vec::new();
        self.world.save_state_packed(&mut block);
        let passages = self.world.tunnelling();
        let passages = passages.map(|of| (of.interface.index(), of.primitive, of.through.index(), of.count));
        let contacts: Vec<_> = self
            .world
            .contacts_iter()
            .map(|c| {
                let sides = [c.a, c.b].map(|side| (side.interface.index(), side.primitive, side.element));
                (c.pair.index(), sides, (c.feature, c.end, c.sticks), [c.point, c.normal, c.force], c.work)
            })
            .collect();
        (format!("{report:?} {contacts:?} {wrenches:?} {passages:?} {energies:?}"), block)
    }
}

/// Runs two equal worlds through the same frames, of which one visits only near pairs, and compares their
/// results. Returns the numbers of pairs that this world visited, of all pairs, of contacts, and of
/// tunnelling events.
fn compare(seed: u64, config: &Config, plane: bool, regime: &Regime) -> [usize; 4] {
    let mut near = Flock::new(config.clone(), plane, regime, &mut Random(seed));
    let mut all = Flock::new(config.clone(), plane, regime, &mut Random(seed));
    all.world.runtime_mut().frame.near.visit_all();
    let mut random = Random(seed ^ 0xff);
    let (mut seen, mut saved) = ([0; 4], Vec::new());
    for frame in 0..40 {
        near.fly(regime, &mut random);
        let states = near.states.clone();
        let (pair, object, what) = (random.below(near.pairs.len()), random.below(44), random.below(9));
        let some = [pair, random.below(near.pairs.len())];
        let mut reports = Vec::new();
        for flock in [&mut near, &mut all] {
            flock.set(&states);
            let report = flock.world.evaluate().unwrap();
            reports.push(flock.told(report));
            match what {
                0 => {
                    let on = flock.world.pair_enabled(flock.pairs[pair]).unwrap();
                    flock.world.set_pair_enabled(flock.pairs[pair], !on).unwrap();
                }
                1 => {
                    let object = flock.world.scene().objects().nth(object).unwrap();
                    flock.world.clear_contact_history(object).unwrap();
                }
                2 => flock.world.commit_pairs(&some.map(|pair| flock.pairs[pair])).unwrap(),
                3 => {}
                4 if frame > 10 => flock.world.restore_state(&saved).unwrap(),
                _ => flock.world.commit().unwrap(),
            }
        }
        assert!(reports[0] == reports[1], "seed {seed}, frame {frame}");
        saved.clone_from(&reports[0].1);
        seen[2] += near.world.contact_count();
        seen[3] += near.world.tunnelling().map_or(0, |passages| passages.count as usize);
        seen[0] += near.world.runtime_mut().frame.near.list().len();
        seen[1] += all.world.runtime_mut().frame.near.list().len();
        if frame % 8 == 7 {
            // A clone has no data of earlier frames, and must find the same pairs.
            let mut fresh = near.world.try_clone().unwrap();
            assert_eq!(near.world.evaluate().unwrap(), fresh.evaluate().unwrap());
            assert_eq!(
                near.world.runtime_mut().frame.near.list(),
                fresh.runtime_mut().frame.near.list(),
                "seed {seed}, frame {frame}"
            );
        }
    }
    seen
}

const CALM: Regime = Regime { room: 1.5, origin: 0.0, drift: 0.0, way: 0.004, turn: 0.01 };

#[test]
fn many_that_move_little_visit_few_pairs_and_answer_the_same_bits() {
    let mut touched = 0;
    for seed in 0..3 {
        let [near, all, contacts, _] = compare(seed, &Config::default(), false, &CALM);
        assert!(2 * near < all, "{near} of {all}");
        touched += contacts;
    }
    assert!(touched > 100, "{touched}");
}

#[test]
fn with_half_a_space_among_them_too() {
    compare(3, &Config::default(), true, &CALM);
}

#[test]
fn those_that_fly_and_spin_fast_miss_no_passage() {
    let fast = [
        Regime { way: 0.5, ..CALM },
        Regime { way: 0.5, turn: 0.2, ..CALM },
        Regime { room: 6.0, way: 2.0, turn: 0.24, ..CALM },
        Regime { turn: 0.6, ..CALM },
        Regime { turn: 3.0, way: 0.3, ..CALM },
    ];
    let mut went_through = 0;
    for (index, regime) in fast.iter().enumerate() {
        let [.., passages] = compare(10 + index as u64, &Config::default(), false, regime);
        went_through += passages;
    }
    assert!(went_through > 20, "{went_through}");
}

#[test]
fn a_far_origin_and_a_common_drift_change_nothing() {
    let [near, all, ..] =
        compare(20, &Config::default(), false, &Regime { origin: 1e6, drift: 70.0, ..CALM });
    assert!(2 * near < all, "{near} of {all}: a drift of all is no motion");
}

/// In one frame no pair is visited: the second ball has moved away from the first, and all other movable
/// groups are far apart. When the two balls meet again, their motion counts from the commit of that frame,
/// not from the last frame that visited them.
#[test]
fn after_a_frame_without_any_pair_the_way_counts_from_there() {
    /// Index of the second ball; group 0 is the first.
    const BALL: usize = 5;
    let mut flocks = [(); 2].map(|()| Flock::new(Config::default(), false, &CALM, &mut Random(50)));
    flocks[1].world.runtime_mut().frame.near.visit_all();
    let mut states = flocks[0].states.clone();
    for (place, state) in states.iter_mut().enumerate() {
        *state = State { position: [0.0, 0.0, 1e3 * place as f64], ..State::identity() };
    }
    let mut visited = Vec::new();
    let places =
        [[0.39, 0.0, 0.0], [0.39, 1e-3, 0.0], [50.0, 50.0, 0.0], [-50.0, 50.0, 0.0], [0.39, 2e-3, 0.0]];
    for (frame, place) in places.into_iter().enumerate() {
        states[BALL].position = place;
        let told = flocks.each_mut().map(|flock| {
            flock.set(&states);
            let report = flock.world.evaluate().unwrap();
            let told = flock.told(report);
            flock.world.commit().unwrap();
            (told, report.contacts)
        });
        assert!(told[0] == told[1], "frame {frame}");
        visited.push((flocks[0].world.runtime_mut().frame.near.list().len(), told[0].1));
    }
    assert_eq!(visited, [(1, 1), (1, 1), (1, 0), (0, 0), (1, 1)]);
}

#[test]
fn energies_and_accounts_are_the_same() {
    let held = crate::WrenchCoupling::ZeroOrderHold { delay_frames: 1 };
    for accounts in [None, Some(held)] {
        let config = Config { ledger: true, accounts, ..Config::default() };
        compare(30, &config, false, &Regime { way: 0.05, turn: 0.1, ..CALM });
    }
}

#[test]
fn the_tree_finds_every_overlap_once() {
    let mut random = Random(40);
    for round in 0..60 {
        let count = random.below(200);
        let boxes: Vec<Bounds> = (0..count)
            .map(|_| {
                let (place, half) = (random.vec3(5.0), random.vec3(1.0).abs());
                match random.below(40) {
                    0 => Bounds::everything(),
                    1 => Bounds { low_w: place, high_w: Vec3::repeat(f64::NAN) },
                    _ => Bounds { low_w: place - half, high_w: place + half },
                }
            })
            .collect();
        let numbers: Vec<usize> = (0..count).filter(|_| random.below(5) > 0).collect();
        let (mut found, mut expected) = (Vec::new(), Vec::new());
        BoundsTree::with_capacity(count)
            .overlaps(&numbers, &boxes, &mut |a, b| found.push((a.min(b), a.max(b))));
        for (place, &a) in numbers.iter().enumerate() {
            let others = numbers[place + 1..].iter().filter(|b| boxes[a].overlap(&boxes[**b]));
            expected.extend(others.map(|b| (a, *b)));
        }
        found.sort_unstable();
        assert_eq!(found, expected, "round {round}");
    }
}
