//! One field of a table.

/// One field of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name.
    pub name: &'static str,
    /// NumPy's name of its number type.
    pub kind: &'static str,
    /// Length of its array; 0 for a single number.
    pub count: usize,
    /// Size, bytes.
    pub size: usize,
}
