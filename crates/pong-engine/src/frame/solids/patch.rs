//! Forces of a patch: the normal force of every cell, and one bristle for all of them, with torsion
//! (docs/theory.md, 2.12).

use super::cell_force::CellForce;
use super::cells::{FieldCells, FoundField, SolidScratch};
use super::entry::{self, Entry};
use super::relative::Relative;
use super::side::Side;
use crate::frame::forces::contact::FrameContact;
use crate::frame::forces::contact_buffer::ContactBuffer;
use crate::frame::forces::contact_ref::ContactRef;
use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::ContactCandidate;
use crate::law::friction::{FrictionInput, FrictionOutput, PatchBristle, friction_alone, shortened};
use crate::law::{FrictionProps, PairProps, normal_force, normal_tangent};
use crate::seal::Sealed;
use crate::state::{ContactRecord, ContactRole, SolidContactPart};
use pong_geometry::interference::Feature;
use pong_geometry::overlap::{Cell, HalfSpace, Moments};
use pong_geometry::pose::carry_by_smallest_rotation;
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::{Vec3, any_perpendicular, divisor};

/// Least resultant of the normal forces that has friction, relative to K·V. Below it the cells push against
/// each other, and the direction of their sum is rounding.
const LEAST_RESULTANT: f64 = 1e-9;

/// Thickness of a patch, relative to coordinates, up to which rounding alone may have made it.
const THICKNESS_OF_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Mean lever of a uniform disc over its radius of gyration, 2√2/3.
const MEAN_LEVER: f64 = 0.942_809_041_582_063_4;

/// Two sides that share volume.
pub(super) struct Patch<'a> {
    pub context: &'a PairContext<'a>,
    pub sealed: &'a Sealed,
    pub relative: &'a Relative,
    pub sides: (&'a Side<'a>, &'a Side<'a>),
    /// Shares of A's and B's field in the energy, 0…1.
    pub shares: [f64; 2],
    pub props: &'a PairProps,
}

/// Sum of the normal forces of a patch, and what friction needs besides. Vectors are in B's frame.
struct Resultant {
    /// Unit vector along the sum of the forces on A.
    normal: Vec3,
    /// Its magnitude, N.
    force: f64,
    /// Centre of the normal forces, m.
    center: Vec3,
    /// Effective area V²/(2·∫d dV), m², and depth, m.
    area: f64,
    depth: f64,
    /// Mean lever of the torsion, m.
    lever: f64,
}

/// Friction of a patch: force on A, N, couple on A about the normal, N·m, and the bristle.
struct PatchFriction {
    force: Vec3,
    couple: f64,
    output: FrictionOutput,
}

impl Patch<'_> {
    /// Adds the contacts of the patch: a cell each, two for the friction, and the memory of the side of entry.
    pub fn add_contacts(&self, scratch: &mut SolidScratch, entry: Option<&Entry>, out: &mut ContactBuffer) {
        scratch.forces.clear();
        self.add_forces(SolidContactPart::CellOfB, scratch);
        self.add_forces(SolidContactPart::CellOfA, scratch);
        let SolidScratch { of_b, of_a, forces, .. } = &*scratch;
        let resultant = self.resultant(forces, (of_a, of_b));
        let sticks = resultant.is_some_and(|resultant| self.add_friction(&resultant, out));
        for force in forces {
            self.add_cell(force, sticks, out);
        }
        if let Some(entry) = entry {
            self.add_entry(entry, out);
        }
    }

    /// Adds the forces of the cells in the field of one side, the owner: it pushes the other side along its faces, and A
    /// the opposite way if A is the owner.
    fn add_forces(&self, owner: SolidContactPart, scratch: &mut SolidScratch) {
        let is_of_a = owner == SolidContactPart::CellOfA;
        let (mut field, forces) = scratch.field(is_of_a);
        let x_ba = &self.relative.x_ba;
        let cells = field.cells;
        for cell in &cells.cells {
            let Some(force) = self.cell_force(cell, is_of_a, &mut field) else { continue };
            let force = CellForce { part: owner, face: field.faces.numbers[cell.face], ..force };
            forces.push(match is_of_a {
                true => CellForce {
                    normal_b: -x_ba.vector(&force.normal_b),
                    point_b: x_ba.point(&force.point_b),
                    ..force
                },
                false => force,
            });
        }
    }

    /// Force of a cell in the frame of the field's owner, on the other side. A cell is a spring of the area
    /// V²/(2I) and the depth 2I/V, with I = ∫d dV: its force is K·V, and its energy K·I.
    ///
    /// Damping multiplies the integrand by 1 + χ·ḋ, and by zero where this is negative, so no point of the cell pulls.
    fn cell_force(&self, cell: &Cell, is_of_a: bool, field: &mut FoundField<'_>) -> Option<CellForce> {
        let (faces, cells) = (field.faces, field.cells);
        let (face, reference) = (&faces.planes[cell.face], &cells.reference_b);
        let (velocity, share) = match is_of_a {
            true => (&self.relative.b_in_a, self.shares[0]),
            false => (&self.relative.a_in_b, self.shares[1]),
        };
        let Moments { volume, first_b, .. } = &cell.moments;
        let depths = face.depth(reference) * volume - face.normal_b.dot(first_b);
        if *volume <= 0.0 || depths <= 0.0 {
            return None;
        }
        let (per_depth, per_volume) = (divisor(2.0 * depths), divisor(*volume));
        let (area, depth) = (share * volume * volume / per_depth, 2.0 * depths / per_volume);
        // Rate of the depth at a position y from the reference point: at_reference + slope·y.
        let at_reference = -face.normal_b.dot(&velocity.at(reference));
        let slope = velocity.angular.cross(&face.normal_b);
        let rates = at_reference * volume + slope.dot(first_b);
        let elastic = normal_force(self.props, area, depth, 0.0);
        let damping = normal_tangent(self.props, area, depth, 0.0).map_or(0.0, |tangent| tangent.damping);
        let dissipation = damping / elastic.max(f64::MIN_POSITIVE);
        let mut pressing = cell.moments;
        if dissipation * cell.least_rate < -1.0 && dissipation * cell.greatest_rate > -1.0 {
            // Depth of a point in the half space: its rate of the depth above −1/χ.
            let offset = 1.0 / dissipation - face.normal_b.dot(&velocity.linear);
            let presses = HalfSpace { normal_b: -slope, offset };
            pressing = self.part_inside(cell, is_of_a, &presses, field);
        }
        let damped =
            pressing.volume + dissipation * (at_reference * pressing.volume + slope.dot(&pressing.first_b));
        let first =
            pressing.first_b + (pressing.first_b * at_reference + pressing.second * slope) * dissipation;
        let pulls_nowhere = damped > 1e-12 * volume;
        let center = if pulls_nowhere { first / divisor(damped) } else { first_b / per_volume };
        Some(CellForce {
            part: SolidContactPart::CellOfB,
            face: cell.face as u32,
            normal_b: face.normal_b,
            point_b: reference + center,
            force: if pulls_nowhere { elastic * (damped / per_volume) } else { 0.0 },
            rate: rates / per_volume,
            area,
            depth,
        })
    }

    /// Moments of the part of a cell inside a half space of its field's frame.
    fn part_inside(
        &self,
        cell: &Cell,
        is_of_a: bool,
        half_space: &HalfSpace,
        field: &mut FoundField<'_>,
    ) -> Moments {
        let (a, b) = self.sides;
        match is_of_a {
            true => field.part_inside(cell.face, half_space, (b, a), &self.relative.x_ab),
            false => field.part_inside(cell.face, half_space, (a, b), &self.relative.x_ba),
        }
    }

    /// Resultant of the forces; `None` if they cancel, if there are none, or if only rounding has made the shared volume.
    fn resultant(&self, forces: &[CellForce], fields: (&FieldCells, &FieldCells)) -> Option<Resultant> {
        let sum: Vec3 = forces.iter().map(|cell| cell.normal_b * cell.force).sum();
        let (force, pressed) = (sum.norm(), forces.iter().map(|cell| cell.force).sum::<f64>());
        if force <= LEAST_RESULTANT * pressed || force == 0.0 {
            return None;
        }
        let normal = sum / divisor(force);
        let along = |cell: &CellForce| (cell.force * cell.normal_b.dot(&normal)).max(0.0);
        let weights: f64 = forces.iter().map(along).sum();
        let center: Vec3 =
            forces.iter().map(|cell| cell.point_b * along(cell)).sum::<Vec3>() / divisor(weights);
        // Both fields divide the same volume V, which only rounding makes different in the two. Effective area
        // V²/(2I) and depth 2I/V, as for one cell, with I = s_A·I_A + s_B·I_B and V = s_A·V_A + s_B·V_B.
        let (of_a, of_b) = fields;
        let [share_a, share_b] = self.shares;
        let (volume_a, volume_b) = (share_a * of_a.volume(), share_b * of_b.volume());
        let volume = volume_a + volume_b;
        let depths: f64 = forces.iter().map(|cell| 0.5 * cell.area * cell.depth * cell.depth).sum();
        if volume <= 0.0 || depths <= 0.0 {
            return None;
        }
        let lever = if volume_b >= volume_a {
            lever(&of_b.sum(), &of_b.reference_b, &center, &normal)
        } else {
            let x_ab = &self.relative.x_ab;
            lever(&of_a.sum(), &of_a.reference_b, &x_ab.point(&center), &x_ab.vector(&normal))
        };
        let (area, depth) = (volume * volume / divisor(2.0 * depths), 2.0 * depths / divisor(volume));
        // Volume over the largest cross section is the thickness. Parts that touch along a wall between pieces share such
        // a volume or none, and a bristle must not depend on it.
        if volume <= THICKNESS_OF_ROUNDING * self.coordinates() * lever * depth.max(lever) {
            return None;
        }
        Some(Resultant { normal, force, center, area, depth, lever })
    }

    /// Size of the coordinates whose rounding the shared volume has, m.
    fn coordinates(&self) -> f64 {
        let of_a = self.sides.0.parts.iter().map(|part| part.bound.center.norm() + part.bound.half.norm());
        self.relative.x_ba.translation.norm() + of_a.fold(0.0, f64::max)
    }

    /// Adds the friction as two contacts beside the centre, whose forces have the resultant and the couple of
    /// the patch. Returns true if it sticks.
    fn add_friction(&self, resultant: &Resultant, out: &mut ContactBuffer) -> bool {
        if matches!(self.props.friction, FrictionProps::None) {
            return false;
        }
        let earlier = self.earlier_friction();
        let slip_velocity = self.slip_velocity(resultant);
        let PatchFriction { force, couple, output } = self.friction(resultant, slip_velocity, earlier);
        let Resultant { normal, center, area, depth, lever, .. } = *resultant;
        let aside = across(&normal, &force);
        let turning = normal.cross(&aside) * (0.5 * couple / lever.max(f64::MIN_POSITIVE));
        for (index, sign) in [1.0, -1.0].into_iter().enumerate() {
            let continues = earlier.map(|[first, second]| [first, second][index].0);
            let found = ContactCandidate {
                feature: Feature::face(index),
                depth,
                normal_b: normal,
                deepest_b: center,
                weight: 0.0,
                ..self.candidate(SolidContactPart::Friction)
            };
            self.add(out, continues, |contact| {
                contact.found = found;
                contact.point_b = center + aside * (sign * lever);
                contact.friction_force_b = force * 0.5 + turning * sign;
                contact.slip_velocity_b = slip_velocity - normal * normal.dot(&slip_velocity);
                contact.rate = 0.0;
                contact.sticks = output.sticks;
                // The second contact keeps the deflection times the area: see `carried`.
                contact.bristle_b = output.bristle_b * if index == 0 { 1.0 } else { area };
                contact.stored = if index == 0 { output.stored } else { 0.0 };
            });
        }
        output.sticks
    }

    /// Records of the two friction contacts at the last commit, with their indices.
    fn earlier_friction(&self) -> Option<[(usize, &ContactRecord); 2]> {
        let mut records = entry::records(self.context, self.sides, SolidContactPart::Friction);
        let first = records.next()?;
        Some([first, records.next()?])
    }

    /// Velocity of A relative to B at the centre: in the contact plane, and along the normal the lever times
    /// the rate of turning about it, m/s.
    fn slip_velocity(&self, resultant: &Resultant) -> Vec3 {
        let Resultant { normal, center, lever, .. } = resultant;
        let velocity = self.relative.a_in_b.at(center);
        let turning = lever * self.relative.a_in_b.angular.dot(normal);
        let slip_velocity = velocity + normal * (turning - normal.dot(&velocity));
        match self.context.surfaces.motions() {
            None => slip_velocity,
            Some(surfaces) => {
                let motion = self.context.motion;
                let turning = lever * surfaces.angular_velocity(motion).dot(normal);
                slip_velocity + surfaces.velocity(motion, center, normal) + normal * turning
            }
        }
    }

    fn friction(
        &self,
        resultant: &Resultant,
        slip_velocity: Vec3,
        earlier: Option<[(usize, &ContactRecord); 2]>,
    ) -> PatchFriction {
        let Resultant { normal, force, area, lever, .. } = *resultant;
        let stuck = earlier.is_none_or(|[(_, first), _]| first.sticks);
        let output = match self.props.friction {
            FrictionProps::Bristle { stiffness, damping, mu_kinetic, mu_static, .. } => PatchBristle {
                carried_b: carried(resultant, earlier),
                slip_b: self.slip(resultant, earlier),
                slip_velocity_b: slip_velocity,
                normal_b: normal,
                stiffness: stiffness * area,
                damping: damping * area,
                kinetic_limit: mu_kinetic * force,
                static_limit: mu_static * force,
                stuck,
            }
            .evaluate(),
            _ => {
                let input = FrictionInput {
                    normal_force: force,
                    normal_b: normal,
                    slip_b: Vec3::zeros(),
                    slip_velocity_b: slip_velocity,
                    share: 1.0,
                    stiffness: 0.0,
                    carried_b: Vec3::zeros(),
                    stuck,
                    parameters: &[],
                };
                friction_alone(&self.props.friction, &input, &mut [])
            }
        };
        let along = normal.dot(&output.force_b);
        PatchFriction { force: output.force_b - normal * along, couple: along * lever, output }
    }

    /// Slip since the last commit, m: in the contact plane that of A at the centre, and along the normal the
    /// lever times the angle turned about it. In the step of the first touch, only the part after the touch.
    fn slip(&self, resultant: &Resultant, earlier: Option<[(usize, &ContactRecord); 2]>) -> Vec3 {
        let Some(since) = &self.context.motion.since_commit else { return Vec3::zeros() };
        let Resultant { normal, center, depth, lever, .. } = resultant;
        // Point of A at the centre: the mean of those at this centre and at the earlier one, in A's frame. No
        // choice of frames has a part in it, and a rolling contact does not slip.
        let present = self.relative.x_ab.point(center);
        let point_of_a = earlier.map_or(present, |[(_, first), (_, second)]| {
            let middle = (first.point_b + second.point_b) * 0.5;
            (since.x_ba.inverse().point(&middle) + present) * 0.5
        });
        let displacement = self.relative.x_ba.point(&point_of_a) - since.x_ba.point(&point_of_a);
        let turned = self.context.rotation(since);
        let approach = -normal.dot(&displacement);
        let mut slip = displacement + normal * (approach + lever * turned.dot(normal));
        if let Some(surfaces) = self.context.surfaces.motions() {
            let motion = self.context.motion;
            let before = earlier
                .map(|[(_, first), (_, second)]| ((first.point_b + second.point_b) * 0.5, first.normal_b));
            slip += surfaces.travel((motion, since), before, center, normal)
                + normal * (lever * surfaces.turned(motion).dot(normal));
        }
        if earlier.is_none() { shortened(slip, approach, *depth) } else { slip }
    }

    fn candidate(&self, part: SolidContactPart) -> ContactCandidate {
        let (a, b) = self.sides;
        ContactCandidate {
            key: entry::key(self.context, self.sides, part),
            primitive_b: b.primitive,
            element_a: a.element,
            element_b: b.element,
            kind_b: if b.parts.is_empty() { PrimitiveKind::Plane } else { PrimitiveKind::Polyhedron },
            ..ContactCandidate::NOTHING
        }
    }

    fn add_cell(&self, cell: &CellForce, sticks: bool, out: &mut ContactBuffer) {
        let found = ContactCandidate {
            feature: Feature::face(cell.face as usize),
            depth: cell.depth,
            normal_b: cell.normal_b,
            deepest_b: cell.point_b,
            weight: cell.area,
            ..self.candidate(cell.part)
        };
        let mut records = entry::records(self.context, self.sides, cell.part);
        let continues = records.find(|(_, record)| record.feature == found.feature.0).map(|(index, _)| index);
        let mut velocity = self.relative.a_in_b.at(&cell.point_b);
        if let Some(surfaces) = self.context.surfaces.motions() {
            velocity += surfaces.velocity(self.context.motion, &cell.point_b, &cell.normal_b);
        }
        self.add(out, continues, |contact| {
            contact.found = found;
            contact.point_b = cell.point_b;
            contact.rate = cell.rate;
            contact.normal_force = cell.force;
            contact.slip_velocity_b = velocity - cell.normal_b * cell.normal_b.dot(&velocity);
            contact.stored = crate::law::stored_energy(self.props, cell.area, cell.depth);
            contact.sticks = sticks || cell.force <= 0.0;
        });
    }

    /// Adds the memory of the side of entry, which is a contact without force.
    fn add_entry(&self, entry: &Entry, out: &mut ContactBuffer) {
        let found = ContactCandidate {
            normal_b: entry.in_b,
            role: ContactRole::Tracked,
            ..self.candidate(SolidContactPart::Entry)
        };
        self.add(out, entry.record, |contact| {
            contact.found = found;
            contact.bristle_b = entry.in_a;
        });
    }

    /// Adds a contact that `write` fills in. It continues the committed record of the given index.
    fn add(&self, out: &mut ContactBuffer, continues: Option<usize>, write: impl FnOnce(&mut FrameContact)) {
        let mut contact = FrameContact::blank();
        write(&mut contact);
        let (key, role) = (contact.found.key, contact.found.role);
        let Some(index) = out.slot(role, self.sealed) else { return };
        let slot = out.slot_of(index);
        out.contacts[index] = contact;
        let pushes = role == ContactRole::Active;
        out.refs[index] = ContactRef::new(key.head(), slot, pushes, continues.map(|index| index as u32));
    }
}

/// Bristle of the last commit in the present contact plane, m. Where the effective area has grown since then,
/// its force is kept, and where it has shrunk, its deflection: neither makes energy. The second friction
/// contact keeps the deflection times the area, so the shorter of the two candidates is the right one.
fn carried(resultant: &Resultant, earlier: Option<[(usize, &ContactRecord); 2]>) -> Vec3 {
    let Some([(_, first), (_, second)]) = earlier else { return Vec3::zeros() };
    let same_force = second.bristle_b / divisor(resultant.area);
    let kept =
        if same_force.norm_squared() < first.bristle_b.norm_squared() { same_force } else { first.bristle_b };
    carry_by_smallest_rotation(&kept, &first.normal_b, &resultant.normal)
}

/// Mean lever of the torsion about an axis, m, for a volume with moments about `reference`: that of a uniform
/// disc with the same radius of gyration. `center` is a point of the axis, and `normal` its unit direction.
fn lever(moments: &Moments, reference: &Vec3, center: &Vec3, normal: &Vec3) -> f64 {
    let about = moments.about(&(reference - center));
    let polar = about.second.trace() - normal.dot(&(about.second * normal));
    MEAN_LEVER * (polar.max(0.0) / about.volume.max(f64::MIN_POSITIVE)).sqrt()
}

/// Unit vector in the contact plane: along the friction force, or any if there is none.
fn across(normal: &Vec3, force: &Vec3) -> Vec3 {
    let length = force.norm();
    if length > 0.0 {
        return force / (length + f64::MIN_POSITIVE);
    }
    any_perpendicular(normal)
}
