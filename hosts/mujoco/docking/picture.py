"""Draws docs/figures/mujoco_docking.png without a screen: the docking in MuJoCo when the rings have met.

    MUJOCO_GL=egl python3 picture.py PLUGIN        from the root of the repository; PLUGIN is libpong_contact.so
"""

import pathlib
import struct
import sys
import zlib

import mujoco

HERE = pathlib.Path(__file__).resolve().parent
WIDTH, HEIGHT = 960, 540


def write_png(path, pixels):
    """Colour as eight-bit red, green and blue."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    header = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def main():
    mujoco.mj_loadPluginLibrary(sys.argv[1])
    m = mujoco.MjModel.from_xml_path(str(HERE / "docking.xml"))
    d = mujoco.MjData(m)
    mujoco.mj_resetDataKeyframe(m, d, 0)
    mujoco.mj_step(m, d, round(2.4 / m.opt.timestep))
    option, camera = mujoco.MjvOption(), mujoco.MjvCamera()
    for flag in (mujoco.mjtVisFlag.mjVIS_CONTACTPOINT, mujoco.mjtVisFlag.mjVIS_CONTACTFORCE, mujoco.mjtVisFlag.mjVIS_TRANSPARENT):
        option.flags[flag] = 1
    camera.lookat[:] = 0, 0, -0.1
    camera.distance, camera.azimuth, camera.elevation = 1.9, 130, -25
    with mujoco.Renderer(m, HEIGHT, WIDTH) as renderer:
        renderer.update_scene(d, camera, option)
        write_png(HERE.parents[2] / "docs/figures/mujoco_docking.png", renderer.render())


main()
