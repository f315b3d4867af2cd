//! Faults of notation: the field at which a scene's text breaks off, and its correct form.

use super::error::SceneError;
use serde::Deserialize;

/// Correct forms of the fields that are most often written differently.
const FIELDS: [(&str, &str); 20] = [
    ("models", r#"write models: { "ball": "ball.ron", … }"#),
    ("objects", r#"write objects: [(name: "ball", model: "ball", bodies: [(motion: Fixed)]), …]"#),
    ("bodies", "write bodies: [(motion: Free, mass: …, inertia: …), …]"),
    ("pairs", r#"write pairs: [("ball", "ground"), …]"#),
    ("passes_through", r#"write passes_through: [("ball", "ground"), …]"#),
    ("motion", "write motion: Free, Fixed or Prescribed(…)"),
    (
        "inertia",
        "write inertia: Diagonal(xx, yy, zz), or Full(xx: …, yy: …, zz: …, xy: …, xz: …, yz: …), kg·m² about the mass \
         centre",
    ),
    ("position", "write position: (x, y, z), m"),
    (
        "orientation",
        "write the quaternion orientation: (w, x, y, z); a turn of 90° about x is (0.70710678, 0.70710678, 0, 0)",
    ),
    ("mass_center", "write mass_center: (x, y, z), m in the axes of the group"),
    ("linear_velocity", "write linear_velocity: (x, y, z), m/s"),
    ("angular_velocity", "write angular_velocity: (x, y, z), rad/s"),
    ("surface_velocity", "write surface_velocity: (x, y, z), m/s in the axes of the group"),
    ("surface_angular_velocity", "write surface_angular_velocity: (x, y, z), rad/s in the axes of the group"),
    ("belt_velocity", "write belt_velocity: (x, y, z), the axis of the rollers times the speed, m/s"),
    ("force", "write force: (x, y, z), N"),
    ("moment", "write moment: (x, y, z), N·m"),
    ("stiffness", "write stiffness: (x, y, z, about x, about y, about z), N/m and N·m/rad"),
    ("damping", "write damping: (x, y, z, about x, about y, about z), N·s/m and N·m·s/rad"),
    (
        "integrator",
        "write integrator: RungeKutta4, SemiImplicitEuler, ZeroOrderHold(substeps: 1) or LongFrame()",
    ),
];

/// The fault of a text that is not a scene, from the reader's error.
pub(super) fn fault(text: &str, file: &str, error: &ron::error::SpannedError) -> SceneError {
    let (file, at) = (file.to_owned(), Some((error.span.start.line, error.span.start.col)));
    if format_of(text).as_deref() == Some("pong-model") {
        let cause = "this is a model, not a scene".to_owned();
        let cure = "check it with `pong check`; a scene names it in `models`".to_owned();
        return SceneError { file, at: None, thing: "scene".to_owned(), cause, cure };
    }
    let start = offset(text, error.span.start.line, error.span.start.col);
    let cause = error.code.to_string();
    // For an unknown field, the cause already has its name.
    let unknown = matches!(error.code, ron::Error::NoSuchStructField { .. });
    let field = field_before(&text[..start]).filter(|_| !unknown);
    let known = field.and_then(|field| FIELDS.iter().find(|(name, _)| *name == field));
    let cure = known.map_or("docs/scene_format.md lists every field", |(_, cure)| cure).to_owned();
    let thing = field.map_or_else(|| "scene".to_owned(), |field| format!("field `{field}`"));
    SceneError { file, at, thing, cause, cure }
}

/// The `format` that a file declares, whatever the rest of it is.
fn format_of(text: &str) -> Option<String> {
    #[derive(Deserialize)]
    struct Head {
        format: String,
    }
    let options = ron::Options::default().with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME);
    options.from_str::<Head>(text).ok().map(|head| head.format)
}

/// Byte offset of a line and column, both from 1.
fn offset(text: &str, line: usize, column: usize) -> usize {
    let line_start: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let rest = &text[line_start.min(text.len())..];
    let within = rest.char_indices().nth(column.saturating_sub(1)).map_or(rest.len(), |(index, _)| index);
    (line_start + within).min(text.len())
}

/// The last `name:` of a text, outside strings and comments.
fn field_before(text: &str) -> Option<&str> {
    let bytes = text.as_bytes();
    let (mut index, mut word, mut field) = (0, 0..0, None);
    while index < bytes.len() {
        let from = index;
        match bytes[index] {
            b'"' => {
                index += 1;
                while index < bytes.len() && bytes[index] != b'"' {
                    index += if bytes[index] == b'\\' { 2 } else { 1 };
                }
                index += 1;
                word = 0..0;
            }
            b'/' if bytes.get(index + 1) == Some(&b'/') => {
                index = text[index..].find('\n').map_or(bytes.len(), |length| index + length);
            }
            b'/' if bytes.get(index + 1) == Some(&b'*') => {
                index = text[index..].find("*/").map_or(bytes.len(), |length| index + length + 2);
            }
            b':' if !word.is_empty() => {
                field = text.get(word.clone());
                (index, word) = (index + 1, 0..0);
            }
            byte if byte == b'_' || byte.is_ascii_alphanumeric() => {
                while index < bytes.len() && (bytes[index] == b'_' || bytes[index].is_ascii_alphanumeric()) {
                    index += 1;
                }
                word = from..index;
            }
            byte => {
                index += 1;
                if !byte.is_ascii_whitespace() {
                    word = 0..0;
                }
            }
        }
    }
    field
}

#[cfg(test)]
mod tests {
    use super::field_before;

    #[test]
    fn strings_and_comments_hold_no_field() {
        assert_eq!(field_before("(name: \"a: b\", // mass: 1\n /* x: */ inertia : (1, 2"), Some("inertia"));
        assert_eq!(field_before("(name: \"an unfinished \\\" b:"), Some("name"));
        assert_eq!(field_before("(1, 2, \"key\": 3"), None);
        assert_eq!(field_before(""), None);
    }
}
