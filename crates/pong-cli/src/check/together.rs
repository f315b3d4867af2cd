//! Duplicate geometry of two models as they are placed: coplanar faces, and primitives in one place. What touches both
//! models there is pushed twice.

use super::doubled::ends;
use super::named::Named;
use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::MovableGroup;
use pong_model::flush::{PlacedGroup, flush_pairs};

/// Distance up to which two primitives are in one place, relative to the size of all that are compared.
const NEAR: f64 = 1e-6;

/// Notes of two models, one for their faces and one for their other primitives. They are notes because another scene
/// may place the models elsewhere.
pub(super) fn notes(a: &Named, b: &Named) -> Vec<String> {
    let placed = [a, b].map(|named| PlacedGroup { group: &named.model.bodies[0], pose: named.pose });
    let notes = [flush_faces(&placed), in_one_place(&placed)];
    let join = "if they never move relative to each other, make them one model with `pong join`";
    notes.into_iter().flatten().map(|note| format!("placed as here, {note}; {join}")).collect()
}

/// The first overlap of faces, or the first seam if there is no overlap.
fn flush_faces(placed: &[PlacedGroup<'_>; 2]) -> Option<String> {
    let pairs = flush_pairs(placed);
    let first = pairs.iter().find(|pair| pair.overlap).or(pairs.first())?;
    let [one, other] = first.primitives.map(|(group, primitive)| path(placed[group].group, primitive));
    let more = more(pairs.len());
    Some(match first.overlap {
        true => format!(
            "`{one}` and `{other}` lie in one plane and overlap{more}: what touches both there is pushed twice"
        ),
        false => format!(
            "`{one}` and `{other}` are flush{more}: what rolls or slides over their seam is pushed by both, up to twice"
        ),
    })
}

/// The first two equal primitives in one place.
fn in_one_place(placed: &[PlacedGroup<'_>; 2]) -> Option<String> {
    let mut axes: Vec<Axis> = (0..2).flat_map(|model| axes_of(model, &placed[model])).collect();
    let extent = axes.iter().flat_map(|axis| axis.ends).map(|(end, radius)| end.amax() + radius);
    let near = NEAR * extent.fold(0.0, f64::max);
    // Sorted along the longest side of the box around all, so that few have nearly the same coordinate.
    let ends = || axes.iter().flat_map(|axis| axis.ends).map(|(end, _)| end);
    let low = ends().fold(Vec3::zeros(), |low, end| low.inf(&end));
    let high = ends().fold(Vec3::zeros(), |high, end| high.sup(&end));
    let side = (high - low).imax();
    axes.sort_by(|one, other| one.least(side).total_cmp(&other.least(side)));
    let mut found = Vec::new();
    for (index, one) in axes.iter().enumerate() {
        let beside = axes[index + 1..].iter().take_while(|other| other.least(side) <= one.least(side) + near);
        found.extend(beside.filter(|other| one.is_at(other, near)).map(|other| (one, other)));
    }
    let (one, other) = *found.first()?;
    let [first, second] = if one.model == 0 { [one, other] } else { [other, one] };
    let [path_a, path_b] = [first, second].map(|axis| path(placed[axis.model].group, axis.primitive));
    let kind = first.kind.name();
    let more = more(found.len());
    Some(format!("`{path_a}` and `{path_b}` are the same {kind} in one place{more}: their springs add"))
}

/// Path of a primitive.
fn path(group: &MovableGroup, primitive: usize) -> &str {
    &group.primitives[primitive].path
}

/// Words for the pairs beyond the first.
fn more(count: usize) -> String {
    match count {
        1 => String::new(),
        _ => format!(" (and {} more {})", count - 1, if count == 2 { "pair" } else { "pairs" }),
    }
}

/// Axis of a primitive in the common frame.
struct Axis {
    /// Model, 0 or 1.
    model: usize,
    /// Index into the primitives of the model's root.
    primitive: usize,
    kind: PrimitiveKind,
    /// Ends, m, and the radii there, m.
    ends: [(Vec3, f64); 2],
}

impl Axis {
    /// Lesser coordinate of both ends, m.
    fn least(&self, coordinate: usize) -> f64 {
        self.ends[0].0[coordinate].min(self.ends[1].0[coordinate])
    }

    /// Tests whether the other model has the same primitive here, whatever the order of its ends.
    fn is_at(&self, other: &Self, near: f64) -> bool {
        let same = |one: (Vec3, f64), other: (Vec3, f64)| {
            (one.0 - other.0).norm() <= near && (one.1 - other.1).abs() <= near
        };
        let [one, two] = other.ends;
        let [first, second] = self.ends;
        self.model != other.model
            && self.kind == other.kind
            && ((same(first, one) && same(second, two)) || (same(first, two) && same(second, one)))
    }
}

fn axes_of(model: usize, placed: &PlacedGroup<'_>) -> Vec<Axis> {
    let x_wg = placed.pose.transform();
    let of = |(primitive, info): (usize, &pong_model::PrimitiveInfo)| {
        let ends = ends(placed.group, info.kind, info.elements.start as usize)?;
        let ends = ends.map(|(end, radius)| (x_wg.point(&end), radius));
        Some(Axis { model, primitive, kind: info.kind, ends })
    };
    placed.group.primitives.iter().enumerate().filter_map(of).collect()
}
