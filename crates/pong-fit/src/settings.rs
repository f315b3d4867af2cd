//! Settings of an identification.

use crate::data::Quantity;
use crate::error::{FitError, Result};
use crate::parameter::Parameter;

/// Factor between a value of the scene and each bound, for a parameter without bounds.
const DEFAULT_FACTOR: f64 = 100.0;

/// A free parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Free {
    /// Name of a parameter (docs/campaigns.md).
    pub name: String,
    /// Bounds, in the parameter's unit. `None`: a hundredth to a hundred times of the scene's value.
    pub bounds: Option<(f64, f64)>,
}

/// Start of each record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Starts {
    /// Unknown: the first measurement has the sensor's noise as all others have.
    Fitted,
    /// The first measurement as it is.
    Measured,
}

/// Settings of an identification.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The free parameters.
    pub free: Vec<Free>,
    /// Noise of the sensors, in the units of the quantities; replaces that of the data.
    pub noise: [Option<f64>; 6],
    /// Quantities that count; all that were measured if it is empty.
    pub of: Vec<Quantity>,
    /// Time from the start of each record before which nothing counts, s.
    pub from: f64,
    /// Length of each record that counts, s; all of it without.
    pub horizon: Option<f64>,
    /// Relative number of records that take no part in the fit; with less than four records, share of the time.
    pub test: f64,
    /// Start of each record.
    pub starts: Starts,
    /// Number of points from which the search begins: the scene's values, and others between the bounds.
    pub tries: usize,
    /// Seed of the split, of the tries and of the bootstrap.
    pub seed: u64,
    /// Number of threads; the results have the same bits for any number.
    pub threads: usize,
    /// Relative number of cases in which an interval must contain the true value.
    pub confidence: f64,
    /// True for profile intervals, which take most of the time.
    pub profiles: bool,
    /// Largest number of iterations of a search.
    pub iterations: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            free: Vec::new(),
            noise: [None; 6],
            of: Vec::new(),
            from: 0.0,
            horizon: None,
            test: 0.25,
            starts: Starts::Fitted,
            tries: 8,
            seed: 0,
            threads: crate::Batch::threads_of_this_machine(),
            confidence: 0.95,
            profiles: true,
            iterations: 40,
        }
    }
}

impl Settings {
    /// # Errors
    /// Settings out of range, all of them at once.
    pub(crate) fn check(&self) -> Result<()> {
        let mut faults = Vec::new();
        let mut fault = |wrong: bool, thing: &str, cause: String, cure: &str| {
            if wrong {
                faults.push(format!("{thing}: {cause}; {cure}"));
            }
        };
        let cure = "name at least one, such as surface.MODEL.SURFACE.friction.mu (docs/campaigns.md)";
        fault(self.free.is_empty(), "free parameters", "there are none".to_owned(), cure);
        let test = self.test;
        fault(
            !(0.0..=0.9).contains(&test),
            "test share",
            format!("it is {test}"),
            "give a share from 0 to 0.9",
        );
        let from = self.from;
        fault(
            !(from >= 0.0 && from.is_finite()),
            "from",
            format!("it is {from} s"),
            "give a time from zero up, s",
        );
        let horizon = self.horizon.unwrap_or(1.0);
        fault(
            !(horizon > 0.0 && horizon.is_finite()),
            "horizon",
            format!("it is {horizon} s"),
            "give a time above zero, s",
        );
        let confidence = self.confidence;
        let wrong = !(0.5..=0.9999).contains(&confidence);
        fault(wrong, "confidence", format!("it is {confidence}"), "give a share from 0.5 to 0.9999");
        fault(
            self.tries == 0 || self.tries > 10_000,
            "tries",
            format!("it is {}", self.tries),
            "give 1 to 10000",
        );
        fault(self.threads == 0, "threads", "it is 0".to_owned(), "give at least one");
        if faults.is_empty() { Ok(()) } else { Err(FitError(faults.join("\n"))) }
    }
}

/// Scale of a parameter, with its bounds in its unit: the search works on the logarithm of the parameter where both bounds
/// are above zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    /// Lower bound, in the unit of the parameter.
    pub low: f64,
    /// Upper bound, in the unit of the parameter.
    pub high: f64,
    /// True if the search works on the logarithm.
    pub logarithmic: bool,
}

/// Difference for derivatives on a logarithmic scale.
const LOG_STEP: f64 = 5e-3;

/// Difference for derivatives on a linear scale, in lengths of the interval between the bounds.
const LINEAR_STEP: f64 = 1e-3;

impl Scale {
    /// The scale of a free parameter.
    ///
    /// # Errors
    /// Bounds that are not in order, or missing where the scene's value gives none.
    pub fn of(free: &Free, parameter: &Parameter) -> Result<Self> {
        let thing = || format!("parameter `{}`", free.name);
        let value = parameter.in_scene;
        let (low, high) = match free.bounds {
            Some(bounds) => bounds,
            None if value > 0.0 => (value / DEFAULT_FACTOR, value * DEFAULT_FACTOR),
            None => {
                let cause = format!("it has no bounds, and {value} in the scene gives none");
                return Err(FitError::new(thing(), cause, format!("write {}=LOW..HIGH", free.name)));
            }
        };
        if !(low < high && low.is_finite() && high.is_finite()) {
            let cause = format!("its bounds are {low} and {high}");
            return Err(FitError::new(thing(), cause, "give finite numbers, the lower first"));
        }
        Ok(Self { low, high, logarithmic: low > 0.0 })
    }

    pub fn to_search(self, value: f64) -> f64 {
        let value = value.clamp(self.low, self.high);
        if self.logarithmic { libm::log(value) } else { value }
    }

    pub fn to_value(self, z: f64) -> f64 {
        let value = if self.logarithmic { libm::exp(z) } else { z };
        value.clamp(self.low, self.high)
    }

    /// Bounds of the search.
    pub fn bounds(self) -> (f64, f64) {
        (self.to_search(self.low), self.to_search(self.high))
    }

    /// Difference for derivatives.
    pub fn step(self) -> f64 {
        if self.logarithmic { LOG_STEP } else { LINEAR_STEP * (self.high - self.low) }
    }
}
