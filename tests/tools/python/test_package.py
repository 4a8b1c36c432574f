"""The documentation's examples, and the installation by pip."""

import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys

import pytest
from conftest import have_device

ROOT = pathlib.Path(__file__).resolve().parents[3]


def test_examples_of_the_documentation_run(tmp_path, monkeypatch):
    have_device()
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```$", (ROOT / "docs/python.md").read_text(), re.M | re.S)
    assert len(blocks) >= 5
    names = {}
    for block in blocks:  # Each goes on from the one before.
        exec(compile(block, "docs/python.md", "exec"), names)
    assert (tmp_path / "knot.svg").stat().st_size > 1000 and (tmp_path / "knot.png").stat().st_size > 1000


def test_the_bench_finds_the_same_edges():
    script = ROOT / "tools/bench/python_package.py"
    result = subprocess.run([sys.executable, "-B", script, "--json", "shape:knot:3000"], capture_output=True, text=True)
    assert result.returncode == 0 and result.stderr == "", result.stderr
    told = json.loads(result.stdout)
    model = told["models"][0]
    assert model["differences"] == 0 and model["edges"] == model["numpy_edges"] > 0
    assert model["tracker_us"] < model["silhouette_us"] and 0 < told["call_us"]
    if told["vtk"]:
        assert model["filter_split_edges"] > 0 and model["vtk_split_edges"] == 0
        assert all(model[f"{name}_us"] > 0 for name in ("filter", "vtk", "filter+angle", "vtk+angle"))
    result = subprocess.run([sys.executable, "-B", script, "missing.obj"], capture_output=True, text=True)
    assert result.returncode == 1 and result.stderr.startswith("python_package.py: error: missing.obj"), result.stderr


def test_pip_installs_the_package(tmp_path):
    """With the extension module that is built already."""
    for module in ("pip", "setuptools", "wheel"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"no {module} in this Python")
    target = tmp_path / "target"
    environment = {**os.environ, "RIMLINE_BUILD_DIR": os.environ["RIMLINE_BUILD_DIR"]}
    result = subprocess.run([sys.executable, "-m", "pip", "install", "--no-index", "--no-deps", "--no-build-isolation",
                             "--disable-pip-version-check", "--target", str(target), str(ROOT / "tools/python")],
                            capture_output=True, text=True, env=environment, timeout=500)
    assert result.returncode == 0, result.stdout + result.stderr
    assert sorted(path.suffix for path in (target / "rimline").iterdir() if path.is_file()) == [
        ".py", ".py", ".pyi", ".so", ".typed"]
    code = "import rimline; print(rimline.__file__, rimline.load('shape:box').silhouette((3, 2, 1)).edges.shape)"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=tmp_path,
                            env={**os.environ, "PYTHONPATH": str(target)})
    assert result.stdout == f"{target}/rimline/__init__.py (6, 2)\n", result.stdout + result.stderr
    assert not list((ROOT / "tools/python").glob("*.egg-info")) and not (ROOT / "tools/python/build").exists()
