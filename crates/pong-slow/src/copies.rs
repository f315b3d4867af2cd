//! Substeps on copies of the bodies: velocity Verlet, one evaluation and one commit a substep.

use crate::body::Body;
use crate::chart;
use crate::contact_set::{Row, axes_of, groups, place};
use crate::error::SlowError;
use crate::system::System;
use nalgebra::Vector6;
use pong_engine::{StatusBits, World};
use pong_geometry::{Pose, Vec3};

/// Stiffness of friction that sticks, as a share of the normal stiffness: the default of the engine. It weighs
/// distances and sets the substep, and is no force.
const STICKING_SHARE: f64 = 2.0 / 3.0;

/// Iterations for the largest eigenvalue of the contacts, and what the result is multiplied by.
const ITERATIONS: usize = 40;
const MARGIN: f64 = 1.05;

/// A copy of a body.
#[derive(Clone, Debug)]
pub(crate) struct Copy {
    pub pose: Pose,
    /// Displacement from the leading pose of the host's body.
    pub displacement: Vector6<f64>,
    pub velocity: Vector6<f64>,
    /// Impulse of the contacts since the host had the velocity of the start of the frame: what was held back in earlier
    /// frames, and that of this frame. Of a body that contact does not move: that of this frame.
    pub impulse: Vector6<f64>,
    /// Impulse of friction in this frame.
    pub friction: Vector6<f64>,
    /// Work that friction has taken from the copies since the offset began, J: the share of this body.
    pub rubbed: f64,
}

/// A point at which two copies touch at the end of the substeps, in the frames of both.
#[derive(Clone, Debug)]
pub(crate) struct Touch {
    pub bodies: (usize, usize),
    /// Contact point in the frames that move of A and of B.
    pub points: [Vec3; 2],
    /// Normal in the frame of B.
    pub normal: Vec3,
    /// Acting stiffness along the normal, and across it (0 if it slips), N/m.
    pub stiffness: [f64; 2],
}

/// End of the substeps.
#[derive(Debug)]
pub(crate) struct Ends {
    pub copies: Vec<Copy>,
    pub touches: Vec<Touch>,
    /// Pairs of bodies that touched at some substep, in order.
    pub touched: Vec<(usize, usize)>,
    /// A body left one partner and touched another.
    pub met_another: bool,
    /// Squared largest rate of the contacts, 1/s².
    pub rate_square: f64,
    pub flags: StatusBits,
}

/// Outcome of the substeps.
pub(crate) enum Outcome {
    Ends(Ends),
    /// Contacts have this squared rate (1/s²), too large for the substeps.
    TooCoarse(f64),
}

/// Length and number of substeps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Division {
    /// Length of the frame, s.
    pub length: f64,
    pub substeps: u32,
    /// Largest squared rate (1/s²) that the substeps are made for.
    pub rate_square_max: f64,
}

/// Follows the copies through the frame.
pub(crate) fn follow(
    world: &mut World,
    system: &System,
    mut copies: Vec<Copy>,
    division: Division,
) -> Result<Outcome, SlowError> {
    let bodies = &system.bodies[..];
    let step = division.length / f64::from(division.substeps);
    let start: Vec<Vector6<f64>> = copies.iter().map(|copy| copy.velocity).collect();
    // Impulses of the contacts in this frame, and those with half a substep more.
    let mut impulses = vec![Vector6::zeros(); bodies.len()];
    let mut ahead = impulses.clone();
    let held: Vec<Vector6<f64>> = copies.iter().map(|copy| copy.impulse).collect();
    let mut seen = Seen::default();
    place(world, bodies, |index| (copies[index].pose, copies[index].velocity))?;
    seen.flags = seen.flags.union(world.step()?.status);
    if let Some(rate) = seen.look(world, system, &copies)
        && rate > division.rate_square_max
    {
        return Ok(Outcome::TooCoarse(rate));
    }
    let mut forces = forces(world, bodies, &copies)?;
    for substep in 1..=division.substeps {
        let time = step * f64::from(substep);
        let half_substep = 0.5 * step;
        for index in 0..bodies.len() {
            impulses[index] += forces[index] * half_substep;
            ahead[index] = impulses[index] + forces[index] * half_substep;
        }
        let gained = [system.gains(&impulses), system.gains(&ahead)];
        for (index, body) in bodies.iter().enumerate() {
            let copy = &mut copies[index];
            let by = velocity(body, &start[index], &gained[0][index], time - half_substep) * step;
            copy.pose = body.moved(&copy.pose, &by);
            copy.displacement += by;
            // Velocity of the end with the force of the start: damping and friction are evaluated with it.
            copy.velocity = velocity(body, &start[index], &gained[1][index], time);
        }
        place(world, bodies, |index| (copies[index].pose, copies[index].velocity))?;
        seen.flags = seen.flags.union(world.step()?.status);
        if let Some(rate) = seen.look(world, system, &copies)
            && rate > division.rate_square_max
        {
            return Ok(Outcome::TooCoarse(rate));
        }
        forces = self::forces(world, bodies, &copies)?;
        impulses.iter_mut().zip(&forces).for_each(|(impulse, force)| *impulse += force * half_substep);
        let gained = system.gains(&impulses);
        for (index, body) in bodies.iter().enumerate() {
            copies[index].velocity = velocity(body, &start[index], &gained[index], time);
        }
        add_friction(world, system, &mut copies, step);
    }
    for (index, copy) in copies.iter_mut().enumerate() {
        copy.impulse = held[index] + impulses[index];
    }
    let touches = touches(world, &copies);
    let Seen { touched, met_another, rate_square, flags, .. } = seen;
    Ok(Outcome::Ends(Ends { copies, touches, touched, met_another, rate_square, flags }))
}

fn velocity(body: &Body, start: &Vector6<f64>, gained: &Vector6<f64>, time: f64) -> Vector6<f64> {
    start + body.acceleration * time + gained
}

fn forces(world: &World, bodies: &[Body], copies: &[Copy]) -> Result<Vec<Vector6<f64>>, SlowError> {
    let of =
        |(body, copy): (&Body, &Copy)| Ok(body.wrench_in_chart(&copy.pose, &world.wrench(body.interface)?));
    bodies.iter().zip(copies).map(of).collect()
}

fn add_friction(world: &World, system: &System, copies: &mut [Copy], step: f64) {
    for contact in world.contacts_iter() {
        let (a, b) = groups(&contact);
        let push = contact.friction_force * step;
        let taken = -push.dot(&contact.slip_velocity);
        let share = if system.moves(a) && system.moves(b) { 0.5 } else { 1.0 };
        for (body, push) in [(a, push), (b, -push)] {
            let impulse =
                chart::of_force_at(system.bodies[body].axes, &copies[body].pose, &contact.point, &push);
            copies[body].friction += impulse;
            copies[body].rubbed += share * taken;
        }
    }
}

/// Contacts that the copies have at the end of the substeps.
fn touches(world: &World, copies: &[Copy]) -> Vec<Touch> {
    let listed = world.contacts_iter().zip(world.normal_tangents());
    let touch = |(contact, tangent): (pong_engine::Contact, Option<pong_engine::NormalTangent>)| {
        let bodies = groups(&contact);
        let secant = contact.normal_force / contact.depth.max(f64::MIN_POSITIVE);
        let stiffness = tangent.map_or(secant, |tangent| tangent.stiffness);
        let into = |body: usize| {
            let pose = &copies[body].pose;
            pose.orientation.inverse() * (contact.point - pose.position)
        };
        let holds = contact.sticks && contact.friction_force != Vec3::zeros();
        Touch {
            bodies,
            points: [into(bodies.0), into(bodies.1)],
            normal: copies[bodies.1].pose.orientation.inverse() * contact.normal,
            stiffness: [stiffness, if holds { STICKING_SHARE * stiffness } else { 0.0 }],
        }
    };
    listed.map(touch).filter(|touch| touch.stiffness[0] > 0.0).collect()
}

/// Contacts seen in the substeps so far.
#[derive(Default)]
struct Seen {
    touched: Vec<(usize, usize)>,
    touching: Vec<(usize, usize)>,
    ended: Vec<(usize, usize)>,
    met_another: bool,
    /// Sum of the stiffnesses at which the rate was computed last, N/m.
    assessed: f64,
    rate_square: f64,
    flags: StatusBits,
}

impl Seen {
    /// Looks at the contacts of the frame; returns the squared rate if it was computed again.
    fn look(&mut self, world: &World, system: &System, copies: &[Copy]) -> Option<f64> {
        let mut now: Vec<(usize, usize)> = Vec::new();
        let mut total = 0.0;
        for (contact, tangent) in world.contacts_iter().zip(world.normal_tangents()) {
            let (a, b) = groups(&contact);
            let pair = (a.min(b), a.max(b));
            if now.last() != Some(&pair) {
                now.push(pair);
            }
            total += tangent.map_or(0.0, |tangent| tangent.stiffness);
        }
        now.sort_unstable();
        now.dedup();
        if now != self.touching {
            self.change_partners(now, system);
        }
        if total <= 1.02 * self.assessed {
            return None;
        }
        self.assessed = total;
        let rate = rate_square(world, system, copies);
        self.rate_square = self.rate_square.max(rate);
        Some(rate)
    }

    fn change_partners(&mut self, now: Vec<(usize, usize)>, system: &System) {
        self.ended.extend(self.touching.iter().filter(|pair| !now.contains(pair)));
        let shares = |one: &(usize, usize), other: &(usize, usize)| {
            let within = |body: usize| system.moves(body) && (body == other.0 || body == other.1);
            one != other && (within(one.0) || within(one.1))
        };
        for pair in &now {
            let begins = !self.touching.contains(pair);
            self.met_another |= begins && self.ended.iter().any(|ended| shares(pair, ended));
            if let Err(place) = self.touched.binary_search(pair) {
                self.touched.insert(place, *pair);
            }
        }
        self.touching = now;
    }
}

/// Squared rate of the fastest vibration of the bodies on the contacts of the frame, 1/s², or of the fastest decay by
/// damping if that is faster.
fn rate_square(world: &World, system: &System, copies: &[Copy]) -> f64 {
    let poses: Vec<Pose> = copies.iter().map(|copy| copy.pose).collect();
    let mut rows: Vec<(Row, f64)> = Vec::new();
    let mut damping_time: f64 = 0.0;
    for (contact, tangent) in world.contacts_iter().zip(world.normal_tangents()) {
        let secant = contact.normal_force / contact.depth.max(f64::MIN_POSITIVE);
        let (k, c) = tangent.map_or((secant, 0.0), |tangent| (tangent.stiffness, tangent.damping));
        if k <= 0.0 {
            continue;
        }
        damping_time = damping_time.max(c / k);
        let across = if contact.friction_force == Vec3::zeros() { 0.0 } else { STICKING_SHARE * k };
        for (direction, k) in axes_of(&contact.normal).iter().zip([k, across, across]) {
            if k > 0.0 {
                rows.push((
                    Row::new(&system.bodies, &poses, groups(&contact), [&contact.point; 2], direction),
                    k,
                ));
            }
        }
    }
    let fastest = MARGIN * largest_eigenvalue(system, &rows);
    let decay = 0.5 * damping_time * fastest;
    fastest.max(decay * decay)
}

/// A spring in coordinates z in which all masses are one.
struct Spring {
    /// Stretch per coordinate of an assembly: the place of its first coordinate, and one number for each.
    on: Vec<(usize, Vec<f64>)>,
    /// Stiffness, N/m.
    stiffness: f64,
}

impl Spring {
    fn of(system: &System, starts: &[usize], row: &Row, stiffness: f64) -> Self {
        let mut on: Vec<(usize, Vec<f64>)> = Vec::new();
        for (body, impulse) in [(row.a, &row.on_a), (row.b, &row.on_b)] {
            let Some(home) = system.home(body) else { continue };
            let start = starts[home];
            let place = on.iter().position(|part| part.0 == start).unwrap_or_else(|| {
                on.push((start, vec![0.0; system.assemblies[home].rank()]));
                on.len() - 1
            });
            system.add_coordinates_of_impulse(&mut on[place].1, body, impulse);
        }
        Self { on, stiffness }
    }
}

/// Largest eigenvalue of Bᵀ·K·B by power iteration.
fn largest_eigenvalue(system: &System, rows: &[(Row, f64)]) -> f64 {
    let (starts, size) = system.starts();
    let springs: Vec<Spring> =
        rows.iter().map(|(row, stiffness)| Spring::of(system, &starts, row, *stiffness)).collect();
    // Unlike numbers, so that no mode is missed by symmetry.
    let mut z: Vec<f64> = (0..size).map(|i| 1.0 + 0.37 * ((7 * (i / 6) + 3 * (i % 6)) % 5) as f64).collect();
    let norm_of = |z: &[f64]| z.iter().map(|x| x * x).sum::<f64>().sqrt();
    let mut eigenvalue = 0.0;
    for _ in 0..ITERATIONS {
        let norm = norm_of(&z);
        if norm == 0.0 {
            return 0.0;
        }
        let mut next = vec![0.0; size];
        for Spring { on, stiffness } in &springs {
            let stretch: f64 = parts(on).map(|(place, x)| x * z[place]).sum();
            parts(on).for_each(|(place, x)| next[place] += x * stretch * (stiffness / norm));
        }
        eigenvalue = norm_of(&next);
        z = next;
    }
    eigenvalue
}

/// Coordinates of a spring: places and numbers.
fn parts(on: &[(usize, Vec<f64>)]) -> impl Iterator<Item = (usize, f64)> {
    on.iter().flat_map(|(start, numbers)| numbers.iter().enumerate().map(move |(i, x)| (start + i, *x)))
}
