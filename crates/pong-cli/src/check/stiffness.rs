//! Stiffness of one face under every primitive that can press on it: springs in parallel add.

use super::named::Named;
use crate::text::{count, number};
use pong_engine::{Laws, combine_surfaces, has_tester};
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Exponent, Model, MovableGroup, PrimitiveInfo, Surface, pair_entries, printable};
use std::collections::{BTreeMap, BTreeSet};

/// Number of faces listed; the softer ones are only counted.
const LISTED: usize = 10;

/// Kinds that press with their whole spring, with their names.
const PRESSING: [(PrimitiveKind, &str, &str); 5] = [
    (PrimitiveKind::Point, "point", "points"),
    (PrimitiveKind::LineSegment, "segment", "segments"),
    (PrimitiveKind::Capsule, "capsule", "capsules"),
    (PrimitiveKind::Cylinder, "cylinder", "cylinders"),
    (PrimitiveKind::Cone, "cone", "cones"),
];

/// Kinds pressed on: faces, and the walls of round parts or holes.
const PRESSED: [PrimitiveKind; 6] = [
    PrimitiveKind::Plane,
    PrimitiveKind::Polyhedron,
    PrimitiveKind::Capsule,
    PrimitiveKind::Cylinder,
    PrimitiveKind::Cone,
    PrimitiveKind::Bore,
];

/// Number of primitives of each pressing kind with one surface.
struct Group {
    surface: u32,
    counts: [usize; PRESSING.len()],
}

impl Group {
    /// Numbers of primitives that can touch a kind of face, by kind.
    fn on(&self, face: PrimitiveKind) -> [usize; PRESSING.len()] {
        std::array::from_fn(|i| if has_tester(PRESSING[i].0, face) { self.counts[i] } else { 0 })
    }
}

/// A kind of face and the sum of all springs that can press on one of them at once.
pub(super) struct FacePressed {
    stiffness: f64,
    unit: &'static str,
    /// Description of the pressing primitives and the face.
    told: String,
}

/// Lines of text, the stiffest faces first.
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

/// Primitives of body A that press on the faces of body B: one entry for each surface of faces.
pub(super) fn faces_pressed(
    (a, body_a): (&Named, &MovableGroup),
    (b, body_b): (&Named, &MovableGroup),
) -> Vec<FacePressed> {
    let pressing = pressing(body_a);
    let mut found = Vec::new();
    for (kind, surface) in faces(body_b) {
        let mut all = [0; PRESSING.len()];
        let counts = pressing.iter().flat_map(|group| group.on(kind).into_iter().enumerate());
        counts.for_each(|(index, count)| all[index] += count);
        if all == [0; PRESSING.len()] {
            continue;
        }
        let face_surface = &b.model.surfaces[surface as usize];
        let (stiffness, unit) = sum(&pressing, &a.model, &b.model, (kind, face_surface));
        let told = format!(
            "all {} of {}:{} on a {} (`{}`) of {}:{}",
            told(&all),
            a.name,
            body_a.path,
            kind.name(),
            face_surface.name,
            b.name,
            body_b.path,
        );
        found.push(FacePressed { stiffness, unit, told: printable(&told).into_owned() });
    }
    found
}

fn sum(
    pressing: &[Group],
    model_a: &Model,
    model_b: &Model,
    (kind, face): (PrimitiveKind, &Surface),
) -> (f64, &'static str) {
    let mut sum = 0.0;
    let mut unit = "N/m";
    for group in pressing {
        let surface = &model_a.surfaces[group.surface as usize];
        let Some((stiffness, hertz)) = pair_stiffness(model_a, surface, model_b, face) else { continue };
        // Lying flat, both halves of a segment press, and the whole of a round part.
        sum += stiffness * group.on(kind).iter().sum::<usize>() as f64;
        unit = if hertz { "N/m^1.5" } else { unit };
    }
    (sum, unit)
}

fn told(counts: &[usize]) -> String {
    let of_kind = |(&number, (_, one, more)): (&usize, &(_, &str, &str))| {
        (number > 0).then(|| count(number, one, more))
    };
    counts.iter().zip(&PRESSING).filter_map(of_kind).collect::<Vec<_>>().join(" and ")
}

fn pressing(body: &MovableGroup) -> Vec<Group> {
    let mut by_surface: BTreeMap<u32, Group> = BTreeMap::new();
    for info in &body.primitives {
        let Some(index) = PRESSING.iter().position(|(kind, ..)| *kind == info.kind) else { continue };
        let surface = info.surface;
        let new = Group { surface, counts: [0; PRESSING.len()] };
        by_surface.entry(surface).or_insert(new).counts[index] += 1;
    }
    by_surface.into_values().collect()
}

/// Kinds and surfaces of the faces of a body, each once.
fn faces(body: &MovableGroup) -> BTreeSet<(PrimitiveKind, u32)> {
    let of_primitive = |info: &PrimitiveInfo| (info.kind, info.surface);
    body.primitives.iter().filter(|info| PRESSED.contains(&info.kind)).map(of_primitive).collect()
}

/// Stiffness of a pair, and whether its exponent is 3/2. `None` if the two cannot be combined, which sealing
/// reports.
fn pair_stiffness(model_a: &Model, a: &Surface, model_b: &Model, b: &Surface) -> Option<(f64, bool)> {
    let entry = pair_entries((model_a, a), (model_b, b)).first().map(|(_, entry)| *entry);
    let props = combine_surfaces(a, b, entry, &Laws::default()).ok()?;
    Some((props.stiffness, props.normal.exponent() == Exponent::ThreeHalves))
}
