//! Building of a model from a source: by its marks or, without any, by its geometry.

mod building;
mod default;
mod frames;
mod kinds;
mod marked;
mod mesh_files;
pub mod meshes;
mod names;
mod round;
mod surfaces;

use crate::findings::Findings;
use crate::laws;
use crate::marks::Settings;
use crate::model::Model;
use crate::number::Grid;
use crate::source::{Shape, Source};
use surfaces::unknown_surfaces;

pub use building::Building;
pub use surfaces::default_surface;

/// A model and the mesh files beside it: name and contents.
pub struct Built {
    pub model: Model,
    pub mesh_files: Vec<(String, Vec<u8>)>,
    /// Number of vertices and triangles read.
    pub vertices: usize,
    pub triangles: usize,
    /// True if the shapes become solids if they can: without marks, or with a root whose contact is automatic.
    pub is_automatic: bool,
}

pub fn build(source: Source, building: &mut Building<'_>, findings: &mut Findings) -> Option<Built> {
    let shapes = || source.nodes.iter().filter_map(|node| node.mesh.as_ref());
    let (vertices, triangles) =
        (shapes().map(|shape| shape.vertices.len()).sum(), shapes().map(|shape| shape.triangles.len()).sum());
    let marks = marked::read_marks(&source, building, findings);
    let on_root = marks.iter().flatten().find_map(|mark| mark.settings.as_ref());
    let settings = source.settings.as_ref().or(on_root);
    let settings =
        settings.map(|value| Settings::read(value, &format!("{}: scene", building.file), findings));
    let marked = settings.is_some() || marks.iter().any(Option::is_some);
    let is_automatic = !marked || marked::is_automatic(&source.nodes, &marks, &building.root);
    let grid = Grid::of_size(size_m(&source));
    let root = match marked {
        true => marked::tree(source, &marks, grid, building, findings),
        false => default::tree(source, grid, building, findings),
    };
    let mut model = Model { entry_memory: true, name: building.name.clone(), ..Model::default() };
    model.root = root?;
    apply_settings(&mut model, settings.unwrap_or_default(), building, findings);
    if !findings.faults.is_empty() {
        return None;
    }
    let mesh_files = mesh_files::split_off(&mut model, building.inline_max, findings);
    findings.faults.is_empty().then_some(Built { model, mesh_files, vertices, triangles, is_automatic })
}

/// Largest coordinate, m; it sets the number of digits.
fn size_m(source: &Source) -> f64 {
    let largest = |shape: &Shape| shape.vertices.iter().map(|place| place.amax()).fold(0.0, f64::max);
    let own = |node: &crate::source::Node| {
        let scale = node.local.linear.column_iter().map(|axis| axis.norm()).fold(0.0, f64::max);
        node.mesh.as_ref().map_or(0.0, largest) * scale.max(1.0) + node.local.translation.amax()
    };
    source.nodes.iter().map(own).fold(0.0, f64::max)
}

/// Name, surfaces, pairs and filters of the model.
fn apply_settings(model: &mut Model, settings: Settings, building: &Building<'_>, findings: &mut Findings) {
    let scene = format!("{}: scene", building.file);
    if !settings.name.is_empty() {
        model.name = settings.name;
    } else if !settings.surfaces.is_empty() {
        model.name = model.root.name.clone();
    }
    model.entry_memory = settings.entry_memory.unwrap_or(true);
    model.filters = settings.filters;
    for (name, fields) in &settings.surfaces {
        match laws::record(fields) {
            Ok(record) => model.surfaces.push((name.clone(), record)),
            Err(cause) => {
                findings.fault(&format!("{scene}/surfaces/{name}"), "surface", cause, "correct the surface")
            }
        }
    }
    for (index, fields) in settings.pairs.iter().enumerate() {
        match laws::record(fields) {
            Ok(record) => model.pairs.push(record),
            Err(cause) => {
                findings.fault(&format!("{scene}/pairs[{index}]"), "surface", cause, "correct the pair")
            }
        }
    }
    default_surface(model, building, findings);
    unknown_surfaces(model, building, findings);
}
