//! Linear system of free bodies: masses, stiffness and damping about the mass centres.

use crate::coupling::surely_stable_with;
use crate::mass::SpringRates;
use crate::mobility::{Mat6, Vec6, largest_eigenvalue};
use nalgebra::DMatrix;
use pong_engine::{EngineError, TangentMatrix, WrenchCoupling};
use pong_geometry::{Mat3, Vec3};

/// A free body of a linear system.
#[derive(Clone, Debug)]
pub struct LinearBody {
    /// Name of the body.
    pub name: String,
    /// Mass, kg.
    pub mass: f64,
    /// Inertia tensor about the mass centre along the common axes, kg·m².
    pub inertia: Mat3,
    /// Vector from the origin of the movable group to the mass centre, m, along the common axes.
    pub arm: Vec3,
}

/// A spring between two sides: a contact, several contacts of the same two primitives, or a spring of the host.
#[derive(Clone, Debug)]
pub struct Carrier {
    /// Name, for tables.
    pub name: String,
    /// Number of contacts in it; 0 for a spring of the host.
    pub contacts: usize,
    /// Its two sides as indices of free bodies; `None` for a side that does not yield.
    pub sides: [Option<usize>; 2],
    /// −∂W/∂x about the origins of the groups, as in [`pong_engine::PairTangent::stiffness`]. Only its
    /// symmetric part counts.
    pub stiffness: [[TangentMatrix; 2]; 2],
}

/// Free bodies with the stiffness and damping of everything between them, for small motions about one state.
#[derive(Clone, Debug)]
pub struct LinearSystem {
    pub(super) bodies: Vec<LinearBody>,
    /// M^(−½) of each body.
    roots: Vec<Mat6>,
    /// K about the mass centres.
    stiffness: DMatrix<f64>,
    /// D about the mass centres.
    damping: DMatrix<f64>,
    carriers: Vec<Carrier>,
}

impl LinearSystem {
    /// A system without stiffness and damping.
    ///
    /// # Errors
    /// [`EngineError::BadValue`] for a mass or a principal moment of inertia that is not above zero and finite.
    pub fn new(bodies: Vec<LinearBody>) -> Result<Self, EngineError> {
        let roots = bodies.iter().map(inverse_root).collect::<Result<Vec<_>, _>>()?;
        let size = 6 * bodies.len();
        let (stiffness, damping) = (DMatrix::zeros(size, size), DMatrix::zeros(size, size));
        Ok(Self { bodies, roots, stiffness, damping, carriers: Vec::new() })
    }

    /// The bodies, in the order in which they were given.
    pub fn bodies(&self) -> &[LinearBody] {
        &self.bodies
    }

    /// The contacts and springs whose share of the energy of each mode is computed.
    pub fn carriers(&self) -> &[Carrier] {
        &self.carriers
    }

    /// Stiffness K about the mass centres (N/m, N/rad, N, N·m/rad), six rows for each body.
    pub fn stiffness(&self) -> &DMatrix<f64> {
        &self.stiffness
    }

    /// Damping D about the mass centres (N·s/m, N·s/rad, N·s, N·m·s/rad), six rows for each body.
    pub fn damping(&self) -> &DMatrix<f64> {
        &self.damping
    }

    /// Adds −∂W/∂x and −∂W/∂v of wrenches between two sides, about the origins of their groups.
    pub fn add(
        &mut self,
        sides: [Option<usize>; 2],
        stiffness: &[[TangentMatrix; 2]; 2],
        damping: &[[TangentMatrix; 2]; 2],
    ) {
        for (i, on) in sides.iter().enumerate() {
            for (j, of) in sides.iter().enumerate() {
                let (Some(on), Some(of)) = (*on, *of) else { continue };
                let (to, from) = (moved(&self.bodies[on].arm).transpose(), moved(&self.bodies[of].arm));
                let mut block = self.stiffness.fixed_view_mut::<6, 6>(6 * on, 6 * of);
                block += to * stiffness[i][j] * from;
                let mut block = self.damping.fixed_view_mut::<6, 6>(6 * on, 6 * of);
                block += to * damping[i][j] * from;
            }
        }
    }

    /// Adds the stiffness of a force (N, common axes) on the origin of a body: if the body turns, the moment of the
    /// force about the mass centre changes. Give the sum of all forces on the body but gravity, once.
    pub fn add_force(&mut self, body: usize, force: &Vec3) {
        let turned = force.cross_matrix() * self.bodies[body].arm.cross_matrix();
        let mut block = self.stiffness.fixed_view_mut::<3, 3>(6 * body + 3, 6 * body + 3);
        block += turned;
    }

    /// Adds a contact or a spring whose share of the energy of each mode is computed. It adds no stiffness.
    pub fn add_carrier(&mut self, carrier: Carrier) {
        self.carriers.push(carrier);
    }

    /// Largest eigenvalues of M⁻¹·½(K + Kᵀ) (1/s²) and M⁻¹·½(D + Dᵀ) (1/s): upper bounds of the square of the
    /// angular frequency and of the damping over mass of every motion.
    pub fn largest_rates(&self) -> SpringRates {
        SpringRates {
            stiffness: largest_eigenvalue(symmetric(&self.scaled(&self.stiffness))),
            damping: largest_eigenvalue(symmetric(&self.scaled(&self.damping))),
        }
    }

    /// The longest step (s) at which contacts and springs of this system are surely stable; 0 if there is none,
    /// infinite if nothing acts. `least_ratio` is the least damping over stiffness of all contacts, s.
    pub fn surely_stable_step(&self, coupling: WrenchCoupling, least_ratio: f64) -> f64 {
        surely_stable_with(coupling, self.largest_rates(), least_ratio, SpringRates::default())
    }

    /// M^(−½)·A·M^(−½).
    pub(super) fn scaled(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let mut scaled = matrix.clone();
        for (i, left) in self.roots.iter().enumerate() {
            for (j, right) in self.roots.iter().enumerate() {
                let block = left * matrix.fixed_view::<6, 6>(6 * i, 6 * j) * right;
                scaled.fixed_view_mut::<6, 6>(6 * i, 6 * j).copy_from(&block);
            }
        }
        scaled
    }

    /// M^(−½) of a body.
    pub(super) fn root(&self, body: usize) -> &Mat6 {
        &self.roots[body]
    }

    /// Energy ½·xᵀ·K·x (J) of each carrier in a motion: six numbers for each body, at its mass centre.
    pub(super) fn energies(&self, motion: &[Vec6]) -> Vec<f64> {
        let energy = |carrier: &Carrier| {
            let at_origin = carrier.sides.map(|side| {
                side.map_or_else(Vec6::zeros, |body| moved(&self.bodies[body].arm) * motion[body])
            });
            let mut sum = 0.0;
            for (on, blocks) in at_origin.iter().zip(&carrier.stiffness) {
                for (of, block) in at_origin.iter().zip(blocks) {
                    sum += 0.5 * on.dot(&(block * of));
                }
            }
            sum
        };
        self.carriers.iter().map(energy).collect()
    }
}

/// Half the sum of a matrix and its transpose.
pub(super) fn symmetric(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    (matrix + matrix.transpose()) * 0.5
}

/// Motion of the origin of a group from that of its mass centre: the origin lies at −arm, so v − θ × arm.
fn moved(arm: &Vec3) -> Mat6 {
    let mut moved = Mat6::identity();
    moved.fixed_view_mut::<3, 3>(0, 3).copy_from(&arm.cross_matrix());
    moved
}

/// M^(−½).
fn inverse_root(body: &LinearBody) -> Result<Mat6, EngineError> {
    let bad = |cause: String| EngineError::BadValue { what: format!("body `{}`", body.name), cause };
    if !(body.mass > 0.0 && body.mass.is_finite()) {
        return Err(bad(format!("its mass is {} kg; give a finite mass above zero", body.mass)));
    }
    if body.inertia.iter().any(|x| !x.is_finite()) {
        return Err(bad("its inertia is not finite; give finite moments".to_owned()));
    }
    let eigen = body.inertia.symmetric_eigen();
    if let Some(moment) = eigen.eigenvalues.iter().find(|moment| **moment <= 0.0) {
        return Err(bad(format!("a principal moment of inertia is {moment} kg·m²; all must be above zero")));
    }
    let turn = eigen.eigenvectors
        * Mat3::from_diagonal(&eigen.eigenvalues.map(|moment| 1.0 / moment.sqrt()))
        * eigen.eigenvectors.transpose();
    let mut root = Mat6::zeros();
    root.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Mat3::identity() / body.mass.sqrt()));
    root.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
    Ok(root)
}
