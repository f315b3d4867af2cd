//! Up to eight triangles, stored as coordinate arrays for SIMD.

use crate::Vec3;
use crate::primitive::TriangleSet;
use crate::simd::{LANES, LaneBits, Simd};

/// Eight vectors stored as arrays of x, y and z.
pub(super) type EightVectors = [[f64; LANES]; 3];

/// Initial value of unused lanes.
pub(super) const NOTHING: EightVectors = [[0.0; LANES]; 3];

/// Writes a vector to one lane.
#[inline(always)]
pub(super) fn put(vectors: &mut EightVectors, lane: usize, v: &Vec3) {
    (vectors[0][lane], vectors[1][lane], vectors[2][lane]) = (v.x, v.y, v.z);
}

/// Writes a number to all lanes from `lane` on.
#[inline(always)]
pub(super) fn fill_in<S: Simd>(simd: S, numbers: &mut [f64; LANES], lane: usize, value: f64) {
    let from_there = simd.mask(LaneBits::MAX.checked_shl(lane as u32).unwrap_or(0));
    *numbers = simd.store(simd.select(from_there, simd.splat(value), simd.load(numbers)));
}

/// Writes a vector to all lanes from `lane` on.
#[inline(always)]
pub(super) fn fill_vectors_in<S: Simd>(simd: S, vectors: &mut EightVectors, lane: usize, v: &Vec3) {
    fill_in(simd, &mut vectors[0], lane, v.x);
    fill_in(simd, &mut vectors[1], lane, v.y);
    fill_in(simd, &mut vectors[2], lane, v.z);
}

/// Up to eight triangles of a set, each with the centre of the shape that may touch it.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(super) struct TriangleLanes {
    pub corners: [EightVectors; 3],
    pub centers: EightVectors,
    /// Distance behind a triangle up to which the centre of its shape is still pushed to the front, m.
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

    /// Adds a triangle to the lanes, of which there are eight, and returns its lane. The triangle's data is
    /// read later, by [`fetch`](Self::fetch).
    #[inline(always)]
    pub fn add(&mut self, center: &Vec3, triangle: u32, thickness: f64) -> usize {
        let lane = self.push(triangle);
        put(&mut self.centers, lane, center);
        self.thicknesses[lane] = thickness;
        lane
    }

    /// Sets the centre and thickness for all triangles that [`push`](Self::push) adds afterwards.
    #[inline(always)]
    pub fn begin_in<S: Simd>(&mut self, simd: S, center: &Vec3, thickness: f64) {
        fill_vectors_in(simd, &mut self.centers, self.count, center);
        fill_in(simd, &mut self.thicknesses, self.count, thickness);
    }

    /// Adds a triangle and returns its lane.
    #[inline(always)]
    pub fn push(&mut self, triangle: u32) -> usize {
        let lane = self.count;
        assert!(lane < LANES, "there may be eight");
        self.triangles[lane] = triangle;
        self.count += 1;
        lane
    }

    /// Reads the data of the triangles: first all records, then all corners. Each read may miss the cache,
    /// and the address of a corner depends on the record. So the reads of each kind follow one another, and
    /// their cache misses overlap.
    #[inline(always)]
    pub fn fetch(&mut self, set: &TriangleSet) {
        // Unused lanes repeat a triangle that is read anyway, so that the loops have a fixed length.
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

    /// Returns the lanes that hold a triangle.
    #[inline(always)]
    pub fn used(&self) -> LaneBits {
        !(LaneBits::MAX.checked_shl(self.count as u32).unwrap_or(0))
    }
}

/// Gathers bit `k` of each of eight bytes.
#[inline(always)]
pub(super) fn bit_of_each(bytes: &[u8; LANES], k: usize) -> LaneBits {
    // The product moves the lowest bit of each byte to the highest byte, side by side.
    let bits = u64::from_le_bytes(*bytes) >> k & 0x0101_0101_0101_0101;
    (bits.wrapping_mul(0x0102_0408_1020_4080) >> 56) as LaneBits
}
