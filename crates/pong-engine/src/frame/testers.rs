//! Pairs of primitives: carries A into B's frame, runs the tester, hands out contacts under their keys.

use super::bounding::{Found, LeafItems, PairContext};
use super::buffers::{FrameContact, Stance};
use super::dispatch::has_tester;
use super::relative::Motion;
use super::side_of_entry::{PolyhedronEntry, TriangleEntry};
use crate::state::{ContactKey, ContactMemory};
use pong_geometry::Vec3;
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
use pong_geometry::primitive::PrimitiveKind::{self, *};
use pong_geometry::primitive::{Ray, Sphere};
use pong_model::{Body, Item, PrimitiveInfo};

/// Tests everything in one leaf against everything in another.
pub(super) fn test_leaves(
    context: &PairContext<'_>,
    leaves: LeafItems<'_>,
    memory: &ContactMemory,
    found: &mut Found<'_>,
) {
    for item_first in leaves[0] {
        for item_second in leaves[1] {
            test_items(context, [*item_first, *item_second], memory, found);
        }
    }
}

/// Tests two elements in the orders that the table knows.
fn test_items(context: &PairContext<'_>, items: [Item; 2], memory: &ContactMemory, found: &mut Found<'_>) {
    let kinds = [0, 1].map(|i| context.bodies[i].primitives[items[i].primitive as usize].kind);
    let one_kind = kinds[0] == kinds[1];
    for flipped in [0, 1] {
        // Of two primitives of one kind, A is that of the Object named first.
        if one_kind && (flipped == 0) != context.first_named_first {
            continue;
        }
        let (a, b) = (flipped, 1 - flipped);
        let side = Side { context, memory, flipped, item_a: items[a], item_b: items[b] };
        if has_tester(kinds[a], kinds[b]) {
            found.report.primitives_tested += 1;
            side.test(kinds[a], kinds[b], found);
        } else if !context.scene.extensions.has_no_contact_tests() {
            side.test_custom(found);
        }
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

    fn test(&self, kind_a: PrimitiveKind, kind_b: PrimitiveKind, found: &mut Found<'_>) {
        match kind_a {
            Point => self.test_point(kind_b, found),
            LineSegment => self.test_segment(kind_b, found),
            Ray => self.test_ray(kind_b, found),
            Sphere => self.test_sphere(kind_b, found),
            _ => self.test_ellipsoid(kind_b, found),
        }
    }

    fn test_point(&self, kind_b: PrimitiveKind, found: &mut Found<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        let local = self.body_a().points[self.item_a.element as usize];
        let point = local.carried(&self.motion().x_ba);
        match kind_b {
            Plane => self.whole(point_plane(&point, &body.planes[b]), found),
            Sphere => self.whole(point_sphere(&point, &body.spheres[b]), found),
            Ellipsoid => self.whole(point_ellipsoid(&point.position, &body.ellipsoids[b]), found),
            _ => {
                let Some(face) = self.entry_face(&local.position, &point.position) else { return };
                let polyhedron = &body.polyhedra[b];
                let contact = point_below_face(&point.position, polyhedron, face.pushes);
                self.with_entry_face(contact, face.reached, found);
            }
        }
    }

    fn test_segment(&self, kind_b: PrimitiveKind, found: &mut Found<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        let segment = self.body_a().segments[self.item_a.element as usize].carried(&self.motion().x_ba);
        let ends = match kind_b {
            Plane => line_segment_plane(&segment, &body.planes[b]),
            _ => line_segment_polyhedron(&segment, &body.polyhedra[b]),
        };
        for (end, contact) in ends.iter().enumerate() {
            let Some(contact) = contact else { continue };
            self.emit(contact, found, |out| {
                out.key.end = end as u32;
                out.half = true;
            });
        }
    }

    fn test_ray(&self, kind_b: PrimitiveKind, found: &mut Found<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        let ray: Ray = self.body_a().rays[self.item_a.element as usize].carried(&self.motion().x_ba);
        let hit: Option<RayHit> = match kind_b {
            Plane => ray_plane(&ray, &body.planes[b]),
            Polyhedron => ray_polyhedron(&ray, &body.polyhedra[b]),
            _ => {
                let reach = ray.reach.or(self.info_b().thickness).unwrap_or(0.0);
                ray_triangle(&ray, &body.triangles, self.item_b.element, reach)
            }
        };
        if let Some(hit) = hit {
            self.emit(&ray_contact(&ray, &hit), found, |out| out.ray_distance = Some(hit.distance));
        }
    }

    fn test_sphere(&self, kind_b: PrimitiveKind, found: &mut Found<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        let local = self.body_a().spheres[self.item_a.element as usize];
        let sphere = local.carried(&self.motion().x_ba);
        match kind_b {
            Plane => self.whole(sphere_plane(&sphere, &body.planes[b]), found),
            Sphere => self.whole(sphere_sphere(&sphere, &body.spheres[b]), found),
            Polyhedron => self.test_sphere_polyhedron(&local, &sphere, found),
            _ => {
                let thickness = self.info_b().thickness.unwrap_or(sphere.radius);
                let mut emit = |contact| self.on_triangle(&local.center, &sphere.center, contact, found);
                sphere_triangle(&sphere, &body.triangles, self.item_b.element, thickness, &mut emit);
            }
        }
    }

    fn test_sphere_polyhedron(&self, local: &Sphere, sphere: &Sphere, found: &mut Found<'_>) {
        let polyhedron = &self.body_b().polyhedra[self.item_b.element as usize];
        if let Some(face) = self.entry_face(&local.center, &sphere.center) {
            let contact = sphere_inside_polyhedron(sphere, polyhedron, face.pushes);
            self.emit(&contact, found, |out| {
                out.shares = true;
                out.entry_face = face.reached as u32;
            });
        } else if !polyhedron.contains(&sphere.center) {
            self.sharing(sphere_outside_polyhedron(sphere, polyhedron), found);
        }
    }

    fn test_ellipsoid(&self, kind_b: PrimitiveKind, found: &mut Found<'_>) {
        let (body, b) = (self.body_b(), self.item_b.element as usize);
        let local = self.body_a().ellipsoids[self.item_a.element as usize];
        let ellipsoid = local.carried(&self.motion().x_ba);
        match kind_b {
            Plane => self.whole(ellipsoid_plane(&ellipsoid, &body.planes[b]), found),
            Polyhedron => self.sharing(ellipsoid_polyhedron(&ellipsoid, &body.polyhedra[b]), found),
            _ => {
                let thickness = self.info_b().thickness.unwrap_or(ellipsoid.smallest_semi_axis());
                let mut emit = |contact| self.on_triangle(&local.center, &ellipsoid.center, contact, found);
                ellipsoid_triangle(&ellipsoid, &body.triangles, self.item_b.element, thickness, &mut emit);
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
        Point => PrimitiveRef::Point(&body.points[i]),
        LineSegment => PrimitiveRef::LineSegment(&body.segments[i]),
        Ray => PrimitiveRef::Ray(&body.rays[i]),
        Sphere => PrimitiveRef::Sphere(&body.spheres[i]),
        Ellipsoid => PrimitiveRef::Ellipsoid(&body.ellipsoids[i]),
        Triangle => PrimitiveRef::Triangle(&body.triangles, item.element),
        Polyhedron => PrimitiveRef::Polyhedron(&body.polyhedra[i]),
        Plane => PrimitiveRef::Plane(&body.planes[i]),
        Custom => PrimitiveRef::Custom(&*body.customs[i]),
    }
}
