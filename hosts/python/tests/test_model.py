"""Model files as data, and the rules of the loader for programs that make models."""

import os
import pathlib
import random

import numpy as np
import pytest
from support import BALL, GROUND

import pong

CUBE = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
FACES = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]


def with_root(contents, surface="steel"):
    return f"""(format: "pong-model", version: 1, name: "m", surfaces: {{ "steel": (stiffness: 1e6) }},
        root: (name: "m", surface: "{surface}", {contents}))"""


def primitives(*written):
    return pong.model.parse(with_root(f"primitives: [{', '.join(written)}]"))["root"]["primitives"]


def test_every_form_of_a_value():
    text = with_root(
        """groups: [(name: "arm", movable: true, bound: Custom("kind"), leaf_size: Some(4), surface: None,
            pose: (position: (1, 2.5, -3e-3)), primitives: [
            Ray(name: "tip", origin: (0, 0, 0), direction: (0, 0, 1), length: 0.1, response: Axial),
            Custom(name: "own", kind: "spring", parameters: [1, 2]),
            Triangle(name: "sheet", vertices: ((0, 0, 0), (1, 0, 0), (0, 1, 0)), two_sided: true),
        ])]"""
    )
    (arm,) = pong.model.parse(text)["root"]["groups"]
    own = arm.pop("primitives")
    assert arm == {
        "name": "arm", "movable": True, "bound": {"Custom": "kind"}, "leaf_size": 4, "surface": None,
        "pose": {"position": (1.0, 2.5, -3e-3)},
    }  # fmt: skip
    assert own[0] == {
        "Ray": {
            "name": "tip", "origin": (0.0, 0.0, 0.0), "direction": (0.0, 0.0, 1.0), "length": 0.1, "response": "Axial",
        }
    }  # fmt: skip
    assert own[1] == {"Custom": {"name": "own", "kind": "spring", "parameters": [1.0, 2.0]}}
    assert own[2]["Triangle"]["vertices"] == ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


def test_surfaces_and_laws():
    ball = pong.model.parse(BALL)
    assert ball["surfaces"] == {
        "rubber": {"stiffness": 2e4, "normal": {"Linear": {"damping": 30.0}}, "friction": {"Bristle": {"mu": 0.6}}}
    }
    assert ball["format"] == "pong-model" and ball["version"] == 1
    assert pong.model.parse(GROUND)["surfaces"]["stone"]["stiffness"] == float("inf")


def test_lists_of_meshes_are_arrays():
    vertices = "vertices: [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 0.1)]"
    mesh, solid, mixed = primitives(
        f'TriangleMesh(name: "a", {vertices}, triangles: [(0, 1, 2), (0, 2, 3)])',
        f'Polyhedron(name: "b", {vertices}, faces: [[0, 2, 1], [0, 1, 3]], inactive_faces: [1])',
        f'Polyhedron(name: "c", {vertices}, faces: [[0, 2, 1], [0, 1, 3, 2]])',
    )
    mesh, solid, mixed = mesh["TriangleMesh"], solid["Polyhedron"], mixed["Polyhedron"]
    assert mesh["vertices"].shape == (4, 3) and mesh["vertices"][3, 2] == 0.1
    assert mesh["triangles"].tolist() == [[0, 1, 2], [0, 2, 3]] and mesh["triangles"].dtype == np.int64
    assert solid["faces"].tolist() == [[0, 2, 1], [0, 1, 3]] and solid["inactive_faces"] == [1]
    assert [face.tolist() for face in mixed["faces"]] == [[0, 2, 1], [0, 1, 3, 2]]


def test_a_list_with_comments_and_words_is_the_same_list():
    plain, odd = primitives(
        'TriangleMesh(name: "a", vertices: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], triangles: [(0, 1, 2)])',
        'TriangleMesh(name: "b", vertices: [(0, 0 /* z */, 0), (1_0e-1, 0, 0), (0, 1f64, 0)], triangles: [(0x0, 1, 2u8)])',
    )
    for name in ("vertices", "triangles"):
        assert np.array_equal(plain["TriangleMesh"][name], odd["TriangleMesh"][name])


def test_what_is_read_is_not_judged_by_its_shape(tmp_path):
    open_one = 'Polyhedron(name: "p", vertices: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces: [[0, 1, 2]])'
    (found,) = primitives(open_one)
    assert found["Polyhedron"]["faces"].tolist() == [[0, 1, 2]]
    text = with_root(f"primitives: [{open_one}]")
    assert [error["rule"] for error in pong.model.check(text).errors] == ["too-few-faces"]
    (tmp_path / "m.ron").write_text(with_root('primitives: [TriangleMesh(name: "t", file: "none.obj")]'))
    (mesh,) = pong.model.read(tmp_path / "m.ron")["root"]["primitives"]
    assert mesh == {"TriangleMesh": {"name": "t", "file": "none.obj"}}
    # The number of faces in the file is unknown here, so an invalid face index is passed on unchanged.
    (solid,) = primitives('Polyhedron(name: "p", file: "none.obj", inactive_faces: [1, 1.5])')
    assert solid["Polyhedron"]["inactive_faces"] == [1, 1.5]


def test_faults_have_place_cause_and_cure(tmp_path):
    with pytest.raises(pong.ModelError) as told:
        pong.model.parse(BALL.replace("radius: 0.1", "radius: -0.1, colour: 3"), name="ball.ron")
    rules = [(error["file"], error["line"], error["path"], error["rule"]) for error in told.value.errors]
    assert rules == [("ball.ron", 5, "ball/shell", "not-positive"), ("ball.ron", 5, "ball/shell", "unknown-field")]
    assert all(error["cause"] and error["cure"] for error in told.value.errors)
    with pytest.raises(pong.ModelError, match="unreadable"):
        pong.model.read(tmp_path / "none.ron")
    (tmp_path / "latin.ron").write_bytes(b"\n(name: \xe9)")
    with pytest.raises(pong.ModelError) as told:
        pong.model.read(tmp_path / "latin.ron")
    assert told.value.errors[0]["line"] == 2 and "UTF-8" in told.value.errors[0]["cure"]


def same(a, b):
    """True if data is equal to the last bit, including arrays."""
    if isinstance(a, dict):
        return isinstance(b, dict) and list(a) == list(b) and all(same(a[key], b[key]) for key in a)
    if isinstance(a, (list, tuple)):
        return type(a) is type(b) and len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, np.ndarray):
        return isinstance(b, np.ndarray) and a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()
    return type(a) is type(b) and (a == b or a != a)


def test_what_is_written_is_read_as_it_was():
    models = pathlib.Path(os.environ["REPOSITORY"]).glob("models/*/*.ron")
    texts = [text for text in map(pathlib.Path.read_text, models) if '"pong-model"' in text]
    assert len(texts) > 50
    for text in [*texts, BALL, GROUND]:
        data = pong.model.parse(text)
        written = pong.model.write(data)
        assert same(pong.model.parse(written), data)
        assert max(map(len, written.splitlines())) <= 120
        assert pong.model.write(pong.model.parse(written)) == written


def test_every_number_and_every_text_comes_back():
    random.seed(3)
    numbers = [random.uniform(-1, 1) * 10.0 ** random.randint(-300, 99) for _ in range(300)]
    numbers += [0.1, 1e22, 5e-324, 1e100, -0.0, 123456789.123456789]
    names = ['a"b', "back\\slash", "line\nbreak", "µ-Größe", "tab\t", "\u200b", "// no comment"]
    surfaces = {name: {"stiffness": float("inf"), "friction": None} for name in names}
    surfaces["s"] = {"stiffness": 1.0, "friction": {"Bristle": {"mu": 0.3}}}
    own = [{"Custom": {"name": name.replace("/", "|"), "surface": name, "kind": name, "parameters": numbers}} for name in names]
    faces = [np.array([0, 1, 2], dtype=np.int64), np.array([0, 3, 2, 1], dtype=np.int64)]
    own.append({"Polyhedron": {"name": "p", "vertices": np.array(numbers).reshape(-1, 3), "faces": faces}})
    root = {"name": "m", "surface": "s", "bound": {"Custom": "torus"}, "leaf_size": 7, "primitives": own}
    data = {"format": "pong-model", "version": 1, "name": "m", "surfaces": surfaces, "root": root}
    assert same(pong.model.parse(pong.model.write(data)), data)


def test_one_line_has_the_same_data():
    for text in (BALL, GROUND):
        data = pong.model.parse(text)
        line = pong.model.write(data, one_line=True)
        assert "\n" not in line and same(pong.model.parse(line), data)


def test_the_schema_has_every_kind_and_field():
    tables = pong.model.schema()
    assert list(tables["primitives"])[:3] == ["Point", "LineSegment", "Ray"] and len(tables["primitives"]) == 14
    radius = tables["primitives"]["Sphere"]["radius"]
    assert radius == {"type": "positive", "unit": "m", "required": True}
    assert tables["primitives"]["Ray"]["response"]["choices"] == ("Normal", "Axial")
    assert tables["normal_laws"]["Linear"]["restitution"]["fields"]["mass"]["unit"] == "kg"
    assert tables["group"]["bound"]["words"].startswith("`Aabb` if movable") and "Custom" in tables["bounds"]
    assert list(tables["friction_laws"]) == ["None", "Bristle", "Coulomb", "Custom"]


def test_values_that_contain_themselves_are_refused():
    endless = {"name": "g"}
    endless["groups"] = [endless]
    with pytest.raises(ValueError, match="128 deep"):
        pong.model.write({"root": endless})


def test_what_has_no_form_is_refused():
    with pytest.raises(TypeError, match="no form for .*, which is a set"):
        pong.model.write({"name": {1, 2}})
    # The loader judges its meaning.
    with pytest.raises(pong.ModelError, match="unknown-field"):
        pong.model.parse(pong.model.write(pong.model.parse(BALL) | {"colour": 1}))


def test_check_gives_all_errors_or_the_model_with_its_warnings():
    good = pong.model.check(BALL)
    assert (good.errors, good.warnings, good.model.hash) == ([], [], pong.Model.parse(BALL).hash)
    wound = 'TriangleMesh(name: "t", vertices: [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], triangles: [(0, 1, 2), (1, 2, 3)])'
    odd = pong.model.check(with_root(f"primitives: [{wound}]"))
    assert odd.model is not None and len(odd.warnings) == 1 and "wound against" in odd.warnings[0]
    bad = pong.model.check(BALL.replace("0.1)", "-1)").replace("mu: 0.6", "mu: -1"), name="ball.ron")
    assert bad.model is None and [error["rule"] for error in bad.errors] == ["negative", "not-positive"]


def test_a_polyhedron_is_told_by_face_and_place():
    assert pong.model.check_polyhedron(CUBE, FACES) == []
    assert pong.model.check_polyhedron(CUBE, np.array(FACES), inactive=[0]) == []
    lifted = CUBE.copy()
    lifted[7, 2] += 0.01
    (fault,) = pong.model.check_polyhedron(lifted, FACES)
    assert (fault["rule"], fault["face"]) == ("face-not-planar", 1)
    # The plane goes through the mean: a quarter of the height by which one of four corners was lifted.
    assert fault["off"] == pytest.approx(0.0025, rel=1e-3)
    open_one = pong.model.check_polyhedron(CUBE, FACES[1:])
    assert {fault["rule"] for fault in open_one} == {"open-polyhedron"}
    assert {place for fault in open_one for place in fault["places"]} == {tuple(p) for p in CUBE[:4].tolist()}
    dented = np.concatenate([CUBE, [[0.5, 0.5, 0.9]]])
    fan = [[4, 5, 8], [5, 7, 8], [7, 6, 8], [6, 4, 8]]
    in_front = pong.model.check_polyhedron(dented, [FACES[0], *FACES[2:], *fan])
    assert {fault["rule"] for fault in in_front} == {"not-convex"} and min(f["off"] for f in in_front) > 0.05


def test_triangles_are_told_by_rule():
    a, b = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0)], float), np.array([(0, 0, 0), (1, 1, 0), (0, 1, 0)], float)
    assert pong.model.check_triangles([a, b]) == []
    (fault,) = pong.model.check_triangles([a, b[::-1]])
    assert (fault["severity"], fault["rule"], fault["triangles"].tolist()) == ("warning", "winding", [0, 1])
    repeated = pong.model.check_triangles([a, b, np.roll(a, 1, axis=0)])[0]
    assert (repeated["severity"], repeated["rule"]) == ("error", "duplicate-triangle")
    assert repeated["triangles"].tolist() == [2]
    (sliver,) = pong.model.check_triangles([a, [(0, 0, 0), (1, 0, 0), (0.5, 1e-11, 0)]])
    assert (sliver["rule"], sliver["triangles"].tolist()) == ("sliver-triangle", [1])


def test_arguments_that_cannot_be_used():
    with pytest.raises(pong.BadValueError, match="triangle 0 has a coordinate that is no finite number"):
        pong.model.check_triangles(np.full((1, 3, 3), np.nan))
    with pytest.raises(pong.BadValueError, match="there is no face 6 among 6"):
        pong.model.check_polyhedron(CUBE, FACES, inactive=[6])
    (fault,) = pong.model.check_polyhedron(CUBE, [*FACES[:5], [1, 3, 7, 9]])
    assert (fault["rule"], fault["face"]) == ("index-out-of-range", 5)


def test_bounds_of_groups():
    text = with_root(
        """groups: [
            (name: "arm", movable: true, bound: Sphere, pose: (position: (9, 0, 0)), groups: [
                (name: "hand", bound: Aabb, pose: (position: (0, 0, 2)), primitives: [
                    Sphere(name: "ball", center: (1, 0, 0), radius: 0.5),
                ]),
            ]),
            (name: "floor", bound: Aabb, primitives: [Plane(name: "p", normal: (0, 0, 1), offset: 0)]),
        ]"""
    )
    bounds = {bound["path"]: bound for bound in pong.Model.parse(text).bounds()}
    assert set(bounds) == {"m", "m/arm", "m/arm/hand", "m/floor"}
    hand, arm = bounds["m/arm/hand"], bounds["m/arm"]
    assert (hand["kind"], hand["movable_group"], arm["kind"]) == ("Aabb", "m/arm", "Sphere")
    np.testing.assert_allclose(hand["center"], (1, 0, 2), atol=1e-6)
    np.testing.assert_allclose(hand["half"], 0.5, rtol=1e-5)
    np.testing.assert_allclose(arm["half"], 0.5, rtol=1e-5)
    assert np.array_equal(hand["axes"], np.eye(3))
    assert "half" not in bounds["m/floor"], "a plane has no end"


SLAB = """(format: "pong-model", version: 1, name: "slab",
    surfaces: { "rough": (stiffness: inf, friction: Bristle(mu: 0.9)) },
    root: (name: "slab", surface: "rough", primitives: [Polyhedron(name: "solid",
        vertices: [(-1, -1, -1), (1, -1, -1), (-1, 1, -1), (1, 1, -1), (-1, -1, 0), (1, -1, 0), (-1, 1, 0), (1, 1, 0)],
        faces: [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]])]))"""


def forces_at(floor, places, ball):
    """Force on a ball of 0.1 m whose centre is at height 0.099 m, at each place."""
    builder = pong.WorldBuilder()
    builder.create_object(builder.add_model(ball), "ball")
    builder.create_object(builder.add_model(floor), "floor")
    builder.pair("ball", "floor")
    world = builder.seal()
    forces = []
    for x in places:
        states = np.zeros((2, 13))
        states[:, 3] = 1.0
        states[0, :3] = (x, 0.2, 0.099)
        world.set_states(states)
        world.step()
        forces.append(float(world.wrenches()[0, 2]))
    return forces


def test_joined_files_are_one_surface(tmp_path):
    (tmp_path / "slab.ron").write_text(SLAB)
    slab = tmp_path / "slab.ron"
    parts = [slab, (slab, (2, 0, 0)), (slab, (4, 0, 0), (0, 0, 0, 1))]
    text = pong.model.join(parts, name="floor", folder=tmp_path)
    floor, ball = pong.Model.parse(text, folder=tmp_path), pong.Model.parse(BALL)
    paths = [path for path, _, _ in floor.primitives()]
    assert paths == ["floor/slab/solid", "floor/slab_2/solid", "floor/slab_3/solid"]
    middle, seam, turned = forces_at(floor, [0.2, 1.0, 3.0], ball)
    assert middle > 1.0 and seam == pytest.approx(middle, rel=1e-9) and turned == pytest.approx(middle, rel=1e-9)
    separate = pong.Model.parse(pong.model.join(parts, name="floor", folder=tmp_path, one_surface=False))
    assert forces_at(separate, [1.0], ball)[0] == pytest.approx(2.0 * middle, rel=1e-6)


def test_what_cannot_be_joined_is_refused(tmp_path):
    (tmp_path / "slab.ron").write_text(SLAB)
    with pytest.raises(pong.BadValueError, match="no models to join"):
        pong.model.join([], name="floor")
    with pytest.raises(pong.BadValueError, match=r"parts\[0\].*quaternion"):
        pong.model.join([(tmp_path / "slab.ron", (0, 0, 0), (2, 0, 0, 0))], name="floor")
    with pytest.raises(pong.BadValueError, match="2 numbers|6 numbers"):
        pong.model.join([(tmp_path / "slab.ron", (0, 0))], name="floor")
    with pytest.raises(pong.ModelError, match=r"none\.ron"):
        pong.model.join([tmp_path / "none.ron"], name="floor")
