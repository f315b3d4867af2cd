//! Frames of nodes relative to their rigid body.

use crate::affine::{Affine, Skew};
use crate::findings::Findings;
use crate::number::Grid;
use nalgebra::Matrix3;

/// The frame of a movable group.
pub(super) struct BodyFrame {
    /// Position in the frame of the parent movable group, m, and orientation (w, x, y, z).
    pub(super) position: [f64; 3],
    pub(super) orientation: [f64; 4],
    /// Remaining (non-rigid) transform for everything below, from the node to its rigid frame.
    pub(super) rest: Affine,
}

/// Splits the transform of a movable node to the body above; `None` after a fault.
pub(super) fn body_frame(
    to_body: &Affine,
    grid: Grid,
    path: &str,
    findings: &mut Findings,
) -> Option<BodyFrame> {
    let stretch = match to_body.stretch() {
        Ok(stretch) => stretch,
        Err(Skew::Flat) => {
            let cause = "a scale of zero leaves no frame for this movable group";
            return findings.refuse(path, "flat-frame", cause, "correct its scale and those of its parents");
        }
        Err(Skew::Sheared(cosine)) => {
            let cause = format!("its frame is sheared: the cosine between two axes is {cosine:.1e}");
            let cure =
                "apply the scale of its parents: a turned child of an unevenly scaled parent is sheared";
            return findings.refuse(path, "sheared-frame", cause, cure);
        }
    };
    if stretch.mirrored {
        let cause = "its frame is mirrored: a movable group needs a right-handed one";
        return findings.refuse(
            path,
            "mirrored-frame",
            cause,
            "apply its negative scale, or that of its parents",
        );
    }
    let scale = stretch.scale.map(|s| if (s - 1.0).abs() < 1e-12 { 1.0 } else { s });
    if scale.iter().any(|s| *s != 1.0) {
        let cause =
            format!("its scale of ({}, {}, {}) went into what hangs below", scale.x, scale.y, scale.z);
        findings.note(path, "scaled-frame", cause, "");
    }
    let turn = stretch.turn.quaternion();
    let sign = if turn.w < 0.0 { -1.0 } else { 1.0 };
    let orientation = [turn.w, turn.i, turn.j, turn.k].map(|x| Grid::of_size(1.0).round(sign * x));
    let position = grid.round_place(&to_body.translation).into();
    let rest = Affine { linear: Matrix3::from_diagonal(&scale), ..Affine::identity() };
    Some(BodyFrame { position, orientation, rest })
}
