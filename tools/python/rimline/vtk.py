"""Silhouettes in VTK pipelines, and so in PyVista, vedo and trame.

    lines = rimline.vtk.Silhouette()
    lines.SetInputConnection(reader.GetOutputPort())
    lines.SetCamera(renderer.GetActiveCamera())

Silhouette has the properties of vtkPolyDataSilhouette and takes its place. It follows the camera by change sets, and its
edges are right where vertices are split, as along seams of textures and in STL files: there VTK's takes every edge for
a border.
"""

# VTK has no types before 9.3.
# mypy: disable-error-code="import,misc"

from __future__ import annotations

import weakref
from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkFiltersHybrid import vtkPolyDataSilhouette

from rimline import Mesh, Tracker

__all__ = ["Silhouette"]


class Silhouette(VTKPythonAlgorithmBase):
    """The silhouette of vtkPolyData as lines over its points, from a camera, a point or a direction."""

    DIRECTION_SPECIFIED_VECTOR, DIRECTION_SPECIFIED_ORIGIN, DIRECTION_CAMERA_ORIGIN, DIRECTION_CAMERA_VECTOR = range(4)
    Directions = vtkPolyDataSilhouette.Directions
    VTK_DIRECTION_SPECIFIED_VECTOR = vtkPolyDataSilhouette.VTK_DIRECTION_SPECIFIED_VECTOR
    VTK_DIRECTION_SPECIFIED_ORIGIN = vtkPolyDataSilhouette.VTK_DIRECTION_SPECIFIED_ORIGIN
    VTK_DIRECTION_CAMERA_ORIGIN = vtkPolyDataSilhouette.VTK_DIRECTION_CAMERA_ORIGIN
    VTK_DIRECTION_CAMERA_VECTOR = vtkPolyDataSilhouette.VTK_DIRECTION_CAMERA_VECTOR

    def __init__(self) -> None:
        super().__init__(nInputPorts=1, inputType="vtkPolyData", nOutputPorts=1, outputType="vtkPolyData")
        self._camera: Any = None
        self._camera_observer: weakref.finalize | None = None
        self._prop: Any = None
        self._direction = self.DIRECTION_CAMERA_ORIGIN
        self._vector = (0.0, 0.0, 0.0)
        self._origin = (0.0, 0.0, 0.0)
        self._has_feature_angle = True
        self._feature_angle = 60.0
        self._has_borders = False
        self._is_piece_invariant = True
        self._known: tuple[Any, int] = (None, 0)
        self._lines: _Lines | None = None

    # Properties, as those of vtkPolyDataSilhouette.

    def _set(self, name: str, value: Any) -> None:
        if getattr(self, name) != value:
            setattr(self, name, value)
            self.Modified()

    def SetCamera(self, camera: Any) -> None:
        """The camera of DIRECTION_CAMERA_ORIGIN and DIRECTION_CAMERA_VECTOR."""
        if camera is self._camera:
            return
        if self._camera_observer is not None:
            self._camera_observer()
        filter_reference = weakref.ref(self)

        def notice(*_: Any) -> None:
            filter_or_none = filter_reference()
            if filter_or_none is not None:
                filter_or_none.Modified()

        self._camera, self._camera_observer = camera, None
        if camera is not None:
            observer = weakref.finalize(self, camera.RemoveObserver, camera.AddObserver("ModifiedEvent", notice))
            observer.atexit = False
            self._camera_observer = observer
        self.Modified()

    def GetCamera(self) -> Any:
        """The camera."""
        return self._camera

    def SetProp3D(self, prop: Any) -> None:
        """The actor of the input: a camera is taken to its coordinates."""
        if prop is self._prop:
            return
        self._prop = prop
        self.SetNumberOfInputPorts(1 if prop is None else 2)
        if prop is not None:
            # No event of an actor tells that its user transform changed, but its GetMTime() does. VTK's filter passes
            # that on, and a pipeline asks all that an input comes from.
            watch = vtkPolyDataSilhouette()
            watch.SetInputData(vtkPolyData())
            watch.SetDirectionToSpecifiedOrigin()
            watch.SetProp3D(prop)
            self.SetInputConnection(1, watch.GetOutputPort())
        self.Modified()

    def GetProp3D(self) -> Any:
        """The actor of the input."""
        return self._prop

    def SetDirection(self, direction: int) -> None:
        """One of the four DIRECTION numbers."""
        self._set("_direction", min(max(int(direction), 0), 3))

    def GetDirection(self) -> int:
        """One of the four DIRECTION numbers."""
        return self._direction

    def SetDirectionToSpecifiedVector(self) -> None:
        """The direction of projection is the vector."""
        self.SetDirection(self.DIRECTION_SPECIFIED_VECTOR)

    def SetDirectionToSpecifiedOrigin(self) -> None:
        """The viewpoint is the origin."""
        self.SetDirection(self.DIRECTION_SPECIFIED_ORIGIN)

    def SetDirectionToCameraVector(self) -> None:
        """The direction of projection is that of the camera."""
        self.SetDirection(self.DIRECTION_CAMERA_VECTOR)

    def SetDirectionToCameraOrigin(self) -> None:
        """The viewpoint is that of the camera, or for a parallel projection its direction."""
        self.SetDirection(self.DIRECTION_CAMERA_ORIGIN)

    def SetVector(self, *vector: Any) -> None:
        """The direction of projection, away from the viewer."""
        self._set("_vector", _three(vector))

    def GetVector(self) -> tuple[float, float, float]:
        """The direction of projection."""
        return self._vector

    def SetOrigin(self, *origin: Any) -> None:
        """The viewpoint."""
        self._set("_origin", _three(origin))

    def GetOrigin(self) -> tuple[float, float, float]:
        """The viewpoint."""
        return self._origin

    def SetEnableFeatureAngle(self, is_enabled: int) -> None:
        """Whether edges that bend by more than FeatureAngle are lines too: as in VTK also borders, if it is below 90."""
        self._set("_has_feature_angle", bool(is_enabled))

    def GetEnableFeatureAngle(self) -> int:
        """Whether edges that bend by more than FeatureAngle are lines too."""
        return int(self._has_feature_angle)

    def SetFeatureAngle(self, degrees: float) -> None:
        """In degrees, 0 to 180."""
        self._set("_feature_angle", min(max(float(degrees), 0.0), 180.0))

    def GetFeatureAngle(self) -> float:
        """In degrees."""
        return self._feature_angle

    def SetBorderEdges(self, is_enabled: int) -> None:
        """Whether edges of one face are lines too."""
        self._set("_has_borders", bool(is_enabled))

    def GetBorderEdges(self) -> int:
        """Whether edges of one face are lines too."""
        return int(self._has_borders)

    def BorderEdgesOn(self) -> None:
        """SetBorderEdges(1)."""
        self.SetBorderEdges(1)

    def BorderEdgesOff(self) -> None:
        """SetBorderEdges(0)."""
        self.SetBorderEdges(0)

    def SetPieceInvariant(self, is_invariant: int) -> None:
        """Has no effect on the lines: the whole input is looked at."""
        self._set("_is_piece_invariant", bool(is_invariant))

    def GetPieceInvariant(self) -> int:
        """What was set."""
        return int(self._is_piece_invariant)

    def PieceInvariantOn(self) -> None:
        """SetPieceInvariant(1)."""
        self.SetPieceInvariant(1)

    def PieceInvariantOff(self) -> None:
        """SetPieceInvariant(0)."""
        self.SetPieceInvariant(0)

    # The pipeline.

    def SetInputData(self, *port_and_data: Any) -> None:
        """The input where it comes from no other filter. A port may come first."""
        self.SetInputDataObject(*port_and_data)

    def AddInputData(self, *port_and_data: Any) -> None:
        """As SetInputData(): the filter has one input."""
        self.AddInputDataObject(*port_and_data)

    def GetInput(self, port: int = 0) -> Any:
        """The vtkPolyData that comes in, or None."""
        return self.GetInputDataObject(port, 0)

    def GetPolyDataInput(self, port: int) -> Any:
        """The same."""
        return self.GetInput(port)

    def GetOutput(self, port: int = 0) -> Any:
        """The lines."""
        return self.GetOutputDataObject(port)

    def SetOutput(self, data: Any) -> None:
        """The vtkPolyData that takes the lines."""
        self.GetExecutive().SetOutputData(0, data)

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        """Called by the pipeline."""
        source = vtkPolyData.GetData(inputs[0], 0)
        target = vtkPolyData.GetData(outputs, 0)
        if self._lines is None or self._known != (source, source.GetMTime()):
            self._lines = _Lines(source)
            self._known = (source, source.GetMTime())
        target.SetPoints(source.GetPoints())
        angle = self._feature_angle if self._has_feature_angle else None
        edges = self._lines.seen_from(self._viewpoint(), angle, self._has_borders)
        if len(edges) > 0:
            lines = vtkCellArray()
            lines.SetData(2, numpy_to_vtkIdTypeArray(edges.ravel(), deep=1))
            target.SetLines(lines)
        return 1

    def _viewpoint(self) -> dict[str, Any]:
        """The point or the direction towards the viewer, in the coordinates of the input."""
        if self._direction == self.DIRECTION_SPECIFIED_ORIGIN:
            return {"eye": self._origin}
        if self._direction == self.DIRECTION_SPECIFIED_VECTOR:
            return {"direction": [-c for c in self._vector]}
        if self._camera is None:
            raise ValueError("rimline.vtk.Silhouette: SetCamera() first, or specify an origin or a vector")
        is_parallel = self._direction == self.DIRECTION_CAMERA_VECTOR or self._camera.GetParallelProjection()
        if is_parallel:
            place = [-c for c in self._camera.GetDirectionOfProjection()] + [0.0]
        else:
            place = [*self._camera.GetPosition(), 1.0]
        if self._prop is not None:
            inverse = vtkMatrix4x4()
            vtkMatrix4x4.Invert(self._prop.GetMatrix(), inverse)
            place = list(inverse.MultiplyPoint(place))
        return {"direction" if is_parallel else "eye": place[:3]}


class _Lines:
    """The lines of one vtkPolyData. Raises ValueError where a point of a face is missing or not finite."""

    def __init__(self, source: Any) -> None:
        triangles = vtkTriangleFilter()
        triangles.SetInputData(source)
        triangles.PassVertsOff()
        triangles.PassLinesOff()
        triangles.Update()
        polys = triangles.GetOutput().GetPolys()
        points = np.zeros((0, 3)) if source.GetPoints() is None else vtk_to_numpy(source.GetPoints().GetData())
        faces = np.zeros((0, 3), dtype=np.int64)
        if polys.GetNumberOfCells() > 0:
            faces = vtk_to_numpy(polys.GetConnectivityArray()).reshape(-1, 3)
        if faces.size > 0 and not 0 <= faces.min() <= faces.max() < len(points):
            raise ValueError(f"rimline.vtk.Silhouette: a face has a point that is none of the {len(points)}")
        is_used = np.zeros(len(points), dtype=bool)
        is_used[faces] = True
        self._points = np.flatnonzero(is_used)  # Of the input, for each vertex of the mesh. Other points may be NaN.
        vertices = points[self._points].astype(np.float64)
        wrong = np.flatnonzero(~(np.abs(vertices) <= 2.0**60).all(axis=1))
        if len(wrong) > 0:
            point = self._points[wrong[0]]
            raise ValueError(
                f"rimline.vtk.Silhouette: point {point}: a coordinate is not a finite number within 2^60"
            )
        self._offset = _offset(vertices)
        self._mesh = Mesh(vertices - self._offset, (np.cumsum(is_used) - 1)[faces])
        self._edges = self._points.take(self._mesh.edges)  # One `take` of a row is less than those of its two points.
        self._tracker: Tracker | None = None
        self._bends: tuple[Any, Any] | None = None
        self._fixed_for: tuple[float | None, bool] | None = None
        self._fixed: Any = None
        self._is_sharp: Any = None

    def seen_from(self, viewpoint: dict[str, Any], angle: float | None, has_borders: bool) -> Any:
        """N x 2 int64: points of the input. Edges that bend by more than `angle` (degrees) are among them, and below 90
        borders too."""
        if "eye" in viewpoint:
            viewpoint = {"eye": np.subtract(viewpoint["eye"], self._offset)}
        if self._tracker is None:
            self._tracker = Tracker(self._mesh, **viewpoint)
        else:
            self._tracker.move_to(**viewpoint)
        if self._fixed_for != (angle, has_borders):
            self._fix(angle, has_borders)
        rows = self._tracker.silhouette
        if self._is_sharp is not None:
            rows = rows.compress(~self._is_sharp.take(rows))
        edges = self._edges.take(rows, axis=0)
        return np.concatenate([edges, self._fixed]) if len(self._fixed) > 0 else edges

    def _fix(self, angle: float | None, has_borders: bool) -> None:
        """Keeps the lines that no viewpoint changes, and which edges of the mesh they are by their angle."""
        self._is_sharp = None
        parts = [np.zeros((0, 2), dtype=np.int64)]
        if angle is not None:
            if self._bends is None:
                self._bends = self._measured_bends()
            rows, cosines = self._bends
            sharp = rows[cosines < np.cos(np.radians(angle))]
            if len(sharp) > 0:
                self._is_sharp = np.zeros(len(self._edges), dtype=bool)
                self._is_sharp[sharp] = True
                parts.append(self._edges[sharp])
        if has_borders or (angle is not None and angle < 90.0):
            parts.append(self._points.take(self._mesh.borders))
        self._fixed = np.concatenate(parts)
        self._fixed_for = (angle, has_borders)

    def _measured_bends(self) -> tuple[Any, Any]:
        """Rows of edges of two faces, and the cosines between these."""
        corners = self._mesh.vertices[self._mesh.faces].astype(np.float64)
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        lengths = np.linalg.norm(normals, axis=1, keepdims=True)
        normals = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
        faces = self._mesh.edge_faces
        rows = np.flatnonzero(faces[:, 1] >= 0)
        return rows, (normals[faces[rows, 0]] * normals[faces[rows, 1]]).sum(axis=1)


def _offset(vertices: Any) -> Any:
    """What to subtract from V x 3 float64 before they are rounded to float32: along axes where they lie farther from 0
    than they extend, their center. There the differences of numbers that are float32 already are exact."""
    if len(vertices) == 0:
        return np.zeros(3)
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    is_far = (low * high > 0) & (np.minimum(np.abs(low), np.abs(high)) >= high - low)
    return np.where(is_far, low + (high - low) / 2, 0.0)


def _three(values: tuple[Any, ...]) -> tuple[float, float, float]:
    numbers = values[0] if len(values) == 1 else values
    x, y, z = (float(number) for number in numbers)
    return x, y, z
