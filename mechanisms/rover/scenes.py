"""Motions of the rover: standing, turning, driving up slopes and steps, sliding, driving over a stone and over rocks."""

import math

import dimensions as d
import numpy as np
import rig
from dimensions import model

GAIN = 400.0  # of a motor's speed control, N·m·s/rad
CRAWL = 0.05  # m/s
SETTLED = 1.0  # s
LET_DOWN = 2.0  # s
STANDS = 8.0  # s: the wheel has rolled to the edge
RISE = 8.0  # s in which torques rise from LEAST to what the motors can
LEAST = 5.0  # N·m
LIFTED = 0.001  # m
VOLTAGE = 0.6  # on slopes: at more, the front wheels would slip


def crawl(speeds, level, steer=None, cap=None):
    """Motors that hold speeds of their wheels (m/s; by wheel or one), within their torque-speed line.

    `cap(time)`: greatest torque, N·m.
    """

    def control(machine):
        for name in rig.WHEELS:
            ahead = speeds[name] if isinstance(speeds, dict) else speeds
            told = ahead / d.AXLE_HEIGHT[level.tyre]
            speed = machine.speed(f"drive_{name}")
            torque = GAIN * (told - speed)
            if cap is not None:
                torque = max(-cap(machine.time), min(cap(machine.time), torque))
            voltage = speed / d.FREE_SPEED + torque / d.STALL_TORQUE
            machine.data.ctrl[machine.model.actuator(f"drive_{name}").id] = max(-1.0, min(1.0, voltage))
        for name, angle in (steer or {}).items():
            machine.data.ctrl[machine.model.actuator(f"steer_{name}").id] = angle

    return control


# --- turning ---------------------------------------------------------------------------------------------------------------


def ackermann(radius):
    """Angles of the corner wheels and path of each wheel for one metre of the chassis's middle in a left turn."""
    steer, way = {}, {}
    for name in rig.WHEELS:
        where, side = name.split("_")
        across = radius - d.SIDES[side] * d.HALF_TRACK
        way[name] = math.hypot(across, d.AXLE_X[where]) / radius
        if name in rig.CORNERS:
            steer[name] = math.atan2(d.AXLE_X[where], across)
    return steer, way


def turned(radius, level, speed=0.6, seconds=5.0):
    """Radius of the circle of the chassis's middle, m, and the machine."""
    steer, way = ackermann(radius)
    made = rig.machine(level)
    for name, angle in steer.items():
        made.data.qpos[made.model.joint(f"steer_{name}").qposadr[0]] = angle
    rig.rolling(made, level, 0.0)
    seen = []

    def watch(m):
        if m.time > 1.0:
            seen.append(m.place("chassis")[:2])

    made.run(seconds, crawl({name: speed * share for name, share in way.items()}, level, steer), watch)
    return circle(np.array(seen)), made


def circle(places):
    """Radius of the circle through points, by least squares of x² + y² = 2·a·x + 2·b·y + c."""
    system = np.column_stack((2 * places, np.ones(len(places))))
    a, b, c = np.linalg.lstsq(system, (places**2).sum(axis=1), rcond=None)[0]
    return math.sqrt(c + a * a + b * b)


# --- slopes ----------------------------------------------------------------------------------------------------------------


def stall_slope(motors=6):
    """Slope on which the stall torque of this number of motors holds the weight, rad."""
    return math.asin(motors * VOLTAGE * d.STALL_TORQUE / d.AXLE_HEIGHT["rigid"] / (d.GROSS_MASS * model.GRAVITY))


def pulled(angle, dead=(), step=None, level=d.RIGID):
    """Acceleration up a slope at a constant voltage, m/s², near standstill; and the machine."""
    made = rig.machine(level, angle=angle, step=step)
    rig.voltages(made, {name: 0.0 if name in dead else VOLTAGE for name in rig.WHEELS})
    for name in dead:
        _without_power(made, name)
    made.run(SETTLED)
    first = float(made.data.qvel[0])
    made.run(2.0)
    return (float(made.data.qvel[0]) - first) / 2.0, made


def _without_power(made, name):
    """Removes the power of a motor: it neither drives nor brakes."""
    motor = made.model.actuator(f"drive_{name}").id
    made.model.actuator_gainprm[motor] = 0.0
    made.model.actuator_biasprm[motor] = 0.0


def stalls_at(predicted, dead=(), level=d.RIGID):
    """Slope of zero acceleration, from one below and one above, rad; and the last machine."""
    sines = [share * math.sin(predicted) for share in (0.98, 1.02)]
    found = [pulled(math.asin(sine), dead, level=level) for sine in sines]
    (up, _), (down, made) = found
    return math.asin(sines[0] + (sines[1] - sines[0]) * up / (up - down)), made


def slides(angle, level=d.RIGID):
    """Acceleration down a slope with locked wheels, m/s², and the machine."""
    made = rig.machine(level, angle=angle, locked=True)
    made.run(SETTLED)
    first = float(made.data.qvel[0])
    made.run(3.0)
    return (first - float(made.data.qvel[0])) / 3.0, made


def slip(level, seconds=3.0):
    """Slip of the wheels while the motors pull on level ground: share of the way over the ground by which the treads are
    ahead. And the machine."""
    made = rig.machine(level, ground="floor" if level.tyre.startswith("rigid") else "ground")
    made.run(SETTLED)
    rig.voltages(made, VOLTAGE)
    turned = [made.joint(f"drive_{name}") for name in rig.WHEELS]
    first = float(made.data.qpos[0])
    made.run(seconds)
    way = float(made.data.qpos[0]) - first
    treads = [made.joint(f"drive_{name}") - before for name, before in zip(rig.WHEELS, turned)]
    return d.AXLE_HEIGHT[level.tyre] * sum(treads) / len(treads) / way - 1.0, made


# --- steps and stones ------------------------------------------------------------------------------------------------------


def climbs(name, height, step=None, level=d.RIGID):
    """Torque with which the wheels `name` (front, middle or rear) leave the ground, N·m; and whether they are up at the end.

    The rover is let down onto ground and step, rolls to the edge and stands there; then all motors' torques rise slowly
    to what they can give. Without the stand, momentum would help. And the machine.
    """
    ahead, above = model.WHEEL_RADIUS + 0.02, 0.0 if name == "front" else height + 0.002
    made = rig.machine(level, x=-d.AXLE_X[name] - ahead, more_ground=height, step=step, height=above)
    wheel = f"wheel_{name}_left"
    told = crawl(CRAWL, level, cap=rising)
    made.run(LET_DOWN, crawl(0.0, level))
    made.start()  # the account of energy: without the fall
    made.run(STANDS - LET_DOWN, told)
    low = made.place(wheel)[2]
    lifted = made.run(RISE + 2.0, told, lambda m: m.place(wheel)[2] > low + LIFTED)
    torque = rising(made.time)
    if lifted:
        made.run(18.0, told, lambda m: m.place(wheel)[2] > height + 0.99 * model.WHEEL_RADIUS)
    return torque, made.place(wheel)[2] > height + 0.98 * model.WHEEL_RADIUS, made


def rising(time):
    """Largest torque of each motor, N·m."""
    return LEAST + (d.STALL_TORQUE - LEAST) * max(0.0, min(1.0, (time - STANDS) / RISE))


def over_stone(level, step=None, seconds=6.0, speed=0.7):
    """Drive with the left wheels over a stone of 0.15 m: the machine; position and pitch of the chassis, and loads, by
    time."""
    made = rig.machine(level, ground="stone", x=-2.2, step=step)
    rig.rolling(made, level, speed)
    every = round(0.01 / made.step)
    seen, count = [], 0

    def watch(m):
        nonlocal count
        count += 1
        if count % every == 0:
            q = m.data.qpos
            load = max(m.wrench(f"wheel_{name}")[2] for name in rig.WHEELS)
            seen.append(
                (m.time, q[0], q[2], 2 * q[5], 2 * q[4], load, m.joint("rocker_left") + m.joint("rocker_right"))
            )

    made.run(seconds, crawl(speed, level), watch)
    return made, np.array(seen)


def over_rocks(level, seconds=8.0, speed=1.0, prepare=None):
    """Terrain of models/rover with its rocks."""
    made = rig.machine(level, ground="terrain", x=-2.3, height=0.01)
    if prepare is not None:
        prepare(made)
    made.run(seconds, crawl(speed, level))
    return made
