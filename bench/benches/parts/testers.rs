//! Every interference tester of the capability table, and the eight-element tests that the engine runs before
//! them; ns per query.

use crate::clock::{ThreadTime, per_item};
use criterion::{BenchmarkGroup, BenchmarkId, Criterion};
use pong_bench::ours::Ours;
use pong_bench::pairs::{self, Answer, Mover, Queries, RADIUS, Target};
use pong_bench::peer::PairPeer;
use pong_geometry::Lanes;
use pong_geometry::primitive::{Polyhedron, PrimitiveKind};
use pong_geometry::simd::{self, Kernel, LANES, LaneBits, Simd};
use std::hint::black_box;

const POSES: usize = 4096;

/// Runs all of them.
pub fn all(criterion: &mut Criterion<ThreadTime>) {
    let mut group = criterion.benchmark_group("testers");
    for (mover, target) in pairs::all() {
        let mut ours = Ours::new(mover, &target);
        let id = id([mover.kind(), target.kind()].map(PrimitiveKind::name).join("-"), &target);
        // Searched once, and only if requested.
        let mut queries = None;
        let mut answers = vec![Answer::default(); POSES];
        group.bench_function(id, |bencher| {
            let queries = queries.get_or_insert_with(|| checked(mover, &target, &mut ours));
            bencher.iter_custom(|passes| {
                per_item(passes, POSES, || ours.pass(queries, black_box(&mut answers)))
            });
        });
    }
    group.finish();
    let mut group = criterion.benchmark_group("eight");
    for target in Target::of(PrimitiveKind::Polyhedron) {
        eight(&mut group, &target);
    }
    group.finish();
}

fn id(name: String, target: &Target) -> BenchmarkId {
    match target.faces() {
        Some(faces) => BenchmarkId::new(name, faces),
        None => BenchmarkId::from_parameter(name),
    }
}

/// The poses, after a check: a tester that confuses hits and misses is not worth timing.
fn checked(mover: Mover, target: &Target, ours: &mut Ours) -> Queries {
    let queries = Queries::new(POSES, mover, target, |x| ours.touches(x));
    let mut answers = vec![Answer::default(); POSES];
    ours.pass(&queries, &mut answers);
    let differing = answers.iter().zip(&queries.hits).filter(|(answer, hit)| answer.hit() != **hit).count();
    // Of two cones the search for the plate misses one in thousands; cones whose axis has passed an edge of a triangle are
    // not pushed by it (docs/theory.md, 2.8, limits).
    let most = if mover == Mover::Cone { POSES / 100 } else { 0 };
    assert!(differing <= most, "{mover:?}: {differing} hits and misses are not as made");
    queries
}

/// Eight points, or the centres of eight spheres, against one polyhedron; ns per eight.
fn eight(group: &mut BenchmarkGroup<'_, ThreadTime>, target: &Target) {
    let tests = [
        ("Point-Polyhedron", Mover::Point, EightTest::Contain),
        ("Sphere-Polyhedron", Mover::Sphere, EightTest::Outside),
    ];
    for (name, mover, test) in tests {
        let mut ours = Ours::new(mover, target);
        let mut centers = None;
        group.bench_function(id(name.to_owned(), target), |bencher| {
            let centers = centers.get_or_insert_with(|| by_eight(&checked(mover, target, &mut ours)));
            let polyhedron = &ours.body().polyhedra[0];
            bencher.iter_custom(|passes| {
                per_item(passes, centers.len(), || {
                    black_box(simd::run(Eights { test, polyhedron, centers }));
                })
            });
        });
    }
}

fn by_eight(queries: &Queries) -> Vec<Lanes> {
    let lanes = |transforms: &[pong_geometry::Transform]| {
        let along = |axis: usize| std::array::from_fn(|lane| transforms[lane].translation[axis]);
        Lanes { x: along(0), y: along(1), z: along(2) }
    };
    queries.transforms.chunks_exact(LANES).map(lanes).collect()
}

#[derive(Clone, Copy)]
enum EightTest {
    Contain,
    Outside,
}

struct Eights<'a> {
    test: EightTest,
    polyhedron: &'a Polyhedron,
    centers: &'a [Lanes],
}

impl Kernel for Eights<'_> {
    type Output = LaneBits;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> LaneBits {
        let Self { test, polyhedron, centers } = self;
        let of_eight = |centers: &Lanes| match test {
            EightTest::Contain => polyhedron.lanes_contain_in(simd, centers),
            EightTest::Outside => polyhedron.lanes_outside_in(simd, centers, &[RADIUS; LANES]),
        };
        centers.iter().fold(0, |all, centers| all ^ of_eight(centers))
    }
}
