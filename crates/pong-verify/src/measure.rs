//! Periods, roots, observed orders, rotations.

use pong_executive::{Quat, Vec3};

/// Upward zero crossings of a signal, from samples of value and rate.
#[derive(Debug, Default)]
pub struct Crossings {
    pub times: Vec<f64>,
    last: Option<(f64, f64, f64)>,
}

impl Crossings {
    /// Adds a sample.
    pub fn push(&mut self, time: f64, value: f64, rate: f64) {
        if let Some((t0, x0, v0)) = self.last
            && x0 < 0.0
            && value >= 0.0
        {
            let h = time - t0;
            // Hermite cubic through both samples and their rates.
            let cubic = |u: f64| {
                let w = 1.0 - u;
                w * w * ((1.0 + 2.0 * u) * x0 + u * h * v0) + u * u * ((3.0 - 2.0 * u) * value - w * h * rate)
            };
            self.times.push(t0 + h * bisect(0.0, 1.0, |u| cubic(u) < 0.0));
        }
        self.last = Some((time, value, rate));
    }

    /// Mean time between crossings.
    pub fn period(&self) -> f64 {
        let (first, last) = (self.times.first(), self.times.last());
        match (first, last) {
            (Some(first), Some(last)) if self.times.len() > 1 => {
                (last - first) / (self.times.len() - 1) as f64
            }
            _ => f64::NAN,
        }
    }
}

/// Upper end of the interval from `low` in which `below` holds, found by bisection.
pub fn bisect(mut low: f64, mut high: f64, mut below: impl FnMut(f64) -> bool) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// Order of a method from its errors at a step and at half of it.
pub fn order(coarse: f64, fine: f64) -> f64 {
    libm::log2((coarse / fine).abs())
}

/// Rotation of a rotation vector (axis times angle), without the platform's sine.
pub fn rotation(vector: Vec3) -> Quat {
    let angle = vector.norm();
    let half = 0.5 * angle;
    let ratio = if angle > 0.0 { libm::sin(half) / angle } else { 0.5 };
    let [x, y, z] = (vector * ratio).into();
    pong_executive::Pose::new(Vec3::zeros(), [libm::cos(half), x, y, z]).orientation
}

/// Degrees to radians.
pub fn radians(degrees: f64) -> f64 {
    degrees * core::f64::consts::PI / 180.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossings_of_a_sine() {
        let mut crossings = Crossings::default();
        for i in 0..2000 {
            let t = f64::from(i) * 0.01;
            crossings.push(t, libm::sin(t), libm::cos(t));
        }
        assert_eq!(crossings.times.len(), 3);
        assert!((crossings.period() - 2.0 * core::f64::consts::PI).abs() < 1e-10);
    }

    #[test]
    fn order_of_a_fourth_order_method() {
        assert_eq!(order(16.0, 1.0), 4.0);
    }
}
