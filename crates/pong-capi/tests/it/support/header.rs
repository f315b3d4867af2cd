//! Generates `pong.h`: shared by the generator (an example of this crate) and the test that the committed header
//! is current.

use cbindgen::{Builder, DocumentationStyle, EnumConfig, ItemType, Language, RenameRule, Style};
use std::path::Path;

/// Source files in the reading order of the header.
const FILES: [&str; 33] = [
    "status",
    "abi",
    "version",
    "coupling",
    "config",
    "ids",
    "states",
    "wrenches",
    "handle",
    "world",
    "clone",
    "law_types",
    "laws",
    "models",
    "objects",
    "pairs",
    "interfaces",
    "primitives",
    "step_plan",
    "seal",
    "frames",
    "contacts",
    "distance",
    "pair_monitor",
    "report",
    "accounts",
    "tally",
    "worker",
    "workers",
    "contact_state",
    "continuation",
    "surfaces",
    "log",
];
const LAST_FILE: &str = "user_data";

const HEADER: &str = "\
// Pong: contact dynamics, states in, wrenches out.
//
// Generated from crates/pong-capi by ci/header; do not edit. Calling order, ownership and threads: README.md
// beside this file. SI units: m, kg, s, N, rad. C99 and C++11 or later.";

/// The text of the header.
pub fn generate() -> String {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut builder = Builder::new().with_config(config());
    for file in FILES.iter().chain([&LAST_FILE]) {
        builder = builder.with_src(src.join(file).with_extension("rs"));
    }
    let bindings = builder.generate().expect("the sources of this crate parse");
    let mut text = Vec::new();
    bindings.write(&mut text);
    String::from_utf8(text).expect("the header is UTF-8")
}

fn config() -> cbindgen::Config {
    let check = format!(
        "\n/// Hash of every layout in this header; see PONG_CHECK_ABI().\n#define PONG_LAYOUT_HASH {:#018x}ULL\n\n\
         /// Checks that this header fits the library: call it first.\n\
         #define PONG_CHECK_ABI() pong_check_abi(PONG_ABI_VERSION, PONG_LAYOUT_HASH)",
        pong::layout::layout_hash()
    );
    let mut config = cbindgen::Config {
        language: Language::C,
        cpp_compat: true,
        header: Some(HEADER.to_owned()),
        include_guard: Some("PONG_H".to_owned()),
        no_includes: true,
        sys_includes: vec!["stddef.h".to_owned(), "stdint.h".to_owned()],
        after_includes: Some(check),
        documentation_style: DocumentationStyle::Cxx,
        style: Style::Both,
        usize_is_size_t: true,
        line_length: 110,
        tab_width: 4,
        enumeration: EnumConfig {
            rename_variants: RenameRule::QualifiedScreamingSnakeCase,
            ..EnumConfig::default()
        },
        ..cbindgen::Config::default()
    };
    config.export.item_types = vec![
        ItemType::Constants,
        ItemType::Enums,
        ItemType::Structs,
        ItemType::OpaqueItems,
        ItemType::Typedefs,
        ItemType::Functions,
    ];
    config
}
