//! Convex pieces of one body: grouping into surfaces, and matching of their internal faces.

use crate::hull::{Hull, PLANE_TOLERANCE, area, overlap_area};
use pong_geometry::Vec3;

/// Overlap above which two internal faces are matched, as a fraction of the smaller area.
const OVERLAP_SHARE: f64 = 1e-6;

/// Disjoint sets; the lowest member represents its set.
pub(crate) struct Sets(Vec<u32>);

impl Sets {
    pub(crate) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    pub(crate) fn find(&mut self, member: u32) -> u32 {
        let mut here = member;
        while self.0[here as usize] != here {
            let above = self.0[here as usize];
            self.0[here as usize] = self.0[above as usize];
            here = self.0[here as usize];
        }
        here
    }

    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

/// Face of a piece with the box around it.
pub(crate) struct Wall {
    pub(crate) piece: u32,
    pub(crate) face: usize,
    pub(crate) corners: Vec<Vec3>,
    pub(crate) low: Vec3,
    pub(crate) high: Vec3,
}

/// Joins pieces along their internal faces, and makes the planes of opposite internal faces exact opposites.
/// Returns, for each piece, the lowest piece of its surface; and the internal faces (piece, face) without a
/// counterpart.
pub(crate) fn join_walls(hulls: &mut [Hull]) -> (Vec<u32>, Vec<(u32, usize)>) {
    let walls = faces_by_x(hulls, |piece, face| !hulls[piece].faces[face].active);
    let twins = twin_walls(hulls, &walls);
    let mut pieces = Sets::new(hulls.len());
    let mut planes = Sets::new(walls.len());
    for &(a, b) in &twins {
        pieces.join(walls[a].piece, walls[b].piece);
        planes.join(a as u32, b as u32);
        let lower = if walls[a].piece < walls[b].piece { a } else { b };
        hulls[walls[lower].piece as usize].faces[walls[lower].face].closed = true;
    }
    share_planes(hulls, &walls, &mut planes);
    let mut paired = vec![false; walls.len()];
    twins.iter().for_each(|&(a, b)| (paired[a], paired[b]) = (true, true));
    let lonely = walls.iter().zip(&paired).filter(|(_, paired)| !**paired);
    let mut lonely: Vec<_> = lonely.map(|(wall, _)| (wall.piece, wall.face)).collect();
    lonely.sort_unstable();
    ((0..hulls.len() as u32).map(|piece| pieces.find(piece)).collect(), lonely)
}

/// Faces (piece, face) that `counts` selects, sorted by their least x coordinate.
pub(crate) fn faces_by_x(hulls: &[Hull], counts: impl Fn(usize, usize) -> bool) -> Vec<Wall> {
    let mut walls = Vec::new();
    for (piece, hull) in hulls.iter().enumerate() {
        for face in (0..hull.faces.len()).filter(|&face| counts(piece, face)) {
            let corners = hull.corners(face);
            let margin = Vec3::repeat(PLANE_TOLERANCE * hull.diameter);
            let low = corners.iter().fold(corners[0], |low, c| low.inf(c)) - margin;
            let high = corners.iter().fold(corners[0], |high, c| high.sup(c)) + margin;
            walls.push(Wall { piece: piece as u32, face, corners, low, high });
        }
    }
    walls.sort_by(|a, b| a.low.x.total_cmp(&b.low.x).then((a.piece, a.face).cmp(&(b.piece, b.face))));
    walls
}

fn twin_walls(hulls: &[Hull], walls: &[Wall]) -> Vec<(usize, usize)> {
    let mut twins = Vec::new();
    for (index, wall) in walls.iter().enumerate() {
        let reachable = walls[index + 1..].iter().take_while(|other| other.low.x <= wall.high.x);
        for (ahead, other) in reachable.enumerate() {
            if lie_against(hulls, wall, other).is_some() {
                twins.push((index, index + 1 + ahead));
            }
        }
    }
    twins
}

/// Area common to two faces of different pieces that lie in one plane, with the pieces on opposite sides of it, m²;
/// `None` if they do not lie so, or have no area in common.
pub(crate) fn lie_against(hulls: &[Hull], a: &Wall, b: &Wall) -> Option<f64> {
    let apart = |i: usize| a.low[i] > b.high[i] || b.low[i] > a.high[i];
    if a.piece == b.piece || apart(1) || apart(2) {
        return None;
    }
    let (hull_a, hull_b) = (&hulls[a.piece as usize], &hulls[b.piece as usize]);
    let (face_a, face_b) = (&hull_a.faces[a.face], &hull_b.faces[b.face]);
    let tolerance = PLANE_TOLERANCE * hull_a.diameter.max(hull_b.diameter);
    let near = |face: &crate::hull::HullFace, corners: &[Vec3]| {
        corners.iter().all(|c| (face.normal.dot(c) - face.offset).abs() <= tolerance)
    };
    if face_a.normal.dot(&face_b.normal) >= -0.5 || !near(face_a, &b.corners) || !near(face_b, &a.corners) {
        return None;
    }
    let common = overlap_area(&a.corners, &b.corners, &face_a.normal);
    (common > OVERLAP_SHARE * area(&a.corners).min(area(&b.corners))).then_some(common)
}

/// Gives all faces of each set of `planes` the plane of the lowest piece among them, reversed where necessary, so
/// that they agree to the bit.
pub(crate) fn share_planes(hulls: &mut [Hull], walls: &[Wall], planes: &mut Sets) {
    let key = |wall: usize| (walls[wall].piece, walls[wall].face);
    let mut lowest: Vec<usize> = (0..walls.len()).collect();
    for wall in 0..walls.len() {
        let plane = planes.find(wall as u32) as usize;
        if key(wall) < key(lowest[plane]) {
            lowest[plane] = wall;
        }
    }
    for wall in 0..walls.len() {
        let (piece, face) = key(lowest[planes.find(wall as u32) as usize]);
        let model = hulls[piece as usize].faces[face].clone();
        let own = &mut hulls[walls[wall].piece as usize].faces[walls[wall].face];
        let opposite = model.normal.dot(&own.normal) < 0.0;
        own.normal = if opposite { -model.normal } else { model.normal };
        own.offset = if opposite { -model.offset } else { model.offset };
    }
}
