"""Intervals of loads in three parts, and the inputs that matter, for a docking and a berthing (docs/sensitivity.md).

    python hosts/python/examples/load_intervals.py docking OUT [--runs 93] [--pairs 10] [--workers 2]
    python hosts/python/examples/load_intervals.py berthing OUT
    python hosts/python/examples/load_intervals.py docking OUT --morris 20        elementary effects
    python hosts/python/examples/load_intervals.py docking OUT --sobol 128        indices of Sobol

Prints tables for a page. A second call does what is left.
"""

import argparse
import math
import pathlib

from pong import campaign

MODELS = pathlib.Path(__file__).resolve().parents[3] / "models"
DEGREE = math.radians(1.0)


def docking():
    """Approaches within the limits of the International Docking System Standard; the scene begins 50 mm aside, pitched by
    1° and rolled by 2°."""
    return {
        "scene": MODELS / "idss_docking/scene_soft_capture.ron",
        "quantity": "peak_force.target",
        "seed": 1,
        "integrator": "SemiImplicitEuler",
        "step": 1e-3,
        "pivots": {"chaser": (0.0, 0.0, 0.3)},
        "dispersions": [
            campaign.Uniform("chaser.position.x", -0.12, 0.02),
            campaign.Uniform("chaser.position.y", -0.07, 0.07),
            campaign.Uniform("chaser.rotation.x", -3.8 * DEGREE, 1.8 * DEGREE),
            campaign.Uniform("chaser.rotation.y", -2.8 * DEGREE, 2.8 * DEGREE),
            campaign.Uniform("chaser.rotation.z", -6.0 * DEGREE, 2.0 * DEGREE),
            campaign.Uniform("chaser.velocity.z", -0.05, 0.0),
            campaign.Uniform("surface.idss_active.structure.friction.mu", 0.1, 0.3),
        ],
        "force": 500.0,
    }


def berthing():
    """A module that comes a little elsewhere than planned, with other masses, friction and stiffness of the arm."""
    return {
        "scene": MODELS / "common_berthing/scene_berthing.ron",
        "quantity": "peak_force.passive",
        "seed": 1,
        # A fourth of the evaluations of the scene's Runge-Kutta.
        "integrator": "ZeroOrderHold",
        "dispersions": [
            campaign.Uniform("passive.position.x", -0.01, 0.01),
            campaign.Uniform("passive.position.y", -0.01, 0.01),
            campaign.Uniform("passive.rotation.z", -0.3 * DEGREE, 0.3 * DEGREE),
            campaign.Normal("body.passive.mass_factor", 1.0, 0.03),
            campaign.Uniform("spring.4.stiffness_factor", 0.8, 1.2),
            campaign.Uniform("surface.active.guide.friction.mu", 0.1, 0.3),
            campaign.Uniform("surface.active.latch.friction.mu", 0.1, 0.3),
        ],
        "force": 500.0,
    }


def alternatives(force):
    return [
        campaign.OtherLaws("hunt_crossley", force=force, damping_exponent=1.0),
        campaign.OtherLaws("hertz", force=force, exponent=1.5, damping_exponent=1.5),
        campaign.OtherLaws("coulomb", friction="Coulomb", slip_speed=1e-3),
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", choices=["docking", "berthing"])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=93)
    parser.add_argument("--pairs", type=int, default=10)
    parser.add_argument("--morris", type=int, help="trajectories")
    parser.add_argument("--sobol", type=int, help="base points, a power of two")
    parser.add_argument("--duration", type=float, help="of a run, s; that of the scene without it")
    parser.add_argument("--workers", type=int)
    arguments = parser.parse_args()
    study = {"docking": docking, "berthing": berthing}[arguments.study]()
    study["duration"] = arguments.duration
    force, quantity = study.pop("force"), study.pop("quantity")
    hands = {"workers": arguments.workers, "runs_per_task": 1}
    if arguments.morris or arguments.sobol:
        method = "morris" if arguments.morris else "sobol"
        plan = campaign.Plan(method=method, samples=arguments.morris or arguments.sobol, **study)
        campaign.run(plan, arguments.folder / method, **hands)
        print(campaign.indices(arguments.folder / method, quantities=[quantity]))
        return
    plan = campaign.Plan(runs=arguments.runs, **study)
    options = {"alternatives": alternatives(force), "pairs": arguments.pairs, **hands}
    found = campaign.interval(plan, quantity, arguments.folder, **options)
    print(found, found.markdown("N"), sep="\n\n")


if __name__ == "__main__":
    main()
