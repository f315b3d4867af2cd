//! W2: the docking ring. The engine's whole frame beside parry's collision detection alone, in the same rounds.

use pong_bench::heap;
use pong_bench::options::Options;
use pong_bench::peer::{Loop, Manifolds};
use pong_bench::rig::{Fingerprint, Rig};
use pong_bench::ring::{self, Ring, Tip};
use pong_bench::timing::Times;
use pong_engine::State;
use pong_geometry::extension::Extensions;
use std::error::Error;
use std::hint::black_box;
use std::sync::Arc;

#[global_allocator]
static HEAP: heap::Counting = heap::Counting;

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(std::env::args().skip(1), 40)?;
    println!(
        "µs per frame, min / median of {} passes; ratios: engine over peer, median [min..max]",
        options.rounds
    );
    for (index, size) in ring::SIZES.into_iter().enumerate() {
        let wanted = options.only.is_none_or(|only| only == index) && !(options.smoke && index > 1);
        if wanted {
            for tip in [Tip::Sphere, Tip::Point] {
                run(size, tip, &options)?;
            }
        }
    }
    Ok(())
}

fn run(size: (usize, usize), tip: Tip, options: &Options) -> Result<(), Box<dyn Error>> {
    let ring = Ring::new(size);
    let mut states = ring::states();
    if options.smoke {
        states.truncate(4);
    }
    let parse = |text: &str| pong_model::parse(text, "ring.ron", None, &Extensions::new()).map(Arc::new);
    let mut rig = Rig::new([parse(&ring.wedge_model())?, parse(&ring.tip_model(tip))?])?;
    println!("\n({}, {}) {tip:?}", size.0, size.1);
    check_first_pass(&mut rig, &states)?;

    let mut engine = Times::default();
    if options.alone {
        for _ in 0..options.rounds {
            engine.run(states.len(), || engine_pass(&mut rig, &states));
        }
        row("engine, whole frame", &engine, "");
        return Ok(());
    }
    let mut manifolds = (tip == Tip::Sphere).then(|| Manifolds::ring(&ring));
    let own_loop = Loop::ring(&ring, tip);
    cross_check(&mut rig, manifolds.as_mut(), &own_loop, &states)?;
    let (mut by_manifolds, mut by_loop) = (Times::default(), Times::default());
    for _ in 0..options.rounds {
        engine.run(states.len(), || engine_pass(&mut rig, &states));
        if let Some(manifolds) = &mut manifolds {
            by_manifolds.run(states.len(), || {
                states.iter().for_each(|states| _ = black_box(manifolds.frame(states)));
            });
        }
        by_loop.run(states.len(), || states.iter().for_each(|states| _ = black_box(own_loop.frame(states))));
    }
    row("engine, whole frame", &engine, "");
    if manifolds.is_some() {
        let ratio = engine.over(&by_manifolds);
        row("parry, contact_manifolds of compounds", &by_manifolds, &format!("ratio {ratio}"));
    }
    row(
        "parry, own loop, intersect_aabb + project_point",
        &by_loop,
        &format!("ratio {}", engine.over(&by_loop)),
    );
    Ok(())
}

fn engine_pass(rig: &mut Rig, states: &[[State; 2]]) {
    for states in states {
        black_box(rig.frame(states));
    }
}

fn row(name: &str, times: &Times, rest: &str) {
    println!("  {name:<48} {:>9.1} / {:>9.1}   {rest}", times.min(), times.median());
}

/// What a frame does, the bits of all wrenches of the first pass, and memory taken in the second.
fn check_first_pass(rig: &mut Rig, states: &[[State; 2]]) -> Result<(), Box<dyn Error>> {
    let mut fingerprint = Fingerprint::default();
    let (mut contacts, mut volumes, mut primitives) = (0.0, 0.0, 0.0);
    for states in states {
        fingerprint.add(&rig.frame(states));
        let report = rig.world.report();
        contacts += f64::from(report.contacts);
        volumes += report.volumes_tested as f64;
        primitives += report.primitives_tested as f64;
    }
    let before = heap::calls();
    engine_pass(rig, states);
    let frames = states.len() as f64;
    let taken = (heap::calls() - before) as f64 / frames;
    println!(
        "  per frame: {:.3} contacts, {:.1} volume tests, {:.1} primitive tests, {taken:.2} allocations; wrenches {fingerprint}",
        contacts / frames,
        volumes / frames,
        primitives / frames
    );
    if contacts == 0.0 {
        return Err("nothing touched".into());
    }
    Ok(())
}

/// Everyone must find as many contacts in every frame.
fn cross_check(
    rig: &mut Rig,
    mut manifolds: Option<&mut Manifolds>,
    own_loop: &Loop,
    states: &[[State; 2]],
) -> Result<(), Box<dyn Error>> {
    for (frame, states) in states.iter().enumerate() {
        rig.frame(states);
        let engine = rig.world.contact_count();
        let by_loop = own_loop.frame(states);
        let by_manifolds = manifolds.as_mut().map_or(engine, |manifolds| manifolds.frame(states));
        if engine != by_loop || engine != by_manifolds {
            return Err(format!(
                "frame {frame}: {engine} contacts of the engine, {by_manifolds} of manifolds, {by_loop} of the loop"
            )
            .into());
        }
    }
    println!("  contact counts agree in every frame");
    Ok(())
}
