//! W5: memory of a terrain of a million triangles, bytes per contact, allocations per frame.

use parry3d_f64::query::{ContactManifold, TrackedContact};
use pong_bench::folder::Folder;
use pong_bench::heap;
use pong_bench::options::Options;
use pong_bench::peer::Peer;
use pong_bench::peer::parry::{Manifolds, trimesh};
use pong_bench::rig::{self, Rig};
use pong_bench::ring::{self, Ring, Tip};
use pong_bench::scenes;
use pong_bench::table::{Table, at_most, or_dash};
use pong_bench::terrain::{self, Source, Terrain, WHEELS, Wheel};
use pong_engine::{Config, WorldBuilder};
use pong_model::{Extensions, MovableGroup};
use std::error::Error;
use std::time::Instant;

#[global_allocator]
static HEAP: heap::Counting = heap::Counting;

/// Target bytes per triangle, with its search tree, and per kept contact.
const PER_TRIANGLE: f64 = 64.0;
const PER_CONTACT: f64 = 160.0;
const MEBIBYTE: f64 = 1024.0 * 1024.0;

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(1)?;
    let large = Terrain::SIZES[if options.smoke { 1 } else { 3 }];
    println!("{}", triangles(large)?);
    println!("{}", contacts(if options.smoke { 0 } else { 2 })?);
    println!("{}", calls(if options.smoke { 0 } else { 1 })?);
    Ok(())
}

// ---- triangles

fn triangles(large: Terrain) -> Result<Table, Box<dyn Error>> {
    let mut table = Table::new(&[
        "terrain",
        "file, MiB",
        "loaded in, s",
        "peak, MiB",
        "B per triangle with its tree",
        "without the tree",
        "wanted with the tree",
    ]);
    let folder = Folder::new("w5_memory")?;
    for (terrain, source) in [
        (large, Source::Stl),
        (large, Source::Obj),
        (large, Source::Inline),
        (Terrain::SIZES[0], Source::Inline),
    ] {
        table.row(load(&folder, terrain, source)?);
    }
    for (engine, held, bare) in peers(&large) {
        let per_triangle = |bytes: usize| format!("{:.1}", bytes as f64 / large.count() as f64);
        let name = format!("{engine}, {}", large.count());
        let dash = || "–".to_owned();
        table.row([
            name,
            dash(),
            dash(),
            dash(),
            per_triangle(held),
            bare.map_or_else(dash, per_triangle),
            dash(),
        ]);
    }
    Ok(table)
}

fn load(folder: &Folder, terrain: Terrain, source: Source) -> Result<[String; 7], Box<dyn Error>> {
    let (path, bytes) = folder.write(terrain, source)?;
    let before = heap::held();
    heap::reset_peak();
    let start = Instant::now();
    let model = pong_model::load(&path, &Extensions::new())?;
    let seconds = start.elapsed().as_secs_f64();
    let (held, peak) = (heap::held() - before, heap::peak() - before);
    let bare = without_tree(&model.bodies[0]);
    let per_triangle = |bytes: usize| format!("{:.1}", bytes as f64 / terrain.count() as f64);
    Ok([
        format!("Pong, {} from {source:?}", terrain.count()),
        format!("{:.1}", bytes as f64 / MEBIBYTE),
        format!("{seconds:.2}"),
        format!("{:.1}", peak as f64 / MEBIBYTE),
        per_triangle(held),
        per_triangle(bare),
        at_most(PER_TRIANGLE, held as f64 / terrain.count() as f64),
    ])
}

/// Bytes of vertices and triangle data without the search tree.
fn without_tree(body: &MovableGroup) -> usize {
    size_of_val(&*body.triangles.vertices) + size_of_val(&*body.triangles.triangles)
}

/// Bytes that other engines hold for the terrain, and those of vertices and triangles alone. Engines in C are
/// measured by the C library's counters.
fn peers(terrain: &Terrain) -> Vec<(&'static str, usize, Option<usize>)> {
    let mut out = Vec::new();
    let before = heap::held();
    let mesh = trimesh(terrain);
    let bare = size_of_val(mesh.vertices()) + size_of_val(mesh.indices());
    out.push(("parry", heap::held() - before, Some(bare)));
    drop(mesh);
    #[cfg(any(feature = "mujoco", feature = "ode"))]
    let [sphere, _] = Wheel::BOTH;
    #[cfg(feature = "ode")]
    {
        let before = heap::held_in_c();
        let ode = pong_bench::peer::ode::OdeTerrain::new(terrain, sphere);
        let bare = terrain.vertices().len() * 24 + terrain.count() * 12;
        out.push(("ODE", heap::held_in_c() - before, Some(bare)));
        drop(ode);
    }
    #[cfg(feature = "mujoco")]
    {
        // The arena of every scene does not count.
        let small = Terrain { cells: [2, 2] };
        let held = |terrain: &Terrain| {
            let before = heap::held_in_c();
            let mujoco = pong_bench::peer::mujoco::Mujoco::terrain(terrain, sphere, WHEELS);
            let held = heap::held_in_c() - before;
            drop(mujoco);
            held
        };
        out.push(("MuJoCo, height field", held(terrain).saturating_sub(held(&small)), None));
    }
    out
}

// ---- contacts

/// Memory of sealed worlds that differ only in their contact capacity.
fn contacts(size: usize) -> Result<Table, Box<dyn Error>> {
    const ROOM: usize = 1024;
    let ring = Ring::new(ring::SIZES[size]);
    let models = scenes::ring_models(&ring, Tip::Sphere)?;
    let states = ring::states();
    let with_room = |contacts: usize| -> Result<[usize; 3], Box<dyn Error>> {
        let before = heap::held();
        let builder = WorldBuilder::new(Config { contact_capacity: Some(contacts), ..rig::config(1) });
        let mut rig = Rig::in_world(builder, &models, &[(0, 1)])?;
        states.iter().for_each(|states| _ = rig.frame(states));
        let records = rig.world.memory().contacts_capacity;
        Ok([heap::held() - before, rig.world.state_size(), records])
    };
    let (less, more) = (with_room(ROOM)?, with_room(2 * ROOM)?);
    let mut table = Table::new(&["memory of contacts", "B per contact", "wanted"]);
    let mut row = |what: &str, bytes: f64, wanted: Option<f64>| {
        let wanted = wanted.map(|wanted| at_most(wanted, bytes));
        table.row([what.to_owned(), format!("{bytes:.1}"), or_dash(wanted)]);
    };
    let [all, saved, records] = [0, 1, 2].map(|i| (more[i] - less[i]) as f64);
    row("Pong, what is kept of one contact from frame to frame", saved / records, Some(PER_CONTACT));
    row("Pong, everything that grows with the room for contacts", all / ROOM as f64, None);

    let before = heap::held();
    let mut manifolds = Manifolds::ring(&ring);
    let empty = heap::held() - before;
    let most = states.iter().map(|states| manifolds.frame(states)).max().unwrap_or(0);
    row(
        "parry, what manifolds of the ring hold after 64 frames",
        (heap::held() - before - empty) as f64 / most as f64,
        None,
    );
    row("parry, one point of a manifold", size_of::<TrackedContact<()>>() as f64, None);
    row("parry, one manifold", size_of::<ContactManifold<(), ()>>() as f64, None);
    Ok(table)
}

// ---- calls

fn calls(size: usize) -> Result<Table, Box<dyn Error>> {
    let mut table = Table::new(&["calls for memory per frame", "Pong", "wanted", "parry"]);
    let ring = Ring::new(ring::SIZES[size]);
    let mut row = |name: &str, pong: f64, parry: f64| {
        let verdict = if pong == 0.0 { "0, reached" } else { "0, missed" };
        table.row([name.to_owned(), format!("{pong:.2}"), verdict.to_owned(), format!("{parry:.2}")]);
    };
    let states = scenes::ring_states();
    let mut rig = scenes::ring(&ring, Tip::Sphere, 1)?;
    row("ring, spheres", per_frame(&mut rig, &states), per_frame(&mut Manifolds::ring(&ring), &states));

    let (terrain, [sphere, _]) = (Terrain::SIZES[1], Wheel::BOTH);
    let states = terrain::states(64, sphere);
    let mut rig = scenes::wheels(&terrain, sphere)?;
    let mut parry = Manifolds::terrain(&terrain, sphere, WHEELS).ok_or("parry knows spheres")?;
    row("six wheels on 10,000 triangles", per_frame(&mut rig, &states), per_frame(&mut parry, &states));
    Ok(table)
}

/// Allocations in a second pass over the same frames.
fn per_frame(peer: &mut dyn Peer, states: &[Vec<pong_engine::State>]) -> f64 {
    let mut pass = || states.iter().for_each(|states| _ = std::hint::black_box(peer.frame(states)));
    pass();
    let before = heap::calls();
    pass();
    (heap::calls() - before) as f64 / states.len() as f64
}
