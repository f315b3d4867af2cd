//! A world in which every pair of kinds touches and separates, in frames that use all ways of calling.

use crate::common::own_kinds::extensions;
use crate::common::*;
use crate::heap::during;
use crate::registered::laws;
use pong_engine::*;
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::{Quat, Vec3};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// Stations at which a part waits for the movers to come down, one metre apart, with their tops at z = 0.
const STATIONS: u32 = 6;

/// One primitive of every kind that can be A, lowest points at z = 0, and two more points on an arm that
/// moves on its own.
fn mover(surface: &str) -> String {
    format!(
        "(format: \"pong-model\", version: 1, name: \"mover\", surfaces: {{ {surface} }}, root: (name: \"mover\",
          surface: \"s\", groups: [
            (name: \"feet\", primitives: [
              Point(name: \"point\", position: (0.02, 0.02, 0.0)),
              LineSegment(name: \"bar\", ends: ((-0.03, -0.02, 0.0), (0.03, -0.02, 0.0))),
              Ray(name: \"plunger\", origin: (0.0, 0.03, 0.05), direction: (0, 0, -1), length: 0.055, reach: 0.02),
              Sphere(name: \"ball\", center: (-0.03, 0.0, 0.04), radius: 0.04),
              Ellipsoid(name: \"egg\", center: (0.03, 0.0, 0.02), semi_axes: (0.02, 0.015, 0.02)) ]),
            (name: \"arm\", movable: true, bound: Obb, primitives: [
              Point(name: \"near\", position: (0.0, -0.03, 0.0)), Point(name: \"far\", position: (0.0, -0.05, 0.0)) ]),
          ]))"
    )
}

/// A sphere, an ellipsoid, a mesh, two blocks with an internal face, a pit that a ball touches on all sides,
/// a post.
fn ground(surface: &str) -> String {
    let bump = |x: f64, y: f64| Vec3::new(x + 2.0, y, 0.004 * ((40.0 * x).sin() + (37.0 * y).cos()) - 0.006);
    // A ball that goes down between the walls has contact normals more than 90° apart.
    let pit = "TriangleMesh(name: \"pit\", vertices: [(3.97, -0.03, 0.02), (4.03, -0.03, 0.02), (4.03, 0.03, 0.02), \
               (3.97, 0.03, 0.02), (4.0, 0.0, -0.13)], triangles: [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)], \
               thickness: 0.05)";
    let parts = [
        "Sphere(name: \"dome\", center: (0, 0, -0.5), radius: 0.5)".to_owned(),
        "Ellipsoid(name: \"hill\", center: (1, 0, -0.2), semi_axes: (0.5, 0.4, 0.2))".to_owned(),
        plate_mesh("terrain", 6, 0.4, bump),
        box_polyhedron("left", [2.95, 0.0, -0.1], [0.05, 0.2, 0.1], "5"),
        box_polyhedron("right", [3.05, 0.0, -0.1], [0.05, 0.2, 0.1], "4"),
        pit.to_owned(),
        "Custom(name: \"post\", kind: \"Post\", parameters: [0.1])".to_owned(),
    ];
    model("ground", surface, &parts.join(","))
}

/// A clock that advances with each reading.
fn ticks() -> u64 {
    static TICKS: AtomicU64 = AtomicU64::new(0);
    TICKS.fetch_add(1, Relaxed)
}

/// A point, and enough balls that workers are used.
fn probes() -> String {
    let ball = |i: u32| {
        let (x, y) = (0.1 * f64::from(i % 4), 0.1 * f64::from(i / 4));
        format!("Sphere(name: \"ball {i}\", center: ({:?}, {:?}, 0.01), radius: 0.01)", x - 0.15, y - 0.15)
    };
    let balls: Vec<String> = (0..16).map(ball).collect();
    format!("Point(name: \"p\", position: (0, 0, 0)), {}", balls.join(","))
}

pub struct Bench {
    pub world: World,
    movers: [ObjectId; 2],
    /// Movers, ground, floor, then the two with laws of their own.
    interfaces: Vec<InterfaceId>,
    /// Kinds of the primitives of each interface.
    kinds: Vec<Vec<PrimitiveKind>>,
    pairs: Vec<PairId>,
    states: Vec<(InterfaceId, State)>,
    block: Vec<u8>,
    pub seen: Seen,
}

/// Record of what happened, to show that the frames were worth counting.
#[derive(Default)]
pub struct Seen {
    /// Frames in which the kinds of (A, B) touched, and frames in which they did not.
    pub touches: [[u32; 9]; 9],
    pub frames: u32,
    pub limited: u32,
    pub empty: u32,
    /// Frames in which a worker took part.
    pub shared: u32,
    pub most_contacts: usize,
}

impl Bench {
    pub fn new(config: Config) -> Self {
        let extensions = extensions();
        let mut builder = WorldBuilder::with_extensions(config, extensions.clone(), laws());
        builder.set_clock(ticks);
        let rubber = surface(
            1e5,
            "normal: Linear(damping: 100.0, ramp: 1e-4), friction: Bristle(mu: 0.4, static_excess: 0.5)",
        );
        let own = surface(
            1.0,
            "normal: Custom(name: \"cubic\", parameters: [1e9]), friction: Custom(name: \"glue\", parameters: [500.0])",
        );
        let plane = "Plane(name: \"floor\", normal: (0, 0, 1), offset: -0.01)";
        let probe =
            model("probe", &own, &probes()).replace("root: (", "root: (bound: Custom(\"Everywhere\"), ");
        let counter = [plane.to_owned(), plate_mesh("mat", 4, 0.6, |x, y| Vec3::new(x, y, -0.009))];
        let texts = [
            mover(&rubber),
            ground(&rubber),
            model("floor", &rubber, plane),
            probe,
            model("counter", &own, &counter.join(",")),
        ];
        let models = texts.map(|text| {
            let model = pong_model::parse(&text, "test.ron", None, &extensions);
            builder.add_model(Arc::new(model.unwrap_or_else(|errors| panic!("{errors}\n{text}"))))
        });
        // One mover before and one after the ground, for both orders of A and B. The part that marks threads
        // comes first, because the caller begins with the last blocks.
        let objects =
            [(3, "probe"), (4, "counter"), (0, "first"), (1, "ground"), (0, "second"), (2, "floor")]
                .map(|(model, name)| builder.create_object(models[model], name).unwrap());
        let [probe, counter, first, ground, second, floor] = objects;
        let pairs = [(first, ground), (ground, second), (first, floor), (probe, counter), (second, first)]
            .map(|(a, b)| builder.pair(a, b).unwrap());
        let (world, _) = builder.seal().unwrap();
        let (mut interfaces, mut kinds) = (Vec::new(), Vec::new());
        for object in [first, second, ground, floor, probe, counter] {
            let bodies = &world.scene().model_of(object).unwrap().bodies;
            kinds
                .extend(bodies.iter().map(|body| body.primitives.iter().map(|p| p.kind).collect::<Vec<_>>()));
            interfaces.extend(world.scene().interfaces(object).unwrap());
        }
        let states = interfaces.iter().map(|interface| (*interface, State::identity())).collect();
        let block = vec![0; world.state_size()];
        let seen = Seen::default();
        Self { world, movers: [first, second], interfaces, kinds, pairs: pairs.into(), states, block, seen }
    }

    /// Sets all states of frame `i`: the movers hop from station to station, down and up again at each.
    pub fn place(&mut self, i: u32) {
        let t = f64::from(i);
        // In some frames everything is far away.
        let lift = if i % 100 < 10 { 1.5 } else { 0.0 };
        for mover in 0..2 {
            // The second mover is half a round and half a hop behind.
            let phase = t / 32.0 + f64::from(mover) * (f64::from(STATIONS) + 1.0) / 2.0;
            let station = phase as u32 % STATIONS;
            let x = [0.0, 1.0, 2.0, 3.0, 4.03, 0.09][station as usize];
            let hop = (std::f64::consts::TAU * phase).cos();
            let slide =
                Vec3::new(x + 0.004 * (0.7 * t).sin(), 0.003 * (0.3 * t).cos(), 0.012 * hop - 0.002 + lift);
            let turn =
                Quat::from_scaled_axis(Vec3::new(0.01 * (0.2 * t).sin(), 0.01, 0.05 * (0.1 * t).sin()));
            let state = moving(slide, turn, Vec3::new(0.01, 0.0, 0.05 * hop), Vec3::new(0.0, 0.0, 0.1));
            let arm = moving(slide + Vec3::new(0.0, 0.0, 0.003), turn, Vec3::zeros(), Vec3::zeros());
            self.states[2 * mover as usize].1 = state;
            self.states[2 * mover as usize + 1].1 = arm;
        }
        let probe = Vec3::new(0.001 * (0.5 * t).sin(), 0.0, 0.004 * (0.25 * t).sin() - 0.008 + lift);
        self.states[6].1 = at(probe, Quat::identity());
    }

    /// Runs one frame, in one of the ways in which hosts call.
    fn frame(&mut self, i: u32) {
        self.place(i);
        let world = &mut self.world;
        if i.is_multiple_of(3) {
            let states = &self.states;
            states.iter().for_each(|(interface, state)| {
                during("set_state", || world.set_state(*interface, state)).unwrap();
            });
        } else {
            during("set_states", || world.set_states(&self.states)).unwrap();
        }
        if i % 50 == 1 {
            during("prewake and quiesce", || world.prewake(std::time::Duration::from_micros(20)));
        } else if i % 50 == 2 {
            during("prewake and quiesce", || world.quiesce());
        }
        // The cycle differs from that of the hops, so that every way of calling meets every kind of contact
        // in the long run.
        match i % 7 {
            0 | 1 => drop(during("step", || world.step()).unwrap()),
            2 => {
                during("evaluate", || world.evaluate()).unwrap();
                during("evaluate", || world.evaluate()).unwrap();
                during("commit", || world.commit()).unwrap();
            }
            3 => {
                during("evaluate", || world.evaluate()).unwrap();
                let some = &self.pairs[(i / 7) as usize % 3..][..2];
                during("commit_pairs", || world.commit_pairs(some)).unwrap();
            }
            4 => {
                let pair = self.pairs[(i / 7) as usize % self.pairs.len()];
                let off = (i / 35).is_multiple_of(4);
                during("set_pair_enabled", || world.set_pair_enabled(pair, !off)).unwrap();
                during("step", || world.step()).unwrap();
                during("set_pair_enabled", || world.set_pair_enabled(pair, true)).unwrap();
                during("commit", || world.commit()).unwrap();
            }
            5 => {
                let object = self.movers[(i / 7) as usize % 2];
                if (i / 14).is_multiple_of(5) {
                    during("clear_contact_history", || world.clear_contact_history(object)).unwrap();
                }
                during("step", || world.step()).unwrap();
            }
            _ => {
                during("save_state", || world.save_state(&mut self.block)).unwrap();
                during("step", || world.step()).unwrap();
                during("restore_state", || world.restore_state(&self.block)).unwrap();
                during("evaluate", || world.evaluate()).unwrap();
            }
        }
        self.look();
    }

    /// Reads everything that a host can read of a frame.
    fn look(&mut self) {
        let (world, seen) = (&self.world, &mut self.seen);
        let mut touch = [[false; 9]; 9];
        during("contacts_iter", || {
            for contact in world.contacts_iter() {
                let [a, b] = [contact.a, contact.b].map(|side| {
                    let body = self.interfaces.iter().position(|interface| *interface == side.interface);
                    self.kinds[body.unwrap()][side.primitive as usize]
                });
                touch[a as usize][b as usize] = true;
            }
        });
        for (frames, touch) in seen.touches.iter_mut().flatten().zip(touch.iter().flatten()) {
            *frames += u32::from(*touch);
        }
        let mut load = 0.0;
        during("wrench and wrench_common", || {
            for interface in &self.interfaces {
                load += world.wrench(*interface).unwrap().force.norm();
                load += world.wrench_common(*interface).unwrap().moment.norm();
            }
        });
        during("reports", || {
            let report = world.report();
            let ledger = world.ledger();
            assert!(load.is_finite() && ledger.stored.is_finite());
            assert!(world.memory().contacts_peak >= world.contact_count());
            assert!(world.counts().testers().count() > 0 || world.contact_count() == 0);
            seen.shared += u32::from(world.thread_work().skip(1).any(|lane| lane.blocks > 0));
            seen.frames += 1;
            seen.limited += u32::from(report.status.leaves_contacts_out());
            seen.empty += u32::from(world.contact_count() == 0);
            seen.most_contacts = seen.most_contacts.max(world.contact_count());
            assert!(world.is_evaluated() || report.contacts as usize == world.contact_count());
        });
    }

    pub fn frames(&mut self, range: std::ops::Range<u32>) {
        range.for_each(|i| self.frame(i));
    }
}
