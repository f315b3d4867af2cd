# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of scenes through pong_viz, from a given viewpoint: used by the picture.py of models.

A picture.py runs as

    python picture.py PONG [-o PNG]

with Blender as a Python module and PONG the program; it writes picture.png beside itself unless told otherwise.
"""

import argparse
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "blender"))

STEP = 5  # between the colours of a picture, of 255


def main(folder, scene, at_s, eye, target, lens_mm=50.0, size=(800, 450), arrow_m=0.3, alpha=0.9):
    """Runs a scene of the folder and takes the picture of one instant, seen from `eye` towards `target`, m."""
    parser = argparse.ArgumentParser(description=f"Takes a picture of {scene} with Blender.")
    parser.add_argument("pong", help="the program `pong`")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=folder / "picture.png")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as log:
        subprocess.run([given.pong, "run", "--quiet", "--log", log, str(folder / scene)], check=True)
        take(log, given.output, at_s, eye, target, lens_mm, size, arrow_m, alpha)
    leave()


def take(log, output, at_s, eye, target, lens_mm=50.0, size=(800, 450), arrow_m=0.3, alpha=0.9):
    """Takes the picture of an existing response log."""
    _show(log, at_s, size, arrow_m, alpha)
    _look(eye, target, lens_mm)
    _shoot(output.resolve())
    print(f"{output}: {output.stat().st_size / 1e3:.0f} kB")


def animate(log, output, start_s, end_s, eye, travel, target, lens_mm, size, fps, speed, arrow_m=0.3):
    """Writes an animated picture (WebP, with Pillow) of a response log that repeats without end.

    The camera and what it looks at move by `travel`, m, from the first to the last picture. `speed` 0.5 is half as
    fast as life.
    """
    import bpy
    from mathutils import Vector
    from PIL import Image
    from pong_viz.render import still

    count = len(_show(log, start_s, size, arrow_m, 1.0, end_s, fps, speed).film.times)
    scene = bpy.context.scene
    scene.render.dither_intensity = 0.0
    pictures = []
    with tempfile.TemporaryDirectory() as folder:
        for number in range(1, count + 1):
            shift = Vector(travel) * ((number - 1) / max(count - 1, 1))
            _look(Vector(eye) + shift, Vector(target) + shift, lens_mm)
            path = pathlib.Path(folder) / f"{number}.png"
            still(scene, path, number, caption=False)
            pictures.append(Image.open(path).convert("RGB"))
    pictures[0].save(
        output, save_all=True, append_images=pictures[1:], duration=round(1000 / fps), loop=0, quality=72, method=6
    )
    print(f"{output}: {len(pictures)} pictures, {output.stat().st_size / 1e3:.0f} kB")


def leave():
    """Skips Blender's own exit, which may crash or hang in a module."""
    sys.stdout.flush()
    os._exit(0)


def _show(log, at_s, size, arrow_m, alpha, end_s=None, fps=30, speed=1.0):
    import bpy
    from pong_viz.log import Log
    from pong_viz.render import Picture, prepare
    from pong_viz.scene import Options, show

    bpy.ops.wm.read_factory_settings(use_empty=True)
    prepare(bpy.context.scene, Picture(*size))
    end_s = at_s + 0.1 if end_s is None else end_s
    options = Options(
        fps=fps, speed=speed, start=at_s, end=end_s, arrow_length=arrow_m, alpha=alpha, shapes="all"
    )
    return show(Log(pathlib.Path(log)), options)


def _look(eye, target, lens_mm):
    import bpy
    from mathutils import Vector

    camera = bpy.context.scene.camera
    way = Vector(eye) - Vector(target)
    camera.location = eye
    camera.rotation_quaternion = way.to_track_quat("Z", "Y")
    camera.data.lens, camera.data.clip_start, camera.data.clip_end = lens_mm, 0.01 * way.length, 100.0 * way.length


def _shoot(path):
    import bpy
    from pong_viz.render import still

    scene = bpy.context.scene
    scene.render.dither_intensity = 0.0  # noise does not compress
    scene.render.image_settings.compression = 100
    still(scene, path, 1, caption=False)
    _slim(path)


def _slim(path):
    """Rewrites a picture with quantised colours: a third of the size, without a visible difference."""
    import bpy
    import numpy as np

    image = bpy.data.images.load(str(path))
    wide, tall = image.size
    pixels = np.array(image.pixels[:]).reshape(tall, wide, image.channels)[::-1, :, :3]
    colours = np.clip(np.round(pixels * 255 / STEP) * STEP, 0, 255).astype(np.uint8)
    lines = b"".join(b"\0" + line.tobytes() for line in colours)
    head = struct.pack(">IIBBBBB", wide, tall, 8, 2, 0, 0, 0)
    chunks = [(b"IHDR", head), (b"IDAT", zlib.compress(lines, 9)), (b"IEND", b"")]
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, body in chunks:
            file.write(struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)))
