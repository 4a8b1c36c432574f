"""rimline.vtk.Silhouette in place of vtkPolyDataSilhouette."""

import gc
import warnings
import weakref

import numpy as np
import pytest
from conftest import orbit, pairs

vtk_data = pytest.importorskip("vtkmodules.vtkCommonDataModel")
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonMath import vtkMatrix4x4  # noqa: E402
from vtkmodules.vtkCommonTransforms import vtkTransform  # noqa: E402
from vtkmodules.vtkFiltersCore import vtkTriangleFilter  # noqa: E402
from vtkmodules.vtkFiltersHybrid import vtkPolyDataSilhouette  # noqa: E402
from vtkmodules.vtkRenderingCore import vtkActor, vtkCamera  # noqa: E402

import vtkmodules.vtkRenderingOpenGL2  # noqa: E402,F401  Makes actors and cameras.

import rimline  # noqa: E402
import rimline.vtk  # noqa: E402


def poly_data(vertices, faces):
    data = vtk_data.vtkPolyData()
    points = vtk_points(vertices)
    data.SetPoints(points)
    cells = vtk_data.vtkCellArray()
    faces = np.asarray(faces, dtype=np.int64)
    offsets = np.arange(0, faces.size + 1, faces.shape[1], dtype=np.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=1), numpy_to_vtkIdTypeArray(faces.ravel(), deep=1))
    data.SetPolys(cells)
    return data


def vtk_points(vertices):
    from vtkmodules.vtkCommonCore import vtkPoints

    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(vertices), deep=1))
    return points


def lines_of(algorithm):
    algorithm.Update()
    lines = algorithm.GetOutput().GetLines()
    if lines.GetNumberOfCells() == 0:
        return set()
    return pairs(vtk_to_numpy(lines.GetConnectivityArray()).reshape(-1, 2))


@pytest.fixture
def filters():
    knot = rimline.load("shape:knot:2000")
    data = poly_data(knot.vertices, knot.faces)
    ours, theirs = rimline.vtk.Silhouette(), vtkPolyDataSilhouette()
    for one in (ours, theirs):
        one.SetInputData(data)
        one.SetEnableFeatureAngle(0)
    return knot, data, ours, theirs


def test_lines_follow_the_camera_as_vtks_do(filters):
    knot, _, ours, theirs = filters
    camera = vtkCamera()
    for one in (ours, theirs):
        one.SetCamera(camera)
    camera.SetFocalPoint(*knot.center)
    for eye in orbit(knot, 12):
        camera.SetPosition(*eye)
        assert lines_of(ours) == lines_of(theirs) == pairs(knot.silhouette(eye).edges)
    ours.SetDirectionToCameraVector()
    theirs.SetDirectionToCameraVector()
    assert lines_of(ours) == lines_of(theirs)
    ours.SetDirectionToCameraOrigin()
    camera.ParallelProjectionOn()
    towards = [-c for c in camera.GetDirectionOfProjection()]
    assert lines_of(ours) == pairs(knot.silhouette(direction=towards).edges)


def test_an_actor_moves_the_camera_to_its_coordinates(filters):
    _, _, ours, theirs = filters
    camera, actor = vtkCamera(), vtkActor()
    actor.SetPosition(1, 2, 3)
    actor.RotateY(30)
    camera.SetPosition(4, 3, 5)
    for one in (ours, theirs):
        one.SetCamera(camera)
        one.SetProp3D(actor)
    first = lines_of(ours)
    assert first == lines_of(theirs)
    actor.RotateX(40)
    assert lines_of(ours) == lines_of(theirs) != first


@pytest.mark.parametrize("kind", ["transform", "part of a transform", "matrix"])
def test_what_an_actor_was_given_may_change_in_place(filters, kind):
    _, _, ours, theirs = filters
    camera, actor = vtkCamera(), vtkActor()
    camera.SetPosition(4, 3, 5)
    part, whole, matrix = vtkTransform(), vtkTransform(), vtkMatrix4x4()
    whole.Concatenate(part)
    if kind == "matrix":
        actor.SetUserMatrix(matrix)
    else:
        actor.SetUserTransform(part if kind == "transform" else whole)
    for one in (ours, theirs):
        one.SetCamera(camera)
        one.SetProp3D(actor)
    after = vtkTriangleFilter()
    after.PassLinesOn()
    after.SetInputConnection(ours.GetOutputPort())
    first = lines_of(ours)
    assert lines_of(after) == first == lines_of(theirs)
    time = ours.GetOutput().GetMTime()
    ours.Update()
    assert ours.GetOutput().GetMTime() == time
    part.RotateY(70)
    matrix.SetElement(0, 2, 3)
    assert lines_of(after) == lines_of(ours) == lines_of(theirs) != first
    for one in (ours, theirs):
        one.SetProp3D(None)
    assert lines_of(ours) == lines_of(theirs) == first
    assert ours.GetNumberOfInputPorts() == 1 and ours.GetProp3D() is None


def test_points_vectors_angles_and_borders_are_those_of_vtk():
    terrain = rimline.load("shape:terrain:1000")
    box = rimline.load("shape:box")
    for mesh in (terrain, box):
        ours, theirs = rimline.vtk.Silhouette(), vtkPolyDataSilhouette()
        for one in (ours, theirs):
            one.SetInputData(poly_data(mesh.vertices, mesh.faces))
            one.SetDirectionToSpecifiedOrigin()
            one.SetOrigin(3, 2, 4)
            one.SetFeatureAngle(20)
        assert lines_of(ours) == lines_of(theirs)
        for one in (ours, theirs):
            one.BorderEdgesOn()
            one.SetDirectionToSpecifiedVector()
            one.SetVector(-0.3, -0.7, 0.2)
        assert lines_of(ours) == lines_of(theirs)
        assert ours.GetFeatureAngle() == 20 and ours.GetBorderEdges() == 1 and ours.GetEnableFeatureAngle() == 1
        assert ours.GetOrigin() == (3, 2, 4) and ours.GetVector() == (-0.3, -0.7, 0.2)


def test_split_vertices_are_joined(filters):
    knot, _, ours, theirs = filters
    corners = knot.vertices[knot.faces].reshape(-1, 3)
    data = poly_data(corners, np.arange(len(corners)).reshape(-1, 3))
    for one in (ours, theirs):
        one.SetInputData(data)
        one.SetDirectionToSpecifiedOrigin()
        one.SetOrigin(3, 2, 4)
    assert lines_of(theirs) == set()  # VTK sees borders alone.
    first_of = {tuple(p): i for i, p in reversed(list(enumerate(corners.tolist())))}
    number = [first_of[tuple(p)] for p in knot.vertices.tolist()]
    expected = {tuple(sorted((number[a], number[b]))) for a, b in knot.silhouette((3, 2, 4)).edges.tolist()}
    assert lines_of(ours) == expected


def test_quads_strips_and_changed_inputs_are_read():
    quads = np.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]])
    corners = np.array([[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], dtype=float)
    ours = rimline.vtk.Silhouette()
    data = poly_data(corners, quads)
    ours.SetInputData(data)
    ours.SetDirectionToSpecifiedOrigin()
    ours.SetOrigin(0.5, 0.4, 9)
    assert lines_of(ours) == {(4, 5), (5, 6), (6, 7), (4, 7), (0, 4), (1, 5), (2, 6), (3, 7),
                              (0, 1), (1, 2), (2, 3), (0, 3)}  # With those of 90 degrees.
    ours.SetEnableFeatureAngle(0)
    assert lines_of(ours) == {(4, 5), (5, 6), (6, 7), (4, 7)}
    data.SetPoints(vtk_points(corners * [1, 1, -1]))
    data.Modified()
    assert lines_of(ours) == {(4, 5), (5, 6), (6, 7), (4, 7)} or lines_of(ours) == {(0, 1), (1, 2), (2, 3), (0, 3)}
    ours.SetInputData(vtk_data.vtkPolyData())
    assert lines_of(ours) == set()


def test_the_camera_holds_no_filter(filters):
    _, data, _, _ = filters
    camera = vtkCamera()
    ours = rimline.vtk.Silhouette()
    ours.SetInputData(data)
    ours.SetCamera(camera)
    ours.Update()
    assert camera.HasObserver("ModifiedEvent")
    reference = weakref.ref(ours)
    del ours
    gc.collect()
    assert reference() is None
    assert not camera.HasObserver("ModifiedEvent")
    camera.SetPosition(3, 2, 1)


def test_the_lines_that_no_camera_changes_are_found_once(monkeypatch):
    read = []

    class Mesh(rimline.Mesh):
        def __getattribute__(self, name):
            read.append(name)
            return super().__getattribute__(name)

    monkeypatch.setattr(rimline.vtk, "Mesh", Mesh)
    box = rimline.load("shape:box")
    ours = rimline.vtk.Silhouette()
    ours.SetInputData(poly_data(box.vertices, box.faces))
    ours.SetDirectionToSpecifiedOrigin()
    ours.SetOrigin(3, 2, 4)
    assert len(lines_of(ours)) == 12 and "edges" in read
    read.clear()
    for eye in orbit(box, 5):
        ours.SetOrigin(*eye)
        assert len(lines_of(ours)) == 12 and len(vtk_to_numpy(ours.GetOutput().GetLines().GetConnectivityArray())) == 24
    assert read == []
    ours.SetFeatureAngle(95)
    assert lines_of(ours) == pairs(box.silhouette(eye).edges)
    ours.SetFeatureAngle(80)
    assert len(lines_of(ours)) == 12


@pytest.mark.parametrize("kind", [np.float64, np.float32])
def test_models_far_from_the_origin_have_the_same_lines(filters, kind):
    knot, _, ours, _ = filters
    vertices = knot.vertices.astype(np.float64)
    # In steps of what float32 has at 4,000,000.
    vertices = vertices if kind == np.float64 else np.round(256 * vertices) / 4
    near = rimline.Mesh(vertices, knot.faces)
    offset = np.array([500000.0, -4000000.0, 0.0])
    data = poly_data((vertices + offset).astype(kind), knot.faces)
    ours.SetInputData(data)
    ours.SetDirectionToSpecifiedOrigin()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for eye in orbit(near, 8):
            ours.SetOrigin(*(eye + offset))
            assert lines_of(ours) == pairs(near.silhouette(eye).edges)
    ours.SetDirectionToSpecifiedVector()
    ours.SetVector(-0.3, -0.7, 0.2)
    assert lines_of(ours) == pairs(near.silhouette(direction=(0.3, 0.7, -0.2)).edges)
    assert ours.GetOutput().GetPoints() is data.GetPoints()


def test_points_of_no_face_may_be_anything(filters):
    knot, _, ours, _ = filters
    odd = np.array([[np.nan, 0, 0], [1e30, np.inf, 0], knot.vertices[0]])
    data = poly_data(np.concatenate([odd, knot.vertices]), knot.faces.astype(np.int64) + len(odd))
    ours.SetInputData(data)
    ours.SetDirectionToSpecifiedOrigin()
    ours.SetOrigin(3, 2, 4)
    assert lines_of(ours) == pairs(knot.silhouette((3, 2, 4)).edges.astype(np.int64) + len(odd))
    with pytest.raises(ValueError, match="point 1: a coordinate is not a finite number within 2\\^60"):
        rimline.vtk._Lines(poly_data(np.concatenate([odd, knot.vertices]), [[3, 4, 1]]))
    with pytest.raises(ValueError, match="a face has a point that is none of the 3"):
        rimline.vtk._Lines(poly_data(odd, [[0, 1, 3]]))


def test_the_filter_has_what_that_of_vtk_has(filters):
    _, data, ours, theirs = filters
    assert set(dir(theirs)) - set(dir(ours)) == set()
    for name in ("SPECIFIED_VECTOR", "SPECIFIED_ORIGIN", "CAMERA_ORIGIN", "CAMERA_VECTOR"):
        number = getattr(theirs, f"VTK_DIRECTION_{name}")
        ours.SetDirection(getattr(ours, f"VTK_DIRECTION_{name}"))
        assert ours.GetDirection() == number == getattr(ours, f"DIRECTION_{name}")
    for one in (rimline.vtk.Silhouette(), vtkPolyDataSilhouette()):
        assert one.GetInput() is None and one.GetPieceInvariant() == 1
        one.PieceInvariantOff()
        assert one.GetPieceInvariant() == 0
        one.PieceInvariantOn()
        assert one.GetPieceInvariant() == 1
        one.AddInputData(data)
        assert one.GetInput() is data and one.GetInput(0) is data and one.GetPolyDataInput(0) is data
        one.SetInputData(0, data)
        output = vtk_data.vtkPolyData()
        one.SetOutput(output)
        one.SetDirectionToSpecifiedOrigin()
        one.SetOrigin(3, 2, 4)
        assert len(lines_of(one)) > 0 and one.GetOutput() is output and one.GetOutput(0) is output
