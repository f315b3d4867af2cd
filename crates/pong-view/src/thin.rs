//! Choice of the frames of a log for the page.

use pong_record::FrameRow;

/// Bytes of a frame, of a body in it and of a contact in it, before packing: the widths of the columns in `tables.rs`.
const FRAME: u64 = 36;
const BODY: u64 = 28 + 24;
const PEAKS: u64 = 12;
const CONTACT: u64 = 94;

/// Every n-th frame of a log, and the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Thinning {
    pub every: u64,
    /// Frames in the log.
    pub frames: u64,
}

impl Thinning {
    /// The stride asked for, or else the smallest whose frames stay within the budget, bytes.
    pub fn choose(rows: &[FrameRow], bodies: usize, every: Option<u64>, budget: u64) -> Self {
        let frames = rows.len() as u64;
        let thinned = |every| Self { every, frames };
        if let Some(every) = every {
            return thinned(every.max(1));
        }
        let mut every = thinned(1).size(rows, bodies).div_ceil(budget.max(1)).max(1);
        while every < frames && thinned(every).size(rows, bodies) > budget {
            every += 1;
        }
        thinned(every)
    }

    /// True if the frame with this index is kept.
    pub fn keeps(&self, index: u64) -> bool {
        index.is_multiple_of(self.every) || index + 1 == self.frames
    }

    fn size(&self, rows: &[FrameRow], bodies: usize) -> u64 {
        let body = BODY + if self.every > 1 { PEAKS } else { 0 };
        let kept = rows.iter().zip(0..).filter(|(_, index)| self.keeps(*index));
        kept.map(|(row, _)| FRAME + body * bodies as u64 + CONTACT * u64::from(row.contacts)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(count: u64) -> Vec<FrameRow> {
        let empty = pong_record::Frame::default().row;
        (0..count).map(|frame| FrameRow { frame, contacts: 4, ..empty }).collect()
    }

    #[test]
    fn what_fits_stays_whole() {
        let thinning = Thinning::choose(&rows(100), 2, None, 1 << 20);
        assert_eq!(thinning.every, 1);
        assert!((0..100).all(|index| thinning.keeps(index)));
    }

    #[test]
    fn what_does_not_fit_is_thinned_to_the_budget_and_keeps_its_ends() {
        let rows = rows(1000);
        let whole = Thinning { every: 1, frames: 1000 }.size(&rows, 2);
        let thinning = Thinning::choose(&rows, 2, None, whole / 7);
        assert!(thinning.size(&rows, 2) <= whole / 7);
        assert!(Thinning { every: thinning.every - 1, frames: 1000 }.size(&rows, 2) > whole / 7);
        assert!(thinning.keeps(0) && thinning.keeps(999) && !thinning.keeps(1));
    }

    #[test]
    fn what_is_asked_for_is_done() {
        let thinning = Thinning::choose(&rows(10), 2, Some(4), 1);
        let kept: Vec<u64> = (0..10).filter(|index| thinning.keeps(*index)).collect();
        assert_eq!(kept, [0, 4, 8, 9]);
    }
}
