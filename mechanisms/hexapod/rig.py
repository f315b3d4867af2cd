"""A hexapod on a plane or on the terrain, as MJCF."""

import math

import dimensions as d
import leg
import mujoco
import numpy as np

from kit import mjcf
from kit.machine import Machine, wrenches

LEGS = range(6)
JOINTS = ("coxa", "femur", "tibia")
BLUE, STEEL, DARK = "0.25 0.42 0.62 1", "0.6 0.62 0.65 1", "0.25 0.25 0.27 1"
LEVEL = (0.0, 0.0, -d.GRAVITY)
BEHIND = 1.0  # m of terrain behind the start


class Hexapod(Machine):
    def forces(self):
        """Force on each foot, along the axes of the world, N."""
        return wrenches(self.data.sensordata[self.sensed])[-6:, :3]


def rod(length, mass):
    across = mass * length**2 / 12
    return (
        f'<inertial pos="{length / 2:.12g} 0 0" mass="{mass}" diaginertia="{0.02 * across:.6g} {across:.6g} {across:.6g}"/>'
        f'<geom type="capsule" fromto="0 0 0 {length:.12g} 0 0" size="0.011" rgba="{STEEL}" contype="0" conaffinity="0"/>'
    )


def joint(name, axis):
    return f'<joint name="{name}" axis="{axis}" armature="{d.ROTOR_INERTIA}"/>'


def leg_body(i):
    x, y = leg.hip(i)
    ball = (
        f'<site name="foot_{i}" pos="{d.TIBIA:.12g} 0 0"/><geom name="foot_{i}" type="sphere" pos="{d.TIBIA:.12g} 0 0" '
        f'size="{d.FOOT_RADIUS}" mass="0" rgba="{DARK}" contype="0" conaffinity="1"/>'
    )
    tibia = f'<body name="tibia_{i}" pos="{d.FEMUR:.12g} 0 0">{joint(f"tibia_{i}", "0 -1 0")}{rod(d.TIBIA, d.TIBIA_MASS)}{ball}</body>'
    femur = f'<body name="femur_{i}" pos="{d.COXA:.12g} 0 0">{joint(f"femur_{i}", "0 -1 0")}{rod(d.FEMUR, d.FEMUR_MASS)}{tibia}</body>'
    turned = mjcf.numbers(mjcf.quaternion_about_z(d.AZIMUTHS[i]))
    return (
        f'<body name="coxa_{i}" pos="{x:.12g} {y:.12g} 0" quat="{turned}">{joint(f"coxa_{i}", "0 0 1")}'
        f"{rod(d.COXA, d.COXA_MASS)}{femur}</body>"
    )


def body():
    a, b, c = d.BODY_SIZE
    inertia = mjcf.numbers(d.BODY_MASS / 12 * np.array((b * b + c * c, a * a + c * c, a * a + b * b)))
    return (
        f'<body name="body"><freejoint name="body"/><inertial pos="0 0 0" mass="{d.BODY_MASS}" diaginertia="{inertia}"/>'
        f'<geom type="cylinder" size="{d.HIPS} {c / 2}" rgba="{BLUE}" contype="0" conaffinity="0"/>'
        f"{''.join(map(leg_body, LEGS))}</body>"
    )


def servos(stiffer):
    """Servos that hold angles: torque k·(commanded − angle) − c·speed, limited."""
    k, c, most = stiffer * d.SERVO_STIFFNESS, math.sqrt(stiffer) * d.SERVO_DAMPING, d.SERVO_TORQUE
    return "".join(
        f'<general name="{name}_{i}" joint="{name}_{i}" gainprm="{k}" biastype="affine" biasprm="0 {-k} {-c}" '
        f'forcelimited="true" forcerange="{-most} {most}"/>'
        for i in LEGS
        for name in JOINTS
    )


def slope(angle, azimuth=0.0):
    """Gravity on a slope that rises towards an azimuth; the ground stays in the plane z = 0."""
    down = math.sin(angle)
    return tuple(-d.GRAVITY * x for x in (down * math.cos(azimuth), down * math.sin(azimuth), math.cos(angle)))


def ground(tiles):
    """MJCF, Objects, carriers: the plane, or a row of terrain tiles."""
    if not tiles:
        drawn = '<geom name="ground" type="plane" size="20 20 1" rgba="0.72 0.7 0.66 1" contype="1" conaffinity="0"/>'
        return drawn, {"ground": "plane.ron"}, {"ground": "world"}
    names = [f"tile_{k}" for k in range(tiles)]
    drawn = "".join(
        f'<body name="{name}" pos="{k * d.TILE - BEHIND:.12g} 0 0"><geom type="mesh" mesh="terrain" rgba="0.72 0.66 0.58 1" '
        'contype="0" conaffinity="0"/></body>'
        for k, name in enumerate(names)
    )
    return drawn, dict.fromkeys(names, "terrain.ron"), {name: name for name in names}


def text(step, tiles=0, gravity=LEVEL, stiffer=1.0, friction=None):
    """MJCF, and the carrier bodies of the contact groups."""
    drawn, objects, bodies = ground(tiles)
    under = list(objects)
    for i in LEGS:
        objects[f"foot_{i}"], bodies[f"foot_{i}"] = "foot.ron", f"tibia_{i}"
    pairs = [(f"foot_{i}", name) for i in LEGS for name in under]
    extension = mjcf.contact_instance(objects, pairs, bodies, folder=str(d.HERE), capacity=64, friction=friction)
    mesh = f'<asset><mesh name="terrain" file="{d.HERE / "terrain.obj"}" inertia="shell"/></asset>' if tiles else ""
    more = f"<actuator>{servos(stiffer)}</actuator>{mesh}"
    return mjcf.model("hexapod", extension, drawn + body(), more, step, gravity=gravity), list(bodies.values())


def sunk():
    """Depth of six feet in level ground."""
    return d.MASS * d.GRAVITY / (6 * d.STIFFNESS)


def machine(step, tiles=0, gravity=LEVEL, height=d.HEIGHT, above=0.0, stiffer=1.0, made=None, friction=None):
    """Stand on all feet; `above`: height above the position of first contact with the plane, m.

    `stiffer`: by what its servos are stiffer. `made`: the class of machine, for other contacts. `friction`: of feet and ground.
    """
    hexapod = (made or Hexapod)(*text(step, tiles, gravity, stiffer, friction))
    pose(hexapod, [leg.neutral(i, height) for i in LEGS], height + d.FOOT_RADIUS + above)
    return hexapod


def pose(hexapod, places, height):
    """Joint angles for positions of the feet in the body, with a level body at a height above its start."""
    told = leg.all_angles(places)
    hexapod.data.qpos[:7] = (0.0, 0.0, height, 1.0, 0.0, 0.0, 0.0)
    hexapod.data.qpos[7:] = told
    hexapod.data.ctrl[:] = told
    hexapod.start()


def tell(hexapod, places):
    hexapod.data.ctrl[:] = leg.all_angles(places)


def feet(hexapod):
    """Positions of the feet in the world."""
    return np.array([hexapod.data.site(f"foot_{i}").xpos for i in LEGS])


def mass_centre(hexapod):
    return hexapod.data.subtree_com[hexapod.model.body("body").id].copy()


def tilt(hexapod):
    """Angle between the body and the ground, rad."""
    return math.acos(min(1.0, hexapod.data.body("body").xmat[8]))


def foot_velocity(hexapod, i):
    """Velocity of a foot's contact point on level ground, m/s."""
    velocity = np.empty(6)
    site = hexapod.model.site(f"foot_{i}").id
    mujoco.mj_objectVelocity(hexapod.model, hexapod.data, mujoco.mjtObj.mjOBJ_SITE, site, velocity, 0)
    return velocity[3:] + np.cross(velocity[:3], (0.0, 0.0, -d.FOOT_RADIUS))
