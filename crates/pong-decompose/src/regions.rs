//! Unions of coplanar convex polygons.

use crate::polygon::{Polygon, area, lexicographic, sides};
use crate::seams::{Pool, with_vertices};
use nalgebra::Vector3;
use pong_import::mesh::ring;
use std::collections::{BTreeMap, BTreeSet};

/// Sum of the areas.
pub(crate) fn sum(polygons: &[Polygon]) -> f64 {
    polygons.iter().map(|polygon| area(polygon)).sum()
}

/// Polygons as the loader will see them: it merges connected ones to one face, which must be convex, unless
/// their outline is not one simple loop. `None` if it would refuse them.
pub(crate) fn faces_of(
    polygons: &[Polygon],
    normal: &Vector3<f64>,
    strip_m: f64,
    slack_m2: f64,
) -> Option<Vec<Polygon>> {
    let mut faces = Vec::new();
    for group in connected(polygons, normal, strip_m) {
        let members: Vec<Polygon> = group.iter().map(|&index| polygons[index].clone()).collect();
        let around = hull(&members, normal);
        if let [one] = members.as_slice() {
            faces.push(one.clone());
        } else if (area(&around) - sum(&members)).abs() <= slack_m2 {
            faces.push(around);
        } else if is_one_loop(&members, 0.01 * strip_m) {
            return None;
        } else {
            faces.extend(members);
        }
    }
    Some(faces)
}

/// Tests whether the boundary of a union is one loop that passes every corner once.
fn is_one_loop(members: &[Polygon], same_m: f64) -> bool {
    let mut pool = Pool::within(same_m);
    let members: Vec<Polygon> = members.iter().map(|polygon| pool.polygon(polygon.clone())).collect();
    let mut places: Vec<Vector3<f64>> = members.iter().flatten().copied().collect();
    places.sort_by(lexicographic);
    places.dedup();
    let number = |place: &Vector3<f64>| places.partition_point(|other| lexicographic(other, place).is_lt());
    let edges: BTreeSet<(usize, usize)> = members
        .iter()
        .flat_map(|polygon| {
            let outline: Vec<usize> = with_vertices(polygon, &places, same_m).iter().map(number).collect();
            ring(&outline).collect::<Vec<_>>()
        })
        .collect();
    let rim: Vec<(usize, usize)> = edges.iter().copied().filter(|&(a, b)| !edges.contains(&(b, a))).collect();
    let next: BTreeMap<usize, usize> = rim.iter().copied().collect();
    if next.len() != rim.len() {
        return false;
    }
    let Some(&(first, mut here)) = rim.first() else { return false };
    let mut length = 1;
    while here != first && length <= rim.len() {
        let Some(&beyond) = next.get(&here) else { return false };
        (here, length) = (beyond, length + 1);
    }
    length == rim.len()
}

/// Groups of polygons that share stretches of boundary, directly or through others.
fn connected(polygons: &[Polygon], normal: &Vector3<f64>, strip_m: f64) -> Vec<Vec<usize>> {
    let mut group: Vec<usize> = (0..polygons.len()).collect();
    for a in 0..polygons.len() {
        for b in a + 1..polygons.len() {
            if share_rim(&polygons[a], &polygons[b], normal, strip_m) {
                let (keep, gone) = (group[a].min(group[b]), group[a].max(group[b]));
                group.iter_mut().filter(|number| **number == gone).for_each(|number| *number = keep);
            }
        }
    }
    let members = |number: usize| (0..polygons.len()).filter(|&index| group[index] == number).collect();
    (0..polygons.len()).filter(|&number| group[number] == number).map(members).collect()
}

/// Tests whether two polygons touch along more than a point.
fn share_rim(one: &[Vector3<f64>], other: &[Vector3<f64>], normal: &Vector3<f64>, strip_m: f64) -> bool {
    let edges: Vec<_> = ring(other).filter(|(a, b)| a != b).collect();
    sides(one, normal).iter().zip(ring(one).filter(|(a, b)| a != b)).any(|(side, (start, end))| {
        let along = (end - start).normalize();
        let reach = along.dot(&(end - start));
        edges.iter().any(|(c, d)| {
            if side.height(c).abs() > strip_m || side.height(d).abs() > strip_m {
                return false;
            }
            let (c, d) = (along.dot(&(c - start)), along.dot(&(d - start)));
            c.max(d).min(reach) - c.min(d).max(0.0) > strip_m
        })
    })
}

/// Convex outline around coplanar polygons, without straight corners.
fn hull(polygons: &[Polygon], normal: &Vector3<f64>) -> Polygon {
    let across = Vector3::ith(normal.iamin(), 1.0);
    let u = across.cross(normal).normalize();
    let v = normal.cross(&u);
    let mut places: Vec<(f64, f64, Vector3<f64>)> =
        polygons.iter().flatten().map(|place| (u.dot(place), v.dot(place), *place)).collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    places.dedup_by(|a, b| a.2 == b.2);
    let size = places.iter().map(|(x, y, _)| x.abs().max(y.abs())).fold(0.0, f64::max);
    let turns = |chain: &[(f64, f64, Vector3<f64>)], next: &(f64, f64, Vector3<f64>)| {
        let [.., a, b] = chain else { return true };
        let (along, beyond) = ((b.0 - a.0, b.1 - a.1), (next.0 - b.0, next.1 - b.1));
        along.0 * beyond.1 - along.1 * beyond.0
            > 1e-12 * size * (along.0.hypot(along.1) + beyond.0.hypot(beyond.1))
    };
    let chain = |places: &mut dyn Iterator<Item = (f64, f64, Vector3<f64>)>| {
        let mut chain: Vec<(f64, f64, Vector3<f64>)> = Vec::new();
        for next in places {
            while chain.len() > 1 && !turns(&chain, &next) {
                chain.pop();
            }
            chain.push(next);
        }
        chain.pop();
        chain
    };
    let lower = chain(&mut places.iter().copied());
    let upper = chain(&mut places.iter().rev().copied());
    lower.into_iter().chain(upper).map(|(_, _, place)| place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Polygon {
        [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
            .map(|(x, y)| Vector3::new(x, y, 1.0))
            .to_vec()
    }

    #[test]
    fn connected_faces_become_one_where_the_loader_makes_one_of_them() {
        let up = Vector3::z();
        let faces = |polygons: &[Polygon]| faces_of(polygons, &up, 1e-6, 1e-6);
        let bar =
            [rectangle(0.0, 0.0, 1.0, 1.0), rectangle(1.0, 0.0, 2.0, 1.0), rectangle(5.0, 0.0, 1.0, 1.0)];
        let unions = faces(&bar).unwrap();
        assert_eq!(unions.iter().map(Vec::len).collect::<Vec<_>>(), [4, 4]);
        assert_eq!(sum(&unions), 4.0);
        let corner = [rectangle(0.0, 0.0, 1.0, 1.0), rectangle(1.0, 0.0, 1.0, 2.0)];
        assert!(faces(&corner).is_none(), "one face with a dent");
        let apart = [rectangle(0.0, 0.0, 1.0, 1.0), rectangle(1.0, 1.0, 1.0, 1.0)];
        assert_eq!(faces(&apart).unwrap().len(), 2, "they touch at a point only");
        let frame = [
            rectangle(0.0, 0.0, 3.0, 1.0),
            rectangle(0.0, 2.0, 3.0, 1.0),
            rectangle(0.0, 1.0, 1.0, 1.0),
            rectangle(2.0, 1.0, 1.0, 1.0),
        ];
        assert_eq!(faces(&frame).unwrap().len(), 4, "two rims: they stay apart");
        assert!(faces(&frame[..3]).is_none(), "a C has one rim");
    }
}
