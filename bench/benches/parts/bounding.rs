//! Every pair of bounding volumes, ns per pair, and the search for a leaf's elements that a box may touch, ns
//! per box.

use crate::clock::{ThreadTime, per_item};
use criterion::{BenchmarkId, Criterion};
use pong_bench::random::Random;
use pong_bench::scenes;
use pong_bench::terrain::{Source, Terrain};
use pong_bench::volumes::VolumePair;
use pong_geometry::Vec3;
use pong_geometry::bounding::VolumeTests;
use pong_geometry::simd::{self, Kernel, Simd};
use pong_model::box_tree::{BoxTree, NarrowBox};
use std::error::Error;
use std::hint::black_box;

const POSES: usize = 1024;
/// Half the size of a query box: a wheel's, m.
const HALF: f64 = 0.25;

/// Runs all of them.
pub fn all(criterion: &mut Criterion<ThreadTime>) -> Result<(), Box<dyn Error>> {
    volumes(criterion);
    box_tree(criterion)
}

fn volumes(criterion: &mut Criterion<ThreadTime>) {
    let mut group = criterion.benchmark_group("volumes");
    let tests = VolumeTests::default();
    for pair in VolumePair::all(POSES) {
        let how = if pair.overlap { "overlapping" } else { "apart" };
        assert_eq!(pair.met(&tests), if pair.overlap { POSES } else { 0 }, "{}", pair.name());
        group.bench_function(BenchmarkId::new(pair.name(), how), |bencher| {
            bencher.iter_custom(|passes| {
                per_item(passes, POSES, || _ = black_box(black_box(&pair).met(&tests)))
            });
        });
    }
    group.finish();
}

fn box_tree(criterion: &mut Criterion<ThreadTime>) -> Result<(), Box<dyn Error>> {
    let mut group = criterion.benchmark_group("box_tree");
    for terrain in Terrain::SIZES {
        let id = BenchmarkId::from_parameter(format!("{}_triangles", terrain.count()));
        // Loaded only if requested.
        let mut ground = None;
        group.bench_function(id, |bencher| {
            let (model, boxes) = ground.get_or_insert_with(|| {
                let model = scenes::parse(&terrain.files(Source::Inline).0).expect("a valid model");
                let boxes = boxes(&terrain, &model.bodies[0].tree.batches[0].boxes);
                (model, boxes)
            });
            let tree = &model.bodies[0].tree.batches[0].boxes;
            assert!(descend(tree, boxes) > 0, "no triangle is found");
            bencher.iter_custom(|passes| {
                per_item(passes, POSES, || _ = black_box(descend(tree, black_box(boxes))))
            });
        });
    }
    group.finish();
    Ok(())
}

/// Query boxes of a wheel's size, centred at vertices of the ground.
fn boxes(terrain: &Terrain, tree: &BoxTree) -> Vec<NarrowBox> {
    let vertices = terrain.vertices();
    let mut random = Random(0x626f_7865);
    let half = Vec3::repeat(HALF);
    let mut some = || {
        let middle = vertices[random.between(0.0, vertices.len() as f64) as usize];
        tree.narrowed(&(middle - half), &(middle + half))
    };
    (0..POSES).map(|_| some()).collect()
}

fn descend(tree: &BoxTree, boxes: &[NarrowBox]) -> u32 {
    simd::run(Descent { tree, boxes })
}

/// Numbers of elements whose boxes overlap the query boxes.
struct Descent<'a> {
    tree: &'a BoxTree,
    boxes: &'a [NarrowBox],
}

impl Kernel for Descent<'_> {
    type Output = u32;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> u32 {
        let mut found = 0;
        for query in self.boxes {
            self.tree.visit(simd, query, |_, met| found += met.count_ones());
        }
        found
    }
}
