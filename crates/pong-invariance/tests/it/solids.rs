//! Small surveys of solids that touch by volume, and of moving and declared surfaces.

use super::invariances::{does_not_differ, nothing_differs};
use pong_invariance::make::{belts, volumes};

#[test]
fn solids_agree_with_their_twins() {
    // Meshes on meshes take long and have a test below.
    for (name, ..) in volumes::FAMILIES.iter().filter(|(name, ..)| *name != "mesh_on_mesh") {
        nothing_differs(&[], Some(name), 200);
    }
}

#[test]
fn solids_with_other_group_axes() {
    nothing_differs(&["group_frame"], Some("solid_on_plane"), 200);
}

#[test]
fn moving_and_declared_surfaces_agree_with_their_twins() {
    for (name, ..) in belts::FAMILIES {
        nothing_differs(&[], Some(name), 60);
    }
}

#[test]
fn driven_belts_are_driven_planes() {
    for name in ["belt", "solid_on_belt"] {
        nothing_differs(&["driven", "group_frame"], Some(name), 300);
    }
}

#[test]
fn declared_pieces_are_the_whole() {
    nothing_differs(&["declared"], Some("solid"), 300);
}

#[test]
fn joints_in_another_order() {
    nothing_differs(&["reordered", "turned"], Some("joint"), 300);
}

#[test]
fn meshes_in_another_order() {
    nothing_differs(&["reordered", "turned", "scaled", "group_frame"], Some("mesh_on_mesh"), 300);
}

/// Scenes of long runs that differed once.
#[test]
fn scenes_of_solids_that_once_differed() {
    let told = [
        // A region that ends in a ridge exactly in the opposite face: rounding decided whether that face bounded it.
        ("group_frame", "mesh_on_mesh", 374),
        // Two pieces that touched along the edge of a wall, within rounding, began their bristle there or a frame later.
        ("moved", "l_on_l", 1960),
    ];
    for (name, family, index) in told {
        does_not_differ(name, Some(family), 1, index);
    }
}
