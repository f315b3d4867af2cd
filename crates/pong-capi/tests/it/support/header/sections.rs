//! Sections of `pong.h`, in calling order.

use super::source_folder;

/// A part of the header under one heading.
pub struct Section {
    /// The heading.
    pub heading: &'static str,
    /// Lines about the section as a whole.
    pub about: &'static [&'static str],
    /// Source files, whose items come in the order in which they stand there; or `file::item` for an item whose file
    /// belongs to another section.
    items: &'static [&'static str],
}

/// Heading of the section that has the check of the layout.
pub const VERSION: &str = "Version";

pub const SECTIONS: &[Section] = &[
    Section { heading: "Status and messages", about: &[], items: &["status"] },
    Section { heading: VERSION, about: &[], items: &["abi", "version"] },
    Section { heading: "Set-up: world", about: &[], items: &["handle", "coupling", "config", "world"] },
    Section {
        heading: "Set-up: models, Objects and pairs",
        about: &[],
        items: &["ids", "models", "objects", "pairs"],
    },
    Section {
        heading: "Set-up: Interfaces and primitives",
        about: &[],
        items: &["interfaces", "primitives"],
    },
    Section {
        heading: "Set-up: masses and step",
        about: &["Optional: checks whether the host's step is short enough. No frame reads masses or plan."],
        items: &["step_plan"],
    },
    Section { heading: "Set-up: seal", about: &[], items: &["seal"] },
    Section {
        heading: "Frames",
        about: &["Each frame: set states, step, get wrenches; or evaluate at stages and commit at the end."],
        items: &["states", "surface_motions", "interfaces::pong_get_authored_state", "frames"],
    },
    Section { heading: "Results: wrenches", about: &[], items: &["wrenches"] },
    Section { heading: "Results: contacts", about: &[], items: &["contacts", "step_plan::pong_check_step"] },
    Section { heading: "Results: tangents", about: &[], items: &["tangents", "slopes"] },
    Section { heading: "Results: distance", about: &[], items: &["distance"] },
    Section { heading: "Results: begin, end and peaks of contact", about: &[], items: &["pair_monitor"] },
    Section {
        heading: "Contact state",
        about: &[],
        items: &["contact_state", "objects::pong_clear_contact_history"],
    },
    Section {
        heading: "Changes between frames",
        about: &[],
        items: &["pairs::pong_set_pair_enabled", "surfaces"],
    },
    Section { heading: "Further worlds", about: &[], items: &["clone", "continuation"] },
    Section { heading: "Response logs", about: &[], items: &["log"] },
    Section {
        heading: "Own force laws",
        about: &["Registered before models that name them are loaded."],
        items: &["law_types", "laws"],
    },
    Section { heading: "User data", about: &[], items: &["user_data"] },
    Section { heading: "Workers", about: &[], items: &["worker", "workers"] },
    Section { heading: "Diagnostics: report", about: &[], items: &["report", "tally"] },
    Section {
        heading: "Diagnostics: energies",
        about: &[],
        items: &["report::pong_ledger", "report::pong_get_ledger", "accounts"],
    },
    Section {
        heading: "Slow hosts",
        about: &[
            "Optional: for hosts that call once in a long frame and hold the wrench. See docs/slow_hosts.md.",
        ],
        items: &["slow_settings", "slow_input", "slow_report", "slow_host"],
    },
];

impl Section {
    /// The names of its declarations, in order.
    pub fn names(&self) -> Vec<String> {
        let names = self.items.iter().flat_map(|item| match item.split_once("::") {
            Some((_, name)) => vec![name.to_owned()],
            None => names_in(item),
        });
        names.collect()
    }
}

/// The source files of all sections.
pub fn files() -> impl Iterator<Item = &'static str> {
    SECTIONS.iter().flat_map(|section| section.items).filter(|item| !item.contains("::")).copied()
}

/// The names that a file declares for C, in order, without those that another section takes.
fn names_in(file: &str) -> Vec<String> {
    let source = std::fs::read_to_string(source_folder().join(file).with_extension("rs"));
    let source = source.unwrap_or_else(|error| panic!("{file}.rs: {error}"));
    let taken = |name: &str| {
        SECTIONS.iter().flat_map(|section| section.items).any(|item| *item == format!("{file}::{name}"))
    };
    let names = source.lines().filter_map(item_name).filter(|name| !taken(name));
    names.map(str::to_owned).collect()
}

/// The name of a public item of C that a line begins.
fn item_name(line: &str) -> Option<&str> {
    let begins = [
        "pub const ",
        "pub struct ",
        "pub enum ",
        "pub type ",
        "pub extern \"C\" fn ",
        "pub unsafe extern \"C\" fn ",
    ];
    let rest = begins.iter().find_map(|begin| line.strip_prefix(begin))?;
    let name = rest.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').next()?;
    (name.starts_with("pong_") || name.starts_with("PONG_")).then_some(name)
}
