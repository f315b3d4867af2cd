"""Latches alone: the linkage over its whole stroke, the flow of the motor's power, the holding force of a stalled motor.

The module slides along z and does nothing else. In the free stroke it is out of reach.
"""

import mujoco
import numpy as np

import dimensions as d
import linkage
import mechanism
import statics
from dimensions import common
from kit.machine import Machine
from kit.rows import Limit, Row

LATCHES = range(4)
CLOSED = 1.0  # angle of a crank that has gone through its stroke
RESISTANCE = 4000.0  # N, that pulls the module out while the latches pull it in
LOADED_FROM, LOADED_TO = 0.040, 0.024  # m: where power is compared; the standoffs are not reached


def rig(level, gap):
    scene = mechanism.Scene(level, start=mechanism.Start(gap=gap), guided=True)
    machine = Machine(mechanism.text(scene), mechanism.carried(scene).values())
    machine.model.opt.disableactuator = 1 << mechanism.arm.GROUP
    return machine


def drive(machine):
    machine.data.ctrl[:4] = 1.0


class Loop:
    """Records the deviation of the linkages from the closed form."""

    def __init__(self):
        self.equation, self.pin, self.roller = 0.0, 0.0, 0.0

    def __call__(self, machine):
        for i in LATCHES:
            crank = machine.joint(f"crank_{i}")
            pose = linkage.pose(crank)
            off = linkage.freudenstein(crank, machine.joint(f"follower_{i}"))
            self.equation = max(self.equation, abs(off))
            places = [machine.data.site(f"{name}_{i}").xpos for name in ("joint", "end")]
            self.pin = max(self.pin, float(np.linalg.norm(places[0] - places[1])))
            roller = machine.data.site(f"roller_{i}").xpos
            reached = np.array([np.hypot(roller[0], roller[1]), roller[2]])
            self.roller = max(self.roller, float(np.abs(reached - pose.roller).max()))


def free_stroke(level):
    """Full stroke from stowed to closed and back."""
    machine, loop = rig(level, 0.5), Loop()
    machine.watchers.append(loop)
    machine.run(12.0, drive, lambda m: m.joint("crank_0") > CLOSED)
    machine.run(12.0, back, lambda m: m.joint("crank_0") < d.STOWED + 0.02)
    yield Limit(f"free stroke, level {level.name}: what is left of Freudenstein's equation", loop.equation, 1e-6)
    yield Limit("the pin that closes the loop is open by", loop.pin, 1e-7, "m")
    yield Limit("the roller is off the coupler curve by", loop.roller, 1e-6, "m")


def back(machine):
    machine.data.ctrl[:4] = -1.0


def energy_of_latches(machine):
    """Kinetic energy of the latches, J."""
    model, data = machine.model, machine.data
    alone, product = np.zeros(model.nv), np.zeros(model.nv)
    for i in LATCHES:
        for name in ("crank", "coupler", "follower"):
            dof = model.joint(f"{name}_{i}").dofadr[0]
            alone[dof] = data.qvel[dof]
    mujoco.mj_mulM(model, data, product, alone)
    return 0.5 * float(alone @ product)


def load_at_crank(machine, i):
    """Contact torque at the crank, N·m: virtual work of the contact's force and moment per rad, by closed form."""
    pose = linkage.pose(machine.joint(f"crank_{i}"))
    azimuth = np.radians(common.LATCH_AZIMUTHS[i])
    wrench, pin = machine.wrench(f"coupler_{i}"), machine.place(f"coupler_{i}")
    about_roller = wrench[3:] - np.cross(machine.data.site(f"roller_{i}").xpos - pin, wrench[:3])
    outward = wrench[0] * np.cos(azimuth) + wrench[1] * np.sin(azimuth)
    raising = about_roller[0] * np.sin(azimuth) - about_roller[1] * np.cos(azimuth)
    return -(outward * pose.roller_rate[0] + wrench[2] * pose.roller_rate[1] + raising * pose.coupler_rate)


def powers(machine):
    """Powers of the motors, τω, and of the rollers, F·v at the contact point, with v from the closed form of the linkage."""
    omega = [machine.speed(f"crank_{i}") for i in LATCHES]
    torque = [float(machine.data.actuator(f"latch_{i}").force[0]) for i in LATCHES]
    return np.array([np.dot(torque, omega), sum(load_at_crank(machine, i) * omega[i] for i in LATCHES)])


def under_load(level):
    """The latches pull the module in against a constant force: the motors' work equals that at the rollers plus kinetic
    energy."""
    machine, loop = rig(level, 0.060), Loop()
    machine.watchers.append(loop)
    pulled = machine.model.joint("module").dofadr[0]

    def control(m):
        drive(m)
        # Applied only while the rollers hold it: before, nothing would.
        m.data.qfrc_applied[pulled] = RESISTANCE if m.wrench("coupler_0")[2] > 0.0 else 0.0

    machine.run(12.0, control, lambda m: m.place("passive")[2] < LOADED_FROM)
    work, before, last = np.zeros(2), energy_of_latches(machine), powers(machine)
    while machine.place("passive")[2] > LOADED_TO:
        machine.advance(control)
        now = powers(machine)
        work, last = work + 0.5 * machine.step * (now + last), now
    gained = energy_of_latches(machine) - before
    yield Row(f"loaded, level {level.name}: work of the motors, τω", work[0], work[1] + gained, 1e-3, "J")
    print(f"      of it at the rollers, F·v: {work[1]:.4g} J; left in moving links and rotors: {gained:.3g} J")
    machine.data.qfrc_applied[pulled] = 0.0
    machine.run(3.0, drive)
    force = np.mean([machine.wrench(f"coupler_{i}")[2] for i in LATCHES])
    needed = np.mean([load_at_crank(machine, i) for i in LATCHES])
    yield Row("stalled on the hard stop: what the contact asks of the crank", needed, d.STALL_TORQUE, 1e-3, "N m")
    z = machine.place("passive")[2]
    yield Limit("force at a roller: at most τ·dθ/dz", force, statics.latch(z, 1.0) * 1.001, "N")
    sliding = statics.latch(z, 1.0, d.ROLLER_FRICTION) * 0.999
    yield Limit("and at least what friction leaves of it", force, sliding, "N", least=True)
    yield Limit("loaded: what is left of Freudenstein's equation", loop.equation, 1e-6)
    yield Limit("the pin that closes the loop is open by", loop.pin, 1e-7, "m")


def rows(levels):
    for level in levels:
        yield from free_stroke(level)
        yield from under_load(level)
