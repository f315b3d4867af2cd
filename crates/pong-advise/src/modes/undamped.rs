//! Frequencies and shapes without damping: eigenvalues of M^(−½)·½(K + Kᵀ)·M^(−½).

use super::damped::{Damped, Growth};
use super::kind::{ModeKind, bad};
use super::system::{LinearSystem, symmetric};
use crate::mobility::Vec6;
use nalgebra::{Complex, DMatrix, DVector};
use pong_engine::EngineError;
use pong_geometry::Vec3;

/// Eigenvalues within this share of each other have one space of shapes, and the shapes along the axes are chosen.
const EQUAL: f64 = 1e-7;

/// Motion of one body in a mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyShape {
    /// Displacement of the mass centre, m, along the common axes.
    pub translation: Vec3,
    /// Rotation vector, rad, along the common axes.
    pub rotation: Vec3,
    /// Share of the kinetic energy of the mode in the translation of this body, no unit.
    pub translation_share: f64,
    /// Share of the kinetic energy of the mode in the rotation of this body, no unit.
    pub rotation_share: f64,
}

/// A mode of a linear system.
#[derive(Clone, Debug)]
pub struct Mode {
    /// Kind of the mode.
    pub kind: ModeKind,
    /// Square of the angular frequency without damping, 1/s²; negative for an unstable mode.
    pub rate: f64,
    /// Frequency without damping, Hz; 0 unless the mode is an oscillation.
    pub frequency: f64,
    /// Damping over critical damping, no unit, from the eigenvalues of the damped system; below 0 if the motion
    /// grows. `None` unless the mode is an oscillation.
    pub damping_ratio: Option<f64>,
    /// The two eigenvalues of the damped system that belong to this mode, 1/s. `None` unless the mode is an
    /// oscillation.
    pub eigenvalues: Option<[Complex<f64>; 2]>,
    /// Motion of each body, scaled so that xᵀ·M·x = 1 kg·m².
    pub shape: Vec<BodyShape>,
    /// Share of each carrier in the energy of all carriers, in the order of [`LinearSystem::carriers`].
    pub shares: Vec<f64>,
}

/// Modes of a linear system, by rising frequency.
#[derive(Clone, Debug)]
pub struct Modes {
    /// Six modes for each free body.
    pub modes: Vec<Mode>,
    /// Motions of the damped system that grow.
    pub growths: Vec<Growth>,
}

impl LinearSystem {
    /// Modes. Eigenvalues of less than `tolerance` of the largest one count as zero: 1e-10 for tangents in closed form,
    /// 1e-6 for tangents by differences.
    ///
    /// # Errors
    /// [`EngineError::BadValue`] if a stiffness or damping is not finite, or if the eigenvalues do not converge.
    pub fn modes(&self, tolerance: f64) -> Result<Modes, EngineError> {
        let (stiffness, damping) = (self.scaled(self.stiffness()), self.scaled(self.damping()));
        if stiffness.iter().chain(damping.iter()).any(|x| !x.is_finite()) {
            let cause =
                "a stiffness or damping is not finite; check the stiffness of the surfaces and springs";
            return Err(bad(cause));
        }
        if stiffness.is_empty() {
            return Ok(Modes { modes: Vec::new(), growths: Vec::new() });
        }
        let (rates, vectors) = sorted_eigen(&symmetric(&stiffness))?;
        let largest = rates.iter().fold(0.0_f64, |most, rate| most.max(rate.abs()));
        let kind = |rate: f64| match rate {
            _ if rate.abs() <= tolerance * largest => ModeKind::Rigid,
            _ if rate > 0.0 => ModeKind::Oscillation,
            _ => ModeKind::Unstable,
        };
        let kinds: Vec<ModeKind> = rates.iter().map(|rate| kind(*rate)).collect();
        let damped = Damped::new(&stiffness, &damping, (&rates, &vectors, &kinds), tolerance)?;
        let modes = (0..rates.len()).map(|index| {
            let vector = vectors.column(index).into_owned();
            self.mode(kinds[index], rates[index], &vector, damped.pairs[index])
        });
        Ok(Modes { modes: modes.collect(), growths: damped.growths })
    }

    fn mode(
        &self,
        kind: ModeKind,
        rate: f64,
        vector: &DVector<f64>,
        eigenvalues: Option<[Complex<f64>; 2]>,
    ) -> Mode {
        let scaled = |body: usize| vector.fixed_rows::<6>(6 * body).into_owned();
        let motion: Vec<Vec6> = (0..self.bodies.len()).map(|body| self.root(body) * scaled(body)).collect();
        let shape = motion.iter().enumerate().map(|(body, motion)| BodyShape {
            translation: motion.fixed_rows::<3>(0).into_owned(),
            rotation: motion.fixed_rows::<3>(3).into_owned(),
            translation_share: scaled(body).fixed_rows::<3>(0).norm_squared(),
            rotation_share: scaled(body).fixed_rows::<3>(3).norm_squared(),
        });
        let energies = self.energies(&motion);
        let sum: f64 = energies.iter().sum();
        let known = kind != ModeKind::Rigid && sum > 0.0;
        let shares = energies.iter().map(|energy| if known { energy / sum } else { 0.0 }).collect();
        let oscillates = kind == ModeKind::Oscillation;
        Mode {
            kind,
            rate,
            frequency: if oscillates { rate.sqrt() / std::f64::consts::TAU } else { 0.0 },
            damping_ratio: eigenvalues.map(|[a, b]| -(a + b).re / (2.0 * (a * b).norm().sqrt())),
            eigenvalues,
            shape: shape.collect(),
            shares,
        }
    }
}

/// Eigenvalues in rising order, with their vectors as columns.
fn sorted_eigen(matrix: &DMatrix<f64>) -> Result<(Vec<f64>, DMatrix<f64>), EngineError> {
    let eigen = matrix
        .clone()
        .try_symmetric_eigen(f64::EPSILON, 10_000)
        .ok_or_else(|| bad("the eigenvalues of the stiffness do not converge"))?;
    let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let rates: Vec<f64> = order.iter().map(|index| eigen.eigenvalues[*index]).collect();
    let mut vectors = eigen.eigenvectors.select_columns(&order);
    let largest = rates.iter().fold(0.0_f64, |most, rate| most.max(rate.abs()));
    let mut first = 0;
    for end in 1..=rates.len() {
        if end == rates.len() || rates[end] - rates[end - 1] > EQUAL * rates[end].abs() + 1e-12 * largest {
            if end - first > 1 {
                let space = vectors.columns(first, end - first).into_owned();
                vectors.columns_mut(first, end - first).copy_from(&along_axes(&space));
            }
            first = end;
        }
    }
    Ok((rates, vectors))
}

/// Another orthonormal basis of the space of some columns: each vector is the projection of a coordinate axis.
fn along_axes(space: &DMatrix<f64>) -> DMatrix<f64> {
    let mut rest = space * space.transpose();
    let mut basis = DMatrix::zeros(space.nrows(), space.ncols());
    for column in 0..space.ncols() {
        // The first of the axes that are equally near: rounding must not choose.
        let most = rest.diagonal().max();
        let axis = (0..rest.nrows()).find(|axis| rest[(*axis, *axis)] >= most * (1.0 - 1e-6)).unwrap_or(0);
        let vector = rest.column(axis).into_owned() / rest[(axis, axis)].sqrt();
        rest -= &vector * vector.transpose();
        basis.set_column(column, &vector);
    }
    basis
}
