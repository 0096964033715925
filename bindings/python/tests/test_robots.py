"""Scenes and URDF: read as MuJoCo reads it, written and read again, refused with file, line and element."""

import json
import math
import random
from pathlib import Path
from typing import Any, Callable, Dict

import numpy as np
import pytest
from conftest import ROOT
from robots import compare_bodies, near, plain

from feather_physics import FeatherError, InvalidArgumentError, UnsupportedError, VersionError, World
from feather_physics.frames import angles_of, matrix_of, multiply, normalized, principal, rotate, turn_of
from feather_physics.scene import Scene, SceneBody, SceneJoint, SceneShape
from feather_physics.urdf import load_urdf, save_urdf

ARM = ROOT / "examples/python/arm.urdf"


# ---- numbers


def test_principal_axes_give_the_matrix_again() -> None:
    draw = random.Random(1)
    for case in range(300):
        q = normalized([draw.gauss(0, 1) for _ in range(4)])
        moments = [draw.uniform(1, 2) * 10.0 ** (case % 7 - 3) for _ in range(3)]
        if case % 5 == 0:
            moments[1] = moments[0]
        wanted = matrix_of(moments, q)
        found, turn = principal(wanted)
        assert np.allclose(matrix_of(found, turn), wanted, rtol=0, atol=1e-13 * max(moments))
        assert np.allclose(sorted(found), sorted(moments), rtol=1e-12)
    assert principal([[3, 0, 0], [0, 2, 0], [0, 0, 1]]) == ((3, 2, 1), (0, 0, 0, 1))


def test_angles_give_the_turn_again() -> None:
    draw = random.Random(2)
    for case in range(300):
        rpy = [draw.uniform(-math.pi, math.pi), draw.uniform(-1.5, 1.5), draw.uniform(-math.pi, math.pi)]
        if case % 4 == 0:
            rpy[1] = math.copysign(math.pi / 2, draw.uniform(-1, 1))
        q = turn_of(*rpy)
        again = turn_of(*angles_of(q))
        assert abs(abs(sum(a * b for a, b in zip(q, again))) - 1) < 1e-12
    # about z by a quarter turn, then about fixed x: roll last in the product, as ROS has it
    assert np.allclose(rotate(turn_of(0, 0, math.pi / 2), (1, 0, 0)), (0, 1, 0))
    assert np.allclose(multiply(turn_of(0, 0, 0.3), turn_of(0.2, 0, 0)), turn_of(0.2, 0, 0.3))


# ---- robots of our own


def vector(draw: random.Random, size: float) -> str:
    return " ".join(f"{draw.uniform(-size, size):.6f}" for _ in range(3))


def random_link(draw: random.Random, name: str) -> str:
    q = normalized([draw.gauss(0, 1) for _ in range(4)])
    a, b = draw.uniform(0.01, 0.2), draw.uniform(0.01, 0.2)
    m = matrix_of((a, b, draw.uniform(abs(a - b) + 1e-3, a + b)), q)
    tensor = " ".join(f'{k}="{m[i][j]:.15g}"' for k, i, j in (
        ("ixx", 0, 0), ("ixy", 0, 1), ("ixz", 0, 2), ("iyy", 1, 1), ("iyz", 1, 2), ("izz", 2, 2)))
    form = draw.choice(
        ['<box size="0.1 0.2 0.3"/>', '<sphere radius="0.1"/>', '<cylinder radius="0.05" length="0.4"/>'])
    return (
        f'<link name="{name}"><inertial><origin xyz="{vector(draw, 0.3)}" rpy="{vector(draw, 3)}"/>'
        f'<mass value="{draw.uniform(0.1, 5):.6f}"/><inertia {tensor}/></inertial>'
        f'<visual><geometry><sphere radius="1"/></geometry></visual>'
        f'<collision><origin xyz="{vector(draw, 0.1)}" rpy="{vector(draw, 3)}"/><geometry>{form}</geometry></collision>'
        "</link>\n"
    )


def random_robot(seed: int) -> str:
    draw = random.Random(seed)
    count = draw.randint(2, 20)
    text = f'<robot name="robot{seed}">\n<link name="base"/>\n'
    text += "".join(random_link(draw, f"link{i}") for i in range(1, count))
    for i in range(1, count):
        parent = "base" if i == 1 else f"link{draw.randint(max(1, i - 3), i - 1)}"
        kind = draw.choice(["fixed", "revolute", "continuous", "prismatic"])
        text += f'<joint name="joint{i}" type="{kind}"><parent link="{parent}"/><child link="link{i}"/>'
        text += f'<origin xyz="{vector(draw, 0.5)}" rpy="{vector(draw, 3)}"/>'
        if kind != "fixed":
            text += f'<axis xyz="{vector(draw, 1)}"/>'
            text += f'<dynamics damping="{draw.uniform(0, 1):.6f}" friction="{draw.uniform(0, 1):.6f}"/>'
        if kind in ("revolute", "prismatic"):
            text += f'<limit lower="{draw.uniform(-2, 0):.6f}" upper="{draw.uniform(0, 2):.6f}" effort="9" velocity="2"/>'
        text += "</joint>\n"
    return text + "</robot>\n"


PENDULUM = """<robot name="pendulum">
<link name="base"/>
<link name="upper"><inertial><origin xyz="0.25 0 0"/><mass value="1.5"/>
  <inertia ixx="0.004" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.03"/></inertial></link>
<link name="lower"><inertial><origin xyz="0.2 0 0"/><mass value="1"/>
  <inertia ixx="0.003" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial></link>
<joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/></joint>
<joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="0.5 0 0"/>
  <axis xyz="0 1 0"/><dynamics damping="0.05"/></joint>
</robot>
"""


def test_robots_are_read_as_mujoco_reads_them(referee: Callable[..., Any]) -> None:
    texts = [random_robot(seed) for seed in range(30)] + [PENDULUM, ARM.read_text()]
    bodies = joints = 0
    for text, wanted in zip(texts, referee(texts)):
        scene = load_urdf(text, fixed_base=True)
        mine = {body.name: body for body in scene.bodies}
        assert set(mine) == {body["name"] for body in wanted["bodies"]}
        bodies += compare_bodies(mine, wanted["bodies"])
        moving = {joint.name: joint for joint in scene.joints if joint.type != "fixed"}
        assert set(moving) == {joint["name"] for joint in wanted["joints"]}
        for theirs in wanted["joints"]:
            joint = moving[theirs["name"]]
            joints += 1
            assert joint.type == {2: "slider", 3: "hinge"}[theirs["type"]]
            assert np.allclose(joint.position, theirs["position"], rtol=0, atol=1e-5)
            assert np.allclose(joint.axis, theirs["axis"], rtol=0, atol=1e-5)
            assert (joint.lower is not None) == bool(theirs["limited"])
            if joint.lower is not None:
                assert np.allclose((joint.lower, joint.upper), theirs["range"], rtol=0, atol=1e-9)
            assert abs(joint.damping - theirs["damping"]) < 1e-9 and abs(joint.friction - theirs["friction"]) < 1e-9
    assert bodies > 200 and joints > 150


def test_a_double_pendulum_falls_as_mujoco_s_does(referee: Callable[..., Any]) -> None:
    wanted = referee([PENDULUM], "1.0")[0]["after"]
    with World(gravity=(0, 0, -9.81), substeps=64) as world:
        built = load_urdf(PENDULUM).build(world)
        for _ in range(100):
            world.step(0.01)
        found = [built.joints[name].state.angle for name in ("shoulder", "elbow")]
    assert np.abs(np.subtract(found, wanted)).max() < math.radians(0.5), (found, wanted)


# ---- worlds


def test_a_robot_is_built_where_it_is_asked_for() -> None:
    scene = load_urdf(ARM)
    q = turn_of(-math.pi / 2, 0, 0.4)
    with World(gravity=(0, 0, 0)) as world:
        first = scene.build(world, group=-1)
        other = scene.build(world, (5, 1, 2), q, group=-1)
        for body in scene.bodies:
            place = np.add((5, 1, 2), rotate(q, body.position))
            assert np.allclose(other.bodies[body.name].position, place, rtol=0, atol=1e-6)
            if body.mass is not None and body.type == "dynamic":
                data = first.bodies[body.name].mass_data
                assert abs(data.mass - body.mass) < 1e-6 and np.allclose(data.centre, body.centre, atol=1e-6)
        assert len(first.joints) == len([j for j in scene.joints if j.type != "free"])
        before = [body.position for body in first.bodies.values()]
        for _ in range(60):
            world.step()
        after = [body.position for body in first.bodies.values()]
        assert np.allclose(before, after, rtol=0, atol=1e-4)  # nothing pulls: frames and limits fit


def test_what_cannot_be_built_leaves_nothing() -> None:
    scene = load_urdf(ARM)
    scene.joints[-1].b = "nobody"
    with World() as world:
        with pytest.raises(InvalidArgumentError, match="nobody"):
            scene.build(world)
        assert world.counters.bodies == 0 and world.counters.joints == 0
        scene.joints[-1] = SceneJoint("x", "rack", None, scene.bodies[0].name, (0, 0, 0))
        with pytest.raises(InvalidArgumentError, match="rack"):
            scene.build(world)
        scene.bodies[-1].shapes.append(SceneShape("egg", [1]))
        with pytest.raises(InvalidArgumentError, match="egg"):
            scene.build(world)
        assert world.counters.bodies == 0


@pytest.mark.parametrize("kind, moves", [("planar", True), ("floating", True), ("fixed", False)])
def test_other_joints(kind: str, moves: bool) -> None:
    text = PENDULUM.replace('name="shoulder" type="continuous"', f'name="shoulder" type="{kind}"')
    with World(gravity=(1, 0, 0)) as world:
        built = load_urdf(text).build(world)
        for _ in range(30):
            world.step()
        x, y, z = built.bodies["upper"].position
        assert (x > 0.05) == moves and abs(y) < 1e-3
        assert set(built.joints) == ({"elbow"} if kind == "floating" else {"shoulder", "elbow"})


# ---- writing, JSON


def test_written_robots_are_read_again() -> None:
    for text in [random_robot(seed) for seed in range(30, 60)] + [PENDULUM, ARM.read_text()]:
        scene = load_urdf(text)
        assert near(plain(scene), plain(load_urdf(save_urdf(scene))))


def test_json_is_exact() -> None:
    for text in (random_robot(7), PENDULUM, ARM.read_text()):
        scene = load_urdf(text)
        again = Scene.from_json(scene.to_json())
        assert again.to_json() == scene.to_json() and again.bodies == scene.bodies and again.joints == scene.joints


@pytest.mark.parametrize("change, told", [
    (lambda r: r.update(format="other"), "no scene"),
    (lambda r: r.update(bodies=5), "bodies"),
    (lambda r: r["bodies"][0].update(mas=1), "mas"),
    (lambda r: r["bodies"][0].update(mass="1"), "mass"),
    (lambda r: r["bodies"][0].update(position=[1, 2]), "position"),
    (lambda r: r["bodies"][0].update(name=None), "name"),
    (lambda r: r["bodies"][0].update(shapes=[{"form": "box"}]), "size"),
    (lambda r: r["joints"][0].update(damping=None), "damping"),
    (lambda r: r["joints"][0].pop("b"), "'b'"),
    (lambda r: r["joints"].append(3), "joints"),
])
def test_bad_json_is_named(change: Callable[[Any], Any], told: str) -> None:
    record = json.loads(load_urdf(PENDULUM).to_json())
    change(record)
    with pytest.raises(InvalidArgumentError, match=told):
        Scene.from_json(json.dumps(record))
    with pytest.raises(InvalidArgumentError):
        Scene.from_json("{")
    with pytest.raises(VersionError):
        Scene.from_json('{"format": "feather-scene", "version": 2}')


def test_what_urdf_has_not() -> None:
    body = SceneBody("a", mass=1.0, inertia=(1, 1, 1))
    with pytest.raises(UnsupportedError, match="world"):
        save_urdf(Scene(bodies=[body], joints=[SceneJoint("j", "hinge", None, "a", (0, 0, 0))]))
    both = [body, SceneBody("b", position=(1, 0, 0), mass=1.0, inertia=(1, 1, 1))]
    for joint, told in (
        (SceneJoint("j", "hinge", "a", "b", (0.5, 0, 0)), "origin"),
        (SceneJoint("j", "slider", "a", "b", (1, 0, 0)), "limits"),
        (SceneJoint("j", "ball", "a", "b", (1, 0, 0)), "ball"),
    ):
        with pytest.raises(UnsupportedError, match=told):
            save_urdf(Scene(bodies=both, joints=[joint]))


# ---- what is refused

LINK = '<link name="{}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>'
TWO = LINK.format("a") + LINK.format("b")
JOINT = '<joint name="j" type="revolute"><parent link="a"/><child link="b"/><limit lower="-1" upper="1"/></joint>'


@pytest.mark.parametrize("body, told", [
    ("<link/>", "name is missing"),
    (LINK.format("a").replace('"1"/>', '"-1"/>', 1), "not negative"),
    (LINK.format("a").replace('value="1"', 'value="one"'), "1 finite numbers"),
    (LINK.format("a").replace('value="1"', 'value="nan"'), "finite"),
    (LINK.format("a").replace("<mass value=\"1\"/>", ""), "mass and inertia"),
    (LINK.format("a") * 2, "second link"),
    (TWO, "one link without a parent"),
    (TWO + JOINT * 2, "two parents"),
    (TWO + LINK.format("c") + JOINT + JOINT.replace('link="b"', 'link="c"'), "second joint"),
    (TWO + JOINT.replace('link="b"', 'link="z"'), "no link 'z'"),
    (TWO + JOINT.replace("revolute", "screw"), "'screw'"),
    (TWO + JOINT.replace('<limit lower="-1" upper="1"/>', ""), "limit is needed"),
    (TWO + JOINT.replace("<limit", '<axis xyz="0 0 0"/><limit'), "direction"),
    (TWO + JOINT.replace("<limit", '<dynamics damping="-1"/><limit'), "negative"),
    (TWO + JOINT.replace("<limit", '<origin xyz="1 2"/><limit'), "3 finite numbers"),
    (LINK.format("a") + '<link name="b"/>' + JOINT, "no inertial"),
    ('<link name="a"><collision/></link>', "one form"),
    ('<link name="a"><collision><geometry><box size="1 0 1"/></geometry></collision></link>', "more than 0"),
    ('<link name="a"><collision><geometry><sphere radius="-1"/></geometry></collision></link>', "more than 0"),
])
def test_what_is_wrong_is_named_with_its_line(body: str, told: str, tmp_path: Path) -> None:
    path = tmp_path / "wrong.urdf"
    path.write_text(f'<robot name="r">\n{body}\n</robot>')
    with pytest.raises(InvalidArgumentError, match=told) as error:
        load_urdf(path)
    assert f"{path}:" in str(error.value)


def test_what_is_no_robot() -> None:
    for text, told in (
        ("<robot", "unclosed|no element"), ("<html></html>", "<robot>"), ("<a>" * 300, "deeper"),
        ('<!DOCTYPE x [<!ENTITY a "b">]><robot/>', "document type"), (b"\xff\xfe\x00", "urdf:1"),
        (b"<robot>" + b" " * (17 << 20), "are the most"),
    ):
        with pytest.raises(InvalidArgumentError, match=told):
            load_urdf(text)
    with pytest.raises(FileNotFoundError):
        load_urdf("no/such.urdf")
    with pytest.raises(InvalidArgumentError, match="inertia"):
        load_urdf(PENDULUM, inertia="guess")


def test_what_is_not_exact_is_a_warning_or_an_error() -> None:
    extras = (
        "<transmission/>" + TWO.replace("</link>", '<collision><geometry><mesh filename="m.stl"/></geometry></collision></link>', 1)
        + JOINT.replace('"1"/></joint>', '"7"/></joint>')
    )
    scene = load_urdf(f"<robot>{extras}</robot>")
    assert [(kind, sentence.split(":")[0]) for _, _, kind, sentence in scene.warnings] == [
        ("element", "<transmission>"), ("limit", "<limit>"), ("mesh", "<mesh>"),
    ]
    assert scene.joints[0].lower is None and scene.bodies[0].shapes == []
    with pytest.raises(InvalidArgumentError, match="transmission"):
        load_urdf(f"<robot>{extras}</robot>", strict=True)
    ball = '<robot><link name="a"><collision><geometry><sphere radius="0.5"/></geometry></collision></link></robot>'
    assert load_urdf(ball).bodies[0].type == "static"
    with World() as world:
        body = load_urdf(ball, inertia="from_shapes").build(world).bodies["a"]
        assert abs(body.mass - 1000 * math.pi / 6) < 0.1


def test_broken_files_never_crash() -> None:
    draw, texts = random.Random(3), [PENDULUM, ARM.read_text(), random_robot(3)]
    taken = 0
    for case in range(3000):
        data = bytearray(texts[case % 3].encode())
        for _ in range(draw.randint(1, 4)):
            at = draw.randrange(len(data))
            what = draw.randrange(4)
            if what == 0:
                data[at] = draw.randrange(256)
            elif what == 1:
                del data[at : at + draw.randint(1, 30)]
            elif what == 2:
                data[at:at] = data[at : at + draw.randint(1, 200)]
            else:
                data[at:at] = draw.choice([b"nan", b"-", b"1e999", b"<link>", b'"', b"&lt;", b"0"])
        try:
            scene = load_urdf(bytes(data))
            if case % 20 == 0:
                with World() as world:
                    scene.build(world)
                    world.step()
            taken += 1
        except FeatherError:
            pass
    assert 30 < taken < 2970
