"""The wheel contains binaries, but no module that depends on the version of Python: py3-none-PLATFORM."""

import os

from setuptools import Distribution, setup
from setuptools.command.bdist_wheel import bdist_wheel


class WithBinaries(Distribution):
    def has_ext_modules(self):
        return True


class PlatformWheel(bdist_wheel):
    def get_tag(self):
        return "py3", "none", os.environ.get("PLATFORM") or super().get_tag()[2]


setup(
    version=os.environ["PONG_VERSION"],
    install_requires=[f"mujoco=={os.environ['MUJOCO_VERSION']}"],
    distclass=WithBinaries,
    cmdclass={"bdist_wheel": PlatformWheel},
)
