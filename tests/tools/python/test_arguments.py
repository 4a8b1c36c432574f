"""Arguments: errors of their own methods, odd text, and errors of the system."""

import errno
import os
import pathlib
import pickle
import threading

import numpy as np
import pytest
from conftest import have_device

import rimline

BOX = rimline.load("shape:box")
TRIANGLE, FACES = np.eye(3), np.array([[0, 1, 2]])


def value_that_raises(error):
    class Value:
        def fail(self, *_, **__):
            raise error

        __array__ = __float__ = __index__ = __iter__ = fail

        def __len__(self):
            raise error

        def __getitem__(self, at):
            raise error

    return Value()


def test_numbers_that_change_their_list_are_read_once():
    numbers = []

    class Number:
        def __float__(self):
            numbers.clear()
            return 1.0

    for call in (BOX.silhouette, BOX.front_faces, lambda v: rimline.Tracker(BOX, v),
                 lambda v: rimline.best_light(BOX, v)):
        numbers[:] = [Number(), 2.0, 3.0]
        call(numbers)
        assert numbers == []


def test_more_faces_than_a_mesh_takes_are_refused_before_they_are_copied():
    faces = np.broadcast_to(np.array([0, 1, 2], np.uint8), (2**30 + 1, 3))
    with pytest.raises(ValueError, match="faces: more than 2\\^30 rows"):
        rimline.Mesh(TRIANGLE, faces)


CONVERSIONS = [
    (lambda v: rimline.Mesh(v, FACES), "vertices: "), (lambda v: rimline.Mesh(TRIANGLE, v), "faces: "),
    (lambda v: rimline.PointSurface(v), "points: "), (lambda v: BOX.silhouette(v), "eye: "),
    (lambda v: BOX.silhouette((v, 2, 3)), "eye: "), (lambda v: rimline.load("shape:box", subdivide=v), "subdivide: "),
    (lambda v: rimline.TangentialField(BOX, tolerance=v), "tolerance: "),
    (lambda v: rimline.draw(BOX, eye=(v, 2, 3)), "eye: "), (lambda v: rimline.draw(BOX, fov=v), "fov: "),
]


def test_what_is_no_rows_is_named():
    for wrong, name in ((None, "NoneType"), ((row for row in TRIANGLE), "generator")):
        with pytest.raises(TypeError, match=f"vertices: expected rows of three numbers, not {name}"):
            rimline.Mesh(wrong, FACES)


@pytest.mark.parametrize("call, words", CONVERSIONS)
def test_errors_of_conversions_are_passed_on(call, words):
    for error in (KeyboardInterrupt("now"), MemoryError("full"), OSError(5, "lost")):
        with pytest.raises(type(error)) as caught:
            call(value_that_raises(error))
        assert caught.value is error
    with pytest.raises((TypeError, ValueError), match=f"^{words}"):
        call(value_that_raises(TypeError("no")))


def test_wrong_kinds_of_a_value_are_the_cause_of_the_error():
    cause = ValueError("not today")
    for call, words in CONVERSIONS[:7]:
        with pytest.raises(TypeError, match=f"^{words}") as caught:
            call(value_that_raises(cause))
        assert caught.value.__cause__ is cause


def test_masks_that_raise_are_passed_on():
    class Masked:
        @property
        def mask(self):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        rimline.Mesh(Masked(), FACES)


SURROGATE = "caf\udce9"


@pytest.mark.parametrize("call, error, words", [
    (lambda: rimline.draw(BOX, eye=SURROGATE), ValueError, "eye: "),
    (lambda: rimline.draw(BOX, lines=["silhouette", SURROGATE]), ValueError, "lines: "),
    (lambda: rimline.draw(BOX, **{SURROGATE: 3}), TypeError, "unexpected keyword argument 'caf"),
    (lambda: rimline.Scene(BOX, style=SURROGATE), ValueError, "style: "),
    (lambda: rimline.TangentialField(BOX, SURROGATE), ValueError, "function: "),
    (lambda: rimline.best_light(BOX, (3, 2, 4), up=SURROGATE), ValueError, "up: "),
    (lambda: rimline.best_views(BOX, visible=False, below=SURROGATE), ValueError, "below: "),
    (lambda: rimline.Renderer(SURROGATE), ValueError, "device: "),
    (lambda: rimline.Mesh(TRIANGLE, FACES, up=SURROGATE), ValueError, "up: "),
])
def test_text_with_lone_surrogates_is_an_error_that_names_the_argument(call, error, words):
    with pytest.raises(error, match=f"^{words}.*" + r"\\udce9"):
        call()


def test_paths_with_surrogates_are_names_of_files(tmp_path):
    path = os.fsdecode(os.fsencode(tmp_path / "caf") + b"\xe9.svg")
    rimline.draw(BOX).save(path)
    assert os.path.exists(path)


def test_errors_of_files_have_the_number_of_the_system(tmp_path):
    drawing, picture = rimline.draw(BOX), np.full((4, 5, 4), 200, dtype=np.uint8).view(rimline.Picture)
    for thing, name in ((drawing, "a.svg"), (picture, "a.png")):
        with pytest.raises(rimline.MissingFileError, match="there is no folder") as missing:
            thing.save(tmp_path / "none" / name)
        assert missing.value.errno == errno.ENOENT
    (tmp_path / "folder.svg").mkdir()
    for call in (lambda: rimline.load(tmp_path), lambda: drawing.save(tmp_path / "folder.svg")):
        with pytest.raises(rimline.FileError, match="name a file in it") as folder:
            call()
        assert folder.value.errno == errno.EISDIR and not isinstance(folder.value, FileNotFoundError)


def test_pickled_errors_keep_their_number_and_text(tmp_path):
    for path in (tmp_path / "missing.obj", tmp_path):
        with pytest.raises(rimline.FileError) as caught:
            rimline.load(path)
        error = caught.value
        for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
            copy = pickle.loads(pickle.dumps(error, protocol))
            assert type(copy) is type(error) and copy.errno == error.errno != 0
            assert str(copy) == str(error) and str(copy).startswith(str(tmp_path)) and "[Errno" not in str(copy)
    assert str(rimline.FileError("lost")) == "lost"
    assert str(rimline.FileError(2, "gone", "a.obj")) == "[Errno 2] gone: 'a.obj'"


def test_errors_of_files_have_the_name_of_the_file(tmp_path):
    odd = os.fsdecode(os.fsencode(tmp_path / "caf") + b"\xe9.obj")
    drawing, picture = rimline.draw(BOX), np.full((4, 5, 4), 200, dtype=np.uint8).view(rimline.Picture)
    for call, path in ((rimline.load, tmp_path / "none.obj"), (rimline.load, odd), (rimline.load, tmp_path),
                       (rimline.load, pathlib.Path("/dev/null")), (rimline.load_points, tmp_path / "none.xyz"),
                       (drawing.save, tmp_path / "none" / "a.svg"), (picture.save, tmp_path / "none" / "a.png")):
        with pytest.raises(rimline.FileError) as caught:
            call(path)
        error = caught.value
        assert error.filename == str(path) and "[Errno" not in str(error), path
        copy = pickle.loads(pickle.dumps(error))
        assert str(copy) == str(error) and (copy.filename == str(path) or error.errno is None)


def test_an_empty_drawing_is_a_warning():
    with pytest.warns(UserWarning, match="the drawing is empty"):
        assert not rimline.draw(BOX, lines="border").lines


def test_a_device_may_be_a_number():
    have_device()
    with pytest.raises(rimline.NoDeviceError, match="99"):
        rimline.Renderer(device=99)


def test_a_cloud_is_not_a_mesh_and_the_message_names_its_reader(tmp_path):
    path = tmp_path / "cloud.ply"
    path.write_text("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                    "end_header\n1 2 3\n")
    with pytest.raises(rimline.InputError, match=r"cloud of 1 points; load_points\(\) reads it$"):
        rimline.load(path)
    assert rimline.load_points(path).tolist() == [[1, 2, 3]]


@pytest.mark.parametrize("call, error, words", [
    (lambda: rimline.best_views(BOX, visible=False, up="Auto"), ValueError, "up: .*auto, not 'Auto'"),
    (lambda: rimline.Scene(BOX, light=[(1, 2, 3), None]), TypeError, "light: expected numbers or names, not None"),
    (lambda: rimline.draw(BOX, eye=[(1, 2, 8), (2, 2, 8)]), ValueError,
     r"eye: expected one value, not \[\(1, 2, 8\), \(2, 2, 8\)\]"),
    (lambda: rimline.CameraPath(BOX, [rimline.best_views(BOX, 1, visible=False)[0].eye, (9, 9, 9)]), ValueError,
     r"eyes\[1\]: expected a point 1.73 to 2"),
    (lambda: rimline.camera_path(BOX, [(9, 9, 9), (0, 9, 9)]), ValueError, r"views\[0\]: expected a point 1.73 to 2"),
    (lambda: rimline.camera_path(BOX, "4"), TypeError, "views: expected an integer, views or points, not str"),
    (lambda: rimline.camera_path(BOX, b"42"), TypeError, "views: expected an integer, views or points, not bytes"),
    (lambda: rimline.best_views(BOX, renderer=3, visible=False), TypeError,
     "renderer: expected a rimline.Renderer, not int"),
    (lambda: rimline.Scene(BOX, size=b"32"), TypeError, "size: expected width and height, not b'32'"),
    (lambda: rimline.Scene(BOX, size={640, 480}), TypeError, "size: expected width and height, not {"),
    (lambda: rimline.Scene(BOX, size={640: 1, 480: 2}), TypeError, "size: expected width and height, not {"),
])
def test_messages_say_what_is_expected(call, error, words):
    with pytest.raises(error, match=f"^{words}"):
        call()


def test_sizes_may_be_arrays():
    for size in ([64, 48], (64, 48), np.array([64, 48]), "64x48"):
        assert rimline.Scene(BOX, size=size).options["size"] == "64x48"


@pytest.mark.parametrize("kind", ["<f8", ">f8", ">f4", "f4"])
def test_other_threads_run_while_large_arrays_are_read(kind):
    vertices = np.zeros((6_000_000, 3), dtype=kind)
    vertices[-1, 2] = np.nan
    ticks, over = [], threading.Event()

    def tick():
        while not over.wait(0.001):
            ticks.append(1)

    thread = threading.Thread(target=tick)
    thread.start()
    start = len(ticks)
    with pytest.raises(ValueError, match=r"vertices\[5999999\]: "):
        rimline.Mesh(vertices, FACES)
    assert len(ticks) - start > 5
    over.set()
    thread.join()


def test_transparent_pictures_have_the_background_none():
    have_device()
    opaque, transparent = (rimline.render(BOX, size=(32, 24), background=b) for b in (None, "none"))
    assert (opaque[..., 3] == 255).all() and transparent[0, 0, 3] == 0
