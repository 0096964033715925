"""Recordings: made, read, written to files, played; what ends them, and what lives how long."""

import gc
import threading
from array import array
from pathlib import Path
from typing import Any, List, Tuple

import pytest

from feather_physics import (
    BusyError,
    DataError,
    DivergedError,
    Heightfield,
    InvalidArgumentError,
    LimitError,
    Player,
    Pool,
    Recorder,
    Recording,
    StaleHandleError,
    StateError,
    SteppingError,
    Store,
    World,
)

DT = 1 / 60


def pile(count: int = 12) -> World:
    world = World()
    world.create_body("static").add(world.create_heightfield([[0.1 * ((5 * i + k) % 3) for k in range(9)] for i in range(9)]))
    for i in range(count):
        world.create_body(position=(3 + 0.1 * (i % 3), 1 + 0.9 * i, 4)).add_box(0.4, 0.4, 0.4)
    return world


def run(world: World, steps: int) -> List[int]:
    hashes = []
    for step in range(steps):
        if step % 10 == 5:
            world.bodies[1 + step % 7].add_impulse((0.3, 0.5, 0.1))
        if step == 30:
            world.create_body(position=(4, 12, 4)).add_sphere(0.3)
        world.step(DT)
        hashes.append(world.hash)
    return hashes


def recorded(steps: int = 60, **options: Any) -> bytes:
    with pile() as world, world.recorder(**options) as recorder:
        run(world, steps)
        return recorder.read()


@pytest.mark.parametrize("fine", [False, True])
def test_a_file_plays_with_any_workers(tmp_path: Path, fine: bool) -> None:
    path = tmp_path / "run.feather"
    with pile() as world:
        with world.record(path, fine=fine, keyframe_steps=25) as recording:
            recording.note("it begins")
            hashes = run(world, 70)
            recording.note("a body: ä", world.bodies[2])
        handle = world.bodies[2].id
    for workers, simd in ((1, "auto"), (2, "auto"), (3, "plain")):
        with Player(path if workers == 1 else path.read_bytes(), workers=workers, simd=simd) as player:
            assert [replay.hash for replay in player] == hashes
            assert player.step() is False and player.divergence is None
            info = player.info
            assert (info.first_step, info.step, info.has_diverged, info.foreign) == (0, 70, False, False)
            assert info.bytes == path.stat().st_size and info.keyframes >= 3 and info.notes == 2
            assert player.notes == [(0, 0, "it begins"), (70, handle, "a body: ä")]


def test_seeks_go_both_ways_in_what_was_fed_in_pieces() -> None:
    with pile() as world, world.recorder(keyframe_steps=20) as recorder:
        hashes, pieces = [], []
        for _ in range(6):
            hashes += run(world, 15)
            pieces.append(recorder.read())
        assert all(pieces) and recorder.read() == b""
    player = Player()
    with pytest.raises(StateError, match="step it or seek"):
        player.world
    assert player.step() is False and player.seek(3) is False and player.divergence is None and player.notes == []
    whole = b"".join(pieces)
    for i in range(0, len(whole), 333):
        player.feed(memoryview(whole)[i : i + 333])
    for step in (90, 7, 46, 45, 1, 88):
        assert player.seek(step) is True and player.info.step == step
        assert player.world.hash == hashes[step - 1]
    assert player.seek(91) is False
    with pytest.raises(InvalidArgumentError):
        player.seek(-1)
    late = pile()
    late.step(DT)
    part = Player(late.recorder().read())
    with pytest.raises(InvalidArgumentError, match="begins at"):
        part.seek(0)


def test_a_file_is_whole_whatever_is_raised(tmp_path: Path) -> None:
    path = tmp_path / "run.feather"
    world = pile()
    with pytest.raises(ZeroDivisionError):
        with world.record(str(path)) as recording:
            hashes = run(world, 37)
            assert recording.read() == b""
            1 / 0
    assert recording.closed and [replay.hash for replay in Player(path)] == hashes
    with pytest.raises(StaleHandleError):
        recording.note("late")
    recording.close()
    with world.record(path) as recording:
        hashes = run(world, 22)
        before = path.stat().st_size
        recording.flush()
        assert [replay.hash for replay in Player(path)] == hashes and before < path.stat().st_size
        hashes += run(world, 3)
        world.close()
        assert recording.closed
    assert [replay.hash for replay in Player(path)] == hashes


def test_a_file_grows_with_the_steps(tmp_path: Path) -> None:
    for fine, steps in ((False, 15), (True, 1)):
        with pile() as world, world.record(tmp_path / "run", fine=fine) as recording:
            recording.flush()
            size = (tmp_path / "run").stat().st_size
            file: Any = recording._file
            for _ in range(steps - 1):
                world.step(DT)
                assert file.tell() == size
            world.step(DT)
            assert file.tell() > size


def test_a_file_that_fails_ends_the_recording_and_no_step() -> None:
    world = pile()
    recording = world.record("/dev/full", fine=True)
    run(world, 200)
    with pytest.raises(OSError):
        recording.flush()
    with pytest.raises(OSError):
        recording.close()
    assert recording.closed
    with world.recorder():
        world.step(DT)


def test_a_world_that_cannot_be_recorded_leaves_the_file(tmp_path: Path) -> None:
    path = tmp_path / "run"
    path.write_bytes(b"precious")
    world = World()
    with world.recorder():
        for begin in (world.recorder, lambda: world.record(path)):
            with pytest.raises(StateError, match="has a recorder"):
                begin()
    for wrong in ({"keyframe_steps": -1}, {"buffer_bytes": 100}):
        with pytest.raises(InvalidArgumentError):
            world.record(path, **wrong)
        with pytest.raises(InvalidArgumentError):
            world.recorder(**wrong)
    for mistyped in ({"keyframe_steps": "x"}, {"buffer_bytes": None}, {"keyframe_steps": 1.5}):
        with pytest.raises(TypeError):
            world.recorder(**mistyped)  # type: ignore[arg-type]
    assert path.read_bytes() == b"precious"
    for name in (5, None, 1.5):
        with pytest.raises(TypeError):
            world.record(name)  # type: ignore[arg-type]
    with pytest.raises(OSError):
        world.record(tmp_path / "nowhere" / "run")
    world.recorder().close()
    world.close()
    with pytest.raises(StaleHandleError):
        world.recorder()


def test_what_ends_a_recording() -> None:
    world = pile()
    recorder = world.recorder()
    hashes = run(world, 9)
    world.close()
    with pytest.raises(StateError, match="ended"):
        recorder.note("late")
    assert [replay.hash for replay in Player(recorder.read())] == hashes
    assert recorder.read() == b""
    recorder.close()
    recorder.close()
    for call in (recorder.read, lambda: recorder.note("x")):
        with pytest.raises(StaleHandleError, match="closed"):
            call()
    world = pile()
    recorder = world.recorder(fine=True, buffer_bytes=65536)
    run(world, 1000)
    waiting = recorder.read()
    assert 0 < len(waiting) <= 65536 and 0 < sum(1 for _ in Player(waiting)) < 1000
    with pytest.raises(LimitError, match="nobody read"):
        recorder.read()
    with pytest.raises(LimitError, match="keyframe"):
        recorder.close()
        pile(200).recorder(buffer_bytes=65536)


def test_a_recorder_that_nobody_has_ends_even_in_a_step() -> None:
    world = pile()
    world.recorder()
    gc.collect()
    kept: List[Recorder] = [world.recorder()]
    refused = 0

    def judge(pair: Any) -> bool:
        nonlocal refused
        if kept:
            try:
                kept[0].close()
            except SteppingError:
                refused += 1
            kept.clear()
        return True

    world.set_pair_filter(judge)
    world.create_body(position=(20, 5, 4)).add_sphere(0.5, pair_filter=True)
    world.create_body(position=(20, 5.2, 4)).add_sphere(0.5, pair_filter=True)
    world.step(DT)
    assert not kept and refused == 1
    with world.recorder():
        pass


def test_a_flight_recorder_keeps_the_last_steps() -> None:
    world = pile()
    with world.recorder(last=True, buffer_bytes=65536, keyframe_steps=20) as recorder:
        hashes = run(world, 400)
        kept = recorder.read()
        assert recorder.read() == kept and len(kept) <= 65536
    player = Player(kept)
    played = [replay.hash for replay in player]
    assert 20 <= len(played) < 400 and played == hashes[-len(played) :] and player.info.first_step == 400 - len(played)


def test_the_world_of_a_player_is_to_be_read() -> None:
    player = Player(recorded())
    player.seek(20)
    world = player.world
    assert player.world is world
    body = world.bodies[1]
    where = body.position
    for change in (
        lambda: world.step(DT),
        lambda: world.create_body(),
        lambda: setattr(body, "position", (0, 0, 0)),
        lambda: setattr(world, "gravity", (0, 0, 0)),
        lambda: world.restore(world.save()),
        lambda: world.set_pair_filter(lambda pair: True),
        body.destroy,
        world.close,
        world.recorder,
        world.history,
    ):
        with pytest.raises(StateError, match="player's"):
            change()
    assert body.position == where and world.raycast((3, 20, 4), (0, -40, 0)) is not None and world.counters.bodies == 13
    assert World.load(world.save(assets=True)).hash == world.hash
    player.step()
    assert body.position != where
    player.close()
    player.close()
    assert world.closed and player.closed
    for call in (lambda: body.position, lambda: world.hash, player.step, lambda: player.info, lambda: player.world, player.release):
        with pytest.raises(StaleHandleError):
            call()


def test_a_world_outlives_the_player_that_nobody_has() -> None:
    player = Player(recorded())
    player.seek(20)
    world, expected = player.world, player.world.hash
    del player
    gc.collect()
    assert world.hash == expected
    with pytest.raises(StateError):
        world.step(DT)


def test_a_released_world_goes_on() -> None:
    data = recorded()
    twin = pile()
    expected = run(twin, 20)
    twin.step(DT)
    for has_view in (False, True):
        player = Player(data, workers=2)
        with pytest.raises(StateError):
            player.release()
        player.seek(20)
        view = player.world if has_view else None
        world = player.release()
        assert view is None or view is world
        with pytest.raises(StateError):
            player.world
        assert world.hash == expected[-1]
        world.step(DT)
        assert world.hash == twin.hash
        assert player.seek(10) is True and player.world is not world and player.world.hash == expected[9]
        player.close()
        world.step(DT)
        world.create_body()
        world.close()


def test_pools_and_stores_of_a_player() -> None:
    data = recorded(assets=False)
    with pytest.raises(StateError, match="nowhere"):
        Player(data).step()
    with Pool(2) as pool, Store() as store:
        store.create_heightfield([[0.1 * ((5 * i + k) % 3) for k in range(9)] for i in range(9)])
        player = Player(data, pool=pool, store=store)
        assert player.seek(50) and player.world.store is store
        with pytest.raises(StateError):
            pool.close()
        world = player.release()
        player.close()
        world.step(DT)
        with pytest.raises(StateError):
            pool.close()
        world.close()
        idle = Player(data, pool=pool, store=store)
    with pytest.raises(StaleHandleError):
        idle.step()
    with pytest.raises(StaleHandleError):
        Player(pool=pool)


def test_a_player_and_its_world_keep_the_pool_that_nobody_has() -> None:
    player = Player(recorded(), pool=Pool(2))
    gc.collect()
    assert player.seek(50)
    world = player.release()
    del player
    gc.collect()
    world.step(DT)


def flight(speed: float, fine: bool) -> Tuple[bytes, bytes, int]:
    """A body's first keyframe, its 60 steps, its handle."""
    with World(number=7) as world:
        body = world.create_body(linear_velocity=(0, 0, speed))
        body.add_sphere(0.5)
        recorder = world.recorder(fine=fine)
        first = recorder.read()
        for _ in range(60):
            world.step(DT)
        return first, recorder.read(), body.id


def test_who_goes_another_way_is_named() -> None:
    for fine in (False, True):
        (first, _, body), (_, rest, _) = flight(1, fine), flight(2, fine)
        player = Player(first)
        player.feed(rest)
        with pytest.raises(DivergedError):
            while player.step():
                pass
        found = player.divergence
        assert found is not None and found.kind == "step" and found.step == 1 and "1" in found.text
        assert player.info.has_diverged
        if fine:
            assert (found.body, found.component) == (body, 2) and "velocity" in found.field
        else:
            assert (found.body, found.component) == (0, -1)
        while player.step():  # once
            pass
        assert player.divergence == found and player.info.step == 60


def test_what_a_player_s_world_stands_on_is_not_edited() -> None:
    player = Player(recorded())
    player.seek(40)
    ground = player.world.bodies[0].shapes[0].geometry
    assert isinstance(ground, Heightfield)
    with pytest.raises(BusyError, match="player"):
        ground.set_heights(0, 0, 9, 9, array("f", [2.0] * 81))
    while player.step():
        pass
    assert player.divergence is None


def test_wrong_bytes_and_arguments() -> None:
    data = recorded(20)
    for wrong in (b"no recording of a world, by no means: of nothing at all", bytes(1000)):
        with pytest.raises(DataError):
            Player(wrong)
    altered = bytearray(data)
    altered[len(data) - 3] ^= 4
    player = Player()
    with pytest.raises(DataError):
        player.feed(altered)
    assert Player(data[:-1]).info.bytes < len(data) and Player(b"").step() is False
    for mistyped in (5, 1.5, object()):
        with pytest.raises(TypeError):
            Player(mistyped)
        with pytest.raises(TypeError):
            player.feed(mistyped)
    with pytest.raises(TypeError):
        player.feed(None)
    for mistyped in ("x", None, 1.5):
        with pytest.raises(TypeError):
            player.seek(mistyped)  # type: ignore[arg-type]
    for options in ({"workers": 0}, {"workers": 65}, {"simd": "mmx"}):
        with pytest.raises(InvalidArgumentError):
            Player(**options)  # type: ignore[arg-type]
    with pytest.raises(OSError):
        Player("/nowhere/run.feather")
    world, other = World(), World()
    with world.recorder() as recorder:
        recorder.note("x" * 4096)
        with pytest.raises(InvalidArgumentError):
            recorder.note("x" * 4097)
        with pytest.raises(InvalidArgumentError, match="another world"):
            recorder.note("x", other.create_body())
        with pytest.raises(ValueError, match="null"):
            recorder.note("a\0b")
        with pytest.raises(UnicodeEncodeError):
            recorder.note("\ud800")
        for mistyped in (5, b"x", None):
            with pytest.raises(TypeError):
                recorder.note(mistyped)  # type: ignore[arg-type]
        with pytest.raises(TypeError):
            recorder.note("x", 5)  # type: ignore[arg-type]


def test_other_threads_run_while_a_player_plays() -> None:
    data = recorded(200)
    busy = 0
    for _ in range(50):
        player = Player(data)
        player.seek(1)
        world = player.world
        thread = threading.Thread(target=player.seek, args=(200,))
        thread.start()
        while thread.is_alive():
            for call in (lambda: player.info, lambda: world.hash, player.close):
                try:
                    call()
                except BusyError:
                    busy += 1
                except StaleHandleError:
                    pass
                else:
                    break
            if busy:
                break
        thread.join()
        if busy:
            break
    assert busy


def test_a_recorder_is_read_by_another_thread() -> None:
    world = pile(30)
    recorder = world.recorder()
    pieces: List[bytes] = []
    done = threading.Event()

    def read() -> None:
        while not done.is_set():
            pieces.append(recorder.read())

    thread = threading.Thread(target=read)
    thread.start()
    hashes = run(world, 100)
    done.set()
    thread.join()
    pieces.append(recorder.read())
    assert [replay.hash for replay in Player(b"".join(pieces))] == hashes


def test_who_reads_first_writes_first(tmp_path: Path) -> None:
    world = pile()
    inside, go = threading.Event(), threading.Event()

    class Slow:
        """The first who writes waits in it."""

        def __init__(self, file: Any):
            self.flush, self.close, self.file = file.flush, file.close, file

        def write(self, data: bytes) -> None:
            if not inside.is_set():
                inside.set()
                go.wait()
            self.file.write(data)

    with world.record(tmp_path / "run") as recording:
        hashes = run(world, 5)
        recording._file = Slow(recording._file)  # type: ignore[assignment]
        first, second = (threading.Thread(target=recording.flush) for _ in range(2))
        first.start()
        inside.wait()
        hashes += run(world, 5)
        second.start()
        second.join(0.2)  # it would be done, if it did not wait for the first
        go.set()
        first.join()
        second.join()
    assert [replay.hash for replay in Player(tmp_path / "run")] == hashes


def test_an_interrupt_leaves_no_gap(tmp_path: Path) -> None:
    world = pile()

    class Interrupted:
        def write(self, data: bytes) -> None:
            raise KeyboardInterrupt

    recording: Any = world.record(tmp_path / "run", fine=True)
    hashes = run(world, 10)
    file, recording._file = recording._file, Interrupted()
    with pytest.raises(KeyboardInterrupt):
        world.step(DT)
    recording._file = file
    run(world, 10)
    with pytest.raises(OSError, match="interrupted"):
        recording.close()
    assert [replay.hash for replay in Player(tmp_path / "run")] == hashes
