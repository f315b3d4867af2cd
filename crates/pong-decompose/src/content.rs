//! Part of a solid in a box: its volume, and points whose hull contains it.

use crate::inside::Solid;
use crate::polygon::{Plane, Polygon, clip, is_wide};
use nalgebra::Vector3;
use pong_import::mesh::{Mesh, area_vector, bounds};

/// Content narrower than this share of the cell's diagonal only touches the cell.
const STRIP_SHARE: f64 = 1e-9;
/// Position of the probe for a corner, as a share of the way from the corner to the middle of the cell.
const PROBE_SHARE: f64 = 1e-7;

/// A box with axes along those of the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cell {
    pub(crate) low: Vector3<f64>,
    pub(crate) high: Vector3<f64>,
}

impl Cell {
    /// Both sides of a plane across an axis.
    pub(crate) fn cut(&self, axis: usize, at: f64) -> [Self; 2] {
        let (mut lower, mut upper) = (*self, *self);
        lower.high[axis] = at;
        upper.low[axis] = at;
        [lower, upper]
    }

    /// Intersection of both boxes; `None` if it has no volume.
    pub(crate) fn common(&self, other: &Self) -> Option<Self> {
        let common = Self { low: self.low.sup(&other.low), high: self.high.inf(&other.high) };
        (0..3).all(|axis| common.low[axis] < common.high[axis]).then_some(common)
    }
}

/// The part of a solid in a cell.
pub(crate) struct Content {
    /// Points that include every corner of that part.
    pub(crate) points: Vec<Vector3<f64>>,
    pub(crate) volume_m3: f64,
}

/// Cuts a closed mesh by a cell.
pub(crate) fn content(mesh: &Mesh, solid: &Solid, cell: &Cell) -> Content {
    let mut content = Content { points: Vec::new(), volume_m3: 0.0 };
    let strip_m = STRIP_SHARE * (cell.high - cell.low).norm();
    for triangle in 0..mesh.triangles.len() {
        let corners = mesh.corners(triangle);
        let (low, high) = bounds(&corners);
        if (0..2).any(|axis| low[axis] > cell.high[axis] || high[axis] < cell.low[axis]) {
            continue;
        }
        content.volume_m3 += volume_below(&corners, cell);
        if low.z <= cell.high.z && high.z >= cell.low.z {
            let inside = within(&corners, cell, 0..3);
            if is_wide(&inside, strip_m) && !faces_a_wall(&inside, &corners, cell) {
                content.points.extend(inside);
            }
        }
    }
    let corner = |k: u32| {
        Vector3::from_fn(|axis, _| if k >> axis & 1 == 0 { cell.low[axis] } else { cell.high[axis] })
    };
    // A corner may lie on the surface, so a point slightly inside the cell decides.
    let middle = 0.5 * (cell.low + cell.high);
    let is_solid = |place: &Vector3<f64>| solid.holds(&(place + (middle - place) * PROBE_SHARE));
    content.points.extend((0..8).map(corner).filter(is_solid));
    content
}

/// Tests whether a polygon lies in a wall of the cell and faces inwards: the solid it bounds is then outside.
fn faces_a_wall(inside: &[Vector3<f64>], corners: &[Vector3<f64>; 3], cell: &Cell) -> bool {
    let normal = area_vector(corners);
    let all_at = |axis: usize, at: f64| inside.iter().all(|place| place[axis] == at);
    (0..3).any(|axis| {
        (normal[axis] > 0.0 && all_at(axis, cell.low[axis]))
            || (normal[axis] < 0.0 && all_at(axis, cell.high[axis]))
    })
}

fn within(corners: &[Vector3<f64>], cell: &Cell, axes: std::ops::Range<usize>) -> Polygon {
    axes.fold(corners.to_vec(), |polygon, axis| {
        let above_low = clip(&polygon, &Plane::across(axis, cell.low[axis], true));
        clip(&above_low, &Plane::across(axis, cell.high[axis], false))
    })
}

/// The signed volume between the cell's floor and a triangle over it: with the sign of the triangle's upward normal,
/// these add up to the solid's volume within the cell, because along every vertical line the solid is what lies
/// below its upper sides and not below its lower ones.
fn volume_below(corners: &[Vector3<f64>; 3], cell: &Cell) -> f64 {
    let upward = area_vector(corners).z;
    if upward == 0.0 {
        return 0.0;
    }
    let over = within(corners, cell, 0..2);
    let floor = Plane::across(2, cell.low.z, true);
    let ceiling = Plane::across(2, cell.high.z, false);
    let between = clip(&clip(&over, &floor), &ceiling);
    // A face in the ceiling itself counts once.
    let lies_below = corners.iter().all(|corner| corner.z <= cell.high.z);
    let beyond = if lies_below { Polygon::new() } else { clip(&over, &ceiling.flipped()) };
    let volume = prism(&between, |z| z - cell.low.z) + prism(&beyond, |_| cell.high.z - cell.low.z);
    volume.copysign(upward)
}

/// ∫ height(z) over a polygon's shadow on the floor; `height` is linear.
fn prism(polygon: &[Vector3<f64>], height: impl Fn(f64) -> f64) -> f64 {
    let Some(first) = polygon.first() else { return 0.0 };
    let fan = polygon.windows(2).skip(1).map(|pair| {
        let shadow = 0.5 * (pair[0] - first).cross(&(pair[1] - first)).z.abs();
        shadow * (height(first.z) + height(pair[0].z) + height(pair[1].z)) / 3.0
    });
    fan.sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::piece::hull;

    /// A tetrahedron with corners at the origin and at 1 along the axes.
    fn tetrahedron() -> Mesh {
        let vertices = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
        Mesh { vertices, triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], look_of: vec![0; 4] }
    }

    fn cell(low: [f64; 3], high: [f64; 3]) -> Cell {
        Cell { low: low.into(), high: high.into() }
    }

    #[test]
    fn what_lies_in_cells_adds_up_and_is_what_its_hull_holds() {
        let mesh = tetrahedron();
        let solid = Solid::new(&mesh).unwrap();
        let whole = cell([0.0; 3], [1.0; 3]);
        assert!((content(&mesh, &solid, &whole).volume_m3 - 1.0 / 6.0).abs() < 1e-15);
        // Above z = ½ a tetrahedron of half the size is left.
        let [below, above] = whole.cut(2, 0.5);
        assert!((content(&mesh, &solid, &above).volume_m3 - 1.0 / 48.0).abs() < 1e-15);
        for [one, other] in [[below, above], whole.cut(0, 0.3), below.cut(1, 0.2)] {
            for cell in [one, other] {
                let content = content(&mesh, &solid, &cell);
                let hull = hull(&content.points).unwrap();
                assert!((hull.volume_m3 - content.volume_m3).abs() < 1e-12, "convex: the hull adds nothing");
            }
        }
        let inner = content(&mesh, &solid, &cell([0.1; 3], [0.2; 3]));
        assert_eq!(inner.points.len(), 8, "all corners of a cell within");
        assert!((inner.volume_m3 - 1e-3).abs() < 1e-15);
    }

    #[test]
    fn a_face_in_a_wall_belongs_to_the_side_behind_it() {
        let mesh = tetrahedron();
        let solid = Solid::new(&mesh).unwrap();
        let beside = content(&mesh, &solid, &cell([0.0, 0.0, -1.0], [1.0, 1.0, 0.0]));
        assert_eq!((beside.points.len(), beside.volume_m3), (0, 0.0));
    }
}
