//! The text of a generated header, taken apart into declarations.

/// One declaration with its comment.
pub struct Declaration {
    /// The constant, type or function.
    pub name: String,
    /// Comment and code; ends with a line break.
    pub text: String,
}

impl Declaration {
    /// The common part of the names of constants that belong together, `PONG_FLAG` for `PONG_FLAG_TUNNELLED`; `None` for
    /// types and functions.
    pub fn group(&self) -> Option<String> {
        let words: Vec<&str> = self.name.strip_prefix("PONG_")?.split('_').collect();
        // A frame of reference has two words.
        let length = if words[0] == "REFERENCE" { 2 } else { 1 };
        Some(words[..length].join("_"))
    }
}

/// The declarations of a header: its parts between blank lines, the preprocessor's frame around functions left out.
pub fn declarations(header: &str) -> Vec<Declaration> {
    let parts = header.split("\n\n").map(str::trim).filter(|part| !part.is_empty());
    parts
        .filter(|part| !part.starts_with("#ifdef __cplusplus"))
        .map(|part| Declaration { name: declared_name(part), text: format!("{part}\n") })
        .collect()
}

/// The name that a declaration declares.
fn declared_name(declaration: &str) -> String {
    let code = declaration.lines().map(str::trim).find(|line| !line.starts_with("//"));
    let code = code.unwrap_or_else(|| panic!("no code: {declaration}"));
    if let Some(constant) = code.strip_prefix("#define ") {
        return constant.split(' ').next().unwrap_or_default().to_owned();
    }
    // A pointer to a function has its name in the first brackets.
    let code = code.replace("(*", " ");
    let before = code.split(['(', ')', '{', ';']).next().unwrap_or_default();
    let name = before.split_whitespace().last().unwrap_or_default();
    name.trim_start_matches('*').to_owned()
}
