//! Primitive whose fields are open.

use super::fields::Fields;
use crate::draft::BodyDraft;
use pong_geometry::Transform;

/// Primitive being read.
pub(super) struct Primitive<'n, 'd> {
    pub(super) fields: Fields<'n>,
    pub(super) at: u32,
    pub(super) path: String,
    pub(super) x: Transform,
    pub(super) draft: &'d mut BodyDraft,
}
