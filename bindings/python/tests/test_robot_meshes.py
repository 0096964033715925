"""Meshes of robots: STL and OBJ in URDF and MJCF, as MuJoCo weighs them, as hulls that move and triangles that stand."""

import math
import random
import struct
from pathlib import Path
from typing import Any, Callable, List, Sequence, Tuple

import pytest
from robots import compare_bodies, near, plain

from feather_physics import FeatherError, InvalidArgumentError, Store, World
from feather_physics.mjcf import load_mjcf, save_mjcf
from feather_physics.robot_mesh import ellipsoid, find_file, mass_of, read_mesh
from feather_physics.scene import Scene, SceneMesh
from feather_physics.urdf import load_urdf, save_urdf

# A box of 2 x 4 x 6 m about (1, 2, 3), wound counterclockwise from outside
BOX = [(x, y, z) for x in (0.0, 2.0) for y in (0.0, 4.0) for z in (0.0, 6.0)]
FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
CORNERS = [corner for a, b, c, d in FACES for corner in (a, b, c, a, c, d)]


def binary_stl(points: Sequence[Sequence[float]], corners: Sequence[int]) -> bytes:
    data = b"made by a test".ljust(80) + struct.pack("<I", len(corners) // 3)
    for k in range(0, len(corners), 3):
        data += struct.pack("<3f", 0, 0, 0)
        data += b"".join(struct.pack("<3f", *points[corner]) for corner in corners[k : k + 3]) + b"\0\0"
    return data


def text_stl(points: Sequence[Sequence[float]], corners: Sequence[int]) -> str:
    text = "solid box\n"
    for k in range(0, len(corners), 3):
        text += "facet normal 0 0 0\nouter loop\n"
        text += "".join("vertex {} {} {}\n".format(*points[corner]) for corner in corners[k : k + 3])
        text += "endloop\nendfacet\n"
    return text + "endsolid box\n"


def obj(points: Sequence[Sequence[float]], faces: Sequence[Sequence[int]]) -> str:
    text = "# a box\no box\n" + "".join("v {} {} {}\n".format(*point) for point in points) + "vn 0 0 1\n"
    for i, face in enumerate(faces):
        text += "f " + " ".join(f"{c + 1}//1" if i % 2 else str(c - len(points)) for c in face) + "\n"
    return text


@pytest.fixture
def boxes(tmp_path: Path) -> Path:
    (tmp_path / "binary.stl").write_bytes(binary_stl(BOX, CORNERS))
    (tmp_path / "text.STL").write_text(text_stl(BOX, CORNERS))
    (tmp_path / "box.obj").write_text(obj(BOX, FACES))
    return tmp_path


def is_a_box(found: Any, sides: Tuple[float, float, float], centre: Tuple[float, float, float]) -> None:
    volume, middle, moments, _ = found
    assert volume == pytest.approx(math.prod(sides))
    assert middle == pytest.approx(centre)
    squares = [s * s for s in sides]
    assert sorted(moments) == pytest.approx(sorted((sum(squares) - s) / 12 for s in squares))


@pytest.mark.parametrize("name", ["binary.stl", "text.STL", "box.obj"])
def test_files_are_boxes(boxes: Path, name: str) -> None:
    points, corners = read_mesh(str(boxes / name), (1, 1, 1))
    assert (len(points), len(corners)) == (24, 36)
    is_a_box(mass_of(points, corners), (2, 4, 6), (1, 2, 3))
    is_a_box(mass_of(points, []), (2, 4, 6), (1, 2, 3))  # the hull
    # mirrored along one axis it is still wound from outside: triangles that stand would let things through
    points, corners = read_mesh(str(boxes / name), (-0.5, 1, 1))
    is_a_box(mass_of(points, corners), (1, 4, 6), (-0.5, 2, 3))
    with Store() as store:
        mesh = store.create_mesh([points[k : k + 3] for k in range(0, len(points), 3)], corners)
        assert mesh.info.open_edges == 0 and mesh.info.volume == pytest.approx(24)


@pytest.mark.parametrize(
    "name, data, told",
    [
        ("a.stl", b"", "no STL"),
        ("a.stl", b"solid\nvertex 0 0 0\n", "no STL"),
        ("a.stl", b"solid\nvertex 0 zero 0\n", "a.stl:2: three numbers"),
        ("a.stl", struct.pack("<80xI", 1) + struct.pack("<12fH", *[math.nan] * 12, 0), "finite"),
        ("a.obj", b"# nothing", "no OBJ"),
        ("a.obj", b"v 0 0\n", "a.obj:1: three numbers"),
        ("a.obj", b"v 0 0 0\nf 1 2 3\n", "a.obj:2: a face"),
        ("a.obj", b"v 0 0 0\nf 1 x 3\n", "a.obj:2: a face"),
        ("a.obj", b"v 0 0 0\nf 1 1\n", "a.obj:2: a face"),
    ],
)
def test_broken_files(tmp_path: Path, name: str, data: bytes, told: str) -> None:
    (tmp_path / name).write_bytes(data)
    with pytest.raises(InvalidArgumentError, match=told):
        read_mesh(str(tmp_path / name), (1, 1, 1))
    with pytest.raises(InvalidArgumentError, match="the scale is not 0"):
        (tmp_path / "b.obj").write_text(obj(BOX, FACES))
        read_mesh(str(tmp_path / "b.obj"), (1, 0, 1))


def test_scrambled_files_are_read_or_refused(boxes: Path) -> None:
    draw = random.Random(3)
    for name in ("binary.stl", "text.STL", "box.obj"):
        data = (boxes / name).read_bytes()
        for _ in range(300):
            broken = bytearray(data)
            for _ in range(draw.randint(1, 8)):
                broken[draw.randrange(len(broken))] = draw.randrange(256)
            if draw.random() < 0.3:
                del broken[draw.randrange(len(broken)) :]
            path = boxes / f"broken{Path(name).suffix}"
            path.write_bytes(broken)
            try:
                mass_of(*read_mesh(str(path), (1, 1, 1)))
            except FeatherError:
                pass


def test_where_files_are(tmp_path: Path) -> None:
    package = tmp_path / "ws" / "arm"
    (package / "meshes").mkdir(parents=True), (package / "urdf").mkdir()  # type: ignore[func-returns-value]
    mesh, file = package / "meshes" / "m.stl", str(package / "urdf" / "arm.urdf")
    mesh.write_bytes(b"")
    for name in ("package://arm/meshes/m.stl", "../meshes/m.stl", f"file://{mesh}", str(mesh)):
        found = find_file(name, file, [])
        assert found is not None and Path(found).resolve() == mesh
    assert find_file("package://arm/meshes/m.stl", None, [tmp_path / "ws"]) == str(mesh)
    assert find_file("meshes/m.stl", None, [tmp_path, package]) == str(mesh)
    assert find_file("package://leg/meshes/m.stl", file, []) is None
    assert find_file("meshes/m.stl", None, []) is None


# ---- masses as MuJoCo has them


def blob(draw: random.Random) -> List[float]:
    return [
        round(x, 4)
        for _ in range(draw.randint(5, 40))
        for x in (draw.gauss(0, 0.2), draw.gauss(0, 0.1), draw.gauss(0, 0.3))
    ]


def model_of_blobs(seed: int) -> str:
    draw, assets, bodies = random.Random(seed), "", ""
    for i in range(draw.randint(1, 4)):
        points = " ".join(map(repr, blob(draw)))
        placed = draw.choice(["", 'refpos="0.1 0.2 -0.1" refquat="0.5 0.5 -0.5 0.5"', 'scale="2 0.5 -1"'])
        assets += f'<mesh name="m{i}" vertex="{points}" {placed}/>'
        # MuJoCo 2.2 takes the box of the same inertia for the volume, so the mass is given
        weight = f'mass="{draw.uniform(0.5, 3):.4f}"'
        numbers = " ".join(f"{draw.uniform(-1, 1):.4f}" for _ in range(7)).split()
        geom = f'<geom type="mesh" mesh="m{i}" pos="{" ".join(numbers[:3])}" quat="{" ".join(numbers[3:])}" {weight}/>'
        bodies += f'<body name="b{i}" pos="{i} 0 1"><freejoint/>{geom}<geom size="0.1" pos="0.3 0 0"/></body>'
    return f'<mujoco model="blobs"><asset>{assets}</asset><worldbody>{bodies}</worldbody></mujoco>'


def test_masses_agree_with_mujoco(referee: Callable[..., Any], boxes: Path) -> None:
    models = [model_of_blobs(seed) for seed in range(20)]
    inside = boxes / "models"
    inside.mkdir()
    file = inside / "box.xml"
    file.write_text(
        '<mujoco><compiler meshdir=".."/><default><mesh scale="0.1 0.2 0.3"/></default><asset><mesh file="binary.stl"/>'
        '<mesh name="o" file="box.obj" scale="0.5 0.5 0.5"/></asset><worldbody><body name="a"><freejoint/>'
        '<geom type="mesh" mesh="binary" euler="10 20 30"/><geom type="mesh" mesh="o" pos="1 1 1" mass="50"/></body></worldbody></mujoco>'
    )
    answers = referee([*models, file])
    for source, truth in zip([*models, file], answers):
        scene = load_mjcf(source)
        assert scene.warnings == []
        count = compare_bodies({body.name: body for body in scene.bodies}, truth["bodies"])
        assert count == len(scene.bodies)
        again = load_mjcf(save_mjcf(scene))
        assert near(plain(scene), plain(again))
        assert plain(Scene.from_json(scene.to_json())) == plain(scene)


# ---- what they collide as

CUP = [
    (r * math.cos(a), r * math.sin(a), z)
    for r, z in ((0.3, 0.0), (0.5, 0.4), (0.45, 0.4), (0.25, 0.1))
    for a in (0.5 * math.pi * k for k in range(4))
]


def cup() -> List[int]:
    """A bowl of four sides: outside, rim, inside, and its two bottoms."""
    corners = [0, 2, 1, 0, 3, 2, 12, 13, 14, 12, 14, 15]
    for ring in range(3):
        for k in range(4):
            a, b = 4 * ring + k, 4 * ring + (k + 1) % 4
            corners += [a, b, b + 4, a, b + 4, a + 4]
    return corners


def test_a_cup_that_stands_holds_a_ball_and_one_that_moves_is_its_hull(tmp_path: Path) -> None:
    (tmp_path / "cup.stl").write_bytes(binary_stl(CUP, cup()))
    text = (
        '<robot name="r"><link name="{name}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial>'
        '<collision><geometry><mesh filename="cup.stl"/></geometry></collision></link></robot>'
    )
    for fixed, rest in ((True, 0.1 + 0.05), (False, 0.4 + 0.05)):
        file = tmp_path / "cup.urdf"
        file.write_text(text.format(name="cup"))
        scene = load_urdf(file, fixed_base=fixed)
        assert [w.sentence.split(": ")[-1] for w in scene.warnings] == (
            [] if fixed else ["meshes of bodies that move collide as their hulls"]
        )
        with World(gravity=(0, 0, -9.81)) as world:
            world.create_body("static").add_plane((0, 0, 1), 0)
            built = scene.build(world)
            assert list(built.assets) == [("cup.stl", fixed)]
            ball = world.create_body("dynamic", position=(0, 0, 0.6))
            ball.add_sphere(0.05)
            for _ in range(300):
                world.step(1 / 60)
            assert ball.position[2] == pytest.approx(rest, abs=0.005)  # slop of a contact
            copy = World.load(world.save(assets=True))
            copy.step(1 / 60), world.step(1 / 60)  # type: ignore[func-returns-value]
            assert copy.hash == world.hash


def test_a_urdf_with_meshes_is_written_again(boxes: Path) -> None:
    form = '<mesh filename="box.obj" scale="0.1 0.1 -0.2"/>'
    link = '<link name="{}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial><collision><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/><geometry>{}</geometry></collision></link>'
    joint = '<joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>'
    text = f'<robot name="r">{link.format("a", form)}{link.format("b", form)}{joint}</robot>'
    scene = load_urdf(text, folders=[boxes])
    assert len(scene.meshes) == 1 and len(scene.warnings) == 1
    assert near(plain(load_urdf(save_urdf(scene), folders=[boxes])), plain(scene))
    assert plain(Scene.from_json(scene.to_json())) == plain(scene)
    with pytest.raises(InvalidArgumentError, match="their hulls"):
        load_urdf(text, folders=[boxes], strict=True)
    scene.meshes[0].file = ""
    with pytest.raises(FeatherError, match="files alone"):
        save_urdf(scene)
    scene.meshes.clear()
    with World() as world, pytest.raises(InvalidArgumentError, match="no mesh"):
        scene.build(world)


def test_what_is_not_there_or_of_another_kind(boxes: Path) -> None:
    (boxes / "m.dae").write_text("<COLLADA/>")
    for name in ("none.stl", "m.dae"):
        urdf = f'<robot><link name="a"><collision><geometry><mesh filename="{name}"/></geometry></collision></link></robot>'
        mjcf = f'<mujoco><asset><mesh name="m" file="{name}"/></asset><worldbody><geom type="mesh" mesh="m"/></worldbody></mujoco>'
        for load, text in ((load_urdf, urdf), (load_mjcf, mjcf)):
            scene = load(text, folders=[boxes])
            assert len(scene.warnings) == 1 and "left out" in scene.warnings[0].sentence
            with pytest.raises(InvalidArgumentError, match="left out"):
                load(text, folders=[boxes], strict=True)
    flat = '<mujoco><asset><mesh name="m" vertex="0 0 0 1 0 0 0 1 0 1 1 0"/></asset><worldbody><body><freejoint/><geom type="mesh" mesh="{}"/></body></worldbody></mujoco>'
    for mesh, told in (("m", "<geom>: mesh 'm'"), ("n", "there is no mesh 'n'")):
        with pytest.raises(InvalidArgumentError, match=told):
            load_mjcf(flat.format(mesh))
    for wrong in (
        'vertex="0 0"',
        'vertex="0 0 0 1 0 0 0 1 0 0 0 1" face="0 1 4"',
        'vertex="0 0 0 1 0 0 0 1 0 0 0 1" refquat="0 0 0 0"',
        "",
    ):
        with pytest.raises(InvalidArgumentError):
            load_mjcf(flat.replace('vertex="0 0 0 1 0 0 0 1 0 1 1 0"', wrong).format("m"))


def test_json_names_what_is_wrong_with_a_mesh() -> None:
    good = Scene(meshes=[SceneMesh("m", [float(x) for point in BOX for x in point], list(CORNERS))])
    assert plain(Scene.from_json(good.to_json())) == plain(good)
    for points, corners in (
        ([], []),
        ([1.0], []),
        ([0.0] * 9, [0, 1]),
        ([0.0] * 9, [0, 1, 3]),
        ([0.0] * 9, [0, 1, 1.5]),
    ):
        bad = Scene(meshes=[SceneMesh("m", points, corners)])
        with pytest.raises(InvalidArgumentError, match="of m"):
            Scene.from_json(bad.to_json())


def test_an_ellipsoid_collides_as_a_hull() -> None:
    model = '<mujoco><worldbody><geom type="plane" size="9 9 1"/><body name="a" pos="0 0 1"><freejoint/><geom type="ellipsoid" size="0.2 0.3 0.1"/></body></worldbody></mujoco>'
    scene = load_mjcf(model)
    assert [w.sentence.split(": ")[-1] for w in scene.warnings] == ["ellipsoids collide as hulls of 64 points"]
    assert near(plain(load_mjcf(save_mjcf(scene))), plain(scene))
    with World(gravity=scene.gravity) as world:
        body = scene.build(world).bodies["a"]
        for _ in range(300):
            world.step(1 / 60)
        assert body.position[2] == pytest.approx(0.1, abs=0.005)  # on its flat side
    volume, centre, _, _ = mass_of(ellipsoid((0.2, 0.3, 0.1)), [])  # type: ignore[misc]
    assert len(ellipsoid((1, 1, 1))) == 3 * 64 and centre == pytest.approx((0, 0, 0), abs=1e-3)
    assert volume == pytest.approx(4 / 3 * math.pi * 0.006, rel=0.15)
