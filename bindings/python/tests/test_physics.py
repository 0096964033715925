"""The package's objects do what the library does: one small scene for each feature."""

import math
from array import array
from typing import Any, List

import numpy as np
import pytest

import feather_physics
from feather_physics import (
    Body,
    Box,
    Capsule,
    Cone,
    Cylinder,
    DataError,
    DegenerateError,
    FeatherError,
    Filter,
    FilterPair,
    Heightfield,
    Hull,
    InvalidArgumentError,
    MassData,
    Material,
    Mesh,
    Plane,
    Pool,
    Quat,
    Scaled,
    Sphere,
    StaleHandleError,
    StateError,
    SteppingError,
    Store,
    UnsupportedError,
    Vec3,
    VersionError,
    World,
)

STEP = 1 / 60


def run(world: World, seconds: float) -> List[Any]:
    """Steps, and returns all events."""
    events: List[Any] = []
    for _ in range(round(seconds / STEP)):
        world.step(STEP)
        events += [*world.pair_events, *world.body_events, *world.hit_events, *world.joint_events]
    return events


def test_free_fall(world: World, ball: Body) -> None:
    # semi-implicit Euler in 8 substeps: y = y0 - g t (t + h) / 2
    run(world, 1)
    assert ball.position.y == pytest.approx(5 - 9.81 * (1 + STEP / 8) / 2, abs=1e-4)
    assert ball.linear_velocity == pytest.approx((0, -9.81, 0), abs=1e-4)


def test_ball_comes_to_rest_on_the_ground(world: World, ground: Body, ball: Body) -> None:
    ball.shapes[0].events = ("touch", "hit")
    events = run(world, 3)
    assert abs(ball.position.y - 0.5) < 0.005
    kinds = [type(e).__name__ + getattr(e, "kind", "") for e in events]
    assert kinds == ["PairEvententer", "HitEvent", "BodyEventsleep"]
    assert (events[0].body_a, events[0].body_b) == (ground, ball)
    assert events[1].speed == pytest.approx(math.sqrt(2 * 9.81 * 4.5), rel=0.02)
    assert not ball.awake
    (contact,) = ball.contacts
    assert contact.normal == pytest.approx((0, 1, 0)) and len(contact.points) == 1
    assert contact == ground.contacts[0] == ball.shapes[0].contacts[0]
    assert sum(p.total_impulse for p in contact.points) == pytest.approx(ball.mass * 9.81 * STEP, rel=0.05)


def test_properties_are_read_as_they_were_written(world: World, ball: Body) -> None:
    values = {
        "position": (1, 2, 3),
        "rotation": (0, 1, 0, 0),
        "transform": ((4, 5, 6), (0, 0, 1, 0)),
        "linear_velocity": (1, 2, 3),
        "angular_velocity": (4, 5, 6),
        "mass": 2.0,
        "gravity_scale": 0.5,
        "sleep_threshold": 0.25,
        "tag": 2**64 - 1,
        "sleep_allowed": False,
        "bullet": True,
        "damping": (0.5, 0.25),
        "locks": ("y", "xz"),
        "enabled": False,
        "type": "kinematic",
    }
    for name, value in values.items():
        setattr(ball, name, value)
        assert getattr(ball, name) == value, name
    ball.enabled = ball.sleep_allowed = True
    ball.type = "dynamic"
    ball.awake = False
    assert not ball.awake
    assert isinstance(ball.position, Vec3) and isinstance(ball.rotation, Quat)


def test_properties_of_shapes(world: World, ball: Body) -> None:
    (shape,) = ball.shapes
    values = {
        "density": 500.0,
        "surface_velocity": (1, 0, 0),
        "tag": 7,
        "trigger": True,
        "geometry": Capsule(0.5, 0.25),
        "frame": ((1, 2, 3), (0, 0, 0, 1)),
        "material": Material(0.5, 0.25, 0.125, 0.5, 0.25, "minimum", "average", 2**64 - 1),
        "filter": Filter(2, 6, -3),
        "pair_filter": True,
        "one_way": (0, 0, 1),
        "events": ("touch", "hit"),
    }
    for name, value in values.items():
        setattr(shape, name, value)
        assert getattr(shape, name) == value, name
    assert shape.body == ball
    for geometry in (Sphere(0.5), Box(0.5, 0.25, 0.125)):
        shape.geometry = geometry
        assert shape.geometry == geometry
    shape.destroy()
    assert not shape.is_valid and ball.shapes == []


def test_mass_data(world: World) -> None:
    body = world.create_body()
    body.add_box(0.5, 0.5, 0.5, density=1000)
    assert body.mass == pytest.approx(1000)
    assert body.mass_data.inertia == pytest.approx((1000 / 6,) * 3)
    body.mass_data = MassData(2, Vec3((0, 1, 0)), Vec3((1, 1, 1)), Quat((0, 0, 0, 1)))
    assert body.mass_data.mass == 2 and body.centre == (0, 1, 0)
    body.reset_mass()
    assert body.mass == pytest.approx(1000)


def test_forces_and_impulses(world: World) -> None:
    world.gravity = (0, 0, 0)
    body = world.create_body()
    body.add_box(0.5, 0.5, 0.5, density=8)
    body.add_force((480, 0, 0))
    world.step(STEP)
    assert body.linear_velocity.x == pytest.approx(480 / 8 / 60, rel=1e-5)
    body.linear_velocity = (0, 0, 0)
    body.add_impulse((8, 0, 0))
    assert body.linear_velocity.x == pytest.approx(1)
    body.add_impulse((0, 8, 0), body.position)
    body.add_force((0, 0, 1), body.position)
    body.add_torque((0, 0, 1))
    body.add_angular_impulse((0, 0, 8 / 6))
    assert body.angular_velocity.z == pytest.approx(1, rel=1e-5)
    x, y, z = body.position
    assert body.velocity_at((x + 1, y, z)) == pytest.approx((1, 2, 0), abs=1e-4)


def test_kinematic_body_reaches_its_target(world: World) -> None:
    body = world.create_body("kinematic")
    body.add_box(1, 1, 1)
    body.move_to((1, 0, 0), seconds=STEP)
    world.step(STEP)
    assert body.position == pytest.approx((1, 0, 0), abs=1e-6)


def test_world_settings() -> None:
    with World(gravity=(0, 0, -1), substeps=4, workers=2, tag=9, simd="plain") as world:
        assert (world.gravity, world.substeps, world.tag) == ((0, 0, -1), 4, 9)
        world.tag = 2**64 - 1
        assert world.tag == 2**64 - 1
        world.substeps = 6
        assert world.substeps == 6
        world.tuning = world.tuning._replace(contact_hertz=20)
        assert world.tuning.contact_hertz == 20
        assert world.tuning.sleep_enabled is True
        world.tuning = world.tuning._replace(sleep_enabled=False, continuous_enabled=False, warm_start_enabled=False)
        assert world.tuning[-3:] == (False, False, False)
        assert world.counters.simd == 1 and world.counters.workers == 2
        world.step()
        assert world.profile.step > 0
        world.optimize()
        assert repr(world) == "<World of 0 bodies>"
    assert repr(world) == "<World, closed>"


def test_pool_is_shared_and_kept() -> None:
    pool = Pool(2)
    a, b = World(pool=pool), World(pool=pool)
    with pytest.raises(StateError):
        pool.close()
    capsule = pool._capsule
    del pool, capsule
    a.step()
    a.close(), b.close()


def test_queries(world: World, ground: Body, ball: Body) -> None:
    hit = world.raycast((0, 10, 0), (0, -20, 0))
    assert hit and hit.body == ball and hit.shape == ball.shapes[0] and hit.triangle == -1 and not hit.started_inside
    assert hit.point == pytest.approx((0, 5.5, 0)) and hit.fraction == pytest.approx(0.225) and hit.normal == pytest.approx((0, 1, 0))
    assert [h.body for h in world.raycast_all((0, 10, 0), (0, -20, 0))] == [ball, ground]
    assert world.raycast((5, 10, 0), (0, -1, 0)) is None
    assert world.raycast_any((0, 10, 0), (0, -20, 0)) is True and world.raycast_any((5, 10, 0), (0, -1, 0)) is False
    for exclude in (ball, [ball], array("Q", [ball.id])):
        other = world.raycast((0, 10, 0), (0, -20, 0), exclude=exclude)
        assert other and other.body == ground
    assert world.raycast((0, 10, 0), (0, -20, 0), mask=2) is None
    swept = world.sweep(Sphere(0.5), (0, 10, 0), (0, -20, 0))
    assert swept and swept.body == ball and swept.fraction == pytest.approx(0.2, abs=1e-4)
    assert world.sweep_any(Box(1, 1, 1), (0, 10, 0), (0, -20, 0), rotation=(0, 0, 0, 1))
    assert [h.body for h in world.sweep_all(Capsule(1, 0.5), (0, 10, 0), (0, -20, 0))] == [ball, ground]
    turn = (0, 0, 6.2831853)
    rod, at = Box(7, 0.1, 0.1), (0, 12, 0)
    assert world.sweep(rod, at, (0, 0, 0)) is None and world.sweep_any(rod, at, (0, 0, 0)) is False
    turned = world.sweep(rod, at, (0, 0, 0), turn=turn)
    assert turned and turned.body == ball and 0 < turned.fraction < 0.25
    assert world.sweep_any(rod, at, (0, 0, 0), turn=turn)
    assert [h.body for h in world.sweep_all(rod, at, (0, -8, 0), turn=turn)] == [ball, ground]
    with pytest.raises(InvalidArgumentError):
        world.sweep(rod, at, (0, 0, 0), turn=(0, 65, 0))
    assert world.overlap(Sphere(1), (0, 4, 0)) == [ball] and world.overlap(Sphere(1), (9, 9, 9)) == []
    assert world.overlap_any(Sphere(1), (0, 4, 0))
    near = world.closest_point((0, 7, 0), 10)
    assert near and near.body == ball and near.distance == pytest.approx(1.5)
    assert world.closest_point((0, 7, 0), 1) is None
    assert ball.raycast((0, 10, 0), (0, -20, 0)) == hit == ball.shapes[0].raycast((0, 10, 0), (0, -20, 0))
    assert ball.closest_point((0, 7, 0)) == near == ball.shapes[0].closest_point((0, 7, 0))
    assert world.create_body().closest_point((0, 0, 0)) is None
    with pytest.raises(UnsupportedError):
        world.sweep(Plane(), (0, 0, 0), (0, 1, 0))


def test_joints(world: World) -> None:
    a, b = world.create_body("static"), world.create_body(position=(1, 0, 0))
    b.add_sphere(0.25)
    x, z = (1, 0, 0), (0, 0, 1)
    made = [
        world.create_distance_joint(a, b, (0, 0, 0), x),
        world.create_ball_joint(a, b, (0, 0, 0), x, cone_enabled=True, cone_y=0.5, cone_z=0.5),
        world.create_hinge_joint(a, b, (0, 0, 0), z, limit_enabled=True, lower=-1, upper=1),
        world.create_fixed_joint(a, b, x),
        world.create_configurable_joint(a, b, x, linear_x={"motion": "limited", "lower": -1, "upper": 1}, angular_y={"motion": "free"}),
        world.create_rope_joint(a, b, (0, 0, 0), x, 3),
        world.create_slider_joint(a, b, x, x, tag=5),
        world.create_wheel_joint(a, b, x, z, (0, 1, 0), 4, 0.7, 0.2),
        world.create_motor_joint(a, b, 5, 1, 100, 100),
    ]
    kinds = ["distance", "ball", "hinge", "fixed", "configurable", "distance", "configurable", "configurable", "configurable"]
    assert [joint.type for joint in made] == kinds
    assert world.joints == made == a.joints == b.joints
    assert all(joint.bodies == (a, b) and joint.is_valid and joint.enabled for joint in made)
    assert made[4].definition.angular_y.motion == "free" and made[5].definition.upper == 3 and made[6].tag == 5
    assert made[0].definition.lower == pytest.approx(1)
    hinge = made[2]
    hinge.set(motor_speed=2, motor_max=10, tag=3)
    assert hinge.definition.motor_speed == 2 and hinge.tag == 3
    made[4].set(linear_x={"lower": -2})
    assert made[4].definition.linear_x.lower == -2 and made[4].definition.linear_x.motion == "limited"
    for joint in made:
        definition = joint.definition
        joint.set(**{name: value for name, value in vars(definition).items() if not name.startswith("body_")})
        assert joint.definition == definition
    with pytest.raises(TypeError):
        hinge.set(colour=1)
    with pytest.raises(InvalidArgumentError):
        world.create_fixed_joint(a, a, x)
    for joint in made[:2] + made[3:]:
        joint.destroy()
        assert not joint.is_valid
    # the pendulum swings down to its limit of 1 rad below the horizontal
    run(world, 5)
    assert hinge.angle == pytest.approx(hinge.state.angle) and -1.05 < hinge.angle <= 1.05
    assert hinge.frames[0].position == pytest.approx((0, 0, 0), abs=1e-6)
    assert hinge.reaction[0].y > 0
    hinge.enabled = False
    assert not hinge.enabled


def test_a_joint_that_breaks_sends_its_event(world: World) -> None:
    a, b = world.create_body("static"), world.create_body(position=(1, 0, 0))
    b.add_sphere(0.25)
    joint = world.create_fixed_joint(a, b, (0, 0, 0), break_force=1, tag=4)
    (event,) = [e for e in run(world, 0.1) if type(e).__name__ == "JointEvent"]
    assert event.joint == joint and (event.body_a, event.body_b) == (a, b) and event.tag == 4 and event.type == "fixed"
    assert not joint.is_valid and math.hypot(*event.force) > 1


def test_heightfield(world: World, ball: Body) -> None:
    field = world.create_heightfield([[0, 0, 0], [0, 1, 0], [0, 0, 0]], cell_x=4, cell_z=4)
    ground = world.create_body("static")
    shape = ground.add(field, position=(-4, 0, -4))
    assert shape.geometry == field and isinstance(shape.geometry, Heightfield)
    hit = world.raycast((0, 3, 0), (0, -10, 0))
    assert hit and hit.point.y == pytest.approx(1) and hit.triangle >= 0
    field.set_heights(1, 1, 1, 1, array("f", [2]))
    assert field.get_heights(0, 0, 3, 3, array("f", bytes(36))).tolist() == [0, 0, 0, 0, 2, 0, 0, 0, 0]
    flat = world.create_heightfield(array("f", bytes(24)), rows=2, columns=3, holes=bytes([0, 1]), cell_materials=bytes(2), materials=[Material()])
    flat.destroy()
    assert not flat.is_valid and field.is_valid
    for wrong in ({"heights": array("f", bytes(20)), "rows": 2, "columns": 3}, {"heights": [[1, 2], [3]]}, {"heights": array("f", bytes(24))}):
        with pytest.raises(ValueError):
            world.create_heightfield(**wrong)
    with pytest.raises(ValueError):
        field.set_heights(0, 0, 3, 3, array("f", [2]))


CUBE = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]


def test_hull(world: World) -> None:
    hull = world.create_hull(CUBE + [(0, 0, 0)])
    assert hull.vertices == CUBE and hull.info.volume == pytest.approx(1) and hull.info.centre == (0, 0, 0)
    assert (hull.info.vertex_count, hull.info.edge_count, hull.info.face_count) == (8, 12, 6)
    assert all(len(face.corners) == 4 and face.distance == pytest.approx(0.5) for face in hull.faces)
    assert {tuple(face.normal) for face in hull.faces} == {(-1, 0, 0), (1, 0, 0), (0, -1, 0), (0, 1, 0), (0, 0, -1), (0, 0, 1)}
    world.create_body("static").add_plane()
    body = world.create_body(position=(0, 1, 0))
    shape = body.add(hull, density=500)
    assert shape.geometry == hull and isinstance(shape.geometry, Hull) and body.mass == pytest.approx(500)
    run(world, 2)
    assert body.position.y == pytest.approx(0.5, abs=1e-3)
    for points in (np.array(CUBE, dtype=np.float32), np.array(CUBE), array("f", [x for point in CUBE for x in point])):
        assert world.create_hull(points, max_vertices=8, tolerance=1e-4).vertices == CUBE
    with pytest.raises(DegenerateError, match="flat"):
        world.create_hull([(0, 0, 0), (1, 0, 0), (0, 0, 1), (1, 0, 1)])
    with pytest.raises(InvalidArgumentError, match="points.3..z"):
        world.create_hull([*CUBE[:3], (0, 0, math.nan)])
    with pytest.raises(ValueError):
        world.create_hull([1, 2, 3, 4])
    hull.destroy()
    assert not hull.is_valid
    with pytest.raises(StaleHandleError):
        hull.info


def test_saved_assets(world: World) -> None:
    vertices = [(-4, 0, -4), (4, 0, -4), (-4, 0, 4), (4, 0, 4)]
    mesh = world.create_mesh(vertices, [(0, 2, 3), (0, 3, 1)], triangle_data=[7, 8])
    field = world.store.create_heightfield([[0, 1], [2, 3]])
    hull = world.create_hull(CUBE)
    with Store() as store:
        for asset, kind in ((hull, Hull), (mesh, Mesh), (field, Heightfield)):
            saved = asset.save()
            loaded = store.load(saved)
            assert type(saved) is bytes and type(loaded) is kind and loaded.store is store and loaded.save() == saved
            assert store.load(memoryview(bytearray(saved))).save() == saved
            assert store.load(np.frombuffer(saved, dtype=np.uint8)).save() == saved
            before = store.bytes
            for wrong in (b"", saved[:-8], bytes(len(saved)), saved[:50] + bytes([saved[50] ^ 1]) + saved[51:]):
                with pytest.raises(DataError, match="at byte"):
                    store.load(wrong)
            with pytest.raises(VersionError, match="newer"):
                store.load(saved[:8] + bytes([2]) + saved[9:])
            assert store.bytes == before
        assert store.load(mesh.save()).triangle(1).data == 8  # type: ignore[union-attr, attr-defined]
        for wrong in ("bytes", 5, None):  # type: ignore[assignment]
            with pytest.raises(TypeError):
                store.load(wrong)
    hull.destroy()
    with pytest.raises(StaleHandleError):
        hull.save()


def test_scaled(world: World) -> None:
    hull = world.create_hull(CUBE)
    mesh = world.create_mesh([(-1, 0, -1), (1, 0, -1), (-1, 0, 1), (1, 0, 1)], [(0, 2, 3), (0, 3, 1)])
    floor = world.create_body("static").add(Scaled(mesh, (-9, 1, 9)))
    assert floor.geometry == Scaled(mesh, (-9, 1, 9))
    body = world.create_body(position=(5, 2, 5))
    shape = body.add(Scaled(hull, (-2, 0.5, 1)), density=500)
    assert shape.geometry == Scaled(hull, (-2, 0.5, 1)) and body.mass == pytest.approx(500)
    run(world, 2)
    assert body.position.y == pytest.approx(0.25, abs=1e-3)
    hit = world.raycast((5, 5, 5), (0, -10, 0))
    assert hit and hit.shape == shape and hit.normal == pytest.approx((0, 1, 0), abs=1e-3)
    shape.geometry = Scaled(hull, (3, 3, 3))
    assert body.mass == pytest.approx(27 * 500)
    shape.geometry = Scaled(hull, (1, 1, 1))
    assert shape.geometry == hull
    assert world.sweep(Scaled(hull, (-4, 1, 1)), (5, 9, 5), (0, -10, 0))
    for wrong in (0, math.nan, math.inf, 1e-4, -1e4):
        with pytest.raises(InvalidArgumentError, match="scale.x"):
            body.add(Scaled(hull, (wrong, 1, 1)))
        with pytest.raises(InvalidArgumentError, match="scale.z"):
            shape.geometry = Scaled(hull, (1, 1, wrong))
    assert shape.geometry == hull
    with pytest.raises(DegenerateError, match="thick"):
        body.add(Scaled(hull, (0.001, 30, 1)))
    for other in (Sphere(1), Scaled(hull, (2, 2, 2))):
        with pytest.raises(TypeError, match="a hull or a mesh is needed, not '(Sphere|Scaled)'"):
            body.add(Scaled(other, (2, 2, 2)))  # type: ignore[arg-type]
    field = world.create_heightfield([[0, 0], [0, 0]])
    with pytest.raises(UnsupportedError, match="heightfield"):
        world.create_body("static").add(Scaled(field, (2, 2, 2)))  # type: ignore[arg-type]
    with pytest.raises(ValueError):
        body.add(Scaled(hull, (1, 2)))
    hull.destroy()
    run(world, 0.1)
    with pytest.raises(StaleHandleError):
        body.add(Scaled(hull, (2, 2, 2)))


def test_mesh(world: World) -> None:
    vertices = [(-4, 0, -4), (4, 0, -4), (-4, 0, 4), (4, 0, 4)]
    triangles = [(0, 2, 3), (0, 3, 1), (0, 0, 1)]
    mesh = world.create_mesh(vertices, triangles, triangle_materials=bytes([0, 1, 0]), materials=[Material(user_id=5), Material(user_id=6)], triangle_data=[7, 8, 9])
    info = mesh.info
    assert (info.triangle_count, info.degenerate_triangles, info.open_edges, info.material_count) == (2, 1, 4, 2)
    assert info.area == pytest.approx(64) and info.volume == 0 and info.lower == (-4, 0, -4) and info.upper == (4, 0, 4)
    triangle = mesh.triangle(1)
    assert triangle and triangle.corners == (vertices[0], vertices[3], vertices[1]) and (triangle.material, triangle.data) == (1, 8)
    assert [edge.open for edge in triangle.edges] == [False, True, True] and triangle.edges[1].felt and not triangle.edges[0].felt
    assert mesh.triangle(2) is None
    shape = world.create_body("static").add(mesh)
    assert shape.geometry == mesh and isinstance(shape.geometry, Mesh)
    body = world.create_body(position=(1, 1, 0))
    body.add_cylinder(0.25, 0.5)
    assert body.shapes[0].geometry == Cylinder(0.25, 0.5)
    cone = world.create_body(position=(-2, 1, 2))
    assert cone.add_cone(0.5, 0.5).geometry == Cone(0.5, 0.5)
    run(world, 2)
    assert body.position.y == pytest.approx(0.25, abs=1e-3) and cone.position.y == pytest.approx(0.5, abs=1e-3)
    hit = world.raycast((3, 3, -3), (0, -10, 0))
    assert hit and hit.triangle == 1 and hit.material == 6
    mesh.set_materials([Material(), Material(user_id=11)])
    hit = world.raycast((3, 3, -3), (0, -10, 0))
    assert hit and hit.material == 11
    with pytest.raises(UnsupportedError, match="dynamic"):
        body.add(mesh)
    flat = np.array(triangles[:2])
    for indices in (flat, flat.astype(np.uint16), flat.astype(np.uint32), flat.astype(np.int32), flat.ravel().tolist()):
        other = world.create_mesh(np.array(vertices, dtype=np.float32), indices, two_sided=True, strict=True, weld_distance=1e-4, edge_angle=0.1)
        assert other.info.triangle_count == 2 and other.triangle(1).corners == triangle.corners  # type: ignore[union-attr]
    both = World()
    both.create_body("static").add(both.create_mesh([(-1, 0, -1), (-1, 0, 1), (1, 0, -1)], [(0, 1, 2)], two_sided=True))
    for height in (1, -1):
        hit = both.raycast((-0.5, height, -0.5), (0, -2 * height, 0))
        assert hit and hit.normal.y == height and hit.back == (height < 0)
        assert [h.back for h in both.raycast_all((-0.5, height, -0.5), (0, -2 * height, 0))] == [height < 0]
    for wrong in ({"strict": True}, {"triangle_materials": bytes(2)}, {"triangle_data": [1]}, {"weld_distance": -1}, {"materials": [Material()] * 256}):
        with pytest.raises(ValueError):
            world.create_mesh(vertices, triangles, **wrong)  # type: ignore[arg-type]
    with pytest.raises(InvalidArgumentError, match="triangle 0"):
        world.create_mesh(vertices, [(0, 1, 4)])
    with pytest.raises(OverflowError):
        world.create_mesh(vertices, [(0, 1, -1)])


def test_user_data_and_equality(world: World, ball: Body) -> None:
    ball.user_data = {"name": "ball"}
    assert world.bodies[0].user_data == {"name": "ball"} and world.bodies[0] == ball and world.bodies[0] is not ball
    assert len({ball, world.bodies[0]}) == 1 and ball != ball.shapes[0] and ball != 5
    assert world.create_body(user_data=3).user_data == 3
    assert ball.world is world and ball.id == world.body_ids()[0]
    ball.destroy()
    assert ball.user_data is None and not ball.is_valid


def test_events_of_triggers_and_stay(world: World, ground: Body, ball: Body) -> None:
    zone = world.create_body("static", position=(0, 3, 0))
    zone.add_box(1, 1, 1, trigger=True, events=("touch", "stay"))
    events = [e for e in run(world, 2) if type(e).__name__ == "PairEvent" and e.is_trigger]
    kinds = [e.kind for e in events]
    assert kinds[0] == "enter" and kinds[-1] == "exit" and set(kinds[1:-1]) == {"stay"}
    assert {*events[0][1:3]} == {zone, ball}


def test_collisions_can_be_ignored(world: World, ground: Body, ball: Body) -> None:
    world.ignore_collision(ground, ball)
    run(world, 2)
    assert ball.position.y < -1
    assert world.is_ignored(ball, ground) and not world.is_ignored(ball, world.create_body())
    ball.filter = Filter(2, 4, 5)
    assert ball.shapes[0].filter == ball.filter == (2, 4, 5)


def test_equal_runs_have_equal_hashes() -> None:
    def play(workers: int) -> int:
        with World(workers=workers) as world:
            world.create_body("static").add_plane()
            for i, body in enumerate(world.create_bodies([(i % 3 * 0.3, 1 + i, 0) for i in range(40)])):
                body.add(Sphere(0.5) if i % 2 else Box(0.5, 0.5, 0.5))
            run(world, 1)
            return world.hash

    assert play(1) == play(3)


def test_version() -> None:
    assert feather_physics.__version__.count(".") == 2
    assert issubclass(InvalidArgumentError, FeatherError) and issubclass(InvalidArgumentError, ValueError)


def test_everything_public_is_documented() -> None:
    for name in feather_physics.__all__:
        thing = getattr(feather_physics, name)
        if not isinstance(thing, type):
            continue
        assert thing.__doc__, name
        for member, value in vars(thing).items():
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                assert getattr(value, "__doc__", None), f"{name}.{member}"
