//! Readers of OBJ and STL. Public for `pong-import`, which reads by the same rules; not a stable interface.

mod obj;
mod stl;
mod text;

pub use obj::{Obj, ObjObject, obj};
pub use stl::{STL_HEAD, STL_TRIANGLE, Stl, stl};
pub use text::{FormatFault, text};
