//! Looks up what is remembered of contacts while a frame is worked out.

use super::memory::ContactMemory;
use super::record::{ContactKey, ContactRecord, ContactRole};
use pong_geometry::Vec3;
use pong_geometry::interference::Feature;

/// A contact continues another of the same key only if the cosine of their normals exceeds this (60°).
pub(crate) const SAME_WAY_COSINE_MIN: f64 = 0.5;

impl ContactMemory {
    /// The records under one key, with the index of the first: few keys have a head in common.
    #[inline]
    pub fn under(&self, key: &ContactKey) -> (usize, &[ContactRecord]) {
        let found = self.records.of_head(key.head());
        let records = self.records.found(&found);
        // Their heads are the key's.
        let tail = key.tail();
        let others = records.iter().take_while(|record| record.key.tail() < tail).count();
        let (_, records) = records.split_at(others);
        let same = records.iter().take_while(|record| record.key.tail() == tail).count();
        (found.first() + others, &records[..same])
    }

    /// The record of the given role, and its index, that a present contact with normal `n` continues: the one under its key with
    /// the normal n' nearest to it, ties by feature, if n·n' exceeds [`SAME_WAY_COSINE_MIN`].
    ///
    /// Nearest is told by |n − n'|, which is exact: the cosines of normals 1e-8 apart and nearer are all one, and among
    /// the faces of a plate folded by so little a contact would continue another's bristle.
    #[inline(always)]
    pub fn matching(
        &self,
        key: &ContactKey,
        normal: &Vec3,
        role: ContactRole,
    ) -> Option<(usize, &ContactRecord)> {
        let (first, records) = self.under(key);
        let mut best: Option<(usize, f64)> = None;
        let same_way = |record: &ContactRecord| record.normal_b.dot(normal) > SAME_WAY_COSINE_MIN;
        let all = records.iter().enumerate();
        for (i, record) in all.filter(|(_, record)| record.role == role && same_way(record)) {
            let apart = (record.normal_b - normal).norm_squared();
            let closer = best.is_none_or(|(b, least)| {
                apart < least || (apart == least && record.feature < records[b].feature)
            });
            if closer {
                best = Some((i, apart));
            }
        }
        best.map(|(i, _)| (first + i, &records[i]))
    }

    /// The role of the record that is nearest to a present contact, of whatever role: of the nearest normal, as for
    /// [`matching`](Self::matching), and where several have that normal, the contact's own feature.
    pub fn role_of_nearest(&self, key: &ContactKey, normal: &Vec3, feature: Feature) -> Option<ContactRole> {
        let (_, records) = self.under(key);
        let same_way = records.iter().filter(|record| record.normal_b.dot(normal) > SAME_WAY_COSINE_MIN);
        let apart = |record: &ContactRecord| (record.normal_b - normal).norm_squared();
        let is_other = |record: &ContactRecord| record.feature != feature.0;
        let nearest = same_way.min_by(|a, b| {
            apart(a).total_cmp(&apart(b)).then(is_other(a).cmp(&is_other(b))).then(a.feature.cmp(&b.feature))
        });
        nearest.map(|record| record.role)
    }
}
