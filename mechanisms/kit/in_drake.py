"""A machine in Drake (`pip install drake`), which moves the bodies and computes the contacts.

Drake's own reader takes bodies, joints and masses from the MJCF. Motors, springs and dampers of joints and what a host
applies are computed by MuJoCo at the same state, and given to Drake as forces on the joints at the beginning of each step.
So the inputs are the same numbers, and controllers and rigs need not know who moves the machine. Limits of joints and
loops that MuJoCo closes by `connect` are Drake's own: its solver holds them as hard as the step allows.

Contact is Drake's point contact: one pair of points for two convex shapes. Two ways of Drake, fixed beforehand:

`SAP`      with the stiffness K and the time of relaxation C/K: K·(r + v·C/K) is the law of Pong's linear damper.
`LAGGED`   what Drake takes if nothing is said, with the stiffness K and Drake's own dissipation (Hunt and Crossley).
"""

import xml.etree.ElementTree as xml

import mujoco
import numpy as np

from kit.ledger import add_applied
from kit.own_contact import DEFAULT, Own

SAP, LAGGED = "sap", "lagged"
GEOM = mujoco.mjtGeom


def at_hand():
    try:
        import pydrake.multibody.plant  # noqa: F401
    except ImportError:
        print("Drake is not installed, so its columns are missing: pip install drake")
        return False
    return True


class InDrake(Own):
    """Replacement of a `Machine`. Its MuJoCo model holds Drake's state, and computes forces of joints."""

    def __init__(self, text, carriers, way, movers, grounds):
        self.simulator, self.steps = None, 0
        super().__init__(text, carriers, DEFAULT, movers, grounds)
        self.model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
        self._build(way, movers, grounds)
        self.start()

    def start(self):
        """Call after setting positions or velocities in the MuJoCo model."""
        mujoco.mj_forward(self.model, self.data)
        if self.simulator is not None:
            self._give_state()
            self._give_forces()

    def hurry(self, control=None):
        if control is not None:
            control(self)
        mujoco.mj_forward(self.model, self.data)
        self._give_forces()
        # Drake steps at whole multiples of the step; half a step more, so that rounding can neither lose a step nor add
        # one.
        self.simulator.AdvanceTo((self.steps + 0.5) * self.step)
        self.steps += 1
        self._take_state()

    def pushes(self):
        """(geom, geom, position, force on the second) of each contact, along the axes of the world."""
        mujoco.mj_forward(self.model, self.data)
        self._give_forces()
        found = self.plant.get_contact_results_output_port().Eval(self.context)
        for k in range(found.num_point_pair_contacts()):
            info = found.point_pair_contact_info(k)
            first, second = (self.geoms[i] for i in (info.point_pair().id_A, info.point_pair().id_B))
            yield first, second, info.contact_point(), info.contact_force()

    def contacts(self):
        return len(list(self.pushes()))

    def _build(self, way, movers, grounds):
        from pydrake.multibody.parsing import Parser
        from pydrake.multibody.plant import AddMultibodyPlant, MultibodyPlantConfig
        from pydrake.systems.analysis import Simulator
        from pydrake.systems.framework import DiagramBuilder

        builder = DiagramBuilder()
        how = MultibodyPlantConfig(time_step=self.step, contact_model="point", discrete_contact_approximation=way)
        self.plant, self.scene = AddMultibodyPlant(how, builder)
        Parser(self.plant).AddModelsFromString(_for_drake(self.text), "xml")
        self.plant.mutable_gravity_field().set_gravity_vector(np.zeros(3))
        self._shapes(way, movers, grounds)
        self._rotors()
        self._loops()
        self.plant.Finalize()
        self.simulator = Simulator(builder.Build())
        self.context = self.plant.GetMyMutableContextFromRoot(self.simulator.get_mutable_context())
        self.places = self._places()
        self.port = self.plant.get_applied_generalized_force_input_port()

    def _shapes(self, way, movers, grounds):
        """Adds contact geometry: grounds are rigid; movers have the stiffness of the pair. Friction: of the pair, see
        `_of_mover`."""
        from pydrake.geometry import CollisionFilterDeclaration, GeometrySet

        self.geoms, ground = {}, max(surface.friction for surface in movers.values())
        for name in (*movers, *grounds):
            geom, surface = self.model.geom(name).id, movers.get(name)
            friction = _of_mover(surface.friction, ground) if surface else ground
            self.geoms[self._register(geom, name, _properties(surface, friction, way))] = geom
        sides = [[i for i, g in self.geoms.items() if self.model.geom(g).name in side] for side in (movers, grounds)]
        for side in sides:
            self.scene.collision_filter_manager().Apply(CollisionFilterDeclaration().ExcludeWithin(GeometrySet(side)))

    def _register(self, geom, name, about):
        from pydrake.math import RigidTransform
        from pydrake.common.eigen_geometry import Quaternion

        body = self.model.body(self.model.geom_bodyid[geom]).name
        quaternion = self.model.geom_quat[geom] / np.linalg.norm(self.model.geom_quat[geom])
        place = RigidTransform(Quaternion(quaternion), self.model.geom_pos[geom])
        carrier = self.plant.world_body() if body == "world" else self.plant.GetBodyByName(body)
        return self.plant.RegisterCollisionGeometry(carrier, place, _shape(self.model, geom), name, about)

    def _rotors(self):
        """MuJoCo's `armature` is the inertia of a rotor without a gear ratio."""
        for j in range(self.model.njnt):
            inertia = self.model.dof_armature[self.model.jnt_dofadr[j]]
            if inertia > 0.0:
                name = self.model.joint(j).name
                motor = self.plant.AddJointActuator(f"rotor_{name}", self.plant.GetJointByName(name))
                motor.set_default_rotor_inertia(inertia)
                motor.set_default_gear_ratio(1.0)

    def _loops(self):
        """Adds the constraints of MuJoCo's `connect`: a point of one body stays at a point of another."""
        for k in range(self.model.neq):
            if self.model.eq_type[k] != mujoco.mjtEq.mjEQ_CONNECT:
                raise ValueError("this constraint is not among those that are given to Drake")
            names = (self.model.body(b).name for b in (self.model.eq_obj1id[k], self.model.eq_obj2id[k]))
            one, other = (self.plant.GetBodyByName(name) for name in names)
            self.plant.AddBallConstraint(one, self.model.eq_data[k, :3], other, self.model.eq_data[k, 3:6])

    def _places(self):
        """Start indices of joints in MuJoCo's two and Drake's two vectors: of free ones, of balls, and, as columns, of
        all others."""
        free, balls, others = [], [], []
        for j in range(self.model.njnt):
            joint, own = self.model.joint(j), (self.model.jnt_qposadr[j], self.model.jnt_dofadr[j])
            if joint.type[0] == mujoco.mjtJoint.mjJNT_FREE:
                body = self.plant.GetBodyByName(self.model.body(self.model.jnt_bodyid[j]).name)
                free.append((*own, body.floating_positions_start(), body.floating_velocities_start_in_v()))
            else:
                other = self.plant.GetJointByName(joint.name)
                kind = balls if joint.type[0] == mujoco.mjtJoint.mjJNT_BALL else others
                kind.append((*own, other.position_start(), other.velocity_start()))
        return free, balls, np.array(others, dtype=int).reshape(-1, 4).T

    def _give_state(self):
        """Converts the state. Drake has the quaternion before the position, the angular velocity before the velocity,
        and in the world. A ball joint has roll, pitch and yaw, and its angular velocity in the axes of its parent."""
        from pydrake.math import RollPitchYaw, RotationMatrix

        d, positions, speeds = self.data, np.zeros(self.plant.num_positions()), np.zeros(self.plant.num_velocities())
        free, balls, (q, v, to_q, to_v) = self.places
        positions[to_q], speeds[to_v] = d.qpos[q], d.qvel[v]
        for q, v, to_q, to_v in free:
            positions[to_q : to_q + 4], positions[to_q + 4 : to_q + 7] = d.qpos[q + 3 : q + 7], d.qpos[q : q + 3]
            speeds[to_v : to_v + 3] = _turned(d.qpos[q + 3 : q + 7]) @ d.qvel[v + 3 : v + 6]
            speeds[to_v + 3 : to_v + 6] = d.qvel[v : v + 3]
        for q, v, to_q, to_v in balls:
            turned = _turned(d.qpos[q : q + 4])
            positions[to_q : to_q + 3] = RollPitchYaw(RotationMatrix(turned)).vector()
            speeds[to_v : to_v + 3] = turned @ d.qvel[v : v + 3]
        self.plant.SetPositions(self.context, positions)
        self.plant.SetVelocities(self.context, speeds)

    def _take_state(self):
        from pydrake.math import RollPitchYaw

        d, positions, speeds = self.data, *self._found()
        free, balls, (q, v, from_q, from_v) = self.places
        d.qpos[q], d.qvel[v] = positions[from_q], speeds[from_v]
        for q, v, from_q, from_v in free:
            d.qpos[q : q + 3], d.qpos[q + 3 : q + 7] = (
                positions[from_q + 4 : from_q + 7],
                positions[from_q : from_q + 4],
            )
            d.qvel[v : v + 3] = speeds[from_v + 3 : from_v + 6]
            d.qvel[v + 3 : v + 6] = _turned(d.qpos[q + 3 : q + 7]).T @ speeds[from_v : from_v + 3]
        for q, v, from_q, from_v in balls:
            d.qpos[q : q + 4] = RollPitchYaw(positions[from_q : from_q + 3]).ToQuaternion().wxyz()
            d.qvel[v : v + 3] = _turned(d.qpos[q : q + 4]).T @ speeds[from_v : from_v + 3]
        d.time += self.step
        mujoco.mj_kinematics(self.model, d)

    def _found(self):
        return self.plant.GetPositions(self.context), self.plant.GetVelocities(self.context)

    def _give_forces(self):
        """Applies the forces of motors, springs, dampers, hosts and gravity on the joints."""
        d, forces = self.data, np.zeros(self.plant.num_velocities())
        given = d.qfrc_actuator + d.qfrc_passive + d.qfrc_applied + self._weight()
        add_applied(self.model, d, given)
        free, balls, (_, v, _, to) = self.places
        forces[to] = given[v]
        for q, v, _, to in free:
            forces[to : to + 3] = _turned(d.qpos[q + 3 : q + 7]) @ given[v + 3 : v + 6]
            forces[to + 3 : to + 6] = given[v : v + 3]
        for q, v, _, to in balls:
            forces[to : to + 3] = _turned(d.qpos[q : q + 4]) @ given[v : v + 3]
        self.port.FixValue(self.context, forces)

    def _weight(self):
        """Gravity as a joint force: it may turn while a machine runs; Drake's cannot, so Drake has none."""
        if not self.model.opt.gravity.any():
            return 0.0
        gravity, without = self.model.opt.gravity.copy(), np.empty(self.model.nv)
        self.model.opt.gravity[:] = 0.0
        mujoco.mj_rne(self.model, self.data, 0, without)
        self.model.opt.gravity[:] = gravity
        return without - self.data.qfrc_bias


def _for_drake(text):
    """Bodies, joints and masses only; everything else is passed in other ways."""
    root = xml.fromstring(text)
    for child in list(root):
        if child.tag not in ("compiler", "worldbody"):
            root.remove(child)
    for parent in list(root.iter()):
        for child in list(parent):
            if child.tag in ("geom", "site"):
                parent.remove(child)
            elif child.tag == "joint":
                for key in ("stiffness", "damping", "armature"):
                    child.attrib.pop(key, None)
    for parent in list(root.iter()):
        for body in parent.findall("body"):
            _split(parent, body)
    return xml.tostring(root, encoding="unicode")


def _split(parent, body):
    """Splits a body with several joints into bodies with one each: Drake's reader places only the last one correctly."""
    *first, _ = body.findall("joint") or [None]
    for number, joint in enumerate(first):
        place = {key: body.attrib.pop(key) for key in ("pos", "quat") if key in body.attrib}
        outer = xml.Element("body", name=f"{body.get('name')}_before_{number}", **place)
        body.remove(joint)
        outer.append(joint)
        parent.remove(body)
        parent.append(outer)
        outer.append(body)
        parent = outer


def _of_mover(pair, ground):
    """Coefficient of friction of a mover: for two surfaces Drake takes 2·a·b/(a + b), and the pair must have its own."""
    return pair * ground / (2.0 * ground - pair) if pair else 0.0


def _properties(surface, friction, way):
    """`surface` is None for a rigid ground."""
    from pydrake.geometry import AddContactMaterial, ProximityProperties
    from pydrake.multibody.plant import CoulombFriction

    made = ProximityProperties()
    # A factor of 1e9 over the other's is as good as infinite.
    stiffness = surface.stiffness if surface else 1e16
    AddContactMaterial(made, point_stiffness=stiffness, friction=CoulombFriction(friction, friction))
    if way == SAP:
        # Relaxation times of a pair are added.
        made.AddProperty("material", "relaxation_time", surface.damping / surface.stiffness if surface else 0.0)
    return made


def _shape(model, geom):
    from pydrake import geometry as g

    size, kind = model.geom_size[geom], model.geom_type[geom]
    if kind == GEOM.mjGEOM_MESH:
        mesh = model.geom_dataid[geom]
        first = model.mesh_vertadr[mesh]
        return g.Convex(
            points=model.mesh_vert[first : first + model.mesh_vertnum[mesh]].T.astype(float), label="piece"
        )
    if kind == GEOM.mjGEOM_PLANE:
        return g.HalfSpace()
    if kind == GEOM.mjGEOM_SPHERE:
        return g.Sphere(size[0])
    if kind == GEOM.mjGEOM_CYLINDER:
        return g.Cylinder(size[0], 2 * size[1])
    if kind == GEOM.mjGEOM_ELLIPSOID:
        return g.Ellipsoid(*size)
    raise ValueError(f"this geom is not among those that are given to Drake: {kind}")


def _turned(quaternion):
    matrix = np.empty(9)
    mujoco.mju_quat2Mat(matrix, quaternion)
    return matrix.reshape(3, 3)
