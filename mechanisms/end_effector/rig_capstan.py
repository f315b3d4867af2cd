"""A cable wrapped around a shaft: its holding ratio of tensions grows as exp(μφ·r/(r + rc))."""

import math

import models
from dimensions import Fixture, Snare
from kit import mjcf
from kit.machine import Machine
from kit.rows import Limit, Row

WRAPPED = 24  # links that lie on the shaft
FREE = 3  # links at each end that do not
LOW = 50.0  # N, at one end
RISE = 0.1  # of the predicted tension in a second: how slowly the other end's tension rises
SLID = 2e-3  # m: a cable that moved so far slides
FAR = 2.0  # m: so far away is what pulls at an end


def layout(reach, angle):
    """Length of a link and angle between links whose middles touch the circle `reach`."""
    bend = angle / WRAPPED
    return 2.0 * reach * math.tan(bend / 2.0), bend


def chain(snare, reach, angle):
    length, bend = layout(reach, angle)
    count, mass = WRAPPED + 2 * FREE, 0.002
    across = mass * length**2 / 12.0
    inertia = (
        f'<inertial pos="{length / 2:.12g} 0 0" mass="{mass}" diaginertia="{across:.6g} {across:.6g} {across:.6g}"/>'
    )
    text = f'<site name="high" pos="{length:.12g} 0 0"/>'
    for index in reversed(range(count)):
        # The cable begins along +y beside the shaft and turns left.
        turned = FREE <= index <= FREE + WRAPPED
        share = 0.5 if index in (FREE, FREE + WRAPPED) else 1.0
        start = (reach, -FREE * length, 0.0) if index == 0 else (length, 0.0, 0.0)
        turn = (0.5 * math.pi if index == 0 else 0.0) + (share * bend if turned else 0.0)
        first = (
            '<site name="low"/><joint type="slide" axis="1 0 0"/><joint name="along" type="slide" axis="0 1 0"/>'
            if index == 0
            else ""
        )
        text = (
            f'<body name="link_{index:02}" pos="{mjcf.numbers(start)}" quat="{mjcf.numbers(mjcf.quaternion_about_z(turn))}">{first}'
            f'<joint axis="0 0 1" armature="1e-6" damping="1e-4"/>{inertia}{text}</body>'
        )
    return text, count, length


def rig(snare, fixture, angle):
    reach = fixture.shaft_radius + snare.radius
    text, count, length = chain(snare, reach, angle)
    tail = FREE * length
    end = (reach * math.cos(angle) - tail * math.sin(angle), reach * math.sin(angle) + tail * math.cos(angle))
    pull_low = (reach, -tail - FAR, 0.0)
    pull_high = (end[0] - FAR * math.sin(angle), end[1] + FAR * math.cos(angle), 0.0)
    world = f'{text}<site name="from_low" pos="{mjcf.numbers(pull_low)}"/><site name="from_high" pos="{mjcf.numbers(pull_high)}"/>'
    more = (
        '<tendon><spatial name="low"><site site="low"/><site site="from_low"/></spatial>'
        '<spatial name="high"><site site="high"/><site site="from_high"/></spatial></tendon>'
        '<actuator><motor name="low" tendon="low" gear="-1"/><motor name="high" tendon="high" gear="-1"/></actuator>'
    )
    bodies = {"shaft": "world", "cable": "world", **{f"cable/link_{i:02}": f"link_{i:02}" for i in range(count)}}
    things = {"shaft": "text1", "cable": "text2"}
    texts = [
        models.fixture(fixture, snare.friction).text(),
        models.chain(length, snare.radius, count, models.Surface(2e5, 5.0, snare.friction)).text(),
    ]
    extension = mjcf.contact_instance(things, [("cable", "shaft")], bodies, texts, capacity=128)
    carriers = ["world", "world"] + [f"link_{i:02}" for i in range(count)]
    return Machine(mjcf.model("capstan", extension, world, more, 5e-5, "RK4"), carriers)


def holds(snare, fixture, angle, predicted):
    """Ratio of tensions at which the cable begins to slide."""
    machine = rig(snare, fixture, angle)
    ratio = 1.0

    def control(m):
        nonlocal ratio
        ratio = min(1.0 + (0.92 * predicted - 1.0) * min(1.0, m.time / 0.3), predicted)
        ratio += RISE * predicted * max(0.0, m.time - 0.5)
        m.data.ctrl[:] = (LOW, LOW * ratio)

    machine.run(0.5, control)
    rest = machine.joint("along")
    machine.run(2.5, control, watch=lambda m: abs(m.joint("along") - rest) > SLID)
    return ratio, machine


def rows():
    fixture = Fixture()
    for friction, angle in ((0.2, math.pi), (0.2, 0.75 * math.pi), (0.4, 0.75 * math.pi)):
        snare = Snare(friction=friction)
        predicted = math.exp(friction * angle * fixture.shaft_radius / (fixture.shaft_radius + snare.radius))
        ratio, machine = holds(snare, fixture, angle, predicted)
        yield Row(
            f"friction {friction:g}, wrapped {math.degrees(angle):g} deg: tensions are as exp(μφ·r/(r + rc))",
            ratio,
            predicted,
            0.03,
        )
        yield Limit("forces that have no reaction, of the greatest", machine.imbalance, 1e-12)
