//! The contact state block: a restored block must be refused, or be usable in frames.

use crate::count;
use crate::input::Input;
use pong_engine::{Config, InterfaceId, State, World, WorldBuilder};
use std::sync::{Arc, Mutex, OnceLock};

const MODELS: [&str; 2] =
    [include_str!("../seeds/c_models/ball.ron"), include_str!("../seeds/c_models/solid.ron")];
/// Contact capacity, small so that the block is short and most mutations hit relevant fields.
const CAPACITY: usize = 16;
const CHECKSUM: usize = 8;
const HEAD: usize = 24;

struct Scene {
    world: World,
    interfaces: Vec<InterfaceId>,
    /// A valid block with contacts.
    block: Vec<u8>,
}

static SCENE: OnceLock<Mutex<Scene>> = OnceLock::new();

/// The first byte selects whether the rest is a block itself, or changes to a valid one with a corrected
/// checksum.
pub fn run(data: &[u8]) {
    count::input();
    let mut scene = SCENE.get_or_init(|| Mutex::new(scene())).lock().expect("one thread");
    let mut input = Input::new(data);
    let as_it_stands = input.chance(32);
    let block = if as_it_stands { input.rest().to_vec() } else { changed(&scene.block, &mut input) };
    let before = saved(&scene.world);
    match scene.world.restore_state(&block) {
        Ok(()) => {
            count::accepted();
            frames(&mut scene);
        }
        Err(_) => assert!(saved(&scene.world) == before, "a block that was refused changed something"),
    }
    let good = std::mem::take(&mut scene.block);
    scene.world.restore_state(&good).expect("a good block");
    scene.block = good;
}

/// Writes numbers into a valid block: three bytes of position and kind, then the value.
fn changed(good: &[u8], input: &mut Input<'_>) -> Vec<u8> {
    let mut block = good.to_vec();
    let body = block.len() - CHECKSUM;
    let used = block[..body].iter().rposition(|byte| *byte != 0).unwrap_or(0);
    while !input.is_empty() {
        // Mostly behind the header, which identifies the world of the block.
        let place = usize::from(u16::from_le_bytes(input.bytes()));
        let at = if input.chance(16) { place % body } else { HEAD + place % (used - HEAD) };
        if input.chance(128) {
            let at = at / 8 * 8;
            let number = input.number().to_le_bytes();
            let end = (at + 8).min(body);
            block[at..end].copy_from_slice(&number[..end - at]);
        } else {
            block[at] = input.byte();
        }
    }
    let checksum = pong_model::Fnv::of(&block[..body]);
    block[body..].copy_from_slice(&checksum.to_le_bytes());
    block
}

fn frames(scene: &mut Scene) {
    let Scene { world, interfaces, .. } = scene;
    for k in 0..2 {
        set_states(world, interfaces, f64::from(k) * 1e-3);
        // A pose or a spring deflection of 1e300 m is finite, and its overflow is reported.
        if world.step().is_err() {
            return;
        }
        count::frame();
        for interface in interfaces.iter() {
            let wrench = world.wrench(*interface).expect("a frame was computed");
            let finite = wrench.force.iter().chain(wrench.moment.iter()).all(|x| x.is_finite());
            assert!(finite, "a restored state gives the wrench {wrench:?}");
        }
    }
    let ledger = world.ledger();
    let finite = [ledger.stored, ledger.work, ledger.dissipated].iter().all(|x| x.is_finite());
    assert!(finite, "a restored state gives the energies {ledger:?}");
}

fn scene() -> Scene {
    let config = Config { contact_capacity: Some(CAPACITY), ledger: true, ..Config::default() };
    let mut builder = WorldBuilder::new(config);
    let objects: Vec<_> = MODELS
        .iter()
        .enumerate()
        .map(|(index, text)| {
            let model =
                pong_model::parse(text, "model", None, builder.scene().extensions()).expect("a good model");
            let model = builder.add_model(Arc::new(model));
            builder.create_object(model, &format!("object {index}")).expect("set-up")
        })
        .collect();
    builder.pair(objects[0], objects[1]).expect("set-up");
    builder.pair(objects[1], objects[1]).expect("set-up");
    let (mut world, _) = builder.seal().expect("a good scene");
    let interfaces: Vec<_> =
        objects.iter().flat_map(|object| world.scene().interfaces(*object).expect("sealed")).collect();
    for k in 0..3 {
        set_states(&mut world, &interfaces, f64::from(k) * 1e-3);
        world.step().expect("good states");
    }
    assert!(world.contact_count() > 1, "the block is to have contacts");
    let block = saved(&world);
    Scene { world, interfaces, block }
}

fn set_states(world: &mut World, interfaces: &[InterfaceId], shift: f64) {
    for (index, interface) in interfaces.iter().enumerate() {
        let mut state = State::identity();
        state.position = [0.1 * index as f64 + shift, 0.05, -0.01 * index as f64];
        state.linear_velocity = [0.1, 0.0, -0.1 * index as f64];
        world.set_state(*interface, &state).expect("a good state");
    }
}

fn saved(world: &World) -> Vec<u8> {
    let mut block = Vec::new();
    world.save_state_packed(&mut block);
    block
}
