//! Points of an ellipse or an ellipsoid that are nearest to a given point.
//!
//! # The equation
//!
//! Consider a point `y` in the principal frame, with the semi-axes `aᵢ` and `A = diag(aᵢ)`. The foot `x` of a
//! normal through `y` has the components `xᵢ = aᵢ²·yᵢ/(aᵢ² + t)` with a parameter `t`. The foot lies on the
//! surface if the secular equation holds:
//!
//! ```text
//! f(t) = Σ qᵢ² = 1,    qᵢ = xᵢ/aᵢ = aᵢ·yᵢ/(aᵢ² + t).
//! ```
//!
//! From `x − y = −t·A⁻²·x`, `y` lies on the inner side of the surface at `x` if `t < 0`. A root is a local
//! minimum of the distance if `H = I + t·A⁻²` is positive semidefinite on the tangent plane at `x`, whose
//! normal is `g = A⁻²·x`.
//!
//! * `t > −a_min²`: `H` is positive definite. `f` falls from ∞ to 0, so there is one root: the nearest point.
//! * `−a_mid² < t < −a_min²`: `H` has one negative eigenvalue. Restricted to the tangent plane, `H` has at
//!   least one positive eigenvalue (interlacing), and its determinant has the sign of
//!   `gᵀ·adj(H)·g = −½·det(H)·f'(t)`, that is of `f'`. `f` is convex here and has at most two roots: the
//!   larger one, where `f' ≥ 0`, is the only local minimum.
//! * `t < −a_mid²`: `H` has two negative eigenvalues, so on every plane it has a negative one: no local
//!   minimum.
//!
//! If `y` lies in the plane through the centre perpendicular to the shortest axis, both minima can fall on
//! `t = −a_min²`, and are then mirror images.
//!
//! # Why the iteration converges
//!
//! With `σ = (t + a_min²)/a_min²`, `wᵢ = aᵢ·yᵢ/a_min²` and `dᵢ = (aᵢ² − a_min²)/a_min² ≥ 0`,
//! `f = Σ (wᵢ/(σ + dᵢ))²`. `ψ = 1/√f` is concave between the poles of `f`: `ψ'' ≤ 0` is `3·f'² ≤ 2·f·f''`,
//! that is `(Σ wᵢ²/(σ+dᵢ)³)² ≤ Σ wᵢ²/(σ+dᵢ)² · Σ wᵢ²/(σ+dᵢ)⁴`, the inequality of Cauchy and Schwarz. The
//! tangent of a concave function lies above it. So Newton's method for `ψ = 1`, started where `ψ ≤ 1` and `ψ`
//! rises, approaches the root quadratically and never passes it. The start `σ = maxᵢ(|wᵢ| − dᵢ)` has
//! `1 ≤ f ≤ N`. The second minimum is found by the same iteration in `τ = −σ`, started at `τ = |wᵢ|` of the
//! shortest axis `i`. If `ψ` falls, or has a pole, before it reaches 1, there is no second minimum. With
//! rounding, the iteration ends when the sequence no longer rises.
//!
//! Only the dimensionless `d` and `w` enter: scaling the scene changes nothing but rounding.

use crate::{Vec3, divisor};

/// Maximum number of iterations. A point within rounding of the focal curve needs most, about 50: there σ
/// grows by half per iteration, from 1e-8 to 1, before the convergence becomes quadratic.
const MOST_ITERATIONS: usize = 100;

/// Foot point of a normal from a point to an ellipse (`N` = 2) or ellipsoid (`N` = 3), in its principal
/// frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalFoot<const N: usize> {
    /// Surface point, m.
    pub point: [f64; N],
    /// Outward unit normal at that point.
    pub normal: [f64; N],
    /// Height of the tangent plane at `point` above the given point, m; positive if the given point is
    /// inside.
    pub depth: f64,
}

/// Returns the surface point nearest to `y`, which may be inside or outside, in the principal frame.
///
/// If several points are nearest, the result is the one with the positive coordinate along the shortest axis,
/// the first if several axes are shortest.
pub fn nearest_on_ellipsoid(semi_axes: &Vec3, y: &Vec3) -> NormalFoot<3> {
    nearest([semi_axes.x, semi_axes.y, semi_axes.z], [y.x, y.y, y.z])
}

/// Returns the second local minimum of the distance from `y` to the surface; `None` if there is none. It is
/// on the other side of the plane through the centre perpendicular to the shortest axis.
pub fn second_nearest_on_ellipsoid(semi_axes: &Vec3, y: &Vec3) -> Option<NormalFoot<3>> {
    second_nearest([semi_axes.x, semi_axes.y, semi_axes.z], [y.x, y.y, y.z])
}

/// Same as [`nearest_on_ellipsoid`], for an ellipse.
pub fn nearest_on_ellipse(semi_axes: [f64; 2], y: [f64; 2]) -> NormalFoot<2> {
    nearest(semi_axes, y)
}

/// Same as [`second_nearest_on_ellipsoid`], for an ellipse.
pub fn second_nearest_on_ellipse(semi_axes: [f64; 2], y: [f64; 2]) -> Option<NormalFoot<2>> {
    second_nearest(semi_axes, y)
}

#[inline]
fn nearest<const N: usize>(a: [f64; N], y: [f64; N]) -> NormalFoot<N> {
    let secular = Secular::new(&a, &y);
    let mut q = secular.main_root();
    normalize(&mut q);
    foot(&a, &y, q)
}

#[inline]
fn second_nearest<const N: usize>(a: [f64; N], y: [f64; N]) -> Option<NormalFoot<N>> {
    let mut q = Secular::new(&a, &y).second_root()?;
    normalize(&mut q);
    Some(foot(&a, &y, q))
}

/// Secular equation in dimensionless form (see the module documentation).
struct Secular<const N: usize> {
    w: [f64; N],
    d: [f64; N],
    shortest: usize,
}

impl<const N: usize> Secular<N> {
    #[inline]
    fn new(a: &[f64; N], y: &[f64; N]) -> Self {
        let mut shortest = 0;
        for i in 1..N {
            if a[i] < a[shortest] {
                shortest = i;
            }
        }
        let a_min = a[shortest];
        let inverse_square = 1.0 / (a_min * a_min);
        let mut secular = Self { w: [0.0; N], d: [0.0; N], shortest };
        for i in 0..N {
            secular.w[i] = a[i] * y[i] * inverse_square;
            secular.d[i] = (a[i] - a_min) * (a[i] + a_min) * inverse_square;
        }
        secular
    }

    /// Returns the vector `q` of the nearest point, not normalised.
    #[inline]
    fn main_root(&self) -> [f64; N] {
        let mut sigma = 0.0_f64;
        for i in 0..N {
            sigma = sigma.max(self.w[i].abs() - self.d[i]);
        }
        if sigma == 0.0 {
            // The point lies in the plane through the centre perpendicular to the shortest axis, so the terms
            // with a pole at σ = 0 vanish.
            if let Some(q) = self.on_medial_plane(1.0) {
                return q;
            }
        }
        for _ in 0..MOST_ITERATIONS {
            let (mut square, mut cube) = (0.0, 0.0);
            for i in 0..N {
                let reciprocal = self.reciprocal(sigma, i);
                let q = self.w[i] * reciprocal;
                square += q * q;
                cube += q * q * reciprocal;
            }
            let next = sigma + square * (square.sqrt() - 1.0) / cube;
            if next.is_nan() || next <= sigma {
                break;
            }
            sigma = next;
        }
        std::array::from_fn(|i| self.w[i] * self.reciprocal(sigma, i))
    }

    /// Returns the vector `q` of the second local minimum, not normalised; `None` if there is no second
    /// minimum.
    #[inline]
    fn second_root(&self) -> Option<[f64; N]> {
        let lifted = self.on_medial_plane(-1.0)?;
        let w_short = self.w[self.shortest].abs();
        if w_short == 0.0 {
            return self.has_gap().then_some(lifted);
        }
        let mut tau = w_short;
        for _ in 0..MOST_ITERATIONS {
            let (mut square, mut cube) = (0.0, 0.0);
            for (i, (w, d)) in self.w.iter().zip(&self.d).enumerate() {
                let denominator = d - tau;
                if i != self.shortest && denominator <= 0.0 {
                    return None;
                }
                let reciprocal = 1.0 / divisor(denominator);
                let q = w * reciprocal;
                square += q * q;
                cube -= q * q * reciprocal;
            }
            if cube <= 0.0 {
                return None;
            }
            let next = tau + square * (square.sqrt() - 1.0) / cube;
            if next.is_nan() || next <= tau {
                break;
            }
            tau = next;
        }
        Some(std::array::from_fn(|i| self.w[i] / (self.d[i] - tau)))
    }

    /// Returns the vector `q` at `t = −a_min²`. Its component along the shortest axis has the given sign and
    /// makes `q` a unit vector. `None` if the other components alone are longer than 1, or if the point has a
    /// component along a second axis that is equally short.
    #[inline]
    fn on_medial_plane(&self, sign: f64) -> Option<[f64; N]> {
        let mut q = [0.0; N];
        let mut rest = 0.0;
        for (i, (w, d)) in self.w.iter().zip(&self.d).enumerate() {
            if i != self.shortest && *w != 0.0 {
                if *d <= 0.0 {
                    return None;
                }
                q[i] = w / d.max(f64::MIN_POSITIVE);
                rest += q[i] * q[i];
            }
        }
        if rest > 1.0 {
            return None;
        }
        q[self.shortest] = sign * (1.0 - rest).sqrt();
        Some(q)
    }

    /// Returns `true` if the shortest axis is the only one of its length.
    fn has_gap(&self) -> bool {
        (0..N).all(|i| i == self.shortest || self.d[i] > 0.0)
    }

    /// Returns `1/(σ + dᵢ)`; 0 at the pole, where `wᵢ` is 0.
    #[inline]
    fn reciprocal(&self, sigma: f64, i: usize) -> f64 {
        let sum = sigma + self.d[i];
        // Clamped, so that the quotient is finite even if a compiler divides before the branch.
        if sum > 0.0 { 1.0 / sum.max(f64::MIN_POSITIVE) } else { 0.0 }
    }
}

#[inline]
fn normalize<const N: usize>(v: &mut [f64; N]) -> f64 {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    for x in v.iter_mut() {
        *x /= length;
    }
    length
}

/// Returns the foot point that belongs to the vector `q`. The depth is computed as `h(n) − n·y` with the
/// normal n and the support function h. An error of the root then has only a second-order effect, and only
/// rounding can take the depth below the true minimum.
#[inline]
fn foot<const N: usize>(a: &[f64; N], y: &[f64; N], q: [f64; N]) -> NormalFoot<N> {
    let mut normal: [f64; N] = std::array::from_fn(|i| q[i] / a[i]);
    let half_width = 1.0 / normalize(&mut normal);
    let height: f64 = (0..N).map(|i| normal[i] * y[i]).sum();
    NormalFoot { point: std::array::from_fn(|i| a[i] * q[i]), normal, depth: half_width - height }
}
