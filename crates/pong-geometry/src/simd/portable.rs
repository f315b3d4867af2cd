//! Portable level: operations on plain arrays, the reference for the other levels.

use super::arithmetic::Simd;
use super::boxes::{BoxSimd, EightBoxes};
use super::lanes::{LANES, LaneBits};

/// Instruction-set level that every machine has.
#[derive(Clone, Copy, Debug)]
pub struct Portable;

#[inline(always)]
fn zip(a: [f64; LANES], b: [f64; LANES], f: impl Fn(f64, f64) -> f64) -> [f64; LANES] {
    let mut out = [0.0; LANES];
    for lane in 0..LANES {
        out[lane] = f(a[lane], b[lane]);
    }
    out
}

#[inline(always)]
fn compare(a: [f64; LANES], b: [f64; LANES], f: impl Fn(f64, f64) -> bool) -> LaneBits {
    let mut bits = 0;
    for lane in 0..LANES {
        bits |= LaneBits::from(f(a[lane], b[lane])) << lane;
    }
    bits
}

impl Simd for Portable {
    type Eight = [f64; LANES];
    type Mask = LaneBits;

    #[inline(always)]
    fn splat(self, value: f64) -> Self::Eight {
        [value; LANES]
    }
    #[inline(always)]
    fn load(self, values: &[f64; LANES]) -> Self::Eight {
        *values
    }
    #[inline(always)]
    fn store(self, values: Self::Eight) -> [f64; LANES] {
        values
    }
    #[inline(always)]
    fn add(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        zip(a, b, |a, b| a + b)
    }
    #[inline(always)]
    fn sub(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        zip(a, b, |a, b| a - b)
    }
    #[inline(always)]
    fn mul(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        zip(a, b, |a, b| a * b)
    }
    #[inline(always)]
    fn div(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        zip(a, b, |a, b| a / b)
    }
    #[inline(always)]
    fn below(self, a: Self::Eight, b: Self::Eight) -> Self::Mask {
        compare(a, b, |a, b| a < b)
    }
    #[inline(always)]
    fn at_least(self, a: Self::Eight, b: Self::Eight) -> Self::Mask {
        compare(a, b, |a, b| a >= b)
    }
    #[inline(always)]
    fn equal(self, a: Self::Eight, b: Self::Eight) -> Self::Mask {
        compare(a, b, |a, b| a == b)
    }
    #[inline(always)]
    fn scaled(self, values: Self::Eight, power: Self::Eight) -> Self::Eight {
        zip(values, power, |value, power| f64::from_bits(value.to_bits().wrapping_add(power.to_bits() << 52)))
    }
    #[inline(always)]
    fn sqrt(self, values: Self::Eight) -> Self::Eight {
        values.map(f64::sqrt)
    }
    #[inline(always)]
    fn larger(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        zip(a, b, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn smaller(self, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        zip(a, b, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn abs(self, values: Self::Eight) -> Self::Eight {
        values.map(f64::abs)
    }
    #[inline(always)]
    fn largest(self, values: Self::Eight) -> f64 {
        values.into_iter().fold(f64::NEG_INFINITY, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn mask(self, bits: LaneBits) -> Self::Mask {
        bits
    }
    #[inline(always)]
    fn and(self, a: Self::Mask, b: Self::Mask) -> Self::Mask {
        a & b
    }
    #[inline(always)]
    fn bits(self, mask: Self::Mask) -> LaneBits {
        mask
    }
    #[inline(always)]
    fn select(self, mask: Self::Mask, a: Self::Eight, b: Self::Eight) -> Self::Eight {
        let mut out = b;
        for lane in 0..LANES {
            if mask >> lane & 1 == 1 {
                out[lane] = a[lane];
            }
        }
        out
    }
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

    #[inline(always)]
    fn packed(self, values: &[u32; LANES], bits: LaneBits) -> [u32; LANES] {
        let (mut packed, mut count) = ([0; LANES], 0);
        for (lane, &value) in values.iter().enumerate() {
            packed[count] = value;
            count += usize::from(bits >> lane & 1);
        }
        packed
    }
}
