"""Alternatives of a scene's model form: other laws of contact, other models, another scene (docs/sensitivity.md).

Other laws are written as models and a scene of their own, so that every run of an alternative can be repeated."""

import copy
import math
import os
import pathlib
from dataclasses import dataclass, replace

import pong
import pong.model

from ._dispersions import take_numbers
from ._errors import CampaignError

FRICTIONS = ("same", "Coulomb", "None")


@dataclass(frozen=True)
class OtherModels:
    """Alternative: files that the scene names in its `alternatives`.

    Parameters
    ----------
    name : str
        Name of the alternative in the scene.
    """

    name: str


@dataclass(frozen=True)
class OtherScene:
    """Alternative: another scene with the same bodies.

    Parameters
    ----------
    name : str
        Name of the alternative.
    scene : path_like
        Scene file.
    """

    name: str
    scene: str


@dataclass(frozen=True)
class OtherLaws:
    """Alternative: the same models with other laws of contact.

    A `Linear` normal law becomes a `PowerLaw`. At `force`, both laws have stored the same energy, and a contact that
    closes as fast has lost the same energy in them, to first order in the damping.

    Parameters
    ----------
    name : str
        Name of the alternative.
    force : float, optional
        Normal force of a contact at which the laws agree, N. Without it, normal laws stay.
    exponent : float, default 1.0
        Exponent of the depth in the spring, 1.0 or 1.5.
    damping_exponent : float, default 1.0
        Exponent of the depth in the damper, from 0 to `exponent`.
    friction : {"same", "Coulomb", "None"}, default "same"
        Law of friction; `Coulomb` keeps the coefficient of a bristle.
    slip_speed : float, optional
        Speed at which `Coulomb` friction reaches its full value, m/s.
    """

    name: str
    force: float | None = None
    exponent: float = 1.0
    damping_exponent: float = 1.0
    friction: str = "same"
    slip_speed: float | None = None

    def __post_init__(self):
        take_numbers(self, "force", "exponent", "damping_exponent", "slip_speed")
        fault = self.fault()
        if fault:
            raise CampaignError(f"alternative `{self.name}`: {fault}")

    def fault(self):
        """The fault of the parameters, or None."""
        if self.force is None and self.friction == "same":
            return "it changes no law; give a force, at which normal laws agree, or another friction"
        if self.force is not None and not 0.0 < self.force < math.inf:
            return f"force is {self.force}; give a finite number above zero, N"
        if self.exponent not in (1.0, 1.5):
            return f"exponent is {self.exponent}; give 1.0 or 1.5"
        if not 0.0 <= self.damping_exponent <= self.exponent:
            return f"damping_exponent is {self.damping_exponent}; give a number from 0 to {self.exponent:g}, the exponent"
        if self.friction not in FRICTIONS:
            return f"there is no friction `{self.friction}`; give one of {', '.join(FRICTIONS)}"
        if (self.friction == "Coulomb") != (self.slip_speed is not None):
            return "slip_speed belongs to Coulomb friction; give both or none"
        return None

    def law(self, stiffness, damping):
        """Returns the law that replaces a linear one of a surface, whose depth under `force` is that of its own spring.

        Parameters
        ----------
        stiffness : float
            Stiffness of the surface, N/m.
        damping : float
            Damping of its linear law, N·s/m.

        Returns
        -------
        tuple[float, dict]
            Stiffness and normal law, as a model file has them.
        """
        p, q = self.exponent, self.damping_exponent
        depth = self.force / stiffness
        # Stored: k·δ²/2 = k'·δ^(p + 1)/(p + 1). Lost while closing: c·v·δ·π/4 = c'·v·δ^(q + 1)·I.
        other = stiffness * 0.5 * (p + 1.0) * depth ** (1.0 - p)
        lost = damping * (math.pi / 4.0) / (closing_integral(p, q) * depth**q)
        return other, {"PowerLaw": {"exponent": p, "damping_exponent": q, "damping": lost}}


KINDS = (OtherModels, OtherScene, OtherLaws)


def plan_with(plan, alternative, folder):
    """Plan of an alternative; other laws are written into the folder."""
    if isinstance(alternative, OtherScene):
        return replace(plan, scene=alternative.scene, alternative=None)
    if isinstance(alternative, OtherModels):
        return replace(plan, alternative=alternative.name)
    dispersed = [name for name in plan.parameters if name.startswith("surface.") and name.endswith((".stiffness", ".damping"))]
    if alternative.force is not None and dispersed:
        cause = "it is dispersed, and its unit is another in the other law"
        raise CampaignError(f"alternative `{alternative.name}`: `{dispersed[0]}`: {cause}; take it out of the dispersions")
    return replace(plan, scene=written(plan.scene, alternative, pathlib.Path(folder)))


def written(scene, alternative, folder):
    """Writes a scene and its models with other laws into a folder, and returns the path of the scene."""
    scene = pathlib.Path(scene)
    changed = 0
    for file in pong.Scene.load(scene).model_files:
        place = relative(file, scene.parent, alternative)
        data = pong.model.read(file)
        changed += change(data, alternative, file)
        save(folder / place, pong.model.write(data).encode())
        for mesh in meshes(data):
            save(folder / place.parent / mesh, (file.parent / mesh).read_bytes())
    if not changed:
        cause = f"no surface of the scene `{scene}` has a law that it changes"
        raise CampaignError(f"alternative `{alternative.name}`: {cause}; leave it out")
    save(folder / scene.name, scene.read_bytes())
    return folder / scene.name


def relative(file, home, alternative):
    """Path of a model from the folder of its scene."""
    place = pathlib.Path(os.path.relpath(file, home))
    if place.parts[0] == os.pardir:
        cause = f"the model {file} is not in the folder of its scene, {home}"
        raise CampaignError(f"alternative `{alternative.name}`: {cause}; put it there, or give an OtherScene")
    return place


def save(path, content):
    """Writes a file unless it is there with the same content."""
    if not (path.is_file() and path.read_bytes() == content):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def meshes(data):
    """Relative paths of the mesh files of a model."""
    if isinstance(data, dict):
        for key, value in data.items():
            if key == "file" and isinstance(value, str):
                yield value
            else:
                yield from meshes(value)
    elif isinstance(data, list | tuple):
        for value in data:
            yield from meshes(value)


def change(data, alternative, file):
    """Changes the laws of a model; returns the number of laws that changed."""
    numbers = pong.Model.load(file).surfaces
    count = 0
    for name, surface in data["surfaces"].items():
        count += change_normal(surface, surface["stiffness"], numbers[name], alternative)
        count += change_friction(surface, alternative)
    for entry in data.get("pairs") or []:
        if alternative.force is not None and entry.get("normal"):
            cause = f"an entry of `pairs` in {file} has a normal law of its own"
            raise CampaignError(f"alternative `{alternative.name}`: {cause}; give an OtherScene")
        count += change_friction(entry, alternative)
    return count


def change_normal(surface, stiffness, numbers, alternative):
    """Replaces a linear law."""
    damping = linear_damping(surface, numbers)
    if alternative.force is None or damping is None or not math.isfinite(stiffness):
        return 0
    surface["stiffness"], surface["normal"] = alternative.law(stiffness, damping)
    return 1


def linear_damping(surface, numbers):
    """Damping of a linear law, N·s/m; None for another law."""
    normal = surface.get("normal")
    if normal is None:
        return 0.0
    return numbers["normal"]["damping"] if "Linear" in normal else None


def closing_integral(p, q):
    """∫ u^q·√(1 − u^(p + 1)) du from 0 to 1: B((q + 1)/(p + 1), 3/2)/(p + 1)."""
    a = (q + 1.0) / (p + 1.0)
    return math.gamma(a) * math.gamma(1.5) / (math.gamma(a + 1.5) * (p + 1.0))


def change_friction(entry, alternative):
    """Replaces a bristle."""
    friction = entry.get("friction")
    if alternative.friction == "same" or not isinstance(friction, dict):
        return 0
    if alternative.friction == "None":
        entry["friction"] = None
        return 1
    if "Bristle" not in friction:
        return 0
    mu = copy.copy(friction["Bristle"]["mu"])
    entry["friction"] = {"Coulomb": {"mu": mu, "slip_speed": alternative.slip_speed}}
    return 1
