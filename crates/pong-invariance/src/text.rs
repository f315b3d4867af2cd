//! Text of a body as a model file, and of a scene for messages.

use crate::round_part::{RoundKind, RoundPart};
use crate::scene::{Body, Friction, Mesh, Normal, Scene, Shape, Solid, Surface};
use pong_engine::State;
use pong_geometry::{Quat, Vec3};
use std::fmt::Write as _;

/// The text of a model file.
pub fn model(body: &Body, name: &str, surface: &str) -> String {
    let mut text = String::with_capacity(512);
    let _ = write!(
        text,
        "(\n    format: \"pong-model\", version: 1, name: \"{name}\",\n    surfaces: {{ \"{surface}\": {} }},\n",
        self::surface(&body.surface)
    );
    let _ = write!(text, "    root: (name: \"{name}\", surface: \"{surface}\",{}", bound(body, 0));
    groups(&mut text, body);
    text.push_str("),\n)\n");
    text
}

fn surface(surface: &Surface) -> String {
    let normal = match surface.normal {
        Normal::Linear { damping, ramp } => format!("Linear(damping: {damping:?}, ramp: {ramp:?})"),
        Normal::HuntCrossley { dissipation, exponent } => {
            format!("HuntCrossley(dissipation: {dissipation:?}, exponent: {exponent:?})")
        }
        Normal::PowerLaw { damping, exponent, damping_exponent } => format!(
            "PowerLaw(exponent: {exponent:?}, damping_exponent: {damping_exponent:?}, damping: {damping:?})"
        ),
    };
    let friction = match surface.friction {
        Friction::Smooth => "None".to_owned(),
        Friction::Bristle { mu, excess, stiffness, damping } => format!(
            "Bristle(mu: {mu:?}, static_excess: {excess:?}, stiffness: {stiffness:?}, damping: {damping:?})"
        ),
        Friction::Coulomb { mu, slip_speed } => format!("Coulomb(mu: {mu:?}, slip_speed: {slip_speed:?})"),
    };
    format!("(stiffness: {:?}, normal: {normal}, friction: {friction})", surface.stiffness)
}

fn bound(body: &Body, group: usize) -> String {
    let mut text = String::new();
    if !body.grouping.bounds.is_empty() {
        let _ = write!(text, " bound: {},", body.grouping.bounds[group % body.grouping.bounds.len()]);
    }
    if let Some(size) = body.grouping.leaf_size {
        let _ = write!(text, " leaf_size: {size},");
    }
    text
}

/// Content of the root after its name: primitives directly, or groups with poses and leaves.
fn groups(text: &mut String, body: &Body) {
    let is_placed = body.place != pong_geometry::Pose::identity();
    if body.grouping.leaves.is_empty() && !is_placed {
        return primitives(text, body, 0..body.shapes.len());
    }
    let mut starts = vec![0];
    starts.extend(body.grouping.leaves.iter().scan(0, |sum, count| {
        *sum += count;
        Some(*sum)
    }));
    if starts.last() != Some(&body.shapes.len()) {
        starts.push(body.shapes.len());
    }
    text.push_str(" groups: [\n");
    for (leaf, range) in starts.windows(2).enumerate() {
        let _ = write!(text, "    (name: \"leaf {leaf}\",");
        if is_placed {
            let _ = write!(
                text,
                " pose: (position: {}, orientation: {}),",
                triple(&body.place.position),
                quaternion(&body.place.orientation)
            );
        }
        text.push_str(&bound(body, leaf + 1));
        for level in 0..body.grouping.depth {
            let _ = write!(text, " groups: [(name: \"level {level}\",{}", bound(body, leaf + level + 2));
        }
        primitives(text, body, range[0]..range[1]);
        text.push_str(&")]".repeat(body.grouping.depth));
        text.push_str("),\n");
    }
    text.push(']');
}

fn primitives(text: &mut String, body: &Body, range: std::ops::Range<usize>) {
    text.push_str(" primitives: [\n");
    for index in range {
        text.push_str("        ");
        primitive(text, &body.shapes[index], body.names[index]);
        text.push_str(",\n");
    }
    text.push_str("    ]");
}

fn primitive(text: &mut String, shape: &Shape, name: usize) {
    let _ = write!(text, "{}(name: \"{}_{name}\", ", shape.kind(), shape.kind().to_lowercase());
    let _ = match shape {
        Shape::Point { position } => write!(text, "position: {}", triple(position)),
        Shape::Segment { ends } => write!(text, "ends: ({}, {})", triple(&ends[0]), triple(&ends[1])),
        Shape::Ray { origin, direction, length, axial } => write!(
            text,
            "origin: {}, direction: {}, length: {length:?}, response: {}",
            triple(origin),
            triple(direction),
            if *axial { "Axial" } else { "Normal" }
        ),
        Shape::Sphere { center, radius } => write!(text, "center: {}, radius: {radius:?}", triple(center)),
        Shape::Ellipsoid { center, semi_axes, orientation } => write!(
            text,
            "center: {}, semi_axes: {}, orientation: {}",
            triple(center),
            triple(semi_axes),
            quaternion(orientation)
        ),
        Shape::Plane { normal, offset } => write!(text, "normal: {}, offset: {offset:?}", triple(normal)),
        Shape::Polyhedron(Solid { vertices, faces, inactive }) => {
            let _ = write!(text, "vertices: [{}], faces: {faces:?}", list(vertices));
            if inactive.is_empty() { Ok(()) } else { write!(text, ", inactive_faces: {inactive:?}") }
        }
        Shape::Mesh(Mesh { vertices, triangles, two_sided, thickness }) => {
            let _ = write!(text, "vertices: [{}], triangles: [", list(vertices));
            for [a, b, c] in triangles {
                let _ = write!(text, "({a}, {b}, {c}), ");
            }
            let _ = write!(text, "], two_sided: {two_sided}");
            thickness.map_or(Ok(()), |thickness| write!(text, ", thickness: {thickness:?}"))
        }
        Shape::Round(part) => {
            round_part(text, part);
            Ok(())
        }
    };
    text.push(')');
}

fn round_part(text: &mut String, part: &RoundPart) {
    let RoundPart { kind, ends: [p, q], radii: [r, s], thickness, mouths } = part;
    let _ = write!(text, "ends: ({}, {}), ", triple(p), triple(q));
    let _ = match kind {
        RoundKind::Capsule | RoundKind::Cylinder => write!(text, "radius: {r:?}"),
        RoundKind::Cone => write!(text, "radii: ({r:?}, {s:?})"),
        RoundKind::Bore => write!(text, "radii: ({r:?}, {s:?}), mouths: ({}, {})", mouths[0], mouths[1]),
    };
    if let Some(thickness) = thickness {
        let _ = write!(text, ", thickness: {thickness:?}");
    }
}

fn triple(v: &Vec3) -> String {
    format!("({:?}, {:?}, {:?})", v.x, v.y, v.z)
}

fn quaternion(q: &Quat) -> String {
    format!("({:?}, {:?}, {:?}, {:?})", q.w, q.i, q.j, q.k)
}

fn list(vertices: &[Vec3]) -> String {
    let mut text = String::with_capacity(60 * vertices.len());
    for vertex in vertices {
        text.push_str(&triple(vertex));
        text.push_str(", ");
    }
    text
}

/// Full text of a scene: both model files and every state.
pub fn scene(scene: &Scene) -> String {
    let mut text = String::new();
    for (body, name) in [(0, "a"), (1, "b")] {
        let _ = writeln!(text, "{name}.ron:\n{}", model(&scene.bodies[body], name, name));
    }
    let pair = if scene.swapped { "(b, a)" } else { "(a, b)" };
    let _ = writeln!(text, "pair {pair}; each frame is evaluated and committed:");
    for (index, states) in scene.frames.iter().enumerate() {
        for (state, name) in states.iter().zip(["a", "b"]) {
            let _ = writeln!(text, "  frame {index} {name}: {}", self::state(state));
        }
    }
    text
}

fn state(state: &State) -> String {
    let State { position, orientation, linear_velocity, angular_velocity } = state;
    format!("x {position:?} q {orientation:?} v {linear_velocity:?} w {angular_velocity:?}")
}
