# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line: a response log as film, pictures or .blend, without a window.

Exit codes: 0 done, 1 it cannot be shown or written, 2 wrong usage.
"""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path


def arguments(words, program: str) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog=program,
        description="Plays a response log back: bodies in motion, contacts marked (green: sticks, red: slips), forces as "
                    "arrows on the first object of each pair.",
    )
    parser.add_argument("log", type=Path, nargs="?", help="folder that `pong run --log` or a host wrote")
    parser.add_argument("-o", "--output", type=Path, help="film, .mp4")
    parser.add_argument("--frames", type=Path, metavar="DIR", help="every picture as PNG")
    parser.add_argument("--still", type=Path, metavar="PNG", help="one picture; at --at, else at the largest force")
    parser.add_argument("--at", type=float, metavar="S", help="time of the still, s in the log")
    parser.add_argument("--blend", type=Path, metavar="FILE", help="the animated scene as .blend")
    parser.add_argument("--remove", type=Path, metavar="FILE", help="no log: take the responses out of this .blend; --blend "
                                                                    "names the file that is written, which may be the same")
    _add_what_is_shown(parser)
    _add_how_it_is_rendered(parser)
    given = parser.parse_args(words)
    if given.remove is not None:
        if given.log is not None or given.blend is None:
            parser.error("--remove takes no log, and needs --blend: python -m pong_viz --remove shown.blend --blend clean.blend")
    elif given.log is None:
        parser.error("the following arguments are required: log")
    if not (given.output or given.frames or given.still or given.blend):
        parser.error("nothing to make: give -o, --frames, --still or --blend")
    if given.fps < 1 or not given.speed > 0.0:
        parser.error("--fps and --speed must be above zero")
    for path, ending in ((given.output, ".mp4"), (given.still, ".png"), (given.blend, ".blend")):
        if path is not None and path.suffix.lower() != ending:
            parser.error(f"{path}: the name must end in {ending}")
    if given.blend and given.graphics and given.blend.resolve() == given.graphics.resolve():
        parser.error(f"{given.blend}: --blend would replace the graphics; give another name")
    return given


def _add_what_is_shown(parser) -> None:
    parser.add_argument("--graphics", type=Path, metavar="FILE", help=".blend with the author's own graphics, which move")
    parser.add_argument("--map", type=_pair, action="append", default=[], metavar="BODY=OBJECT",
                        help="which object of the graphics a body moves; else the one with the property `pong_body`, else the "
                             "one with the body's name")
    parser.add_argument("--shapes", choices=("all", "missing", "touched", "none"), default="missing",
                        help="draw the models' primitives: of all bodies; of those without graphics (default); as default and, "
                             "over graphics, each one while it touches; of none")
    parser.add_argument("--fps", type=int, default=30, help="pictures per second of film; default 30")
    parser.add_argument("--speed", type=float, default=1.0, help="0.1 is ten times slower than life; default 1")
    parser.add_argument("--from", dest="start", type=float, metavar="S", help="first instant, s in the log")
    parser.add_argument("--to", dest="end", type=float, metavar="S", help="last instant, s in the log")
    parser.add_argument("--relative-to", default="", metavar="BODY", help="hold this body still")
    parser.add_argument("--arrow", type=float, default=0.0, metavar="M", help="length of the largest force, m")
    parser.add_argument("--mark", type=float, default=0.0, metavar="M", help="radius of the disc at a contact, m")
    parser.add_argument("--most-contacts", type=int, default=64, metavar="N", help="shown at once; default 64")
    parser.add_argument("--alpha", type=float, default=0.55, help="opacity of bodies, 0 to 1; default 0.55")
    parser.add_argument("--look-from", type=_direction, metavar="X,Y,Z",
                        help="where the camera stands, seen from what it looks at; default 1,-1.5,0.75")
    parser.add_argument("--look-at", type=_place, metavar="X,Y,Z,R",
                        help="what fills the picture: the ball of this radius about this place, m; default: the whole run")
    parser.add_argument("--own-camera", action="store_true", help="camera and lights of the graphics; none are added")


def _add_how_it_is_rendered(parser) -> None:
    parser.add_argument("--size", type=_size, default=(1280, 720), metavar="WxH", help="pixels; default 1280x720")
    parser.add_argument("--engine", choices=("workbench", "eevee", "cycles", "scene"), default="workbench",
                        help="default workbench; `scene` takes engine, size and samples from the graphics")
    parser.add_argument("--no-caption", dest="caption", action="store_false",
                        help="leave time, largest force and scale of the arrows out of the pictures")
    parser.add_argument("--quick", action="store_true",
                        help="workbench without shadows and with edges smoothed after rendering: less time")
    parser.add_argument("--no-smoothing", dest="smooth", action="store_false",
                        help="workbench with edges as they are drawn; with --quick, a third of its time")
    parser.add_argument("--samples", type=int, default=8, help="of eevee and cycles; default 8")


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.partition("x")
    if not (width.isdigit() and height.isdigit() and int(width) >= 4 and int(height) >= 4):
        raise argparse.ArgumentTypeError(f"{text}: give width x height in pixels, such as 1280x720")
    return int(width), int(height)


def _direction(text: str) -> tuple[float, float, float]:
    try:
        x, y, z = (float(part) for part in text.split(","))
        if not 0.0 < math.hypot(x, y, z) < math.inf:
            raise ValueError
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text}: give a direction as X,Y,Z, such as 1,-1.5,0.75") from None
    return x, y, z


def _place(text: str) -> tuple[float, float, float, float]:
    try:
        x, y, z, radius = (float(part) for part in text.split(","))
        if not (radius > 0.0 and math.hypot(x, y, z, radius) < math.inf):
            raise ValueError
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text}: give a place and a radius as X,Y,Z,R, such as 0,0,1,0.5") from None
    return x, y, z, radius


def _pair(text: str) -> tuple[str, str]:
    body, _, name = text.partition("=")
    if not (body and name):
        raise argparse.ArgumentTypeError(f"{text}: give BODY=OBJECT")
    return body, name


def main(words=None, program: str = "pong_viz") -> int:
    try:
        given = arguments(words, program)
    except SystemExit as stop:
        return int(stop.code or 0)
    try:
        import bpy
    except ImportError as reason:
        print(f"pong_viz: Blender's module bpy is not there ({reason}); pip install bpy, or run it inside Blender",
              file=sys.stderr)
        return 1
    from .core.engine import WheelMissing
    from .log import Log, LogError
    from .render import RenderFault

    try:
        if given.remove is not None:
            return _take_out(bpy, given)
        _start(bpy, given)
        log = Log(given.log)
        made = _show(log, given)
        for note in made.notes:
            print(f"note: {note}", file=sys.stderr)
        _write(bpy.context.scene, log, made, given)
    except (LogError, RenderFault, WheelMissing, ValueError, OSError, RuntimeError) as fault:
        print(f"pong_viz: {fault}", file=sys.stderr)
        return 1
    return 0


def _take_out(bpy, given) -> int:
    from . import before

    _open(bpy, given.remove)
    shown = [scene for scene in bpy.data.scenes if before.is_shown(scene)]
    if not shown:
        raise ValueError(f"{given.remove}: none of its scenes shows a response")
    for scene in shown:
        before.remove(scene)
    bpy.ops.wm.save_as_mainfile(filepath=str(given.blend.resolve()))
    print(given.blend)
    return 0


def _open(bpy, path) -> None:
    if not path.is_file():
        raise OSError(f"{path}: there is no such file; name a .blend file")
    bpy.ops.wm.open_mainfile(filepath=str(path.resolve()), load_ui=False, use_scripts=False)


def _start(bpy, given) -> None:
    if given.graphics is None:
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    else:
        _open(bpy, given.graphics)
    if given.engine == "scene" or given.own_camera:
        if given.graphics is None:
            raise ValueError("--engine scene and --own-camera take what --graphics has; name that file too")
        if given.own_camera and bpy.context.scene.camera is None:
            raise ValueError(f"{given.graphics}: --own-camera, but its scene has no active camera; set one, or leave that out")


def _show(log, given):
    from . import before, camera
    from .render import Picture, prepare
    from .scene import Options, show
    import bpy

    before.note(bpy.context.scene)
    prepare(bpy.context.scene, Picture(*given.size, given.engine, given.samples, given.quick, given.smooth))
    return show(log, Options(
        fps=given.fps, speed=given.speed, start=given.start, end=given.end, relative_to=given.relative_to,
        arrow_length=given.arrow, mark_radius=given.mark, most_contacts=given.most_contacts, alpha=given.alpha,
        shapes=given.shapes, graphics=dict(given.map), camera=not given.own_camera, look_from=given.look_from or camera.DIRECTION,
        look_at=given.look_at,
    ))


def _write(scene, log, made, given) -> None:
    import bpy
    import numpy as np

    from . import render

    if given.blend:
        if given.engine != "scene":
            render.show_colors()
        bpy.ops.wm.save_as_mainfile(filepath=str(given.blend.resolve()))
        print(given.blend)
    if given.still:
        at = given.at if given.at is not None else most_loaded(log, made)
        picture = int(np.argmin(np.abs(made.film.times - at)))
        render.still(scene, given.still.resolve(), picture + 1, given.caption)
        print(f"{given.still} t = {made.film.times[picture]:.4f} s")
    if given.frames:
        print(render.frames(scene, given.frames.resolve(), given.caption))
    if given.output:
        print(render.movie(scene, given.output.resolve(), given.caption))


def most_loaded(log, made) -> float:
    """Time of the picture with the largest sum of normal forces."""
    sums = [float(log.contacts_of(int(row))["normal_force"].sum()) for row in made.film.rows]
    return float(made.film.times[sums.index(max(sums))])
