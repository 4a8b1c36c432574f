"""Times VTK's vtkPolyDataSilhouette for `rimline bench hough`.

Reads a mesh and viewpoints from standard input, as little-endian numbers:

    uint64 vertices, triangles, points, rounds
    float32 x, y, z      for each vertex
    uint32  a, b, c      for each triangle
    float64 x, y, z      for each viewpoint

and prints one JSON object: VTK's version, and for each point the microseconds of the filter's update (the
least of all rounds) and the number of its output lines. A time is the lesser of the clock's and the
processor's, so that other programs do not count. The times do not include the edge table, which the filter
builds once a mesh, nor Python's work but the call. Ends with status 77 if VTK is not installed for this
Python.
"""

import array
import json
import sys
import time

try:
    from vtkmodules.vtkCommonCore import vtkFloatArray, vtkIdTypeArray, vtkPoints, vtkVersion
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkFiltersHybrid import vtkPolyDataSilhouette
    import vtkmodules.vtkRenderingCore  # For the filter's camera, which exists even if it is not used.
except ImportError:
    sys.exit(77)


def read(type_code, count):
    numbers = array.array(type_code)
    numbers.frombytes(sys.stdin.buffer.read(count * numbers.itemsize))
    if len(numbers) != count:
        sys.exit("vtk_silhouette.py: standard input ends early")
    return numbers


vertex_count, triangle_count, point_count, rounds = read("Q", 4)
positions = read("f", 3 * vertex_count)
corners = read("I", 3 * triangle_count)
viewpoints = read("d", 3 * point_count)

coordinates = vtkFloatArray()
coordinates.SetNumberOfComponents(3)
coordinates.SetVoidArray(positions, len(positions), 1)  # No copy: `positions` stays alive until the end.
points = vtkPoints()
points.SetData(coordinates)

cells = vtkCellArray()
cells.AllocateExact(triangle_count, len(corners))
for first in range(0, len(corners), 3):
    cells.InsertNextCell(3, corners[first : first + 3])
mesh = vtkPolyData()
mesh.SetPoints(points)
mesh.SetPolys(cells)

silhouette = vtkPolyDataSilhouette()
silhouette.SetInputData(mesh)
silhouette.SetDirectionToSpecifiedOrigin()
silhouette.SetEnableFeatureAngle(0)  # Silhouettes alone: no creases, no borders.
silhouette.SetBorderEdges(0)
silhouette.SetOrigin(0.0, 0.0, 0.0)
silhouette.Update()  # Builds the edge table.

times_us = [float("inf")] * point_count
lines = [0] * point_count
for _ in range(rounds):
    for i in range(point_count):
        silhouette.SetOrigin(viewpoints[3 * i], viewpoints[3 * i + 1], viewpoints[3 * i + 2])
        processor_start, start = time.process_time(), time.perf_counter()
        silhouette.Update()
        seconds = min(time.perf_counter() - start, time.process_time() - processor_start)
        times_us[i] = min(times_us[i], 1e6 * seconds)
        lines[i] = silhouette.GetOutput().GetNumberOfLines()

print(json.dumps({"version": vtkVersion.GetVTKVersion(), "us": times_us, "lines": lines}))
