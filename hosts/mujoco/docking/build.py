"""Writes docking.xml: the scene of models/idss_docking for MuJoCo.

    python3 build.py            writes it
    python3 build.py --check    says whether it is what this script writes

The six-axis springs of the scene become joints: along three slides and a ball joint, MuJoCo's springs and dampers are those of
the scene (docs/scene_format.md), because the three stiffnesses about the axes are equal. The models' polyhedra become meshes that
are shown and touch nothing: contact is the plugin's.
"""

import pathlib
import sys

import ron

HERE = pathlib.Path(__file__).resolve().parent
MODELS = HERE.parents[2] / "models/idss_docking"
# Group of the scene, body that carries it, colour.
COLOURS = {"chaser": "0.75 0.75 0.8 1", "chaser/ring": "0.85 0.7 0.35 1", "latch": "0.8 0.3 0.2 1", "target": "0.4 0.5 0.65 1"}


def numbers(values):
    return " ".join(f"{value:.12g}" for value in values)


def polyhedra(group, owner):
    """(movable group, vertices) of all polyhedra of a group and those below it; `owner` is the movable group it moves with."""
    for primitive in group.get("primitives", []):
        if primitive["is"] == "Polyhedron":
            yield owner, primitive["vertices"]
    for below in group.get("groups", []):
        yield from polyhedra(below, f"{owner}/{below['name']}" if below.get("movable") else owner)


def shapes(name, model):
    """Meshes and geoms of an Object: ([asset lines], {movable group: [geom lines]})."""
    assets, geoms = [], {}
    for index, (group, vertices) in enumerate(polyhedra(ron.read((MODELS / model).read_text())["root"], name)):
        mesh = f"{name}_{index}"
        flat = numbers(value for vertex in vertices for value in vertex)
        assets.append(f'<mesh name="{mesh}" inertia="legacy" vertex="{flat}"/>')
        colour = COLOURS.get(group, COLOURS["latch"])
        geoms.setdefault(group, []).append(f'<geom type="mesh" mesh="{mesh}" rgba="{colour}"/>')
    return assets, geoms


def inertial(body):
    center = numbers(body.get("mass_center", (0, 0, 0)))
    return f'<inertial pos="{center}" mass="{body["mass"]:.12g}" diaginertia="{numbers(body["inertia"]["of"])}"/>'


def joints(spring):
    """Three slides and a ball joint of a spring whose stiffness and damping about its axes are equal."""
    stiffness, damping = spring["stiffness"], spring["damping"]
    assert len(set(stiffness[3:])) == len(set(damping[3:])) == 1, "a ball joint has one stiffness and one damping"
    for axis, k, c in zip(("1 0 0", "0 1 0", "0 0 1"), stiffness, damping):
        yield f'<joint type="slide" axis="{axis}" stiffness="{k:g}" damping="{c:g}"/>'
    yield f'<joint type="ball" stiffness="{stiffness[3]:g}" damping="{damping[3]:g}"/>'


def free_body(name, body, lines):
    place = f'pos="{numbers(body["position"])}" quat="{numbers(body["orientation"])}"'
    return [f'<body name="{name}" {place}>', "  <freejoint/>", f"  {inertial(body)}", *("  " + line for line in lines), "</body>"]


def held_body(name, body, spring, lines):
    first = spring["first"]
    place = f'pos="{numbers(first.get("position", (0, 0, 0)))}" quat="{numbers(first.get("orientation", (1, 0, 0, 0)))}"'
    inside = [*joints(spring), inertial(body), *lines]
    return [f'<body name="{name}" {place}>', *("  " + line for line in inside), "</body>"]


def docking():
    scene = ron.read((MODELS / "scene_soft_capture.ron").read_text())
    chaser, target = scene["objects"]
    bodies = {body.get("group", ""): body for body in chaser["bodies"]}
    springs = {spring["second"]["body"]: spring for spring in scene["springs"]}
    assets, geoms = shapes("chaser", scene["models"]["idss_active"])
    more_assets, target_geoms = shapes("target", scene["models"]["idss_passive"])

    ring = list(geoms["chaser/ring"])
    for index in range(3):
        latch = f"latch_{index}"
        ring += held_body(f"chaser/ring/{latch}", bodies[latch], springs[f"chaser/{latch}"], geoms[f"chaser/ring/{latch}"])
    ring = held_body("chaser/ring", bodies["ring"], springs["chaser/ring"], ring)
    world = free_body("chaser", bodies[""], geoms["chaser"] + ring)
    world += free_body("target", target["bodies"][0], target_geoms["target"])
    # All bodies of the chaser move together: the joints are at rest.
    assert all(body["linear_velocity"] == bodies[""]["linear_velocity"] for body in bodies.values())
    velocity = [*bodies[""]["linear_velocity"], *[0.0] * (3 + 4 * 6 + 6)]
    pose = [v for body in (bodies[""],) for v in (*body["position"], *body["orientation"])]
    pose += [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0] * 4
    pose += [*target["bodies"][0]["position"], *target["bodies"][0]["orientation"]]
    indent = "\n    "
    return f"""<!-- A chaser of 12 t docks to a station of 420 t: models/idss_docking/scene_soft_capture.ron for MuJoCo. Written by build.py.
     `dir` is seen from the folder in which the process runs: the root of the repository. Start from the keyframe. -->
<mujoco model="idss_docking">
  <option timestep="{scene["step"]:g}" integrator="RK4" gravity="0 0 0">
    <flag contact="disable"/>
  </option>
  <statistic meansize="0.1" extent="1.5" center="0 0 -0.3" meanmass="400"/>
  <visual>
    <global azimuth="150" elevation="-15" offwidth="1280" offheight="800"/>
    <map znear="0.02" zfar="100" force="3"/>
    <headlight ambient="0.5 0.5 0.5" diffuse="0.7 0.7 0.7"/>
    <rgba contactforce="0.8 0.1 0.5 1"/>
  </visual>
  <extension>
    <plugin plugin="pong.contact">
      <instance name="docking">
        <config key="dir" value="models/idss_docking"/>
        <config key="objects" value="chaser = {scene["models"]["idss_active"]}; target = {scene["models"]["idss_passive"]}"/>
      </instance>
    </plugin>
  </extension>
  <asset>
    <texture type="skybox" builtin="gradient" rgb1="1 1 1" rgb2="0.75 0.8 0.85" width="64" height="384"/>
    {indent.join(assets + more_assets)}
  </asset>
  <worldbody>
    {indent.join(world)}
  </worldbody>
  <sensor>
    <plugin name="contact" instance="docking"/>
  </sensor>
  <keyframe>
    <key name="approach" qpos="{numbers(pose)}" qvel="{numbers(velocity)}"/>
  </keyframe>
</mujoco>
"""


def main():
    path = HERE / "docking.xml"
    if "--check" in sys.argv:
        if path.read_text() != docking():
            sys.exit(f"{path}: not what build.py writes; run it")
    else:
        path.write_text(docking())


if __name__ == "__main__":
    main()
