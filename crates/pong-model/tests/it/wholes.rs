//! Convex solids that several pieces form together.

use crate::common::{cube, load, model_of};
use pong_model::{Item, MovableGroup};

fn body(pieces: &[String]) -> MovableGroup {
    load(&model_of(&pieces.join(","))).bodies[0].clone()
}

/// Sizes of the one solid of several pieces: faces, edges and vertices; `None` if there is none.
fn whole(body: &MovableGroup) -> Option<[usize; 3]> {
    let [whole] = &body.wholes[..] else { return None };
    assert!(whole.solid.planes().all_active);
    let first = Item { primitive: whole.primitive, element: 0 };
    for piece in 0..body.primitives.len() as u32 {
        let (stands, solid) = body.convex_solid(Item { primitive: piece, element: piece }).unwrap();
        assert_eq!((stands, solid), (first, &whole.solid));
    }
    Some([whole.solid.faces.len(), whole.solid.edges.len(), whole.solid.vertices.len()])
}

#[test]
fn pieces_with_a_convex_union_are_one_solid() {
    let (left, right) =
        (cube("l", [0.0; 3], [1.0; 3], "[3]"), cube("r", [1.0, 0.0, 0.0], [3.0, 1.0, 1.0], "[5]"));
    assert_eq!(whole(&body(&[left.clone(), right.clone()])), Some([6, 12, 8]));
    // Two pieces below one: their joint ends within its face.
    let below = [
        cube("l", [0.0; 3], [1.0; 3], "[3,1]"),
        cube("r", [1.0, 0.0, 0.0], [3.0, 1.0, 1.0], "[5,1]"),
        cube("t", [0.0, 0.0, 1.0], [3.0, 1.0, 1.5], "[0]"),
    ];
    assert_eq!(whole(&body(&below)), Some([6, 12, 8]));
    let solid = &body(&below).wholes[0].solid;
    assert!(solid.faces.iter().all(|face| face.normal.amax() == 1.0));
}

#[test]
fn other_pieces_stay_as_they_are() {
    let alone = |pieces: &[String]| {
        let body = body(pieces);
        assert!(body.wholes.is_empty());
        body.convex_solid(Item { primitive: 0, element: 0 }).is_some()
    };
    assert!(alone(&[cube("l", [0.0; 3], [1.0; 3], "[]")]));
    let right = |top: f64| cube("r", [1.0, 0.0, 0.0], [3.0, 1.0, top], "[5]");
    // An edge that goes in; a wall of which a half is free; a wall alone.
    let stepped = [
        cube("l", [0.0; 3], [1.0; 3], "[3]"),
        cube("r", [1.0, 0.0, 0.0], [2.0, 1.0, 1.0], "[5,1]"),
        cube("t", [1.0, 0.0, 1.0], [2.0, 1.0, 2.0], "[0]"),
    ];
    assert!(!alone(&stepped));
    assert!(!alone(&[cube("l", [0.0; 3], [1.0; 3], "[3]"), right(0.5)]));
    assert!(!alone(&[cube("l", [0.0; 3], [1.0; 3], "[3]")]));
    // Pieces that overlap.
    let deep = cube("r", [0.9, 0.0, 0.0], [3.0, 1.0, 1.0], "[5]");
    assert!(!alone(&[cube("l", [0.0; 3], [1.0; 3], "[3]"), deep]));
}
