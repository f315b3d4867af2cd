//! An upper bound of the effect of the host's springs and dampers on each body: the largest eigenvalue of
//! M⁻¹·K and of M⁻¹·C.
//!
//! The springs between two bodies, u and v, are K = (J_u, J_v)ᵀ·k·(J_u, J_v). With S the roots of the inverse
//! inertia, the largest eigenvalue of SᵀKS is that of √k·(J_u·S_u·S_uᵀ·J_uᵀ + J_v·S_v·S_vᵀ·J_vᵀ)·√k, at most
//! the sum of the eigenvalues of the two parts. The axes of a spring are fixed in its first body; the second
//! may have rotated against them, so there a spring counts as isotropic with its largest stiffness.

use crate::mass::{GroupMass, SpringRates};
use crate::mobility::{Mat6, Mobility, largest_eigenvalue};
use nalgebra::DMatrix;
use pong_geometry::{Mat3, Vec3};
use std::collections::BTreeMap;

/// One end of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HostSpringEnd {
    /// Index of the body among the masses; `None` for the ground.
    pub body: Option<usize>,
    /// Point of application of the spring's force, m, in the group frame.
    pub place: Vec3,
}

/// A six-axis spring-damper of the host.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HostSpring {
    /// Both ends; the axes are fixed in the first.
    pub ends: [HostSpringEnd; 2],
    /// The spring's axes in the first body's group frame, as columns.
    pub axes: Mat3,
    /// Stiffness along the axes (N/m), then about them (N·m/rad).
    pub stiffness: [f64; 6],
    /// Damping along the axes (N·s/m), then about them (N·m·s/rad).
    pub damping: [f64; 6],
}

/// For every body the sum of the bounds of all springs that end on it. Any motion x has
/// x·Kx ≤ Σ λ_uv·(|x_u|² + |x_v|²) = Σ |x_u|²·(sum at u), so the largest sum bounds all modes.
pub fn spring_rates(masses: &[GroupMass], springs: &[HostSpring]) -> Vec<SpringRates> {
    let mobilities: Vec<Option<Mobility>> = masses.iter().map(Mobility::new).collect();
    let mut between: BTreeMap<[Option<usize>; 2], Vec<&HostSpring>> = BTreeMap::new();
    for spring in springs {
        between.entry(spring.ends.map(|end| end.body)).or_default().push(spring);
    }
    let mut rates = vec![SpringRates::default(); masses.len()];
    for (bodies, springs) in between {
        let of = |values: fn(&HostSpring) -> &[f64; 6]| {
            let part = |side: usize| {
                let mobility = bodies[side].and_then(|body| mobilities[body]);
                mobility.map_or(0.0, |mobility| largest(&mobility, &springs, side, values))
            };
            part(0) + part(1)
        };
        let (stiffness, damping) = (of(|spring| &spring.stiffness), of(|spring| &spring.damping));
        for body in bodies.into_iter().flatten().filter(|body| mobilities[*body].is_some()) {
            rates[body].stiffness += stiffness;
            rates[body].damping += damping;
        }
    }
    rates
}

/// The largest eigenvalue of the springs at one end, the other held.
fn largest(
    mobility: &Mobility,
    springs: &[&HostSpring],
    side: usize,
    values: fn(&HostSpring) -> &[f64; 6],
) -> f64 {
    let mut sum = Mat6::zeros();
    for spring in springs {
        let values = values(spring);
        let most = |three: &[f64]| three.iter().copied().fold(0.0, f64::max);
        for axis in 0..3 {
            let (along, about, direction) = match side {
                0 => (values[axis], values[axis + 3], spring.axes.column(axis).into_owned()),
                _ => (most(&values[..3]), most(&values[3..]), Mat3::identity().column(axis).into_owned()),
            };
            mobility.add(&mut sum, along, &direction, &spring.ends[side].place);
            mobility.add_rotational(&mut sum, about, &direction);
        }
    }
    largest_eigenvalue(DMatrix::from_column_slice(6, 6, sum.as_slice()))
}
