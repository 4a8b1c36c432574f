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

from rimline import Mesh, Tracker

__all__ = ["Silhouette"]


class Silhouette(VTKPythonAlgorithmBase):
    """The silhouette of vtkPolyData as lines over its points, from a camera, a point or a direction."""

    DIRECTION_SPECIFIED_VECTOR, DIRECTION_SPECIFIED_ORIGIN, DIRECTION_CAMERA_ORIGIN, DIRECTION_CAMERA_VECTOR = range(4)

    def __init__(self) -> None:
        super().__init__(nInputPorts=1, inputType="vtkPolyData", nOutputPorts=1, outputType="vtkPolyData")
        self._camera: Any = None
        self._camera_observer: weakref.finalize | None = None
        self._prop: Any = None
        self._prop_observer: weakref.finalize | None = None
        self._direction = self.DIRECTION_CAMERA_ORIGIN
        self._vector = (0.0, 0.0, 0.0)
        self._origin = (0.0, 0.0, 0.0)
        self._has_feature_angle = True
        self._feature_angle = 60.0
        self._has_borders = False
        self._known: tuple[Any, int] = (None, 0)
        self._mesh: Mesh | None = None
        self._tracker: Tracker | None = None
        self._sharp: tuple[float, Any] | None = None

    # Properties, as those of vtkPolyDataSilhouette.

    def _set(self, name: str, value: Any) -> None:
        if getattr(self, name) != value:
            setattr(self, name, value)
            self.Modified()

    def _observe(self, watched: Any, name: str) -> None:
        """`watched` takes the place of the attribute `name`, and this filter is modified when it is."""
        if getattr(self, name) is watched:
            return
        stop_watching = getattr(self, f"{name}_observer")
        if stop_watching is not None:
            stop_watching()
        filter_reference = weakref.ref(self)

        def notice(*_: Any) -> None:
            filter_or_none = filter_reference()
            if filter_or_none is not None:
                filter_or_none.Modified()

        setattr(self, name, watched)
        observer = None
        if watched is not None:
            observer = weakref.finalize(self, watched.RemoveObserver, watched.AddObserver("ModifiedEvent", notice))
            observer.atexit = False
        setattr(self, f"{name}_observer", observer)
        self.Modified()

    def SetCamera(self, camera: Any) -> None:
        """The camera of DIRECTION_CAMERA_ORIGIN and DIRECTION_CAMERA_VECTOR."""
        self._observe(camera, "_camera")

    def GetCamera(self) -> Any:
        """The camera."""
        return self._camera

    def SetProp3D(self, prop: Any) -> None:
        """The actor of the input: a camera is taken to its coordinates."""
        self._observe(prop, "_prop")

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
        """Has no effect: the whole input is looked at."""

    def GetPieceInvariant(self) -> int:
        """Always 1."""
        return 1

    # The pipeline.

    def SetInputData(self, data: Any) -> None:
        """The input where it comes from no other filter."""
        self.SetInputDataObject(0, data)

    def GetOutput(self) -> Any:
        """The lines."""
        return self.GetOutputDataObject(0)

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        """Called by the pipeline."""
        source = vtkPolyData.GetData(inputs[0], 0)
        target = vtkPolyData.GetData(outputs, 0)
        self._take(source)
        target.SetPoints(source.GetPoints())
        edges = self._edges()
        if len(edges) == 0:
            return 1
        connectivity = np.ascontiguousarray(edges, dtype=np.int64).ravel()
        offsets = np.arange(0, len(connectivity) + 1, 2, dtype=np.int64)
        lines = vtkCellArray()
        lines.SetData(numpy_to_vtkIdTypeArray(offsets, deep=1), numpy_to_vtkIdTypeArray(connectivity, deep=1))
        target.SetLines(lines)
        return 1

    def _take(self, source: Any) -> None:
        """Makes the mesh of another input, or of one that has changed."""
        if self._mesh is not None and self._known == (source, source.GetMTime()):
            return
        self._tracker, self._sharp = None, None
        triangles = vtkTriangleFilter()
        triangles.SetInputData(source)
        triangles.PassVertsOff()
        triangles.PassLinesOff()
        triangles.Update()
        polys = triangles.GetOutput().GetPolys()
        points = source.GetPoints()
        vertices = np.zeros((0, 3)) if points is None else vtk_to_numpy(points.GetData())
        faces = np.zeros((0, 3), dtype=np.int64)
        if polys.GetNumberOfCells() > 0:
            faces = vtk_to_numpy(polys.GetConnectivityArray()).reshape(-1, 3)
        self._mesh = Mesh(vertices, faces)
        self._known = (source, source.GetMTime())

    def _edges(self) -> Any:
        assert self._mesh is not None
        viewpoint = self._viewpoint()
        if self._tracker is None:
            self._tracker = Tracker(self._mesh, **viewpoint)
        else:
            self._tracker.move_to(**viewpoint)
        parts = [self._tracker.edges]
        if self._has_feature_angle:
            silhouette = np.zeros(len(self._mesh.edges), dtype=bool)
            silhouette[self._tracker.silhouette] = True
            sharp = self._sharp_edges()
            parts.append(self._mesh.edges[sharp[~silhouette[sharp]]])
        if self._has_borders or (self._has_feature_angle and self._feature_angle < 90.0):
            parts.append(self._mesh.borders)
        return np.concatenate(parts)

    def _sharp_edges(self) -> Any:
        """Rows of edges of two faces whose normals differ by more than the feature angle."""
        assert self._mesh is not None
        if self._sharp is None or self._sharp[0] != self._feature_angle:
            corners = self._mesh.vertices[self._mesh.faces].astype(np.float64)
            normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            lengths = np.linalg.norm(normals, axis=1, keepdims=True)
            normals = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
            faces = self._mesh.edge_faces
            rows = np.flatnonzero(faces[:, 1] >= 0)
            cosines = (normals[faces[rows, 0]] * normals[faces[rows, 1]]).sum(axis=1)
            self._sharp = (self._feature_angle, rows[cosines < np.cos(np.radians(self._feature_angle))])
        return self._sharp[1]

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


def _three(values: tuple[Any, ...]) -> tuple[float, float, float]:
    numbers = values[0] if len(values) == 1 else values
    x, y, z = (float(number) for number in numbers)
    return x, y, z
