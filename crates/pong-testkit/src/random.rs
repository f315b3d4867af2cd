//! A deterministic source of numbers: the same seed gives the same scenes on every machine.

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

type Vec3 = Vector3<f64>;
type Quat = UnitQuaternion<f64>;

/// Pseudo-random numbers (splitmix64; Steele, Lea and Flood 2014). The seed is its state.
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// An independent sequence of numbers for every (seed, stream, index).
    pub fn new(seed: u64, stream: u64, index: u64) -> Self {
        let mut random = Self(seed);
        for part in [stream, index] {
            random.0 = random.bits().wrapping_add(part.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        }
        random
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number from 0 up to, but not including, 1.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number between two bounds.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// A number between two positive bounds, with uniform logarithm.
    pub fn log_between(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.between(libm::log(low), libm::log(high)))
    }

    /// An index below `count`, which must not be 0.
    pub fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    /// True with this probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// One element of a list.
    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    /// A vector with every component between ±`size`.
    pub fn vector(&mut self, size: f64) -> Vec3 {
        Vec3::from_fn(|_, _| self.between(-size, size))
    }

    /// A unit vector, uniform over the sphere.
    pub fn direction(&mut self) -> Vec3 {
        loop {
            let v = self.vector(1.0);
            let length = v.norm();
            if (0.1..1.0).contains(&length) {
                return v / length;
            }
        }
    }

    /// A unit vector perpendicular to another.
    pub fn across(&mut self, n: &Vec3) -> Vec3 {
        loop {
            let v = n.cross(&self.direction());
            if v.norm() > 0.1 {
                return v.normalize();
            }
        }
    }

    /// A rotation with uniform axis and uniform angle, the same bits on every machine.
    pub fn orientation(&mut self) -> Quat {
        self.small_rotation(std::f64::consts::PI)
    }

    /// The matrix of a rotation from [`orientation`](Self::orientation).
    pub fn rotation_matrix(&mut self) -> Matrix3<f64> {
        self.orientation().to_rotation_matrix().into_inner()
    }

    /// A rotation by at most `angle`, rad.
    pub fn small_rotation(&mut self, angle: f64) -> Quat {
        let axis = self.direction();
        rotation_about(&axis, self.between(-angle, angle))
    }

    /// A rotation with the platform's sine: its rotation vector has components within ±3 rad.
    pub fn rotation(&mut self) -> Quat {
        Quat::from_scaled_axis(self.vector(3.0))
    }

    /// A random permutation of the indices below `count`.
    pub fn order(&mut self, count: usize) -> Vec<usize> {
        let mut order: Vec<usize> = (0..count).collect();
        for last in (1..count).rev() {
            order.swap(last, self.below(last + 1));
        }
        order
    }
}

/// The rotation about a unit axis, the same bits on every machine.
pub fn rotation_about(axis: &Vec3, angle: f64) -> Quat {
    let (sine, cosine) = (libm::sin(0.5 * angle), libm::cos(0.5 * angle));
    let v = axis * sine;
    Quat::new_normalize(Quaternion::new(cosine, v.x, v.y, v.z))
}

/// The shortest rotation from one unit vector to another.
pub fn rotation_between(from: &Vec3, to: &Vec3) -> Quat {
    Quat::rotation_between(from, to).unwrap_or_else(|| {
        let side = if from.x.abs() < 0.6 { Vec3::x() } else { Vec3::y() };
        rotation_about(&from.cross(&side).normalize(), std::f64::consts::PI)
    })
}
