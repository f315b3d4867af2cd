//! Several models that never move relative to each other as one model: `pong join`.
//!
//! Contacts on one surface share one spring only within a movable group (docs/theory.md, 2.2). Fixed parts that are
//! flush therefore belong into one model. The root of each source becomes a group of the root of the new model, at a
//! given pose; movable groups below the roots stay movable.

use crate::authored::{Field, Node, Value};
use crate::model::Model;
use pong_geometry::Pose;

/// Model to be joined to others.
pub struct Source<'s> {
    /// Name of its group below the new root; unique among the sources.
    pub name: &'s str,
    /// File as written ([`authored::load`](crate::authored::load)).
    pub document: &'s Node,
    /// Model that the loader makes of it.
    pub model: &'s Model,
    /// Pose of its root in the frame of the new root.
    pub pose: Pose,
    /// Path from the folder of the new file to that of the source's meshes, ending in `/`; empty for the same folder.
    /// `None` if the meshes are not below the folder of the new file.
    pub meshes: Option<&'s str>,
}

/// Values of a model file, for [`write::text`](crate::write::text), that joins models. With `one_surface` all faces of
/// the root's rigid body are one surface.
///
/// Surfaces of the same name and the same values become one; of those that differ, the later ones get the name of
/// their source and a dot in front.
///
/// # Errors
/// Cause and cure: there are no sources, names repeat, or settings of whole files differ.
pub fn join(name: &str, sources: &[Source<'_>], one_surface: bool) -> Result<Value, String> {
    let Some(first) = sources.first() else {
        return Err("there are no models to join; name at least one".to_owned());
    };
    for (index, source) in sources.iter().enumerate() {
        if source.name.is_empty() || source.name.contains('/') {
            return Err(format!("the name \"{}\" is empty or has a `/`; give another one", source.name));
        }
        if sources[..index].iter().any(|earlier| earlier.name == source.name) {
            return Err(format!("two models have the name \"{}\"; give each its own", source.name));
        }
        if source.meshes.is_none() && names_a_file(&source.document.value) {
            let name = source.name;
            return Err(format!(
                "\"{name}\" reads a mesh from a folder that is not below that of the new file; write the new file into a \
                 folder above the meshes"
            ));
        }
        if source.model.entry_memory != first.model.entry_memory {
            let [one, other] = [first.name, source.name];
            return Err(format!(
                "\"{one}\" and \"{other}\" differ in `entry_memory`; give both the same value"
            ));
        }
    }
    let mut tables = Tables::default();
    let mut groups = Vec::new();
    for source in sources {
        groups.push(tables.add(name, source)?);
    }
    let mut root = vec![("name", Value::text(name))];
    if one_surface {
        root.push(("one_surface", Value::Bool(true)));
    }
    root.push(("groups", Value::list(groups)));
    let mut fields = Vec::new();
    if !first.model.entry_memory {
        fields.push(("entry_memory", Value::Bool(false)));
    }
    fields
        .push(("surfaces", Value::map(tables.surfaces.iter().map(|(name, value)| (&**name, value.clone())))));
    if !tables.pairs.is_empty() {
        fields.push(("pairs", Value::list(tables.pairs)));
    }
    if !tables.filters.is_empty() {
        fields.push(("filters", Value::list(tables.filters)));
    }
    fields.push(("root", Value::fields(root)));
    Ok(Value::model(name, fields))
}

/// Tables of the new file.
#[derive(Default)]
struct Tables {
    surfaces: Vec<(String, Value)>,
    pairs: Vec<Value>,
    filters: Vec<Value>,
}

impl Tables {
    /// Adds the surfaces, pairs and filters of a source; returns the group of its root.
    fn add(&mut self, model: &str, source: &Source<'_>) -> Result<Value, String> {
        let changes = Changes { surfaces: self.add_surfaces(source), source, model };
        if let Some(Value::List(pairs)) = field(&source.document.value, "pairs") {
            for pair in pairs {
                self.add_pair(changes.pair(&pair.value), source.name)?;
            }
        }
        let root = source.model.groups.first().map_or("", String::as_str);
        for pair in &source.model.filters {
            let path = |group: &String| format!("{model}/{}{}", source.name, &group[root.len()..]);
            self.filters.push(Value::tuple(pair.iter().map(|group| Value::text(&path(group)))));
        }
        let Some(root) = field(&source.document.value, "root") else {
            return Err(format!("the model \"{}\" has no root", source.name));
        };
        Ok(changes.root(root))
    }

    /// Adds the surfaces of a source; returns old and new names of those that get another name.
    fn add_surfaces(&mut self, source: &Source<'_>) -> Vec<(String, String)> {
        let mut renamed = Vec::new();
        let Some(Value::Map(entries)) = field(&source.document.value, "surfaces") else { return renamed };
        for (key, value) in entries {
            let Value::Text(name) = &key.value else { continue };
            let value = without_places(&value.value);
            let same_name = |name: &str, known: &(String, Value)| known.0 == *name;
            match self.surfaces.iter().find(|known| same_name(name, known)) {
                Some((_, known)) if *known == value => {}
                None => self.surfaces.push((name.clone(), value)),
                Some(_) => {
                    let mut new = format!("{}.{name}", source.name);
                    while self.surfaces.iter().any(|known| same_name(&new, known)) {
                        new.push('\'');
                    }
                    self.surfaces.push((new.clone(), value));
                    renamed.push((name.clone(), new));
                }
            }
        }
        renamed
    }

    /// Adds an entry of `pairs` unless it is there already.
    fn add_pair(&mut self, pair: Value, source: &str) -> Result<(), String> {
        let names = |pair: &Value| {
            let mut names: Vec<String> = match field(pair, "surfaces") {
                Some(Value::Tuple(_, items)) => {
                    items.iter().map(|item| crate::write::line(&item.value)).collect()
                }
                _ => Vec::new(),
            };
            names.sort();
            names
        };
        match self.pairs.iter().find(|known| names(known) == names(&pair)) {
            Some(known) if *known == pair => Ok(()),
            Some(_) => Err(format!(
                "\"{source}\" and a model before it have different `pairs` entries for {}; make them equal, or give the \
                 surfaces different names",
                names(&pair).join(" and ")
            )),
            None => {
                self.pairs.push(pair);
                Ok(())
            }
        }
    }
}

/// Changes of a source's values on the way into the new file.
struct Changes<'s> {
    /// Old and new names of surfaces.
    surfaces: Vec<(String, String)>,
    source: &'s Source<'s>,
    /// Name of the new model.
    model: &'s str,
}

impl Changes<'_> {
    /// Root group of the source as a group at its pose.
    fn root(&self, root: &Value) -> Value {
        let mut group = self.changed(root);
        if let Value::Struct(_, fields) = &mut group {
            fields.retain(|field| !matches!(&*field.name, "name" | "movable"));
            let Pose { position: p, orientation: q } = self.source.pose;
            let mut first = vec![field_of("name", Value::text(self.source.name))];
            if self.source.pose != Pose::identity() {
                let position = Value::numbers(&[p.x, p.y, p.z]);
                let orientation = Value::numbers(&[q.w, q.i, q.j, q.k]);
                let pose = [("position", position), ("orientation", orientation)];
                first.push(field_of("pose", Value::fields(pose)));
            }
            fields.splice(0..0, first);
        }
        group
    }

    /// Value of a group or primitive, or of a list of them, with new names of surfaces and paths of meshes.
    fn changed(&self, value: &Value) -> Value {
        match value {
            Value::Struct(name, fields) => {
                let fields = fields.iter().map(|field| {
                    let value = match &*field.name {
                        "surface" => self.text(&field.value.value, &|name| self.surface(name)),
                        "file" => self.text(&field.value.value, &|path| {
                            format!("{}{path}", self.source.meshes.unwrap_or_default())
                        }),
                        "groups" | "primitives" => self.changed(&field.value.value),
                        _ => without_places(&field.value.value),
                    };
                    field_of(&field.name, value)
                });
                Value::Struct(name.clone(), fields.collect())
            }
            Value::List(items) => Value::list(items.iter().map(|item| self.changed(&item.value))),
            Value::Tuple(name, items) => Value::Tuple(
                name.clone(),
                items.iter().map(|item| self.changed(&item.value).into()).collect(),
            ),
            other => other.clone(),
        }
    }

    /// Text, or `Some(text)`, changed.
    fn text(&self, value: &Value, change: &dyn Fn(&str) -> String) -> Value {
        match value {
            Value::Text(text) => Value::text(&change(text)),
            Value::Tuple(name, items) => {
                let items = items.iter().map(|item| self.text(&item.value, change).into());
                Value::Tuple(name.clone(), items.collect())
            }
            other => other.clone(),
        }
    }

    fn surface(&self, name: &str) -> String {
        let new = self.surfaces.iter().find(|(old, _)| old == name);
        new.map_or_else(|| name.to_owned(), |(_, new)| new.clone())
    }

    /// Entry of `pairs` with new names. A name with the source's own model gets the new model.
    fn pair(&self, pair: &Value) -> Value {
        let own = format!("{}/", self.source.model.name);
        let rename = |name: &str| match name.strip_prefix(own.as_str()) {
            Some(surface) => format!("{}/{}", self.model, self.surface(surface)),
            None => self.surface(name),
        };
        let Value::Struct(name, fields) = pair else { return pair.clone() };
        let fields = fields.iter().map(|field| {
            let value = match (&*field.name, &field.value.value) {
                ("surfaces", names) => self.text(names, &rename),
                (_, other) => without_places(other),
            };
            field_of(&field.name, value)
        });
        Value::Struct(name.clone(), fields.collect())
    }
}

/// Returns `true` if a primitive reads a file.
fn names_a_file(value: &Value) -> bool {
    match value {
        Value::Struct(_, fields) => {
            fields.iter().any(|field| &*field.name == "file" || names_a_file(&field.value.value))
        }
        Value::Tuple(_, items) | Value::List(items) => items.iter().any(|item| names_a_file(&item.value)),
        _ => false,
    }
}

/// Value of a field of a struct.
fn field<'v>(value: &'v Value, name: &str) -> Option<&'v Value> {
    let Value::Struct(_, fields) = value else { return None };
    fields.iter().find(|field| &*field.name == name).map(|field| &field.value.value)
}

fn field_of(name: &str, value: Value) -> Field {
    Field { name: name.into(), at: 0, value: value.into() }
}

/// Value with all positions in the text 0, so that equal values of two files are equal.
fn without_places(value: &Value) -> Value {
    let plain = |node: &Node| without_places(&node.value).into();
    match value {
        Value::Struct(name, fields) => {
            let fields = fields.iter().map(|field| field_of(&field.name, without_places(&field.value.value)));
            Value::Struct(name.clone(), fields.collect())
        }
        Value::Tuple(name, items) => Value::Tuple(name.clone(), items.iter().map(plain).collect()),
        Value::List(items) => Value::List(items.iter().map(plain).collect()),
        Value::Map(entries) => {
            Value::Map(entries.iter().map(|(key, value)| (plain(key), plain(value))).collect())
        }
        other => other.clone(),
    }
}
