//! Local shape of a primitive at a contact: how its contact point moves when the normal turns.
//!
//! A convex primitive has one point farthest along each direction. If the direction turns by dm, that point moves
//! by H·dm, where H holds the radii of curvature. A corner has H = 0. Along an edge or a generator the point is
//! not determined: there the normal cannot turn instead. On a face the normal cannot turn at all.

use pong_geometry::extension::PrimitiveRef;
use pong_geometry::interference::triangle_features::TriangleView;
use pong_geometry::interference::{Feature, FeatureKind};
use pong_geometry::primitive::{Bore, Ellipsoid, Frustum, Polyhedron, TriangleSet};
use pong_geometry::{Mat3, Vec3};

/// Local shape at a contact. All vectors are in one frame.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shape {
    /// Corner or curved surface: matrix H of the radii of curvature, m, symmetric, zero along the normal.
    Round(Mat3),
    /// Edge or generator: unit vector along it, and the radius of curvature across it, m.
    Straight { along: Vec3, radius: f64 },
    /// Flat face.
    Flat,
}

impl Shape {
    /// Corner of no extent.
    pub const CORNER: Self = Self::Round(Mat3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0));

    /// Shape in a frame that is turned by a rotation matrix.
    pub fn rotated(&self, rotation: &Mat3) -> Self {
        match self {
            Self::Round(radii) => Self::Round(rotation * radii * rotation.transpose()),
            Self::Straight { along, radius } => Self::Straight { along: rotation * along, radius: *radius },
            Self::Flat => Self::Flat,
        }
    }

    /// Shape of a ball.
    fn ball(radius: f64, outward: &Vec3) -> Self {
        Self::Round((Mat3::identity() - outward * outward.transpose()) * radius)
    }

    /// Shape of an ellipsoid where its outward normal is `outward`: the support point is A²·m/√(mᵀA²m).
    fn of_ellipsoid(ellipsoid: &Ellipsoid, outward: &Vec3) -> Self {
        let squares = ellipsoid.semi_axes.component_mul(&ellipsoid.semi_axes);
        let matrix = ellipsoid.axes * Mat3::from_diagonal(&squares) * ellipsoid.axes.transpose();
        let pole = matrix * outward;
        let reach = outward.dot(&pole).sqrt();
        Self::Round(matrix / reach - pole * pole.transpose() / (reach * reach * reach))
    }

    /// Shape of a circle, the rim of a disc or the mouth of a hole, at one of its points. `None` if the contact is
    /// not on the circle, or its normal not perpendicular to it.
    fn of_rim(&Circle { center, axis, radius }: &Circle<'_>, place: &Vec3, outward: &Vec3) -> Option<Self> {
        let arm = place - center;
        let arm = arm - axis * axis.dot(&arm);
        let rounding = rounding(&[place, center]);
        if radius <= rounding {
            return Some(Self::CORNER);
        }
        let away = arm / radius.max(f64::MIN_POSITIVE);
        let (along, lean) = (axis.cross(&away), outward.dot(&away));
        // Where the normal is along the axis, the whole rim touches.
        let is_on = (arm.norm() - radius).abs() <= rounding && along.dot(outward).abs() <= ROUNDING;
        (is_on && lean.abs() > ROUNDING).then(|| Self::Round(along * along.transpose() * (radius / lean)))
    }

    /// Shape of the side of a round solid, or of the wall of a hole, at a point of its surface. `None` if the normal
    /// does not pass through the axis.
    fn of_side(frustum: &Frustum, place: &Vec3, outward: &Vec3) -> Option<Self> {
        let arm = place - frustum.ends[0];
        let lean = outward - frustum.axis * frustum.axis.dot(outward);
        let (square, across) = (lean.norm_squared(), outward.cross(&frustum.axis));
        let is_through = across.dot(&arm).abs() <= rounding(&[place, &frustum.ends[0]]);
        // The radius is the distance of the point from the axis along the normal.
        (square > ROUNDING && is_through).then(|| {
            let along = across.normalize().cross(outward);
            Self::Straight { along, radius: arm.dot(&lean) / square.max(f64::MIN_POSITIVE) }
        })
    }
}

/// A circle in space.
struct Circle<'a> {
    center: &'a Vec3,
    axis: &'a Vec3,
    radius: f64,
}

impl<'a> Circle<'a> {
    fn at_end(frustum: &'a Frustum, end: usize) -> Self {
        Self { center: &frustum.ends[end], axis: &frustum.axis, radius: frustum.radii[end] }
    }
}

/// A primitive at a contact, in the frame in which the contact is given.
pub(super) struct AtContact<'a> {
    element: PrimitiveRef<'a>,
    /// Contact point on the surface of the primitive, m.
    place: Vec3,
    /// Outward unit normal of the primitive.
    outward: Vec3,
}

/// Fraction of an axis from its end within which a point counts as the end.
const AT_END: f64 = 1e-9;

/// Rounding of the product of two unit vectors, and of a point relative to its coordinates.
const ROUNDING: f64 = 1e-9;

/// Rounding of a distance between points, m.
fn rounding(points: &[&Vec3]) -> f64 {
    points.iter().map(|point| point.amax()).fold(0.0, f64::max) * ROUNDING
}

impl<'a> AtContact<'a> {
    /// A primitive whose surface has the contact point `place` and there the outward unit normal `outward`, all in one
    /// frame.
    pub fn new(element: PrimitiveRef<'a>, place: Vec3, outward: Vec3) -> Self {
        Self { element, place, outward }
    }

    /// Shape of the primitive as A. `on_edge` is true if an edge of B pushes. `None` for kinds without a known
    /// shape, and where the shape is not unique.
    pub fn shape_of_a(&self, on_edge: bool) -> Option<Shape> {
        match self.element {
            PrimitiveRef::Point(_) | PrimitiveRef::Ray(_) => Some(Shape::CORNER),
            PrimitiveRef::Sphere(sphere) => Some(Shape::ball(sphere.radius, &self.outward)),
            PrimitiveRef::Ellipsoid(ellipsoid) => {
                let is_pole = self.is_at(&ellipsoid.support(&self.outward));
                is_pole.then(|| Shape::of_ellipsoid(ellipsoid, &self.outward))
            }
            PrimitiveRef::LineSegment(segment) => self.of_axis(&segment.ends, 0.0),
            PrimitiveRef::Capsule(capsule) => self.of_axis(&capsule.ends, capsule.radius),
            PrimitiveRef::Cylinder(frustum) | PrimitiveRef::Cone(frustum) => {
                match on_edge && is_between(&self.place, &frustum.ends) {
                    true => Shape::of_side(frustum, &self.place, &self.outward),
                    false => self.of_end_disc(frustum),
                }
            }
            _ => None,
        }
    }

    /// Shape of a segment, or of a capsule, whose axis has these ends.
    fn of_axis(&self, ends: &[Vec3; 2], radius: f64) -> Option<Shape> {
        if !is_between(&(self.place - self.outward * radius), ends) {
            return Some(Shape::ball(radius, &self.outward));
        }
        let along = (ends[1] - ends[0]).normalize();
        let across = along.cross(&self.outward).dot(&(self.place - ends[0]));
        (across.abs() <= rounding(&[&self.place, &ends[0]])).then_some(Shape::Straight { along, radius })
    }

    fn of_end_disc(&self, frustum: &Frustum) -> Option<Shape> {
        let end = usize::from(fraction(&self.place, &frustum.ends) > 0.5);
        Shape::of_rim(&Circle::at_end(frustum, end), &self.place, &self.outward)
    }

    /// True at the end of the side of a round solid, where its outward normal is still that of the side.
    pub fn is_end_of_wall(&self) -> bool {
        let (PrimitiveRef::Cylinder(frustum) | PrimitiveRef::Cone(frustum)) = self.element else {
            return false;
        };
        let is_on_wall = (self.outward.dot(&frustum.axis) - frustum.wall[0]).abs() < ROUNDING;
        is_on_wall && !is_between(&self.place, &frustum.ends)
    }

    /// Shape of the primitive as B, whose `feature` pushes.
    pub fn shape_of_b(&self, feature: Feature) -> Option<Shape> {
        match self.element {
            PrimitiveRef::Plane(_) => Some(Shape::Flat),
            PrimitiveRef::Sphere(sphere) => Some(Shape::ball(sphere.radius, &self.outward)),
            PrimitiveRef::Ellipsoid(ellipsoid) => Some(Shape::of_ellipsoid(ellipsoid, &self.outward)),
            PrimitiveRef::Capsule(capsule) => self.of_axis(&capsule.ends, capsule.radius),
            PrimitiveRef::Cylinder(frustum) | PrimitiveRef::Cone(frustum) => self.of_frustum(frustum),
            PrimitiveRef::Bore(bore) => self.of_bore(bore, feature),
            PrimitiveRef::Triangle(set, _) => self.of_triangles(set, feature),
            PrimitiveRef::Polyhedron(polyhedron) => self.of_polyhedron(polyhedron, feature),
            _ => None,
        }
    }

    /// End, side or rim of a round solid, by the direction of the normal.
    fn of_frustum(&self, frustum: &Frustum) -> Option<Shape> {
        let along = self.outward.dot(&frustum.axis);
        if is_along(along) && frustum.radii[usize::from(along > 0.0)] > 0.0 {
            return Some(Shape::Flat);
        }
        let is_on_wall = (along - frustum.wall[0]).abs() < ROUNDING;
        match is_on_wall && is_between(&self.place, &frustum.ends) {
            true => Shape::of_side(frustum, &self.place, &self.outward),
            false => self.of_end_disc(frustum),
        }
    }

    /// Features of a bore: its wall, and as edges its two mouths.
    fn of_bore(&self, bore: &Bore, feature: Feature) -> Option<Shape> {
        if is_along(self.outward.dot(&bore.hole.axis)) {
            return Some(Shape::Flat);
        }
        match feature.kind() {
            FeatureKind::Face => Shape::of_side(&bore.hole, &self.place, &self.outward),
            _ => Shape::of_rim(&Circle::at_end(&bore.hole, feature.index()), &self.place, &self.outward),
        }
    }

    fn of_triangles(&self, set: &TriangleSet, feature: Feature) -> Option<Shape> {
        let index = feature.index();
        match feature.kind() {
            FeatureKind::Face => Some(Shape::Flat),
            FeatureKind::Edge => {
                self.of_edge(TriangleView::new(set, (index / 3) as u32).edge_ends(index % 3))
            }
            FeatureKind::Vertex => Some(Shape::CORNER),
        }
    }

    fn of_polyhedron(&self, polyhedron: &Polyhedron, feature: Feature) -> Option<Shape> {
        match feature.kind() {
            FeatureKind::Face => {
                let is_normal = (polyhedron.faces[feature.index()].normal - self.outward).amax() < ROUNDING;
                is_normal.then_some(Shape::Flat)
            }
            FeatureKind::Edge => {
                let edge = &polyhedron.edges[feature.index()];
                // A normal of one of its two faces may be that of the face.
                let is_face =
                    |face: u32| (polyhedron.faces[face as usize].normal - self.outward).amax() < ROUNDING;
                let ends = edge.vertices.map(|vertex| polyhedron.vertices[vertex as usize].position);
                if edge.faces.into_iter().any(is_face) { None } else { self.of_edge(ends) }
            }
            FeatureKind::Vertex => Some(Shape::CORNER),
        }
    }

    /// Shape of an edge, or of one of its ends. `None` if the contact is not on the edge.
    fn of_edge(&self, ends: [Vec3; 2]) -> Option<Shape> {
        if ends.iter().any(|end| self.is_at(end)) {
            return Some(Shape::CORNER);
        }
        let along = (ends[1] - ends[0]).normalize();
        let arm = self.place - ends[0];
        let is_across = self.outward.dot(&along).abs() < ROUNDING;
        (is_across && self.is_at(&(ends[0] + along * along.dot(&arm))))
            .then_some(Shape::Straight { along, radius: 0.0 })
    }

    /// True if the contact is at a point, to rounding.
    fn is_at(&self, point: &Vec3) -> bool {
        (self.place - point).amax() <= rounding(&[&self.place, point])
    }
}

/// True for the product of two parallel unit vectors.
fn is_along(cosine: f64) -> bool {
    cosine.abs() > 1.0 - 1e-14
}

/// Position of a point along an axis: 0 at its first end, 1 at its second.
fn fraction(place: &Vec3, ends: &[Vec3; 2]) -> f64 {
    let axis = ends[1] - ends[0];
    (place - ends[0]).dot(&axis) / axis.norm_squared()
}

/// True if a point lies between the ends of an axis, at neither of them.
fn is_between(place: &Vec3, ends: &[Vec3; 2]) -> bool {
    let fraction = fraction(place, ends);
    AT_END < fraction && fraction < 1.0 - AT_END
}
