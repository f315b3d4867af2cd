//! `pong import`: a mesh file becomes a model file.

use crate::folders::AllowedFolders;
use crate::terminal::{Failure, Outcome, SPINNER, print, progress, show, tell};
use crate::text::count;
use pong_import::{DefaultSurface, Findings, Imported, Options, Up};
use std::path::PathBuf;
use std::process::ExitCode;

/// Makes a model file of a mesh file: glTF (.glb, .gltf), Collada (.dae), OBJ or STL.
///
/// Nodes of a glTF file become groups and primitives as `extras.pong` says, which the modelling toolkit writes. Without
/// it every node becomes a group, convex solids become polyhedra and other surfaces meshes of triangles. If all are
/// closed, they touch by the volume that they share (`contact: Solid`).
/// docs/importing.md has the whole of it.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    mesh: Mesh,
    /// glTF: the node to take where several are marked as roots.
    #[arg(long, value_name = "NODE")]
    root: Option<String>,
    /// Unmarked convex solids of more faces become surfaces of triangles.
    #[arg(long, value_name = "FACES", default_value_t = 1000)]
    faces_max: usize,
    /// Puts meshes of more than this many faces into OBJ files beside the model.
    #[arg(long, value_name = "FACES", num_args = 0..=1, default_missing_value = "1000")]
    mesh_files: Option<usize>,
    /// Makes unmarked parts that are not convex their convex hulls: hulls of CoACD, which rounding has dented.
    #[arg(long)]
    hull: bool,
    /// Makes unmarked parts that are a capsule, a cylinder, a cone or a bore within this distance that primitive: 0.1mm.
    #[arg(long, value_name = "TOLERANCE", value_parser = length_m)]
    round: Option<f64>,
}

/// The mesh file, the model file, and the options of the conversion.
#[derive(clap::Args)]
pub(crate) struct Mesh {
    #[command(flatten)]
    pub(crate) file: MeshFile,
    /// The model file to write.
    #[arg(short, long, value_name = "MODEL.ron")]
    pub(crate) output: PathBuf,
    /// Name of the model; that of the file unless given.
    #[arg(long)]
    pub(crate) name: Option<String>,
    /// Writes no `contact: Solid`: shapes touch where points, segments and round parts meet faces.
    #[arg(long)]
    pub(crate) marked: bool,
    #[command(flatten)]
    pub(crate) surface: Surface,
}

/// A mesh file and the options of reading it.
#[derive(clap::Args)]
pub(crate) struct MeshFile {
    /// The mesh file.
    #[arg(value_name = "MESH")]
    pub(crate) input: PathBuf,
    /// Axis of the file that points up; y in glTF, z in OBJ and STL, in Collada what the file says, unless given.
    #[arg(long, value_enum, value_name = "AXIS")]
    pub(crate) up: Option<Axis>,
    /// Length of one unit of the file: 0.001, 1mm, 1in; a factor to the unit that a Collada file gives.
    #[arg(long, value_name = "LENGTH", default_value = "1m", value_parser = length_m)]
    pub(crate) unit: f64,
    /// glTF and Collada: the scene to read.
    #[arg(long)]
    pub(crate) scene: Option<String>,
    /// Welds vertices within this distance of each other: 1e-6, 1um; only equal ones are welded unless given.
    #[arg(long, value_name = "LENGTH", value_parser = length_m)]
    pub(crate) weld: Option<f64>,
    /// Turns triangles that run against their neighbours, and closed surfaces that face inwards.
    #[arg(long)]
    pub(crate) outward: bool,
    /// Fills holes between their vertices; refused if more than a quarter of the surface is missing.
    #[arg(long)]
    pub(crate) close: bool,
    /// Most triangles that meshes may make which the file names several times.
    #[arg(long, value_name = "TRIANGLES", default_value_t = 2_000_000)]
    pub(crate) triangles_max: usize,
    #[command(flatten)]
    pub(crate) allowed: AllowedFolders,
}

/// The default surface.
#[derive(clap::Args)]
pub(crate) struct Surface {
    /// Name of the surface of parts without one.
    #[arg(id = "surface_name", long = "surface", value_name = "NAME", default_value = "default")]
    name: String,
    /// Its stiffness, N/m.
    #[arg(long, value_name = "N/m", value_parser = positive)]
    stiffness: Option<f64>,
    /// Its damping, N·s/m.
    #[arg(long, value_name = "N·s/m", default_value_t = 0.0, requires = "stiffness", value_parser = not_negative)]
    damping: f64,
    /// Its kinetic coefficient of friction.
    #[arg(long, default_value_t = 0.0, requires = "stiffness", value_parser = not_negative)]
    mu: f64,
}

#[derive(Clone, Copy, clap::ValueEnum)]
pub(crate) enum Axis {
    Y,
    Z,
}

impl From<Axis> for Up {
    fn from(axis: Axis) -> Self {
        match axis {
            Axis::Y => Self::Y,
            Axis::Z => Self::Z,
        }
    }
}

impl Surface {
    pub(crate) fn chosen(&self) -> Option<DefaultSurface> {
        let Self { name, stiffness, damping, mu } = self;
        stiffness.map(|stiffness| DefaultSurface {
            name: name.clone(),
            stiffness,
            damping: *damping,
            mu: *mu,
        })
    }
}

/// Units of length and their metres.
const LENGTHS: [(&str, f64); 8] = [
    ("um", 1e-6),
    ("µm", 1e-6),
    ("mm", 1e-3),
    ("cm", 1e-2),
    ("in", 0.0254),
    ("ft", 0.3048),
    ("km", 1e3),
    ("m", 1.0),
];

/// Parses a length above zero, in metres unless a unit follows.
pub(crate) fn length_m(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let unit = LENGTHS.iter().find(|(unit, _)| text.ends_with(unit));
    let (digits, metres) = unit.map_or((text, 1.0), |(unit, metres)| (text.trim_end_matches(unit), *metres));
    let value: f64 = match digits.trim() {
        "" => 1.0,
        digits => digits.parse().map_err(|_| format!("`{text}` is no length: write 0.005, 5mm or 0.2in"))?,
    };
    // Divides for decimal units, so that 5 mm is the number nearest to 0.005.
    let length = if metres < 0.02 { value / (1.0 / metres).round() } else { value * metres };
    if length > 0.0 && length.is_finite() { Ok(length) } else { Err("it must be above zero".to_owned()) }
}

pub(crate) fn positive(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| format!("`{text}` is no number"))?;
    if value > 0.0 { Ok(value) } else { Err("it must be above zero".to_owned()) }
}

fn not_negative(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| format!("`{text}` is no number"))?;
    if value >= 0.0 && value.is_finite() { Ok(value) } else { Err("it must not be negative".to_owned()) }
}

impl Mesh {
    /// Options of every command that makes a model of a mesh.
    pub(crate) fn options(&self) -> Options {
        let (name, surface) = (self.name.clone(), self.surface.chosen());
        Options { name, surface, marked: self.marked, ..self.file.options() }
    }
}

impl MeshFile {
    /// Options of every command that reads a mesh.
    pub(crate) fn options(&self) -> Options {
        Options {
            up: self.up.map(Up::from),
            unit_m: self.unit,
            scene: self.scene.clone(),
            weld_m: self.weld,
            outward: self.outward,
            close: self.close,
            triangles_max: self.triangles_max,
            allowed: self.allowed.folders.clone(),
            ..Options::default()
        }
    }
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let options = Options {
        root: arguments.root.clone(),
        faces_max: arguments.faces_max,
        inline_max: arguments.mesh_files.unwrap_or(usize::MAX),
        round_m: arguments.round,
        hull: arguments.hull.then_some(pong_decompose::hull_of_mesh),
        ..arguments.mesh.options()
    };
    let bar = progress(None, SPINNER, false);
    let result =
        pong_import::import(&arguments.mesh.file.input, &arguments.mesh.output, &options, &mut |what| {
            show(&bar, what)
        });
    bar.finish_and_clear();
    let imported = result.map_err(|findings| nothing_written(&findings))?;
    imported.findings.notes.iter().for_each(|note| tell(format!("note: {note}")));
    print(&summary(&imported));
    Ok(ExitCode::SUCCESS)
}

/// Error of a refused mesh.
pub(crate) fn nothing_written(findings: &Findings) -> Failure {
    let faults = count(findings.faults.len(), "fault", "faults");
    format!("{findings}\n{faults}; nothing was written").into()
}

fn summary(imported: &Imported) -> String {
    let kinds: Vec<String> =
        imported.primitives.iter().map(|(kind, number)| format!("{number} {kind}")).collect();
    let read = format!(
        "{} and {} read: {}\n",
        count(imported.vertices, "vertex", "vertices"),
        count(imported.triangles, "triangle", "triangles"),
        kinds.join(", ")
    );
    imported.files.iter().fold(read, |text, file| text + &format!("written: {}\n", file.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_take_units() {
        for (text, metres) in [
            ("5mm", 0.005),
            ("0.005", 0.005),
            ("1 in", 0.0254),
            ("mm", 0.001),
            ("2m", 2.0),
            ("1e-6", 1e-6),
            ("3um", 3e-6),
        ] {
            assert_eq!(length_m(text), Ok(metres), "{text}");
        }
        for text in ["0", "-1mm", "five", "inf", "3 parsecs"] {
            assert!(length_m(text).is_err(), "{text}");
        }
    }
}
