//! Distance of two movable groups, as Python sees it.

use pong_engine::{GroupDistance, NearestPrimitive};
use pyo3::prelude::*;

/// Distance of two movable groups.
#[pyclass(frozen, eq, module = "pong.types", get_all)]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Distance {
    /// float : Smallest distance of two primitives that have a contact test with each other, m: 0 if such overlap, infinite if there are
    /// none.
    distance: f64,
    /// list of list of float or None : Nearest points of the two, m, in the common frame; `None` if the distance is infinite. If primitives overlap, some points
    /// near.
    points: Option<[[f64; 3]; 2]>,
    /// list of int or None : Numbers of the nearest primitives, as `primitive_path` takes them; `None` if the distance is infinite.
    primitives: Option<[u32; 2]>,
    /// list of int or None : Elements within the primitives: a mesh's triangles, from 0; 0 for all other kinds.
    elements: Option<[u32; 2]>,
}

#[pymethods]
impl Distance {
    fn __repr__(&self) -> String {
        format!("<pong.Distance {} m>", self.distance)
    }
}

impl From<GroupDistance> for Distance {
    fn from(found: GroupDistance) -> Self {
        let of = |part: fn(&NearestPrimitive) -> u32| {
            found.nearest.as_ref().map(|both| [part(&both[0]), part(&both[1])])
        };
        Self {
            distance: found.distance,
            points: found.nearest.map(|both| both.map(|side| side.point.into())),
            primitives: of(|side| side.primitive),
            elements: of(|side| side.element),
        }
    }
}
