//! Registers of AArch64. Every such processor has NEON; `pulp` returns its token after asking, which makes the use of
//! the instructions safe. No instruction here fuses a product and a sum.

use super::lanes::LaneBits;
use super::pairs::Registers;
use pulp::aarch64::Neon;
use pulp::cast;
use std::arch::aarch64::{float32x4_t, float64x2_t, uint32x4_t, uint64x2_t};

impl Registers for Neon {
    type Two = float64x2_t;
    type TwoMarks = uint64x2_t;
    type Four = float32x4_t;
    type FourMarks = uint32x4_t;

    #[inline(always)]
    fn splat(self, value: f64) -> float64x2_t {
        self.neon.vdupq_n_f64(value)
    }
    #[inline(always)]
    fn load(self, values: [f64; 2]) -> float64x2_t {
        cast(values)
    }
    #[inline(always)]
    fn store(self, values: float64x2_t) -> [f64; 2] {
        cast(values)
    }
    #[inline(always)]
    fn add(self, a: float64x2_t, b: float64x2_t) -> float64x2_t {
        self.neon.vaddq_f64(a, b)
    }
    #[inline(always)]
    fn sub(self, a: float64x2_t, b: float64x2_t) -> float64x2_t {
        self.neon.vsubq_f64(a, b)
    }
    #[inline(always)]
    fn mul(self, a: float64x2_t, b: float64x2_t) -> float64x2_t {
        self.neon.vmulq_f64(a, b)
    }
    #[inline(always)]
    fn div(self, a: float64x2_t, b: float64x2_t) -> float64x2_t {
        self.neon.vdivq_f64(a, b)
    }
    #[inline(always)]
    fn sqrt(self, values: float64x2_t) -> float64x2_t {
        self.neon.vsqrtq_f64(values)
    }
    #[inline(always)]
    fn abs(self, values: float64x2_t) -> float64x2_t {
        self.neon.vabsq_f64(values)
    }
    #[inline(always)]
    fn scaled(self, values: float64x2_t, power: float64x2_t) -> float64x2_t {
        cast(self.neon.vaddq_u64(cast(values), self.neon.vshlq_n_u64::<52>(cast(power))))
    }
    #[inline(always)]
    fn below(self, a: float64x2_t, b: float64x2_t) -> uint64x2_t {
        self.neon.vcltq_f64(a, b)
    }
    #[inline(always)]
    fn at_least(self, a: float64x2_t, b: float64x2_t) -> uint64x2_t {
        self.neon.vcgeq_f64(a, b)
    }
    #[inline(always)]
    fn equal(self, a: float64x2_t, b: float64x2_t) -> uint64x2_t {
        self.neon.vceqq_f64(a, b)
    }
    #[inline(always)]
    fn and(self, a: uint64x2_t, b: uint64x2_t) -> uint64x2_t {
        self.neon.vandq_u64(a, b)
    }
    #[inline(always)]
    fn select(self, marks: uint64x2_t, a: float64x2_t, b: float64x2_t) -> float64x2_t {
        self.neon.vbslq_f64(marks, a, b)
    }
    #[inline(always)]
    fn marks(self, words: [u64; 2]) -> uint64x2_t {
        cast(words)
    }
    #[inline(always)]
    fn bits(self, [a, b, c, d]: [uint64x2_t; 4]) -> LaneBits {
        // NEON has no move of marks to bits: each mark keeps its own bit, and a sum collects them.
        let keep = |marks, bits: [u64; 2]| self.neon.vandq_u64(marks, cast(bits));
        let low = self.neon.vorrq_u64(keep(a, [1, 2]), keep(b, [4, 8]));
        let high = self.neon.vorrq_u64(keep(c, [16, 32]), keep(d, [64, 128]));
        self.neon.vaddvq_u64(self.neon.vorrq_u64(low, high)) as LaneBits
    }

    #[inline(always)]
    fn splat_single(self, value: f32) -> float32x4_t {
        self.neon.vdupq_n_f32(value)
    }
    #[inline(always)]
    fn load_single(self, values: [f32; 4]) -> float32x4_t {
        cast(values)
    }
    #[inline(always)]
    fn add_single(self, a: float32x4_t, b: float32x4_t) -> float32x4_t {
        self.neon.vaddq_f32(a, b)
    }
    #[inline(always)]
    fn sub_single(self, a: float32x4_t, b: float32x4_t) -> float32x4_t {
        self.neon.vsubq_f32(a, b)
    }
    #[inline(always)]
    fn mul_single(self, a: float32x4_t, b: float32x4_t) -> float32x4_t {
        self.neon.vmulq_f32(a, b)
    }
    #[inline(always)]
    fn larger_single(self, a: float32x4_t, b: float32x4_t) -> float32x4_t {
        // Not FMAX, which returns NaN where one of the two is.
        self.neon.vbslq_f32(self.neon.vcgtq_f32(a, b), a, b)
    }
    #[inline(always)]
    fn below_single(self, a: float32x4_t, b: float32x4_t) -> uint32x4_t {
        self.neon.vcltq_f32(a, b)
    }
    #[inline(always)]
    fn at_most_single(self, a: float32x4_t, b: float32x4_t) -> uint32x4_t {
        self.neon.vcleq_f32(a, b)
    }
    #[inline(always)]
    fn or_single(self, a: uint32x4_t, b: uint32x4_t) -> uint32x4_t {
        self.neon.vorrq_u32(a, b)
    }
    #[inline(always)]
    fn bits_single(self, [a, b]: [uint32x4_t; 2]) -> LaneBits {
        let keep = |marks, bits: [u32; 4]| self.neon.vandq_u32(marks, cast(bits));
        self.neon.vaddvq_u32(self.neon.vorrq_u32(keep(a, [1, 2, 4, 8]), keep(b, [16, 32, 64, 128])))
            as LaneBits
    }
}
