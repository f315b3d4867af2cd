//! Contact records in key order, and the records of one key that a contact may continue.

use super::record::{ContactKey, ContactRecord, ContactRole};
use pong_arena::{Full, Table};
use pong_geometry::Vec3;
use pong_geometry::interference::Feature;
use std::num::NonZeroU32;
use std::ops::{Deref, DerefMut};

/// Contact records in key order. The high words of the keys are also packed in an array of their own, so that
/// a search reads few cache lines.
#[derive(Clone, Debug)]
pub(crate) struct Records {
    /// High word of each record's key.
    heads: Table<u64>,
    /// Hash table from high word to the index of its first record. A search checks the entry that it reads,
    /// so entries that are stale or belong to another word cost only time.
    hints: Box<[u16]>,
    /// Number of hints in use, a power of two.
    hints_used: usize,
    records: Table<ContactRecord>,
}

/// Index range of the records of one key or high word. Compact, because each contact of a frame stores one or
/// none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct RecordRange {
    /// Index of the first record plus one; arbitrary if the range is empty.
    first: NonZeroU32,
    count: u32,
}

impl RecordRange {
    fn new(first: usize, count: usize) -> Self {
        Self { first: NonZeroU32::MIN.saturating_add(first as u32), count: count as u32 }
    }

    /// Index of the first record; arbitrary if the range is empty.
    #[inline]
    pub fn first(&self) -> usize {
        (self.first.get() - 1) as usize
    }
}

/// Minimum number of hints: twice the contacts of most frames, and small enough for the cache.
const HINTS_MIN: usize = 512;

/// Maximum number of hints; more would not stay in the cache.
const HINTS_MAX: usize = 8192;

/// Number of hints for this many records: two per record, so that few collide.
fn hints_for(records: usize) -> usize {
    (2 * records).next_power_of_two().clamp(HINTS_MIN, HINTS_MAX)
}

/// Below this number of records a search is as fast without hints.
const WORTH_A_HINT: usize = 16;

/// Index of the hint of a high word, of `used` hints.
#[inline]
fn hint_of(head: u64, used: usize) -> usize {
    /// Neighbouring primitives get neighbouring hints; each direction of each pair starts at another offset.
    const DIRECTION_APART: u64 = 0x9e37;
    ((head >> 32).wrapping_mul(DIRECTION_APART).wrapping_add(head)) as usize & (used - 1)
}

impl Records {
    /// Bytes per record.
    pub const BYTES: usize = size_of::<ContactRecord>() + size_of::<u64>();

    /// Room for this many records.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            heads: Table::with_capacity(capacity, 0),
            hints: vec![0; hints_for(capacity)].into(),
            hints_used: HINTS_MIN,
            records: Table::with_capacity(capacity, ContactRecord::blank()),
        }
    }

    /// Capacity in records.
    pub fn capacity(&self) -> usize {
        self.heads.capacity()
    }

    /// High word of a record's key.
    #[inline]
    pub fn head(&self, index: usize) -> u64 {
        self.heads[index]
    }

    /// Sizes the hints for this many records; call before the first is written.
    #[inline]
    pub fn size_hints(&mut self, records: usize) {
        self.hints_used = hints_for(records).min(self.hints.len());
    }

    /// Appends a record that `write` writes completely, in place; keys must come in order.
    ///
    /// # Errors
    /// [`Full`] if there is no room; the records are unchanged.
    #[inline(always)]
    pub fn push_with(&mut self, write: impl FnOnce(&mut ContactRecord)) -> Result<(), Full> {
        let record = self.records.slot()?;
        write(record);
        let head = record.key.head();
        if self.heads.last() != Some(&head) {
            // An index that does not fit is truncated; the search rejects such a hint.
            self.hints[hint_of(head, self.hints_used)] = self.heads.len() as u16;
        }
        self.heads.push(head)?;
        debug_assert!(self.records.windows(2).last().is_none_or(|two| two[0].key <= two[1].key));
        Ok(())
    }

    /// Appends all records of another list.
    ///
    /// # Errors
    /// [`Full`] if there is no room for all.
    pub fn extend(&mut self, other: &Self) -> Result<(), Full> {
        other.iter().try_for_each(|record| self.push_with(|slot| *slot = *record))
    }

    /// Drops all records.
    pub fn clear(&mut self) {
        self.heads.clear();
        self.records.clear();
    }

    /// Copies a record, with its key, over another one; the caller preserves the order.
    pub fn copy_within(&mut self, from: usize, to: usize) {
        self.records[to] = self.records[from];
        self.heads[to] = self.heads[from];
    }

    /// Keeps the first `len` records.
    pub fn truncate(&mut self, len: usize) {
        self.heads.truncate(len);
        self.records.truncate(len);
    }

    /// Records of a key.
    #[inline]
    pub fn of_key(&self, key: &ContactKey) -> RecordRange {
        let range = self.of_head(key.head());
        let tail = key.tail();
        match self.in_range(&range) {
            [] => range,
            // Usual case: one record.
            [one] if one.key.tail() == tail => range,
            several => {
                // All have the key's high word; compare the low word.
                let others = several.iter().take_while(|record| record.key.tail() < tail).count();
                let same = several[others..].iter().take_while(|record| record.key.tail() == tail).count();
                RecordRange::new(range.first() + others, same)
            }
        }
    }

    /// Records with this high word.
    #[inline]
    pub fn of_head(&self, head: u64) -> RecordRange {
        let first = self.first_of_head(head);
        let mut end = first;
        while self.heads.get(end) == Some(&head) {
            end += 1;
        }
        RecordRange::new(first, end - first)
    }

    /// Records of a range.
    #[inline]
    pub fn in_range(&self, range: &RecordRange) -> &[ContactRecord] {
        &self.records[range.first()..range.first() + range.count as usize]
    }

    /// Index of the first record with this high word, or of the position where it would be inserted.
    #[inline]
    pub fn first_of_head(&self, head: u64) -> usize {
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

    /// Records of a pair of movable groups.
    pub fn of_group_pair(&self, group_pair: u32) -> impl Iterator<Item = &ContactRecord> {
        let first_of = |group_pair| ContactKey { group_pair, ..ContactKey::default() }.head();
        let (first, next) = (first_of(group_pair), first_of(group_pair + 1));
        self.records[self.first_of_head(first)..self.first_of_head(next)].iter()
    }
}

/// The records in key order.
impl Deref for Records {
    type Target = [ContactRecord];

    #[inline]
    fn deref(&self) -> &[ContactRecord] {
        &self.records
    }
}

/// Mutable access; keys must not be changed.
impl DerefMut for Records {
    #[inline]
    fn deref_mut(&mut self) -> &mut [ContactRecord] {
        &mut self.records
    }
}

impl Default for Records {
    /// No capacity.
    fn default() -> Self {
        Self::with_capacity(0)
    }
}

impl PartialEq for Records {
    /// Compares the records; hints and capacity do not matter.
    fn eq(&self, other: &Self) -> bool {
        self.records[..] == other.records[..]
    }
}

/// A contact continues a record of the same key only if the cosine between their normals exceeds this (60°).
pub(crate) const SAME_WAY_COSINE_MIN: f64 = 0.5;

/// Records of one key, ordered by piece and feature.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RecordsOfKey<'m> {
    /// Index range of the records, kept so that the frame need not search again.
    pub range: RecordRange,
    pub records: &'m [ContactRecord],
}

impl<'m> RecordsOfKey<'m> {
    /// Record of the given role that a contact with this normal continues, with its index. It is the record
    /// with the nearest normal, of equally near ones that with the lowest feature; `None` if no cosine
    /// exceeds [`SAME_WAY_COSINE_MIN`].
    ///
    /// Nearness is measured by |n − n′|. Cosines would not do: those of normals less than 1e-8 apart all
    /// round to 1, so that on a plate folded by such an angle a contact could continue the bristle of another
    /// contact.
    #[inline(always)]
    pub fn matching(&self, normal: &Vec3, role: ContactRole) -> Option<(usize, &'m ContactRecord)> {
        let may =
            |record: &ContactRecord| record.role == role && record.normal_b.dot(normal) > SAME_WAY_COSINE_MIN;
        // Usual case: one record.
        if let [one] = self.records {
            return may(one).then_some((self.range.first(), one));
        }
        let mut best: Option<(usize, f64)> = None;
        for (i, record) in self.records.iter().enumerate().filter(|(_, record)| may(record)) {
            let apart = (record.normal_b - normal).norm_squared();
            let closer = best.is_none_or(|(b, least)| {
                apart < least || (apart == least && record.feature < self.records[b].feature)
            });
            if closer {
                best = Some((i, apart));
            }
        }
        best.map(|(i, _)| (self.range.first() + i, &self.records[i]))
    }

    /// Role of the record with the nearest normal, as in [`matching`](Self::matching) but for any role. Of
    /// equally near records, one of the given feature counts, otherwise that with the lowest feature.
    pub fn role_of_nearest(&self, normal: &Vec3, feature: Feature) -> Option<ContactRole> {
        let same_way = self.records.iter().filter(|record| record.normal_b.dot(normal) > SAME_WAY_COSINE_MIN);
        let apart = |record: &ContactRecord| (record.normal_b - normal).norm_squared();
        let is_other = |record: &ContactRecord| record.feature != feature.0;
        let nearest = same_way.min_by(|a, b| {
            apart(a).total_cmp(&apart(b)).then(is_other(a).cmp(&is_other(b))).then(a.feature.cmp(&b.feature))
        });
        nearest.map(|record| record.role)
    }
}
