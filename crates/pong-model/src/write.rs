//! Text of a model file from values as [`authored::parse`](crate::authored::parse) gives them.
//!
//! Equal values give equal texts, and reading gives the values that were written, bit for bit: each number is the
//! shortest decimal of its bits. A value stands on one line if it fits; otherwise each field has a line of its
//! own, and long lists of numbers are filled. Groups, primitives, surfaces and pairs always have lines of their
//! own. Nothing is judged: the loader does that.

mod layout;

use crate::ron_tree::{Rows, Value};
use crate::schema::{self, Type};
use layout::{Item, Shown, lay_out, one_line};

/// Text of a model file: `model` is the struct of its fields.
pub fn text(model: &Value) -> String {
    let mut shown = shown(model, None);
    shown.break_up();
    let mut out = String::new();
    lay_out("", &shown, 0, &mut out);
    // No comma follows the outermost bracket.
    out.truncate(out.len() - 2);
    out.push('\n');
    out
}

/// Text of a value on one line.
pub fn line(value: &Value) -> String {
    one_line(&shown(value, None))
}

/// Decimal text of a number: the shortest digits that give the same bits, never an integer; scientific notation
/// outside of 1e-4 to 1e16.
pub fn decimal(value: f64) -> String {
    if value.is_nan() {
        return "NaN".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "inf" } else { "-inf" }.to_owned();
    }
    if value == 0.0 || (1e-4..1e16).contains(&value.abs()) {
        return format!("{value:?}");
    }
    let text = format!("{value:e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let (sign, size) = exponent.strip_prefix('-').map_or(('+', exponent), |size| ('-', size));
    format!("{digits}e{sign}{size:0>2}")
}

/// Layout of a value of a type; `None` for a value whose type does not change its layout.
fn shown(value: &Value, of: Option<Type>) -> Shown {
    let is_whole = of.is_some_and(|of| of.is_whole());
    match value {
        Value::Bool(flag) => Shown::Flat(flag.to_string()),
        Value::Number(number) => Shown::Flat(token(*number, is_whole)),
        Value::Text(text) => Shown::Flat(quoted(text)),
        Value::Name(name) => Shown::Flat(word(name)),
        Value::Struct(name, fields) => {
            let items = fields.iter().map(|field| {
                let of = schema::field(&field.name).map(|field| field.value);
                (format!("{}: ", word(&field.name)).into(), shown(&field.value.value, of))
            });
            let mut block = Shown::block(&opening(name.as_deref()), items.collect(), ")");
            if matches!(of, Some(Type::Group | Type::Groups)) {
                block.break_up();
            }
            block
        }
        Value::Tuple(name, items) => {
            Shown::block(&opening(name.as_deref()), unlabelled(items.iter().map(|node| &node.value), of), ")")
        }
        Value::Numbers(numbers) => {
            let items = numbers.iter().map(|number| ("".into(), Shown::Flat(token(*number, is_whole))));
            Shown::block("(", items.collect(), ")")
        }
        Value::List(items) => list(unlabelled(items.iter().map(|node| &node.value), of), of),
        Value::Map(entries) => {
            let labelled = entries
                .iter()
                .map(|(key, entry)| (format!("{}: ", line(&key.value)).into(), shown(&entry.value, None)));
            let mut block = Shown::block("{", labelled.collect(), "}");
            block.break_up();
            block
        }
        Value::Rows(rows) => Shown::Filled(row_tokens(rows, is_whole)),
    }
}

fn unlabelled<'v>(values: impl Iterator<Item = &'v Value>, of: Option<Type>) -> Vec<Item> {
    values.map(|value| ("".into(), shown(value, of))).collect()
}

/// Layout of a list: groups, primitives and pairs one a line, short tokens as many per line as fit.
fn list(items: Vec<Item>, of: Option<Type>) -> Shown {
    let is_broken = matches!(of, Some(Type::Groups | Type::Primitives | Type::List(_)));
    if !is_broken && items.iter().all(|(_, item)| matches!(item, Shown::Flat(_))) {
        return Shown::Filled(items.into_iter().map(|(_, item)| one_line(&item)).collect());
    }
    let mut block = Shown::block("[", items, "]");
    if is_broken {
        block.break_up();
    }
    block
}

/// Each row as `(x, y, z)` or `[a, b, c]`.
fn row_tokens(rows: &Rows, is_whole: bool) -> Vec<String> {
    let brackets = if rows.bracketed { ['[', ']'] } else { ['(', ')'] };
    let row = |index: usize| {
        let mut text = String::from(brackets[0]);
        for (place, number) in rows.row(index).iter().enumerate() {
            if place > 0 {
                text.push_str(", ");
            }
            text.push_str(&token(*number, is_whole));
        }
        text.push(brackets[1]);
        text
    };
    (0..rows.len()).map(row).collect()
}

fn token(number: f64, is_whole: bool) -> String {
    // Formatted, not cast: a cast of a number beyond the range of integers would trap.
    let is_integer = is_whole && number == number.trunc() && number.abs() < 1e18;
    if is_integer { format!("{:.0}", number + 0.0) } else { decimal(number) }
}

fn opening(name: Option<&str>) -> String {
    format!("{}(", name.map(word).unwrap_or_default())
}

/// Name as it is written; RON has a raw form for names that are no plain words.
fn word(name: &str) -> String {
    let is_plain = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        && !name.starts_with(|c: char| c.is_ascii_digit());
    if is_plain { name.to_owned() } else { format!("r#{name}") }
}

/// Text in quotation marks, with escapes for quotation marks and for characters that show nothing.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            ' '..='~' => out.push(c),
            c if c.is_alphanumeric() => out.push(c),
            // A combining mark is escaped by itself, but not behind another character.
            c if format!("a{c}").escape_debug().nth(1) == Some(c) => out.push(c),
            c => out.push_str(&format!("\\u{{{:x}}}", c as u32)),
        }
    }
    out + "\""
}
