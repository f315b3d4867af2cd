//! Box-box test by separating axes. Two boxes are disjoint if and only if their projections are disjoint
//! along one of 15 directions L. These are the face normals `b_i` and `a_j`, and the cross products
//! `b_i × a_j` of edges. Along L the boxes are disjoint if
//!
//! ```text
//!     |L·t| > Σ hb_k |L·b_k| + Σ ha_k |L·a_k|
//! ```
//!
//! Here t is the vector from B's centre to A's, and `hb` and `ha` are the half extents. Everything is in B's
//! axes, where `m_ij = b_i·a_j` gives all projections.

use crate::{Mat3, Vec3};

/// Gap between projections above which the boxes count as separate, as a fraction of the sizes.
///
/// For boxes in contact, each product in the sums is at most the sum of the sizes, and no more than ten
/// products are added. So each side is accurate to about ten units of 1.1e-16 of the sum of the sizes. The
/// margin of the volumes does not cover this error: for nearly parallel edges `b_i × a_j` is short, which
/// scales the margin down but not the rounding of `m`.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Returns `true` if two boxes may overlap. `half_a` and `half_b` are the half extents, `m` has A's axes as
/// columns in B's axes, and `t` is the vector from B's centre to A's, in B's axes.
#[inline]
pub(super) fn boxes_overlap(half_a: &Vec3, half_b: &Vec3, m: &Mat3, t: &Vec3) -> bool {
    let abs = m.abs();
    let margin = ROUNDING * (half_a.sum() + half_b.sum());
    // Branch-free within a group of three; NaN counts as overlap.
    let apart = |x: f64, y: f64, z: f64| (x > margin) | (y > margin) | (z > margin);
    let gaps_b = t.abs() - half_b - abs * half_a;
    if apart(gaps_b.x, gaps_b.y, gaps_b.z) {
        return false;
    }
    if have_common_point(half_a, half_b, m, t) {
        return true;
    }
    let gaps_a = m.tr_mul(t).abs() - half_a - abs.tr_mul(half_b);
    if apart(gaps_a.x, gaps_a.y, gaps_a.z) {
        return false;
    }
    let edges = |i: usize| {
        let gap = |j: usize| edge_gap(i, j, half_a, half_b, m, &abs, t);
        apart(gap(0), gap(1), gap(2))
    };
    !(edges(0) | edges(1) | edges(2))
}

/// Returns `true` if the point of B nearest to A's centre lies in A, which proves an overlap. This quick test
/// is enough for most overlapping boxes. If the point lies in A only by rounding, every gap between the
/// projections is below the margin, so the full test reports an overlap too.
#[inline(always)]
fn have_common_point(half_a: &Vec3, half_b: &Vec3, m: &Mat3, t: &Vec3) -> bool {
    let nearest = t.zip_map(half_b, |t, half| {
        if t > half {
            half
        } else if t < -half {
            -half
        } else {
            t
        }
    });
    let place_a = m.tr_mul(&(nearest - t)).abs();
    // NaN counts as outside.
    (place_a.x <= half_a.x) & (place_a.y <= half_a.y) & (place_a.z <= half_a.z)
}

/// Returns the gap between the projections along `b_i × a_j` (not a unit vector); positive if they are
/// disjoint.
///
/// In B's axes `b_i × a_j` has the components −m(i+2, j) at i+1 and m(i+1, j) at i+2. Its component along
/// `a_(j+1)` is `b_i·(a_j × a_(j+1)) = m(i, j+2)`.
#[inline(always)]
fn edge_gap(i: usize, j: usize, half_a: &Vec3, half_b: &Vec3, m: &Mat3, abs: &Mat3, t: &Vec3) -> f64 {
    let (i1, i2, j1, j2) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
    let center = t[i2] * m[(i1, j)] - t[i1] * m[(i2, j)];
    let reach_a = half_a[j1] * abs[(i, j2)] + half_a[j2] * abs[(i, j1)];
    let reach_b = half_b[i1] * abs[(i2, j)] + half_b[i2] * abs[(i1, j)];
    center.abs() - reach_a - reach_b
}
