//! Convex hulls of the point sets of a decomposer.

use crate::piece::{NoHull, Piece, hull};
use crate::seams::Pool;
use crate::solids;
use nalgebra::Vector3;
use pong_import::{Finding, Findings};

/// Hulls of point sets, and the number of sets without thickness.
pub(crate) fn hulls_of(
    found: Vec<Vec<Vector3<f64>>>,
    pool: &mut Pool,
    file: &str,
) -> Result<(Vec<Piece>, usize), Finding> {
    let (mut parts, mut flat) = (Vec::new(), 0);
    let failed = |cause: String| Finding {
        path: file.to_owned(),
        rule: "decomposer-failed",
        cause,
        cure: "try another --resolution or --concavity, or keep a TriangleMesh".to_owned(),
    };
    for points in found {
        let points: Vec<Vector3<f64>> = points.into_iter().map(|place| pool.place(place)).collect();
        match hull(&points) {
            Ok(piece) => parts.push(piece),
            Err(NoHull::Flat) => flat += 1,
            Err(NoHull::Failed) => {
                let at = solids::named(&points[0]);
                return Err(failed(format!(
                    "no hull was found around the {} points of the piece at {at}",
                    points.len()
                )));
            }
        }
    }
    if parts.is_empty() { Err(failed("no piece has a thickness".to_owned())) } else { Ok((parts, flat)) }
}

pub(crate) fn tell_flat(flat: usize, file: &str, findings: &mut Findings) {
    if flat > 0 {
        let cause = format!("{flat} pieces without thickness were left out");
        findings.note(file, "thin-piece", cause, "what that leaves uncovered is in the deficit");
    }
}
