//! Reference energies of a motion, to detect energy from nowhere.

use crate::energy::Energy;

/// Reference energies of a motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reference {
    pub energy: Energy,
    /// Energy stored in the contacts, J; infinite where it is not known.
    pub stored: f64,
    /// Diameter of the box around all bodies, m.
    pub size: f64,
}
