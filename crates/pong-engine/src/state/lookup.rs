//! Looks up what is remembered of contacts while a frame is worked out.

use super::memory::ContactMemory;
use super::record::{ContactKey, ContactRecord, ContactRole};
use super::records::RecordRange;
use pong_geometry::Vec3;
use pong_geometry::interference::Feature;

/// A contact continues another of the same key only if the cosine of their normals exceeds this (60°).
pub(crate) const SAME_WAY_COSINE_MIN: f64 = 0.5;

/// What is remembered under one key, in the order of pieces and features.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RecordsOfKey<'m> {
    /// Where the records stand: whoever notes that need not search for them again in this frame.
    pub range: RecordRange,
    pub records: &'m [ContactRecord],
}

impl ContactMemory {
    /// The records under one key.
    #[inline]
    pub fn under(&self, key: &ContactKey) -> RecordsOfKey<'_> {
        let range = self.records.of_key(key);
        self.at(range)
    }

    /// Records that were found before.
    #[inline(always)]
    pub fn at(&self, range: RecordRange) -> RecordsOfKey<'_> {
        RecordsOfKey { range, records: self.records.in_range(&range) }
    }
}

impl<'m> RecordsOfKey<'m> {
    /// The record of the given role, and its index, that a present contact with normal `n` continues: the one with
    /// the normal n' nearest to it, ties by feature, if n·n' exceeds [`SAME_WAY_COSINE_MIN`].
    ///
    /// Nearest is told by |n − n'|, which is exact: the cosines of normals 1e-8 apart and nearer are all one, and among
    /// the faces of a plate folded by so little a contact would continue another's bristle.
    #[inline(always)]
    pub fn matching(&self, normal: &Vec3, role: ContactRole) -> Option<(usize, &'m ContactRecord)> {
        let may =
            |record: &ContactRecord| record.role == role && record.normal_b.dot(normal) > SAME_WAY_COSINE_MIN;
        // As a rule.
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

    /// The role of the record that is nearest to a present contact, of whatever role: of the nearest normal, as for
    /// [`matching`](Self::matching), and where several have that normal, the contact's own feature.
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
