#!/usr/bin/env python3
"""Takes picture.png: the rover in its traverse. Runs as models/pictures.py says."""

import argparse
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import pictures  # noqa: E402

AT = 4.5  # s
TARGET = (2.9, 0.2, 0.15)
EYE = (6.4, -4.0, 2.3)
STEP = 5  # between colours, of 255
MARKS = 0.12  # of their usual size, which goes by the whole terrain


def finish():
    import bpy

    for thing in bpy.data.objects:
        if thing.name.startswith("contact "):
            thing.delta_scale = (MARKS, MARKS, MARKS)
    bpy.context.scene.render.image_settings.color_mode = "RGB"


def slim(path):
    """Writes a picture again with colours in steps: a third of the size, and no difference to the eye."""
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


def main():
    parser = argparse.ArgumentParser(description="Takes a picture of the traverse with Blender.")
    parser.add_argument("pong", help="the program `pong`")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=HERE / "picture.png")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as log:
        subprocess.run([given.pong, "run", "--quiet", "--log", log, str(HERE / "scene_traverse.ron")], check=True)
        pictures._show(log, AT, (640, 340), 0.7, 1.0)
        finish()
        pictures._look(EYE, TARGET, 45.0)
        pictures._shoot(given.output.resolve())
        slim(given.output.resolve())
    print(f"{given.output}: {given.output.stat().st_size / 1e3:.0f} kB")
    sys.stdout.flush()
    os._exit(0)  # Blender as a module may crash or hang in its own exit


if __name__ == "__main__":
    main()
