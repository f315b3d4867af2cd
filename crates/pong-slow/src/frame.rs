//! One frame: from the states that the host has to the wrenches that it holds.

use crate::body::Body;
use crate::chart;
use crate::contact_set::{place, springs_at};
use crate::copies::{Copy, Division, Ends, Outcome, follow};
use crate::error::SlowError;
use crate::guard::{Guard, stored};
use crate::implicit::Step;
use crate::input::{Coupling, GroupInput, in_order, require_frame};
use crate::island::{Island, islands};
use crate::memory::{KeptBody, Memory};
use crate::prediction::inserted;
use crate::projection::project;
use crate::queue::{carry_forward, under_way};
use crate::report::{FrameStatus, Report};
use crate::settings::Settings;
use crate::system::System;
use nalgebra::Vector6;
use pong_engine::World;
use pong_geometry::{Pose, Wrench};
use std::collections::VecDeque;

/// Substeps of a frame in which nothing is known to touch.
const SUBSTEPS_LEAST: u32 = 8;
/// Repetitions of the substeps with a shorter step.
const REPEATS_MAX: u32 = 8;
/// Margin of the rate for which substeps are made, so that a rate that grows slowly does not repeat them.
const RATE_MARGIN: f64 = 1.1;

/// Result of a frame.
pub(crate) struct Computed {
    pub memory: Memory,
    pub report: Report,
    /// Wrench on each movable group about its origin along common axes.
    pub wrenches: Vec<Wrench>,
}

/// A frame in work.
struct Frame<'f> {
    settings: &'f Settings,
    memory: &'f Memory,
    /// Contact state at the start of the frame.
    block: &'f [u8],
    length: f64,
    system: System<'f>,
    /// Poses and velocities as the host gave them.
    given: Vec<(Pose, Vector6<f64>)>,
    queues: Vec<VecDeque<Vector6<f64>>>,
    report: Report,
}

/// Computes a frame. The world has the committed contact state `block`; afterwards it has that of the end of the copies.
pub(crate) fn compute(
    world: &mut World,
    settings: &Settings,
    (memory, block): (&Memory, &[u8]),
    length: f64,
    (inputs, couplings): (&[GroupInput], &[Coupling]),
) -> Result<Computed, SlowError> {
    require_frame(length)?;
    let inputs = in_order(world, inputs)?;
    // Refuses states that are not finite and quaternions that are not of unit length.
    inputs.iter().try_for_each(|input| world.set_state(input.interface, &input.state))?;
    let mut frame = Frame::new(world, settings, (memory, block), length, (&inputs, couplings))?;
    frame.report.groups = inserted(world, memory, &frame.system)?;
    frame.report.inserted = frame.report.groups.iter().map(|group| group.inserted).sum();
    frame.measure_theta();
    let ends = frame.follow(world)?;
    frame.finish(world, ends)
}

impl<'f> Frame<'f> {
    fn new(
        world: &World,
        settings: &'f Settings,
        (memory, block): (&'f Memory, &'f [u8]),
        length: f64,
        (inputs, couplings): (&[&GroupInput], &'f [Coupling]),
    ) -> Result<Self, SlowError> {
        let (mut bodies, mut given, mut queues) = (Vec::new(), Vec::new(), Vec::new());
        for (index, input) in inputs.iter().enumerate() {
            let body = Body::of(input, world.inspect().group_name(index))?;
            given.push((body.pose, body.velocity));
            queues.push(under_way(memory, index, &body, settings.delay_frames));
            bodies.push(body);
        }
        let mut system = System::new(bodies, couplings)?;
        carry_forward(&mut system, &queues, settings.theta, length)?;
        system.bodies.iter_mut().for_each(|body| body.lead(settings.theta, length));
        Ok(Self { settings, memory, block, length, system, given, queues, report: Report::default() })
    }

    /// Measures θ from the motion since the last frame, at the body whose velocity changed most.
    fn measure_theta(&mut self) {
        const LEAST: f64 = 1e-11;
        let mut best = 0.0;
        for (index, body) in self.system.bodies.iter().enumerate() {
            let Some(kept) = self.memory.of(index, body.axes).filter(|_| body.axes == chart::Axes::Common)
            else {
                continue;
            };
            let (pose, velocity) = &self.given[index];
            let length = self.memory.length;
            let gained = chart::linear(&(velocity - kept.given_velocity));
            let by = pose.position - kept.given.position - chart::linear(&kept.given_velocity) * length;
            let change = length * gained.norm();
            let size = pose.position.norm() + length * chart::linear(velocity).norm();
            if change > best && change > LEAST * size && self.system.moves(index) {
                best = change;
                self.report.theta_measured = Some(by.dot(&gained) / (length * gained.norm_squared()));
            }
        }
        let off = self.report.theta_measured.map_or(0.0, |theta| (theta - self.settings.theta).abs());
        self.report.status.theta_mismatch = off > 0.1;
    }

    fn copies(&self) -> Vec<Copy> {
        let kept = |(index, body): (usize, &Body)| self.memory.of(index, body.axes);
        let kept: Vec<_> = self.system.bodies.iter().enumerate().map(kept).collect();
        let held_back: Vec<_> =
            kept.iter().map(|kept| kept.map_or_else(Vector6::zeros, |kept| kept.held_back)).collect();
        let gains = self.system.gains(&held_back);
        let start = |(index, body): (usize, &Body)| {
            let offset = kept[index].map_or_else(Pose::identity, |kept| kept.offset);
            let pose = chart::at_offset(body.axes, &body.leading, &offset);
            Copy {
                displacement: chart::displacement(body.axes, &body.leading, &pose),
                pose,
                velocity: body.velocity + gains[index],
                impulse: held_back[index],
                friction: Vector6::zeros(),
                rubbed: kept[index].map_or(0.0, |kept| kept.unspent),
            }
        };
        self.system.bodies.iter().enumerate().map(start).collect()
    }

    /// Follows the copies with as many substeps as their contacts need.
    fn follow(&mut self, world: &mut World) -> Result<Ends, SlowError> {
        let mut rate_square = self.memory.rate_square;
        for repeat in 0.. {
            let wanted = self.substeps(rate_square);
            let substeps = wanted.min(self.settings.substeps_max);
            let last = wanted >= self.settings.substeps_max || repeat >= REPEATS_MAX;
            let rate_square_max = if last { f64::INFINITY } else { rate_square * RATE_MARGIN };
            if repeat > 0 {
                world.restore_state(self.block)?;
            }
            let division = Division { length: self.length, substeps, rate_square_max };
            let outcome = follow(world, &self.system, self.copies(), division)?;
            self.report.evaluations += substeps + 1;
            match outcome {
                Outcome::TooCoarse(rate) => rate_square = rate,
                Outcome::Ends(ends) => {
                    self.report.substeps = substeps;
                    self.report.contacts = ends.touches.len() as u32;
                    self.report.rate = ends.rate_square.sqrt();
                    self.report.substeps_wanted = self.substeps(ends.rate_square).max(substeps);
                    let status = &mut self.report.status;
                    status.substep_limit = self.report.substeps_wanted > self.settings.substeps_max;
                    status.unresolved = self.length * self.report.rate > f64::from(substeps);
                    status.met_another = ends.met_another;
                    status.engine = ends.flags;
                    return Ok(ends);
                }
            }
        }
        unreachable!("the last repetition accepts every rate")
    }

    fn substeps(&self, rate_square: f64) -> u32 {
        let wanted = (self.settings.substeps_per_radian * self.length * rate_square.sqrt()).ceil();
        (wanted.min(f64::from(u32::MAX)) as u32).max(SUBSTEPS_LEAST)
    }

    /// Impulses, what is kept, and the wrenches.
    fn finish(mut self, world: &mut World, ends: Ends) -> Result<Computed, SlowError> {
        let mut impulses = vec![Vector6::zeros(); self.system.bodies.len()];
        // What is kept of each copy: nothing, or its offset with this work of friction, J.
        let mut keeps = vec![Some(0.0); self.system.bodies.len()];
        if self.report.status.unresolved {
            world.restore_state(self.block)?;
            self.implicit(world, &ends, &mut impulses)?;
            keeps.fill(None);
        } else {
            self.near_copies(world, &ends, &mut impulses, &mut keeps)?;
        }
        let memory = self.remember(&ends, &impulses, &keeps);
        let wrench = |(body, impulse): (&Body, &Vector6<f64>)| body.wrench_of(impulse, self.length);
        let wrenches = self.system.bodies.iter().zip(&impulses).map(wrench).collect();
        Ok(Computed { memory, report: self.report, wrenches })
    }

    /// Islands of what touches within the frame, or would touch where the bodies land with these impulses.
    fn islands(
        &mut self,
        world: &mut World,
        ends: &Ends,
        impulses: &[Vector6<f64>],
    ) -> Result<Vec<Island>, SlowError> {
        let mut touched = ends.touched.clone();
        let landing = self.system.landing(impulses, self.length);
        self.report.evaluations += 1;
        let springs = springs_at(world, &self.system.bodies, &landing)?;
        touched.extend(springs.iter().map(|spring| (spring.normal.a, spring.normal.b)));
        Ok(islands(&self.system, &touched))
    }

    /// Impulses that lead nearest to the copies, within the energy that is allowed.
    fn near_copies(
        &mut self,
        world: &mut World,
        ends: &Ends,
        impulses: &mut [Vector6<f64>],
        keeps: &mut [Option<f64>],
    ) -> Result<(), SlowError> {
        let reached: Vec<_> = ends.copies.iter().map(|copy| copy.impulse).collect();
        impulses.copy_from_slice(&reached);
        for island in islands(&self.system, &ends.touched) {
            let nearest = project(&self.system, &island, &ends.touches, &reached, self.length);
            island.bodies.iter().for_each(|&body| impulses[body] = nearest[body]);
        }
        let islands = self.islands(world, ends, impulses)?;
        let at_end: Vec<Pose> = ends.copies.iter().map(|copy| copy.pose).collect();
        let at_start: Vec<Pose> = self.system.bodies.iter().map(|body| body.leading).collect();
        let bodies = &self.system.bodies;
        let (end, start) = (springs_at(world, bodies, &at_end)?, springs_at(world, bodies, &at_start)?);
        self.report.evaluations += 2;
        for island in &islands {
            let mut guard = Guard {
                system: &self.system,
                island,
                copies: &ends.copies,
                stored: [stored(island, &end), stored(island, &start)],
                length: self.length,
                poses: self.system.landing(impulses, self.length),
                evaluations: 0,
            };
            let guarded = guard.limit(world, impulses.to_vec())?;
            self.report.evaluations += guard.evaluations;
            self.report.status.energy_limited |= guarded.limited;
            let copy_open = !end.iter().any(|spring| island.touches(&spring.normal));
            let dropped =
                copy_open && guarded.open && guarded.host <= guarded.copy + 1e-13 * guarded.copy.abs();
            for &body in &island.bodies {
                impulses[body] = guarded.impulses[body];
                keeps[body] = (!dropped).then_some(guarded.unspent / island.bodies.len() as f64);
            }
        }
        Ok(())
    }

    /// Impulses of one implicit step; the contact state follows to where the bodies land.
    fn implicit(
        &mut self,
        world: &mut World,
        ends: &Ends,
        impulses: &mut [Vector6<f64>],
    ) -> Result<(), SlowError> {
        for island in self.islands(world, ends, impulses)? {
            let held = vec![Vector6::zeros(); impulses.len()];
            let (system, length) = (&self.system, self.length);
            let poses = system.landing(impulses, length);
            let mut step = Step { system, island: &island, length, held: &held, poses, evaluations: 0 };
            let found = step.solve(world, &held)?;
            self.report.evaluations += step.evaluations;
            island.bodies.iter().for_each(|&body| impulses[body] = found[body]);
        }
        let landing = self.system.landing(impulses, self.length);
        let velocities = self.system.velocities_after(impulses, self.length);
        place(world, &self.system.bodies, |index| (landing[index], velocities[index]))?;
        world.step()?;
        Ok(())
    }

    fn remember(&self, ends: &Ends, impulses: &[Vector6<f64>], keeps: &[Option<f64>]) -> Memory {
        let landing = self.system.landing(impulses, self.length);
        let velocities = self.system.velocities_after(impulses, self.length);
        let keep = |(index, body): (usize, &Body)| {
            let copy = &ends.copies[index];
            let unspent = keeps[index].filter(|_| self.system.moves(index));
            let is_kept = unspent.is_some();
            let mut queue = self.queues[index].clone();
            queue.push_back(impulses[index]);
            queue.truncate(self.settings.delay_frames as usize + 1);
            queue.pop_front();
            KeptBody {
                axes: body.axes,
                offset: if is_kept {
                    chart::offset(body.axes, &landing[index], &copy.pose)
                } else {
                    Pose::identity()
                },
                held_back: if is_kept { copy.impulse - impulses[index] } else { Vector6::zeros() },
                unspent: unspent.unwrap_or(0.0),
                predicted: landing[index],
                predicted_velocity: velocities[index],
                given: self.given[index].0,
                given_velocity: self.given[index].1,
                queue,
            }
        };
        let bodies = self.system.bodies.iter().enumerate().map(keep).collect();
        Memory { length: self.length, rate_square: ends.rate_square, bodies }
    }
}

/// Status of a frame that was evaluated without dynamics.
pub(crate) fn plain_status(flags: pong_engine::StatusBits) -> FrameStatus {
    FrameStatus { engine: flags, ..FrameStatus::default() }
}
