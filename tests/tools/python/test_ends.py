"""The end of the interpreter while daemon threads call, and children of fork."""

import subprocess
import sys

import pytest
from conftest import have_device

import rimline

LOOPS = """
import os, sys, threading, time
import rimline

mesh, big = rimline.load("shape:knot:2000"), rimline.load("shape:knot:200000")
tracker, drawing = rimline.Tracker(mesh, (2, 1, 5)), rimline.draw(mesh)
service = rimline.SilhouetteService(workers=1)
followed = service.add(mesh, (2, 1, 5))
eyes = [(2, 1, 5), (5, 1, 2)]

def follow():
    eyes.reverse()
    followed.post(eyes[0])
    followed.take(timeout=1)

def move():
    eyes.reverse()
    tracker.move_to(eyes[0])

def render():
    renderer.render(mesh, size=(64, 64))

calls = {
    "move_to": move,
    "edges": lambda: tracker.edges,
    "take": lambda: followed.take(timeout=1),
    "follow": follow,
    "snapshot": followed.snapshot,
    "front_faces": lambda: big.front_faces((2, 1, 5)),
    "edge_faces": lambda: big.edge_faces,
    "to_svg": drawing.to_svg,
    "save": lambda: drawing.save(sys.argv[2]),
    "silhouette": lambda: big.silhouette(eye=(2, 1, 5), progress=None),
    "mesh": lambda: rimline.Mesh(big.vertices, big.faces, progress=lambda share: None),
    "bar": lambda: rimline.Mesh(big.vertices, big.faces, progress=bar),
    "index": lambda: rimline.Mesh(big.vertices, big.faces).build_index(),
    "draw": lambda: rimline.draw(big, progress=lambda share: None),
    "blocked": lambda: rimline.Mesh(big.vertices, big.faces, progress=lambda share: time.sleep(100)),
    "render": render,
}

class Bar:
    n = 0
    total = 1.0
    def update(self, share):
        self.n += share

bar = Bar()
if sys.argv[1] == "render":
    renderer = rimline.Renderer()

def loop():
    while True:
        calls[sys.argv[1]]()

for _ in range(2):
    threading.Thread(target=loop, daemon=True).start()
time.sleep(0.25)
"""


@pytest.mark.parametrize("call", [
    "move_to", "edges", "take", "follow", "snapshot", "front_faces", "edge_faces", "to_svg", "save", "silhouette",
    "mesh", "bar", "index", "draw", "blocked", "render"])
def test_daemon_threads_in_calls_do_not_break_the_end_of_the_interpreter(call, tmp_path):
    if call == "render":
        have_device()
    for _ in range(2):
        result = subprocess.run([sys.executable, "-c", LOOPS, call, str(tmp_path / "drawing.svg")],
                                capture_output=True, text=True, timeout=60)
        assert result.returncode == 0 and result.stderr == "", (result.returncode, result.stderr)


SERVICE_IN_A_CHILD = """
import gc, multiprocessing, rimline

service = rimline.SilhouetteService(workers=1)
tracker = service.add(rimline.load("shape:knot:500"), (3, 2, 1))

def use():
    global service, tracker
    refused = 0
    for call in (lambda: tracker.post((1, 2, 3)), lambda: tracker.take(timeout=60), tracker.snapshot, tracker.remove,
                 lambda: service.add(rimline.load("shape:box"), (3, 2, 1)), lambda: service.worker_count):
        try:
            call()
        except rimline.CancelledError as error:
            refused += "the process that made it" in str(error)
    service.stop()
    del call, service, tracker
    gc.collect()
    raise SystemExit(refused)

child = multiprocessing.get_context("fork").Process(target=use)
child.start()
child.join(30)
assert child.exitcode == 6, child.exitcode
tracker.post((3, 2, 0.5))
assert tracker.take(5.0) is not None
"""


def test_a_service_refuses_work_in_a_child_of_fork():
    result = subprocess.run([sys.executable, "-c", SERVICE_IN_A_CHILD], capture_output=True, text=True, timeout=60)
    assert result.returncode == 0, result.stderr


def test_a_child_of_fork_makes_long_calls_and_ends():
    code = ("import os, rimline, threading; mesh = rimline.load('shape:knot:300000');"
            "thread = threading.Thread(target=lambda: rimline.LineDrawer(mesh)); thread.start()\n"
            "child = os.fork()\n"
            "if child == 0:\n"
            "    rimline.load('shape:knot:2000').build_index(); raise SystemExit(7)\n"
            "raise SystemExit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))")
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert result.returncode == 7, result.stderr


USED_BY_THE_COLLECTOR = """
import gc, rimline

tracker = rimline.Tracker(rimline.load("shape:knot:500"), (3, 2, 1))

class Cycle:
    def __init__(self):
        self.me = self
    def __del__(self):
        uses.append(tracker.point)

uses = []
gc.set_threshold(1)
for read in (lambda: tracker.point, lambda: tracker.edges, lambda: tracker.silhouette, lambda: tracker.front_faces):
    for _ in range(200):
        Cycle()
        read()
assert len(uses) > 100
"""


def test_the_collector_may_run_code_that_uses_the_tracker():
    result = subprocess.run([sys.executable, "-c", USED_BY_THE_COLLECTOR], capture_output=True, text=True, timeout=60)
    assert result.returncode == 0, result.stderr


UNMADE = """
import sys, rimline
from rimline import _rimline

bound = getattr(_rimline, sys.argv[1])
names = [name for name in vars(bound) if not name.startswith("__")]
calls = [lambda thing, name=name: getattr(thing, name) for name in names]
calls += [repr, len] if "__len__" in vars(bound) else [repr] if "__repr__" in vars(bound) else []
calls.append(lambda thing: rimline.Tracker(thing, (1, 2, 3)))
for name in names:
    for arguments in ((), ((1, 2, 3),), (rimline.load("shape:box"), (3, 2, 1)), (rimline.load("shape:box"), {}, None)):
        calls.append(lambda thing, name=name, arguments=arguments: getattr(thing, name)(*arguments))
refused = 0
for call in calls:
    thing = bound.__new__(bound)
    try:
        call(thing)
    except TypeError as error:
        refused += str(error) == f"{sys.argv[1]}.__init__() was not called"
    except (AttributeError, ValueError):
        pass

class Hasty(bound):
    def __init__(self):
        getattr(self, names[0])()

try:
    Hasty()
except TypeError as error:
    refused += str(error) == f"{sys.argv[1]}.__init__() was not called"
assert refused >= len(names), refused
"""


@pytest.mark.parametrize("name", [name for name, value in vars(rimline._rimline).items()
                                  if isinstance(value, type) and not issubclass(value, BaseException)])
def test_objects_that_were_not_made_are_refused(name):
    result = subprocess.run([sys.executable, "-c", UNMADE, name], capture_output=True, text=True, timeout=60)
    assert result.returncode == 0, result.stderr


def test_meshes_and_renderers_that_were_not_made_are_no_arguments():
    mesh, renderer = rimline.Mesh.__new__(rimline.Mesh), rimline.Renderer.__new__(rimline.Renderer)
    for call in (lambda: rimline.draw(mesh), lambda: rimline.Tracker(mesh, (1, 2, 3)),
                 lambda: mesh.silhouette((1, 2, 3))):
        with pytest.raises(TypeError, match=r"^Mesh.__init__\(\) was not called"):
            call()
    box = rimline.load("shape:box")
    for call in (lambda: renderer.render(box), lambda: rimline.best_views(box, renderer=renderer)):
        with pytest.raises(TypeError, match=r"^Renderer.__init__\(\) was not called"):
            call()
