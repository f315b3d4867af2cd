//! From a source to a model: by its marks, or without any by its geometry.

mod default;
mod frames;
mod kinds;
mod marked;
mod mesh_files;
pub mod meshes;
mod names;

use crate::findings::Findings;
use crate::laws::{self, DefaultSurface};
use crate::marks::Settings;
use crate::mesh::HullFinder;
use crate::model::{Field, Group, Model};
use crate::number::Grid;
use crate::source::{Shape, Source};
use std::collections::BTreeSet;

/// Name of the surface that stands in when none is given.
const PLACEHOLDER: &str = "placeholder";

/// How a model is to be built.
pub struct Building<'a> {
    /// What messages call the file.
    pub file: String,
    /// Name of the model if the file gives none.
    pub name: String,
    /// Name of the root to take, if there are several.
    pub root: Option<String>,
    /// Vertices nearer than this are one, m; `None` joins only equal ones.
    pub weld_m: Option<f64>,
    /// Metres in one unit of the file, for lengths in marks.
    pub unit_m: f64,
    pub surface: Option<DefaultSurface>,
    pub faces_max: usize,
    /// Meshes of more triangles go to files beside the model.
    pub inline_max: usize,
    /// What unmarked parts that are not convex become, if anything: their convex hulls.
    pub hull: Option<HullFinder>,
    pub progress: &'a mut dyn FnMut(&str),
}

/// A model and the mesh files beside it: name and contents.
pub struct Built {
    pub model: Model,
    pub mesh_files: Vec<(String, Vec<u8>)>,
    /// Vertices and triangles that were read.
    pub vertices: usize,
    pub triangles: usize,
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
    findings.faults.is_empty().then_some(Built { model, mesh_files, vertices, triangles })
}

/// The largest coordinate anywhere, m: what digits are counted from.
fn size_m(source: &Source) -> f64 {
    let largest = |shape: &Shape| shape.vertices.iter().map(|place| place.amax()).fold(0.0, f64::max);
    let own = |node: &crate::source::Node| {
        let scale = node.local.linear.column_iter().map(|axis| axis.norm()).fold(0.0, f64::max);
        node.mesh.as_ref().map_or(0.0, largest) * scale.max(1.0) + node.local.translation.amax()
    };
    source.nodes.iter().map(own).fold(0.0, f64::max)
}

/// Name, surfaces and pairs of the model.
fn apply_settings(model: &mut Model, settings: Settings, building: &Building<'_>, findings: &mut Findings) {
    let scene = format!("{}: scene", building.file);
    if !settings.name.is_empty() {
        model.name = settings.name;
    } else if !settings.surfaces.is_empty() {
        model.name = model.root.name.clone();
    }
    model.entry_memory = settings.entry_memory.unwrap_or(true);
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

/// Gives the root a surface if something below has none.
pub fn default_surface(model: &mut Model, building: &Building<'_>, findings: &mut Findings) {
    if !lacks_surface(&model.root) {
        if let (Some(surface), true) = (&building.surface, findings.faults.is_empty()) {
            let cause =
                format!("everything has a surface: `{}` of the command line is not used", surface.name);
            findings.note(&building.file, "surface-not-used", cause, "");
        }
        return;
    }
    let surface = building.surface.clone().unwrap_or_else(|| {
        let cause = format!(
            "nothing says what it is made of: `{PLACEHOLDER}` (1e6 N/m, no damping, no friction) stands in"
        );
        let cure = "give --stiffness, --damping and --mu, or correct the surface in the model file";
        findings.note(&building.file, "placeholder-surface", cause, cure);
        let line =
            format!("The surface `{PLACEHOLDER}` stands in for one that was not given: correct its numbers.");
        model.comment.push(line);
        DefaultSurface { name: PLACEHOLDER.to_owned(), stiffness: 1e6, damping: 0.0, mu: 0.0 }
    });
    if model.surfaces.iter().any(|(name, _)| *name == surface.name) {
        let cause = format!("the surface `{}` is in the file already", surface.name);
        findings.fault(
            &building.file,
            "repeated-surface",
            cause,
            "--surface gives the default one another name",
        );
        return;
    }
    model.surfaces.push((surface.name.clone(), surface.record()));
    model.root.surface = Some(surface.name);
}

/// Whether a primitive has no surface, neither its own nor that of a group above.
fn lacks_surface(group: &Group) -> bool {
    group.surface.is_none()
        && (group.primitives.iter().any(|primitive| primitive.surface.is_none())
            || group.groups.iter().any(lacks_surface))
}

fn unknown_surfaces(model: &Model, building: &Building<'_>, findings: &mut Findings) {
    let mut named: BTreeSet<(String, String)> = BTreeSet::new();
    let mut open = vec![(model.root.name.clone(), &model.root)];
    while let Some((path, group)) = open.pop() {
        named.extend(group.surface.iter().map(|surface| (path.clone(), surface.clone())));
        for primitive in &group.primitives {
            named.extend(
                primitive
                    .surface
                    .iter()
                    .map(|surface| (format!("{path}/{}", primitive.name), surface.clone())),
            );
        }
        open.extend(group.groups.iter().map(|below| (format!("{path}/{}", below.name), below)));
    }
    for (path, surface) in named {
        if !model.surfaces.iter().any(|(name, _)| *name == surface) {
            let cause = format!("there is no surface `{surface}` in the file");
            let cure = "add it to the surfaces of the scene's extras.pong, or correct the name";
            findings.fault(&format!("{}: {path}", building.file), "unknown-surface", cause, cure);
        }
    }
}

/// Whether a field is there under this name.
pub fn value_of<'a>(record: &'a [(String, Field)], name: &str) -> Option<&'a Field> {
    record.iter().find(|(key, _)| key == name).map(|(_, value)| value)
}
