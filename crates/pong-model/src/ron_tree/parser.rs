//! Recursive descent over the bytes of the text.

use super::number::number;
use super::{Field, Node, Rows, SyntaxError, Value};

/// Maximum nesting depth of values; the `ron` crate's default.
const DEPTH_LIMIT: u32 = 128;
/// Names allowed in `#![enable(…)]`; none changes how a model file is read.
const KNOWN_EXTENSIONS: [&str; 4] =
    ["implicit_some", "unwrap_newtypes", "unwrap_variant_newtypes", "explicit_struct_names"];

pub(super) type Parsed<T> = Result<T, SyntaxError>;

pub(super) struct Parser<'a> {
    pub(super) text: &'a str,
    pub(super) position: usize,
    depth: u32,
}

/// Reads one RON document.
pub(crate) fn parse(text: &str) -> Parsed<Node> {
    let mut parser = Parser { text, position: 0, depth: 0 };
    if text.len() >= u32::MAX as usize {
        return Err(parser.error("text-too-long", "the file is longer than 4 GiB"));
    }
    parser.skip_blank()?;
    while parser.take("#![") {
        parser.enable_attribute()?;
    }
    let node = parser.value()?;
    parser.skip_blank()?;
    match parser.peek() {
        None => Ok(node),
        Some(c) => Err(parser.error("syntax", format!("`{c}` after the end of the model"))),
    }
}

/// Byte offset after the value that begins at `at`, in a text that [`parse`] has read.
pub(crate) fn end_of_value(text: &str, at: u32) -> Parsed<usize> {
    let mut parser = Parser { text, position: at as usize, depth: 0 };
    parser.value()?;
    Ok(parser.position)
}

impl Parser<'_> {
    pub(super) fn error(&self, rule: &'static str, cause: impl Into<String>) -> SyntaxError {
        self.error_at(self.position, rule, cause)
    }

    pub(super) fn error_at(&self, at: usize, rule: &'static str, cause: impl Into<String>) -> SyntaxError {
        SyntaxError { at: at as u32, rule, cause: cause.into() }
    }

    pub(super) fn rest(&self) -> &str {
        &self.text[self.position..]
    }

    pub(super) fn byte(&self) -> Option<u8> {
        self.text.as_bytes().get(self.position).copied()
    }

    pub(super) fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    pub(super) fn take(&mut self, what: &str) -> bool {
        let found = self.text.as_bytes()[self.position..].starts_with(what.as_bytes());
        if found {
            self.position += what.len();
        }
        found
    }

    fn expect(&mut self, what: &str, purpose: &str) -> Parsed<()> {
        if self.take(what) {
            return Ok(());
        }
        Err(self.error("syntax", format!("expected `{what}` {purpose}, found {}", self.found())))
    }

    fn found(&self) -> String {
        self.peek().map_or("the end of the file".to_owned(), |c| format!("`{}`", c.escape_default()))
    }

    /// Skips white space and comments.
    pub(super) fn skip_blank(&mut self) -> Parsed<()> {
        loop {
            match self.byte() {
                Some(b' ' | b'\t' | b'\n' | b'\r' | 0x0B | 0x0C) => self.position += 1,
                Some(b'/') => self.comment()?,
                Some(0x80..) => match self.peek() {
                    Some(c @ ('\u{85}' | '\u{200E}' | '\u{200F}' | '\u{2028}' | '\u{2029}')) => {
                        self.position += c.len_utf8();
                    }
                    _ => return Ok(()),
                },
                _ => return Ok(()),
            }
        }
    }

    fn comment(&mut self) -> Parsed<()> {
        let start = self.position;
        if self.take("//") {
            self.position += self.rest().find('\n').unwrap_or(self.rest().len());
            return Ok(());
        }
        if !self.take("/*") {
            return Err(self.error("syntax", "a `/` that opens no comment"));
        }
        let mut open = 1;
        while open > 0 {
            if self.take("/*") {
                open += 1;
            } else if self.take("*/") {
                open -= 1;
            } else if self.position < self.text.len() {
                self.position += 1;
            } else {
                return Err(self.error_at(start, "syntax", "this comment is never closed"));
            }
        }
        Ok(())
    }

    fn enable_attribute(&mut self) -> Parsed<()> {
        self.skip_blank()?;
        self.expect("enable", "in the attribute")?;
        self.skip_blank()?;
        self.expect("(", "after `enable`")?;
        loop {
            self.skip_blank()?;
            if self.take(")") {
                break;
            }
            let at = self.position;
            let name = self.identifier()?;
            if !KNOWN_EXTENSIONS.contains(&name.as_ref()) {
                return Err(self.error_at(at, "syntax", format!("unknown extension `{name}`")));
            }
            self.skip_blank()?;
            if !self.take(",") {
                self.expect(")", "after the list of extensions")?;
                break;
            }
        }
        self.skip_blank()?;
        self.expect("]", "after `enable(…)`")?;
        self.skip_blank()
    }

    /// Reads a value; blanks before it must already be skipped.
    fn value(&mut self) -> Parsed<Node> {
        let at = self.position as u32;
        self.depth += 1;
        if self.depth > DEPTH_LIMIT {
            return Err(self.error("too-deep", format!("values nest deeper than {DEPTH_LIMIT}")));
        }
        let value = self.bare_value()?;
        self.depth -= 1;
        Ok(Node { at, value })
    }

    fn bare_value(&mut self) -> Parsed<Value> {
        match self.byte() {
            Some(b'(') => self.parenthesised(None),
            Some(b'[') => self.list(),
            Some(b'{') => self.map(),
            Some(b'"') => self.string().map(Value::Text),
            Some(b'\'') => self.character().map(Value::Text),
            Some(b'0'..=b'9' | b'+' | b'-' | b'.') => self.number().map(Value::Number),
            Some(b'r') if self.at_raw_string() => self.raw_string().map(Value::Text),
            Some(b'b') if self.at_bytes() => {
                Err(self.error("byte-string", "byte strings have no meaning in a model file"))
            }
            Some(_) => self.named(),
            None => Err(self.error("syntax", "expected a value, found the end of the file")),
        }
    }

    fn number(&mut self) -> Parsed<f64> {
        let start = self.position;
        let malformed = |token: &str| self.error_at(start, "syntax", format!("`{token}` is not a number"));
        let (value, end) = number(self.text, start).map_err(malformed)?;
        self.position = end;
        Ok(value)
    }

    fn named(&mut self) -> Parsed<Value> {
        let raw = self.rest().starts_with("r#");
        let name = self.identifier()?;
        if !raw {
            match name.as_ref() {
                "true" => return Ok(Value::Bool(true)),
                "false" => return Ok(Value::Bool(false)),
                "inf" | "inff32" | "inff64" => return Ok(Value::Number(f64::INFINITY)),
                "NaN" | "NaNf32" | "NaNf64" => return Ok(Value::Number(f64::NAN)),
                _ => {}
            }
        }
        let after_name = self.position;
        self.skip_blank()?;
        if self.byte() == Some(b'(') {
            return self.parenthesised(Some(name));
        }
        self.position = after_name;
        Ok(Value::Name(name))
    }

    pub(super) fn identifier(&mut self) -> Parsed<Box<str>> {
        let raw = self.take("r#");
        let rest = self.rest();
        let first = rest.chars().next();
        let starts = first.is_some_and(|c| c == '_' || c.is_alphabetic() || (raw && is_raw_name(c)));
        if !starts {
            return Err(self.error("syntax", format!("expected a value or a name, found {}", self.found())));
        }
        let belongs = |c: char| c == '_' || c.is_alphanumeric() || (raw && is_raw_name(c));
        let length = rest.find(|c| !belongs(c)).unwrap_or(rest.len());
        let name = rest[..length].into();
        self.position += length;
        Ok(name)
    }

    fn parenthesised(&mut self, name: Option<Box<str>>) -> Parsed<Value> {
        let open = self.position;
        self.position += 1;
        self.skip_blank()?;
        if let Some(numbers) = name.is_none().then(|| self.number_tuple()).flatten() {
            return Ok(Value::Numbers(numbers));
        }
        if self.at_field()? {
            return self.fields(open).map(|fields| Value::Struct(name, fields));
        }
        self.items(open, ")").map(|items| Value::Tuple(name, items))
    }

    /// Tries to read the rest of a tuple as plain numbers; does not advance if it is anything else.
    fn number_tuple(&mut self) -> Option<Box<[f64]>> {
        let start = self.position;
        let mut numbers = Vec::new();
        let found = self.depth < DEPTH_LIMIT && self.row_numbers(")", &mut numbers).is_some();
        if found && !numbers.is_empty() {
            return Some(numbers.into());
        }
        self.position = start;
        None
    }

    /// Returns `true` if `name :` comes next.
    fn at_field(&mut self) -> Parsed<bool> {
        let start = self.position;
        let named = self.peek().is_some_and(|c| c == '_' || c.is_alphabetic());
        let found = named && self.identifier().is_ok() && {
            self.skip_blank()?;
            self.byte() == Some(b':')
        };
        self.position = start;
        Ok(found)
    }

    fn fields(&mut self, open: usize) -> Parsed<Vec<Field>> {
        let mut fields = Vec::new();
        loop {
            self.skip_blank()?;
            if self.take(")") {
                return Ok(fields);
            }
            self.refuse_end(open, "(")?;
            let at = self.position as u32;
            let name = self.identifier()?;
            self.skip_blank()?;
            self.expect(":", &format!("after the field name `{name}`"))?;
            self.skip_blank()?;
            fields.push(Field { name, at, value: self.value()? });
            self.separator(")", "after the value of a field")?;
        }
    }

    fn items(&mut self, open: usize, close: &str) -> Parsed<Vec<Node>> {
        let mut items = Vec::new();
        loop {
            self.skip_blank()?;
            if self.take(close) {
                return Ok(items);
            }
            self.refuse_end(open, if close == ")" { "(" } else { "[" })?;
            items.push(self.value()?);
            self.separator(close, "between items")?;
        }
    }

    /// Consumes a comma, unless the closing bracket comes next.
    fn separator(&mut self, close: &str, purpose: &str) -> Parsed<()> {
        self.skip_blank()?;
        if self.rest().starts_with(close) { Ok(()) } else { self.expect(",", purpose) }
    }

    fn refuse_end(&self, open: usize, bracket: &str) -> Parsed<()> {
        if self.position < self.text.len() {
            return Ok(());
        }
        Err(self.error_at(open, "syntax", format!("this `{bracket}` is never closed")))
    }

    fn map(&mut self) -> Parsed<Value> {
        let open = self.position;
        self.position += 1;
        let mut entries = Vec::new();
        loop {
            self.skip_blank()?;
            if self.take("}") {
                return Ok(Value::Map(entries));
            }
            self.refuse_end(open, "{")?;
            let key = self.value()?;
            self.skip_blank()?;
            self.expect(":", "after the key of a map")?;
            self.skip_blank()?;
            entries.push((key, self.value()?));
            self.separator("}", "between the entries of a map")?;
        }
    }

    fn list(&mut self) -> Parsed<Value> {
        let open = self.position;
        self.position += 1;
        self.skip_blank()?;
        if let Some(rows) = self.rows()? {
            return Ok(Value::Rows(Box::new(rows)));
        }
        self.items(open, "]").map(Value::List)
    }

    /// Tries to read the rest of a list as rows of numbers; does not advance if it is anything else.
    fn rows(&mut self) -> Parsed<Option<Rows>> {
        let start = self.position;
        let bracketed = match self.byte() {
            Some(b'[') => true,
            Some(b'(') => false,
            _ => return Ok(None),
        };
        let mut rows = Rows { bracketed, ..Rows::default() };
        if self.depth + 2 <= DEPTH_LIMIT && self.fill_rows(&mut rows).is_some() {
            return Ok(Some(rows));
        }
        self.position = start;
        Ok(None)
    }

    fn fill_rows(&mut self, rows: &mut Rows) -> Option<()> {
        let (open, close) = if rows.bracketed { ("[", "]") } else { ("(", ")") };
        loop {
            self.skip_blank().ok()?;
            if self.take("]") {
                return Some(());
            }
            let at = self.position as u32;
            if !self.take(open) {
                return None;
            }
            self.row_numbers(close, &mut rows.numbers)?;
            rows.at.push(at);
            rows.ends.push(u32::try_from(rows.numbers.len()).ok()?);
            self.skip_blank().ok()?;
            if !self.take(",") && self.byte() != Some(b']') {
                return None;
            }
        }
    }

    fn row_numbers(&mut self, close: &str, numbers: &mut Vec<f64>) -> Option<()> {
        loop {
            self.skip_blank().ok()?;
            if self.take(close) {
                return Some(());
            }
            if !matches!(self.byte()?, b'0'..=b'9' | b'+' | b'-' | b'.') {
                return None;
            }
            numbers.push(self.number().ok()?);
            self.skip_blank().ok()?;
            if !self.take(",") && !self.rest_starts(close) {
                return None;
            }
        }
    }

    fn rest_starts(&self, what: &str) -> bool {
        self.text.as_bytes()[self.position..].starts_with(what.as_bytes())
    }
}

fn is_raw_name(c: char) -> bool {
    matches!(c, '.' | '+' | '-' | '_') || c.is_alphanumeric()
}
