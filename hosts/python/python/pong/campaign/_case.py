"""One run of a campaign, as a worker computes it."""

import hashlib
import os
import socket

import numpy as np

import pong

from ._errors import CampaignError

AXES = {"x": 0, "y": 1, "z": 2}
MOTIONS = ("position", "rotation", "velocity", "angular_velocity")


def read(path):
    """Text and digest of a scene."""
    with open(path, "rb") as file:
        content = file.read()
    return content.decode("utf-8"), hashlib.sha256(content).hexdigest()


def where():
    """This worker, for messages."""
    return f"{socket.gethostname()}, process {os.getpid()}"


def build(job):
    """The scene of a campaign as this machine has it, or why it is not that of the campaign."""
    path = job["scene"]
    cure = "put the scene and its models where every worker finds them under this path, or use workers of this machine"
    try:
        text, digest = read(path)
    except (OSError, UnicodeDecodeError) as reason:
        raise CampaignError(f"scene `{path}`: it cannot be read on the worker {where()}: {reason}; {cure}") from None
    if digest != job["digest"]:
        cause = f"the file on the worker {where()} is another than the one that the campaign began with"
        raise CampaignError(f"scene `{path}`: {cause}; bring it back, or begin another campaign")
    try:
        simulation = pong.Scene.parse(text, name=path, folder=os.path.dirname(path)).build(step=job["step"])
    except pong.PongError as reason:
        raise CampaignError(f"scene `{path}`: it cannot be built on the worker {where()}: {reason}; {cure}") from None
    if job["scene_hash"] is not None and simulation.scene_hash != job["scene_hash"]:
        cause = f"its models on the worker {where()} are others than those that the campaign began with"
        raise CampaignError(f"scene `{path}`: {cause}; bring them back, or begin another campaign")
    return simulation


def check(job):
    """Whether this worker can run the campaign: nothing, or why not."""
    try:
        build(job)
    except CampaignError as error:
        return str(error)
    return None


def turned(rotation, vectors):
    """Vectors turned by a rotation vector (Rodrigues)."""
    angle = np.linalg.norm(rotation)
    if angle == 0.0:
        return vectors
    axis = rotation / angle
    parallel = np.outer(vectors @ axis, axis).reshape(vectors.shape)
    return parallel + np.cos(angle) * (vectors - parallel) + np.sin(angle) * np.cross(axis, vectors)


def product(p, q):
    """Of two quaternions (w, x, y, z)."""
    vector = p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:])
    return np.concatenate([[p[0] * q[0] - p[1:] @ q[1:]], vector])


def in_frame_of(state, vector):
    """A vector of the common frame along the axes of a body."""
    w, v = state[3], -state[4:7]
    return vector + 2 * np.cross(v, np.cross(v, vector) + w * vector)


def in_common(state, vector):
    """A vector of a body along the common axes."""
    w, v = state[3], state[4:7]
    return vector + 2 * np.cross(v, np.cross(v, vector) + w * vector)


def displaced(states, pivot, change):
    """The states of the bodies of one Object (its root first), displaced as one rigid body: turned about the pivot, moved,
    and given a velocity and an angular velocity beside those that they have."""
    out = states.copy()
    root = states[0]
    at = root[:3] + in_common(root, pivot)
    angle = np.linalg.norm(change["rotation"])
    axis = change["rotation"] / angle if angle else np.zeros(3)
    turn = np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * axis])
    for row in out:
        arm = turned(change["rotation"], row[:3] - at)
        row[:3] = at + arm + change["position"]
        row[3:7] = product(turn, row[3:7])
        row[3:7] /= np.linalg.norm(row[3:7])
        # Velocities are those of the approach: they keep their direction, however the vehicle is turned.
        row[7:10] += change["velocity"] + np.cross(change["angular_velocity"], arm)
        row[10:] += change["angular_velocity"]
    return out


def apply(simulation, job, values):
    """Gives a simulation the values of a run."""
    changes = {}
    for name, value in zip(job["parameters"], values):
        parts = name.split(".")
        if parts[0] == "surface":
            set_surface(simulation, name, parts, value)
        elif len(parts) == 3 and parts[1] in MOTIONS and parts[2] in AXES:
            change = changes.setdefault(parts[0], {motion: np.zeros(3) for motion in MOTIONS})
            change[parts[1]][AXES[parts[2]]] += value
        else:
            cure = "write OBJECT.position.x (or rotation, velocity, angular_velocity; y, z) or surface.MODEL.SURFACE.VALUE"
            raise CampaignError(f"parameter `{name}`: it names nothing that can be dispersed; {cure}")
    states, bodies = simulation.states(), simulation.bodies
    for name, change in changes.items():
        rows = [i for i, body in enumerate(bodies) if body == name or body.startswith(name + "/")]
        if not rows:
            known = sorted({body.split("/")[0] for body in bodies})
            raise CampaignError(f"parameter `{name}`: there is no such Object; name one of: {', '.join(known)}")
        pivot = np.array(job["pivots"].get(name, (0.0, 0.0, 0.0)))
        simulation.set_states(displaced(states[rows], pivot, change), [bodies[i] for i in rows])


def set_surface(simulation, name, parts, value):
    """`surface.MODEL.SURFACE.stiffness`, `….normal.damping`, `….friction.mu`."""
    if len(parts) not in (4, 5) or len(parts) == 5 and parts[3] not in ("normal", "friction"):
        raise CampaignError(f"parameter `{name}`: write surface.MODEL.SURFACE.VALUE, such as surface.ring.steel.friction.mu")
    _, model, surface, *path = parts
    values = simulation.surface(model, surface)
    place = values[path[0]] if len(path) == 2 else values
    # A switch, such as `hertz`, is no number that could be spread.
    numbers = [key for key, known in place.items() if isinstance(known, float | int) and not isinstance(known, bool)]
    if path[-1] not in numbers:
        raise CampaignError(f"parameter `{name}`: the surface has no value `{path[-1]}`; it has: {', '.join(numbers)}")
    place[path[-1]] = value
    simulation.set_surface(model, surface, values)


def met(criterion, bodies, states):
    """Whether the end of a run meets a criterion."""
    own, other = (states[bodies.index(name)] for name in (criterion["body"], criterion["of"]))
    apart = in_frame_of(other, own[:3] - other[:3])
    # Of the place on the other body at which the origin is.
    speed = np.linalg.norm(own[7:10] - other[7:10] - np.cross(other[10:], own[:3] - other[:3]))
    inside = all(low <= x <= high for low, x, high in zip(criterion["low"], apart, criterion["high"]))
    return bool(inside and speed <= (np.inf if criterion["speed"] is None else criterion["speed"]))


def outcome(job, index, values, log=None):
    """The row of one run. An error of the run is in the row: it must not end the campaign."""
    simulation = build(job)
    row = {"run": index, **dict(zip(job["parameters"], map(float, values)))}
    try:
        apply(simulation, job, values)
        steps = simulation.steps if job["duration"] is None else round(job["duration"] / simulation.step_length)
        options = {} if log is None else {"log": log, "every": simulation.record_every}
        done = simulation.run(steps, **({"every": max(steps, 1)} | options))
    except pong.PongError as error:
        return row | {"error": type(error).__name__, "message": str(error)}
    bodies, last = done.bodies, done.states[-1]
    for place, body in enumerate(bodies):
        row[f"peak_force.{body}"] = float(done.peak_force[place])
        row[f"peak_moment.{body}"] = float(done.peak_moment[place])
        row[f"peak_depth.{body}"] = float(done.peak_depth[place])
    for criterion in job["criteria"]:
        row[criterion["name"]] = met(criterion, bodies, last)
    row["contacts_at_end"] = int(done.contacts[-1])
    row["tunnelled"] = int(done.tunnelled)
    row["warnings"] = "\n".join(done.warnings)
    return row


def outcomes(job, indices, values):
    """The rows of some runs: what one task of a worker is."""
    return [outcome(job, index, row) for index, row in zip(indices, values)]
