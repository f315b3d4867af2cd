//! Incremental potentials of a step, and derivatives of the wrenches by the numbers of a surface.

use crate::guard::with_world;
use crate::handle::pong_world;
use crate::ids::{pong_interface_id, pong_model_id};
use crate::pointers::text;
use crate::status::pong_status;
use crate::tangents::{Destination, by_rows};
use crate::wrenches::pong_wrench;
use pong_engine::{PairPotential, SurfaceSlope};
use std::ffi::c_char;

/// Incremental potential of the contacts of two movable groups.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_potential {
    /// The two movable groups, in the order of pong_contact_change.
    pub interfaces: [pong_interface_id; 2],
    /// Energy that the contacts add, J.
    pub energy: f64,
    /// Minus its derivatives by the poses of both groups: force, N, and moment about the group's origin, N m, along common
    /// axes.
    pub wrenches: [pong_wrench; 2],
    /// Its second derivatives without the turning of normals and levers: `stiffness[i][j]` as in pong_tangent. The whole is
    /// symmetric and has no negative eigenvalue while no damper pulls.
    pub stiffness: [[[f64; 36]; 2]; 2],
}

/// Derivatives of the wrenches that two movable groups put on each other, by a number of a surface.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_surface_slope {
    /// The two movable groups, in the order of pong_contact_change.
    pub interfaces: [pong_interface_id; 2],
    /// Derivatives of the wrenches on both, N and N m over the unit of the number, about the group's origin, along common
    /// axes.
    pub wrenches: [pong_wrench; 2],
}

/// Copies the incremental potential of a step of length `step`, s, for every two movable groups that touch, always in the
/// same order: the first `capacity`; `count` gets their number. A host that finds the end of its step as the minimum of an
/// energy sets poses, evaluates, adds these energies, wrenches and second derivatives to its own, and commits the end that
/// it has found. The step starts at the last commit. The wrenches are not those of pong_get_wrenches(): the limit of
/// friction follows the load at the start, and damping the depth gained in the step over its length. See docs/theory.md, 7.
/// Allocates.
///
/// PONG_STATUS_WRONG_PHASE: call it between pong_evaluate() and the commit. PONG_STATUS_BAD_VALUE: `step` is not positive
/// and finite, or a contact is of two solids, has a law of the host or a resistance to rolling or spinning, or no unique
/// derivative. PONG_STATUS_BUFFER_TOO_SMALL if not all fit; `group_pairs` of the seal report is always enough. With capacity
/// 0 `potentials` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_incremental_potentials(
    world: *const pong_world,
    step: f64,
    potentials: *mut pong_potential,
    capacity: usize,
    count: *mut usize,
) -> pong_status {
    with_world(world, |inner| {
        let out = Destination::new((potentials, "potentials"), capacity, count)?;
        inner.law_faults.check()?;
        let found = inner.phase.frames("get incremental potentials")?.incremental_potentials(step)?;
        out.fill(&found)
    })
}

/// Copies the derivatives of the wrenches of the last frame by a number of a surface of a model, for every two movable
/// groups that touch, always in the same order: the first `capacity`; `count` gets their number. `number` is named as in
/// the model format: "stiffness", "normal.damping", "friction.mu" and so on. Poses and contact state are held. By
/// differences: two evaluations, three for a number that is zero. Surface and frame are those of before. Allocates.
///
/// PONG_STATUS_WRONG_PHASE: call it between pong_evaluate() and the commit. PONG_STATUS_UNKNOWN_NAME: the model has no such
/// surface, or the surface does not give the number. Otherwise errors as for pong_evaluate(); after PONG_STATUS_LAW_FAILED
/// the frame does not count. PONG_STATUS_BUFFER_TOO_SMALL if not all fit; `group_pairs` of the seal report is always
/// enough. With capacity 0 `slopes` may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_surface_slopes(
    world: *mut pong_world,
    model: pong_model_id,
    surface: *const c_char,
    number: *const c_char,
    slopes: *mut pong_surface_slope,
    capacity: usize,
    count: *mut usize,
) -> pong_status {
    with_world(world, |inner| {
        let out = Destination::new((slopes, "slopes"), capacity, count)?;
        let (surface, number) = (text(surface, "surface")?, text(number, "number")?);
        inner.law_faults.check()?;
        let found = inner.phase.frames_mut("get surface slopes")?.surface_slopes(model.id(), surface, number);
        inner.law_faults.collect();
        inner.law_faults.check()?;
        out.fill(&found?)
    })
}

impl From<&PairPotential> for pong_potential {
    fn from(potential: &PairPotential) -> Self {
        Self {
            interfaces: potential.groups.map(Into::into),
            energy: potential.energy,
            wrenches: potential.wrenches.each_ref().map(Into::into),
            stiffness: potential.stiffness.map(|row| row.map(|block| by_rows(&block))),
        }
    }
}

impl From<&SurfaceSlope> for pong_surface_slope {
    fn from(slope: &SurfaceSlope) -> Self {
        Self { interfaces: slope.groups.map(Into::into), wrenches: slope.wrenches.each_ref().map(Into::into) }
    }
}
