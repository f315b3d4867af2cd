//! Reduction of a scene while it still disagrees.

use crate::scene::{Body, Friction, Normal, Scene, Shape};
use pong_engine::State;
use pong_geometry::{Pose, Vec3};

/// Most trials per scene.
const TRIALS: usize = 1500;

/// The smallest scene found that still `differs`.
pub fn reduce(scene: &Scene, mut differs: impl FnMut(&Scene) -> bool) -> Scene {
    let mut smallest = scene.clone();
    let mut trials = 0;
    loop {
        let mut is_smaller = false;
        for step in STEPS {
            let mut at = 0;
            while let Some(candidate) = step(&smallest, at) {
                trials += 1;
                if trials > TRIALS {
                    return smallest;
                }
                match candidate != smallest && differs(&candidate) {
                    true => {
                        smallest = candidate;
                        is_smaller = true;
                    }
                    false => at += 1,
                }
            }
        }
        if !is_smaller {
            return smallest;
        }
    }
}

/// One way to make a scene smaller: returns its `at`-th trial, or `None` when there are no more.
type Step = fn(&Scene, usize) -> Option<Scene>;

const STEPS: &[Step] = &[
    fewer_frames,
    fewer_shapes,
    half_of_the_triangles,
    fewer_triangles,
    plainer_surface,
    at_rest,
    plainer_frame,
    plainer_shape,
    rounder_states,
    rounder_shapes,
];

fn fewer_frames(scene: &Scene, at: usize) -> Option<Scene> {
    (scene.frames.len() > 1 && at < scene.frames.len()).then_some(())?;
    let mut smaller = scene.clone();
    smaller.frames.remove(at);
    if !smaller.motions.is_empty() {
        smaller.motions.remove(at);
    }
    Some(smaller)
}

fn fewer_shapes(scene: &Scene, at: usize) -> Option<Scene> {
    let counts = [0, 1].map(|body| scene.bodies[body].shapes.len());
    let (body, index) = if at < counts[0] { (0, at) } else { (1, at - counts[0]) };
    (index < counts[body]).then_some(())?;
    let mut smaller = scene.clone();
    let Body { shapes, names, .. } = &mut smaller.bodies[body];
    if shapes.len() > 1 {
        shapes.remove(index);
        names.remove(index);
    }
    Some(smaller)
}

fn half_of_the_triangles(scene: &Scene, at: usize) -> Option<Scene> {
    without_triangles(scene, |count| (at < 8 && count > 8).then(|| (count * at / 8, count * (at + 1) / 8)))
}

fn fewer_triangles(scene: &Scene, at: usize) -> Option<Scene> {
    without_triangles(scene, |count| (count > 1 && at < count).then_some((at, at + 1)))
}

fn without_triangles(scene: &Scene, range: impl Fn(usize) -> Option<(usize, usize)>) -> Option<Scene> {
    let mut smaller = scene.clone();
    let Some(Shape::Mesh(mesh)) = smaller.bodies[1].shapes.first_mut() else { return None };
    let (from, to) = range(mesh.triangles.len())?;
    mesh.triangles.drain(from..to);
    // Drops unused corners.
    let mut new = vec![usize::MAX; mesh.vertices.len()];
    let mut vertices = Vec::new();
    for corner in mesh.triangles.iter_mut().flatten() {
        if new[*corner] == usize::MAX {
            new[*corner] = vertices.len();
            vertices.push(mesh.vertices[*corner]);
        }
        *corner = new[*corner];
    }
    mesh.vertices = vertices;
    Some(smaller)
}

fn plainer_surface(scene: &Scene, at: usize) -> Option<Scene> {
    let mut smaller = scene.clone();
    for body in &mut smaller.bodies {
        let surface = &mut body.surface;
        match at {
            0 => surface.friction = Friction::Smooth,
            1 => surface.normal = Normal::Linear { damping: 0.0, ramp: 0.0 },
            2 => surface.stiffness = 1e5,
            3 => surface.stiffness = rounded(surface.stiffness, 1),
            4 => {
                if let Friction::Bristle { mu, excess, stiffness, damping } = &mut surface.friction {
                    *excess = 0.0;
                    [mu, stiffness, damping].into_iter().for_each(|x| *x = rounded(*x, 1));
                }
            }
            _ => return None,
        }
    }
    Some(smaller)
}

fn at_rest(scene: &Scene, at: usize) -> Option<Scene> {
    let mut smaller = scene.clone();
    let each = smaller.frames.iter_mut();
    match at {
        0 => each.flatten().for_each(|state| {
            state.linear_velocity = [0.0; 3];
            state.angular_velocity = [0.0; 3];
        }),
        1 => each.flatten().for_each(|state| state.angular_velocity = [0.0; 3]),
        2 => smaller.swapped = false,
        3 => smaller.motions.clear(),
        _ => return None,
    }
    Some(smaller)
}

/// B at the origin, with its group's frame equal to the common one.
fn plainer_frame(scene: &Scene, at: usize) -> Option<Scene> {
    let mut smaller = scene.clone();
    match at {
        0 => {
            for states in &mut smaller.frames {
                let (a, b) = (states[0].pose(), states[1].pose());
                states[0] = State::from_motion(&Pose::relative(&a, &b), &states[0].twist());
                states[1] = State::from_motion(&Pose::identity(), &states[1].twist());
            }
        }
        1 => {
            for state in smaller.frames.iter_mut().flatten() {
                state.orientation = [1.0, 0.0, 0.0, 0.0];
            }
        }
        _ => return None,
    }
    Some(smaller)
}

fn plainer_shape(scene: &Scene, at: usize) -> Option<Scene> {
    let mut smaller = scene.clone();
    let shape = smaller.bodies[0].shapes.first_mut()?;
    match (at, shape) {
        (0, Shape::Ellipsoid { orientation, .. }) => *orientation = nalgebra::UnitQuaternion::identity(),
        (1, Shape::Ellipsoid { center, semi_axes, .. }) => {
            let (center, radius) = (*center, semi_axes.min());
            smaller.bodies[0].shapes[0] = Shape::Sphere { center, radius };
        }
        (0 | 1, _) => {}
        (2, _) => {
            // Moves its middle to the group's origin.
            let shift = match &smaller.bodies[0].shapes[0] {
                Shape::Point { position: p }
                | Shape::Sphere { center: p, .. }
                | Shape::Ellipsoid { center: p, .. } => *p,
                Shape::Segment { ends } => (ends[0] + ends[1]) * 0.5,
                Shape::Ray { origin, .. } => *origin,
                Shape::Round(part) => (part.ends[0] + part.ends[1]) * 0.5,
                _ => return None,
            };
            let move_it = Pose { position: -shift, orientation: nalgebra::UnitQuaternion::identity() };
            let shapes = &mut smaller.bodies[0].shapes;
            *shapes = shapes.iter().map(|shape| shape.carried(&move_it)).collect();
            for states in &mut smaller.frames {
                let pose = states[0].pose();
                let position = pose.position + pose.orientation * shift;
                states[0] = State::from_motion(&Pose { position, ..pose }, &states[0].twist());
            }
        }
        (3, _) => smaller.bodies[1].place = Pose::identity(),
        _ => return None,
    }
    Some(smaller)
}

fn rounder_states(scene: &Scene, at: usize) -> Option<Scene> {
    let digits = [1, 2, 3, 5];
    let frame = at / digits.len();
    (frame < scene.frames.len()).then_some(())?;
    let mut smaller = scene.clone();
    for state in &mut smaller.frames[frame] {
        let numbers =
            state.position.iter_mut().chain(&mut state.linear_velocity).chain(&mut state.angular_velocity);
        numbers.for_each(|x| *x = rounded(*x, digits[at % digits.len()]));
    }
    Some(smaller)
}

fn rounder_shapes(scene: &Scene, at: usize) -> Option<Scene> {
    let digits = [1, 2, 3, 5];
    let (body, digits) = (at / digits.len(), digits[at % digits.len()]);
    (body < 2).then_some(())?;
    let mut smaller = scene.clone();
    let round = |v: &Vec3| v.map(|x| rounded(x, digits));
    for shape in &mut smaller.bodies[body].shapes {
        shape.vertices_mut().iter_mut().for_each(|v| *v = round(v));
        match shape {
            Shape::Sphere { center, radius } => {
                (*center, *radius) = (round(center), rounded(*radius, digits))
            }
            Shape::Ellipsoid { center, semi_axes, .. } => {
                (*center, *semi_axes) = (round(center), round(semi_axes))
            }
            Shape::Round(part) => part.radii = part.radii.map(|radius| rounded(radius, digits)),
            Shape::Point { position } => *position = round(position),
            Shape::Segment { ends } => *ends = ends.map(|end| round(&end)),
            Shape::Plane { normal, offset } => (*normal, *offset) = (round(normal), rounded(*offset, digits)),
            _ => {}
        }
    }
    Some(smaller)
}

fn rounded(x: f64, digits: i32) -> f64 {
    if x == 0.0 || !x.is_finite() {
        return x;
    }
    let unit = libm::pow(10.0, (digits - 1) as f64 - libm::floor(libm::log10(x.abs())));
    (x * unit).round() / unit
}
