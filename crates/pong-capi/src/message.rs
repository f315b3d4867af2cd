//! The last message of each thread.

use pong_model::printable_lines;
use std::cell::{Cell, RefCell};
use std::ffi::c_char;
use std::fmt;
use std::io::Write as _;

/// Size of the fixed message buffer, with the zero byte at its end. Every message of a frame fits.
const SHORT: usize = 512;

/// Buffer that holds the last message.
#[derive(Clone, Copy)]
enum Last {
    Nothing,
    Short,
    Long,
}

thread_local! {
    // Neither of these two needs a destructor at the end of a thread. Therefore a thread's first call of the
    // library allocates nothing if it succeeds, because it then uses these two alone.
    static LAST: Cell<Last> = const { Cell::new(Last::Nothing) };
    static SHORT_TEXT: RefCell<[u8; SHORT]> = const { RefCell::new([0; SHORT]) };
    static LONG_TEXT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Clears the message.
pub(crate) fn clear() {
    LAST.set(Last::Nothing);
}

/// Sets the message. Hosts print it, so control characters in names are escaped.
pub(crate) fn set(text: &str) {
    let text = &*printable_lines(text);
    if text.len() < SHORT {
        SHORT_TEXT.with_borrow_mut(|short| {
            for (place, byte) in short.iter_mut().zip(as_c(text)) {
                *place = byte;
            }
        });
        LAST.set(Last::Short);
        return;
    }
    // A thread that is ending has no long message any more; that is not an error.
    let kept = LONG_TEXT.try_with(|long| {
        let mut long = long.borrow_mut();
        long.clear();
        long.extend(as_c(text));
    });
    LAST.set(if kept.is_ok() { Last::Long } else { Last::Nothing });
}

/// Sets the message in the fixed buffer; the excess is cut off.
pub(crate) fn set_short(text: fmt::Arguments<'_>) {
    SHORT_TEXT.with_borrow_mut(|short| {
        let mut room = &mut short[..SHORT - 1];
        // An error means that the text was cut off.
        let _ = room.write_fmt(text);
        let length = SHORT - 1 - room.len();
        short[length] = 0;
    });
    LAST.set(Last::Short);
}

/// Bytes of the text, with a zero at the end and none before it, which would end the text early.
fn as_c(text: &str) -> impl Iterator<Item = u8> {
    text.bytes().map(|byte| if byte == 0 { b'?' } else { byte }).chain([0])
}

/// The message as a C string.
pub(crate) fn pointer() -> *const c_char {
    let nothing = c"".as_ptr();
    match LAST.get() {
        Last::Nothing => nothing,
        Last::Short => SHORT_TEXT.with_borrow(|short| short.as_ptr().cast()),
        Last::Long => LONG_TEXT.try_with(|long| long.borrow().as_ptr().cast()).unwrap_or(nothing),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ffi::CStr;

    #[test]
    fn a_text_of_any_length_comes_back_whole() {
        for len in [0, 1, SHORT - 2, SHORT - 1, SHORT, SHORT + 1, 10 * SHORT, 3] {
            let text = "x".repeat(len);
            set(&text);
            // SAFETY: the text ends with a zero byte and lives until the next one is set.
            assert_eq!(unsafe { CStr::from_ptr(pointer()) }.to_str(), Ok(text.as_str()), "{len} bytes");
        }
        clear();
        // SAFETY: as above.
        assert!(unsafe { CStr::from_ptr(pointer()) }.is_empty());
    }
}
