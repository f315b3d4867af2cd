//! Volume, mass, centre of mass and inertia of closed meshes, by the divergence theorem: exact for flat triangles.

use crate::solids::{self, SolidMesh};
use nalgebra::{Matrix3, Vector3};
use pong_import::mesh::{Mesh, bounds};
use pong_import::{Findings, Options, source};
use std::path::Path;

/// Mass of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mass {
    /// Density, kg/m³.
    Density(f64),
    /// Mass of all solids together, kg.
    Total(f64),
}

/// Mass properties of all solids of a file, in the frame of the model.
#[derive(Clone, Debug, PartialEq)]
pub struct MassProperties {
    /// Distinct vertices read.
    pub vertices: usize,
    /// Triangles read.
    pub triangles: usize,
    /// Closed solids, cavities not counted.
    pub solids: usize,
    /// Volume of all solids, without cavities, m³.
    pub volume_m3: f64,
    /// Mass, kg.
    pub mass_kg: f64,
    /// Centre of mass, m.
    pub center_m: [f64; 3],
    /// Inertia tensor about the centre of mass along the axes of the model, kg·m².
    pub inertia: Matrix3<f64>,
}

/// Mass properties of a mesh file, or what keeps its mesh from having an inside.
pub fn mass_properties(input: &Path, options: &Options, mass: Mass) -> (Option<MassProperties>, Findings) {
    let mut findings = Findings::default();
    let found = attempt(input, options, mass, &mut findings);
    (found.filter(|_| findings.faults.is_empty()), findings)
}

fn attempt(input: &Path, options: &Options, mass: Mass, findings: &mut Findings) -> Option<MassProperties> {
    let source = source::read(input, &options.reading(), findings)?;
    let mut silent = |_: &str| ();
    let building = options.building(input, &mut silent);
    let shape = solids::flatten(source, &building, findings);
    let (vertices, triangles) = (shape.vertices.len(), shape.triangles.len());
    let solids = solids::solids(shape, &building, findings)?;
    let mut whole = Mesh::default();
    solids.iter().for_each(|solid: &SolidMesh| whole.append(&solid.mesh));
    let Moments { volume_m3, center, second } = Moments::of(&whole);
    let density = match mass {
        Mass::Density(density) => density,
        Mass::Total(mass) => mass / volume_m3,
    };
    Some(MassProperties {
        vertices,
        triangles,
        solids: solids.len(),
        volume_m3,
        mass_kg: density * volume_m3,
        center_m: center.into(),
        inertia: (Matrix3::identity() * second.trace() - second) * density,
    })
}

/// Volume, its centroid, and ∫ x xᵀ dV about the centroid.
struct Moments {
    volume_m3: f64,
    center: Vector3<f64>,
    second: Matrix3<f64>,
}

impl Moments {
    /// Sums over tetrahedra between the triangles and an inner point.
    fn of(mesh: &Mesh) -> Self {
        let (low, high) = bounds(&mesh.vertices);
        let origin = 0.5 * (low + high);
        let (mut six, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
        for triangle in 0..mesh.triangles.len() {
            let corners = mesh.corners(triangle).map(|corner| corner - origin);
            let [a, b, c] = corners;
            let det = a.dot(&b.cross(&c));
            let sum = a + b + c;
            six += det;
            first += sum * det;
            second +=
                (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose()) * det;
        }
        let volume_m3 = six / 6.0;
        let offset = first / (24.0 * volume_m3);
        let second = second / 120.0 - offset * offset.transpose() * volume_m3;
        Self { volume_m3, center: origin + offset, second }
    }
}
