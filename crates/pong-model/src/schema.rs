//! Kinds and fields of model files, as data: names, types, units and defaults, in the order in which files are
//! written. The reader, the writer, the Python package and the tests of docs/model_format.md go by these tables.

mod fields;
mod kinds;
mod types;

pub use fields::{CONTACTS, FILTERS, GROUP, MODEL, PAIR, POSE, PRIMITIVE, SURFACE};
pub use kinds::{BOUNDS, FRICTION_LAWS, Friction, NORMAL_LAWS, Normal, PRIMITIVES, Shape};
pub use types::{Field, FieldDefault, Kind, Type};

/// Field of that name, wherever it stands in a file: a name has one type, except for `stiffness`, `damping`
/// and `restitution`, whose types are written in the same way. `None` if no struct has such a field.
pub fn field(name: &str) -> Option<&'static Field> {
    let of_kinds = PRIMITIVES.iter().map(|kind| kind.fields);
    let of_laws = NORMAL_LAWS.iter().map(|law| law.fields).chain(FRICTION_LAWS.iter().map(|law| law.fields));
    let structs = [MODEL, SURFACE, PAIR, GROUP, POSE, PRIMITIVE];
    let mut all = structs.into_iter().chain(of_kinds).chain(of_laws).flatten();
    all.find(|field| field.name == name)
}

/// Names of kinds, in the order of the table.
pub fn names<T>(kinds: &'static [Kind<T>]) -> Vec<&'static str> {
    kinds.iter().map(|kind| kind.name).collect()
}
