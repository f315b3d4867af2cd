//! The movable groups of a frame, and the assemblies that they form.

use crate::assembly::Assembly;
use crate::body::Body;
use crate::error::SlowError;
use crate::input::{Coupling, gains};
use nalgebra::{DMatrix, Matrix6, Vector6};
use pong_geometry::Pose;

/// Movable groups with their masses and joints. Lists of impulses and velocities have one entry for each body.
#[derive(Debug)]
pub(crate) struct System<'c> {
    pub bodies: Vec<Body>,
    pub assemblies: Vec<Assembly>,
    couplings: &'c [Coupling],
    /// Assembly of each body, and its place there; `None` for a body that contact does not move.
    homes: Vec<Option<(usize, usize)>>,
}

impl<'c> System<'c> {
    /// Bodies and the joints between them.
    pub fn new(bodies: Vec<Body>, couplings: &'c [Coupling]) -> Result<Self, SlowError> {
        let homes = vec![None; bodies.len()];
        let mut system = Self { bodies, assemblies: Vec::new(), couplings, homes };
        system.require_joints()?;
        system.assemble()?;
        Ok(system)
    }

    /// Forms the assemblies for the poses that the bodies have.
    fn assemble(&mut self) -> Result<(), SlowError> {
        let mut mobilities = Vec::with_capacity(self.bodies.len());
        for body in &self.bodies {
            mobilities.push(body.mobility()?);
        }
        let pairs: Vec<_> = self.couplings.iter().map(|coupling| coupling.places()).collect();
        self.assemblies.clear();
        for members in connected(self.bodies.len(), &pairs, |body| mobilities[body].is_some()) {
            let mobility = self.mobility(&members, &mobilities);
            let refused = || {
                let names: Vec<_> =
                    members.iter().map(|&body| format!("`{}`", self.bodies[body].name)).collect();
                SlowError::BadInput { what: format!("mobility of {}", names.join(", ")), cause: gains() }
            };
            let assembly = Assembly::of(members.clone(), &mobility).ok_or_else(refused)?;
            for (place, body) in members.into_iter().enumerate() {
                self.homes[body] = Some((self.assemblies.len(), place));
            }
            self.assemblies.push(assembly);
        }
        Ok(())
    }

    /// Refuses couplings of bodies that are not in joints.
    fn require_joints(&self) -> Result<(), SlowError> {
        for coupling in self.couplings {
            let (of, by) = coupling.places();
            if let Some(body) = [of, by].into_iter().find(|body| !self.bodies[*body].is_jointed()) {
                let [of, by, wrong] = [of, by, body].map(|body| &self.bodies[body].name);
                return Err(SlowError::BadInput {
                    what: format!("coupling of `{of}` and `{by}`"),
                    cause: format!(
                        "`{wrong}` is not in joints; give it `Jointed` dynamics, or leave the coupling out"
                    ),
                });
            }
        }
        Ok(())
    }

    /// Mobility of the bodies of an assembly, six rows for each.
    fn mobility(&self, members: &[usize], own: &[Option<Matrix6<f64>>]) -> DMatrix<f64> {
        let mut whole = DMatrix::zeros(6 * members.len(), 6 * members.len());
        for (place, body) in members.iter().enumerate() {
            let own = own[*body].unwrap_or_default();
            whole.fixed_view_mut::<6, 6>(6 * place, 6 * place).copy_from(&own);
        }
        for coupling in self.couplings {
            let (of, by) = coupling.places();
            if let (Ok(row), Ok(column)) = (members.binary_search(&of), members.binary_search(&by)) {
                let block = coupling.block();
                whole.fixed_view_mut::<6, 6>(6 * row, 6 * column).copy_from(&block);
                whole.fixed_view_mut::<6, 6>(6 * column, 6 * row).copy_from(&block.transpose());
            }
        }
        whole
    }

    /// Moves the bodies by a frame in which the host applies these impulses.
    pub fn advance(&mut self, impulses: &[Vector6<f64>], theta: f64, length: f64) -> Result<(), SlowError> {
        let ends = self.velocities_after(impulses, length);
        for (body, end) in self.bodies.iter_mut().zip(&ends) {
            let by = (body.velocity + (end - body.velocity) * theta) * length;
            body.pose = body.moved(&body.pose, &by);
            body.velocity = *end;
        }
        self.assemble()
    }

    /// Returns true if contact moves the body.
    pub fn moves(&self, body: usize) -> bool {
        self.homes[body].is_some()
    }

    /// Assembly of a body that moves.
    pub fn home(&self, body: usize) -> Option<usize> {
        self.homes[body].map(|(assembly, _)| assembly)
    }

    /// Velocities gained by impulses.
    pub fn gains(&self, impulses: &[Vector6<f64>]) -> Vec<Vector6<f64>> {
        let mut gains = vec![Vector6::zeros(); self.bodies.len()];
        self.assemblies.iter().for_each(|assembly| assembly.add_gains(impulses, &mut gains));
        gains
    }

    /// Velocities at the end of a frame in which the host applies these impulses.
    pub fn velocities_after(&self, impulses: &[Vector6<f64>], length: f64) -> Vec<Vector6<f64>> {
        let mut velocities = self.gains(impulses);
        for (velocity, body) in velocities.iter_mut().zip(&self.bodies) {
            *velocity += body.velocity + body.acceleration * length;
        }
        velocities
    }

    /// Leading poses at the end of a frame in which the host applies these impulses.
    pub fn landing(&self, impulses: &[Vector6<f64>], length: f64) -> Vec<Pose> {
        let velocities = self.velocities_after(impulses, length);
        let pose = |(body, velocity): (&Body, &Vector6<f64>)| body.moved(&body.leading, &(velocity * length));
        self.bodies.iter().zip(&velocities).map(pose).collect()
    }

    /// Adds Bᵀ·p of an impulse on a body to the coordinates z of its assembly.
    pub fn add_coordinates_of_impulse(&self, z: &mut [f64], body: usize, impulse: &Vector6<f64>) {
        if let Some((assembly, place)) = self.homes[body] {
            self.assemblies[assembly].add_coordinates_of_impulse(z, place, impulse);
        }
    }

    /// Energy ½·u·M·u of an assembly with these velocities, J.
    pub fn kinetic(&self, assembly: usize, velocities: &[Vector6<f64>]) -> f64 {
        0.5 * self.assemblies[assembly].coordinates(velocities).norm_squared()
    }

    /// Potential of the forces without contact on an assembly after displacements from the leading poses, J.
    pub fn potential(&self, assembly: usize, displacements: &[Vector6<f64>]) -> f64 {
        let assembly = &self.assemblies[assembly];
        let accelerations: Vec<_> = self.bodies.iter().map(|body| body.acceleration).collect();
        -assembly.coordinates(&accelerations).dot(&assembly.coordinates(displacements))
    }

    /// Coordinates z of all assemblies, one after another, and where each begins.
    pub fn starts(&self) -> (Vec<usize>, usize) {
        let mut size = 0;
        let start = |assembly: &Assembly| {
            size += assembly.rank();
            size - assembly.rank()
        };
        let starts = self.assemblies.iter().map(start).collect();
        (starts, size)
    }
}

/// Sets of indices below `count` that pairs connect, each ascending, in order of their first one; without those that do
/// not count.
pub(crate) fn connected(
    count: usize,
    pairs: &[(usize, usize)],
    counts: impl Fn(usize) -> bool,
) -> Vec<Vec<usize>> {
    let mut root: Vec<usize> = (0..count).collect();
    fn find(root: &[usize], mut index: usize) -> usize {
        while root[index] != index {
            index = root[index];
        }
        index
    }
    for &(a, b) in pairs {
        if counts(a) && counts(b) {
            let (a, b) = (find(&root, a), find(&root, b));
            // The lowest index names the set.
            root[a.max(b)] = a.min(b);
        }
    }
    let mut sets: Vec<Vec<usize>> = Vec::new();
    let mut set_of = vec![usize::MAX; count];
    for index in (0..count).filter(|index| counts(*index)) {
        let first = find(&root, index);
        if set_of[first] == usize::MAX {
            set_of[first] = sets.len();
            sets.push(Vec::new());
        }
        sets[set_of[first]].push(index);
    }
    sets
}
