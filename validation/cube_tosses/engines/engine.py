"""Interface of an engine in this study: parameters go in, poses of the cube come out."""

from abc import ABC, abstractmethod

from validation.cube_tosses.data import PUBLISHED_BODY
from validation.cube_tosses.protocol import STEP, SUBSTEPS


class MissingEngine(Exception):
    """Absence of the Python package of an engine."""


class Engine(ABC):
    """One engine with one law of contact."""

    name = ""  # of the command line
    title = ""  # of tables
    free = {}  # name of each parameter: its `Free`
    units = {}  # name of each parameter: its unit

    def __init__(self):
        self.step, self.substeps, self.table = STEP, SUBSTEPS, 0.0
        self.body, self.values = PUBLISHED_BODY, {}

    def configure(self, values, body=PUBLISHED_BODY, table=0.0, substeps=SUBSTEPS):
        """Takes parameters, body, height of the table (m) and the number of steps in a frame."""
        unknown = set(values) ^ set(self.free)
        if unknown:
            raise ValueError(
                f"{self.name}: parameter `{sorted(unknown)[0]}` is missing or unknown; it has {', '.join(self.free)}"
            )
        self.values, self.body, self.table = dict(values), body, table
        self.step, self.substeps = STEP * SUBSTEPS / substeps, substeps
        self.build()

    @abstractmethod
    def build(self):
        """Makes the simulation of the present parameters."""

    @abstractmethod
    def follow(self, start, frames):
        """Poses (frames × 7) of a cube that starts with these 13 numbers over a table at height zero."""

    def peak_force(self):
        """Greatest contact force of the last run in N, or None where the engine does not say."""
        return None

    def poses(self, case):
        """Poses of the frames of a case."""
        start = case.start.copy()
        start[2] -= self.table
        poses = self.follow(start, len(case.measured))
        poses[:, 2] += self.table
        return poses


def package(name, of):
    """Imports the package of an engine; without it, the error names the cure."""
    import importlib

    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise MissingEngine(
            f"{of}: the Python package `{name}` is not installed; pip install -r validation/peers.txt"
        ) from error
