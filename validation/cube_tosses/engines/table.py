"""Engines of this study by name."""

from validation.cube_tosses.engines import with_bullet, with_drake, with_mujoco, with_pong

CLASSES = (
    with_pong.Linear,
    with_pong.LinearCoulomb,
    with_pong.HuntCrossley,
    with_pong.Hertz,
    with_pong.Power,
    with_mujoco.Mujoco,
    with_mujoco.MujocoPyramidal,
    with_drake.Drake,
    with_drake.DrakeSap,
    with_drake.DrakeTamsi,
    with_bullet.Bullet,
    with_bullet.BulletAsPublished,
)
ENGINES = {engine.name: engine for engine in CLASSES}


def make(name):
    """Engine of a name."""
    if name not in ENGINES:
        raise ValueError(f"{name}: there is no such engine; there are {', '.join(ENGINES)}")
    return ENGINES[name]()
