"""Platform with a driven claw, payload with pins, and arms, as MJCF."""

import dimensions as d
import numpy as np
from kit import mjcf
from kit.machine import Machine

VANES = list(d.AZIMUTHS)
AXES = ("x", "y", "z", "roll", "pitch", "yaw")
CARRIERS = ["world", *VANES, "claw", "payload"]
GROUPS = ["platform", *VANES, "claw", "payload"]
STEEL, BLUE, GOLD = "0.55 0.57 0.6 1", "0.3 0.45 0.65 0.35", "0.75 0.6 0.3 1"
ROUGH = f"friction: Bristle(mu: {d.FRICTION})"
SMOOTH = "friction: None"
# Bristles stiff enough that all of them slip within the deflection of the flanks.
SOON_SLIPS = f"friction: Bristle(mu: {d.FRICTION}, stiffness: {4 * d.STIFFNESS})"


def radial(name):
    """Unit vector along the groove of a vane; its pin is seated at R times that."""
    return np.array([np.cos(d.AZIMUTHS[name]), np.sin(d.AZIMUTHS[name]), 0.0])


def platform_text(friction):
    """`friction`: of the vanes and the claw, where it is another than that of the model."""
    text = (d.HERE / "platform.ron").read_text(encoding="utf-8")
    if ROUGH not in text:
        raise ValueError(f"platform.ron does not say `{ROUGH}`")
    return text.replace(ROUGH, friction or ROUGH)


def payload_text(missing):
    """`missing`: the number of a pin that is left out."""
    lines = (d.HERE / "payload.ron").read_text(encoding="utf-8").splitlines(keepends=True)
    return "".join(line for line in lines if missing is None or f'"pin_{missing}"' not in line)


def payload(fixtures, missing):
    pins = "".join(
        f'<geom type="sphere" pos="{mjcf.numbers(d.RADIUS * radial(name))}" size="{d.PIN}" rgba="{GOLD}"/>'
        f'<geom type="capsule" fromto="{mjcf.numbers(d.RADIUS * radial(name))} '
        f'{mjcf.numbers(d.RADIUS * radial(name) + (0, 0, d.DRAWN_Z))}" size="0.006" rgba="{GOLD}"/>'
        for i, name in enumerate(VANES, 1)
        if i != missing
    )
    bar = f"0 {-d.BAR_HALF} {d.BAR_Z} 0 {d.BAR_HALF} {d.BAR_Z}"
    sites = "".join(f'<site name="{h.name}" pos="{mjcf.numbers(h.fixture)}"/>' for h in fixtures)
    return (
        f'<body name="payload"><freejoint/><inertial pos="{mjcf.numbers(d.CENTER)}" mass="{d.MASS}" '
        f'diaginertia="{mjcf.numbers(d.INERTIA)}"/><geom type="box" pos="0 0 {d.DRAWN_Z}" '
        f'size="{mjcf.numbers([s / 2 for s in d.DRAWN])}" rgba="{BLUE}"/>{pins}<geom type="capsule" '
        f'fromto="{bar}" size="{d.BAR_RADIUS}" rgba="{GOLD}"/>{sites}</body>'
    )


def claw():
    """Claw, with angle 0 when closed and a positive angle when open."""
    middle = ((d.CLAW_REACH - d.CLAW_HEEL) / 2, 0.0, d.CLAW_THICKNESS / 2)
    half = ((d.CLAW_REACH + d.CLAW_HEEL) / 2, d.CLAW_HALF_WIDTH, d.CLAW_THICKNESS / 2)
    return (
        f'<body name="claw" pos="{mjcf.numbers(d.HINGE)}"><joint name="claw" axis="0 -1 0" '
        f'armature="{d.CLAW_ARMATURE}" limited="true" range="-0.2 1.9"/><inertial pos="{mjcf.numbers(middle)}" '
        f'mass="{d.CLAW_MASS}" diaginertia="0.01 0.04 0.04"/><geom type="box" pos="{mjcf.numbers(middle)}" '
        f'size="{mjcf.numbers(half)}" rgba="{GOLD}"/></body>'
    )


def vanes():
    """Carrier bodies of the groups, drawn as thin boxes."""
    width = d.OPENING / np.cos(d.FLANK)
    boxes = ""
    for name, azimuth in d.AZIMUTHS.items():
        place, turn = d.RADIUS * radial(name), mjcf.quaternion_about_z(azimuth)
        flanks = "".join(
            f'<geom type="box" pos="0 {side * d.OPENING / 2} {(d.ROOT_Z + d.CREST_Z) / 2 - 0.008}" '
            f'euler="{side * d.FLANK} 0 0" size="{d.HALF_LENGTH} {width / 2} 0.004" rgba="{STEEL}"/>'
            for side in (1, -1)
        )
        boxes += f'<body name="{name}" pos="{mjcf.numbers(place)}" quat="{mjcf.numbers(turn)}">{flanks}</body>'
    return boxes


def holder(group, h):
    """Controls are the commanded pose of the fixture relative to that in the seated payload, m and rad."""
    return "".join(
        f'<general name="{h.name}_{axis}" site="{h.name}" refsite="at_{h.name}" group="{group}" '
        f'gear="{mjcf.numbers(np.eye(6)[i])}" gaintype="fixed" gainprm="{k:.12g}" biastype="affine" '
        f'biasprm="0 {-k:.12g} {-c:.12g}"/>'
        for i, (axis, k, c) in enumerate(zip(AXES, h.stiffness, h.damping))
    )


def machine(step, holders=(), friction=None, missing=None, pose=(0.0,) * 6, opened=d.OPEN, mu=None):
    """Machine with the payload at a pose (m and a rotation vector, from its seat) and the claw at an angle; arms hold
    their poses.

    `friction`: see `platform_text`; `mu`: coefficient of friction of all surfaces.
    """
    bodies = {"platform": "world", **{f"platform/{name}": name for name in VANES}}
    bodies |= {"platform/claw": "claw", "payload": "payload"}
    texts = (platform_text(friction), payload_text(missing))
    extension = mjcf.contact_instance(
        {"platform": "text1", "payload": "text2"},
        [("platform", "payload")],
        bodies,
        texts=texts if mu is None else [mjcf.with_friction(text, mu) for text in texts],
    )
    sites = "".join(f'<site name="at_{h.name}" pos="{mjcf.numbers(h.fixture)}"/>' for h in holders)
    arms = "".join(holder(1 + i, h) for i, h in enumerate(holders))
    more = f"<actuator>{mjcf.motor('claw', 'claw', d.CLAW_STALL, d.CLAW_FREE_SPEED)}{arms}</actuator>"
    world = sites + vanes() + claw() + payload(holders, missing)
    made = Machine(mjcf.model("cas", extension, world, more, step), CARRIERS, GROUPS)
    place(made, pose, opened)
    for h in holders:
        lead(made, h, pose)
    made.start()
    return made


def place(made, pose, opened):
    """Sets the pose of the payload from its seat, and the angle of the claw."""
    made.data.qpos[made.model.joint("claw").qposadr[0]] = opened
    first = made.model.body("payload").jntadr[0]
    first = made.model.jnt_qposadr[first]
    made.data.qpos[first : first + 3] = pose[:3]
    made.data.qpos[first + 3 : first + 7] = quaternion(pose[3:])


def quaternion(turn):
    angle = float(np.linalg.norm(turn))
    share = 0.5 if angle == 0.0 else np.sin(angle / 2) / angle
    return np.array([np.cos(angle / 2), *(share * np.asarray(turn, float))])


def rotation(turn):
    """Matrix of a rotation vector (Rodrigues)."""
    w, *v = quaternion(turn)
    cross = np.cross(np.eye(3), v)
    return np.eye(3) + 2.0 * w * cross + 2.0 * cross @ cross


def lead(made, h, pose, off=(0.0,) * 6):
    """Commands an arm to its fixture's pose in a payload at `pose`, displaced by `off`."""
    fixture = np.array(h.fixture)
    shift = np.asarray(pose[:3]) + rotation(pose[3:]) @ fixture - fixture
    wanted = np.r_[shift, pose[3:]] + off
    for axis, value in zip(AXES, wanted):
        made.data.ctrl[made.model.actuator(f"{h.name}_{axis}").id] = value


def grasping(made, holders, holding):
    """Closes only the arms named in `holding` on their fixtures."""
    off = [1 + i for i, h in enumerate(holders) if h.name not in holding]
    made.model.opt.disableactuator = sum(1 << group for group in off)


def drive(made, voltage):
    """Sets the voltage of the claw: −1 closes it."""
    made.data.ctrl[made.model.actuator("claw").id] = voltage


def pose(made):
    """Pose of the payload from its seat: m, and a rotation vector."""
    w, *v = made.data.xquat[made.model.body("payload").id]
    sine = float(np.linalg.norm(v))
    turn = np.zeros(3) if sine == 0.0 else np.array(v) / sine * 2.0 * np.arctan2(sine, w)
    return np.r_[made.place("payload"), turn]


def wrench_of(made, h):
    """Wrench of an arm on its fixture, along the axes of the world: N and N·m."""
    return np.array([made.data.actuator_force[made.model.actuator(f"{h.name}_{axis}").id] for axis in AXES])


def on_vanes(made):
    """Force of each vane on its pin, N."""
    return np.array([-made.on(name)[:3] for name in VANES])
