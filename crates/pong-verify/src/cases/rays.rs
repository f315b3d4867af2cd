//! V29: rays against a plane, a triangle and a convex polyhedron.

use crate::case::{Case, Failure, Outcome};
use crate::measure::rotation;
use crate::row::Row;
use crate::scene::Duo;
use pong_engine::State;
use pong_executive::{Pose, Twist, Vec3};
use pong_testkit::Random;

pub const V29: Case = Case {
    id: "V29",
    title: "Rays",
    set_up: "A plunger 0.7 m long at random poses within 3 m of a plane, of a triangle with reach 0.05 m and of an \
             octahedron, force along the surface's normal and along the axis; 300 hits each, no ray flatter than \
             30°, none within 1e-6 of an edge or an end. Errors are over the largest coordinate.",
    source: "t = (h − n·o)/(n·d) of the least front hit; δ = (L − t)(−d·n) along n, or L − t along −d; place tip + s·δ·n",
    rows,
};

const ORIGIN: [f64; 3] = [0.1, -0.2, 0.3];
const DIRECTION: [f64; 3] = [0.3, -0.2, -1.0];
const LENGTH: f64 = 0.7;
/// Least distance of a sample from an edge or end: closer, rounding decides between hit and miss.
const MARGIN: f64 = 1e-6;

/// A ray in the frame of its target.
struct Local {
    origin: Vec3,
    direction: Vec3,
}

/// Hit or miss by theory.
enum Truth {
    Hit {
        distance: f64,
        normal: Vec3,
    },
    Miss,
    /// Too near to an edge to decide, or too flat to compare.
    Unclear,
}

type Theory = fn(&Local) -> Truth;

fn rows() -> Outcome {
    let targets: [(&str, &str, Theory); 3] = [
        ("plane", "ground", plane),
        ("triangle", "target_triangle", triangle),
        ("polyhedron", "target_polyhedron", polyhedron),
    ];
    let mut rows = Vec::new();
    for (name, file, theory) in targets {
        for (response, axial) in [("ray_normal", false), ("ray_axial", true)] {
            rows.extend(compare(name, file, theory, (response, axial))?);
        }
    }
    Ok(rows)
}

fn compare(
    name: &str,
    file: &str,
    theory: Theory,
    (response, axial): (&str, bool),
) -> Result<[Row; 3], Failure> {
    let (mut world, [ray, target]) = Duo::new(response, file)?.world()?;
    let mut random = Random(29);
    let (mut hits, mut wrong) = (0, 0);
    let [mut depth_off, mut place_off] = [0.0_f64; 2];
    while hits < 300 {
        let mut pose = |place: f64| Pose {
            position: random.vector(place),
            orientation: rotation(random.vector(core::f64::consts::PI)),
        };
        let (x_t, x_near) = (pose(3.0), pose(0.8));
        let x_r = x_t.compose(&x_near);
        let still = Twist::zero();
        world.set_states(&[
            (ray, State::from_motion(&x_r, &still)),
            (target, State::from_motion(&x_t, &still)),
        ])?;
        world.evaluate()?;
        let back = x_t.orientation.inverse();
        let origin = x_r.orientation * Vec3::from(ORIGIN) + x_r.position;
        let direction = x_r.orientation * Vec3::from(DIRECTION).normalize();
        let local = Local { origin: back * (origin - x_t.position), direction: back * direction };
        let found = world.contacts();
        let (distance, normal) = match theory(&local) {
            Truth::Unclear => continue,
            Truth::Miss => {
                wrong += found.len();
                continue;
            }
            Truth::Hit { distance, normal } => (distance, x_t.orientation * normal),
        };
        hits += 1;
        let [contact] = found.as_slice() else {
            wrong += 1;
            continue;
        };
        let short = LENGTH - distance;
        let (depth, normal) =
            if axial { (short, -direction) } else { (short * -direction.dot(&normal), normal) };
        // The target is rigid: the ray yields, so the force acts at its tip moved outwards by the depth.
        let place = origin + direction * LENGTH + normal * depth;
        let largest = [origin, place, x_t.position, x_r.position].iter().map(Vec3::amax).fold(1.0, f64::max);
        depth_off = depth_off.max((contact.depth - depth).abs() / largest);
        place_off = place_off.max((contact.point - place).norm() / largest);
        place_off = place_off.max((contact.normal - normal).norm());
    }
    let along = if axial { "axial" } else { "normal" };
    Ok([
        Row::count(format!("{name}, {along}: hits or misses told wrong"), 0, wrong),
        Row::below(format!("{name}, {along}: depth"), "", depth_off, 1e-14),
        Row::below(format!("{name}, {along}: place and normal"), "", place_off, 1e-14),
    ])
}

/// A hit on a face, if it is from the front, steep enough and within the ray's length.
fn front_hit(ray: &Local, normal: Vec3, offset: f64, reach: f64) -> Truth {
    let climb = normal.dot(&ray.direction);
    if climb >= 0.0 {
        return Truth::Miss;
    }
    let distance = (offset - normal.dot(&ray.origin)) / climb;
    let near = |end: f64| (distance - end).abs() < MARGIN;
    if climb > -0.5 || near(-reach) || near(LENGTH) {
        return Truth::Unclear;
    }
    if distance > -reach && distance < LENGTH { Truth::Hit { distance, normal } } else { Truth::Miss }
}

fn plane(ray: &Local) -> Truth {
    front_hit(ray, Vec3::z(), 0.0, 0.0)
}

/// Hit on a triangle, from signed areas of the plane's point with the edges.
fn triangle(ray: &Local) -> Truth {
    let corners = [Vec3::new(-1.0, -0.8, -0.1), Vec3::new(1.2, -0.9, 0.1), Vec3::new(0.1, 1.1, 0.05)];
    let across = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
    let normal = across.normalize();
    let hit = front_hit(ray, normal, normal.dot(&corners[0]), 0.05);
    let Truth::Hit { distance, .. } = hit else { return hit };
    let point = ray.origin + ray.direction * distance;
    let areas = [0, 1, 2].map(|i| {
        let (from, to) = (corners[i], corners[(i + 1) % 3]);
        normal.dot(&(to - from).cross(&(point - from))) / across.norm()
    });
    let least = areas.into_iter().fold(f64::INFINITY, f64::min);
    match least {
        _ if least.abs() < MARGIN => Truth::Unclear,
        _ if least < 0.0 => Truth::Miss,
        _ => hit,
    }
}

/// Hit on the octahedron |x|/0.8 + |y|/0.7 + |z|/0.5 = 1: of the ray's crossings with the planes of the
/// faces, the one on the surface that faces the ray.
fn polyhedron(ray: &Local) -> Truth {
    const AXES: [f64; 3] = [0.8, 0.7, 0.5];
    let gauge = |p: &Vec3| (0..3).map(|i| p[i].abs() / AXES[i]).sum::<f64>();
    for signs in 0..8 {
        let outward = Vec3::from_fn(|i, _| if signs >> i & 1 == 1 { -1.0 } else { 1.0 } / AXES[i]);
        let normal = outward.normalize();
        let climb = normal.dot(&ray.direction);
        if climb >= 0.0 {
            continue;
        }
        let distance = (1.0 / outward.norm() - normal.dot(&ray.origin)) / climb;
        let point = ray.origin + ray.direction * distance;
        if gauge(&point) > 1.0 + MARGIN {
            continue;
        }
        let on_edge = (0..3).any(|i| point[i].abs() < 1e-5);
        return if on_edge { Truth::Unclear } else { front_hit(ray, normal, 1.0 / outward.norm(), 0.0) };
    }
    Truth::Miss
}
