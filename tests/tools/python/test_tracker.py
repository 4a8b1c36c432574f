"""rimline.Tracker and SilhouetteService: change sets against silhouettes from nothing."""

import gc
import resource
import sys
import threading
import time
import weakref

import numpy as np
import pytest
from conftest import orbit, pairs

import rimline


@pytest.fixture(scope="module")
def knot():
    return rimline.load("shape:knot:5000")


def apply(change, slots, words):
    slots[change.slots[:, 0]] = change.slots[:, 1]
    words[change.words[:, 0]] = change.words[:, 1]
    return set(slots[: change.silhouette_size].tolist())


def test_change_sets_lead_to_the_silhouette(knot):
    eyes = orbit(knot, 100)
    tracker = rimline.Tracker(knot, eyes[0])
    assert set(tracker.silhouette.tolist()) == set(knot.silhouette(eyes[0]).ids.tolist())
    slots = np.zeros(len(knot.edges), dtype=np.uint32)
    slots[: len(tracker.silhouette)] = tracker.silhouette
    words = tracker.face_words
    front, edges = tracker.front_faces, set(tracker.silhouette.tolist())
    for number, eye in enumerate(eyes[1:], 1):
        change = tracker.move_to(eye)
        expected = set(knot.silhouette(eye).ids.tolist())
        edges = (edges | set(change.added.tolist())) - set(change.removed.tolist())
        assert edges == expected == apply(change, slots, words) == set(tracker.silhouette.tolist())
        front[change.flipped] ^= True
        assert (front == knot.front_faces(eye)).all() and (front == tracker.front_faces).all()
        assert (words == tracker.face_words).all()
        assert change.sequence == tracker.sequence == number
        assert change.point == tracker.point == (*eye.astype(np.float32).tolist(), 1.0)
        assert pairs(tracker.edges) == pairs(knot.silhouette(eye).edges)
    change = tracker.move_to(direction=(1, 2, 3))
    assert change.point == (1, 2, 3, 0)
    assert set(tracker.silhouette.tolist()) == set(knot.silhouette(direction=(1, 2, 3)).ids.tolist())


def test_arrays_outlive_moves_the_tracker_and_the_mesh():
    mesh = rimline.load("shape:knot:5000")
    eyes = orbit(mesh, 60)
    tracker = rimline.Tracker(mesh, eyes[0])
    kept, copies = [], []
    for eye in eyes[1:]:
        change = tracker.move_to(eye)
        kept.append([change.added, change.slots[::2, 1], change.words, change.flipped])
        copies.append([array.copy() for array in kept[-1]])
        del change
    del tracker, mesh
    gc.collect()
    for arrays, copied in zip(kept, copies):
        assert all((a == b).all() for a, b in zip(arrays, copied))


def test_arrays_are_views_and_their_memory_is_used_again(knot):
    eyes = orbit(knot, 10)
    tracker = rimline.Tracker(knot, eyes[0])
    change = tracker.move_to(eyes[1])
    assert change.added.base is not None and not change.added.flags.writeable
    assert change.added.ctypes.data == change.added.ctypes.data
    with pytest.raises(ValueError):
        change.added[:] = 0
    first = id(change)
    del change
    assert id(tracker.move_to(eyes[2])) == first
    held = tracker.move_to(eyes[3]).added
    assert tracker.move_to(eyes[4]).added.base is not held.base


def test_a_change_set_with_weak_references_does_not_change(knot):
    eyes = orbit(knot, 10)
    tracker = rimline.Tracker(knot, eyes[0])
    change = tracker.move_to(eyes[1])
    weak, sequence = weakref.ref(change), change.sequence
    del change
    tracker.move_to(eyes[2])
    assert weak() is None or weak().sequence == sequence


def test_wrong_arguments_leave_the_tracker_as_it_was(knot):
    tracker = rimline.Tracker(knot, (2, 1, 2))
    before = tracker.silhouette
    for wrong in ((), ((1, 2),), (None,), ((np.nan, 0, 0),)):
        with pytest.raises((TypeError, ValueError)):
            tracker.move_to(*wrong)
    assert (tracker.silhouette == before).all() and tracker.sequence == 0
    for mesh in (None, 3, "shape:knot"):
        with pytest.raises(TypeError):
            rimline.Tracker(mesh, (1, 2, 3))


def test_threads_may_share_meshes_and_trackers():
    mesh = rimline.load("shape:knot:50000")  # Without an index: the first thread makes it.
    eyes = orbit(mesh, 60)
    shared = rimline.Tracker(mesh, eyes[0])
    failures = []

    def work(start):
        try:
            own = rimline.Tracker(mesh, eyes[start])
            for i in range(len(eyes)):
                eye = eyes[(start + i) % len(eyes)]
                own.move_to(eye)
                assert set(own.silhouette.tolist()) == set(mesh.silhouette(eye).ids.tolist())
                shared.move_to(eye).added.sum()
                len(shared.silhouette)
        except BaseException as error:  # noqa: B902
            failures.append(error)

    threads = [threading.Thread(target=work, args=(10 * i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures
    shared.move_to(eyes[3])
    assert set(shared.silhouette.tolist()) == set(mesh.silhouette(eyes[3]).ids.tolist())


def test_a_hundred_thousand_moves_hold_no_more_memory(knot):
    eyes = [tuple(eye) for eye in orbit(knot, 1000).tolist()]
    tracker = rimline.Tracker(knot, eyes[0])

    def resident_kb():
        gc.collect()
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * resource.getpagesize() // 1024

    for step in range(100_000):
        change = tracker.move_to(eyes[step % 1000])
        len(change.added), len(change.slots)
        if step == 10_000:
            before = resident_kb()
    assert resident_kb() <= 1.01 * before + 256
    assert tracker.sequence == 100_000


def test_a_call_costs_less_than_five_microseconds_beside_the_move():
    """A tracker that stays where it is does nothing: what is left is the call."""
    tracker = rimline.Tracker(rimline.load("shape:box"), (3, 2, 1))
    eyes = [(3, 2, 1), np.array([3.0, 2.0, 1.0])]
    best = float("inf")
    for eye in eyes:
        for _ in range(20):
            start = time.perf_counter()
            for _ in range(1000):
                tracker.move_to(eye).added
            best = min(best, (time.perf_counter() - start) / 1000)
    print(f"{1e6 * best:.2f} us a call")
    assert best < 5e-6


def test_a_service_follows_points_in_order(knot):
    eyes = orbit(knot, 200)
    with rimline.SilhouetteService(workers=2) as service:
        assert service.worker_count == 2
        trackers = [service.add(knot, eyes[0]) for _ in range(3)]
        states = []
        for tracker in trackers:
            snapshot = tracker.snapshot()
            slots = np.zeros(len(knot.edges), dtype=np.uint32)
            slots[: len(snapshot.slots)] = snapshot.slots
            states.append([slots, snapshot.words.copy(), snapshot.sequence])
            assert set(snapshot.slots.tolist()) == set(knot.silhouette(eyes[0]).ids.tolist())
            assert (snapshot.front_faces == knot.front_faces(eyes[0])).all()
        for eye in eyes[1:]:
            for tracker in trackers:
                tracker.post(eye)
            for tracker, state in zip(trackers, states):
                change = tracker.take(5.0)
                assert change is not None and change.sequence == state[2] + 1
                state[2] = change.sequence
                assert apply(change, state[0], state[1]) == set(knot.silhouette(eye).ids.tolist())
        assert trackers[0].take() is None
        for timeout, error in ((float("nan"), ValueError), (-1, ValueError), ("1", TypeError), (None, TypeError)):
            with pytest.raises(error, match="timeout"):
                trackers[0].take(timeout)
        assert trackers[0].remove() and not trackers[0].remove()
        with pytest.raises(rimline.CancelledError):
            trackers[0].post((1, 2, 3))
        with pytest.raises(rimline.CancelledError):
            trackers[0].take()
        with pytest.raises(rimline.CancelledError):
            trackers[0].snapshot()
    with pytest.raises(rimline.CancelledError):
        trackers[1].post((1, 2, 3))
    with pytest.raises(rimline.CancelledError):
        service.add(knot, (1, 2, 3))
    with pytest.raises(ValueError):
        rimline.SilhouetteService(max_pending=0)


def test_a_tracker_of_a_service_keeps_what_it_needs():
    tracker = rimline.SilhouetteService(workers=1).add(rimline.load("shape:torus:2000"), (3, 2, 1))
    gc.collect()
    tracker.post((3, 2, 0.5))
    assert tracker.take(5.0) is not None
    assert sys.getrefcount(tracker) == 2


def test_taking_ends_where_the_service_is_stopped():
    service = rimline.SilhouetteService(workers=1)
    tracker = service.add(rimline.load("shape:torus:2000"), (3, 2, 1))
    tracker.post((3, 2, 0.5))
    assert tracker.take(5.0) is not None
    thread = threading.Timer(0.2, service.stop)
    thread.start()
    start = time.perf_counter()
    with pytest.raises(rimline.CancelledError, match="stopped"):
        tracker.take(60.0)
    assert time.perf_counter() - start < 30
    thread.join()


def test_a_service_has_as_many_workers_as_are_of_use():
    for wrong in (-1, 1025, 10**6):
        with pytest.raises(ValueError, match="workers: expected 0 to 1024"):
            rimline.SilhouetteService(workers=wrong)
