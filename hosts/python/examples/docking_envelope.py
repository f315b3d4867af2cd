"""Capture envelope of the docking interfaces: offsets from which the latches hold.

    python hosts/python/examples/docking_envelope.py OUT [--runs 10000] [--workers 2] [--scheduler ADDRESS] [--reference]

Writes the campaign into OUT, and pictures beside its tables. A second call does what is left. With `--reference` the same
approaches are computed with the scene's own integrator and step.
"""

import argparse
import math
import pathlib

import numpy as np

from pong import campaign
from pong.campaign import plots

SCENE = pathlib.Path(__file__).resolve().parents[3] / "models/idss_docking/scene_soft_capture.ron"
DEGREE = math.radians(1.0)

# Start of the scene itself: 50 mm aside, pitched by 1° and rolled by 2°.
ASIDE, PITCHED, ROLLED = 0.05, 1.0, 2.0
LATERAL, TILT = 0.20, 8.0


def plan(runs, duration=16.0, reference=False):
    """Approaches at 0.04 to 0.10 m/s up to twice as far off as the International Docking System Standard allows (0.10 m and
    4° on each axis), so that the border of the envelope is inside.

    The first `n` approaches are the same for every number of runs: the study of the step compares them one by one."""
    # Six times as fast as the scene's integrator and step; the effect is measured in docs/campaigns.md.
    training = {"integrator": "SemiImplicitEuler", "step": 1e-3}
    stops = [
        campaign.Held("held", "captured", 1.0),
        # At the start the ring is at most 0.5 m away: farther away and receding, it has bounced off or passed by.
        campaign.Beyond("parted", "chaser/ring", "target", 0.55),
    ]
    return campaign.Plan(
        scene=SCENE,
        runs=runs,
        seed=1,
        method="random",
        dispersions=[
            campaign.Uniform("chaser.position.x", -ASIDE - LATERAL, -ASIDE + LATERAL),
            campaign.Uniform("chaser.position.y", -LATERAL, LATERAL),
            # Far enough back that no approach begins in contact; four of the 128 corners would.
            campaign.Uniform("chaser.position.z", -0.26, -0.24),
            campaign.Uniform("chaser.rotation.x", (-PITCHED - TILT) * DEGREE, (-PITCHED + TILT) * DEGREE),
            campaign.Uniform("chaser.rotation.y", -TILT * DEGREE, TILT * DEGREE),
            campaign.Uniform("chaser.rotation.z", (-ROLLED - TILT) * DEGREE, (-ROLLED + TILT) * DEGREE),
            # The scene closes at 0.1 m/s.
            campaign.Uniform("chaser.velocity.z", -0.06, 0.0),
        ],
        pivots={"chaser": (0.0, 0.0, 0.3)},
        # The ring's face on the target's, within 20 mm, and at rest against it.
        criteria=[
            campaign.Within(
                "captured", "chaser/ring", "target", low=(-0.02, -0.02, -0.02), high=(0.02, 0.02, 0.02), speed=0.02
            )
        ],
        duration=duration,
        stops=stops,
        **({} if reference else training),
    )


def offsets(table):
    """Lateral offset from the axis (m), tilt and roll of the ring (°) of each approach."""
    column = {name: table[name].to_numpy() for name in table.column_names if name.startswith("chaser.")}
    lateral = np.hypot(column["chaser.position.x"] + ASIDE, column["chaser.position.y"])
    tilt = np.hypot(column["chaser.rotation.x"] / DEGREE + PITCHED, column["chaser.rotation.y"] / DEGREE)
    return lateral, tilt, np.abs(column["chaser.rotation.z"] / DEGREE + ROLLED)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=10_000)
    parser.add_argument("--workers", type=int)
    parser.add_argument("--scheduler")
    parser.add_argument("--reference", action="store_true")
    arguments = parser.parse_args()
    folder = arguments.folder
    wanted = plan(arguments.runs, reference=arguments.reference)
    table = campaign.run(wanted, folder, workers=arguments.workers, scheduler=arguments.scheduler, runs_per_task=10)
    print(campaign.summary(folder, quantities=["peak_force.target", "peak_moment.target", "time_at_end"]))
    lateral, tilt, roll = offsets(table)
    inside = (lateral <= 0.10) & (tilt <= 4.0) & (roll <= 4.0)
    met = table["captured"].to_numpy(zero_copy_only=False)[inside]
    if len(met):
        low, high = campaign.wilson(int(met.sum()), len(met))
        print(f"inside the standard's limits: {met.sum()} of {len(met)} captured, between {low:.4f} and {high:.4f}")
    plots.distribution(folder, "peak_force.target").savefig(folder / "peak_force.svg")
    plots.share(folder, ("lateral offset, m", lateral), "captured").savefig(folder / "share.svg")
    plots.envelope(folder, "chaser.position.x", "chaser.position.y", "captured").savefig(folder / "envelope.png", dpi=110)


if __name__ == "__main__":
    main()
