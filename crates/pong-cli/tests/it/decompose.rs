//! `pong decompose` on the command line.

use crate::common;
use crate::common::pong;
use std::path::PathBuf;

/// An L of 3 m³: outlines at y = 0 and y = 1, and the sides between them.
const ELL: &str = "v 0 0 0\nv 2 0 0\nv 2 0 1\nv 1 0 1\nv 1 0 2\nv 0 0 2\n\
                   v 0 1 0\nv 2 1 0\nv 2 1 1\nv 1 1 1\nv 1 1 2\nv 0 1 2\n\
                   f 1 2 3 4 5 6\nf 12 11 10 9 8 7\n\
                   f 1 7 8 2\nf 2 8 9 3\nf 3 9 10 4\nf 4 10 11 5\nf 5 11 12 6\nf 6 12 7 1\n";

fn folder(test: &str) -> PathBuf {
    common::folder(&format!("decompose/{test}"), &[("ell.obj", ELL)])
}

#[test]
fn figures_are_printed_and_the_model_passes_the_check() {
    let folder = folder("figures");
    let arguments = ["decompose", "ell.obj", "-o", "ell.ron", "--stiffness", "1e6", "--samples", "2000"];
    let (code, out, err) = pong(&folder, &arguments);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    let lines: Vec<&str> = out.lines().collect();
    assert_eq!(lines[0], "12 vertices and 20 triangles read: 2 pieces", "{out}");
    assert!(lines[1].ends_with("2 of them inactive"), "{out}");
    assert_eq!(lines[2], "volume: 3 m³, 100 % of the source's 3 m³");
    assert!(lines[4].trim_start().starts_with("protrusion") && lines[5].trim_start().starts_with("deficit"));
    assert_eq!(lines[6], "written: ./ell.ron");
    let (code, _, err) = pong(&folder, &["check", "ell.ron"]);
    assert_eq!((code, err.as_str()), (0, ""));
}

#[test]
fn what_protrudes_beyond_the_limit_ends_with_one_and_leaves_what_was_there() {
    let folder = folder("limit");
    std::fs::write(folder.join("ell.ron"), "earlier").unwrap();
    let arguments = [
        "decompose",
        "ell.obj",
        "-o",
        "ell.ron",
        "--pieces-max",
        "1",
        "--within",
        "10cm",
        "--samples",
        "2000",
    ];
    let (code, out, err) = pong(&folder, &arguments);
    assert_eq!(code, 1);
    assert!(out.contains("protrusion"), "the figures are told: {out}");
    assert!(
        err.contains("error: ell.obj: [protrusion]") && err.ends_with("1 fault; nothing was written\n"),
        "{err}"
    );
    assert_eq!(std::fs::read_to_string(folder.join("ell.ron")).unwrap(), "earlier");
    let (code, _, _) = pong(&folder, &["decompose", "ell.obj", "-o", "ell.ron", "--pieces-max", "0"]);
    assert_eq!(code, 2);
}
