//! Point of a simplex that is nearest to the origin.
//!
//! Candidates are the nearest point of each edge, and the nearest point of each face if it lies inside the
//! face. The nearest candidate is the result. The weights of its corners are never negative and add up to
//! one, so the result lies in the simplex whatever the rounding.
//!
//! Slender faces are as accurate as others. Their axes come from Gram-Schmidt orthogonalisation, longest edge
//! first, so the point is exact to the rounding of the coordinates, and the normal is perpendicular to the
//! face to rounding.

use crate::Vec3;

/// Corner of the simplex: support points of two cores, and their difference.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Point of the first core less point of the second, m.
    pub difference_b: Vec3,
    /// Points of the two cores, m.
    pub points_b: [Vec3; 2],
}

/// Corner, edge or face of a simplex that contains the simplex's point nearest to the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearest {
    /// Corners; only the first `count` are used.
    pub corners: [Corner; 3],
    /// Number of corners.
    pub count: usize,
    /// Weights of the corners in the nearest point.
    shares: [f64; 3],
    /// Distance of the nearest point from the origin, m.
    pub distance: f64,
    /// Unit vector from the origin to the nearest point, made perpendicular to the edge or face.
    pub direction_b: Vec3,
}

impl Nearest {
    /// Creates the simplex of one corner.
    pub fn corner(corner: Corner) -> Self {
        Self::new([corner; 3], 1, [1.0, 0.0, 0.0], |v| v)
    }

    fn new(corners: [Corner; 3], count: usize, shares: [f64; 3], upright: impl FnOnce(Vec3) -> Vec3) -> Self {
        let mut nearest = Self { corners, count, shares, distance: 0.0, direction_b: Vec3::x() };
        let v = nearest.mixed(|corner| corner.difference_b);
        nearest.distance = v.norm();
        let upright = upright(v);
        let length = upright.norm();
        if length > 0.0 {
            nearest.direction_b = upright / length.max(f64::MIN_POSITIVE);
        }
        nearest
    }

    /// Returns the sum of the vectors `of` the corners, weighted by `shares`.
    fn mixed(&self, of: impl Fn(&Corner) -> Vec3) -> Vec3 {
        let parts = self.corners.iter().zip(&self.shares).take(self.count);
        parts.map(|(corner, share)| of(corner) * *share).sum()
    }

    /// Returns the nearest points of the two cores, m.
    pub fn points(&self) -> [Vec3; 2] {
        [0, 1].map(|side| self.mixed(|corner| corner.points_b[side]))
    }

    /// Returns the nearest point after a corner is added to the simplex; `None` if the new simplex contains
    /// the origin.
    ///
    /// The corner must be nearer to the origin along `direction_b` than the nearest point. The new nearest
    /// point then is that corner, or lies on an edge or face that has it, even if the distance decreases only
    /// by rounding.
    pub fn with(&self, corner: Corner) -> Option<Self> {
        let mut all = [corner; 4];
        all[..self.count].copy_from_slice(&self.corners[..self.count]);
        let all = &all[..=self.count];
        let mut best = on_edge([all[0], corner]);
        let mut consider = |candidate: Self| {
            if candidate.distance < best.distance {
                best = candidate;
            }
        };
        for i in 1..self.count {
            consider(on_edge([all[i], corner]));
            (0..i).filter_map(|j| Face::new([all[j], all[i], corner])?.nearest()).for_each(&mut consider);
        }
        if self.count == 3 && holds_origin(all) { None } else { Some(best) }
    }
}

/// Returns `true` if the origin lies in the tetrahedron of four corners.
fn holds_origin(corners: &[Corner]) -> bool {
    (0..4).all(|top| {
        let face = [1, 2, 3].map(|k| corners[(top + k) % 4]);
        Face::new(face).is_some_and(|face| face.holds_origin_before(&corners[top]))
    })
}

/// Returns the point of an edge nearest to the origin.
fn on_edge(ends: [Corner; 2]) -> Nearest {
    let [a, b] = ends;
    let along = b.difference_b - a.difference_b;
    let square = along.norm_squared();
    let share = -a.difference_b.dot(&along) / square.max(f64::MIN_POSITIVE);
    if share <= 0.0 || square == 0.0 {
        return Nearest::corner(a);
    }
    if share >= 1.0 {
        return Nearest::corner(b);
    }
    let unit = along / square.sqrt().max(f64::MIN_POSITIVE);
    Nearest::new([a, b, b], 2, [1.0 - share, share, 0.0], |v| v - unit * unit.dot(&v))
}

/// Triangular face of a simplex, with two axes in its plane.
struct Face {
    /// Corners; the longest edge runs from the first to the second.
    corners: [Corner; 3],
    /// Unit vector along the longest edge, and the unit vector across it towards the third corner.
    axes: [Vec3; 2],
    /// Length of the longest edge, m.
    length: f64,
    /// Height of the third corner over the longest edge, m.
    height: f64,
}

impl Face {
    /// Creates the face of three corners; `None` if they are in line.
    fn new(corners: [Corner; 3]) -> Option<Self> {
        let square = |i: usize| (corners[(i + 1) % 3].difference_b - corners[i].difference_b).norm_squared();
        let first = if square(0) >= square(1) && square(0) >= square(2) {
            0
        } else if square(1) >= square(2) {
            1
        } else {
            2
        };
        let corners = [0, 1, 2].map(|k| corners[(first + k) % 3]);
        let [a, b, c] = corners.map(|corner| corner.difference_b);
        let length = (b - a).norm();
        let along = (b - a) / length.max(f64::MIN_POSITIVE);
        let across = (c - a) - along * along.dot(&(c - a));
        let height = across.norm();
        if !(length > 0.0 && height > 0.0) {
            return None;
        }
        let across = across / height.max(f64::MIN_POSITIVE);
        // Orthogonalised once more, because for a slender face the first difference is mostly rounding.
        let across = across - along * along.dot(&across);
        let across = across / across.norm().max(f64::MIN_POSITIVE);
        Some(Self { corners, axes: [along, across], length, height })
    }

    fn normal(&self) -> Vec3 {
        let [along, across] = &self.axes;
        along.cross(across)
    }

    /// Returns the point of the face nearest to the origin; `None` unless the origin projects into the face.
    fn nearest(&self) -> Option<Nearest> {
        let [a, _, c] = self.corners.map(|corner| corner.difference_b);
        let [along, across] = &self.axes;
        let third = -a.dot(across) / self.height.max(f64::MIN_POSITIVE);
        let second = (-a.dot(along) - third * (c - a).dot(along)) / self.length.max(f64::MIN_POSITIVE);
        let first = 1.0 - second - third;
        if !(first > 0.0 && second > 0.0 && third > 0.0) {
            return None;
        }
        // The error of the normal is rounding/`height`, that of the vector from the origin is rounding/|v|.
        // The more accurate of the two gives the direction.
        let upright = |v: Vec3| {
            let normal = self.normal();
            if v.norm() >= self.height {
                v - along * along.dot(&v)
            } else {
                normal * 1.0_f64.copysign(normal.dot(&a))
            }
        };
        Some(Nearest::new(self.corners, 3, [first, second, third], upright))
    }

    /// Returns `true` if the origin is between the plane of this face and the parallel plane through
    /// `corner`, the fourth corner. For a tetrahedron that is flat to rounding, only the parallel plane
    /// excludes an origin outside the tetrahedron.
    fn holds_origin_before(&self, corner: &Corner) -> bool {
        let normal = self.normal();
        let foot = self.corners[0].difference_b;
        let (origin, top) = (-normal.dot(&foot), normal.dot(&(corner.difference_b - foot)));
        if top >= 0.0 { (0.0..=top).contains(&origin) } else { (top..=0.0).contains(&origin) }
    }
}
