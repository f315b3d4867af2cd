//! Random numbers of the scenes, the same in every run.

use pong_geometry::{Pose, Quat, Vec3};

pub use pong_testkit::Random;

/// A uniformly distributed orientation.
pub fn rotation(random: &mut Random) -> Quat {
    loop {
        let wxyz: [f64; 4] = std::array::from_fn(|_| random.between(-1.0, 1.0));
        if (0.01..1.0).contains(&wxyz.iter().map(|x| x * x).sum::<f64>()) {
            return Pose::new(Vec3::zeros(), wxyz).orientation;
        }
    }
}
