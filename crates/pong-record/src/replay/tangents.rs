//! Tangents of the frames of a log, computed by its replay.

use super::options::ReplayOptions;
use super::replayed_world::Replay;
use super::report::Obstacle;
use crate::error::LogError;
use crate::read::{Frame, Log};
use crate::table::{Row, TangentRow, header};
use pong_engine::{PairTangent, TangentMatrix};
use std::fs::File;
use std::io::{BufWriter, Seek, SeekFrom, Write};
use std::path::Path;

/// Replays a log and writes the tangents of every two movable groups that touch in its frames as a NumPy file of
/// [`TangentRow`]: those of the evaluation of each frame, before its commit, in closed form or by differences where there
/// is none. The recorder pays nothing for them. Returns the number of rows, and the first reason why bristles may differ
/// from those of the run.
///
/// # Errors
/// A log that cannot be read, or whose world cannot be built; a file that cannot be written.
pub fn write_tangents(
    log: &mut Log,
    options: ReplayOptions<'_>,
    path: &Path,
) -> Result<(u64, Option<Obstacle>), LogError> {
    let unwritable = |reason: std::io::Error| LogError::unwritable(path, &reason);
    let mut file = BufWriter::new(File::create(path).map_err(unwritable)?);
    file.write_all(&header(TangentRow::FIELDS, 0, None)).map_err(unwritable)?;
    let mut replay = Replay::new(log, &ReplayOptions { tolerance: Some(0.0), ..options })?;
    let (mut frame, mut bytes) = (Frame::default(), Vec::new());
    let (mut rows, mut obstacle) = (0, None);
    for index in 0..log.frame_count() {
        log.read(index, &mut frame)?;
        let here = replay.obstacle(&frame.row);
        obstacle = obstacle.or(here);
        replay.run(log, &frame)?;
        bytes.clear();
        for tangent in replay.world.complete_tangents()? {
            row(&tangent, &frame).put(&mut bytes);
            rows += 1;
        }
        file.write_all(&bytes).map_err(unwritable)?;
        replay.accept(&frame.row)?;
    }
    // The length of the header does not depend on the number of rows.
    file.seek(SeekFrom::Start(0)).map_err(unwritable)?;
    file.write_all(&header(TangentRow::FIELDS, rows, None)).map_err(unwritable)?;
    file.flush().map_err(unwritable)?;
    Ok((rows, obstacle))
}

fn row(tangent: &PairTangent, frame: &Frame) -> TangentRow {
    let [body_a, body_b] = tangent.groups.map(|group| group.index() as u32);
    TangentRow {
        frame: frame.row.frame,
        time: frame.row.time,
        body_a,
        body_b,
        by_differences: u32::from(tangent.by_differences),
        stiffness: matrix(&tangent.stiffness),
        damping: matrix(&tangent.damping),
    }
}

/// The four blocks as one matrix.
fn matrix(blocks: &[[TangentMatrix; 2]; 2]) -> [[f64; 12]; 12] {
    std::array::from_fn(|row| {
        std::array::from_fn(|column| blocks[row / 6][column / 6][(row % 6, column % 6)])
    })
}
