//! `pong decompose`: a closed mesh becomes convex pieces.

use crate::import::{Mesh, length_m, nothing_written};
use crate::terminal::{Outcome, SPINNER, print, progress, show, tell};
use crate::text::{count, number};
use pong_decompose::{DecomposeOptions, Decomposed, Method, Report};
use pong_report::table;
use std::process::ExitCode;

/// Makes a group of convex polyhedra of a closed mesh that need not be convex: glTF (.glb, .gltf),
/// Collada (.dae), OBJ or STL.
///
/// Faces between the pieces are marked inactive. Prints how far the pieces protrude from the mesh and how
/// much of it they leave uncovered. docs/importing.md explains the figures, and when to model by hand
/// instead.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    mesh: Mesh,
    /// Refuses a result that protrudes, or leaves uncovered, more than this: 0.5mm.
    #[arg(long, value_name = "LENGTH", value_parser = length_m)]
    within: Option<f64>,
    /// Cuts where pieces protrude by more than this, as long as --pieces-max allows it, instead of by voxels: 1mm keeps holes
    /// wider than 2 mm.
    #[arg(long, value_name = "LENGTH", value_parser = length_m)]
    fit: Option<f64>,
    /// Most pieces.
    #[arg(long, value_name = "PIECES", default_value_t = 64, value_parser = at_least_one)]
    pieces_max: usize,
    /// Most volume by which pieces may exceed the mesh, as a share of the whole hull's volume [default:
    /// 0.005]; with CoACD its threshold [default: 0.05].
    #[arg(long, value_name = "SHARE")]
    concavity: Option<f64>,
    /// Voxels along the longest side [default: 100]; with CoACD samples on the surface [default: 2000].
    #[arg(long, value_name = "COUNT")]
    resolution: Option<u32>,
    /// Method of finding the cuts: VHACD is built in, CoACD is a Python package.
    #[arg(long, value_enum, default_value = "vhacd")]
    method: Finder,
    /// The Python interpreter that has CoACD.
    #[arg(long, value_name = "PROGRAM", default_value = "python3")]
    python: String,
    /// Number of points measured on each surface, and in the volume.
    #[arg(long, value_name = "COUNT", default_value_t = 30_000, value_parser = at_least_one)]
    samples: usize,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Finder {
    Vhacd,
    Coacd,
}

fn at_least_one(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(0) | Err(_) => Err("it must be a whole number above zero".to_owned()),
        Ok(number) => Ok(number),
    }
}

pub(crate) fn main(arguments: &Arguments) -> Outcome {
    let options = DecomposeOptions {
        import: arguments.mesh.options(),
        method: match arguments.method {
            Finder::Vhacd => Method::Vhacd,
            Finder::Coacd => Method::Coacd(arguments.python.clone()),
        },
        resolution: arguments.resolution,
        concavity: arguments.concavity,
        fit_m: arguments.fit,
        pieces_max: arguments.pieces_max,
        within_m: arguments.within,
        samples: arguments.samples,
    };
    let bar = progress(None, SPINNER, false);
    let done = pong_decompose::decompose(
        &arguments.mesh.file.input,
        &arguments.mesh.output,
        &options,
        &mut |what| show(&bar, what),
    );
    bar.finish_and_clear();
    let Decomposed { report, files, findings } = done;
    if let Some(report) = &report {
        print(&summary(report));
    }
    if !findings.faults.is_empty() {
        return Err(nothing_written(&findings));
    }
    findings.notes.iter().for_each(|note| tell(format!("note: {note}")));
    files.iter().for_each(|file| print(&format!("written: {}\n", file.display())));
    Ok(ExitCode::SUCCESS)
}

fn summary(report: &Report) -> String {
    let deviation = &report.deviation;
    let exactly = if report.exact { ", exact: the source is convex" } else { "" };
    let counts = format!(
        "{} and {} read: {}{exactly}\n{}, {} of them inactive\n",
        count(report.vertices, "vertex", "vertices"),
        count(report.triangles, "triangle", "triangles"),
        count(report.pieces, "piece", "pieces"),
        count(report.faces, "face", "faces"),
        report.inactive_faces,
    );
    let percent = |share: f64| format!("{} %", number(100.0 * share));
    let volume = format!(
        "volume: {} m³, {} of the source's {} m³\n",
        number(report.volume_m3),
        percent(report.volume_m3 / report.source_volume_m3),
        number(report.source_volume_m3)
    );
    let row = |name: &str, side: &pong_decompose::Distances, inner_m: f64, share: f64| {
        vec![
            name.to_owned(),
            number(side.max_m.max(inner_m)),
            number(side.bound_m.max(inner_m)),
            number(side.mean_m),
            percent(side.area_share),
            percent(share),
        ]
    };
    let rows = [
        row("protrusion", &deviation.protrusion, 0.0, deviation.protruding_share),
        row("deficit", &deviation.deficit, deviation.inner_deficit_m, deviation.deficit_share),
    ];
    counts + &volume + &table::aligned(&["", "max m", "at most m", "mean m", "of area", "of volume"], &rows)
}
