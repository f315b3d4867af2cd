"""The capture envelope of the docking interfaces: from which offsets do the latches hold?

    python hosts/python/examples/docking_envelope.py OUT [--runs 10000] [--workers 2] [--scheduler ADDRESS]

Writes the campaign into OUT and two pictures beside its tables. A second call does what is left.
"""

import argparse
import math
import pathlib

from pong import campaign
from pong.campaign import plots

SCENE = pathlib.Path(__file__).resolve().parents[3] / "models/idss_docking/scene_soft_capture.ron"


def plan(runs, duration=None):
    """Approaches up to 0.1 m and 4° off, at 0.05 to 0.15 m/s: what the International Docking System Standard allows."""
    degrees = math.radians(1.0)
    return campaign.Plan(
        scene=SCENE,
        runs=runs,
        seed=1,
        method="latin_hypercube",
        dispersions=[
            # The scene itself starts 50 mm aside.
            campaign.Uniform("chaser.position.x", -0.15, 0.05),
            campaign.Uniform("chaser.position.y", -0.10, 0.10),
            campaign.Uniform("chaser.rotation.x", -4 * degrees, 4 * degrees),
            campaign.Uniform("chaser.rotation.y", -4 * degrees, 4 * degrees),
            campaign.Uniform("chaser.rotation.z", -4 * degrees, 4 * degrees),
            campaign.Uniform("chaser.velocity.z", -0.05, 0.05),
        ],
        pivots={"chaser": (0.0, 0.0, 0.3)},
        # The ring's face on the target's, within 20 mm, and at rest against it.
        criteria=[
            campaign.Within(
                "captured", "chaser/ring", "target", low=(-0.02, -0.02, -0.02), high=(0.02, 0.02, 0.02), speed=0.02
            )
        ],
        duration=duration,
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=10_000)
    parser.add_argument("--workers", type=int)
    parser.add_argument("--scheduler")
    arguments = parser.parse_args()
    campaign.run(plan(arguments.runs), arguments.folder, workers=arguments.workers, scheduler=arguments.scheduler)
    print(campaign.summary(arguments.folder, quantities=["peak_force.target", "peak_moment.target"]))
    plots.distribution(arguments.folder, "peak_force.target").savefig(arguments.folder / "peak_force.svg")
    plots.envelope(arguments.folder, "chaser.position.x", "chaser.position.y", "captured").savefig(arguments.folder / "envelope.svg")


if __name__ == "__main__":
    main()
