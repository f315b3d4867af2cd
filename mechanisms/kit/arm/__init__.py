"""A manipulator of seven joints in the layout of the space station's arm, with force-moment accommodation.

    from kit.arm import Arm, Law, body

`body` gives its MJCF, `Arm` its controller. mechanisms/arm/README.md describes and checks it.
"""

from .body import body
from .control import Arm, Law

__all__ = ["Arm", "Law", "body"]
