//! Hash of a model: FNV-1a, 64 bits, over everything that affects results.
//!
//! Names of groups and primitives, and bounding volumes, are left out: they affect no result. Included are
//! names of surfaces, because tables of other models refer to them, and filters.

use crate::draft::BodyDraft;
use crate::fnv::Fnv;
use crate::model::{Model, MovableGroup, PrimitiveInfo};
use crate::surface::{Exponent, FrictionLaw, NormalLaw, PairOverride, Surface};
use pong_geometry::Vec3;
use pong_geometry::primitive::{Frustum, Polyhedron, PrimitiveKind, RayResponse, TriangleSet};

/// Hash being computed for a model.
struct ModelHash(Fnv);

/// Hash of a model; `drafts` have the parameters of custom primitives.
pub(crate) fn hash(model: &Model, drafts: &[BodyDraft]) -> u64 {
    let mut hash = ModelHash(Fnv::default());
    hash.word(u64::from(model.entry_memory));
    hash.list(&model.surfaces, ModelHash::surface);
    hash.list(&model.pair_overrides, ModelHash::pair);
    hash.word(model.bodies.len() as u64);
    for (body, draft) in model.bodies.iter().zip(drafts) {
        hash.body(body);
        hash.list(&draft.custom_parameters, |hash, (kind, parameters)| {
            hash.text(kind);
            hash.list(parameters, |hash, &x| hash.number(x));
        });
    }
    // Without filters nothing is added, so models from before filters existed keep their hash.
    for pair in model.filters_within().pairs() {
        pair.iter().for_each(|group| hash.text(group));
    }
    // As for filters, nothing is added without foundations and solids.
    hash.foundations(&model.surfaces);
    for (body, draft) in (0..).zip(drafts) {
        hash.solids(body, &model.bodies[body], &draft.is_solid);
        hash.one_surface(body, &draft.one_surface);
    }
    hash.0.value()
}

impl ModelHash {
    fn word(&mut self, word: u64) {
        self.0.word(word);
    }

    fn number(&mut self, x: f64) {
        self.0.number(x);
    }

    fn option(&mut self, x: Option<f64>) {
        self.word(u64::from(x.is_some()));
        self.number(x.unwrap_or(0.0));
    }

    fn vector(&mut self, v: &Vec3) {
        v.iter().for_each(|&x| self.number(x));
    }

    fn text(&mut self, text: &str) {
        self.word(text.len() as u64);
        text.bytes().for_each(|byte| self.word(u64::from(byte)));
    }

    fn list<T>(&mut self, items: &[T], mut each: impl FnMut(&mut Self, &T)) {
        self.word(items.len() as u64);
        items.iter().for_each(|item| each(self, item));
    }

    fn surface(&mut self, surface: &Surface) {
        self.text(&surface.name);
        self.number(surface.stiffness);
        self.normal_law(&surface.normal);
        self.friction_law(&surface.friction);
    }

    /// Adds the surfaces that have a foundation or an area.
    fn foundations(&mut self, surfaces: &[Surface]) {
        for surface in surfaces.iter().filter(|surface| surface.foundation.or(surface.area).is_some()) {
            self.text("foundation");
            self.text(&surface.name);
            self.option(surface.foundation);
            self.option(surface.area);
        }
    }

    fn pair(&mut self, pair: &PairOverride) {
        pair.surfaces.iter().for_each(|name| self.text(name));
        self.option(pair.stiffness);
        self.list(pair.normal.as_slice(), Self::normal_law);
        self.list(pair.friction.as_slice(), Self::friction_law);
    }

    fn normal_law(&mut self, law: &NormalLaw) {
        match law {
            NormalLaw::Linear { damping, ramp } => {
                self.word(0);
                self.number(*damping);
                self.number(*ramp);
            }
            NormalLaw::HuntCrossley { dissipation, exponent } => {
                self.word(if *exponent == Exponent::One { 1 } else { 2 });
                self.number(*dissipation);
            }
            NormalLaw::Custom { name, parameters } => self.custom_law(3, name, parameters),
            NormalLaw::Inherited => self.word(4),
            NormalLaw::PowerLaw { damping, exponent, damping_exponent } => {
                self.word(if *exponent == Exponent::One { 5 } else { 6 });
                self.number(*damping);
                self.number(*damping_exponent);
            }
        }
    }

    fn friction_law(&mut self, law: &FrictionLaw) {
        match law {
            FrictionLaw::None => self.word(0),
            FrictionLaw::Bristle { mu, static_excess, stiffness, damping, rolling, spinning } => {
                self.word(1);
                self.number(*mu);
                self.number(*static_excess);
                self.option(*stiffness);
                match damping {
                    Some(damping) => self.number(*damping),
                    // Bits that no finite number has.
                    None => self.word(u64::MAX),
                }
                // As for filters, nothing is added without resistances.
                if [rolling, spinning].into_iter().any(|length| *length > 0.0) {
                    self.text("resistances");
                    self.number(*rolling);
                    self.number(*spinning);
                }
            }
            FrictionLaw::Coulomb { mu, slip_speed } => {
                self.word(2);
                self.number(*mu);
                self.number(*slip_speed);
            }
            FrictionLaw::Custom { name, parameters } => self.custom_law(3, name, parameters),
            FrictionLaw::Inherited => self.word(4),
        }
    }

    fn custom_law(&mut self, kind: u64, name: &str, parameters: &[f64]) {
        self.word(kind);
        self.text(name);
        self.list(parameters, |hash, &x| hash.number(x));
    }

    fn body(&mut self, body: &MovableGroup) {
        self.word(body.parent.map_or(u64::MAX, u64::from));
        self.list(&body.primitives, Self::primitive);
        self.list(&body.points, |hash, point| hash.vector(&point.position));
        self.list(&body.segments, |hash, segment| segment.ends.iter().for_each(|end| hash.vector(end)));
        self.list(&body.rays, |hash, ray| {
            hash.vector(&ray.origin);
            hash.vector(&ray.direction);
            hash.number(ray.length);
            hash.option(ray.reach);
            hash.word(u64::from(ray.response == RayResponse::Axial));
        });
        self.list(&body.spheres, |hash, sphere| {
            hash.vector(&sphere.center);
            hash.number(sphere.radius);
        });
        self.list(&body.ellipsoids, |hash, ellipsoid| {
            hash.vector(&ellipsoid.center);
            ellipsoid.axes.iter().for_each(|&x| hash.number(x));
            hash.vector(&ellipsoid.semi_axes);
        });
        self.list(&body.planes, |hash, plane| {
            hash.vector(&plane.normal);
            hash.number(plane.offset);
        });
        self.triangles(&body.triangles);
        self.list(&body.polyhedra, Self::polyhedron);
        self.round_parts(body);
    }

    /// The kinds of the primitives imply which of these lists exist, so models without round parts keep the
    /// hash from before these existed.
    fn round_parts(&mut self, body: &MovableGroup) {
        for capsule in &body.capsules {
            capsule.ends.iter().for_each(|end| self.vector(end));
            self.number(capsule.radius);
        }
        body.frusta.iter().for_each(|frustum| self.frustum(frustum));
        for bore in &body.bores {
            self.frustum(&bore.hole);
            self.number(bore.thickness);
            bore.mouths.iter().for_each(|&pushes| self.word(u64::from(pushes)));
        }
    }

    /// Adds the solids of a movable group by the polyhedra and meshes that they consist of.
    fn solids(&mut self, number: usize, body: &MovableGroup, is_solid: &[bool]) {
        for (index, info) in body.primitives.iter().enumerate() {
            if is_solid[index] && matches!(info.kind, PrimitiveKind::Polyhedron | PrimitiveKind::Triangle) {
                self.text("solid");
                self.word((number as u64) << 32 | index as u64);
            }
        }
    }

    /// Adds the primitives of a movable group that are declared one surface.
    fn one_surface(&mut self, number: usize, one_surface: &[Option<u32>]) {
        let mut numbers: Vec<u32> = Vec::new();
        for (index, group) in one_surface.iter().enumerate() {
            let Some(group) = group else { continue };
            let place = numbers.iter().position(|known| known == group).unwrap_or_else(|| {
                numbers.push(*group);
                numbers.len() - 1
            });
            self.text("one surface");
            self.word((number as u64) << 32 | index as u64);
            self.word(place as u64);
        }
    }

    fn frustum(&mut self, frustum: &Frustum) {
        frustum.ends.iter().for_each(|end| self.vector(end));
        frustum.radii.iter().for_each(|&radius| self.number(radius));
    }

    fn primitive(&mut self, info: &PrimitiveInfo) {
        self.word(info.kind as u64);
        self.word(u64::from(info.surface));
        self.word(u64::from(info.elements.start) << 32 | u64::from(info.elements.end));
        self.word(u64::from(info.first_mirror));
        self.option(info.thickness);
    }

    /// Neighbours and shells are left out: they follow from the vertices.
    fn triangles(&mut self, set: &TriangleSet) {
        self.list(&set.vertices, Self::vector);
        self.list(&set.triangles, |hash, triangle| {
            let [a, b, c] = triangle.vertices;
            hash.word(u64::from(a) << 32 | u64::from(b));
            hash.word(u64::from(c));
        });
    }

    /// Edges are left out: they follow from vertices, faces and outlines.
    fn polyhedron(&mut self, polyhedron: &Polyhedron) {
        self.list(&polyhedron.vertices, |hash, vertex| hash.vector(&vertex.position));
        self.list(&polyhedron.faces, |hash, face| {
            hash.vector(&face.normal);
            hash.number(face.offset);
            hash.word(u64::from(face.active) | u64::from(face.closed) << 1 | u64::from(face.rim_count) << 32);
        });
        self.list(&polyhedron.rims, |hash, rim| hash.word(u64::from(rim.start)));
    }
}
