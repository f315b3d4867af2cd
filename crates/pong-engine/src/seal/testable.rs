//! Testable pairs of primitives: by the tester table, or by a test that the host registered.

use crate::frame::narrow_phase::pair_table::has_tester;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Extensions, MovableGroup, PrimitiveInfo};

/// Name of a primitive's kind; a custom kind has its own name.
pub(crate) fn kind_name<'a>(body: &'a MovableGroup, info: &PrimitiveInfo) -> &'a str {
    match info.kind {
        PrimitiveKind::Custom => body.customs[info.elements.start as usize].kind_name(),
        kind => kind.name(),
    }
}

/// Returns true if a primitive can be tested as A against another as B.
pub(crate) fn can_be_tested(
    extensions: &Extensions,
    a: (&MovableGroup, &PrimitiveInfo),
    b: (&MovableGroup, &PrimitiveInfo),
) -> bool {
    has_tester(a.1.kind, b.1.kind)
        || extensions.contact_test(kind_name(a.0, a.1), kind_name(b.0, b.1)).is_some()
}
