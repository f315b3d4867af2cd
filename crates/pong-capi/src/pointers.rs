//! Pointers from C: NULL, alignment, lengths and overlap are checked.

use crate::failure::{Failure, Outcome};
use crate::status::pong_status;
use std::ffi::{CStr, c_char};
use std::ops::Range;
use std::ptr::NonNull;

fn null(name: &str) -> Failure {
    Failure::new(pong_status::NullArgument, format!("`{name}` is NULL; pass a pointer to a variable"))
}

fn check<T>(pointer: *const T, name: &str) -> Outcome {
    if pointer.is_null() {
        return Err(null(name));
    }
    if !pointer.is_aligned() {
        let message =
            format!("`{name}` is not aligned to {} bytes; pass a variable of its type", align_of::<T>());
        return Err(Failure::new(pong_status::BadValue, message));
    }
    Ok(())
}

/// Destination of one result, or none if the caller passed NULL.
pub(crate) struct Out<T>(Option<NonNull<T>>);

impl<T> Out<T> {
    /// # Safety
    /// `pointer` is NULL or may be written for as long as the `Out` lives.
    pub unsafe fn new(pointer: *mut T, name: &str) -> Outcome<Self> {
        check(pointer, name)?;
        Ok(Self(NonNull::new(pointer)))
    }

    /// As [`new`](Self::new), but NULL is allowed and discards the result.
    ///
    /// # Safety
    /// As [`new`](Self::new).
    pub unsafe fn optional(pointer: *mut T, name: &str) -> Outcome<Self> {
        if pointer.is_null() { Ok(Self(None)) } else { Self::new(pointer, name) }
    }

    /// Writes the result.
    pub fn set(&self, value: T) {
        if let Some(pointer) = self.0 {
            // SAFETY: `new` has checked the pointer; the rest is its contract.
            unsafe { pointer.write(value) };
        }
    }
}

/// Destination of several results.
pub(crate) struct OutArray<T> {
    pointer: *mut T,
    len: usize,
}

impl<T> OutArray<T> {
    /// # Safety
    /// `pointer` may be NULL if `len` is 0; else `len` elements may be written for as long as this lives.
    pub unsafe fn new(pointer: *mut T, len: usize, name: &str) -> Outcome<Self> {
        if len > 0 {
            check(pointer, name)?;
            check_len::<T>(len, name)?;
        }
        Ok(Self { pointer, len })
    }

    /// Number of elements that fit.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Writes one element; one beyond the end is dropped.
    pub fn set(&mut self, index: usize, value: T) {
        if index < self.len {
            // SAFETY: `new` has checked the pointer, the index is inside.
            unsafe { self.pointer.add(index).write(value) }
        }
    }
}

impl OutArray<u8> {
    /// The bytes, set to zero first: the caller's buffer may never have been written.
    pub fn zeroed(&mut self) -> &mut [u8] {
        if self.len == 0 {
            return &mut [];
        }
        // SAFETY: `new` has checked the pointer; nothing else refers to the caller's buffer during the call.
        unsafe {
            self.pointer.write_bytes(0, self.len);
            std::slice::from_raw_parts_mut(self.pointer, self.len)
        }
    }
}

/// Returns an array that is only read.
///
/// # Safety
/// `pointer` may be NULL if `len` is 0; else `len` elements can be read and do not change for `'a`.
pub(crate) unsafe fn array<'a, T>(pointer: *const T, len: usize, name: &str) -> Outcome<&'a [T]> {
    if len == 0 {
        return Ok(&[]);
    }
    check(pointer, name)?;
    check_len::<T>(len, name)?;
    // SAFETY: checked above; the rest is the contract of this function.
    Ok(unsafe { std::slice::from_raw_parts(pointer, len) })
}

/// Returns a value that is only read.
///
/// # Safety
/// `pointer` is NULL or can be read and does not change for `'a`.
pub(crate) unsafe fn one<'a, T>(pointer: *const T, name: &str) -> Outcome<&'a T> {
    check(pointer, name)?;
    // SAFETY: checked above; the rest is the contract of this function.
    Ok(unsafe { &*pointer })
}

/// Refuses two arrays that overlap, of which at least one is written, because writing one would change the
/// other while it is in use. Each is given by its name, address and number of elements.
pub(crate) fn apart<T, U>(a: (&str, *const T, usize), b: (&str, *const U, usize)) -> Outcome {
    let [a_bytes, b_bytes] = [bytes(a.1, a.2), bytes(b.1, b.2)];
    if a_bytes.start < b_bytes.end && b_bytes.start < a_bytes.end {
        let message = format!("`{}` and `{}` share memory; give each memory of its own", a.0, b.0);
        return Err(Failure::new(pong_status::BadValue, message));
    }
    Ok(())
}

fn bytes<T>(pointer: *const T, len: usize) -> Range<usize> {
    let start = pointer.addr();
    start..start.saturating_add(len.saturating_mul(size_of::<T>()))
}

/// Returns UTF-8 text that ends with a zero byte.
///
/// # Safety
/// `pointer` is NULL or the text can be read and does not change for `'a`.
pub(crate) unsafe fn text<'a>(pointer: *const c_char, name: &str) -> Outcome<&'a str> {
    if pointer.is_null() {
        return Err(Failure::new(pong_status::NullArgument, format!("`{name}` is NULL; pass a string")));
    }
    // SAFETY: not NULL; the rest is the contract of this function.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map_err(|_| {
        Failure::new(pong_status::BadValue, format!("`{name}` is not UTF-8; encode it as UTF-8"))
    })
}

fn check_len<T>(len: usize, name: &str) -> Outcome {
    match len.checked_mul(size_of::<T>()) {
        Some(bytes) if bytes <= isize::MAX as usize => Ok(()),
        _ => Err(Failure::new(
            pong_status::BadValue,
            format!("`{name}` cannot have {len} elements; give its true length"),
        )),
    }
}
