//! The reference: Runge-Kutta with smaller and smaller steps, whose differences estimate its own error.
//!
//! Three runs at steps 4h, 2h and h (errors ε of order p: ε ≈ C·hᵖ) have the differences d₁ = |4h − 2h| and
//! d₂ = |2h − h|, which give the observed order and the error of the last run (Richardson):
//!
//! ```text
//! p = log₂(d₁/d₂)        ε(h) ≈ d₂/(2ᵖ − 1)
//! ```

use crate::sweep::errors::{Errors, Quantity};
use serde::{Deserialize, Serialize};

/// Accepted range of observed orders: contact begins and ends between steps, where no method has its own
/// order, and an order above four is chance.
const BELIEVED_ORDERS: (f64, f64) = (0.5, 4.0);

/// Differences below this are rounding errors.
const ROUNDING: f64 = 1e-12;

/// Properties of the reference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// Its steps in a frame.
    pub steps_per_frame: u32,
    /// Checks by quantity, in the order of [`Quantity::ALL`].
    pub checks: [Check; 5],
}

/// Richardson's check of one quantity, relative as the errors are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// The observed order of convergence in the step, without unit; `None` where the differences are rounding.
    pub order: Option<f64>,
    /// The estimated relative error of the reference.
    #[serde(with = "crate::sweep::store::number")]
    pub error: f64,
}

impl Check {
    /// Check from the difference between the first two of three runs and that between the last two.
    pub fn new(first: f64, second: f64) -> Self {
        if first.max(second) < ROUNDING {
            return Self { order: None, error: second };
        }
        let order = if second > 0.0 { libm::log2(first / second) } else { BELIEVED_ORDERS.1 };
        // Two infinite differences have no order.
        let believed = if order.is_nan() {
            BELIEVED_ORDERS.0
        } else {
            order.clamp(BELIEVED_ORDERS.0, BELIEVED_ORDERS.1)
        };
        Self { order: order.is_finite().then_some(order), error: second / (libm::exp2(believed) - 1.0) }
    }
}

impl Reference {
    /// Reference from the differences between the last three runs.
    pub fn new(steps_per_frame: u32, first: &Errors, second: &Errors) -> Self {
        let checks = Quantity::ALL.map(|quantity| Check::new(first.of(quantity), second.of(quantity)));
        Self { steps_per_frame, checks }
    }

    /// The check of a quantity.
    pub fn of(&self, quantity: Quantity) -> Check {
        self.checks[quantity as usize]
    }

    /// The largest estimated error of some quantities.
    pub fn uncertainty(&self, of: &[Quantity]) -> f64 {
        of.iter().map(|quantity| self.of(*quantity).error).fold(0.0, f64::max)
    }

    /// The largest share of the tolerance for the reference's own error: above it the reference has not
    /// converged.
    pub const SHARE: f64 = 0.25;

    /// True if levels can be judged by it.
    pub fn has_converged(&self, of: &[Quantity], within: f64) -> bool {
        self.uncertainty(of) <= Self::SHARE * within
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From errors C·hᵖ at 4h, 2h, h, the order and the error of the last are recovered.
    #[test]
    fn richardson_finds_order_and_error() {
        for order in [1.0, 2.0, 3.5, 4.0_f64] {
            let error = |halvings: i32| 0.3 * libm::exp2(-order * f64::from(halvings));
            let check = Check::new(error(0) - error(1), error(1) - error(2));
            assert!((check.order.unwrap() - order).abs() < 1e-12, "{check:?}");
            assert!((check.error / error(2) - 1.0).abs() < 1e-12, "{check:?}");
        }
    }

    /// Differences that do not fall mean no convergence: the reported error is then larger than the last
    /// difference.
    #[test]
    fn what_does_not_fall_is_not_believed() {
        let check = Check::new(0.01, 0.02);
        assert!(check.order.unwrap() < 0.0 && check.error > 0.02, "{check:?}");
        assert_eq!(Check::new(1e-15, 1e-14).order, None);
        assert_eq!(Check::new(0.0, 0.0), Check { order: None, error: 0.0 });
        assert!(Check::new(f64::INFINITY, f64::INFINITY).error.is_infinite());
    }
}
