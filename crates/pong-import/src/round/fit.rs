//! Least-squares fit of a round primitive to a mesh, from a nearby axis, by Gauss-Newton.

use super::frame::Frame;
use super::shape::{Kind, Round};
use crate::mesh::{Adjacency, Mesh};
use nalgebra::{DMatrix, DVector, Vector3};

const ROUNDS: usize = 20;
/// Steps below this share of the size have converged.
const SETTLED: f64 = 1e-14;
/// A point nearer to the axis than this share of the size has no radial direction.
const ON_AXIS: f64 = 1e-6;
/// A wall point nearer to the axis than this share of the largest radius is the tip of a cone.
const TIP: f64 = 0.02;

/// A primitive with the frame of its axis.
pub(super) struct Fit {
    pub(super) round: Round,
    pub(super) frame: Frame,
}

/// The wall of a frustum: radius at the origin of the frame, and its slope along z.
#[derive(Clone, Copy)]
struct Wall {
    radius: f64,
    slope: f64,
}

pub(super) fn fitted(
    part: &Mesh,
    edges: &Adjacency,
    start: &Frame,
    kind: Kind,
    tolerance_m: f64,
) -> Option<Fit> {
    if kind == Kind::Capsule {
        return capsule(part, start, tolerance_m);
    }
    let mut frame = *start;
    let mut wall = Wall { radius: 0.0, slope: 0.0 };
    // The set of flat end triangles depends on the axis and vice versa.
    for _ in 0..2 {
        let places = places_of_wall(part, &frame, kind, tolerance_m);
        (frame, wall) = fit_wall(&places, &frame, kind != Kind::Cylinder, part.size_m())?;
    }
    let heights = heights(part, edges, &frame, kind, tolerance_m);
    let radii = heights.map(|z| wall.radius + wall.slope * z);
    let radii = radii.map(|radius| if radius.abs() <= tolerance_m { 0.0 } else { radius });
    let sound = heights[1] > heights[0] && radii.iter().all(|radius| *radius >= 0.0) && radii != [0.0; 2];
    let ends = heights.map(|z| frame.on_axis(z));
    sound.then_some(Fit { round: Round { kind, ends, radii }, frame })
}

/// Lowest and highest coordinate along the axis.
fn extent(part: &Mesh, frame: &Frame) -> [f64; 2] {
    let heights = part.vertices.iter().map(|place| frame.local(place).z);
    heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)])
}

/// The end (0 or 1) in which a triangle lies flat, if it does.
fn flat_end(
    part: &Mesh,
    frame: &Frame,
    extent: [f64; 2],
    triangle: usize,
    tolerance_m: f64,
) -> Option<usize> {
    let heights = part.corners(triangle).map(|place| frame.local(&place).z);
    (0..2).find(|&end| heights.iter().all(|z| (z - extent[end]).abs() <= 2.0 * tolerance_m))
}

/// Vertices of all triangles except flat ends.
fn places_of_wall(part: &Mesh, frame: &Frame, kind: Kind, tolerance_m: f64) -> Vec<Vector3<f64>> {
    let extent = extent(part, frame);
    let mut is_wall = vec![kind == Kind::Bore; part.vertices.len()];
    for (index, triangle) in part.triangles.iter().enumerate() {
        if flat_end(part, frame, extent, index, tolerance_m).is_none() {
            triangle.iter().for_each(|&vertex| is_wall[vertex as usize] = true);
        }
    }
    part.vertices.iter().zip(is_wall).filter(|(_, wall)| *wall).map(|(place, _)| *place).collect()
}

/// Heights of both ends along the axis: the mean over the vertices of flat triangles there, or over the edge
/// of a bore; at a tip the last vertex.
fn heights(part: &Mesh, edges: &Adjacency, frame: &Frame, kind: Kind, tolerance_m: f64) -> [f64; 2] {
    let extent = extent(part, frame);
    let middle = 0.5 * (extent[0] + extent[1]);
    let mut at_end = [const { Vec::new() }; 2];
    if kind == Kind::Bore {
        for &(triangle, corner) in &edges.free {
            let z = frame.local(&part.corners(triangle as usize)[corner as usize]).z;
            at_end[usize::from(z > middle)].push(z);
        }
    } else {
        for index in 0..part.triangles.len() {
            if let Some(end) = flat_end(part, frame, extent, index, tolerance_m) {
                at_end[end].extend(part.corners(index).map(|place| frame.local(&place).z));
            }
        }
    }
    [0, 1].map(|end| match at_end[end].len() {
        0 => extent[end],
        count => at_end[end].iter().sum::<f64>() / count as f64,
    })
}

/// Frustum wall nearest to the points. A step shifts and tilts the axis, and changes radius and slope.
fn fit_wall(places: &[Vector3<f64>], start: &Frame, tapers: bool, size_m: f64) -> Option<(Frame, Wall)> {
    let unknowns = if tapers { 6 } else { 5 };
    let mut frame = *start;
    let away = |place: &Vector3<f64>| frame.local(place).xy().norm();
    let mean = places.iter().map(away).sum::<f64>() / places.len() as f64;
    let tip = TIP * places.iter().map(away).fold(0.0, f64::max);
    let mut wall = Wall { radius: mean, slope: 0.0 };
    for _ in 0..ROUNDS {
        let rows = |place: &Vector3<f64>| rows_of_wall(&frame.local(place), wall, tip);
        let step = step(places.iter().flat_map(rows), unknowns)?;
        frame = frame.changed([step[0], step[1]], [step[2], step[3]]);
        wall.radius += step[4];
        wall.slope += if tapers { step[5] } else { 0.0 };
        if settled(&step, size_m) {
            break;
        }
    }
    Some((frame, wall))
}

/// Radial residual of a point from the wall, and its derivatives by the unknowns. A tip has no radial
/// direction: it should lie on the axis, with radius zero there.
fn rows_of_wall(local: &Vector3<f64>, wall: Wall, tip: f64) -> Vec<(f64, Vec<f64>)> {
    let (away, z, b) = (local.xy().norm(), local.z, wall.slope);
    if away <= tip {
        return vec![
            (local.x, vec![-1.0, 0.0, -z, 0.0, 0.0, 0.0]),
            (local.y, vec![0.0, -1.0, 0.0, -z, 0.0, 0.0]),
            (-wall.radius - b * z, vec![0.0, 0.0, 0.0, 0.0, -1.0, -z]),
        ];
    }
    let (ux, uy) = (local.x / away, local.y / away);
    let lean = [-ux * z - b * local.x, -uy * z - b * local.y];
    vec![(away - wall.radius - b * z, vec![-ux, -uy, lean[0], lean[1], -1.0, -z])]
}

/// Capsule nearest to all vertices. A step also moves both ends along the axis.
fn capsule(part: &Mesh, start: &Frame, tolerance_m: f64) -> Option<Fit> {
    let size_m = part.size_m();
    let mut frame = *start;
    let [low, high] = extent(part, &frame);
    let away = part.vertices.iter().map(|place| frame.local(place).xy().norm());
    let mut radius = away.fold(0.0, f64::max);
    let mut ends = [low + radius, high - radius];
    for _ in 0..ROUNDS {
        if ends[1] <= ends[0] {
            return None;
        }
        let row = |place: &Vector3<f64>| {
            let local = frame.local(place);
            let nearest = local.z.clamp(ends[0], ends[1]);
            let arm = Vector3::new(local.x, local.y, local.z - nearest);
            let distance = arm.norm();
            let n = arm.try_normalize(ON_AXIS * size_m)?;
            let at_end = [local.z < ends[0], local.z > ends[1]].map(|beyond| if beyond { -n.z } else { 0.0 });
            let row = vec![-n.x, -n.y, -n.x * nearest, -n.y * nearest, -1.0, at_end[0], at_end[1]];
            Some((distance - radius, row))
        };
        let step = step(part.vertices.iter().filter_map(row), 7)?;
        frame = frame.changed([step[0], step[1]], [step[2], step[3]]);
        radius += step[4];
        ends = [ends[0] + step[5], ends[1] + step[6]];
        if settled(&step, size_m) {
            break;
        }
    }
    // A capsule hardly longer than a sphere is refused.
    let sound = radius > 0.0 && ends[1] - ends[0] > tolerance_m;
    let round = Round { kind: Kind::Capsule, ends: ends.map(|z| frame.on_axis(z)), radii: [radius; 2] };
    sound.then_some(Fit { round, frame })
}

/// Gauss-Newton step of the unknowns; zero for unknowns on which no residual depends.
fn step(rows: impl Iterator<Item = (f64, Vec<f64>)>, unknowns: usize) -> Option<DVector<f64>> {
    let mut normal = DMatrix::zeros(unknowns, unknowns);
    let mut gradient = DVector::zeros(unknowns);
    let mut scale = DVector::zeros(unknowns);
    for (residual, row) in rows {
        for i in 0..unknowns {
            gradient[i] -= row[i] * residual;
            (0..unknowns).for_each(|j| normal[(i, j)] += row[i] * row[j]);
        }
    }
    // Lengths and slopes differ in size: each unknown is scaled by its own curvature.
    for i in 0..unknowns {
        let curvature: f64 = normal[(i, i)];
        scale[i] = if curvature > 0.0 { curvature.sqrt().recip() } else { 0.0 };
    }
    let scaled = DMatrix::from_fn(unknowns, unknowns, |i, j| normal[(i, j)] * scale[i] * scale[j]);
    let solved = scaled.svd(true, true).solve(&gradient.component_mul(&scale), 1e-10).ok()?;
    let step = solved.component_mul(&scale);
    step.iter().all(|x| x.is_finite()).then_some(step)
}

fn settled(step: &DVector<f64>, size_m: f64) -> bool {
    step.amax() <= SETTLED * size_m.max(1.0)
}
