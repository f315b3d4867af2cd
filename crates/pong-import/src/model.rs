//! A model as a model file has it (docs/model_format.md), ready to be written.

use nalgebra::Vector3;

/// A whole model.
#[derive(Clone, Debug, Default)]
pub(crate) struct Model {
    /// Lines of the comment at the head of the file.
    pub(crate) comment: Vec<String>,
    pub(crate) name: String,
    pub(crate) entry_memory: bool,
    /// Name and fields of each surface.
    pub(crate) surfaces: Vec<(String, Record)>,
    pub(crate) pairs: Vec<Record>,
    pub(crate) root: Group,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Group {
    pub(crate) name: String,
    pub(crate) movable: bool,
    pub(crate) position: Option<[f64; 3]>,
    pub(crate) orientation: Option<[f64; 4]>,
    /// `None` for `Aabb`, the default.
    pub(crate) bound: Option<String>,
    pub(crate) surface: Option<String>,
    pub(crate) groups: Vec<Group>,
    pub(crate) primitives: Vec<Primitive>,
}

#[derive(Clone, Debug)]
pub(crate) struct Primitive {
    pub(crate) kind: &'static str,
    pub(crate) name: String,
    pub(crate) surface: Option<String>,
    /// In the order of the format's tables; fields at their defaults are left out.
    pub(crate) fields: Record,
}

/// Fields in the order they are written.
pub(crate) type Record = Vec<(String, Field)>;

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Field {
    Number(f64),
    Text(String),
    /// Written as it stands: `true`, `Axial`, `None`.
    Word(String),
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
    pub(crate) fn is_empty(&self) -> bool {
        self.groups.is_empty() && self.primitives.is_empty()
    }

    /// Calls `see` with every primitive below.
    pub(crate) fn each_primitive(&mut self, see: &mut impl FnMut(&mut Primitive)) {
        self.primitives.iter_mut().for_each(&mut *see);
        self.groups.iter_mut().for_each(|group| group.each_primitive(see));
    }
}

pub(crate) fn place(v: &Vector3<f64>) -> Field {
    Field::Tuple(vec![v.x, v.y, v.z])
}

pub(crate) fn field(name: &str, value: Field) -> (String, Field) {
    (name.to_owned(), value)
}
