//! Eight triangles side by side, coordinate by coordinate.

use crate::Vec3;
use crate::primitive::TriangleSet;
use crate::simd::{LANES, LaneBits, Simd};

/// Vectors, coordinate by coordinate.
pub(super) type EightVectors = [[f64; LANES]; 3];

/// Something to fill memory with.
pub(super) const NOTHING: EightVectors = [[0.0; LANES]; 3];

/// Writes one vector.
#[inline(always)]
pub(super) fn put(vectors: &mut EightVectors, lane: usize, v: &Vec3) {
    (vectors[0][lane], vectors[1][lane], vectors[2][lane]) = (v.x, v.y, v.z);
}

/// Writes a number into the lanes from one on.
#[inline(always)]
pub(super) fn fill_in<S: Simd>(simd: S, numbers: &mut [f64; LANES], lane: usize, value: f64) {
    let from_there = simd.mask(LaneBits::MAX.checked_shl(lane as u32).unwrap_or(0));
    *numbers = simd.store(simd.select(from_there, simd.splat(value), simd.load(numbers)));
}

/// Writes a vector into the lanes from one on.
#[inline(always)]
pub(super) fn fill_vectors_in<S: Simd>(simd: S, vectors: &mut EightVectors, lane: usize, v: &Vec3) {
    fill_in(simd, &mut vectors[0], lane, v.x);
    fill_in(simd, &mut vectors[1], lane, v.y);
    fill_in(simd, &mut vectors[2], lane, v.z);
}

/// Up to eight triangles of a set, each with the centre of what may touch it.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct TriangleLanes {
    pub corners: [EightVectors; 3],
    pub centers: EightVectors,
    /// How far behind a triangle its centre may be and still be pushed to the front, m.
    pub thicknesses: [f64; LANES],
    pub may_push: [u8; LANES],
    pub triangles: [u32; LANES],
    pub count: usize,
}

impl TriangleLanes {
    pub const NONE: Self = Self {
        corners: [NOTHING; 3],
        centers: NOTHING,
        thicknesses: [0.0; LANES],
        may_push: [0; LANES],
        triangles: [0; LANES],
        count: 0,
    };

    /// One more, of which there may be eight; answers its lane. Nothing is read of the triangle yet.
    #[inline(always)]
    pub fn add(&mut self, center: &Vec3, triangle: u32, thickness: f64) -> usize {
        let lane = self.push(triangle);
        put(&mut self.centers, lane, center);
        self.thicknesses[lane] = thickness;
        lane
    }

    /// Gives what is pushed from here on a centre and a thickness.
    #[inline(always)]
    pub fn begin_in<S: Simd>(&mut self, simd: S, center: &Vec3, thickness: f64) {
        fill_vectors_in(simd, &mut self.centers, self.count, center);
        fill_in(simd, &mut self.thicknesses, self.count, thickness);
    }

    /// One more; answers its lane.
    #[inline(always)]
    pub fn push(&mut self, triangle: u32) -> usize {
        let lane = self.count;
        assert!(lane < LANES, "there may be eight");
        self.triangles[lane] = triangle;
        self.count += 1;
        lane
    }

    /// Reads the triangles: all records, then all corners. Each is likely to come from a slow memory, and a record says where
    /// its corners are: side by side they wait once.
    #[inline(always)]
    pub fn fetch(&mut self, set: &TriangleSet) {
        // Lanes without a triangle get one that is read anyway: a loop over all lanes takes no decisions.
        for lane in self.count..LANES {
            self.triangles[lane] = self.triangles[0];
        }
        let mut vertices = [[0; LANES]; 3];
        for lane in 0..LANES {
            let record = &set.triangles[self.triangles[lane] as usize];
            for (of_corner, vertex) in vertices.iter_mut().zip(record.vertices) {
                of_corner[lane] = vertex;
            }
            self.may_push[lane] = record.may_push.0;
        }
        for (corner, vertices) in self.corners.iter_mut().zip(&vertices) {
            for (lane, &vertex) in vertices.iter().enumerate() {
                put(corner, lane, &set.vertices[vertex as usize]);
            }
        }
    }

    /// The lanes that hold one.
    #[inline(always)]
    pub fn used(&self) -> LaneBits {
        !(LaneBits::MAX.checked_shl(self.count as u32).unwrap_or(0))
    }
}

/// Bit `k` of each of eight bytes.
#[inline(always)]
pub(super) fn bit_of_each(bytes: &[u8; LANES], k: usize) -> LaneBits {
    // The product brings the bits, one in each byte, side by side into the highest byte.
    let bits = u64::from_le_bytes(*bytes) >> k & 0x0101_0101_0101_0101;
    (bits.wrapping_mul(0x0102_0408_1020_4080) >> 56) as LaneBits
}
