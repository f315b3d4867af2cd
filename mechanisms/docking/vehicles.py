"""Chaser and target as MJCF: bodies, joints, motors, and the contact models of soft and hard capture."""

import math

import dimensions as d
import numpy as np
import stewart
from kit import mjcf, parameters
from kit.machine import Machine
from kit.mjcf import numbers

SOFT = {"chaser": "models/idss_docking/idss_active.ron", "target": "mechanisms/docking/soft_passive.ron"}
HARD = {"hard_chaser": "mechanisms/docking/hard_active.ron", "hard_target": "mechanisms/docking/hard_passive.ron"}
LATCHES = range(3)
CAPACITY = 128


def body(name, mass, inertia, inside="", center=(0, 0, 0), place=(0, 0, 0), quaternion=(1, 0, 0, 0)):
    return (
        f'<body name="{name}" pos="{numbers(place)}" quat="{numbers(quaternion)}">'
        f'<inertial pos="{numbers(center)}" mass="{mass:.12g}" diaginertia="{numbers(inertia)}"/>{inside}</body>'
    )


def latches(drawn):
    """Latches, each on a radial slide of the ring, on a spring without preload, outwards against a stop."""
    text = ""
    for i, azimuth in enumerate(d.IDSS.ACTIVE_PETALS):
        frame = np.array(d.IDSS.latch_frame(azimuth)).T
        slide = (
            f'<joint name="latch_{i}" type="slide" axis="1 0 0" stiffness="{d.LATCH_STIFFNESS}" damping="{d.LATCH_DAMPING}" '
            f'limited="true" range="{-d.LATCH_STROKE} {d.LATCH_STOP}" solreflimit="{d.LATCH_STOP_TIME} 1"/>'
        )
        place = d.IDSS.latch_tip(azimuth)
        slide += drawn.get(f"latch_{i}", "")
        text += body(
            f"latch_{i}", d.LATCH_MASS, [d.LATCH_INERTIA] * 3, slide, place=place, quaternion=mjcf.quaternion_of(frame)
        )
    return text


def hooks():
    """Hooks, each on a pivot outside the hard face; at angle zero its arm lies across the axis. It starts open."""
    text = ""
    for i in range(d.HOOKS):
        azimuth = i * 360.0 / d.HOOKS
        inwards = np.array(d.on_circle(-1.0, azimuth))
        frame = np.column_stack([inwards, np.cross((0, 0, 1), inwards), (0, 0, 1)])
        hinge = f'<joint name="hook_{i}" axis="0 1 0" armature="{d.HOOK_ARMATURE}"/>'
        arm = '<geom type="box" pos="0.0325 0 0.0125" size="0.0475 0.015 0.0125" rgba="0.8 0.3 0.2 1"/>'
        place = d.on_circle(d.HOOK_PIVOT_RADIUS, azimuth, d.HOOK_PIVOT_HEIGHT)
        text += body(
            f"hook_{i}",
            d.HOOK_MASS,
            (1e-3, 4e-3, 4e-3),
            hinge + arm,
            (0.03, 0, 0.01),
            place,
            mjcf.quaternion_of(frame),
        )
    return text


def world(hard, drawn):
    """Bodies at the origin: `set_vehicle` places them."""
    inside = stewart.bodies() + stewart.ring(latches(drawn) + drawn.get("ring", "")) + (hooks() if hard else "")
    chaser = body(
        "chaser", d.CHASER_MASS, d.CHASER_INERTIA, "<freejoint/>" + drawn.get("chaser", "") + inside, d.CHASER_CENTER
    )
    target = body("target", d.TARGET_MASS, d.TARGET_INERTIA, "<freejoint/>" + drawn.get("target", ""), d.TARGET_CENTER)
    return chaser + target


def actuators(hard):
    solenoids = "".join(f'<motor name="latch_{i}" joint="latch_{i}"/>' for i in LATCHES)
    motors = "".join(
        mjcf.motor(f"hook_{i}", f"hook_{i}", d.HOOK_STALL, d.HOOK_FREE_SPEED) for i in range(d.HOOKS if hard else 0)
    )
    return f"<actuator>{stewart.actuators()}{solenoids}{motors}</actuator>"


def without_pusher():
    """Hard model of the chaser with pusher 0 too short to reach anything."""
    text = " ".join((d.ROOT / parameters.with_surfaces(HARD, d.ROOT)["hard_chaser"]).read_text().split())
    before, after = text.split('name: "pusher_0"')
    return before + 'name: "pusher_0"' + after.replace(f"length: {d.PUSHER_LENGTH}", "length: 1e-4", 1)


def machine(level, hard=True, drawn=None, assets="", dead_pusher=False, petals=True, kind=Machine):
    """`hard`: with pads, pushers and hooks; without, for approaches until capture. `drawn`: body → geoms to be seen.

    `dead_pusher`: pusher 0 does not push. Without `petals` these, strikers and latches touch nothing.
    `kind`: of machine, for other contacts.
    """
    objects = {**SOFT, **(HARD if hard else {})}
    objects |= {"hard_chaser": "text1"} if dead_pusher else {}
    texts = [without_pusher()] if dead_pusher else []
    carried = {"chaser/ring": "ring", **{f"chaser/ring/latch_{i}": f"latch_{i}" for i in LATCHES}}
    carriers = ["chaser", "ring", *[f"latch_{i}" for i in LATCHES], "target"]
    pairs = [("chaser", "target")] if petals else []
    if hard:
        hooks_ = [f"hook_{i}" for i in range(d.HOOKS)]
        carried |= {
            "hard_chaser": "chaser",
            "hard_target": "target",
            **{f"hard_chaser/{name}": name for name in hooks_},
        }
        carriers += ["chaser", *hooks_, "target"]
        pairs += [("hard_chaser", "hard_target")]
    text = mjcf.model(
        "docking",
        mjcf.contact_instance(objects, pairs, carried, texts, folder=d.ROOT, capacity=CAPACITY) + assets,
        world(hard, drawn or {}),
        actuators(hard) + stewart.closures(level),
        level.step,
        level.integrator,
    )
    return kind(text, carriers)


def set_vehicle(made, name, place, frame, velocity=(0, 0, 0), spin=(0, 0, 0)):
    """Position and rotation matrix of a vehicle's frame, velocity of its origin, angular velocity along its own axes."""
    joint = made.model.joint(made.model.body(name).jntadr[0])
    first, rate = joint.qposadr[0], joint.dofadr[0]
    made.data.qpos[first : first + 7] = np.hstack([place, mjcf.quaternion_of(frame)])
    made.data.qvel[rate : rate + 6] = np.hstack([velocity, spin])


def flipped():
    """Frame of the target, whose port faces −z: rotated by 180° about x."""
    return np.diag([1.0, -1.0, -1.0])


def about(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    made = {
        "x": [[1, 0, 0], [0, c, -s], [0, s, c]],
        "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
        "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]],
    }
    return np.array(made[axis])


def reduced_mass():
    """Reduced mass of the two vehicles along the axis; the chaser with ring, legs, latches and hooks."""
    return 1.0 / (1.0 / chaser_mass() + 1.0 / d.TARGET_MASS)


def chaser_mass(hard=True):
    carried = d.RING_MASS + 3 * d.LATCH_MASS + stewart.LEGS * (d.CYLINDER_MASS + d.ROD_MASS)
    return d.CHASER_MASS + carried + (d.HOOKS * d.HOOK_MASS if hard else 0.0)
