//! Lines and words of text files, and faults of mesh files.

use std::borrow::Cow;
use std::fmt;

/// Fault of a mesh file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FormatFault {
    /// Line in a text file, from 1; 0 for a binary file.
    pub line: usize,
    /// Name of the rule, as listed in docs/importing.md.
    pub rule: &'static str,
    pub cause: String,
    pub cure: &'static str,
}

impl FormatFault {
    pub(super) fn damaged(line: usize, cause: String) -> Self {
        Self { line, rule: "damaged", cause, cure: "export it again" }
    }
}

impl fmt::Display for FormatFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => f.write_str(&self.cause),
            line => write!(f, "line {line}: {}", self.cause),
        }
    }
}

/// Decodes a name or word as UTF-8, else as Latin-1.
pub(super) fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

/// Decodes a text file as UTF-8, else as Latin-1.
///
/// # Errors
/// Text in UTF-16.
pub fn text(bytes: &[u8]) -> Result<Cow<'_, str>, FormatFault> {
    marked(bytes).map(decoded)
}

/// Quotes a word for messages, shortened if it is long.
pub(super) fn quoted(bytes: &[u8]) -> String {
    const SHOWN: usize = 40;
    match bytes.len() {
        0..=SHOWN => format!("`{}`", decoded(bytes)),
        _ => format!("`{}…`", decoded(&bytes[..SHOWN])),
    }
}

/// Removes the byte order mark that some editors put before UTF-8; a fault for text in UTF-16.
pub(super) fn marked(bytes: &[u8]) -> Result<&[u8], FormatFault> {
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        let cause = "it is text in UTF-16".to_owned();
        return Err(FormatFault { cure: "save it as UTF-8 or ASCII", ..FormatFault::damaged(1, cause) });
    }
    Ok(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes))
}

/// Lines with their numbers; they end with a line feed, a carriage return, or both.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut rest = Some(bytes);
    let next = move || {
        let text = rest?;
        let Some(end) = text.iter().position(|byte| matches!(byte, b'\n' | b'\r')) else {
            rest = None;
            return Some(text);
        };
        let both = text[end..].starts_with(b"\r\n");
        rest = Some(&text[end + 1 + usize::from(both)..]);
        Some(&text[..end])
    };
    std::iter::from_fn(next).zip(1..).map(|(line, number)| (number, line))
}

pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(|byte| byte.is_ascii_whitespace()).filter(|word| !word.is_empty())
}
