//! Load sharing of a body whose two ends yield, each with half a spring (docs/theory.md, 2.8): the displacements u₀, u₁
//! of the ends of its axis with the least |u₀|² + |u₁|² that clear all places of contact,
//!
//! ```text
//! n_i·((1 − s_i)·u₀ + s_i·u₁) ≥ δ_i,      u₀ = Σ λ_i·(1 − s_i)·n_i,      u₁ = Σ λ_i·s_i·n_i,      λ ≥ 0.
//! ```
//!
//! This is a strictly convex quadratic program in six numbers, with the vectors a_i = ((1 − s_i)·n_i, s_i·n_i). The dual
//! active-set method solves it: the most violated place enters, and places whose λ would become negative leave (D.
//! Goldfarb, A. Idnani, *A numerically stable dual method for solving strictly convex quadratic programs*, Mathematical
//! Programming 27, 1983). The a_i of the places that carry load are kept as Q·R, so that normals of a plate that is flat
//! to single precision are told apart.

use nalgebra::Vector6;
use pong_geometry::interference::axis_triangle::AxisPlace;

/// Places that carry load.
#[derive(Clone, Copy, Debug)]
pub struct Loaded {
    /// Indices of the places, with their loads λ, m.
    members: [(usize, f64); SIZE],
    count: usize,
    /// Orthonormal vectors that span the a_i of the members.
    basis: [Vector6<f64>; SIZE],
    /// Components of the a_i of the members in the basis, upper triangular.
    parts: [[f64; SIZE]; SIZE],
    /// The displacements u₀ and u₁, m.
    moved: Vector6<f64>,
}

/// Most places that six numbers need.
pub const SIZE: usize = 6;
/// Allowed violation of a place, relative to the largest depth.
const VIOLATION_MAX: f64 = 1e-12;
/// Part of a unit vector across those of the members, below which it is rounding.
const ROUNDING: f64 = 1e-14;
/// Part of the depth by which a place between the ends counts as less deep. Of many places on one plane, between which
/// rounding would choose, the outermost carry the load.
const PREFER_OUTER: f64 = 1e-11;
/// Most places that enter.
const STEPS: usize = 100;

/// Vector a of a place.
fn vector(place: &AxisPlace) -> Vector6<f64> {
    let (n, s) = (&place.normal_b, place.along);
    Vector6::new((1.0 - s) * n.x, (1.0 - s) * n.y, (1.0 - s) * n.z, s * n.x, s * n.y, s * n.z)
}

fn target(place: &AxisPlace) -> f64 {
    place.depth * (1.0 - PREFER_OUTER * place.along * (1.0 - place.along))
}

impl Loaded {
    /// Places that carry load, by index, with their loads λ, m.
    pub fn members(&self) -> &[(usize, f64)] {
        &self.members[..self.count]
    }

    /// Computes the loads. `rounding` is the error of a depth, m. `None` if no displacement clears all places.
    pub fn new(places: &[AxisPlace], rounding: f64) -> Option<Self> {
        let mut loaded = Self {
            members: [(0, 0.0); SIZE],
            count: 0,
            basis: [Vector6::zeros(); SIZE],
            parts: [[0.0; SIZE]; SIZE],
            moved: Vector6::zeros(),
        };
        let deepest = places.iter().map(|place| place.depth).fold(0.0, f64::max);
        let allowed = VIOLATION_MAX * deepest + rounding;
        // Limited, because places that differ only by rounding could replace each other endlessly.
        for _ in 0..STEPS {
            let mut worst = (allowed, None);
            for (index, place) in places.iter().enumerate() {
                let missing = target(place) - vector(place).dot(&loaded.moved);
                if missing > worst.0 {
                    worst = (missing, Some(index));
                }
            }
            let (_, Some(entering)) = worst else { break };
            loaded.enter(places, entering)?;
        }
        loaded.solve(places);
        Some(loaded)
    }

    /// Loads a violated place until it is cleared; places whose load falls to zero leave.
    fn enter(&mut self, places: &[AxisPlace], entering: usize) -> Option<()> {
        let place = &places[entering];
        let new = vector(place);
        let least = ROUNDING * new.norm();
        let mut load = 0.0;
        loop {
            let (parts, rest) = self.split(&new);
            let gives = self.back_substituted(&parts);
            let across = rest.norm();
            let is_free = across > least && self.count < SIZE;
            let full = match is_free {
                true => (target(place) - new.dot(&self.moved)) / (across * across),
                false => f64::INFINITY,
            };
            let mut first = (f64::INFINITY, 0);
            for k in (0..self.count).filter(|&k| gives[k] > 0.0) {
                let until = self.members[k].1 / gives[k];
                if until < first.0 {
                    first = (until, k);
                }
            }
            let step = full.min(first.0);
            if step == f64::INFINITY {
                return None;
            }
            for (member, give) in self.members[..self.count].iter_mut().zip(&gives) {
                member.1 = (member.1 - step * give).max(0.0);
            }
            load += step;
            if is_free {
                self.moved += rest * step;
            }
            if full <= first.0 {
                self.append((entering, load), parts, &rest);
                return Some(());
            }
            self.leave(places, first.1);
        }
    }

    /// Components of a vector in the basis, and what is across it.
    fn split(&self, vector: &Vector6<f64>) -> ([f64; SIZE], Vector6<f64>) {
        let (mut parts, mut rest) = ([0.0; SIZE], *vector);
        // The second time removes the rounding of the first.
        for _ in 0..2 {
            for (part, own) in parts.iter_mut().zip(&self.basis[..self.count]) {
                let along = own.dot(&rest);
                rest -= own * along;
                *part += along;
            }
        }
        (parts, rest)
    }

    /// Adds a member, given what [`Self::split`] returns of its vector.
    fn append(&mut self, (index, load): (usize, f64), parts: [f64; SIZE], rest: &Vector6<f64>) {
        let k = self.count;
        self.members[k] = (index, load);
        let across = rest.norm();
        self.basis[k] = rest / across;
        for (row, part) in self.parts[..k].iter_mut().zip(parts) {
            row[k] = part;
        }
        self.parts[k][k] = across;
        self.count += 1;
    }

    /// Removes a member, and computes the basis of the others anew.
    fn leave(&mut self, places: &[AxisPlace], member: usize) {
        let members = self.members;
        let all = std::mem::take(&mut self.count);
        for (_, &kept) in members[..all].iter().enumerate().filter(|(k, _)| *k != member) {
            let (parts, rest) = self.split(&vector(&places[kept.0]));
            self.append(kept, parts, &rest);
        }
    }

    /// Sets the loads of the members by their depths as they are.
    fn solve(&mut self, places: &[AxisPlace]) {
        let mut along = [0.0; SIZE];
        for k in 0..self.count {
            let known: f64 = (0..k).map(|row| self.parts[row][k] * along[row]).sum();
            along[k] = (places[self.members[k].0].depth - known) / self.parts[k][k];
        }
        let loads = self.back_substituted(&along);
        for (member, load) in self.members[..self.count].iter_mut().zip(loads) {
            member.1 = load.max(0.0);
        }
    }

    /// Solves R·x = right-hand side.
    fn back_substituted(&self, right: &[f64; SIZE]) -> [f64; SIZE] {
        let mut solved = [0.0; SIZE];
        for k in (0..self.count).rev() {
            let known: f64 = (k + 1..self.count).map(|j| self.parts[k][j] * solved[j]).sum();
            solved[k] = (right[k] - known) / self.parts[k][k];
        }
        solved
    }
}
