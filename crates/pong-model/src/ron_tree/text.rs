//! Strings and characters.

use super::parser::{Parsed, Parser};

impl Parser<'_> {
    pub(super) fn at_raw_string(&self) -> bool {
        let after = self.rest()[1..].trim_start_matches('#');
        after.starts_with('"')
    }

    pub(super) fn at_bytes(&self) -> bool {
        let rest = self.rest();
        rest.starts_with("b\"")
            || rest.starts_with("b'")
            || rest.starts_with("br\"")
            || rest.starts_with("br#")
    }

    pub(super) fn raw_string(&mut self) -> Parsed<String> {
        let start = self.position;
        let rest = &self.rest()[1..];
        let hashes = rest.len() - rest.trim_start_matches('#').len();
        let close = format!("\"{}", "#".repeat(hashes));
        let body = &rest[hashes + 1..];
        let Some(length) = body.find(&close) else {
            return Err(self.error_at(start, "syntax", "this raw text is never closed"));
        };
        let text = body[..length].to_owned();
        self.position += 1 + hashes + 1 + length + close.len();
        Ok(text)
    }

    pub(super) fn string(&mut self) -> Parsed<String> {
        let start = self.position;
        self.position += 1;
        let mut text = String::new();
        loop {
            let rest = self.rest();
            let Some(length) = rest.find(['"', '\\']) else {
                return Err(self.error_at(start, "syntax", "this text is never closed"));
            };
            text.push_str(&rest[..length]);
            self.position += length + 1;
            if self.text.as_bytes()[self.position - 1] == b'"' {
                return Ok(text);
            }
            if let Some(c) = self.escape()? {
                text.push(c);
            }
        }
    }

    pub(super) fn character(&mut self) -> Parsed<String> {
        let start = self.position;
        self.position += 1;
        let unclosed = self.error_at(start, "syntax", "this is not one character between quotes");
        let c = if self.take("\\") {
            self.escape()?
        } else {
            let c = self.peek().filter(|&c| c != '\'');
            self.position += c.map_or(0, char::len_utf8);
            c
        };
        match c {
            Some(c) if self.take("'") => Ok(c.to_string()),
            _ => Err(unclosed),
        }
    }

    /// Reads the part after a backslash; a line break swallows the white space after it.
    fn escape(&mut self) -> Parsed<Option<char>> {
        let at = self.position - 1;
        let Some(kind) = self.peek() else {
            return Err(self.error_at(at, "syntax", "the file ends within an escape"));
        };
        self.position += kind.len_utf8();
        Ok(Some(match kind {
            '\\' | '"' | '\'' => kind,
            'n' => '\n',
            'r' => '\r',
            't' => '\t',
            '0' => '\0',
            'x' => self.hex_escape(at, 2)?,
            'u' => self.unicode_escape(at)?,
            '\n' | '\r' => {
                let rest = self.rest();
                self.position += rest.len() - rest.trim_start_matches([' ', '\t', '\n', '\r']).len();
                return Ok(None);
            }
            other => return Err(self.error_at(at, "syntax", format!("unknown escape `\\{other}`"))),
        }))
    }

    fn hex_escape(&mut self, at: usize, digits: usize) -> Parsed<char> {
        let code = self.rest().get(..digits).filter(|d| d.bytes().all(|b| b.is_ascii_hexdigit()));
        let code = code.and_then(|d| u32::from_str_radix(d, 16).ok()).and_then(char::from_u32);
        self.position = (self.position + digits).min(self.text.len());
        code.ok_or_else(|| self.error_at(at, "syntax", "not a hexadecimal character code"))
    }

    fn unicode_escape(&mut self, at: usize) -> Parsed<char> {
        let bad = self.error_at(at, "syntax", "not a character code like `\\u{3bc}`");
        if !self.take("{") {
            return Err(bad);
        }
        let length = self.rest().find('}').filter(|&length| (1..=6).contains(&length));
        let Some(length) = length else { return Err(bad) };
        let c = u32::from_str_radix(&self.rest()[..length], 16).ok().and_then(char::from_u32);
        self.position += length + 1;
        c.ok_or(bad)
    }
}
