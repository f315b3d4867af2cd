//! Every stage of a frame on the fixed scenes, by the engine's own timer: wall-clock ns per frame, including
//! the reading of the clock. Energies are kept, so that no stage is empty.

use crate::clock::{ThreadTime, middle_of};
use criterion::{BenchmarkId, Criterion};
use pong_bench::rig::{self, Rig};
use pong_bench::scenes::{FIXED, Scene};
use pong_bench::timing::now_ns;
use pong_engine::{Config, Stage, State, WorldBuilder};
use std::error::Error;

/// Runs all of them.
pub fn all(criterion: &mut Criterion<ThreadTime>) -> Result<(), Box<dyn Error>> {
    let mut group = criterion.benchmark_group("stages");
    for name in FIXED {
        let scene = Scene::fixed(name)?;
        let mut builder = WorldBuilder::new(Config { ledger: true, ..rig::config(1) });
        builder.set_clock(now_ns);
        let mut rig = scene.rig(builder)?;
        for stage in Stage::ALL {
            group.bench_function(BenchmarkId::new(name, stage.name()), |bencher| {
                bencher.iter_custom(|passes| middle_of(passes, || pass(&mut rig, &scene.states, stage)));
            });
        }
    }
    group.finish();
    Ok(())
}

/// Time of a stage, ns per frame.
fn pass(rig: &mut Rig, states: &[Vec<State>], stage: Stage) -> f64 {
    let frame = |states: &Vec<State>| {
        rig.step(states);
        rig.world.stage_times().of(stage)
    };
    states.iter().map(frame).sum::<u64>() as f64 / states.len() as f64
}
