//! Text of a body as a model file, and of a scene for messages.

use crate::round_part::{RoundKind, RoundPart};
use crate::scene::{Body, Friction, Mesh, Normal, Scene, Shape, Solid, Surface};
use pong_engine::State;
use pong_geometry::{Pose, Quat, Vec3};
use pong_model::authored::Value;
use pong_model::write;
use std::fmt::Write as _;

/// Fields of a struct before they become a value.
type Fields = Vec<(&'static str, Value)>;

/// The text of a model file.
pub fn model(body: &Body, name: &str, surface: &str) -> String {
    let mut root: Fields = vec![("name", Value::text(name)), ("surface", Value::text(surface))];
    root.extend(bound(body, 0));
    if body.is_solid {
        root.push(("contact", Value::name("Solid")));
    }
    if body.is_one_surface {
        root.push(("one_surface", Value::Bool(true)));
    }
    root.push(contents(body));
    let surfaces = Value::map([(surface, self::surface(&body.surface))]);
    write::text(&Value::model(name, [("surfaces", surfaces), ("root", Value::fields(root))]))
}

fn surface(surface: &Surface) -> Value {
    let number = Value::Number;
    let normal = match surface.normal {
        Normal::Linear { damping, ramp } => {
            Value::named("Linear", [("damping", number(damping)), ("ramp", number(ramp))])
        }
        Normal::HuntCrossley { dissipation, exponent } => Value::named(
            "HuntCrossley",
            [("dissipation", number(dissipation)), ("exponent", number(exponent))],
        ),
        Normal::PowerLaw { damping, exponent, damping_exponent } => Value::named(
            "PowerLaw",
            [
                ("exponent", number(exponent)),
                ("damping_exponent", number(damping_exponent)),
                ("damping", number(damping)),
            ],
        ),
    };
    let friction = match surface.friction {
        Friction::Smooth => Value::name("None"),
        Friction::Bristle { mu, excess, stiffness, damping } => Value::named(
            "Bristle",
            [
                ("mu", number(mu)),
                ("static_excess", number(excess)),
                ("stiffness", number(stiffness)),
                ("damping", number(damping)),
            ],
        ),
        Friction::Coulomb { mu, slip_speed } => {
            Value::named("Coulomb", [("mu", number(mu)), ("slip_speed", number(slip_speed))])
        }
    };
    Value::fields([("stiffness", number(surface.stiffness)), ("normal", normal), ("friction", friction)])
}

fn bound(body: &Body, group: usize) -> Fields {
    let mut fields = Fields::new();
    if !body.grouping.bounds.is_empty() {
        let bound = body.grouping.bounds[group % body.grouping.bounds.len()];
        fields.push(("bound", Value::name(bound)));
    }
    fields.extend(body.grouping.leaf_size.map(|size| ("leaf_size", Value::Number(size as f64))));
    fields
}

/// Content of the root: primitives directly, or groups with poses and leaves.
fn contents(body: &Body) -> (&'static str, Value) {
    let is_placed = body.place != Pose::identity();
    if body.grouping.leaves.is_empty() && !is_placed {
        return primitives(body, 0..body.shapes.len());
    }
    let mut starts = vec![0];
    starts.extend(body.grouping.leaves.iter().scan(0, |sum, count| {
        *sum += count;
        Some(*sum)
    }));
    if starts.last() != Some(&body.shapes.len()) {
        starts.push(body.shapes.len());
    }
    let leaves = starts.windows(2).enumerate().map(|(index, range)| leaf(body, index, range[0]..range[1]));
    ("groups", Value::list(leaves))
}

/// Leaf with further groups inside it, the innermost with the primitives.
fn leaf(body: &Body, index: usize, range: std::ops::Range<usize>) -> Value {
    let mut inner = primitives(body, range);
    for level in (0..body.grouping.depth).rev() {
        let mut fields: Fields = vec![("name", Value::text(&format!("level {level}")))];
        fields.extend(bound(body, index + level + 2));
        fields.push(inner);
        inner = ("groups", Value::list([Value::fields(fields)]));
    }
    let mut fields: Fields = vec![("name", Value::text(&format!("leaf {index}")))];
    if body.place != Pose::identity() {
        let pose = [
            ("position", triple(&body.place.position)),
            ("orientation", quaternion(&body.place.orientation)),
        ];
        fields.push(("pose", Value::fields(pose)));
    }
    fields.extend(bound(body, index + 1));
    fields.push(inner);
    Value::fields(fields)
}

fn primitives(body: &Body, range: std::ops::Range<usize>) -> (&'static str, Value) {
    ("primitives", Value::list(range.map(|index| primitive(&body.shapes[index], body.names[index]))))
}

fn primitive(shape: &Shape, name: usize) -> Value {
    let number = Value::Number;
    let mut fields: Fields = vec![("name", Value::text(&format!("{}_{name}", shape.kind().to_lowercase())))];
    match shape {
        Shape::Point { position } => fields.push(("position", triple(position))),
        Shape::Segment { ends } => fields.push(("ends", Value::tuple(ends.iter().map(triple)))),
        Shape::Ray { origin, direction, length, axial } => fields.extend([
            ("origin", triple(origin)),
            ("direction", triple(direction)),
            ("length", number(*length)),
            ("response", Value::name(if *axial { "Axial" } else { "Normal" })),
        ]),
        Shape::Sphere { center, radius } => {
            fields.extend([("center", triple(center)), ("radius", number(*radius))]);
        }
        Shape::Ellipsoid { center, semi_axes, orientation } => fields.extend([
            ("center", triple(center)),
            ("semi_axes", triple(semi_axes)),
            ("orientation", quaternion(orientation)),
        ]),
        Shape::Plane { normal, offset } => {
            fields.extend([("normal", triple(normal)), ("offset", number(*offset))]);
        }
        Shape::Polyhedron(solid) => fields.extend(polyhedron(solid)),
        Shape::Mesh(mesh) => fields.extend(triangle_mesh(mesh)),
        Shape::Round(part) => fields.extend(round_part(part)),
    }
    Value::named(shape.kind(), fields)
}

fn polyhedron(Solid { vertices, faces, inactive }: &Solid) -> Fields {
    let index = |index: &usize| *index as f64;
    let mut fields = vec![
        ("vertices", Value::rows(false, vertices.iter().map(|v| [v.x, v.y, v.z]))),
        ("faces", Value::rows(true, faces.iter().map(|face| face.iter().map(index)))),
    ];
    if !inactive.is_empty() {
        fields.push(("inactive_faces", Value::list(inactive.iter().map(index).map(Value::Number))));
    }
    fields
}

fn triangle_mesh(Mesh { vertices, triangles, two_sided, thickness }: &Mesh) -> Fields {
    let mut fields = vec![
        ("vertices", Value::rows(false, vertices.iter().map(|v| [v.x, v.y, v.z]))),
        (
            "triangles",
            Value::rows(false, triangles.iter().map(|corners| corners.map(|corner| corner as f64))),
        ),
        ("two_sided", Value::Bool(*two_sided)),
    ];
    fields.extend(thickness.map(|thickness| ("thickness", Value::Number(thickness))));
    fields
}

fn round_part(RoundPart { kind, ends, radii, thickness, mouths }: &RoundPart) -> Fields {
    let mut fields = vec![("ends", Value::tuple(ends.iter().map(triple)))];
    match kind {
        RoundKind::Capsule | RoundKind::Cylinder => fields.push(("radius", Value::Number(radii[0]))),
        RoundKind::Cone => fields.push(("radii", Value::numbers(radii))),
        RoundKind::Bore => fields.extend([
            ("radii", Value::numbers(radii)),
            ("mouths", Value::tuple(mouths.iter().map(|mouth| Value::Bool(*mouth)))),
        ]),
    }
    fields.extend(thickness.map(|thickness| ("thickness", Value::Number(thickness))));
    fields
}

fn triple(v: &Vec3) -> Value {
    Value::numbers(v.as_slice())
}

fn quaternion(q: &Quat) -> Value {
    Value::numbers(&[q.w, q.i, q.j, q.k])
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
        for (motion, name) in scene.motions.get(index).into_iter().flatten().zip(["a", "b"]) {
            let _ = writeln!(text, "  frame {index} surface of {name}: {motion:?}");
        }
    }
    text
}

fn state(state: &State) -> String {
    let State { position, orientation, linear_velocity, angular_velocity } = state;
    format!("x {position:?} q {orientation:?} v {linear_velocity:?} w {angular_velocity:?}")
}
