"""Shared parts of the tests: the plugin, small models, small MJCFs.

PLUGIN is the built plugin, PONG the program `pong` (ci/mujoco sets both).
"""

import os
import pathlib

import mujoco
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[3]
PLUGIN = os.environ["PLUGIN"]
PONG = os.environ["PONG"]
mujoco.mj_loadPluginLibrary(PLUGIN)
INTEGRATORS = ("Euler", "RK4", "implicit", "implicitfast", "discrete")

GROUND = """(format: "pong-model", version: 1, name: "ground", surfaces: { "rigid": (stiffness: inf) },
    root: (name: "ground", surface: "rigid", primitives: [Plane(name: "floor", normal: (0, 0, 1), offset: 0)]))"""


def ball_model(stiffness=2e4, damping=0.0, mu=0.0, tangential=None, tangential_damping=0.0, radius=0.1):
    friction = "None"
    if mu:
        more = f", stiffness: {tangential}" if tangential else ""
        friction = f"Bristle(mu: {mu}{more}, damping: {tangential_damping})"
    return f"""(format: "pong-model", version: 1, name: "ball",
        surfaces: {{ "rubber": (stiffness: {stiffness}, normal: Linear(damping: {damping}), friction: {friction}) }},
        root: (name: "ball", surface: "rubber", primitives: [
            Sphere(name: "shell", center: (0, 0, 0), radius: {radius})]))"""


def instance(objects, name="c", **keys):
    """An <instance>: `objects` and other keys of the configuration."""
    keys = {"objects": objects, **keys}
    lines = "".join(f"<config key='{key}' value='{value}'/>" for key, value in keys.items())
    return f"<instance name='{name}'>{lines}</instance>"


def mjcf(bodies, instances, integrator="Euler", timestep=1e-3, gravity="0 0 -9.81", more="", flags=""):
    return f"""<mujoco><option timestep="{timestep}" integrator="{integrator}" gravity="{gravity}"><flag {flags}/></option>
        <extension><plugin plugin="pong.contact">{instances}</plugin></extension>
        <worldbody>{bodies}</worldbody>{more}</mujoco>"""


FREE = "<body name='ball' pos='{place}'><freejoint/><inertial mass='{mass}' pos='0 0 0' diaginertia='{i} {i} {i}'/></body>"
SENSOR = "<sensor><plugin name='contact' instance='c'/></sensor>"


def ball_on_ground(place="0 0 0.2", mass=1.0, capacity=64, more=SENSOR, integrator="Euler", timestep=1e-3, gravity="0 0 -9.81",
                   joints=None, flags="", check="true", **surface):
    """One ball above a plane. `joints` replaces the free joint."""
    body = FREE.format(place=place, mass=mass, i=0.4 * mass * 0.01)
    if joints is not None:
        body = body.replace("<freejoint/>", joints)
    inside = instance("ball = text1; ground = text2", bodies="ground = world", text1=ball_model(**surface), text2=GROUND,
                      contact_capacity=capacity, check_step=check)
    text = mjcf(body, inside, integrator, timestep, gravity, more, flags)
    return mujoco.MjModel.from_xml_string(text)


def several_balls(count=6, integrator="Euler", timestep=1e-3):
    """Balls with friction that fall on the ground beside and on each other: contacts come and go, bristles turn."""
    names = [f"ball_{i}" for i in range(count)]
    bodies = ""
    for i, name in enumerate(names):
        place = f"{0.17 * (i % 3)} {0.02 * i} {0.15 + 0.21 * (i // 3)}"
        bodies += FREE.format(place=place, mass=1.0 + 0.1 * i, i=0.004).replace("'ball'", f"'{name}'")
    pairs = [f"{a}, {b}" for k, a in enumerate(names) for b in names[:k]] + [f"{a}, ground" for a in names]
    objects = "; ".join(f"{name} = text1" for name in names) + "; ground = text2"
    inside = instance(objects, bodies="ground = world", pairs="; ".join(pairs), check_step="false",
                      text1=ball_model(stiffness=2e4, damping=20.0, mu=0.5, tangential_damping=5.0), text2=GROUND)
    return mujoco.MjModel.from_xml_string(mjcf(bodies, inside, integrator, timestep, more=SENSOR))


def docking():
    """Path of the docking scene, independent of the working directory."""
    text = (ROOT / "hosts/mujoco/docking/docking.xml").read_text()
    folder = 'value="models/idss_docking"'
    assert text.count(folder) == 1
    return mujoco.MjModel.from_xml_string(text.replace(folder, f'value="{ROOT}/models/idss_docking"'))


FULL = mujoco.mjtState.mjSTATE_INTEGRATION


def full_state(m, d, kind=FULL):
    state = np.empty(mujoco.mj_stateSize(m, kind))
    mujoco.mj_getState(m, d, state, kind)
    return state


def run(m, d, steps):
    """Steps the simulation and returns the bits of every state on the way."""
    bits = []
    for _ in range(steps):
        mujoco.mj_step(m, d)
        bits.append(full_state(m, d).tobytes() + d.sensordata.tobytes())
    return bits


def assert_same_bits(test, bits, expected):
    """Asserts that two runs are equal, without printing the states: a report on them would take minutes."""
    test.assertEqual(len(bits), len(expected))
    differing = [step for step, (a, b) in enumerate(zip(bits, expected)) if a != b]
    test.assertFalse(differing, f"the runs differ from step {differing[:1]} on")
