//! A deterministic source of numbers (splitmix64), so that every run has the same scene.

use pong_geometry::{Pose, Quat, Vec3};

/// The generator; the seed is its state.
pub struct Random(pub u64);

impl Random {
    /// The next number, 0 ≤ x < 1.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// The next number, low ≤ x < high.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A unit vector, every direction as likely.
    pub fn direction(&mut self) -> Vec3 {
        loop {
            let v = Vec3::from_fn(|_, _| self.between(-1.0, 1.0));
            if (0.01..1.0).contains(&v.norm()) {
                return v.normalize();
            }
        }
    }

    /// An orientation, every one as likely.
    pub fn rotation(&mut self) -> Quat {
        loop {
            let wxyz: [f64; 4] = std::array::from_fn(|_| self.between(-1.0, 1.0));
            if (0.01..1.0).contains(&wxyz.iter().map(|x| x * x).sum::<f64>()) {
                return Pose::new(Vec3::zeros(), wxyz).orientation;
            }
        }
    }
}
