//! Loads at which a linear interface ends: the first contact opens, or the first bristle lets go.

use nalgebra::{SMatrix, Vector6};
use pong_engine::{Contact, ContactTangent, EngineError, FrictionProps, World};
use pong_geometry::{Mat3, Vec3};

/// Load beyond which nothing is reported, over the sum of the normal forces: what opens there does so by rounding.
const FAR: f64 = 1e6;

/// Share of the load at which a contact opens within which it does not slide before.
const TOGETHER: f64 = 1e-9;

/// Event of a contact that ends the range of a linear interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// Its normal force becomes zero.
    Opens,
    /// Its friction force reaches the static limit μN.
    Slides,
}

/// A load on the first set that ends the range of the linear interface.
#[derive(Clone, Debug)]
pub struct LoadLimit {
    /// Component of the load: 0 to 2 force along x, y, z, 3 to 5 moment about them.
    pub component: usize,
    /// The load beyond the preload, N or N·m, with its sign.
    pub load: f64,
    /// Event at this load.
    pub ending: Ending,
    /// The two primitives.
    pub contact: String,
}

/// A contact at the preload, with the changes of its forces in a motion of the first set.
pub(super) struct PreloadedContact {
    name: String,
    /// Vector from the reference point to the contact point, m, common axes.
    arm: Vec3,
    /// Normal force, N.
    normal_force: f64,
    /// Change of the normal force, N/m and N/rad.
    normal_change: Vector6<f64>,
    /// Friction force on A, N, common axes.
    friction_force: Vec3,
    /// Change of the friction force, N/m and N/rad.
    friction_change: SMatrix<f64, 3, 6>,
    /// Coefficient of static friction of a contact that sticks.
    friction: Option<f64>,
}

impl PreloadedContact {
    /// `is_a` is true if side A of the contact is in the first set.
    pub fn new(
        name: String,
        contact: &Contact,
        is_a: bool,
        reference: &Vec3,
        (springs, friction): (&ContactTangent, Option<f64>),
    ) -> Self {
        let arm = contact.point - reference;
        // Displacement of A's point relative to B's: v + θ × arm, or its opposite.
        let mut displacement = SMatrix::<f64, 3, 6>::zeros();
        displacement.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
        displacement.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm.cross_matrix());
        if !is_a {
            displacement = -displacement;
        }
        let across = Mat3::identity() - contact.normal * contact.normal.transpose();
        Self {
            name,
            arm,
            normal_force: contact.normal_force,
            normal_change: -springs.normal.stiffness * displacement.transpose() * contact.normal,
            friction_force: contact.friction_force,
            friction_change: -springs.tangential.stiffness * across * displacement,
            friction: friction.filter(|_| contact.sticks),
        }
    }

    /// Distance of the contact point from the reference point, m.
    pub fn lever(&self) -> f64 {
        self.arm.norm()
    }

    /// Load over unit load at which the contact opens if the unit load moves the first set by `motion`.
    fn opens_at(&self, motion: &Vector6<f64>, sign: f64) -> Option<f64> {
        let change = sign * self.normal_change.dot(motion);
        (change < 0.0).then(|| self.normal_force / -change)
    }

    /// Load over unit load at which the friction force t and the normal force N are in |t| = μ·N: the least positive
    /// root of |t + λ·dt|² = μ²·(N + λ·dN)².
    fn slides_at(&self, motion: &Vector6<f64>, sign: f64) -> Option<f64> {
        let mu = self.friction?;
        let (limit, limit_change) = (mu * self.normal_force, mu * sign * self.normal_change.dot(motion));
        let (force, change) = (self.friction_force, sign * self.friction_change * motion);
        let square = change.norm_squared() - limit_change * limit_change;
        let half = force.dot(&change) - limit * limit_change;
        let left = (limit * limit - force.norm_squared()).max(0.0);
        let discriminant = half * half + square * left;
        let divisor = half + discriminant.max(0.0).sqrt();
        let load = (discriminant >= 0.0 && divisor > 0.0).then(|| left / divisor)?;
        // Where both forces end together, the contact opens.
        let opens = self.opens_at(motion, sign).unwrap_or(f64::INFINITY);
        (load < opens * (1.0 - TOGETHER)).then_some(load)
    }
}

/// Coefficient of static friction between the surfaces of a contact; `None` without a bristle.
pub(super) fn static_friction(world: &World, contact: &Contact) -> Result<Option<f64>, EngineError> {
    let side = |side: &pong_engine::ContactSide| (side.interface.index(), side.primitive);
    let (a, b) = (side(&contact.a), side(&contact.b));
    let mut pushing = world.inspect().pushing()?;
    let same = pushing.find(|one| (one.group_a, one.primitive_a) == a && (one.group_b, one.primitive_b) == b);
    Ok(same.and_then(|one| match one.props.friction {
        FrictionProps::Bristle { mu_static, .. } => Some(mu_static),
        _ => None,
    }))
}

/// Limits of a load of one component in both directions. A unit load moves the first set by `motion`.
pub(super) fn of_load(
    component: usize,
    motion: &Vector6<f64>,
    contacts: &[PreloadedContact],
    lever: f64,
) -> Vec<LoadLimit> {
    let normal_forces: f64 = contacts.iter().map(|contact| contact.normal_force).sum();
    let far = FAR * normal_forces * if component < 3 { 1.0 } else { lever };
    let mut limits = Vec::new();
    for sign in [1.0, -1.0] {
        for ending in [Ending::Opens, Ending::Slides] {
            let load = |contact: &PreloadedContact| match ending {
                Ending::Opens => contact.opens_at(motion, sign),
                Ending::Slides => contact.slides_at(motion, sign),
            };
            let loads = contacts.iter().filter_map(|contact| Some((load(contact)?, contact)));
            let least = loads.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(load, _)| *load < far);
            limits.extend(least.map(|(load, contact)| LoadLimit {
                component,
                load: sign * load,
                ending,
                contact: contact.name.clone(),
            }));
        }
    }
    limits
}
