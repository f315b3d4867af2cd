//! Contact memory against slow reference models, and blocks that must be refused.

use super::block::{StateError, largest_len, needed_len, write_block};
use super::memory::{ContactMemory, RecordEntry};
use super::poses::{CommittedPoses, NEVER, Past};
use super::record::{ContactKey, ContactRecord, ContactRole};
use super::records::Records;
use super::records::RecordsOfKey;
use crate::energy::LedgerEntry;
use crate::energy::account::{EnergyAccount, WrenchCoupling};
use crate::energy::contact::{ContactEnergies, ContactEnergy, ContactEnergyRef};
use crate::energy::episodes::PairEnergies;
use pong_geometry::{Pose, Quat, Vec3, Wrench};
use pong_model::Fnv;
use pong_testkit::Random;

/// Delay of the wrench in frames, if energies are kept.
const DELAY: u32 = 2;
const GROUP_PAIRS: usize = 5;
/// Movable groups in pairs; group 2 has none.
const BODIES: [usize; 3] = [0, 1, 3];
const ALL_BODIES: usize = 4;
const EPOCHS: u8 = 3;
const CAPACITY: usize = 24;
const WORLD: u64 = 0x5eed;

fn read_block(memory: &mut ContactMemory, world: u64, block: &[u8]) -> Result<(), StateError> {
    super::block::read_block(memory, world, block, |_| true)
}

fn pose_of(random: &mut Random) -> Pose {
    let [w, x, y, z] = [random.unit(), random.unit(), random.unit(), random.unit()];
    let orientation = Quat::new_unchecked(nalgebra::Quaternion::new(w, x, y, z));
    Pose { position: random.vector(0.5), orientation }
}

fn poses_of_all(random: &mut Random) -> Vec<Pose> {
    (0..ALL_BODIES).map(|_| pose_of(random)).collect()
}

fn poses_of(random: &mut Random) -> CommittedPoses {
    let mut poses = CommittedPoses::new(BODIES.into(), ALL_BODIES, GROUP_PAIRS);
    for epoch in 0..EPOCHS {
        BODIES.iter().for_each(|&body| poses.put_pose(epoch, body, pose_of(random)));
    }
    let epochs = [0; GROUP_PAIRS].map(|_| [0, 1, 2, NEVER][random.below(4)]);
    poses.put_epochs(EPOCHS, epochs.into_iter());
    poses
}

fn record_of(random: &mut Random) -> ContactRecord {
    let role = [ContactRole::Active, ContactRole::Active, ContactRole::WrongSide, ContactRole::Tracked]
        [random.below(4)];
    // Few different forces, so that there are ties.
    let force = if role == ContactRole::Active { Vec3::x() * random.below(4) as f64 } else { Vec3::zeros() };
    let key = ContactKey {
        group_pair: random.below(GROUP_PAIRS) as u32,
        flipped: random.below(2) as u32,
        primitive_a: random.below(9) as u32,
        shell_b: random.below(9) as u32,
        end: random.below(2) as u32,
    };
    ContactRecord {
        key,
        feature: random.bits() as u32,
        element_b: random.bits() as u32,
        entry_face: random.bits() as u32,
        sticks: random.below(2) == 1,
        role,
        normal_b: random.vector(0.5),
        point_b: random.vector(0.5),
        bristle_b: random.vector(0.5),
        force_b: force,
        stored: random.unit(),
        work: random.unit(),
        dissipated: random.unit(),
    }
}

/// A memory with this many records and no energies.
fn memory_of(random: &mut Random, records: usize, stride: usize) -> ContactMemory {
    memory_with(random, records, stride, None)
}

/// A memory with this many records; energies are kept if `stride` is odd.
fn memory_with_energies(random: &mut Random, records: usize, stride: usize) -> ContactMemory {
    let held = WrenchCoupling::ZeroOrderHold { delay_frames: DELAY };
    memory_with(random, records, stride, (stride % 2 == 1).then_some(held))
}

fn memory_with(
    random: &mut Random,
    records: usize,
    stride: usize,
    coupling: Option<WrenchCoupling>,
) -> ContactMemory {
    let energies = ContactEnergies::with_capacity(coupling, CAPACITY);
    let mut memory = ContactMemory::with_capacity(poses_of(random), GROUP_PAIRS, CAPACITY, stride)
        .with_energies(energies, PairEnergies::default());
    (memory.work, memory.dissipated) = (random.unit(), random.unit());
    let mut fresh: Vec<ContactRecord> = (0..records).map(|_| record_of(random)).collect();
    fresh.sort_by_key(|record| record.key);
    for record in fresh {
        let law_state: Vec<f64> = (0..stride).map(|_| random.unit()).collect();
        let Some(coupling) = coupling else {
            memory.push(&RecordEntry { record, law_state: &law_state, energy: None }).unwrap();
            continue;
        };
        let account = EnergyAccount {
            work_in: random.unit(),
            friction_loss: random.unit(),
            ..EnergyAccount::default()
        };
        let energy = ContactEnergy { account, bristle: random.unit() };
        let wrench = |_| Wrench { force: random.vector(0.5), moment: random.vector(0.5) };
        let delayed: Vec<Wrench> = (0..coupling.delay()).map(wrench).collect();
        let energy = Some(ContactEnergyRef { energy: &energy, delayed: &delayed });
        memory.push(&RecordEntry { record, law_state: &law_state, energy }).unwrap();
    }
    memory
}
/// Records as the slow reference model stores them.
fn listed(memory: &ContactMemory) -> Vec<(ContactRecord, Vec<f64>)> {
    let numbers = |remembered: &RecordEntry<'_>| {
        let energy = remembered.energy.iter().flat_map(ContactEnergyRef::numbers);
        remembered.law_state.iter().copied().chain(energy).collect()
    };
    memory.iter().map(|remembered| (remembered.record, numbers(&remembered))).collect()
}

fn entries_of(memory: &ContactMemory) -> impl Iterator<Item = RecordEntry<'_>> + Clone {
    memory.iter()
}

/// Two memories: in early rounds they fit together into one, in later rounds not always.
fn two_memories(random: &mut Random, round: u32) -> (ContactMemory, ContactMemory) {
    let stride = round as usize % 4;
    let (least, most) = if round < 200 { (0, CAPACITY / 2) } else { (CAPACITY - 3, CAPACITY) };
    let [first, second] = [0, 1].map(|_| least + random.below(most - least + 1));
    (memory_with_energies(random, first, stride), memory_with_energies(random, second, stride))
}

#[test]
fn a_contact_is_remembered_in_at_most_160_bytes() {
    assert!(size_of::<ContactRecord>() <= 160, "{}", size_of::<ContactRecord>());
}

#[test]
fn forgetting_keeps_all_else_in_order_with_its_numbers() {
    let mut random = Random(1);
    for round in 0..300 {
        let count = random.below(CAPACITY + 1);
        let memory = memory_with_energies(&mut random, count, round % 4);
        let forgotten = random.below(1 << GROUP_PAIRS);
        let is_forgotten = |pair: u32| forgotten >> pair & 1 == 1;
        let mut left = memory.clone();
        left.clear_history(|pair| is_forgotten(pair as u32), |group_pair| group_pair as usize, false);
        let mut expected = listed(&memory);
        expected.retain(|(record, _)| !is_forgotten(record.key.group_pair));
        assert_eq!(listed(&left), expected);
        assert_eq!(left.law_state.len(), left.records.len() * left.law_state_len);
        for pair in 0..GROUP_PAIRS {
            let before = past_of(&memory.poses, pair).filter(|_| !is_forgotten(pair as u32));
            assert_eq!(past_of(&left.poses, pair), before);
        }
        assert_eq!((left.work, left.dissipated), (memory.work, memory.dissipated));
    }
}

/// Poses at a pair's last commit, as the slow reference model stores them.
fn past_of(poses: &CommittedPoses, pair: usize) -> Option<Vec<Pose>> {
    let epoch = poses.epoch_of(pair);
    (epoch != NEVER).then(|| BODIES.iter().map(|&body| *poses.pose(epoch, body)).collect())
}

/// Two states of a world are swapped as in frames, against a model that stores the poses of every pair.
#[test]
fn the_past_of_every_pair_is_that_of_its_last_commit() {
    let mut random = Random(10);
    let empty = CommittedPoses::new(BODIES.into(), ALL_BODIES, GROUP_PAIRS);
    let (mut committed, mut spare) = (empty.clone(), empty);
    let mut expected = vec![None; GROUP_PAIRS];
    let mut enabled = [true; GROUP_PAIRS];
    for round in 0..3000 {
        let now = poses_of_all(&mut random);
        let seen = || Some(BODIES.iter().map(|&body| now[body]).collect::<Vec<_>>());
        let chosen = random.below(1 << GROUP_PAIRS);
        let is_chosen = |pair: usize| chosen >> pair & 1 == 1;
        match random.below(8) {
            0 => {
                let pair = random.below(GROUP_PAIRS);
                enabled[pair] = !enabled[pair];
                spare.copy_from(&committed);
                spare.clear_history(|other| other == pair);
                expected[pair] = None;
            }
            1 => {
                spare.copy_from(&committed);
                spare.clear_history(is_chosen);
                (0..GROUP_PAIRS).filter(|&pair| is_chosen(pair)).for_each(|pair| expected[pair] = None);
            }
            2 | 3 if chosen > 0 => {
                let epoch = committed.free_epoch(is_chosen).expect("a small world has room for every pair");
                spare.commit_some(&committed, (&now, &enabled), epoch, is_chosen);
                for pair in (0..GROUP_PAIRS).filter(|&pair| is_chosen(pair)) {
                    expected[pair] = seen().filter(|_| enabled[pair]);
                }
            }
            _ => {
                spare.commit(&committed, (1, &now), &enabled);
                assert_eq!(spare.past(), Past::OneEpoch);
                expected = enabled.map(|on| seen().filter(|_| on)).to_vec();
            }
        }
        std::mem::swap(&mut committed, &mut spare);
        let known: Vec<_> = (0..GROUP_PAIRS).map(|pair| past_of(&committed, pair)).collect();
        assert!(known == expected, "round {round}");
        assert_eq!(committed.knows_any(), expected.iter().any(Option::is_some));
        let other = committed.epoch_of.iter().any(|epoch| *epoch != NEVER && *epoch != 0);
        assert!(!other || committed.past() == Past::Several);
    }
}

/// A large world has room for few epochs; if all are in use, committing their pairs together frees some.
#[test]
fn a_large_world_has_room_for_few_epochs() {
    let bodies: Vec<usize> = (0..4096).collect();
    let mut poses = CommittedPoses::new(bodies.into(), 4096, 20);
    assert_eq!(poses.capacity(), 8);
    let (now, enabled) = (vec![Pose::identity(); 4096], [true; 20]);
    for pair in 0..8 {
        let epoch = poses.free_epoch(|other| other == pair).unwrap();
        let before = poses.clone();
        poses.commit_some(&before, (&now, &enabled), epoch, |other| other == pair);
    }
    assert_eq!(poses.free_epoch(|other| other == 8), None);
    assert!(poses.free_epoch(|other| other == 7).is_some());
    assert!(poses.free_epoch(|_| true).is_some());
}

#[test]
fn a_commit_of_some_pairs_replaces_theirs_and_keeps_the_rest() {
    let mut random = Random(2);
    let mut next = [0, 1, 2, 3].map(|stride| memory_with_energies(&mut random, CAPACITY, stride));
    let mut overflows = 0;
    for round in 0..600 {
        let (memory, trial) = two_memories(&mut random, round);
        let accepted = random.below(1 << GROUP_PAIRS);
        let is_accepted = |pair: u32| accepted >> pair & 1 == 1;
        let next = &mut next[memory.law_state_len];
        let added: Vec<LedgerEntry> = (0..GROUP_PAIRS)
            .map(|_| LedgerEntry { work: random.between(-1.0, 1.0), dissipated: 0.5 })
            .collect();
        let left_out =
            memory.merge_into(entries_of(&trial), (&trial.pair_energies, &added), is_accepted, next);

        let mut expected = listed(&memory);
        expected.retain(|(record, _)| !is_accepted(record.key.group_pair));
        expected.extend(listed(&trial).into_iter().filter(|(record, _)| is_accepted(record.key.group_pair)));
        expected.sort_by_key(|(record, _)| record.key);
        assert_eq!(left_out, expected.len().saturating_sub(CAPACITY));
        if left_out > 0 {
            // The strongest records are kept, ties in key order.
            overflows += 1;
            let mut by_force: Vec<usize> = (0..expected.len()).collect();
            by_force.sort_by(|&i, &j| expected[j].0.force_b.norm().total_cmp(&expected[i].0.force_b.norm()));
            by_force.truncate(CAPACITY);
            by_force.sort();
            expected = by_force.iter().map(|&i| expected[i].clone()).collect();
        }
        assert_eq!(listed(next), expected);
        let booked: Vec<_> = (0..GROUP_PAIRS).filter(|pair| is_accepted(*pair as u32)).collect();
        let work: f64 = booked.iter().map(|pair| added[*pair].work).sum();
        assert!((next.work - memory.work - work).abs() < 1e-12);
        assert!((next.dissipated - memory.dissipated - 0.5 * booked.len() as f64).abs() < 1e-12);
    }
    assert!(overflows > 50, "{overflows}");
}

#[test]
fn a_commit_of_everything_takes_everything_over_but_the_totals() {
    let mut random = Random(3);
    for round in 0..300 {
        let (mut memory, trial) = two_memories(&mut random, round);
        let totals = (memory.work, memory.dissipated);
        memory.clear_records();
        entries_of(&trial).for_each(|remembered| memory.push(&remembered).unwrap());
        assert_eq!(listed(&memory), listed(&trial));
        assert_eq!((memory.work, memory.dissipated), totals);
        let mut copy = memory_with_energies(&mut random, CAPACITY, memory.law_state_len);
        copy.copy_from(&memory);
        assert!(copy == memory);
    }
}

#[test]
fn records_of_one_key_are_found_together_whatever_was_done_before() {
    let mut random = Random(4);
    for cleared in 0..1 << GROUP_PAIRS {
        let mut memory = memory_of(&mut random, CAPACITY, 2);
        let all: Vec<ContactKey> = memory.records.iter().map(|record| record.key).collect();
        let is_cleared = |pair: usize| cleared >> pair & 1 == 1;
        memory.clear_history(is_cleared, |group_pair| group_pair as usize, false);
        let mut copy = memory_of(&mut random, CAPACITY, 2);
        copy.copy_from(&memory);
        for memory in [&memory, &copy] {
            for (index, RecordEntry { record, law_state, .. }) in memory.iter().enumerate() {
                let RecordsOfKey { range, records } = memory.under(&record.key);
                assert!((range.first()..range.first() + records.len()).contains(&index));
                assert!(records.iter().all(|other| other.key == record.key));
                assert_eq!(memory.law_state_of(index), law_state);
                // Usually one record has the high word; this key has another end.
                let elsewhere = ContactKey { end: record.key.end + 1000, ..record.key };
                assert!(memory.under(&elsewhere).records.is_empty());
            }
            let mut gone = all.iter().filter(|key| is_cleared(key.group_pair as usize));
            assert!(gone.all(|key| memory.under(key).records.is_empty()));
        }
    }
}

#[test]
fn the_first_record_of_a_head_is_found_whatever_was_hinted_before() {
    /// Primitives this far apart have the same hint, for any number of hints.
    const APART: u32 = 1 << 13;
    let mut random = Random(21);
    let model = record_of(&mut random);
    // One list for all rounds, so that hints of earlier contents remain.
    let mut records = Records::with_capacity(5000);
    for _ in 0..2000 {
        let some = |random: &mut Random| ContactKey {
            group_pair: random.below(2) as u32,
            primitive_a: random.below(9) as u32 + APART * random.below(3) as u32,
            ..ContactKey::default()
        };
        let mut keys: Vec<ContactKey> = (0..random.below(60)).map(|_| some(&mut random)).collect();
        keys.sort();
        records.clear();
        records.size_hints(random.below(5000));
        for key in &keys {
            records.push_with(|record| *record = ContactRecord { key: *key, ..model }).unwrap();
        }
        if random.below(3) == 0 {
            let gone = random.below(keys.len() + 1);
            (gone..keys.len()).skip(2).for_each(|from| records.copy_within(from, from - 2));
            keys.drain(gone..keys.len().min(gone + 2));
            records.truncate(keys.len());
        }
        for head in (0..100).map(|_| some(&mut random).head()) {
            assert_eq!(records.first_of_head(head), keys.iter().filter(|key| key.head() < head).count());
        }
    }
}

#[test]
fn a_contact_continues_the_record_of_the_closest_normal_within_60_degrees() {
    let mut random = Random(9);
    let model = ContactRecord { role: ContactRole::Active, ..record_of(&mut random) };
    let mut memory = ContactMemory::with_capacity(poses_of(&mut random), GROUP_PAIRS, CAPACITY, 0);
    let oblique = Vec3::new(0.6, 0.0, 0.8);
    for (normal, feature, role) in [
        (Vec3::x(), 1, ContactRole::Active),
        (oblique, 7, ContactRole::Active),
        (oblique, 5, ContactRole::Active),
        (Vec3::z(), 0, ContactRole::Tracked),
    ] {
        memory
            .push(&RecordEntry {
                record: ContactRecord { normal_b: normal, feature, role, ..model },
                law_state: &[],
                energy: None,
            })
            .unwrap();
    }
    let found = |normal: Vec3, role| {
        let (index, record) = memory.under(&model.key).matching(&normal, role)?;
        assert_eq!(record, &memory.records[index]);
        Some(index)
    };
    assert_eq!(found(Vec3::x(), ContactRole::Active), Some(0));
    // Two equal normals: the lower feature.
    assert_eq!(found(Vec3::z(), ContactRole::Active), Some(2));
    assert_eq!(found(Vec3::z(), ContactRole::Tracked), Some(3));
    assert_eq!(found(Vec3::z(), ContactRole::WrongSide), None);
    // The cosine must exceed one half.
    assert_eq!(found(Vec3::new(0.0, 0.75_f64.sqrt(), 0.5), ContactRole::Tracked), None);
    assert_eq!(found(Vec3::new(0.0, 0.8, 0.6), ContactRole::Tracked), Some(3));
    let elsewhere = ContactKey { primitive_a: model.key.primitive_a + 1, ..model.key };
    assert_eq!(memory.under(&elsewhere).matching(&Vec3::z(), ContactRole::Tracked), None);
}

/// A block in a buffer for the largest block.
fn block_of(memory: &ContactMemory) -> Vec<u8> {
    let mut block = vec![0xee; largest_len(memory)];
    write_block(memory, WORLD, &mut block).unwrap();
    block
}

/// A block in a buffer of just its length.
fn tight_block_of(memory: &ContactMemory) -> Vec<u8> {
    let mut block = vec![0xee; needed_len(memory)];
    write_block(memory, WORLD, &mut block).unwrap();
    block
}

/// A block of format version 3, byte by byte.
#[test]
fn the_block_is_laid_out_as_version_3_says() {
    let mut random = Random(5);
    for _ in 0..40 {
        let memory = memory_of(&mut random, 0, 0);
        let mut expected = b"PONGSTAT".to_vec();
        let mut put = |bytes: &[u8]| expected.extend_from_slice(bytes);
        put(&3_u32.to_le_bytes());
        put(&0_u32.to_le_bytes());
        put(&WORLD.to_le_bytes());
        put(&memory.work.to_le_bytes());
        put(&memory.dissipated.to_le_bytes());
        let mut epochs: Vec<u8> = Vec::new();
        for pair in 0..GROUP_PAIRS {
            let epoch = memory.poses.epoch_of(pair);
            if epoch != NEVER && !epochs.contains(&epoch) {
                epochs.push(epoch);
            }
        }
        put(&(epochs.len() as u64).to_le_bytes());
        for (epoch, body) in epochs.iter().flat_map(|epoch| BODIES.map(|body| (*epoch, body))) {
            let pose = memory.poses.pose(epoch, body);
            let numbers = pose.position.iter().chain(pose.orientation.coords.iter());
            numbers.for_each(|x| put(&x.to_le_bytes()));
        }
        for pair in 0..GROUP_PAIRS {
            let place = epochs.iter().position(|epoch| *epoch == memory.poses.epoch_of(pair));
            put(&[place.map_or(255, |place| place as u8)]);
        }
        put(&[0; 3]);
        let checksum = Fnv::of(&expected).to_le_bytes();
        expected.extend_from_slice(&checksum);
        assert!(tight_block_of(&memory) == expected);
    }
}

#[test]
fn a_block_gives_back_to_the_bit_what_was_saved_whatever_was_there_before() {
    let mut random = Random(6);
    for round in 0..100 {
        let (memory, mut other) = two_memories(&mut random, round);
        read_block(&mut other, WORLD, &block_of(&memory)).unwrap();
        assert!(other == memory);
        assert_eq!(block_of(&other), block_of(&memory));
    }
}

#[test]
fn a_damaged_byte_anywhere_is_refused_and_changes_nothing() {
    let mut random = Random(7);
    let saved = memory_of(&mut random, 9, 1);
    let (block, tight) = (block_of(&saved), tight_block_of(&saved));
    let mut memory = memory_of(&mut random, 5, 1);
    let before = memory.clone();
    for at in 0..block.len() {
        let mut damaged = block.clone();
        damaged[at] ^= 1 << (at % 8);
        assert!(read_block(&mut memory, WORLD, &damaged).is_err(), "byte {at}");
        assert!(memory == before, "byte {at}");
    }
    for len in [0, 7, 8, 39, 40, tight.len() - 1] {
        assert!(read_block(&mut memory, WORLD, &block[..len]).is_err());
    }
    assert!(read_block(&mut memory, WORLD, &[&block[..], &[0]].concat()).is_err());
    assert_eq!(read_block(&mut memory, WORLD + 1, &block), Err(StateError::World));
    assert!(memory == before);
}

/// A block is as long as its contents; followed by zeros up to the largest block, it is the same block.
#[test]
fn a_block_has_no_room_for_contacts_that_there_are_not() {
    let mut random = Random(9);
    for round in 0..100 {
        let (memory, mut other) = two_memories(&mut random, round);
        let (tight, whole) = (tight_block_of(&memory), block_of(&memory));
        let numbers = memory.records.len() * (RECORD_BYTES + 8 * memory.numbers_each());
        assert_eq!(tight.len(), first_record(&memory) + numbers + 8);
        assert!(whole[..tight.len()] == tight && whole[tight.len()..].iter().all(|byte| *byte == 0));
        // A buffer is not written beyond the largest block.
        let mut larger = vec![0xee; whole.len() + 100];
        write_block(&memory, WORLD, &mut larger).unwrap();
        assert!(larger[..whole.len()] == whole && larger[whole.len()..] == [0xee; 100]);
        let mut smaller = vec![0xee; tight.len() - 1];
        let (least, most, got) = (tight.len(), whole.len(), smaller.len());
        assert_eq!(write_block(&memory, WORLD, &mut smaller), Err(StateError::Length { least, most, got }));
        assert!(smaller.iter().all(|byte| *byte == 0xee));
        let before = other.clone();
        assert!(read_block(&mut other, WORLD + 1, &tight).is_err() && other == before);
        for until in [tight.len(), (tight.len() + whole.len()) / 2, whole.len()] {
            other = before.clone();
            read_block(&mut other, WORLD, &whole[..until]).unwrap();
            assert!(other == memory);
        }
    }
    let mut memory = memory_of(&mut random, 5, 1);
    let before = memory.clone();
    let tight = tight_block_of(&memory_of(&mut random, 9, 1));
    for at in 0..tight.len() {
        let mut damaged = tight.clone();
        damaged[at] ^= 1 << (at % 8);
        assert!(read_block(&mut memory, WORLD, &damaged).is_err() && memory == before, "byte {at}");
    }
    for len in [0, 7, 8, 39, 40, tight.len() - 1] {
        assert!(read_block(&mut memory, WORLD, &tight[..len]).is_err() && memory == before, "{len} bytes");
    }
    assert!(read_block(&mut memory, WORLD, &[&tight[..], &[1]].concat()).is_err() && memory == before);
}

/// Offset of the poses in the block, which begin with the number of epochs.
const POSES: usize = 40;
/// One epoch per pair of Objects, padded to a multiple of eight bytes.
const PAIRS_BYTES: usize = 8;

/// Offset of the pairs' epochs in the block.
fn first_epoch(memory: &ContactMemory) -> usize {
    let (_, epochs) = memory.poses.numbered();
    POSES + 8 + usize::from(epochs) * BODIES.len() * 56
}

/// Offset of the records in the block.
fn first_record(memory: &ContactMemory) -> usize {
    first_epoch(memory) + PAIRS_BYTES
}

/// Index of the role among the words of a record in the block.
const ROLE_WORD: usize = 9;
const RECORD_BYTES: usize = 160;

/// The block with one word replaced and a matching checksum.
fn forged(block: &[u8], at: usize, word: u32) -> Vec<u8> {
    let mut forged = block.to_vec();
    forged[at..at + 4].copy_from_slice(&word.to_le_bytes());
    let body = forged.len() - 8;
    let checksum = Fnv::of(&forged[..body]).to_le_bytes();
    forged[body..].copy_from_slice(&checksum);
    forged
}

#[test]
fn a_block_that_holds_nonsense_under_a_good_checksum_is_refused_and_changes_nothing() {
    let mut random = Random(8);
    let saved = memory_of(&mut random, 9, 0);
    let block = tight_block_of(&saved);
    let mut memory = memory_of(&mut random, 5, 0);
    let before = memory.clone();
    let last = first_record(&saved) + 8 * RECORD_BYTES;
    let (_, epochs) = saved.poses.numbered();
    let nonsense = [
        ("a role that there is not", last + 4 * ROLE_WORD, 3),
        ("a pair that there is not", last, GROUP_PAIRS as u32),
        ("keys out of order", last, 0),
        ("an epoch that there is not", first_epoch(&saved), u32::from_le_bytes([epochs; 4])),
        ("more epochs than there is room for", POSES, GROUP_PAIRS as u32 + 1),
        ("something behind the epochs", first_epoch(&saved) + 4, 0x0100_0000),
    ];
    assert!(saved.records[7].key.group_pair > 0);
    for (what, at, word) in nonsense {
        let forged = forged(&block, at, word);
        assert_eq!(read_block(&mut memory, WORLD, &forged), Err(StateError::Damaged), "{what}");
        assert!(memory == before, "{what}");
    }
    let empty = tight_block_of(&memory_of(&mut random, 0, 0));
    for count in [CAPACITY as u32 + 1, u32::MAX] {
        let forged = forged(&empty, 12, count);
        assert_eq!(read_block(&mut memory, WORLD, &forged), Err(StateError::Damaged), "{count} records");
        assert!(memory == before);
    }
    // The forgery itself is valid: a permitted word is accepted.
    read_block(&mut memory, WORLD, &forged(&block, last + 4 * ROLE_WORD, 1)).unwrap();
    assert_eq!(memory.records[8].role, ContactRole::WrongSide);
}
