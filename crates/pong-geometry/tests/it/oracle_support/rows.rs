//! Batches of pairs in which several consecutive pairs have the same element.

use crate::common::{Random, levels};
use pong_geometry::primitive::TriangleSet;
use pong_geometry::simd::{Kernel, LANES, Level, Simd, run, set_level};
use std::fmt::Debug;

/// Batch of up to eight pairs of an element and a triangle.
pub trait Pairs: Default {
    type Element;
    /// Classification of the pairs.
    type Told: PartialEq + Debug;
    fn begin_in<S: Simd>(&mut self, simd: S, element: &Self::Element, thickness: f64);
    fn push(&mut self, triangle: u32) -> usize;
    fn add(&mut self, element: &Self::Element, triangle: u32, thickness: f64) -> usize;
    fn take(&mut self, set: &TriangleSet) -> Self::Told;
}

struct Begin<'a, P: Pairs>(&'a mut P, &'a P::Element, f64);

impl<P: Pairs> Kernel for Begin<'_, P> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        self.0.begin_in(simd, self.1, self.2);
    }
}

/// Pairs pushed after their element are classified like those added together with it, whatever their lanes
/// held before, and at every instruction-set level. `draw` gives an element, a triangle near it and a
/// thickness; returns the classifications.
pub fn tell_in_rows<P: Pairs>(
    set: &TriangleSet,
    random: &mut Random,
    draw: impl Fn(&mut Random) -> (P::Element, u32, f64),
) -> Vec<P::Told> {
    let (mut one_by_one, mut in_a_row) = (P::default(), P::default());
    let mut all = Vec::new();
    let _turn = levels::Turn::wait();
    for round in 0..200 {
        set_level(Level::available().nth(round % Level::available().count()).unwrap());
        let mut left = LANES;
        while left > 0 {
            let (element, there, thickness) = draw(random);
            let row = 1 + random.bits() as usize % left;
            run(Begin(&mut in_a_row, &element, thickness));
            for number in 0..row {
                let triangle = (there + number as u32) % set.triangles.len() as u32;
                assert_eq!(in_a_row.push(triangle), one_by_one.add(&element, triangle, thickness));
            }
            left -= row;
        }
        let told = one_by_one.take(set);
        assert_eq!(in_a_row.take(set), told);
        all.push(told);
    }
    all
}
