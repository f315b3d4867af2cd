//! Models: from a file or from text.

use crate::failure::Failure;
use crate::failure::Outcome;
use crate::guard::{get, with_world};
use crate::handle::{Inner, pong_world};
use crate::ids::pong_model_id;
use crate::memory;
use crate::names::text_at;
use crate::pointers::{Out, array, text};
use crate::status::pong_status;
use pong_geometry::{Pose, Vec3};
use pong_model::{Model, PlacedFile, common_folder, join_files};
use pong_record::ModelSource;
use std::ffi::c_char;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Loads a model file (UTF-8 path); meshes are looked for beside it. One model serves any number of Objects.
/// Before sealing. PONG_STATUS_MODEL_ERROR: the message has one line for every fault, with file, line and
/// column. PONG_STATUS_OUT_OF_MEMORY, of this and every other call of set-up: the message has the size that
/// was asked for.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_load_model(
    world: *mut pong_world,
    path: *const c_char,
    model: *mut pong_model_id,
) -> pong_status {
    with_world(world, |inner| {
        let (path, out) = (text(path, "path")?, Out::new(model, "model")?);
        memory::require_for_file(Path::new(path))?;
        let loaded = pong_model::load(Path::new(path), inner.phase.scene().extensions())?;
        out.set(inner.add_model(loaded, ModelSource::File(Path::new(path).to_owned()))?);
        Ok(())
    })
}

/// Loads a model from `length` bytes of UTF-8 text; it needs no zero byte at its end. Errors call it `name`.
/// Meshes in files of their own are looked for in `mesh_dir`; with NULL they are refused. Otherwise as
/// pong_load_model().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_load_model_text(
    world: *mut pong_world,
    text: *const c_char,
    length: usize,
    name: *const c_char,
    mesh_dir: *const c_char,
    model: *mut pong_model_id,
) -> pong_status {
    with_world(world, |inner| {
        if text.is_null() {
            return Err(Failure::new(pong_status::NullArgument, "`text` is NULL; pass the text of a model"));
        }
        let bytes = array(text.cast::<u8>(), length, "text")?;
        memory::require_small()?;
        let name = crate::pointers::text(name, "name")?;
        let mesh_dir =
            if mesh_dir.is_null() { None } else { Some(crate::pointers::text(mesh_dir, "mesh_dir")?) };
        let out = Out::new(model, "model")?;
        let Ok(text) = std::str::from_utf8(bytes) else {
            let message = format!("{name}: the text is not UTF-8; save the model as UTF-8");
            return Err(Failure::new(pong_status::ModelError, message));
        };
        memory::require_for_text(bytes, mesh_dir.map(Path::new))?;
        let loaded =
            pong_model::parse(text, name, mesh_dir.map(Path::new), inner.phase.scene().extensions())?;
        let source = ModelSource::Text { text: text.to_owned(), mesh_dir: mesh_dir.map(PathBuf::from) };
        out.set(inner.add_model(loaded, source)?);
        Ok(())
    })
}

/// Loads `count` model files that never move relative to each other as one model, as `pong join` does: the root of
/// each becomes a group of the new root, and with `one_surface` other than 0 flush faces of the root's rigid body are one
/// surface. `poses` has the place of each root in the frame of the new one: the position in m, and the quaternion
/// (w, x, y, z). NULL leaves all roots in one place. A file may be named several times. Errors call the new model
/// `name`. Before sealing. PONG_STATUS_MODEL_ERROR: a file has faults, or they cannot be joined.
/// PONG_STATUS_BAD_VALUE: a number is not finite, or a quaternion has not the length 1 within 1e-3.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_load_joined_models(
    world: *mut pong_world,
    paths: *const *const c_char,
    poses: *const [f64; 7],
    count: usize,
    name: *const c_char,
    one_surface: i32,
    model: *mut pong_model_id,
) -> pong_status {
    with_world(world, |inner| {
        let (paths, name) = (array(paths, count, "paths")?, text(name, "name")?);
        let poses = if poses.is_null() { None } else { Some(array(poses, count, "poses")?) };
        let out = Out::new(model, "model")?;
        let mut files = Vec::with_capacity(count);
        for (index, path) in paths.iter().enumerate() {
            let path = PathBuf::from(text(*path, "paths[i]")?);
            memory::require_for_file(&path)?;
            let pose = poses.map_or(Ok(Pose::identity()), |poses| pose_of(index, &poses[index]))?;
            files.push(PlacedFile { path, pose });
        }
        let folder = common_folder(&files);
        let mesh_dir = folder.as_deref().unwrap_or(Path::new(""));
        let extensions = inner.phase.scene().extensions();
        let text = join_files(name, &files, mesh_dir, one_surface != 0, extensions)
            .map_err(|error| Failure::new(pong_status::ModelError, error.to_string()))?;
        memory::require_for_text(text.as_bytes(), Some(mesh_dir))?;
        let loaded = pong_model::parse(&text, name, Some(mesh_dir), extensions)?;
        out.set(inner.add_model(loaded, ModelSource::Text { text, mesh_dir: folder })?);
        Ok(())
    })
}

/// Pose of numbers from C; refuses numbers that no pose has.
fn pose_of(index: usize, numbers: &[f64; 7]) -> Outcome<Pose> {
    let [x, y, z, q @ ..] = *numbers;
    let norm = q.iter().map(|q| q * q).sum::<f64>().sqrt();
    if !numbers.iter().all(|number| number.is_finite()) || (norm - 1.0).abs() > 1e-3 {
        let message = format!(
            "`poses[{index}]`: the quaternion has the length {norm}, or a number is not finite; give x, y, z in m and a \
             quaternion w, x, y, z of length 1"
        );
        return Err(Failure::new(pong_status::BadValue, message));
    }
    Ok(Pose::new(Vec3::new(x, y, z), q))
}

/// Lets models loaded from now on also read meshes from `folder` (UTF-8 path) and the folders below it. Without
/// it a mesh that lies outside the model's own folder, through a link, is refused. Before sealing; may be
/// called for several folders.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_allow_files_below(
    world: *mut pong_world,
    folder: *const c_char,
) -> pong_status {
    with_world(world, |inner| {
        let folder = text(folder, "folder")?;
        inner.phase.set_up("allow a folder")?.allow_files_below(folder);
        Ok(())
    })
}

impl Inner {
    fn add_model(&mut self, model: Model, source: ModelSource) -> Outcome<pong_model_id> {
        let model = Arc::new(model);
        let id = self.phase.set_up("add a model")?.add_model(Arc::clone(&model));
        self.names.add_model(id, &model);
        self.sources.push(source);
        Ok(id.into())
    }
}

/// Number of warnings that loading a model gave: a valid model may still have something that its author should
/// know.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_model_warning_count(
    world: *const pong_world,
    model: pong_model_id,
    count: *mut usize,
) -> pong_status {
    get(world, (count, "count"), |inner| Ok(inner.names.model(model)?.warnings.len()))
}

/// Returns a warning of a model; `index` counts from 0. The text lives as long as the world.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_model_warning(
    world: *const pong_world,
    model: pong_model_id,
    index: usize,
    warning: *mut *const c_char,
) -> pong_status {
    get(world, (warning, "warning"), |inner| text_at("warning", &inner.names.model(model)?.warnings, index))
}
