//! One field of a table.

/// One field of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name.
    pub name: &'static str,
    /// NumPy's name of one number of it.
    pub kind: &'static str,
    /// How many numbers it is; 0 for one that is no array.
    pub count: usize,
    /// Bytes.
    pub size: usize,
}
