//! Generates `pong.h`: shared by the generator (an example of this crate) and the test that the committed header
//! is current.

mod declarations;
mod sections;

use cbindgen::{Builder, DocumentationStyle, EnumConfig, ItemType, Language, RenameRule, Style};
use declarations::{Declaration, declarations};
use sections::SECTIONS;
use std::fmt::Write;
use std::path::{Path, PathBuf};

const HEAD: &str = "\
// Pong: contact dynamics, states in, wrenches out.
//
// Generated from crates/pong-capi by ci/header; do not edit. Calling order, ownership and threads: README.md
// beside this file. C99 and C++11 or later.
//
// Units: SI (m, kg, s, N, J, rad) unless a comment says otherwise.
//
// Frames: states are relative to the common frame, which the host chooses; paired Objects share it. `..._group` and
// `..._b` quantities are along the axes of a movable group. In a contact the normal points from B to A, and forces are
// those on A.
//
// Truth values are int32_t, in settings uint32_t: 0 for no, 1 for yes. As input, any other number is
// PONG_STATUS_BAD_VALUE.
//
// Errors: a call that returns a pong_status changes nothing that a later frame can see if it fails. Any of them may
// return PONG_STATUS_NULL_ARGUMENT, PONG_STATUS_PANIC and, with a world, PONG_STATUS_BUSY; with an id or an index
// PONG_STATUS_UNKNOWN_ID; with a name PONG_STATUS_UNKNOWN_NAME; with a number or text that cannot be
// PONG_STATUS_BAD_VALUE. The comment of a function names the other ones. \"Before sealing\" and \"after sealing\" mean
// PONG_STATUS_WRONG_PHASE otherwise.

#ifndef PONG_H
#define PONG_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern \"C\" {
#endif
";

const TAIL: &str = "
#ifdef __cplusplus
}  /* extern \"C\" */
#endif

#endif  /* PONG_H */
";

/// The text of the header.
pub fn generate() -> String {
    let mut left = declarations(&generated_code());
    let mut text = HEAD.to_owned();
    for section in SECTIONS {
        write!(text, "\n/* ---- {} {} */\n", section.heading, "-".repeat(100 - section.heading.len()))
            .unwrap();
        text.extend(section.about.iter().map(|line| format!("/* {line} */\n")));
        if section.heading == sections::VERSION {
            text.push_str(&layout_check());
        }
        let mut group = None;
        for name in section.names() {
            let Some(index) = left.iter().position(|declaration| declaration.name == name) else {
                panic!("{name}: not in what cbindgen generates");
            };
            let declaration = left.remove(index);
            if group.is_none() || group != declaration.group() {
                text.push('\n');
            }
            text.push_str(&declaration.text);
            group = declaration.group();
        }
    }
    let unplaced: Vec<&str> =
        left.iter().map(|declaration: &Declaration| declaration.name.as_str()).collect();
    assert!(unplaced.is_empty(), "in no section of sections.rs: {unplaced:?}");
    text + TAIL
}

/// The folder of the sources of this crate.
fn source_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

fn layout_check() -> String {
    format!(
        "\n/// Hash of every layout in this header; see PONG_CHECK_ABI().\n#define PONG_LAYOUT_HASH {:#018x}ULL\n\n\
         /// Checks that this header fits the library: call it first.\n\
         #define PONG_CHECK_ABI() pong_check_abi(PONG_ABI_VERSION, PONG_LAYOUT_HASH)\n",
        pong::layout::layout_hash()
    )
}

/// Declarations as cbindgen writes them: constants, types, functions.
fn generated_code() -> String {
    let mut builder = Builder::new().with_config(config());
    for file in sections::files() {
        builder = builder.with_src(source_folder().join(file).with_extension("rs"));
    }
    let bindings = builder.generate().expect("the sources of this crate parse");
    let mut text = Vec::new();
    bindings.write(&mut text);
    String::from_utf8(text).expect("the header is UTF-8")
}

fn config() -> cbindgen::Config {
    let mut config = cbindgen::Config {
        language: Language::C,
        cpp_compat: true,
        no_includes: true,
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
