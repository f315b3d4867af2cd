//! Sets of logical processors in the notation of the kernel.

use std::collections::BTreeSet;
use std::fmt;

/// Logical processors in the kernel's notation: `0-3,8`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CpuSet(BTreeSet<usize>);

/// Upper limit: more processors than any kernel supports (8,192 at most), so a larger number is not a list of
/// processors.
const PROCESSORS_MAX: usize = 1 << 16;

impl CpuSet {
    /// Parses the kernel's notation. An empty text is an empty set, and so is `(null)`, which some kernels
    /// write for `nohz_full`. `None` for any other text that is not a list.
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        if text.is_empty() || text == "(null)" {
            return Some(Self::default());
        }
        let mut cpus = BTreeSet::new();
        for part in text.split(',') {
            let (first, last) = part.split_once('-').unwrap_or((part, part));
            let number = |text: &str| text.trim().parse::<usize>().ok();
            let (first, last) = (number(first)?, number(last)?);
            if first > last || last >= PROCESSORS_MAX {
                return None;
            }
            cpus.extend(first..=last);
        }
        Some(Self(cpus))
    }

    /// Number of processors.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Processors in ascending order.
    pub fn iter(&self) -> impl Iterator<Item = usize> + '_ {
        self.0.iter().copied()
    }

    /// Processors in either set.
    pub(crate) fn union(&self, other: &Self) -> Self {
        Self(self.0.union(&other.0).copied().collect())
    }

    /// Processors in both sets.
    pub(crate) fn intersection(&self, other: &Self) -> Self {
        Self(self.0.intersection(&other.0).copied().collect())
    }
}

impl fmt::Display for CpuSet {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() {
            return write!(out, "none");
        }
        let mut ranges: Vec<(usize, usize)> = Vec::new();
        for cpu in self.iter() {
            match ranges.last_mut() {
                Some((_, last)) if *last + 1 == cpu => *last = cpu,
                _ => ranges.push((cpu, cpu)),
            }
        }
        let texts = ranges.iter().map(|(first, last)| match last - first {
            0 => first.to_string(),
            _ => format!("{first}-{last}"),
        });
        write!(out, "{}", texts.collect::<Vec<_>>().join(","))
    }
}

#[cfg(test)]
mod tests {
    use super::CpuSet;

    #[test]
    fn lists_are_read_and_written_as_the_kernel_does() {
        for (text, written, count) in
            [("0-1", "0-1", 2), ("0,2-3,8\n", "0,2-3,8", 4), ("5", "5", 1), ("3,1,2", "1-3", 3)]
        {
            let set = CpuSet::parse(text).unwrap();
            assert_eq!((set.to_string().as_str(), set.len()), (written, count));
        }
        for nothing in ["", "\n", "(null)"] {
            assert_eq!(CpuSet::parse(nothing).unwrap().to_string(), "none");
        }
    }

    #[test]
    fn what_is_no_list_is_refused() {
        for text in ["a", "1-", "-1", "3-1", "1,,2", "0-99999999999", "0-18446744073709551615"] {
            assert_eq!(CpuSet::parse(text), None, "{text}");
        }
    }
}
