//! Import of a mesh file as a model file, complete or not at all.

use crate::affine::Up;
use crate::build::{self, Building, Built};
use crate::files;
use crate::findings::Findings;
use crate::laws::DefaultSurface;
use crate::mesh::HullFinder;
use crate::source::{self, Reading};
use crate::write;
use std::path::{Path, PathBuf};

/// Options of an import.
#[derive(Clone, Debug)]
pub struct Options {
    /// Upward axis; `None` for the convention of the format: y in glTF, z in OBJ and STL, the file's own in
    /// Collada.
    pub up: Option<Up>,
    /// Metres in one unit of the file; a Collada file gives its unit, and this is a factor to it.
    pub unit_m: f64,
    /// glTF: name of the scene; `None` for the default one.
    pub scene: Option<String>,
    /// Name of the root node if several are marked as roots.
    pub root: Option<String>,
    /// Name of the model; `None` for the name in the file, else the file's name.
    pub name: Option<String>,
    /// Surface of primitives that name none; `None` adds a placeholder.
    pub surface: Option<DefaultSurface>,
    /// Vertices within this distance of each other are merged, m; `None` merges bit-equal ones only.
    pub weld_m: Option<f64>,
    /// True if the winding of triangles is made consistent and closed surfaces outward.
    pub outward: bool,
    /// True if holes of surfaces are filled.
    pub close: bool,
    /// Convex solids of more faces become surfaces unless they are marked as polyhedra.
    pub faces_max: usize,
    /// Meshes of more triangles or faces are written to files beside the model.
    pub inline_max: usize,
    /// Convex hull function for unmarked closed parts that are not convex (`pong_decompose::hull_of_mesh`);
    /// `None` leaves such parts as they are.
    pub hull: Option<HullFinder>,
    /// Tolerance within which unmarked parts become capsules, cylinders, cones or bores, m; `None` leaves
    /// them polyhedra and surfaces.
    pub round_m: Option<f64>,
    /// Most triangles that a file may create by instancing its meshes.
    pub triangles_max: usize,
    /// True if unmarked closed meshes and polyhedra keep `contact: Marked`; otherwise they are solids.
    pub marked: bool,
    /// Folders, besides that of the mesh file, from which referenced files (glTF buffers) may be read.
    pub allowed: Vec<PathBuf>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            up: None,
            unit_m: 1.0,
            scene: None,
            root: None,
            name: None,
            surface: None,
            weld_m: None,
            outward: false,
            close: false,
            faces_max: 1000,
            inline_max: usize::MAX,
            hull: None,
            round_m: None,
            triangles_max: 2_000_000,
            marked: false,
            allowed: Vec::new(),
        }
    }
}

impl Options {
    /// Options of reading the file.
    #[doc(hidden)]
    pub fn reading(&self) -> Reading {
        let Self { up, unit_m, scene, triangles_max, allowed, .. } = self.clone();
        Reading { up, unit_m, scene, triangles_max, allowed }
    }

    /// Options of building a model of it.
    #[doc(hidden)]
    pub fn building<'a>(&self, input: &Path, progress: &'a mut dyn FnMut(&str)) -> Building<'a> {
        let options = self.clone();
        let stem = || input.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        Building {
            file: input.display().to_string(),
            name: options.name.unwrap_or_else(stem),
            root: options.root,
            weld_m: options.weld_m,
            outward: options.outward,
            close: options.close,
            unit_m: options.unit_m,
            surface: options.surface,
            faces_max: options.faces_max,
            inline_max: options.inline_max,
            hull: options.hull,
            round_m: options.round_m,
            progress,
        }
    }
}

/// Outcome of an import.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The model file and mesh files beside it.
    pub files: Vec<PathBuf>,
    /// Distinct vertices read.
    pub vertices: usize,
    /// Triangles read.
    pub triangles: usize,
    /// Number of primitives in the model by kind, in the order of kinds in the format.
    pub primitives: Vec<(&'static str, usize)>,
    /// Notes for the author, with the loader's warnings.
    pub findings: Findings,
}

/// Imports a mesh file and writes the model to `output`.
///
/// `progress` is called with the current activity. The engine's loader reads the model back before it is
/// moved into place; after a fault nothing is written.
///
/// # Errors
/// All faults, and the notes.
pub fn import(
    input: &Path,
    output: &Path,
    options: &Options,
    progress: &mut dyn FnMut(&str),
) -> Result<Imported, Findings> {
    let mut findings = Findings::default();
    let built = convert(input, options, progress, &mut findings);
    let Some(built) = built.filter(|_| findings.faults.is_empty()) else { return Err(findings) };
    progress("writing");
    let Built { mut model, mesh_files, vertices, triangles, is_automatic } = built;
    let primitives = kinds_of(&model.root);
    let has = |kind: &str| primitives.iter().any(|(other, _)| *other == kind);
    let solid = !options.marked && is_automatic && (has("Polyhedron") || has("TriangleMesh"));
    let marked = model.root.contact;
    model.root.contact = if solid { Some("Solid") } else { marked };
    let text = write::text(&model);
    model.root.contact = marked;
    // Kept only if another text may be needed.
    let model = solid.then_some(model);
    let instead = || model.as_ref().map(write::text);
    progress("checking");
    let files = files::write_checked_or(output, text, instead, mesh_files, &mut findings);
    match files {
        Some(files) => Ok(Imported { files, vertices, triangles, primitives, findings }),
        None => Err(findings),
    }
}

fn convert(
    input: &Path,
    options: &Options,
    progress: &mut dyn FnMut(&str),
    findings: &mut Findings,
) -> Option<build::Built> {
    let file = input.display().to_string();
    if !(options.unit_m > 0.0 && options.unit_m.is_finite()) {
        return findings.refuse(
            &file,
            "unit",
            format!("a unit of {} m", options.unit_m),
            "give metres above zero",
        );
    }
    progress("reading");
    let source = source::read(input, &options.reading(), findings)?;
    let mut building = options.building(input, progress);
    let mut built = build::build(source, &mut building, findings)?;
    if let Some(name) = &options.name {
        built.model.name.clone_from(name);
    }
    Some(built)
}

fn kinds_of(root: &crate::model::Group) -> Vec<(&'static str, usize)> {
    let mut counts: Vec<(&'static str, usize)> =
        crate::marks::kinds().into_iter().map(|kind| (kind, 0)).collect();
    let mut open = vec![root];
    while let Some(group) = open.pop() {
        for primitive in &group.primitives {
            counts.iter_mut().filter(|(kind, _)| *kind == primitive.kind).for_each(|(_, count)| *count += 1);
        }
        open.extend(&group.groups);
    }
    counts.retain(|(_, count)| *count > 0);
    counts
}
