//! Decomposition of a closed mesh into a group of convex polyhedra, with figures of the deviation.
//!
//! `solids` (a file to closed meshes), `by_vhacd` (cuts by `flats` and `cells`, `content` between them),
//! `fitted` (cuts where pieces protrude) or `coacd`, `piece` (hulls), `join`, `walls` with `regions` and
//! `seams` (internal faces), `measure` (deviation from the source). `mass`: volume, mass and inertia of
//! closed meshes.

#![forbid(unsafe_code)]

mod by_vhacd;
mod cells;
mod coacd;
mod content;
mod fitted;
mod flats;
mod hulls;
mod inside;
mod join;
mod mass;
mod measure;
mod options;
mod piece;
mod polygon;
mod regions;
mod seams;
mod solids;
mod sound;
mod walls;

pub use mass::{Mass, MassProperties, mass_properties};
pub use measure::{Deviation, Distances};
pub use options::{DecomposeOptions, Method};

use hulls::{hulls_of, tell_flat};
use inside::Solid;
use nalgebra::Vector3;
use piece::{Piece, hull};
use pong_import::build::{self, Building};
use pong_import::mesh::{self, Mesh};
use pong_import::model::{Field, Group, Model, Primitive, field};
use pong_import::source;
use pong_import::{DefaultSurface, Findings, files, write};
use pong_model::Extensions;
use seams::Pool;
use solids::SolidMesh;
use std::path::{Path, PathBuf};

/// Pieces this close to each other (in sizes of the whole) are neighbours; smaller overlaps are ignored.
const NEAR_SHARE: f64 = 1e-7;
/// CoACD's vertices within this share of the size are merged.
const SETTLED_SHARE: f64 = 3e-4;

/// The figures of a decomposition.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Distinct vertices read.
    pub vertices: usize,
    /// Triangles read.
    pub triangles: usize,
    /// Convex pieces.
    pub pieces: usize,
    /// True if every connected part was convex and became one piece.
    pub exact: bool,
    /// Faces of all pieces.
    pub faces: usize,
    /// Internal faces among them.
    pub inactive_faces: usize,
    /// Sum of the pieces' volumes, m³.
    pub volume_m3: f64,
    /// Volume of the source, m³.
    pub source_volume_m3: f64,
    /// Length of the source's diagonal, m.
    pub size_m: f64,
    /// Deviation of the pieces from the source.
    pub deviation: Deviation,
}

/// Outcome of a decomposition.
#[derive(Clone, Debug)]
pub struct Decomposed {
    /// Figures, if the decomposition got that far.
    pub report: Option<Report>,
    /// The model file; empty if there are faults.
    pub files: Vec<PathBuf>,
    /// Faults and notes; the loader's warnings are among them.
    pub findings: Findings,
}

/// Decomposes a mesh file into convex pieces and writes them as a model to `output`.
///
/// `progress` is called with the current activity. The engine's loader reads the model back before it is
/// moved into place; after a fault nothing is written. Bad input, a decomposer that gives up and a protrusion
/// or deficit above `within_m` are faults.
pub fn decompose(
    input: &Path,
    output: &Path,
    options: &DecomposeOptions,
    progress: &mut dyn FnMut(&str),
) -> Decomposed {
    let mut findings = Findings::default();
    let mut report = None;
    let files = attempt(input, output, options, progress, &mut report, &mut findings).unwrap_or_default();
    Decomposed { report, files, findings }
}

fn attempt(
    input: &Path,
    output: &Path,
    options: &DecomposeOptions,
    progress: &mut dyn FnMut(&str),
    report: &mut Option<Report>,
    findings: &mut Findings,
) -> Option<Vec<PathBuf>> {
    let file = input.display().to_string();
    options.check(&file, findings)?;
    progress("reading");
    let source = source::read(input, &options.import.reading(), findings)?;
    let building = options.import.building(input, progress);
    let shape = solids::flatten(source, &building, findings);
    let (vertices, triangles) = (shape.vertices.len(), shape.triangles.len());
    let solids = solids::solids(shape, &building, findings)?;
    let whole = whole(&solids);
    let (pieces, exact) = pieces(&solids, options, &building.file, building.progress, findings)?;
    (building.progress)("measuring");
    let solid = Solid::new(&whole)?;
    let deviation = measure::deviation(&whole, &solid, &pieces, options.samples)?;
    let figures = Report {
        vertices,
        triangles,
        pieces: pieces.len(),
        exact,
        faces: pieces.iter().map(|piece| piece.faces.len()).sum(),
        inactive_faces: pieces.iter().flat_map(|piece| &piece.inactive).filter(|inactive| **inactive).count(),
        volume_m3: pieces.iter().map(|piece| piece.volume_m3).sum(),
        source_volume_m3: mesh::volume_m3(&whole),
        size_m: whole.size_m(),
        deviation,
    };
    *report = Some(figures.clone());
    tell_protrusion(&figures, options, &building.file, findings);
    within(&figures, options, &building.file, findings)?;
    (building.progress)("writing");
    let mut model = model(pieces, &building, &figures);
    build::default_surface(&mut model, &building, findings);
    model.root.contact = (!options.import.marked).then_some("Solid");
    let text = write::text(&model);
    model.root.contact = None;
    let instead = || (!options.import.marked).then(|| write::text(&model));
    files::write_checked_or(output, text, instead, Vec::new(), findings)
}

/// Protrusions of more than this share of the size are reported.
const TOLD_SHARE: f64 = 0.01;

/// A body in front of the mesh would touch a protruding piece before the mesh itself.
fn tell_protrusion(figures: &Report, options: &DecomposeOptions, file: &str, findings: &mut Findings) {
    let protrusion_m = figures.deviation.protrusion.max_m;
    let share = protrusion_m / figures.size_m;
    if share <= TOLD_SHARE {
        return;
    }
    let voxel = match options.method {
        Method::Vhacd if options.fit_m.is_some() => String::new(),
        Method::Vhacd => {
            let voxel_m = figures.size_m / f64::from(options.resolution.unwrap_or(100));
            format!("; walls and gaps thinner than a voxel, about {voxel_m:.1e} m, are not seen")
        }
        Method::Coacd(_) => String::new(),
    };
    let cause = format!(
        "at its worst place a piece protrudes {protrusion_m:.2e} m, {:.1} % of the mesh's size{voxel}",
        100.0 * share
    );
    let cure = "--fit LENGTH cuts where pieces protrude by more; a larger --resolution and a smaller --concavity follow the mesh closer; --within refuses what protrudes more";
    findings.note(file, "protrusion", cause, cure);
}

fn whole(solids: &[SolidMesh]) -> Mesh {
    let mut whole = Mesh::default();
    solids.iter().for_each(|solid| whole.append(&solid.mesh));
    whole
}

/// Pieces of all solids with their internal faces, and whether all solids were convex.
fn pieces(
    solids: &[SolidMesh],
    options: &DecomposeOptions,
    file: &str,
    progress: &mut dyn FnMut(&str),
    findings: &mut Findings,
) -> Option<(Vec<Piece>, bool)> {
    let size_m = whole(solids).size_m();
    let mut pool = Pool::new(size_m);
    let mut all = Vec::new();
    let mut exact = true;
    let share = (options.pieces_max / solids.len()).max(1);
    for (number, solid) in solids.iter().enumerate() {
        let convex = if solid.hollow { None } else { mesh::polyhedron(&solid.mesh, usize::MAX).ok() };
        if let Some(polyhedron) = convex {
            all.push(pool.canonical(Piece::new(polyhedron)));
            continue;
        }
        exact = false;
        progress(&format!("cutting solid {} of {}", number + 1, solids.len()));
        solid.mesh.vertices.iter().for_each(|place| _ = pool.place(*place));
        let near_m = NEAR_SHARE * size_m;
        let (parts, forced) = match &options.method {
            Method::Vhacd => {
                let cutting = format!("cutting solid {} of {}", number + 1, solids.len());
                let mut told = |what: &str| progress(&format!("{cutting}: {what}"));
                match options.fit_m {
                    Some(fit_m) => {
                        let fitting = fitted::Fitting { fit_m, pieces_max: share, near_m };
                        fitted::pieces(solid, &fitting, &mut pool, file, &mut told, findings)?
                    }
                    None => {
                        let limits = (share, near_m);
                        by_vhacd::pieces(solid, options, limits, &mut pool, file, &mut told, findings)?
                    }
                }
            }
            Method::Coacd(python) => {
                let calling = coacd::Calling {
                    python,
                    threshold: options.concavity.unwrap_or(0.05),
                    pieces_max: share,
                    resolution: options.resolution.unwrap_or(2000),
                };
                let hulls = coacd::hulls(&solid.mesh, &calling, file, findings)?;
                let hulls = settled(hulls, &solid.mesh, size_m);
                let (mut parts, flat) = findings.ok(hulls_of(hulls, &mut pool, file))?;
                tell_flat(flat, file, findings);
                let forced = join::join(&mut parts, share, near_m);
                (parts, forced)
            }
        };
        if forced > 0 {
            let cause = format!("pieces were joined {forced} times to keep to {} pieces", options.pieces_max);
            findings.note(file, "joined", cause, "--pieces-max allows more");
        }
        all.extend(parts);
    }
    if all.len() > options.pieces_max {
        let cause = format!("{} pieces: fewer would have to overlap", all.len());
        findings.note(file, "many-pieces", cause, "a larger --concavity gives fewer");
    }
    tell_changes(sound::make(&mut all, size_m, &is_accepted), file, findings);
    progress("finding inner walls");
    let walls = walls::mark(&mut all, options.pieces_max, size_m, &is_accepted);
    tell_walls(&walls, &all, size_m, file, findings);
    Some((all, exact))
}

/// The convex hull of a mesh and how far its deepest vertex lies within it, m; `None` if it has no thickness.
pub fn hull_of_mesh(mesh: &Mesh) -> Option<(mesh::Polyhedron, f64)> {
    let piece = hull(&mesh.vertices).ok()?;
    let depth = |place: &Vector3<f64>| {
        piece.planes.iter().map(|plane| -plane.height(place)).fold(f64::INFINITY, f64::min).max(0.0)
    };
    let deepest_m = mesh.vertices.iter().map(depth).fold(0.0, f64::max);
    let look = mesh.look_of.first().copied().unwrap_or(0);
    let look_of = vec![look; piece.faces.len()];
    Some((mesh::Polyhedron { vertices: piece.vertices, faces: piece.faces, look_of }, deepest_m))
}

/// Moves CoACD's vertices (off by about 1e-4 of the size) back to those of the mesh, and near neighbours onto
/// each other.
fn settled(hulls: Vec<Vec<Vector3<f64>>>, mesh: &Mesh, size_m: f64) -> Vec<Vec<Vector3<f64>>> {
    let mut pool = Pool::within(SETTLED_SHARE * size_m);
    mesh.vertices.iter().for_each(|place| pool.add(*place));
    hulls.into_iter().map(|hull| hull.into_iter().map(|place| pool.place(place)).collect()).collect()
}

fn tell_changes(changes: sound::Changes, file: &str, findings: &mut Findings) {
    let sound::Changes { flat, welded, welded_m } = changes;
    if flat > 0 {
        let cause = format!("{flat} vertices that stand out by next to nothing were left out");
        findings.note(file, "simplified", cause, "");
    }
    if welded > 0 {
        let cause = format!("vertices of {welded} pieces within {welded_m:.1e} m of each other became one");
        findings.note(file, "simplified", cause, "another --resolution may do without");
    }
}

fn tell_walls(walls: &walls::Walls, pieces: &[Piece], size_m: f64, file: &str, findings: &mut Findings) {
    if walls.part_covered > 0 {
        let cause = format!("{} faces are covered in part and stay active as a whole", walls.part_covered);
        let cure = "a seam may be felt there: --pieces-max allows more cuts, or author these pieces by hand";
        findings.note(file, "part-covered", cause, cure);
    }
    let deep = |a: usize, b: usize| pieces[a].overlaps(&pieces[b], 1e-6 * size_m);
    let overlaps = (0..pieces.len()).flat_map(|a| (a + 1..pieces.len()).map(move |b| (a, b)));
    let overlaps: Vec<(usize, usize)> = overlaps.filter(|&(a, b)| deep(a, b)).collect();
    if let Some((a, b)) = overlaps.first() {
        let cause = format!("{} pairs of pieces overlap, the first piece_{a} and piece_{b}", overlaps.len());
        findings.note(file, "overlap", cause, "what touches both there is pushed twice");
    }
}

/// Refuses a deviation above `within_m`.
fn within(report: &Report, options: &DecomposeOptions, file: &str, findings: &mut Findings) -> Option<()> {
    let Some(limit_m) = options.within_m else { return Some(()) };
    let Deviation { protrusion, deficit, inner_deficit_m, .. } = &report.deviation;
    let at = |place: &[f64; 3]| solids::named(&Vector3::from(*place));
    if protrusion.max_m > limit_m {
        let cause = format!(
            "the pieces protrude by {:.3e} m at {}, more than {limit_m} m",
            protrusion.max_m,
            at(&protrusion.at)
        );
        let cure = "cut by --fit with the same length, raise --pieces-max, or author the pieces by hand";
        findings.fault(file, "protrusion", cause, cure);
    }
    let missing_m = deficit.max_m.max(*inner_deficit_m);
    if missing_m > limit_m {
        let cause = format!(
            "{missing_m:.3e} m of the source are uncovered near {}, more than {limit_m} m",
            at(&deficit.at)
        );
        let cure =
            "raise --resolution and --pieces-max, or use --method vhacd, which leaves next to nothing out";
        findings.fault(file, "deficit", cause, cure);
    }
    let bound_m = protrusion.bound_m.max(deficit.bound_m);
    if findings.faults.is_empty() && bound_m > limit_m {
        let cause =
            format!("nothing beyond {limit_m} m was found, but up to {bound_m:.3e} m cannot be ruled out");
        findings.note(file, "not-ruled-out", cause, "--samples looks closer");
    }
    findings.faults.is_empty().then_some(())
}

fn model(pieces: Vec<Piece>, building: &Building<'_>, report: &Report) -> Model {
    let mut root = Group { name: building.name.clone(), ..Group::default() };
    for (number, piece) in pieces.into_iter().enumerate() {
        root.primitives.push(primitive(format!("piece_{number}"), piece));
    }
    let Deviation { protrusion, deficit, inner_deficit_m, .. } = &report.deviation;
    let comment = format!(
        "Convex pieces of a mesh: they protrude by up to {:.2e} m and leave up to {:.2e} m uncovered.",
        protrusion.max_m,
        deficit.max_m.max(*inner_deficit_m)
    );
    Model {
        comment: vec![comment],
        name: building.name.clone(),
        entry_memory: true,
        root,
        ..Model::default()
    }
}

fn primitive(name: String, piece: Piece) -> Primitive {
    let inactive: Vec<usize> = (0..piece.faces.len()).filter(|&face| piece.inactive[face]).collect();
    let mut fields = Vec::new();
    if !inactive.is_empty() {
        fields.push(field("inactive_faces", Field::Indices(inactive)));
    }
    fields.push(field("vertices", Field::Vertices(piece.vertices)));
    fields.push(field("faces", Field::Faces(piece.faces)));
    Primitive { kind: "Polyhedron", name, surface: None, fields }
}

/// Tests whether the engine's loader accepts a piece unchanged.
fn is_accepted(piece: &Piece) -> bool {
    let surface = DefaultSurface { name: "any".to_owned(), stiffness: 1.0, damping: 0.0, mu: 0.0 };
    let root = Group {
        name: "piece".to_owned(),
        surface: Some(surface.name.clone()),
        primitives: vec![primitive("piece".to_owned(), piece.clone())],
        ..Group::default()
    };
    let surfaces = vec![(surface.name.clone(), surface.record())];
    let model = Model { name: "piece".to_owned(), entry_memory: true, surfaces, root, ..Model::default() };
    pong_model::parse(&write::text(&model), "piece", None, &Extensions::new()).is_ok()
}
