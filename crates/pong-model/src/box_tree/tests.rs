use super::build::Boxed;
use super::{BoxNode, BoxTree, Child, NarrowBox, WIDTH, lanes, round_down, round_up};
use pong_geometry::Vec3;
use pong_geometry::simd::Portable;
use pong_testkit::Random;
use std::collections::BTreeSet;

fn boxes(count: usize, random: &mut Random, around: &Vec3) -> Vec<Boxed<u32>> {
    let mut corner = || Vec3::from_fn(|_, _| random.unit());
    let one = |item| {
        let low = around + corner();
        Boxed { item, low, high: low + corner() * 0.05 }
    };
    (0..count as u32).map(one).collect()
}

/// Rounding outward never excludes a point, for numbers of every size.
#[test]
fn single_precision_boxes_hold_their_numbers() {
    let mut random = Random(1);
    for exponent in -330..330 {
        let size: f64 = format!("1e{exponent}").parse().unwrap();
        let x = (random.unit() - 0.5) * size;
        for x in [x, f64::from(x as f32), f64::from((x as f32).next_up()), -x] {
            let beyond = x.abs() >= f64::from(f32::MAX);
            assert!(beyond || (f64::from(round_down(x)) <= x && f64::from(round_up(x)) >= x), "{x:e}");
            assert!(round_down(x) <= round_up(x) && round_down(x).is_finite() && round_up(x).is_finite());
            let slack = 4e-7 * x.abs() + 4.0 * f64::from(f32::MIN_POSITIVE);
            let loose = f64::from(round_up(x)) - f64::from(round_down(x));
            assert!(beyond || loose <= slack, "{x:e} {loose:e}");
        }
    }
    let beyond = [f64::NEG_INFINITY, -1e300, -1e39, 1e39, 1e300, f64::INFINITY];
    for (low, high) in beyond.iter().flat_map(|low| beyond.iter().map(move |high| (*low, *high))) {
        assert!(low > high || round_down(low) <= round_up(high), "{low:e} {high:e}");
    }
}

/// Every element that the query touches is found: compared with a test of all elements.
#[test]
fn nothing_that_a_box_touches_is_missed() {
    let mut random = Random(2);
    for count in [0, 1, 7, 8, 9, 64, 65, 96, 513, 3000] {
        let around = Vec3::new(1e4, -3e3, 50.0);
        let mut elements = boxes(count, &mut random, &around);
        let tree = BoxTree::build(&mut elements);
        for _ in 0..200 {
            let low = around + Vec3::from_fn(|_, _| random.unit());
            let high = low + Vec3::from_fn(|_, _| random.unit() * 0.1);
            let mut found = BTreeSet::new();
            tree.visit(Portable, &tree.narrowed(&low, &high), |node, met| {
                for lane in lanes(met) {
                    let Child::Element(place) = node.child(lane) else { panic!("a bottom node") };
                    assert!(found.insert(elements[place as usize].item), "found twice");
                }
            });
            for element in &elements {
                let touches = (0..3).all(|k| element.low[k] <= high[k] && element.high[k] >= low[k]);
                assert!(!touches || found.contains(&element.item));
            }
            assert!(found.len() < 20 + count / 4, "the tree must also leave something out");
        }
    }
}

/// The sphere test inside a box excludes no element that the sphere reaches, also far from the origin. Near
/// the origin, it leaves at most 1 % more elements than it must.
#[test]
fn nothing_that_a_ball_reaches_is_missed() {
    let mut random = Random(4);
    let (mut reached, mut seen) = (0, 0);
    for around in [Vec3::zeros(), Vec3::new(1e4, -3e3, 50.0), Vec3::repeat(1e25)] {
        let mut elements = boxes(3000, &mut random, &around);
        let tree = BoxTree::build(&mut elements);
        for round in 0..200 {
            let center = around + Vec3::from_fn(|_, _| random.unit());
            // Radius that just reaches one of the boxes.
            let element = &elements[round * 7];
            let nearest = center.sup(&element.low).inf(&element.high);
            let radius = (nearest - center).norm().min(0.3);
            let half = Vec3::repeat(radius);
            let query = tree.narrowed(&(center - half), &(center + half));
            let ball = tree.narrowed_ball(&center, radius);
            let mut found = BTreeSet::new();
            tree.visit(Portable, &query, |node, met| {
                for lane in lanes(met & node.boxes.near(Portable, &ball)) {
                    let Child::Element(place) = node.child(lane) else { panic!("a bottom node") };
                    found.insert(elements[place as usize].item);
                }
            });
            for element in &elements {
                let nearest = center.sup(&element.low).inf(&element.high);
                let reaches = (nearest - center).norm() <= radius;
                assert!(!reaches || found.contains(&element.item), "{center} {radius:e}");
                reached += usize::from(reaches && around.x == 0.0);
            }
            seen += if around.x == 0.0 { found.len() } else { 0 };
        }
    }
    assert!(reached > 1000 && seen <= reached + reached / 100, "{reached} {seen}");
}

/// Bottom nodes are full except the last of a part, all are at the same depth, and every node bounds what is
/// below it.
#[test]
fn nodes_are_full_and_hold_what_is_below() {
    let mut random = Random(3);
    for count in [8, 96, 5000] {
        let mut elements = boxes(count, &mut random, &Vec3::zeros());
        let tree = BoxTree::build(&mut elements);
        let bottoms = tree.nodes.iter().filter(|node| node.is_bottom());
        assert_eq!(bottoms.count(), count.div_ceil(WIDTH));
        check(&tree, (&tree.nodes[0], tree.levels), 0..count as u32);
    }
}

fn check(tree: &BoxTree, (node, levels): (&BoxNode, u32), expected: std::ops::Range<u32>) {
    assert_eq!(node.elements, expected);
    assert_eq!(node.is_bottom(), levels == 0);
    let mut next = expected.start;
    for (lane, child) in node.children().enumerate() {
        match child {
            Child::Element(place) => {
                assert_eq!(place, next);
                next += 1;
            }
            Child::Node(child) => {
                let child = &tree.nodes[child as usize];
                let below = (0..WIDTH).map(|below| child.boxes.lane(below));
                let around = below.fold(NarrowBox::NOTHING, |all, one| all.join(&one));
                assert_eq!(around, child.boxes.around());
                assert_eq!(around, node.boxes.lane(lane));
                check(tree, (child, levels - 1), next..child.elements.end);
                next = child.elements.end;
            }
        }
    }
    assert_eq!(next, expected.end);
}

#[test]
fn unbounded_elements_are_always_met() {
    let infinite = Vec3::repeat(f64::INFINITY);
    let tree = BoxTree::build(&mut [Boxed { item: 0_u32, low: -infinite, high: infinite }]);
    let mut met = 0;
    tree.visit(Portable, &tree.narrowed(&Vec3::repeat(1e90), &Vec3::repeat(2e90)), |_, bits| {
        met += bits.count_ones()
    });
    assert_eq!(met, 1);
    assert!(tree.around == NarrowBox::EVERYTHING);
}
