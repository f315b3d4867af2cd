//! Text safe for a terminal, a log or a dialog, whatever names a file or a host uses.

use std::borrow::Cow;
use std::fmt::Write as _;

/// Returns `true` for a character that controls a display instead of being shown: a control character (ESC
/// begins the sequences that recolour, move and rename a terminal), a line separator, or a change of writing
/// direction, which shows text in another order than it is stored.
fn steers(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{2028}' | '\u{2029}' | '\u{61c}' | '\u{200e}' | '\u{200f}')
        || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

fn escaped(text: &str, stays: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.chars().any(|c| steers(c) && !stays(c)) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        match c {
            c if !steers(c) || stays(c) => out.push(c),
            '\n' | '\r' | '\t' => out.extend(c.escape_default()),
            c => {
                let _ = write!(out, "\\u{{{:x}}}", u32::from(c));
            }
        }
    }
    Cow::Owned(out)
}

/// Text on one line, in which every character that controls a display is escaped: `\n`, `\u{1b}`. Text
/// without such characters is returned unchanged.
///
/// ```
/// assert_eq!(pong_model::printable("arm/tip"), "arm/tip");
/// assert_eq!(pong_model::printable("tip\x1b[2J\nerror"), r"tip\u{1b}[2J\nerror");
/// ```
pub fn printable(text: &str) -> Cow<'_, str> {
    escaped(text, |_| false)
}

/// [`printable`] for a text of several lines, which keeps its line breaks. Names in it must be made
/// [`printable`] before, or they could add lines of their own.
pub fn printable_lines(text: &str) -> Cow<'_, str> {
    escaped(text, |c| c == '\n')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_steers_a_display_is_left() {
        for c in (0..=0x10_ffff).filter_map(char::from_u32) {
            let name = format!("a{c}b");
            let shown = printable(&name);
            assert!(!shown.chars().any(char::is_control), "{:x}", u32::from(c));
            assert_eq!(shown == name, !steers(c), "{:x}", u32::from(c));
        }
        // A change of writing direction would show `nor.exe` as `exe.ron`.
        assert_eq!(printable("a\u{202e}nor.b"), r"a\u{202e}nor.b");
        assert_eq!(printable("µ–δ é 漢字 👍"), "µ–δ é 漢字 👍");
    }

    #[test]
    fn lines_stay_lines_only_where_asked() {
        assert_eq!(printable("a\nb\r\tc"), r"a\nb\r\tc");
        assert_eq!(printable_lines("a\nb\u{7}"), "a\nb\\u{7}");
    }
}
