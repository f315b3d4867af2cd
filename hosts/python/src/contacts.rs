//! Contacts as a structured NumPy array: one row per contact, written once, into the memory that NumPy shows.

use crate::arrays::{self, Matrix};
use pong_engine::{Contact, NormalTangent, World};
use pong_geometry::Vec3;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyByteArray, PyDict, PyList};

/// A field of a row: name, NumPy type, bytes.
type Field = (&'static str, &'static str, usize);

/// Fields in the order in which [`write`] writes them: integers first, in a number that keeps the following
/// fields aligned.
const FIELDS: [Field; 26] = [
    ("pair", "u4", 4),
    ("interface_a", "u4", 4),
    ("interface_b", "u4", 4),
    ("primitive_a", "u4", 4),
    ("primitive_b", "u4", 4),
    ("element_a", "u4", 4),
    ("element_b", "u4", 4),
    ("feature_kind", "u4", 4),
    ("feature_index", "u4", 4),
    ("end", "u4", 4),
    ("sticks", "u4", 4),
    ("contact", "u4", 4),
    ("point", "3f8", 24),
    ("normal", "3f8", 24),
    ("depth", "f8", 8),
    ("depth_rate", "f8", 8),
    ("weight", "f8", 8),
    ("normal_force", "f8", 8),
    ("friction_force", "3f8", 24),
    ("force", "3f8", 24),
    ("slip_velocity", "3f8", 24),
    ("arm_a", "3f8", 24),
    ("arm_b", "3f8", 24),
    ("stored", "f8", 8),
    ("work", "f8", 8),
    ("dissipated", "f8", 8),
];

const ROW: usize = {
    let (mut sum, mut index) = (0, 0);
    while index < FIELDS.len() {
        sum += FIELDS[index].2;
        index += 1;
    }
    sum
};

/// NumPy's type of a row.
pub(crate) fn dtype(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    static DTYPE: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let made = DTYPE.get_or_try_init(py, || {
        let [names, formats, offsets] = [PyList::empty(py), PyList::empty(py), PyList::empty(py)];
        let mut at = 0;
        for (name, format, bytes) in FIELDS {
            names.append(name)?;
            formats.append(format)?;
            offsets.append(at)?;
            at += bytes;
        }
        let fields = PyDict::new(py);
        fields.set_item("names", names)?;
        fields.set_item("formats", formats)?;
        fields.set_item("offsets", offsets)?;
        fields.set_item("itemsize", ROW)?;
        Ok::<_, PyErr>(py.import("numpy")?.call_method1("dtype", (fields,))?.unbind())
    })?;
    Ok(made.bind(py).clone())
}

/// The contacts of the last frame of a world.
pub(crate) fn array<'py>(py: Python<'py>, world: &World) -> PyResult<Bound<'py, PyAny>> {
    static FROM_BUFFER: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
    let from_buffer = FROM_BUFFER.import(py, "numpy", "frombuffer")?;
    let bytes = PyByteArray::new_with(py, world.contact_count() * ROW, |bytes| {
        for (index, (contact, row)) in world.contacts_iter().zip(bytes.chunks_exact_mut(ROW)).enumerate() {
            write(index, &contact, row);
        }
        Ok(())
    })?;
    from_buffer.call1((bytes, dtype(py)?))
}

/// Cursor over the bytes of a row.
struct Writer<'a>(&'a mut [u8]);

impl Writer<'_> {
    fn put<const N: usize>(&mut self, bytes: [u8; N]) {
        let (place, rest) = std::mem::take(&mut self.0).split_at_mut(N);
        place.copy_from_slice(&bytes);
        self.0 = rest;
    }

    fn counts(&mut self, counts: &[u32]) {
        counts.iter().for_each(|count| self.put(count.to_ne_bytes()));
    }

    fn numbers(&mut self, numbers: &[f64]) {
        numbers.iter().for_each(|number| self.put(number.to_ne_bytes()));
    }

    fn vector(&mut self, vector: &Vec3) {
        self.numbers(vector.as_slice());
    }
}

fn write(index: usize, contact: &Contact, row: &mut [u8]) {
    let Contact { a, b, .. } = contact;
    let mut to = Writer(row);
    to.counts(&[contact.pair.index() as u32, a.interface.index() as u32, b.interface.index() as u32]);
    to.counts(&[a.primitive, b.primitive, a.element, b.element]);
    to.counts(&[contact.feature.kind() as u32, contact.feature.index() as u32, contact.end]);
    to.counts(&[u32::from(contact.sticks), index as u32]);
    to.vector(&contact.point);
    to.vector(&contact.normal);
    to.numbers(&[contact.depth, contact.depth_rate, contact.weight, contact.normal_force]);
    for vector in [contact.friction_force, contact.force, contact.slip_velocity, a.arm, b.arm] {
        to.vector(&vector);
    }
    to.numbers(&[contact.stored, contact.work, contact.dissipated]);
}

/// Stiffness (N/m) and damping (N·s/m) of each contact along its normal; NaN for a normal law of the host.
pub(crate) fn stiffness<'py>(py: Python<'py>, world: &World) -> PyResult<Matrix<'py>> {
    let row = |tangent: Option<NormalTangent>| tangent.map_or([f64::NAN; 2], |t| [t.stiffness, t.damping]);
    let rows: Vec<[f64; 2]> = world.normal_tangents().map(row).collect();
    arrays::fill(py, None, rows.len(), |index| Ok(rows[index]))
}
