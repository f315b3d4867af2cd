"""Opens MuJoCo's viewer with the plugin loaded: python -m pong_mujoco FILE.xml"""

import sys

import mujoco.viewer

if len(sys.argv) != 2:
    sys.exit(__doc__)
mujoco.viewer.launch_from_path(sys.argv[1])
