//! Nanoseconds per pair test; printed, not judged:
//! `cargo test --release --test bounding_timing -- --ignored --nocapture`.

mod bounding_support;

use bounding_support::{Fitted, KINDS, Random, fitted_bodies, meeting, tricky_direction, tricky_rotation};
use pong_geometry::Transform;
use pong_geometry::bounding::{Volume, VolumeTests};
use std::hint::black_box;
use std::time::Instant;

const BODIES: usize = 64;

/// Least time of a test over all ordered pairs, ns, and the share that overlaps.
fn measured(volumes: &[(&Volume, &Volume)], poses: &[Transform]) -> (f64, f64) {
    let tests = black_box(VolumeTests::default());
    let (mut least, mut hits) = (f64::INFINITY, 0);
    for _ in 0..40 {
        let start = Instant::now();
        let overlap = |((a, b), x_ba): (&(&Volume, &Volume), &Transform)| tests.overlap(a, b, x_ba);
        hits = volumes.iter().zip(poses).map(overlap).filter(|&hit| hit).count();
        least = least.min(start.elapsed().as_secs_f64());
    }
    (1e9 * least / volumes.len() as f64, hits as f64 / volumes.len() as f64)
}

#[test]
#[ignore = "a measurement"]
fn nanoseconds_per_pair() {
    let mut random = Random(31);
    let bodies = fitted_bodies(&mut random, BODIES);
    let pairs: Vec<(&Fitted, &Fitted)> =
        bodies.iter().flat_map(|a| bodies.iter().map(move |b| (a, b))).collect();
    let touching: Vec<_> = pairs
        .iter()
        .map(|(a, b)| {
            meeting(tricky_rotation(&mut random), &a.body.inside(&mut random), &b.body.inside(&mut random))
        })
        .collect();
    let far: Vec<_> = touching
        .iter()
        .map(|x| Transform { translation: x.translation + tricky_direction(&mut random) * 1e5, ..*x })
        .collect();
    for (i, kind_a) in KINDS.iter().enumerate() {
        for (j, kind_b) in KINDS.iter().enumerate() {
            let volumes: Vec<_> = pairs.iter().map(|(a, b)| (&a.volumes[i], &b.volumes[j])).collect();
            let (near_ns, near) = measured(&volumes, &touching);
            let (far_ns, hit) = measured(&volumes, &far);
            let names = format!("{}–{}", kind_a.name(), kind_b.name());
            println!("{names:<14} overlapping {near_ns:5.1} ns ({near:.2}), far {far_ns:5.1} ns ({hit:.2})");
        }
    }
}
