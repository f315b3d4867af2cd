//! Groups in the text of a model file, and edits of their bounding volumes and leaf sizes. The edits change
//! the speed, not the results.
//!
//! Only the necessary parts of a text change: comments, order and numbers stay, byte for byte. Names stay
//! too, because a group without its own volume is still a group: paths of primitives do not change.

use crate::draft::is_above_by_default;
use crate::ron_tree::{self, Field, Node, Value};
use pong_geometry::bounding::BoundKind;

/// Bounding volume of a group.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Bound {
    /// Volume of this kind around everything below, down to the next movable groups.
    Around(BoundKind),
    /// No volume: the contents belong to the group above.
    Above,
}

impl std::fmt::Display for Bound {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Around(BoundKind::Custom(kind)) => write!(f, "Custom(\"{}\")", kind.escape_default()),
            Self::Around(kind) => f.write_str(kind.name()),
            Self::Above => f.write_str("Above"),
        }
    }
}

/// Group of a model file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// Path of names from the root.
    pub path: String,
    /// Index of the group above; `None` for the root.
    pub above: Option<usize>,
    /// True for a movable group; the root is one.
    pub movable: bool,
    /// Bounding volume.
    pub bound: Bound,
    /// Maximum number of elements of a leaf, if limited.
    pub leaf_size: Option<usize>,
    /// True if it holds primitives, false if it holds groups.
    pub holds_primitives: bool,
}

/// New bounding volume and leaf size of a group.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Regrouped {
    /// Path of the group.
    pub path: String,
    /// New bounding volume.
    pub bound: Bound,
    /// New maximum number of elements of a leaf; `None` for no limit.
    pub leaf_size: Option<usize>,
}

/// Groups in the text of a model file, each before those below it, in file order.
///
/// # Errors
/// Cause and cure, if [`parse`](crate::parse) does not accept the text.
pub fn groups(text: &str) -> Result<Vec<Group>, String> {
    let found = read(text.strip_prefix(BOM).unwrap_or(text))?;
    Ok(found.into_iter().map(|places| places.group).collect())
}

/// Text with new bounding volumes and leaf sizes for some of its groups.
///
/// # Errors
/// Cause and cure, if [`parse`](crate::parse) does not accept the text, or a group does not exist.
pub fn regrouped(text: &str, changes: &[Regrouped]) -> Result<String, String> {
    let (mark, plain) = text.strip_prefix(BOM).map_or(("", text), |plain| (&text[..BOM.len_utf8()], plain));
    let mut found = read(plain)?;
    for change in changes {
        let Some(places) = found.iter_mut().find(|places| places.group.path == change.path) else {
            return Err(format!("there is no group {}; name one of the file's", change.path));
        };
        (places.group.bound, places.group.leaf_size) = (change.bound.clone(), change.leaf_size);
    }
    let defaults = default_bounds(&found, |places| Some(&places.group.bound));
    let edits = found.iter().zip(defaults).flat_map(|(places, default)| places.edits(plain, &default));
    Ok(mark.to_owned() + &edited(plain, edits.collect()))
}

/// Bounding volumes that groups get if the text names none: `Above` for a group that is not movable, has no leaf
/// size, and has no volume below it in its body; otherwise `Aabb`. `named` returns the volume that a group is given.
fn default_bounds(found: &[Places], named: impl Fn(&Places) -> Option<&Bound>) -> Vec<Bound> {
    let mut volume_below = vec![false; found.len()];
    let mut defaults = vec![Bound::Around(BoundKind::Aabb); found.len()];
    // Groups below come after their group, so in reverse order they are visited first.
    for index in (0..found.len()).rev() {
        let group = &found[index].group;
        if is_above_by_default(group.movable, group.leaf_size, volume_below[index]) {
            defaults[index] = Bound::Above;
        }
        if let Some(above) = group.above.filter(|_| !group.movable) {
            let bound = named(&found[index]).unwrap_or(&defaults[index]);
            volume_below[above] |= volume_below[index] || *bound != Bound::Above;
        }
    }
    defaults
}

/// Text after edits, which must not overlap.
fn edited(text: &str, mut edits: Vec<Edit>) -> String {
    edits.sort_by_key(|edit| edit.from);
    let mut out = String::new();
    let mut done = 0;
    for Edit { from, to, put } in edits {
        out.push_str(&text[done..from]);
        out.push_str(&put);
        done = to;
    }
    out + &text[done..]
}

/// Mesh files named in the text of a model file, each once, in file order.
///
/// # Errors
/// Cause and cure, if [`parse`](crate::parse) does not accept the text.
pub fn mesh_files(text: &str) -> Result<Vec<String>, String> {
    let node = ron_tree::parse(text.strip_prefix(BOM).unwrap_or(text));
    let node = node.map_err(|error| format!("{}; check it with `pong check`", error.cause))?;
    let mut files = Vec::new();
    meshes(&node, &mut files);
    Ok(files)
}

/// Collects the `file` fields of primitives at any depth.
fn meshes(node: &Node, files: &mut Vec<String>) {
    match &node.value {
        Value::Struct(kind, fields) => {
            let may = matches!(kind.as_deref(), Some("TriangleMesh" | "Polyhedron"));
            if let Some(file) = field(fields, "file").filter(|_| may)
                && let Value::Text(file) = &within_some(&file.value).value
                && !files.contains(file)
            {
                files.push(file.clone());
            }
            fields.iter().for_each(|field| meshes(&field.value, files));
        }
        Value::List(items) | Value::Tuple(_, items) => items.iter().for_each(|item| meshes(item, files)),
        _ => {}
    }
}

const BOM: char = '\u{feff}';

/// Positions of a group's fields in the text, as start and end in bytes.
struct Places {
    bound: Option<(usize, usize)>,
    leaf_size: Option<(usize, usize)>,
    /// Values in the text, `None` where it has none.
    written: (Option<Bound>, Option<usize>),
    /// Start of the name's field and end of its value.
    name: (usize, usize),
    group: Group,
}

/// Replacement of a range of a text.
struct Edit {
    from: usize,
    to: usize,
    put: String,
}

impl Places {
    /// Edits that give the text the values of the group; none if it already has them. `default` is the
    /// bounding volume of the group if the text names none.
    fn edits(&self, text: &str, default: &Bound) -> Vec<Edit> {
        let mut edits = Vec::new();
        let mut added = String::new();
        let mut set = |place: Option<(usize, usize)>, name: &str, value: Option<String>| match (place, value)
        {
            (Some((from, to)), value) => {
                edits.push(Edit { from, to, put: value.unwrap_or_else(|| "None".to_owned()) });
            }
            (None, Some(value)) => added += &format!("{}{name}: {value}", self.separator(text)),
            (None, None) => {}
        };
        let Group { bound, leaf_size, .. } = &self.group;
        if bound != self.written.0.as_ref().unwrap_or(default) {
            set(self.bound, "bound", Some(bound.to_string()));
        }
        if *leaf_size != self.written.1 {
            set(self.leaf_size, "leaf_size", leaf_size.map(|size| size.to_string()));
        }
        if !added.is_empty() {
            edits.push(Edit { from: self.name.1, to: self.name.1, put: added });
        }
        edits
    }

    /// Separator between the name and a field after it: a line break if the name begins a line.
    fn separator(&self, text: &str) -> String {
        let line = text[..self.name.0].rfind('\n').map_or(0, |end| end + 1);
        let before = &text[line..self.name.0];
        let end = if text[..line].ends_with("\r\n") { "\r\n" } else { "\n" };
        if before.trim().is_empty() && line > 0 { format!(",{end}{before}") } else { ", ".to_owned() }
    }
}

/// Groups of a text, each before those below it.
fn read(text: &str) -> Result<Vec<Places>, String> {
    let refused = || "the text is no model; check it with `pong check`".to_owned();
    let node =
        ron_tree::parse(text).map_err(|error| format!("{}; check it with `pong check`", error.cause))?;
    let root = fields(&node).and_then(|top| field(top, "root")).ok_or_else(refused)?;
    let mut found = Vec::new();
    walk(text, &root.value, None, &mut found).ok_or_else(refused)?;
    let defaults = default_bounds(&found, |places| places.written.0.as_ref());
    for (places, default) in found.iter_mut().zip(defaults) {
        places.group.bound = places.written.0.clone().unwrap_or(default);
    }
    Ok(found)
}

/// Adds a group and those below it; `None` if the structure is not that of a valid model.
fn walk(text: &str, node: &Node, above: Option<usize>, found: &mut Vec<Places>) -> Option<()> {
    let own = fields(within_some(node))?;
    let span = |field: &Field| {
        let end = ron_tree::end_of_value(text, field.value.at).ok()?;
        Some((field.value.at as usize, end))
    };
    let name = field(own, "name")?;
    let Value::Text(word) = &within_some(&name.value).value else { return None };
    let path = above.map_or(word.clone(), |above| format!("{}/{word}", found[above].group.path));
    let (bound, leaf_size) = (field(own, "bound"), field(own, "leaf_size"));
    let list = |name: &str| match &within_some(&field(own, name)?.value).value {
        Value::List(items) if !items.is_empty() => Some(items),
        _ => None,
    };
    let movable = field(own, "movable").map(|field| within_some(&field.value).value.clone());
    let written = match bound {
        Some(field) => Some(bound_of(&field.value)?),
        None => None,
    };
    let limit = leaf_size.and_then(|field| match within_some(&field.value).value {
        Value::Number(size) => Some(size as usize),
        _ => None,
    });
    found.push(Places {
        written: (written.clone(), limit),
        bound: bound.and_then(span),
        leaf_size: leaf_size.and_then(span),
        name: (name.at as usize, span(name)?.1),
        group: Group {
            path,
            above,
            movable: above.is_none() || movable == Some(Value::Bool(true)),
            bound: written.unwrap_or(Bound::Above),
            leaf_size: limit,
            holds_primitives: list("primitives").is_some(),
        },
    });
    let index = found.len() - 1;
    list("groups").into_iter().flatten().try_for_each(|below| walk(text, below, Some(index), found))
}

fn bound_of(node: &Node) -> Option<Bound> {
    match &within_some(node).value {
        Value::Name(word) => match word.as_ref() {
            "Sphere" => Some(Bound::Around(BoundKind::Sphere)),
            "Obb" => Some(Bound::Around(BoundKind::Obb)),
            "Above" => Some(Bound::Above),
            _ => Some(Bound::Around(BoundKind::Aabb)),
        },
        Value::Tuple(_, items) => match &items.first()?.value {
            Value::Text(kind) => Some(Bound::Around(BoundKind::Custom(kind.clone()))),
            _ => None,
        },
        _ => None,
    }
}

/// Replaces `Some(x)` by `x`.
fn within_some(node: &Node) -> &Node {
    match &node.value {
        Value::Tuple(Some(word), items) if word.as_ref() == "Some" && items.len() == 1 => &items[0],
        _ => node,
    }
}

fn fields(node: &Node) -> Option<&[Field]> {
    match &node.value {
        Value::Struct(_, fields) => Some(fields),
        _ => None,
    }
}

fn field<'n>(fields: &'n [Field], name: &str) -> Option<&'n Field> {
    fields.iter().find(|field| field.name.as_ref() == name)
}
