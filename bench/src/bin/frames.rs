//! Frames of one fixed scene, for a counter of instructions: `frames SCENE [FRAMES] [cold]`.
//!
//! Only frames run in the function `pong_bench_frames`, in which `ci/instructions` counts. The instruction
//! set level is fixed, so that a counter that supports fewer instructions than the machine counts the same.
//! With `cold`, more memory than the counter's caches hold is read before each frame.

use pong_bench::rig::Rig;
use pong_bench::scenes::{self, FRAMES, Frames, Scene};
use pong_bench::terrain::Wheel;
use pong_bench::{optional, rig};
use pong_engine::{State, WorldBuilder};
use pong_geometry::simd::{Level, set_level};
use std::error::Error;
use std::sync::Arc;

const SCENES: &str =
    "docking, docking_crowded, docking_unused, docking_pair_off, ring, wheels, contact, contacts";
/// Objects without contact in a crowded scene.
const BYSTANDERS: usize = 1000;
/// Memory read before a cold frame, bytes: twice the largest cache that `ci/instructions` simulates.
const OTHER_WORK: usize = 16 << 20;
/// A cache line, bytes.
const LINE: usize = 64;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().ok_or(format!("frames SCENE [FRAMES] [cold], with SCENE one of {SCENES}"))?;
    let frames = arguments.next().map_or(Ok(FRAMES), |text| text.parse())?;
    let cold = match arguments.next().as_deref() {
        None => false,
        Some("cold") => true,
        Some(other) => return Err(format!("{other}: the third word can be cold").into()),
    };
    let level = set_level(Level::Avx2);
    let (mut rig, states) = scene(&name)?;
    // All buffers have grown after one pass.
    let contacts: u32 = states.iter().map(|states| contacts(&mut rig, states)).sum();
    if contacts == 0 {
        return Err(format!("{name}: nothing touches").into());
    }
    if cold {
        let other_work = vec![1_u8; OTHER_WORK];
        for states in states.iter().cycle().take(frames) {
            let read: u64 = other_work.iter().step_by(LINE).map(|&byte| u64::from(byte)).sum();
            std::hint::black_box(read);
            pong_bench_frames(&mut rig, std::slice::from_ref(states), 1);
        }
    } else {
        pong_bench_frames(&mut rig, &states, frames);
    }
    let per_frame = f64::from(contacts) / states.len() as f64;
    println!("{name}: {frames} frames at level {}, {per_frame:.2} contacts per frame", level.name());
    Ok(())
}

fn contacts(rig: &mut Rig, states: &[State]) -> u32 {
    rig.step(states);
    rig.world.report().contacts
}

/// The counted frames. The counter finds this function by name.
#[unsafe(no_mangle)]
#[inline(never)]
fn pong_bench_frames(rig: &mut Rig, states: &[Vec<State>], frames: usize) {
    for states in states.iter().cycle().take(frames) {
        std::hint::black_box(rig.step(states));
    }
}

fn scene(name: &str) -> Result<(Rig, Frames), Box<dyn Error>> {
    if !SCENES.split(", ").any(|known| known == name) {
        return Err(format!("{name}: use one of {SCENES}").into());
    }
    let mut scene = Scene::fixed(name.split('_').next().unwrap_or(name))?;
    let mut builder = WorldBuilder::new(rig::config(1));
    match name {
        "docking_crowded" => {
            let bystander = scenes::parse(&Wheel::BOTH[0].model())?;
            scene.models.extend(vec![bystander; BYSTANDERS]);
        }
        "docking_unused" => builder = optional::world_with_unused(),
        // A third Object also touches the first, but their pair is disabled.
        "docking_pair_off" => {
            scene.models.push(Arc::clone(&scene.models[1]));
            scene.pairs.push((0, 2));
        }
        _ => {}
    }
    let mut rig = scene.rig(builder)?;
    if name == "docking_pair_off" {
        rig.world.set_pair_enabled(rig.pairs[1], false)?;
    }
    Ok((rig, scene.states))
}
