//! Levels of x86-64: one register of eight numbers (AVX-512) or two registers of four (AVX2). `pulp` returns
//! a token only if the machine has the instructions, which makes their use safe.

use super::arithmetic::Simd;
use super::lanes::{LANES, LaneBits};
use pulp::cast;
use pulp::x86::{V3, V4};
use std::arch::x86_64::{__m128d, __m256d, __m256i, __m512d, _CMP_EQ_OQ, _CMP_GE_OQ, _CMP_LT_OQ};

/// AVX-512 level: eight numbers per instruction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Avx512(pub V4);

impl Simd for Avx512 {
    type Eight = __m512d;
    type Mask = LaneBits;

    #[inline(always)]
    fn splat(self, value: f64) -> __m512d {
        self.0.avx512f._mm512_set1_pd(value)
    }
    #[inline(always)]
    fn load(self, values: &[f64; LANES]) -> __m512d {
        cast(*values)
    }
    #[inline(always)]
    fn store(self, values: __m512d) -> [f64; LANES] {
        cast(values)
    }
    #[inline(always)]
    fn add(self, a: __m512d, b: __m512d) -> __m512d {
        self.0.avx512f._mm512_add_pd(a, b)
    }
    #[inline(always)]
    fn sub(self, a: __m512d, b: __m512d) -> __m512d {
        self.0.avx512f._mm512_sub_pd(a, b)
    }
    #[inline(always)]
    fn mul(self, a: __m512d, b: __m512d) -> __m512d {
        self.0.avx512f._mm512_mul_pd(a, b)
    }
    #[inline(always)]
    fn div(self, a: __m512d, b: __m512d) -> __m512d {
        self.0.avx512f._mm512_div_pd(a, b)
    }
    #[inline(always)]
    fn below(self, a: __m512d, b: __m512d) -> LaneBits {
        self.0.avx512f._mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b)
    }
    #[inline(always)]
    fn at_least(self, a: __m512d, b: __m512d) -> LaneBits {
        self.0.avx512f._mm512_cmp_pd_mask::<_CMP_GE_OQ>(a, b)
    }
    #[inline(always)]
    fn equal(self, a: __m512d, b: __m512d) -> LaneBits {
        self.0.avx512f._mm512_cmp_pd_mask::<_CMP_EQ_OQ>(a, b)
    }
    #[inline(always)]
    fn sqrt(self, values: __m512d) -> __m512d {
        self.0.avx512f._mm512_sqrt_pd(values)
    }
    #[inline(always)]
    fn scaled(self, values: __m512d, power: __m512d) -> __m512d {
        let power = self.0.avx512f._mm512_slli_epi64::<52>(cast(power));
        cast(self.0.avx512f._mm512_add_epi64(cast(values), power))
    }
    #[inline(always)]
    fn larger(self, a: __m512d, b: __m512d) -> __m512d {
        self.0.avx512f._mm512_max_pd(a, b)
    }
    #[inline(always)]
    fn smaller(self, a: __m512d, b: __m512d) -> __m512d {
        self.0.avx512f._mm512_min_pd(a, b)
    }
    #[inline(always)]
    fn abs(self, values: __m512d) -> __m512d {
        cast(self.0.avx512f._mm512_andnot_si512(cast(self.splat(-0.0)), cast(values)))
    }
    #[inline(always)]
    fn largest(self, values: __m512d) -> f64 {
        let [low, high] = cast(values);
        largest_of_four(*self.0, self.0.avx._mm256_max_pd(low, high))
    }
    #[inline(always)]
    fn mask(self, bits: LaneBits) -> LaneBits {
        bits
    }
    #[inline(always)]
    fn and(self, a: LaneBits, b: LaneBits) -> LaneBits {
        a & b
    }
    #[inline(always)]
    fn bits(self, mask: LaneBits) -> LaneBits {
        mask
    }
    #[inline(always)]
    fn select(self, mask: LaneBits, a: __m512d, b: __m512d) -> __m512d {
        self.0.avx512f._mm512_mask_blend_pd(mask, b, a)
    }
}

#[inline(always)]
fn largest_of_four(v3: V3, values: __m256d) -> f64 {
    let [low, high]: [__m128d; 2] = cast(values);
    let two = v3.sse2._mm_max_pd(low, high);
    let one = v3.sse2._mm_max_pd(two, v3.sse2._mm_unpackhi_pd(two, two));
    cast::<__m128d, [f64; 2]>(one)[0]
}

/// AVX2 level: four numbers per instruction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Avx2(pub V3);

/// Eight numbers as two registers: lanes 0 to 3, and lanes 4 to 7.
type Halves = [__m256d; 2];

impl Simd for Avx2 {
    type Eight = Halves;
    type Mask = Halves;

    #[inline(always)]
    fn splat(self, value: f64) -> Halves {
        [self.0.avx._mm256_set1_pd(value); 2]
    }
    #[inline(always)]
    fn load(self, values: &[f64; LANES]) -> Halves {
        cast(*values)
    }
    #[inline(always)]
    fn store(self, values: Halves) -> [f64; LANES] {
        cast(values)
    }
    #[inline(always)]
    fn add(self, [a, b]: Halves, [c, d]: Halves) -> Halves {
        [self.0.avx._mm256_add_pd(a, c), self.0.avx._mm256_add_pd(b, d)]
    }
    #[inline(always)]
    fn sub(self, [a, b]: Halves, [c, d]: Halves) -> Halves {
        [self.0.avx._mm256_sub_pd(a, c), self.0.avx._mm256_sub_pd(b, d)]
    }
    #[inline(always)]
    fn mul(self, [a, b]: Halves, [c, d]: Halves) -> Halves {
        [self.0.avx._mm256_mul_pd(a, c), self.0.avx._mm256_mul_pd(b, d)]
    }
    #[inline(always)]
    fn div(self, [a, b]: Halves, [c, d]: Halves) -> Halves {
        [self.0.avx._mm256_div_pd(a, c), self.0.avx._mm256_div_pd(b, d)]
    }
    #[inline(always)]
    fn below(self, [a, b]: Halves, [c, d]: Halves) -> Halves {
        [self.0.avx._mm256_cmp_pd::<_CMP_LT_OQ>(a, c), self.0.avx._mm256_cmp_pd::<_CMP_LT_OQ>(b, d)]
    }
    #[inline(always)]
    fn at_least(self, [a, b]: Halves, [c, d]: Halves) -> Halves {
        [self.0.avx._mm256_cmp_pd::<_CMP_GE_OQ>(a, c), self.0.avx._mm256_cmp_pd::<_CMP_GE_OQ>(b, d)]
    }
    #[inline(always)]
    fn equal(self, [a, b]: Halves, [c, d]: Halves) -> Halves {
        [self.0.avx._mm256_cmp_pd::<_CMP_EQ_OQ>(a, c), self.0.avx._mm256_cmp_pd::<_CMP_EQ_OQ>(b, d)]
    }
    #[inline(always)]
    fn sqrt(self, [a, b]: Halves) -> Halves {
        [self.0.avx._mm256_sqrt_pd(a), self.0.avx._mm256_sqrt_pd(b)]
    }
    #[inline(always)]
    fn scaled(self, values: Halves, power: Halves) -> Halves {
        let of = |values: __m256d, power: __m256d| {
            let power = self.0.avx2._mm256_slli_epi64::<52>(cast(power));
            cast(self.0.avx2._mm256_add_epi64(cast(values), power))
        };
        [of(values[0], power[0]), of(values[1], power[1])]
    }
    #[inline(always)]
    fn larger(self, [a, b]: Halves, [c, d]: Halves) -> Halves {
        [self.0.avx._mm256_max_pd(a, c), self.0.avx._mm256_max_pd(b, d)]
    }
    #[inline(always)]
    fn smaller(self, [a, b]: Halves, [c, d]: Halves) -> Halves {
        [self.0.avx._mm256_min_pd(a, c), self.0.avx._mm256_min_pd(b, d)]
    }
    #[inline(always)]
    fn abs(self, [a, b]: Halves) -> Halves {
        let sign = self.0.avx._mm256_set1_pd(-0.0);
        [self.0.avx._mm256_andnot_pd(sign, a), self.0.avx._mm256_andnot_pd(sign, b)]
    }
    #[inline(always)]
    fn largest(self, [a, b]: Halves) -> f64 {
        largest_of_four(self.0, self.0.avx._mm256_max_pd(a, b))
    }
    #[inline(always)]
    fn mask(self, bits: LaneBits) -> Halves {
        let lanes = self.0.avx._mm256_set1_epi64x(bits.into());
        let of = |lanes_of: [i64; 4]| {
            let single: __m256i = cast(lanes_of);
            cast(self.0.avx2._mm256_cmpeq_epi64(self.0.avx2._mm256_and_si256(lanes, single), single))
        };
        [of([1, 2, 4, 8]), of([16, 32, 64, 128])]
    }
    #[inline(always)]
    fn and(self, [a, b]: Halves, [c, d]: Halves) -> Halves {
        [self.0.avx._mm256_and_pd(a, c), self.0.avx._mm256_and_pd(b, d)]
    }
    #[inline(always)]
    fn bits(self, [a, b]: Halves) -> LaneBits {
        (self.0.avx._mm256_movemask_pd(a) | self.0.avx._mm256_movemask_pd(b) << 4) as LaneBits
    }
    #[inline(always)]
    fn select(self, [first, second]: Halves, [a, b]: Halves, [c, d]: Halves) -> Halves {
        [self.0.avx._mm256_blendv_pd(c, a, first), self.0.avx._mm256_blendv_pd(d, b, second)]
    }
}
