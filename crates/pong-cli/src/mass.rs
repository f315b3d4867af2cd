//! `pong mass`: mass, centre of mass and inertia of a closed mesh.

use crate::import::{MeshFile, nothing_written};
use crate::terminal::{Outcome, print, tell};
use crate::text::{count, number};
use pong_decompose::{Mass, MassProperties};
use pong_import::number::Grid;
use pong_model::write::decimal;
use std::process::ExitCode;

/// Computes mass, centre of mass and inertia of a closed mesh: glTF (.glb, .gltf), Collada (.dae), OBJ or STL.
///
/// The last line is ready for a body of a scene (docs/scene_format.md). It is in the frame of the model that `pong import`
/// writes with the same options. All solids of the file count as one body of one density; cavities are left out.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("amount").required(true))]
pub(crate) struct Arguments {
    #[command(flatten)]
    mesh: MeshFile,
    /// Density, kg/m³: 7850 for steel, 2700 for aluminium.
    #[arg(long, value_name = "KG/M3", group = "amount", value_parser = crate::import::positive)]
    density: Option<f64>,
    /// Mass of the whole, kg, where that is known instead.
    #[arg(long, value_name = "KG", group = "amount", value_parser = crate::import::positive)]
    mass: Option<f64>,
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let mass = match (arguments.density, arguments.mass) {
        (Some(density), _) => Mass::Density(density),
        (None, mass) => Mass::Total(mass.unwrap_or(1.0)),
    };
    let options = arguments.mesh.options();
    let (found, findings) = pong_decompose::mass_properties(&arguments.mesh.input, &options, mass);
    let Some(found) = found else { return Err(nothing_written(&findings)) };
    findings.notes.iter().for_each(|note| tell(format!("note: {note}")));
    print(&told(&found));
    Ok(ExitCode::SUCCESS)
}

/// Products of inertia below this share of the trace are rounding errors.
const NO_PRODUCT: f64 = 1e-12;

fn told(found: &MassProperties) -> String {
    let inertia = &found.inertia;
    let mut principal: Vec<f64> = inertia.symmetric_eigenvalues().iter().copied().collect();
    principal.sort_by(f64::total_cmp);
    let principal: Vec<String> = principal.into_iter().map(number).collect();
    let [vertices, triangles] =
        [count(found.vertices, "vertex", "vertices"), count(found.triangles, "triangle", "triangles")];
    format!(
        "{vertices} and {triangles} read: {}\nvolume: {} m³, {} kg/m³\nprincipal moments of inertia: {} kg·m²\n{}\n",
        count(found.solids, "solid", "solids"),
        number(found.volume_m3),
        number(found.mass_kg / found.volume_m3),
        principal.join(", "),
        scene_line(found)
    )
}

/// The fields for a body of a scene.
fn scene_line(found: &MassProperties) -> String {
    let inertia = &found.inertia;
    let size = |values: &[f64]| values.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    let grid = Grid::of_size(size(inertia.as_slice()));
    let moment = |i: usize, j: usize| decimal(grid.round(inertia[(i, j)]));
    let off = [(0, 1), (0, 2), (1, 2)].map(|at| inertia[at].abs()).into_iter().fold(0.0, f64::max);
    let [xx, yy, zz] = [0, 1, 2].map(|axis| moment(axis, axis));
    let tensor = if off <= NO_PRODUCT * inertia.trace() {
        format!("Diagonal({xx}, {yy}, {zz})")
    } else {
        let [xy, xz, yz] = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| moment(i, j));
        format!("Full(xx: {xx}, yy: {yy}, zz: {zz}, xy: {xy}, xz: {xz}, yz: {yz})")
    };
    let places = Grid::of_size(size(&found.center_m).max(found.volume_m3.cbrt()));
    let [x, y, z] = found.center_m.map(|x| decimal(places.round(x)));
    let mass = decimal(Grid::of_size(found.mass_kg).round(found.mass_kg));
    format!("mass: {mass}, inertia: {tensor}, mass_center: ({x}, {y}, {z})")
}
