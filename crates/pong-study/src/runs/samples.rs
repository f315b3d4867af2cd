//! Folders, models and scenes of tests.

use std::path::PathBuf;

/// A folder of the test's own, removed afterwards.
pub(crate) struct Folder(pub PathBuf);

impl Folder {
    pub fn new(test: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("pong_study_{test}_{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    pub fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
        path
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A model with one surface.
pub(crate) fn model(name: &str, root: &str) -> String {
    format!(
        "(format: \"pong-model\", version: 1, name: \"{name}\", surfaces: {{ \"s\": (stiffness: 1e5, friction: Bristle(mu: 0.4)) }},\n    \
         root: (name: \"{name}\", surface: \"s\", {root}))\n"
    )
}

/// A scene of a free model above or beside a fixed one.
pub(crate) fn scene(folder: &Folder, moving: (&str, &str), fixed: (&str, &str), start: &str) -> PathBuf {
    for (name, root) in [moving, fixed] {
        folder.write(&format!("{name}.ron"), &model(name, root));
    }
    let (a, b) = (moving.0, fixed.0);
    folder.write(
        "scene.ron",
        &format!(
            "(format: \"pong-scene\", version: 1, name: \"{a} and {b}\", models: {{ \"{a}\": \"{a}.ron\", \"{b}\": \"{b}.ron\" }},\n\
             objects: [(name: \"{a}\", model: \"{a}\", bodies: [(motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3), {start})]),\n\
             (name: \"{b}\", model: \"{b}\", bodies: [(motion: Fixed)])], pairs: [(\"{a}\", \"{b}\")],\n\
             integrator: SemiImplicitEuler, step: 1e-3, duration: 0.1)"
        ),
    )
}
