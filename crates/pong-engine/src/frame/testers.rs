//! Pairs of primitives: carries A into B's frame, runs the tester, hands out contacts under their keys.

use super::bounding::{Found, LeafItems, PairContext};
use super::buffers::{FrameContact, Stance};
use super::relative::Motion;
use super::side_of_entry::{PolyhedronEntry, TriangleEntry};
use crate::dispatch::has_tester;
use crate::state::{ContactKey, ContactMemory};
use pong_geometry::extension::PrimitiveRef;
use pong_geometry::interference::triangle_features::{Standing, TriangleContact};
use pong_geometry::interference::{
    Interference, ellipsoid_plane::ellipsoid_plane, ellipsoid_polyhedron::ellipsoid_polyhedron,
    ellipsoid_triangle::ellipsoid_triangle, line_segment_plane::line_segment_plane,
    line_segment_polyhedron::line_segment_polyhedron, point_ellipsoid::point_ellipsoid,
    point_plane::point_plane, point_polyhedron::point_below_face, point_sphere::point_sphere,
    ray_plane::RayHit, ray_plane::ray_contact, ray_plane::ray_plane, ray_polyhedron::ray_polyhedron,
    ray_triangle::ray_triangle, sphere_plane::sphere_plane, sphere_polyhedron::sphere_inside_polyhedron,
    sphere_polyhedron::sphere_outside_polyhedron, sphere_sphere::sphere_sphere,
    sphere_triangle::sphere_triangle,
};
use pong_geometry::primitive::PrimitiveKind::{self, Custom, Plane, Polyhedron, Triangle};
use pong_geometry::primitive::{Ellipsoid, LineSegment, Point, Ray, Sphere};
use pong_geometry::{Transform, Vec3};
use pong_model::{Body, Item, PrimitiveInfo};

/// Tests everything in one leaf against everything in another, in the orders that the table knows.
pub(super) fn test_leaves(
    context: &PairContext<'_>,
    leaves: LeafItems<'_>,
    memory: &ContactMemory,
    found: &mut Found<'_>,
) {
    for flipped in [0, 1] {
        for &item_a in leaves[flipped] {
            let kind_a = kind_of(context.bodies[flipped], item_a);
            let a = Carried::new(context.bodies[flipped], item_a, &context.motions[flipped].x_ba);
            if a.is_none() && context.scene.extensions.has_no_contact_tests() {
                continue;
            }
            for &item_b in leaves[1 - flipped] {
                let kind_b = kind_of(context.bodies[1 - flipped], item_b);
                // Of two primitives of one kind, A is that of the Object named first.
                if kind_a == kind_b && (flipped == 0) != context.first_named_first {
                    continue;
                }
                let side = Side { context, memory, flipped, item_a, item_b };
                match &a {
                    Some(a) if has_tester(kind_a, kind_b) => {
                        found.report.primitives_tested += 1;
                        side.test(a, kind_b, found);
                    }
                    _ if context.scene.extensions.has_no_contact_tests() => {}
                    _ => side.test_custom(found),
                }
            }
        }
    }
}

fn kind_of(body: &Body, item: Item) -> PrimitiveKind {
    body.primitives[item.primitive as usize].kind
}

/// A primitive that can be A, in B's frame: carried once for everything that it meets in a leaf.
enum Carried {
    Point(Point),
    Segment(LineSegment),
    Ray(Ray),
    Sphere(Sphere),
    Ellipsoid(Ellipsoid),
}

impl Carried {
    /// `None` for kinds that are never A in the table.
    fn new(body: &Body, item: Item, x_ba: &Transform) -> Option<Self> {
        let i = item.element as usize;
        Some(match kind_of(body, item) {
            PrimitiveKind::Point => Self::Point(body.points[i].carried(x_ba)),
            PrimitiveKind::LineSegment => Self::Segment(body.segments[i].carried(x_ba)),
            PrimitiveKind::Ray => Self::Ray(body.rays[i].carried(x_ba)),
            PrimitiveKind::Sphere => Self::Sphere(body.spheres[i].carried(x_ba)),
            PrimitiveKind::Ellipsoid => Self::Ellipsoid(body.ellipsoids[i].carried(x_ba)),
            Triangle | Polyhedron | Plane | Custom => return None,
        })
    }
}

/// One element as A against one element as B.
struct Side<'a> {
    context: &'a PairContext<'a>,
    memory: &'a ContactMemory,
    flipped: usize,
    item_a: Item,
    item_b: Item,
}

impl<'a> Side<'a> {
    fn body_a(&self) -> &'a Body {
        self.context.bodies[self.flipped]
    }

    fn body_b(&self) -> &'a Body {
        self.context.bodies[1 - self.flipped]
    }

    fn motion(&self) -> &'a Motion {
        &self.context.motions[self.flipped]
    }

    fn info_b(&self) -> &'a PrimitiveInfo {
        &self.body_b().primitives[self.item_b.primitive as usize]
    }

    fn test(&self, a: &Carried, kind_b: PrimitiveKind, found: &mut Found<'_>) {
        match a {
            Carried::Point(point) => self.test_point(point, kind_b, found),
            Carried::Segment(segment) => self.test_segment(segment, kind_b, found),
            Carried::Ray(ray) => self.test_ray(ray, kind_b, found),
            Carried::Sphere(sphere) => self.test_sphere(sphere, kind_b, found),
            Carried::Ellipsoid(ellipsoid) => self.test_ellipsoid(ellipsoid, kind_b, found),
        }
    }

    fn test_point(&self, point: &Point, kind_b: PrimitiveKind, found: &mut Found<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        match kind_b {
            Plane => self.whole(point_plane(point, &body.planes[b]), found),
            PrimitiveKind::Sphere => self.whole(point_sphere(point, &body.spheres[b]), found),
            PrimitiveKind::Ellipsoid => {
                self.whole(point_ellipsoid(&point.position, &body.ellipsoids[b]), found);
            }
            _ => {
                let polyhedron = &body.polyhedra[b];
                if !polyhedron.contains(&point.position) {
                    return;
                }
                let local = self.body_a().points[self.item_a.element as usize].position;
                let Some(face) = self.entry_face(&local, &point.position) else { return };
                let contact = point_below_face(&point.position, polyhedron, face.pushes);
                self.with_entry_face(contact, face.reached, found);
            }
        }
    }

    fn test_segment(&self, segment: &LineSegment, kind_b: PrimitiveKind, found: &mut Found<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        let ends = match kind_b {
            Plane => line_segment_plane(segment, &body.planes[b]),
            _ => line_segment_polyhedron(segment, &body.polyhedra[b]),
        };
        for (end, contact) in ends.iter().enumerate() {
            let Some(contact) = contact else { continue };
            self.emit(contact, found, |out| {
                out.key.end = end as u32;
                out.half = true;
            });
        }
    }

    fn test_ray(&self, ray: &Ray, kind_b: PrimitiveKind, found: &mut Found<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        let hit: Option<RayHit> = match kind_b {
            Plane => ray_plane(ray, &body.planes[b]),
            Polyhedron => ray_polyhedron(ray, &body.polyhedra[b]),
            _ => {
                let reach = ray.reach.or(self.info_b().thickness).unwrap_or(0.0);
                ray_triangle(ray, &body.triangles, self.item_b.element, reach)
            }
        };
        if let Some(hit) = hit {
            self.emit(&ray_contact(ray, &hit), found, |out| out.ray_distance = Some(hit.distance));
        }
    }

    fn test_sphere(&self, sphere: &Sphere, kind_b: PrimitiveKind, found: &mut Found<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        match kind_b {
            Plane => self.whole(sphere_plane(sphere, &body.planes[b]), found),
            PrimitiveKind::Sphere => self.whole(sphere_sphere(sphere, &body.spheres[b]), found),
            Polyhedron => self.test_sphere_polyhedron(sphere, found),
            _ => {
                let local = self.body_a().spheres[self.item_a.element as usize].center;
                let thickness = self.info_b().thickness.unwrap_or(sphere.radius);
                let mut emit = |contact| self.on_triangle(&local, &sphere.center, contact, found);
                sphere_triangle(sphere, &body.triangles, self.item_b.element, thickness, &mut emit);
            }
        }
    }

    fn test_sphere_polyhedron(&self, sphere: &Sphere, found: &mut Found<'_>) {
        let polyhedron = &self.body_b().polyhedra[self.item_b.element as usize];
        // Most pairs end here: apart by the plane of one face.
        if polyhedron.faces.iter().any(|face| face.height(&sphere.center) >= sphere.radius) {
            return;
        }
        if !polyhedron.contains(&sphere.center) {
            self.sharing(sphere_outside_polyhedron(sphere, polyhedron), found);
            return;
        }
        let local = self.body_a().spheres[self.item_a.element as usize].center;
        let Some(face) = self.entry_face(&local, &sphere.center) else { return };
        let contact = sphere_inside_polyhedron(sphere, polyhedron, face.pushes);
        self.emit(&contact, found, |out| {
            out.shares = true;
            out.entry_face = face.reached as u32;
        });
    }

    fn test_ellipsoid(&self, ellipsoid: &Ellipsoid, kind_b: PrimitiveKind, found: &mut Found<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        match kind_b {
            Plane => self.whole(ellipsoid_plane(ellipsoid, &body.planes[b]), found),
            Polyhedron => self.sharing(ellipsoid_polyhedron(ellipsoid, &body.polyhedra[b]), found),
            _ => {
                let local = self.body_a().ellipsoids[self.item_a.element as usize].center;
                let thickness = self.info_b().thickness.unwrap_or(ellipsoid.smallest_semi_axis());
                let mut emit = |contact| self.on_triangle(&local, &ellipsoid.center, contact, found);
                ellipsoid_triangle(ellipsoid, &body.triangles, self.item_b.element, thickness, &mut emit);
            }
        }
    }

    fn test_custom(&self, found: &mut Found<'_>) {
        let a = element_ref(self.body_a(), self.item_a);
        let b = element_ref(self.body_b(), self.item_b);
        let extensions = &self.context.scene.extensions;
        let Some(test) = extensions.contact_test(a.kind_name(), b.kind_name()) else { return };
        found.report.primitives_tested += 1;
        self.whole(test(a, b, &self.motion().x_ba), found);
    }

    /// A contact of one sphere's or ellipsoid's centre with one triangle, unless the centre came from behind.
    fn on_triangle(&self, local: &Vec3, center: &Vec3, contact: TriangleContact, found: &mut Found<'_>) {
        let entry = TriangleEntry {
            context: self.context,
            memory: self.memory,
            body: self.body_b(),
            triangle: self.item_b.element,
            center: *center,
            earlier: self.motion().since_commit.map(|since| since.x_ba.point(local)),
        };
        let key = self.key();
        let Some(role) = entry.role(&key, &contact) else { return };
        self.emit(&contact.interference, found, |out| {
            out.shares = true;
            out.role = role;
            out.stance = match contact.standing {
                Standing::Front => Stance::Plain,
                Standing::Behind => Stance::Behind,
                Standing::Spare => Stance::Spare,
            };
        });
    }

    /// For a point inside B's polyhedron, the face that memory reaches and the one that pushes.
    fn entry_face(&self, local: &Vec3, p: &Vec3) -> Option<super::side_of_entry::EntryFace> {
        PolyhedronEntry {
            memory: self.memory,
            body: self.body_b(),
            shell: self.info_b().shell,
            piece: self.item_b.element,
            point: *p,
            earlier: self.motion().since_commit.map(|since| since.x_ba.point(local)),
            remembers: self.context.entry_memory[1 - self.flipped],
        }
        .face(&self.key())
    }

    fn key(&self) -> ContactKey {
        let info_b = self.info_b();
        let shell_b = match info_b.kind {
            Triangle => self.body_b().triangles.triangles[self.item_b.element as usize].shell,
            _ => info_b.shell,
        };
        ContactKey {
            group_pair: self.context.group_pair,
            flipped: self.flipped as u32,
            primitive_a: self.item_a.primitive,
            shell_b,
            end: 0,
        }
    }

    fn whole(&self, contact: Option<Interference>, found: &mut Found<'_>) {
        if let Some(contact) = contact {
            self.emit(&contact, found, |_| ());
        }
    }

    fn sharing(&self, contact: Option<Interference>, found: &mut Found<'_>) {
        if let Some(contact) = contact {
            self.emit(&contact, found, |out| out.shares = true);
        }
    }

    fn with_entry_face(&self, contact: Option<Interference>, face: usize, found: &mut Found<'_>) {
        if let Some(contact) = contact {
            self.emit(&contact, found, |out| out.entry_face = face as u32);
        }
    }

    fn emit(&self, contact: &Interference, found: &mut Found<'_>, adjust: impl FnOnce(&mut FrameContact)) {
        let mut out = FrameContact::found(self.key(), contact);
        out.primitive_b = self.item_b.primitive;
        out.element_a = self.item_a.element;
        out.element_b = self.item_b.element;
        out.kind_b = self.info_b().kind;
        adjust(&mut out);
        found.contacts.push(out);
    }
}

/// An element as registered testers see it.
fn element_ref(body: &Body, item: Item) -> PrimitiveRef<'_> {
    let i = item.element as usize;
    match body.primitives[item.primitive as usize].kind {
        PrimitiveKind::Point => PrimitiveRef::Point(&body.points[i]),
        PrimitiveKind::LineSegment => PrimitiveRef::LineSegment(&body.segments[i]),
        PrimitiveKind::Ray => PrimitiveRef::Ray(&body.rays[i]),
        PrimitiveKind::Sphere => PrimitiveRef::Sphere(&body.spheres[i]),
        PrimitiveKind::Ellipsoid => PrimitiveRef::Ellipsoid(&body.ellipsoids[i]),
        Triangle => PrimitiveRef::Triangle(&body.triangles, item.element),
        Polyhedron => PrimitiveRef::Polyhedron(&body.polyhedra[i]),
        Plane => PrimitiveRef::Plane(&body.planes[i]),
        Custom => PrimitiveRef::Custom(&*body.customs[i]),
    }
}
