//! Mass properties of movable groups, and the host's step.

use crate::bounce::Accuracy;
use nalgebra::SMatrix;
use pong_engine::WrenchCoupling;
use pong_engine::{EngineError, State};
use pong_geometry::Mat3;

/// Mass properties of a movable group, for the step adviser alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroupMass {
    /// Mass, kg; infinite for a group that does not yield (fixed, or on a prescribed path).
    pub mass: f64,
    /// Inertia about the mass centre along the axes of the group frame, kg·m²: Ixx, Iyy, Izz, Ixy, Ixz, Iyz, the
    /// products those of the tensor itself (Ixy = −∫xy dm). All zero if it is not known: lever arms are then left out.
    pub inertia: [f64; 6],
    /// The mass centre in the group frame, m.
    pub mass_center: [f64; 3],
    /// Compliance of a group on joints; `None` for a free one.
    pub joints: Option<Joints>,
    /// The host's own springs and dampers that act on the group.
    pub springs: SpringRates,
}

/// Compliance of a group on joints, at one pose of its mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joints {
    /// Inverse inertia: acceleration (linear of the group's origin, then angular) per wrench (force, then
    /// moment about the origin), along the axes of the group frame; J·M⁻¹·Jᵀ of a mechanism with mass matrix
    /// M. Symmetric and positive semidefinite.
    pub inverse_inertia: [[f64; 6]; 6],
    /// Groups with the same number share joints: a push on one moves the others.
    pub mechanism: u32,
}

/// Springs and dampers of the host, beside contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpringRates {
    /// Upper bound of the largest eigenvalue of M⁻¹·K of the springs on the group, 1/s²
    /// ([`spring_rates`](crate::spring_rates)).
    pub stiffness: f64,
    /// Upper bound of the largest eigenvalue of M⁻¹·C of the dampers, 1/s.
    pub damping: f64,
}

impl SpringRates {
    /// True if there are neither springs nor dampers.
    pub fn is_zero(&self) -> bool {
        self.stiffness == 0.0 && self.damping == 0.0
    }
}

impl Joints {
    pub(crate) fn matrix(&self) -> SMatrix<f64, 6, 6> {
        // Symmetric part: the mean of entries that should be equal.
        let m = &self.inverse_inertia;
        SMatrix::from_fn(|i, j| 0.5 * (m[i][j] + m[j][i]))
    }

    /// Cause and cure, if no mechanism has such a matrix.
    fn fault(&self) -> Option<&'static str> {
        /// Tolerated relative rounding error.
        const ROUNDING: f64 = 1e-6;
        let m = &self.inverse_inertia;
        if m.iter().flatten().any(|x| x.is_nan() || x.abs() > State::LARGEST) {
            return Some("the inverse inertia on joints is not finite or beyond 1e100; give J·M⁻¹·Jᵀ");
        }
        // Entries mix m and rad, so each is compared with the diagonal of its row and column.
        let size = |i: usize, j: usize| (m[i][i].abs() * m[j][j].abs()).sqrt();
        let uneven = |i: usize, j: usize| (m[i][j] - m[j][i]).abs() > ROUNDING * size(i, j);
        if (0..6).any(|i| (0..i).any(|j| uneven(i, j))) {
            return Some("the inverse inertia on joints is not symmetric; give J·M⁻¹·Jᵀ");
        }
        let values = self.matrix().symmetric_eigenvalues();
        (values.min() < -ROUNDING * values.amax())
            .then_some("the inverse inertia on joints has a direction of negative mass; give J·M⁻¹·Jᵀ")
    }
}

impl GroupMass {
    /// A group that does not yield.
    pub fn immovable() -> Self {
        Self::point(f64::INFINITY)
    }

    /// A mass whose inertia is not known, its centre at the group's origin.
    pub fn point(mass: f64) -> Self {
        Self { mass, inertia: [0.0; 6], mass_center: [0.0; 3], joints: None, springs: SpringRates::default() }
    }

    /// The inertia tensor, kg·m²; `None` if it is not known or the group does not yield.
    pub(crate) fn tensor(&self) -> Option<Mat3> {
        let [xx, yy, zz, xy, xz, yz] = self.inertia;
        let known = self.mass.is_finite() && self.inertia != [0.0; 6];
        known.then(|| Mat3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz))
    }

    /// Refuses values that no group can have; the error calls it `group`.
    ///
    /// # Errors
    /// [`EngineError::BadValue`].
    pub fn check(&self, group: &str) -> Result<(), EngineError> {
        let bad = |cause: String| Err(EngineError::BadValue { what: format!("mass of `{group}`"), cause });
        if self.mass.is_nan() || self.mass <= 0.0 {
            return bad(format!(
                "it is {} kg; give a mass above zero, or infinity for what does not yield",
                self.mass
            ));
        }
        let beyond = |x: &f64| x.is_nan() || x.abs() > State::LARGEST;
        if self.mass.is_finite() && (beyond(&self.mass) || beyond(&(1.0 / self.mass.max(f64::MIN_POSITIVE))))
        {
            let cause = format!("it is {:e} kg; give 1e-100 to 1e100, or infinity", self.mass);
            return bad(cause);
        }
        if self.mass_center.iter().any(beyond) {
            return bad(
                "the mass centre is not finite or beyond 1e100 m; give three finite coordinates".to_owned()
            );
        }
        if self.inertia.iter().any(beyond) {
            let cause = "the inertia is not finite or beyond 1e100 kg·m²; give finite moments, or zeros if they are not known";
            return bad(cause.to_owned());
        }
        if self.tensor().is_some_and(|tensor| root_of(tensor).is_none()) {
            let cause = "no body has this inertia; its principal moments must be above zero, or all values zero if \
                         they are not known";
            return bad(cause.to_owned());
        }
        if let Some(cause) = self.joints.as_ref().and_then(Joints::fault) {
            return bad(cause.to_owned());
        }
        let SpringRates { stiffness, damping } = self.springs;
        if [stiffness, damping].iter().any(|x| *x < 0.0 || beyond(x)) {
            let cause = "the rates of its springs are below zero or not finite; give numbers from zero up";
            return bad(cause.to_owned());
        }
        Ok(())
    }
}

/// The lower triangle whose product with its transpose is a symmetric matrix (Cholesky); `None` if the matrix
/// is not positive definite.
///
/// A pivot that is not positive is replaced before the square root and the division, because a compiler may
/// compute them before the branch.
pub(crate) fn root_of(mut matrix: Mat3) -> Option<Mat3> {
    for column in 0..3 {
        for before in 0..column {
            let share = matrix[(column, before)];
            for row in column..3 {
                matrix[(row, column)] -= share * matrix[(row, before)];
            }
        }
        let square = matrix[(column, column)];
        if square.is_nan() || square <= 0.0 {
            return None;
        }
        let root = square.max(f64::MIN_POSITIVE).sqrt();
        matrix[(column, column)] = root;
        for row in column + 1..3 {
            matrix[(row, column)] /= root;
        }
    }
    Some(matrix.lower_triangle())
}

/// The host's step and its use of the wrench.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepPlan {
    /// The step or frame, s.
    pub step: f64,
    /// Use of the wrench by the host.
    pub coupling: WrenchCoupling,
    /// Speed at which bodies touch, m/s; `None` if it is not known. Laws whose stiffness or damping follows
    /// the depth are judged at the depth that this speed gives, and not at all without it.
    pub closing_speed: Option<f64>,
    /// Speed that a fall in the scene can reach, m/s; `None` if it is not known. Contacts of solids that would gain
    /// energy at this speed get a note.
    pub fall_speed: Option<f64>,
    /// Accuracy of a bounce; `None` to be warned of instability alone.
    pub accuracy: Option<Accuracy>,
}

impl StepPlan {
    /// A plan with accuracies of 5 % for the depth and 2 % for the rebound.
    pub fn new(step: f64, coupling: WrenchCoupling) -> Self {
        Self { step, coupling, closing_speed: None, fall_speed: None, accuracy: Some(Accuracy::default()) }
    }

    /// Refuses values that no host can have.
    ///
    /// # Errors
    /// [`EngineError::BadValue`].
    pub fn check(&self) -> Result<(), EngineError> {
        /// Upper limit: longer delays are more likely a typing error.
        const DELAY_FRAMES_MAX: u32 = 100;
        let bad = |cause: String| Err(EngineError::BadValue { what: "step plan".to_owned(), cause });
        let positive = |value: f64| value > 0.0 && value.is_finite();
        if !positive(self.step) {
            return bad(format!("the step is {} s; give a finite time above zero", self.step));
        }
        if [self.closing_speed, self.fall_speed].into_iter().flatten().any(|speed| !positive(speed)) {
            return bad(
                "the closing speed must be finite and above zero; leave it out if it is not known".to_owned()
            );
        }
        if self.accuracy.is_some_and(|wanted| !positive(wanted.depth) || !positive(wanted.rebound)) {
            return bad(
                "both accuracies must be finite and above zero; leave them out to ask for none".to_owned()
            );
        }
        match self.coupling {
            WrenchCoupling::ZeroOrderHold { delay_frames: late } if late > DELAY_FRAMES_MAX => {
                bad(format!("the wrench comes {late} frames late; give at most {DELAY_FRAMES_MAX}"))
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pong_testkit::Random;
    use pong_testkit::exceptions::are_raised_by;
    use std::hint::black_box;

    /// The roots agree with nalgebra's to the bit, and are missing where nalgebra has none; no root is taken
    /// of a negative number.
    #[test]
    fn roots_of_random_matrices() {
        let mut random = Random(7);
        let mut found = 0;
        for _ in 0..2_000 {
            let any = Mat3::from_fn(|_, _| random.between(-1.0, 1.0));
            let matrix = any * any.transpose() - Mat3::identity() * random.between(0.0, 0.2);
            let expected = matrix.cholesky().map(|factor| factor.l());
            assert_eq!(root_of(matrix), expected, "{matrix}");
            found += u32::from(expected.is_some());
            let raised = are_raised_by(|| {
                black_box(root_of(black_box(matrix)));
            });
            assert!(!raised, "{matrix}");
        }
        assert!((500..1_500).contains(&found), "{found}");
    }

    #[test]
    fn an_inertia_of_no_body_has_no_root_and_raises_nothing() {
        for moments in
            [[-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, -1.0], [0.0, 1.0, 1.0], [1.0, 0.0, 0.0]]
        {
            let matrix = Mat3::from_diagonal(&moments.into());
            assert!(!are_raised_by(|| assert!(root_of(black_box(matrix)).is_none())), "{moments:?}");
        }
    }
}
