//! Points where the primitives of a movable group can be touched, and the compliance of the group there.

use crate::mobility::Mobility;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Element, Item, MovableGroup, PrimitiveInfo};
use std::collections::BTreeMap;

/// Largest inverse of the effective mass at the points of a contact, 1/kg.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Compliance {
    /// Along the normal.
    pub normal: f64,
    /// Along the surface, where friction acts.
    pub along: f64,
    /// True if the point can be at any distance from the mass centre; its lever is then left out.
    pub is_unbounded: bool,
}

impl Compliance {
    /// Compliance of two bodies in contact.
    pub fn plus(self, other: Self) -> Self {
        Self {
            normal: self.normal + other.normal,
            along: self.along + other.along,
            is_unbounded: self.is_unbounded || other.is_unbounded,
        }
    }

    /// The larger of each value of two points.
    pub fn or_larger(self, other: Self) -> Self {
        Self {
            normal: self.normal.max(other.normal),
            along: self.along.max(other.along),
            is_unbounded: self.is_unbounded || other.is_unbounded,
        }
    }
}

/// Returns true for kinds whose pairs yield at the ends of their axes (docs/theory.md, 2.8): no motion of either body
/// meets more than a whole spring at each end of its axis.
pub(crate) fn yield_at_ends(kind_a: PrimitiveKind, kind_b: PrimitiveKind) -> bool {
    match kind_b {
        PrimitiveKind::Capsule => matches!(kind_a, PrimitiveKind::LineSegment | PrimitiveKind::Capsule),
        PrimitiveKind::Triangle => kind_a == PrimitiveKind::Capsule,
        _ => false,
    }
}

/// Returns true for kinds of which A alone yields at the ends of its axis (docs/theory.md, 2.8), however far it overhangs.
pub(crate) fn yields_alone(kind_a: PrimitiveKind, kind_b: PrimitiveKind) -> bool {
    use PrimitiveKind::{Capsule, Cone, Cylinder, LineSegment, Polyhedron, Triangle};
    match kind_b {
        Cylinder | Cone | Polyhedron => matches!(kind_a, LineSegment | Capsule),
        Triangle => matches!(kind_a, Capsule | Cylinder | Cone),
        _ => false,
    }
}

/// Returns true for kinds of which A has an axis that may overhang B and hold it at A's ends.
pub(crate) fn overhangs(kind_a: PrimitiveKind, kind_b: PrimitiveKind) -> bool {
    use PrimitiveKind::{Capsule, Cone, Cylinder, LineSegment, Polyhedron, Triangle};
    matches!(kind_a, LineSegment | Capsule | Cylinder | Cone)
        && matches!(kind_b, Cylinder | Cone | Polyhedron | Triangle)
}

pub(crate) type Compliances = BTreeMap<(PrimitiveKind, u32), Compliance>;

/// Compliance at all primitives of a body, by kind and surface.
pub(crate) fn compliances(body: &MovableGroup, mobility: &Mobility) -> Compliances {
    let mut all = Compliances::new();
    for (index, info) in body.primitives.iter().enumerate() {
        let here = compliance_of(body, (index as u32, info), mobility);
        all.entry((info.kind, info.surface)).and_modify(|most| *most = most.or_larger(here)).or_insert(here);
    }
    all
}

/// Compliance at a point within a radius of a centre through which the normal passes.
fn round(mobility: &Mobility, center: &pong_geometry::Vec3, radius: f64) -> Compliance {
    let (normal, along) = (mobility.compliance(center), mobility.compliance_around(center, radius));
    Compliance { normal, along, is_unbounded: false }
}

fn compliance_of(
    body: &MovableGroup,
    (index, info): (u32, &PrimitiveInfo),
    mobility: &Mobility,
) -> Compliance {
    let element = info.elements.start as usize;
    let anywhere = |most: f64| Compliance { normal: most, along: most, is_unbounded: false };
    let unbounded = || {
        let at_center = mobility.compliance(mobility.center());
        Compliance { is_unbounded: mobility.has_levers(), ..anywhere(at_center) }
    };
    match info.kind {
        PrimitiveKind::Plane => unbounded(),
        PrimitiveKind::Sphere => round(mobility, &body.spheres[element].center, body.spheres[element].radius),
        // Compliance is convex in the point: the largest of an axis is at an end.
        PrimitiveKind::LineSegment => {
            let ends = body.segments[element].ends;
            ends.map(|end| round(mobility, &end, 0.0))
                .into_iter()
                .fold(Compliance::default(), Compliance::or_larger)
        }
        PrimitiveKind::Capsule => {
            let part = &body.capsules[element];
            let ends = part.ends.map(|end| round(mobility, &end, part.radius));
            ends.into_iter().fold(Compliance::default(), Compliance::or_larger)
        }
        _ => {
            let of = |element| Element::new(body, Item { primitive: index, element }).extent();
            let whole = info.elements.clone().map(of).reduce(|a, b| (a.0.inf(&b.0), a.1.sup(&b.1)));
            match whole {
                None => Compliance::default(),
                Some(extent) if extent.0.iter().chain(&extent.1).all(|x| x.is_finite()) => {
                    anywhere(mobility.compliance_in(&extent))
                }
                Some(_) => unbounded(),
            }
        }
    }
}
