# SPDX-License-Identifier: GPL-3.0-or-later
"""python -m pong_viz LOG -o film.mp4: a response log as film, pictures or .blend, without a window."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path


def arguments(words) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="pong_viz",
        description="Plays a response log back: bodies in motion, contacts marked (green: sticks, red: slips), forces as "
                    "arrows on the first object of each pair.",
    )
    parser.add_argument("log", type=Path, help="folder that `pong run --log` or a host wrote")
    parser.add_argument("-o", "--output", type=Path, help="film, .mp4")
    parser.add_argument("--frames", type=Path, metavar="DIR", help="every picture as PNG")
    parser.add_argument("--still", type=Path, metavar="PNG", help="one picture; at --at, else at the largest force")
    parser.add_argument("--at", type=float, metavar="S", help="time of the still, s in the log")
    parser.add_argument("--blend", type=Path, metavar="FILE", help="the animated scene as .blend")
    parser.add_argument("--graphics", type=Path, metavar="FILE", help=".blend with the author's own graphics, which move")
    parser.add_argument("--map", action="append", default=[], metavar="BODY=OBJECT",
                        help="which object of the graphics a body moves; else those with the property `pong_body`")
    parser.add_argument("--shapes", choices=("all", "missing", "none"), default="missing",
                        help="draw the models' primitives: of all bodies, of those without graphics (default), of none")
    parser.add_argument("--fps", type=int, default=30)
    parser.add_argument("--speed", type=float, default=1.0, help="0.1 is ten times slower than life; default 1")
    parser.add_argument("--from", dest="start", type=float, metavar="S")
    parser.add_argument("--to", dest="end", type=float, metavar="S")
    parser.add_argument("--relative-to", default="", metavar="BODY", help="hold this body still")
    parser.add_argument("--arrow", type=float, default=0.0, metavar="M", help="length of the largest force, m")
    parser.add_argument("--most-contacts", type=int, default=64, metavar="N", help="shown at once; default 64")
    parser.add_argument("--alpha", type=float, default=0.55, help="opacity of bodies, 0 to 1; default 0.55")
    parser.add_argument("--size", default="1280x720", metavar="WxH")
    parser.add_argument("--engine", choices=("workbench", "eevee", "cycles"), default="workbench")
    parser.add_argument("--samples", type=int, default=8)
    read = parser.parse_args(words)
    if not (read.output or read.frames or read.still or read.blend):
        parser.error("nothing to make: give -o, --frames, --still or --blend")
    if read.fps < 1 or not read.speed > 0.0:
        parser.error("--fps and --speed must be above zero")
    return read


def main(words=None) -> int:
    given = arguments(words)
    try:
        import bpy
    except ImportError as reason:
        print(f"pong_viz: Blender's module bpy is not there ({reason}); pip install bpy, or run it inside Blender",
              file=sys.stderr)
        return 1
    from .log import Log, LogError

    try:
        _start(bpy, given)
        log = Log(given.log)
        made = _show(log, given)
    except (LogError, ValueError, OSError, RuntimeError) as fault:
        print(f"pong_viz: {fault}", file=sys.stderr)
        return 1
    for note in made.notes:
        print(f"note: {note}", file=sys.stderr)
    _write(bpy.context.scene, log, made, given)
    return 0


def _start(bpy, given) -> None:
    if given.graphics is None:
        bpy.ops.wm.read_factory_settings(use_empty=True)
    elif not given.graphics.is_file():
        raise OSError(f"{given.graphics}: there is no such file; name the .blend with the graphics")
    else:
        bpy.ops.wm.open_mainfile(filepath=str(given.graphics))


def _show(log, given):
    from .render import Picture, prepare
    from .scene import Options, show
    import bpy

    width, _, height = given.size.partition("x")
    if not (width.isdigit() and height.isdigit()):
        raise ValueError(f"--size {given.size}: give width x height in pixels, such as 1280x720")
    pairs = [item.partition("=") for item in given.map]
    wrong = [body for body, sign, name in pairs if not (sign and name)]
    if wrong:
        raise ValueError(f"--map {wrong[0]}: give BODY=OBJECT")
    prepare(bpy.context.scene, Picture(int(width), int(height), given.engine, given.samples))
    return show(log, Options(
        fps=given.fps, speed=given.speed, start=given.start, end=given.end, relative_to=given.relative_to,
        arrow_length=given.arrow, most_contacts=given.most_contacts, alpha=given.alpha, shapes=given.shapes,
        graphics={body: name for body, _, name in pairs},
    ))


def _write(scene, log, made, given) -> None:
    import numpy as np

    from . import render

    if given.blend:
        import bpy

        bpy.ops.wm.save_as_mainfile(filepath=str(given.blend.resolve()))
        print(given.blend)
    if given.still:
        at = given.at if given.at is not None else _most_loaded(log, made)
        picture = int(np.argmin(np.abs(made.film.times - at)))
        print(render.still(scene, given.still.resolve(), picture + 1), f"t = {made.film.times[picture]:.4f} s")
    if given.frames:
        render.frames(scene, given.frames.resolve())
        print(given.frames)
    if given.output:
        print(render.movie(scene, given.output.resolve()))


def _most_loaded(log, made) -> float:
    """The time of the picture with the largest sum of normal forces."""
    sums = [float(log.contacts_of(int(row))["normal_force"].sum()) for row in made.film.rows]
    return float(made.film.times[sums.index(max(sums))])


if __name__ == "__main__":
    sys.exit(main())
