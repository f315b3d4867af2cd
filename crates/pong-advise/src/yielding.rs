//! Springs of contacts of bars, cylinders and cones whose ends yield (docs/theory.md, 2.8), of the contacts of a frame.
//!
//! With the energy of (1), U = min ¼k·(|u₀|² + |u₁|²) over displacements of the ends of A's axis after which A touches
//! nothing, the displacements that follow a motion of the bodies are among those allowed. So no motion meets more than half a
//! spring at each end, along the normal if there is one plane, however short the support is. Two capsules yield both, and of
//! these a whole spring counts at each end of each axis, of its own body alone.
//!
//! The contacts of a cylinder or a cone on one plane are places of its rims, which move along the rims when it turns about
//! the direction in which it leans: of a disc of radius R whose lowest place has the depth D, that is a spring against turning of
//! ½k·min(2R², D·R/s), s the sine of the angle between axis and normal. It is what keeps a body that stands from falling to
//! the side.

use crate::places::{yield_at_ends, yields_alone};
use crate::rows::{AXES, Acting, primitives_of, rows_of};
use crate::setting::Setting;
use crate::spring::{ContactSprings, Spring};
use pong_engine::inspect::PushingContact;
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::{Vec3, any_perpendicular};

/// Returns the springs that count beside or in place of the contacts `of_two` primitives, which are among all `contacts`. Of those
/// in whose place they count the stiffness becomes 0.
pub(crate) fn count_yielding(
    setting: &Setting<'_>,
    contacts: &[PushingContact<'_>],
    acting: &mut [Acting],
    of_two: &[usize],
) -> Vec<Acting> {
    let Some(&first) = of_two.iter().max_by(|a, b| {
        let stiffness = |index: usize| acting[index].springs.normal.stiffness;
        stiffness(**a).total_cmp(&stiffness(**b))
    }) else {
        return Vec::new();
    };
    let [a, b] = primitives_of(&contacts[first]);
    let kinds = [a, b].map(|primitive| kind_of(setting, primitive));
    if yield_at_ends(kinds[0], kinds[1]) && kinds[1] == PrimitiveKind::Capsule {
        of_two.iter().for_each(|index| acting[*index].stiffens = 0.0);
        return at_ends_of_axes(setting, &contacts[first], &acting[first]);
    }
    let on_triangles = kinds[1] == PrimitiveKind::Triangle;
    let normal = acting[first].normal;
    let is_one_plane = of_two.iter().all(|index| acting[*index].normal.dot(&normal) > 1.0 - SAME);
    let mut more = Vec::new();
    let touching: Vec<&PushingContact<'_>> = of_two.iter().map(|index| &contacts[*index]).collect();
    let is_at_ends = on_triangles && !is_one_plane || is_one_plane && !is_tip(setting, &touching);
    if yields_alone(kinds[0], kinds[1]) && is_at_ends {
        for &index in of_two {
            // The highest place of a rim is no end.
            if !round_of(setting, a).is_some_and(|round| round.is_above(&contacts[index])) {
                acting[index].stiffens = 0.0;
            }
        }
        // Beside the half springs of the ends, rules that meet there (theory, 2.8: limits).
        let share = if is_one_plane { 0.5 } else { 1.0 };
        more.extend(at_ends_of_a(setting, &contacts[first], &acting[first], (share, is_one_plane)));
    }
    let on_planes =
        matches!(kinds[1], PrimitiveKind::Plane | PrimitiveKind::Polyhedron | PrimitiveKind::Triangle);
    if let Some(round) = round_of(setting, a).filter(|_| on_planes) {
        let deepest = of_two.iter().copied().max_by(|a, b| contacts[*a].depth.total_cmp(&contacts[*b].depth));
        more.extend(
            deepest.into_iter().flat_map(|index| round.turning(setting, &contacts[index], &acting[index])),
        );
    }
    more
}

/// A contact is at an end of an axis if it is not farther from there than this part of its length.
const TIP: f64 = 1e-6;

/// Two normals are the same if the cosine of their angle differs from 1 by less than this.
const SAME: f64 = 1e-9;

fn kind_of(setting: &Setting<'_>, (group, primitive): (usize, u32)) -> PrimitiveKind {
    setting.scene.body(group).primitives[primitive as usize].kind
}

/// Ends of the axis of a line segment or a capsule, in the frame of its movable group.
fn ends_of_axis(setting: &Setting<'_>, (group, primitive): (usize, u32)) -> Option<[Vec3; 2]> {
    let body = setting.scene.body(group);
    let info = &body.primitives[primitive as usize];
    let core = body.element(info.kind, info.elements.start).facts()?.core()?;
    Some(core.0)
}

/// Whole springs along the normal of a contact at the four ends of the axes of two capsules.
fn at_ends_of_axes(setting: &Setting<'_>, contact: &PushingContact<'_>, known: &Acting) -> Vec<Acting> {
    let x_ba = contact.x_ba;
    let mut all = Vec::new();
    for (k, (group, primitive)) in primitives_of(contact).into_iter().enumerate() {
        let (Some(mobility), Some(ends)) =
            (setting.mobilities[group].as_ref(), ends_of_axis(setting, (group, primitive)))
        else {
            continue;
        };
        for end in ends {
            let axis = |axis: Vec3| if k == 0 { x_ba.rotation.tr_mul(&axis) } else { -axis };
            let rows = AXES.map(|own| mobility.row(&axis(own), &end));
            let springs = ContactSprings { friction: None, ..known.springs };
            all.push(Acting { rows: vec![(group, rows)], stiffens: 1.0, springs, ..known.clone() });
        }
    }
    all
}

/// Ends of A's axis, of a cylinder or a cone the lowest places of its discs, in the frame of its movable group.
fn ends_of_a(setting: &Setting<'_>, contact: &PushingContact<'_>) -> Option<[Vec3; 2]> {
    let a = (contact.group_a, contact.primitive_a);
    round_of(setting, a).map_or_else(|| ends_of_axis(setting, a), |round| Some(round.low_places(contact)))
}

/// True if A's contacts are all at one end of its axis: the other end then yields nothing, and the contacts are its springs.
fn is_tip(setting: &Setting<'_>, contacts: &[&PushingContact<'_>]) -> bool {
    let at_end = |contact: &PushingContact<'_>, end: usize| {
        ends_of_a(setting, contact).is_some_and(|ends| {
            let to = contact.x_ba.point(&ends[end]) - contact.point_b;
            let aside = to - contact.normal_b * contact.normal_b.dot(&to);
            aside.norm() <= TIP * (ends[1] - ends[0]).norm()
        })
    };
    (0..2).any(|end| contacts.iter().all(|contact| at_end(contact, end)))
}

/// A share of the spring at the two ends of A's axis, of a cylinder or a cone at the lowest places of its discs, which both
/// bodies feel: along the normal of the contact, or along every direction.
fn at_ends_of_a(
    setting: &Setting<'_>,
    contact: &PushingContact<'_>,
    known: &Acting,
    (share, is_one_plane): (f64, bool),
) -> Vec<Acting> {
    let across = Spring { stiffness: share * known.springs.normal.stiffness, damping: 0.0 };
    let springs = ContactSprings { friction: (!is_one_plane).then_some(across), ..known.springs };
    let at_end = |end: Vec3| {
        let rows = rows_of(setting, &PushingContact { point_b: contact.x_ba.point(&end), ..*contact });
        Acting { rows, stiffens: share, springs, ..known.clone() }
    };
    ends_of_a(setting, contact).into_iter().flatten().map(at_end).collect()
}

/// A cylinder or a cone, in the frame of its movable group.
struct Round {
    ends: [Vec3; 2],
    radii: [f64; 2],
    axis: Vec3,
}

fn round_of(setting: &Setting<'_>, (group, primitive): (usize, u32)) -> Option<Round> {
    let body = setting.scene.body(group);
    let info = &body.primitives[primitive as usize];
    let is_round = matches!(info.kind, PrimitiveKind::Cylinder | PrimitiveKind::Cone);
    let frustum = is_round.then(|| &body.frusta[info.elements.start as usize])?;
    Some(Round { ends: frustum.ends, radii: frustum.radii, axis: frustum.axis })
}

impl Round {
    /// Normal, and unit vector across the axis towards a contact.
    fn seen(&self, contact: &PushingContact<'_>) -> (Vec3, Vec3) {
        let x_ba = contact.x_ba;
        let place = x_ba.rotation.tr_mul(&(contact.point_b - x_ba.translation)) - self.ends[0];
        let across = place - self.axis * self.axis.dot(&place);
        let normal = x_ba.rotation.tr_mul(&contact.normal_b);
        (normal, across.try_normalize(f64::MIN_POSITIVE).unwrap_or_else(|| any_perpendicular(&self.axis)))
    }

    /// True for a contact on that side of the axis where the normal points.
    fn is_above(&self, contact: &PushingContact<'_>) -> bool {
        let (normal, across) = self.seen(contact);
        normal.dot(&across) > 0.0
    }

    /// Lowest places of the discs.
    fn low_places(&self, contact: &PushingContact<'_>) -> [Vec3; 2] {
        let (normal, across) = self.seen(contact);
        let down = if normal.dot(&across) > 0.0 { -across } else { across };
        [0, 1].map(|end| self.ends[end] + down * self.radii[end])
    }

    /// Springs against turning about the direction in which the axis leans.
    fn turning(&self, setting: &Setting<'_>, contact: &PushingContact<'_>, known: &Acting) -> [Acting; 1] {
        let (normal, across) = self.seen(contact);
        let sine = normal.cross(&self.axis).norm();
        let about = normal.cross(&self.axis.cross(&across));
        let about_b = contact.x_ba.rotation * about;
        // Not below the plane: the place of the contact is at most the depth below it.
        let top = contact.normal_b.dot(&contact.point_b) + contact.depth;
        let of_disc = |end: usize| {
            let radius = self.radii[end];
            let middle = top - contact.normal_b.dot(&contact.x_ba.point(&self.ends[end]));
            let depth = (middle + radius * sine).max(0.0);
            (2.0 * radius * radius).min(depth * radius / sine.max(f64::MIN_POSITIVE))
        };
        let bend = 0.5 * (of_disc(0) + of_disc(1));
        let turn_of = |group: usize, to_group: &dyn Fn(&Vec3) -> Vec3| {
            let mobility = setting.mobilities[group].as_ref();
            mobility.map(|mobility| (group, AXES.map(|axis| mobility.turn_row(&to_group(&axis)))))
        };
        let on_a = turn_of(contact.group_a, &|axis| contact.x_ba.rotation.tr_mul(axis));
        let on_b = turn_of(contact.group_b, &|axis| -axis);
        let springs = ContactSprings { friction: None, ..known.springs };
        let rows = on_a.into_iter().chain(on_b).collect();
        [Acting { rows, stiffens: bend, normal: about_b, springs, ..known.clone() }]
    }
}
