//! The text of the page: `page/` and `vendor/`, with the data of a run.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

const FRAME: &str = include_str!("../page/page.html");
const STYLE: &str = include_str!("../page/style.css");
const MAIN: &str = include_str!("../page/main.js");

macro_rules! modules {
    ($($name:literal),* $(,)?) => {
        [$((concat!("#view/", $name), include_str!(concat!("../page/", $name)))),*]
    };
}

/// The page's modules, by the names in their import statements.
const MODULES: &[(&str, &str)] = &modules![
    "arrows.js",
    "bodies.js",
    "camera.js",
    "contacts.js",
    "data.js",
    "highlight.js",
    "keys.js",
    "list.js",
    "meshes.js",
    "patches.js",
    "player.js",
    "plots.js",
    "series.js",
    "stage.js",
    "theme.js",
    "transport.js",
    "units.js",
];
const THREE: &str = include_str!("../vendor/three.min.js");
const THREE_LICENSE: &str = include_str!("../vendor/LICENSE");

/// JSON escaped for a script element.
pub(crate) fn json(value: &impl Serialize) -> String {
    let text = serde_json::to_string(value).expect("names and finite numbers are always JSON");
    text.replace('<', "\\u003c").replace('\u{2028}', "\\u2028").replace('\u{2029}', "\\u2029")
}

/// The whole page.
pub(crate) fn page(title: &str, description: &str, data: &str) -> String {
    let title = escaped(title);
    let imports = imports();
    let parts = [
        ("title", title.as_str()),
        ("style", STYLE),
        ("three-license", THREE_LICENSE),
        ("imports", imports.as_str()),
        ("run", description),
        ("data", data),
        ("main", MAIN),
    ];
    let mut page = String::with_capacity(FRAME.len() + parts.iter().map(|part| part.1.len()).sum::<usize>());
    let mut rest = FRAME;
    while let Some((before, after)) = rest.split_once("{{") {
        let (name, after) = after.split_once("}}").expect("page.html closes what it opens");
        let part = parts.iter().find(|part| part.0 == name).expect("page.html asks for what there is");
        page.push_str(before);
        page.push_str(part.1);
        rest = after;
    }
    page + rest
}

/// Import map from module names to their text, because a page opened from a disk may not load other files.
fn imports() -> String {
    // Each text ends with its name, because errors would otherwise name modules by their whole text.
    let url = |name: &str, text: &str| {
        let named = format!("{text}\n//# sourceURL=pong/{}\n", name.trim_start_matches("#view/"));
        format!("data:text/javascript;base64,{}", STANDARD.encode(named))
    };
    let all = MODULES.iter().chain([&("three", THREE)]);
    let map: serde_json::Map<_, _> =
        all.map(|(name, text)| ((*name).to_owned(), serde_json::Value::String(url(name, text)))).collect();
    json(&serde_json::json!({ "imports": map }))
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_cannot_break_out_of_the_page() {
        let empty = super::page("", "\"\"", "");
        for evil in [
            "</script><script>alert(1)</script>{{data}}",
            "</title><img src=x onerror='alert(1)'>",
            "<!-- <script>",
            "--> ]]>",
            "\" onload=\"alert(1)\" ' & &lt; &amp;quot; \\\"",
            "\u{2028}\u{2029}\u{0}\u{1b}[31m\u{202e}",
            "{{run}}",
        ] {
            let page = super::page(evil, &json(&evil), "");
            for mark in ["<script", "</script", "<!--", "<img", "<title", "</title"] {
                assert_eq!(page.matches(mark).count(), empty.matches(mark).count(), "{evil:?}: {mark}");
            }
            assert!(!json(&evil).contains(['<', '\u{2028}', '\u{2029}']), "{evil:?}");
            let text = page.split_once(r#"id="run">"#).unwrap().1.split_once("</script>").unwrap().0;
            assert_eq!(serde_json::from_str::<String>(text).unwrap(), evil);
            let shown = page.split_once("<title>").unwrap().1.split_once(" – pong view</title>").unwrap().0;
            let escapes = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&amp;", "&")];
            let read = escapes.iter().fold(shown.to_owned(), |text, (from, to)| text.replace(from, to));
            assert_eq!(read, evil);
        }
    }

    #[test]
    fn every_module_that_is_imported_is_there() {
        let names: Vec<&str> = MODULES.iter().map(|module| module.0).chain(["three"]).collect();
        for text in MODULES.iter().map(|module| module.1).chain([MAIN]) {
            for import in text.lines().filter_map(|line| line.split_once(" from \"")) {
                let name = import.1.trim_end_matches("\";");
                assert!(names.contains(&name), "{name}");
            }
        }
    }

    /// Scripts show names only as text or as attributes of their own, never as markup; the page forbids
    /// scripts from anywhere else.
    #[test]
    fn no_module_makes_markup_of_text() {
        let markup =
            ["innerHTML", "outerHTML", "insertAdjacentHTML", "createContextualFragment", "DOMParser"];
        let code = ["document.write", "eval(", "new Function", "srcdoc", "setAttribute(\"on", "javascript:"];
        for (name, text) in MODULES.iter().copied().chain([("main.js", MAIN)]) {
            for word in markup.iter().chain(&code) {
                assert!(!text.contains(word), "{name}: {word}");
            }
        }
        assert!(FRAME.contains("default-src 'none'"));
    }

    #[test]
    fn no_module_has_words_that_end_a_script() {
        assert!(!MAIN.contains("</script"));
        assert!(!STYLE.contains("</style"));
    }
}
