//! The committed `include/pong.h` is equal to the header generated from the sources.

use crate::support;
use std::path::Path;

#[test]
fn the_committed_header_is_current() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../include/pong.h");
    let committed = std::fs::read_to_string(&path).unwrap();
    let generated = support::header::generate();
    let difference = committed.lines().zip(generated.lines()).enumerate().find(|(_, (old, new))| old != new);
    assert!(
        committed == generated,
        "include/pong.h is not current; run `ci/header --write`. First difference (line from 0, old, new): {difference:?}"
    );
}
