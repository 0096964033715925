"""Two players in two processes over UDP, with rollback: nobody waits for the other's keys.

python3 rollback.py [SECONDS [SEED]]      python3 rollback.py --synctest FRAMES

The first process is a bad network: it loses packets, delivers them late, twice and out of order. A player expects the
other's keys to be what they were last, and goes on. When the true ones come and are others, the world goes back, and
the steps since are made again. Worlds before frames whose keys are all known are the same for both, bit for bit.
"""

import heapq
import multiprocessing
import random
import select
import socket
import struct
import sys
import time
from typing import Any, Dict, List, Tuple

from feather_physics import World

RATE = 240  # frames a second: a game has 60
HISTORY, AHEAD, INPUT_DELAY = 16, 8, 2  # frames
DELAYS, LOST, DOUBLED = (2, 8), 0.10, 0.05  # frames; shares
LEFT, RIGHT, FORWARD, BACK, JUMP = 1, 2, 4, 8, 16


def keys_of(player: int, frame: int) -> int:
    """A player holds its keys for a third of a second."""
    return random.Random(player * 100003 + frame // 20).randrange(32)


class Game:
    """A frame is the same calls in the same order for the same keys."""

    def __init__(self) -> None:
        self.world = World(number=1)  # the same handles for both
        self.world.create_body("static").add_plane()
        for i in range(16):
            self.world.create_body(position=(0.7 * (i % 4) - 1, 0.3 + 0.6 * (i // 4), 0)).add_box(0.3, 0.3, 0.3)
        self.cars = [self.world.create_body(position=(0, 0.25, z)) for z in (-5, 5)]
        for car in self.cars:
            car.add_box(0.5, 0.25, 0.8)

    def step(self, keys: List[int]) -> None:
        for car, pressed in zip(self.cars, keys):
            side = bool(pressed & RIGHT) - bool(pressed & LEFT)
            ahead = bool(pressed & FORWARD) - bool(pressed & BACK)
            car.add_force((4000 * side, 12000 * bool(pressed & JUMP), 4000 * ahead))
        self.world.step(1 / 60)


class Session:
    """What a player knows, and the way back."""

    def __init__(self) -> None:
        self.game = Game()
        self.history = self.game.world.history(frames=HISTORY)
        self.known: List[List[int]] = [[], []]  # true keys of both, by frame
        self.played: List[List[int]] = []  # what each frame was made with
        self.hashes = [self.game.world.hash]  # of the world before each frame

    def expected(self, player: int, frame: int) -> int:
        known = self.known[player]
        return known[frame] if frame < len(known) else known[-1] if known else 0

    def make_frame(self, is_kept: bool = False) -> None:
        frame = len(self.played)
        if not is_kept:
            self.history.keep(frame)
        self.played.append([self.expected(player, frame) for player in (0, 1)])
        self.game.step(self.played[-1])
        self.hashes.append(self.game.world.hash)

    def go_back(self, frame: int) -> None:
        now = len(self.played)
        self.history.restore(frame)
        del self.played[frame:], self.hashes[frame + 1 :]
        self.make_frame(is_kept=True)
        while len(self.played) < now:
            self.make_frame()

    def learn(self, player: int, first: int, keys: bytes) -> None:
        """The keys of some frames. What is known says nothing new; what follows a gap comes again."""
        known = self.known[player]
        if first <= len(known):
            known.extend(keys[len(known) - first :])

    def mend(self) -> int:
        """Goes back to the first frame that was made with other keys than the true ones. Returns how many are sure."""
        sure = min(len(self.played), len(self.known[0]), len(self.known[1]))
        for frame in range(max(0, len(self.played) - HISTORY), len(self.played)):
            if any(self.played[frame][p] != self.expected(p, frame) for p in (0, 1) if frame < len(self.known[p])):
                self.go_back(frame)
                break
        return sure


HEAD = struct.Struct("<BBii")  # to, from, first frame of the keys, first frame that the sender does not know


def play(player: int, link: socket.socket, network: Any, frames: int, results: Any) -> None:
    """The process of a player."""
    session, mine, other, acknowledged = Session(), player, 1 - player, 0
    next_tick = time.monotonic()
    lingering = 2 * RATE  # frames in which the other may still ask for keys
    while lingering:
        while select.select([link], [], [], max(0.0, next_tick - time.monotonic()))[0]:
            data = link.recv(2048)
            _, _, first, unknown = HEAD.unpack_from(data)
            session.learn(other, first, data[HEAD.size :])
            acknowledged = max(acknowledged, unknown)
        sure = session.mend()
        frame = len(session.played)
        if frame < frames and frame - len(session.known[other]) < AHEAD:
            while len(session.known[mine]) <= frame + INPUT_DELAY:
                session.known[mine].append(keys_of(mine, len(session.known[mine])))
            session.make_frame()
        if sure >= frames and acknowledged >= frames:
            lingering -= 1
        head = HEAD.pack(other, mine, acknowledged, len(session.known[other]))
        link.sendto(head + bytes(session.known[mine][acknowledged:][:64]), network)
        next_tick = max(next_tick + 1 / RATE, time.monotonic())
    results.put((player, session.hashes))


def deliver(link: socket.socket, addresses: List[Any], seed: int, results: Any) -> Tuple[int, Dict[int, List[int]]]:
    """The network: passes on packets until the players are done. Returns how many, and what the players say."""
    chance, number = random.Random(seed), 0
    under_way: List[Tuple[float, int, bytes]] = []
    hashes: Dict[int, List[int]] = {}
    while len(hashes) < 2:
        if not results.empty():
            hashes.update([results.get()])
        if select.select([link], [], [], 0.001)[0]:
            data = link.recv(2048)
            for _ in range(0 if chance.random() < LOST else 2 if chance.random() < DOUBLED else 1):
                number += 1
                heapq.heappush(under_way, (time.monotonic() + chance.uniform(*DELAYS) / RATE, number, data))
        while under_way and under_way[0][0] <= time.monotonic():
            data = heapq.heappop(under_way)[2]
            link.sendto(data, addresses[data[0]])
    return number, hashes


def play_alone(frames: int) -> List[int]:
    """The hashes of the game without a network."""
    game = Game()
    hashes = [game.world.hash]
    for frame in range(frames):
        game.step([keys_of(player, frame) for player in (0, 1)])
        hashes.append(game.world.hash)
    return hashes


def play_together(frames: int, seed: int) -> bool:
    links = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(3)]
    for link in links:
        link.bind(("127.0.0.1", 0))
    addresses = [link.getsockname() for link in links]
    context = multiprocessing.get_context("fork")  # the sockets go along
    results: Any = context.Queue()
    processes = [
        context.Process(target=play, args=(player, links[player], addresses[2], frames, results), daemon=True)
        for player in (0, 1)
    ]
    for process in processes:
        process.start()
    number, hashes = deliver(links[2], addresses, seed, results)
    alone = play_alone(frames)
    differ = sum(hashes[player][frame] != alone[frame] for player in (0, 1) for frame in range(frames + 1))
    print(f"{frames} frames, {number} packets; {differ} frames differ from the game without a network")
    return differ == 0


def test_going_back(frames: int, back: int) -> bool:
    """Each frame goes back, and must come out the same."""
    session, alone = Session(), play_alone(frames)
    for frame in range(frames):
        for player in (0, 1):
            session.known[player].append(keys_of(player, frame))
        session.make_frame()
        session.go_back(max(frame + 1 - back, 0))
    differ = sum(a != b for a, b in zip(session.hashes, alone))
    print(f"{frames} frames, each went back by {back}: {differ} differ")
    return differ == 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["--synctest"]:
        sys.exit(not test_going_back(300, int(sys.argv[2]) if len(sys.argv) > 2 else 8))
    seconds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    sys.exit(not play_together(60 * seconds, int(sys.argv[2]) if len(sys.argv) > 2 else 1))
