//! W8: cold frames: between two frames, other work of a simulation fills the caches.

use pong_bench::one_by_one::{Others, middles_of_halves, quantile, seconds};
use pong_bench::options::Options;
use pong_bench::peer::Peer;
use pong_bench::rig;
use pong_bench::ring::{self, Ring, Tip};
use pong_bench::scenes::Scene;
use pong_bench::table::{Table, ratio_at_most};
use pong_bench::terrain::{Terrain, Wheel};
use pong_bench::timing::digits;
use pong_engine::{State, WorldBuilder};
use std::error::Error;
use std::hint::black_box;

const MICRO: f64 = 1e-6;
/// Target time of a cold frame, relative to a warm one.
const COLD_OVER_WARM: f64 = 3.0;

type Contender = (String, Box<dyn Peer>, Vec<Vec<State>>, Option<f64>);

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::read(8)?;
    let mut others = Others::default();
    let mut table = Table::new(&["scene", "warm, µs", "cold, µs", "cold over warm", "wanted"]);
    for (name, mut engine, states, wanted) in contenders(&options)? {
        let mut pass = |others: Option<&mut Others>| -> f64 {
            let mut times: Vec<f64> = Vec::with_capacity(states.len());
            let mut others = others;
            for states in &states {
                if let Some(others) = &mut others {
                    others.work();
                }
                times.push(seconds(|| _ = black_box(engine.frame(states))));
            }
            quantile(&mut times, 0.5)
        };
        let (mut warm, mut cold) = (Vec::new(), Vec::new());
        for _ in 0..options.rounds.max(2) {
            pass(None);
            warm.push(pass(None));
            cold.push(pass(Some(&mut others)));
        }
        let mut ratios: Vec<f64> = cold.iter().zip(&warm).map(|(cold, warm)| cold / warm).collect();
        let halves = middles_of_halves(&mut ratios);
        let verdict = wanted.map(|wanted| ratio_at_most(wanted, Some(halves)));
        let [warm, cold] = [&mut warm, &mut cold].map(|times| digits(quantile(times, 0.5) / MICRO));
        let ratio = digits(quantile(&mut ratios, 0.5));
        table.row([name, warm, cold, ratio, verdict.unwrap_or("–".to_owned())]);
    }
    println!(
        "A frame with its data in the caches, and after 96 MiB were touched; middle of the middles of {} passes\n",
        options.rounds
    );
    println!("{table}");
    Ok(())
}

fn contenders(options: &Options) -> Result<Vec<Contender>, Box<dyn Error>> {
    let (ring, terrain, [wheel, _]) = (Ring::new(ring::SIZES[0]), Terrain::SIZES[1], Wheel::BOTH);
    let scenes = [
        ("docking", Scene::docking()?),
        ("ring, 12 wedges, 200 spheres", Scene::ring(&ring, Tip::Sphere)?),
        ("six spheres on 10,000 triangles", Scene::wheels(&terrain, wheel)?),
    ];
    let mut all: Vec<Contender> = Vec::new();
    for (name, scene) in scenes {
        let mut states = scene.states.clone();
        states.truncate(if options.smoke { 2 } else { states.len() });
        let rig = scene.rig(WorldBuilder::new(rig::config(1)))?;
        all.push((format!("Pong, {name}"), Box::new(rig), states, Some(COLD_OVER_WARM)));
    }
    #[cfg(feature = "ode")]
    if !options.alone {
        use pong_bench::peer::ode::{OdeRing, OdeTerrain, Space};
        let (of_ring, of_wheels) = (all[1].2.clone(), all[2].2.clone());
        let ode = OdeRing::new(&ring, Tip::Sphere, Space::Quadtree);
        all.push(("ODE, the same ring, detection".to_owned(), Box::new(ode), of_ring, None));
        if let Some(ode) = OdeTerrain::new(&terrain, wheel) {
            all.push(("ODE, the same wheels, detection".to_owned(), Box::new(ode), of_wheels, None));
        }
    }
    Ok(all)
}
