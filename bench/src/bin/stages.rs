//! Time of every stage of a frame by the engine's own clock, median of all frames. The engine reads the clock
//! between the stages, so these frames are slightly longer than others.

use pong_bench::options::Options;
use pong_bench::rig::{self, Rig};
use pong_bench::ring::{self, Ring, Tip};
use pong_bench::scenes::Scene;
use pong_bench::table::Table;
use pong_bench::terrain::{Terrain, Wheel};
use pong_bench::timing::{digits, median, now_ns};
use pong_engine::{Stage, State, Work, WorldBuilder};
use std::error::Error;

const MICRO_NS: f64 = 1e3;

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(30)?;
    let cores = std::thread::available_parallelism()?.get().max(2);
    rig::bind_caller();
    let columns = Stage::ALL.map(Stage::name).into_iter().chain(Work::ALL.map(Work::name));
    let head: Vec<&str> = ["scene", "threads", "frame"].into_iter().chain(columns).collect();
    let mut table = Table::new(&head);
    for (number, (name, scene)) in scenes(options.smoke)?.into_iter().enumerate() {
        for threads in rig::thread_counts(cores) {
            if options.wants(number) {
                let mut builder = WorldBuilder::new(rig::config(threads));
                builder.set_clock(now_ns);
                let middles = middles(&mut scene.rig(builder)?, &scene.states, options.rounds);
                let cells = middles.into_iter().map(|ns| digits(ns / MICRO_NS));
                table.row([name.clone(), threads.to_string()].into_iter().chain(cells));
            }
        }
    }
    println!("µs per frame by stage, and the work of the stage contacts, summed over all threads\n\n{table}");
    Ok(())
}

fn scenes(smoke: bool) -> Result<Vec<(String, Scene)>, Box<dyn Error>> {
    let mut scenes = vec![
        ("docking".to_owned(), Scene::docking()?),
        ("six spheres on 10,000 triangles".to_owned(), Scene::wheels(&Terrain::SIZES[1], Wheel::BOTH[0])?),
        ("six ellipsoids on 10,000 triangles".to_owned(), Scene::wheels(&Terrain::SIZES[1], Wheel::BOTH[1])?),
    ];
    for (wedges, points) in ring::sizes(smoke) {
        let ring = Ring::new((wedges, points));
        scenes.push((format!("ring, {wedges} wedges, {points} spheres"), Scene::ring(&ring, Tip::Sphere)?));
    }
    Ok(scenes)
}

/// Medians of the whole frame and of every following column, ns.
fn middles(rig: &mut Rig, states: &[Vec<State>], rounds: usize) -> Vec<f64> {
    let mut columns = vec![Vec::new(); 1 + Stage::ALL.len() + Work::ALL.len()];
    // All buffers have grown after one pass.
    for pass in 0..=rounds {
        for states in states {
            let began = now_ns();
            rig.step(states);
            let whole = now_ns() - began;
            let times = rig.world.stage_times();
            let stages = Stage::ALL.iter().map(|&stage| times.of(stage));
            let parts = Work::ALL.iter().map(|&work| times.work.of(work));
            if pass > 0 {
                let all = std::iter::once(whole).chain(stages).chain(parts);
                columns.iter_mut().zip(all).for_each(|(column, ns)| column.push(ns as f64));
            }
        }
    }
    columns.into_iter().map(median).collect()
}
