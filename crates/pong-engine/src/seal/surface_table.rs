//! Combined surface values of two models.

use super::solids::FoundationKey;
use crate::law::{NormalProps, PairProps};
use pong_model::{Exponent, Surface};
use std::collections::BTreeMap;

/// Combined values of all pairs of surfaces of two models, A's model first.
pub(crate) struct SurfaceTable {
    pub model_a: usize,
    pub model_b: usize,
    /// Number of surfaces of B's model.
    pub columns: usize,
    /// Combined values in row-major order, one row per surface of A's model.
    pub props: Vec<Option<PairProps>>,
    /// True if contacts of any of these pairs resist rolling or spinning.
    pub has_resistance: bool,
    /// Combined values per unit area of solids and planes that may meet.
    pub foundations: BTreeMap<FoundationKey, PairProps>,
}

impl SurfaceTable {
    /// Empty table for two models.
    pub fn empty(model_a: usize, model_b: usize, surfaces: &[Vec<Surface>]) -> Self {
        let columns = surfaces[model_b].len();
        let props = vec![None; surfaces[model_a].len() * columns];
        Self { model_a, model_b, columns, props, has_resistance: false, foundations: BTreeMap::new() }
    }

    /// Values of a pair of surfaces that can meet.
    pub fn props(&self, surface_a: u32, surface_b: u32) -> &PairProps {
        let entry = &self.props[surface_a as usize * self.columns + surface_b as usize];
        entry.as_ref().expect("sealing combined every pair of surfaces that can meet")
    }

    /// Stiffness and damping of the stiffest pair of surfaces whose force is linear in the depth.
    pub fn stiffest(&self) -> Option<(f64, f64)> {
        let linear = self.props.iter().flatten().filter_map(|props| match &props.normal {
            NormalProps::Linear { damping, .. } => Some((props.stiffness, *damping)),
            NormalProps::HuntCrossley { exponent: Exponent::One, .. } => Some((props.stiffness, 0.0)),
            NormalProps::PowerLaw { damping, exponent: Exponent::One, damping_exponent } => {
                // Damping at touch.
                Some((props.stiffness, if *damping_exponent == 0.0 { *damping } else { 0.0 }))
            }
            NormalProps::HuntCrossley { .. } | NormalProps::PowerLaw { .. } | NormalProps::Custom { .. } => {
                None
            }
        });
        linear.max_by(|a, b| a.0.total_cmp(&b.0))
    }
}
