//! Merging of positions that are bit-equal in the file: glTF and STL repeat a vertex for each normal or
//! triangle.

use crate::number::widened;
use nalgebra::Vector3;
use pong_model::weld::WordMap;

/// Distinct single-precision positions in the order of first use. They are compared before they are widened:
/// widening costs more than the look-up, and most positions are repeated.
#[derive(Default)]
pub(crate) struct Welder {
    numbers: WordMap<[u32; 3], u32>,
    wide: pong_model::weld::Welder,
    pub(crate) vertices: Vec<Vector3<f64>>,
}

impl Welder {
    /// Index of a position; −0 and 0 are the same.
    pub(crate) fn weld(&mut self, place: [f32; 3]) -> u32 {
        let key = place.map(|x| (x + 0.0).to_bits());
        let vertices = &mut self.vertices;
        *self.numbers.entry(key).or_insert_with(|| {
            vertices.push(Vector3::from(place.map(|x| widened(x + 0.0))));
            (vertices.len() - 1) as u32
        })
    }

    /// Index of a position of double precision.
    pub(crate) fn weld_wide(&mut self, place: Vector3<f64>) -> u32 {
        self.wide.weld(place, &mut self.vertices)
    }
}
