//! Errors of a property over many poses.

use super::{VARIANTS, Variant};

/// Errors by variant, with the index of each pose.
pub struct Statistics {
    limit: f64,
    errors: Vec<(Variant, usize, f64)>,
}

impl Statistics {
    /// No errors yet, with the largest that is allowed.
    pub fn new(limit: f64) -> Self {
        Self { limit, errors: Vec::new() }
    }

    pub fn add(&mut self, variant: Variant, index: usize, error: f64) {
        self.errors.push((variant, index, error));
    }

    /// Prints the errors of each variant, and panics if one is beyond the limit.
    pub fn judge(&mut self, name: &str, poses: usize) {
        self.errors.sort_by(|a, b| a.2.total_cmp(&b.2));
        let mut beyond = 0;
        for variant in VARIANTS {
            let of: Vec<_> = self.errors.iter().filter(|(known, ..)| *known == variant).collect();
            let Some((_, index, worst)) = of.last() else { continue };
            let nearly_all = of[of.len() * 99 / 100].2;
            let outside = of.iter().filter(|(.., error)| *error > self.limit).count();
            println!(
                "{name}, {variant:?}: {} touch, 99 % {nearly_all:.1e}, worst {worst:.1e} (pose {index}), {outside} beyond",
                of.len()
            );
            for (_, index, error) in of.iter().rev().take(outside.min(5)) {
                println!("    pose {index}: {error:.3e}");
            }
            beyond += outside;
        }
        assert!(self.errors.len() > poses / 3, "{name}: only {} of {poses} touch", self.errors.len());
        assert!(beyond == 0, "{name}: {beyond} of {poses} beyond {:.0e}", self.limit);
    }
}
