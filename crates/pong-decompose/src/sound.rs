//! Pieces that the loader accepts.
//!
//! The loader merges neighbouring faces that are coplanar within 1e-6 of the diameter, and refuses the result
//! if its outline is not convex. On smooth shapes this is caused by vertices that stand out by almost
//! nothing, so these are left out.

use crate::piece::{Piece, hull};
use crate::polygon::lexicographic;
use crate::seams::Pool;
use nalgebra::Vector3;

/// Vertices that stand out by less than this share of a piece's box may be left out.
const FLAT_SHARE: f64 = 1e-5;

/// Changes made to the pieces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Changes {
    /// Vertices left out.
    pub(crate) flat: usize,
    /// Pieces in which vertices within `welded_m` were merged, because nothing less helped.
    pub(crate) welded: usize,
    /// Largest distance of merged vertices, m.
    pub(crate) welded_m: f64,
}

/// Makes the smallest changes with which all pieces are accepted.
pub(crate) fn make(pieces: &mut [Piece], size_m: f64, accepted: &dyn Fn(&Piece) -> bool) -> Changes {
    let mut changes = Changes::default();
    let mut left_out: Vec<Vector3<f64>> = Vec::new();
    for piece in pieces.iter_mut() {
        if accepted(piece) {
            continue;
        }
        if let Some((simpler, gone)) = without_flat_vertices(piece, accepted) {
            left_out.extend(gone);
            *piece = simpler;
        } else if let Some((simpler, within_m)) = welded(piece, size_m, accepted) {
            changes.welded += 1;
            changes.welded_m = changes.welded_m.max(within_m);
            *piece = simpler;
        }
    }
    left_out.sort_by(lexicographic);
    left_out.dedup();
    changes.flat = left_out.len();
    // Neighbours lose them too, so that common faces stay alike.
    for piece in pieces {
        for place in &left_out {
            if let Some(simpler) = without(piece, place).filter(accepted) {
                *piece = simpler;
            }
        }
    }
    changes
}

/// The piece without a vertex, if the vertex stands out by almost nothing.
fn without(piece: &Piece, place: &Vector3<f64>) -> Option<Piece> {
    standing_out(piece, place).filter(|(height_m, _)| *height_m <= limit_m(piece)).map(|(_, rest)| rest)
}

fn limit_m(piece: &Piece) -> f64 {
    FLAT_SHARE * (piece.high - piece.low).norm()
}

/// Height of a vertex above the hull of the others, m, and that hull.
fn standing_out(piece: &Piece, place: &Vector3<f64>) -> Option<(f64, Piece)> {
    let others: Vec<Vector3<f64>> = piece.vertices.iter().copied().filter(|vertex| vertex != place).collect();
    if others.len() == piece.vertices.len() {
        return None;
    }
    let rest = hull(&others).ok()?;
    let height_m = rest.planes.iter().map(|plane| plane.height(place)).fold(0.0, f64::max);
    Some((height_m, rest))
}

/// Leaves out the flattest vertices, one after the other, until the piece is accepted.
fn without_flat_vertices(
    piece: &Piece,
    accepted: &dyn Fn(&Piece) -> bool,
) -> Option<(Piece, Vec<Vector3<f64>>)> {
    let height = |place: &Vector3<f64>| Some((standing_out(piece, place)?.0, *place));
    let mut flattest: Vec<(f64, Vector3<f64>)> = piece.vertices.iter().filter_map(height).collect();
    flattest.retain(|(height_m, _)| *height_m <= limit_m(piece));
    flattest.sort_by(|a, b| a.0.total_cmp(&b.0).then(lexicographic(&a.1, &b.1)));
    let (mut simpler, mut gone) = (piece.clone(), Vec::new());
    for (_, place) in flattest {
        let Some(rest) = without(&simpler, &place) else { continue };
        simpler = rest;
        gone.push(place);
        if accepted(&simpler) {
            return Some((simpler, gone));
        }
    }
    None
}

/// Merges vertices that are close together; the last resort.
fn welded(piece: &Piece, size_m: f64, accepted: &dyn Fn(&Piece) -> bool) -> Option<(Piece, f64)> {
    [1e-6, 1e-5, 1e-4, 1e-3].into_iter().map(|share| share * size_m).find_map(|within_m| {
        let mut pool = Pool::within(within_m);
        let points: Vec<Vector3<f64>> = piece.vertices.iter().map(|place| pool.place(*place)).collect();
        let simpler = hull(&points).ok().filter(|simpler| accepted(simpler))?;
        Some((simpler, within_m))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners() -> Vec<Vector3<f64>> {
        (0..8).map(|k| Vector3::from_fn(|axis, _| f64::from(k >> axis & 1))).collect()
    }

    /// A unit cube with a vertex above its top.
    fn bumped(height_m: f64) -> Piece {
        let mut points = corners();
        points.push(Vector3::new(0.4, 0.5, 1.0 + height_m));
        hull(&points).unwrap()
    }

    #[test]
    fn only_vertices_that_hardly_stand_out_are_left_out() {
        let is_cube = |piece: &Piece| piece.vertices.len() == 8;
        let mut pieces = [bumped(1e-5), hull(&corners()).unwrap()];
        assert_eq!(pieces[0].vertices.len(), 9);
        assert_eq!(make(&mut pieces, 1.7, &is_cube), Changes { flat: 1, ..Changes::default() });
        assert_eq!([pieces[0].faces.len(), pieces[1].faces.len()], [6, 6]);
        let mut high = [bumped(0.1)];
        assert_eq!(make(&mut high, 1.7, &is_cube), Changes::default());
        assert_eq!(high[0].vertices.len(), 9);
    }

    #[test]
    fn accepted_pieces_stay_as_they_are() {
        let mut pieces = [bumped(1e-5)];
        assert_eq!(make(&mut pieces, 1.7, &|_| true), Changes::default());
        assert_eq!(pieces[0].vertices.len(), 9);
    }
}
