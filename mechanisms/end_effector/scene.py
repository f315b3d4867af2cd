"""The whole end effector and a free-flying payload as MJCF text: `mjcf_text(case)` makes it without running a simulation.

Frames: z points out of the shell to the payload, the plane of the open snare is z = 0. The ring and the cables ride on a
carriage that a ball screw pulls inwards. The payload's origin is the centre of its plate, the grapple shaft goes along −z
from it. The shell is fixed to the world, or `Case.holder` says what joints hold it.
"""

import math
from dataclasses import dataclass, field

import models
import snare as s
from dimensions import ARM, CAMS, PLUNGERS, SCREW, SEAT, Fixture, Snare
from kit import mjcf

PLATE_HEIGHT = 0.145  # of the payload's plate when the snare is triggered, m
PAYLOADS = {1000.0: 400.0, 16000.0: 60000.0}  # mass, kg: inertia about each axis, kg·m²


@dataclass(frozen=True)
class Case:
    """A capture: state of the payload, holder of the shell, and failures."""

    mass: float = 1000.0
    offset: tuple = (0.030, 0.0)  # of the knob's middle from the axis, m
    tilt_deg: float = 1.0  # of the shaft, about the y axis
    roll_deg: float = 2.0  # about the shaft
    drift: tuple = (0.0, 0.01, 0.0)  # m/s
    approach: float = 0.0  # m by which the payload begins farther out than where the snare is triggered
    snare: Snare = field(default_factory=Snare)
    fixture: Fixture = field(default_factory=Fixture)
    slack: float = 0.0  # m by which cable 0 is longer
    motor_share: float = 1.0  # of the stall torque that the snare motor has
    cams: bool = True  # whether the payload has its cams
    held_for: float = 0.3  # s of a pressed joint before release
    holder: str = ""  # MJCF of the joints between world and shell; "": fixed. See `arm`
    step: float | None = None


def screw_force():
    """Axial force of a stalled carriage: the preload, N."""
    return SCREW.stall_torque * 2.0 * math.pi * SCREW.efficiency / SCREW.lead


def screw(joint):
    """The motor through the screw, and the rotor's inertia reflected to the slide (kg)."""
    ratio = 2.0 * math.pi / SCREW.lead
    return mjcf.motor("screw", joint, screw_force(), SCREW.free_speed / ratio), SCREW.inertia * ratio**2


def arm(held=ARM):
    """Joints for `Case.holder`: springs and dampers along and about three axes at the arm's tip."""
    axes = ("1 0 0", "0 1 0", "0 0 1")
    along = f'type="slide" stiffness="{held.stiffness:g}" damping="{held.damping:g}"'
    about = f'type="hinge" stiffness="{held.turning_stiffness:g}" damping="{held.turning_damping:g}"'
    return "".join(
        f'<joint name="arm_{kind}_{i}" axis="{axis}" pos="0 0 {-held.behind:g}" {how}/>'
        for kind, how in (("along", along), ("about", about))
        for i, axis in enumerate(axes)
    )


def cam_roll_deg():
    """Largest roll of a payload at which the flat tips of the cams enter between the rollers, degrees."""
    tip = CAMS.half_root - CAMS.height * math.tan(math.radians(CAMS.flank_deg))
    return math.degrees(math.asin((models.roller_place() - tip - CAMS.roller) / CAMS.circle))


# --- Objects -----------------------------------------------------------------------------------------------------------


def objects(case):
    """(Objects as models, pairs, group → body) for the plugin; groups in the order of its sensor."""
    snare = case.snare
    cables = [f"cable_{i}" for i in range(s.CABLES)]
    things = {name: (models.cable(snare), "carriage") for name in cables}
    things["fixture"] = (models.fixture(case.fixture, snare.friction), "payload")
    for name, model in (("pads", models.pads), ("teeth", models.teeth), ("rollers", models.rollers)):
        things[name] = (model(friction=snare.friction), "shell")
    things["lip"] = (models.lip(snare.friction), "shell")
    things["plungers"] = (models.plungers(), "plungers")
    for name, model in (("plate", models.plate), ("crowns", models.crowns), ("cams", models.cams)):
        things[name] = (model(snare.friction), "payload")
    pairs = [(a, b) for k, a in enumerate(cables) for b in cables[:k]] + [(name, "fixture") for name in cables]
    pairs += [("pads", "plate"), ("teeth", "crowns"), ("lip", "fixture"), ("plungers", "plate")]
    if case.cams:
        pairs.append(("rollers", "cams"))
    else:
        del things["rollers"], things["cams"]
    return things, pairs


def groups(case):
    """Movable groups in the order of the plugin's sensor: name → body that carries it."""
    carried = {}
    for name, (model, body) in objects(case)[0].items():
        carried[name] = body
        carried.update({f"{name}/{link}": f"{name}/{link}" for link in model.links})
    return carried


# --- bodies ------------------------------------------------------------------------------------------------------------


def quaternion(tilt_deg, roll_deg):
    """Rotation by the roll about z, then the tilt about y."""
    t, r = math.radians(tilt_deg) / 2, math.radians(roll_deg) / 2
    return (
        math.cos(t) * math.cos(r),
        math.sin(t) * math.sin(r),
        math.sin(t) * math.cos(r),
        math.cos(t) * math.sin(r),
    )


def payload_place(case):
    """Position of the plate's centre for which the middle of the knob is at the offset."""
    shape, tilt = case.fixture, math.radians(case.tilt_deg)
    reach = shape.shaft_length + shape.cone_length + 0.5 * shape.knob_length
    return (case.offset[0] + reach * math.sin(tilt), case.offset[1], PLATE_HEIGHT + case.approach)


def payload(case):
    inertia = mjcf.numbers([PAYLOADS[case.mass]] * 3)
    place, turn = mjcf.numbers(payload_place(case)), mjcf.numbers(quaternion(case.tilt_deg, case.roll_deg))
    return (
        f'<body name="payload" pos="{place}" quat="{turn}"><freejoint name="payload"/>'
        f'<inertial pos="0 0 1" mass="{case.mass:g}" diaginertia="{inertia}"/>{_drawn_payload(case)}</body>'
    )


def shell(case):
    """The shell with all its parts, on the joints of `Case.holder`."""
    _, reflected = screw("retract")
    inertia = mjcf.numbers([ARM.shell_inertia] * 3)
    carriage = (
        f'<body name="carriage"><joint name="retract" type="slide" axis="0 0 -1" armature="{reflected:.12g}" limited="true" '
        f'range="0 {SCREW.stroke:g}"/><inertial pos="0 0 -0.05" mass="{SCREW.carriage:g}" diaginertia="0.2 0.2 0.2"/>'
        f"{s.bodies(case.snare)}</body>"
    )
    plungers = (
        f'<body name="plungers"><joint name="plungers" type="slide" axis="0 0 1" damping="{PLUNGERS.losses:g}"/>'
        f'<inertial pos="0 0 0" mass="{PLUNGERS.mass:g}" diaginertia="0.005 0.005 0.01"/>{_drawn_plungers()}</body>'
    )
    return (
        f'<body name="shell">{case.holder}<inertial pos="0 0 -0.2" mass="{ARM.shell_mass:g}" diaginertia="{inertia}"/>'
        f"{_drawn_shell()}{carriage}{plungers}</body>"
    )


def actuators(case):
    """Ring, screw, and the springs of the plungers: control 0 latches these, 1 releases them."""
    snare = case.snare
    ring = mjcf.motor("ring", "turn", snare.stall_torque * case.motor_share, snare.free_speed)
    push = (
        f'<general name="plungers" joint="plungers" ctrllimited="true" ctrlrange="0 1" gaintype="fixed" biastype="affine" '
        f'gainprm="{PLUNGERS.spring * PLUNGERS.stroke:.12g}" biasprm="0 {-PLUNGERS.spring:g} 0"/>'
    )
    return f"<actuator>{ring}{screw('retract')[0]}{push}</actuator>"


def mjcf_text(case, folder=models.HERE):
    """The whole machine as MJCF text. `folder`: location of its model files, as seen by the plugin."""
    things, pairs = objects(case)
    sources, texts = models.sources({name: model for name, (model, _) in things.items()})
    bodies = {name: body for name, (_, body) in things.items()}
    extension = mjcf.contact_instance(sources, pairs, bodies, texts, folder=folder, capacity=256)
    more = _meshes() + s.tendons(case.snare, case.slack) + actuators(case)
    return mjcf.model("end_effector", extension, shell(case) + payload(case), more, case.step or case.snare.step)


# --- shown only --------------------------------------------------------------------------------------------------------


def _drawn_payload(case):
    """The cone as short cylinders."""
    shape, slices = case.fixture, 8
    top, bottom = -shape.shaft_length, -shape.shaft_length - shape.cone_length
    levels = [top + (bottom - top) * i / slices for i in range(slices + 1)]
    radii = [shape.shaft_radius + (shape.knob_radius - shape.shaft_radius) * (i + 0.5) / slices for i in range(slices)]
    parts = [(0.0, top, shape.shaft_radius), (bottom, bottom - shape.knob_length, shape.knob_radius)]
    parts += zip(levels, levels[1:], radii)
    rods = "".join(
        f'<geom type="cylinder" fromto="0 0 {a:.6g} 0 0 {b:.6g}" size="{r:.6g}" rgba="0.4 0.5 0.65 1"/>'
        for a, b, r in parts
    )
    balls = _balls(models.crowns(), "0.25 0.45 0.3 1")
    plate = '<geom type="cylinder" fromto="0 0 0 0 0 0.012" size="0.19" rgba="0.75 0.75 0.8 0.35"/>'
    return plate + rods + balls + (_meshed(models.cams(), "0.3 0.55 0.35 1") if case.cams else "")


def _drawn_shell():
    return (
        _balls(models.pads(), "0.6 0.3 0.25 1")
        + _meshed(models.teeth(), "0.55 0.5 0.35 1")
        + _rods(models.rollers(), "0.45 0.4 0.5 1")
        + _rods(models.lip(), "0.6 0.6 0.65 1")
    )


def _drawn_plungers():
    return "".join(
        f'<geom type="capsule" fromto="{x:.6g} {y:.6g} {SEAT - PLUNGERS.length:g} {x:.6g} {y:.6g} {SEAT - 0.004:g}" size="0.004" rgba="0.2 0.2 0.25 1"/>'
        for x, y in models.around(PLUNGERS.count, PLUNGERS.circle, PLUNGERS.first_deg)
    )


def _balls(model, colour):
    fields = [dict(one.fields) for one in model.parts]
    return "".join(
        f'<geom type="sphere" pos="{mjcf.numbers(f["center"])}" size="{f["radius"]:g}" rgba="{colour}"/>'
        for f in fields
    )


def _rods(model, colour):
    fields = [dict(one.fields) for one in model.parts]
    return "".join(
        f'<geom type="capsule" fromto="{mjcf.numbers(f["ends"][0] + f["ends"][1])}" size="{f["radius"]:g}" rgba="{colour}"/>'
        for f in fields
    )


def _meshed(model, colour):
    return "".join(f'<geom type="mesh" mesh="{one.name}" rgba="{colour}"/>' for one in model.parts)


def _meshes():
    parts = models.teeth().parts + models.cams().parts
    meshes = "".join(
        f'<mesh name="{one.name}" vertex="{mjcf.numbers([x for v in dict(one.fields)["vertices"] for x in v])}"/>'
        for one in parts
    )
    return f"<asset>{meshes}</asset>"
