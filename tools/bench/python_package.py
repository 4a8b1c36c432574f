"""Times the Python package beside numpy and VTK; checks that what follows the eye finds the edges of all faces tested.

    PYTHONPATH=build/release/python python3 tools/bench/python_package.py [--json] [--check] [MODEL...]

Without models: stanford-bunny.obj and igea.ply of the folders of RIMLINE_MODELS, or a built-in shape. Of each it follows
an orbit in steps of half a degree:

    silhouette    Mesh.silhouette(), which tests all faces
    tracker       Tracker.move_to() and the arrays of what joined and left
    filter        rimline.vtk.Silhouette, the update alone, with EnableFeatureAngle off
    vtk           vtkPolyDataSilhouette, the same
    filter+angle  rimline.vtk.Silhouette with EnableFeatureAngle on, as it is at first
    vtk+angle     vtkPolyDataSilhouette, the same
    numpy         all faces and edges with numpy, vectorized

Times are medians. A call beside the move is that of a tracker that stays where it is. --check exits with status 3 where
a call takes 5 us or more, the filter is not 10 times as fast as VTK's with either setting, or edges differ; without VTK
its part is left out.
"""

import argparse
import json
import os
import pathlib
import statistics
import sys
import time

import numpy as np

import rimline

try:
    import rimline.vtk
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints, vtkVersion
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkFiltersHybrid import vtkPolyDataSilhouette
    import vtkmodules.vtkRenderingCore  # noqa: F401  For the filter's camera.
except ImportError:
    vtkPolyDataSilhouette = None

FRAMES = 40
STEP_DEG = 0.5


def median_us(work, items):
    times = []
    for item in items:
        start = time.perf_counter()
        work(item)
        times.append(1e6 * (time.perf_counter() - start))
    return statistics.median(times)


def sorted_pairs(edges):
    edges = np.sort(np.asarray(edges, dtype=np.int64), axis=1)
    return edges[np.lexsort((edges[:, 1], edges[:, 0]))]


class NumpySilhouette:
    """What one writes with numpy: face sides from planes, and a comparison of the two faces of each edge."""

    def __init__(self, mesh):
        corners = mesh.vertices[mesh.faces].astype(np.float64)
        self.normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self.offsets = (self.normals * corners[:, 0]).sum(axis=1)
        self.edges, self.faces = mesh.edges, mesh.edge_faces

    def __call__(self, eye):
        front = self.normals @ eye > self.offsets
        two = self.faces[:, 1] >= 0
        return self.edges[two & (front[self.faces[:, 0]] != front[self.faces[:, 1]])]


def poly_data(vertices, faces):
    data, points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(vertices), deep=1))
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, faces.size + 1, 3, dtype=np.int64), deep=1),
                  numpy_to_vtkIdTypeArray(faces.astype(np.int64).ravel(), deep=1))
    data.SetPoints(points)
    data.SetPolys(cells)
    return data


def filter_of(kind, data, has_feature_angle=0):
    one = kind()
    one.SetInputData(data)
    one.SetDirectionToSpecifiedOrigin()
    one.SetEnableFeatureAngle(has_feature_angle)
    return one


def lines_of(one):
    lines = one.GetOutput().GetLines()
    return vtk_to_numpy(lines.GetConnectivityArray()).reshape(-1, 2) if lines.GetNumberOfCells() else np.zeros((0, 2))


def measure(model):
    mesh = rimline.load(model)
    turns = np.radians(STEP_DEG * np.arange(FRAMES))
    eyes = mesh.center + 2.5 * mesh.radius * np.stack([np.cos(turns), 0.2 + 0 * turns, np.sin(turns)], axis=1)
    eyes = [tuple(eye) for eye in eyes.astype(np.float32).astype(np.float64).tolist()]
    result = {"model": pathlib.Path(model).name, "faces": len(mesh.faces), "differences": 0}
    by_numpy = NumpySilhouette(mesh)

    result["silhouette_us"] = median_us(mesh.silhouette, eyes)
    result["numpy_us"] = median_us(by_numpy, [np.array(eye) for eye in eyes[:10]])
    tracker = rimline.Tracker(mesh, eyes[0])

    def move(eye):
        change = tracker.move_to(eye)
        return change.added, change.removed

    for eye in eyes:
        move(eye)
    result["tracker_us"] = median_us(move, eyes)
    for eye in eyes[::8]:
        tracker.move_to(eye)
        # numpy's sides of faces that are seen edge-on may differ: it rounds otherwise.
        expected = sorted_pairs(mesh.silhouette(eye).edges)
        result["differences"] += not np.array_equal(sorted_pairs(tracker.edges), expected)
        result["numpy_edges"] = len(by_numpy(np.array(eye)))
        result["edges"] = len(expected)

    if vtkPolyDataSilhouette is not None:
        data = poly_data(mesh.vertices, mesh.faces)

        def update(one):
            def run(eye):
                one.SetOrigin(*eye)
                one.Update()
            return run

        for setting, has_feature_angle in (("", 0), ("+angle", 1)):
            ours = filter_of(rimline.vtk.Silhouette, data, has_feature_angle)
            theirs = filter_of(vtkPolyDataSilhouette, data, has_feature_angle)
            update(ours)(eyes[0])
            update(theirs)(eyes[0])  # Makes its table of edges.
            result[f"filter{setting}_us"] = median_us(update(ours), eyes[1:])
            result[f"vtk{setting}_us"] = median_us(update(theirs), eyes[1:9])
            for eye in eyes[::16]:
                update(ours)(eye)
                found, expected = (set(map(tuple, sorted_pairs(edges).tolist()))
                                   for edges in (lines_of(ours), mesh.silhouette(eye).edges))
                result["differences"] += not (found >= expected if has_feature_angle else found == expected)
        split = mesh.vertices[mesh.faces].reshape(-1, 3)
        data = poly_data(split, np.arange(len(split)).reshape(-1, 3))
        ours, theirs = filter_of(rimline.vtk.Silhouette, data), filter_of(vtkPolyDataSilhouette, data)
        for name, one in (("filter", ours), ("vtk", theirs)):
            update(one)(eyes[0])
            result[f"{name}_split_edges"] = len(lines_of(one))
        result["split_edges"] = len(mesh.silhouette(eyes[0]))
        result["differences"] += result["filter_split_edges"] != result["split_edges"]
    return result


def call_us():
    tracker = rimline.Tracker(rimline.load("shape:box"), (3, 2, 1))
    best = float("inf")
    for _ in range(50):
        start = time.perf_counter()
        for _ in range(1000):
            tracker.move_to((3, 2, 1)).added
        best = min(best, 1e3 * (time.perf_counter() - start))
    return best


def default_models():
    found = []
    for folder in os.environ.get("RIMLINE_MODELS", "").split(":"):
        for name in ("stanford-bunny.obj", "igea.ply"):
            path = pathlib.Path(folder) / name
            if folder and path.is_file():
                found.append(str(path))
    return found or ["shape:knot:100000"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="*", metavar="MODEL")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--check", action="store_true", help="exit with status 3 where a target is missed")
    arguments = parser.parse_args()
    try:
        results = [measure(model) for model in arguments.models or default_models()]
    except rimline.Error as error:
        sys.exit(f"python_package.py: error: {error}")
    call = call_us()
    version = None if vtkPolyDataSilhouette is None else vtkVersion.GetVTKVersion()
    if arguments.json:
        print(json.dumps({"call_us": call, "vtk": version, "models": results}))
    else:
        print(f"a call beside the move {call:.2f} us; {'VTK ' + version if version else 'no VTK'}")
        for r in results:
            print(f"{r['model']}, {r['faces']:,} faces, {r['edges']:,} silhouette edges")
            for name in ("silhouette", "tracker", "filter", "vtk", "filter+angle", "vtk+angle", "numpy"):
                if f"{name}_us" in r:
                    ratio = r[f"{name}_us"] / r["tracker_us"]
                    print(f"  {name:<13}{r[f'{name}_us']:12.1f} us{ratio:10.1f}x the tracker")
            if "vtk_split_edges" in r:
                print(f"  with split vertices: {r['split_edges']:,} edges, the filter finds "
                      f"{r['filter_split_edges']:,}, VTK {r['vtk_split_edges']:,}")
    differ = [f"{r['model']}: edges differ" for r in results if r["differences"]]
    missed = [f"{r['model']}: the filter is not 10 times as fast as VTK's" for r in results if "vtk_us" in r
              and min(r["vtk_us"] / r["filter_us"], r["vtk+angle_us"] / r["filter+angle_us"]) < 10]
    missed += ["a call takes 5 us or more"] if call >= 5 else []
    missed = differ + (missed if arguments.check else [])
    for line in missed:
        print(f"python_package.py: {line}", file=sys.stderr)
    sys.exit(3 if missed else 0)


main()
