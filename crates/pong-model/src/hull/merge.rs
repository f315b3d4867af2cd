//! Coplanar neighbouring faces become one: hulls from OBJ and STL files are triangulated.
//!
//! Regions grow from the largest faces, whose normals are the surest. A face joins when every vertex of the
//! region stays within the tolerance of the common plane. Area vectors add up to that of the union, so the
//! arbitrary normal of a sliver cannot turn the plane.

use super::polygon::{area_vector, edges, plane_of, unit, width};
use super::{HullFace, PLANE_TOLERANCE};
use crate::weld::WordMap;
use pong_geometry::Vec3;
use std::collections::VecDeque;

/// Below this width (in diameters) the normal of a face is noise and says nothing about its side.
const SURE_WIDTH: f64 = 4e-6;

struct Faces<'a> {
    vertices: &'a [Vec3],
    outlines: &'a [Vec<u32>],
    active: &'a [bool],
    areas: Vec<Vec3>,
    sure: Vec<bool>,
    /// The face that runs along a directed edge.
    along: WordMap<(u32, u32), u32>,
    tolerance: f64,
}

pub(super) fn merge_coplanar(
    vertices: &[Vec3],
    outlines: &[Vec<u32>],
    active: &[bool],
    diameter: f64,
) -> Vec<HullFace> {
    let faces = Faces::new(vertices, outlines, active, diameter);
    let mut merged = Vec::new();
    for mut region in faces.regions() {
        region.sort_unstable();
        match faces.outline(&region) {
            Some(outline) => merged.push(faces.face(outline, region[0])),
            None => merged.extend(region.iter().map(|&f| faces.face(outlines[f as usize].clone(), f))),
        }
    }
    merged.sort_by_key(|face| face.authored);
    merged
}

impl<'a> Faces<'a> {
    fn new(vertices: &'a [Vec3], outlines: &'a [Vec<u32>], active: &'a [bool], diameter: f64) -> Self {
        let corners = |face: &Vec<u32>| -> Vec<Vec3> { face.iter().map(|&v| vertices[v as usize]).collect() };
        let mut along = WordMap::default();
        for (index, face) in outlines.iter().enumerate() {
            along.extend(edges(face).map(|edge| (edge, index as u32)));
        }
        Self {
            vertices,
            outlines,
            active,
            areas: outlines.iter().map(|face| area_vector(&corners(face))).collect(),
            sure: outlines.iter().map(|face| width(&corners(face)) > SURE_WIDTH * diameter).collect(),
            along,
            tolerance: PLANE_TOLERANCE * diameter,
        }
    }

    fn neighbors(&self, face: u32) -> impl Iterator<Item = u32> + '_ {
        edges(&self.outlines[face as usize]).map(|(a, b)| self.along[&(b, a)])
    }

    fn regions(&self) -> Vec<Vec<u32>> {
        let mut order: Vec<u32> = (0..self.outlines.len() as u32).collect();
        let size = |face: u32| self.areas[face as usize].norm();
        order.sort_by(|&a, &b| size(b).total_cmp(&size(a)).then(a.cmp(&b)));
        let mut taken = vec![false; self.outlines.len()];
        let mut regions = Vec::new();
        for seed in order {
            if !taken[seed as usize] {
                regions.push(self.grow(seed, &mut taken));
            }
        }
        regions
    }

    fn grow(&self, seed: u32, taken: &mut [bool]) -> Vec<u32> {
        taken[seed as usize] = true;
        let mut region = vec![seed];
        let mut area = self.areas[seed as usize];
        let mut places: Vec<Vec3> = self.places(seed).collect();
        let mut frontier: VecDeque<u32> = self.neighbors(seed).collect();
        while let Some(face) = frontier.pop_front() {
            let index = face as usize;
            if taken[index] || self.active[index] != self.active[seed as usize] {
                continue;
            }
            let united = area + self.areas[index];
            let known = places.len();
            places.extend(self.places(face));
            if self.faces_along(face, &united) && self.flat(&places, &united) {
                taken[index] = true;
                region.push(face);
                area = united;
                frontier.extend(self.neighbors(face));
            } else {
                places.truncate(known);
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

    fn flat(&self, places: &[Vec3], area: &Vec3) -> bool {
        let normal = unit(area);
        let heights = places.iter().map(|p| normal.dot(&(p - places[0])));
        let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(low, high), h| (low.min(h), high.max(h)));
        high - low <= 2.0 * self.tolerance
    }

    /// The outline of a region, if it is one loop.
    fn outline(&self, region: &[u32]) -> Option<Vec<u32>> {
        if let [face] = region {
            return Some(self.outlines[*face as usize].clone());
        }
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
        (outline.len() == next.len()).then_some(outline)
    }

    fn face(&self, outline: Vec<u32>, authored: u32) -> HullFace {
        let corners: Vec<Vec3> = outline.iter().map(|&v| self.vertices[v as usize]).collect();
        let (normal, offset) = plane_of(&corners);
        HullFace { normal, offset, active: self.active[authored as usize], closed: false, outline, authored }
    }
}
