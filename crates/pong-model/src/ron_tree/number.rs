//! Numbers: decimal, hexadecimal, binary, octal, with underscores and type suffixes, infinity and NaN.

const SUFFIXES: [&str; 12] =
    ["i8", "i16", "i32", "i64", "i128", "u8", "u16", "u32", "u64", "u128", "f32", "f64"];

/// Number that begins at `start`, and the offset after it; if there is none, the token found instead.
pub(super) fn number(text: &str, start: usize) -> Result<(f64, usize), &str> {
    let bytes = text.as_bytes();
    let mut end = start;
    while end < bytes.len() && belongs(bytes, start, end) {
        end += 1;
    }
    let token = &text[start..end];
    meaning(token).map(|value| (value, end)).ok_or(token)
}

/// Returns `true` if a character belongs to the number. Signs do at its start and after the `e` of an
/// exponent.
fn belongs(bytes: &[u8], start: usize, here: usize) -> bool {
    match bytes[here] {
        b'+' | b'-' => {
            here == start || (matches!(bytes[here - 1], b'e' | b'E') && !is_hex(&bytes[start..here]))
        }
        byte => byte == b'.' || byte == b'_' || byte.is_ascii_alphanumeric(),
    }
}

fn is_hex(token: &[u8]) -> bool {
    let digits = token.strip_prefix(b"-").or(token.strip_prefix(b"+")).unwrap_or(token);
    digits.starts_with(b"0x")
}

fn meaning(token: &str) -> Option<f64> {
    // Fast path for nearly every number of a large file.
    if token.bytes().all(|b| matches!(b, b'0'..=b'9' | b'-' | b'.')) && token != "." && token != "-." {
        return token.parse().ok();
    }
    let (negative, digits) = match token.as_bytes()[0] {
        b'-' => (true, &token[1..]),
        b'+' => (false, &token[1..]),
        _ => (false, token),
    };
    let size = magnitude(digits)?;
    Some(if negative { -size } else { size })
}

fn magnitude(digits: &str) -> Option<f64> {
    match digits {
        "inf" => return Some(f64::INFINITY),
        "NaN" => return Some(f64::NAN),
        _ => {}
    }
    for (prefix, radix) in [("0x", 16), ("0b", 2), ("0o", 8)] {
        if let Some(rest) = digits.strip_prefix(prefix) {
            return integer(without_suffix(rest, radix == 16), radix);
        }
    }
    decimal(without_suffix(digits, false))
}

fn without_suffix(digits: &str, hexadecimal: bool) -> &str {
    let own = |suffix: &&&str| !(hexadecimal && suffix.starts_with('f')) && digits.ends_with(**suffix);
    SUFFIXES.iter().find(own).map_or(digits, |suffix| &digits[..digits.len() - suffix.len()])
}

fn integer(digits: &str, radix: u32) -> Option<f64> {
    if digits.starts_with('_') || digits.is_empty() {
        return None;
    }
    let plain: String = digits.chars().filter(|&c| c != '_').collect();
    u64::from_str_radix(&plain, radix).ok().map(|value| value as f64)
}

/// Parses a decimal number. An underscore must follow a digit (or the `e` of an exponent), as in the `ron`
/// crate.
fn decimal(digits: &str) -> Option<f64> {
    let mut plain = String::with_capacity(digits.len());
    let mut underscore_allowed = false;
    for c in digits.chars() {
        match c {
            '_' if underscore_allowed => continue,
            '0'..='9' | 'e' | 'E' => underscore_allowed = true,
            '.' | '+' | '-' => underscore_allowed = false,
            _ => return None,
        }
        plain.push(c);
    }
    if !plain.bytes().any(|b| b.is_ascii_digit()) {
        return None;
    }
    plain.parse().ok()
}
