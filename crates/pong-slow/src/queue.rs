//! Wrenches on their way to a host that applies them some frames late (docs/theory.md, 9).

use crate::body::Body;
use crate::error::SlowError;
use crate::memory::Memory;
use crate::system::System;
use nalgebra::Vector6;
use std::collections::VecDeque;

/// Impulses that the host will apply before the one that is computed now, the oldest first; zero before the first
/// frame.
pub(crate) fn under_way(
    memory: &Memory,
    index: usize,
    body: &Body,
    delay_frames: u32,
) -> VecDeque<Vector6<f64>> {
    let length = delay_frames as usize;
    let kept = memory.of(index, body.axes).filter(|kept| kept.queue.len() == length);
    kept.map_or_else(|| VecDeque::from(vec![Vector6::zeros(); length]), |kept| kept.queue.clone())
}

/// Moves the bodies to the time at which the impulses that are computed now will act.
pub(crate) fn carry_forward(
    system: &mut System,
    queues: &[VecDeque<Vector6<f64>>],
    theta: f64,
    length: f64,
) -> Result<(), SlowError> {
    let frames = queues.first().map_or(0, VecDeque::len);
    for frame in 0..frames {
        let impulses: Vec<_> = queues.iter().map(|queue| queue[frame]).collect();
        system.advance(&impulses, theta, length)?;
    }
    Ok(())
}
