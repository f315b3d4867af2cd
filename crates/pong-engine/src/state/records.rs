//! Contact records in the order of their keys.

use super::record::{ContactKey, ContactRecord};
use pong_arena::{Full, Table};
use std::ops::{Deref, DerefMut, Range};

/// Records, used as a slice. What tells most keys apart stands beside them once more, closely packed: a search reads few
/// cache lines, and of the records themselves only those that it finds. Where threads are on cores that are far apart, the
/// fewer lines of the committed records they have read, the sooner the next commit but one can write them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Records {
    records: Table<ContactRecord>,
    /// The head of every record's key.
    heads: Table<u64>,
}

impl Records {
    /// Bytes of a record.
    pub const BYTES: usize = size_of::<ContactRecord>() + size_of::<u64>();

    /// Room for so many.
    pub fn with_capacity(capacity: usize) -> Self {
        Self {
            records: Table::with_capacity(capacity, ContactRecord::blank()),
            heads: Table::with_capacity(capacity, 0),
        }
    }

    /// How many fit.
    pub fn capacity(&self) -> usize {
        self.records.capacity()
    }

    /// Appends a record that `write` writes, all of it, in place; keys must come in order.
    ///
    /// # Errors
    /// [`Full`] if there is no room; the records stay as they are.
    #[inline(always)]
    pub fn push_with(&mut self, write: impl FnOnce(&mut ContactRecord)) -> Result<(), Full> {
        let record = self.records.slot()?;
        write(record);
        self.heads.push(record.key.head())?;
        debug_assert!(self.records.windows(2).last().is_none_or(|two| two[0].key <= two[1].key));
        Ok(())
    }

    /// Appends all records of another list.
    ///
    /// # Errors
    /// [`Full`] if there is no room for all; the records stay as they are.
    pub fn extend(&mut self, other: &Self) -> Result<(), Full> {
        self.records.extend_from_slice(&other.records)?;
        self.heads.extend_from_slice(&other.heads)
    }

    /// Drops all records.
    pub fn clear(&mut self) {
        self.records.clear();
        self.heads.clear();
    }

    /// Overwrites a record by another one, key and all; the order is the caller's to keep.
    pub fn copy_within(&mut self, from: usize, to: usize) {
        self.records[to] = self.records[from];
        self.heads[to] = self.heads[from];
    }

    /// Keeps the first `len` records.
    pub fn truncate(&mut self, len: usize) {
        self.records.truncate(len);
        self.heads.truncate(len);
    }

    /// Where the records are whose keys have one head.
    #[inline]
    pub fn of_head(&self, head: u64) -> Range<usize> {
        let first = self.heads.partition_point(|&other| other < head);
        let same = self.heads[first..].iter().take_while(|&&other| other == head).count();
        first..first + same
    }

    /// Where the records under one key are, among those of its head: few keys have a head in common.
    #[inline]
    pub fn under(&self, key: &ContactKey, of_head: Range<usize>) -> Range<usize> {
        let first = of_head.start;
        let of_head = &self.records[of_head];
        let before = of_head.iter().take_while(|record| record.key < *key).count();
        let count = of_head[before..].iter().take_while(|record| record.key == *key).count();
        first + before..first + before + count
    }
}

impl Deref for Records {
    type Target = [ContactRecord];

    fn deref(&self) -> &Self::Target {
        &self.records
    }
}

/// Keys are not to be changed.
impl DerefMut for Records {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.records
    }
}
