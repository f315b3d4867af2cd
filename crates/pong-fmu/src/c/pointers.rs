//! Pointers of the importer, as slices and references. NULL is refused.

use crate::refusal::Refusal;
use std::borrow::Cow;
use std::ffi::{CStr, c_char};

fn null(what: &str) -> Refusal {
    Refusal::error(format!("{what}: the pointer is NULL; give the address of a variable or an array"))
}

/// # Safety
/// As all functions of this module (`c/mod.rs`).
pub(super) unsafe fn slice<'a, T>(pointer: *const T, length: usize, what: &str) -> Result<&'a [T], Refusal> {
    match (length, pointer.is_null()) {
        (0, _) => Ok(&[]),
        (_, true) => Err(null(what)),
        // SAFETY: the importer vouches for the number of elements.
        _ => Ok(unsafe { std::slice::from_raw_parts(pointer, length) }),
    }
}

/// # Safety
/// As all functions of this module (`c/mod.rs`).
pub(super) unsafe fn slice_mut<'a, T>(
    pointer: *mut T,
    length: usize,
    what: &str,
) -> Result<&'a mut [T], Refusal> {
    match (length, pointer.is_null()) {
        (0, _) => Ok(&mut []),
        (_, true) => Err(null(what)),
        // SAFETY: the importer vouches for the number of elements, and nothing else uses them during the
        // call.
        _ => Ok(unsafe { std::slice::from_raw_parts_mut(pointer, length) }),
    }
}

/// Writes the value of each reference.
///
/// # Safety
/// As all functions of this module (`c/mod.rs`).
pub(super) unsafe fn read<T>(
    references: *const u32,
    count: usize,
    values: *mut T,
    mut value: impl FnMut(u32) -> Result<T, Refusal>,
) -> Result<(), Refusal> {
    // SAFETY: by the contract of this function.
    let references = unsafe { slice(references, count, "value references")? };
    // SAFETY: by the contract of this function.
    let values = unsafe { slice_mut(values, count, "values")? };
    references.iter().zip(values).try_for_each(|(reference, place)| {
        *place = value(*reference)?;
        Ok(())
    })
}

/// # Safety
/// As all functions of this module (`c/mod.rs`).
pub(super) unsafe fn place<'a, T>(pointer: *mut T, what: &str) -> Result<&'a mut T, Refusal> {
    // SAFETY: NULL, or the address of a variable of the importer's.
    unsafe { pointer.as_mut() }.ok_or_else(|| null(what))
}

/// # Safety
/// As all functions of this module (`c/mod.rs`).
pub(super) unsafe fn text<'a>(pointer: *const c_char) -> Option<Cow<'a, str>> {
    // SAFETY: NULL, or a text with a zero byte at its end.
    (!pointer.is_null()).then(|| unsafe { CStr::from_ptr(pointer) }.to_string_lossy())
}
