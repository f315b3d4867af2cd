//! Bit-equal vertices where pieces meet: the loader recognises common edges by them.

use crate::piece::Piece;
use crate::polygon::{Polygon, lexicographic, plane_of};
use nalgebra::Vector3;
use pong_import::mesh::ring;
use std::collections::BTreeMap;

/// Points within this share of the whole's size are merged.
const SAME_SHARE: f64 = 1e-9;

/// Pool of points with look-up within a tolerance.
pub(crate) struct Pool {
    same_m: f64,
    cells: BTreeMap<[i64; 3], Vec<Vector3<f64>>>,
}

impl Pool {
    pub(crate) fn new(size_m: f64) -> Self {
        Self::within(SAME_SHARE * size_m)
    }

    pub(crate) fn within(same_m: f64) -> Self {
        Self { same_m, cells: BTreeMap::new() }
    }

    /// The vertices of all pieces.
    pub(crate) fn of(pieces: &[Piece], size_m: f64) -> Self {
        let mut pool = Self::new(size_m);
        for place in pieces.iter().flat_map(|piece| &piece.vertices) {
            pool.place(*place);
        }
        pool
    }

    /// Nearest known point within the tolerance; otherwise adds `place` and returns it.
    pub(crate) fn place(&mut self, place: Vector3<f64>) -> Vector3<f64> {
        let home = self.home(&place);
        let near = (0..27).map(|k| [home[0] + k % 3 - 1, home[1] + k / 3 % 3 - 1, home[2] + k / 9 - 1]);
        let distance = |seen: &Vector3<f64>| (seen - place).norm();
        let close = near.filter_map(|cell| self.cells.get(&cell)).flatten().copied();
        let close = close.filter(|seen| distance(seen) <= self.same_m);
        if let Some(seen) = close.min_by(|a, b| distance(a).total_cmp(&distance(b))) {
            return seen;
        }
        self.add(place);
        place
    }

    /// Adds a new point, however near to others.
    pub(crate) fn add(&mut self, place: Vector3<f64>) {
        let home = self.home(&place);
        self.cells.entry(home).or_default().push(place);
    }

    fn home(&self, place: &Vector3<f64>) -> [i64; 3] {
        place.map(|x| (x / (4.0 * self.same_m)).floor() as i64).into()
    }

    pub(crate) fn polygon(&mut self, polygon: Polygon) -> Polygon {
        let mut polygon: Polygon = polygon.into_iter().map(|place| self.place(place)).collect();
        polygon.dedup();
        while polygon.len() > 1 && polygon.first() == polygon.last() {
            polygon.pop();
        }
        polygon
    }

    pub(crate) fn canonical(&mut self, mut piece: Piece) -> Piece {
        piece.vertices.iter_mut().for_each(|place| *place = self.place(*place));
        piece
    }
}

/// Gives the pieces these faces (outline, inactive) with their neighbours' vertices inserted in the edges.
/// Returns the pieces that keep their old faces because the new ones would not close or are not `accepted`.
pub(crate) fn stitch(
    pieces: &mut [Piece],
    faces: &[Vec<(Polygon, bool)>],
    size_m: f64,
    accepted: &dyn Fn(&Piece) -> bool,
) -> Vec<usize> {
    let same_m = SAME_SHARE * size_m;
    let places: Vec<Vec<Vector3<f64>>> =
        faces.iter().map(|faces| faces.iter().flat_map(|(polygon, _)| polygon).copied().collect()).collect();
    let mut kept = Vec::new();
    for index in 0..pieces.len() {
        let near = (0..pieces.len()).filter(|&other| pieces[other].is_near(&pieces[index], same_m));
        let mut on_rims: Vec<Vector3<f64>> = near.flat_map(|other| places[other].iter().copied()).collect();
        on_rims.sort_by(lexicographic);
        on_rims.dedup();
        let with_places: Vec<(Polygon, bool)> = faces[index]
            .iter()
            .map(|(polygon, inactive)| (with_vertices(polygon, &on_rims, same_m), *inactive))
            .collect();
        let stitched = indexed(&with_places).map(|(vertices, outlines)| Piece {
            inactive: with_places.iter().map(|(_, inactive)| *inactive).collect(),
            planes: with_places.iter().map(|(polygon, _)| plane_of(polygon)).collect(),
            vertices,
            faces: outlines,
            ..pieces[index].clone()
        });
        match stitched.filter(accepted) {
            Some(piece) => pieces[index] = piece,
            None => kept.push(index),
        }
    }
    kept
}

/// An outline with the points that lie within its edges inserted, in order.
pub(crate) fn with_vertices(polygon: &[Vector3<f64>], places: &[Vector3<f64>], same_m: f64) -> Polygon {
    let mut outline = Polygon::new();
    for (a, b) in ring(polygon) {
        outline.push(a);
        // Measured from the same end for both faces of an edge.
        let forward = lexicographic(&a, &b).is_le();
        let (start, end) = if forward { (a, b) } else { (b, a) };
        let length = (end - start).norm();
        let along = (end - start) / length;
        let from = places.partition_point(|place| place.x < start.x - same_m);
        let reachable = places[from..].iter().take_while(|place| place.x <= end.x + same_m);
        let mut within: Vec<(f64, Vector3<f64>)> = reachable
            .map(|place| (along.dot(&(place - start)), *place))
            .filter(|(t, place)| {
                *t > same_m && *t < length - same_m && (place - start - along * *t).norm() <= same_m
            })
            .collect();
        within.sort_by(|x, y| x.0.total_cmp(&y.0));
        if !forward {
            within.reverse();
        }
        outline.extend(within.into_iter().map(|(_, place)| place));
    }
    outline
}

type Indexed = (Vec<Vector3<f64>>, Vec<Vec<u32>>);

/// Vertices and outlines, if every edge has its opposite.
fn indexed(faces: &[(Polygon, bool)]) -> Option<Indexed> {
    let mut numbers: BTreeMap<[u64; 3], u32> = BTreeMap::new();
    let mut vertices = Vec::new();
    let mut numbered = |place: &Vector3<f64>| {
        *numbers.entry([place.x, place.y, place.z].map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
            vertices.push(*place);
            (vertices.len() - 1) as u32
        })
    };
    let outlines: Vec<Vec<u32>> =
        faces.iter().map(|(polygon, _)| polygon.iter().map(&mut numbered).collect()).collect();
    let mut edges: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    outlines.iter().flat_map(|outline| ring(outline)).for_each(|edge| *edges.entry(edge).or_default() += 1);
    let closed = edges.iter().all(|(&(a, b), &count)| a != b && count == 1 && edges.get(&(b, a)) == Some(&1));
    (closed && outlines.iter().all(|outline| outline.len() > 2)).then_some((vertices, outlines))
}
