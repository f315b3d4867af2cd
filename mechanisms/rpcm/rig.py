"""The box between its rails as a machine, and the random loads of Whitney's diagram."""

import dimensions as d
import numpy as np
from kit import mjcf
from kit.machine import Machine

GREY, BLUE, GOLD = "0.7 0.7 0.72 0.3", "0.3 0.45 0.65 0.6", "0.75 0.6 0.3 1"
INSIDE = 0.010 + d.LENGTH / 2  # where the middle of the box is when all of it is in the rails


def geom(kind, place, size, rgba, more=""):
    return f'<geom type="{kind}" pos="{mjcf.numbers(place)}" size="{mjcf.numbers(size)}" rgba="{rgba}" {more}/>'


def drawn_box():
    front = d.LENGTH / 2
    pins = [(front + d.PIN_LENGTH / 2, side * d.PIN_Y, 0) for side in d.SIDES.values()]
    cylinders = [geom("cylinder", p, (d.PIN_RADIUS, d.PIN_LENGTH / 2), GOLD, 'euler="0 1.5708 0"') for p in pins]
    return geom("box", (0, 0, 0), (front, d.WIDTH / 2, d.HEIGHT / 2), BLUE) + "".join(cylinders)


def root():
    """Position of the cone's base in the box."""
    return np.array((-d.LENGTH / 2, 0.0, 0.0))


def drawn_cone(slope):
    """Visual geoms of the cone: three cylinders."""
    parts = []
    for i in range(3):
        middle = (i + 0.5) / 3 * d.CONE_LENGTH
        place = root() - (middle, 0, 0)
        size = (d.CONE_RADIUS - middle * np.tan(slope), d.CONE_LENGTH / 6)
        parts.append(geom("cylinder", place, size, GOLD, 'euler="0 1.5708 0"'))
    return "".join(parts)


def drawn_rails():
    half, high = d.STOP / 2, d.HEIGHT / 2 + d.CLEARANCE + d.WALL
    webs = [
        geom("box", (half, side * (d.GAP + d.WALL) / 2, 0), (half, d.WALL / 2, high), GREY)
        for side in d.SIDES.values()
    ]
    back = geom("box", (d.STOP + d.WALL / 2, 0, 0), (d.WALL / 2, d.GAP / 2 + d.WALL, high), GREY)
    return "".join(webs) + back


FREE, ALONG = "<freejoint/>", '<joint name="along" type="slide" axis="1 0 0"/>'


def body(place, yaw=0.0, inside="", joint=FREE, slope=d.HALF_ANGLE):
    """A box with its middle at `place`; `slope`: half-angle of its cone; `inside`: additional contents."""
    turned = mjcf.numbers(mjcf.quaternion_about_z(yaw))
    return (
        f'<body name="box" pos="{mjcf.numbers(place)}" quat="{turned}">{joint}<inertial pos="0 0 0" '
        f'mass="{d.MASS:g}" diaginertia="{mjcf.numbers(d.INERTIA)}"/>{drawn_box()}{drawn_cone(slope)}{inside}</body>'
    )


def machine(place, yaw=0.0, connector=True, step=d.TRAINING.step, friction=None):
    objects, pairs = {"rails": "rails.ron", "box": "box.ron"}, [("rails", "box")]
    carried = {"rails": "world", "box": "box"}
    if connector:
        objects |= {"socket": "socket.ron", "plug": "plug.ron"}
        pairs.append(("socket", "plug"))
        carried |= {"socket": "world", "plug": "box"}
    extension = mjcf.contact_instance(objects, pairs, carried, folder=str(d.HERE), friction=friction)
    text = mjcf.model("rpcm", extension, drawn_rails() + body(place, yaw), step=step)
    return Machine(text, list(carried.values()))


def yaw(made):
    """Yaw of a box turned by a few degrees only."""
    matrix = made.data.xmat[made.model.body("box").id]
    return float(np.arctan2(matrix[3], matrix[0]))


# --- random loads --------------------------------------------------------------------------------------------------------

FORCE = 40.0  # N, along the way in
FIRST, THEN, TRIED = 0.08, 0.05, 0.20  # s: loads across come, the force along comes, the box is watched
SLID = 2e-3  # m: a box that slides goes further in that time; one that jams moves on its springs only


def moves(across, moment):
    """True if a box slides under FORCE along, `across` times as much sideways, and a moment of `moment` m times as much."""
    made = machine((INSIDE, 0, 0), connector=False, step=d.ANALYSIS.step)
    index = made.model.body("box").id

    def control(m):
        aside = FORCE * min(1.0, m.time / FIRST)
        along = FORCE * min(1.0, max(0.0, (m.time - FIRST) / THEN))
        made.data.xfrc_applied[index] = (along, across * aside, 0, 0, 0, moment * aside)

    made.run(FIRST, control)
    start = made.place("box")[0]
    return made.run(THEN + TRIED, control, watch=lambda m: m.place("box")[0] - start > SLID), made
