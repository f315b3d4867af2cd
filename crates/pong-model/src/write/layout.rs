//! Layout of values: on one line if they fit, otherwise one field per line, with long lists filled.

use std::borrow::Cow;

/// Most characters of a line.
const WIDTH: usize = 120;
const INDENT: usize = 4;

/// Label and its value.
pub(super) type Item = (Cow<'static, str>, Shown);

/// Value ready for layout.
pub(super) enum Shown {
    Flat(String),
    /// Bracketed list; always one item per line if `broken`.
    Block {
        opening: String,
        items: Vec<Item>,
        closing: &'static str,
        broken: bool,
    },
    /// Long list of short tokens, as many per line as fit.
    Filled(Vec<String>),
}

impl Shown {
    pub(super) fn block(opening: &str, items: Vec<Item>, closing: &'static str) -> Self {
        Self::Block { opening: opening.to_owned(), items, closing, broken: false }
    }

    /// Gives each item of a list a line of its own, unless it is empty.
    pub(super) fn break_up(&mut self) {
        if let Self::Block { items, broken, .. } = self {
            *broken = !items.is_empty();
        }
    }
}

/// Appends the lines of label and value; the last ends with a comma.
pub(super) fn lay_out(label: &str, value: &Shown, indent: usize, out: &mut String) {
    let start = " ".repeat(indent) + label;
    let room = WIDTH.saturating_sub(start.chars().count() + 1);
    if let Some(line) = flat(value, room) {
        *out += &format!("{start}{line},\n");
        return;
    }
    match value {
        Shown::Flat(line) => *out += &format!("{start}{line},\n"),
        Shown::Filled(tokens) => {
            *out += &format!("{start}[\n");
            fill(tokens, indent + INDENT, out);
            *out += &format!("{}],\n", " ".repeat(indent));
        }
        Shown::Block { opening, items, closing, .. } => {
            *out += &format!("{start}{opening}\n");
            items.iter().for_each(|(label, inner)| lay_out(label, inner, indent + INDENT, out));
            *out += &format!("{}{closing},\n", " ".repeat(indent));
        }
    }
}

/// The value on one line, however long.
pub(super) fn one_line(value: &Shown) -> String {
    match value {
        Shown::Flat(line) => line.clone(),
        Shown::Filled(tokens) => format!("[{}]", tokens.join(", ")),
        Shown::Block { opening, items, closing, .. } => {
            let parts: Vec<String> =
                items.iter().map(|(label, inner)| format!("{label}{}", one_line(inner))).collect();
            format!("{opening}{}{closing}", parts.join(", "))
        }
    }
}

/// The value on one line; `None` if it is longer than the room or has lines of its own.
fn flat(value: &Shown, room: usize) -> Option<String> {
    let line = match value {
        Shown::Filled(tokens) if 3 * tokens.len() > room + 3 => return None,
        Shown::Block { broken: true, .. } => return None,
        Shown::Block { opening, items, closing, .. } => {
            let parts: Option<Vec<String>> =
                items.iter().map(|(label, inner)| Some(format!("{label}{}", flat(inner, room)?))).collect();
            format!("{opening}{}{closing}", parts?.join(", "))
        }
        Shown::Flat(_) | Shown::Filled(_) => one_line(value),
    };
    (line.chars().count() <= room).then_some(line)
}

fn fill(tokens: &[String], indent: usize, out: &mut String) {
    let margin = " ".repeat(indent);
    let mut used = 0;
    for token in tokens {
        // Token and comma, plus a space unless it is the first on the line.
        let width = token.chars().count() + 1;
        if used > 0 && used + 1 + width <= WIDTH - indent {
            out.push(' ');
            used += 1 + width;
        } else {
            if used > 0 {
                out.push('\n');
            }
            out.push_str(&margin);
            used = width;
        }
        out.push_str(token);
        out.push(',');
    }
    out.push('\n');
}
