//! Deviation between pieces and source, measured from the two surfaces alone, independently of the method
//! that made the pieces.
//!
//! Distances from a solid change no faster than the position (Lipschitz constant 1). A triangle is halved
//! until it is small or cannot contain a larger distance than the largest found; the remaining bounds limit
//! the true maximum.

use crate::inside::Solid;
use crate::piece::Piece;
use crate::polygon::lexicographic;
use nalgebra::Vector3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use pong_import::mesh::{Mesh, bounds};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Distances below this share of the size are rounding.
const NOTHING: f64 = 1e-8;
/// Relative accuracy of the largest distance.
const SHARP: f64 = 1e-4;

/// Distances of one solid's surface from another solid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Distances {
    /// Largest distance found, m.
    pub max_m: f64,
    /// Upper bound of the distance over the whole surface, m.
    pub bound_m: f64,
    /// Point of the largest distance found, m.
    pub at: [f64; 3],
    /// Mean over the surface's area, m.
    pub mean_m: f64,
    /// Share of the area at a distance above zero.
    pub area_share: f64,
}

/// Quality of a decomposition.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Distances of the pieces' active faces outside the source.
    pub protrusion: Distances,
    /// Distances of the source's surface outside the pieces.
    pub deficit: Distances,
    /// Largest distance from the pieces found inside the source, m.
    pub inner_deficit_m: f64,
    /// Share of the source's volume outside all pieces.
    pub deficit_share: f64,
    /// Volume of the pieces outside the source, as a share of the source's.
    pub protruding_share: f64,
    /// Sample points inside the source for the volumes.
    pub places: usize,
}

/// All pieces as one solid.
struct Union<'a> {
    pieces: &'a [Piece],
    boxes: Bvh,
    surface: Solid,
    nothing_m: f64,
}

impl<'a> Union<'a> {
    fn new(pieces: &'a [Piece], nothing_m: f64) -> Option<Self> {
        let margin = Vector3::repeat(nothing_m);
        let vector = |v: Vector3<f64>| parry3d_f64::math::Vector::new(v.x, v.y, v.z);
        let boxes: Vec<Aabb> = pieces
            .iter()
            .map(|piece| Aabb::new(vector(piece.low - margin), vector(piece.high + margin)))
            .collect();
        let mut mesh = Mesh::default();
        pieces.iter().for_each(|piece| mesh.append(&piece.triangles()));
        let boxes = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        Some(Self { pieces, boxes, surface: Solid::new(&mesh)?, nothing_m })
    }

    fn holds(&self, place: &Vector3<f64>) -> bool {
        let vector = parry3d_f64::math::Vector::new(place.x, place.y, place.z);
        let here = Aabb::new(vector, vector);
        let mut near = self.boxes.intersect_aabb(&here);
        near.any(|piece| self.pieces[piece as usize].holds(place, self.nothing_m))
    }

    fn outside_by_m(&self, place: &Vector3<f64>) -> f64 {
        if self.holds(place) { 0.0 } else { self.surface.surface_distance_m(place) }
    }
}

/// Measures pieces against the source with about `samples` places on each surface and in the volume.
pub(crate) fn deviation(source: &Mesh, solid: &Solid, pieces: &[Piece], samples: usize) -> Option<Deviation> {
    let size_m = source.size_m();
    let nothing_m = NOTHING * size_m;
    let union = Union::new(pieces, nothing_m)?;
    let active = active_triangles(pieces);
    let off_source = |place: &Vector3<f64>| drop_rounding(solid.outside_by_m(place), nothing_m);
    let off_pieces = |place: &Vector3<f64>| drop_rounding(union.outside_by_m(place), nothing_m);
    let whole: Vec<[Vector3<f64>; 3]> = (0..source.triangles.len()).map(|t| source.corners(t)).collect();
    let mut deviation = Deviation {
        protrusion: over(&active, samples, SHARP * size_m, &off_source),
        deficit: over(&whole, samples, SHARP * size_m, &off_pieces),
        ..Deviation::default()
    };
    volumes(&mut deviation, source, solid, &union, samples);
    Some(deviation)
}

fn drop_rounding(distance_m: f64, nothing_m: f64) -> f64 {
    if distance_m <= nothing_m { 0.0 } else { distance_m }
}

fn active_triangles(pieces: &[Piece]) -> Vec<[Vector3<f64>; 3]> {
    let mut active = Vec::new();
    for piece in pieces {
        for face in (0..piece.faces.len()).filter(|&face| !piece.inactive[face]) {
            let polygon = piece.polygon(face);
            active.extend((1..polygon.len() - 1).map(|k| [polygon[0], polygon[k], polygon[k + 1]]));
        }
    }
    active
}

fn area_m2([a, b, c]: &[Vector3<f64>; 3]) -> f64 {
    0.5 * (b - a).cross(&(c - a)).norm()
}

/// A part of a triangle, with an upper bound of its distance from the other solid.
struct Patch {
    corners: [Vector3<f64>; 3],
    bound_m: f64,
}

impl PartialEq for Patch {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Patch {}

impl PartialOrd for Patch {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Ordered by bound, ties by position, so that every run has the same order.
impl Ord for Patch {
    fn cmp(&self, other: &Self) -> Ordering {
        let places = || self.corners.iter().zip(&other.corners).map(|(a, b)| lexicographic(a, b));
        self.bound_m
            .total_cmp(&other.bound_m)
            .then_with(|| places().find(|o| o.is_ne()).unwrap_or(Ordering::Equal))
    }
}

/// Distances over triangles: even sampling first, then refinement where the largest may still hide.
fn over(
    triangles: &[[Vector3<f64>; 3]],
    samples: usize,
    sharp_m: f64,
    distance: &dyn Fn(&Vector3<f64>) -> f64,
) -> Distances {
    let total_m2: f64 = triangles.iter().map(area_m2).sum();
    let longest_m = 2.0 * (total_m2 / samples.max(1) as f64).sqrt();
    let mut found = Distances::default();
    let see = |found: &mut Distances, place: &Vector3<f64>| {
        let away_m = distance(place);
        if away_m > found.max_m {
            (found.max_m, found.at) = (away_m, (*place).into());
        }
        away_m
    };
    triangles.iter().flatten().for_each(|corner| _ = see(&mut found, corner));
    let mut patches = Vec::new();
    let mut open: Vec<[Vector3<f64>; 3]> = triangles.iter().rev().copied().collect();
    let (mut moment, mut away_m2) = (0.0, 0.0);
    while let Some(corners) = open.pop() {
        let (halves, length) = halved(&corners);
        if length > longest_m {
            open.extend(halves);
            continue;
        }
        let away_m = patch(&corners, &mut patches, |place| see(&mut found, place));
        let area = area_m2(&corners);
        moment += area * away_m;
        away_m2 += if away_m > 0.0 { area } else { 0.0 };
    }
    (found.mean_m, found.area_share) = (moment / total_m2, away_m2 / total_m2);
    // Largest bound first, for as many steps as the even sampling took.
    let mut work = patches.len();
    let mut patches = BinaryHeap::from(patches);
    let mut settled_m = found.max_m;
    while let Some(next) = patches.pop() {
        if next.bound_m <= found.max_m + sharp_m || work == 0 {
            settled_m = next.bound_m;
            break;
        }
        work -= 1;
        let mut halves = Vec::new();
        for half in halved(&next.corners).0 {
            patch(&half, &mut halves, |place| see(&mut found, place));
        }
        patches.extend(halves);
    }
    found.bound_m = settled_m.max(found.max_m);
    found
}

/// Measures the middle of a patch and adds it to the list.
fn patch(
    corners: &[Vector3<f64>; 3],
    patches: &mut Vec<Patch>,
    see: impl FnOnce(&Vector3<f64>) -> f64,
) -> f64 {
    let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    let away_m = see(&middle);
    let radius = corners.iter().map(|corner| (corner - middle).norm()).fold(0.0, f64::max);
    patches.push(Patch { corners: *corners, bound_m: away_m + radius });
    away_m
}

/// Two halves of a triangle, cut across its longest edge, and that edge's length.
fn halved(corners: &[Vector3<f64>; 3]) -> ([[Vector3<f64>; 3]; 2], f64) {
    let length = |k: usize| (corners[(k + 1) % 3] - corners[k]).norm();
    let longest = (1..3).fold(0, |best, k| if length(k) > length(best) { k } else { best });
    let [a, b, c] = [0, 1, 2].map(|k| corners[(longest + k) % 3]);
    let middle = 0.5 * (a + b);
    ([[a, middle, c], [middle, b, c]], length(longest))
}

/// Volumes by counting points of a low-discrepancy sequence (Roberts' R3) in the common box.
fn volumes(deviation: &mut Deviation, source: &Mesh, solid: &Solid, union: &Union<'_>, samples: usize) {
    let (mut low, mut high) = bounds(&source.vertices);
    for piece in union.pieces {
        (low, high) = (low.inf(&piece.low), high.sup(&piece.high));
    }
    // Reciprocal powers of the real root of x⁴ = x + 1.
    const STEPS: [f64; 3] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_3];
    let (mut missing, mut protruding) = (0usize, 0usize);
    for number in 1..=samples {
        let share = Vector3::from(STEPS.map(|step| (0.5 + step * number as f64).fract()));
        let place = low + (high - low).component_mul(&share);
        match (solid.holds(&place), union.holds(&place)) {
            (true, true) => deviation.places += 1,
            (true, false) => {
                deviation.places += 1;
                missing += 1;
                let away_m = union.surface.surface_distance_m(&place);
                deviation.inner_deficit_m = deviation.inner_deficit_m.max(away_m);
            }
            (false, true) => protruding += 1,
            (false, false) => {}
        }
    }
    let inside = deviation.places.max(1) as f64;
    deviation.deficit_share = missing as f64 / inside;
    deviation.protruding_share = protruding as f64 / inside;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::piece::box_between;

    #[test]
    fn a_cube_beside_its_place_is_off_by_what_it_was_moved() {
        let source = box_between([0.0; 3], [1.0; 3]).triangles();
        let moved = [box_between([0.1, 0.0, 0.0], [1.1, 1.0, 1.0])];
        let solid = Solid::new(&source).unwrap();
        let found = deviation(&source, &solid, &moved, 20_000).unwrap();
        for side in [&found.protrusion, &found.deficit] {
            assert!(
                (side.max_m - 0.1).abs() < 1e-12 && side.bound_m >= 0.1 && side.bound_m < 0.12,
                "{side:?}"
            );
            // One face is off by 0.1, a tenth of four others by 0.05 in the mean.
            assert!((side.area_share - 1.4 / 6.0).abs() < 0.01, "{side:?}");
            assert!((side.mean_m - (0.1 + 0.4 * 0.05) / 6.0).abs() < 0.001, "{side:?}");
        }
        assert!((found.deficit_share - 0.1).abs() < 0.005 && (found.protruding_share - 0.1).abs() < 0.005);
        assert!((found.inner_deficit_m - 0.1).abs() < 0.01);
    }

    #[test]
    fn a_void_within_is_found_though_the_surfaces_agree() {
        let source = box_between([0.0; 3], [3.0; 3]).triangles();
        // Six boxes around an empty unit cube.
        let pieces = [
            box_between([0.0, 0.0, 0.0], [3.0, 3.0, 1.0]),
            box_between([0.0, 0.0, 2.0], [3.0, 3.0, 3.0]),
            box_between([0.0, 0.0, 1.0], [1.0, 3.0, 2.0]),
            box_between([2.0, 0.0, 1.0], [3.0, 3.0, 2.0]),
            box_between([1.0, 0.0, 1.0], [2.0, 1.0, 2.0]),
            box_between([1.0, 2.0, 1.0], [2.0, 3.0, 2.0]),
        ];
        let found = deviation(&source, &Solid::new(&source).unwrap(), &pieces, 20_000).unwrap();
        assert_eq!(found.deficit.max_m, 0.0);
        assert!(found.inner_deficit_m > 0.4 && found.inner_deficit_m <= 0.5, "{found:?}");
        assert!((found.deficit_share - 1.0 / 27.0).abs() < 0.005);
    }
}
