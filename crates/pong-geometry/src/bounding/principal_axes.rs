//! Principal axes of points by Jacobi rotations. Only +, −, ×, ÷ and √ are used, so that every machine
//! computes the same bits.

use crate::{Mat3, Vec3};

/// Returns the principal axes of the covariance of the points, as orthonormal right-handed columns.
pub(super) fn principal_axes(points: &[Vec3]) -> Mat3 {
    let count = points.len() as f64;
    let mean = points.iter().sum::<Vec3>() / count;
    let spread = points.iter().fold(Mat3::zeros(), |sum, p| sum + (p - mean) * (p - mean).transpose());
    orthonormal(&diagonalising_rotation(spread))
}

/// Returns the rotation V for which VᵀSV is diagonal, for a symmetric matrix S.
///
/// Each sweep rotates in the three coordinate planes by the angle that zeroes the off-diagonal entry.
/// Convergence is quadratic: a 3 × 3 matrix needs four or five sweeps, and further sweeps change nothing.
fn diagonalising_rotation(mut s: Mat3) -> Mat3 {
    const SWEEPS: usize = 8;
    /// Smallest tangent of twice the angle, 2⁻⁵¹¹. Below it the square of the cotangent overflows, and a
    /// rotation by so small an angle changes no number.
    const SMALLEST_TANGENT: f64 = f64::from_bits((1023 - 511) << 52);
    let mut rotation = Mat3::identity();
    for _ in 0..SWEEPS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let (apart, twice) = (s[(q, q)] - s[(p, p)], 2.0 * s[(p, q)]);
            // No rotation: the entry is zero, or so small that the square of the cotangent would overflow.
            if twice.abs() <= apart.abs() * SMALLEST_TANGENT || twice == 0.0 {
                continue;
            }
            // Smaller root t = tan(angle) of t² + 2·t·cot(2·angle) − 1 = 0.
            let cot = apart / twice;
            let tangent = cot.signum() / (cot.abs() + (cot * cot + 1.0).sqrt());
            let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
            let turn = plane_rotation(p, q, cosine, tangent * cosine);
            s = turn.transpose() * s * turn;
            rotation *= turn;
        }
    }
    rotation
}

/// Returns the rotation in the plane of axes `p` and `q` that takes `p` towards −`q`.
pub(super) fn plane_rotation(p: usize, q: usize, cosine: f64, sine: f64) -> Mat3 {
    let mut turn = Mat3::identity();
    turn[(p, p)] = cosine;
    turn[(q, q)] = cosine;
    turn[(p, q)] = sine;
    turn[(q, p)] = -sine;
    turn
}

/// Returns orthonormal right-handed axes for axes distorted by rounding. The first axis and the plane of the
/// first two are kept.
pub(super) fn orthonormal(axes: &Mat3) -> Mat3 {
    let x = axes.column(0).normalize();
    let y = axes.column(1) - x * x.dot(&axes.column(1));
    let y = y.normalize();
    Mat3::from_columns(&[x, y, x.cross(&y)])
}
