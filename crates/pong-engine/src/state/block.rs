//! Contact state as one flat, versioned, pointer-free block of bytes.
//!
//! ```text
//! magic 8 | version 4 | record count 4 | world hash 8 | ledger 2 × 8
//! | epochs 8, poses of every epoch: 7 × 8 per movable group that is in a pair
//! | if any surface has moved along itself, travels of the surfaces of every epoch: 9 × 8 per movable group that is in a pair
//! | epoch of every pair of Objects: 1 each, 255 without history; zeros up to a multiple of 8
//! | accounts, if kept, per pair of movable groups: PairEnergy::NUMBERS × 8, and 6 × 8 per delay frame of the wrenches
//! | records: RECORD_LEN + 8 × (numbers of its friction law and of its energies) per contact
//! | checksum 8 (FNV-1a of everything before)
//! ```
//!
//! The version is 4 with the travels of surfaces and 3 without. All numbers are little-endian. The length depends on the number of epochs and records; the sealed world
//! limits it. A longer buffer, up to that limit, holds the block followed by zeros.

use super::memory::ContactMemory;
use super::poses::{CommittedPoses, NEVER};
use super::record::{ContactKey, ContactRecord, ContactRole};
use crate::energy::account::{EnergyAccount, WrenchCoupling};
use crate::energy::contact::{ContactEnergies, ContactEnergy, ContactEnergyRef};
use crate::energy::episodes::{PairEnergies, PairEnergy};
use crate::scene::SurfaceField;
use pong_geometry::{Pose, Vec3, Wrench};
use pong_model::{Fnv, LARGEST};

const MAGIC: [u8; 8] = *b"PONGSTAT";
const VERSION: u32 = 3;
/// Version of a block that has the travels of surfaces.
const VERSION_WITH_TRAVELS: u32 = 4;
const TOTALS_AT: usize = 8 + 4 + 4 + 8;
const HEADER_LEN: usize = TOTALS_AT + 2 * 8;
const EPOCHS_AT: usize = HEADER_LEN;
const POSE_LEN: usize = 7 * 8;
const TRAVEL_LEN: usize = 8 * SurfaceField::NUMBERS;
const RECORD_LEN: usize = 8 * 4 + 2 * 4 + 4 * 3 * 8 + 3 * 8;
const CHECKSUM_LEN: usize = 8;

/// Reasons for refusing a block. The world keeps its state.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StateError {
    /// The buffer has the wrong length.
    #[error(
        "contact state: the buffer has {got} bytes where the block has {least}; give as many, or up to {most} of \
         which those behind the block are zero"
    )]
    Length {
        /// Bytes of the block.
        least: usize,
        /// Bytes of the largest block of this world, and so of a buffer that holds one with zeros behind it.
        most: usize,
        /// Bytes given.
        got: usize,
    },
    /// The block does not start like a contact state block.
    #[error(
        "contact state: the bytes are not a contact state block; hand in one that was saved by this engine"
    )]
    Foreign,
    /// The block was written by another version of the format.
    #[error(
        "contact state: the block has format version {got}, this engine reads {VERSION}; save it again with this version"
    )]
    Version {
        /// Version in the block.
        got: u32,
    },
    /// The block belongs to a world that was built by other calls.
    #[error(
        "contact state: the block was saved by a world that was built from other models or other calls; build the world \
         by the same calls in the same order"
    )]
    World,
    /// The block's contents do not match its checksum.
    #[error("contact state: the block is damaged (checksum mismatch); use another copy")]
    Damaged,
}

/// Length of the largest block of a memory, bytes.
pub(crate) fn largest_len(memory: &ContactMemory) -> usize {
    used_len(memory, (memory.poses.capacity(), memory.poses.keeps_travels()), memory.records.capacity())
        + CHECKSUM_LEN
}

/// Length of the block of the current contents, bytes.
pub(crate) fn needed_len(memory: &ContactMemory) -> usize {
    let (_, epochs) = memory.poses.numbered();
    let epochs = (usize::from(epochs), memory.poses.has_travels());
    used_len(memory, epochs, memory.records.len()) + CHECKSUM_LEN
}

fn accounts_len(memory: &ContactMemory) -> usize {
    PairEnergies::block_len(memory.pair_energies.pairs.len(), memory.pair_energies.delay)
}

/// Length of a block with this many epochs, with or without the travels of surfaces, and with this many records,
/// without the checksum, bytes.
fn used_len(memory: &ContactMemory, (epochs, has_travels): (usize, bool), records: usize) -> usize {
    let each = POSE_LEN + if has_travels { TRAVEL_LEN } else { 0 };
    let poses = 8 + epochs * memory.poses.bodies().len() * each + padded(memory.poses.pairs());
    let contacts = records * (RECORD_LEN + 8 * memory.numbers_each());
    HEADER_LEN + poses + accounts_len(memory) + contacts
}

/// Rounds up to a multiple of 8.
fn padded(bytes: usize) -> usize {
    bytes.next_multiple_of(8)
}

/// Writes the block into a buffer of at least [`needed_len`] bytes. The rest of the buffer, up to the largest
/// block, is zeroed, so that buffers of one size can be compared as a whole.
pub(crate) fn write_block(memory: &ContactMemory, world_hash: u64, out: &mut [u8]) -> Result<(), StateError> {
    let (needed, most) = (needed_len(memory), largest_len(memory));
    if out.len() < needed {
        return Err(StateError::Length { least: needed, most, got: out.len() });
    }
    let reached = out.len().min(most);
    out[needed..reached].fill(0);
    let used = write_used(memory, world_hash, &mut out[..needed]);
    let checksum = Fnv::of(&out[..used]);
    out[used..needed].copy_from_slice(&checksum.to_le_bytes());
    Ok(())
}

/// Writes everything except the checksum; returns the number of bytes.
fn write_used(memory: &ContactMemory, world_hash: u64, out: &mut [u8]) -> usize {
    let mut writer = Writer { out, at: 0 };
    writer.bytes(&MAGIC);
    writer.u32(if memory.poses.has_travels() { VERSION_WITH_TRAVELS } else { VERSION });
    writer.u32(memory.records.len() as u32);
    writer.bytes(&world_hash.to_le_bytes());
    writer.f64(memory.work);
    writer.f64(memory.dissipated);
    writer.poses(&memory.poses);
    writer.pair_energies(&memory.pair_energies);
    for entry in memory.iter() {
        writer.record(&entry.record);
        entry.law_state.iter().for_each(|x| writer.f64(*x));
        entry.energy.iter().flat_map(ContactEnergyRef::numbers).for_each(|x| writer.f64(x));
    }
    writer.at
}

/// Reads a block, with or without zeros behind it, into a memory of the same world. `exists` returns true if
/// the primitive of A in a key exists; it is called only for valid pairs.
///
/// # Errors
/// If the block is refused, the memory is unchanged.
pub(crate) fn read_block(
    memory: &mut ContactMemory,
    world_hash: u64,
    block: &[u8],
    exists: impl Fn(&ContactKey) -> bool,
) -> Result<(), StateError> {
    let count = check(memory, world_hash, block, exists)?;
    let has_travels = Reader { block, at: MAGIC.len() }.u32() == VERSION_WITH_TRAVELS;
    let mut reader = Reader { block, at: TOTALS_AT };
    memory.work = reader.f64();
    memory.dissipated = reader.f64();
    reader.poses(&mut memory.poses, has_travels);
    reader.pair_energies(&mut memory.pair_energies);
    memory.clear_records();
    for _ in 0..count {
        let record = reader.record().expect("checked before");
        memory.records.push_with(|slot| *slot = record).expect("no more than the capacity");
        for _ in 0..memory.law_state_len {
            memory.law_state.push(reader.f64()).expect("as many as the records have");
        }
        reader.contact_energy(&mut memory.energies);
    }
    Ok(())
}

/// Validates a block; returns the number of its records.
fn check(
    like: &ContactMemory,
    world_hash: u64,
    block: &[u8],
    exists: impl Fn(&ContactKey) -> bool,
) -> Result<usize, StateError> {
    if block.len() < HEADER_LEN || block[..8] != MAGIC {
        return Err(StateError::Foreign);
    }
    let mut reader = Reader { block, at: 8 };
    let version = reader.u32();
    if ![VERSION, VERSION_WITH_TRAVELS].contains(&version) {
        return Err(StateError::Version { got: version });
    }
    let count = reader.u32() as usize;
    if reader.u64() != world_hash {
        return Err(StateError::World);
    }
    // Reject an impossible count before it enters a length.
    if count > like.records.capacity() {
        return Err(StateError::Damaged);
    }
    reader.at = EPOCHS_AT;
    let epochs = if block.len() < EPOCHS_AT + 8 { 0 } else { reader.u64() as usize };
    // Likewise for an impossible number of epochs.
    if epochs > like.poses.capacity() {
        return Err(StateError::Damaged);
    }
    let has_travels = version == VERSION_WITH_TRAVELS;
    if has_travels && !like.poses.keeps_travels() {
        return Err(StateError::World);
    }
    let used = used_len(like, (epochs, has_travels), count);
    let (least, most) = (used + CHECKSUM_LEN, largest_len(like));
    if !(least..=most).contains(&block.len()) {
        return Err(StateError::Length { least, most, got: block.len() });
    }
    let (block, behind) = block.split_at(least);
    let (contents, checksum) = block.split_at(used);
    if Fnv::of(contents).to_le_bytes() != checksum || !is_zero(behind) {
        return Err(StateError::Damaged);
    }
    reader.at = TOTALS_AT;
    let totals = [reader.f64(), reader.f64()];
    let poses_make_sense = poses_make_sense(&like.poses, &mut reader, has_travels);
    let accounts_make_sense = (0..accounts_len(like) / 8).all(|_| reader.f64().is_finite());
    let finite = totals.iter().all(|x| x.is_finite()) && poses_make_sense && accounts_make_sense;
    match finite && records_make_sense(like, reader, count, exists) {
        true => Ok(count),
        false => Err(StateError::Damaged),
    }
}

/// Returns true if all poses are valid host poses, all travels are numbers that a host may set, and every pair's
/// epoch exists.
fn poses_make_sense(like: &CommittedPoses, reader: &mut Reader<'_>, has_travels: bool) -> bool {
    let epochs = reader.u64();
    // NaN fails both comparisons. No component of a unit quaternion exceeds 1 by more than rounding.
    let can_be = |pose: &Pose| {
        pose.position.iter().all(|x| x.abs() <= LARGEST)
            && pose.orientation.coords.iter().all(|x| x.abs() < 2.0)
    };
    let count = epochs as usize * like.bodies().len();
    let poses_can_be = (0..count).fold(true, |all, _| can_be(&reader.pose()) && all);
    let numbers = if has_travels { count * SurfaceField::NUMBERS } else { 0 };
    let travels_can_be = (0..numbers).fold(true, |all, _| reader.f64().abs() <= LARGEST && all);
    let epochs_of = reader.bytes(padded(like.pairs()));
    let (pairs, behind) = epochs_of.split_at(like.pairs());
    poses_can_be
        && travels_can_be
        && pairs.iter().all(|epoch| *epoch == NEVER || u64::from(*epoch) < epochs)
        && is_zero(behind)
}

fn is_finite_record(record: &ContactRecord) -> bool {
    let vectors = [&record.normal_b, &record.point_b, &record.bristle_b, &record.force_b];
    let numbers = [record.stored, record.work, record.dissipated];
    vectors.into_iter().flatten().chain(&numbers).all(|x| x.is_finite())
}

/// Returns true if every record is valid and the keys are in order, as all lookups require.
fn records_make_sense(
    like: &ContactMemory,
    mut reader: Reader<'_>,
    count: usize,
    exists: impl Fn(&ContactKey) -> bool,
) -> bool {
    let mut last = ContactKey::default();
    (0..count).all(|_| {
        let record = reader.record();
        reader.at += 8 * like.numbers_each();
        record.is_some_and(|record| {
            let in_order = last <= record.key;
            last = record.key;
            in_order
                && is_finite_record(&record)
                && (record.key.group_pair as usize) < like.group_pairs
                && record.key.flipped < 2
                && exists(&record.key)
        })
    })
}

/// Returns true if all bytes are zero. It compares pieces of 64 bytes at once, because there can be a
/// megabyte of zeros.
fn is_zero(bytes: &[u8]) -> bool {
    let (pieces, rest) = bytes.as_chunks::<64>();
    pieces.iter().all(|piece| piece.iter().fold(0, |any, byte| any | byte) == 0)
        && rest.iter().all(|byte| *byte == 0)
}

struct Writer<'a> {
    out: &'a mut [u8],
    at: usize,
}

impl Writer<'_> {
    fn bytes(&mut self, bytes: &[u8]) {
        self.out[self.at..self.at + bytes.len()].copy_from_slice(bytes);
        self.at += bytes.len();
    }

    fn u32(&mut self, value: u32) {
        self.bytes(&value.to_le_bytes());
    }

    fn f64(&mut self, value: f64) {
        self.bytes(&value.to_le_bytes());
    }

    fn vec3(&mut self, v: &Vec3) {
        v.iter().for_each(|x| self.f64(*x));
    }

    fn poses(&mut self, poses: &CommittedPoses) {
        let (number, count) = poses.numbered();
        self.bytes(&u64::from(count).to_le_bytes());
        for wanted in 0..count {
            let epoch = number.iter().position(|number| *number == wanted).expect("as many as are numbered");
            for &body in poses.bodies() {
                let pose = poses.pose(epoch as u8, body);
                self.vec3(&pose.position);
                pose.orientation.coords.iter().for_each(|x| self.f64(*x));
            }
        }
        let written = if poses.has_travels() { count } else { 0 };
        for wanted in 0..written {
            let epoch = number.iter().position(|number| *number == wanted).expect("as many as are numbered");
            for &body in poses.bodies() {
                poses.travel_in(epoch as u8, body).numbers().iter().for_each(|x| self.f64(*x));
            }
        }
        for pair in 0..poses.pairs() {
            self.bytes(&[number[usize::from(poses.epoch_of(pair))]]);
        }
        for _ in poses.pairs()..padded(poses.pairs()) {
            self.bytes(&[0]);
        }
    }

    fn pair_energies(&mut self, energies: &PairEnergies) {
        energies.pairs.iter().flat_map(PairEnergy::numbers).for_each(|x| self.f64(x));
        for wrench in &energies.delayed {
            self.vec3(&wrench.force);
            self.vec3(&wrench.moment);
        }
    }

    fn record(&mut self, record: &ContactRecord) {
        let key = &record.key;
        for word in [key.group_pair, key.flipped, key.primitive_a, key.shell_b, key.end] {
            self.u32(word);
        }
        for word in [record.feature, record.element_b, record.entry_face] {
            self.u32(word);
        }
        self.u32(u32::from(record.sticks));
        self.u32(record.role.to_word());
        for v in [&record.normal_b, &record.point_b, &record.bristle_b, &record.force_b] {
            self.vec3(v);
        }
        for x in [record.stored, record.work, record.dissipated] {
            self.f64(x);
        }
    }
}

struct Reader<'a> {
    block: &'a [u8],
    at: usize,
}

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let bytes = self.block[self.at..self.at + N].try_into().expect("N bytes");
        self.at += N;
        bytes
    }

    fn bytes(&mut self, count: usize) -> &[u8] {
        self.at += count;
        &self.block[self.at - count..self.at]
    }

    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take())
    }

    fn u64(&mut self) -> u64 {
        u64::from_le_bytes(self.take())
    }

    fn f64(&mut self) -> f64 {
        f64::from_le_bytes(self.take())
    }

    fn vec3(&mut self) -> Vec3 {
        Vec3::new(self.f64(), self.f64(), self.f64())
    }

    fn pose(&mut self) -> Pose {
        let position = self.vec3();
        let [x, y, z, w] = [self.f64(), self.f64(), self.f64(), self.f64()];
        // Not normalised: stored quaternions are unit quaternions, and normalising again would change their
        // bits.
        let orientation = nalgebra::Unit::new_unchecked(nalgebra::Quaternion::new(w, x, y, z));
        Pose { position, orientation }
    }

    fn poses(&mut self, poses: &mut CommittedPoses, has_travels: bool) {
        let count = self.u64() as u8;
        for epoch in 0..count {
            for place in 0..poses.bodies().len() {
                let body = poses.bodies()[place];
                poses.put_pose(epoch, body, self.pose());
            }
        }
        poses.drop_travels();
        if has_travels {
            self.travels(poses, count);
        }
        let epochs = self.bytes(padded(poses.pairs()));
        poses.put_epochs(count, epochs.iter().copied());
    }

    fn travels(&mut self, poses: &mut CommittedPoses, epochs: u8) {
        poses.use_travels();
        for epoch in 0..epochs {
            for place in 0..poses.bodies().len() {
                let travel = SurfaceField::from_numbers(&std::array::from_fn(|_| self.f64()));
                poses.put_travel(epoch, poses.bodies()[place], &travel);
            }
        }
    }

    fn wrench(&mut self) -> Wrench {
        Wrench { force: self.vec3(), moment: self.vec3() }
    }

    fn pair_energies(&mut self, energies: &mut PairEnergies) {
        for energy in &mut energies.pairs {
            *energy = PairEnergy::from_numbers(&std::array::from_fn(|_| self.f64()));
        }
        energies.delayed.iter_mut().for_each(|wrench| *wrench = self.wrench());
    }

    /// Reads the energies of the last record.
    fn contact_energy(&mut self, energies: &mut ContactEnergies) {
        if energies.numbers() == 0 {
            return;
        }
        let account =
            EnergyAccount::from_numbers(&std::array::from_fn::<_, { EnergyAccount::NUMBERS }, _>(|_| {
                self.f64()
            }));
        let energy = ContactEnergy { account, bristle: self.f64() };
        let mut delayed = [Wrench::zero(); WrenchCoupling::DELAY_FRAMES_MAX as usize];
        let delayed = &mut delayed[..energies.delay()];
        delayed.iter_mut().for_each(|wrench| *wrench = self.wrench());
        let read = ContactEnergyRef { energy: &energy, delayed };
        energies.push(Some(read)).expect("as much room as for records");
    }

    fn record(&mut self) -> Option<ContactRecord> {
        let key = ContactKey {
            group_pair: self.u32(),
            flipped: self.u32(),
            primitive_a: self.u32(),
            shell_b: self.u32(),
            end: self.u32(),
        };
        Some(ContactRecord {
            key,
            feature: self.u32(),
            element_b: self.u32(),
            entry_face: self.u32(),
            sticks: self.u32() != 0,
            role: ContactRole::from_word(self.u32())?,
            normal_b: self.vec3(),
            point_b: self.vec3(),
            bristle_b: self.vec3(),
            force_b: self.vec3(),
            stored: self.f64(),
            work: self.f64(),
            dissipated: self.f64(),
        })
    }
}
