//! One implicit Euler step from the host's state with the normal forces of its end: the least ½·|z|² + Φ over landing
//! poses, Φ the energy of the normal springs. Such a step never raises the energy where Φ is convex.

use crate::contact_set::{Spring, springs_at};
use crate::error::SlowError;
use crate::island::Island;
use crate::system::System;
use nalgebra::{DMatrix, DVector, Vector6};
use pong_engine::World;
use pong_geometry::Pose;

/// Newton steps, and halvings of each.
const NEWTON_MAX: usize = 40;
const HALVINGS_MAX: usize = 30;
/// Residual at which the iteration ends, relative to the largest terms.
const RESIDUAL: f64 = 1e-13;

/// Task of a step for one island.
pub(crate) struct Step<'s> {
    pub system: &'s System<'s>,
    pub island: &'s Island,
    /// Length of the frame, s.
    pub length: f64,
    /// Impulses that act besides the normal forces.
    pub held: &'s [Vector6<f64>],
    /// Landing poses of all bodies; those of the island are overwritten.
    pub poses: Vec<Pose>,
    pub evaluations: u32,
}

impl Step<'_> {
    /// Impulses of the step, from a first guess of them.
    pub fn solve(
        &mut self,
        world: &mut World,
        guess: &[Vector6<f64>],
    ) -> Result<Vec<Vector6<f64>>, SlowError> {
        let pushes: Vec<_> = guess.iter().zip(self.held).map(|(guess, held)| guess - held).collect();
        let of_island = self.island.bodies.iter().map(|&body| (body, &pushes[body]));
        let mut z = self.island.coordinates(self.system, of_island);
        let mut springs = self.springs(world, &z)?;
        let mut value = 0.5 * z.norm_squared() + energy(&springs);
        for _ in 0..NEWTON_MAX {
            let (gradient, stiffness, size) = self.gradient(&z, &springs);
            if gradient.norm() <= RESIDUAL * size {
                break;
            }
            let down = Island::solve(stiffness, &-&gradient);
            let slope = gradient.dot(&down);
            let mut share = 1.0;
            let mut moved = false;
            for _ in 0..HALVINGS_MAX {
                let trial = &z + &down * share;
                let found = self.springs(world, &trial)?;
                let there = 0.5 * trial.norm_squared() + energy(&found);
                if there <= value + 1e-4 * share * slope {
                    (z, springs, value, moved) = (trial, found, there, true);
                    break;
                }
                share *= 0.5;
            }
            // No step lowers the value by more than rounding.
            if !moved {
                break;
            }
        }
        Ok(self.impulses(&springs))
    }

    fn springs(&mut self, world: &mut World, z: &DVector<f64>) -> Result<Vec<Spring>, SlowError> {
        let mut velocities = self.system.velocities_after(self.held, self.length);
        self.island.add_velocities(self.system, z, &mut velocities);
        for &body in &self.island.bodies {
            let one = &self.system.bodies[body];
            self.poses[body] = one.moved(&one.leading, &(velocities[body] * self.length));
        }
        self.evaluations += 1;
        let springs = springs_at(world, &self.system.bodies, &self.poses)?;
        Ok(springs.into_iter().filter(|spring| self.island.touches(&spring.normal)).collect())
    }

    /// Gradient and stiffness in z, and the size of the terms of the gradient.
    fn gradient(&self, z: &DVector<f64>, springs: &[Spring]) -> (DVector<f64>, DMatrix<f64>, f64) {
        let mut gradient = z.clone();
        let mut size = z.norm();
        let mut stiffness = DMatrix::zeros(z.len(), z.len());
        for spring in springs {
            let row = self.island.row(self.system, &spring.normal);
            gradient.axpy(-self.length * spring.force, &row, 1.0);
            size += self.length * spring.force * row.norm();
            stiffness.ger(self.length * self.length * spring.stiffness, &row, &row, 1.0);
        }
        (gradient, stiffness, size)
    }

    fn impulses(&self, springs: &[Spring]) -> Vec<Vector6<f64>> {
        let mut impulses = self.held.to_vec();
        for spring in springs {
            for (body, on) in [(spring.normal.a, &spring.normal.on_a), (spring.normal.b, &spring.normal.on_b)]
            {
                if self.island.has(body) {
                    impulses[body] += on * (self.length * spring.force);
                }
            }
        }
        impulses
    }
}

fn energy(springs: &[Spring]) -> f64 {
    springs.iter().map(|spring| spring.energy).sum()
}
