//! From a mesh file to a model file, all of it or nothing.

use crate::affine::Up;
use crate::build::{self, Building};
use crate::files;
use crate::findings::Findings;
use crate::laws::DefaultSurface;
use crate::mesh::HullFinder;
use crate::source::{self, Reading};
use crate::write;
use std::path::{Path, PathBuf};

/// How a mesh file is to be imported.
#[derive(Clone, Debug)]
pub struct Options {
    /// Which axis points up; `None` for what the format is known for: y in glTF, z in OBJ and STL, in Collada what the
    /// file says.
    pub up: Option<Up>,
    /// Metres in one unit of the file; a Collada file gives its unit, and this is a factor to it.
    pub unit_m: f64,
    /// glTF: name of the scene; `None` for the default one.
    pub scene: Option<String>,
    /// Name of the node to take as root where several are marked as roots.
    pub root: Option<String>,
    /// Name of the model; `None` for what the file says, else the file's own name.
    pub name: Option<String>,
    /// Surface of whatever names none; `None` puts a placeholder there.
    pub surface: Option<DefaultSurface>,
    /// Vertices within this distance of each other are one, m; `None` for bit-equal ones only.
    pub weld_m: Option<f64>,
    /// Whether triangles that run against their neighbours are turned, and closed surfaces that face inwards.
    pub outward: bool,
    /// Whether holes of surfaces are filled.
    pub close: bool,
    /// Convex solids of more faces become surfaces, unless they are marked as polyhedra.
    pub faces_max: usize,
    /// Meshes of more triangles or faces go to files beside the model.
    pub inline_max: usize,
    /// What finds the convex hulls that unmarked closed parts become if they are not convex (`pong_decompose::hull_of_mesh`);
    /// `None` leaves such parts as they are.
    pub hull: Option<HullFinder>,
    /// Unmarked parts that are a capsule, a cylinder, a cone or a bore within this distance become that primitive, m; `None` leaves
    /// them polyhedra and surfaces.
    pub round_m: Option<f64>,
    /// Triangles that a file may make by naming meshes several times.
    pub triangles_max: usize,
    /// Folders beside the mesh file's own from which files that it names (buffers of glTF) may be read.
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
            allowed: Vec::new(),
        }
    }
}

impl Options {
    /// How the file is to be read.
    #[doc(hidden)]
    pub fn reading(&self) -> Reading {
        let Self { up, unit_m, scene, triangles_max, allowed, .. } = self.clone();
        Reading { up, unit_m, scene, triangles_max, allowed }
    }

    /// How a model is to be made of it.
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

/// What was written.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The model file and mesh files beside it.
    pub files: Vec<PathBuf>,
    /// Distinct vertices and triangles read.
    pub vertices: usize,
    /// Triangles read.
    pub triangles: usize,
    /// Number of primitives in the model by kind, in the order of kinds in the format.
    pub primitives: Vec<(&'static str, usize)>,
    /// What the author should know; the loader's warnings are among it.
    pub findings: Findings,
}

/// Imports a mesh file and writes the model to `output`.
///
/// `progress` is called with what is being done. The model is read back by the engine's loader before it is put in
/// its place; after a fault nothing is written.
///
/// # Errors
/// Every fault that was found, and the notes.
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
    let primitives = kinds_of(&built.model.root);
    let text = write::text(&built.model);
    let (vertices, triangles) = (built.vertices, built.triangles);
    drop(built.model);
    progress("checking");
    let files = files::write_checked(output, text, built.mesh_files, &mut findings);
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
    let mut counts: Vec<(&'static str, usize)> = crate::marks::KINDS.iter().map(|kind| (*kind, 0)).collect();
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
