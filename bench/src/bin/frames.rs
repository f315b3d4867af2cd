//! Frames of one fixed scene, for a counter of instructions: `frames SCENE [FRAMES]`.
//!
//! All that happens in the function `pong_bench_frames` is frames: `ci/instructions` counts in there alone. The
//! level of instructions is fixed, so that a counter that knows fewer than the machine counts the same.

use pong_bench::rig::{self, Rig};
use pong_bench::ring::{self, Ring, Tip};
use pong_bench::terrain::{self, Terrain, Wheel};
use pong_bench::{docking, optional, scenes};
use pong_engine::{State, World};
use pong_geometry::simd::{Level, set_level};
use std::error::Error;
use std::sync::Arc;

const SCENES: &str = "docking, docking_crowded, docking_unused, docking_pair_off, ring, wheels";
const FRAMES: usize = 64;
/// Objects that meet nobody, in a crowded scene.
const BYSTANDERS: usize = 1000;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().ok_or(format!("frames SCENE [FRAMES], with SCENE one of {SCENES}"))?;
    let frames = arguments.next().map_or(Ok(FRAMES), |text| text.parse())?;
    let level = set_level(Level::Avx2);
    let (mut rig, states) = scene(&name)?;
    // Whatever grows has grown after one pass.
    let contacts: u32 = states.iter().map(|states| contacts(&mut rig, states)).sum();
    if contacts == 0 {
        return Err(format!("{name}: nothing touches").into());
    }
    pong_bench_frames(&mut rig, &states, frames);
    let per_frame = f64::from(contacts) / states.len() as f64;
    println!("{name}: {frames} frames at level {}, {per_frame:.2} contacts per frame", level.name());
    Ok(())
}

fn contacts(rig: &mut Rig, states: &[State]) -> u32 {
    rig.step(states);
    rig.world.report().contacts
}

/// The frames that count. Its name is looked for.
#[unsafe(no_mangle)]
#[inline(never)]
fn pong_bench_frames(rig: &mut Rig, states: &[Vec<State>], frames: usize) {
    for states in states.iter().cycle().take(frames) {
        std::hint::black_box(rig.step(states));
    }
}

type Scene = (Rig, Vec<Vec<State>>);

fn scene(name: &str) -> Result<Scene, Box<dyn Error>> {
    Ok(match name {
        "docking" => docking_scene(World::new(rig::config(1)), 0)?,
        "docking_crowded" => docking_scene(World::new(rig::config(1)), BYSTANDERS)?,
        "docking_unused" => docking_scene(optional::world_with_unused(), 0)?,
        "docking_pair_off" => pair_off_scene()?,
        "ring" => (scenes::ring(&Ring::new(ring::SIZES[1]), Tip::Sphere, 1)?, scenes::ring_states()),
        "wheels" => {
            let [sphere, _] = Wheel::BOTH;
            (scenes::wheels(&Terrain::SIZES[1], sphere)?, terrain::states(FRAMES, sphere))
        }
        other => return Err(format!("{other}: use one of {SCENES}").into()),
    })
}

fn docking_scene(world: World, bystanders: usize) -> Result<Scene, Box<dyn Error>> {
    let mut models = docking::models()?.to_vec();
    let states = docking::states(&models[0]);
    let bystander = scenes::parse(&Wheel::BOTH[0].model())?;
    models.extend(vec![bystander; bystanders]);
    Ok((Rig::in_world(world, &models, &[(0, 1)])?, states))
}

/// Docking with a third Object in the way of the first as well, their pair switched off.
fn pair_off_scene() -> Result<Scene, Box<dyn Error>> {
    let [active, passive] = docking::models()?;
    let states = docking::states(&active);
    let models = [active, Arc::clone(&passive), passive];
    let mut rig = Rig::in_world(World::new(rig::config(1)), &models, &[(0, 1), (0, 2)])?;
    rig.world.set_pair_enabled(rig.pairs[1], false)?;
    Ok((rig, states))
}
