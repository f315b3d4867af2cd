//! Looks up contact records during a frame.

use super::memory::ContactMemory;
use super::record::{ContactKey, ContactRecord, ContactRole};
use super::records::RecordRange;
use pong_geometry::Vec3;
use pong_geometry::interference::Feature;

/// A contact continues a record of the same key only if the cosine between their normals exceeds this (60°).
pub(crate) const SAME_WAY_COSINE_MIN: f64 = 0.5;

/// Records of one key, ordered by piece and feature.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RecordsOfKey<'m> {
    /// Index range of the records, kept so that the frame need not search again.
    pub range: RecordRange,
    pub records: &'m [ContactRecord],
}

impl ContactMemory {
    /// Records of a key.
    #[inline]
    pub fn under(&self, key: &ContactKey) -> RecordsOfKey<'_> {
        let range = self.records.of_key(key);
        self.at(range)
    }

    /// Records of a range from an earlier search.
    #[inline(always)]
    pub fn at(&self, range: RecordRange) -> RecordsOfKey<'_> {
        RecordsOfKey { range, records: self.records.in_range(&range) }
    }
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
