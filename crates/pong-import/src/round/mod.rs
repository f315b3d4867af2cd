//! Recognition of round parts of a mesh: capsule, cylinder, cone, or the wall of a bore, within a tolerance.
//!
//! A candidate for the axis comes from the areas and normals of the part (`axes`). The wall is fitted to the
//! vertices by least squares (`fit`), and the ends to the flat triangles there. The distance of the mesh from
//! the primitive (`measure`) alone decides: a bad candidate is refused.

mod axes;
mod fit;
mod frame;
mod measure;
mod shape;

use crate::mesh::{Adjacency, Mesh, volume_m3};
use fit::Fit;

pub use shape::{Kind, Recognised, Round};

/// A part with fewer points around the axis is meant as a prism: a box, a hexagon.
const SIDES_MIN: usize = 8;

/// The round primitive that a connected part matches within a tolerance, if any: a solid if the part is
/// closed and faces outwards, a bore if it is open at two ends and faces its axis.
pub fn recognise(part: &Mesh, tolerance_m: f64) -> Option<Recognised> {
    let edges = Adjacency::new(&part.triangles);
    if !edges.crowded.is_empty() || !edges.wound_against.is_empty() {
        return None;
    }
    let kinds: &[Kind] = match (edges.is_closed(), volume_m3(part) > 0.0) {
        (true, true) => &[Kind::Cylinder, Kind::Capsule, Kind::Cone],
        (true, false) => return None,
        (false, _) => &[Kind::Bore],
    };
    let candidates = axes::candidates(part);
    let best = |kind: Kind| {
        let fits = candidates.iter().filter_map(|frame| fit::fitted(part, &edges, frame, kind, tolerance_m));
        let judged = fits.filter_map(|fit| judged(part, &edges, fit, tolerance_m));
        judged.min_by(|a, b| a.farthest_m.total_cmp(&b.farthest_m))
    };
    // A cone of equal radii is a cylinder, but fits noise slightly better.
    let (plain, last) = kinds.split_at(kinds.len() - 1);
    let plain = plain.iter().filter_map(|&kind| best(kind));
    plain.min_by(|a, b| a.farthest_m.total_cmp(&b.farthest_m)).or_else(|| best(last[0]))
}

/// Accepts a fit if the mesh is near the primitive everywhere, surrounds its axis and covers all of it.
fn judged(part: &Mesh, edges: &Adjacency, fit: Fit, tolerance_m: f64) -> Option<Recognised> {
    let Fit { round, frame } = fit;
    if !measure::goes_around(part, &frame, SIDES_MIN) {
        return None;
    }
    let farthest_m = measure::farthest_m(part, &round);
    // NaN is not within the tolerance.
    let near = farthest_m <= tolerance_m;
    let whole = match round.kind {
        Kind::Bore => measure::is_wall_of_hole(part, edges, &round, &frame, tolerance_m),
        _ => measure::has_volume(part, &round, tolerance_m),
    };
    (near && whole).then_some(Recognised { round, farthest_m })
}
