//! Merging of bit-equal positions into one vertex. Public for `pong-import`, which uses the same rule; not a
//! stable interface.

use pong_geometry::Vec3;
use rustc_hash::FxBuildHasher;
use std::collections::HashMap;

/// Bits of a position; −0 and 0 are the same.
pub type PositionKey = [u64; 3];

/// Key of a position.
pub fn position_key(p: &Vec3) -> PositionKey {
    [(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits(), (p.z + 0.0).to_bits()]
}

/// Position without negative zeros.
pub fn without_negative_zero(p: Vec3) -> Vec3 {
    p.map(|x| x + 0.0)
}

/// Hash map with a fast hash that is the same on every machine. Nothing depends on the order of its entries.
pub type WordMap<K, V> = HashMap<K, V, FxBuildHasher>;

/// Numbers distinct positions in the order of first use.
#[derive(Default)]
pub struct Welder {
    numbers: WordMap<PositionKey, u32>,
}

impl Welder {
    /// Number of a position; a new position is appended to `vertices`.
    pub fn weld(&mut self, position: Vec3, vertices: &mut Vec<Vec3>) -> u32 {
        *self.numbers.entry(position_key(&position)).or_insert_with(|| {
            vertices.push(without_negative_zero(position));
            (vertices.len() - 1) as u32
        })
    }
}
