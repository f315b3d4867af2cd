"""Frames: known answers, arrays in and out, contact memory."""

import numpy as np
import pytest
from support import BALL, DAMPING, GROUND, STIFFNESS, builder, scene_folder, states, touching, turned, world

import pong


def test_force_of_a_sphere_on_a_plane_is_that_of_its_spring_and_damper():
    w = world()
    w.set_states(touching(1e-3, velocity=(0, 0, -0.2)))
    report = w.step()
    force = STIFFNESS * 1e-3 + DAMPING * 0.2
    assert report.contacts == 1 and report.is_complete
    np.testing.assert_allclose(w.wrenches(), [[0, 0, force, 0, 0, 0], [0, 0, -force, 0, 0, 0]], atol=1e-12 * force)


def test_turned_and_moved_it_is_the_same_force():
    rng = np.random.default_rng(5)
    for _ in range(20):
        q = rng.normal(size=4)
        posed, turn = turned(touching(1e-3, velocity=(0.05, 0, -0.2)), q / np.linalg.norm(q), rng.uniform(-3, 3, 3))
        w, still = world(), world()
        w.set_states(posed)
        still.set_states(touching(1e-3, velocity=(0.05, 0, -0.2)))
        w.step(), still.step()
        common, expected = w.wrenches(), still.wrenches()
        np.testing.assert_allclose(common[:, :3], [turn(row[:3]) for row in expected], atol=1e-9)
        # Along the axes of its own group the ball feels the same as without the rotation.
        np.testing.assert_allclose(w.wrenches(axes="group")[0], expected[0], atol=1e-9)


def test_contacts_sum_to_the_wrench():
    w = world()
    w.set_states(touching(2e-3, velocity=(0.3, 0.1, -0.1), spin=(1, 2, 3)))
    w.evaluate()
    w.commit()
    contacts = w.contacts()
    assert contacts.dtype == pong.CONTACT_DTYPE and len(contacts) == 1
    (contact,) = contacts
    side = 0 if contact["interface_a"] == 0 else 1
    sign = 1.0 if side == 0 else -1.0
    arm = contact["arm_a"] if side == 0 else contact["arm_b"]
    expected = np.concatenate([sign * contact["force"], np.cross(arm, sign * contact["force"])])
    np.testing.assert_allclose(w.wrenches()[0], expected, rtol=1e-12, atol=1e-12)
    assert contact["depth"] == pytest.approx(2e-3, rel=1e-12)
    assert contact["depth_rate"] == pytest.approx(0.1, rel=1e-12)
    np.testing.assert_allclose(np.abs(contact["normal"]), [0, 0, 1], atol=1e-15)
    names = {w.primitive_path(contact[f"interface_{s}"], contact[f"primitive_{s}"]) for s in "ab"}
    assert names == {"ball/ball/shell", "ground/ground/floor"}


def test_the_wrench_of_a_pair_is_that_of_its_only_two_groups():
    w = world()
    w.set_states(touching(2e-3, velocity=(0.3, 0.1, -0.1), spin=(1, 2, 3)))
    w.step()
    ball, ground = w.interfaces
    for axes in ("common", "group"):
        rows = w.wrenches(axes=axes)
        assert np.array_equal(w.wrench_from(ball, ground, axes=axes), rows[0])
        assert np.array_equal(w.wrench_from(ground, ball, axes=axes), rows[1])
        assert np.array_equal(w.pair_wrench(w.pairs[0], ball, axes=axes), rows[0])
    np.testing.assert_allclose(w.pair_wrench(w.pairs[0], ground), -w.wrenches()[1], atol=1e-12)
    assert w.pair_wrench(w.pairs[0], ball).shape == (6,)
    with pytest.raises(pong.PongError, match="the same movable group"):
        w.wrench_from(ball, ball)
    with pytest.raises(pong.PongError, match="common"):
        w.pair_wrench(w.pairs[0], ball, axes="world")


def test_the_distance_of_a_ball_from_the_ground_needs_no_frame():
    w = world()
    ball, ground = w.interfaces
    with pytest.raises(pong.PongError, match="never set"):
        w.distance(ball, ground)
    w.set_states(touching(-0.25))
    found = w.distance(ball, ground)
    assert found.distance == pytest.approx(0.25, abs=1e-15)
    assert found.primitives == [0, 0] and found.elements == [0, 0]
    (_, _, low), (_, _, floor) = found.points
    assert low - floor == pytest.approx(0.25, abs=1e-15)
    assert w.distance(ground, ball).points == found.points[::-1]
    assert repr(found) == f"<pong.Distance {found.distance} m>"
    w.set_states(touching(1e-3))
    assert w.distance(ball, ground).distance == 0.0
    with pytest.raises(pong.PongError, match="the same movable group"):
        w.distance(ball, ball)


def test_begins_ends_and_peaks_are_told_of_the_frames_observed():
    w = world()
    for call in (w.contact_changes, w.pair_peaks, w.begin_peak_window, lambda: w.observe_pairs(1.0)):
        with pytest.raises(pong.PhaseError, match="start_pair_monitor"):
            call()
    w.start_pair_monitor()
    told = []
    for depth, step in [(1e-3, 1e-3), (3e-3, 1e-3), (-1e-3, 2e-3)]:
        w.clear_contact_history("ball")
        w.set_states(touching(depth))
        w.step()
        w.observe_pairs(step)
        told.append([(c.pair, c.interface_a, c.interface_b, c.begins) for c in w.contact_changes()])
    assert told == [[(0, 0, 1, True)], [], [(0, 0, 1, False)]]
    with pytest.raises(pong.PhaseError, match="once after each commit"):
        w.observe_pairs(1e-3)
    with pytest.raises(pong.BadValueError, match="step"):
        w.observe_pairs(-1e-3)
    (peaks,) = w.pair_peaks()
    assert (peaks.pair, peaks.touches, peaks.begins, peaks.ends) == (0, False, 1, 1)
    assert peaks.peak_normal_force == pytest.approx(STIFFNESS * 3e-3, rel=1e-12)
    assert peaks.contact_time == pytest.approx(2e-3, rel=1e-12)
    np.testing.assert_allclose(peaks.mean, [0, 0, STIFFNESS * 1e-3, 0, 0, 0], atol=1e-9)
    w.begin_peak_window()
    assert w.pair_peaks() == []


def test_parts_give_what_the_array_gives():
    whole, parts = world(), world()
    given = touching(1e-3, velocity=(0.1, 0.2, -0.3), spin=(1.0, -2.0, 0.5))
    whole.set_states(given)
    parts.set_states(
        position=given[:, :3],
        orientation=given[:, 3:7],
        linear_velocity=given[:, 7:10],
        angular_velocity=given[:, 10:],
    )
    whole.step(), parts.step()
    assert np.array_equal(whole.wrenches(), parts.wrenches())
    assert np.array_equal(parts.states(), given)


def test_arrays_may_be_views_lists_and_single_precision():
    expected = world()
    expected.set_states(touching(0.25, velocity=(0, 0, -0.5)))
    expected.step()
    wide = np.zeros((4, 26))
    wide[::2, ::2] = touching(0.25, velocity=(0, 0, -0.5))
    for given in (wide[::2, ::2], touching(0.25, velocity=(0, 0, -0.5)).tolist(), np.asfortranarray(wide[::2, ::2])):
        w = world()
        w.set_states(given)
        w.step()
        assert np.array_equal(w.wrenches(), expected.wrenches())
    single = world()
    single.set_states(touching(0.25, velocity=(0, 0, -0.5)).astype(np.float32))
    assert np.array_equal(single.states(), touching(0.25, velocity=(0, 0, -0.5)).astype(np.float32).astype(float))


def test_numbers_of_numpy_are_numbers(tmp_path):
    w = world()
    rubber, values = w.models[0], w.surface(w.models[0], "rubber")
    for number in (np.float32(0.25), np.array(0.25), np.float16(0.25)):
        w.set_surface(rubber, "rubber", values | {"friction": values["friction"] | {"mu": number}, "stiffness": np.int64(30000)})
        now = w.surface(rubber, "rubber")
        assert now["friction"]["mu"] == 0.25 and now["stiffness"] == 3e4
    stone = w.surface(w.models[1], "stone")
    w.set_surface(w.models[1], "stone", stone | {"stiffness": np.float32(np.inf)})
    assert w.surface(w.models[1], "stone") == stone
    simulation = pong.Scene.load(scene_folder(tmp_path)).build(step=np.float32(2.0**-13))
    simulation.set_gravity(np.array([0, 0, -9]))
    assert simulation.gravity == (0.0, 0.0, -9.0) and simulation.step_length == 2.0**-13
    simulation.set_mass("ball", {"mass": np.array(2.0), "inertia": np.eye(3, dtype=np.float32), "mass_center": np.zeros(3)})
    assert simulation.mass("ball")["mass"] == 2.0 and simulation.mass("ball")["inertia"][1][1] == 1.0
    simulation.run(steps=np.int64(2))
    w.set_states(touching(1e-3))
    assert w.preload_friction(w.pairs[0], np.array([0.5, 0, 0], np.float32)) == 1
    data = pong.model.parse(BALL)
    data["root"]["primitives"][0]["Sphere"]["radius"] = np.array(0.5)
    assert "radius: 0.5" in pong.model.write(data)


def test_results_go_into_the_memory_of_the_caller():
    w = world()
    w.set_states(touching(1e-3))
    w.step()
    room = np.full((2, 6), np.nan)
    assert w.wrenches(room) is room and np.array_equal(room, w.wrenches())
    # A view of a larger array, every second column.
    wide = np.zeros((2, 12))
    w.wrenches(wide[:, ::2])
    assert np.array_equal(wide[:, ::2], room) and not wide[:, 1::2].any()
    contacts = w.contacts()
    assert contacts.base is not None, "contacts are a view of what the engine wrote"


def test_some_interfaces_alone():
    w = world()
    ball, ground = w.interfaces
    given = touching(1e-3)
    w.set_states(given[1:], interfaces=[ground])
    assert np.isnan(w.states()[0]).all() and np.array_equal(w.states()[1], given[1])
    w.set_states(given[:1], interfaces=[w.interface("ball")])
    assert (ball.name, ball.index) == ("ball/ball", 0) and ball == w.interface("ball")
    w.step()
    assert w.wrenches()[0, 2] == pytest.approx(STIFFNESS * 1e-3, rel=1e-12)


def slide(w, steps, start=0):
    """The ball dragged along the ground: friction builds up from frame to frame."""
    rows = []
    for step in range(start, start + steps):
        given = touching(1e-3, velocity=(0.1, 0.02, 0))
        given[0, 0], given[0, 1] = 1e-4 * step, 2e-5 * step
        w.set_states(given)
        w.step()
        rows.append(w.wrenches())
    return np.array(rows)


def test_evaluate_is_pure_and_commit_is_not():
    w = world()
    slide(w, 3)
    before = w.save_state()
    given = touching(1.5e-3, velocity=(0.1, 0, 0))
    w.set_states(given)
    first = (w.evaluate(), w.wrenches())
    w.set_states(touching(3e-3, velocity=(-1.0, 0, 0)))
    w.evaluate()
    assert w.save_state() == before
    w.set_states(given)
    assert w.evaluate() == first[0] and np.array_equal(w.wrenches(), first[1])
    w.commit()
    assert w.save_state() != before


def test_a_restored_state_goes_on_to_the_same_bits():
    whole = slide(world(), 10)
    saving, restored = world(), world()
    slide(saving, 5)
    assert saving.scene_hash == restored.scene_hash
    block = saving.save_state()
    assert isinstance(block, bytes)
    restored.restore_state(block)
    assert np.array_equal(slide(restored, 5, start=5), whole[5:])
    # Sensitivity of the comparison: without the state the friction differs.
    assert not np.array_equal(slide(world(), 5, start=5), whole[5:])


def test_objects_arrive_and_the_others_go_on_to_the_same_bits(tmp_path):
    def slid(x):
        posed = touching(1e-3)
        posed[0, 0] = x
        return posed

    w = world()
    for x in (0.0, 1e-4):
        w.set_states(slid(x))
        w.step()
    extension = w.extended()
    second = extension.create_object(w.models[0], "second")
    extension.pair(second, "ground")
    larger = extension.seal()
    arrived = larger.interface(second)
    assert larger.interfaces[:2] == w.interfaces and arrived == larger.interfaces[2]
    larger.set_states(position=[(5.0, 0.0, 0.099)], interfaces=[arrived])
    told = larger.continue_from(w)
    assert (told["objects"], told["pairs"], told["contacts"], told["objects_left"]) == (2, 1, 1, 0)
    for x in (1e-4, 2e-4, 1e-4):
        w.set_states(slid(x))
        larger.set_states(slid(x), interfaces=w.interfaces)
        w.step(), larger.step()
        assert larger.wrenches(axes="group")[0].tobytes() == w.wrenches(axes="group")[0].tobytes()
    smaller = world()
    told = smaller.continue_from(larger)
    assert (told["objects_left"], told["pairs_left"], told["contacts_left"]) == (1, 1, 1) and told["energy_left"] > 0
    with pytest.raises(pong.BadValueError, match="this world itself"):
        larger.continue_from(larger)
    larger.evaluate()
    with pytest.raises(pong.PhaseError, match="commit the frame"):
        smaller.continue_from(larger)
    larger.commit()
    smaller.start_log(tmp_path / "log")
    with pytest.raises(pong.PhaseError, match="stop_log"):
        smaller.continue_from(larger)
    smaller.stop_log()


def test_history_is_dropped_where_it_is_asked_for():
    w, fresh = world(), world()
    slide(w, 5)
    w.clear_contact_history("ball")
    assert np.array_equal(slide(w, 1, start=5), slide(fresh, 1, start=5))


def test_a_pair_that_is_off_has_no_contacts():
    w = world()
    w.set_pair_enabled(w.pairs[0], False)
    w.set_states(touching(1e-3))
    assert w.step().contacts == 0 and not w.wrenches().any()
    w.set_pair_enabled(w.pairs[0], True)
    assert w.step().contacts == 1


def test_surfaces_can_be_changed_between_frames():
    w = world()
    ball, ground = w.models
    values = w.surface(ball, "rubber")
    assert values["stiffness"] == STIFFNESS and w.surface(ground, "stone")["stiffness"] == float("inf")
    values["stiffness"] = 2 * STIFFNESS
    w.set_surface(ball, "rubber", values)
    w.set_surface(ground, "stone", w.surface(ground, "stone"))
    w.set_states(touching(1e-3))
    w.step()
    assert w.wrenches()[0, 2] == pytest.approx(2 * STIFFNESS * 1e-3, rel=1e-12)


def test_values_of_a_surface_that_are_left_out_stay():
    w = world()
    ball = w.models[0]
    values = w.surface(ball, "rubber")
    w.set_surface(ball, "rubber", {"friction": {"mu": 0.2}})
    w.set_surface(ball, "rubber", {"stiffness": 3 * STIFFNESS, "normal": {}})
    w.set_surface(ball, "rubber", {})
    assert w.surface(ball, "rubber") == values | {"friction": values["friction"] | {"mu": 0.2}, "stiffness": 3 * STIFFNESS}


def test_friction_can_be_there_from_the_start():
    w = world()
    w.set_states(touching(1e-3))
    assert w.preload_friction(w.pairs[0], holding=(3.0, 0, 0)) == 1
    w.evaluate()
    assert w.wrenches()[0, 0] == pytest.approx(3.0, rel=1e-9)


def test_the_ledger_knows_what_is_stored():
    w = world(ledger=True)
    w.set_states(touching(1e-3))
    w.step()
    assert w.ledger()["stored"] == pytest.approx(0.5 * STIFFNESS * 1e-6, rel=1e-9)


def test_what_is_left_out_is_told():
    made = pong.WorldBuilder(contact_capacity=1)
    text = """(format: "pong-model", version: 1, name: "feet",
        surfaces: { "rubber": (stiffness: 2e4, normal: Linear(damping: 30)) },
        root: (name: "feet", surface: "rubber", primitives: [
            Point(name: "left", position: (-1, 0, 0)), Point(name: "right", position: (1, 0, 0))]))"""
    from support import GROUND

    for name, source in (("feet", text), ("ground", GROUND)):
        made.create_object(made.add_model(pong.Model.parse(source)), name)
    made.pair("feet", "ground")
    w = made.seal()
    w.set_states(states(((0, 0, -1e-3), (0,) * 3, (0,) * 3), ((0,) * 3, (0,) * 3, (0,) * 3)))
    report = w.step()
    assert pong.Status(report.status) == pong.Status.CONTACT_LIMIT and not report.is_complete
    assert (report.contacts, report.contacts_wanted) == (1, 2)


def test_tunnelling_and_depth_in_meshes_are_told_by_name():
    plate = """(format: "pong-model", version: 1, name: "plate", surfaces: { "s": (stiffness: 1e5) },
        root: (name: "plate", surface: "s", primitives: [TriangleMesh(name: "top", thickness: 0.01, vertices: [
            (-1, -1, 0), (1, -1, 0), (0, 1, 0)], triangles: [(0, 1, 2)])]))"""
    # A step in a block: the prism of an L with an arm of 0.06 m, so that its facets push down to 0.03 m.
    outline = [(-0.1, -0.06), (0.1, -0.06), (0.1, 0), (0, 0), (0, 0.06), (-0.1, 0.06)]
    vertices = [(x, y, z) for y in (-0.08, 0.08) for x, z in outline]
    ends = [(0, 1, 2), (0, 2, 3), (0, 3, 5), (3, 4, 5)]
    sides = [t for a in range(6) for b in [(a + 1) % 6] for t in ((a, a + 6, b + 6), (a, b + 6, b))]
    triangles = ends + [(a + 6, c + 6, b + 6) for a, b, c in ends] + sides
    block = f"""(format: "pong-model", version: 1, name: "l", surfaces: {{ "s": (stiffness: 1e5) }},
        root: (name: "l", surface: "s", contact: Solid, primitives: [
            TriangleMesh(name: "mesh", vertices: {vertices}, triangles: {triangles})]))"""

    def two(first, second):
        made = pong.WorldBuilder()
        for name, text in (("first", first), ("second", second)):
            made.create_object(made.add_model(pong.Model.parse(text)), name)
        made.pair("first", "second")
        return made.seal()

    def at(w, z):
        w.set_states(states(((0, 0, z), (0,) * 3, (0,) * 3), ((0,) * 3, (0,) * 3, (0,) * 3)))
        return w.step()

    w = two(BALL, plate)
    assert at(w, 0.5).is_complete and w.tunnelling() is None
    assert pong.Status(at(w, -0.5).status) == pong.Status.TUNNELLED
    assert w.tunnelling() == "`first/ball/shell` through `second/plate` (1 of 1)"
    w = two(block, block)
    assert at(w, 0.119).is_complete and w.deep_in_mesh() is None
    assert pong.Status(at(w, 0.08).status) == pong.Status.DEEP_IN_MESH
    assert w.deep_in_mesh() == "`second/l` in `first/l`"


def test_workers_change_no_bit():
    assert np.array_equal(slide(world(workers=1), 5), slide(world(), 5))


def test_the_builder_can_be_mended_after_a_refused_seal():
    made = pong.WorldBuilder()
    text = """(format: "pong-model", version: 1, name: "hard", surfaces: { "steel": (stiffness: inf) },
        root: (name: "hard", surface: "steel", primitives: [Sphere(name: "s", center: (0, 0, 0), radius: 1)]))"""
    model = made.add_model(pong.Model.parse(text))
    made.create_object(model, "one")
    made.create_object(model, "two")
    made.pair("one", "two")
    with pytest.raises(pong.SealError) as caught:
        made.seal()
    assert caught.value.problems and "steel" in str(caught.value)
    # Nothing was lost: the Objects exist, and more can be added.
    made.create_object(model, "three")
    assert builder().seal().contact_capacity >= 256


def test_stiffness_and_damping_of_contacts():
    """The floor is rigid: the ball's own values, 2e4 N/m and 30 N·s/m."""
    made = world()
    made.set_states(touching(1e-3, velocity=(0.0, 0.0, -0.1)))
    made.step()
    np.testing.assert_allclose(made.contact_stiffness(), [[STIFFNESS, DAMPING]], rtol=1e-12)
    made.set_states(touching(-1e-3))
    made.step()
    assert made.contact_stiffness().shape == (0, 2)


def test_tangents():
    """A ball on a rigid floor: 2e4 N/m and 30 N·s/m along z, against each other; bristles of half the stiffness add more."""
    made = world()
    with pytest.raises(pong.PhaseError, match="tangent"):
        made.tangents()
    made.set_states(touching(1e-3, velocity=(0.0, 0.0, -0.1)))
    made.evaluate()
    before = made.wrenches()
    (tangent,), (differences,) = made.tangents(), made.tangents(differences=True)
    assert (tangent.interface_a, tangent.interface_b) == (0, 1)
    assert differences.by_differences and not tangent.by_differences
    assert made.complete_tangents() == [tangent]
    assert tangent.stiffness.shape == tangent.damping.shape == (2, 2, 6, 6)
    signs = np.array([[1.0, -1.0], [-1.0, 1.0]])
    np.testing.assert_allclose(tangent.stiffness[:, :, 2, 2], STIFFNESS * signs, rtol=1e-9)
    np.testing.assert_allclose(tangent.damping[:, :, 2, 2], DAMPING * signs, rtol=1e-9)
    np.testing.assert_allclose(differences.stiffness, tangent.stiffness, atol=1e-4 * STIFFNESS)
    np.testing.assert_allclose(differences.damping, tangent.damping, atol=1e-4 * DAMPING)
    np.testing.assert_array_equal(made.wrenches(), before)
    (slope,) = made.surface_slopes(made.models[0], "rubber", "stiffness")
    np.testing.assert_allclose(slope.wrenches[:, 2], [1e-3, -1e-3], rtol=1e-7)
    with pytest.raises(pong.NotFoundError, match="stiffness"):
        made.surface_slopes(made.models[0], "rubber", "colour")
    (potential,) = made.incremental_potentials(1e6)
    assert (potential.interface_a, potential.interface_b) == (slope.interface_a, slope.interface_b) == (0, 1)
    np.testing.assert_allclose(potential.energy, 0.5 * STIFFNESS * 1e-6, rtol=1e-7)
    np.testing.assert_allclose(potential.wrenches[:, 2], [STIFFNESS * 1e-3, -STIFFNESS * 1e-3], rtol=1e-8)
    np.testing.assert_allclose(potential.stiffness, potential.stiffness.transpose(1, 0, 3, 2), rtol=1e-12)
    np.testing.assert_array_equal(made.wrenches(), before)
    made.commit()
    with pytest.raises(pong.PhaseError, match="before it is committed"):
        made.tangents(differences=True)
    (row,) = made.contact_tangents()
    np.testing.assert_allclose(row[:2], [STIFFNESS, DAMPING], rtol=1e-12)
    assert row[2] > 0.0


LANDER = BALL.replace("primitives: [", """groups: [(name: "arm", movable: true,
    primitives: [Point(name: "tip", position: (0, 0, 0))]), (name: "body", primitives: [""").replace("]),\n)", "])]),\n)")


def test_groups_that_are_kept_apart():
    counts = []
    for kept_apart in (False, True):
        made = pong.WorldBuilder()
        for name, text in (("lander", LANDER), ("ground", GROUND)):
            made.create_object(made.add_model(pong.Model.parse(text, name=name)), name)
        made.pair("lander", "ground")
        if kept_apart:
            with pytest.raises(pong.NotFoundError, match="lander/leg"):
                made.filter("lander", "leg", "ground", "")
            made.filter("lander", "arm", "ground", "")
            with pytest.raises(pong.DuplicateError, match="already there"):
                made.filter("ground", "", "lander", "ball/arm")
        world = made.seal()
        states = np.zeros((3, 13))
        states[:, 3] = 1.0
        states[0, 2], states[1, 2] = 0.099, -0.001
        world.set_states(states)
        counts.append(world.step().contacts)
    assert counts == [2, 1]


def test_a_step_report_counts_masses_and_joints():
    """The ball with a mass at the plane: h²·k/m + 2·h·c/m < 4 for semi-implicit Euler; on a slide of 4 kg that of 4 kg."""

    def limit(m):
        return (-DAMPING + np.sqrt(DAMPING**2 + 4 * STIFFNESS * m)) / STIFFNESS

    world = builder().seal()
    ball, ground = {"mass": 1.0}, {"mass": np.inf}
    told = world.step_report({"ball": ball, "ground": ground}, step=1e-3, coupling="semi_implicit")
    assert told["stable_step"] == pytest.approx(limit(1.0), rel=1e-9) and told["warnings"] == []
    slide = np.zeros((6, 6))
    slide[2, 2] = 0.25
    masses = {"ball": ball | {"inverse_inertia": slide}, "ground": ground}
    told = world.step_report(masses, step=1.1 * limit(4.0), coupling="semi_implicit")
    assert told["stable_step"] == pytest.approx(limit(4.0), rel=1e-9) and len(told["warnings"]) == 1
    # The spring of the slide acts beside the contact.
    springs = {"ball": masses["ball"] | {"spring_rate": 1e5}, "ground": ground}
    noted = world.step_report(springs, step=1e-3, coupling="semi_implicit")
    assert noted["surely_stable_step"] < limit(4.0) < told["surely_stable_step"] * 1.001
    assert world.step_report({"ball": ball}, step=1e-3)["not_judged"] == ["`ground/ground`: no mass is given"]
    for bad, words in (
        ({"ball": {}}, "`mass` is missing"),
        ({"ball": ball | {"inverse_inertia": np.eye(5)}}, "shape"),
        ({"ball": ball | {"inverse_inertia": -slide}}, "negative mass"),
        ({"ball": ball | {"inertias": 1.0}}, "inertia"),
        ({"bell": ball}, "bell"),
    ):
        with pytest.raises(pong.EngineError, match=words):
            world.step_report(bad, step=1e-3)


def test_surfaces_that_move_along_themselves():
    w = world(moving_surfaces=True)
    motions = np.zeros((2, 18))
    for _ in range(20):
        w.set_states(touching(1e-3))
        w.set_surface_motions(motions)
        w.step()
        motions[1, 0] = 0.5
        motions[1, 9] += 0.5 * 1e-3
    friction = w.wrenches()[0, 0]
    assert 0.0 < friction <= 0.6 * w.wrenches()[0, 2] * (1.0 + 1e-9)
    with pytest.raises(pong.BadValueError, match="moving_surfaces"):
        world().set_surface_motions(motions)


def test_a_log_has_the_motions_of_surfaces(tmp_path):
    w = world(moving_surfaces=True)
    motions = np.zeros((2, 18))
    w.set_states(touching(1e-3))
    w.start_log(tmp_path / "log", step=1e-3)
    for frame in range(30):
        w.set_states(touching(1e-3))
        w.set_surface_motions(motions)
        w.step()
        w.log_frame(frame * 1e-3)
        motions[1, 0] = 0.5
        motions[1, 9] += 0.5e-3
        motions[1, 16] += 1e-4 * frame
    assert w.stop_log() == 30
    found = pong.replay(tmp_path / "log")
    assert found.agrees and found.compared == 30


def test_foundation_and_resistance_can_be_set():
    w = world()
    ball = w.models[0]
    values = w.surface(ball, "rubber")
    assert values["foundation"] is None and values["area"] is None
    assert values["friction"]["rolling"] == 0.0 and values["friction"]["spinning"] == 0.0
    w.set_surface(ball, "rubber", {"foundation": 1e7, "friction": {"rolling": 1e-3, "spinning": 2e-3}})
    values = w.surface(ball, "rubber")
    assert values["foundation"] == 1e7
    assert (values["friction"]["rolling"], values["friction"]["spinning"]) == (1e-3, 2e-3)
    w.set_surface(ball, "rubber", {"foundation": None, "area": 0.01})
    with pytest.raises(pong.BadValueError, match="not both"):
        w.set_surface(ball, "rubber", {"foundation": 1e7})


def test_slow_host():
    """A ball of 1 kg falls on the floor in frames of 20 ms: by the law of the contact, where a held wrench would throw it up."""
    made = world()
    slow = pong.SlowHost(made, substeps_max=5000)
    ball, floor = made.interfaces
    assert repr(slow) == "<pong.SlowHost of 2 Interfaces>"
    row, accelerations, frame = touching(-1e-3), np.zeros((2, 6)), 0.02
    accelerations[0, 2] = -9.81
    with pytest.raises(pong.BadValueError, match="mass of `ball/ball`: it is missing"):
        slow.step(frame, row, accelerations)
    slow.prescribed(floor)
    slow.free(ball, mass=-1.0, inertia=np.eye(3))
    with pytest.raises(pong.BadValueError, match="mass of `ball/ball`: it is -1 kg"):
        slow.step(frame, row, accelerations)
    slow.free(ball, mass=1.0, inertia=4e-3 * np.eye(3))
    with pytest.raises(pong.PhaseError, match="evaluate a frame first"):
        slow.wrenches()
    with pytest.raises(pong.BadValueError, match="length of the frame"):
        slow.step(0.0, row, accelerations)
    with pytest.raises(pong.PhaseError):
        slow.commit()
    fastest = 0.0
    for number in range(20):
        kept = slow.save_state()
        report = slow.step(frame, row, accelerations)
        wrench = slow.wrenches()
        slow.restore_state(kept)
        assert slow.evaluate(frame, row, accelerations) == report
        slow.commit()
        np.testing.assert_array_equal(slow.wrenches(out=np.empty((2, 6))), wrench)
        np.testing.assert_array_equal(slow.wrenches("group"), wrench)  # nothing turns
        assert report.substeps >= 8 and not (report.substep_limit or report.unresolved or report.theta_mismatch)
        assert abs(report.inserted) < 1e-9 and report.differences.shape == (2, 13) and report.status == 0
        row[0, 7:10] += frame * (wrench[0, :3] + accelerations[0, :3])
        row[0, :3] += frame * row[0, 7:10]
        fastest = max(fastest, row[0, 9])
    assert report.theta_measured == pytest.approx(1.0, abs=1e-6)
    assert 0.0 < fastest < np.sqrt(2.0 * 9.81 * 1e-3)
    with pytest.raises(pong.ContactStateError, match="damaged"):
        slow.restore_state(kept[:-1])
    with pytest.raises(pong.BadValueError, match="theta"):
        pong.SlowHost(made, theta=2.0)


def test_slow_host_of_a_jointed_body():
    """A ball that can only rise: its mobility holds it against the floor as its mass would."""
    made = world()
    slow = pong.SlowHost(made)
    mobility = np.zeros((6, 6))
    mobility[2, 2] = 0.5
    slow.jointed(made.interfaces[0], mobility)
    slow.prescribed(made.interfaces[1])
    accelerations = np.zeros((2, 6))
    accelerations[0, 2] = -9.81
    slow.step(0.05, touching(2.0 * 9.81 / STIFFNESS), accelerations)
    assert slow.wrenches("group")[0, 2] == pytest.approx(2.0 * 9.81, rel=1e-6)
    slow.jointed(made.interfaces[0], -mobility)
    with pytest.raises(pong.BadValueError, match="mobility of `ball/ball`: an impulse would move the body against itself"):
        slow.step(0.05, touching(1e-3), accelerations)
    with pytest.raises(pong.BadValueError, match=r"give one of shape \(6, 6\)"):
        slow.jointed(made.interfaces[0], np.eye(3))
    with pytest.raises(pong.NotFoundError):
        slow.prescribed(world().interfaces[0])


def test_slow_host_of_coupled_bodies():
    """Two balls that are one rigid body and can only rise: together they carry its weight, without the coupling more."""
    made = pong.WorldBuilder()
    for name, text in (("left", BALL), ("right", BALL), ("ground", GROUND)):
        made.create_object(made.add_model(pong.Model.parse(text, name=name)), name)
    made.pair("left", "ground"), made.pair("right", "ground")
    made = made.seal()
    mass, mobility = 2.0, np.zeros((6, 6))
    mobility[2, 2] = 1.0 / mass
    left, right, floor = made.interfaces
    accelerations = np.zeros((3, 6))
    accelerations[:2, 2] = -9.81
    deep = touching(0.5 * mass * 9.81 / STIFFNESS)
    rows = np.vstack([deep[0], deep[0], deep[1]])
    for coupled in (True, False):
        slow = pong.SlowHost(made)
        slow.jointed(left, mobility), slow.jointed(right, mobility), slow.prescribed(floor)
        if coupled:
            slow.couplings([(left, right, mobility)])
        slow.step(0.05, rows, accelerations)
        carried = sum(slow.wrenches("group")[:2, 2])
        if coupled:
            assert carried == pytest.approx(mass * 9.81, rel=1e-6)
        else:
            assert carried > 1.2 * mass * 9.81
    with pytest.raises(pong.BadValueError, match="it is one group"):
        slow.couplings([(left, left, mobility)])
    slow.couplings([(left, right, 3.0 * mobility)])
    with pytest.raises(pong.BadValueError, match="an impulse would move the body against itself"):
        slow.step(0.05, rows, accelerations)
    slow.couplings([(left, floor, mobility)])
    with pytest.raises(pong.BadValueError, match="is not in joints"):
        slow.step(0.05, rows, accelerations)
