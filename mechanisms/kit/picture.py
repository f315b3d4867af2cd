"""Offscreen pictures of a machine, with its contacts and their forces."""

import struct
import zlib

import mujoco

WIDTH, HEIGHT = 960, 540


def take(machine, path, lookat, distance, azimuth, elevation, force_scale=2e-4):
    """Writes a PNG file."""
    option, camera = mujoco.MjvOption(), mujoco.MjvCamera()
    for flag in (mujoco.mjtVisFlag.mjVIS_CONTACTPOINT, mujoco.mjtVisFlag.mjVIS_CONTACTFORCE):
        option.flags[flag] = 1
    machine.model.vis.map.force = force_scale
    camera.lookat[:] = lookat
    camera.distance, camera.azimuth, camera.elevation = distance, azimuth, elevation
    with mujoco.Renderer(machine.model, HEIGHT, WIDTH) as renderer:
        renderer.update_scene(machine.data, camera, option)
        _write_png(path, renderer.render())


def _write_png(path, pixels):
    """Colour as eight-bit red, green and blue."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    header = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, 2, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
    )
