//! One convex piece, and the convex hull of points.

use crate::polygon::{Plane, Polygon, clip, is_wide, plane_of};
use nalgebra::{Matrix3, Vector3};
use pong_import::mesh::{self, Flaw, Mesh, Polyhedron, bounds, ring};
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Point sets flatter than this (spread along one direction over that along another) are stretched before the
/// hull.
const FLAT_SPREAD: f64 = 0.03;
/// Point sets flatter than this are no solid.
const NO_SPREAD: f64 = 1e-7;

/// A convex solid of polygons.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    pub(crate) vertices: Vec<Vector3<f64>>,
    pub(crate) faces: Vec<Vec<u32>>,
    /// True for each internal (inactive) face.
    pub(crate) inactive: Vec<bool>,
    pub(crate) planes: Vec<Plane>,
    pub(crate) low: Vector3<f64>,
    pub(crate) high: Vector3<f64>,
    pub(crate) volume_m3: f64,
}

/// Reasons why points have no solid hull.
#[derive(Debug)]
pub(crate) enum NoHull {
    /// The points lie in a plane.
    Flat,
    /// The hull is damaged.
    Failed,
}

impl Piece {
    pub(crate) fn new(solid: Polyhedron) -> Self {
        let Polyhedron { vertices, faces, .. } = solid;
        let (low, high) = bounds(&vertices);
        let inactive = vec![false; faces.len()];
        let mut piece = Self { vertices, faces, inactive, planes: Vec::new(), low, high, volume_m3: 0.0 };
        piece.planes = (0..piece.faces.len()).map(|face| plane_of(&piece.polygon(face))).collect();
        piece.volume_m3 = mesh::volume_m3(&piece.triangles());
        piece
    }

    /// The corners of a face, m.
    pub(crate) fn polygon(&self, face: usize) -> Polygon {
        self.faces[face].iter().map(|&vertex| self.vertices[vertex as usize]).collect()
    }

    /// Triangle fans over all faces.
    pub(crate) fn triangles(&self) -> Mesh {
        let fan = |face: &Vec<u32>| {
            let face = face.clone();
            (1..face.len() - 1).map(move |k| [face[0], face[k], face[k + 1]])
        };
        let triangles: Vec<[u32; 3]> = self.faces.iter().flat_map(fan).collect();
        Mesh { vertices: self.vertices.clone(), look_of: vec![0; triangles.len()], triangles }
    }

    /// Tests whether the bounding boxes come within a distance.
    pub(crate) fn is_near(&self, other: &Self, margin_m: f64) -> bool {
        (0..3).all(|axis| {
            self.low[axis] <= other.high[axis] + margin_m && other.low[axis] <= self.high[axis] + margin_m
        })
    }

    /// Tests whether a point is inside, or less than `margin_m` outside every face's plane.
    pub(crate) fn holds(&self, place: &Vector3<f64>, margin_m: f64) -> bool {
        self.planes.iter().all(|plane| plane.height(place) <= margin_m)
    }

    /// Tests whether the pieces overlap by more than `margin_m`.
    pub(crate) fn overlaps(&self, other: &Self, margin_m: f64) -> bool {
        if !self.is_near(other, -margin_m) {
            return false;
        }
        let reaches_into = |from: &Self, into: &Self| {
            (0..from.faces.len()).any(|face| {
                let inside = into
                    .planes
                    .iter()
                    .fold(from.polygon(face), |rest, plane| clip(&rest, &plane.shifted(-margin_m)));
                inside.len() > 2 && is_wide(&inside, margin_m)
            })
        };
        let within = |inner: &Self, outer: &Self| inner.vertices.iter().all(|v| outer.holds(v, -margin_m));
        reaches_into(self, other) || reaches_into(other, self) || within(self, other) || within(other, self)
    }

    /// Both sides of a plane that passes through the piece.
    pub(crate) fn cut(&self, plane: &Plane) -> Option<[Self; 2]> {
        let mut sides = [Vec::new(), Vec::new()];
        for face in 0..self.faces.len() {
            for (a, b) in ring(&self.polygon(face)) {
                let (height_a, height_b) = (plane.height(&a), plane.height(&b));
                if height_a <= 0.0 {
                    sides[0].push(a);
                }
                if height_a >= 0.0 {
                    sides[1].push(a);
                }
                if (height_a < 0.0 && height_b > 0.0) || (height_a > 0.0 && height_b < 0.0) {
                    let place = plane.crossing(&a, &b);
                    sides.iter_mut().for_each(|side| side.push(place));
                }
            }
        }
        let [below, above] = sides.map(|side| hull(&side).ok());
        Some([below?, above?])
    }
}

/// Convex hull of points with coplanar triangles merged; its vertices are input points, bit for bit.
pub(crate) fn hull(points: &[Vector3<f64>]) -> Result<Piece, NoHull> {
    let mut points = points.to_vec();
    points.sort_by(crate::polygon::lexicographic);
    points.dedup();
    if points.len() < 4 {
        return Err(NoHull::Flat);
    }
    let (mean, spread) = principal_spread(&points);
    let largest = spread.column_iter().map(|axis| axis.norm()).fold(0.0, f64::max);
    let least = spread.column_iter().map(|axis| axis.norm()).fold(f64::INFINITY, f64::min);
    if least <= NO_SPREAD * largest {
        return Err(NoHull::Flat);
    }
    let plain = points.iter().map(|place| (place - mean) / largest);
    // Affine maps preserve hulls; flat sets are more robust when stretched to a round shape.
    let round = |place: &Vector3<f64>| {
        Vector3::from_fn(|axis, _| {
            let along = spread.column(axis);
            along.dot(&(place - mean)) / along.norm_squared()
        })
    };
    if least > FLAT_SPREAD * largest
        && let Ok(piece) = mapped_hull(&points, plain.collect())
    {
        return Ok(piece);
    }
    let mirrored = spread.determinant() < 0.0;
    let round: Vec<Vector3<f64>> =
        points.iter().map(|place| if mirrored { -round(place) } else { round(place) }).collect();
    // Many coplanar points can make the hull fail: retries move each point by far less than a plane's
    // tolerance.
    let attempts = [0.0, 1e-11, 1e-10, 1e-9].into_iter().map(|by| {
        mapped_hull(
            &points,
            round.iter().enumerate().map(|(number, place)| place + joggle(number) * by).collect(),
        )
    });
    let mut last = Err(NoHull::Failed);
    for attempt in attempts {
        last = attempt;
        if last.is_ok() {
            break;
        }
    }
    last
}

/// Evenly scattered point in the cube from −1 to 1.
fn joggle(number: usize) -> Vector3<f64> {
    let turn = |step: f64| 2.0 * (step * (number + 1) as f64).fract() - 1.0;
    Vector3::new(turn(0.754_877_666_246_692_8), turn(0.569_840_290_998_053_2), turn(0.618_033_988_749_894_9))
}

/// Mean, and the principal axes scaled by the standard deviations along them.
fn principal_spread(points: &[Vector3<f64>]) -> (Vector3<f64>, Matrix3<f64>) {
    let first = points[0];
    let mean = first + points.iter().map(|place| place - first).sum::<Vector3<f64>>() / points.len() as f64;
    let covariance =
        points.iter().map(|place| (place - mean) * (place - mean).transpose()).sum::<Matrix3<f64>>()
            / points.len() as f64;
    let eigen = covariance.symmetric_eigen();
    // Deviations are computed from the points: the least eigenvalue would drown in rounding.
    let along = |axis: Vector3<f64>| {
        let sum: f64 = points.iter().map(|place| axis.dot(&(place - mean)).powi(2)).sum();
        axis * (sum / points.len() as f64).sqrt().max(f64::MIN_POSITIVE)
    };
    let axes: Vec<Vector3<f64>> =
        eigen.eigenvectors.column_iter().map(|axis| along(axis.into_owned())).collect();
    (mean, Matrix3::from_columns(&axes))
}

/// The hull of `mapped`, with the places of `points`.
fn mapped_hull(points: &[Vector3<f64>], mapped: Vec<Vector3<f64>>) -> Result<Piece, NoHull> {
    let key = |x: f64, y: f64, z: f64| [x, y, z].map(|x| (x + 0.0).to_bits());
    let number: BTreeMap<[u64; 3], u32> =
        mapped.iter().enumerate().map(|(index, p)| (key(p.x, p.y, p.z), index as u32)).collect();
    let places: Vec<_> = mapped.iter().map(|p| parry3d_f64::math::Vector::new(p.x, p.y, p.z)).collect();
    // Degenerate points can trip assertions inside parry.
    let found = catch_unwind(AssertUnwindSafe(|| parry3d_f64::transformation::try_convex_hull(&places)));
    let (corners, triangles) = found.ok().and_then(Result::ok).ok_or(NoHull::Failed)?;
    let original: Option<Vec<u32>> =
        corners.iter().map(|p| number.get(&key(p.x, p.y, p.z)).copied()).collect();
    let original = original.ok_or(NoHull::Failed)?;
    let triangles: Vec<[u32; 3]> =
        triangles.into_iter().map(|triangle| triangle.map(|v| original[v as usize])).collect();
    let look_of = vec![0; triangles.len()];
    let mesh = Mesh { vertices: points.to_vec(), triangles, look_of }.compact();
    match mesh::polyhedron(&mesh, usize::MAX) {
        Ok(solid) => Ok(Piece::new(solid)),
        Err(Flaw::Thin) => Err(NoHull::Flat),
        Err(_) => Err(NoHull::Failed),
    }
}

/// An upright box as a piece, for tests.
#[cfg(test)]
pub(crate) fn box_between(low: [f64; 3], high: [f64; 3]) -> Piece {
    let corner =
        |k: usize| Vector3::from_fn(|axis, _| if k >> axis & 1 == 0 { low[axis] } else { high[axis] });
    hull(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners(size: [f64; 3]) -> Vec<Vector3<f64>> {
        (0..8)
            .map(|k| {
                Vector3::new(
                    size[0] * f64::from(k & 1),
                    size[1] * f64::from(k >> 1 & 1),
                    size[2] * f64::from(k >> 2),
                )
            })
            .collect()
    }

    #[test]
    fn boxes_of_any_thickness_have_six_faces() {
        for size in [[1.0, 1.0, 1.0], [1.0, 2.0, 1e-4], [1e-3, 1.0, 30.0], [1e4, 1e4, 1e-1]] {
            let piece = hull(&corners(size)).unwrap();
            let volume: f64 = size.iter().product();
            assert_eq!((piece.vertices.len(), piece.faces.len()), (8, 6), "{size:?}");
            assert!((piece.volume_m3 / volume - 1.0).abs() < 1e-12);
        }
        assert!(matches!(hull(&corners([1.0, 1.0, 0.0])), Err(NoHull::Flat)));
    }

    #[test]
    fn a_cut_gives_two_parts_with_a_common_wall() {
        let piece = hull(&corners([3.0, 1.0, 1.0])).unwrap();
        let [left, right] = piece.cut(&Plane::across(0, 1.0, false)).unwrap();
        assert_eq!((left.volume_m3, right.volume_m3), (1.0, 2.0));
        assert!(!left.overlaps(&right, 1e-9) && left.is_near(&right, 1e-9));
        assert!(left.overlaps(&piece, 1e-9) && piece.overlaps(&right, 1e-9));
        let small =
            hull(&corners([0.5, 0.5, 0.5]).iter().map(|v| v.add_scalar(0.2)).collect::<Vec<_>>()).unwrap();
        assert!(small.overlaps(&piece, 1e-9) && piece.overlaps(&small, 1e-9), "one within the other");
    }
}
