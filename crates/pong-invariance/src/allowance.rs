//! Allowed difference between two answers to the same scene.

use crate::base::Base;
use crate::make::path;
use crate::play::{Answer, Touch};
use crate::round_part::RoundKind;
use crate::scene::{Scene, Shape};
use crate::twin::Twin;
use pong_geometry::{Vec3, Wrench};

/// Tolerance where bits are not required, relative to the largest term.
pub const TOLERANCE: f64 = 1e-9;

/// Roundings of a position on its way to a depth, each of at most one unit in the last place. Scenes without
/// a defect stay below 20.
const ROUNDINGS: f64 = 64.0;

/// Rounding allowance of a scene, in addition to [`TOLERANCE`].
pub struct Allowance {
    /// Force, N.
    pub force: f64,
    /// Lever arm for moments, m.
    pub lever: f64,
}

impl Allowance {
    /// Allowance for a difference in a frame whose largest term is `largest`.
    pub fn of(base: &Base, twin: &Twin, largest: f64) -> Self {
        let scene = &base.scene;
        let position = Self::position(scene, twin);
        let velocity = twin.rounding_of_velocity + f64::EPSILON * 10.0 * (scene.size + farthest(scene));
        let rounding = ROUNDINGS * (scene.stiffness() * position + scene.damping() * velocity);
        // Rounding tilts the plane of a triangle by ε over its relative height.
        let thin = 64.0 * f64::EPSILON * (1.0 / thinnest(scene)).max(1.0 / thinnest(&twin.scene));
        let origins = twin.back.origins.iter().flatten().map(Vec3::norm).fold(0.0, f64::max);
        let lever = 4.0 * (scene.size + origins);
        // A rounded position makes a direction uncertain by the rounding over the size.
        let turned = ROUNDINGS * twin.rounding / narrowest(scene);
        Self { force: (TOLERANCE + thin + turned) * largest + rounding, lever }
    }

    /// Uncertainty of a position, m, as one of [`ROUNDINGS`].
    fn position(scene: &Scene, twin: &Twin) -> f64 {
        twin.rounding + f64::EPSILON * (scene.size + farthest(scene)) + bent(scene) / ROUNDINGS
    }

    /// Allowance for the rounding of volumes in the frames up to the last of `answers`, which are those of the
    /// twin. The force of a cell of solids is K·V, with a damping of c·ḋ over its effective area, which is known
    /// to the rounding of V over its depth.
    pub fn of_solids(base: &Base, twin: &Twin, answers: &[Answer]) -> f64 {
        let scene = &base.scene;
        let rounding = Self::position(scene, twin) * ROUNDINGS * scene.size.powi(2);
        let area = scene.reference_area();
        let scale = scene.size / twin.scene.size;
        let mut damped = 0.0;
        for (frame, answer) in answers.iter().enumerate() {
            let speed = scene.frames[frame].iter().map(|state| {
                let twist = state.twist();
                twist.linear.norm() + twist.angular.norm() * scene.size
            });
            let speed: f64 = speed.sum();
            let first = base.answers[frame].contacts.iter().map(|touch| (touch.depth, touch.weight));
            let second =
                answer.contacts.iter().map(|touch| (touch.depth * scale, touch.weight * scale * scale));
            damped += first
                .chain(second)
                .filter(|(depth, _)| *depth > 0.0)
                .map(|(depth, weight)| scene.damping_at(depth) * speed * weight.min(rounding / depth))
                .sum::<f64>();
        }
        (scene.stiffness() * rounding + damped) / area
    }

    /// Difference of two wrenches as a multiple of the allowance.
    pub fn exceeded(&self, a: &[Wrench; 2], b: &[Wrench; 2]) -> f64 {
        distance(a, b, self.lever) / self.force
    }
}

/// Uncertainty of the directions in a frame's contacts with round parts, rad. The lowest place of a flat end is known to
/// the rounding of directions over the sine between its axis and the normal, the normal between two axes to the rounding
/// of positions over their distance. What is upright or crosses within rounding has no allowance.
pub fn of_directions(base: &Base, twin: &Twin, frame: usize) -> f64 {
    /// Largest uncertainty for which a direction is still known.
    const KNOWN: f64 = 1e-2;
    let scene = &base.scene;
    let (rounding, position) = (ROUNDINGS * f64::EPSILON, ROUNDINGS * Allowance::position(scene, twin));
    let uncertainty = |touch: &Touch| {
        let parts = [0, 1].map(|body| scene.bodies[body].shapes.get(touch.of[body] as usize));
        let upright = [0, 1].map(|body| match parts[body] {
            Some(Shape::Round(part)) if part.kind != RoundKind::Capsule => {
                let axis = scene.frames[frame][body].pose().orientation * part.axis();
                rounding / axis.cross(&touch.normal).norm().max(rounding)
            }
            _ => 0.0,
        });
        let radius = |part: Option<&Shape>| match part? {
            Shape::Segment { .. } => Some(0.0),
            Shape::Round(part) if part.kind == RoundKind::Capsule => Some(part.widest()),
            _ => None,
        };
        let crossing = match parts.map(radius) {
            [Some(a), Some(b)] => position / (a + b - touch.depth).abs().max(position),
            _ => 0.0,
        };
        upright.into_iter().chain([crossing]).filter(|angle| *angle < KNOWN).fold(0.0, f64::max)
    };
    base.answers[frame].contacts.iter().map(uncertainty).fold(0.0, f64::max)
}

/// Largest coordinate of a group, m.
fn farthest(scene: &Scene) -> f64 {
    let positions = scene.frames.iter().flatten().flat_map(|state| state.position);
    positions.fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// Largest difference of forces, and of moments divided by the lever.
pub fn distance(a: &[Wrench; 2], b: &[Wrench; 2], lever: f64) -> f64 {
    let of = |a: &Wrench, b: &Wrench| (a.force - b.force).norm().max((a.moment - b.moment).norm() / lever);
    let worst = of(&a[0], &b[0]).max(of(&a[1], &b[1]));
    if worst.is_nan() { f64::INFINITY } else { worst }
}

/// Largest distance of a solid's corners from the planes of their faces, m: in single precision a face of
/// four corners is not planar, and its plane may depend on their order.
pub fn bent(scene: &Scene) -> f64 {
    let mut most = 0.0_f64;
    for body in scene.bodies.iter().filter(|body| body.is_solid) {
        body.shapes.iter().for_each(|shape| most = most.max(bent_between(shape, scene.size)));
    }
    for shape in scene.bodies.iter().flat_map(|body| &body.shapes) {
        let Shape::Polyhedron(solid) = shape else { continue };
        for face in &solid.faces {
            let corners: Vec<Vec3> = face.iter().map(|index| solid.vertices[*index]).collect();
            let normal = path::normal_of(&corners);
            let off = corners.iter().map(|corner| normal.dot(&(corner - corners[0])).abs());
            most = off.fold(most, f64::max);
        }
    }
    // A plane through three corners is off by a few times that at the others, and edges of pieces move with
    // it.
    let slack = 1e3 * f64::EPSILON * scene.size;
    if most > slack { 30.0 * most } else { 0.0 }
}

/// Largest height of a triangle above the plane of a neighbour, m, among those that single precision may have bent.
fn bent_between(shape: &Shape, size: f64) -> f64 {
    let Shape::Mesh(mesh) = shape else { return 0.0 };
    let mut most = 0.0_f64;
    for one in &mesh.triangles {
        let corners = one.map(|index| mesh.vertices[index]);
        let normal = path::normal_of(&corners);
        for other in &mesh.triangles {
            if other.iter().filter(|index| one.contains(index)).count() == 2 {
                let heights = other.map(|index| normal.dot(&(mesh.vertices[index] - corners[0])).abs());
                let height = heights.into_iter().fold(0.0, f64::max);
                most = if height < 1e-6 * size { most.max(height) } else { most };
            }
        }
    }
    most
}

/// Smallest radius of a round part, or the size, m: the direction from an axis is uncertain in proportion to
/// its inverse.
fn narrowest(scene: &Scene) -> f64 {
    let radii = scene.bodies.iter().flat_map(|body| &body.shapes).filter_map(|shape| match shape {
        Shape::Round(part) => Some(part.radii),
        _ => None,
    });
    radii.flatten().filter(|radius| *radius > 0.0).fold(scene.size, f64::min)
}

/// Height of the thinnest triangle, relative to the scene's size.
pub fn thinnest(scene: &Scene) -> f64 {
    let mut least = 1.0_f64;
    for shape in scene.bodies.iter().flat_map(|body| &body.shapes) {
        if let Shape::Mesh(mesh) = shape {
            for triangle in &mesh.triangles {
                let [p, q, r] = triangle.map(|index| mesh.vertices[index]);
                let longest = (q - p).norm().max((r - q).norm()).max((p - r).norm());
                least = least.min((q - p).cross(&(r - p)).norm() / longest / scene.size);
            }
        }
    }
    least
}
