//! Energy in the springs of the last frame's contacts: the work of pressing them in from touch.
//!
//! ```text
//! U = w·½kδ² (laws of exponent 1)      U = w·⅖kδ^(5/2) (exponent 3/2)      w: the contact's weight
//! ```

use crate::setting::Setting;
use pong_engine::{EngineError, NormalProps, PairProps, World};
use pong_model::Exponent;
use std::collections::BTreeMap;

/// Energy that the contacts of two movable groups store.
#[derive(Clone, Debug, PartialEq)]
pub struct StoredEnergy {
    /// The two movable groups: indices of their Interfaces.
    pub groups: [usize; 2],
    /// `object/path` of the two.
    pub names: [String; 2],
    /// Energy of all normal springs between them, J.
    pub energy: f64,
    /// The depth of the deepest contact, m.
    pub depth: f64,
    /// Deepest contact: `groups[deepest.0]` is the group in whose frame its position `deepest.1` is given, m.
    pub deepest: (usize, [f64; 3]),
    /// Contacts with a normal law of the host's, whose energy is not known.
    pub not_known: usize,
}

/// Energy stored by the contacts of the last frame, for every pair of movable groups in contact. Bristles are left out.
///
/// # Errors
/// A world that has no frame yet.
pub fn stored_energy(world: &World) -> Result<Vec<StoredEnergy>, EngineError> {
    let setting = Setting::new(world, &[])?;
    let mut stored: BTreeMap<usize, StoredEnergy> = BTreeMap::new();
    for contact in setting.scene.pushing()? {
        let pair = &setting.scene.pairs()[contact.pair];
        let groups = [pair.first, pair.second];
        let sum = stored.entry(contact.pair).or_insert_with(|| StoredEnergy {
            groups,
            names: groups.map(|group| setting.scene.group_name(group)),
            energy: 0.0,
            depth: 0.0,
            deepest: (0, [0.0; 3]),
            not_known: 0,
        });
        match pressed_in(contact.props, contact.depth) {
            Some(energy) => sum.energy += contact.weight * energy,
            None => sum.not_known += 1,
        }
        if contact.depth > sum.depth {
            let side = usize::from(groups[1] == contact.group_b);
            (sum.depth, sum.deepest) = (contact.depth, (side, contact.point_b.into()));
        }
    }
    Ok(stored.into_values().collect())
}

/// The work of the undamped law from touch to a depth, J; `None` for laws of the host's.
fn pressed_in(props: &PairProps, depth: f64) -> Option<f64> {
    if matches!(props.normal, NormalProps::Custom { .. }) {
        return None;
    }
    let k = props.stiffness;
    Some(match props.normal.exponent() {
        Exponent::One => 0.5 * k * depth * depth,
        Exponent::ThreeHalves => 0.4 * k * depth * depth * depth.sqrt(),
    })
}
