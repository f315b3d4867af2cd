"""Hard capture and undocking: predictions for hooks and pushers, and a push-off by unequal pushers."""

import math

import dimensions as d
import docking
import numpy as np
import vehicles
from kit.rules import honest
from kit.rows import Limit, Row
from sequence import Sequencer


def predicted_hook():
    """(force of a stalled hook, N; its angle, rad): τ = F·a·cos θ, with the springs of hook and pad deflected by a·sin θ."""
    force, angle = d.HOOK_STALL / d.HOOK_ARM, 0.0
    pushed = d.PUSHERS * d.PUSHER_STIFFNESS * d.PUSHER_LENGTH / d.HOOKS
    for _ in range(20):
        gives = force / d.HOOK_STIFFNESS + (force - pushed) / d.HARD_PAD_STIFFNESS
        angle = math.asin(gives / d.HOOK_ARM)
        force = d.HOOK_STALL / (d.HOOK_ARM * math.cos(angle))
    return force, angle


def hooked(made):
    """Rows for the end of the phase `hold`."""
    axis = made.data.body("chaser").xmat.reshape(3, 3)[:, 2]
    forces = [float(made.wrench(f"hook_{i}")[:3] @ axis) for i in range(d.HOOKS)]
    force, angle = predicted_hook()
    yield Row("preload of the twelve hooks together", sum(forces), d.HOOKS * force, 2e-3, "N")
    yield Row("the least of them", min(forces), force, 5e-3, "N")
    yield Row("angle of hook 0 when it stalls", made.joint("hook_0"), angle, 2e-2, "rad")


def pusher_energy(count=d.PUSHERS):
    return count * 0.5 * d.PUSHER_STIFFNESS * d.PUSHER_LENGTH**2


def separated(made):
    """Rows after the push-off: ½Σkδ² with the reduced mass."""
    speed = float(docking.motion(made, "target")[0][2] - docking.motion(made, "chaser")[0][2])
    yield Row(
        "speed of separation, √(2·½Σkδ²/m)",
        speed,
        math.sqrt(2 * pusher_energy() / vehicles.reduced_mass()),
        1e-2,
        "m/s",
    )


def chaser_inertia():
    """Inertia of the chaser across its axis, about the common mass centre; its parts are near the hard plane."""
    carried = vehicles.chaser_mass() - d.CHASER_MASS
    reduced = carried * d.CHASER_MASS / vehicles.chaser_mass()
    return d.CHASER_INERTIA[0] + reduced * d.CHASER_CENTER[2] ** 2


def unequal(level):
    """Push-off with one dead pusher of three: the other two act as one of twice the stiffness, off the axis."""
    arm = d.PUSHER_RADIUS * math.cos(math.pi / d.PUSHERS)
    inertia = {"chaser": chaser_inertia(), "target": d.TARGET_INERTIA[0]}
    mass = {"chaser": vehicles.chaser_mass(), "target": d.TARGET_MASS}
    effective = 1.0 / sum(1.0 / mass[name] + arm**2 / inertia[name] for name in mass)
    impulse = math.sqrt(2 * pusher_energy(d.PUSHERS - 1) * effective)
    made, relative, spin = push_off(level, petals=False)
    yield Row("tip-off rate of the chaser, J·d/I", spin, impulse * arm / inertia["chaser"], 1e-2, "rad/s")
    yield Row("speed of separation with two pushers, J/m", relative, impulse / vehicles.reduced_mass(), 1e-2, "m/s")
    yield from honest(made)
    _, _, guided = push_off(level, petals=True)
    yield Limit(
        "tip-off rate where strikers and ring guide the vehicles", guided, impulse * arm / inertia["chaser"], "rad/s"
    )


def push_off(level, petals):
    """(machine, speed of separation, rate of the chaser) with pusher 0 dead."""
    made = docking.mated_and_free(level, petals)
    result = docking.go_on(made, Sequencer(from_phase="away"), "done")
    return made, float(-result.relative_speed()[2]), float(np.linalg.norm(docking.motion(made, "chaser")[1]))
