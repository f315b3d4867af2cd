//! Bit-equal positions are one vertex. Public for `pong-import`, which welds by the same rule; no stable interface.

use pong_geometry::Vec3;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// Bits of a position; −0 and 0 are the same.
pub type PositionKey = [u64; 3];

/// The key of a position.
pub fn position_key(p: &Vec3) -> PositionKey {
    [(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits(), (p.z + 0.0).to_bits()]
}

/// A position without negative zeros.
pub fn without_negative_zero(p: Vec3) -> Vec3 {
    p.map(|x| x + 0.0)
}

/// Mixes words; quick, and the same on every machine. Nothing depends on the order of a map's entries.
#[derive(Clone, Copy, Default)]
pub struct WordHasher(u64);

impl Hasher for WordHasher {
    fn finish(&self) -> u64 {
        self.0 ^ (self.0 >> 32)
    }

    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u64(u64::from(byte));
        }
    }

    fn write_u32(&mut self, word: u32) {
        self.write_u64(u64::from(word));
    }

    fn write_usize(&mut self, word: usize) {
        self.write_u64(word as u64);
    }

    fn write_u64(&mut self, word: u64) {
        let mixed = (self.0.rotate_left(26) ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        self.0 = mixed ^ (mixed >> 29);
    }
}

/// A map that hashes with [`WordHasher`].
pub type WordMap<K, V> = HashMap<K, V, BuildHasherDefault<WordHasher>>;

/// Gives every distinct position a number, in the order of first use.
#[derive(Default)]
pub struct Welder {
    numbers: WordMap<PositionKey, u32>,
}

impl Welder {
    /// The number of a position, which is pushed to `vertices` when it is new.
    pub fn weld(&mut self, position: Vec3, vertices: &mut Vec<Vec3>) -> u32 {
        *self.numbers.entry(position_key(&position)).or_insert_with(|| {
            vertices.push(without_negative_zero(position));
            (vertices.len() - 1) as u32
        })
    }
}
