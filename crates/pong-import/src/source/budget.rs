//! Limits on the size of an import: a short file can instance one mesh many times.

use crate::findings::Findings;

/// Bytes of the paths of all nodes, unless the file is longer: each path repeats the names of the nodes
/// above.
const PATH_BYTES: usize = 64 << 20;

/// Remaining budget of a file.
pub(super) struct Budget {
    corners: usize,
    path_bytes: usize,
    triangles_max: usize,
}

impl Budget {
    /// Budget of a file of this length, with its buffers. Every corner of a mesh takes at least a byte, so a
    /// file that uses each mesh once stays within its length.
    pub(super) fn new(triangles_max: usize, length: usize) -> Self {
        let corners = triangles_max.saturating_mul(3).max(length);
        Self { corners, path_bytes: PATH_BYTES.max(length), triangles_max }
    }

    /// Reserves room for a mesh of so many corners or vertices; notes a fault and returns false if there is
    /// none.
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

    /// Reserves room for a node of this path; notes a fault and returns false if there is none.
    pub(super) fn take_path(&mut self, path: &str, file: &str, findings: &mut Findings) -> bool {
        // A node takes room even without a mesh.
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

    /// Reports the first time that there is no room; all later requests fail.
    fn refuse(&mut self, path: &str, cause: String, cure: &str, findings: &mut Findings) {
        if findings.faults.iter().all(|fault| fault.rule != "too-many-copies") {
            findings.fault(path, "too-many-copies", cause, cure);
        }
        (self.corners, self.path_bytes) = (0, 0);
    }
}
