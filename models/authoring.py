# SPDX-License-Identifier: GPL-3.0-or-later
"""Models through the modelling toolkit (blender/pong_pmtk), from Python: used by the build scripts.

A script describes a tree of groups and primitives with the functions below and hands it to `main`, which makes it a
Blender scene of marked objects, one for each group and primitive, and exports that scene as File > Export does: what
the toolkit refuses is refused here. Needs Blender as a Python module (pip install bpy). A build script then runs as

    python build.py [FOLDER] [--blend FILE]

and writes the model files into FOLDER (its own unless given) and, on request, the scene as a .blend file.

Lengths in metres, angles in degrees. Coordinates are rounded to a nanometre, quaternions to 1e-15; what Blender's
single precision cannot hold of them is kept beside it by the toolkit, so the model file has every digit.
"""

import argparse
import os
import pathlib
import sys
from dataclasses import dataclass

from geometry import rounded, solid

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "blender"))

from pong_pmtk.core.model import Group, Model, Primitive, Tagged  # noqa: E402

QUATERNION_ROUNDING = 15  # decimal places


# --- surfaces --------------------------------------------------------------------------------------------------------

def surface(stiffness, normal=None, friction=None):
    """Surface of a model's table. `stiffness` in N/m; `normal` and `friction` from the functions below."""
    return {"stiffness": float(stiffness), "normal": normal, "friction": friction}


def linear(damping=None, ramp=None, restitution=None):
    """Damping in N·s/m with an onset over the depth `ramp`, m; or `restitution=(e, mass)`."""
    rebound = None if restitution is None else {"e": restitution[0], "mass": float(restitution[1])}
    return _law("Linear", damping=damping, ramp=ramp, restitution=rebound)


def hunt_crossley(exponent, dissipation=None, restitution=None):
    """Dissipation in s/m; or `restitution=(e, speed)`. `exponent` is 1.0 or 1.5."""
    rebound = None if restitution is None else {"e": restitution[0], "speed": float(restitution[1])}
    return _law("HuntCrossley", dissipation=dissipation, exponent=exponent, restitution=rebound)


def power_law(exponent, damping_exponent, damping=None, restitution=None):
    """Damping in N·s/m^(1 + damping_exponent); or `restitution=(e, speed, mass)`. `exponent` is 1.0 or 1.5."""
    rebound = None if restitution is None else dict(zip(("e", "speed", "mass"), map(float, restitution), strict=True))
    return _law("PowerLaw", exponent=exponent, damping_exponent=damping_exponent, damping=damping, restitution=rebound)


def bristle(mu, static_excess=None, stiffness=None, damping=None, mass=None, rolling=None, spinning=None):
    """Damping in N·s/m, 0 for none; or `mass` in kg, for which it is critical. Without both it follows the normal law.
    `rolling` and `spinning` are lengths in m."""
    return _law("Bristle", mu=mu, static_excess=static_excess, stiffness=stiffness, damping=damping, mass=mass,
                rolling=rolling, spinning=spinning)


def coulomb(mu, slip_speed):
    return _law("Coulomb", mu=mu, slip_speed=slip_speed)


def _law(name, **fields):
    given = {key: value for key, value in fields.items() if value is not None}
    return Tagged(name, {key: value if isinstance(value, dict) else float(value) for key, value in given.items()})


def pair(first, second, stiffness=None, **laws):
    """Values of two surfaces when they touch; `normal=` and `friction=` as of a surface, `friction=None` for none."""
    own = {} if stiffness is None else {"stiffness": float(stiffness)}
    return {"surfaces": (first, second), **own, **laws}


# --- primitives ------------------------------------------------------------------------------------------------------

@dataclass
class Meshed(Primitive):
    """A primitive with vertices and faces, optionally in an OBJ or STL file beside the model."""

    file: str = ""


def point(name, position, surface=None):
    return Primitive("Point", name, {"position": rounded(position)}, surface)


def segment(name, a, b, surface=None):
    return Primitive("LineSegment", name, {"ends": (rounded(a), rounded(b))}, surface)


def sphere(name, center, radius, surface=None):
    return Primitive("Sphere", name, {"center": rounded(center), "radius": _length(radius)}, surface)


def ellipsoid(name, center, semi_axes, orientation=None, surface=None):
    """`orientation`: quaternion (w, x, y, z) of its axes."""
    fields = {"center": rounded(center), "semi_axes": rounded(semi_axes)}
    if orientation is not None:
        fields["orientation"] = _quaternion(orientation)
    return Primitive("Ellipsoid", name, fields, surface)


def capsule(name, a, b, radius, surface=None):
    """Capsule of `radius` around the segment from a to b: a link of a cable, a bar with spherical ends."""
    return Primitive("Capsule", name, {"ends": (rounded(a), rounded(b)), "radius": _length(radius)}, surface)


def cylinder(name, a, b, radius, surface=None):
    """A round solid with flat ends at a and b."""
    return Primitive("Cylinder", name, {"ends": (rounded(a), rounded(b)), "radius": _length(radius)}, surface)


def cone(name, a, b, radii, surface=None):
    """A round solid with different radii at a and b, one of which may be zero."""
    return Primitive("Cone", name, {"ends": (rounded(a), rounded(b)), "radii": rounded(radii)}, surface)


def bore(name, a, b, radii, thickness=None, mouths=(True, True), surface=None):
    """Wall of a hole from a to b; `radii`: at both, or one number. `mouths`: ends with an edge that makes contact."""
    both = (radii, radii) if isinstance(radii, (int, float)) else radii
    fields = {"ends": (rounded(a), rounded(b)), "radii": rounded(both)}
    if thickness is not None:
        fields["thickness"] = _length(thickness)
    return Primitive("Bore", name, {**fields, "mouths": tuple(map(bool, mouths))}, surface)


def ray(name, origin, direction, length, reach=None, response="Normal", surface=None):
    """A plunger; `direction` need not be of unit length."""
    fields = {"origin": rounded(origin), "direction": rounded(direction), "length": _length(length)}
    if reach is not None:
        fields["reach"] = _length(reach)
    return Primitive("Ray", name, {**fields, "response": response}, surface)


def flat_ground(name, normal, offset, surface=None):
    """Half space normal·x <= offset."""
    return Primitive("Plane", name, {"normal": rounded(normal), "offset": _length(offset)}, surface)


def polyhedron(name, half_spaces, inactive=(), surface=None):
    """A convex piece; `inactive`: indices of the half spaces that are internal faces."""
    vertices, faces = solid(half_spaces)
    return mesh_polyhedron(name, vertices, faces, inactive, surface)


def mesh_polyhedron(name, vertices, faces, inactive=(), surface=None, file=""):
    """A polyhedron from vertices and faces, which run counter-clockwise seen from outside."""
    fields = {"vertices": _rows(vertices), "faces": [list(map(int, face)) for face in faces]}
    if len(inactive):
        fields["inactive_faces"] = sorted(map(int, inactive))
    return Meshed("Polyhedron", name, fields, surface, file)


def triangle(name, vertices, thickness=None, two_sided=False, surface=None):
    fields = {"vertices": tuple(map(rounded, vertices)), **_sheet(thickness, two_sided)}
    return Primitive("Triangle", name, fields, surface)


def triangle_mesh(name, vertices, triangles, thickness=None, two_sided=False, surface=None, file=""):
    """`file`: name of an OBJ or STL file beside the model for the mesh; "" for within the model."""
    import numpy as np

    fields = {"vertices": _rows(vertices), "triangles": np.asarray(triangles, dtype=np.int64).reshape(-1, 3)}
    return Meshed("TriangleMesh", name, {**fields, **_sheet(thickness, two_sided)}, surface, file)


def custom(name, kind, parameters=(), surface=None):
    return Primitive("Custom", name, {"kind": kind, "parameters": [float(x) for x in parameters]}, surface)


def _sheet(thickness, two_sided):
    fields = {} if thickness is None else {"thickness": _length(thickness)}
    return {**fields, "two_sided": True} if two_sided else fields


def _length(x):
    return rounded((float(x),))[0]


def _quaternion(q):
    return tuple(round(float(c), QUATERNION_ROUNDING) + 0.0 for c in q)


def _rows(vertices):
    import numpy as np

    return np.array([rounded(map(float, vertex)) for vertex in vertices], dtype=np.float64).reshape(-1, 3)


# --- groups and models -----------------------------------------------------------------------------------------------

def group(
    name, groups=(), primitives=(), bound=None, surface=None, movable=False, position=None, orientation=None
):
    """A group of groups or of primitives; `position` and `orientation` in the frame of the group above."""
    return Group(
        name,
        movable,
        None if position is None else rounded(map(float, position)),
        None if orientation is None else _quaternion(orientation),
        bound,
        surface,
        list(groups),
        list(primitives),
    )


def model(name, surfaces, root, pairs=(), entry_memory=True):
    """A model; `surfaces`: name -> `surface(…)`, `root`: its group."""
    return Model(name, surfaces, root, list(pairs), entry_memory)


# --- from the tree to Blender and out ----------------------------------------------------------------------------

def main(models, folder, texts=None, arguments=None):
    """Builds models and writes their files; `folder` is that of the script. `texts`: name -> text of what is written
    beside them, such as scenes. Ends the program.
    """
    parser = argparse.ArgumentParser(description=f"Builds {', '.join(made.name for made in models)} with Blender.")
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=folder, help="where the models go")
    parser.add_argument("--blend", type=pathlib.Path, metavar="FILE", help="save the scene")
    options = parser.parse_args(arguments)
    failed = build(models, options.folder, options.blend)
    for name, text in ({} if failed else texts or {}).items():
        (options.folder / name).write_text(text, encoding="utf-8", newline="\n")
        print(f"{options.folder / name}: written")
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(failed)  # Blender as a module may crash or hang in its own exit, when Python has gone


def build(models, folder, blend=None):
    """Makes one scene of the models and exports each as `folder/<name>.ron`; returns 0, or 1 if the toolkit refuses one."""
    import bpy
    import pong_pmtk

    pong_pmtk.register()
    try:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        roots = [insert(bpy.context, made) for made in models]
        done = [export(bpy.context, made, root, folder) for made, root in zip(models, roots)]
        if blend is not None:
            _save(blend)
        return 0 if all(done) else 1
    finally:
        pong_pmtk.unregister()  # Blender frees what is registered after Python has gone, and crashes over it


def insert(context, made):
    """Makes a model marked objects of the scene, as opening its file would; returns the root."""
    import bpy
    from pong_pmtk.core.unbuild import unbuild
    from pong_pmtk.scene.insert import insert as insert_objects

    facts = unbuild(made, reserved=set(bpy.data.objects.keys()))
    files = dict(_files(made.root, made.root.name))
    for path, thing in _paths(facts):
        thing.mark.file = files.get(path, "")
    objects = insert_objects(facts, context.scene)
    context.view_layer.update()
    return next(objects[thing.name] for thing in facts.objects if thing.mark.role == "root")


def _files(tree, path):
    """Paths of the primitives with mesh files, with those files."""
    for below in tree.groups:
        yield from _files(below, f"{path}/{below.name}")
    for primitive in tree.primitives:
        if getattr(primitive, "file", ""):
            yield f"{path}/{primitive.name}", primitive.file


def _paths(facts):
    """All objects of a snapshot with their paths in the model."""
    paths = {}
    for thing in facts.objects:  # parents come first
        name = thing.mark.name or thing.name
        paths[thing.name] = f"{paths[thing.parent]}/{name}" if thing.parent else name
        yield paths[thing.name], thing


def export(context, made, root, folder):
    """Exports the model below a root and prints the findings; returns whether it was written."""
    from pong_pmtk.scene import session

    target = pathlib.Path(folder) / f"{made.name}.ron"
    try:
        result = session.export(context, target, root.name)
    except session.Refused as refused:
        result = refused.result
    for finding in result.findings:
        print(finding, file=sys.stderr)
    print(f"{target}: {'not written' if result.model is None else 'written'}")
    return result.model is not None


def _save(blend):
    from pong_pmtk.cli import save_blend

    save_blend(blend)
    print(f"{blend}: saved")
