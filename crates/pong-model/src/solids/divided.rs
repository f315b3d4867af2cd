//! Division of a closed mesh into small closed parts, so that a contact need not read the whole mesh.

use pong_geometry::Vec3;
use pong_geometry::overlap::{HalfSpace, Surface};

/// Number of facets up to which a part is not divided.
const FACETS: usize = 24;

/// Share of the facets of a part that the larger half may keep at most. A cut that leaves more is of no use.
const USEFUL: f64 = 0.9;

/// Parts without common volume that together are the solid. Each is cut across the axis along which the halves have
/// the fewest facets, in the middle of its facets.
pub(super) fn divided(whole: Surface) -> Vec<Surface> {
    let mut open = vec![whole];
    let mut parts = Vec::new();
    while let Some(part) = open.pop() {
        match halves(&part) {
            // The lower half comes first.
            Some([lower, upper]) => open.extend([upper, lower]),
            None => parts.push(part),
        }
    }
    parts
}

/// Halves of a part; `None` if it is small or no cut is of use.
fn halves(part: &Surface) -> Option<[Surface; 2]> {
    let extents: Vec<[Vec3; 2]> = part.facets().map(|facet| extent(part.vertices(), facet)).collect();
    if extents.len() <= FACETS {
        return None;
    }
    let cuts = [0, 1, 2].map(|axis| {
        let at = median(&extents, axis);
        let lower = extents.iter().filter(|[low, _]| low[axis] < at).count();
        let upper = extents.iter().filter(|[_, high]| high[axis] > at).count();
        (lower.max(upper), axis, at)
    });
    let &(most, axis, at) = cuts.iter().min_by_key(|(most, ..)| *most)?;
    if most as f64 > USEFUL * extents.len() as f64 {
        return None;
    }
    let lower = HalfSpace { normal_b: Vec3::ith(axis, 1.0), offset: at };
    let halves = [part.cut_by(&lower), part.cut_by(&lower.opposite())];
    let has_facets = |half: &Surface| half.facets().next().is_some();
    halves.iter().all(has_facets).then_some(halves)
}

/// Corners of the box around a facet.
fn extent(vertices: &[Vec3], facet: &[[u32; 2]]) -> [Vec3; 2] {
    let start = |edge: &[u32; 2]| vertices[edge[0] as usize];
    let first = start(&facet[0]);
    facet.iter().map(start).fold([first; 2], |[low, high], p| [low.inf(&p), high.sup(&p)])
}

/// Median of the middles of the boxes along an axis.
fn median(extents: &[[Vec3; 2]], axis: usize) -> f64 {
    let mut middles: Vec<f64> = extents.iter().map(|[low, high]| 0.5 * (low[axis] + high[axis])).collect();
    let half = middles.len() / 2;
    *middles.select_nth_unstable_by(half, f64::total_cmp).1
}
