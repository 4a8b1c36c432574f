"""Fields, views, paths, lights and point clouds: what the program says, and closed forms."""

import os
import subprocess
import sys

import numpy as np
import pytest
from conftest import command, have_device

import rimline


@pytest.fixture(scope="module")
def knot():
    return rimline.load("shape:knot:3000")


def test_fields_are_sums_over_planes(knot):
    points = np.random.default_rng(1).uniform(-2, 2, (20, 3))
    for function in ("views", "silhouette", "facing"):
        field = rimline.TangentialField(knot, function, tolerance=0)
        values = field.at(points)
        assert values.shape == (20,)
        for point, value in zip(points.tolist(), values):
            told = command("field", "shape:knot:3000", "--function", function, "--tolerance", "0", "--at",
                           ",".join(map(repr, point)))
            assert value == pytest.approx(told["values"][0], abs=1e-6 * field.max_value)
        near = rimline.TangentialField(knot, function, tolerance=1e-2).at(points)
        assert np.abs(near - values).max() <= 1e-2 * field.max_value + field.error_bound
    # Of a box seen from far away on an axis, one face is in front.
    box = rimline.load("shape:box")
    planes = len(box.faces)
    assert rimline.TangentialField(box, "facing").at([[50, 0.1, 0.2]]) == pytest.approx(planes / 6, rel=1e-5)
    with pytest.raises(ValueError, match="function: expected one of"):
        rimline.TangentialField(knot, "nothing")
    with pytest.raises(ValueError, match="tolerance"):
        rimline.TangentialField(knot, tolerance=-1)
    with pytest.raises(ValueError):
        rimline.TangentialField(knot).at([[np.nan, 0, 0]])
    assert rimline.TangentialField(knot).at(np.zeros((0, 3))).shape == (0,)
    assert "views" in rimline.FIELD_FUNCTIONS


def test_views_are_those_of_the_command(knot):
    have_device()
    told = command("views", "shape:knot:3000", "-k", "3")["views"]
    views = rimline.best_views(knot, 3)
    assert len(views) == 3
    for view, expected in zip(views, told):
        assert view.eye == pytest.approx(expected["eye"], abs=1e-5)
        assert view.target == pytest.approx(expected["target"], abs=1e-5)
        assert view.up == pytest.approx(expected["up"]) and view.fov == pytest.approx(expected["fov"])
        assert view.score == pytest.approx(expected["score"]) and view.votes == pytest.approx(expected["votes"])
        assert view.visible_ratio == pytest.approx(expected["visible_ratio"])
    by_votes = rimline.best_views(knot, 2, visible=False)
    told = command("views", "shape:knot:3000", "-k", "2", "--no-ratio")["views"]
    assert by_votes[0].eye == pytest.approx(told[0]["eye"], abs=1e-5) and by_votes[0].visible_ratio is None
    for wrong in ({"count": 0}, {"count": 65}, {"below": "more"}):
        with pytest.raises(ValueError):
            rimline.best_views(knot, **wrong)


def test_views_need_no_device():
    words = "import rimline; print([(*v.eye, v.visible_ratio) for v in rimline.best_views(rimline.load('shape:knot:2000'), 3)])"
    none = {name: value for name, value in os.environ.items() if name != "RIMLINE_DEVICE"}
    none.update(VK_ICD_FILENAMES="/nonexistent", VK_DRIVER_FILES="/nonexistent")
    result = subprocess.run([sys.executable, "-c", words], env=none, capture_output=True, text=True, check=True)
    views = np.array(eval(result.stdout, {"np": np}))
    assert views.shape == (3, 4) and (views[:, 3] > 0.3).all()
    # A device that is asked for must be there.
    none["RIMLINE_DEVICE"] = "no-such-device"
    asked = subprocess.run([sys.executable, "-c", words], env=none, capture_output=True, text=True)
    assert asked.returncode != 0 and "NoDeviceError" in asked.stderr


def test_paths_pass_through_the_views(knot):
    have_device()
    told = command("path", "shape:knot:3000", "-k", "3", "--frames", "12")
    views = rimline.best_views(knot, 3)
    path = rimline.camera_path(knot, views)
    assert path.nodes == pytest.approx(np.array(told["nodes"]), abs=1e-4)
    assert path.length == pytest.approx(told["length"], rel=1e-4)
    eyes, ups = path.sample(12)
    assert eyes == pytest.approx(np.array(told["samples"]), abs=1e-3)
    assert ups == pytest.approx(np.array(told["ups"]), abs=1e-3)
    assert path.position(0) == pytest.approx(path.nodes[0]) and path.position(1.25) == pytest.approx(
        path.position(0.25))
    assert rimline.camera_path(knot, 3).nodes == pytest.approx(path.nodes)
    for eyes in (np.zeros((0, 3)), [views[0].eye], [[0, 0, 0], [1, 1, 1]], [[9, 9, 9], [0, 9, 9]]):
        with pytest.raises(ValueError):
            rimline.CameraPath(knot, eyes)
    for count in (0, 10**9):
        with pytest.raises(ValueError):
            path.sample(count)
    with pytest.raises(ValueError):
        path.position(float("nan"))
    with pytest.raises(TypeError, match="below"):
        rimline.camera_path(knot, views, below="full")


def test_views_of_a_path_are_a_number_views_or_points(knot):
    path = rimline.camera_path(knot, np.int64(3), visible=False)
    views = rimline.best_views(knot, 3, visible=False)
    eyes = np.array([view.eye for view in views])
    for same in (views, eyes, eyes.tolist(), np.asfortranarray(eyes), (view.eye for view in views)):
        assert (rimline.camera_path(knot, same).nodes == path.nodes).all()
    with pytest.raises(TypeError, match="views: expected an integer, views or points, not float"):
        rimline.camera_path(knot, 2.0, visible=False)
    with pytest.raises(TypeError, match="below: only where views is a number"):
        rimline.camera_path(knot, views, below="full")
    for count_or_views in (3, views):
        with pytest.raises(TypeError, match="unexpected keyword argument 'belw'"):
            rimline.camera_path(knot, count_or_views, belw="full")
    for wrong in (1, np.int64(65), eyes[:1], []):
        with pytest.raises(ValueError, match="views: expected "):
            rimline.camera_path(knot, wrong)
    for wrong in (eyes[:2].T, [(1, 2), (3, 4)]):
        with pytest.raises(ValueError, match=r"views: expected the shape \(N, 3\), not \(\d, 2\)"):
            rimline.camera_path(knot, wrong)
    for wrong in ([(1, 2, 3), (3, 4)], ["view", "view"]):
        with pytest.raises((TypeError, ValueError), match="views: "):
            rimline.camera_path(knot, wrong)


def test_lights_are_those_of_the_command(knot):
    for by, option in (("tones", []), ("votes", ["--by-votes"])):
        told = command("light", "shape:knot:3000", "--eye", "3,2,4", *option)["sun"]
        sun = rimline.best_light(knot, (3, 2, 4), by=by)
        assert sun == pytest.approx(told, abs=1e-5) and np.linalg.norm(sun) == pytest.approx(1)
    with pytest.raises(ValueError):
        rimline.best_light(knot, (3, 2, 4), by="luck")
    for axis, direction in (("z", (0, 0, 1)), ("-y", (0, -1, 0))):
        named = rimline.best_light(knot, (3, 2, 4), up=axis)
        assert (named == rimline.best_light(knot, (3, 2, 4), up=direction)).all()
        views = [rimline.best_views(knot, 1, visible=False, up=up)[0] for up in (axis, direction)]
        assert (views[0].eye == views[1].eye).all() and (views[0].up == np.array(direction)).all()
    assert (rimline.best_views(knot, 1, visible=False, up="auto")[0].up == knot.up).all()
    with pytest.raises(ValueError, match="up: .*'w'"):
        rimline.best_light(knot, (3, 2, 4), up="w")
    with pytest.raises(ValueError, match="center"):
        rimline.best_light(knot, knot.center)


def test_points_are_those_of_the_command(tmp_path):
    mesh = rimline.load("shape:terrain:3000")
    told = command("points", "shape:terrain:3000", "--as-points", "--from", "3,2,4")
    surface = rimline.PointSurface(mesh.vertices)
    labels = surface.labels
    for label, name in enumerate(rimline.POINT_LABELS):
        if name in ("border", "undecided"):
            assert np.flatnonzero(labels == label).tolist() == told[name]
    assert surface.features == pytest.approx(np.array(told["features"]), abs=1e-6)
    silhouette = surface.silhouette((3, 2, 4))
    assert silhouette.points.tolist() == told["silhouette"] and len(silhouette) == len(told["silhouette"])
    assert silhouette.edges.tolist() == told["consensus_edges"]
    direction = surface.silhouette(direction=(1, 0.2, 0.3))
    assert len(direction) > 0


def test_points_of_files_are_rows(tmp_path):
    rows = np.random.default_rng(3).normal(size=(50, 3))
    cloud = tmp_path / "scan é.xyz"
    np.savetxt(cloud, rows, fmt="%.17g")
    points = rimline.load_points(cloud)
    assert points.dtype == np.float64 and (points == rows).all()
    np.savetxt(tmp_path / "scan.csv", rows, fmt="%.17g", delimiter=",", header="x,y,z", comments="")
    assert (rimline.load_points(str(tmp_path / "scan.csv")) == rows).all()
    cloud.write_text("1 2 3\n1 2 nan\n")
    with pytest.raises(rimline.InputError, match="scan é.xyz:2"):
        rimline.load_points(cloud)
    with pytest.raises(rimline.MissingFileError):
        rimline.load_points(tmp_path / "none.xyz")


def test_points_of_a_sphere_have_radial_normals_and_a_round_silhouette():
    sphere = rimline.load("shape:sphere:5000").vertices.astype(np.float64)
    surface = rimline.PointSurface(sphere)
    assert len(surface) == len(sphere)
    assert (np.array(rimline.POINT_LABELS)[surface.labels] == "interior").all()
    assert np.abs((surface.normals * sphere).sum(axis=1)).min() > 0.999
    on = sphere[surface.silhouette((0, 0, 4)).points]
    assert np.abs(on[:, 2] - 0.25).max() < 0.08


def test_stray_points_can_be_left_out():
    random = np.random.default_rng(3)
    lattice = np.stack(np.meshgrid(*2 * [np.arange(40.0)]), axis=-1).reshape(-1, 2)
    sheet = np.column_stack([lattice + random.uniform(-0.2, 0.2, lattice.shape), np.zeros(len(lattice))])
    stray = random.uniform((-10, -10, 5), (50, 50, 30), (40, 3))
    points = np.concatenate([sheet, stray])
    undecided = rimline.POINT_LABELS.index("undecided")
    labels = rimline.PointSurface(points, drop_outliers=True).labels
    assert (labels[len(sheet):] == undecided).all()
    alone = rimline.PointSurface(sheet).labels
    assert (labels[:len(sheet)] == alone).all()
    assert (rimline.PointSurface(points).labels[:len(sheet)] != alone).sum() > 10


def test_equal_points_have_what_the_first_has():
    sphere = rimline.load("shape:sphere:2000").vertices
    twice = np.concatenate([sphere, sphere[::-1]])
    once, surface = rimline.PointSurface(sphere), rimline.PointSurface(twice)
    assert (surface.labels == np.concatenate([once.labels, once.labels[::-1]])).all()
    assert (surface.normals == np.concatenate([once.normals, once.normals[::-1]])).all()
    assert (surface.silhouette((0, 0, 4)).points == once.silhouette((0, 0, 4)).points).all()


@pytest.mark.parametrize("points, k", [
    (np.zeros((0, 3)), 16), (np.zeros((3, 2)), 16), ([[np.nan, 0, 0]], 16), (None, 16), (np.zeros((5, 3)), 3),
    (np.zeros((5, 3)), 33)])
def test_wrong_points_are_errors(points, k):
    with pytest.raises((TypeError, ValueError)):
        rimline.PointSurface(points, k=k)


def test_few_points_are_undecided():
    for points in ([[0, 0, 0]], [[0, 0, 0], [1, 0, 0]], np.zeros((10, 3)), [[i, 0, 0] for i in range(30)]):
        surface = rimline.PointSurface(points)
        assert (np.array(rimline.POINT_LABELS)[surface.labels] == "undecided").all()
        assert len(surface.silhouette((3, 2, 1))) == 0
