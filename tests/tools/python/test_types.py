"""The stubs say what the extension module has, and mypy agrees with them."""

import pathlib
import re
import subprocess
import sys

import pytest

import rimline

PACKAGE = pathlib.Path(rimline.__file__).parent

GOOD = """
from typing import Any

import numpy.typing as npt
import rimline

mesh = rimline.load("shape:knot")
edges: npt.NDArray[Any] = mesh.silhouette(eye=(2, 1, 2)).edges
for line in rimline.draw(mesh, hidden="dashed").lines:
    print(line)
picture: rimline.Picture = rimline.render(mesh, style="toon")
views: list[rimline.View] = rimline.best_views(mesh, 2)
"""
BAD = """
import rimline

rimline.load(3)
rimline.Tracker("mesh", (1, 2, 3))
rimline.load("shape:knot").silhouet((1, 2, 3))
"""


def mypy(*arguments):
    pytest.importorskip("mypy")
    return subprocess.run([sys.executable, "-m", *arguments], capture_output=True, text=True, timeout=300,
                          cwd=PACKAGE.parent)


def test_the_package_and_its_users_are_typed(tmp_path):
    result = mypy("mypy", "--strict", "--cache-dir", str(tmp_path), "-p", "rimline")
    assert result.returncode == 0, result.stdout
    (tmp_path / "good.py").write_text(GOOD)
    result = mypy("mypy", "--strict", "--cache-dir", str(tmp_path), str(tmp_path / "good.py"))
    assert result.returncode == 0, result.stdout
    (tmp_path / "bad.py").write_text(BAD)
    result = mypy("mypy", "--strict", "--cache-dir", str(tmp_path), str(tmp_path / "bad.py"))
    assert result.stdout.count("error: ") == 3, result.stdout


def test_the_stubs_name_what_there_is(tmp_path):
    # pybind11's classes have a metaclass of their own, and those without a constructor an __init__ that raises.
    (tmp_path / "allowed").write_text("rimline\\._rimline\\.[A-Za-z]+(\\.__init__)?\n")
    result = mypy("mypy.stubtest", "--allowlist", str(tmp_path / "allowed"), "rimline._rimline")
    assert result.returncode == 0, result.stdout + result.stderr


def test_everything_public_is_documented_and_exported():
    for name in rimline.__all__:
        thing = getattr(rimline, name)
        assert isinstance(thing, (str, tuple)) or thing.__doc__, name
        for member, value in vars(thing).items() if isinstance(thing, type) else ():
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                # Methods begin with their signature.
                text = re.sub(r"\A\w+\(.*\) -> .*\n?", "", value.__doc__ or "")
                assert text.strip(), f"{name}.{member}"
