"""Arguments: errors of their own methods, odd text, and errors of the system."""

import errno
import os
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


CONVERSIONS = [
    (lambda v: rimline.Mesh(v, FACES), "vertices: "), (lambda v: rimline.Mesh(TRIANGLE, v), "faces: "),
    (lambda v: rimline.PointSurface(v), "points: "), (lambda v: BOX.silhouette(v), "eye: "),
    (lambda v: BOX.silhouette((v, 2, 3)), "eye: "), (lambda v: rimline.load("shape:box", subdivide=v), "subdivide: "),
    (lambda v: rimline.TangentialField(BOX, tolerance=v), "tolerance: "),
    (lambda v: rimline.draw(BOX, eye=(v, 2, 3)), "eye: "), (lambda v: rimline.draw(BOX, fov=v), "fov: "),
]


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
