//! Making a page from a log.

use crate::ViewError;
use crate::blob::{Blob, Column};
use crate::html;
use crate::origin::Origin;
use crate::shape::Shape;
use crate::tables::{ContactColumns, FrameColumns, Frames};
use crate::thin::Thinning;
use pong_model::{Extensions, Model};
use pong_record::{Log, Run, RunModel};
use serde::Serialize;
use std::path::PathBuf;

/// Options of a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Keeps only every n-th frame (and the last); `None`: as many as fit the budget.
    pub every: Option<u64>,
    /// Most bytes of the frames before packing. Ignored if `every` is given.
    pub budget: u64,
}

impl Default for Options {
    /// All frames, up to 64 MB.
    fn default() -> Self {
        Self { every: None, budget: 64_000_000 }
    }
}

/// A page and its contents.
#[derive(Clone, Debug)]
pub struct Page {
    /// The text of the HTML file.
    pub html: String,
    /// Frames in the log.
    pub frames_in_log: u64,
    /// Frames in the page.
    pub frames: u64,
    /// Stride of the frames in the page.
    pub every: u64,
    /// Contacts in the page.
    pub contacts: u64,
    /// Distinct triangles in the page.
    pub triangles: u64,
    /// Size of the frames' data before packing, and of all data after it, bytes.
    pub data_bytes: [u64; 2],
    /// Notes to the reader about the page's limits.
    pub notes: Vec<String>,
}

/// Data of the page other than numbers.
#[derive(Serialize)]
struct Description<'a> {
    name: &'a str,
    writer: &'a str,
    engine: &'a str,
    step: Option<f64>,
    integrator: Option<&'a str>,
    finished: bool,
    lost: u64,
    every: u64,
    frames_in_log: u64,
    notes: &'a [String],
    /// Horizontal axis: `time`, or `frame` where times do not increase.
    axis: &'static str,
    /// The body that the origin moves with.
    origin_body: Option<usize>,
    /// Origin: one position, or one for each frame; m.
    origin: Column,
    objects: Vec<&'a str>,
    bodies: Vec<BodyDescription<'a>>,
    primitives: Vec<[usize; 2]>,
    shapes: Vec<Shape>,
    frames: FrameColumns,
    contacts: ContactColumns,
}

#[derive(Serialize)]
struct BodyDescription<'a> {
    name: &'a str,
    object: usize,
    shape: usize,
    parent: Option<usize>,
}

/// Makes the page of a log. `extensions` are the kinds of primitives that its models name.
///
/// # Errors
/// A log or a model that cannot be read, a model that is not the one of the run, a log without frames.
pub fn page(log: &mut Log, options: &Options, extensions: &Extensions) -> Result<Page, ViewError> {
    let rows = log.frame_rows(0, log.frame_count())?;
    if rows.is_empty() {
        return Err(ViewError::Empty(log.folder().to_owned()));
    }
    let run = log.run().clone();
    let thinning = Thinning::choose(&rows, run.bodies.len(), options.every, options.budget);
    let frames = Frames::read(log, &thinning)?;

    let mut blob = Blob::default();
    let looks = Looks::new(log, &run, extensions, &mut blob)?;
    let radii: Vec<f64> = looks.of_body.iter().map(|&shape| looks.shapes[shape].radius()).collect();
    let origin = Origin::choose(&frames.places(), &radii);
    let triangles = looks.shapes.iter().map(|shape| shape.triangle_count() as u64).sum();
    let mut notes = notes(log, &run, &frames, &thinning, &origin);
    notes.extend(looks.changed.iter().map(|name| {
        format!("The model {name} is not the one of the run: its hash is another, what is drawn may be wrong")
    }));
    let before_frames = blob.len();
    let description = Description {
        name: &run.name,
        writer: &run.writer,
        engine: &run.engine,
        step: run.step,
        integrator: run.integrator.as_deref(),
        finished: log.is_whole(),
        lost: run.lost,
        every: thinning.every,
        frames_in_log: thinning.frames,
        notes: &notes,
        axis: if frames.times_increase() { "time" } else { "frame" },
        origin_body: match origin {
            Origin::Fixed(_) => None,
            Origin::With(body, _) => Some(body),
        },
        origin: match &origin {
            Origin::Fixed(place) => blob.f64s(place.iter().copied()),
            Origin::With(_, places) => blob.f64s(places.iter().flat_map(|p| [p.x, p.y, p.z])),
        },
        objects: run.objects.iter().map(|object| object.name.as_str()).collect(),
        bodies: bodies(&run, &looks.of_body),
        primitives: looks.primitives,
        shapes: looks.shapes,
        frames: frames.columns(&origin, &mut blob),
        contacts: frames.contact_columns(&origin, &mut blob),
    };
    let data = blob.packed().map_err(ViewError::Packing)?;
    Ok(Page {
        html: html::page(&run.name, &html::json(&description), &data),
        frames_in_log: thinning.frames,
        frames: frames.rows.len() as u64,
        every: thinning.every,
        contacts: frames.contact_count() as u64,
        triangles,
        data_bytes: [(blob.len() - before_frames) as u64, data.len() as u64],
        notes,
    })
}

fn bodies<'a>(run: &'a Run, shapes: &[usize]) -> Vec<BodyDescription<'a>> {
    let describe = |(body, &shape): (&'a pong_record::RunBody, &usize)| BodyDescription {
        name: &body.name,
        object: body.object,
        shape,
        parent: body.parent,
    };
    run.bodies.iter().zip(shapes).map(describe).collect()
}

/// Notes to the reader about data that the page does not show.
fn notes(log: &Log, run: &Run, frames: &Frames, thinning: &Thinning, origin: &Origin) -> Vec<String> {
    let mut notes = Vec::new();
    if thinning.every > 1 {
        notes.push(format!(
            "Thinned: every {}th frame is shown, {} of {}; the plots show the peaks of all of them",
            thinning.every,
            frames.rows.len(),
            thinning.frames
        ));
    }
    if !log.is_whole() {
        notes.push("The log was cut off: it is shown as far as it was written".to_owned());
    }
    if run.lost > 0 {
        notes.push(format!("{} frames were lost while the log was written", run.lost));
    }
    if frames.rows.iter().any(|row| row.flags != 0) {
        notes.push(
            "In some frames contacts were left out or missed: the frame's header marks them".to_owned(),
        );
    }
    if !frames.times_increase() {
        notes.push("The times of the frames do not always increase: the run is played by frames".to_owned());
    }
    if let Origin::With(body, _) = origin {
        notes.push(format!("The view travels with {}", run.bodies[*body].name));
    }
    notes
}

/// The shapes of a run, and their assignment to bodies.
struct Looks {
    shapes: Vec<Shape>,
    /// Index of the shape of each body.
    of_body: Vec<usize>,
    /// Movable group and index of the part in its shape, for each primitive of the log.
    primitives: Vec<[usize; 2]>,
    /// Models whose hash differs from the one in the log.
    changed: Vec<String>,
}

impl Looks {
    fn new(log: &Log, run: &Run, extensions: &Extensions, blob: &mut Blob) -> Result<Self, ViewError> {
        let mut files = Vec::new();
        for index in 0..run.models.len() {
            let path = log.model_path(index).unwrap_or_default();
            files.push((pong_model::load(&path, extensions).map_err(ViewError::Model)?, path));
        }
        let is_changed = |(model, logged): &(&(Model, PathBuf), &RunModel)| model.0.hash != logged.hash;
        let changed = files.iter().zip(&run.models).filter(is_changed).map(|(model, _)| model.0.name.clone());
        let changed = changed.collect();
        let mut looks = Self { shapes: Vec::new(), of_body: Vec::new(), primitives: Vec::new(), changed };
        let mut known = Vec::new();
        for body in &run.bodies {
            let key = (run.objects[body.object].model, body.path.as_str());
            let shape = known.iter().position(|other| *other == key);
            looks.of_body.push(shape.unwrap_or(known.len()));
            if shape.is_none() {
                known.push(key);
                looks.shapes.push(shape_of(&files[key.0], body.path.as_str(), blob)?);
            }
        }
        for primitive in &run.primitives {
            let shape = looks.of_body[primitive.body];
            let Some(part) = looks.shapes[shape].part(&primitive.path) else {
                return Err(foreign(&files[known[shape].0].1, "primitive", &primitive.path));
            };
            looks.primitives.push([primitive.body, part]);
        }
        Ok(looks)
    }
}

fn shape_of((model, file): &(Model, PathBuf), path: &str, blob: &mut Blob) -> Result<Shape, ViewError> {
    let Some(body) = model.bodies.iter().find(|body| body.path == path) else {
        return Err(foreign(file, "movable group", path));
    };
    Ok(Shape::new(body, &model.surfaces, blob))
}

fn foreign(file: &std::path::Path, what: &str, path: &str) -> ViewError {
    ViewError::Foreign {
        model: file.to_owned(),
        cause: format!("it has no {what} `{path}`, which the log names"),
    }
}
