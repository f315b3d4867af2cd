//! What one face would feel if everything that can press on it did: springs in parallel add.

use super::named::Named;
use crate::text::{count, number};
use pong_engine::{Laws, NormalProps, combine_surfaces};
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Exponent, Model, MovableGroup, Surface, pair_entries, printable};
use std::collections::BTreeMap;

/// How many are told; the softer ones are only counted.
const LISTED: usize = 10;

/// Points and segments of one body that have one surface.
struct Group {
    surface: u32,
    points: usize,
    segments: usize,
}

/// A kind of face and the sum of all springs that can press on one of them at once.
pub(super) struct FacePressed {
    stiffness: f64,
    unit: &'static str,
    /// Who presses on what.
    told: String,
}

/// The stiffest faces first.
pub(super) fn lines(mut faces: Vec<FacePressed>) -> String {
    faces.sort_by(|a, b| b.stiffness.total_cmp(&a.stiffness));
    let line = |face: &FacePressed| {
        format!("  up to {} {} on one face: {}\n", number(face.stiffness), face.unit, face.told)
    };
    let mut text: String = faces.iter().take(LISTED).map(line).collect();
    if faces.len() > LISTED {
        text += &format!(
            "  and {} that are no stiffer\n",
            count(faces.len() - LISTED, "kind of face", "kinds of faces")
        );
    }
    text
}

/// Points and segments of body A that press on the faces of body B: one entry for each surface of faces.
pub(super) fn faces_pressed(
    (a, body_a): (&Named, &MovableGroup),
    (b, body_b): (&Named, &MovableGroup),
) -> Vec<FacePressed> {
    let pressing = pressing(body_a);
    if pressing.is_empty() {
        return Vec::new();
    }
    let points: usize = pressing.iter().map(|group| group.points).sum();
    let segments: usize = pressing.iter().map(|group| group.segments).sum();
    let mut found = Vec::new();
    for (surface, kind) in faces(body_b) {
        let face_surface = &b.model.surfaces[surface as usize];
        let (stiffness, unit) = sum(&pressing, &a.model, &b.model, face_surface);
        let told = format!(
            "all {} of {}:{} on a {kind} (`{}`) of {}:{}",
            told(points, segments),
            a.name,
            body_a.path,
            face_surface.name,
            b.name,
            body_b.path,
        );
        found.push(FacePressed { stiffness, unit, told: printable(&told).into_owned() });
    }
    found
}

fn sum(pressing: &[Group], model_a: &Model, model_b: &Model, face: &Surface) -> (f64, &'static str) {
    let mut sum = 0.0;
    let mut unit = "N/m";
    for group in pressing {
        let surface = &model_a.surfaces[group.surface as usize];
        let Some((stiffness, hertz)) = pair_stiffness(model_a, surface, model_b, face) else { continue };
        // Lying flat, both halves of a segment press.
        sum += stiffness * (group.points + group.segments) as f64;
        unit = if hertz { "N/m^1.5" } else { unit };
    }
    (sum, unit)
}

fn told(points: usize, segments: usize) -> String {
    let points = (points > 0).then(|| count(points, "point", "points"));
    let segments = (segments > 0).then(|| count(segments, "segment", "segments"));
    points.into_iter().chain(segments).collect::<Vec<_>>().join(" and ")
}

fn pressing(body: &MovableGroup) -> Vec<Group> {
    let mut by_surface: BTreeMap<u32, Group> = BTreeMap::new();
    for info in &body.primitives {
        let surface = info.surface;
        let (points, segments) = match info.kind {
            PrimitiveKind::Point => (1, 0),
            PrimitiveKind::LineSegment => (0, 1),
            _ => continue,
        };
        let group = by_surface.entry(surface).or_insert(Group { surface, points: 0, segments: 0 });
        group.points += points;
        group.segments += segments;
    }
    by_surface.into_values().collect()
}

/// Surfaces of planes and polyhedra, each once.
fn faces(body: &MovableGroup) -> BTreeMap<u32, &'static str> {
    let flat = |kind| matches!(kind, PrimitiveKind::Plane | PrimitiveKind::Polyhedron);
    body.primitives
        .iter()
        .filter(|info| flat(info.kind))
        .map(|info| (info.surface, info.kind.name()))
        .collect()
}

/// Stiffness of a pair, and whether it goes with the power 3/2. `None` cannot be combined, which sealing tells.
fn pair_stiffness(model_a: &Model, a: &Surface, model_b: &Model, b: &Surface) -> Option<(f64, bool)> {
    let entry = pair_entries((model_a, a), (model_b, b)).first().map(|(_, entry)| *entry);
    let props = combine_surfaces(a, b, entry, &Laws::default()).ok()?;
    let hertz = matches!(props.normal, NormalProps::HuntCrossley { exponent: Exponent::ThreeHalves, .. });
    Some((props.stiffness, hertz))
}
