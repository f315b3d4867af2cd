//! Marks: the content of `extras.pong` of glTF nodes and scenes. The names are those of the modelling
//! toolkit.

use crate::findings::Findings;
use serde_json::{Map, Value};

/// Newest supported version of marks.
const VERSION: u64 = 1;

const ROLES: [&str; 4] = ["none", "root", "group", "primitive"];
const BOUNDS: [&str; 3] = ["Aabb", "Sphere", "Obb"];
const CONTACTS: [&str; 3] = ["Default", "Solid", "Marked"];

/// Contact of a root whose shapes become solids if they can.
const AUTOMATIC: &str = "Automatic";

/// Kinds of primitives, in the order of the format.
pub(crate) fn kinds() -> Vec<&'static str> {
    pong_model::schema::names(pong_model::schema::PRIMITIVES)
}

/// Mark of one node; lengths in units of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Mark {
    pub(crate) role: String,
    /// Empty for the node's name.
    pub(crate) name: String,
    /// Empty for the surface of the group above.
    pub(crate) surface: String,
    /// Position among siblings, from 1; 0 for last, sorted by name.
    pub(crate) order: u64,
    pub(crate) movable: bool,
    /// Name as in model files, or `Custom:` and the name of a registered kind; empty for the default.
    pub(crate) bound: String,
    /// `Solid` or `Marked`; `None` for the contact of the group above.
    pub(crate) contact: Option<&'static str>,
    /// True for a root whose shapes become solids if they can.
    pub(crate) is_automatic: bool,
    pub(crate) kind: String,
    /// Radius before the node's scale, as are semi-axes and length.
    pub(crate) radius: f64,
    pub(crate) semi_axes: [f64; 3],
    pub(crate) length: f64,
    /// Radii of a cone or bore, at -z and at +z.
    pub(crate) radii: [f64; 2],
    /// True for each end of a bore (-z, +z) with a convex edge that makes contact.
    pub(crate) mouths: [bool; 2],
    /// Reach, independent of the scale, as is the thickness.
    pub(crate) reach: Option<f64>,
    pub(crate) response: String,
    pub(crate) thickness: Option<f64>,
    pub(crate) two_sided: bool,
    /// Name of the mesh file to write, and metres in one unit of it.
    pub(crate) file: String,
    pub(crate) file_scale: f64,
    pub(crate) custom_kind: String,
    pub(crate) parameters: Vec<f64>,
    /// Settings of the model that a root may carry.
    pub(crate) settings: Option<Value>,
    /// Name of a field that refers to faces, edges or vertices by number, if there is one.
    pub(crate) numbered: Option<&'static str>,
}

/// Settings of a whole model.
#[derive(Clone, Debug, Default)]
pub(crate) struct Settings {
    pub(crate) name: String,
    pub(crate) entry_memory: Option<bool>,
    pub(crate) surfaces: Map<String, Value>,
    pub(crate) pairs: Vec<Value>,
    pub(crate) filters: Vec<[String; 2]>,
}

/// Reads fields of an object and reports those that are wrong or unknown.
struct Fields<'a> {
    map: &'a Map<String, Value>,
    path: &'a str,
    findings: &'a mut Findings,
    /// Names of the fields read so far, which are the known ones.
    known: Vec<&'static str>,
}

impl<'a> Fields<'a> {
    fn of(map: &'a Map<String, Value>, path: &'a str, findings: &'a mut Findings) -> Self {
        Self { map, path, findings, known: vec!["version"] }
    }

    fn take<T>(&mut self, key: &'static str, what: &str, read: impl Fn(&Value) -> Option<T>) -> Option<T> {
        self.known.push(key);
        let value = self.map.get(key).filter(|value| !value.is_null())?;
        let read = read(value);
        if read.is_none() {
            let cause = format!("`{key}` of its mark is {value}, not {what}");
            self.findings.fault(self.path, "mark", cause, "correct the mark where the file was made");
        }
        read
    }

    fn text(&mut self, key: &'static str) -> String {
        self.take(key, "text", |value| value.as_str().map(str::to_owned)).unwrap_or_default()
    }

    fn word(&mut self, key: &'static str, allowed: &[&str], default: &str) -> String {
        let what = format!("one of {}", allowed.join(", "));
        let read = |value: &Value| value.as_str().filter(|word| allowed.contains(word)).map(str::to_owned);
        self.take(key, &what, read).unwrap_or_else(|| default.to_owned())
    }

    fn number(&mut self, key: &'static str) -> Option<f64> {
        self.take(key, "a number that is not negative", |value| value.as_f64().filter(|x| *x >= 0.0))
    }

    fn flag(&mut self, key: &'static str) -> Option<bool> {
        self.take(key, "true or false", flag_of)
    }

    fn radii(&mut self) -> [f64; 2] {
        let two = |value: &Value| -> Option<[f64; 2]> {
            let radii: [f64; 2] = numbers_of(value)?.try_into().ok()?;
            radii.iter().all(|radius| *radius >= 0.0).then_some(radii)
        };
        self.take("radii", "two numbers that are not negative", two).unwrap_or([0.0; 2])
    }

    fn mouths(&mut self) -> [bool; 2] {
        let two = |value: &Value| -> Option<[bool; 2]> {
            value.as_array()?.iter().map(flag_of).collect::<Option<Vec<bool>>>()?.try_into().ok()
        };
        self.take("mouths", "two of true and false", two).unwrap_or([true; 2])
    }

    fn bound(&mut self) -> String {
        let custom = self.text("custom_bound");
        let bound = self.word("bound", &BOUNDS, "");
        if custom.is_empty() { bound } else { format!("Custom:{custom}") }
    }

    /// Contact, and true for the automatic contact of a root.
    fn contact(&mut self, role: &str) -> (Option<&'static str>, bool) {
        let allowed = match role {
            "root" => [CONTACTS.as_slice(), &[AUTOMATIC]].concat(),
            _ => CONTACTS.to_vec(),
        };
        let word = self.word("contact", &allowed, "Default");
        (CONTACTS[1..].iter().copied().find(|contact| *contact == word), word == AUTOMATIC)
    }

    fn unknown(&mut self) {
        for key in self.map.keys().filter(|key| !self.known.contains(&key.as_str())) {
            let cause = format!("`{key}` of its mark is not known and counts for nothing");
            self.findings.note(self.path, "unknown-field", cause, "");
        }
    }
}

/// Boolean value; some programs store custom properties as 0 and 1.
fn flag_of(value: &Value) -> Option<bool> {
    value.as_bool().or(value.as_u64().filter(|x| *x < 2).map(|x| x == 1))
}

fn filters_of(value: &Value) -> Option<Vec<[String; 2]>> {
    let groups = |pair: &Value| {
        let [a, b] = &pair.as_array()?[..] else { return None };
        Some([a.as_str()?.to_owned(), b.as_str()?.to_owned()])
    };
    value.as_array()?.iter().map(groups).collect()
}

fn numbers_of(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(Value::as_f64).collect()
}

/// The object of `extras.pong`; some programs store it as text.
fn object<'a>(
    value: &'a Value,
    parsed: &'a mut Value,
    path: &str,
    findings: &mut Findings,
) -> Option<&'a Map<String, Value>> {
    if let Some(text) = value.as_str() {
        *parsed = serde_json::from_str(text).unwrap_or(Value::Null);
    } else {
        *parsed = value.clone();
    }
    let map = parsed.as_object();
    match map {
        None => findings.fault(path, "mark", "its `extras.pong` is no JSON object", "write it again"),
        Some(map) => {
            let version = map.get("version").and_then(Value::as_u64).unwrap_or(VERSION);
            if version > VERSION {
                let cause = format!("its mark is of version {version}; known are those up to {VERSION}");
                findings.fault(path, "mark-version", cause, "use a newer pong, or an older toolkit");
            }
        }
    }
    map
}

impl Mark {
    /// `None` for a node without a role, and after a fault.
    pub(crate) fn read(value: &Value, path: &str, findings: &mut Findings) -> Option<Self> {
        let mut parsed = Value::Null;
        let map = object(value, &mut parsed, path, findings)?;
        let before = findings.faults.len();
        let mut fields = Fields::of(map, path, findings);
        let numbers = |value: &Value| -> Option<[f64; 3]> { numbers_of(value)?.try_into().ok() };
        let role = fields.word("role", &ROLES, if map.contains_key("kind") { "primitive" } else { "none" });
        let (contact, is_automatic) = fields.contact(&role);
        let mark = Self {
            role,
            name: fields.text("name"),
            surface: fields.text("surface"),
            movable: fields.flag("movable").unwrap_or(false),
            order: fields.take("order", "a whole number", Value::as_u64).unwrap_or(0),
            bound: fields.bound(),
            contact,
            is_automatic,
            kind: fields.word("kind", &[kinds().as_slice(), &[""]].concat(), ""),
            radius: fields.number("radius").unwrap_or(0.0),
            semi_axes: fields.take("semi_axes", "three numbers", numbers).unwrap_or([0.0; 3]),
            length: fields.number("length").unwrap_or(0.0),
            radii: fields.radii(),
            mouths: fields.mouths(),
            reach: fields.number("reach"),
            response: fields.word("response", &["Normal", "Axial"], "Normal"),
            thickness: fields.number("thickness"),
            two_sided: fields.flag("two_sided").unwrap_or(false),
            file: fields.text("file"),
            file_scale: fields.number("file_scale").filter(|scale| *scale > 0.0).unwrap_or(1.0),
            custom_kind: fields.text("custom_kind"),
            parameters: fields.take("parameters", "a list of numbers", numbers_of).unwrap_or_default(),
            settings: map.get("settings").filter(|settings| settings.is_object()).cloned(),
            numbered: ["inactive_faces", "parts"]
                .into_iter()
                .find(|key| map.get(*key).and_then(Value::as_array).is_some_and(|list| !list.is_empty())),
        };
        fields.known.extend(["settings", "inactive_faces", "parts"]);
        fields.unknown();
        (mark.role != "none" && findings.faults.len() == before).then_some(mark)
    }
}

impl Settings {
    pub(crate) fn read(value: &Value, path: &str, findings: &mut Findings) -> Self {
        let mut parsed = Value::Null;
        let Some(map) = object(value, &mut parsed, path, findings) else { return Self::default() };
        let mut fields = Fields::of(map, path, findings);
        let settings = Self {
            name: fields.text("name"),
            entry_memory: fields.flag("entry_memory"),
            surfaces: fields
                .take("surfaces", "an object", |value| value.as_object().cloned())
                .unwrap_or_default(),
            pairs: fields.take("pairs", "a list", |value| value.as_array().cloned()).unwrap_or_default(),
            filters: fields.take("filters", "a list of two groups each", filters_of).unwrap_or_default(),
        };
        fields.unknown();
        settings
    }
}
