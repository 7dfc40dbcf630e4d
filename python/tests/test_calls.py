# SPDX-License-Identifier: Apache-2.0
"""Threads, signals, progress, limits and memory of calls."""
import gc
import os
import resource
import signal
import threading
import time

import numpy as np
import pytest

import trisect
from trisect import Solid


@pytest.fixture(scope="module")
def balls():
    """Two balls that meet in general position."""
    a = Solid.sphere(1, 5)
    return a, a.rotate((1, 2, 3), 17).translate((0.3, 0.2, 0.1))


@pytest.fixture(scope="module")
def many():
    """Balls whose union takes some tenths of a second on any machine, trees made."""
    ball = Solid.sphere(1, 4)
    balls = []
    while True:
        more = range(len(balls), 2 * len(balls) + 16)
        balls += [ball.rotate((1, 2, i), 17 * i + 5)
                  .translate((0.2 * (i % 5), 0.3 * (i % 3), 0.05 * i)) for i in more]
        trisect.union(balls)
        begin = time.monotonic()
        trisect.union(balls)
        if time.monotonic() - begin > 0.3:
            return balls


@pytest.fixture(autouse=True)
def interruptible():
    """Ctrl-C as in a terminal: a job that a script starts in the background ignores it."""
    old = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, old)


def for_some_seconds():
    """Steps of a loop that something is to end long before this does."""
    begin = time.monotonic()
    while time.monotonic() - begin < 30:
        yield


def test_calls_release_the_lock(many):
    beats = []
    done = threading.Event()

    def beat():
        while not done.is_set():
            beats.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=beat)
    thread.start()
    begin = time.monotonic()
    with trisect.limits(threads=1):
        trisect.union(many)
    end = time.monotonic()
    done.set()
    thread.join()
    # Where the lock is held the other thread beats before and after, and never within.
    within = [t for t in beats if begin < t < end]
    assert len(within) > 10


def test_ctrl_c_stops_inside_one_boolean(many, balls):
    threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        for _ in for_some_seconds():
            trisect.union(many)
    assert time.monotonic() - begin < 5
    # And all goes on afterwards.
    assert (balls[0] & balls[0]).equals(balls[0])


def test_ctrl_c_does_not_wait_for_the_end_of_a_call(many):
    threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT)).start()
    is_done = False
    with pytest.raises(KeyboardInterrupt):
        trisect.union(many)
        is_done = True
        time.sleep(10)  # for the signal
    assert not is_done


def test_other_handlers_run_while_a_call_works(many):
    calls = []
    old = signal.signal(signal.SIGALRM, lambda *_: calls.append(time.monotonic()))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        for _ in for_some_seconds():
            result = trisect.union(many)
            if calls:
                break
        # The handler raised nothing, so the call went on to its result.
        assert len(calls) == 1 and not result.is_empty
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, old)


def test_a_handler_that_raises_ends_the_call(many):
    class OutOfTime(Exception):
        pass

    def raise_it(*_):
        raise OutOfTime

    old = signal.signal(signal.SIGALRM, raise_it)
    try:
        with pytest.raises(OutOfTime):
            signal.setitimer(signal.ITIMER_REAL, 0.1)
            for _ in for_some_seconds():
                trisect.union(many)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, old)


def test_progress_is_reported_and_stops(many):
    seen = []

    def note(seconds, steps):
        seen.append((seconds, steps))

    with trisect.limits(progress=note):
        for _ in for_some_seconds():
            trisect.union(many)
            if len(seen) >= 2:
                break
    assert len(seen) >= 2
    assert all(s > 0 and n > 0 for s, n in seen)

    with trisect.limits(progress=lambda seconds, steps: False):
        with pytest.raises(trisect.CancelledError):
            for _ in for_some_seconds():
                trisect.union(many)

    def fail(seconds, steps):
        raise ZeroDivisionError("from progress")

    with trisect.limits(progress=fail):
        with pytest.raises(ZeroDivisionError, match="from progress"):
            for _ in for_some_seconds():
                trisect.union(many)
    with pytest.raises(TypeError, match="progress must be callable"):
        trisect.limits(progress=3)


@pytest.mark.parametrize("call", [
    lambda v, f: Solid(v, f, embedding="check"),
    lambda v, f: trisect.check(v, f),
    lambda v, f: Solid(v, f, embedding="resolve").volume,
])
def test_import_and_checks_of_large_meshes_stop(call):
    def fail(seconds, steps):
        raise ZeroDivisionError("from progress")

    def stops(segments):
        vertices, faces = Solid.torus(3, 1, segments, 401).mesh()
        with trisect.limits(threads=1, progress=fail):
            try:
                call(vertices, faces)
            except ZeroDivisionError:
                return True
        return False

    # Progress is first called after a twentieth of a second, in which a fast machine may end a call.
    assert any(stops(400 << doubling) for doubling in range(5))


def test_progress_may_call_the_library(many, cube):
    volumes = []

    def nested(seconds, steps):
        volumes.append((cube | cube.translate((2, 0, 0))).volume)

    with trisect.limits(progress=nested):
        for _ in for_some_seconds():
            trisect.union(many)
            if volumes:
                break
    assert set(volumes) == {2.0}


def test_progress_may_use_what_the_call_works_on(many):
    parts = [a - b for a, b in zip(many, many[1:])]  # their trees are made when first needed
    calls = []

    def nested(seconds, steps):
        part = parts[len(calls) % len(parts)]
        calls.append(part.locate((0.1, 0.2, 0.3)).location)

    with trisect.limits(progress=nested):
        for _ in for_some_seconds():
            trisect.union(parts)
            for part in parts:
                part.locate((0, 0, 0))
            if len(calls) >= 3:
                break
    assert len(calls) >= 3


def test_a_scene_is_not_used_by_progress_of_its_own(many):
    scene = trisect.Scene()
    for ball in many:
        scene.add(ball)
    with trisect.limits(progress=lambda seconds, steps: len(scene)):
        with pytest.raises(trisect.UsageError, match="while it works"):
            for i in for_some_seconds():
                scene.interfering(contacts=True)
                scene.add(many[0].translate((0.001 * len(scene), 0, 0)))
    assert len(scene) >= len(many)


def test_limits(balls):
    with trisect.limits(max_work=1000):
        with pytest.raises(trisect.LimitError, match="work budget of 1000"):
            balls[0] | balls[1]
        with trisect.limits(max_work=10):
            with pytest.raises(trisect.LimitError, match="work budget of 10 "):
                balls[0] | balls[1]
    balls[0] | balls[1]


def test_limits_are_those_of_one_thread(balls):
    outcome = []
    with trisect.limits(max_work=10):
        thread = threading.Thread(target=lambda: outcome.append((balls[0] | balls[1]).is_empty))
        thread.start()
        thread.join()
    assert outcome == [False]


def test_results_do_not_depend_on_threads(balls):
    results = []
    for threads in (1, 2, 0):
        with trisect.limits(threads=threads):
            results.append((balls[0] - balls[1]).mesh())
    for v, f in results[1:]:
        assert (v == results[0][0]).all() and (f == results[0][1]).all()


def test_many_threads_share_solids(balls):
    expected = (balls[0] - balls[1]).triangle_count
    counts = []

    def work():
        counts.append((balls[0] - balls[1]).triangle_count)

    threads = [threading.Thread(target=work) for _ in range(8)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert counts == [expected] * 8


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="needs /proc")
def test_memory_stays_flat():
    v, f = Solid.box((0, 0, 0), (1, 1, 1)).mesh()
    w = v + 0.5

    def one():
        result = (Solid(v, f) - Solid(w, f)).mesh(sources=True)
        assert result[0].shape[0] == 14

    for _ in range(500):
        one()
    gc.collect()
    before = resident()
    for _ in range(10_000):
        one()
    gc.collect()
    assert resident() - before < 4 << 20


def test_errors_do_not_leak_references():
    v, f = Solid.box((0, 0, 0), (1, 1, 1)).mesh()
    import sys

    before = sys.getrefcount(v), sys.getrefcount(f)
    for _ in range(100):
        with pytest.raises(trisect.InvalidSolid):
            Solid(v, f[1:])
        with pytest.raises(trisect.UsageError):
            Solid(v, f + 1)
    gc.collect()
    assert (sys.getrefcount(v), sys.getrefcount(f)) == before


def test_exceptions_derive_from_what_python_has():
    assert issubclass(trisect.UsageError, ValueError) and issubclass(trisect.UsageError, trisect.Error)
    assert issubclass(trisect.InvalidSolid, ValueError)
    assert issubclass(trisect.LimitError, trisect.Error)
    assert not issubclass(trisect.CancelledError, ValueError)
