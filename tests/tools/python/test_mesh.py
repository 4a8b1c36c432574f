"""rimline.Mesh: arrays in and out, and silhouettes against numpy."""

import copy
import errno
import os
import pickle
import subprocess
import sys
import threading

import numpy as np
import pytest
from conftest import command, find_model, have_device, numpy_silhouette, orbit, pairs

import rimline


@pytest.fixture(scope="module")
def knot():
    return rimline.load("shape:knot:2000")


def test_silhouettes_equal_those_of_numpy(knot):
    for eye in orbit(knot, 25):
        front, edges = numpy_silhouette(knot.vertices, knot.faces, eye.astype(np.float32))
        silhouette = knot.silhouette(eye)
        assert pairs(silhouette.edges) == edges
        assert len(silhouette) == len(edges) == len(silhouette.ids)
        assert (knot.front_faces(eye) == front).all()
        assert pairs(knot.edges[silhouette.ids]) == edges
        assert (silhouette.segments == knot.vertices[silhouette.edges]).all()
    front, edges = numpy_silhouette(knot.vertices, knot.faces, direction=(0.3, 0.7, -0.2))
    assert pairs(knot.silhouette(direction=(0.3, 0.7, -0.2)).edges) == edges


def test_the_index_changes_no_silhouette():
    mesh = rimline.load("shape:torus:3000")
    before = [mesh.silhouette(eye).ids for eye in orbit(mesh, 10)]
    mesh.build_index()
    after = [mesh.silhouette(eye).ids for eye in orbit(mesh, 10)]
    assert all((a == b).all() for a, b in zip(before, after))


def test_numbers_are_those_of_the_command(knot):
    result = command("silhouette", "shape:knot:2000", "--from", "3,2,4")
    edges = {tuple(edge) for edge in result["edges"]}
    assert pairs(knot.silhouette((3, 2, 4)).edges) == edges


@pytest.mark.parametrize("change", [
    lambda a: a.astype(np.float64),
    lambda a: np.asfortranarray(a),
    lambda a: np.repeat(a, 2, axis=0)[::2],
    lambda a: a[::-1].copy()[::-1],
    lambda a: a.astype(">f8"),
    lambda a: a.astype(np.float64).tolist(),
    lambda a: np.ascontiguousarray(np.stack([a, a], axis=2))[:, :, 0],
], ids=["float64", "Fortran", "strided", "reversed", "other byte order", "lists", "inner stride"])
def test_vertices_of_any_kind_are_read(knot, change):
    vertices = change(knot.vertices)
    if isinstance(vertices, np.ndarray):
        vertices.flags.writeable = False
    mesh = rimline.Mesh(vertices, knot.faces)
    assert (mesh.vertices == knot.vertices).all() and (mesh.edges == knot.edges).all()


@pytest.mark.parametrize("kind", ["i2", "u2", "i4", "u4", "i8", "u8", ">i4"])
def test_faces_of_any_width_are_read(knot, kind):
    for faces in (knot.faces.astype(kind), np.asfortranarray(knot.faces.astype(kind))):
        assert (rimline.Mesh(knot.vertices, faces).edges == knot.edges).all()


def test_faces_of_bytes_are_read():
    vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    for kind in (np.int8, np.uint8):
        assert len(rimline.Mesh(np.array(vertices, dtype=kind), faces.astype(kind)).edges) == 6


TRIANGLE = np.eye(3)
FACES = np.array([[0, 1, 2]])


@pytest.mark.parametrize("vertices, faces, error, words", [
    (np.zeros((3, 2)), FACES, ValueError, r"vertices: expected the shape \(N, 3\), not \(3, 2\)"),
    (np.zeros(3), FACES, ValueError, r"vertices: .*\(3,\)"),
    (np.zeros((1, 3, 3)), FACES, ValueError, "vertices"),
    ("text", FACES, TypeError, "vertices"),
    (None, FACES, TypeError, "vertices"),
    (TRIANGLE.astype(complex), FACES, TypeError, "vertices: expected real numbers, not complex128"),
    (TRIANGLE.astype(bool), FACES, TypeError, "vertices: .*bool"),
    (TRIANGLE.astype(object), FACES, TypeError, "vertices: .*object"),
    ([[0, 0, 0], [np.nan, 0, 0], [0, 1, 0]], FACES, ValueError, r"vertices\[1\]: .*finite"),
    ([[0, 0, 0], [0, 0, 0], [0, np.inf, 0]], FACES, ValueError, r"vertices\[2\]"),
    ([[0, 0, 0], [0, 0, 0], [0, 0, 1e30]], FACES, ValueError, r"vertices\[2\]"),
    (TRIANGLE, [[0, 1, 3]], ValueError, r"faces\[0\]: there is no vertex 3 among 3"),
    (TRIANGLE, [[0, 1, 2], [0, -1, 2]], ValueError, r"faces\[1\]: there is no vertex -1"),
    (TRIANGLE, [[0.0, 1.0, 2.0]], TypeError, "faces: expected integers, not float64"),
    (TRIANGLE, [[0, 1, 2, 0]], ValueError, r"faces: .*\(1, 4\)"),
    (np.zeros((0, 3)), FACES, ValueError, "among 0"),
])
def test_wrong_arrays_are_errors_that_name_the_row(vertices, faces, error, words):
    with pytest.raises(error, match=words):
        rimline.Mesh(vertices, faces)


def test_a_mesh_far_from_the_origin_is_warned_of(knot):
    with pytest.warns(UserWarning, match="the mesh: lies so far from the origin that single precision loses its shape"):
        rimline.Mesh(knot.vertices.astype(float) + [448000.25, 5411000.5, 0], knot.faces)


def test_arrays_with_a_mask_are_refused():
    masked = np.ma.array(TRIANGLE, mask=[[0, 0, 1]] * 3, dtype=float)
    with pytest.raises(TypeError, match="vertices: expected an array without a mask"):
        rimline.Mesh(masked, FACES)


@pytest.mark.parametrize("eye", [None, 3, "abc", {5, 1, 2}, {5: 1, 1: 1, 2: 1}, (1, 2), (1, 2, 3, 4), ("a", 2, 3), (np.nan, 0, 0), (1e30, 0, 0),
                                 np.zeros((1, 3)), np.zeros((3, 3)), b"abc"])
def test_wrong_points_are_errors(knot, eye):
    with pytest.raises((TypeError, ValueError)):
        knot.silhouette(eye)
    with pytest.raises((TypeError, ValueError)):
        knot.silhouette(direction=eye)
    with pytest.raises((TypeError, ValueError)):
        rimline.Tracker(knot, eye)


def test_a_direction_is_one_however_short(knot):
    expected = knot.front_faces(direction=(2, 0.8, 0.1))
    for power in (-10, -60, -100, -300):
        found = knot.front_faces(direction=(2 * 2.0**power, 0.8 * 2.0**power, 0.1 * 2.0**power))
        assert (found == expected).all(), power


def test_a_point_is_an_eye_or_a_direction(knot):
    with pytest.raises(TypeError, match="either eye or direction"):
        knot.silhouette((1, 2, 3), direction=(1, 2, 3))
    with pytest.raises(ValueError, match="not zero"):
        knot.silhouette(direction=(0, 0, 0))
    for eye in ([2, 1, 2], np.array([2, 1, 2]), np.array([2, 1, 2], dtype=np.float32), iter([2, 1, 2])):
        assert (knot.silhouette(eye).ids == knot.silhouette((2.0, 1.0, 2.0)).ids).all()


def test_an_empty_mesh_has_nothing():
    have_device()
    for vertices, faces in ((np.zeros((0, 3)), np.zeros((0, 3), dtype=int)), ([], []), (TRIANGLE, [])):
        mesh = rimline.Mesh(vertices, faces)
        assert mesh.faces.shape == (0, 3) and mesh.edges.shape == (0, 2) and mesh.radius == 0
        assert mesh.silhouette((1, 2, 3)).edges.shape == (0, 2)
        assert mesh.silhouette((1, 2, 3)).segments.shape == (0, 2, 3)
        tracker = rimline.Tracker(mesh, (1, 2, 3))
        assert len(tracker.move_to((3, 2, 1)).added) == 0
        for draw in (rimline.draw, rimline.render):
            with pytest.raises(rimline.InputError, match="it has no faces"):
                draw(mesh)
        assert rimline.best_views(mesh, visible=False) == []


def test_equal_positions_are_one_vertex_unless_asked():
    corners = rimline.load("shape:box").vertices[rimline.load("shape:box").faces].reshape(-1, 3)
    faces = np.arange(len(corners)).reshape(-1, 3)
    have_device()
    welded, split = rimline.Mesh(corners, faces), rimline.Mesh(corners, faces, weld=False)
    assert welded.is_closed and len(welded.borders) == 0
    assert not split.is_closed and len(split.borders) == len(corners)
    first = {tuple(p): i for i, p in reversed(list(enumerate(corners.tolist())))}
    assert set(welded.edges.ravel().tolist()) <= set(first.values())
    assert (welded.vertices == corners).all()
    for draw in (rimline.draw, rimline.render):
        with pytest.raises(ValueError, match="one vertex"):
            draw(split)


def test_vertices_are_a_view_that_outlives_the_mesh():
    mesh = rimline.Mesh(TRIANGLE, FACES)
    vertices = mesh.vertices
    with pytest.raises(ValueError):
        vertices[0, 0] = 3
    del mesh
    assert (vertices == TRIANGLE).all()


def test_arrays_of_a_mesh_are_views_that_cannot_be_written(knot):
    for name in ("vertices", "faces", "edges", "edge_faces"):
        array = getattr(knot, name)
        assert np.shares_memory(array, getattr(knot, name)) and array.base is not None, name
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    faces = rimline.Mesh(np.eye(3), [[0, 1, 2]]).faces
    assert faces.tolist() == [[0, 1, 2]]


def test_files_are_read_and_their_faults_are_errors(tmp_path):
    path = tmp_path / "triangle.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert len(rimline.load(path).faces) == len(rimline.load(bytes(path)).faces) == 1
    assert len(rimline.load(path, subdivide=2).faces) == 16
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")
    with pytest.raises(rimline.InputError, match="triangle.obj:4: ") as caught:
        rimline.load(path)
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, rimline.Error)
    with pytest.raises(rimline.FileError) as missing:
        rimline.load(tmp_path / "missing.obj")
    assert isinstance(missing.value, FileNotFoundError) and missing.value.errno == errno.ENOENT
    assert str(missing.value).startswith(str(tmp_path))
    with pytest.raises(rimline.FileError) as folder:
        rimline.load(tmp_path)
    assert not isinstance(folder.value, FileNotFoundError)
    for wrong in ("", "-", 3, None, "shape:nope", "shape:knot:x"):
        with pytest.raises((TypeError, ValueError)):
            rimline.load(wrong)
    with pytest.raises(ValueError, match="subdivide"):
        rimline.load("shape:box", subdivide=99)


def test_names_of_files_are_any_bytes(tmp_path):
    path = os.fsencode(tmp_path / "caf") + b"\xe9.obj"
    with pytest.raises(rimline.FileError, match=r"caf\\xe9.obj: "):
        rimline.load(path)
    with open(path, "w") as file:
        file.write("mtllib missing.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    with pytest.warns(UserWarning, match=r"caf\\xe9.obj.*missing.mtl"):
        mesh = rimline.load(path)
    assert os.fsencode(mesh.name) == path and rimline.load("shape:box").name == "shape:box"
    assert r"caf\xe9.obj: 3 vertices" in repr(mesh)
    assert r"caf\xe9.obj" in rimline.draw(mesh, eye=(3, 2, 4)).to_svg()
    with pytest.raises(ValueError, match=r"path: .*caf\\xe9.txt"):
        rimline.draw(mesh, eye=(3, 2, 4)).save(path.replace(b".obj", b".txt"))


def test_warnings_of_a_file_are_pythons(tmp_path):
    path = tmp_path / "colors.obj"
    path.write_text("mtllib missing.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    with pytest.warns(UserWarning, match="missing.mtl"):
        rimline.load(path)


BOX = rimline.load("shape:box")
BOX_PATH = rimline.camera_path(BOX, 3, visible=False)
WRONG_ARGUMENTS = [
    (lambda: rimline.load(3), TypeError, "path: expected str"),
    (lambda: rimline.load("a\0b"), ValueError, "path: "),
    (lambda: rimline.load("shape:box", subdivide=-1), ValueError, "subdivide: expected 0 to 14, not -1"),
    (lambda: rimline.load("shape:box", subdivide=10**30), ValueError, "subdivide: .*, not 10"),
    (lambda: rimline.load("shape:box", subdivide=1.0), TypeError, "subdivide: expected an integer, not float"),
    (lambda: rimline.load("shape:box", textures=1), TypeError, "textures: expected True or False, not int"),
    (lambda: rimline.Mesh(TRIANGLE, FACES, weld=None), TypeError, "weld: expected True or False, not NoneType"),
    (lambda: BOX.silhouette((10**400, 0, 0)), ValueError, "eye: expected finite numbers within 2"),
    (lambda: BOX.silhouette(("a", 0, 0)), TypeError, "eye: expected a number, not str"),
    (lambda: rimline.Tracker("mesh", (1, 2, 3)), TypeError, "mesh: expected a rimline.Mesh, not str"),
    (lambda: rimline.draw(None), TypeError, "mesh: expected a rimline.Mesh, not NoneType"),
    (lambda: rimline.SilhouetteService(workers=-1), ValueError, "workers: .*, not -1"),
    (lambda: rimline.SilhouetteService(max_pending=0), ValueError, "max_pending: .*, not 0"),
    (lambda: rimline.PointSurface(TRIANGLE, k=-1), ValueError, "k: expected 4 to 32, not -1"),
    (lambda: rimline.PointSurface(TRIANGLE, drop_outliers="no"), TypeError, "drop_outliers: "),
    (lambda: rimline.best_views(BOX, -1, visible=False), ValueError, "count: expected 1 to 64, not -1"),
    (lambda: rimline.best_views(BOX, 2, visible="no"), TypeError, "visible: expected True or False, not 'no'"),
    (lambda: rimline.best_views(BOX, 2, renderer=3), TypeError, "renderer: expected a rimline.Renderer, not int"),
    (lambda: rimline.best_views(BOX, 2, visible=False, below=3), TypeError, "below: expected a str, not int"),
    (lambda: rimline.best_views(BOX, 2, visible=False, by_area=0), TypeError, "by_area: "),
    (lambda: BOX_PATH.sample(-1), ValueError, "count: .*, not -1"),
    (lambda: BOX_PATH.position("a"), TypeError, "share: expected a number, not str"),
    (lambda: rimline.best_light(BOX, (3, 2, 4), by=1), TypeError, "by: expected a str, not int"),
    (lambda: rimline.TangentialField(BOX, 3), TypeError, "function: expected a str, not int"),
    (lambda: rimline.TangentialField(BOX, tolerance="a"), TypeError, "tolerance: expected a number, not str"),
    (lambda: rimline.Renderer(3.5), TypeError, "device: expected a str, not float"),
    (lambda: rimline.Renderer(validate=3), TypeError, "validate: expected True or False, not int"),
]


@pytest.mark.parametrize("call, error, words", WRONG_ARGUMENTS)
def test_wrong_arguments_are_errors_that_name_them(call, error, words):
    with pytest.raises(error, match=f"^{words}") as caught:
        call()
    assert "incompatible" not in str(caught.value)


def test_numbers_and_flags_of_numpy_are_as_those_of_python():
    assert len(rimline.load("shape:box", subdivide=np.uint8(1), textures=np.bool_(True)).faces) == 4 * len(BOX.faces)
    assert len(rimline.Mesh(TRIANGLE, FACES, weld=np.bool_(False)).edges) == 3


def test_real_models_load():
    mesh = rimline.load(find_model("igea.ply"))
    assert mesh.silhouette(eye=(2, 1, 2)).edges.shape[1] == 2
    assert len(mesh.faces) > 100_000


def test_progress_is_reported_to_functions_and_bars():
    shares = []
    rimline.load("shape:knot:300000", subdivide=1, progress=shares.append)
    assert shares == sorted(shares) and shares[-1] == 1.0 and len(shares) > 1
    tqdm = pytest.importorskip("tqdm")
    with tqdm.tqdm(total=None, file=open("/dev/null", "w")) as bar:
        rimline.load("shape:knot", progress=bar)
        assert bar.n == pytest.approx(bar.total)
    with tqdm.tqdm(total=200, file=open("/dev/null", "w")) as bar:
        rimline.load("shape:knot", progress=bar)
        assert bar.n == pytest.approx(200)
    with pytest.raises(TypeError, match="progress"):
        rimline.load("shape:knot", progress=3)

    class Failure(Exception):
        pass

    def fail(share):
        raise Failure

    with pytest.raises(Failure):
        rimline.load("shape:knot:300000", subdivide=1, progress=fail)


@pytest.mark.parametrize("call", [lambda **options: rimline.draw(rimline.load("shape:knot:20000"), **options),
                                  lambda **options: rimline.camera_path(rimline.load("shape:knot:4000"), 3,
                                                                        visible=False, **options)],
                         ids=["draw", "camera_path"])
def test_progress_of_two_steps_is_one(call):
    shares = []
    call(progress=shares.append)
    assert shares == sorted(set(shares)) and shares[-1] == 1.0
    with pytest.raises(TypeError, match="progress"):
        call(progress=3)
    tqdm = pytest.importorskip("tqdm")
    with tqdm.tqdm(total=100, file=open("/dev/null", "w")) as bar:
        call(progress=bar)
        assert bar.n == pytest.approx(100)


@pytest.mark.parametrize("call", [lambda: rimline.load("shape:knot:500000").build_index(),
                                  lambda: BOX_PATH.sample(1_000_000)], ids=["index", "sample"])
def test_other_threads_run_meanwhile(call):
    ticks, over = [], threading.Event()

    def tick():
        while not over.wait(0.001):
            ticks.append(1)

    thread = threading.Thread(target=tick)
    thread.start()
    call()
    over.set()
    thread.join()
    assert len(ticks) > 20


INTERRUPTED = """
import os, signal, sys, threading, time
import numpy as np
import rimline

name, delay_s = sys.argv[1], float(sys.argv[2])
# Only what the call needs: the mesh takes a second to make.
if name == "sample":
    path = rimline.camera_path(rimline.load("shape:box"), 3, visible=False)
elif name == "save":
    picture = np.random.default_rng(1).integers(0, 256, (4000, 4000, 4), dtype=np.uint8).view(rimline.Picture)
elif name == "read":
    vertices, faces = np.zeros((9_000_000, 3), dtype=">f8"), np.zeros((1, 3), dtype=int)
elif name not in ("load", "turn"):
    mesh = rimline.load("shape:knot:1000000")
    vertices, faces = mesh.vertices, mesh.faces
calls = {
    "load": lambda: rimline.load("shape:knot:500000", subdivide=3),
    "mesh": lambda: rimline.Mesh(vertices, faces),
    "read": lambda: rimline.Mesh(vertices, faces),
    "index": lambda: mesh.build_index(),
    "lines": lambda: rimline.LineDrawer(mesh),
    "field": lambda: rimline.TangentialField(mesh, tolerance=1e-3),
    "views": lambda: rimline.best_views(mesh, visible=False),
    "light": lambda: rimline.best_light(mesh, (3, 2, 4)),
    "points": lambda: rimline.PointSurface(vertices),
    "render": lambda: rimline.render(mesh),
    "sample": lambda: path.sample(1_000_000),
    "save": lambda: picture.save(os.devnull),
    "turn": lambda: drawer.draw(eye=(1, 2, 3)),
}
if name == "turn":
    drawer = rimline.LineDrawer(rimline.load("shape:terrain:300000"))
    threading.Thread(target=lambda: drawer.draw(crease=1), daemon=True).start()
    time.sleep(0.1)
call = calls[name]
sent = []

def interrupt():
    time.sleep(delay_s)
    sent.append(time.perf_counter())
    os.kill(os.getpid(), signal.SIGINT)

thread = threading.Thread(target=interrupt)
thread.start()
try:
    call()
    print("ended", flush=True)
    os._exit(0)
except KeyboardInterrupt:
    print(time.perf_counter() - sent[0])
thread.join()
"""


@pytest.mark.parametrize(("name", "delay_s"), [
    ("load", 0.08), ("mesh", 0.08), ("read", 0.04), ("index", 0.08), ("lines", 0.08), ("field", 0.08), ("views", 0.08),
    ("light", 0.08), ("points", 0.08), ("sample", 0.08), ("save", 0.04), ("save", 0.6), ("turn", 0.3),
    ("load", 0.8), ("index", 0.3), ("index", 0.6), ("lines", 0.6), ("field", 0.32), ("light", 0.35),
    ("render", 0.02), ("render", 0.7), ("render", 1.5), ("render", 2.5)])
def test_ctrl_c_ends_long_calls_at_once(name, delay_s):
    if name == "render":
        have_device()
    times = []
    for _ in range(5):  # The system may stop the process for a moment.
        result = subprocess.run([sys.executable, "-c", INTERRUPTED, name, str(delay_s)], capture_output=True, text=True,
                                timeout=120)
        assert result.returncode == 0, result.stderr
        if delay_s > 0.1 and result.stdout.strip() == "ended":
            pytest.skip(f"{name} takes less than {delay_s} s here")
        assert result.stdout.strip() != "ended"
        times.append(float(result.stdout))
        if times[-1] < 0.1:
            return
    pytest.fail(f"{name} took {times} s to end")


def test_threads_in_long_calls_do_not_break_the_end_of_the_interpreter():
    code = ("import rimline, threading, time; m = rimline.load('shape:knot:300000');"
            "threading.Thread(target=lambda: rimline.LineDrawer(m), daemon=True).start(); time.sleep(0.05)")
    for _ in range(3):
        result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
        assert result.returncode == 0 and result.stderr == "", (result.returncode, result.stderr)


def test_objects_are_not_copied_or_pickled():
    mesh = rimline.load("shape:box")
    for make in [copy.copy, copy.deepcopy, *(lambda m, p=p: pickle.dumps(m, p) for p in range(6))]:
        for thing in (mesh, mesh.silhouette(eye=(3, 2, 1)), rimline.Tracker(mesh, (3, 2, 1))):
            with pytest.raises(TypeError, match=f"cannot copy or pickle a {type(thing).__name__}"):
                make(thing)
    assert isinstance(pickle.loads(pickle.dumps(rimline.InputError("a.obj: line 1"))), rimline.InputError)


def test_a_child_of_fork_draws_by_itself_and_ends():
    have_device()
    code = ("import multiprocessing, rimline; mesh = rimline.load('shape:knot:500'); mine = rimline.Renderer();"
            "mine.render(mesh, size=(16, 16)); rimline.render(mesh, size=(16, 16))\n"
            "def draw():\n"
            "    global mine; mine = rimline.Renderer(); mine.render(mesh, size=(16, 16)); raise SystemExit(7)\n"
            "child = multiprocessing.get_context('fork').Process(target=draw)\n"
            "child.start(); child.join(); raise SystemExit(child.exitcode)")
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert result.returncode == 7, result.stderr
