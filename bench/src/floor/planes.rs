//! A point against the planes of a convex body, eight planes at a time: height above the highest plane.

use super::Level;
use pong_geometry::{Pose, Transform, Vec3};
#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::*;

/// Eight planes: x, y and z of the normals, then the offsets.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub struct Block([[f64; 8]; 4]);

/// Blocks of a convex body; the last block is filled with copies of its last plane.
pub fn blocks(planes: &[(Vec3, f64)]) -> Vec<Block> {
    let block = |planes: &[(Vec3, f64)]| {
        let plane = |lane: usize| planes[lane.min(planes.len() - 1)];
        let normals = |axis: usize| std::array::from_fn(|lane| plane(lane).0[axis]);
        Block([normals(0), normals(1), normals(2), std::array::from_fn(|lane| plane(lane).1)])
    };
    planes.chunks(8).map(block).collect()
}

/// Floor of one point against a convex body: for every pair of poses, transforms the point to the body's
/// frame and takes its greatest height above any plane, m. Negative inside: minus the depth.
pub fn heights(level: Level, blocks: &[Block], point: &Vec3, poses: &[[Pose; 2]], out: &mut [f64]) {
    match level {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: `Level::detect` found the features.
        Level::Avx512 => unsafe { heights_avx512(blocks, point, poses, out) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: `Level::detect` found the features.
        Level::Avx2 => unsafe { heights_avx2(blocks, point, poses, out) },
        _ => {
            for (poses, out) in poses.iter().zip(out) {
                *out = greatest_portable(blocks, &seen(poses, point));
            }
        }
    }
}

/// Floor of many points of one body under one pose.
pub fn heights_of_many(level: Level, blocks: &[Block], points: &[Vec3], x: &Transform, out: &mut [f64]) {
    match level {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: `Level::detect` found the features.
        Level::Avx512 => unsafe { heights_of_many_avx512(blocks, points, x, out) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: `Level::detect` found the features.
        Level::Avx2 => unsafe { heights_of_many_avx2(blocks, points, x, out) },
        _ => {
            for (point, out) in points.iter().zip(out) {
                *out = greatest_portable(blocks, &x.point(point));
            }
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,fma")]
fn heights_avx512(blocks: &[Block], point: &Vec3, poses: &[[Pose; 2]], out: &mut [f64]) {
    for (poses, out) in poses.iter().zip(out) {
        *out = greatest_avx512(blocks, &seen(poses, point));
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn heights_avx2(blocks: &[Block], point: &Vec3, poses: &[[Pose; 2]], out: &mut [f64]) {
    for (poses, out) in poses.iter().zip(out) {
        *out = greatest_avx2(blocks, &seen(poses, point));
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,fma")]
fn heights_of_many_avx512(blocks: &[Block], points: &[Vec3], x: &Transform, out: &mut [f64]) {
    for (point, out) in points.iter().zip(out) {
        *out = greatest_avx512(blocks, &carried(x, point));
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn heights_of_many_avx2(blocks: &[Block], points: &[Vec3], x: &Transform, out: &mut [f64]) {
    for (point, out) in points.iter().zip(out) {
        *out = greatest_avx2(blocks, &carried(x, point));
    }
}

/// A point of one group in the frame of another, by two quaternion rotations, the least possible.
#[inline(always)]
fn seen([mover, target]: &[Pose; 2], point: &Vec3) -> Vec3 {
    target.orientation.inverse() * (mover.position - target.position + mover.orientation * point)
}

/// A point transformed by a pose, with fused operations.
#[inline]
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "fma")]
pub(super) fn carried(x: &Transform, p: &Vec3) -> Vec3 {
    let (r, t) = (&x.rotation, &x.translation);
    let row = |i: usize| r[(i, 0)].mul_add(p.x, r[(i, 1)].mul_add(p.y, r[(i, 2)].mul_add(p.z, t[i])));
    Vec3::new(row(0), row(1), row(2))
}

/// Greatest height of a point above any plane, m.
#[inline]
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,fma")]
pub(super) fn greatest_avx512(blocks: &[Block], p: &Vec3) -> f64 {
    let (x, y, z) = (_mm512_set1_pd(p.x), _mm512_set1_pd(p.y), _mm512_set1_pd(p.z));
    let mut greatest = _mm512_set1_pd(f64::NEG_INFINITY);
    for Block(rows) in blocks {
        // SAFETY: a row holds the eight numbers that are read.
        let [nx, ny, nz, offset] = rows.each_ref().map(|row| unsafe { _mm512_loadu_pd(row.as_ptr()) });
        let height = _mm512_fmadd_pd(nx, x, _mm512_fmadd_pd(ny, y, _mm512_fmsub_pd(nz, z, offset)));
        greatest = _mm512_max_pd(greatest, height);
    }
    _mm512_reduce_max_pd(greatest)
}

/// Greatest height of a point above any plane, m.
#[inline]
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
pub(super) fn greatest_avx2(blocks: &[Block], p: &Vec3) -> f64 {
    let (x, y, z) = (_mm256_set1_pd(p.x), _mm256_set1_pd(p.y), _mm256_set1_pd(p.z));
    let mut greatest = [_mm256_set1_pd(f64::NEG_INFINITY); 2];
    for Block(rows) in blocks {
        for (half, greatest) in greatest.iter_mut().enumerate() {
            // SAFETY: half a row holds the four numbers that are read.
            let [nx, ny, nz, offset] =
                rows.each_ref().map(|row| unsafe { _mm256_loadu_pd(row[4 * half..][..4].as_ptr()) });
            let height = _mm256_fmadd_pd(nx, x, _mm256_fmadd_pd(ny, y, _mm256_fmsub_pd(nz, z, offset)));
            *greatest = _mm256_max_pd(*greatest, height);
        }
    }
    let four = _mm256_max_pd(greatest[0], greatest[1]);
    let two = _mm_max_pd(_mm256_castpd256_pd128(four), _mm256_extractf128_pd(four, 1));
    _mm_cvtsd_f64(_mm_max_pd(two, _mm_unpackhi_pd(two, two)))
}

/// Greatest height of a point above any plane, m.
pub(super) fn greatest_portable(blocks: &[Block], p: &Vec3) -> f64 {
    let mut greatest = [f64::NEG_INFINITY; 8];
    for Block([nx, ny, nz, offset]) in blocks {
        for lane in 0..8 {
            let height = nx[lane] * p.x + ny[lane] * p.y + nz[lane] * p.z - offset[lane];
            greatest[lane] = greatest[lane].max(height);
        }
    }
    greatest.into_iter().fold(f64::NEG_INFINITY, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::Hull;
    use crate::pairs::{Mover, Queries, Target};

    /// Every level of this machine finds the height that the planes give one by one.
    #[test]
    fn all_levels_find_the_highest_plane() {
        for vertices in [8, 18, 66] {
            let hull = Hull::fibonacci(vertices);
            let planes = hull.planes();
            assert_eq!(planes.len(), 2 * vertices - 4);
            let queries = Queries::new(64, Mover::Point, &Target::Hull(hull), |x| x.translation.norm() < 0.3);
            let point = Vec3::new(0.01, -0.02, 0.03);
            for level in [Level::Portable, Level::Avx2, Level::Avx512] {
                if level == Level::Avx512 && Level::detect() != level
                    || level == Level::Avx2 && Level::detect() == Level::Portable
                {
                    continue;
                }
                let mut found = vec![0.0; 64];
                heights(level, &blocks(&planes), &point, &queries.poses, &mut found);
                for (found, x) in found.iter().zip(&queries.transforms) {
                    let p = x.point(&point);
                    let height = |(normal, offset): &(Vec3, f64)| normal.dot(&p) - offset;
                    let highest = planes.iter().map(height).fold(f64::NEG_INFINITY, f64::max);
                    assert!((found - highest).abs() < 1e-14, "{level:?}: {found} for {highest}");
                }
            }
        }
    }
}
