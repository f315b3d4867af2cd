"""Motions of the hexapod: standing, shifting until it tips, standing and sliding on slopes, walking."""

import math

import dimensions as d
import gait
import leg
import numpy as np
import rig

SETTLED = 1.0  # s
SHIFT_SPEED = 0.01  # m/s
LOADED = 2.0  # N: a foot that bears more stands
THREE = d.TRIPODS[0]


# --- statics ---


def loads(feet, centre, gravity):
    """Loads of three feet on the plane z = 0, N, from balance normal to it and about its two axes."""
    places = np.array([(x, y, 1.0) for x, y, _ in feet]).T
    # Gravity through the mass centre meets the plane here.
    met = centre - gravity * (centre[2] / gravity[2])
    return np.linalg.solve(places, -d.MASS * gravity[2] * np.array((met[0], met[1], 1.0)))


def on_three(height=d.HEIGHT, shift=(0.0, 0.0)):
    """Positions of the feet: one tripod stands, the other is lifted."""
    places = []
    for i in rig.LEGS:
        x, y, z = leg.neutral(i, height)
        lifted = i not in THREE
        places.append((x, y, z + d.LIFT) if lifted else (x - shift[0], y - shift[1], z))
    return places


def standing_on_three(step, gravity, height=d.HEIGHT, stiffer=1.0):
    hexapod = rig.machine(step, gravity=gravity, height=height, stiffer=stiffer)
    rig.pose(hexapod, on_three(height), height + d.FOOT_RADIUS)
    return hexapod


def tripod_loads(step, slope, azimuth):
    """Measured and predicted loads of three feet, N."""
    gravity = rig.slope(slope, azimuth)
    hexapod = standing_on_three(step, gravity)
    hexapod.run(2 * SETTLED)
    measured = hexapod.forces()[list(THREE), 2]
    return measured, loads(rig.feet(hexapod)[list(THREE)], rig.mass_centre(hexapod), np.array(gravity)), hexapod


# --- tipping ---


def away(foot):
    """Direction of the body away from a foot."""
    return -math.cos(d.AZIMUTHS[foot]), -math.sin(d.AZIMUTHS[foot])


def edge_shift(foot, height=d.LOW):
    """Shift of the body that moves the mass centre over the line of the other two feet, m.

    Bisection for a rigid hexapod, less what it leans forward because two feet bear all and sink, and the third none.
    """
    x, y = away(foot)
    low, high = 0.0, 0.2
    for _ in range(50):
        middle = 0.5 * (low + high)
        places = on_three(height, (middle * x, middle * y))
        others = [places[i] for i in THREE if i != foot]
        edge = np.array(others).mean(axis=0)  # the two are symmetric about the direction
        beyond = (centre(places)[:2] - edge[:2]) @ (x, y) > 0.0
        low, high = (low, middle) if beyond else (middle, high)
    sunk, apart = d.MASS * d.GRAVITY / (2 * d.STIFFNESS), 1.5 * d.STANCE
    return low - (height + d.FOOT_RADIUS + centre(places)[2]) * sunk / apart


def centre(places):
    """Mass centre in the body, from the positions of the feet."""
    total = np.zeros(3)
    for i, place in enumerate(places):
        yaw, up, knee = leg.angles(i, place)
        yaw += d.AZIMUTHS[i]
        hip = np.array((*leg.hip(i), 0.0))
        coxa = d.COXA * np.array((math.cos(yaw), math.sin(yaw), 0.0))
        femur, tibia = pointing(yaw, up) * d.FEMUR, pointing(yaw, up + knee) * d.TIBIA
        total += d.COXA_MASS * (hip + coxa / 2) + d.FEMUR_MASS * (hip + coxa + femur / 2)
        total += d.TIBIA_MASS * (hip + coxa + femur + tibia / 2)
    return total / d.MASS


def pointing(yaw, up):
    return np.array((math.cos(yaw) * math.cos(up), math.sin(yaw) * math.cos(up), math.sin(up)))


def shifted(step, foot, far, stiffer=1.0):
    """Shift at which a foot's load became zero, or None, as the body shifts slowly away from it by `far`."""
    hexapod = standing_on_three(step, rig.LEVEL, d.LOW, stiffer)
    hexapod.run(SETTLED)
    x, y = away(foot)
    empty = None
    while hexapod.time < SETTLED + far / SHIFT_SPEED + 2.0:
        shift = min(far, SHIFT_SPEED * (hexapod.time - SETTLED))
        rig.tell(hexapod, on_three(d.LOW, (shift * x, shift * y)))
        hexapod.hurry()
        if empty is None and hexapod.forces()[foot][2] <= 0.0:
            empty = shift
    return empty, hexapod


# --- slopes ---


def creeps(step, share, seconds, made=None):
    """Creep on six feet at a share of tan θ = μ: displacement of the body across and along the slope, m, and the hexapod."""
    hexapod = on_slope(step, math.atan(share * d.FRICTION), made)
    for _ in range(round(2 * SETTLED / step)):
        hexapod.hurry()
    start = hexapod.place("body")
    for _ in range(round(seconds / step)):
        hexapod.hurry()
    return float(np.linalg.norm(hexapod.place("body") - start)), hexapod


def slides(step, share, made=None):
    """Sliding above tan θ = μ: acceleration, measured and predicted, m/s²."""
    angle = math.atan(share * d.FRICTION)
    hexapod = on_slope(step, angle, made)
    speeds = []
    for _ in range(2):
        for _ in range(round(0.5 / step)):
            hexapod.hurry()
        speeds.append(-float(hexapod.data.qvel[0]))
    return (speeds[1] - speeds[0]) / 0.5, d.GRAVITY * (math.sin(angle) - d.FRICTION * math.cos(angle)), hexapod


def on_slope(step, angle, made=None):
    return rig.machine(step, gravity=rig.slope(angle), above=-rig.sunk(), made=made)


# --- walking ---


class Walk:
    """Walk with records of slip of the feet, tilt and largest torque."""

    def __init__(self, step, tiles=0, stiffer=1.0, made=None):
        above = sum(wave[0] for wave in d.WAVES) if tiles else 0.0  # it drops onto the terrain
        self.hexapod = rig.machine(step, tiles, above=above, stiffer=stiffer, made=made)
        self.gait = gait.Gait()
        self.slipped, self.tilt, self.torque = np.zeros(6), 0.0, 0.0

    def go(self, seconds, step_once=None):
        """`step_once`: hexapod.advance for the accounts; hurry otherwise."""
        once = step_once or self.hexapod.hurry
        every = round(d.TICK / self.hexapod.step)
        for k in range(round(seconds / self.hexapod.step)):
            once(self.gait.control)
            if k % every == 0:
                self._look()

    def _look(self):
        for i, force in enumerate(self.hexapod.forces()):
            if force[2] > LOADED:
                self.slipped[i] += d.TICK * float(np.linalg.norm(rig.foot_velocity(self.hexapod, i)[:2]))
        self.tilt = max(self.tilt, rig.tilt(self.hexapod))
        self.torque = max(self.torque, float(np.abs(self.hexapod.data.actuator_force).max()))

    def way(self):
        return float(self.hexapod.data.qpos[0])

    def slip_share(self):
        """Sliding distance of the feet, relative to the distance walked."""
        return float(self.slipped.mean()) / self.way()


def tiles_for(metres):
    return math.ceil((metres + rig.BEHIND + 1.0) / d.TILE)
