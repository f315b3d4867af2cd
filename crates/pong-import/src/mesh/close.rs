//! Hole filling: boundary loops, filled with triangles between their vertices.

use super::adjacency::Adjacency;
use super::measures::{area_vector, bounds};
use super::triangle_mesh::Mesh;
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Holes of more than this share of the surface count as missing sides and stay open.
const LARGEST_SHARE: f64 = 0.25;
/// Outlines of more vertices are refused: filling takes up to quadratic time.
const MOST_CORNERS: usize = 10_000;
/// Heights above a plane that count as zero, in sizes of an outline.
const FLAT: f64 = 1e-6;

/// Figures of the filled holes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Closed {
    pub(crate) holes: usize,
    pub(crate) triangles: usize,
    pub(crate) area_m2: f64,
    pub(crate) largest_m2: f64,
    /// A corner of the largest hole.
    pub(crate) at: Vector3<f64>,
    /// Largest distance of a hole's vertices from its plane, m.
    pub(crate) bent_m: f64,
}

/// A loop of boundary edges, counter-clockwise seen from the front of its filling.
struct Outline {
    corners: Vec<u32>,
    normal: Vector3<f64>,
    middle: Vector3<f64>,
    size_m: f64,
    bent_m: f64,
}

/// Fills every hole, or returns why it cannot; `None` if there are no holes.
pub(crate) fn close(mesh: &mut Mesh) -> Result<Option<Closed>, String> {
    let adjacency = Adjacency::new(&mesh.triangles);
    let at = |triangle: u32| named(&mesh.corners(triangle as usize)[0]);
    if let Some(&triangle) = adjacency.wound_against.first() {
        return Err(format!("triangles run against each other near {}", at(triangle)));
    }
    if let Some(&triangle) = adjacency.crowded.first() {
        return Err(format!("an edge near {} is shared by three or more triangles", at(triangle)));
    }
    if adjacency.free.is_empty() {
        return Ok(None);
    }
    let outlines = outlines(mesh, &adjacency)?;
    let within = holes_within(mesh, &outlines);
    let mut filled: Vec<[u32; 3]> = Vec::new();
    let mut closed =
        Closed { holes: 0, triangles: 0, area_m2: 0.0, largest_m2: 0.0, at: Vector3::zeros(), bent_m: 0.0 };
    for (index, outline) in outlines.iter().enumerate() {
        if within.iter().any(|islands| islands.contains(&index)) {
            continue;
        }
        let islands: Vec<&Outline> = within[index].iter().map(|&island| &outlines[island]).collect();
        let triangles = fill(mesh, outline, &islands)?;
        let area = |t: &[u32; 3]| 0.5 * area_vector(&t.map(|v| mesh.vertices[v as usize])).norm();
        let area_m2: f64 = triangles.iter().map(area).sum();
        closed.holes += 1;
        closed.area_m2 += area_m2;
        closed.bent_m = closed.bent_m.max(outline.bent_m);
        if area_m2 > closed.largest_m2 {
            (closed.largest_m2, closed.at) = (area_m2, mesh.vertices[outline.corners[0] as usize]);
        }
        filled.extend(triangles);
    }
    let surface_m2: f64 = (0..mesh.triangles.len()).map(|t| 0.5 * area_vector(&mesh.corners(t)).norm()).sum();
    if closed.area_m2 > LARGEST_SHARE * surface_m2 {
        return Err(format!(
            "{} would add {:.3e} m² to a surface of {surface_m2:.3e} m², the largest {:.3e} m² near {}: more than a \
             quarter is missing",
            count(closed.holes),
            closed.area_m2,
            closed.largest_m2,
            named(&closed.at)
        ));
    }
    let before = mesh.triangles.len();
    mesh.look_of.resize(before + filled.len(), mesh.look_of.first().copied().unwrap_or(0));
    mesh.triangles.extend(filled);
    // The triangulation omits collinear corners; these then lie within edges of the filling.
    super::mend(mesh);
    closed.triangles = mesh.triangles.len() - before;
    match Adjacency::new(&mesh.triangles).is_closed() {
        true => Ok(Some(closed)),
        false => Err(format!("with {} filled there are still free edges", count(closed.holes))),
    }
}

pub(crate) fn count(holes: usize) -> String {
    if holes == 1 { "1 hole".to_owned() } else { format!("{holes} holes") }
}

fn named(place: &Vector3<f64>) -> String {
    format!("({}, {}, {})", place.x, place.y, place.z)
}

/// Loops of boundary edges, against the direction of their triangles.
fn outlines(mesh: &Mesh, adjacency: &Adjacency) -> Result<Vec<Outline>, String> {
    let mut next: BTreeMap<u32, u32> = BTreeMap::new();
    for &(triangle, corner) in &adjacency.free {
        let [a, b] = [0, 1].map(|k| mesh.triangles[triangle as usize][(corner as usize + k) % 3]);
        if next.insert(b, a).is_some() {
            let place = named(&mesh.vertices[b as usize]);
            return Err(format!("two holes meet at the vertex {place}"));
        }
    }
    let mut found = Vec::new();
    while let Some((first, mut here)) = next.pop_first() {
        let mut corners = vec![first];
        while here != first {
            corners.push(here);
            here = next.remove(&here).ok_or("an outline of free edges does not end where it begins")?;
        }
        if corners.len() > MOST_CORNERS {
            return Err(format!(
                "a hole near {} has {} corners; at most {MOST_CORNERS} can be filled",
                named(&mesh.vertices[first as usize]),
                corners.len()
            ));
        }
        found.push(Outline::new(mesh, corners));
    }
    Ok(found)
}

impl Outline {
    fn new(mesh: &Mesh, corners: Vec<u32>) -> Self {
        let places: Vec<Vector3<f64>> = corners.iter().map(|&v| mesh.vertices[v as usize]).collect();
        let (low, high) = bounds(&places);
        let middle = 0.5 * (low + high);
        let area: Vector3<f64> = super::ring(&places).map(|(a, b)| (a - middle).cross(&(b - middle))).sum();
        let normal = area.try_normalize(0.0).unwrap_or_default();
        let heights = places.iter().map(|place| normal.dot(&(place - middle)));
        let (least, most) =
            heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        let middle = middle + normal * (0.5 * (least + most));
        Self { corners, normal, middle, size_m: (high - low).norm(), bent_m: 0.5 * (most - least) }
    }

    /// Coordinates in the plane, in which the loop is counter-clockwise.
    fn flat(&self, place: &Vector3<f64>) -> [f64; 2] {
        let across = Vector3::ith(self.normal.iamin(), 1.0);
        let u = across.cross(&self.normal).normalize();
        let v = self.normal.cross(&u);
        [u, v].map(|axis| axis.dot(&(place - self.middle)))
    }

    fn is_flat(&self) -> bool {
        self.bent_m <= FLAT * self.size_m
    }
}

/// Inner loops of each outline in the same hole: the end of a tube is a ring, whose inner loop is coplanar
/// and runs in the opposite direction.
fn holes_within(mesh: &Mesh, outlines: &[Outline]) -> Vec<Vec<usize>> {
    let is_within = |inner: &Outline, outer: &Outline| {
        let near = FLAT * outer.size_m;
        inner.is_flat()
            && outer.is_flat()
            && inner.normal.dot(&outer.normal) < 0.0
            && outer.normal.dot(&(inner.middle - outer.middle)).abs() <= near
            && inner
                .corners
                .iter()
                .all(|&v| outer.normal.dot(&(mesh.vertices[v as usize] - outer.middle)).abs() <= 2.0 * near)
            && surrounds(mesh, outer, &mesh.vertices[inner.corners[0] as usize])
    };
    let islands = |outer: &Outline| {
        (0..outlines.len()).filter(|&inner| is_within(&outlines[inner], outer)).collect::<Vec<_>>()
    };
    outlines.iter().map(islands).collect()
}

/// Tests whether a coplanar point lies within an outline, by the crossings of a ray.
fn surrounds(mesh: &Mesh, outline: &Outline, place: &Vector3<f64>) -> bool {
    let [x, y] = outline.flat(place);
    let flat: Vec<[f64; 2]> =
        outline.corners.iter().map(|&v| outline.flat(&mesh.vertices[v as usize])).collect();
    let crossings = super::ring(&flat)
        .filter(|([ax, ay], [bx, by])| (*ay > y) != (*by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax));
    crossings.count() % 2 == 1
}

/// Triangles between the vertices of an outline and of its inner loops.
fn fill(mesh: &Mesh, outline: &Outline, islands: &[&Outline]) -> Result<Vec<[u32; 3]>, String> {
    let corners: Vec<u32> =
        outline.corners.iter().chain(islands.iter().flat_map(|island| &island.corners)).copied().collect();
    let mut starts = Vec::new();
    let mut start = outline.corners.len() as u32;
    for island in islands {
        starts.push(start);
        start += island.corners.len() as u32;
    }
    let flat: Vec<[f64; 2]> = corners.iter().map(|&v| outline.flat(&mesh.vertices[v as usize])).collect();
    let mut order: Vec<u32> = Vec::new();
    earcut::Earcut::new().earcut(flat.iter().copied(), &starts, &mut order);
    let (triangles, _) = order.as_chunks::<3>();
    let twice = |[a, b, c]: [[f64; 2]; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let covered: f64 = triangles.iter().map(|t| twice(t.map(|k| flat[k as usize])).abs()).sum();
    let area = |from: usize, to: usize| -> f64 {
        super::ring(&flat[from..to]).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
    };
    let mut ends: Vec<usize> = starts.iter().map(|&start| start as usize).collect();
    ends.push(flat.len());
    let outlined = area(0, ends[0]) + ends.windows(2).map(|pair| area(pair[0], pair[1])).sum::<f64>();
    if (covered - outlined).abs() > 1e-9 * outlined.abs() {
        let place = named(&mesh.vertices[outline.corners[0] as usize]);
        return Err(format!(
            "the hole of {} corners near {place} cannot be filled: seen along its normal its outline crosses itself",
            corners.len()
        ));
    }
    // The triangulation may return either winding.
    let outward = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|k| corners[k as usize]);
        if twice(t.map(|k| flat[k as usize])) < 0.0 { [a, c, b] } else { [a, b, c] }
    };
    Ok(triangles.iter().map(outward).collect())
}
