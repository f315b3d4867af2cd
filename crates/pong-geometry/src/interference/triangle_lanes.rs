//! Eight triangles side by side, coordinate by coordinate.

use crate::Vec3;
use crate::primitive::TriangleSet;
use crate::simd::LANES;

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
