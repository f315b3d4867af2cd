//! Round primitives of marked nodes and of recognised parts of meshes.

use super::building::Building;
use super::kinds::{self, Naming};
use super::meshes::Placed;
use crate::affine::Affine;
use crate::findings::Findings;
use crate::marks::Mark;
use crate::mesh::{self, Mesh};
use crate::model::{Field, Primitive, field};
use crate::number::Grid;
use crate::round::{Kind, Recognised, Round, recognise};
use crate::source::Look;
use nalgebra::Vector3;

/// Scales that differ by less than this share are equal.
const SAME_SCALE: f64 = 1e-6;

/// Round primitive along the z axis of a node, centred at its origin.
pub(super) fn marked(
    naming: &Naming<'_>,
    mark: &Mark,
    unit_m: f64,
    to_body: &Affine,
    grid: Grid,
    findings: &mut Findings,
) -> Option<Primitive> {
    let kind = match mark.kind.as_str() {
        "Capsule" => Kind::Capsule,
        "Cylinder" => Kind::Cylinder,
        "Cone" => Kind::Cone,
        _ => Kind::Bore,
    };
    let radii = if matches!(kind, Kind::Capsule | Kind::Cylinder) { [mark.radius; 2] } else { mark.radii };
    let missing = [("length", mark.length), ("radius", radii[0].max(radii[1]))];
    if let Some((what, _)) = missing.iter().find(|(_, size)| *size <= 0.0) {
        let cause = format!("its mark gives no {what} above zero");
        findings.fault(naming.path, "not-positive", cause, "give one in its mark");
        return None;
    }
    let scale = kinds::straight(to_body, naming.path, findings)?.scale.abs();
    let same: &[f64] = if kind == Kind::Capsule { scale.as_slice() } else { &scale.as_slice()[..2] };
    let (least, most) = same.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), s| (a.min(*s), b.max(*s)));
    if most - least > SAME_SCALE * most {
        let cause = format!("its scale of ({}, {}, {}) leaves no {}", scale.x, scale.y, scale.z, kind.name());
        findings.fault(naming.path, "sheared-shape", cause, "make its scale the same around its z axis");
        return None;
    }
    let half = Vector3::new(0.0, 0.0, 0.5 * mark.length * unit_m);
    let ends = [to_body.point(&-half), to_body.point(&half)];
    let round = Round { kind, ends, radii: radii.map(|radius| radius * unit_m * scale.x) };
    let mut primitive = of(naming, (0, 1), &round, grid);
    if kind == Kind::Bore {
        primitive.fields.extend(mark.thickness.map(|thickness| field("thickness", Field::Number(thickness))));
        if mark.mouths != [true; 2] {
            let [low, high] = mark.mouths;
            primitive.fields.push(field("mouths", Field::Flags(vec![low, high])));
        }
    }
    Some(primitive)
}

fn of(naming: &Naming<'_>, (index, count): (usize, usize), round: &Round, grid: Grid) -> Primitive {
    let ends = round.ends.map(|end| grid.round_place(&end));
    let [low, high] = round.radii.map(|radius| grid.round(radius));
    let size = match round.kind {
        Kind::Capsule | Kind::Cylinder => field("radius", Field::Number(low)),
        Kind::Cone | Kind::Bore => field("radii", Field::Tuple(vec![low, high])),
    };
    naming.primitive(round.kind.name(), index, count, vec![field("ends", Field::Tuples(ends.to_vec())), size])
}

/// Parts that are round within the requested tolerance, as primitives, and the rest of the mesh.
pub(super) fn taken_out(
    naming: &Naming<'_>,
    placed: Placed,
    looks: &[Look],
    building: &Building<'_>,
    grid: Grid,
    findings: &mut Findings,
) -> (Vec<Primitive>, Placed) {
    let Some(tolerance_m) = building.round_m.filter(|_| !placed.two_sided) else {
        return (Vec::new(), placed);
    };
    let mut rest = Mesh::default();
    let mut found: Vec<(Mesh, Recognised)> = Vec::new();
    for part in mesh::parts(&placed.mesh) {
        let plain = kinds::one_surface(&part, looks) && !look_of(&part, looks).inactive;
        match recognise(&part, tolerance_m).filter(|_| plain) {
            Some(round) => found.push((part, round)),
            None => append(&mut rest, &part),
        }
    }
    if found.is_empty() {
        return (Vec::new(), placed);
    }
    let count = found.len();
    let primitive = |(index, (part, recognised)): (usize, &(Mesh, Recognised))| {
        let mut primitive = of(naming, (index, count), &recognised.round, grid);
        primitive.surface = look_of(part, looks).surface.or(primitive.surface);
        tell(naming, &primitive, part, recognised, findings);
        primitive
    };
    let primitives = found.iter().enumerate().map(primitive).collect();
    (primitives, Placed { mesh: rest, two_sided: false })
}

fn look_of(part: &Mesh, looks: &[Look]) -> Look {
    part.look_of.first().and_then(|look| looks.get(*look as usize)).cloned().unwrap_or_default()
}

fn tell(
    naming: &Naming<'_>,
    primitive: &Primitive,
    part: &Mesh,
    recognised: &Recognised,
    findings: &mut Findings,
) {
    let Recognised { round, farthest_m } = recognised;
    let [low, high] = round.radii;
    let radii = match round.kind {
        Kind::Capsule | Kind::Cylinder => format!("radius {low:.6} m"),
        Kind::Cone | Kind::Bore => format!("radii {low:.6} and {high:.6} m"),
    };
    let length = (round.ends[1] - round.ends[0]).norm();
    let cause = format!(
        "a part of {} triangles became the {} `{}`, {radii}, {length:.6} m from end to end: the mesh is {farthest_m:.2e} m from \
         it at most",
        part.triangles.len(),
        round.kind.name(),
        primitive.name
    );
    findings.note(naming.path, "round", cause, "");
}

fn append(mesh: &mut Mesh, part: &Mesh) {
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend(&part.vertices);
    mesh.triangles.extend(part.triangles.iter().map(|triangle| triangle.map(|vertex| first + vertex)));
    mesh.look_of.extend(&part.look_of);
}
