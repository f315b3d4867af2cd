//! Ellipsoid with precomputed matrices, and its outline seen along a direction.

use crate::Vec3;
use crate::primitive::Ellipsoid;

/// Ellipsoid with matrices that are computed once and used for many directions and points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PreparedEllipsoid {
    /// Centre, m.
    pub(crate) center: Vec3,
    /// Rows: principal axes times semi-axes; maps a normal to the scaled normal.
    pub(crate) widen: [Vec3; 3],
    /// Rows: principal axes over semi-axes; maps the ellipsoid to the unit ball.
    shrink: [Vec3; 3],
    /// Smallest semi-axis, m.
    pub(crate) smallest: f64,
    /// Largest semi-axis, m.
    pub(crate) largest: f64,
}

impl PreparedEllipsoid {
    pub(crate) fn new(e: &Ellipsoid) -> Self {
        let axis = |i: usize| e.axes.column(i).into_owned();
        Self {
            center: e.center,
            widen: std::array::from_fn(|i| axis(i) * e.semi_axes[i]),
            shrink: std::array::from_fn(|i| axis(i) * (1.0 / e.semi_axes[i])),
            smallest: e.semi_axes.min(),
            largest: e.semi_axes.max(),
        }
    }

    /// Returns the scaled normal of `n`: its components along the principal axes, times the semi-axes. The
    /// length of the scaled normal is the half width of the ellipsoid along `n`, m.
    #[inline]
    pub(crate) fn widened(&self, n: &Vec3) -> Vec3 {
        Vec3::new(self.widen[0].dot(n), self.widen[1].dot(n), self.widen[2].dot(n))
    }

    /// Returns the farthest point along a normal, given the scaled normal. The result is relative to the
    /// centre and multiplied by the half width, m².
    #[inline]
    pub(crate) fn reach(&self, widened: &Vec3) -> Vec3 {
        self.widen[0] * widened.x + self.widen[1] * widened.y + self.widen[2] * widened.z
    }

    /// Returns a vector in the metric in which the ellipsoid is the unit ball.
    #[inline]
    pub(crate) fn shrunk(&self, v: &Vec3) -> Vec3 {
        Vec3::new(self.shrink[0].dot(v), self.shrink[1].dot(v), self.shrink[2].dot(v))
    }

    /// Returns the direction, not of unit length, whose scaled normal is parallel to `widened`.
    #[inline]
    pub(crate) fn direction_of(&self, widened: &Vec3) -> Vec3 {
        self.shrink[0] * widened.x + self.shrink[1] * widened.y + self.shrink[2] * widened.z
    }

    /// Returns the deepest point of the ellipsoid along −n.
    #[inline]
    pub(crate) fn deepest(&self, n: &Vec3) -> Vec3 {
        let widened = self.widened(n);
        self.center - self.reach(&widened) / widened.norm()
    }

    /// Returns `true` if a second local minimum of the depth ([`ellipsoid_math`](super::ellipsoid_math)) can
    /// have a depth of at most `depth` (m). At such a minimum the root t of that module is below −a_min², and
    /// the depth is −t/h with the half width h ≤ a_max. The depth is therefore at least a_min²/a_max, the
    /// smallest radius of curvature.
    #[inline]
    pub(crate) fn allows_second(&self, depth: f64) -> bool {
        depth * self.largest >= self.smallest * self.smallest
    }

    /// Returns a lower bound of the overlap D(n) (see [`ellipsoid_polyhedron`](super::ellipsoid_polyhedron))
    /// for all normals n between those of two faces, m. `heights` (m) are the heights of the centre above the
    /// two faces.
    ///
    /// Extended to vectors n of any length, D is convex. So between the two normals, D is no less than its
    /// linearisation at either normal. Along the arc a linearisation is a sine wave, concave where positive.
    /// So the larger of the two linearisations is least at an end of the arc or where the two are equal. The
    /// point where they are equal is found on the chord; the value there is divided by the point's distance
    /// from the origin.
    pub(crate) fn arc_bound(&self, normals: &[Vec3; 2], heights: &[f64; 2]) -> f64 {
        let widened = normals.map(|n| self.widened(&n));
        let half_widths = widened.map(|w| w.norm());
        let product = widened[0].dot(&widened[1]);
        let depths = [half_widths[0] - heights[0], half_widths[1] - heights[1]];
        // Linearisation at each normal, evaluated at the other normal.
        let across = [product / half_widths[0] - heights[1], product / half_widths[1] - heights[0]];
        let (fall_0, fall_1) = (depths[0] - across[1], depths[1] - across[0]);
        let sum = fall_0 + fall_1;
        if sum <= 0.0 {
            return depths[0].min(depths[1]);
        }
        let share = fall_0 / sum;
        let chord = depths[0] + share * (across[0] - depths[0]);
        let bend = 1.0 - normals[0].dot(&normals[1]);
        let crossing =
            if chord > 0.0 { chord / (1.0 - 2.0 * share * (1.0 - share) * bend).sqrt() } else { chord };
        crossing.min(depths[0]).min(depths[1])
    }
}

/// Outline of an ellipsoid seen along a direction: an ellipse in the perpendicular plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shadow {
    /// Principal axes, unit.
    pub(crate) axes: [Vec3; 2],
    /// Semi-axes, m.
    pub(crate) semi_axes: [f64; 2],
}

impl Shadow {
    /// Computes the outline in the plane spanned by the orthonormal vectors `u` and `v`.
    ///
    /// The half width along a unit vector of the plane is the length of its scaled normal
    /// ([`widened`](PreparedEllipsoid::widened)), so the squared half width is a quadratic form. Its
    /// principal axes, which are those of the outline, are the two perpendicular directions whose scaled
    /// normals are perpendicular too. One Jacobi rotation finds them; the error of the smaller semi-axis is
    /// no more than the rounding of the larger one.
    #[inline]
    pub(crate) fn new(e: &PreparedEllipsoid, u: &Vec3, v: &Vec3) -> Self {
        let (wide_u, wide_v) = (e.widened(u), e.widened(v));
        /// Limit of `zeta`, 2⁵¹². Above it, `zeta²` overflows and the rotation is zero within rounding, so
        /// the axes are not rotated.
        const LARGEST_COTANGENT: f64 = f64::from_bits((1023 + 512) << 52);
        let (uu, vv, uv) = (wide_u.norm_squared(), wide_v.norm_squared(), wide_u.dot(&wide_v));
        if 2.0 * uv.abs() * LARGEST_COTANGENT <= (vv - uu).abs() || uv == 0.0 {
            return Self { axes: [*u, *v], semi_axes: [uu.sqrt(), vv.sqrt()] };
        }
        let zeta = (vv - uu) / (2.0 * uv);
        let tangent = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
        let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
        let sine = cosine * tangent;
        let turned = |a: &Vec3, b: &Vec3| [a * cosine - b * sine, a * sine + b * cosine];
        Self { axes: turned(u, v), semi_axes: turned(&wide_u, &wide_v).map(|w| w.norm()) }
    }

    /// Returns `true` if a point at `components` (m) may be inside the outline and no deeper than `depth`
    /// (m). The depth is at least the smaller semi-axis times 1 − r, where r is the point's radius in the
    /// metric in which the outline is the unit circle.
    #[inline]
    pub(crate) fn may_hold(&self, components: &[f64; 2], depth: f64) -> bool {
        let [x, y] = [components[0] / self.semi_axes[0], components[1] / self.semi_axes[1]];
        let square = x * x + y * y;
        square < 1.0 && self.semi_axes[0].min(self.semi_axes[1]) * (1.0 - square.sqrt()) <= depth
    }

    /// Same as [`PreparedEllipsoid::allows_second`], for the outline.
    #[inline]
    pub(crate) fn allows_second(&self, depth: f64) -> bool {
        let [a, b] = self.semi_axes;
        depth * a.max(b) >= a.min(b) * a.min(b)
    }

    /// Returns the components of a vector along the principal axes of the outline.
    #[inline]
    pub(crate) fn components(&self, v: &Vec3) -> [f64; 2] {
        [self.axes[0].dot(v), self.axes[1].dot(v)]
    }

    /// Returns the vector in the plane of the outline that has these components along the principal axes.
    #[inline]
    pub(crate) fn vector(&self, components: &[f64; 2]) -> Vec3 {
        self.axes[0] * components[0] + self.axes[1] * components[1]
    }
}
