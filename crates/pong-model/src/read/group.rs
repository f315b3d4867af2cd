//! Groups: names, poses, bounding volumes, surfaces, and contents.

use super::fields::Fields;
use super::place::{GroupReader, Place, authored_name, read_name, surface_index};
use super::primitive::read_primitive;
use super::reader::Reader;
use crate::draft::{BodyDraft, GroupDraft, is_above_by_default};
use crate::model::MovableGroup;
use crate::ron_tree::{Node, Value};
use crate::schema;
use pong_geometry::Pose;
use pong_geometry::bounding::BoundKind;
use std::collections::HashSet;

/// Values that a group inherits from the group above it.
#[derive(Clone)]
pub(super) struct Above {
    /// Path of the group above; empty above the root.
    path: String,
    /// Body above and the group's index in it; `None` above the root.
    owner: Option<(usize, usize)>,
    /// Pose of the group above in the frame of that body.
    x_bg: Pose,
    surface: Option<u32>,
    /// True if the group above has `contact: Solid`.
    solid: bool,
    /// Outermost group of this body that is declared one surface (index into the body's groups).
    one_surface: Option<u32>,
}

/// Reads the root group with everything below it.
pub(super) fn read_root(groups: &mut GroupReader<'_, '_>, node: &Node) {
    let above = Above {
        path: String::new(),
        owner: None,
        x_bg: Pose::identity(),
        surface: None,
        solid: false,
        one_surface: None,
    };
    read_group(groups, node, &above, "root", &mut HashSet::new());
}

fn read_group(
    groups: &mut GroupReader<'_, '_>,
    node: &Node,
    above: &Above,
    nameless: &str,
    siblings: &mut HashSet<String>,
) {
    let path = join(&above.path, authored_name(node).unwrap_or(nameless));
    let Some(fields) = Fields::open(groups.reader, node, &path, &[schema::GROUP]) else { return };
    let name = read_name(groups.reader, &fields, &path, siblings);
    let is_root = above.owner.is_none();
    let movable = read_movable(groups.reader, &fields, &path, is_root);
    let x_pg = read_pose(groups.reader, &fields, &path, is_root);
    let surface = match fields.optional("surface") {
        Some(node) => surface_index(groups.reader, groups.surfaces, node, &path),
        None => above.surface,
    };
    let contact =
        fields.optional("contact").and_then(|node| groups.reader.variant(node, &path, schema::CONTACTS));
    let one_surface = fields.optional("one_surface").and_then(|node| groups.reader.boolean(node, &path));
    let bound = read_bound(groups.reader, &fields, &path, movable);
    let leaf_size = read_leaf_size(groups.reader, &fields, &path);
    let x_bg = above.x_bg.compose(&x_pg);
    let mut place = if movable {
        new_body(groups, above, name, path, x_bg)
    } else {
        same_body(groups, above, path, x_bg)
    };
    place.surface = surface;
    place.solid = contact.map_or(above.solid, |contact| contact == "Solid");
    place.one_surface = match (one_surface, above.one_surface.filter(|_| !movable)) {
        (Some(false), _) => None,
        (Some(true), None) => Some(place.group as u32),
        (_, of_above) => of_above,
    };
    let draft = &mut groups.bodies[place.body].groups[place.group];
    draft.bound = bound.clone().flatten().unwrap_or(BoundKind::Aabb);
    draft.leaf_size = leaf_size;
    draft.at = node.at;
    read_contents(groups, &fields, &place);
    let above = match bound {
        Some(given) => given.is_none(),
        None => {
            let volume_below = holds_volume(&groups.bodies[place.body].groups, place.group);
            is_above_by_default(movable, leaf_size, volume_below)
        }
    };
    groups.bodies[place.body].groups[place.group].above = above;
}

/// Tests whether a group of the same body, at any depth below this group, has a volume of its own.
fn holds_volume(groups: &[GroupDraft], group: usize) -> bool {
    groups[group].children.iter().any(|&child| !groups[child].above || holds_volume(groups, child))
}

fn new_body(
    groups: &mut GroupReader<'_, '_>,
    above: &Above,
    name: Option<String>,
    path: String,
    x_bg: Pose,
) -> Place {
    let parent = above.owner.map(|(body, _)| body);
    let x_rb = match parent.and_then(|parent| groups.bodies[parent].body.initial_pose) {
        Some(x_rp) => x_rp.compose(&x_bg),
        None => Pose::identity(),
    };
    let body = MovableGroup {
        name: name.unwrap_or_default(),
        path: path.clone(),
        parent: parent.map(|parent| parent as u32),
        initial_pose: Some(x_rb),
        ..MovableGroup::default()
    };
    groups.bodies.push(BodyDraft { body, groups: vec![empty_group(&path)], ..BodyDraft::default() });
    Place {
        path,
        body: groups.bodies.len() - 1,
        group: 0,
        x_bg: Pose::identity(),
        surface: None,
        solid: false,
        one_surface: None,
    }
}

fn same_body(groups: &mut GroupReader<'_, '_>, above: &Above, path: String, x_bg: Pose) -> Place {
    let (body, parent) = above.owner.unwrap_or((0, 0));
    let draft = &mut groups.bodies[body].groups;
    draft.push(empty_group(&path));
    let group = draft.len() - 1;
    draft[parent].children.push(group);
    Place { path, body, group, x_bg, surface: None, solid: false, one_surface: None }
}

fn empty_group(path: &str) -> GroupDraft {
    GroupDraft::new(&path.into())
}

fn read_contents(groups: &mut GroupReader<'_, '_>, fields: &Fields<'_>, place: &Place) {
    let (below, primitives) = (fields.optional("groups"), fields.optional("primitives"));
    if below.is_some() && primitives.is_some() {
        let cure = "put the primitives into a group of their own";
        let at = fields.at_field("primitives");
        groups.reader.fault(
            at,
            &place.path,
            "groups-and-primitives",
            "a group holds groups or primitives, never both",
            cure,
        );
    }
    let mut siblings = HashSet::new();
    let mut count = None;
    if let Some(items) = below.and_then(|node| groups.reader.list(node, &place.path)) {
        count = Some(items.len());
        let above = Above {
            path: place.path.clone(),
            owner: Some((place.body, place.group)),
            x_bg: place.x_bg,
            surface: place.surface,
            solid: place.solid,
            one_surface: place.one_surface,
        };
        for (index, item) in items.iter().enumerate() {
            read_group(groups, item, &above, &format!("groups[{index}]"), &mut siblings);
        }
    }
    if let Some(items) = primitives.and_then(|node| groups.reader.list(node, &place.path)) {
        count = Some(count.unwrap_or(0) + items.len());
        for (index, item) in items.iter().enumerate() {
            read_primitive(groups, item, place, index, &mut siblings);
        }
    }
    let unreadable = count.is_none() && (below.is_some() || primitives.is_some());
    if count.unwrap_or(0) == 0 && !unreadable {
        let cure = "give it `groups: [..]` or `primitives: [..]`, or remove it";
        groups.reader.fault(fields.at, &place.path, "empty-group", "a group without contents", cure);
    }
}

fn read_movable(reader: &mut Reader<'_>, fields: &Fields<'_>, path: &str, is_root: bool) -> bool {
    let Some(node) = fields.optional("movable") else { return is_root };
    let movable = reader.boolean(node, path);
    if is_root && movable == Some(false) {
        let cure = "leave `movable` out; a model that never moves is given a constant state";
        reader.fault(node.at, path, "root-not-movable", "the root is always movable", cure);
    }
    is_root || movable.unwrap_or(false)
}

fn read_pose(reader: &mut Reader<'_>, fields: &Fields<'_>, path: &str, is_root: bool) -> Pose {
    let Some(node) = fields.optional("pose") else { return Pose::identity() };
    if is_root {
        let cure = "remove it; the host sets where the root is, or put a group below the root";
        reader.fault(
            node.at,
            path,
            "root-pose",
            "the root has no group above that its pose could refer to",
            cure,
        );
    }
    let Some(fields) = Fields::open(reader, node, path, &[schema::POSE]) else {
        return Pose::identity();
    };
    let position = fields.optional("position").and_then(|node| reader.vector(node, path));
    let orientation = fields.optional("orientation").and_then(|node| reader.rotation(node, path));
    let identity = Pose::identity();
    Pose {
        position: position.unwrap_or(identity.position),
        orientation: orientation.unwrap_or(identity.orientation),
    }
}

/// Kind of a group's volume, `Some(None)` for `Above`; `None` if the file names none.
fn read_bound(
    reader: &mut Reader<'_>,
    fields: &Fields<'_>,
    path: &str,
    movable: bool,
) -> Option<Option<BoundKind>> {
    let node = fields.optional("bound")?;
    Some(match reader.variant(node, path, schema::BOUNDS) {
        Some("Sphere") => Some(BoundKind::Sphere),
        Some("Obb") => Some(BoundKind::Obb),
        Some("Custom") => Some(custom_bound(reader, node, path)),
        Some("Above") if movable => {
            let cause = "a movable group moves by itself and cannot do without a bounding volume";
            let cure = "give it `Aabb`, `Sphere` or `Obb`, or leave `bound` out";
            reader.refuse(node.at, path, "bound-above", cause, cure)
        }
        Some("Above") => None,
        _ => Some(BoundKind::Aabb),
    })
}

fn read_leaf_size(reader: &mut Reader<'_>, fields: &Fields<'_>, path: &str) -> Option<usize> {
    let node = fields.optional("leaf_size")?;
    let size = reader.number(node, path)?;
    // Limited to 2³²: no body has more elements.
    if size >= 1.0 && size == libm::trunc(size) {
        return Some(size.min(f64::from(u32::MAX)) as usize);
    }
    let cause = format!("the size of a leaf is {size}");
    reader.refuse(node.at, path, "leaf-size", cause, "give a whole number of elements, at least 1")
}

fn custom_bound(reader: &mut Reader<'_>, node: &Node, path: &str) -> BoundKind {
    let name = match &node.value {
        Value::Tuple(_, items) if items.len() == 1 => reader.text(&items[0], path),
        _ => {
            let cause = "a custom volume without the name of its kind";
            reader.refuse(node.at, path, "wrong-type", cause, "write Custom(\"kind\")")
        }
    };
    let Some(name) = name else { return BoundKind::Aabb };
    if reader.judges_shapes && reader.ext.volume(&name).is_none() {
        let cause = format!("no bounding volume of the kind \"{name}\" is registered");
        reader.fault(
            node.at,
            path,
            "unknown-volume",
            cause,
            "register it with Extensions::add_volume before loading",
        );
        return BoundKind::Aabb;
    }
    BoundKind::Custom(name)
}

fn join(above: &str, name: &str) -> String {
    if above.is_empty() { name.to_owned() } else { format!("{above}/{name}") }
}
