//! Polygons in space: area, plane, width, overlap.

use super::places::Places;
use pong_geometry::Vec3;

/// Twice the area times the unit normal (Newell's method), relative to the first corner.
pub(super) fn area_vector(corners: &[Vec3]) -> Vec3 {
    let first = corners[0];
    corners.windows(2).skip(1).map(|pair| (pair[0] - first).cross(&(pair[1] - first))).sum()
}

/// Unit normal and offset: Newell's normal through the mean of the corners. The polygon must have an area.
pub(crate) fn plane_of(corners: &[Vec3]) -> (Vec3, f64) {
    let normal = unit(&area_vector(corners));
    (normal, normal.dot(&mean(corners)))
}

/// Unit vector, without overflow at any size.
pub(super) fn unit(v: &Vec3) -> Vec3 {
    (v / v.amax()).normalize()
}

pub(super) fn mean(corners: &[Vec3]) -> Vec3 {
    // Relative to one corner, so that a distant origin costs no precision.
    let first = corners[0];
    first + corners.iter().map(|corner| corner - first).sum::<Vec3>() / corners.len() as f64
}

/// Pairs of each corner and the next one.
pub(super) fn edges<T: Copy>(outline: &[T]) -> impl Iterator<Item = (T, T)> + '_ {
    outline.iter().copied().zip(outline.iter().copied().cycle().skip(1))
}

/// Number of corners above which outlines are not compared corner by edge, which takes quadratic time.
const MANY: usize = 64;

/// Smallest distance between two parallel lines that enclose the polygon; one of them lies along an edge. For
/// a polygon of many corners, a lower bound of at least a quarter of it.
pub(super) fn width(corners: &[Vec3]) -> f64 {
    if corners.len() > MANY {
        let reach = corners.iter().map(|c| (c - corners[0]).norm()).fold(0.0, f64::max);
        // No polygon has more area than its width times its diameter, which is at most twice the reach.
        return 0.25 * area_vector(corners).norm() / reach;
    }
    let across = |a: Vec3, b: Vec3| {
        let along = unit(&(b - a));
        corners.iter().map(|c| (c - a).cross(&along).norm()).fold(0.0, f64::max)
    };
    edges(corners).map(|(a, b)| across(a, b)).fold(f64::INFINITY, f64::min)
}

/// Corner farthest beyond the line along an edge, and its distance, if that exceeds the tolerance: a dent in
/// the outline.
pub(super) fn dent(corners: &[Vec3], normal: &Vec3, tolerance: f64) -> Option<(f64, usize)> {
    let tree = (corners.len() > MANY).then(|| Places::new(corners));
    let beyond = |(a, b): (Vec3, Vec3)| {
        let outward = unit(&(b - a)).cross(normal);
        if outward.amax() == 0.0 {
            // An edge parallel to the normal defines no side.
            return corners.iter().position(|c| *c == b).map(|corner| ((b - a).norm(), corner));
        }
        let outward = unit(&outward);
        match &tree {
            Some(tree) => {
                let found = tree.highest((&outward, outward.dot(&a)), tolerance, |_| true);
                found.map(|(height, corner)| (height, corner as usize))
            }
            None => {
                let heights = corners.iter().enumerate().map(|(index, c)| (outward.dot(&(c - a)), index));
                heights.filter(|(height, _)| *height > tolerance).max_by(|x, y| x.0.total_cmp(&y.0))
            }
        }
    };
    edges(corners).filter_map(beyond).max_by(|x, y| x.0.total_cmp(&y.0))
}

/// Sides of the convex hull of an outline that runs counter-clockwise about the normal: for each edge of the
/// outline, the two corners of its side. `None` unless all corners lie within the tolerance of their side.
/// (Rounding may give the short edges of a straight side any direction, but moves no corner by more than the
/// tolerance.)
pub(super) fn hull_sides(corners: &[Vec3], normal: &Vec3, tolerance: f64) -> Option<Vec<[usize; 2]>> {
    let count = corners.len();
    let flat = flattened(corners, normal);
    let place = |k: usize| flat[k % count];
    let mut hull = convex_hull(&flat);
    let first = hull.iter().enumerate().min_by_key(|(_, corner)| **corner).map_or(0, |(at, _)| at);
    hull.rotate_left(first);
    if hull.len() < 3 || !hull.is_sorted() {
        // The outline runs clockwise or crosses itself.
        return None;
    }
    hull.push(hull[0] + count);
    let mut sides = vec![[0; 2]; count];
    for side in hull.windows(2) {
        let (a, b) = (place(side[0]), place(side[1]));
        let edge = [b[0] - a[0], b[1] - a[1]];
        let length = (edge[0] * edge[0] + edge[1] * edge[1]).sqrt();
        let is_near = |k: usize| {
            let away = [place(k)[0] - a[0], place(k)[1] - a[1]];
            (edge[0] * away[1] - edge[1] * away[0]).abs() <= tolerance * length
        };
        if !(side[0] + 1..side[1]).all(is_near) {
            return None;
        }
        (side[0]..side[1]).for_each(|k| sides[k % count] = [side[0] % count, side[1] % count]);
    }
    Some(sides)
}

/// Coordinates in the plane across a normal, in which counter-clockwise is about the normal.
fn flattened(corners: &[Vec3], normal: &Vec3) -> Vec<[f64; 2]> {
    let across = unit(&(if normal.x.abs() < 0.6 { Vec3::x() } else { Vec3::y() }).cross(normal));
    let along = across.cross(normal);
    let in_plane = |away: Vec3| [along.dot(&away), across.dot(&away)];
    corners.iter().map(|corner| in_plane(corner - corners[0])).collect()
}

/// Corners of the convex hull of places in a plane, counter-clockwise about its normal.
pub(crate) fn convex_outline(places: &[Vec3], normal: &Vec3) -> Vec<usize> {
    convex_hull(&flattened(places, normal))
}

/// Corners of the convex hull of points in a plane, counter-clockwise (Andrew, 1979).
fn convex_hull(places: &[[f64; 2]]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|&a, &b| {
        places[a][0].total_cmp(&places[b][0]).then(places[a][1].total_cmp(&places[b][1])).then(a.cmp(&b))
    });
    let left_of = |[a, b, c]: [usize; 3]| {
        let [a, b, c] = [places[a], places[b], places[c]];
        (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) > 0.0
    };
    let half = |order: &mut dyn Iterator<Item = usize>| {
        let mut chain: Vec<usize> = Vec::new();
        for corner in order {
            while chain.len() > 1 && !left_of([chain[chain.len() - 2], chain[chain.len() - 1], corner]) {
                chain.pop();
            }
            chain.push(corner);
        }
        // The last corner is the first of the other half.
        chain.pop();
        chain
    };
    let lower = half(&mut order.iter().copied());
    let upper = half(&mut order.iter().rev().copied());
    [lower, upper].concat()
}

pub(super) fn longest_edge(corners: &[Vec3]) -> f64 {
    edges(corners).map(|(a, b)| (b - a).norm()).fold(0.0, f64::max)
}

/// Overlap area of two convex polygons with opposite normals, seen along `normal` (that of the first).
pub(crate) fn overlap_area(first: &[Vec3], second: &[Vec3], normal: &Vec3) -> f64 {
    let mut rest = first.to_vec();
    // The second polygon runs clockwise seen along the first's normal.
    for (b, a) in edges(second) {
        let inward = normal.cross(&(b - a));
        rest = clipped(&rest, &a, &inward);
        if rest.len() < 3 {
            return 0.0;
        }
    }
    0.5 * area_vector(&rest).dot(normal)
}

/// Area of a polygon.
pub(crate) fn area(corners: &[Vec3]) -> f64 {
    0.5 * area_vector(corners).norm()
}

/// Part of a polygon on the inner side of a line.
fn clipped(polygon: &[Vec3], on_line: &Vec3, inward: &Vec3) -> Vec<Vec3> {
    let mut inside = Vec::with_capacity(polygon.len() + 1);
    for (a, b) in edges(polygon) {
        let (height_a, height_b) = (inward.dot(&(a - on_line)), inward.dot(&(b - on_line)));
        if height_a >= 0.0 {
            inside.push(a);
        }
        if (height_a > 0.0 && height_b < 0.0) || (height_a < 0.0 && height_b > 0.0) {
            inside.push(a + (b - a) * (height_a / (height_a - height_b)));
        }
    }
    inside
}
