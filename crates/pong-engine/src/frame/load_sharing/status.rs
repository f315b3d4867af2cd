//! Status of a contact candidate: who sets it, and in which order.
//!
//! A tester sets the first status:
//!
//! | status | by |
//! |---|---|
//! | `Front` | every tester, unless a row below applies |
//! | `BackFace`, `Fallback`, `BackFaceFallback` | spheres, ellipsoids and ends of capsules against triangles |
//! | `StandIn` | ellipsoids against triangles and polyhedra; ends of segments that leave a polyhedron |
//! | `AtWall`, `BeyondWall` | points, spheres, ends of capsules and of segments in polyhedra |
//!
//! The passes of load sharing follow, in this order. A pass has one of three effects: it drops a candidate
//! (*culled*), makes it one that is remembered and does not push (*tracked*: its role, not its status), or
//! makes a fallback regular (*regular*: `Front`, or `BackFace` after `BackFaceFallback`). The end spheres of
//! a capsule count as spheres in this table; passes 8 and 9 run after the other passes have run on both ends.
//!
//! | # | pass | applies to | judges | effect |
//! |---|---|---|---|---|
//! | 1 | `keep_first_ray_hits` | rays | any | culled |
//! | 2 | `keep_one_side_of_rims` | spheres, ellipsoids, capsules | contacts of backs at edges and vertices | culled |
//! | 3 | `cull_opposite_at_points` | the same | opposite to a `BackFace` or `BackFaceFallback` face | culled |
//! | 4 | `choose_piece_at_walls`, `choose_piece_of_end_at_walls` | points, spheres; segments | `AtWall`, `BeyondWall`; of segments also exits that are `StandIn`, and all contacts with the same deepest point | culled |
//! | 5 | `resolve_fallbacks` | contacts that share a spring | `Fallback`, `BackFaceFallback` | regular or culled |
//! | 6 | `drop_what_the_body_lacks`; `drop_second_of_edges`; `drop_deeper_faces` | ellipsoid and polyhedron; sphere and polyhedron; ellipsoid and triangle | any | culled; culled or tracked (the second with a face of entry, the third if `BackFace`) |
//! | 7 | `drop_deeper_of_convex_faces`; `cull_idle_stand_ins` | the same | faces that are `BackFace`; `StandIn` | tracked; culled |
//! | 8 | `couple`; on triangles `axes::share` | capsules | contacts between the ends; all of the capsule | culled; new contacts |
//! | 9 | `drop_idle` | the same | without weight | tracked with a face of entry or as `BackFace`, otherwise culled |
//!
//! With a surface that B's model declares (`joint.rs`), passes 4 to 6 run on the candidates of each kind of B, exits of
//! segments into another primitive of the surface are culled after pass 4, and what is left shares one spring.
//!
//! A single candidate skips all passes, unless it lies between the ends of a capsule; if it is `BeyondWall`,
//! it is culled. After the frame's contacts are in order, the first hit of a ray among several movable groups
//! culls the other hits (`output/order.rs`). No pass makes a culled candidate count again.

/// Status of a contact candidate among all candidates of the same surface.
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
    /// Fallback for a face whose foot point lies outside the face: on triangles used only if no regular
    /// contact is as deep, on a polyhedron only if there is no regular contact.
    ///
    /// For a segment: fallback for an exit at the boundary edge of an internal face, if rounding lets the
    /// segment leave through the internal face instead of the active face. Used if no other piece reports
    /// this end, and none contains the segment beyond the exit.
    StandIn,
    /// Point or segment end in a piece, on an internal face or on the boundary edge of an internal face; used
    /// unless a piece of lower index has the same contact. Also an exit of a segment next to an internal
    /// face, of which only one piece may have a contact.
    AtWall,
    /// Point or segment end outside a piece, on the far side of an internal face within its tolerance; used
    /// only if rounding leaves the point in no piece.
    BeyondWall,
    /// Dropped.
    Culled,
}
