//! Kinds of primitives, laws and bounding volumes.

use super::fields::{described, optional, required};
use super::types::{Field, Kind, Type};

/// Primitive as written. Files have two kinds that become triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Shape {
    Point,
    LineSegment,
    Ray,
    Sphere,
    Ellipsoid,
    Plane,
    Triangle,
    TriangleMesh,
    Polyhedron,
    Capsule,
    Cylinder,
    Cone,
    Bore,
    Custom,
}

/// Normal law as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Normal {
    Linear,
    HuntCrossley,
    PowerLaw,
    Custom,
}

/// Friction law as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Friction {
    None,
    Bristle,
    Coulomb,
    Custom,
}

/// Names of bounding volumes. `Custom` holds the name of a registered kind; `Above` is no volume of its own.
pub const BOUNDS: &[&str] = &["Aabb", "Sphere", "Obb", "Above", "Custom"];

/// Primitives, in the order of their tables in tools.
pub const PRIMITIVES: &[Kind<Shape>] = &[
    kind(Shape::Point, "Point", &[required("position", Type::Vector, "m")]),
    kind(Shape::LineSegment, "LineSegment", &[required("ends", Type::VectorPair, "m")]),
    kind(
        Shape::Ray,
        "Ray",
        &[
            required("origin", Type::Vector, "m"),
            required("direction", Type::Direction, ""),
            required("length", Type::Positive, "m"),
            described("reach", Type::NotNegative, "m", "thickness of a triangle or a bore, otherwise 0"),
            optional("response", Type::Word(&["Normal", "Axial"]), "", "Normal"),
        ],
    ),
    kind(
        Shape::Sphere,
        "Sphere",
        &[required("center", Type::Vector, "m"), required("radius", Type::Positive, "m")],
    ),
    kind(
        Shape::Ellipsoid,
        "Ellipsoid",
        &[
            required("center", Type::Vector, "m"),
            required("semi_axes", Type::SemiAxes, "m"),
            optional("orientation", Type::Rotation, "", "(1.0, 0.0, 0.0, 0.0)"),
        ],
    ),
    kind(
        Shape::Plane,
        "Plane",
        &[required("normal", Type::Direction, ""), required("offset", Type::Number, "m")],
    ),
    kind(
        Shape::Triangle,
        "Triangle",
        &[THICKNESS_OF_TRIANGLES, TWO_SIDED, required("vertices", Type::VectorTriple, "m")],
    ),
    kind(
        Shape::TriangleMesh,
        "TriangleMesh",
        &[
            FILE,
            SCALE,
            THICKNESS_OF_TRIANGLES,
            TWO_SIDED,
            described("vertices", Type::Vertices, "m", "those of `file`"),
            described("triangles", Type::Triangles, "", "those of `file`"),
        ],
    ),
    kind(
        Shape::Polyhedron,
        "Polyhedron",
        &[
            FILE,
            SCALE,
            optional("inactive_faces", Type::Indices, "", "[]"),
            described("vertices", Type::Vertices, "m", "those of `file`"),
            described("faces", Type::Faces, "", "those of `file`"),
        ],
    ),
    kind(Shape::Capsule, "Capsule", &[ENDS, required("radius", Type::Positive, "m")]),
    kind(Shape::Cylinder, "Cylinder", &[ENDS, required("radius", Type::Positive, "m")]),
    kind(Shape::Cone, "Cone", &[ENDS, RADII]),
    kind(
        Shape::Bore,
        "Bore",
        &[
            ENDS,
            RADII,
            described("thickness", Type::Positive, "m", "smaller radius; the other one if that is zero"),
            optional("mouths", Type::BooleanPair, "", "(true, true)"),
        ],
    ),
    kind(Shape::Custom, "Custom", &[required("kind", Type::Text, ""), PARAMETERS]),
];

const ENDS: Field = required("ends", Type::VectorPair, "m");
const RADII: Field = required("radii", Type::Radii, "m");
const FILE: Field = described("file", Type::Text, "", "none: the lists below are given");
const SCALE: Field = optional("scale", Type::Positive, "", "1.0");
const TWO_SIDED: Field = optional("two_sided", Type::Boolean, "", "false");
const PARAMETERS: Field = optional("parameters", Type::Numbers, "", "[]");
const THICKNESS_OF_TRIANGLES: Field =
    described("thickness", Type::Positive, "m", "smallest semi-axis of the body that touches");

/// Normal laws.
pub const NORMAL_LAWS: &[Kind<Normal>] = &[
    kind(
        Normal::Linear,
        "Linear",
        &[
            optional("damping", Type::NotNegative, "N·s/m", "0.0"),
            optional("ramp", Type::NotNegative, "m", "0.0"),
            described("restitution", Type::Record(&[E, MASS]), "", "`damping` counts"),
        ],
    ),
    kind(
        Normal::HuntCrossley,
        "HuntCrossley",
        &[
            optional("dissipation", Type::NotNegative, "s/m", "0.0"),
            required("exponent", Type::Exponent, ""),
            described("restitution", Type::Record(&[E, SPEED]), "", "`dissipation` counts"),
        ],
    ),
    kind(
        Normal::PowerLaw,
        "PowerLaw",
        &[
            required("exponent", Type::Exponent, ""),
            required("damping_exponent", Type::NotNegative, ""),
            optional("damping", Type::NotNegative, "N·s/m^(1+q)", "0.0"),
            described("restitution", Type::Record(&[E, SPEED, MASS]), "", "`damping` counts"),
        ],
    ),
    kind(Normal::Custom, "Custom", &[LAW, PARAMETERS]),
];

const E: Field = required("e", Type::Restitution, "");
const MASS: Field = required("mass", Type::Positive, "kg");
const SPEED: Field = required("speed", Type::Positive, "m/s");
const LAW: Field = required("name", Type::Text, "");

/// Friction laws.
pub const FRICTION_LAWS: &[Kind<Friction>] = &[
    kind(Friction::None, "None", &[]),
    kind(
        Friction::Bristle,
        "Bristle",
        &[
            required("mu", Type::NotNegative, ""),
            optional("static_excess", Type::NotNegative, "", "0.0"),
            described("stiffness", Type::FiniteStiffness, "N/m", "⅔ of the normal stiffness"),
            described("damping", Type::NotNegative, "N·s/m", "that of `mass`, else of the normal law"),
            described("mass", Type::Positive, "kg", "`damping` counts"),
            optional("rolling", Type::NotNegative, "m", "0.0"),
            optional("spinning", Type::NotNegative, "m", "0.0"),
        ],
    ),
    kind(
        Friction::Coulomb,
        "Coulomb",
        &[required("mu", Type::NotNegative, ""), required("slip_speed", Type::Positive, "m/s")],
    ),
    kind(Friction::Custom, "Custom", &[LAW, PARAMETERS]),
];

const fn kind<T: Copy>(tag: T, name: &'static str, fields: &'static [Field]) -> Kind<T> {
    Kind { tag, name, fields }
}
