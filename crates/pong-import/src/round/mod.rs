//! Parts of a mesh that are round: a capsule, a cylinder, a cone, or the wall of a bore, within a tolerance.
//!
//! A candidate for the axis comes from the areas and normals of the part (`axes`). The wall is fitted to the vertices by least
//! squares (`fit`), and the ends to the flat triangles there. What counts in the end is only how far the mesh is from the
//! primitive (`measure`): a bad candidate is refused by that, never taken.

mod axes;
mod fit;
mod frame;
mod measure;
mod shape;

use crate::mesh::{Adjacency, Mesh, volume_m3};
use fit::Fit;

pub use shape::{Kind, Recognised, Round};

/// Fewer places around the axis are a prism that is meant as one: a box, a hexagon.
const SIDES_MIN: usize = 8;

/// The round primitive that a connected part is within a tolerance, if it is one: a solid if it is closed and faces outwards, a
/// bore if it is open at two ends and faces its axis.
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
    // A cone of equal radii is a cylinder, and fits noise a little better.
    let (plain, last) = kinds.split_at(kinds.len() - 1);
    let plain = plain.iter().filter_map(|&kind| best(kind));
    plain.min_by(|a, b| a.farthest_m.total_cmp(&b.farthest_m)).or_else(|| best(last[0]))
}

/// Whether the mesh is that primitive: near it everywhere, all around it, and all of it.
fn judged(part: &Mesh, edges: &Adjacency, fit: Fit, tolerance_m: f64) -> Option<Recognised> {
    let Fit { round, frame } = fit;
    if !measure::goes_around(part, &frame, SIDES_MIN) {
        return None;
    }
    let farthest_m = measure::farthest_m(part, &round);
    // Not a number is not within the tolerance.
    let near = farthest_m <= tolerance_m;
    let whole = match round.kind {
        Kind::Bore => measure::is_wall_of_hole(part, edges, &round, &frame, tolerance_m),
        _ => measure::has_volume(part, &round, tolerance_m),
    };
    (near && whole).then_some(Recognised { round, farthest_m })
}
