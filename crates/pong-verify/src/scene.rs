//! Model files → sealed world → simulation.

use crate::case::Failure;
use pong_engine::{Config, Contact, InterfaceId, ModelId, ObjectId, World, WorldBuilder};
use pong_executive::{BodyId, Integrator, MassProperties, Pose, RigidBody, Simulation, Twist, Vec3};
use pong_model::{Extensions, FrictionLaw, NormalLaw, Surface};
use std::sync::Arc;

/// Standard gravity of all cases, m/s².
pub const G: f64 = 9.81;

/// Model files of `models/verification`.
macro_rules! files {
    ($($name:literal),* $(,)?) => {
        const FILES: &[(&str, &str)] = &[$((
            $name,
            include_str!(concat!("../../../models/verification/", $name, ".ron")),
        )),*];
    };
}

files![
    "ball",
    "ball_large_rough",
    "ball_rough",
    "bar",
    "block_rough",
    "box_points",
    "ellipsoid",
    "ellipsoid_rough",
    "ground",
    "ground_coulomb",
    "ground_hertz",
    "ground_hunt_crossley",
    "ground_rigid",
    "ground_rough",
    "hole",
    "mesh_rough",
    "peg",
    "point",
    "point_coulomb",
    "point_hertz",
    "point_hunt_crossley",
    "point_hunt_crossley_restitution",
    "point_power_law",
    "point_restitution",
    "point_rough",
    "probe",
    "ray_axial",
    "ray_normal",
    "ridge_rough",
    "socket",
    "target_polyhedron",
    "target_triangle",
    "tiles_rough",
    "tripod",
    "tripod_rough",
    "trough_120",
    "trough_60",
    "trough_90",
];

/// A world under construction from files.
pub struct Scene {
    pub world: WorldBuilder,
    models: Vec<(String, ModelId)>,
}

impl Scene {
    pub fn new(ledger: bool) -> Self {
        Self { world: WorldBuilder::new(Config { ledger, ..Config::default() }), models: Vec::new() }
    }

    /// Creates an Object from a model file; a file used twice is loaded once.
    pub fn add(&mut self, file: &str, name: &str) -> Result<ObjectId, Failure> {
        let model = match self.models.iter().find(|(known, _)| known == file) {
            Some((_, model)) => *model,
            None => self.load(file, |_| ())?,
        };
        Ok(self.world.create_object(model, name)?)
    }

    /// Loads a file with a changed surface, possibly with other laws.
    fn load(&mut self, file: &str, change: impl FnOnce(&mut Surface)) -> Result<ModelId, Failure> {
        let found = FILES.iter().find(|(name, _)| *name == file);
        let (_, text) = found.ok_or_else(|| format!("there is no model file `{file}`"))?;
        let mut model = pong_model::parse(text, &format!("{file}.ron"), None, &Extensions::new())
            .map_err(|errors| errors.to_string())?;
        change(&mut model.surfaces[0]);
        let id = self.world.add_model(Arc::new(model));
        self.models.push((file.to_owned(), id));
        Ok(id)
    }

    /// Changes the values of a file's only surface.
    pub fn tune(&mut self, file: &str, change: impl FnOnce(&mut Surface)) -> Result<(), Failure> {
        let found = self.models.iter().find(|(known, _)| known == file);
        let (_, model) = found.ok_or_else(|| format!("`{file}` has not been loaded"))?;
        let mut surface = self.world.surface(*model, "s")?.clone();
        change(&mut surface);
        Ok(self.world.set_surface(*model, &surface)?)
    }

    /// Adds a pair of Objects.
    pub fn pair(&mut self, a: ObjectId, b: ObjectId) -> Result<(), Failure> {
        self.world.pair(a, b)?;
        Ok(())
    }

    /// The root's Interface of an Object.
    pub fn root(&self, object: ObjectId) -> Result<InterfaceId, Failure> {
        Ok(self.world.scene().interface(object, "")?)
    }

    /// Ends set-up.
    pub fn seal(self) -> Result<World, Failure> {
        let (world, _) = self.world.seal()?;
        Ok(world)
    }
}

/// A mass with a huge inertia: contact acts slightly off its centre, where the surfaces have yielded, and
/// would otherwise spin it up.
pub fn point_mass(mass: f64) -> RigidBody {
    RigidBody::free("mass", MassProperties::principal(mass, [1e9; 3]))
}

/// Two Objects, one of which is usually at rest.
pub struct Duo {
    pub scene: Scene,
    files: [String; 2],
    objects: [ObjectId; 2],
}

impl Duo {
    /// A mover and a ground.
    pub fn new(mover: &str, ground: &str) -> Result<Self, Failure> {
        Self::with_ledger(mover, ground, false)
    }

    /// As [`new`](Self::new), with the energy ledger if requested.
    pub fn with_ledger(mover: &str, ground: &str, ledger: bool) -> Result<Self, Failure> {
        let mut scene = Scene::new(ledger);
        let objects = [scene.add(mover, "mover")?, scene.add(ground, "ground")?];
        scene.pair(objects[0], objects[1])?;
        Ok(Self { scene, files: [mover, ground].map(str::to_owned), objects })
    }

    /// A mover whose surface has other laws than its file, and a ground.
    pub fn with_laws(mover: &str, ground: &str, change: impl FnOnce(&mut Surface)) -> Result<Self, Failure> {
        let mut scene = Scene::new(false);
        scene.load(mover, change)?;
        let objects = [scene.add(mover, "mover")?, scene.add(ground, "ground")?];
        scene.pair(objects[0], objects[1])?;
        Ok(Self { scene, files: [mover, ground].map(str::to_owned), objects })
    }

    /// Changes the mover's surface.
    pub fn mover(mut self, change: impl FnOnce(&mut Surface)) -> Result<Self, Failure> {
        self.scene.tune(&self.files[0], change)?;
        Ok(self)
    }

    /// Changes the ground's surface.
    pub fn ground(mut self, change: impl FnOnce(&mut Surface)) -> Result<Self, Failure> {
        self.scene.tune(&self.files[1], change)?;
        Ok(self)
    }

    /// The sealed world and both Interfaces.
    pub fn world(self) -> Result<(World, [InterfaceId; 2]), Failure> {
        let interfaces = [self.scene.root(self.objects[0])?, self.scene.root(self.objects[1])?];
        Ok((self.scene.seal()?, interfaces))
    }

    /// A simulation of a mover above ground at rest.
    pub fn on_ground(self, method: (Integrator, f64), mover: RigidBody) -> Result<Run, Failure> {
        self.simulate(method, mover, RigidBody::fixed("ground"))
    }

    /// A simulation of both bodies, whose Interfaces are filled in.
    pub fn simulate(
        self,
        (integrator, step): (Integrator, f64),
        mover: RigidBody,
        ground: RigidBody,
    ) -> Result<Run, Failure> {
        let (world, interfaces) = self.world()?;
        let mut sim = Simulation::new(world, integrator, step)?;
        let body = sim.add_body(mover.touching(interfaces[0]))?;
        let ground = sim.add_body(ground.touching(interfaces[1]))?;
        Ok(Run { sim, body, ground })
    }
}

/// Pose at a position, along the common axes.
pub fn at(position: Vec3) -> Pose {
    Pose { position, ..Pose::identity() }
}

/// Twist without rotation.
pub fn moving(linear: Vec3) -> Twist {
    Twist { linear, angular: Vec3::zeros() }
}

/// A simulation of a mover and a ground.
pub struct Run {
    pub sim: Simulation,
    pub body: BodyId,
    pub ground: BodyId,
}

impl Run {
    /// Turns gravity on, straight down.
    pub fn with_gravity(mut self) -> Self {
        self.sim.set_gravity(Vec3::new(0.0, 0.0, -G));
        self
    }

    pub fn position(&self) -> Vec3 {
        self.sim.pose(self.body).position
    }

    pub fn velocity(&self) -> Vec3 {
        self.sim.twist(self.body).linear
    }

    pub fn spin(&self) -> Vec3 {
        self.sim.twist(self.body).angular
    }

    pub fn contacts(&self) -> Vec<Contact> {
        self.sim.world().contacts()
    }

    /// The single contact; an error if there are more or none.
    pub fn contact(&self) -> Result<Contact, Failure> {
        match self.contacts().as_slice() {
            [one] => Ok(*one),
            others => {
                Err(format!("{} contacts at t = {} s instead of one", others.len(), self.sim.time()).into())
            }
        }
    }
}

/// Sets the stiffness, N/m, and the damping of the linear law, N·s/m.
pub fn set_spring(surface: &mut Surface, stiffness: f64, damping: f64) {
    surface.stiffness = stiffness;
    set_damping(surface, damping);
}

/// Sets the damping of the linear law, N·s/m.
pub fn set_damping(surface: &mut Surface, value: f64) {
    if let NormalLaw::Linear { damping, .. } = &mut surface.normal {
        *damping = value;
    }
}

/// Sets the depth over which the damping of the linear law sets in, m.
pub fn set_ramp(surface: &mut Surface, value: f64) {
    if let NormalLaw::Linear { ramp, .. } = &mut surface.normal {
        *ramp = value;
    }
}

/// Sets the dissipation of the Hunt-Crossley law, s/m.
pub fn set_dissipation(surface: &mut Surface, value: f64) {
    if let NormalLaw::HuntCrossley { dissipation, .. } = &mut surface.normal {
        *dissipation = value;
    }
}

/// Parameters of a bristle.
#[derive(Clone, Copy, Debug)]
pub struct Bristle {
    /// Coefficient of kinetic friction μ_k.
    pub mu: f64,
    /// Static excess: the ratio μ_s/μ_k − 1.
    pub excess: f64,
    /// Tangential stiffness k_t, N/m.
    pub stiffness: f64,
    /// Tangential damping c_t, N·s/m.
    pub damping: f64,
}

/// Sets the friction of a surface.
pub fn set_bristle(surface: &mut Surface, bristle: &Bristle) {
    surface.friction = FrictionLaw::Bristle {
        mu: bristle.mu,
        static_excess: bristle.excess,
        stiffness: Some(bristle.stiffness),
        damping: Some(bristle.damping),
        rolling: 0.0,
        spinning: 0.0,
    };
}

/// Gives the pair these friction values: the ground's bristle is rigid.
pub fn with_friction(duo: Duo, bristle: &Bristle) -> Result<Duo, Failure> {
    let (mu, excess) = (bristle.mu, bristle.excess);
    let ground = FrictionLaw::Bristle {
        mu,
        static_excess: excess,
        stiffness: None,
        damping: Some(0.0),
        rolling: 0.0,
        spinning: 0.0,
    };
    duo.mover(|s| set_bristle(s, bristle))?.ground(|s| s.friction = ground)
}
