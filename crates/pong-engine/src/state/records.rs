//! Contact records in the order of their keys.

use super::record::{ContactKey, ContactRecord};
use super::slot::Slot;
use pong_arena::{Full, Table};
use std::num::NonZeroU32;
use std::ops::{Index, IndexMut};

/// Records, counted in the order of their keys. What tells most keys apart stands beside them, closely packed: a search reads
/// few cache lines, and of the records themselves only those that it finds.
///
/// They stand in that order in one table, or as the lanes of a frame have written them, each lane's in a table of its own.
/// Then a commit moves none, and the core that reads a record is most often the one that has written it.
#[derive(Clone, Debug)]
pub(crate) struct Records {
    /// The head of every record's key.
    heads: Table<u64>,
    /// Where the first record of a head is, by some bits of the head; or was once, or that of another one. Nothing but the time
    /// depends on it: most searches end where it says.
    hints: Box<[u16]>,
    /// So many of them are in use, a power of two.
    hints_used: usize,
    /// Where every record stands, if lanes have written them.
    slots: Table<Slot>,
    in_order: Table<ContactRecord>,
    /// What each lane has written.
    lanes: Vec<Table<ContactRecord>>,
}

/// Which records those of one key or of one head are, in the order of keys. Small: every contact of a frame notes one, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct RecordRange {
    /// The index of the first, and one more. Anything if there are none.
    first: NonZeroU32,
    count: u32,
}

impl RecordRange {
    fn new(first: usize, count: usize) -> Self {
        Self { first: NonZeroU32::MIN.saturating_add(first as u32), count: count as u32 }
    }

    /// The index of the first record, if there is any.
    #[inline]
    pub fn first(&self) -> usize {
        (self.first.get() - 1) as usize
    }
}

/// So many are twice as many as most frames have contacts, and do not displace them from the cache.
const HINTS_MIN: usize = 512;

/// Of more than this, few would be in a cache.
const HINTS_MAX: usize = 8192;

/// How many hints so many records are worth: two each, and few are displaced by another's.
fn hints_for(records: usize) -> usize {
    (2 * records).next_power_of_two().clamp(HINTS_MIN, HINTS_MAX)
}

/// Fewer records than this are searched as quickly without a hint.
const WORTH_A_HINT: usize = 16;

/// Which hint is that of a head, of so many.
#[inline]
fn hint_of(head: u64, used: usize) -> usize {
    /// Neighbouring primitives have neighbouring hints, in each direction of each pair from another place on.
    const DIRECTION_APART: u64 = 0x9e37;
    ((head >> 32).wrapping_mul(DIRECTION_APART).wrapping_add(head)) as usize & (used - 1)
}

/// As many elements as bring all of a table into the cache.
fn one_of_each_line<T>(table: &[T]) -> impl Iterator<Item = &T> {
    const LINE: usize = 64;
    table.iter().step_by(LINE / size_of::<T>())
}

/// The lane of records in order.
const IN_ORDER: usize = Slot::NO_LANE;

impl Records {
    /// Bytes of a record.
    pub const BYTES: usize = Self::LANE_BYTES + size_of::<u64>();

    /// Bytes of one that a lane has written.
    pub const LANE_BYTES: usize = size_of::<ContactRecord>();

    /// Room for so many.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            heads: Table::with_capacity(capacity, 0),
            hints: vec![0; hints_for(capacity)].into(),
            hints_used: HINTS_MIN,
            slots: Table::default(),
            in_order: Table::with_capacity(capacity, ContactRecord::blank()),
            lanes: Vec::new(),
        }
    }

    /// With room, besides, for what so many lanes write, each so many records.
    pub fn with_lanes(mut self, lanes: usize, each: usize) -> Self {
        if lanes > 0 && each > 0 {
            self.slots = Table::with_capacity(self.capacity(), Slot::NOWHERE);
            let lane = || Table::with_capacity(each, ContactRecord::blank());
            self.lanes.extend(std::iter::repeat_with(lane).take(lanes));
        }
        self
    }

    /// How many fit.
    pub fn capacity(&self) -> usize {
        self.heads.capacity()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.heads.len()
    }

    /// The head of a record's key.
    #[inline]
    pub fn head(&self, index: usize) -> u64 {
        self.heads[index]
    }

    /// Whether they stand where lanes have written them.
    pub fn in_lanes(&self) -> bool {
        !self.slots.is_empty()
    }

    /// The records, in the order of their keys.
    pub fn iter(&self) -> impl Iterator<Item = &ContactRecord> + Clone {
        (0..self.len()).map(|index| &self[index])
    }

    /// So many records are going to be written; there are none yet.
    #[inline]
    pub fn expect(&mut self, records: usize) {
        self.hints_used = hints_for(records).min(self.hints.len());
    }

    /// Appends a record that `write` writes, all of it, in place; keys must come in order.
    ///
    /// # Errors
    /// [`Full`] if there is no room; the records stay as they are.
    #[inline(always)]
    pub fn push_with(&mut self, write: impl FnOnce(&mut ContactRecord)) -> Result<(), Full> {
        debug_assert!(!self.in_lanes(), "records of lanes are whole");
        let record = self.in_order.slot()?;
        write(record);
        let head = record.key.head();
        self.hint(head);
        self.heads.push(head)?;
        debug_assert!(self.in_order.windows(2).last().is_none_or(|two| two[0].key <= two[1].key));
        Ok(())
    }

    /// Notes where the next record is to be found, if it is the first of its head.
    #[inline(always)]
    fn hint(&mut self, head: u64) {
        if self.heads.last() != Some(&head) {
            // One that does not fit is a hint that nobody believes.
            self.hints[hint_of(head, self.hints_used)] = self.heads.len() as u16;
        }
    }

    /// Appends all records of another list.
    ///
    /// # Errors
    /// [`Full`] if there is no room for all.
    pub fn extend(&mut self, other: &Self) -> Result<(), Full> {
        other.iter().try_for_each(|record| self.push_with(|slot| *slot = *record))
    }

    /// Replaces all records by those that lanes have written, whose heads and slots come in the order of keys; whether they
    /// can stay where they are: there is room for lanes, and those of one head stand one after another. If not, there are no
    /// records. The [tables of the lanes](Self::lane_mut) are the caller's to exchange.
    #[inline]
    pub fn adopt(&mut self, written: impl Iterator<Item = (u64, Slot)>) -> bool {
        self.clear();
        if self.lanes.is_empty() {
            return false;
        }
        let mut last = None;
        for (head, slot) in written {
            let goes_on =
                last.is_none_or(|(other, before): (u64, Slot)| other != head || slot == before.next());
            self.hint(head);
            if !goes_on || self.heads.push(head).and_then(|()| self.slots.push(slot)).is_err() {
                self.clear();
                return false;
            }
            last = Some((head, slot));
        }
        true
    }

    /// What a lane has written.
    pub fn lane_mut(&mut self, lane: usize) -> &mut Table<ContactRecord> {
        &mut self.lanes[lane]
    }

    /// Drops all records.
    pub fn clear(&mut self) {
        self.heads.clear();
        self.slots.clear();
        self.in_order.clear();
    }

    /// Overwrites a record by another one, key and all; the order is the caller's to keep.
    pub fn copy_within(&mut self, from: usize, to: usize) {
        self[to] = self[from];
        self.heads[to] = self.heads[from];
    }

    /// Keeps the first `len` records.
    pub fn truncate(&mut self, len: usize) {
        self.heads.truncate(len);
        self.slots.truncate(len);
        self.in_order.truncate(len);
    }

    /// The records of a key.
    #[inline]
    pub fn of_key(&self, key: &ContactKey) -> RecordRange {
        let range = self.of_head(key.head());
        let tail = key.tail();
        match self.in_range(&range) {
            [] => range,
            // As a rule.
            [one] if one.key.tail() == tail => range,
            several => {
                // Their heads are the key's.
                let others = several.iter().take_while(|record| record.key.tail() < tail).count();
                let same = several[others..].iter().take_while(|record| record.key.tail() == tail).count();
                RecordRange::new(range.first() + others, same)
            }
        }
    }

    /// The records whose keys have one head.
    #[inline]
    pub fn of_head(&self, head: u64) -> RecordRange {
        let first = self.place_of_head(head);
        let mut end = first;
        while self.heads.get(end) == Some(&head) {
            end += 1;
        }
        RecordRange::new(first, end - first)
    }

    /// The records themselves: those of one head stand one after another.
    #[inline]
    pub fn in_range(&self, range: &RecordRange) -> &[ContactRecord] {
        if range.count == 0 {
            return &[];
        }
        let slot = self.slot(range.first());
        &self.table(slot)[slot.index()..slot.index() + range.count as usize]
    }

    /// The index of the first record whose key has this head, or would have its place there.
    #[inline]
    pub fn place_of_head(&self, head: u64) -> usize {
        let heads = &self.heads[..];
        if heads.len() >= WORTH_A_HINT {
            let hint = usize::from(self.hints[hint_of(head, self.hints_used)]);
            let is_first = || hint.checked_sub(1).is_none_or(|before| heads[before] != head);
            if heads.get(hint) == Some(&head) && is_first() {
                return hint;
            }
        }
        heads.partition_point(|&other| other < head)
    }

    /// The records of a pair of movable groups.
    pub fn of_group_pair(&self, group_pair: u32) -> impl Iterator<Item = &ContactRecord> {
        let first_of = |group_pair| ContactKey { group_pair, ..ContactKey::default() }.head();
        let (first, next) = (first_of(group_pair), first_of(group_pair + 1));
        (self.place_of_head(first)..self.place_of_head(next)).map(|index| &self[index])
    }

    /// Reads the heads, their hints, and where their records stand, all at once: a search would wait for one line after another
    /// that another core has written.
    pub fn fetch(&self) {
        let heads = one_of_each_line(&self.heads).fold(0, |all, head| all ^ head);
        let slots = one_of_each_line(&self.slots).fold(0, |all, slot| all ^ slot.index());
        let hints = one_of_each_line(&self.hints[..self.hints_used]).fold(0, |all, hint| all ^ hint);
        std::hint::black_box((heads, slots, hints));
    }

    /// The table of what stands in a slot.
    #[inline]
    fn table(&self, slot: Slot) -> &[ContactRecord] {
        match slot.lane() {
            IN_ORDER => &self.in_order,
            lane => &self.lanes[lane],
        }
    }

    #[inline]
    fn slot(&self, index: usize) -> Slot {
        if self.in_lanes() { self.slots[index] } else { Slot::new(IN_ORDER, index) }
    }
}

impl Index<usize> for Records {
    type Output = ContactRecord;

    #[inline]
    fn index(&self, index: usize) -> &ContactRecord {
        let slot = self.slot(index);
        &self.table(slot)[slot.index()]
    }
}

/// Keys are not to be changed.
impl IndexMut<usize> for Records {
    #[inline]
    fn index_mut(&mut self, index: usize) -> &mut ContactRecord {
        let slot = self.slot(index);
        let table = match slot.lane() {
            IN_ORDER => &mut self.in_order,
            lane => &mut self.lanes[lane],
        };
        &mut table[slot.index()]
    }
}

impl Default for Records {
    /// No room at all.
    fn default() -> Self {
        Self::with_capacity(0)
    }
}

impl PartialEq for Records {
    /// Whether the records are equal; where they stand and how many would fit does not matter.
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}
