//! The last message of each thread.

use std::cell::RefCell;
use std::ffi::c_char;

thread_local! {
    /// Ends with a zero byte once anything was said. Its memory stays, so that a success allocates nothing.
    static LAST: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Forgets what was said.
pub(crate) fn clear() {
    // A thread that is ending has no message any more; that is no reason to fail.
    let _ = LAST.try_with(|last| last.borrow_mut().clear());
}

/// Says something.
pub(crate) fn set(text: &str) {
    let _ = LAST.try_with(|last| {
        let mut last = last.borrow_mut();
        last.clear();
        // A zero byte would end the text early.
        last.extend(text.bytes().map(|byte| if byte == 0 { b'?' } else { byte }));
        last.push(0);
    });
}

/// What was said, as C reads it.
pub(crate) fn pointer() -> *const c_char {
    let said = LAST.try_with(|last| match last.borrow().as_slice() {
        [] => c"".as_ptr(),
        text => text.as_ptr().cast(),
    });
    said.unwrap_or(c"".as_ptr())
}
