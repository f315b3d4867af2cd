//! Bit-equal positions are one vertex. Public for `pong-import`, which welds by the same rule; no stable interface.

use pong_geometry::Vec3;
use rustc_hash::FxBuildHasher;
use std::collections::HashMap;

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

/// A map with a quick hash, the same on every machine. Nothing depends on the order of its entries.
pub type WordMap<K, V> = HashMap<K, V, FxBuildHasher>;

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
