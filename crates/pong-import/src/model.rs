//! A model as in a model file (docs/model_format.md), ready to be written.

use nalgebra::Vector3;

/// A whole model.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Lines of the comment at the head of the file.
    pub comment: Vec<String>,
    pub name: String,
    pub entry_memory: bool,
    /// Name and fields of each surface.
    pub surfaces: Vec<(String, Record)>,
    pub pairs: Vec<Record>,
    /// Groups that never touch each other.
    pub filters: Vec<[String; 2]>,
    pub root: Group,
}

#[derive(Clone, Debug, Default)]
pub struct Group {
    pub name: String,
    pub movable: bool,
    /// Origin in the parent group, m.
    pub position: Option<[f64; 3]>,
    /// Unit quaternion (w, x, y, z), from the group's axes to those of the parent.
    pub orientation: Option<[f64; 4]>,
    /// `None` for the default of the format; `Custom:` and the name of a registered kind.
    pub bound: Option<String>,
    pub surface: Option<String>,
    /// `Solid` or `Marked`; `None` for the contact of the parent group.
    pub contact: Option<&'static str>,
    pub groups: Vec<Group>,
    pub primitives: Vec<Primitive>,
}

#[derive(Clone, Debug)]
pub struct Primitive {
    pub kind: &'static str,
    pub name: String,
    pub surface: Option<String>,
    /// In the order of the format's tables; fields at their defaults are left out.
    pub fields: Record,
}

/// Fields in the order of writing.
pub type Record = Vec<(String, Field)>;

#[derive(Clone, Debug, PartialEq)]
pub enum Field {
    Number(f64),
    Text(String),
    /// Text written unquoted: `true`, `Axial`, `None`.
    Word(String),
    /// `(true, false)`.
    Flags(Vec<bool>),
    /// `(1.0, 2.0)`.
    Tuple(Vec<f64>),
    Texts(Vec<String>),
    Tuples(Vec<Vector3<f64>>),
    Numbers(Vec<f64>),
    /// `(stiffness: 1.0)`, after a name if there is one: `Linear(damping: 1.0)`.
    Record(String, Record),
    Vertices(Vec<Vector3<f64>>),
    Triangles(Vec<[u32; 3]>),
    Faces(Vec<Vec<u32>>),
    Indices(Vec<usize>),
}

impl Group {
    pub fn is_empty(&self) -> bool {
        self.groups.is_empty() && self.primitives.is_empty()
    }

    /// Calls `see` with every primitive below.
    pub fn each_primitive(&mut self, see: &mut impl FnMut(&mut Primitive)) {
        self.primitives.iter_mut().for_each(&mut *see);
        self.groups.iter_mut().for_each(|group| group.each_primitive(see));
    }
}

pub fn place(v: &Vector3<f64>) -> Field {
    Field::Tuple(vec![v.x, v.y, v.z])
}

pub fn field(name: &str, value: Field) -> (String, Field) {
    (name.to_owned(), value)
}

/// Value of a field; `None` if it is missing.
pub fn value_of<'a>(record: &'a [(String, Field)], name: &str) -> Option<&'a Field> {
    record.iter().find(|(key, _)| key == name).map(|(_, value)| value)
}
