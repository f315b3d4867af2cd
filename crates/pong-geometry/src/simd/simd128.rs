//! Registers of WebAssembly, for programs that are compiled with its 128-bit instructions (`-C
//! target-feature=+simd128`). None of them fuses a product and a sum; the relaxed ones, which may, are not used.

use super::lanes::LaneBits;
use super::pairs::Registers;
use std::arch::wasm32::*;

/// Token of the instructions: this file is compiled only with them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Simd128;

impl Registers for Simd128 {
    type Two = v128;
    type TwoMarks = v128;
    type Four = v128;
    type FourMarks = v128;

    #[inline(always)]
    fn splat(self, value: f64) -> v128 {
        f64x2_splat(value)
    }
    #[inline(always)]
    fn load(self, [a, b]: [f64; 2]) -> v128 {
        f64x2(a, b)
    }
    #[inline(always)]
    fn store(self, values: v128) -> [f64; 2] {
        [f64x2_extract_lane::<0>(values), f64x2_extract_lane::<1>(values)]
    }
    #[inline(always)]
    fn add(self, a: v128, b: v128) -> v128 {
        f64x2_add(a, b)
    }
    #[inline(always)]
    fn sub(self, a: v128, b: v128) -> v128 {
        f64x2_sub(a, b)
    }
    #[inline(always)]
    fn mul(self, a: v128, b: v128) -> v128 {
        f64x2_mul(a, b)
    }
    #[inline(always)]
    fn div(self, a: v128, b: v128) -> v128 {
        f64x2_div(a, b)
    }
    #[inline(always)]
    fn sqrt(self, values: v128) -> v128 {
        f64x2_sqrt(values)
    }
    #[inline(always)]
    fn abs(self, values: v128) -> v128 {
        f64x2_abs(values)
    }
    #[inline(always)]
    fn scaled(self, values: v128, power: v128) -> v128 {
        i64x2_add(values, i64x2_shl(power, 52))
    }
    #[inline(always)]
    fn below(self, a: v128, b: v128) -> v128 {
        f64x2_lt(a, b)
    }
    #[inline(always)]
    fn at_least(self, a: v128, b: v128) -> v128 {
        f64x2_ge(a, b)
    }
    #[inline(always)]
    fn equal(self, a: v128, b: v128) -> v128 {
        f64x2_eq(a, b)
    }
    #[inline(always)]
    fn and(self, a: v128, b: v128) -> v128 {
        v128_and(a, b)
    }
    #[inline(always)]
    fn select(self, marks: v128, a: v128, b: v128) -> v128 {
        v128_bitselect(a, b, marks)
    }
    #[inline(always)]
    fn marks(self, [a, b]: [u64; 2]) -> v128 {
        u64x2(a, b)
    }
    #[inline(always)]
    fn bits(self, [a, b, c, d]: [v128; 4]) -> LaneBits {
        i64x2_bitmask(a) | i64x2_bitmask(b) << 2 | i64x2_bitmask(c) << 4 | i64x2_bitmask(d) << 6
    }

    #[inline(always)]
    fn splat_single(self, value: f32) -> v128 {
        f32x4_splat(value)
    }
    #[inline(always)]
    fn load_single(self, [a, b, c, d]: [f32; 4]) -> v128 {
        f32x4(a, b, c, d)
    }
    #[inline(always)]
    fn add_single(self, a: v128, b: v128) -> v128 {
        f32x4_add(a, b)
    }
    #[inline(always)]
    fn sub_single(self, a: v128, b: v128) -> v128 {
        f32x4_sub(a, b)
    }
    #[inline(always)]
    fn mul_single(self, a: v128, b: v128) -> v128 {
        f32x4_mul(a, b)
    }
    #[inline(always)]
    fn larger_single(self, a: v128, b: v128) -> v128 {
        // "Pseudo-maximum" of b and a: `if b < a { a } else { b }`. The plain maximum returns NaN where one of the two is.
        f32x4_pmax(b, a)
    }
    #[inline(always)]
    fn below_single(self, a: v128, b: v128) -> v128 {
        f32x4_lt(a, b)
    }
    #[inline(always)]
    fn at_most_single(self, a: v128, b: v128) -> v128 {
        f32x4_le(a, b)
    }
    #[inline(always)]
    fn or_single(self, a: v128, b: v128) -> v128 {
        v128_or(a, b)
    }
    #[inline(always)]
    fn bits_single(self, [a, b]: [v128; 2]) -> LaneBits {
        i32x4_bitmask(a) | i32x4_bitmask(b) << 4
    }
}
