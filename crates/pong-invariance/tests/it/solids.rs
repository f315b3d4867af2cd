//! Small surveys of solids that touch by volume.

use super::invariances::nothing_differs;
use pong_invariance::make::volumes;

#[test]
fn solids_agree_with_their_twins() {
    for (name, ..) in volumes::FAMILIES {
        nothing_differs(&[], Some(name), 200);
    }
}

#[test]
fn solids_with_other_group_axes() {
    nothing_differs(&["group_frame"], Some("solid_on_plane"), 200);
}
