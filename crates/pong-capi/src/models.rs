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
use pong_model::Model;
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
