"""Tasks to learn, for envs.VectorEnv. Each has a controller in the tests that solves it, and a golden hash."""

from __future__ import annotations

from typing import Any, List, Sequence, Tuple

import numpy as np

from .envs import Draws, Task, VectorEnv
from .objects import Body, Joint
from .spaces import Box, Discrete
from .world import World

INFINITE = np.inf


def tilted(t: Any) -> Tuple[Any, Any, Any, Any]:
    """A rotation about z by the angle whose half has tangent t, without a sine: its z and w, then sine and cosine."""
    length = np.sqrt(1 + t * t)
    return t / length, 1 / length, 2 * t / (1 + t * t), (1 - t * t) / (1 + t * t)


class CartPole(Task):
    """A pole on a cart, which is pushed left (0) or right (1), is to stay upright: Barto, Sutton and Anderson, 1983.

    Observed: the cart's place and speed (m, m/s), the pole's lean to the right and its rate (rad, rad/s). A reward of 1
    a step. It ends when the cart is farther than 2.4 m, or the pole leans more than 12 degrees."""

    dt, limit = 0.02, 500
    force, far, lean = 10.0, 2.4, 12 * np.pi / 180  # N, m, rad
    half = 0.5  # m, of the pole's length

    def __init__(self) -> None:
        high = np.array([2 * self.far, INFINITE, 2 * self.lean, INFINITE], np.float32)
        self.observation_space, self.action_space = Box(-high, high), Discrete(2)

    def build(self) -> World:
        world = World(substeps=4)
        self.cart = world.create_body(position=(0, 0, 0), linear_damping=0, angular_damping=0)
        self.cart.add_box(0.25, 0.125, 0.25, density=1 / (0.5 * 0.25 * 0.5), mask=0)
        self.pole = world.create_body(position=(0, self.half, 0), linear_damping=0, angular_damping=0)
        self.pole.add_box(0.025, self.half, 0.025, density=0.1 / (0.05 * 0.05 * 2 * self.half), mask=0)
        self.rail = world.create_slider_joint(None, self.cart, (0, 0, 0), (1, 0, 0))
        self.hinge = world.create_hinge_joint(self.cart, self.pole, (0, 0, 0), (0, 0, 1))
        return world

    def bind(self, env: VectorEnv) -> None:
        self.forces = env.input("force", [self.cart])
        self.joints = env.output("joint", [self.rail, self.hinge])

    def begin(self, env: VectorEnv, which: Any, draws: Sequence[Draws]) -> None:
        x, speed, t, spin = np.array([d.uniform(-0.05, 0.05, 4) for d in draws]).T
        z, w, sine, cosine = tilted(0.5 * t)
        poses, velocities = np.zeros((len(which), 2, 7)), np.zeros((len(which), 2, 6))
        poses[:, 0, 0], poses[:, 0, 6] = x, 1
        poses[:, 1, 0], poses[:, 1, 1] = x - self.half * sine, self.half * cosine
        poses[:, 1, 5], poses[:, 1, 6] = z, w
        velocities[:, 0, 0], velocities[:, 1, 5] = speed, spin
        velocities[:, 1, 0], velocities[:, 1, 1] = speed - self.half * cosine * spin, -self.half * sine * spin
        env.write("transform", [self.cart, self.pole], which, poses)
        env.write("velocity", [self.cart, self.pole], which, velocities)

    def act(self, actions: Any) -> None:
        self.forces[:, 0, 0] = np.where(actions == 1, self.force, -self.force)

    def observe(self) -> Any:
        seen = self.joints.reshape(-1, 4).copy()
        seen[:, 2:] *= -1  # it turns to the left about z
        return seen

    def judge(self, actions: Any) -> Tuple[Any, Any]:
        x, lean = self.joints[:, 0, 0], self.joints[:, 1, 0]
        return np.ones(len(x)), (np.abs(x) > self.far) | (np.abs(lean) > self.lean)


class BallOnPlate(Task):
    """A ball is to lie in the middle of a plate that is tilted about two axes.

    Actions: the tilt about x and about z, -1 to 1, of 0.2 rad. Observed, along the plate: the ball's place and speed (m,
    m/s), both tilts and their rates (rad, rad/s). The reward is 1 in the middle and less by the distance. It ends when
    the ball has left the plate."""

    dt, limit = 1 / 60, 600
    half, radius, most = 0.5, 0.05, 0.2  # m, m, rad

    def __init__(self) -> None:
        self.observation_space = Box(-INFINITE, INFINITE, (8,))
        self.action_space = Box(-1.0, 1.0, (2,))

    def build(self) -> World:
        world = World(substeps=4)
        frame = world.create_body(position=(0, 0, 0))
        frame.add_box(0.1, 0.1, 0.1, mask=0)
        self.plate = world.create_body(position=(0, 0, 0))
        self.plate.add_box(self.half, 0.02, self.half, density=200)
        self.ball = world.create_body(position=(0, 0.02 + self.radius, 0))
        self.ball.add_sphere(self.radius)
        drive = dict(spring_hertz=8.0, spring_damping_ratio=1.0)
        self.joints_of = [
            world.create_hinge_joint(None, frame, (0, 0, 0), (1, 0, 0), **drive),
            world.create_hinge_joint(frame, self.plate, (0, 0, 0), (0, 0, 1), **drive),
        ]
        return world

    def bind(self, env: VectorEnv) -> None:
        self.targets = env.input("joint_target", self.joints_of)
        self.tilts = env.output("joint", self.joints_of)
        self.place = env.output("transform", [self.ball], relative_to=self.plate)
        self.motion = env.output("velocity", [self.ball], relative_to=self.plate)

    def begin(self, env: VectorEnv, which: Any, draws: Sequence[Draws]) -> None:
        poses = np.zeros((len(which), 1, 7))
        poses[:, 0, [0, 2]] = np.array([d.uniform(-0.3, 0.3, 2) for d in draws])
        poses[:, 0, 1], poses[:, 0, 6] = 0.02 + self.radius, 1
        env.write("transform", [self.ball], which, poses)
        self.targets[which] = 0

    def act(self, actions: Any) -> None:
        self.targets[:, :, 0] = np.clip(actions, -1, 1) * self.most

    def observe(self) -> Any:
        along = [self.place[:, 0, [0, 2]], self.motion[:, 0, [0, 2]], self.tilts[:, :, 0], self.tilts[:, :, 1]]
        return np.concatenate(along, axis=1)

    def judge(self, actions: Any) -> Tuple[Any, Any]:
        x, y, z = self.place[:, 0, :3].astype(np.float64).T
        off = (np.abs(x) > self.half) | (np.abs(z) > self.half) | (y < 0)
        return 1 - np.sqrt(x * x + z * z), off


class Push(Task):
    """A disc pushes a box to a goal on the ground.

    Actions: the disc's speed along x and z, -1 to 1, of 1 m/s. Observed: the disc's place, the box's place, heading (x
    and z of its own x axis) and speed, and the goal (m, m/s). The reward is by how much the box came nearer to the goal
    in this step, m. It ends when the box is within 5 cm of it."""

    dt, steps, limit = 1 / 60, 2, 600
    near, speed = 0.05, 1.0  # m, m/s

    def __init__(self) -> None:
        self.observation_space = Box(-INFINITE, INFINITE, (10,))
        self.action_space = Box(-1.0, 1.0, (2,))

    def build(self) -> World:
        world = World(substeps=4)
        world.create_body("static").add_plane()
        self.disc = world.create_body("kinematic", position=(0, 0.1, 0))
        self.disc.add_cylinder(0.1, 0.1)
        self.box = world.create_body(position=(0, 0.1, 0.5))
        self.box.add_box(0.2, 0.1, 0.2, density=100)
        return world

    def bind(self, env: VectorEnv) -> None:
        self.goals = np.zeros((env.num_envs, 2))
        self.last = np.zeros(env.num_envs)
        self.speeds = env.input("velocity", [self.disc])
        self.poses = env.output("transform", [self.disc, self.box])
        self.motion = env.output("velocity", [self.box])

    def begin(self, env: VectorEnv, which: Any, draws: Sequence[Draws]) -> None:
        poses = np.zeros((len(which), 1, 7))
        poses[:, 0, 1], poses[:, 0, 6] = 0.1, 1
        for row, world, d in zip(poses[:, 0], which, draws):
            row[0], row[2] = d.uniform(-1, 1, 1)[0], d.uniform(0.5, 1.5, 1)[0]
            self.goals[world] = d.uniform(-1, 1, 1)[0], d.uniform(-1.5, -0.5, 1)[0]
        env.write("transform", [self.box], which, poses)
        self.last[which] = self._distance(poses[:, 0], self.goals[which])
        self.speeds[which] = 0

    @staticmethod
    def _distance(poses: Any, goals: Any) -> Any:
        x, z = poses[:, 0] - goals[:, 0], poses[:, 2] - goals[:, 1]
        return np.sqrt(x * x + z * z)

    def act(self, actions: Any) -> None:
        self.speeds[:, 0, [0, 2]] = np.clip(actions, -1, 1) * self.speed

    def observe(self) -> Any:
        disc, box = self.poses[:, 0, [0, 2]], self.poses[:, 1]
        x, y, z, w = box[:, 3], box[:, 4], box[:, 5], box[:, 6]
        heading = np.stack([1 - 2 * (y * y + z * z), 2 * (x * z - w * y)], axis=1)
        parts = [disc, box[:, [0, 2]], heading, self.motion[:, 0, [0, 2]], self.goals.astype(np.float32)]
        return np.concatenate(parts, axis=1)

    def judge(self, actions: Any) -> Tuple[Any, Any]:
        distance = self._distance(self.poses[:, 1].astype(np.float64), self.goals)
        gain = self.last - distance
        self.last[:] = distance
        return gain, distance < self.near


def capsule(world: World, a: Tuple[float, float], b: Tuple[float, float], radius: float, z: float = 0.0) -> Body:
    """An upright or level limb from a to b in the plane of x and y, of the density of water."""
    level = a[1] == b[1]
    half = 0.5 * (abs(a[0] - b[0]) if level else abs(a[1] - b[1]))
    root = 0.5**0.5
    rotation = (0, 0, root, root) if level else (0, 0, 0, 1)
    body = world.create_body(position=(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), z), rotation=rotation)
    body.add_capsule(half, radius, group=-1)
    return body


class Walker(Task):
    """Two legs of three parts and a torso, which move in the plane of x and y, are to walk to the right.

    Actions: torques of hip, knee and ankle, left then right, -1 to 1, of 100, 100 and 40 N m. Observed: height (m) and
    lean of the torso (its own y axis), its speed and spin, angles and rates of the joints. The reward is the speed to
    the right less the effort. It ends when the torso is below 0.8 m or leans more than 1 rad."""

    dt, steps, limit = 1 / 120, 2, 1000
    most = np.array([100, 100, 40, 100, 100, 40.0])  # N m

    def __init__(self) -> None:
        self.observation_space = Box(-INFINITE, INFINITE, (17,))
        self.action_space = Box(-1.0, 1.0, (6,))

    def build(self) -> World:
        world = World(substeps=4)
        world.create_body("static").add_plane()
        self.torso = capsule(world, (0, 1.05), (0, 1.45), 0.05)
        self.parts: List[Body] = [self.torso]
        self.joints_of: List[Joint] = []
        for z in (0.1, -0.1):
            thigh, leg = capsule(world, (0, 0.6), (0, 1.05), 0.05, z), capsule(world, (0, 0.1), (0, 0.6), 0.04, z)
            foot = capsule(world, (0, 0.06), (0.2, 0.06), 0.06, z)
            self.parts += [thigh, leg, foot]
            for a, b, y, lower, upper in (
                (self.torso, thigh, 1.05, -1.0, 1.0), (thigh, leg, 0.6, -2.6, 0.0), (leg, foot, 0.1, -0.8, 0.8)
            ):
                limits = dict(limit_enabled=1, lower=lower, upper=upper)
                self.joints_of.append(world.create_hinge_joint(a, b, (0, y, z), (0, 0, 1), **limits))
        for body in self.parts:
            body.locks = ("z", "xy")
        return world

    def bind(self, env: VectorEnv) -> None:
        self.torques = env.input("joint_force", self.joints_of)
        self.pose = env.output("transform", [self.torso])
        self.motion = env.output("velocity", [self.torso])
        self.angles = env.output("joint", self.joints_of)

    def begin(self, env: VectorEnv, which: Any, draws: Sequence[Draws]) -> None:
        speeds = np.zeros((len(which), len(self.parts), 6))
        speeds[:, :, 0] = np.array([d.uniform(-0.1, 0.1, 1) for d in draws])
        env.write("velocity", self.parts, which, speeds)

    def act(self, actions: Any) -> None:
        self.torques[:, :, 0] = np.clip(actions, -1, 1) * self.most

    def observe(self) -> Any:
        pose, motion = self.pose[:, 0], self.motion[:, 0]
        lean = self._lean()
        parts = [pose[:, 1:2], lean, motion[:, [0, 1, 5]], self.angles[:, :, 0], self.angles[:, :, 1]]
        return np.concatenate(parts, axis=1)

    def _lean(self) -> Any:
        z, w = self.pose[:, 0, 5:6], self.pose[:, 0, 6:7]
        return -2 * z * w  # x of its y axis: the sine of its lean to the right

    def judge(self, actions: Any) -> Tuple[Any, Any]:
        effort = 0.001 * (np.clip(actions, -1, 1) ** 2).sum(axis=1)
        speed = self.motion[:, 0, 0].astype(np.float64)
        height, lean = self.pose[:, 0, 1], self._lean()[:, 0]
        return speed - effort, (height < 0.8) | (np.abs(lean) > 0.84)  # sine of 1 rad


class Ragdoll(Task):
    """A figure of eleven capsules is to stay on its feet after a push. Drives hold its ten hinges at angles.

    Actions: those angles, -1 to 1, of 0.5 rad: waist, neck, then shoulder, hip, knee and ankle, left and right.
    Observed: height of the torso (m), the sines of its lean to the front and to the side, its speed and spin, angles and
    rates of the joints. A reward of 1 a step. It ends when the torso is below 0.9 m."""

    dt, limit = 1 / 60, 600
    most, low = 0.5, 0.9  # rad, m

    def __init__(self) -> None:
        self.observation_space = Box(-INFINITE, INFINITE, (29,))
        self.action_space = Box(-1.0, 1.0, (10,))

    def build(self) -> World:
        world = World(substeps=4)
        world.create_body("static").add_plane()
        pelvis = capsule(world, (0, 0.95), (0, 1.05), 0.1)
        self.torso = capsule(world, (0, 1.15), (0, 1.4), 0.12)
        head = capsule(world, (0, 1.6), (0, 1.7), 0.09)
        self.joints_of: List[Joint] = []
        self.parts = [pelvis, self.torso, head]
        self._drive(world, pelvis, self.torso, 1.1, 0)
        self._drive(world, self.torso, head, 1.5, 0)
        for z in (0.12, -0.12):
            arm = capsule(world, (0, 0.8), (0, 1.4), 0.05, 1.8 * z)
            thigh, leg = capsule(world, (0, 0.5), (0, 0.95), 0.06, z), capsule(world, (0, 0.12), (0, 0.5), 0.05, z)
            foot = capsule(world, (-0.08, 0.06), (0.16, 0.06), 0.06, z)
            self.parts += [arm, thigh, leg, foot]
            self._drive(world, self.torso, arm, 1.4, 1.8 * z)
            self._drive(world, pelvis, thigh, 0.95, z)
            self._drive(world, thigh, leg, 0.5, z)
            self._drive(world, leg, foot, 0.1, z)
        return world

    def _drive(self, world: World, a: Body, b: Body, y: float, z: float) -> None:
        drive = dict(spring_hertz=20.0, spring_damping_ratio=1.0)
        self.joints_of.append(world.create_hinge_joint(a, b, (0, y, z), (0, 0, 1), **drive))

    def bind(self, env: VectorEnv) -> None:
        self.targets = env.input("joint_target", self.joints_of)
        self.pose = env.output("transform", [self.torso])
        self.motion = env.output("velocity", [self.torso])
        self.angles = env.output("joint", self.joints_of)

    def begin(self, env: VectorEnv, which: Any, draws: Sequence[Draws]) -> None:
        speeds = np.zeros((len(which), len(self.parts), 6))
        speeds[:, :, 0] = np.array([d.uniform(-0.2, 0.2, 1) for d in draws])
        env.write("velocity", self.parts, which, speeds)
        self.targets[which] = 0

    def act(self, actions: Any) -> None:
        self.targets[:, :, 0] = np.clip(actions, -1, 1) * self.most

    def observe(self) -> Any:
        x, y, z, w = self.pose[:, 0, 3:7].T
        leans = np.stack([2 * (x * y - w * z), 2 * (y * z + w * x)], axis=1)  # x and z of its y axis
        parts = [self.pose[:, 0, 1:2], leans, self.motion[:, 0], self.angles[:, :, 0], self.angles[:, :, 1]]
        return np.concatenate(parts, axis=1)

    def judge(self, actions: Any) -> Tuple[Any, Any]:
        return np.ones(len(self.pose)), self.pose[:, 0, 1] < self.low


TASKS = {"CartPole": CartPole, "BallOnPlate": BallOnPlate, "Push": Push, "Walker": Walker, "Ragdoll": Ragdoll}
