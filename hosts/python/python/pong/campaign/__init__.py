"""Campaigns: one scene, run thousands of times with dispersed starts and surfaces (docs/campaigns.md).

    from pong import campaign

    plan = campaign.Plan(
        scene="scene.ron",
        runs=1000,
        seed=1,
        dispersions=[campaign.Uniform("chaser.position.x", -0.1, 0.1), campaign.Normal("chaser.velocity.z", 0.0, 0.01)],
        criteria=[campaign.Within("captured", "chaser/ring", "target", low=(-0.02, -0.02, -0.02), high=(0.02, 0.02, 0.02))],
    )
    campaign.run(plan, "results", workers=2)
    print(campaign.summary("results"))
"""

from ._alternatives import OtherLaws, OtherModels, OtherScene
from ._criteria import Within
from ._dispersions import Normal, Uniform
from ._errors import CampaignError
from ._interval import Interval, Part, Variant, interval, three_parts, tolerance
from ._plan import Plan
from ._run import repeat, run
from ._sensitivity import MorrisIndex, Sensitivity, SobolIndex, design, indices, indices_of
from ._stops import Beyond, Held
from ._store import failures, results
from ._summary import Proportion, Quantile, Summary, quantile_interval, summary, wilson

__all__ = [
    "Beyond",
    "CampaignError",
    "Held",
    "Interval",
    "MorrisIndex",
    "Normal",
    "OtherLaws",
    "OtherModels",
    "OtherScene",
    "Part",
    "Plan",
    "Proportion",
    "Quantile",
    "Sensitivity",
    "SobolIndex",
    "Summary",
    "Uniform",
    "Variant",
    "Within",
    "design",
    "failures",
    "indices",
    "indices_of",
    "interval",
    "quantile_interval",
    "repeat",
    "results",
    "run",
    "summary",
    "three_parts",
    "tolerance",
    "wilson",
]
