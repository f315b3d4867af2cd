//! The contact memory as it was before its size was fixed: for the callers that have not moved over to
//! `memory::ContactMemory` yet. It goes when the last of them has.

use super::block;
use super::memory::{self, ContactKey, ContactRecord, PairPose, Role};
use crate::state::StateError;
use pong_geometry::Vec3;

/// All contact state of a world.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ContactMemory {
    /// One per pair of movable groups.
    pub poses: Vec<PairPose>,
    /// Sorted by key, then piece and feature.
    pub records: Vec<ContactRecord>,
    /// Numbers of registered friction laws: `custom_stride` per record.
    pub custom: Vec<f64>,
    /// How many numbers each record has in `custom`.
    pub custom_stride: usize,
    /// Energy that left the contacts for good since the world began, J.
    pub dissipated: f64,
    /// Work done on the bodies since the world began, J.
    pub work: f64,
}

impl ContactMemory {
    pub fn new(group_pairs: usize, custom_stride: usize) -> Self {
        Self { poses: vec![PairPose::unknown(); group_pairs], custom_stride, ..Self::default() }
    }

    /// The records under one key, with the index of the first.
    pub fn under(&self, key: &ContactKey) -> (usize, &[ContactRecord]) {
        let first = self.records.partition_point(|record| record.key < *key);
        let count = self.records[first..].partition_point(|record| record.key == *key);
        (first, &self.records[first..first + count])
    }

    /// The record of the given role that a present contact with normal `n` continues: the one under its key with
    /// the largest n·n', ties by feature, if that exceeds ½.
    pub fn matching(&self, key: &ContactKey, normal: &Vec3, role: Role) -> Option<usize> {
        let (first, records) = self.under(key);
        let mut best: Option<(usize, f64)> = None;
        for (i, record) in records.iter().enumerate().filter(|(_, record)| record.role == role) {
            let cosine = record.normal.dot(normal);
            let closer = match best {
                None => cosine > 0.5,
                Some((b, most)) => cosine > most || (cosine == most && record.feature < records[b].feature),
            };
            if closer {
                best = Some((i, cosine));
            }
        }
        best.map(|(i, _)| first + i)
    }

    /// The custom numbers of a record.
    pub fn custom_of(&self, record: usize) -> &[f64] {
        &self.custom[record * self.custom_stride..(record + 1) * self.custom_stride]
    }

    /// Drops everything remembered of the pairs of movable groups that `forgotten` names.
    pub fn forget(&mut self, forgotten: impl Fn(u32) -> bool) {
        for (index, pose) in self.poses.iter_mut().enumerate() {
            if forgotten(index as u32) {
                *pose = PairPose::unknown();
            }
        }
        let stride = self.custom_stride;
        let kept: Vec<usize> =
            (0..self.records.len()).filter(|&i| !forgotten(self.records[i].key.group_pair)).collect();
        self.custom = kept.iter().flat_map(|&i| self.custom[i * stride..(i + 1) * stride].to_vec()).collect();
        self.records = kept.iter().map(|&i| self.records[i]).collect();
    }

    /// Takes over what `trial` holds of the pairs of movable groups that `accepted` names and keeps the rest.
    pub fn accept(&mut self, trial: &ContactMemory, accepted: impl Fn(u32) -> bool) {
        let stride = self.custom_stride;
        let mut merged = ContactMemory { poses: self.poses.clone(), ..ContactMemory::new(0, stride) };
        merged.dissipated = self.dissipated;
        merged.work = self.work;
        for (index, pose) in merged.poses.iter_mut().enumerate() {
            if accepted(index as u32) {
                *pose = trial.poses[index];
            }
        }
        for index in 0..self.poses.len() as u32 {
            let source: &ContactMemory = if accepted(index) { trial } else { self };
            let first = source.records.partition_point(|record| record.key.group_pair < index);
            let count = source.records[first..].partition_point(|record| record.key.group_pair == index);
            merged.records.extend_from_slice(&source.records[first..first + count]);
            merged.custom.extend_from_slice(&source.custom[first * stride..(first + count) * stride]);
        }
        *self = merged;
    }
}

/// Writes the block. `out` must have the length that `block_len` gives.
pub(crate) fn write_block(
    memory: &ContactMemory,
    world_hash: u64,
    capacity: usize,
    out: &mut [u8],
) -> Result<(), StateError> {
    let mut fixed = memory::ContactMemory::with_capacity(memory.poses.len(), capacity, memory.custom_stride);
    fixed.poses.copy_from_slice(&memory.poses);
    (fixed.work, fixed.dissipated) = (memory.work, memory.dissipated);
    for (i, record) in memory.records.iter().enumerate() {
        fixed.push(record, memory.custom_of(i)).expect("no more records than the world's capacity");
    }
    block::write_block(&fixed, world_hash, out)
}

/// Reads a block back; `like` gives the shape that the world expects.
pub(crate) fn read_block(
    like: &ContactMemory,
    world_hash: u64,
    capacity: usize,
    bytes: &[u8],
) -> Result<ContactMemory, StateError> {
    let mut fixed = memory::ContactMemory::with_capacity(like.poses.len(), capacity, like.custom_stride);
    block::read_block(&mut fixed, world_hash, bytes)?;
    Ok(ContactMemory {
        poses: fixed.poses.to_vec(),
        records: fixed.records.to_vec(),
        custom: fixed.custom.to_vec(),
        custom_stride: fixed.custom_stride,
        dissipated: fixed.dissipated,
        work: fixed.work,
    })
}
