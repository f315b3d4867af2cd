//! Contact records in the order of their keys.

use super::record::{ContactKey, ContactRecord};
use pong_arena::{Full, Table};
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
    /// Where every record stands, if lanes have written them.
    places: Table<Place>,
    in_order: Table<ContactRecord>,
    /// What each lane has written.
    lanes: Vec<Table<ContactRecord>>,
}

/// Bits that tell where in its table a record stands: they count further than any room for records goes.
const INDEX_BITS: u32 = 25;

/// Where a record stands: its table in the highest bits; below, the index there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place(u32);

/// Where the records of one head are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    first: u32,
    count: u32,
    /// Of the first; the others follow it.
    place: Place,
}

/// The table of records in order.
const IN_ORDER: usize = 0;

impl Place {
    /// What a lane has written, counted from 0, as its record of this index.
    pub const fn in_lane(lane: usize, index: usize) -> Self {
        Self(((lane + 1) << INDEX_BITS | index) as u32)
    }

    const fn in_order(index: usize) -> Self {
        Self((IN_ORDER << INDEX_BITS | index) as u32)
    }

    fn next(self) -> Self {
        Self(self.0 + 1)
    }

    fn table(self) -> usize {
        (self.0 >> INDEX_BITS) as usize
    }

    fn index(self) -> usize {
        (self.0 & (u32::MAX >> (u32::BITS - INDEX_BITS))) as usize
    }
}

impl Found {
    /// No records.
    pub const NOTHING: Self = Self { first: 0, count: 0, place: Place::in_order(0) };

    /// The index of the first record in the order of keys.
    pub fn first(&self) -> usize {
        self.first as usize
    }
}

impl Records {
    /// Bytes of a record.
    pub const BYTES: usize = Self::LANE_BYTES + size_of::<u64>();

    /// Bytes of one that a lane has written.
    pub const LANE_BYTES: usize = size_of::<ContactRecord>();

    /// Room for so many.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            heads: Table::with_capacity(capacity, 0),
            places: Table::default(),
            in_order: Table::with_capacity(capacity, ContactRecord::blank()),
            lanes: Vec::new(),
        }
    }

    /// With room, besides, for what so many lanes write, each so many records.
    pub fn with_lanes(mut self, lanes: usize, each: usize) -> Self {
        if lanes > 0 && each > 0 {
            self.places = Table::with_capacity(self.capacity(), Place::in_order(0));
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

    /// Whether they stand where lanes have written them.
    pub fn in_lanes(&self) -> bool {
        !self.places.is_empty()
    }

    /// The records, in the order of their keys.
    pub fn iter(&self) -> impl Iterator<Item = &ContactRecord> + Clone {
        (0..self.len()).map(|index| &self[index])
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
        self.heads.push(record.key.head())?;
        debug_assert!(self.in_order.windows(2).last().is_none_or(|two| two[0].key <= two[1].key));
        Ok(())
    }

    /// Appends all records of another list.
    ///
    /// # Errors
    /// [`Full`] if there is no room for all.
    pub fn extend(&mut self, other: &Self) -> Result<(), Full> {
        other.iter().try_for_each(|record| self.push_with(|slot| *slot = *record))
    }

    /// Replaces all records by those that lanes have written, whose heads and places come in the order of keys; whether they
    /// can stay where they are: there is room for lanes, and those of one head stand one after another. If not, there are no
    /// records. The [tables of the lanes](Self::lane_mut) are the caller's to exchange.
    #[inline]
    pub fn adopt(&mut self, written: impl Iterator<Item = (u64, Place)>) -> bool {
        self.clear();
        if self.lanes.is_empty() {
            return false;
        }
        let mut last = None;
        for (head, place) in written {
            let goes_on =
                last.is_none_or(|(other, before): (u64, Place)| other != head || place == before.next());
            if !goes_on || self.heads.push(head).and_then(|()| self.places.push(place)).is_err() {
                self.clear();
                return false;
            }
            last = Some((head, place));
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
        self.places.clear();
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
        self.places.truncate(len);
        self.in_order.truncate(len);
    }

    /// Where the records are whose keys have one head.
    #[inline]
    pub fn of_head(&self, head: u64) -> Found {
        let first = self.place_of_head(head);
        let count = self.heads[first..].iter().take_while(|&&other| other == head).count();
        let place = if count > 0 { self.place(first) } else { Place::in_order(0) };
        Found { first: first as u32, count: count as u32, place }
    }

    /// The records that were found.
    #[inline]
    pub fn found(&self, found: &Found) -> &[ContactRecord] {
        let (table, first) = (found.place.table(), found.place.index());
        &self.table(table)[first..first + found.count as usize]
    }

    /// The index of the first record whose key has this head, or would have its place there.
    #[inline]
    pub fn place_of_head(&self, head: u64) -> usize {
        self.heads.partition_point(|&other| other < head)
    }

    /// The records of a pair of movable groups.
    pub fn of_group_pair(&self, group_pair: u32) -> impl Iterator<Item = &ContactRecord> {
        let first_of = |group_pair| ContactKey { group_pair, ..ContactKey::default() }.head();
        let (first, next) = (first_of(group_pair), first_of(group_pair + 1));
        (self.place_of_head(first)..self.place_of_head(next)).map(|index| &self[index])
    }

    /// Reads the heads, and where their records stand, all at once: a search would wait for one line after another that another
    /// core has written.
    pub fn fetch(&self) {
        const LINE: usize = 64;
        let heads = self.heads.iter().step_by(LINE / size_of::<u64>()).fold(0, |all, head| all ^ head);
        let places =
            self.places.iter().step_by(LINE / size_of::<Place>()).fold(0, |all, place| all ^ place.0);
        std::hint::black_box((heads, places));
    }

    #[inline]
    fn table(&self, table: usize) -> &[ContactRecord] {
        match table {
            IN_ORDER => &self.in_order,
            lane => &self.lanes[lane - 1],
        }
    }

    #[inline]
    fn place(&self, index: usize) -> Place {
        if self.places.is_empty() { Place::in_order(index) } else { self.places[index] }
    }
}

impl Index<usize> for Records {
    type Output = ContactRecord;

    #[inline]
    fn index(&self, index: usize) -> &ContactRecord {
        let place = self.place(index);
        &self.table(place.table())[place.index()]
    }
}

/// Keys are not to be changed.
impl IndexMut<usize> for Records {
    #[inline]
    fn index_mut(&mut self, index: usize) -> &mut ContactRecord {
        let place = self.place(index);
        let table = match place.table() {
            IN_ORDER => &mut self.in_order,
            lane => &mut self.lanes[lane - 1],
        };
        &mut table[place.index()]
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
