//! A terrain of a million triangles: how long it takes to load, what it occupies, and what wheels on it cost
//! beside those on a thousand triangles.

use pong_bench::heap;
use pong_bench::options::Options;
use pong_bench::peer::Manifolds;
use pong_bench::rig::Rig;
use pong_bench::ron;
use pong_bench::terrain::{self, Source, Terrain};
use pong_bench::timing::Times;
use pong_engine::State;
use pong_geometry::extension::Extensions;
use pong_model::Model;
use std::error::Error;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

#[global_allocator]
static HEAP: heap::Counting = heap::Counting;

const SMALL: Terrain = Terrain { cells: [25, 20] };
const MEDIUM: Terrain = Terrain { cells: [100, 50] };
const LARGE: Terrain = Terrain { cells: [1000, 500] };
const MEBIBYTE: f64 = 1024.0 * 1024.0;

/// What rolls: its primitive, how far it reaches below its centre, and its radius if the peer knows it.
const WHEELS: [(&str, &str, f64, Option<f64>); 2] = [
    ("sphere", "Sphere(name: \"wheel\", center: (0, 0, 0), radius: 0.25)", 0.25, Some(0.25)),
    ("ellipsoid", "Ellipsoid(name: \"wheel\", center: (0, 0, 0), semi_axes: (0.25, 0.12, 0.25))", 0.25, None),
];

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(std::env::args().skip(1), 40)?;
    let large = if options.smoke { MEDIUM } else { LARGE };
    let folder = Folder::new()?;
    println!("loading: wall-clock time; held: bytes that the model keeps; peak: most bytes while loading");
    let mut model = None;
    for source in [Source::Stl, Source::Obj, Source::Inline] {
        model = Some(load(&folder.0, large, source)?);
    }
    let large = Ground { terrain: large, model: model.ok_or("nothing was loaded")? };
    let small = Ground { terrain: SMALL, model: load(&folder.0, SMALL, Source::Inline)? };
    println!("\nµs per frame, min / median of {} passes; ratios: median [min..max]", options.rounds);
    for wheel in WHEELS {
        roll(&small, &large, wheel, &options)?;
    }
    Ok(())
}

/// A terrain and the model made of it.
struct Ground {
    terrain: Terrain,
    model: Arc<Model>,
}

/// A folder of one's own that goes when it is dropped.
struct Folder(PathBuf);

impl Folder {
    fn new() -> std::io::Result<Self> {
        let path = std::env::temp_dir().join(format!("pong_load_mesh_{}", std::process::id()));
        std::fs::create_dir(&path)?;
        Ok(Self(path))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // Nothing to be done about a folder that will not go.
        _ = std::fs::remove_dir_all(&self.0);
    }
}

fn load(folder: &Path, terrain: Terrain, source: Source) -> Result<Arc<Model>, Box<dyn Error>> {
    let (text, mesh) = terrain.files(source);
    let path = folder.join("terrain.ron");
    let mut bytes = text.len();
    std::fs::write(&path, text)?;
    if let Some((name, content)) = mesh {
        bytes += content.len();
        std::fs::write(folder.join(name), content)?;
    }
    let before = heap::held();
    heap::reset_peak();
    let start = Instant::now();
    let model = pong_model::load(&path, &Extensions::new())?;
    let seconds = start.elapsed().as_secs_f64();
    let triangles = model.bodies[0].triangles.triangles.len();
    let held = (heap::held() - before) as f64;
    println!(
        "  {triangles:>7} triangles, {:<6}: file {:>6.1} MiB, loaded in {seconds:>6.2} s, held {:>6.1} MiB = {:.1} B per \
         triangle, peak {:>6.1} MiB",
        format!("{source:?}"),
        bytes as f64 / MEBIBYTE,
        held / MEBIBYTE,
        held / triangles as f64,
        (heap::peak() - before) as f64 / MEBIBYTE,
    );
    for warning in model.warnings.iter().take(3) {
        println!("    {warning}");
    }
    Ok(Arc::new(model))
}

type Wheel = (&'static str, &'static str, f64, Option<f64>);

fn roll(small: &Ground, large: &Ground, wheel: Wheel, options: &Options) -> Result<(), Box<dyn Error>> {
    let (name, primitive, reach, ball) = wheel;
    let frames = if options.smoke { 4 } else { 256 };
    let states = terrain::states(frames, reach, 0.004);
    let wheel = pong_model::parse(&ron::model("wheel", primitive), "wheel.ron", None, &Extensions::new())?;
    let wheel = Arc::new(wheel);
    let rig = |ground: &Ground| Rig::new([Arc::clone(&ground.model), Arc::clone(&wheel)]);
    let mut rigs = [rig(small)?, rig(large)?];
    let mut times = [Times::default(), Times::default()];
    let mut peers = match ball {
        Some(radius) if !options.alone => {
            Some([small, large].map(|ground| Manifolds::terrain(&ground.terrain, radius)))
        }
        _ => None,
    };
    let mut peer_times = [Times::default(), Times::default()];
    let mut contacts = [0; 2];
    for (count, rig) in contacts.iter_mut().zip(&mut rigs) {
        for states in &states {
            rig.frame(states);
            *count += rig.world.contact_count();
        }
    }
    for _ in 0..options.rounds {
        for (rig, times) in rigs.iter_mut().zip(&mut times) {
            times.run(frames, || pass(rig, &states));
        }
        for (peer, times) in peers.iter_mut().flatten().zip(&mut peer_times) {
            times.run(frames, || states.iter().for_each(|states| _ = black_box(peer.frame(states))));
        }
    }
    for (i, ground) in [small, large].into_iter().enumerate() {
        let triangles = ground.model.bodies[0].triangles.triangles.len();
        let contacts = contacts[i] as f64 / frames as f64;
        println!(
            "  {name} on {triangles:>7} triangles: {:>7.2} / {:>7.2}, {contacts:.2} contacts",
            times[i].min(),
            times[i].median()
        );
        if contacts == 0.0 {
            return Err("the wheel does not touch".into());
        }
        if peers.is_some() {
            let (min, median) = (peer_times[i].min(), peer_times[i].median());
            println!(
                "    parry, detection alone: {min:.2} / {median:.2}, engine over it {}",
                times[i].over(&peer_times[i])
            );
        }
    }
    println!("  {name}, large over small: {}", times[1].over(&times[0]));
    Ok(())
}

fn pass(rig: &mut Rig, states: &[[State; 2]]) {
    for states in states {
        black_box(rig.frame(states));
    }
}
