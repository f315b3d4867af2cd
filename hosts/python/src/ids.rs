//! Models, Objects, pairs and Interfaces of a world, and their forms as arguments.

use crate::arrays::refused;
use crate::errors::{bad_value, of_engine};
use pong_engine::{InterfaceId, ModelId, ObjectId, PairId, Scene};
use pyo3::prelude::*;

macro_rules! handle {
    ($(#[$doc:meta])* $name:ident, $id:ident) => {
        $(#[$doc])*
        #[pyclass(frozen, eq, hash, module = "pong.types")]
        #[derive(Clone, PartialEq, Eq, Hash)]
        pub(crate) struct $name {
            pub id: $id,
            /// str : Name.
            #[pyo3(get)]
            pub name: String,
        }

        #[pymethods]
        impl $name {
            /// int : Index among those of its kind in its world, from 0.
            #[getter]
            fn index(&self) -> usize {
                self.id.index()
            }

            fn __repr__(&self) -> String {
                format!(concat!("<pong.", stringify!($name), " {:?}>"), self.name)
            }
        }
    };
}

handle!(
    /// A model added to a world.
    AddedModel,
    ModelId
);
handle!(
    /// An Object: an instance of a model in a world.
    Object,
    ObjectId
);
handle!(
    /// Two Objects that are tested against each other.
    Pair,
    PairId
);
handle!(
    /// An Interface: the state in and the wrench out of one movable group of an Object. `name` is `object/path`.
    Interface,
    InterfaceId
);

/// An Object, or its name.
#[derive(FromPyObject)]
pub(crate) enum ObjectRef<'py> {
    Id(PyRef<'py, Object>),
    Name(String),
    Other(Bound<'py, PyAny>),
}

impl ObjectRef<'_> {
    /// Its id in a world.
    pub fn resolve(&self, scene: &Scene) -> PyResult<ObjectId> {
        match self {
            Self::Id(object) => Ok(object.id),
            Self::Name(name) => scene.object(name).map_err(of_engine),
            Self::Other(given) => {
                Err(refused("object", given, "give what `create_object` returned, or its name"))
            }
        }
    }
}

/// An Interface of a world, with its name.
pub(crate) fn interface(scene: &Scene, id: InterfaceId) -> PyResult<Interface> {
    let name = scene.interface_name(id).map_err(of_engine)?;
    Ok(Interface { id, name })
}

/// All Objects of a world.
pub(crate) fn objects(scene: &Scene) -> PyResult<Vec<Object>> {
    let object = |id| Ok(Object { id, name: scene.object_name(id).map_err(of_engine)?.to_owned() });
    scene.objects().map(object).collect()
}

/// All models of a world.
pub(crate) fn models(scene: &Scene) -> Vec<AddedModel> {
    scene.models().map(|(id, model)| AddedModel { id, name: model.name.clone() }).collect()
}

/// Error for a number that no Interface of a world has.
pub(crate) fn no_interface(number: usize, count: usize) -> PyErr {
    let cause = format!("there is no Interface {number}, the world has {count}");
    bad_value("interface", cause, "take the number from a contact")
}

/// All Interfaces of a world, in the order of the rows of arrays.
pub(crate) fn interfaces(scene: &Scene) -> PyResult<Vec<Interface>> {
    let mut all = Vec::new();
    for object in scene.objects() {
        for id in scene.interfaces(object).map_err(of_engine)? {
            all.push(interface(scene, id)?);
        }
    }
    Ok(all)
}

/// All pairs of a world, named `a, b`.
pub(crate) fn pairs(scene: &Scene) -> PyResult<Vec<Pair>> {
    let name = |object: ObjectId| scene.object_name(object).map(str::to_owned).map_err(of_engine);
    let pair =
        |(id, [a, b]): (PairId, [ObjectId; 2])| Ok(Pair { id, name: format!("{}, {}", name(a)?, name(b)?) });
    scene.pairs().map(pair).collect()
}
