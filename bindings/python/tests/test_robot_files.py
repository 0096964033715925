"""Robots as people have them: what each kind of file gives, beside MuJoCo; and the law that whatever a text says, nothing
but a SceneError leaves, and no file is read that nobody named. FEATHER_DRAWS and FEATHER_SEED set how many and which
texts are drawn."""

import copy
import json
import math
import os
import random
import tracemalloc
from pathlib import Path
from typing import Any, Callable, List

import numpy as np
import pytest
from conftest import ROOT
from robots import compare_bodies, near, plain

from feather_physics import InvalidArgumentError, SceneError, UnsupportedError, VersionError, World
from feather_physics.frames import about, multiply, rotate
from feather_physics.mjcf import load_mjcf, save_mjcf
from feather_physics.robot_dae import read_dae
from feather_physics.robot_mesh import find_file, mass_of, read_mesh
from feather_physics.scene import Scene
from feather_physics.scene_records import SceneBody, SceneMesh, SceneShape
from feather_physics.urdf import load_urdf, save_urdf

DRAWS = int(os.environ.get("FEATHER_DRAWS", "300"))
SEED = int(os.environ.get("FEATHER_SEED", random.randrange(1 << 32)))


def drawn(name: str) -> random.Random:
    print(f"{name}: FEATHER_SEED={SEED}")
    return random.Random(f"{name} {SEED}")


def link(name: str, mass: Any = 1, inertia: Any = (1, 1, 1), more: str = "") -> str:
    tensor = " ".join(f'i{k}{k}="{x}"' for k, x in zip("xyz", inertia)) + ' ixy="0" ixz="0" iyz="0"'
    return f'<link name="{name}"><inertial><mass value="{mass}"/><inertia {tensor}/></inertial>{more}</link>'


def joint(name: str, kind: str, a: str, b: str, more: str = "", xyz: str = "0 0 0") -> str:
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{a}"/><child link="{b}"/><origin xyz="{xyz}" rpy="0 0 1"/>'
        f'<limit lower="-1" upper="1"/>{more}</joint>'
    )


def robot(body: str) -> str:
    return f'<robot name="r">{body}</robot>'


PAIR = link("a") + link("b") + joint("j", "revolute", "a", "b", '<axis xyz="0 0 1"/>')

# ---- URDF


def test_what_ros_has_besides_is_a_warning_of_each_kind() -> None:
    more = "<gazebo/>" * 3 + '<ros2_control name="x"/><self_filter/><contact/>' + "<gazebo/>"
    scene = load_urdf(robot(more + PAIR.replace("</link>", "<contact/><verbose/></link>")))
    told = [sentence for _, _, kind, sentence in scene.warnings if kind == "element"]
    names = ["gazebo", "ros2_control", "self_filter", "contact", "verbose"]
    assert sorted(told) == sorted(f"<{name}>: is left out" for name in names)
    file, line, kind, sentence = scene.warnings[0]
    assert (file, line, kind, str(scene.warnings[0])) == ("urdf", 1, "element", f"urdf:1: {sentence}")
    with pytest.raises(SceneError, match="left out"):
        load_urdf(robot(more + PAIR), strict=True)
    load_urdf("\ufeff\n\n<?xml version='1.0'?>\n" + robot(PAIR), strict=True)
    with pytest.raises(SceneError, match=":4: <link>"):
        load_urdf(b"\n\n<?xml version='1.0'?>\n<robot name='r'><link/></robot>")


def test_links_without_mass_are_frames() -> None:
    """Their poses follow the body that they are fixed to; what is fixed to them hangs on that body."""
    massless = '<inertial><mass value="0"/><inertia ixx="0" iyy="0" izz="0"/></inertial>'
    ball = '<collision><origin xyz="0 0 1"/><geometry><sphere radius="0.1"/></geometry></collision>'
    text = robot(
        PAIR
        + f'<link name="mount">{massless}{ball}</link><link name="tool0"/>'
        + joint("m", "fixed", "b", "mount", '<axis xyz="0 0 0"/>', "0.5 0 0")
        + joint("t", "fixed", "mount", "tool0", "", "0.25 0 0")
        + link("hand")
        + joint("h", "fixed", "tool0", "hand", "", "0 1 0")
    )
    scene = load_urdf(text, fixed_base=True, strict=True)
    assert [body.name for body in scene.bodies] == ["a", "b", "hand"]
    assert [(one.type, one.a, one.b) for one in scene.joints] == [("hinge", "a", "b"), ("fixed", "b", "hand")]
    assert [(frame.name, frame.body) for frame in scene.frames] == [("mount", "b"), ("tool0", "b")]
    assert np.allclose(scene.bodies[1].shapes[0].position, (0.5, 0, 1))
    assert near(plain(scene), plain(load_urdf(save_urdf(scene), fixed_base=True)))
    assert Scene.from_json(scene.to_json()).frames == scene.frames
    with World(gravity=(0, 0, 0)) as world:
        built = scene.build(world, (1, 2, 3))
        at = scene.frame("tool0")
        assert np.allclose(built.frame("tool0").position, np.add(at.position, (1, 2, 3)), atol=1e-6)
        built.bodies["b"].angular_velocity = (0, 0, 2)
        for _ in range(20):
            world.step(1 / 60)
        turned = multiply(about((0, 0, 1), built.joints["j"].state.angle), at.rotation)
        assert built.joints["j"].state.angle > 0.3
        assert abs(abs(np.dot(built.frame("tool0").rotation, turned)) - 1) < 1e-6
        with pytest.raises(SceneError, match="no frame"):
            built.frame("tool1")
    with pytest.raises(SceneError, match="no frame"):
        scene.frame("tool1")


def test_moving_links_without_mass() -> None:
    """Those to which a mass is fixed move as that mass; others get the caller's, or are refused."""
    moved = robot(link("a") + '<link name="b"/>' + link("c") + joint("j", "revolute", "a", "b") + joint("k", "fixed", "b", "c"))
    scene = load_urdf(moved)
    assert [(one.a, one.b) for one in scene.joints] == [("a", "c")] and scene.frames[0].name == "b"
    alone = robot(link("a") + '<link name="b"/>' + joint("j", "revolute", "a", "b"))
    with pytest.raises(SceneError, match="default_mass"):
        load_urdf(alone)
    scene = load_urdf(alone, default_mass=0.5)
    assert scene.bodies[1].mass == 0.5 and [warning.kind for warning in scene.warnings] == ["mass"]
    for wrong in (0, -1, math.nan):
        with pytest.raises(InvalidArgumentError, match="default_mass"):
            load_urdf(alone, default_mass=wrong)


def test_moments_that_no_body_has_are_balanced_as_mujoco_balances_them(referee: Callable[..., Any]) -> None:
    """The law: whatever moments a file has, the scene's are sound; where the file's are, they are the file's; where
    MuJoCo's are above 0, they are MuJoCo's."""
    draw, texts = drawn("moments"), []
    for _ in range(30):
        moments = sorted(draw.choice([0, draw.uniform(0, 1), draw.uniform(-1, 1)]) for _ in range(3))
        texts.append(robot(link("a") + link("b", draw.uniform(0.1, 9), moments) + joint("j", "fixed", "a", "b")))
    for text, wanted in zip(texts, referee(texts)):
        scene = load_urdf(text)
        body = scene.bodies[1]
        low, middle, high = sorted(body.inertia)
        assert low > 0 and high <= (low + middle) * (1 + 1e-6)
        if max(wanted["bodies"][1]["inertia"]) > 0:
            compare_bodies({one.name: one for one in scene.bodies}, wanted["bodies"])
        if scene.warnings:
            assert [warning.kind for warning in scene.warnings] == ["mass"] and "'b'" in str(scene.warnings[0])
            with pytest.raises(SceneError, match="no body has the moments"):
                load_urdf(text, strict=True)
        with World() as world:
            scene.build(world)


def test_the_compiler_of_mujoco_is_obeyed(tmp_path: Path) -> None:
    said = '<mujoco><compiler balanceinertia="true" discardvisual="true" fusestatic="true" meshdir="m" strippath="true"/></mujoco>'
    (tmp_path / "m").mkdir()
    (tmp_path / "m" / "t.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    mesh = '<collision><geometry><mesh filename="package://far/away/t.obj"/></geometry></collision>'
    text = robot(said + PAIR + link("c", 3, (1, 1, 3), mesh) + joint("k", "fixed", "b", "c", "", "1 0 0"))
    (tmp_path / "r.urdf").write_text(text)
    scene = load_urdf(tmp_path / "r.urdf")
    assert [body.name for body in scene.bodies] == ["a", "b"] and scene.frames[0].name == "c"
    assert scene.bodies[1].mass == 4 and np.allclose(scene.bodies[1].centre, (0.75, 0, 0))
    # Steiner: 1 kg and 3 kg a metre apart, 1 + 5/3 kg m2 of their own
    assert sorted(scene.bodies[1].inertia) == pytest.approx([8 / 3, 8 / 3 + 0.75, 8 / 3 + 0.75])
    assert len(scene.meshes) == 1 and [warning.kind for warning in scene.warnings] == ["hull"]


def test_joints_that_ros_has_otherwise() -> None:
    two = joint("k", "revolute", "b", "c", '<mimic joint="j" multiplier="-1"/>')
    scene = load_urdf(robot(PAIR + link("c") + two))
    assert [(w.kind, "k" in w.sentence) for w in scene.warnings] == [("joint", True)] and scene.joints[1].type == "hinge"
    for limits, kind in (('lower="1" upper="-1"', "revolute"), ('lower="-4" upper="4"', "revolute"), ("", "prismatic")):
        scene = load_urdf(robot(PAIR.replace('lower="-1" upper="1"', limits).replace("revolute", kind)))
        assert scene.joints[0].lower is None and [warning.kind for warning in scene.warnings] == ["limit"]
    assert load_urdf(robot(PAIR.replace("revolute", "spherical"))).joints[0].type == "ball"
    with pytest.raises(SceneError, match="direction"):
        load_urdf(robot(PAIR.replace("0 0 1", "0 0 0")))


@pytest.mark.parametrize("size", [1e-4, 0.5e-3, 1e-3, 0.02])
def test_small_forms(size: float) -> None:
    """The scene has their sizes; a world has them with at least a millimetre to each side."""
    form = f'<collision><geometry><box size="{2 * size} 0.02 0.02"/></geometry></collision>'
    scene = load_urdf(robot(link("a", 1e-3, (1e-7, 1e-7, 1e-7), form)), fixed_base=False)
    assert scene.bodies[0].shapes[0].size[0] == pytest.approx(size)
    assert [warning.kind for warning in scene.warnings] == (["size"] if size < 1e-3 else [])
    with World() as world:
        scene.build(world)
        world.step()
    grain = f'<mujoco><worldbody><body><freejoint/><geom size="{size}" density="0.1"/></body></worldbody></mujoco>'
    scene = load_mjcf(grain)
    assert scene.bodies[0].mass == pytest.approx(0.1 * 4 / 3 * math.pi * size**3)
    with World() as world:
        assert scene.build(world).bodies["body1"].mass == pytest.approx(max(1e-9, scene.bodies[0].mass))


# ---- MJCF


def model(body: str, rest: str = "") -> str:
    return f'<mujoco><compiler angle="radian"/>{rest}<worldbody>{body}</worldbody></mujoco>'


def test_replicas_stand_as_they_are_told() -> None:
    """Frame i is turned by i times the angles and stands at the sum of the offsets, each in the frame before it."""
    draw = drawn("replicas")
    for _ in range(30):
        count, offset = draw.randint(1, 12), [draw.uniform(-1, 1) for _ in range(3)]
        angle = draw.uniform(-1, 1)
        text = model(
            f'<replicate count="{count}" sep="-" offset="{offset[0]} {offset[1]} {offset[2]}" euler="0 0 {angle}">'
            '<body name="b"><joint name="j"/><geom size="0.1"/></body></replicate>'
        ).replace("</mujoco>", '<actuator><motor name="m" joint="j"/></actuator></mujoco>')
        scene = load_mjcf(text)
        digits, place = len(str(count)), np.zeros(3)
        names = [f"-{i:0{digits}}" for i in range(count)]
        assert [body.name for body in scene.bodies] == ["b" + name for name in names]
        assert [(one.name, one.joint) for one in scene.actuators] == [("m" + name, "j" + name) for name in names]
        for i, body in enumerate(scene.bodies):
            turn = about((0, 0, 1), i * angle)
            assert np.allclose(body.position, place, atol=1e-12) and abs(abs(np.dot(body.rotation, turn)) - 1) < 1e-12
            place = place + rotate(turn, offset)
    nested = '<replicate count="2" offset="0 1 0"><replicate count="2" sep="-" offset="1 0 0"><body name="A"><freejoint/><geom size="1"/></body></replicate></replicate>'
    assert [body.name for body in load_mjcf(model(nested)).bodies] == ["A-00", "A-10", "A-01", "A-11"]
    for wrong in ('count="0"', 'count="1e9"', 'count="x"', ""):
        with pytest.raises(SceneError, match="count|elements"):
            load_mjcf(model(f'<replicate {wrong}><body><freejoint/><geom size="1"/></body></replicate>'))


def test_attached_models(tmp_path: Path) -> None:
    arm = '<body name="arm"><joint name="j" range="-90 90"/><geom class="g"/><body name="tip" pos="0 0 1"><joint name="k"/><geom class="g"/></body></body>'
    (tmp_path / "arm.xml").write_text(
        f'<mujoco model="arm"><default><default class="g"><geom size="0.2"/></default></default><worldbody>{arm}</worldbody>'
        '<actuator><motor name="m" joint="k"/></actuator></mujoco>'
    )
    text = model(
        '<frame pos="1 0 0"><attach model="arm" body="arm" prefix="l_"/></frame><attach model="arm" body="tip" prefix="r_"/>',
        '<asset><model name="arm" file="arm.xml"/></asset>',
    )
    (tmp_path / "all.xml").write_text(text)
    scene = load_mjcf(tmp_path / "all.xml")
    assert [body.name for body in scene.bodies] == ["l_arm", "l_tip", "r_tip"]
    assert scene.bodies[1].position == (1.0, 0.0, 1.0) and scene.bodies[0].shapes[0].size == [0.2]
    assert scene.joints[0].upper == pytest.approx(math.pi / 2)  # its own file is in degrees
    assert [one.joint for one in scene.actuators] == ["l_k", "r_k"]
    assert len(load_mjcf(text, folders=[tmp_path]).bodies) == 3
    with pytest.raises(SceneError, match="folders"):
        load_mjcf(text)
    for name in ("arm.xml", "all.xml"):
        (tmp_path / name).write_text(text.replace('body="arm"', "").replace('body="tip"', ""))
    with pytest.raises(SceneError, match="100 files|second"):
        load_mjcf(tmp_path / "all.xml")


def test_a_cable_is_a_chain() -> None:
    text = model('<composite type="cable" prefix="c" count="9 1 1" size="0.8" offset="0 0 2" initial="none"><geom type="capsule" size="0.01"/></composite>')
    scene = load_mjcf(text)
    assert [body.name for body in scene.bodies][::7] == ["cB_first", "cB_last"] and len(scene.joints) == 7
    assert np.allclose([body.position for body in scene.bodies], [(0.1 * i, 0, 2) for i in range(8)])
    assert {one.type for one in scene.joints} == {"ball"} and len(scene.excluded) == 7


def test_mocap_bodies_are_moved_by_the_program() -> None:
    text = model(
        '<body name="m" mocap="true" pos="0 0 1"><inertial mass="0" pos="0 0 0" diaginertia="0 0 0"/><body name="grip"><geom size="0.1"/></body></body>'
        '<body name="b" pos="0 0 2"><freejoint/><geom size="0.1"/></body>'
    ).replace("</mujoco>", '<equality><weld body1="m" body2="b"/></equality></mujoco>')
    scene = load_mjcf(text)
    assert [(body.name, body.type) for body in scene.bodies] == [("m", "kinematic"), ("b", "dynamic")]
    assert scene.frames[0].name == "grip" and len(scene.bodies[0].shapes) == 1
    assert near(plain(scene), plain(load_mjcf(save_mjcf(scene))))
    with World() as world:
        assert scene.build(world).bodies["m"].type == "kinematic"


def test_total_masses_least_masses_and_places_of_the_world(referee: Callable[..., Any]) -> None:
    bodies = (
        '<body name="a" pos="1 0 1"><joint name="j" pos="1 0 1" axis="0 1 0"/><geom type="capsule" fromto="1 0 1 2 0 1" size="0.1"/>'
        '<body name="b" pos="2 0 1"><joint name="k" pos="2 0 1"/><geom pos="2 0 1.5" size="0.01"/></body></body><body name="c"><geom size="0.2"/></body>'
    )
    texts = [
        f"<mujoco><compiler {said}/><worldbody>{bodies}</worldbody></mujoco>"
        for said in ('settotalmass="14"', 'coordinate="global"', 'boundmass="3" boundinertia="0.5" settotalmass="20"')
    ]
    for text, wanted in zip(texts, referee(texts)):
        scene = load_mjcf(text)
        assert compare_bodies({body.name: body for body in scene.bodies}, wanted["bodies"]) == 2
        for one, theirs in zip(scene.joints, wanted["joints"]):
            assert np.allclose(one.position, theirs["position"]) and np.allclose(one.axis, theirs["axis"])


def test_joints_of_one_body_that_are_askew_move_as_in_mujoco(referee: Callable[..., Any]) -> None:
    """Links carry a thousandth of the mass, and turn with it: what a swing differs by is of that order, and so is what
    steps of 0.3 ms leave out. Bound: 20 times that."""
    draw, texts = drawn("askew"), []
    for _ in range(6):
        angle = draw.uniform(0.5, 1.0)
        place = " ".join(f"{draw.uniform(-0.2, 0.2):.3f}" for _ in range(3))
        texts.append(
            model(
                f'<body name="b" pos="0 0 1"><joint name="p" axis="1 0 0" damping="0.1"/><joint name="q" axis="{math.cos(angle)} {math.sin(angle)} 0" '
                f'damping="0.1" pos="{place}"/><geom type="box" size="0.05 0.1 0.2" pos="0 0.1 -0.3" mass="2"/></body>'
            )
        )
    for text, wanted in zip(texts, referee(texts, "0.5")):
        scene = load_mjcf(text)
        assert scene.joints[0].type == "chain" and near(plain(scene), plain(load_mjcf(save_mjcf(scene))))
        with World(gravity=(0, 0, -9.81), substeps=32) as world:
            built = scene.build(world)
            for _ in range(50):
                world.step(0.01)
            found = [built.joints[name].state.angle for name in "pq"]
            assert sum(body.mass for body in (*built.links, built.bodies["b"])) == pytest.approx(2)
        assert np.abs(np.subtract(found, wanted["after"])).max() < 0.02 * max(1, np.abs(wanted["after"]).max()), (found, wanted["after"])


# ---- meshes and where they are

DAE = """<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="f" count="12">0 0 0 3 0 0 0 3 0 0 0 3</float_array>
<technique_common><accessor source="#f" count="4" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>{form}</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><translate>100 0 0</translate><scale>{scale} 1 1</scale><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"""
TRIANGLES = '<triangles count="4"><input semantic="NORMAL" source="#n" offset="1"/><input semantic="VERTEX" source="#v" offset="0"/><p>0 0 2 0 1 0 0 0 1 0 3 0 0 0 3 0 2 0 1 0 2 0 3 0</p></triangles>'
POLYLIST = '<polylist count="4"><input semantic="VERTEX" source="#v" offset="0"/><vcount>3 3 3 3</vcount><p>0 2 1 0 1 3 0 3 2 1 2 3</p></polylist>'


@pytest.mark.parametrize("form", [TRIANGLES, POLYLIST])
def test_collada(tmp_path: Path, form: str) -> None:
    """A corner of 3 cm, 1 m along x: its volume is a sixth of a cube's, mirrored or not."""
    for scale in (1, -1):
        (tmp_path / "m.dae").write_text(DAE.format(form=form, scale=scale))
        volume, centre, _, _ = mass_of(*read_mesh(str(tmp_path / "m.dae"), (1, 1, 1)))  # type: ignore[misc]
        assert volume == pytest.approx(0.03**3 / 6) and centre == pytest.approx((1 + scale * 0.0075, 0.0075, 0.0075))
    good, draw = DAE.format(form=form, scale=1).encode(), drawn("collada")
    for _ in range(DRAWS):
        (tmp_path / "m.dae").write_bytes(mutated(draw, good, [b"#g", b"-1", b"nan", b"9", b"<node>", b"#s"]))
        try:
            read_mesh(str(tmp_path / "m.dae"), (1, 1, 1))
        except SceneError:
            pass
    (tmp_path / "m.dae").write_bytes(b'<!DOCTYPE a [<!ENTITY b "c">]>' + good[21:])
    with pytest.raises(SceneError):
        read_mesh(str(tmp_path / "m.dae"), (1, 1, 1))


@pytest.mark.parametrize("digits", [19, 400, 5000])
def test_a_place_of_many_digits_is_refused(tmp_path: Path, digits: int) -> None:
    """More than a float, and more than Python reads."""
    (tmp_path / "m.dae").write_text(DAE.format(form=TRIANGLES.replace("0 0 2 0", "9" * digits + " 0 2 0"), scale=1))
    with pytest.raises(SceneError):
        read_mesh(str(tmp_path / "m.dae"), (1, 1, 1))


def test_a_geometry_is_not_placed_without_end() -> None:
    """One that has many numbers and no triangle, placed again and again."""
    form = '<polylist><input semantic="VERTEX" source="#v" offset="0"/><vcount></vcount><p>' + "0 1 " * 1000 + "</p></polylist>"
    text = DAE.format(form=form, scale=1)
    place = '<instance_geometry url="#g"/>'
    with pytest.raises(SceneError, match="numbers"):
        read_dae(text.replace(place, place * 100).encode(), "m.dae", 1000)
    with pytest.raises(SceneError, match="no COLLADA file with triangles"):
        read_dae(text.encode(), "m.dae", 1000)


def test_one_face_of_a_large_file_takes_little_memory(tmp_path: Path) -> None:
    """Refused with less than four times the bytes of the file, and without them in the message."""
    (tmp_path / "m.obj").write_bytes(b"v 0 0 0\n" * 3 + b"f" + b" 1 2 3" * ((16 << 20) // 6) + b"\n")
    tracemalloc.start()
    with pytest.raises(SceneError, match="corners") as error:
        read_mesh(str(tmp_path / "m.obj"), (1, 1, 1))
    assert tracemalloc.get_traced_memory()[1] < 4 * (16 << 20) and len(str(error.value)) < 200
    tracemalloc.stop()
    for name, secret in (("s.obj", "v hidden:x:0 0 0\n"), ("s.stl", "vertex hidden:x:0 0 0\n"), ("s.obj", "f hidden:x:0 0 0\n")):
        (tmp_path / name).write_text(secret)
        with pytest.raises(SceneError) as error:
            read_mesh(str(tmp_path / name), (1, 1, 1))
        assert "hidden" not in str(error.value)


def test_no_file_is_read_that_nobody_named(tmp_path: Path) -> None:
    """However a name is written: a text without folders reads none, with folders one of theirs, links followed."""
    given, outside = tmp_path / "given", tmp_path / "outside"
    (given / "deep").mkdir(parents=True), outside.mkdir()  # type: ignore[func-returns-value]
    for folder in (given, given / "deep", outside):
        (folder / "m.stl").write_bytes(b"")
    (given / "link.stl").symlink_to(outside / "m.stl")
    draw, found = drawn("paths"), 0
    for _ in range(10 * DRAWS):
        parts = draw.choices(["..", ".", "deep", "outside", "given", str(outside), str(given), "link.stl", "m.stl", "", "\0"], k=draw.randint(1, 5))
        name = draw.choice(["", "file://", "package://", "/", "model://"]) + "/".join([*parts, draw.choice(["m.stl", "link.stl"])])
        assert find_file(name, None, []) is None
        for file in (None, str(given / "deep" / "r.urdf")):
            path = find_file(name, file, [given])
            assert path is None or os.path.realpath(path).startswith(f"{os.path.realpath(given)}/"), name
            found += path is not None
    assert found > 0
    mesh = '<collision><geometry><mesh filename="{}"/></geometry></collision>'
    for name in (str(outside / "m.stl"), f"file://{outside}/m.stl"):
        scene = load_urdf(robot(link("a", 1, (1, 1, 1), mesh.format(name))))
        assert [warning.kind for warning in scene.warnings] == ["mesh"] and not scene.meshes


# ---- the law of errors

ODD = [b"nan", b"-", b"1e999", b"1e-320", b"<link>", b"<body>", b"</body>", b'"', b"&lt;", b"0", b"\0", b"\xff", b"name", b"utf-7", b" ", b"9" * 30]


def mutated(draw: random.Random, data: bytes, words: List[bytes] = ODD) -> bytes:
    """Some bytes changed, lost, doubled, moved; words put in, or instead of a value."""
    made = bytearray(data)
    for _ in range(draw.choice([1, 1, 1, 2, 5])):
        at, what = draw.randrange(len(made) + 1), draw.randrange(6)
        if what == 0:
            made[at : at + 1] = bytes([draw.randrange(256)])
        elif what == 1:
            del made[at : at + draw.randint(1, 40)]
        elif what == 2:
            made[at:at] = made[at : at + draw.randint(1, 300)]
        elif what == 3:
            made[at:at] = draw.choice(words)
        elif what == 4 and made.find(b'"', at) >= 0:
            start = made.find(b'"', at)
            end = made.find(b'"', start + 1)
            made[start + 1 : max(end, start + 1)] = draw.choice(words)
        else:
            cut = made[at : at + draw.randint(1, 60)]
            del made[at : at + len(cut)]
            to = draw.randrange(len(made) + 1)
            made[to:to] = cut
    return bytes(made)


MODEL = """<mujoco model="m"><compiler angle="radian" settotalmass="3"/><option gravity="0 0 -9"/>
<default><geom density="700"/><default class="c"><joint damping="1"/></default></default>
<asset><mesh name="t" vertex="0 0 0 1 0 0 0 1 0 0 0 1" face="0 2 1 0 1 3 0 3 2 1 2 3"/></asset><worldbody><geom type="plane" size="1 1 1"/>
<replicate count="3" offset="1 0 0" euler="0 0 1"><body name="b" pos="0 0 1"><joint name="j" class="c" range="-1 1"/><joint name="k" axis="1 1 0"/>
<geom type="mesh" mesh="t"/><site name="s" pos="0 0 1"/><site name="f" fromto="0 0 0 0 0 1"/><body name="e" quat="1 1 0 0"><geom type="ellipsoid" size="0.1 0.2 0.3"/></body></body></replicate>
<body name="x" mocap="true"><geom size="0.1"/></body><composite type="cable" count="4" size="1" offset="0 0 3"><geom type="box" size="0.1 0.1 0.1"/></composite>
</worldbody><contact><exclude body1="b0" body2="b1"/></contact><equality><connect body1="b" anchor="0 0 0"/></equality>
<actuator><position joint="j" kp="3" ctrlrange="-1 1"/></actuator></mujoco>"""
ROBOT = robot(
    "<mujoco><compiler fusestatic='true' balanceinertia='true'/></mujoco>"
    + PAIR
    + link("c", 0.1, (0, 0, 1), '<collision><origin rpy="1 2 3"/><geometry><cylinder radius="0.1" length="1"/></geometry></collision>')
    + joint("k", "prismatic", "b", "c", '<dynamics damping="1" friction="2"/>')
    + '<link name="tool0"/>'
    + joint("t", "fixed", "c", "tool0")
)


def use(scene: Scene, is_built: bool) -> None:
    """All that is done with a scene; of its refusals nothing but a SceneError leaves."""
    for call in (scene.to_json, lambda: save_urdf(scene), lambda: save_mjcf(scene)):
        try:
            call()
        except SceneError:
            pass
    if is_built:
        with World() as world:
            scene.build(world)


CORNER = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
SIDES = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]


@pytest.mark.parametrize(
    "points, triangles",
    [
        (["a"] * 12, []),
        ([None] * 12, []),
        ([*CORNER[:11], math.nan], []),
        ([*CORNER[:11], math.inf], []),
        ([10**400, *CORNER[1:]], []),
        (CORNER[:4], []),
        ([], []),
        (CORNER, [0, 1]),
        (CORNER, [*SIDES[:11], 4]),
        (CORNER, [*SIDES[:11], -1]),
        (CORNER, [*SIDES[:11], 1.0]),
        (CORNER, [*SIDES[:11], "x"]),
    ],
)
def test_a_mesh_that_is_none_builds_nothing(points: List[Any], triangles: List[Any]) -> None:
    """A program may make a scene too: what is wrong in it is a SceneError, and nothing is left in the world."""
    body = SceneBody("b", "static", shapes=[SceneShape("mesh", [], mesh="m")])
    with World() as world:
        with pytest.raises(SceneError, match="of m: three"):
            Scene(bodies=[body], meshes=[SceneMesh("m", points, triangles)]).build(world)
        assert not world.bodies
        assert len(Scene(bodies=[body], meshes=[SceneMesh("m", CORNER, SIDES)]).build(world).bodies) == 1


def test_a_site_from_one_place_to_the_same_is_left_out() -> None:
    """Nothing depends on a site: one without a direction is an error when strict alone."""
    site = '<mujoco><worldbody><body name="b"><freejoint/><geom size="0.1"/><site name="s" fromto="0 0 0 0 0 {}"/></body></worldbody></mujoco>'
    assert [frame.name for frame in load_mjcf(site.format(1), strict=True).frames] == ["s"]
    assert load_mjcf(site.format(0)).frames == []
    with pytest.raises(SceneError, match="two places"):
        load_mjcf(site.format(0), strict=True)


@pytest.mark.parametrize("load, text", [(load_urdf, ROBOT), (load_mjcf, MODEL)])
def test_nothing_but_a_scene_error_leaves_a_reader(load: Callable[..., Scene], text: str) -> None:
    use(load(text), True)
    draw, taken = drawn(load.__name__), 0
    for case in range(10 * DRAWS):
        data = mutated(draw, text.encode())
        try:
            use(load(b"<" + data[1:], strict=draw.random() < 0.1), case % 10 == 0)
            taken += 1
        except SceneError as error:
            assert str(error)
    assert DRAWS // 10 < taken < 9 * DRAWS
    for name in ("utf-7", "foo", "utf-32", "idna", "unicode_escape", "rot13", "hex", "punycode", "undefined", ""):
        with pytest.raises(SceneError):
            load(f'<?xml version="1.0" encoding="{name}"?><x/>'.encode())
    with pytest.raises(SceneError):
        load("<robot name='\ud800'/>")


def paths_of(value: Any, path: Any = ()) -> Any:
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield (*path, key)
        yield from paths_of(inner, (*path, key))


WRONG = [None, True, -1, 0, 1e308, math.nan, math.inf, "x", "", [], {}, [1, 2], {"a": 1}, 10**400, "\ud800", [[[[]]]], 1e-320, 2**63, "dynamic", "chain"]


@pytest.mark.parametrize("load, text", [(load_urdf, ROBOT), (load_mjcf, MODEL)])
def test_nothing_but_a_scene_error_leaves_json(load: Callable[..., Scene], text: str) -> None:
    whole = load(text).to_json()
    places = list(paths_of(json.loads(whole)))
    draw = drawn("json")
    for _ in range(10 * DRAWS):
        record = json.loads(whole)
        for *way, last in draw.sample(places, draw.choice([1, 1, 2])):
            inner = record
            try:
                for key in way:
                    inner = inner[key]
                if draw.random() < 0.1 and isinstance(inner, dict):
                    del inner[last]
                else:
                    inner[last] = copy.deepcopy(draw.choice(WRONG))
            except (KeyError, IndexError, TypeError):
                pass  # the first change took the place of the second one away
        try:
            use(Scene.from_json(json.dumps(record)), True)
        except SceneError:
            pass
    for _ in range(DRAWS):
        try:
            use(Scene.from_json(mutated(draw, whole.encode()).decode("utf-8", "replace")), False)
        except SceneError:
            pass
    for wrong in ("[" * 100000, "", "\0", "[]", '{"format": "feather-scene"}', "1" * 5000):
        with pytest.raises(SceneError):
            Scene.from_json(wrong)
    with pytest.raises(VersionError):
        Scene.from_json('{"format": "feather-scene", "version": 2}')
    with pytest.raises(UnsupportedError):
        save_urdf(load_mjcf(MODEL))


def test_the_g1_weighs_each_mesh_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where inertials say the mass, no mesh is weighed; elsewhere each once."""
    import feather_physics.mjcf_geoms as geoms

    weighed: List[int] = []
    monkeypatch.setattr(geoms, "mass_of", lambda points, triangles: weighed.append(1) or mass_of(points, triangles))
    asset = '<asset><mesh name="t" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset>'
    geom = '<geom type="mesh" mesh="t"/>'
    bodies = "".join(f'<body><freejoint/>{geom * 3}</body>' for _ in range(5))
    load_mjcf(model(bodies + geom, asset))
    assert len(weighed) == 1
    load_mjcf(model(f'<body><freejoint/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>{geom}</body>', asset))
    assert len(weighed) == 1 and (ROOT / "tests/robots/referee.c").exists()
