//! Least distance of each primitive of each model from any partner in a run.

use super::shape::Shape;
use pong_engine::{EngineError, World};
use pong_geometry::Pose;
use pong_model::Model;
use std::collections::{BTreeMap, BTreeSet};

/// Identity of a model: its hash and its name. Several files of a run may hold the same one.
pub(crate) type Key = (u64, String);

pub(crate) fn key(model: &Model) -> Key {
    (model.hash, model.name.clone())
}

/// Least distances of the primitives of each model to any partner, m, body after body in the order of the file.
pub(crate) type Nearness = BTreeMap<Key, Vec<Vec<f64>>>;

/// Pairs of primitives that have a test in a world, by their kinds, A's first.
pub(crate) fn testers(world: &World) -> BTreeMap<(String, String), usize> {
    let view = world.inspect();
    let mut testers = BTreeMap::new();
    for pair in view.pairs() {
        for (first, second) in [(pair.first, pair.second), (pair.second, pair.first)] {
            for one in &view.body(first).primitives {
                let partners = view.body(second).primitives.iter();
                for other in partners.filter(|other| view.can_be_tested((first, one), (second, other))) {
                    // Two of one kind are tested once, with either as A.
                    if one.kind != other.kind || first == pair.first {
                        let kinds = (one.kind.name().to_owned(), other.kind.name().to_owned());
                        *testers.entry(kinds).or_insert(0) += 1;
                    }
                }
            }
        }
    }
    testers
}

/// Distances between the movable groups of a world, measured frame by frame.
pub(crate) struct Measure<'w> {
    bodies: Vec<Body<'w>>,
    pairs: Vec<Pair>,
    /// Groups named by filters.
    named: BTreeSet<(Key, String)>,
}

struct Body<'w> {
    key: Key,
    /// Index among the movable groups of its model.
    index: usize,
    shapes: Vec<Shape<'w>>,
    /// Path of each primitive.
    paths: Vec<&'w str>,
    /// Least distance of each primitive so far, m.
    least: Vec<f64>,
}

struct Pair {
    /// The pair of Objects.
    pair: usize,
    bodies: [usize; 2],
    /// Primitives of both that are tested against each other.
    tested: Vec<(u32, u32)>,
}

impl<'w> Measure<'w> {
    /// Prepares the measurement; `world` is used for its models only.
    pub fn new(world: &'w World) -> Result<Self, EngineError> {
        let (scene, view) = (world.scene(), world.inspect());
        let mut bodies = Vec::new();
        for object in scene.objects() {
            let model = scene.model_of(object)?;
            for (index, body) in model.bodies.iter().enumerate() {
                bodies.push(Body {
                    key: key(model),
                    index,
                    shapes: (0..body.primitives.len()).map(|primitive| Shape::new(body, primitive)).collect(),
                    paths: body.primitives.iter().map(|info| info.path.as_str()).collect(),
                    least: vec![f64::INFINITY; body.primitives.len()],
                });
            }
        }
        let pairs = view.pairs().iter().map(|pair| {
            let groups = [pair.first, pair.second];
            let infos = groups.map(|group| &view.body(group).primitives);
            let mut tested = Vec::new();
            for (first, one) in infos[0].iter().enumerate() {
                for (second, other) in infos[1].iter().enumerate() {
                    let (a, b) = ((groups[0], one), (groups[1], other));
                    if view.can_be_tested(a, b) || view.can_be_tested(b, a) {
                        tested.push((first as u32, second as u32));
                    }
                }
            }
            Pair { pair: pair.pair, bodies: groups, tested }
        });
        let (pairs, mut named) = (pairs.collect(), BTreeSet::new());
        for object in scene.objects() {
            let model = scene.model_of(object)?;
            named.extend(model.filters.iter().flatten().map(|group| (key(model), group.clone())));
        }
        for (objects, groups) in scene.filters() {
            for (object, group) in objects.into_iter().zip(groups) {
                named.insert((key(scene.model_of(object)?), group.to_owned()));
            }
        }
        Ok(Self { bodies, pairs, named })
    }

    /// Measures a frame of a world with the same Objects and pairs; its own models may be other copies.
    pub fn frame(&mut self, world: &World) -> Result<(), EngineError> {
        let mut poses = Vec::new();
        for object in world.scene().objects() {
            for interface in world.scene().interfaces(object)? {
                poses.push(world.state_as_set(interface)?.map(|state| state.pose()));
            }
        }
        let mut enabled = Vec::new();
        for (pair, _) in world.scene().pairs() {
            enabled.push(world.pair_enabled(pair)?);
        }
        for pair in self.pairs.iter().filter(|pair| enabled[pair.pair]) {
            let [first, second] = pair.bodies;
            if let (Some(x_ca), Some(x_cb)) = (&poses[first], &poses[second]) {
                measure(&mut self.bodies, pair, &Pose::relative(x_ca, x_cb));
            }
        }
        Ok(())
    }

    /// Merges the measured distances into `nearness`.
    pub fn add_to(&self, nearness: &mut Nearness) {
        for body in &self.bodies {
            let model = nearness.entry(body.key.clone()).or_default();
            if model.len() <= body.index {
                model.resize(body.index + 1, Vec::new());
            }
            let least = &mut model[body.index];
            least.resize(body.least.len(), f64::INFINITY);
            least.iter_mut().zip(&body.least).for_each(|(least, new)| *least = least.min(*new));
        }
        self.keep_named(nearness);
    }

    /// Sets the distance of the nearest primitive in every group named by a filter to zero: it stays, so that
    /// the name remains valid.
    fn keep_named(&self, nearness: &mut Nearness) {
        for (model, group) in &self.named {
            let below = format!("{group}/");
            let of_model = self.bodies.iter().filter(|body| body.key == *model);
            let primitives = of_model.flat_map(|body| {
                let all = body.paths.iter().enumerate().filter(|(_, path)| path.starts_with(&below));
                all.map(|(primitive, _)| (body.least[primitive], body.index, primitive))
            });
            let nearest = primitives.min_by(|a, b| a.0.total_cmp(&b.0));
            if let (Some((_, body, primitive)), Some(least)) = (nearest, nearness.get_mut(model)) {
                least[body][primitive] = 0.0;
            }
        }
    }
}

/// Measures the distances of a pair of movable groups; `x_ba` maps from the first to the second.
fn measure(bodies: &mut [Body<'_>], pair: &Pair, x_ba: &Pose) {
    let [first, second] = pair.bodies;
    let x_ba = x_ba.transform();
    let centers: Vec<_> = bodies[first].shapes.iter().map(|shape| x_ba.point(&shape.center)).collect();
    for &(a, b) in &pair.tested {
        let (a, b) = (a as usize, b as usize);
        let (one, other) = (&bodies[first], &bodies[second]);
        // A pair farther apart than both least distances cannot lower either.
        let known = one.least[a].max(other.least[b]);
        let (shape, partner) = (&one.shapes[a], &other.shapes[b]);
        if (centers[a] - partner.center).norm() - shape.radius - partner.radius >= known {
            continue;
        }
        let apart = shape.apart(partner, &x_ba);
        bodies[first].least[a] = bodies[first].least[a].min(apart);
        bodies[second].least[b] = bodies[second].least[b].min(apart);
    }
}
