//! Eight triangles side by side, coordinate by coordinate.

use crate::Vec3;
use crate::primitive::TriangleSet;
use crate::simd::{LANES, LaneBits};

/// Vectors, coordinate by coordinate.
pub(super) type EightVectors = [[f64; LANES]; 3];

/// Something to fill memory with.
pub(super) const NOTHING: EightVectors = [[0.0; LANES]; 3];

/// Writes one vector.
#[inline(always)]
pub(super) fn put(vectors: &mut EightVectors, lane: usize, v: &Vec3) {
    (vectors[0][lane], vectors[1][lane], vectors[2][lane]) = (v.x, v.y, v.z);
}

/// Writes the corners of one triangle.
#[inline(always)]
pub(super) fn put_corners(corners: &mut [EightVectors; 3], lane: usize, set: &TriangleSet, triangle: u32) {
    let record = &set.triangles[triangle as usize];
    for (corner, &vertex) in corners.iter_mut().zip(&record.vertices) {
        put(corner, lane, &set.vertices[vertex as usize]);
    }
}

/// Bit `k` of each of eight bytes.
#[inline(always)]
pub(super) fn bit_of_each(bytes: &[u8; LANES], k: usize) -> LaneBits {
    // The product brings the bits, one in each byte, side by side into the highest byte.
    let bits = u64::from_le_bytes(*bytes) >> k & 0x0101_0101_0101_0101;
    (bits.wrapping_mul(0x0102_0408_1020_4080) >> 56) as LaneBits
}
