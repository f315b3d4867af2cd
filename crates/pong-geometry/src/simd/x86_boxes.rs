//! Overlap tests on x86-64: eight single-precision boxes in one register, for AVX2 and for AVX-512.

use super::boxes::{BoxSimd, EightBoxes};
use super::lanes::{LANES, LaneBits};
use super::x86::{Avx2, Avx512};
use pulp::cast;
use pulp::core_arch::x86::Avx;
use std::arch::x86_64::{__m256, _CMP_GT_OQ, _CMP_LE_OQ, _CMP_LT_OQ};

#[inline(always)]
fn boxes_met(avx: Avx, boxes: &EightBoxes, low: &[f32; 3], high: &[f32; 3]) -> LaneBits {
    let [least, greatest] = boxes;
    let apart_along = |axis: usize| -> __m256 {
        let beyond = avx._mm256_cmp_ps::<_CMP_GT_OQ>(cast(least[axis]), avx._mm256_set1_ps(high[axis]));
        let before = avx._mm256_cmp_ps::<_CMP_LT_OQ>(cast(greatest[axis]), avx._mm256_set1_ps(low[axis]));
        avx._mm256_or_ps(beyond, before)
    };
    let apart = avx._mm256_or_ps(avx._mm256_or_ps(apart_along(0), apart_along(1)), apart_along(2));
    !(avx._mm256_movemask_ps(apart) as LaneBits)
}

#[inline(always)]
fn boxes_near(avx: Avx, boxes: &EightBoxes, place: &[f32; 3], square: f32) -> LaneBits {
    let [least, greatest] = boxes;
    let square_along = |axis: usize| -> __m256 {
        let place = avx._mm256_set1_ps(place[axis]);
        let before = avx._mm256_sub_ps(cast(least[axis]), place);
        let after = avx._mm256_sub_ps(place, cast(greatest[axis]));
        let beside = avx._mm256_max_ps(avx._mm256_max_ps(before, after), avx._mm256_setzero_ps());
        avx._mm256_mul_ps(beside, beside)
    };
    let across = avx._mm256_add_ps(square_along(0), square_along(1));
    let distance_square = avx._mm256_add_ps(across, square_along(2));
    let near = avx._mm256_cmp_ps::<_CMP_LE_OQ>(distance_square, avx._mm256_set1_ps(square));
    avx._mm256_movemask_ps(near) as LaneBits
}

/// For every lane mask, the indices of its set lanes in increasing order, one byte each, lowest byte first.
static NUMBERS: [u64; 1 << LANES] = {
    let mut numbers = [0; 1 << LANES];
    let mut bits = 0;
    while bits < numbers.len() {
        let (mut lane, mut count) = (0, 0);
        while lane < LANES {
            if bits >> lane & 1 == 1 {
                numbers[bits] |= (lane as u64) << (8 * count);
                count += 1;
            }
            lane += 1;
        }
        bits += 1;
    }
    numbers
};

impl BoxSimd for Avx2 {
    #[inline(always)]
    fn boxes_met(self, boxes: &EightBoxes, low: &[f32; 3], high: &[f32; 3]) -> LaneBits {
        boxes_met(self.0.avx, boxes, low, high)
    }

    #[inline(always)]
    fn boxes_near(self, boxes: &EightBoxes, place: &[f32; 3], square: f32) -> LaneBits {
        boxes_near(self.0.avx, boxes, place, square)
    }

    #[inline(always)]
    fn packed(self, values: &[u32; LANES], bits: LaneBits) -> [u32; LANES] {
        let avx2 = self.0.avx2;
        let numbers = avx2._mm256_cvtepu8_epi32(cast([NUMBERS[usize::from(bits)], 0]));
        cast(avx2._mm256_permutevar8x32_epi32(cast(*values), numbers))
    }
}

impl BoxSimd for Avx512 {
    #[inline(always)]
    fn boxes_met(self, boxes: &EightBoxes, low: &[f32; 3], high: &[f32; 3]) -> LaneBits {
        boxes_met(self.0.avx, boxes, low, high)
    }

    #[inline(always)]
    fn boxes_near(self, boxes: &EightBoxes, place: &[f32; 3], square: f32) -> LaneBits {
        boxes_near(self.0.avx, boxes, place, square)
    }

    #[inline(always)]
    fn packed(self, values: &[u32; LANES], bits: LaneBits) -> [u32; LANES] {
        cast(self.0.avx512f._mm256_maskz_compress_epi32(bits, cast(*values)))
    }
}
