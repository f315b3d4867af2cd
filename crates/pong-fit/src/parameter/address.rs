//! A name resolved to a number of a built scene.

use crate::error::{FitError, Result};
use pong_engine::ModelId;
use pong_executive::scene::BuiltScene;
use pong_executive::{BodyId, MassProperties, Simulation};

/// Forms of a name, for messages.
const FORMS: &str = "OBJECT.position.x (or rotation, velocity, angular_velocity; y, z), body.BODY.mass, \
                     spring.NUMBER.stiffness.x, gravity.z or surface.MODEL.SURFACE.VALUE";

const AXES: [&str; 3] = ["x", "y", "z"];
const SIX: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];
const MOTIONS: [(&str, &str); 4] =
    [("position", "m"), ("rotation", "rad"), ("velocity", "m/s"), ("angular_velocity", "rad/s")];
const SPRINGS: [&str; 3] = ["stiffness", "damping", "preload"];
const ELEMENTS: [(&str, usize, usize); 6] =
    [("xx", 0, 0), ("yy", 1, 1), ("zz", 2, 2), ("xy", 0, 1), ("xz", 0, 2), ("yz", 1, 2)];

/// A parameter of a scene: a number that a name of docs/campaigns.md finds in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Name, such as `surface.cube.acrylic.friction.mu`.
    pub name: String,
    /// Unit; empty for a pure number.
    pub unit: &'static str,
    /// Value in the scene, in the parameter's unit; 0 for a displacement, 1 for a factor.
    pub in_scene: f64,
    pub(crate) target: Target,
}

/// Number that a parameter sets.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Target {
    /// Displacement of an Object by its first body: quantity by its index in [`MOTIONS`], and axis.
    Motion {
        object: usize,
        quantity: usize,
        axis: usize,
    },
    Body {
        body: BodyId,
        value: BodyValue,
    },
    /// Quantity by its index in [`SPRINGS`]; without an axis the factor of all six.
    Spring {
        number: usize,
        quantity: usize,
        axis: Option<usize>,
    },
    Gravity(usize),
    Surface {
        model: ModelId,
        surface: String,
        value: &'static str,
    },
}

/// Number among the mass properties of a body. The order is the order of setting: factors act last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum BodyValue {
    Mass,
    Inertia(usize, usize),
    MassCenter(usize),
    InertiaFactor,
    MassFactor,
}

impl Parameter {
    /// The parameter of a name.
    ///
    /// # Errors
    /// A name that leads nowhere in the scene, with the names that would.
    pub fn find(name: &str, scene: &BuiltScene) -> Result<Self> {
        let (kind, rest) = name.split_once('.').unwrap_or((name, ""));
        let found = match kind {
            "body" => body(rest, scene),
            "spring" => spring(rest, scene),
            "gravity" => gravity(rest, scene),
            "surface" => of_surface(rest, scene),
            _ => motion(name, scene),
        };
        match found {
            Ok((target, unit, in_scene)) => Ok(Self { name: name.to_owned(), unit, in_scene, target }),
            Err((cause, cure)) => Err(FitError::new(format!("parameter `{name}`"), cause, cure)),
        }
    }

    /// True if the parameter displaces an Object instead of setting a value.
    pub fn displaces(&self) -> bool {
        matches!(self.target, Target::Motion { .. })
    }
}

/// Target, unit and value in the scene; or cause and cure.
type Found = std::result::Result<(Target, &'static str, f64), (String, String)>;

fn motion(name: &str, scene: &BuiltScene) -> Found {
    let parts: Vec<&str> = name.rsplitn(3, '.').collect();
    let nothing = || Err(("it names nothing that a scene has".to_owned(), format!("write {FORMS}")));
    let &[axis, quantity, object] = parts.as_slice() else { return nothing() };
    let axis = AXES.iter().position(|known| *known == axis);
    let quantity = MOTIONS.iter().position(|(known, _)| *known == quantity);
    let (Some(axis), Some(quantity)) = (axis, quantity) else { return nothing() };
    match scene.objects.iter().position(|known| known.name == object) {
        Some(object) => Ok((Target::Motion { object, quantity, axis }, MOTIONS[quantity].1, 0.0)),
        None => {
            let known: Vec<&str> = scene.objects.iter().map(|known| known.name.as_str()).collect();
            Err((format!("there is no Object `{object}`"), format!("name one of: {}", known.join(", "))))
        }
    }
}

/// Splits a name from the path of its value. Names may contain dots; the paths are known.
fn split<'a>(
    rest: &'a str,
    known: &[String],
    thing: &str,
) -> std::result::Result<(&'a str, usize), (String, String)> {
    let found = known.iter().enumerate().find_map(|(place, value)| {
        Some((rest.strip_suffix(value.as_str())?.strip_suffix('.').filter(|name| !name.is_empty())?, place))
    });
    found.ok_or_else(|| (format!("{thing} has no such value"), format!("it has: {}", known.join(", "))))
}

fn body(rest: &str, scene: &BuiltScene) -> Found {
    let mut known = vec![
        ("mass".to_owned(), BodyValue::Mass, "kg"),
        ("mass_factor".to_owned(), BodyValue::MassFactor, ""),
        ("inertia_factor".to_owned(), BodyValue::InertiaFactor, ""),
    ];
    known.extend(ELEMENTS.map(|(name, i, j)| (format!("inertia.{name}"), BodyValue::Inertia(i, j), "kg·m²")));
    known
        .extend((0..3).map(|axis| (format!("mass_center.{}", AXES[axis]), BodyValue::MassCenter(axis), "m")));
    let names: Vec<String> = known.iter().map(|(name, ..)| name.clone()).collect();
    let (name, place) = split(rest, &names, "a body")?;
    let Some((id, held)) = scene.simulation.bodies().find(|(_, body)| body.name == name) else {
        let bodies: Vec<&str> = scene.simulation.bodies().map(|(_, body)| body.name.as_str()).collect();
        return Err((format!("there is no body `{name}`"), format!("name one of: {}", bodies.join(", "))));
    };
    let Some(mass) = held.mass() else {
        let cause = format!("body `{name}` is not free, so that no mass has an effect on its motion");
        return Err((cause, "name a body with motion: Free".to_owned()));
    };
    let (_, value, unit) = known[place];
    Ok((Target::Body { body: id, value }, unit, value.read(mass)))
}

impl BodyValue {
    fn read(self, mass: &MassProperties) -> f64 {
        match self {
            Self::Mass => mass.mass,
            Self::Inertia(i, j) => mass.inertia[(i, j)],
            Self::MassCenter(axis) => mass.mass_center[axis],
            Self::InertiaFactor | Self::MassFactor => 1.0,
        }
    }

    /// Sets the value in mass properties.
    pub fn set(self, mass: &mut MassProperties, value: f64) {
        match self {
            Self::Mass => mass.mass = value,
            Self::Inertia(i, j) => {
                mass.inertia[(i, j)] = value;
                mass.inertia[(j, i)] = value;
            }
            Self::MassCenter(axis) => mass.mass_center[axis] = value,
            Self::InertiaFactor => mass.inertia *= value,
            Self::MassFactor => {
                mass.mass *= value;
                mass.inertia *= value;
            }
        }
    }
}

fn spring(rest: &str, scene: &BuiltScene) -> Found {
    let all = (0..3).flat_map(|quantity| {
        let axes = (0..6).map(move |axis| (quantity, Some(axis)));
        axes.chain([(quantity, None)])
    });
    let known: Vec<(usize, Option<usize>)> = all.collect();
    let name = |&(quantity, axis): &(usize, Option<usize>)| match axis {
        Some(axis) => format!("{}.{}", SPRINGS[quantity], SIX[axis]),
        None => format!("{}_factor", SPRINGS[quantity]),
    };
    let names: Vec<String> = known.iter().map(name).collect();
    let (number, place) = split(rest, &names, "a spring")?;
    let springs = scene.simulation.springs();
    let found = number.parse::<usize>().ok().and_then(|number| Some((number, springs.get(number)?)));
    let Some((number, held)) = found else {
        let cause = format!("there is no spring `{number}`: the scene has {}", springs.len());
        return Err((cause, "count from 0 in the order of the scene".to_owned()));
    };
    let (quantity, axis) = known[place];
    let unit = match (axis, quantity) {
        (None, _) => "",
        (Some(0..3), 0) => "N/m",
        (Some(0..3), 1) => "N·s/m",
        (Some(0..3), _) => "N",
        (Some(_), 0) => "N·m/rad",
        (Some(_), 1) => "N·m·s/rad",
        (Some(_), _) => "N·m",
    };
    let values = [held.stiffness, held.damping, held.preload][quantity];
    Ok((Target::Spring { number, quantity, axis }, unit, axis.map_or(1.0, |axis| values[axis])))
}

fn gravity(rest: &str, scene: &BuiltScene) -> Found {
    match AXES.iter().position(|known| *known == rest) {
        Some(axis) => Ok((Target::Gravity(axis), "m/s²", scene.simulation.gravity()[axis])),
        None => Err((format!("gravity has no `{rest}`"), "it has: x, y, z".to_owned())),
    }
}

fn of_surface(rest: &str, scene: &BuiltScene) -> Found {
    let world = scene.simulation.world();
    let mut known = Vec::new();
    for (model, held) in world.scene().models() {
        for surface in world.surfaces(model).unwrap_or_default() {
            let named = rest.strip_prefix(&format!("{}.{}.", held.name, surface.name));
            let Some(value) = named else {
                known.push(format!("surface.{}.{}", held.name, surface.name));
                continue;
            };
            let values = surface.numbers();
            let Some((name, unit)) = values.iter().find(|(name, _)| *name == value) else {
                let names: Vec<&str> = values.iter().map(|(name, _)| *name).collect();
                let cure =
                    format!("it has: {}; to fit another, give the model a value for it", names.join(", "));
                return Err((format!("the surface has no value `{value}`"), cure));
            };
            let in_scene = surface.clone().number_mut(name).map_or(0.0, |number| *number);
            let target = Target::Surface { model, surface: surface.name.clone(), value: name };
            return Ok((target, unit, in_scene));
        }
    }
    Err(("there is no such surface".to_owned(), format!("begin with one of: {}", known.join(", "))))
}

impl Target {
    /// Sets a value in a simulation's spring.
    pub fn set_in_spring(
        &self,
        simulation: &Simulation,
        value: f64,
    ) -> Option<(usize, pong_executive::Spring)> {
        let Self::Spring { number, quantity, axis } = *self else { return None };
        let mut spring = *simulation.springs().get(number)?;
        let held = match quantity {
            0 => &mut spring.stiffness,
            1 => &mut spring.damping,
            _ => &mut spring.preload,
        };
        match axis {
            Some(axis) => held[axis] = value,
            None => held.iter_mut().for_each(|one| *one *= value),
        }
        Some((number, spring))
    }
}
