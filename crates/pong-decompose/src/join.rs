//! Joining of pieces whose union is convex and, above the limit of pieces, of pairs that add the least
//! volume.

use crate::piece::{Piece, hull};
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// A union is convex if its hull exceeds the two volumes by at most this share.
const CONVEX_SHARE: f64 = 1e-7;

/// Joins pieces until no two have a convex union, and at most `pieces_max` are left if that is possible without
/// overlaps. Returns how many joints added volume.
pub(crate) fn join(pieces: &mut Vec<Piece>, pieces_max: usize, margin_m: f64) -> usize {
    let mut pool: Vec<Option<Piece>> = std::mem::take(pieces).into_iter().map(Some).collect();
    let mut pairs: BTreeMap<(usize, usize), Piece> = BTreeMap::new();
    for index in 0..pool.len() {
        add_pairs(&mut pairs, &pool, index, margin_m);
    }
    let mut forced = 0;
    loop {
        let count = pool.iter().flatten().count();
        let Some((a, b)) = next_pair(&pairs, &pool, count > pieces_max, margin_m) else { break };
        let Some(union) = pairs.remove(&(a, b)) else { break };
        forced += usize::from(!is_convex_union(&union, &pool, a, b));
        pairs.retain(|&(i, j), _| ![i, j].contains(&a) && ![i, j].contains(&b));
        pool[b] = None;
        pool[a] = Some(union);
        add_pairs(&mut pairs, &pool, a, margin_m);
    }
    pieces.extend(pool.into_iter().flatten());
    forced
}

/// The hulls of a piece with each of its neighbours.
fn add_pairs(
    pairs: &mut BTreeMap<(usize, usize), Piece>,
    pool: &[Option<Piece>],
    index: usize,
    margin_m: f64,
) {
    let Some(piece) = &pool[index] else { return };
    for (other, neighbor) in pool.iter().enumerate().filter(|(other, _)| *other != index) {
        let key = (index.min(other), index.max(other));
        let Some(neighbor) = neighbor.as_ref().filter(|neighbor| neighbor.is_near(piece, margin_m)) else {
            continue;
        };
        if pairs.contains_key(&key) {
            continue;
        }
        let points: Vec<Vector3<f64>> = piece.vertices.iter().chain(&neighbor.vertices).copied().collect();
        if let Ok(union) = hull(&points) {
            pairs.insert(key, union);
        }
    }
}

fn added_m3(union: &Piece, pool: &[Option<Piece>], a: usize, b: usize) -> f64 {
    let volume = |index: usize| pool[index].as_ref().map_or(0.0, |piece| piece.volume_m3);
    union.volume_m3 - volume(a) - volume(b)
}

fn is_convex_union(union: &Piece, pool: &[Option<Piece>], a: usize, b: usize) -> bool {
    added_m3(union, pool, a, b) <= CONVEX_SHARE * union.volume_m3
}

/// Pair that adds the least volume; ties go to the lowest indices.
fn next_pair(
    pairs: &BTreeMap<(usize, usize), Piece>,
    pool: &[Option<Piece>],
    too_many: bool,
    margin_m: f64,
) -> Option<(usize, usize)> {
    let mut ranked: Vec<(f64, (usize, usize))> = pairs
        .iter()
        .map(|(&(a, b), union)| (added_m3(union, pool, a, b), (a, b)))
        .filter(|&(_, (a, b))| too_many || is_convex_union(&pairs[&(a, b)], pool, a, b))
        .collect();
    ranked.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
    let free = |&(a, b): &(usize, usize)| {
        let others = pool.iter().enumerate().filter(|(index, _)| *index != a && *index != b);
        is_convex_union(&pairs[&(a, b)], pool, a, b)
            || !others
                .filter_map(|(_, piece)| piece.as_ref())
                .any(|other| pairs[&(a, b)].overlaps(other, margin_m))
    };
    ranked.into_iter().map(|(_, pair)| pair).find(free)
}
