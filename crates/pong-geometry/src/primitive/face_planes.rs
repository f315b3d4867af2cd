//! The planes of a polyhedron's faces, coordinate by coordinate.

use super::PolyhedronFace;
use crate::simd::{LANES, LaneBits};

/// Faces in blocks of eight, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FacePlanes {
    /// The blocks; the last one may have empty lanes.
    pub blocks: Vec<PlaneBlock>,
}

/// Eight planes. An empty lane has no normal and lies infinitely far off: every point is infinitely deep below it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct PlaneBlock {
    /// Components of the unit outward normals.
    pub normal: [[f64; LANES]; 3],
    /// Distances from the frame's origin along the normals, m.
    pub offset: [f64; LANES],
    /// Which lanes hold an active face.
    pub active: LaneBits,
    /// Which lanes hold a closed face.
    pub closed: LaneBits,
    /// Which lanes hold a face.
    pub filled: LaneBits,
}

impl PlaneBlock {
    /// No faces.
    pub const EMPTY: Self =
        Self { normal: [[0.0; LANES]; 3], offset: [f64::INFINITY; LANES], active: 0, closed: 0, filled: 0 };
}

impl FacePlanes {
    /// The planes of the faces.
    pub fn new(faces: &[PolyhedronFace]) -> Self {
        Self { blocks: faces.chunks(LANES).map(block).collect() }
    }
}

fn block(faces: &[PolyhedronFace]) -> PlaneBlock {
    let mut block = PlaneBlock::EMPTY;
    for (lane, face) in faces.iter().enumerate() {
        for axis in 0..3 {
            block.normal[axis][lane] = face.normal[axis];
        }
        block.offset[lane] = face.offset;
        block.active |= LaneBits::from(face.active) << lane;
        block.closed |= LaneBits::from(face.closed) << lane;
        block.filled |= 1 << lane;
    }
    block
}
