//! A body that touches in the first frame is pushed as if it had approached from its present side.

use super::differs;
use crate::base::Base;
use crate::judge::Verdict;
use crate::make::path::support;
use crate::make::{meshes, solids, touched};
use crate::random::Random;
use crate::scene::{Body, Friction, Mesh, Normal, Scene, Shape, Surface};
use pong_engine::State;
use pong_geometry::{Pose, Twist, Vec3};

/// A sphere or an ellipsoid with its centre outside a closed, two-sided or bent surface that bulges towards
/// it.
pub fn set_down_scene(random: &mut Random) -> Scene {
    let is_round = random.chance(0.3);
    let mut mesh = match random.below(4) {
        0 => Mesh { two_sided: true, ..meshes::plate(random, is_round) },
        1 => {
            let slope = -random.log_between(1e-2, 4.0);
            meshes::fold(random, slope, is_round)
        }
        _ => meshes::skin(&solids::any(random, is_round)),
    };
    if random.chance(0.5) {
        mesh.thickness = Some(random.log_between(0.05, 5.0));
    }
    let mut shapes = vec![Shape::Mesh(mesh)];
    touched::tilt(random, &mut shapes, is_round);
    let foot = crate::make::path::foot(random, &shapes, is_round);
    let radius = if is_round { 0.5 } else { random.log_between(0.1, 1.0) };
    let ball = match random.chance(0.7) {
        true => Shape::Sphere { center: Vec3::zeros(), radius },
        false => {
            let semi_axes = Vec3::from_fn(|_, _| radius * random.between(0.4, 1.0));
            Shape::Ellipsoid { center: Vec3::zeros(), semi_axes, orientation: random.orientation() }
        }
    };
    let place = foot.place + foot.normal * (radius * random.between(0.05, 0.95));
    let surface = Surface {
        stiffness: 1e5,
        normal: Normal::Linear { damping: 0.0, ramp: 0.0 },
        friction: Friction::Smooth,
    };
    Scene {
        family: "set down",
        bodies: [Body::new(vec![ball], surface), Body::new(shapes, surface)],
        swapped: false,
        frames: vec![[still(&place), still(&Vec3::zeros())]],
        motions: Vec::new(),
        size: 1.0,
    }
}

fn still(position: &Vec3) -> State {
    let rest = Twist { linear: Vec3::zeros(), angular: Vec3::zeros() };
    State::from_motion(&Pose { position: *position, ..Pose::identity() }, &rest)
}

/// Checks that the first frame equals that of the same body moved in from outside, through the nearest point
/// of the surface.
pub fn set_down(base: &mut Base, _: &mut Random) -> Verdict {
    let scene = &base.scene;
    let [Shape::Mesh(mesh)] = scene.bodies[1].shapes.as_slice() else { return Verdict::DoesNotApply };
    let states = scene.frames[0];
    let x_ba = Pose::relative(&states[0].pose(), &states[1].pose());
    let (Shape::Sphere { center, .. } | Shape::Ellipsoid { center, .. }) = &scene.bodies[0].shapes[0] else {
        return Verdict::DoesNotApply;
    };
    let center = x_ba.orientation * center + x_ba.position;
    let Some((nearest, front)) = nearest(mesh, &center) else { return Verdict::DoesNotApply };
    let out = center - nearest;
    // Too close to the surface to decide the side, or behind it.
    if out.norm() < 1e-6 * scene.size || !(mesh.two_sided || out.dot(&front) > 1e-6 * scene.size) {
        return Verdict::DoesNotApply;
    }
    let pose = states[0].pose();
    let reach = match &scene.bodies[0].shapes[0] {
        Shape::Ellipsoid { semi_axes, .. } => support(semi_axes, &Vec3::x()).norm().max(semi_axes.max()),
        Shape::Sphere { radius, .. } => *radius,
        _ => return Verdict::DoesNotApply,
    };
    let away = states[1].pose().orientation * out.normalize() * (4.0 * (reach + scene.size));
    // The centre must not cross any triangle on the way in.
    let from = center + out.normalize() * (4.0 * (reach + scene.size));
    if mesh
        .triangles
        .iter()
        .any(|triangle| is_crossed(&triangle.map(|index| mesh.vertices[index]), &from, &center))
    {
        return Verdict::DoesNotApply;
    }
    let before = [still_at(&Pose { position: pose.position + away, ..pose }), states[1]];
    let Ok(answers) = base.stage.play(&[before, states]) else { return Verdict::DoesNotApply };
    let (first, after) = (&base.answers[0], &answers[1]);
    let difference = (first.wrenches[0].force - after.wrenches[0].force).norm();
    let largest = first.largest.max(after.largest);
    if difference > 1e-9 * largest {
        let what = "the first frame is not that of the body come from outside";
        return differs(base, 0, difference / largest, what, after);
    }
    Verdict::Agrees
}

fn still_at(pose: &Pose) -> State {
    State::from_motion(pose, &Twist { linear: Vec3::zeros(), angular: Vec3::zeros() })
}

/// Tests whether a line segment crosses a triangle, or its boundary within rounding.
fn is_crossed([p, q, r]: &[Vec3; 3], from: &Vec3, to: &Vec3) -> bool {
    let normal = (q - p).cross(&(r - p));
    let (start, end) = (normal.dot(&(from - p)), normal.dot(&(to - p)));
    if start * end > 0.0 {
        return false;
    }
    let place = from + (to - from) * (start / pong_geometry::divisor(start - end));
    let size = (q - p).norm() + (r - p).norm();
    (nearest_of_triangle(&[*p, *q, *r], &place) - place).norm() < 1e-9 * size
}

/// Nearest point of a mesh and the front normal of a triangle there. `None` if the fronts there disagree on
/// the side, as at a sharp boundary.
fn nearest(mesh: &Mesh, x: &Vec3) -> Option<(Vec3, Vec3)> {
    let mut found: Vec<(f64, Vec3, Vec3)> = Vec::new();
    for triangle in &mesh.triangles {
        let [p, q, r] = triangle.map(|index| mesh.vertices[index]);
        let place = nearest_of_triangle(&[p, q, r], x);
        found.push(((place - x).norm(), place, (q - p).cross(&(r - p)).normalize()));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (distance, place, front) = *found.first()?;
    let near = found.iter().take_while(|other| other.0 < distance * (1.0 + 1e-9));
    let sides: Vec<bool> = near.map(|other| (x - other.1).dot(&other.2) > 0.0).collect();
    (mesh.two_sided || sides.iter().all(|side| *side)).then_some((place, front))
}

fn nearest_of_triangle([p, q, r]: &[Vec3; 3], x: &Vec3) -> Vec3 {
    let normal = (q - p).cross(&(r - p));
    let is_over = |a: &Vec3, b: &Vec3| (b - a).cross(&(x - a)).dot(&normal) >= 0.0;
    if is_over(p, q) && is_over(q, r) && is_over(r, p) {
        return x - normal * (normal.dot(&(x - p)) / normal.norm_squared());
    }
    let on_edge = |a: &Vec3, b: &Vec3| {
        let t = ((x - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
        a + (b - a) * t
    };
    let places = [on_edge(p, q), on_edge(q, r), on_edge(r, p)];
    places.into_iter().min_by(|a, b| (a - x).norm().total_cmp(&(b - x).norm())).unwrap_or(*p)
}
