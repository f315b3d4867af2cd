//! Eight boxes in single precision against a box or a ball.

use super::{LANES, LaneBits, Portable};

/// Eight boxes, coordinate by coordinate: the least by axis, then the greatest.
pub type EightBoxes = [[[f32; LANES]; 3]; 2];

/// Which of eight boxes share a place with another box.
pub trait BoxSimd: Copy {
    /// Bit `i` is set unless box `i` lies apart from the box between `low` and `high` along an axis. Comparisons with
    /// a NaN find nothing apart.
    fn boxes_met(self, boxes: &EightBoxes, low: &[f32; 3], high: &[f32; 3]) -> LaneBits;

    /// Bit `i` is set unless the square of the distance from a place to box `i` exceeds `square`. A NaN is no distance.
    fn boxes_near(self, boxes: &EightBoxes, place: &[f32; 3], square: f32) -> LaneBits;
}

impl BoxSimd for Portable {
    #[inline(always)]
    fn boxes_met(self, boxes: &EightBoxes, low: &[f32; 3], high: &[f32; 3]) -> LaneBits {
        let [least, greatest] = boxes;
        let mut met = 0;
        for lane in 0..LANES {
            let mut apart = false;
            for axis in 0..3 {
                apart |= (least[axis][lane] > high[axis]) | (greatest[axis][lane] < low[axis]);
            }
            met |= LaneBits::from(!apart) << lane;
        }
        met
    }

    #[inline(always)]
    fn boxes_near(self, boxes: &EightBoxes, place: &[f32; 3], square: f32) -> LaneBits {
        let larger = |a: f32, b: f32| if a > b { a } else { b };
        let [least, greatest] = boxes;
        let mut near = 0;
        for lane in 0..LANES {
            let mut distance_square = 0.0;
            for axis in 0..3 {
                let (before, after) = (least[axis][lane] - place[axis], place[axis] - greatest[axis][lane]);
                let beside = larger(larger(before, after), 0.0);
                distance_square += beside * beside;
            }
            near |= LaneBits::from(distance_square <= square) << lane;
        }
        near
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::super::x86::{Avx2, Avx512};
    use super::{BoxSimd, EightBoxes, LaneBits};
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
        let mut distance_square = avx._mm256_setzero_ps();
        for axis in 0..3 {
            let place = avx._mm256_set1_ps(place[axis]);
            let before = avx._mm256_sub_ps(cast(least[axis]), place);
            let after = avx._mm256_sub_ps(place, cast(greatest[axis]));
            let beside = avx._mm256_max_ps(avx._mm256_max_ps(before, after), avx._mm256_setzero_ps());
            distance_square = avx._mm256_add_ps(distance_square, avx._mm256_mul_ps(beside, beside));
        }
        let near = avx._mm256_cmp_ps::<_CMP_LE_OQ>(distance_square, avx._mm256_set1_ps(square));
        avx._mm256_movemask_ps(near) as LaneBits
    }

    impl BoxSimd for Avx2 {
        #[inline(always)]
        fn boxes_met(self, boxes: &EightBoxes, low: &[f32; 3], high: &[f32; 3]) -> LaneBits {
            boxes_met(self.0.avx, boxes, low, high)
        }

        #[inline(always)]
        fn boxes_near(self, boxes: &EightBoxes, place: &[f32; 3], square: f32) -> LaneBits {
            boxes_near(self.0.avx, boxes, place, square)
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
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Kernel, Level, Simd, run, set_level};
    use super::*;

    struct Met<'a>(&'a EightBoxes, [f32; 3], [f32; 3]);

    impl Kernel for Met<'_> {
        type Output = LaneBits;

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) -> LaneBits {
            simd.boxes_met(self.0, &self.1, &self.2)
        }
    }

    struct Near<'a>(&'a EightBoxes, [f32; 3], f32);

    impl Kernel for Near<'_> {
        type Output = LaneBits;

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) -> LaneBits {
            simd.boxes_near(self.0, &self.1, self.2)
        }
    }

    /// Every level says what the plain comparisons say, bounds that are equal, infinite or no number included.
    #[test]
    fn levels_agree_on_every_pair_of_bounds() {
        let values = [f32::NEG_INFINITY, -f32::MAX, -1.0, -0.0, 0.0, 1.0, 2.0, f32::INFINITY];
        let mut seed = 1_u32;
        let mut any = move || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            if seed >> 24 == 7 { f32::NAN } else { values[(seed >> 13) as usize % values.len()] }
        };
        for _ in 0..20_000 {
            let boxes = [0, 1].map(|_| [0, 1, 2].map(|_| [0.0; LANES].map(|_| any())));
            let (low, high) = ([0, 1, 2].map(|_| any()), [0, 1, 2].map(|_| any()));
            let expected = Portable.boxes_met(&boxes, &low, &high);
            let expected_near = Portable.boxes_near(&boxes, &low, high[0]);
            for level in Level::available() {
                set_level(level);
                assert_eq!(run(Met(&boxes, low, high)), expected, "{level:?} {boxes:?} {low:?} {high:?}");
                let near = run(Near(&boxes, low, high[0]));
                assert_eq!(near, expected_near, "{level:?} {boxes:?} {low:?} {high:?}");
            }
        }
        set_level(Level::best());
    }
}
