"""Response log (docs/response_logs.md) of a MuJoCo run with Pong's contact: for films, viewers and `pong trade`.

A contact world in the wheel `pong` writes it. That world has the Objects and pairs of the plugin's instance, gets the
states of the bodies after each step of MuJoCo, and must come to the wrenches of the plugin's sensor.
"""

import pathlib
import xml.etree.ElementTree as xml

import mujoco
import numpy as np

from kit import figure

STATE = 13  # position, quaternion, velocity of the origin, angular velocity
SENSED_BEFORE_WRENCHES = 3


class World:
    """A contact world of the wheel `pong` with the Objects and pairs of the plugin's instance, and the states of its bodies."""

    def __init__(self, machine, drawn=()):
        keys = _keys(machine.text)
        self.machine = machine
        self.world = _world(keys, figure.model(machine.model, drawn) if drawn else None)
        self.bodies = [_body(machine.model, keys, _group(made.name)) for made in self.world.interfaces]
        self.states = np.zeros((len(self.bodies), STATE))

    def at(self):
        """The world, evaluated at the present states."""
        self.move()
        self.world.evaluate()
        return self.world

    def move(self):
        """Sets the present states."""
        model, data, velocity = self.machine.model, self.machine.data, np.empty(6)
        for state, body in zip(self.states, self.bodies):
            mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, body, velocity, 0)
            state[:3], state[3:7] = data.xpos[body], data.xquat[body]
            state[7:10], state[10:] = velocity[3:], velocity[:3]
        self.world.set_states(self.states)


class Follower:
    """Watcher of every step of a `Machine`: its contact world commits what the plugin does, and can write its last state as a log
    of one row, with the contact state."""

    def __init__(self, machine):
        self.beside = World(machine)
        self.world = self.beside.at()
        self.machine = machine

    def __call__(self, machine):
        self.beside.move()
        self.world.step()

    def write(self, folder):
        pathlib.Path(folder).parent.mkdir(parents=True, exist_ok=True)
        machine = self.machine
        self.world.start_log(folder, name=machine.name, step=machine.step, commits_per_frame=1, overwrite=True)
        self.beside.at().log_frame(machine.time)
        self.world.stop_log()


class Recorder:
    """Watcher of every step of a `Machine`; each `every`-th is a row of the log.

    `drawn`: patterns of names of bodies whose geoms the log shows beside what touches, such as "link_*".
    `off` is the greatest difference between wrenches of this world and of the plugin, over the greatest force or moment.
    """

    def __init__(self, machine, folder, every=1, drawn=()):
        self.beside = World(machine, drawn)
        self.world = self.beside.at()
        self.machine, self.every, self.steps, self.off = machine, every, 0, 0.0
        # Created first: the writer creates a folder, but not its parents.
        pathlib.Path(folder).parent.mkdir(parents=True, exist_ok=True)
        self.world.start_log(folder, name=machine.name, step=machine.step, commits_per_frame=every, overwrite=True)
        self.world.log_frame(machine.time)

    def __call__(self, machine):
        self.beside.move()
        self.world.step()
        self._compare()
        self.steps += 1
        if self.steps % self.every == 0:
            self.world.log_frame(machine.time)

    def close(self):
        """Closes the log and returns its number of rows."""
        return self.world.stop_log()

    def _compare(self):
        machine = self.machine
        sensed = machine.data.sensordata[machine.sensed][SENSED_BEFORE_WRENCHES:].reshape(-1, 6)
        greatest = np.abs(sensed).max(initial=0.0)
        if greatest > 0.0:
            # Visual Objects come last, without contact.
            wrenches = self.world.wrenches()[: len(sensed)]
            self.off = max(self.off, float(np.abs(wrenches - sensed).max() / greatest))


def _keys(text):
    """Configuration of the pong.contact instance in an MJCF text."""
    return {config.get("key"): config.get("value") for config in xml.fromstring(text).iterfind(".//instance/config")}


def _entries(keys, key, between):
    """The parts of each entry of a key, as docs/mujoco.md writes them."""
    entries = (entry.strip() for entry in keys.get(key, "").split(";"))
    return [tuple(part.strip() for part in entry.split(between)) for entry in entries if entry]


def _world(keys, drawn=None):
    import pong

    builder = pong.WorldBuilder(contact_capacity=int(keys.get("contact_capacity", 64)))
    models = {}
    objects = _entries(keys, "objects", "=")
    for name, model in objects:
        if model not in models:
            models[model] = builder.add_model(_model(pong, keys, model))
        builder.create_object(models[model], name)
    for a, b in _entries(keys, "pairs", ",") or [tuple(name for name, _ in objects)]:
        builder.pair(a, b)
    if drawn is not None:
        builder.create_object(builder.add_model(pong.Model.parse(drawn)), figure.NAME)
    return builder.seal()


def _model(pong, keys, name):
    return pong.Model.parse(keys[name]) if name in keys else pathlib.Path(keys.get("dir", ".")) / name


def _group(interface):
    """Name of a group in the plugin: an Interface OBJECT/ROOT/PATH is the group OBJECT/PATH, and OBJECT/ROOT is OBJECT."""
    name, _, *path = interface.split("/")
    return "/".join([name, *path])


def _body(model, keys, group):
    """Id of the body that carries a group: from the key `bodies`, or the one with the group's name."""
    if group == figure.NAME or group.startswith(f"{figure.NAME}/"):
        return model.body(group.partition("/")[2] or "world").id
    carriers = dict(_entries(keys, "bodies", "="))
    name = carriers.get(group, group)
    return 0 if name == "world" else model.body(keys.get("prefix", "") + name).id
