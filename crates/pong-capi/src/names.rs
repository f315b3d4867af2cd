//! Names as C strings, kept for the world's life.

use crate::failure::{Failure, Outcome};
use crate::ids::{pong_interface_id, pong_model_id, pong_object_id};
use crate::status::pong_status;
use pong_engine::{InterfaceId, ModelId, ObjectId};
use pong_model::Model;
use std::cell::Cell;
use std::collections::HashMap;
use std::ffi::{CString, c_char};
use std::sync::Arc;

/// All names. A `CString` keeps its buffer when the collection around it grows, so its pointer stays valid.
#[derive(Clone, Default)]
pub(crate) struct Names {
    models: HashMap<u64, Arc<ModelNames>>,
    objects: HashMap<u64, CString>,
    interfaces: HashMap<u64, InterfaceNames>,
    /// Number of lists of Interfaces checked so far.
    lists: Cell<u64>,
}

/// Names of a model.
pub(crate) struct ModelNames {
    pub warnings: Vec<CString>,
    pub surfaces: Vec<CString>,
    bodies: Vec<BodyNames>,
}

struct BodyNames {
    path: CString,
    primitives: Vec<CString>,
}

/// Indices of the names of an Interface.
#[derive(Clone)]
struct InterfaceNames {
    object: ObjectId,
    model: Arc<ModelNames>,
    body: usize,
    /// The list that last named it.
    listed: Cell<u64>,
}

impl Names {
    pub fn add_model(&mut self, id: ModelId, model: &Model) {
        let bodies = model.bodies.iter().map(|body| BodyNames {
            path: c_text(&body.path),
            primitives: body.primitives.iter().map(|primitive| c_text(&primitive.path)).collect(),
        });
        let names = ModelNames {
            warnings: model.warnings.iter().map(|warning| c_text(warning)).collect(),
            surfaces: model.surfaces.iter().map(|surface| c_text(&surface.name)).collect(),
            bodies: bodies.collect(),
        };
        self.models.insert(id.to_bits(), Arc::new(names));
    }

    pub fn add_object(&mut self, id: ObjectId, name: &str, model: ModelId, interfaces: &[InterfaceId]) {
        self.objects.insert(id.to_bits(), c_text(name));
        let Some(model) = self.models.get(&model.to_bits()) else { return };
        for (body, interface) in interfaces.iter().enumerate() {
            let names = InterfaceNames { object: id, model: Arc::clone(model), body, listed: Cell::new(0) };
            self.interfaces.insert(interface.to_bits(), names);
        }
    }

    pub fn model(&self, id: pong_model_id) -> Outcome<&ModelNames> {
        self.models.get(&id.bits).map(Arc::as_ref).ok_or_else(|| unknown("model"))
    }

    /// Number of movable groups of a model.
    pub fn group_count(&self, id: pong_model_id) -> Outcome<usize> {
        Ok(self.model(id)?.bodies.len())
    }

    pub fn object(&self, id: pong_object_id) -> Outcome<&CString> {
        self.objects.get(&id.bits).ok_or_else(|| unknown("object"))
    }

    pub fn interface_count(&self) -> usize {
        self.interfaces.len()
    }

    pub fn has_interface(&self, id: pong_interface_id) -> bool {
        self.interfaces.contains_key(&id.bits)
    }

    /// Index, in a list, of the first id that is no Interface or that occurs earlier in the list.
    pub fn unknown_or_named_twice(&self, ids: &[pong_interface_id]) -> Option<usize> {
        let list = self.lists.get() + 1;
        self.lists.set(list);
        let is_listed = |interface: &InterfaceNames| interface.listed.replace(list) == list;
        ids.iter().position(|id| self.interfaces.get(&id.bits).is_none_or(is_listed))
    }

    pub fn object_of(&self, id: pong_interface_id) -> Outcome<ObjectId> {
        Ok(self.interface(id)?.object)
    }

    pub fn path(&self, id: pong_interface_id) -> Outcome<&CString> {
        Ok(&self.body(id)?.path)
    }

    pub fn primitives(&self, id: pong_interface_id) -> Outcome<&[CString]> {
        Ok(&self.body(id)?.primitives)
    }

    fn body(&self, id: pong_interface_id) -> Outcome<&BodyNames> {
        let interface = self.interface(id)?;
        Ok(&interface.model.bodies[interface.body])
    }

    fn interface(&self, id: pong_interface_id) -> Outcome<&InterfaceNames> {
        self.interfaces.get(&id.bits).ok_or_else(|| unknown("interface"))
    }
}

/// Failure for an unknown id.
pub(crate) fn unknown(what: &str) -> Failure {
    let message =
        format!("{what}: the id is zero, stale or of another world; use an id that this world returned");
    Failure::new(pong_status::UnknownId, message)
}

/// Text at an index of a list; it lives as long as the list.
pub(crate) fn text_at(what: &str, texts: &[CString], index: usize) -> Outcome<*const c_char> {
    texts.get(index).map(|text| text.as_ptr()).ok_or_else(|| no_such(what, index, texts.len()))
}

/// Failure for an index out of range.
pub(crate) fn no_such(what: &str, index: usize, count: usize) -> Failure {
    let message = format!("{what} {index}: there are {count}, counted from 0; ask for the count first");
    Failure::new(pong_status::UnknownId, message)
}

/// Text as a C string; a zero byte inside becomes a question mark.
pub(crate) fn c_text(text: &str) -> CString {
    CString::new(text.replace('\0', "?")).unwrap_or_default()
}
