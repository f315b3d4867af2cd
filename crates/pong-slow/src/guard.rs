//! Limit of the energy of the host's body: not above that of its copy, or of an implicit step, whichever is more.
//!
//! A copy that slid further than the host's body has lost more to friction: that much more energy the host may have.
//! The copies follow a passive motion, and an implicit step never raises the energy of convex springs. So neither host nor
//! copy ever has more energy than at the start (docs/theory.md, 9).

use crate::contact_set::{Spring, springs_at};
use crate::copies::Copy;
use crate::error::SlowError;
use crate::implicit::Step;
use crate::island::Island;
use crate::system::System;
use nalgebra::Vector6;
use pong_engine::World;
use pong_geometry::Pose;

/// Halvings of the interval between the implicit step and the wanted velocity.
const HALVINGS: usize = 40;
/// Rounding of an energy, relative to its largest terms.
const ROUNDING: f64 = 1e-13;

/// Guard of one island in one frame.
pub(crate) struct Guard<'g> {
    pub system: &'g System<'g>,
    pub island: &'g Island,
    pub copies: &'g [Copy],
    /// Energy of the contacts of the copies at the end of the substeps, and of the host's bodies at the start, J.
    pub stored: [f64; 2],
    /// Length of the frame, s.
    pub length: f64,
    /// Landing poses of all bodies.
    pub poses: Vec<Pose>,
    pub evaluations: u32,
}

/// Result of a guard.
pub(crate) struct Guarded {
    /// Impulses; those of bodies outside the island are as they were wanted.
    pub impulses: Vec<Vector6<f64>>,
    /// True if the wanted impulses had too much energy.
    pub limited: bool,
    /// True if no body of the island touches anything where it lands.
    pub open: bool,
    /// Energy where the host's bodies land, J.
    pub host: f64,
    /// Energy at the end of the copies, J.
    pub copy: f64,
    /// Work of friction that the copies have lost and the host's bodies have not, J.
    pub unspent: f64,
}

/// Energy with the size of its terms, J.
#[derive(Clone, Copy)]
struct Energy {
    total: f64,
    size: f64,
    /// Work that the mean friction of the copies takes from the host's bodies in the frame, J; not negative.
    rubbed: f64,
    /// True if nothing of the island touches.
    open: bool,
}

impl Energy {
    fn is_within(self, bound: f64) -> bool {
        self.total <= bound + ROUNDING * self.size
    }
}

/// Energies up to which a landing is allowed, J.
struct Bound {
    /// Without regard to friction.
    plain: f64,
    /// With the work of friction in the frame.
    with_friction: f64,
}

impl Bound {
    fn allows(&self, energy: Energy) -> bool {
        let spent = Energy { total: energy.total + energy.rubbed, ..energy };
        energy.is_within(self.plain) || spent.is_within(self.with_friction)
    }
}

impl Guard<'_> {
    /// The wanted impulses, or the nearest on the way from them to an implicit step that have an allowed energy.
    pub fn limit(&mut self, world: &mut World, wanted: Vec<Vector6<f64>>) -> Result<Guarded, SlowError> {
        let copy = self.copy_energy();
        let taken: f64 = self.island.bodies.iter().map(|&body| self.copies[body].rubbed).sum();
        let mut bound = Bound { plain: copy, with_friction: copy + taken.max(0.0) };
        let energy = self.landing(world, &wanted)?;
        let guarded = |impulses, energy: Energy, limited| {
            let unspent = (taken - energy.rubbed).max(0.0);
            Guarded { impulses, limited, open: energy.open, host: energy.total, copy, unspent }
        };
        if bound.allows(energy) {
            return Ok(guarded(wanted, energy, false));
        }
        let (safe, safe_energy) = self.safe(world, &wanted, copy.max(self.start_energy()))?;
        bound.plain = copy.max(safe_energy);
        if bound.allows(energy) {
            return Ok(guarded(wanted, energy, false));
        }
        let between = |share: f64| -> Vec<Vector6<f64>> {
            safe.iter().zip(&wanted).map(|(safe, wanted)| safe + (wanted - safe) * share).collect()
        };
        let (mut inside, mut outside) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inside + outside);
            if bound.allows(self.landing(world, &between(middle))?) {
                inside = middle;
            } else {
                outside = middle;
            }
        }
        let impulses = between(inside);
        let energy = self.landing(world, &impulses)?;
        Ok(guarded(impulses, energy, true))
    }

    /// An implicit step with the friction of the copies held or, if that exceeds the bound, without friction.
    fn safe(
        &mut self,
        world: &mut World,
        guess: &[Vector6<f64>],
        bound: f64,
    ) -> Result<(Vec<Vector6<f64>>, f64), SlowError> {
        let friction: Vec<Vector6<f64>> = self.copies.iter().map(|copy| copy.friction).collect();
        let rubs = self.island.bodies.iter().any(|&body| friction[body].amax() > 0.0);
        if rubs {
            let impulses = self.implicit(world, &friction, guess)?;
            let energy = self.landing(world, &impulses)?;
            if energy.is_within(bound) {
                return Ok((impulses, energy.total));
            }
        }
        let none = vec![Vector6::zeros(); guess.len()];
        let impulses = self.implicit(world, &none, guess)?;
        let energy = self.landing(world, &impulses)?;
        Ok((impulses, energy.total))
    }

    fn implicit(
        &mut self,
        world: &mut World,
        held: &[Vector6<f64>],
        guess: &[Vector6<f64>],
    ) -> Result<Vec<Vector6<f64>>, SlowError> {
        let (system, island, length) = (self.system, self.island, self.length);
        let mut step = Step { system, island, length, held, poses: self.poses.clone(), evaluations: 0 };
        let impulses = step.solve(world, guess)?;
        self.evaluations += step.evaluations;
        Ok(impulses)
    }

    /// Energy where the bodies land with these impulses.
    fn landing(&mut self, world: &mut World, impulses: &[Vector6<f64>]) -> Result<Energy, SlowError> {
        let velocities = self.system.velocities_after(impulses, self.length);
        let by: Vec<_> = velocities.iter().map(|velocity| velocity * self.length).collect();
        let mut rubbed = 0.0;
        for &body in &self.island.bodies {
            let one = &self.system.bodies[body];
            self.poses[body] = one.moved(&one.leading, &by[body]);
            rubbed -= self.copies[body].friction.dot(&velocities[body]);
        }
        let (total, size) = self.motion_energy(&velocities, Some(&by));
        self.evaluations += 1;
        let springs = springs_at(world, &self.system.bodies, &self.poses)?;
        let stored = stored(self.island, &springs);
        let open = !springs.iter().any(|spring| self.island.touches(&spring.normal));
        Ok(Energy { total: total + stored, size: size + stored, rubbed: rubbed.max(0.0), open })
    }

    fn copy_energy(&self) -> f64 {
        let velocities: Vec<_> = self.copies.iter().map(|copy| copy.velocity).collect();
        let displacements: Vec<_> = self.copies.iter().map(|copy| copy.displacement).collect();
        self.motion_energy(&velocities, Some(&displacements)).0 + self.stored[0]
    }

    fn start_energy(&self) -> f64 {
        let velocities: Vec<_> = self.system.bodies.iter().map(|body| body.velocity).collect();
        self.motion_energy(&velocities, None).0 + self.stored[1]
    }

    /// Energy of motion of the island, and of the forces without contact after displacements, with the size of its terms,
    /// J.
    fn motion_energy(&self, velocities: &[Vector6<f64>], by: Option<&[Vector6<f64>]>) -> (f64, f64) {
        let (mut total, mut size) = (0.0, 0.0);
        for &(assembly, _) in &self.island.assemblies {
            let kinetic = self.system.kinetic(assembly, velocities);
            let potential = by.map_or(0.0, |by| self.system.potential(assembly, by));
            total += kinetic + potential;
            size += kinetic + potential.abs();
        }
        (total, size)
    }
}

/// Energy of the springs that act on bodies of an island, J.
pub(crate) fn stored(island: &Island, springs: &[Spring]) -> f64 {
    springs.iter().filter(|spring| island.touches(&spring.normal)).map(|spring| spring.energy).sum()
}
