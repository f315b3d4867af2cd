//! Calls of a host. Calls of a frame in ns per frame, by the wall clock if only a part of the frame is timed;
//! `clock` is the overhead included in such a time.

use crate::clock::{ThreadTime, middle_of, per_item};
use criterion::{BatchSize, BenchmarkGroup, BenchmarkId, Criterion};
use pong_bench::docking;
use pong_bench::folder::Folder;
use pong_bench::rig::{self, Rig, Unsealed};
use pong_bench::ring::{self, Ring, Tip};
use pong_bench::scenes::{self, FIXED, Scene};
use pong_bench::terrain::{Source, Terrain};
use pong_bench::timing::now_ns;
use pong_engine::{State, WorldBuilder};
use pong_model::Extensions;
use std::error::Error;
use std::hint::black_box;

type Group<'a> = BenchmarkGroup<'a, ThreadTime>;

/// Runs all of them.
pub fn all(criterion: &mut Criterion<ThreadTime>) -> Result<(), Box<dyn Error>> {
    let mut group = criterion.benchmark_group("calls");
    for name in FIXED {
        let scene = Scene::fixed(name)?;
        frames(&mut group, name, &scene)?;
        contact_state(&mut group, name, &scene)?;
        seal(&mut group, name, &scene);
    }
    group.bench_function("clock", |bencher| {
        bencher.iter_custom(|calls| middle_of(calls, || timed(|| ())));
    });
    group.finish();
    loading(criterion)
}

// ---- frames

fn frames(group: &mut Group<'_>, name: &str, scene: &Scene) -> Result<(), Box<dyn Error>> {
    let states = &scene.states;
    let mut rig = scene.rig(WorldBuilder::new(rig::config(1)))?;
    let mut part = |part: &str, pass: fn(&mut Rig, &[Vec<State>]) -> f64| {
        group.bench_function(BenchmarkId::new(part, name), |bencher| {
            bencher.iter_custom(|passes| middle_of(passes, || pass(&mut rig, states)));
        });
    };
    part("frame", |rig, states| {
        per_item(1, states.len(), || states.iter().for_each(|states| _ = black_box(rig.step(states))))
    });
    part("set_states", |rig, states| {
        each(states, |states| {
            let time = timed(|| rig.set(states));
            rig.world.step().expect("a sealed world steps");
            time
        })
    });
    part("evaluate", |rig, states| {
        each(states, |states| {
            rig.set(states);
            let time = timed(|| rig.world.evaluate());
            rig.world.commit().expect("an evaluated frame");
            time
        })
    });
    part("commit", |rig, states| {
        each(states, |states| {
            rig.set(states);
            rig.world.evaluate().expect("states are set");
            timed(|| rig.world.commit())
        })
    });
    part("wrenches", |rig, states| {
        each(states, |states| {
            rig.set(states);
            rig.world.step().expect("a sealed world steps");
            timed(|| rig.read(states.len()).len())
        })
    });
    Ok(())
}

/// Mean over the frames of a pass, ns.
fn each(states: &[Vec<State>], mut frame: impl FnMut(&[State]) -> f64) -> f64 {
    states.iter().map(|states| frame(states)).sum::<f64>() / states.len() as f64
}

/// Wall-clock time, which is faster to read than the thread's clock, ns.
fn timed<T>(part: impl FnOnce() -> T) -> f64 {
    let start = now_ns();
    black_box(part());
    (now_ns() - start) as f64
}

// ---- contact state

fn contact_state(group: &mut Group<'_>, name: &str, scene: &Scene) -> Result<(), Box<dyn Error>> {
    let mut rig = scene.rig(WorldBuilder::new(rig::config(1)))?;
    let touching = |rig: &mut Rig, states: &Vec<State>| {
        rig.step(states);
        rig.world.report().contacts > 0
    };
    // Up to a frame in the middle of the path that has contact state to save.
    let middle = scene.states.len() / 2;
    scene.states[..middle].iter().for_each(|states| _ = rig.step(states));
    scene.states[middle..].iter().find(|states| touching(&mut rig, states)).ok_or("nothing touches")?;
    let mut block = vec![0; rig.world.state_used()];
    rig.world.save_state(&mut block)?;
    group.bench_function(BenchmarkId::new("save_state", name), |bencher| {
        bencher.iter(|| rig.world.save_state(black_box(&mut block)));
    });
    group.bench_function(BenchmarkId::new("restore_state", name), |bencher| {
        bencher.iter(|| rig.world.restore_state(black_box(&block)));
    });
    Ok(())
}

// ---- set-up

fn seal(group: &mut Group<'_>, name: &str, scene: &Scene) {
    let set_up = || {
        let builder = WorldBuilder::new(rig::config(1));
        Unsealed::new(builder, &scene.models, &scene.pairs).expect("a scene that was built before")
    };
    group.bench_function(BenchmarkId::new("seal", name), |bencher| {
        bencher.iter_batched(set_up, Unsealed::seal, BatchSize::PerIteration);
    });
}

fn loading(criterion: &mut Criterion<ThreadTime>) -> Result<(), Box<dyn Error>> {
    let mut group = criterion.benchmark_group("load");
    group.bench_function("docking", |bencher| bencher.iter(docking::models));
    let ring = Ring::new(ring::SIZES[1]);
    group.bench_function("ring", |bencher| {
        bencher.iter_custom(|passes| {
            let [wedges, tips] = [ring.wedge_model(), ring.tip_model(Tip::Sphere)];
            per_item(passes, 1, || _ = black_box([scenes::parse(&wedges), scenes::parse(&tips)]))
        });
    });
    let folder = Folder::new("parts")?;
    for source in [Source::Inline, Source::Obj, Source::Stl] {
        let (path, _) = folder.write(Terrain::SIZES[1], source)?;
        group.bench_function(BenchmarkId::new("10000_triangles", format!("{source:?}")), |bencher| {
            bencher.iter(|| pong_model::load(&path, &Extensions::new()));
        });
    }
    group.finish();
    Ok(())
}
