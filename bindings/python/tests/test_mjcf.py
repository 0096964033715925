"""MJCF: read as MuJoCo reads it, written and read again, refused with file, line and element."""

import math
import random
from pathlib import Path
from typing import Any, Callable, Dict, List, Tuple

import numpy as np
import pytest
from robots import compare_bodies, near, plain

from feather_physics import FeatherError, InvalidArgumentError, SceneError, UnsupportedError, World
from feather_physics.frames import Y_TO_Z, about, multiply, normalized, of_axes, rotate
from feather_physics.mjcf import load_mjcf, save_mjcf
from feather_physics.scene import Scene, SceneBody, SceneFreedom, SceneJoint
from feather_physics.urdf import load_urdf

SAMPLES = Path("/usr/share/mujoco/model")  # Debian's libmujoco-samples

# ---- models of our own


def numbers(draw: random.Random, count: int, size: float) -> str:
    return " ".join(f"{draw.uniform(-size, size):.6f}" for _ in range(count))


def random_turn(draw: random.Random) -> str:
    return draw.choice(
        [
            "",
            f'quat="{numbers(draw, 4, 1)}"',
            f'euler="{numbers(draw, 3, 3)}"',
            f'axisangle="{numbers(draw, 4, 2)}"',
            f'xyaxes="{numbers(draw, 6, 1)}"',
            f'zaxis="{numbers(draw, 3, 1)}"',
        ]
    )


def random_geom(draw: random.Random) -> str:
    kind = draw.choice(["sphere", "capsule", "cylinder", "box", "ellipsoid"])
    size = " ".join(
        f"{draw.uniform(0.05, 0.3):.6f}" for _ in range({"sphere": 1, "capsule": 2, "cylinder": 2}.get(kind, 3))
    )
    weight = draw.choice(
        ["", f'mass="{draw.uniform(0.1, 3):.6f}"', f'density="{draw.uniform(10, 3000):.6f}"', 'class="light"']
    )
    if kind != "sphere" and draw.random() < 0.3:
        return f'<geom type="{kind}" fromto="{numbers(draw, 6, 0.5)}" size="{size.split()[0]}" {weight}/>'
    return f'<geom type="{kind}" size="{size}" pos="{numbers(draw, 3, 0.3)}" {random_turn(draw)} {weight}/>'


def random_joints(draw: random.Random, name: str) -> str:
    pos = numbers(draw, 3, 0.1)
    spring = draw.choice(["", f'stiffness="{draw.uniform(0, 9):.6f}" springref="{draw.uniform(-20, 20):.6f}" ref="5"'])
    settings = f'pos="{pos}" damping="{draw.uniform(0, 1):.6f}" {spring} armature="0.001"'
    a, b = of_axes([draw.gauss(0, 1) for _ in range(3)], [draw.gauss(0, 1) for _ in range(3)]), "xyz"
    square = [" ".join(map(repr, rotate(a, [float(letter == other) for other in b]))) for letter in b]
    limits = 'limited="true" range="-50 70"'
    one = f'<joint name="{name}" axis="{numbers(draw, 3, 1)}" {settings} {draw.choice(["", limits, "class=" + chr(34) + "slides" + chr(34)])}/>'
    two = f'<joint name="{name}" axis="{square[0]}" {settings} {limits}/><joint name="{name}b" axis="{square[2]}" {settings}/>'
    three = two + f'<joint name="{name}c" axis="{square[1]}" {settings} {limits}/>'
    plane = f'<joint name="{name}" type="slide" axis="{square[0]}" {settings}/><joint name="{name}b" axis="{square[1]}" {settings}/>'
    ball = f'<joint name="{name}" type="ball" pos="{pos}" damping="0.5"/>'
    return draw.choice([one, one, one, two, three, plane, ball, ""])


def random_model(seed: int) -> str:
    draw = random.Random(seed)
    count = 0

    def body(depth: int) -> str:
        nonlocal count
        count += 1
        name = f"b{count}"
        hung = (
            random_joints(draw, f"j{count}")
            if depth
            else draw.choice(["<freejoint/>", random_joints(draw, f"j{count}"), ""])
        )
        inertial = (
            f'<inertial pos="{numbers(draw, 3, 0.2)}" {random_turn(draw)} mass="2" diaginertia="0.03 0.04 0.05"/>'
        )
        inner = (
            hung
            + "".join(random_geom(draw) for _ in range(draw.randint(1, 3)))
            + (inertial if draw.random() < 0.3 else "")
        )
        inner += "".join(body(depth + 1) for _ in range(draw.randint(0, 2 if depth < 3 else 0)))
        return f'<body name="{name}" pos="{numbers(draw, 3, 0.5)}" {random_turn(draw)}>\n{inner}</body>\n'

    angle = draw.choice(["degree", "radian"])
    sequence = draw.choice(["xyz", "zyx", "XYZ", "zxZ"])
    return f"""<mujoco model="m{seed}"><compiler angle="{angle}" eulerseq="{sequence}" autolimits="true"/>
<option gravity="0 1 -9"/>
<default><geom density="700" friction="0.8 0.1 0.1"/>
 <default class="light"><geom density="50"/></default>
 <default class="slides"><joint type="slide" frictionloss="0.5"/></default></default>
<worldbody><geom type="plane" size="1 1 1"/>
{"".join(body(0) for _ in range(draw.randint(1, 3)))}</worldbody></mujoco>"""


PENDULUM = """<mujoco><option gravity="0 0 -9.81"/><compiler angle="radian"/><worldbody>
<body name="upper" pos="0 0 1"><joint name="shoulder" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.03"/>
<body name="lower" pos="0.5 0 0"><joint name="elbow" axis="0 1 0" damping="0.05" stiffness="3" springref="0.7"/>
<geom type="capsule" fromto="0 0 0 0.4 0 0" size="0.02"/></body></body></worldbody></mujoco>"""

# ---- beside MuJoCo


def freedoms_of(scene: Scene) -> Dict[str, Tuple[SceneJoint, Any, Any]]:
    """By name: the joint, what moves, and its axis in the world, None: a ball."""
    found: Dict[str, Tuple[SceneJoint, Any, Any]] = {}
    for joint in scene.joints:
        if joint.type in ("hinge", "slider", "ball"):
            found[joint.name] = joint, joint, None if joint.type == "ball" else joint.axis
        for one in joint.freedoms:
            found[one.name] = joint, one, rotate(joint.rotation, [float(one.axis[-1] == letter) for letter in "xyz"])
    return found


def compare_joints(scene: Scene, wanted: List[Any]) -> int:
    mine = freedoms_of(scene)
    moving = [joint for joint in wanted if joint["type"] != 0]  # mjJNT_FREE
    assert {joint["name"] for joint in moving} == set(mine)
    for theirs in moving:
        joint, one, axis = mine[theirs["name"]]
        assert math.isclose(one.damping, theirs["damping"], abs_tol=1e-9)
        assert math.isclose(one.friction, theirs["friction"], abs_tol=1e-9)
        assert math.isclose(one.stiffness, theirs["stiffness"], abs_tol=1e-9)
        if axis is None:
            continue
        assert math.isclose(one.armature, theirs["armature"], abs_tol=1e-9)
        sign = np.dot(axis, theirs["axis"])
        assert abs(abs(sign) - 1) < 1e-5, (joint.name, axis, theirs["axis"])
        assert sign > 0 or joint.freedoms
        if joint.name == theirs["name"]:
            assert np.allclose(joint.position, theirs["position"], rtol=0, atol=1e-5)
        limits = sorted(math.copysign(1, sign) * (x - theirs["start"]) for x in theirs["range"])
        has_limits = theirs["limited"] and (one.lower is not None or max(map(abs, limits)) <= math.pi)
        assert (one.lower is not None) == bool(has_limits)
        if one.lower is not None:
            assert np.allclose((one.lower, one.upper), limits, rtol=0, atol=1e-6)
        if one.stiffness:
            assert abs(one.rest - math.copysign(1, sign) * (theirs["rest"] - theirs["start"])) < 1e-6
    return len(moving)


def test_models_are_read_as_mujoco_reads_them(referee: Callable[..., Any]) -> None:
    texts = [random_model(seed) for seed in range(60)]
    bodies = joints = 0
    for text, wanted in zip(texts, referee(texts)):
        scene = load_mjcf(text)
        mine = {body.name: body for body in scene.bodies}
        assert set(mine) - {"world"} == {body["name"] for body in wanted["bodies"]}
        bodies += compare_bodies(mine, wanted["bodies"])
        joints += compare_joints(scene, wanted["joints"])
        assert scene.gravity == tuple(wanted["gravity"])
    assert bodies > 200 and joints > 200


# of Debian's: with what each must say that it leaves out
FILES = {
    "humanoid/humanoid.xml": "moved by 0.04",
    "humanoid100/humanoid100.xml": "several hinges",
    "humanoid/22_humanoids.xml": "several hinges",
    "slider_crank/slider_crank.xml": "position",
    "tendon_arm/arm26.xml": "muscle",
    "composite/scene.xml": "",
}


@pytest.mark.parametrize("file", FILES)
def test_files_of_mujoco(referee: Callable[..., Any], file: str) -> None:
    if not SAMPLES.exists():
        pytest.skip("NOT TESTED: the files of libmujoco-samples")
    scene = load_mjcf(SAMPLES / file)
    assert FILES[file] in "\n".join(map(str, scene.warnings))
    wanted = referee([SAMPLES / file])[0]
    bodies = [body for body in scene.bodies if body.name != "world"]
    assert len(bodies) == len(wanted["bodies"])
    for body, theirs in zip(bodies, wanted["bodies"]):  # in the order of the file; many have no name there
        assert theirs["name"] in (body.name, "(null)")
        theirs["name"] = body.name
    compare_bodies({body.name: body for body in bodies}, wanted["bodies"])
    assert near(plain(scene), plain(load_mjcf(save_mjcf(scene))))
    with World(gravity=scene.gravity) as world:
        built = scene.build(world)
        for _ in range(120):
            world.step()
        assert len(built.bodies) == len(scene.bodies) and math.isfinite(world.energy().kinetic)


def test_a_double_pendulum_falls_as_mujoco_s_does(referee: Callable[..., Any]) -> None:
    wanted = referee([PENDULUM], "1.0")[0]["after"]
    with World(gravity=(0, 0, -9.81), substeps=64) as world:
        built = load_mjcf(PENDULUM).build(world)
        for _ in range(100):
            world.step(0.01)
        found = [built.joints[name].state.angle for name in ("shoulder", "elbow")]
    assert np.abs(np.subtract(found, wanted)).max() < math.radians(0.5), (found, wanted)


def test_two_hinges_of_a_body_hang_as_in_mujoco(referee: Callable[..., Any]) -> None:
    """Springs hold it: the angles are small, and those of one joint as of two."""
    text = """<mujoco><compiler angle="radian"/><option gravity="1 2 -9.81"/><worldbody><body name="b" pos="0 0 1">
    <joint name="p" axis="0 -1 0" stiffness="20" damping="4" springref="0.05"/>
    <joint name="q" axis="1 0 0" stiffness="15" damping="4" limited="true" range="-0.1 1"/>
    <geom type="box" size="0.05 0.05 0.2" pos="0 0 -0.3" mass="2"/></body></worldbody></mujoco>"""
    p, q = referee([text], "8.0")[0]["after"]
    wanted = multiply(about((0, -1, 0), p), about((1, 0, 0), q))
    assert 0.02 < abs(p) < 0.3 and 0.02 < abs(q) < 0.3, (p, q)
    with World(gravity=(1, 2, -9.81)) as world:
        built = load_mjcf(text).build(world)
        for _ in range(480):
            world.step()
        turn = built.bodies["b"].rotation
    assert 2 * math.acos(min(1, abs(np.dot(turn, wanted)))) < math.radians(0.5)


# ---- written and read again


def test_written_models_are_read_again() -> None:
    for seed in range(100, 160):
        scene = load_mjcf(random_model(seed))
        text = save_mjcf(scene)
        again = load_mjcf(text)
        assert near(plain(scene), plain(again))
        assert near(plain(again), plain(load_mjcf(save_mjcf(again))))
        assert Scene.from_json(scene.to_json()).to_json() == scene.to_json()


def test_a_robot_of_ros_becomes_a_model() -> None:
    scene = load_urdf(Path(__file__).resolve().parents[3] / "examples/python/arm.urdf", fixed_base=True)
    again = load_mjcf(save_mjcf(scene))
    a, b = plain(scene), plain(again)
    for one, other in zip(a["bodies"], b["bodies"]):
        for shape in one["shapes"]:
            shape["friction"] = 1.0  # MuJoCo's
        assert near(one, other)
    assert [joint["position"] for joint in a["joints"]] == [joint["position"] for joint in b["joints"]]


def test_what_mjcf_has_not() -> None:
    body = SceneBody("a", mass=1.0, inertia=(1, 1, 1))
    for scene, told in (
        (Scene(bodies=[SceneBody("a")]), "mass"),
        (Scene(bodies=[SceneBody("a", "kinematic")], joints=[SceneJoint("j", "hinge", None, "a", (0, 0, 0))]), "kinematic"),
        (Scene(bodies=[body], joints=[SceneJoint("j", "planar", None, "a", (0, 0, 0))]), "planar"),
        (Scene(bodies=[body], joints=[SceneJoint(name, "hinge", None, "a", (0, 0, 0)) for name in "jk"]), "loops"),
    ):
        with pytest.raises(UnsupportedError, match=told):
            save_mjcf(scene)


# ---- what a model says


def model(body: str, rest: str = "") -> str:
    return f'<mujoco><compiler angle="radian"/>{rest}<worldbody>\n{body}\n</worldbody></mujoco>'


BALL = '<body name="a"><freejoint/><geom size="0.1"/></body><body name="b" pos="1 0 0"><freejoint/><geom size="0.1"/></body>'


def test_loops_exclusions_and_actuators() -> None:
    arm = '<body name="c"><joint name="k" axis="0 0 1"/><geom size="0.1"/></body>'
    text = model(
        BALL + arm,
        """<default><motor gear="3"/></default>
    <contact><exclude body1="a" body2="b"/></contact>
    <equality><connect body1="a" body2="b" anchor="0.5 0 0"/><weld body1="b"/><connect body1="a" anchor="0 0 0" active="false"/></equality>
    <actuator><motor joint="k" ctrlrange="-1 1"/><position name="p" joint="k" kp="7" forcerange="-2 2"/><motor tendon="t"/></actuator>""",
    )
    scene = load_mjcf(text)
    assert scene.excluded == [("a", "b")]
    assert [(j.type, j.a, j.b, j.position) for j in scene.joints if j.name.startswith("eq")] == [
        ("ball", "b", "a", (0.5, 0.0, 0.0)),
        ("fixed", None, "b", (1.0, 0.0, 0.0)),
    ]
    motor, position = scene.actuators
    assert (motor.gear, motor.lower, motor.upper, motor.force_lower) == (3.0, -1.0, 1.0, None)
    assert (position.name, position.gain, position.lower, position.force_upper) == ("p", 7.0, None, 2.0)
    assert len(scene.warnings) == 2 and near(plain(scene), plain(load_mjcf(save_mjcf(scene))))
    with World() as world:
        built = scene.build(world)
        assert world.is_ignored(built.bodies["a"], built.bodies["b"])


def test_classes_frames_and_included_files(tmp_path: Path) -> None:
    (tmp_path / "arm.xml").write_text(
        '<mujocoinclude><body name="a"><freejoint/><geom class="big"/></body></mujocoinclude>'
    )
    (tmp_path / "all.xml").write_text(
        model(
            '<frame pos="0 0 1"><include file="arm.xml"/></frame>',
            '<default><geom size="0.1"/><default class="big"><geom size="0.5" friction="0.3"/></default></default>',
        )
    )
    body = load_mjcf(tmp_path / "all.xml").bodies[0]
    assert body.position == (0.0, 0.0, 1.0) and body.shapes[0].size == [0.5] and body.shapes[0].friction == 0.3
    with pytest.raises(InvalidArgumentError, match="a text includes no files"):
        load_mjcf((tmp_path / "all.xml").read_text())
    (tmp_path / "arm.xml").write_text('<mujocoinclude><include file="arm.xml"/></mujocoinclude>')
    with pytest.raises(InvalidArgumentError, match="100 files"):
        load_mjcf(tmp_path / "all.xml")


def test_a_massless_body_is_a_part_of_what_it_hangs_on() -> None:
    scene = load_mjcf(
        model(
            '<body name="a"><freejoint/><geom size="0.1"/>'
            '<body name="tip" pos="1 0 0"><geom size="0.1" mass="0"/><body name="c" pos="1 0 0"><geom size="0.1"/></body></body></body>'
        )
    )
    assert [body.name for body in scene.bodies] == ["a", "c"] and scene.bodies[1].position == (2.0, 0.0, 0.0)
    assert [shape.position for shape in scene.bodies[0].shapes] == [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)]
    assert [(joint.type, joint.a, joint.b) for joint in scene.joints][1:] == [("fixed", "a", "c")]


def test_what_meets_nothing_counts_for_the_mass() -> None:
    scene = load_mjcf(
        model('<body name="a"><freejoint/><geom type="box" size="1 1 1" contype="0" conaffinity="0"/></body>')
    )
    assert scene.bodies[0].shapes == [] and scene.bodies[0].mass == 8000.0
    plane = load_mjcf(model('<geom type="plane" size="1 1 1" zaxis="1 0 0"/>' + BALL)).bodies[0]
    up = rotate(plane.shapes[0].rotation, (0, 1, 0))
    assert plane.name == "world" and np.allclose(up, (1, 0, 0), atol=1e-12)
    assert np.allclose(rotate(Y_TO_Z, (0, 1, 0)), (0, 0, 1))


@pytest.mark.parametrize(
    "body, told",
    [
        ("<body><joint/></body>", "moves and has no mass"),
        ('<body name="a"/><body name="a"/>', "second body"),
        ('<body><freejoint/><geom size="-1"/></body>', "more than 0"),
        ('<body><freejoint/><geom type="box" size="1"/></body>', "3 finite numbers"),
        ('<body><freejoint/><geom type="egg" size="1"/></body>', "'egg'"),
        ('<body><freejoint/><geom size="1" class="none"/></body>', "no class 'none'"),
        ('<body><freejoint/><geom size="1" mass="-1"/></body>', "not negative"),
        ('<body><freejoint/><geom size="1" friction="-1"/></body>', "not negative"),
        ('<body><freejoint/><geom type="capsule" fromto="0 0 0 0 0 0" size="1"/></body>', "two places"),
        ('<body><freejoint/><geom size="1"/><geom type="plane" size="1 1 1"/></body>', "has a plane"),
        ('<body><joint/><freejoint/><geom size="1"/></body>', "only one"),
        ('<body><joint axis="0 0 0"/><geom size="1"/></body>', "direction"),
        ('<body><joint range="1 0"/><geom size="1"/></body>', "above"),
        ('<body><joint limited="true"/><geom size="1"/></body>', "range is missing"),
        ('<body><joint damping="-1"/><geom size="1"/></body>', "not negative"),
        ('<body quat="1 0 0 0" euler="0 0 0"/>', "one rotation"),
        ('<body quat="0 0 0 0"/>', "direction"),
        ('<body xyaxes="1 0 0 1 0 0"/>', "two directions"),
        ('<body><freejoint/><inertial mass="1" diaginertia="1 1 3"/></body>', "no body has the moments"),
        ('<body><freejoint/><inertial mass="1"/></body>', "diaginertia is missing"),
        (BALL + '</worldbody><contact><exclude body1="a" body2="z"/></contact><worldbody>', "no body 'z'"),
        (BALL + '</worldbody><actuator><motor joint="z"/></actuator><worldbody>', "no joint 'z'"),
        (BALL + '</worldbody><equality><weld body1="a" body2="a"/></equality><worldbody>', "two bodies"),
        ('</worldbody><compiler eulerseq="abc"/><worldbody>', "eulerseq"),
        ('</worldbody><compiler angle="turns"/><worldbody>', "'turns'"),
        ("</worldbody><default><default><geom/></default></default><worldbody>", "class is missing"),
    ],
)
def test_what_is_wrong_is_named_with_its_line(body: str, told: str, tmp_path: Path) -> None:
    path = tmp_path / "wrong.xml"
    path.write_text(model(body))
    with pytest.raises(InvalidArgumentError, match=told) as error:
        load_mjcf(path)
    assert f"{path}:" in str(error.value)


def test_what_is_no_model() -> None:
    with pytest.raises(SceneError, match="<mujoco> is needed"):
        load_mjcf("<robot/>")
    with pytest.raises(FileNotFoundError):
        load_mjcf("no/such.xml")


def test_what_is_not_exact_is_a_warning_or_an_error() -> None:
    body = (
        '<body name="a"><joint armature="1" solreflimit="1 1"/><joint axis="1 0 0" pos="0 0 1"/>'
        '<geom size="1"/><geom type="ellipsoid" size="1 1 1"/><geom type="mesh" mesh="m"/></body>'
        '<body name="b"><joint type="ball" range="0 1"/><geom size="1"/></body><body name="c"><joint range="-9 9"/><geom size="1"/></body>'
    )
    lacking = '<asset><mesh name="m" file="none.stl"/></asset>'
    scene = load_mjcf(model(body + '<composite type="grid"/>' * 2, lacking + "<rocket/><tendon/><equality><tendon/></equality>"))
    told = "\n".join(map(str, scene.warnings))
    for word in (
        "<tendon>",
        "<rocket>",
        "<composite>",
        "ellipsoids",
        "no file",
        "armature",
        "solreflimit",
        "moved by 1 m",
        "several hinges",
        "cone",
        "half a turn",
    ):
        assert word in told, word
    with pytest.raises(InvalidArgumentError, match="is left out"):
        load_mjcf(model(body, lacking + "<tendon/>"), strict=True)
    with World() as world:
        scene.build(world)
        world.step()


def test_broken_files_never_crash() -> None:
    draw, texts = random.Random(4), [PENDULUM, random_model(3), random_model(5)]
    taken = 0
    for case in range(2000):
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
                data[at:at] = draw.choice([b"nan", b"-", b"1e999", b"<body>", b'"', b"&lt;", b"0", b"1e-300"])
        try:
            scene = load_mjcf(bytes(data))
            save_mjcf(scene)
            if case % 20 == 0:
                with World() as world:
                    scene.build(world)
                    world.step()
            taken += 1
        except FeatherError:
            pass
    assert 30 < taken < 1970


def test_freedoms_in_json() -> None:
    scene = Scene(
        bodies=[SceneBody("a")],
        joints=[SceneJoint("j", "configurable", None, "a", (0, 0, 0), freedoms=[SceneFreedom("f", "linear_y", -1, 1)])],
    )
    again = Scene.from_json(scene.to_json())
    assert again.joints == scene.joints
    assert normalized((0, 3, 4)) == (0.0, 0.6, 0.8)
    for change in (
        ('"axis": "linear_y"', '"axis": 5'),
        ('"lower": -1', '"lower": "x"'),
        ('"freedoms": [', '"freedoms": [3, '),
    ):
        with pytest.raises(InvalidArgumentError, match="freedoms"):
            Scene.from_json(scene.to_json().replace(*change))
    scene.joints[0].freedoms[0].axis = "angular_w"
    with World() as world, pytest.raises(InvalidArgumentError, match="angular_w"):
        scene.build(world)
