//! Limits on what a file makes: a short file can name one mesh many times.

use crate::findings::Findings;

/// Bytes of the paths of all nodes, unless the file is as long: each path repeats the names of the nodes above.
const PATH_BYTES: usize = 64 << 20;

/// Remaining budget of a file.
pub(super) struct Budget {
    corners: usize,
    path_bytes: usize,
    triangles_max: usize,
}

impl Budget {
    /// For a file of this length with its buffers. Every corner of a mesh takes a byte at least, so that a file that names
    /// each mesh once stays within its length.
    pub(super) fn new(triangles_max: usize, length: usize) -> Self {
        let corners = triangles_max.saturating_mul(3).max(length);
        Self { corners, path_bytes: PATH_BYTES.max(length), triangles_max }
    }

    /// Whether there is room for a mesh of so many corners or vertices; else a fault is noted.
    pub(super) fn take(&mut self, corners: usize, path: &str, findings: &mut Findings) -> bool {
        match self.corners.checked_sub(corners) {
            Some(left) => self.corners = left,
            None => {
                let cause = format!(
                    "meshes that are named several times make more than {} triangles, and more corners than the file has bytes",
                    self.triangles_max
                );
                self.refuse(
                    path,
                    cause,
                    "--triangles-max allows more; else join or leave out copies",
                    findings,
                );
                return false;
            }
        }
        true
    }

    /// Whether there is room for a node of this path; else a fault is noted.
    pub(super) fn take_path(&mut self, path: &str, file: &str, findings: &mut Findings) -> bool {
        // A node takes room even if it has no mesh.
        if !self.take(1, file, findings) {
            return false;
        }
        match self.path_bytes.checked_sub(path.len()) {
            Some(left) => self.path_bytes = left,
            None => {
                let cause = "the names of its nodes, with those of the nodes above, are longer than 64 MiB";
                self.refuse(
                    file,
                    cause.to_owned(),
                    "give nodes shorter names, or flatten the tree",
                    findings,
                );
                return false;
            }
        }
        true
    }

    /// Tells the first time that there is no room; nothing has room afterwards.
    fn refuse(&mut self, path: &str, cause: String, cure: &str, findings: &mut Findings) {
        if findings.faults.iter().all(|fault| fault.rule != "too-many-copies") {
            findings.fault(path, "too-many-copies", cause, cure);
        }
        (self.corners, self.path_bytes) = (0, 0);
    }
}
