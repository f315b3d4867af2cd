//! Status of a contact candidate: who sets it, and in which order.
//!
//! A tester sets the first status:
//!
//! | status | by |
//! |---|---|
//! | `Front` | every tester, unless a row below applies |
//! | `BackFace`, `Fallback`, `BackFaceFallback` | spheres, ellipsoids and ends of capsules against triangles |
//! | `StandIn` | the same; ellipsoids against polyhedra; ends of segments that leave a polyhedron |
//! | `AtWall`, `BeyondWall` | points, spheres, ends of capsules and of segments in polyhedra |
//!
//! The passes of load sharing follow, in this order. A pass has one of three effects: it drops a candidate
//! (*culled*), makes it one that is remembered and does not push (*tracked*: its role, not its status), or
//! makes a fallback regular (*regular*: `Front`, or `BackFace` after `BackFaceFallback`). The ends of a
//! capsule are spheres here; passes 8 and 9 follow the others for both of them.
//!
//! | # | pass | applies to | judges | effect |
//! |---|---|---|---|---|
//! | 1 | `keep_first_ray_hits` | rays | any | culled |
//! | 2 | `keep_one_side_of_rims` | spheres, ellipsoids, capsules | contacts of backs at edges and vertices | culled |
//! | 3 | `keep_one_way_at_places` | the same | opposite to a `BackFace` or `BackFaceFallback` face | culled |
//! | 4 | `choose_piece_at_walls`, `choose_piece_of_end_at_walls` | points, spheres; segments | `AtWall`, `BeyondWall`; of segments also exits that are `StandIn`, and what has the same end point | culled |
//! | 5 | `settle_fallbacks` | several that share | `Fallback`, `BackFaceFallback` | regular or culled |
//! | 6 | `drop_what_the_body_lacks`; `drop_second_of_edges`; `drop_deeper_faces` | ellipsoid and polyhedron; sphere and polyhedron; ellipsoid and triangle | any | culled; culled or tracked (the second with a face of entry, the third if `BackFace`) |
//! | 7 | `drop_deeper_of_convex_faces`; `cull_idle_stand_ins` | several that share | faces that are `BackFace`; `StandIn` | tracked; culled |
//! | 8 | `couple` | capsules | contacts between the ends | culled |
//! | 9 | `drop_idle` | several that share | without weight | tracked with a face of entry or as `BackFace`, otherwise culled |
//!
//! A candidate that is alone takes none of them, unless it lies between the ends of a capsule; if it is
//! `BeyondWall`, it is culled. After the frame's contacts are in order, the first hit of a ray among several
//! movable groups culls the others (`output/order.rs`). No pass makes a culled candidate count again.

/// Standing of a candidate among those of the same surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CandidateStatus {
    /// Regular contact, with the centre in front.
    Front,
    /// Regular contact, with the centre behind the face.
    BackFace,
    /// Fallback for a contact lost to rounding; used only if no regular contact is at the same point.
    Fallback,
    /// Fallback with the centre behind the face.
    BackFaceFallback,
    /// Fallback for a feature whose foot point lies just outside it by rounding; used only if no regular
    /// contact is as deep. For a segment: an exit through an internal face, within rounding of its boundary
    /// edge.
    StandIn,
    /// Point or segment end in a piece, on an internal face or on the boundary edge of one; used unless a
    /// piece of lower index has the same contact. Also the exit of a segment next to an internal face, which
    /// only one piece carries.
    AtWall,
    /// Point or segment end just beyond an internal face of a piece; used only if rounding leaves it in no
    /// piece.
    BeyondWall,
    /// Dropped.
    Culled,
}
