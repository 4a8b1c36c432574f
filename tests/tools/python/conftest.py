"""What the tests of the Python package share. A run whose tests were all skipped ends with status 77."""

import json
import os
import pathlib
import subprocess

import numpy as np
import pytest

import rimline

PROGRAM = os.environ.get("RIMLINE_PROGRAM", "rimline")


def pytest_terminal_summary(terminalreporter):
    for report in terminalreporter.stats.get("skipped", []):
        terminalreporter.write_line(f"SKIPPED: {report.longrepr[2].removeprefix('Skipped: ')}")


def pytest_sessionfinish(session, exitstatus):
    stats = session.config.pluginmanager.get_plugin("terminalreporter").stats
    # 5: not even one test was collected, as where a whole file is skipped.
    if exitstatus in (0, 5) and stats.get("skipped") and not stats.get("passed"):
        session.exitstatus = 77


def have_device():
    """Skips the case where no Vulkan device can be used."""
    try:
        usable = any(not lacks for _, _, lacks in rimline.devices())
    except rimline.NoDeviceError:
        usable = False
    if not usable:
        pytest.skip("no Vulkan device")


def find_model(name):
    for folder in os.environ.get("RIMLINE_MODELS", "").split(":"):
        path = pathlib.Path(folder) / name
        if folder and path.is_file():
            return str(path)
    pytest.skip(f"{name}: not in the folders of RIMLINE_MODELS")


def command(*arguments):
    """The JSON object that the program prints."""
    result = subprocess.run([PROGRAM, *arguments, "--json"], capture_output=True, text=True, timeout=300)
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


def pairs(edges):
    """The edges as a set of pairs, the lesser vertex first."""
    return {(min(a, b), max(a, b)) for a, b in np.asarray(edges).tolist()}


def numpy_silhouette(vertices, faces, eye=None, direction=None):
    """The silhouette of a closed, oriented mesh by its definition, as a set of pairs."""
    points = np.asarray(vertices, dtype=np.float64)
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    towards = np.asarray(direction, dtype=np.float64) if eye is None else np.asarray(eye) - corners[:, 0]
    heights = (normals * towards).sum(axis=1) / lengths
    scale = np.abs(points).max() + np.abs(towards).max()
    assert np.abs(heights).min() > 1e-6 * scale, "a face is seen edge-on: take another point"
    front = heights > 0
    faces_of = {}
    for face, corner in enumerate(np.asarray(faces).tolist()):
        for i in range(3):
            a, b = corner[i], corner[(i + 1) % 3]
            faces_of.setdefault((min(a, b), max(a, b)), []).append(face)
    return front, {edge for edge, (f, g) in faces_of.items() if front[f] != front[g]}


def orbit(mesh, count, radii=2.5):
    """Eyes around a mesh."""
    turns = np.linspace(0.1, 0.1 + 2 * np.pi, count, endpoint=False)
    around = np.stack([np.cos(turns), 0.3 * np.sin(3 * turns), np.sin(turns)], axis=1)
    return mesh.center + radii * mesh.radius * around
