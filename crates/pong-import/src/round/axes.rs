//! Candidate axes of a round part.

use super::frame::Frame;
use crate::mesh::{Mesh, area_vector};
use nalgebra::{Matrix3, Vector3};

/// Six frames: principal axes of the areas and of the normals. A round part's axis is among both, unless
/// three axes are alike, when any three may be found.
pub(super) fn candidates(part: &Mesh) -> Vec<Frame> {
    let triangles: Vec<_> = (0..part.triangles.len()).map(|index| part.corners(index)).collect();
    let total: f64 = triangles.iter().map(|corners| area_vector(corners).norm()).sum();
    if !(total > 0.0 && total.is_finite()) {
        return Vec::new();
    }
    let middle = |corners: &[Vector3<f64>; 3]| (corners[0] + corners[1] + corners[2]) / 3.0;
    let share = |corners: &[Vector3<f64>; 3]| area_vector(corners).norm() / total;
    let center: Vector3<f64> = triangles.iter().map(|corners| middle(corners) * share(corners)).sum();
    let (mut places, mut facing) = (Matrix3::zeros(), Matrix3::zeros());
    for corners in &triangles {
        let arms = corners.map(|corner| corner - center);
        let middle = middle(corners) - center;
        // The second moment of a triangle is the sum over its corners and three times its centroid, over
        // twelve.
        let square =
            arms.iter().fold(9.0 * middle * middle.transpose(), |sum, arm| sum + arm * arm.transpose());
        places += square * (share(corners) / 12.0);
        if let Some(normal) = area_vector(corners).try_normalize(0.0) {
            facing += normal * normal.transpose() * share(corners);
        }
    }
    let frames = |tensor: Matrix3<f64>| {
        let vectors = tensor.symmetric_eigen().eigenvectors;
        [0, 1, 2].map(|i| Frame::about(center, &vectors.column(i).into_owned()))
    };
    [frames(places), frames(facing)].concat()
}
