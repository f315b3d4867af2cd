"""One run of a campaign, as computed by a worker."""

import hashlib
import os
import socket

import pong

from ._addresses import apply
from ._criteria import met
from ._errors import CampaignError
from ._stops import Watch


def read(path):
    """Text and digest of a scene."""
    with open(path, "rb") as file:
        content = file.read()
    return content.decode("utf-8"), hashlib.sha256(content).hexdigest()


def where():
    """Name of this worker, for messages."""
    return f"{socket.gethostname()}, process {os.getpid()}"


def build(job):
    """Loads the scene of a campaign on this machine, or fails if it differs from that of the campaign."""
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
        simulation = pong.Scene.parse(text, name=path, folder=os.path.dirname(path))
        simulation = simulation.build(step=job["step"], integrator=job["integrator"], alternative=job["alternative"])
    except pong.PongError as reason:
        raise CampaignError(f"scene `{path}`: it cannot be built on the worker {where()}: {reason}; {cure}") from None
    if job["scene_hash"] is not None and simulation.scene_hash != job["scene_hash"]:
        cause = f"its models on the worker {where()} are others than those that the campaign began with"
        raise CampaignError(f"scene `{path}`: {cause}; bring them back, or begin another campaign")
    return simulation


def check(job):
    """Checks whether this worker can run the campaign; returns the obstacle or None."""
    try:
        build(job)
    except CampaignError as error:
        return str(error)
    return None


def outcome(job, index, values, log=None):
    """The row of one run. A failed run returns its error in the row, because it must not end the campaign."""
    simulation = build(job)
    row = {"run": index, **dict(zip(job["parameters"], map(float, values)))}
    try:
        apply(simulation, job, values)
        steps = simulation.steps if job["duration"] is None else round(job["duration"] / simulation.step_length)
        options = {"every": max(steps, 1)} if log is None else {"log": log, "every": simulation.record_every}
        watch = Watch(job, simulation.bodies)
        if watch.stops:
            looks = max(1, round(job["look_every"] / simulation.step_length))
            options |= {"stop": watch, "stop_every": looks}
        done = simulation.run(steps, **options)
    except pong.PongError as error:
        return row | {"error": type(error).__name__, "message": str(error)}
    bodies, last = done.bodies, done.states[-1]
    for place, body in enumerate(bodies):
        row[f"peak_force.{body}"] = float(done.peak_force[place])
        row[f"peak_moment.{body}"] = float(done.peak_moment[place])
        row[f"peak_depth.{body}"] = float(done.peak_depth[place])
    for criterion in job["criteria"]:
        row[criterion["name"]] = met(criterion, bodies, last)
    row["time_at_end"] = float(done.time[-1])
    row["ended_by"] = watch.ended_by or "duration"
    row["contacts_at_start"] = int(done.contacts[0])
    row["contacts_at_end"] = int(done.contacts[-1])
    row["tunnelled"] = int(done.tunnelled)
    row["warnings"] = "\n".join(done.warnings)
    return row


def outcomes(job, indices, values):
    """Rows of several runs: one task of a worker."""
    return [outcome(job, index, row) for index, row in zip(indices, values)]
