//! Places that are bit-equal in the file become one vertex: glTF and STL write a vertex once per normal or triangle.

use crate::number::widened;
use nalgebra::Vector3;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// Mixes words; nothing depends on the order of a map's entries.
#[derive(Default)]
pub(crate) struct WordHasher(u64);

impl Hasher for WordHasher {
    fn finish(&self) -> u64 {
        self.0 ^ (self.0 >> 32)
    }

    fn write(&mut self, bytes: &[u8]) {
        for chunk in bytes.chunks(8) {
            let mut word = [0; 8];
            word[..chunk.len()].copy_from_slice(chunk);
            self.write_u64(u64::from_le_bytes(word));
        }
    }

    fn write_u32(&mut self, word: u32) {
        self.write_u64(u64::from(word));
    }

    fn write_usize(&mut self, word: usize) {
        self.write_u64(word as u64);
    }

    fn write_i64(&mut self, word: i64) {
        self.write_u64(word as u64);
    }

    fn write_u64(&mut self, word: u64) {
        let mixed = (self.0.rotate_left(26) ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        self.0 = mixed ^ (mixed >> 29);
    }
}

pub(crate) type WordMap<K, V> = HashMap<K, V, BuildHasherDefault<WordHasher>>;

/// Gives distinct places of single precision numbers in the order of first use.
#[derive(Default)]
pub(crate) struct Welder {
    numbers: WordMap<[u32; 3], u32>,
    pub(crate) vertices: Vec<Vector3<f64>>,
}

impl Welder {
    pub(crate) fn with_capacity(places: usize) -> Self {
        let mut welder = Self::default();
        welder.numbers.reserve(places);
        welder
    }

    /// The number of a place; −0 and 0 are the same.
    pub(crate) fn weld(&mut self, place: [f32; 3]) -> u32 {
        let key = place.map(|x| (x + 0.0).to_bits());
        let vertices = &mut self.vertices;
        *self.numbers.entry(key).or_insert_with(|| {
            vertices.push(Vector3::from(place.map(|x| widened(x + 0.0))));
            (vertices.len() - 1) as u32
        })
    }
}
