"""Errors are exceptions of their families, with thing, cause and cure, and leave nothing half done."""

import signal
import threading

import numpy as np
import pytest
from support import BALL, builder, scene_folder, touching, world

import pong


def told(family, call, *words):
    with pytest.raises(family) as caught:
        call()
    assert type(caught.value) is family and isinstance(caught.value, pong.PongError)
    text = str(caught.value)
    for word in words:
        assert word in text, f"{word!r} is not in {text!r}"
    return caught.value


def test_every_fault_of_a_model_is_listed():
    broken = BALL.replace("radius: 0.1", "radius: -0.1").replace("mu: 0.6", "mu: -1")
    error = told(pong.ModelError, lambda: pong.Model.parse(broken, name="broken.ron"), "broken.ron:3", "broken.ron:5")
    assert len(error.errors) == 2
    assert set(error.errors[0]) == {"file", "line", "column", "path", "rule", "cause", "cure"}
    told(pong.ModelError, lambda: pong.Model.load("nowhere.ron"), "nowhere.ron", "name a model file")
    told(pong.ModelError, lambda: builder().add_model("nowhere.ron"), "nowhere.ron")


def test_names_and_ids_that_lead_nowhere():
    w, other = world(), world()
    told(pong.NotFoundError, lambda: w.interface("bell"), "bell", "known: ball, ground")
    told(pong.NotFoundError, lambda: w.interface("ball", "arm"), "arm")
    told(pong.NotFoundError, lambda: w.set_states(touching(0), interfaces=other.interfaces), "another world")
    told(pong.NotFoundError, lambda: builder().pair("ball", "sky"), "sky")


def test_arguments_of_another_kind(tmp_path):
    told(pong.BadValueError, lambda: pong.WorldBuilder(workers=-1), "workers: -1", "or 0")
    scene = pong.Scene.load(scene_folder(tmp_path))
    told(pong.BadValueError, lambda: scene.build(workers=-2), "workers: -2", "or 0")
    told(pong.BadValueError, lambda: builder().create_object("ball", "ball"), "'ball'", "add_model")
    told(pong.BadValueError, lambda: builder().add_model(None), "model: got None", "path of a model file")
    told(pong.BadValueError, lambda: builder().pair(0, "ground"), "object: got 0", "or its name")
    told(pong.BadValueError, lambda: pong.tune(3), "runs: got 3", "list of them")


def test_a_delay_that_would_be_ignored():
    told(pong.BadValueError, lambda: pong.WorldBuilder(delay_frames=3), "delay_frames: it is 3", "zero_order_hold")
    told(pong.BadValueError, lambda: pong.WorldBuilder(accounts="stages", delay_frames=3), "delay_frames", "never comes late")
    pong.WorldBuilder(accounts="zero_order_hold", delay_frames=3)


def test_the_same_body_twice(tmp_path):
    w = world()
    ball, ground = w.interfaces
    w.set_states(touching(1e-3))
    twice = touching(1e-3)
    twice[1] = twice[0]
    told(pong.BadValueError, lambda: w.set_states(twice, interfaces=[ball, ball]), "`ball/ball` is given twice", "once")
    assert np.array_equal(w.states(), touching(1e-3))
    simulation = pong.Scene.load(scene_folder(tmp_path)).build()
    told(pong.BadValueError, lambda: simulation.set_states(twice, ["ball", "ball"]), "`ball` is given twice")
    told(pong.BadValueError, lambda: pong.Scene.load(tmp_path / "drop.ron").build(delay_frames=2), "delay_frames", "ZeroOrderHold")


def test_a_name_given_twice():
    made = builder()
    model = made.add_model(pong.Model.parse(BALL))
    told(pong.DuplicateError, lambda: made.create_object(model, "ball"), "object `ball`", "another name")
    told(pong.DuplicateError, lambda: made.pair("ground", "ball"), "pair")


def test_calls_at_the_wrong_time():
    made = builder()
    w = made.seal()
    told(pong.PhaseError, made.seal, "sealed", "another builder")
    told(pong.PhaseError, lambda: made.pair("ball", "ground"), "sealed")
    told(pong.PhaseError, w.wrenches, "evaluate or step")
    told(pong.PhaseError, w.stop_log, "start_log")


def test_states_that_are_refused_change_nothing():
    w = world()
    told(pong.StateError, w.step, "ball/ball", "never set")
    good = touching(1e-3)
    w.set_states(good)
    for column, value, word in ((0, np.nan, "NaN"), (9, np.inf, "inf"), (3, 2.0, "norm"), (1, 1e200, "1e200")):
        bad = good.copy()
        bad[1, column] = value
        bad[0, 2] = 7.0
        told(pong.StateError, lambda: w.set_states(bad), "ground/ground", word)
        assert np.array_equal(w.states(), good)


def test_arrays_of_another_shape():
    w = world()
    told(pong.BadValueError, lambda: w.set_states(np.zeros((2, 12))), "(2, 12)", "give one of shape (2, 13)")
    told(pong.BadValueError, lambda: w.set_states(np.zeros((3, 13))), "(3, 13)")
    told(pong.BadValueError, w.set_states, "states", "position")
    told(pong.BadValueError, lambda: w.set_states(touching(0), position=np.zeros((2, 3))), "states")
    told(pong.BadValueError, lambda: w.set_states(position=np.zeros((2, 3)), orientation=np.zeros((2, 3))), "orientation")
    w.set_states(touching(1e-3))
    w.step()
    told(pong.BadValueError, lambda: w.wrenches(np.zeros((2, 7))), "out", "(2, 6)")
    locked = np.zeros((2, 6))
    locked.setflags(write=False)
    told(pong.BadValueError, lambda: w.wrenches(locked), "out", "written")
    told(pong.BadValueError, lambda: w.wrenches(axes="world"), "axes", "common")
    shape = "give one of shape (2, 13)"
    told(pong.BadValueError, lambda: w.set_states("states"), "states: got 'states', which is of type str", shape)
    told(pong.BadValueError, lambda: w.set_states(np.zeros(13)), "states: got an array of float64 with shape (13,)", shape)
    told(pong.BadValueError, lambda: w.set_states(np.zeros((2, 13, 1))), "with shape (2, 13, 1)", shape)
    told(pong.BadValueError, lambda: w.set_states(touching(0).astype(complex)), "complex128", shape)
    told(pong.BadValueError, lambda: w.set_states([[1, 2], [3]]), "states: got [[1, 2], [3]]", shape)
    for out in (np.empty((2, 6), np.float32), [[0.0] * 6] * 2, np.empty(12)):
        told(pong.BadValueError, lambda: w.wrenches(out), "out: got ", "give an array of float64 with shape (2, 6)")
    told(pong.BadValueError, lambda: w.preload_friction(w.pairs[0], [1.0, 2.0]), "holding", "give 3 numbers")


def test_contact_states_that_do_not_fit():
    w = world()
    w.set_states(touching(1e-3))
    w.step()
    block, wrenches = w.save_state(), w.wrenches()
    told(pong.ContactStateError, lambda: w.restore_state(block[:-1]), "bytes")
    told(pong.ContactStateError, lambda: w.restore_state(b"x" * len(block)), "contact state")
    damaged = bytearray(block)
    damaged[-20] ^= 1
    told(pong.ContactStateError, lambda: w.restore_state(bytes(damaged)), "contact state")
    assert w.save_state() == block and np.array_equal(w.wrenches(), wrenches)


def test_surfaces_that_are_refused():
    w = world()
    ball = w.models[0]
    values = w.surface(ball, "rubber")
    told(pong.BadValueError, lambda: w.set_surface(ball, "rubber", {"mu": 0.2}), "surface `rubber`", "`mu`")
    told(pong.BadValueError, lambda: w.set_surface(ball, "rubber", values | {"stiffness": -1.0}), "stiffness")
    told(pong.BadValueError, lambda: w.set_surface(ball, "rubber", values | {"stifness": 5.0}), "stifness", "did you mean `stiffness`?")
    friction = values["friction"]
    for wrong, words in (
        (friction | {"mue": 0.1}, ("`mue`", "did you mean `mu`?")),
        ({"mue": 0.1}, ("`mue`", "did you mean `mu`?")),
        (friction | {"mu": "0.3"}, ("friction: mu: got '0.3'", "finite number")),
        (friction | {"mu": np.nan}, ("friction: mu: got ", "finite number")),
        (None, ("friction: got None", "dictionary")),
    ):
        told(pong.BadValueError, lambda: w.set_surface(ball, "rubber", values | {"friction": wrong}), *words)
    for stiffness in (None, [1.0], {"a": 1}):
        told(pong.BadValueError, lambda: w.set_surface(ball, "rubber", values | {"stiffness": stiffness}), "stiffness: got", "number")
    told(pong.NotFoundError, lambda: w.surface(ball, "chalk"), "chalk", "rubber")
    assert w.surface(ball, "rubber") == values


def test_scenes_that_are_refused(tmp_path):
    scene = scene_folder(tmp_path)
    told(pong.SceneError, lambda: pong.Scene.load(tmp_path / "none.ron"), "none.ron")
    text = scene.read_text().replace("mass: 1.0, ", "").replace('("ball", "ground")', '("ball", "sky")')
    error = told(pong.SceneError, lambda: pong.Scene.parse(text, folder=tmp_path).build(), "mass", "sky")
    assert len(error.errors) == 2 and error.errors[0]["cure"]
    error = told(pong.SceneError, lambda: pong.Scene.parse(text.replace("mot", "not", 1)), "scene:")
    assert error.errors[0]["line"]
    told(pong.SceneError, lambda: pong.Scene.load(scene).build(step=-1.0), "step")
    told(pong.BadValueError, lambda: pong.Scene.load(scene).build(integrator="Euler"), "Euler", "SemiImplicitEuler")
    simulation = pong.Scene.load(scene).build()
    told(pong.BadValueError, lambda: simulation.set_states(np.zeros((1, 13)), ["moon"]), "moon", "ball, ground")
    told(pong.BadValueError, lambda: simulation.set_states(np.zeros((1, 13)), ["ball"]), "norm")
    told(pong.BadValueError, lambda: simulation.run(every=0), "every")


def test_a_run_that_diverges(tmp_path):
    """A spring that is unstable at a step of 1 s: the first step makes more energy than any force can have given."""
    spring = "springs: [(first: Ground(), second: On(body: \"ball\"), stiffness: (1e4, 1e4, 1e4, 0, 0, 0))],"
    text = scene_folder(tmp_path).read_text().replace("step: 1e-4", f"{spring} step: 1.0")
    simulation = pong.Scene.parse(text.replace("duration: 0.3", "duration: 1000.0"), folder=tmp_path).build()
    energy = "body `ball`: it has 2.249e13 J, more than a hundred times what all forces gave"
    told(pong.RunError, simulation.run, energy, "by the spring of `the ground` and `ball`, at t = 1 s", "shorten it")


def test_cases_and_wishes_that_are_not_there():
    told(pong.BadValueError, lambda: pong.verify(["V999"]), "V999", "V1")
    wish = dict(mass=1.0, speed=1.0, depth=1e-3, restitution=0.5)
    told(pong.BadValueError, lambda: pong.advise_contact(**wish | {"mass": -1.0}), "mass")
    told(pong.BadValueError, lambda: pong.advise_contact(**wish, coupling="rk"), "coupling", "stages")


def test_threads_that_share_a_simulation_are_told(tmp_path):
    """The GIL is released: while one thread computes, another can call, and is refused."""
    simulation = pong.Scene.load(scene_folder(tmp_path)).build()
    thread = threading.Thread(target=simulation.run, args=(200_000,), kwargs={"every": 1000})
    thread.start()
    seen = ""
    while thread.is_alive() and not seen:
        try:
            simulation.time
        except pong.PhaseError as error:
            seen = str(error)
    thread.join()
    assert "another thread" in seen and "a simulation of its own" in seen


def test_a_run_can_be_interrupted(tmp_path):
    """Ctrl-C ends a run that would take hours."""
    simulation = pong.Scene.load(scene_folder(tmp_path)).build()
    # A shell starts background processes with Ctrl-C ignored, and Python keeps that.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT)).start()
        with pytest.raises(KeyboardInterrupt):
            simulation.run(10**10, every=10**9)
    finally:
        signal.signal(signal.SIGINT, before)
    assert simulation.time > 0.0
