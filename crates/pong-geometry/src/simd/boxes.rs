//! Overlap tests of eight boxes in single precision against a box or a sphere, and the selection of the
//! boxes' contents.

use super::lanes::{LANES, LaneBits};

/// Eight boxes as coordinate arrays: minima by axis, then maxima.
pub type EightBoxes = [[[f32; LANES]; 3]; 2];

/// Overlap tests of eight boxes, and selection of their contents.
pub trait BoxSimd: Copy {
    /// Returns a mask in which bit `i` is set unless box `i` is separated from the box between `low` and
    /// `high` along an axis. A comparison with NaN never separates.
    fn boxes_met(self, boxes: &EightBoxes, low: &[f32; 3], high: &[f32; 3]) -> LaneBits;

    /// Returns a mask in which bit `i` is set unless the squared distance from a point to box `i` exceeds
    /// `square`. An axis with a NaN coordinate adds nothing to the distance.
    fn boxes_near(self, boxes: &EightBoxes, place: &[f32; 3], square: f32) -> LaneBits;

    /// Returns the numbers whose bits are set, in order, at the front. The remaining lanes have no meaning.
    fn packed(self, values: &[u32; LANES], bits: LaneBits) -> [u32; LANES];
}

#[cfg(test)]
mod tests {
    use super::super::{Kernel, Level, Portable, Simd, run, set_level};
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

    struct Packed<'a>(&'a [u32; LANES], LaneBits);

    impl Kernel for Packed<'_> {
        type Output = [u32; LANES];

        #[inline(always)]
        fn run<S: Simd>(self, simd: S) -> [u32; LANES] {
            simd.packed(self.0, self.1)
        }
    }

    #[test]
    fn numbers_whose_bits_are_set_come_first_and_in_order() {
        let values = [7, u32::MAX, 0, 1 << 31, 5, 5, 12, 3];
        for bits in 0..=LaneBits::MAX {
            let expected: Vec<u32> =
                (0..LANES).filter(|lane| bits >> lane & 1 == 1).map(|lane| values[lane]).collect();
            for level in Level::available() {
                set_level(level);
                let packed = run(Packed(&values, bits));
                assert_eq!(packed[..expected.len()], expected, "{level:?} {bits:#b}");
            }
        }
        set_level(Level::best());
    }

    /// Every level agrees with scalar comparisons, including equal, infinite and NaN bounds.
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
