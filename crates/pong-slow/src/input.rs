//! Input of a frame: states, masses and accelerations of the movable groups, checked.

use crate::error::SlowError;
use nalgebra::Matrix6;
use pong_engine::{InterfaceId, State, World};
use pong_geometry::{Mat3, Vec3};

/// Relative tolerance of the checks for symmetry and definiteness.
const TOLERANCE: f64 = 1e-9;

/// Answer of a movable group to an impulse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dynamics {
    /// A free rigid body. Its wrench is to be held along common axes.
    Free {
        /// Mass, kg.
        mass: f64,
        /// Inertia about the mass centre along the axes of the group frame, kg·m².
        inertia: [[f64; 3]; 3],
        /// Mass centre in the group frame, m.
        mass_center: [f64; 3],
    },
    /// A body that joints hold. Its wrench is to be held along the axes of the group.
    Jointed {
        /// Mobility: velocity (m/s and rad/s) of the group's origin per impulse (N·s and N·m·s about the origin), both
        /// along the axes of the group, linear rows and columns first. Symmetric, no negative eigenvalue.
        mobility: [[f64; 6]; 6],
    },
    /// A body that contact does not move: the ground, or a body on a prescribed path.
    Prescribed,
}

/// State and dynamics of a movable group at the start of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroupInput {
    /// The movable group.
    pub interface: InterfaceId,
    /// State that the host has, relative to and expressed in the common frame.
    pub state: State,
    /// Answer to an impulse.
    pub dynamics: Dynamics,
    /// Linear acceleration without contact, m/s², along common axes: of the mass centre of a free body, of the group's
    /// origin otherwise. Gravity, thrusters and the forces of joints are in it.
    pub linear_acceleration: [f64; 3],
    /// Angular acceleration without contact, rad/s², along common axes.
    pub angular_acceleration: [f64; 3],
}

/// Velocity that an impulse on one jointed group gives another one, because joints connect them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupling {
    /// The group that moves.
    pub of: InterfaceId,
    /// The group that gets the impulse.
    pub by: InterfaceId,
    /// Cross mobility: velocity (m/s and rad/s) of the origin of `of`, along the axes of `of`, per impulse (N·s and N·m·s)
    /// on `by` about its origin, along the axes of `by`; linear rows and columns first. That of `by` per impulse on `of`
    /// is its transpose.
    pub mobility: [[f64; 6]; 6],
}

impl Coupling {
    /// Indices of both groups.
    pub(crate) fn places(&self) -> (usize, usize) {
        (self.of.index(), self.by.index())
    }

    /// The cross mobility as a matrix.
    pub(crate) fn block(&self) -> Matrix6<f64> {
        Matrix6::from_fn(|i, j| self.mobility[i][j])
    }
}

/// Refuses couplings of other worlds, of a group with itself, given twice, or not finite.
pub(crate) fn require_couplings(world: &World, couplings: &[Coupling]) -> Result<(), SlowError> {
    let mut seen = Vec::with_capacity(couplings.len());
    for coupling in couplings {
        world.state_as_set(coupling.of)?;
        world.state_as_set(coupling.by)?;
        let (of, by) = coupling.places();
        let fault = if of == by {
            "it is one group; give its own mobility as `Jointed` dynamics"
        } else if seen.contains(&(of.min(by), of.max(by))) {
            "it is given twice; one direction is enough"
        } else if coupling.mobility.as_flattened().iter().any(|x| !x.is_finite()) {
            "it is not finite; give 36 finite numbers"
        } else {
            seen.push((of.min(by), of.max(by)));
            continue;
        };
        let name = |group| world.inspect().group_name(group);
        let what = format!("coupling of `{}` and `{}`", name(of), name(by));
        return Err(SlowError::BadInput { what, cause: fault.to_owned() });
    }
    Ok(())
}

/// Refuses a frame length that is not positive and finite.
pub(crate) fn require_frame(length: f64) -> Result<(), SlowError> {
    if length > 0.0 && length.is_finite() {
        return Ok(());
    }
    let cause = format!("it is {length} s; give the positive time until the next call");
    Err(SlowError::BadInput { what: "length of the frame".to_owned(), cause })
}

/// Inputs in the order of the movable groups of the world: each group once, all values usable.
pub(crate) fn in_order<'i>(
    world: &World,
    inputs: &'i [GroupInput],
) -> Result<Vec<&'i GroupInput>, SlowError> {
    let inspection = world.inspect();
    let count = inspection.group_count();
    let mut found: Vec<Option<&GroupInput>> = vec![None; count];
    for input in inputs {
        // Refuses ids of other worlds.
        world.state_as_set(input.interface)?;
        let place = &mut found[input.interface.index()];
        let name = || inspection.group_name(input.interface.index());
        if place.is_some() {
            let what = format!("input of `{}`", name());
            return Err(SlowError::BadInput { what, cause: "it is given twice; leave one out".to_owned() });
        }
        require_finite(input, name)?;
        *place = Some(input);
    }
    let named = |(index, input): (usize, Option<&'i GroupInput>)| {
        input.ok_or_else(|| SlowError::BadInput {
            what: format!("mass of `{}`", inspection.group_name(index)),
            cause: "it is missing; give state, dynamics and acceleration of every movable group, `Prescribed` for one \
                    that contact does not move"
                .to_owned(),
        })
    };
    found.into_iter().enumerate().map(named).collect()
}

fn require_finite(input: &GroupInput, name: impl Fn() -> String) -> Result<(), SlowError> {
    let numbers = input.linear_acceleration.iter().chain(&input.angular_acceleration);
    for number in numbers {
        if !number.is_finite() {
            let cause = format!("it holds {number}; give finite numbers");
            return Err(SlowError::BadInput { what: format!("acceleration of `{}`", name()), cause });
        }
    }
    Ok(())
}

/// Mobility of a group in its chart (`chart.rs`), for a group frame turned by `rotation`; `None` of a body that contact
/// does not move.
pub(crate) fn mobility_of(
    dynamics: &Dynamics,
    rotation: &Mat3,
    name: &str,
) -> Result<Option<Matrix6<f64>>, SlowError> {
    let refused = |quantity: &str, cause: String| {
        Err(SlowError::BadInput { what: format!("{quantity} of `{name}`"), cause })
    };
    match dynamics {
        Dynamics::Prescribed => Ok(None),
        Dynamics::Free { mass, inertia, mass_center } => {
            if !(*mass > 0.0 && mass.is_finite()) {
                return refused("mass", format!("it is {mass} kg; give a positive mass, or `Prescribed`"));
            }
            if mass_center.iter().any(|x| !x.is_finite()) {
                return refused("mass centre", "it is not finite; give three finite coordinates".to_owned());
            }
            let inertia = Mat3::from_fn(|i, j| inertia[i][j]);
            let Some(inverse) = inverse_inertia(&inertia) else {
                return refused(
                    "inertia",
                    "it is not symmetric with positive moments; give the tensor about the mass centre"
                        .to_owned(),
                );
            };
            let mut mobility = Matrix6::zeros();
            mobility.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(1.0 / mass);
            let turned = rotation * inverse * rotation.transpose();
            mobility.fixed_view_mut::<3, 3>(3, 3).copy_from(&turned);
            Ok(Some(mobility))
        }
        Dynamics::Jointed { mobility } => {
            let mobility = Matrix6::from_fn(|i, j| mobility[i][j]);
            if let Some(cause) = fault_of_mobility(&mobility) {
                return refused("mobility", cause);
            }
            Ok(Some(mobility))
        }
    }
}

fn inverse_inertia(inertia: &Mat3) -> Option<Mat3> {
    if inertia.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let symmetric = (inertia - inertia.transpose()).amax() <= TOLERANCE * inertia.amax();
    let cholesky = inertia.cholesky()?;
    symmetric.then(|| cholesky.inverse())
}

/// Cause and cure of a mobility with a negative eigenvalue.
pub(crate) fn gains() -> String {
    "an impulse would move the body against itself; give a mobility without negative eigenvalues".to_owned()
}

fn fault_of_mobility(mobility: &Matrix6<f64>) -> Option<String> {
    if mobility.iter().any(|x| !x.is_finite()) {
        return Some("it is not finite; give 36 finite numbers".to_owned());
    }
    // Rows scaled to a unit diagonal: metres and radians then compare.
    let scale = mobility.diagonal().map(|x| if x > 0.0 { 1.0 / x.sqrt() } else { 0.0 });
    let scaled = Matrix6::from_fn(|i, j| mobility[(i, j)] * scale[i] * scale[j]);
    let too_large = |x: &f64| x.is_nan() || x.abs() > 1.0 + TOLERANCE;
    if scaled.iter().any(too_large) {
        return Some(gains());
    }
    if (scaled - scaled.transpose()).amax() > TOLERANCE {
        return Some(
            "it is not symmetric; give velocity per impulse about one point along one set of axes".to_owned(),
        );
    }
    let negative = mobility.diagonal().iter().any(|x| *x < 0.0);
    let outside = (0..6).any(|i| (0..6).any(|j| scale[i] * scale[j] == 0.0 && mobility[(i, j)] != 0.0));
    if negative || outside {
        return Some(gains());
    }
    if mobility.amax() == 0.0 {
        return Some("it is zero; give `Prescribed` for a body that contact does not move".to_owned());
    }
    None
}

/// Vector of three numbers.
pub(crate) fn vector(numbers: [f64; 3]) -> Vec3 {
    Vec3::from(numbers)
}
