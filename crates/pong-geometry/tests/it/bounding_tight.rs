//! Bounding volumes are tight: volumes separated by a millionth of their size are found disjoint.
//!
//! Degenerate cases: corner over corner, edge over edge (each of the nine pairs of directions), axes parallel
//! exactly or nearly, needles and plates, far origins.

use crate::bounding_support::{
    KINDS, Random, extreme_of, fitted_bodies, meeting, tricky_direction, tricky_rotation,
};
use pong_geometry::bounding::{Bounded, Volume, VolumeTests};
use pong_geometry::{Mat3, Transform, Vec3};

const TRIALS: usize = 150_000;

/// Extent of a volume and distance of its centre from the origin.
fn size_and_offset(volume: &Volume) -> (f64, f64) {
    match volume {
        Volume::Aabb { center, half } | Volume::Obb { center, half, .. } => (half.norm(), center.norm()),
        Volume::Sphere { center, radius } => (*radius, center.norm()),
        _ => unreachable!("a finite built-in kind"),
    }
}

/// A millionth of the sizes, or the rounding of the offsets.
fn visible_gap(a: &Volume, b: &Volume) -> f64 {
    let ((size_a, offset_a), (size_b, offset_b)) = (size_and_offset(a), size_and_offset(b));
    1e-6 * (size_a + size_b) + 1e-12 * (offset_a + offset_b)
}

fn corners(volume: &Volume) -> Vec<Vec3> {
    let mut points = Vec::new();
    volume.representatives(&mut points);
    points
}

fn axes(volume: &Volume) -> Mat3 {
    match volume {
        Volume::Obb { axes, .. } => *axes,
        _ => Mat3::identity(),
    }
}

fn extreme(volume: &Volume, direction: &Vec3) -> Vec3 {
    match volume {
        Volume::Sphere { center, radius } => center + direction * *radius,
        boxed => extreme_of(&corners(boxed), direction),
    }
}

/// Places A so that its lowest point along `n_b` is a gap above B's highest point: certainly disjoint.
fn placed_apart(a: &Volume, b: &Volume, rotation: Mat3, n_b: &Vec3) -> Transform {
    let lowest = extreme(a, &-rotation.tr_mul(n_b));
    meeting(rotation, &lowest, &(extreme(b, n_b) + n_b * visible_gap(a, b)))
}

#[test]
fn volumes_apart_along_any_direction_are_told_apart() {
    let mut random = Random(11);
    let bodies = fitted_bodies(&mut random, 600);
    let tests = VolumeTests::default();
    for (i, kind_a) in KINDS.iter().enumerate() {
        for (j, kind_b) in KINDS.iter().enumerate() {
            for trial in 0..TRIALS {
                let (a, b) = (
                    &bodies[random.below(bodies.len())].volumes[i],
                    &bodies[random.below(bodies.len())].volumes[j],
                );
                if visible_gap(a, b) == 0.0 {
                    continue; // A point on a point.
                }
                let n_b = tricky_direction(&mut random);
                let x_ba = placed_apart(a, b, tricky_rotation(&mut random), &n_b);
                assert!(!tests.overlap(a, b, &x_ba), "{kind_a:?} {kind_b:?} {trial}: {a:?} {b:?} {x_ba:?}");
            }
        }
    }
}

/// Edges that pass over each other in the middle: only their cross product separates these boxes.
#[test]
fn boxes_apart_edge_over_edge_are_told_apart() {
    let mut random = Random(12);
    let bodies = fitted_bodies(&mut random, 600);
    let tests = VolumeTests::default();
    for trial in 0..TRIALS {
        let a = &bodies[random.below(bodies.len())].volumes[2 * random.below(2)];
        let b = &bodies[random.below(bodies.len())].volumes[2 * random.below(2)];
        let rotation = tricky_rotation(&mut random);
        let (edge_a, edge_b) = (axes(a).column(random.below(3)) * 1.0, axes(b).column(random.below(3)) * 1.0);
        let n_b = edge_b.cross(&(rotation * edge_a));
        if n_b.norm() < 1e-3 || visible_gap(a, b) == 0.0 {
            continue; // Not a direction of its own, or a point on a point.
        }
        let n_b = n_b.normalize();
        let middle = |volume: &Volume, direction: &Vec3, edge: &Vec3| {
            let from_center = direction - edge * direction.dot(edge);
            let ends = [from_center + edge * 1e-9, from_center - edge * 1e-9].map(|d| extreme(volume, &d));
            (ends[0] + ends[1]) * 0.5
        };
        let low = middle(a, &-rotation.tr_mul(&n_b), &edge_a);
        let x_ba = meeting(rotation, &low, &(middle(b, &n_b, &edge_b) + n_b * visible_gap(a, b)));
        assert!(!tests.overlap(a, b, &x_ba), "trial {trial}: {a:?} {b:?} {x_ba:?}");
    }
}

/// Gilbert's method for the point of A − B nearest to the origin, independent of separating axes:
/// `Some(true)` if they certainly overlap, `Some(false)` if they are separated by more than `gap`.
fn nearest_point_verdict(a: &[Vec3], b: &[Vec3], gap: f64) -> Option<bool> {
    let difference: Vec<Vec3> = a.iter().flat_map(|p| b.iter().map(move |q| p - q)).collect();
    let mut v = difference[0];
    for _ in 0..400 {
        if v.norm() < 1e-3 * gap {
            return Some(true);
        }
        let w = extreme_of(&difference, &-v);
        if v.dot(&w) > gap * v.norm() {
            return Some(false);
        }
        let step = w - v;
        v += step * (-v.dot(&step) / step.norm_squared()).clamp(0.0, 1.0);
    }
    None
}

/// Random placements, most of them near contact, compared in both directions with an independent method.
#[test]
fn box_verdicts_agree_with_the_nearest_point() {
    let mut random = Random(13);
    let tests = VolumeTests::default();
    let (mut overlapping, mut apart) = (0, 0);
    for _ in 0..30_000 {
        let mut volume = |oriented: bool| {
            let half = Vec3::from_fn(|_, _| 0.2 + random.unit());
            let center = random.vector(1.0);
            if oriented {
                Volume::Obb { center, axes: tricky_rotation(&mut random), half }
            } else {
                Volume::Aabb { center, half }
            }
        };
        let (a, b) = (volume(true), volume(false));
        for (a, b) in [(&a, &a), (&a, &b), (&b, &a), (&b, &b)] {
            let x_ba =
                Transform { rotation: tricky_rotation(&mut random), translation: random.vector(1.0) * 3.0 };
            let carried: Vec<_> = corners(a).iter().map(|p| x_ba.point(p)).collect();
            let Some(expected) = nearest_point_verdict(&carried, &corners(b), 1e-4) else { continue };
            *(if expected { &mut overlapping } else { &mut apart }) += 1;
            assert_eq!(tests.overlap(a, b, &x_ba), expected, "{a:?} {b:?} {x_ba:?}");
        }
    }
    assert!(overlapping > 10_000 && apart > 10_000, "{overlapping} overlapping, {apart} apart");
}
