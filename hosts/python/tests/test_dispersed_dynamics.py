"""Dispersed masses, inertias, springs and gravity, compared with the expected motion."""

import math

import numpy as np
import pytest
from support import SCENE, scene_folder

import pong
from pong import campaign
from pong.campaign import _addresses, _case, _run

# The ball far above the ground on a spring along z and about x, 0.1 m below its rest and turned by 0.1 rad about x.
SPRUNG = SCENE.replace("position: (0.0, 0.0, 0.2)", "position: (0.0, 0.0, 4.9), orientation: (0.99875026, 0.04997917, 0, 0)").replace(
    "gravity: (0.0, 0.0, -9.81)",
    """gravity: (0.0, 0.0, 0.0),
    springs: [(first: Ground(position: (0, 0, 5)), second: On(body: "ball"), stiffness: (0, 0, 200, 0.8, 0, 0))]""",
)
MASS, INERTIA, STIFFNESS, TURNING = 1.0, 4e-3, 200.0, 0.8
TIME = 0.3


def values_of(simulation, **values):
    """Sets values in a simulation by their addresses, written with `_` for `.`."""
    names = [name.replace("__", ".") for name in values]
    _addresses.apply(simulation, {"parameters": names, "pivots": {}}, list(values.values()))


def motion(folder, **values):
    """Travel from rest and turning angle after TIME."""
    simulation = pong.Scene.load(scene_folder(folder, SPRUNG)).build()
    values_of(simulation, **values)
    state = simulation.run(every=100000).states[-1, 0]
    assert simulation.time == pytest.approx(TIME)
    return state[2] - 5.0, 2 * math.atan2(state[4], state[3])


def expected(mass=MASS, inertia=INERTIA, stiffness=STIFFNESS, turning=TURNING):
    """Two harmonic motions, each released at rest. The orientation of the scene has eight digits."""
    return -0.1 * math.cos(math.sqrt(stiffness / mass) * TIME), 0.1 * math.cos(math.sqrt(turning / inertia) * TIME)


@pytest.mark.parametrize(
    ("given", "changed"),
    [
        ({}, {}),
        ({"body__ball__mass": 2.0}, {"mass": 2.0}),
        ({"body__ball__inertia__xx": 6e-3}, {"inertia": 6e-3}),
        ({"body__ball__mass_factor": 1.5}, {"mass": 1.5, "inertia": 6e-3}),
        ({"body__ball__mass_factor": 1.5, "body__ball__mass": 2.0}, {"mass": 3.0, "inertia": 6e-3}),
        ({"spring__0__stiffness__z": 300.0}, {"stiffness": 300.0}),
        ({"spring__0__stiffness__rx": 0.5}, {"turning": 0.5}),
        ({"spring__0__stiffness_factor": 0.5}, {"stiffness": 100.0, "turning": 0.4}),
    ],
)
def test_a_sprung_ball_swings_at_the_frequencies_of_its_values(tmp_path, given, changed):
    np.testing.assert_allclose(motion(tmp_path, **given), expected(**changed), atol=2e-8)


def test_damping_and_preload_of_a_spring(tmp_path):
    """m = 1, c = 10, k = 200 about the rest position, which the preload moves by P/k: decay 5/s, ω_d = √175."""
    z, _ = motion(tmp_path, spring__0__damping__z=10.0, spring__0__preload__z=10.0)
    w, decay, rest = math.sqrt(175.0), math.exp(-5.0 * TIME), 0.05
    assert z == pytest.approx(rest + (-0.1 - rest) * decay * (math.cos(w * TIME) + 5.0 * math.sin(w * TIME) / w), abs=1e-8)


def test_gravity_replaces_that_of_the_scene(tmp_path):
    simulation = pong.Scene.load(scene_folder(tmp_path)).build()
    values_of(simulation, gravity__z=-1.62, gravity__x=0.5)
    assert simulation.gravity == (0.5, 0.0, -1.62)
    x, _, z = simulation.run(1000, every=1000).states[-1, 0, :3]
    assert (x, z) == (pytest.approx(0.5 * 0.5 * 0.01, rel=1e-10), pytest.approx(0.2 - 0.5 * 1.62 * 0.01, rel=1e-12))


def test_products_of_inertia_and_mass_centres_are_set_together(tmp_path):
    """A single moment would be refused: no body has 4e-3, 4e-3 and 9e-3."""
    simulation = pong.Scene.load(scene_folder(tmp_path)).build()
    state = simulation.states()
    values_of(
        simulation,
        body__ball__inertia__zz=9e-3,
        body__ball__inertia__xx=7e-3,
        body__ball__inertia__xy=1e-4,
        body__ball__mass_center__y=0.02,
    )
    told = simulation.mass("ball")
    assert told["inertia"] == [[7e-3, 1e-4, 0.0], [1e-4, 4e-3, 0.0], [0.0, 0.0, 9e-3]]
    assert (told["mass"], told["mass_center"]) == (1.0, [0.0, 0.02, 0.0])
    np.testing.assert_allclose(simulation.states(), state, atol=1e-15)
    # The mass centre falls freely; the ball, which does not turn, falls with it.
    assert simulation.run(500, every=500).states[-1, 0, 2] == pytest.approx(0.2 - 0.5 * 9.81 * 0.05**2, rel=1e-12)


def test_a_heavier_ball_presses_harder(tmp_path):
    """Dropped from the same height without damping, the peak force is slightly above √(2·g·h·m·k), because of the
    weight."""
    plan = campaign.Plan(
        scene=scene_folder(tmp_path, SCENE.replace("duration: 0.3", "duration: 0.17")),
        runs=1,
        dispersions=[
            campaign.Uniform("body.ball.mass", 1.0, 3.0),
            campaign.Uniform("surface.ball.rubber.normal.damping", 0.0, 1e-9),
        ],
    )
    for mass in (1.0, 2.5):
        row = _case.outcome(_run.checked(plan), 0, np.array([mass, 0.0]))
        weight = mass * 9.81
        # kx = W + √(W² + 2kWh): from the energy balance at the deepest point.
        assert row["peak_force.ball"] == pytest.approx(weight + math.sqrt(weight**2 + 2 * 2e4 * weight * 0.1), rel=2e-3)


@pytest.mark.parametrize(
    ("parameter", "words"),
    [
        ("body.bell.mass", ("no body `bell`", "ball, ground")),
        ("body.ball.weight", ("no such value", "mass, mass_factor, inertia.xx")),
        ("body.ball.inertia.yx", ("no such value", "inertia.xy")),
        ("body.mass", ("no such value",)),
        ("body.ground.mass", ("is not free",)),
        ("spring.1.stiffness.x", ("1 springs", "count from 0")),
        ("spring.first.stiffness.x", ("`first` is no spring", "from 0")),
        ("spring.0.stiffness.w", ("no such value", "stiffness.rx")),
        ("spring.0.length", ("no such value", "preload_factor")),
        ("gravity.w", ("no such value", "x, y, z")),
        ("gravity", ("gravity",)),
        ("wind.ball.x", ("nothing that can be dispersed", "body.BODY.mass", "spring.NUMBER.stiffness.x")),
    ],
)
def test_addresses_that_lead_nowhere_are_refused_before_the_first_run(tmp_path, parameter, words):
    plan = campaign.Plan(scene=scene_folder(tmp_path, SPRUNG), runs=1, dispersions=[campaign.Uniform(parameter, 1.0, 2.0)])
    with pytest.raises(pong.PongError) as caught:
        _run.checked(plan)
    for word in words:
        assert word in str(caught.value), str(caught.value)


def test_values_that_nothing_can_have_are_refused_and_change_nothing(tmp_path):
    simulation = pong.Scene.load(scene_folder(tmp_path, SPRUNG)).build()
    mass, spring = simulation.mass("ball"), simulation.spring(0)
    for values, word in (
        (mass | {"mass": -1.0}, "the mass is -1"),
        (mass | {"inertia": [[1, 0, 0], [0, 1, 0], [0, 0, 3]]}, "belong to no body"),
        (mass | {"inertia": [1, 1, 1]}, "inertia: got .1, 1, 1., which is of type list; give one of shape"),
        (mass | {"weight": 3.0}, "no value `weight`"),
        ({"mass": 3.0}, "`inertia` is missing"),
    ):
        with pytest.raises(pong.PongError, match=word):
            simulation.set_mass("ball", values)
    for number, values, word in (
        (0, spring | {"stiffness": [-1.0] * 6}, "stiffness is below zero"),
        (0, spring | {"stiffness": [1.0] * 5}, "spring: stiffness: got .*; give 6 numbers"),
        (0, spring | {"rest": 1.0}, "no value `rest`"),
        (1, spring, "no spring 1"),
    ):
        with pytest.raises(pong.PongError, match=word):
            simulation.set_spring(number, values)
    with pytest.raises(pong.PongError, match="no body `bell`"):
        simulation.mass("bell")
    assert (simulation.mass("ball"), simulation.spring(0)) == (mass, spring)
    without = pong.Scene.load(scene_folder(tmp_path)).build()
    with pytest.raises(pong.PongError, match="the scene has none"):
        without.spring(0)
