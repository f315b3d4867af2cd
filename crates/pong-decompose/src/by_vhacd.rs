//! Pieces of a solid by cuts along flat faces and by VHACD, whichever fits best.

use crate::cells::{Features, Looking, cells};
use crate::content::{Cell, content};
use crate::flats::{Cutting, Judged};
use crate::hulls::{hulls_of, tell_flat};
use crate::inside::Solid;
use crate::join::join;
use crate::options::DecomposeOptions;
use crate::piece::{Piece, hull};
use crate::seams::Pool;
use crate::solids::SolidMesh;
use pong_import::mesh;
use pong_import::{Finding, Findings};

/// Weights of balance and symmetry for VHACD: its defaults, then two pairs that cut rings and cups well.
const WEIGHTS: [(f64, f64); 3] = [(0.05, 0.05), (0.5, 0.05), (0.05, 0.5)];

/// A set of cuts and its outcome.
struct Attempt {
    pieces: Vec<Piece>,
    forced: usize,
    flat: usize,
}

/// Pieces of the attempt that exceeds the solid by the least volume (nearly equal: of the fewest pieces), and
/// its number of joints that added volume.
pub(crate) fn pieces(
    solid: &SolidMesh,
    options: &DecomposeOptions,
    (pieces_max, near_m): (usize, f64),
    pool: &mut Pool,
    file: &str,
    progress: &mut dyn FnMut(&str),
    findings: &mut Findings,
) -> Option<(Vec<Piece>, usize)> {
    let failed = |cause: &str| Finding {
        path: file.to_owned(),
        rule: "decomposer-failed",
        cause: cause.to_owned(),
        cure: "try another --resolution, or --method coacd".to_owned(),
    };
    let Some(inside) = Solid::new(&solid.mesh) else {
        findings.faults.push(failed("the mesh has no inside"));
        return None;
    };
    let whole_m3 = hull(&solid.mesh.vertices).map_or(0.0, |piece| piece.volume_m3);
    let concavity = options.concavity.unwrap_or(0.005);
    let features = Features::of(&solid.mesh);
    let allowed_m3 = concavity * whole_m3;
    let cutting = Cutting { mesh: &solid.mesh, solid: &inside, features: &features, allowed_m3 };
    let by_flats = cutting.cells();
    let mut ways: Vec<Vec<Cell>> = Vec::new();
    if by_flats.iter().all(|judged| cutting.is_convex(judged)) {
        ways.push(by_flats.iter().map(|judged| judged.cell).collect());
    } else {
        for (number, (balance, symmetry)) in WEIGHTS.into_iter().enumerate() {
            progress(&format!("voxels, weights {} of {}", number + 1, WEIGHTS.len()));
            let resolution = options.resolution.unwrap_or(100);
            let looking =
                Looking { resolution, concavity, pieces_max, hollow: solid.hollow, balance, symmetry };
            let Some(found) = cells(&solid.mesh, &features, &looking) else { continue };
            if by_flats.len() > 1 {
                ways.push(refined(&by_flats, &cutting, &found));
            }
            ways.push(found);
        }
    }
    let mut attempts = Vec::new();
    let mut fault = failed("VHACD gave up on this mesh");
    let count = ways.len();
    for (number, cells) in ways.into_iter().enumerate() {
        progress(&format!("joining {} pieces, way {} of {count}", cells.len(), number + 1));
        let contents = cells.iter().map(|cell| content(&solid.mesh, &inside, cell).points);
        match hulls_of(contents.filter(|points| !points.is_empty()).collect(), pool, file) {
            Ok((mut pieces, flat)) => {
                let forced = join(&mut pieces, pieces_max, near_m);
                attempts.push(Attempt { pieces, forced, flat });
            }
            Err(reason) => fault = reason,
        }
    }
    let step_m3 = (0.5 * allowed_m3).max(1e-6 * whole_m3);
    let Some(best) = best(attempts, mesh::volume_m3(&solid.mesh), step_m3, pieces_max) else {
        findings.faults.push(fault);
        return None;
    };
    tell_flat(best.flat, file, findings);
    Some((best.pieces, best.forced))
}

/// Cells along flat faces; cells whose content is not convex are cut further.
fn refined(by_flats: &[Judged], cutting: &Cutting<'_>, found: &[Cell]) -> Vec<Cell> {
    let parts = |judged: &Judged| match cutting.is_convex(judged) {
        true => vec![judged.cell],
        false => found.iter().filter_map(|cell| cell.common(&judged.cell)).collect(),
    };
    by_flats.iter().flat_map(parts).collect()
}

/// Best attempt: few enough pieces, then least excess in steps of `step_m3`, then fewest pieces, then the
/// first.
fn best(attempts: Vec<Attempt>, volume_m3: f64, step_m3: f64, pieces_max: usize) -> Option<Attempt> {
    let rank = |attempt: &Attempt| {
        let pieces_m3: f64 = attempt.pieces.iter().map(|piece| piece.volume_m3).sum();
        let steps = ((pieces_m3 - volume_m3).max(0.0) / step_m3).floor();
        (attempt.pieces.len() > pieces_max, steps as u64, attempt.pieces.len())
    };
    attempts.into_iter().min_by_key(rank)
}
