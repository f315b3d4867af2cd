//! Merging of coplanar neighbouring faces, because hulls from OBJ and STL files are triangulated.
//!
//! Regions grow from the largest faces, whose normals are the most reliable. A face joins if every vertex of
//! the region stays within the tolerance of the common plane. Area vectors are summed, so the arbitrary
//! normal of a sliver cannot turn the plane.
//!
//! If faces are almost but not quite coplanar (a shallow cap, a finely tessellated sphere), a region may get
//! a ragged outline. It is then grown again with a quarter of the tolerance, and so on down to single faces,
//! which are convex. So merging always ends with convex faces within the tolerance, as few as it finds.

use super::places::Places;
use super::polygon::{area_vector, edges, hull_sides, plane_of, unit, width};
use super::solid::{HullFace, PLANE_TOLERANCE};
use super::support;
use crate::weld::WordMap;
use pong_geometry::Vec3;
use std::collections::VecDeque;

/// Width, in diameters, below which the normal of a face is noise.
pub(super) const SURE_WIDTH: f64 = 4e-6;
/// Factor by which the tolerance shrinks when a region is grown again.
const FINER: f64 = 0.25;
/// Number of tolerances; the last, 4e-9 of the diameter, is below the rounding to 32 bits.
pub(super) const LEVELS: usize = 5;

/// Faces of a solid, to be merged as far as they stay convex.
pub(super) struct Faces<'a> {
    vertices: &'a [Vec3],
    outlines: &'a [Vec<u32>],
    active: &'a [bool],
    areas: Vec<Vec3>,
    sure: Vec<bool>,
    /// Face that runs along a directed edge.
    along: WordMap<(u32, u32), u32>,
    /// All faces, largest first.
    order: Vec<u32>,
    /// Planarity tolerance of the model format, m.
    tolerance: f64,
}

/// Merged face, and all vertices that its plane must hold: those of its outline and those dropped by merging.
pub(super) struct Merged {
    pub(super) face: HullFace,
    pub(super) held: Vec<u32>,
}

/// Faces that regions may still take.
struct Free {
    /// Set that each face belongs to; zero once it is taken.
    set: Vec<u32>,
    sets: u32,
}

impl<'a> Faces<'a> {
    pub(super) fn new(
        vertices: &'a [Vec3],
        outlines: &'a [Vec<u32>],
        active: &'a [bool],
        diameter: f64,
    ) -> Self {
        let corners = |face: &Vec<u32>| -> Vec<Vec3> { face.iter().map(|&v| vertices[v as usize]).collect() };
        let mut along = WordMap::default();
        for (index, face) in outlines.iter().enumerate() {
            along.extend(edges(face).map(|edge| (edge, index as u32)));
        }
        // A face that has joined another has no outline.
        let area =
            |face: &Vec<u32>| if face.is_empty() { Vec3::zeros() } else { area_vector(&corners(face)) };
        let sure = |face: &Vec<u32>| !face.is_empty() && width(&corners(face)) > SURE_WIDTH * diameter;
        let areas: Vec<Vec3> = outlines.iter().map(area).collect();
        let mut order: Vec<u32> =
            (0..outlines.len() as u32).filter(|&face| !outlines[face as usize].is_empty()).collect();
        let size = |face: u32| areas[face as usize].norm();
        order.sort_by(|&a, &b| size(b).total_cmp(&size(a)).then(a.cmp(&b)));
        Self {
            vertices,
            outlines,
            active,
            areas,
            order,
            sure: outlines.iter().map(sure).collect(),
            along,
            tolerance: PLANE_TOLERANCE * diameter,
        }
    }

    /// Merged faces if regions start with the tolerance reduced `level` times; with [`LEVELS`] nothing is
    /// merged.
    pub(super) fn merged(&self, level: usize) -> Vec<Merged> {
        let mut merged = Vec::new();
        let mut free = Free { set: vec![0; self.outlines.len()], sets: 0 };
        self.settle(self.order.clone(), level, &mut free, &mut merged);
        merged.sort_by_key(|merged| merged.face.authored);
        merged
    }

    fn neighbors(&self, face: u32) -> impl Iterator<Item = u32> + '_ {
        edges(&self.outlines[face as usize]).map(|(a, b)| self.along[&(b, a)])
    }

    /// Merges the given faces, largest first.
    fn settle(&self, order: Vec<u32>, level: usize, free: &mut Free, merged: &mut Vec<Merged>) {
        if level >= LEVELS {
            merged.extend(order.iter().map(|&face| self.alone(face)));
            return;
        }
        free.sets += 1;
        let set = free.sets;
        order.iter().for_each(|&face| free.set[face as usize] = set);
        let rank: WordMap<u32, u32> = order.iter().zip(0..).map(|(&face, rank)| (face, rank)).collect();
        let tolerance = (0..level).fold(self.tolerance, |tolerance, _| tolerance * FINER);
        let mut ragged = Vec::new();
        for &seed in &order {
            if free.set[seed as usize] != set {
                continue;
            }
            let mut region = self.grow(seed, tolerance, free);
            region.sort_unstable();
            match self.united(&region) {
                Some(face) => merged.push(face),
                None => ragged.push(region),
            }
        }
        for mut region in ragged {
            region.sort_by_key(|face| rank[face]);
            self.settle(region, level + 1, free, merged);
        }
    }

    fn grow(&self, seed: u32, tolerance: f64, free: &mut Free) -> Vec<u32> {
        let set = std::mem::take(&mut free.set[seed as usize]);
        let mut region = vec![seed];
        let mut area = self.areas[seed as usize];
        let mut slab = Slab::new(unit(&area));
        slab.places.extend(self.places(seed));
        slab.measure(unit(&area));
        let mut frontier: VecDeque<u32> = self.neighbors(seed).collect();
        while let Some(face) = frontier.pop_front() {
            let index = face as usize;
            if free.set[index] != set || self.active[index] != self.active[seed as usize] {
                continue;
            }
            let united = area + self.areas[index];
            if self.faces_along(face, &united)
                && slab.takes(self.places(face), unit(&united), 2.0 * tolerance)
            {
                free.set[index] = 0;
                region.push(face);
                area = united;
                frontier.extend(self.neighbors(face));
            }
        }
        region
    }

    fn places(&self, face: u32) -> impl Iterator<Item = Vec3> + '_ {
        self.outlines[face as usize].iter().map(|&v| self.vertices[v as usize])
    }

    fn faces_along(&self, face: u32, area: &Vec3) -> bool {
        let own = &self.areas[face as usize];
        !self.sure[face as usize] || unit(own).dot(&unit(area)) > 0.5
    }

    /// Region as one face, if its outline is one convex loop and its vertices lie within the tolerance of the
    /// face's plane.
    fn united(&self, region: &[u32]) -> Option<Merged> {
        if let [face] = region {
            return Some(self.alone(*face));
        }
        let face = self.face(self.outline(region)?, region[0]);
        let corners: Vec<Vec3> = face.outline.iter().map(|&v| self.vertices[v as usize]).collect();
        let off = |place: Vec3| (face.normal.dot(&place) - face.offset).abs();
        let near = region.iter().flat_map(|&f| self.places(f)).all(|place| off(place) <= self.tolerance);
        if !near || hull_sides(&corners, &face.normal, self.tolerance).is_none() {
            return None;
        }
        let mut held: Vec<u32> = region.iter().flat_map(|&f| &self.outlines[f as usize]).copied().collect();
        held.sort_unstable();
        held.dedup();
        Some(Merged { face, held })
    }

    fn alone(&self, face: u32) -> Merged {
        let outline = &self.outlines[face as usize];
        Merged { face: self.face(outline.clone(), face), held: outline.clone() }
    }

    /// Outline of a region, if it is a single loop.
    fn outline(&self, region: &[u32]) -> Option<Vec<u32>> {
        let mut next: WordMap<u32, u32> = WordMap::default();
        let mut first = None;
        for &face in region {
            for (a, b) in edges(&self.outlines[face as usize]) {
                if region.binary_search(&self.along[&(b, a)]).is_err() {
                    first.get_or_insert(a);
                    if next.insert(a, b).is_some() {
                        return None;
                    }
                }
            }
        }
        let first = first?;
        let mut outline = vec![first];
        let mut here = *next.get(&first)?;
        while here != first && outline.len() <= next.len() {
            outline.push(here);
            here = *next.get(&here)?;
        }
        (outline.len() == next.len() && outline.len() >= 3).then_some(outline)
    }

    fn face(&self, outline: Vec<u32>, authored: u32) -> HullFace {
        let corners: Vec<Vec3> = outline.iter().map(|&v| self.vertices[v as usize]).collect();
        let (normal, offset) = plane_of(&corners);
        HullFace {
            normal,
            offset,
            active: self.active[authored as usize],
            closed: false,
            outline,
            walls: Vec::new(),
            authored,
        }
    }
}

/// Vertices of a region and their extent along its normal.
///
/// The normal converges as the region grows. While it has turned by a negligible angle, the measured heights
/// are reused with a bound for the turn, so the vertices are not measured again for each face that joins.
struct Slab {
    places: Vec<Vec3>,
    /// Normal along which the heights were measured.
    normal: Vec3,
    low: f64,
    high: f64,
    /// Largest distance of a vertex from the first one.
    reach: f64,
}

impl Slab {
    fn new(normal: Vec3) -> Self {
        Self { places: Vec::new(), normal, low: 0.0, high: 0.0, reach: 0.0 }
    }

    /// Measures all heights again.
    fn measure(&mut self, normal: Vec3) {
        let first = self.places[0];
        let heights = self.places.iter().map(|p| normal.dot(&(p - first)));
        (self.low, self.high) = heights.fold((0.0_f64, 0.0_f64), |(low, high), h| (low.min(h), high.max(h)));
        self.reach = self.places.iter().map(|p| (p - first).norm()).fold(0.0, f64::max);
        self.normal = normal;
    }

    /// Adds vertices if all then lie within `thickness` along the normal.
    fn takes(&mut self, places: impl Iterator<Item = Vec3>, normal: Vec3, thickness: f64) -> bool {
        let (known, first) = (self.places.len(), self.places[0]);
        let (mut low, mut high, mut reach) = (self.low, self.high, self.reach);
        self.places.extend(places);
        for place in &self.places[known..] {
            let height = self.normal.dot(&(place - first));
            (low, high) = (low.min(height), high.max(height));
            reach = reach.max((place - first).norm());
        }
        let turn = 2.0 * reach * (normal - self.normal).norm();
        let taken = if high - low + turn <= thickness {
            (self.low, self.high, self.reach) = (low, high, reach);
            true
        } else if high - low - turn > thickness {
            false
        } else {
            let before = (self.low, self.high, self.reach, self.normal);
            self.measure(normal);
            let fits = self.high - self.low <= thickness;
            if !fits {
                (self.low, self.high, self.reach, self.normal) = before;
            }
            fits
        };
        if !taken {
            self.places.truncate(known);
        }
        taken
    }
}

/// Drops the vertices at which only two faces meet, if that moves the edge between them by no more than the
/// tolerance. Rounding gives the short segments of a subdivided straight edge arbitrary directions, so that
/// planes along them would cut into the faces.
pub(super) fn straighten(vertices: &[Vec3], merged: &mut [Merged], tolerance: f64) {
    let mut faces: Vec<&mut HullFace> = merged.iter_mut().map(|merged| &mut merged.face).collect();
    let mut users = vec![0_u32; vertices.len()];
    faces.iter().flat_map(|face| &face.outline).for_each(|&v| users[v as usize] += 1);
    let mut dropped = vec![false; vertices.len()];
    for face in faces.iter() {
        let Some(start) = face.outline.iter().position(|&v| users[v as usize] != 2) else { continue };
        let around = face.outline.iter().cycle().skip(start).take(face.outline.len() + 1);
        let mut chain: Vec<u32> = Vec::new();
        for &vertex in around {
            chain.push(vertex);
            if chain.len() > 1 && users[vertex as usize] != 2 {
                drop_between(vertices, &chain, tolerance, &mut dropped);
                chain = vec![vertex];
            }
        }
    }
    for face in faces.iter_mut() {
        let stay = |v: &u32| !dropped[*v as usize];
        if face.outline.iter().filter(|v| stay(v)).count() < 3 {
            face.outline.iter().for_each(|&v| dropped[v as usize] = false);
        }
    }
    faces.iter_mut().for_each(|face| face.outline.retain(|&v| !dropped[v as usize]));
}

/// Simplifies a chain (Ramer-Douglas-Peucker): drops the vertices within the tolerance of the line between
/// its ends, or keeps the farthest one and repeats on both sides.
fn drop_between(vertices: &[Vec3], chain: &[u32], tolerance: f64, dropped: &mut [bool]) {
    let place = |v: u32| vertices[v as usize];
    let mut open = vec![(0, chain.len() - 1)];
    while let Some((start, end)) = open.pop() {
        let (a, b) = (place(chain[start]), place(chain[end]));
        let off = |k: &usize| {
            let away = place(chain[*k]) - a;
            if a == b { away.norm() } else { away.cross(&unit(&(b - a))).norm() }
        };
        let farthest = (start + 1..end).max_by(|j, k| off(j).total_cmp(&off(k)));
        match farthest {
            Some(k) if off(&k) > tolerance => open.extend([(start, k), (k, end)]),
            _ => chain[start + 1..end].iter().for_each(|&v| dropped[v as usize] = true),
        }
    }
}

/// Replaces the plane of a face if a vertex of the solid lies in front of it, or if it does not hold the
/// face's own vertices. The new plane is the one that comes nearest to supporting the solid and holding these
/// vertices. (Rounding dominates the normal of a narrow face.) Returns `true` if the new plane does both.
pub(super) fn support(vertices: &[Vec3], merged: &mut Merged, tree: &Places, tolerance: f64) -> bool {
    let face = &mut merged.face;
    let held: Vec<Vec3> = merged.held.iter().map(|&v| vertices[v as usize]).collect();
    let holds = held.iter().all(|place| (face.normal.dot(place) - face.offset).abs() <= tolerance);
    if holds && tree.highest((&face.normal, face.offset), tolerance, |v| !face.outline.contains(&v)).is_none()
    {
        return true;
    }
    let (plane, supports) = support::plane(&held, (vertices, tree), face.normal, tolerance);
    (face.normal, face.offset) = plane;
    supports
}
