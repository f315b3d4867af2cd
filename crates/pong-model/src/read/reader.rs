//! State shared by all parts of the reading: the text, the caller's extensions, and all faults found.

use crate::error::ModelError;
use crate::extensions::Extensions;
use crate::ron_tree::SyntaxError;
use crate::surface::Surface;
use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::path::Path;

/// Number of faults listed per mesh; further ones are only counted.
pub(crate) const LISTED_PER_MESH: usize = 20;

/// Text being read and all faults found in it.
pub(crate) struct Reader<'a> {
    text: &'a str,
    file: &'a str,
    pub(crate) mesh_dir: Option<&'a Path>,
    pub(crate) ext: &'a Extensions,
    /// True if shapes are judged and mesh files read; false if only notation, fields, types, names and
    /// indices are.
    pub(crate) judges_shapes: bool,
    /// Faults with their byte offsets.
    faults: Vec<(u32, ModelError)>,
    /// Byte offset of each line; computed for the first warning.
    line_starts: OnceCell<Vec<u32>>,
    pub(crate) warnings: Vec<String>,
    /// Surfaces by name; built at the first look-up.
    surfaces: OnceCell<BTreeMap<String, u32>>,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(text: &'a str, file: &'a str, mesh_dir: Option<&'a Path>, ext: &'a Extensions) -> Self {
        Self {
            text,
            file,
            mesh_dir,
            ext,
            judges_shapes: true,
            faults: Vec::new(),
            line_starts: OnceCell::new(),
            warnings: Vec::new(),
            surfaces: OnceCell::new(),
        }
    }

    /// Reports a fault.
    pub(crate) fn fault(
        &mut self,
        at: u32,
        path: &str,
        rule: &'static str,
        cause: impl Into<String>,
        cure: impl Into<String>,
    ) {
        let error = ModelError {
            file: self.file.to_owned(),
            // Computed for all faults together at the end.
            line: 0,
            column: 0,
            path: path.to_owned(),
            rule,
            cause: cause.into(),
            cure: cure.into(),
        };
        self.faults.push((at, error));
    }

    /// Reports a fault and returns `None`.
    pub(crate) fn refuse<T>(
        &mut self,
        at: u32,
        path: &str,
        rule: &'static str,
        cause: impl Into<String>,
        cure: impl Into<String>,
    ) -> Option<T> {
        self.fault(at, path, rule, cause, cure);
        None
    }

    pub(crate) fn syntax_fault(&mut self, error: SyntaxError) {
        let cure = match error.rule {
            "too-deep" => "flatten the tree of groups",
            "text-too-long" => "keep large meshes in files of their own (OBJ or STL)",
            _ => "correct the notation; nothing behind this place was read",
        };
        self.fault(error.at, "model", error.rule, error.cause, cure);
    }

    pub(crate) fn warn(&mut self, at: u32, path: &str, what: &str) {
        let line = self.line(at);
        self.warnings.push(format!("{}:{line}: {path}: {what}", self.file));
    }

    /// First surface with that name. Every call must pass the same list.
    pub(crate) fn surface_called(&self, surfaces: &[Surface], name: &str) -> Option<u32> {
        let by_name = self.surfaces.get_or_init(|| {
            let named = surfaces.iter().zip(0..surfaces.len() as u32).rev();
            named.map(|(surface, index)| (surface.name.clone(), index)).collect()
        });
        by_name.get(name).copied()
    }

    pub(crate) fn fault_count(&self) -> usize {
        self.faults.len()
    }

    /// All faults, in file order.
    pub(crate) fn into_faults(mut self) -> Vec<ModelError> {
        self.faults.sort_by_key(|(at, _)| *at);
        self.place_faults();
        self.faults.into_iter().map(|(_, error)| error).collect()
    }

    /// Computes lines and columns of the sorted faults in one pass over the text: counting from the start of
    /// the line for each fault would be quadratic for a file in a single line.
    fn place_faults(&mut self) {
        let (mut here, mut line, mut column) = (0, 1, 1);
        for (at, error) in &mut self.faults {
            let end = self.text.floor_char_boundary(*at as usize);
            for c in self.text[here..end].chars() {
                (line, column) = if c == '\n' { (line + 1, 1) } else { (line, column + 1) };
            }
            here = end;
            (error.line, error.column) = (line, column);
        }
    }

    fn line(&self, at: u32) -> u32 {
        let starts = self.line_starts.get_or_init(|| {
            let breaks = self.text.bytes().enumerate().filter(|&(_, byte)| byte == b'\n');
            std::iter::once(0).chain(breaks.map(|(at, _)| at as u32 + 1)).collect()
        });
        starts.partition_point(|&start| start <= at) as u32
    }
}
