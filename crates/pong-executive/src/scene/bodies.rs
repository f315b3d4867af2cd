//! The bodies of a scene: one for every movable group of every object.

use super::document::{BodyEntry, InertiaEntry, MotionEntry, ObjectEntry, PathEntry};
use super::error::{At, Faults};
use super::poses::pose;
use super::setting::Setting;
use crate::body::{Motion, RigidBody};
use crate::mass::MassProperties;
use crate::path::{Oscillation, Path, PathRow, PathTable};
use pong_engine::{InterfaceId, SurfaceMotion};
use pong_geometry::{Mat3, Pose, Twist, Vec3};

/// All bodies that could be made; the others are noted as faults.
pub(crate) fn bodies(setting: &Setting<'_>, faults: &mut Faults<'_>) -> Vec<RigidBody> {
    let mut bodies: Vec<RigidBody> = Vec::new();
    for (index, entry) in setting.document.objects.iter().enumerate() {
        let mut maker = ObjectBodies { setting, object: entry, root: root_pose(setting, index) };
        let first = bodies.len();
        for (number, body) in entry.bodies.iter().enumerate() {
            let thing = format!("objects/{}/bodies[{number}]", entry.name);
            bodies.extend(maker.body(body, &mut faults.at(&thing)));
            if repeats_last(&bodies) {
                bodies.pop();
                faults.note(&thing, "this group already has a body", "list each movable group once");
            }
        }
        tell_missing(entry, index, setting, &bodies[first..], faults);
    }
    bodies
}

fn repeats_last(bodies: &[RigidBody]) -> bool {
    let Some((last, before)) = bodies.split_last() else { return false };
    before.iter().any(|body| body.interface == last.interface)
}

fn tell_missing(
    entry: &ObjectEntry,
    index: usize,
    setting: &Setting<'_>,
    bodies: &[RigidBody],
    faults: &mut Faults<'_>,
) {
    // A body with a fault is missing too, but its fault is noted already.
    if bodies.len() < entry.bodies.len() {
        return;
    }
    let Some(object) = setting.objects[index] else { return };
    for interface in setting.world.scene().interfaces(object).unwrap_or_default() {
        if !bodies.iter().any(|body| body.interface == Some(interface)) {
            let path = setting.world.scene().interface_path(interface).unwrap_or_default();
            let cause = format!("the movable group `{path}` has no body");
            let cure = "list it in `bodies`, if only with motion: Fixed";
            faults.note(format!("objects/{}", entry.name), cause, cure);
        }
    }
}

/// Initial pose of an object's root: the reference for its other groups, unless the scene gives their pose.
fn root_pose(setting: &Setting<'_>, index: usize) -> Pose {
    let scene = setting.world.scene();
    let named = |group: &str| scene.interface(setting.objects[index]?, group).ok();
    // Accepts each name that the scene format allows for the root.
    let is_root = |body: &&BodyEntry| {
        body.group.is_empty() || named(&body.group).is_some_and(|id| named("") == Some(id))
    };
    let root = setting.document.objects[index].bodies.iter().find(is_root);
    let mut unheard = Faults::new("");
    root.map_or(Pose::identity(), |root| {
        pose(&root.position.unwrap_or_default(), &root.orientation, &mut unheard.at(""))
    })
}

struct ObjectBodies<'a> {
    setting: &'a Setting<'a>,
    object: &'a ObjectEntry,
    root: Pose,
}

impl ObjectBodies<'_> {
    fn body(&mut self, entry: &BodyEntry, at: &mut At<'_, '_>) -> Option<RigidBody> {
        let name = match entry.group.as_str() {
            "" => self.object.name.clone(),
            group => format!("{}/{group}", self.object.name),
        };
        let interface = self.setting.interface(&name, at);
        // One name for a body, however the scene writes its group.
        let name = interface.and_then(|id| self.setting.world.scene().group_name(id).ok()).unwrap_or(name);
        let start = self.start(entry, interface, at);
        let twist = start_twist(entry, at);
        let motion = motion(entry, &start, &twist, at);
        let surface = surface(entry, at);
        Some(RigidBody { name, motion: motion?, pose: start, twist, interface: Some(interface?), surface })
    }

    /// The pose given, or else the one of the model's author.
    fn start(&self, entry: &BodyEntry, interface: Option<InterfaceId>, at: &mut At<'_, '_>) -> Pose {
        let given = pose(&entry.position.unwrap_or_default(), &entry.orientation, at);
        let authored = interface.and_then(|id| self.setting.world.scene().authored_pose(id).ok());
        let authored = authored.map_or(Pose::identity(), |x_rg| self.root.compose(&x_rg));
        let by_author = !entry.group.is_empty();
        Pose {
            position: if by_author && entry.position.is_none() { authored.position } else { given.position },
            orientation: if by_author && entry.orientation.is_none() {
                authored.orientation
            } else {
                given.orientation
            },
        }
    }
}

fn start_twist(entry: &BodyEntry, at: &mut At<'_, '_>) -> Twist {
    let linear = entry.linear_velocity.unwrap_or_default();
    let angular = entry.angular_velocity.unwrap_or_default();
    at.finite("linear_velocity", &linear);
    at.finite("angular_velocity", &angular);
    Twist { linear: linear.into(), angular: angular.into() }
}

/// Motion of the body's surface along itself.
fn surface(entry: &BodyEntry, at: &mut At<'_, '_>) -> SurfaceMotion {
    let named = [
        ("surface_velocity", entry.surface_velocity),
        ("surface_angular_velocity", entry.surface_angular_velocity),
        ("belt_velocity", entry.belt_velocity),
    ];
    named.iter().for_each(|(name, value)| _ = at.finite(name, value));
    let [linear_velocity, angular_velocity, belt_velocity] = named.map(|(_, value)| value);
    SurfaceMotion { linear_velocity, angular_velocity, belt_velocity, ..SurfaceMotion::default() }
}

fn motion(entry: &BodyEntry, start: &Pose, twist: &Twist, at: &mut At<'_, '_>) -> Option<Motion> {
    let keeps_velocity =
        matches!(entry.motion, MotionEntry::Free | MotionEntry::Prescribed(PathEntry::ConstantTwist));
    if !keeps_velocity && (entry.linear_velocity.is_some() || entry.angular_velocity.is_some()) {
        let cause = "a velocity is given, but the motion does not have one";
        at.note(cause, "leave it out, or use motion: Prescribed(ConstantTwist)");
    }
    match &entry.motion {
        MotionEntry::Fixed => Some(Motion::Fixed),
        MotionEntry::Free => mass(entry, at).map(Motion::Free),
        MotionEntry::Prescribed(path) => path_of(path, entry, start, twist, at).map(Motion::Prescribed),
    }
}

fn mass(entry: &BodyEntry, at: &mut At<'_, '_>) -> Option<MassProperties> {
    let (Some(mass), Some(inertia)) = (entry.mass, entry.inertia) else {
        at.note("a free body needs `mass` and `inertia`", "give both, or another motion");
        return None;
    };
    let inertia = match inertia {
        InertiaEntry::Diagonal(x, y, z) => Mat3::from_diagonal(&Vec3::new(x, y, z)),
        InertiaEntry::Full { xx, yy, zz, xy, xz, yz } => Mat3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
    };
    let mass = MassProperties { mass, inertia, mass_center: entry.mass_center.into() };
    let wrong = mass.faults();
    wrong.iter().for_each(|(cause, cure)| at.note(cause, cure));
    wrong.is_empty().then_some(mass)
}

fn path_of(
    path: &PathEntry,
    entry: &BodyEntry,
    start: &Pose,
    twist: &Twist,
    at: &mut At<'_, '_>,
) -> Option<Path> {
    match path {
        PathEntry::ConstantTwist => Some(Path::ConstantTwist { pose: *start, twist: *twist }),
        PathEntry::Sinusoid { axis, travel, angle, frequency, phase } => {
            let values = [*travel, *angle, *frequency, *phase];
            let finite = at.finite("Sinusoid", &values);
            let axis = direction(axis, at).filter(|_| finite)?;
            let [travel, angle, frequency, phase] = values;
            Some(Path::Oscillation(Oscillation { pose: *start, axis, travel, angle, frequency, phase }))
        }
        PathEntry::Table(rows) => {
            if entry.position.is_some() || entry.orientation.is_some() {
                let cause = "a pose is given beside a table of poses";
                at.note(cause, "leave `position` and `orientation` to the rows");
            }
            let rows: Vec<PathRow> = rows
                .iter()
                .map(|row| PathRow { time: row.time, pose: pose(&row.position, &row.orientation, at) })
                .collect();
            PathTable::new(&rows).map_err(|line| at.note_line(&line)).ok().map(Path::Table)
        }
    }
}

fn direction(axis: &[f64; 3], at: &mut At<'_, '_>) -> Option<Vec3> {
    if !at.finite("axis", axis) {
        return None;
    }
    let unit = Vec3::from(*axis).try_normalize(0.0);
    if unit.is_none() {
        at.note("the axis is zero", "give a direction");
    }
    unit
}
