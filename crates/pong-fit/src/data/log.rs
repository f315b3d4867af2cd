//! A response log as measured data: one record with the free bodies of the scene.

use super::record::{Data, Record, Row};
use crate::error::{FitError, Result};
use pong_record::Log;
use std::path::Path;

pub(super) fn load(folder: &Path, bodies: &[String]) -> Result<Data> {
    let mut log = Log::open(folder)?;
    let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let known: Vec<(usize, String)> =
        log.run().bodies.iter().map(|body| body.name.clone()).enumerate().collect();
    let meant: Vec<(usize, String)> = known.into_iter().filter(|(_, name)| bodies.contains(name)).collect();
    if meant.is_empty() {
        let cause = "the log has none of the free bodies of the scene";
        return Err(FitError::new(
            folder.display(),
            cause,
            format!("it must have one of: {}", bodies.join(", ")),
        ));
    }
    let mut record = Record { name, ..Record::default() };
    for index in 0..log.frame_count() {
        let frame = log.frame(index)?;
        if record.times.last().is_some_and(|last| frame.row.time <= *last) {
            continue;
        }
        record.times.push(frame.row.time);
        for (body, name) in &meant {
            let (state, wrench) = (&frame.states[*body], &frame.wrenches[*body]);
            record.rows.push(Row {
                time: record.times.len() - 1,
                body: name.clone(),
                position: Some(state.position.into()),
                orientation: Some(
                    pong_geometry::Pose::new(state.position.into(), state.orientation).orientation,
                ),
                velocity: Some(state.linear_velocity.into()),
                angular_velocity: Some(state.angular_velocity.into()),
                force: Some(wrench.force.into()),
                moment: Some(wrench.moment.into()),
            });
        }
    }
    Ok(Data { records: vec![record], ..Data::default() })
}
