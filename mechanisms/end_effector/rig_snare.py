"""The snare compared with closed forms: straightening of free cables, grip, tension, wrapping."""

import math
from dataclasses import replace

import snare as s
import numpy as np

from kit.rules import honest
from kit.rows import Fact, Limit, Row

SLOW = 0.2  # rad/s of a ring that closes without a blow


def held(place):
    """A payload that does not move."""
    return f'<body name="payload" pos="{place}"/>'


def drive(torque, snare, speed=None):
    """A constant voltage: for a stall torque, N·m, or for a speed, rad/s, with the current of the torque as limit."""
    stalled = torque / snare.stall_torque

    def control(machine):
        turning = machine.speed("turn") / snare.free_speed
        voltage = (
            stalled if speed is None else min(stalled + turning, max(turning - stalled, speed / snare.free_speed))
        )
        machine.data.ctrl[machine.model.actuator("ring").id] = voltage

    return control


def ring_torque(machine):
    """Motor torque less the gear's loss, N·m: a creeping ring is not quite stalled."""
    freedom = machine.model.joint("turn").dofadr[0]
    return float(machine.data.qfrc_actuator[freedom] + machine.data.qfrc_damper[freedom])


def free_cables(level):
    """A short cable, straight before the ring has turned half round: L = 1.5 R."""
    snare = replace(level, length=1.5 * level.ring_radius)
    machine = s.rig(snare)
    torque = 6.0
    machine.run(1.2, drive(torque, snare, SLOW))
    machine.run(2.5, drive(torque, snare))
    turn = machine.joint("turn")
    yield Row(
        "free cables are straight at the ring angle 2·asin(L/2R)",
        math.degrees(turn),
        math.degrees(s.straight_turn(snare)),
        1e-3,
        "deg",
    )
    middle = machine.place(f"cable_0/link_{snare.links // 2:02}")
    across = s.aperture(snare, turn)
    yield Row("their aperture is R·cos(θ/2)", math.hypot(middle[0], middle[1]), across, 2e-3, "m")
    for cable in range(s.CABLES):
        yield Row(
            f"tension of cable {cable} is τ/(3·a)",
            s.tension(machine, snare, cable),
            ring_torque(machine) / (3 * across),
            0.01,
            "N",
        )
    yield from honest(machine)


def closes(level, fixture, aperture):
    """Cables of known straight aperture, closed around a fixed shaft: contact or not."""
    turn = 2.0 * math.acos(aperture / level.ring_radius)
    snare = replace(level, length=2.0 * level.ring_radius * math.sin(turn / 2.0))
    machine = s.rig(snare, fixture, held("0 0 0.08"), friction=0.0)
    way = turn - s.open_turn(snare)
    machine.run(way / SLOW + 0.5, drive(4.0, snare, SLOW))
    return machine.contacts() > 0


def grip(level, fixture):
    reach = fixture.shaft_radius + level.radius
    yield Fact(
        "cables of an aperture 5 % above the shaft's radius (and their own) pass by it",
        not closes(level, fixture, 1.05 * reach),
    )
    yield Fact("cables of an aperture 5 % below it touch it", closes(level, fixture, 0.95 * reach))


def squeeze(level, fixture):
    """Without friction the stalled ring pulls each cable around the shaft with τ/(3·(r + rc))."""
    machine = s.rig(level, fixture, held("0 0 0.08"), friction=0.0)
    torque, reach = 3.0, fixture.shaft_radius + level.radius
    machine.run(10.0, drive(torque, level, SLOW), watch=lambda m: s.tension(m, level, 0) > 0.9 * torque / (3 * reach))
    machine.run(0.5, drive(torque, level))
    predicted = ring_torque(machine) / (3 * reach)
    pulls = [s.tension(machine, level, cable) for cable in range(s.CABLES)]
    yield Row("mean tension round a shaft is τ/(3·(r + rc))", sum(pulls) / s.CABLES, predicted, 0.02, "N")
    across = math.hypot(*machine.wrench("payload")[:2])
    yield Limit("what the payload feels across the axis, of one tension", across / predicted, 0.02)
    yield from honest(machine)


def segments_apart(p, q):
    """Least distance of two line segments given by their ends."""
    u, v, w = p[1] - p[0], q[1] - q[0], p[0] - q[0]
    a, b, c, d, e = u @ u, u @ v, v @ v, u @ w, v @ w
    det = a * c - b * b
    best = math.inf
    places = [(0.0, None), (1.0, None), (None, 0.0), (None, 1.0)]
    if det > 1e-12 * a * c:
        along, across = (b * e - c * d) / det, (a * e - b * d) / det
        if 0.0 <= along <= 1.0 and 0.0 <= across <= 1.0:
            places.append((along, across))
    for along, across in places:
        if along is None:
            along = min(1.0, max(0.0, (b * across - d) / a))
        elif across is None:
            across = min(1.0, max(0.0, (b * along + e) / c))
        best = min(best, float(np.linalg.norm(w + along * u - across * v)))
    return best


def axes(machine, snare, cable):
    """Both ends of every link of a cable."""
    for index in range(snare.links - 1):
        body = machine.model.body(f"cable_{cable}/link_{index:02}").id
        start = machine.data.xpos[body]
        yield np.array([start, start + s.pitch(snare) * machine.data.xmat[body].reshape(3, 3)[:, 0]])


def crossing(level):
    """Taut crossing cables are pushed against each other: the upper one stays above."""
    snare = replace(level, length=1.8 * level.ring_radius)
    machine = s.rig(snare, step=level.step / 2)
    push = 5.0  # N on each link

    def control(m, speed=None, pushed=0.0):
        drive(6.0, snare, speed)(m)
        for cable, sign in ((0, 1.0), (2, -1.0)):
            for index in range(snare.links - 1):
                m.data.xfrc_applied[m.model.body(f"cable_{cable}/link_{index:02}").id, 2] = sign * pushed

    machine.run(1.5, lambda m: control(m, SLOW))
    machine.run(0.3, lambda m: control(m))
    apart = []

    def watch(m):
        if round(m.time / m.step) % 40 == 0:
            pairs = (
                (a, b) for k in range(s.CABLES) for j in range(k) for a in axes(m, snare, k) for b in axes(m, snare, j)
            )
            apart.append(min(segments_apart(a, b) for a, b in pairs))
        return False

    begin = machine.time
    machine.run(
        0.5,
        lambda m: control(m, None, 0.5 * push * (1.0 - math.cos(math.pi * min(1.0, (m.time - begin) / 0.3)))),
        watch,
    )
    yield Limit("contacts of cables pushed against each other, at most", machine.contacts_most, 1, least=True)
    yield Limit("least distance of their axes, of their diameter", min(apart) / (2 * snare.radius), 0.97, least=True)
    yield from honest(machine)


def rows(level, fixture):
    yield from free_cables(level)
    yield from grip(level, fixture)
    yield from squeeze(level, fixture)
    yield from crossing(level)
