//! Random solids of every family in [`common::families`], rotated, moved, scaled and rounded to single
//! precision: each loads within the tolerance of the model format; a non-convex solid is refused with a
//! vertex and its distance.

use crate::common::families::{FAMILIES, Family};
use crate::common::held::{TOLERANCE, brief, holds, is_held, load, thickness, written};
use crate::common::solids::{Solid, cut_box};
use pong_geometry::Vec3;
use pong_testkit::{Random, samples};

/// Thickness, in diameters, below which a solid may be refused as flat: the loader estimates the thickness
/// from the volume.
const THIN: f64 = 5.0 * TOLERANCE;
/// Distance by which solids are moved, in diameters: rounding then moves a vertex by a quarter of the
/// tolerance.
const FAR: f64 = 3.0;

fn reach(solid: &Solid) -> f64 {
    solid.vertices.iter().map(|v| (v - solid.vertices[0]).norm()).fold(0.0, f64::max)
}

/// Solid as an exporter writes it: anywhere, of any size, in single precision.
fn exported(solid: &Solid, random: &mut Random) -> Solid {
    let size = random.log_between(1e-4, 1e4);
    let to = random.direction() * (reach(solid) * size * random.between(0.0, FAR));
    solid.posed(random.rotation_matrix(), to, size)
}

/// Shortest distance between two vertices of a face, in diameters.
fn shortest_edge(solid: &Solid) -> f64 {
    let length = |face: &Vec<u32>, k: usize| {
        let [a, b] = [k, (k + 1) % face.len()].map(|k| solid.vertices[face[k] as usize]);
        (b - a).norm()
    };
    let edges = solid.faces.iter().flat_map(|face| (0..face.len()).map(move |k| length(face, k)));
    edges.fold(f64::INFINITY, f64::min) / reach(solid)
}

/// Results for the solids of one family.
#[derive(Default)]
struct Survey {
    made: usize,
    refused_thin: usize,
    /// Messages for solids with edges shorter than the tolerance.
    refused_crowded: Vec<String>,
    /// Number of solids loaded with fewer vertices than were written.
    joined: usize,
}

impl Survey {
    fn of(family: &Family, count: usize, numbers: impl Fn(usize) -> Random) -> Self {
        let mut survey = Self::default();
        for index in 0..count {
            let mut random = numbers(index);
            let Some(solid) = (family.make)(&mut random) else { continue };
            let solid = exported(&solid, &mut random);
            survey.made += 1;
            let what = format!("{}, number {index}", family.name);
            let told = match load(&solid) {
                Ok(loaded) => {
                    let held = is_held(&solid, &loaded);
                    held.unwrap_or_else(|told| panic!("{what}: {told}\n{}", brief(&solid)));
                    survey.joined += usize::from(loaded.vertices.len() < solid.vertices.len());
                    continue;
                }
                Err(told) => told,
            };
            let is_thin = told.contains("[zero-volume]") && thickness(&solid) < THIN * reach(&solid);
            let is_crowded = shortest_edge(&solid) < TOLERANCE;
            assert!(is_thin || is_crowded, "{what}: {told}\n{}", brief(&solid));
            survey.refused_thin += usize::from(is_thin);
            if !is_thin {
                survey.refused_crowded.push(format!("{what}: {told}"));
            }
        }
        survey
    }
}

/// Makes `count` solids of each family of few faces, and fewer of the others.
fn survey(seed: u64, count: usize, mut told: impl FnMut(&str, Survey)) {
    for (stream, family) in FAMILIES.iter().enumerate() {
        let many = (count as f64 * family.share).ceil() as usize;
        told(family.name, Survey::of(family, many, |index| Random::new(seed, stream as u64, index as u64)));
    }
}

#[test]
fn solids_of_every_family_load_and_are_held() {
    for seed in [1, 2, 3] {
        survey(seed, samples(500), |name, survey| {
            let crowded = survey.refused_crowded;
            assert!(crowded.len() * 500 <= survey.made.max(500), "{name}: {}", crowded.join("\n"));
            assert!(
                survey.refused_thin * 100 <= survey.made.max(100),
                "{name}: {} are thin",
                survey.refused_thin
            );
        });
    }
}

/// `cargo test -p pong-model --test it convex_families:: -- --ignored --nocapture`
#[test]
#[ignore = "50,000 solids of each family of few faces take a quarter of an hour"]
fn very_many_solids_load_and_are_held() {
    survey(2026, 50_000, |name, survey| {
        let Survey { made, refused_thin, refused_crowded, joined } = survey;
        let crowded = refused_crowded.len();
        println!(
            "{name}: {made}, {joined} with fewer vertices; refused: {refused_thin} thin, {crowded} crowded"
        );
        refused_crowded.iter().take(3).for_each(|told| println!("  {told}"));
    });
}

/// Equal files give equal bits, and a loaded solid that is written again loads.
#[test]
fn what_is_loaded_loads_again() {
    for (stream, family) in FAMILIES.iter().enumerate() {
        for index in 0..samples((100.0 * family.share).ceil() as usize) as u64 {
            let mut random = Random::new(4, stream as u64, index);
            let Some(solid) = (family.make)(&mut random) else { continue };
            let solid = exported(&solid, &mut random);
            let Ok(loaded) = load(&solid) else { continue };
            let what = format!("{}, number {index}", family.name);
            assert!(load(&solid).as_ref() == Ok(&loaded), "{what}");
            holds(&written(&loaded), &what);
        }
    }
}

/// A dent of a few tolerances is more than rounding.
#[test]
fn what_is_not_convex_is_refused_with_a_vertex_and_how_far_it_is_off() {
    for index in 0..samples(300) as u64 {
        let mut random = Random::new(5, 0, index);
        let size = Vec3::new(1.0, random.between(0.1, 1.0), random.between(0.1, 1.0));
        let cuts = 2 + 2 * random.below(4) as u32;
        let mut solid = cut_box(size, cuts);
        let middle = Vec3::new(0.5 * size.x, 0.5 * size.y, size.z);
        let center = solid.vertices.iter().position(|v| (v - middle).norm() < 1e-9).unwrap();
        let depth = random.log_between(10.0 * TOLERANCE, 0.05) * reach(&solid);
        solid.vertices[center].z -= depth;
        let solid = exported(&solid.triangulated(), &mut random);
        let told =
            load(&solid).err().unwrap_or_else(|| panic!("a dent of {depth:e} is taken, number {index}"));
        let dent = solid.vertices[center];
        assert!(told.contains("[not-convex]") && told.contains("the vertex ("), "{told}");
        let off = told.split(") is ").nth(1).and_then(|rest| rest.split(' ').next()).unwrap();
        assert!((TOLERANCE..2.0).contains(&off.parse::<f64>().unwrap()), "{off} {dent:?}");
    }
}
