//! CoACD as an external tool: its Python package cuts the mesh, we read the pieces back.

use nalgebra::Vector3;
use pong_import::Findings;
use pong_import::mesh::Mesh;
use std::fmt::Write as _;
use std::io::Write;
use std::process::{Command, Stdio};

/// Reads vertices and triangles from standard input and writes the vertices of each hull, one per line, with
/// an empty line between hulls. Output of the package itself goes to standard error.
const PROGRAM: &str = r"
import os, sys
out = os.fdopen(os.dup(1), 'w')
os.dup2(2, 1)
try:
    import numpy, coacd
except ImportError as reason:
    print(reason, file=sys.stderr)
    sys.exit(3)
threshold, pieces, resolution = float(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
rows = [line.split() for line in sys.stdin]
vertices = numpy.array([row[1:] for row in rows if row[0] == 'v'], dtype=float)
triangles = numpy.array([row[1:] for row in rows if row[0] == 'f'], dtype=numpy.int32)
coacd.set_log_level('error')
hulls = coacd.run_coacd(coacd.Mesh(vertices, triangles), threshold=threshold, max_convex_hull=pieces,
                        preprocess_mode='off', resolution=resolution, seed=0)
for hull_vertices, _ in hulls:
    for x, y, z in hull_vertices:
        print(repr(float(x)), repr(float(y)), repr(float(z)), file=out)
    print(file=out)
out.close()
";

/// Arguments of a call of CoACD.
pub(crate) struct Calling<'a> {
    /// The Python interpreter.
    pub(crate) python: &'a str,
    pub(crate) threshold: f64,
    pub(crate) pieces_max: usize,
    pub(crate) resolution: u32,
}

/// Corners of the hulls found by CoACD; the fault tells how to install it if it is missing.
pub(crate) fn hulls(
    mesh: &Mesh,
    calling: &Calling<'_>,
    file: &str,
    findings: &mut Findings,
) -> Option<Vec<Vec<Vector3<f64>>>> {
    let (status, out, err) = match run(mesh, calling) {
        Ok(done) => done,
        Err(reason) => {
            let cause = format!("`{}` cannot be run: {reason}", calling.python);
            return findings.refuse(
                file,
                "coacd-missing",
                cause,
                "install Python 3, or name it with --python; VHACD needs neither",
            );
        }
    };
    let last = err.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or("it said nothing").to_owned();
    match status {
        Some(0) => {}
        Some(3) => {
            let cause = format!("the Python package CoACD is not there: {last}");
            let cure = format!("`{} -m pip install coacd`, or leave --method away for VHACD", calling.python);
            return findings.refuse(file, "coacd-missing", cause, cure);
        }
        _ => {
            return findings.refuse(
                file,
                "decomposer-failed",
                format!("CoACD failed: {last}"),
                "leave --method away for VHACD",
            );
        }
    }
    let hulls = read(&out);
    if hulls.as_ref().is_none_or(Vec::is_empty) {
        let cause = "CoACD gave nothing that can be read";
        return findings.refuse(
            file,
            "decomposer-failed",
            cause,
            "install version 1.0 of the package coacd, or use VHACD",
        );
    }
    hulls
}

type Done = (Option<i32>, String, String);

fn run(mesh: &Mesh, calling: &Calling<'_>) -> std::io::Result<Done> {
    let mut text = String::new();
    for place in &mesh.vertices {
        let _ = writeln!(text, "v {:?} {:?} {:?}", place.x, place.y, place.z);
    }
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    let pieces = i64::try_from(calling.pieces_max).unwrap_or(-1);
    let mut child = Command::new(calling.python)
        .args([
            "-c",
            PROGRAM,
            &calling.threshold.to_string(),
            &pieces.to_string(),
            &calling.resolution.to_string(),
        ])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    let mut input = child.stdin.take();
    let feed = std::thread::spawn(move || input.as_mut().map(|input| input.write_all(text.as_bytes())));
    let output = child.wait_with_output()?;
    // A missing package closes the pipe early; the exit code reports it.
    let _ = feed.join();
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    Ok((output.status.code(), text(output.stdout), text(output.stderr)))
}

fn read(text: &str) -> Option<Vec<Vec<Vector3<f64>>>> {
    let mut hulls = vec![Vec::new()];
    for line in text.lines() {
        let numbers: Option<Vec<f64>> = line.split_whitespace().map(|word| word.parse().ok()).collect();
        match numbers?.as_slice() {
            [] => hulls.push(Vec::new()),
            [x, y, z] => hulls.last_mut()?.push(Vector3::new(*x, *y, *z)),
            _ => return None,
        }
    }
    hulls.retain(|hull| !hull.is_empty());
    Some(hulls)
}
