//! A scene as plain data: two bodies and the states of a history. Models and twins are made from it.

use crate::round_part::RoundPart;
use pong_engine::{State, SurfaceMotion};
use pong_geometry::{Pose, Quat, Vec3};

/// Two bodies and their motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Name of the family that generated it.
    pub family: &'static str,
    /// The bodies; the first is named first in the pair, unless `swapped`.
    pub bodies: [Body; 2],
    /// True if the second body is named first in the pair.
    pub swapped: bool,
    /// States of both movable groups, frame by frame; each frame is evaluated and committed.
    pub frames: Vec<[State; 2]>,
    /// Motions of the surfaces of both groups along themselves, frame by frame; empty if none moves.
    pub motions: Vec<[SurfaceMotion; 2]>,
    /// Approximate size of the bodies, m.
    pub size: f64,
}

/// One Object with one movable group.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its primitives, in the order of the model.
    pub shapes: Vec<Shape>,
    /// Number in the name of each primitive.
    pub names: Vec<usize>,
    /// Common surface of all primitives.
    pub surface: Surface,
    /// Grouping of the primitives.
    pub grouping: Grouping,
    /// Pose of the group that holds the primitives, in the movable group.
    pub place: Pose,
    /// True if the primitives touch by the volume they share (`contact: Solid`).
    pub is_solid: bool,
    /// True if the primitives are declared one surface (`one_surface: true`).
    pub is_one_surface: bool,
}

/// Grouping of primitives below the movable group.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grouping {
    /// Number of consecutive primitives in each leaf; one leaf with all if empty.
    pub leaves: Vec<usize>,
    /// Bounding volume of each group, in turn; the default if empty.
    pub bounds: Vec<&'static str>,
    /// Most elements of a leaf, if limited.
    pub leaf_size: Option<usize>,
    /// Number of additional nested groups above the leaves.
    pub depth: usize,
}

/// Stiffness and laws of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Stiffness, N/m or N/m^1.5; infinite for a rigid surface.
    pub stiffness: f64,
    /// Law of the normal force.
    pub normal: Normal,
    /// Law of friction.
    pub friction: Friction,
}

/// Law of the normal force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Normal {
    /// Spring and damper.
    Linear {
        /// Damping coefficient, N·s/m.
        damping: f64,
        /// Depth over which the damping sets in, m.
        ramp: f64,
    },
    /// Damping that grows with depth.
    HuntCrossley {
        /// Dissipation coefficient, s/m.
        dissipation: f64,
        /// Exponent of the depth, 1 or 1.5.
        exponent: f64,
    },
    /// Spring and damper, each by a power of the depth.
    PowerLaw {
        /// Damping coefficient, N·s/m^(1 + damping_exponent).
        damping: f64,
        /// Exponent of the depth, 1 or 1.5.
        exponent: f64,
        /// Exponent of the depth in the damping, 0 to `exponent`.
        damping_exponent: f64,
    },
}

/// Law of friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// None.
    Smooth,
    /// A bristle that sticks and slips.
    Bristle {
        /// Kinetic coefficient of friction.
        mu: f64,
        /// Static excess μ_s/μ_k − 1.
        excess: f64,
        /// Bristle stiffness, N/m.
        stiffness: f64,
        /// Bristle damping, N·s/m.
        damping: f64,
    },
    /// Regularised Coulomb friction.
    Coulomb {
        /// Coefficient of friction.
        mu: f64,
        /// Speed at which the full force is reached, m/s.
        slip_speed: f64,
    },
}

/// A primitive, with the fields of a model file. Lengths in m.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum Shape {
    Point { position: Vec3 },
    Segment { ends: [Vec3; 2] },
    Ray { origin: Vec3, direction: Vec3, length: f64, axial: bool },
    Sphere { center: Vec3, radius: f64 },
    Ellipsoid { center: Vec3, semi_axes: Vec3, orientation: Quat },
    Plane { normal: Vec3, offset: f64 },
    Polyhedron(Solid),
    Mesh(Mesh),
    Round(RoundPart),
}

/// A convex solid; each face counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solid {
    /// Corners, m.
    pub vertices: Vec<Vec3>,
    /// Corners of each face.
    pub faces: Vec<Vec<usize>>,
    /// Internal faces.
    pub inactive: Vec<usize>,
}

/// Triangles, each counter-clockwise seen from the front.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners, m.
    pub vertices: Vec<Vec3>,
    /// Corners of each triangle.
    pub triangles: Vec<[usize; 3]>,
    /// True if the back makes contact too.
    pub two_sided: bool,
    /// Depth behind the front to which a centre is pushed, m; by default the smallest semi-axis of the
    /// touching primitive.
    pub thickness: Option<f64>,
}

impl Shape {
    /// Name of its kind in a model file.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Point { .. } => "Point",
            Self::Segment { .. } => "LineSegment",
            Self::Ray { .. } => "Ray",
            Self::Sphere { .. } => "Sphere",
            Self::Ellipsoid { .. } => "Ellipsoid",
            Self::Plane { .. } => "Plane",
            Self::Polyhedron(_) => "Polyhedron",
            Self::Mesh(_) => "TriangleMesh",
            Self::Round(part) => part.kind_name(),
        }
    }

    /// The primitive transformed by a pose.
    pub fn carried(&self, pose: &Pose) -> Self {
        let point = |p: &Vec3| pose.orientation * p + pose.position;
        let turned = |v: &Vec3| pose.orientation * v;
        match self {
            Self::Point { position } => Self::Point { position: point(position) },
            Self::Segment { ends } => Self::Segment { ends: [point(&ends[0]), point(&ends[1])] },
            Self::Ray { origin, direction, length, axial } => Self::Ray {
                origin: point(origin),
                direction: turned(direction),
                length: *length,
                axial: *axial,
            },
            Self::Sphere { center, radius } => Self::Sphere { center: point(center), radius: *radius },
            Self::Ellipsoid { center, semi_axes, orientation } => Self::Ellipsoid {
                center: point(center),
                semi_axes: *semi_axes,
                orientation: pose.orientation * orientation,
            },
            Self::Plane { normal, offset } => {
                let normal = turned(normal);
                Self::Plane { normal, offset: offset * normal.norm() + normal.dot(&pose.position) }
            }
            Self::Polyhedron(solid) => Self::Polyhedron(Solid {
                vertices: solid.vertices.iter().map(point).collect(),
                ..solid.clone()
            }),
            Self::Mesh(mesh) => {
                Self::Mesh(Mesh { vertices: mesh.vertices.iter().map(point).collect(), ..mesh.clone() })
            }
            Self::Round(part) => Self::Round(part.carried(pose)),
        }
    }

    /// The primitive in another unit of length.
    pub fn scaled(&self, s: f64) -> Self {
        match self {
            Self::Point { position } => Self::Point { position: position * s },
            Self::Segment { ends } => Self::Segment { ends: ends.map(|end| end * s) },
            Self::Ray { origin, direction, length, axial } => {
                Self::Ray { origin: origin * s, direction: *direction, length: length * s, axial: *axial }
            }
            Self::Sphere { center, radius } => Self::Sphere { center: center * s, radius: radius * s },
            Self::Ellipsoid { center, semi_axes, orientation } => {
                Self::Ellipsoid { center: center * s, semi_axes: semi_axes * s, orientation: *orientation }
            }
            Self::Plane { normal, offset } => Self::Plane { normal: *normal, offset: offset * s },
            Self::Polyhedron(solid) => Self::Polyhedron(Solid {
                vertices: solid.vertices.iter().map(|v| v * s).collect(),
                ..solid.clone()
            }),
            Self::Mesh(mesh) => Self::Mesh(Mesh {
                vertices: mesh.vertices.iter().map(|v| v * s).collect(),
                // `black_box`: the compiler may multiply before it tests for a thickness, on undefined bits
                // (ci/traps).
                thickness: mesh.thickness.and(Some(std::hint::black_box(mesh.thickness.unwrap_or(0.0)) * s)),
                ..mesh.clone()
            }),
            Self::Round(part) => Self::Round(part.scaled(s)),
        }
    }

    /// Area of the outer faces of a polyhedron, or of the triangles of a mesh, m²; zero for other kinds.
    fn outer_area(&self) -> f64 {
        if let Self::Mesh(mesh) = self {
            let area = |triangle: &[usize; 3]| {
                let [p, q, r] = triangle.map(|index| mesh.vertices[index]);
                (q - p).cross(&(r - p)).norm() / 2.0
            };
            return mesh.triangles.iter().map(area).sum();
        }
        let Self::Polyhedron(solid) = self else { return 0.0 };
        let outer = (0..).zip(&solid.faces).filter(|(index, _)| !solid.inactive.contains(index));
        let area = |face: &[usize]| {
            let side = |at: usize| solid.vertices[face[at]] - solid.vertices[face[0]];
            (1..face.len() - 1).map(|at| side(at).cross(&side(at + 1))).sum::<Vec3>().norm() / 2.0
        };
        outer.map(|(_, face)| area(face)).sum()
    }

    /// Corners that a model may give in single precision.
    pub fn vertices_mut(&mut self) -> &mut [Vec3] {
        match self {
            Self::Polyhedron(solid) => &mut solid.vertices,
            Self::Mesh(mesh) => &mut mesh.vertices,
            Self::Round(part) => &mut part.ends,
            _ => &mut [],
        }
    }
}

impl Body {
    /// A body of these primitives.
    pub fn new(shapes: Vec<Shape>, surface: Surface) -> Self {
        let names = (0..shapes.len()).collect();
        Self {
            shapes,
            names,
            surface,
            grouping: Grouping::default(),
            place: Pose::identity(),
            is_solid: false,
            is_one_surface: false,
        }
    }

    /// The body with other primitives.
    pub fn with_shapes(&self, shapes: Vec<Shape>) -> Self {
        let names = (0..shapes.len()).collect();
        Self { shapes, names, grouping: Grouping::default(), ..self.clone() }
    }
}

impl Scene {
    /// True if the bodies touch by the volume they share.
    pub fn is_of_solids(&self) -> bool {
        self.bodies.iter().any(|body| body.is_solid)
    }

    /// Smallest reference area of a solid body, m²: a sixth of its outer surface.
    pub fn reference_area(&self) -> f64 {
        let solids = self.bodies.iter().filter(|body| body.is_solid);
        let outer = solids.map(|body| body.shapes.iter().map(Shape::outer_area).sum::<f64>());
        outer.fold(f64::INFINITY, f64::min) / 6.0
    }

    /// Spring of the pair at depths like the scene's size, N/m, for rounding allowances.
    pub fn stiffness(&self) -> f64 {
        let [a, b] = [0, 1].map(|body| {
            let surface = &self.bodies[body].surface;
            match surface.normal {
                Normal::HuntCrossley { exponent, .. } | Normal::PowerLaw { exponent, .. }
                    if exponent > 1.0 =>
                {
                    surface.stiffness * self.size.sqrt()
                }
                _ => surface.stiffness,
            }
        });
        if a.is_infinite() {
            b
        } else if b.is_infinite() {
            a
        } else {
            a * b / (a + b)
        }
    }

    /// Largest damping of either surface, N·s/m.
    pub fn damping(&self) -> f64 {
        self.damping_at(self.size)
    }

    /// Largest damping of either surface at a depth in m, N·s/m.
    pub fn damping_at(&self, depth: f64) -> f64 {
        let of = |surface: &Surface| {
            let normal = match surface.normal {
                Normal::Linear { damping, .. } => damping,
                Normal::HuntCrossley { dissipation, .. } => dissipation * surface.stiffness.min(1e12) * depth,
                Normal::PowerLaw { damping, damping_exponent, .. } => {
                    damping * libm::pow(depth, damping_exponent)
                }
            };
            let friction = match surface.friction {
                Friction::Bristle { damping, .. } => damping,
                Friction::Smooth | Friction::Coulomb { .. } => 0.0,
            };
            normal + friction
        };
        of(&self.bodies[0].surface) + of(&self.bodies[1].surface)
    }
}
