"""Borders of points by Open3D and PCL, for `rimline bench points`.

Reads points from standard input, as little-endian numbers:

    uint64  points
    uint64  1 for all settings, 0 for 16 neighbors and 120 degrees alone
    float32 x, y, z      for each

and prints one JSON object: for each library, number of neighbors and threshold in degrees ("Open3D 16 90"),
the numbers of the points that the library labels as border. Open3D is used if this Python imports it
(Debian: python3-open3d), PCL if its programs are installed (pcl-tools). A library that is missing or fails is
left out.
"""

import array
import json
import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile

DEBIANS = "/usr/bin/python3"
try:
    import open3d
except ImportError:
    if os.path.exists(DEBIANS) and sys.executable != DEBIANS:
        sys.exit(77)  # Debian's Python may have it and is tried next.
    open3d = None

SETTINGS = ((16, 120), (16, 90), (16, 150), (30, 90))  # 30 and 90 are Open3D's defaults.
MAX_RADIUS = 10  # In medians over the points. Open3D's time grows with the square.


def read(type_code, count):
    numbers = array.array(type_code)
    numbers.frombytes(sys.stdin.buffer.read(count * numbers.itemsize))
    if len(numbers) != count:
        sys.exit("library_borders.py: standard input ends early")
    return numbers


def by_open3d(positions):
    import numpy

    points = numpy.array(positions, dtype=numpy.float64).reshape(-1, 3)
    tensor = open3d.core.Tensor(points)
    cloud = open3d.t.geometry.PointCloud(tensor)
    search = open3d.core.nns.NearestNeighborSearch(tensor)
    search.knn_index()
    borders = {}
    for neighbors, threshold in settings:
        cloud.estimate_normals(max_nn=neighbors)
        # The time grows with the radius, so it is the least radius that contains the neighbors; where some points are
        # remote, these have fewer.
        reaches = search.knn_search(tensor, neighbors)[1].numpy().max(axis=1) ** 0.5
        radius = min(1.001 * float(reaches.max()), MAX_RADIUS * float(numpy.median(reaches)))
        _, mask = cloud.compute_boundary_points(radius, neighbors, threshold)
        borders[f"Open3D {neighbors} {threshold}"] = numpy.flatnonzero(mask.numpy()).tolist()
    return borders


def by_pcl(positions):
    def run(program, *arguments):
        subprocess.run([program, *map(str, arguments)], cwd=folder, check=True, stdin=subprocess.DEVNULL,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    count = len(positions) // 3
    header = (f"VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {count}\nHEIGHT 1\n"
              f"VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {count}\nDATA binary\n")
    borders = {}
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "points.pcd"), "wb") as file:
            file.write(header.encode() + positions.tobytes())
        for neighbors, threshold in settings:
            run("pcl_normal_estimation", "points.pcd", "normals.pcd", "-k", neighbors)
            run("pcl_boundary_estimation", "normals.pcd", "borders.pcd", "-k", neighbors,
                "-thresh", math.radians(threshold))
            with open(os.path.join(folder, "borders.pcd")) as file:
                lines = file.read().split("\n")
            fields = next(line.split()[1:] for line in lines if line.startswith("FIELDS"))
            at = fields.index("boundary_point")
            rows = lines[lines.index("DATA ascii") + 1:][:count]
            borders[f"PCL {neighbors} {threshold}"] = \
                [number for number, row in enumerate(rows) if row.split()[at] == "1"]
    return borders


def stop(*_):
    signal.signal(signal.SIGTERM, signal.SIG_IGN)  # A second signal must not interrupt the exit.
    sys.exit(1)  # Removes the temporary folder.


signal.signal(signal.SIGTERM, stop)
# The libraries' own output must not mix with the JSON.
answer = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)
point_count, has_all_settings = read("Q", 2)
settings = sorted(SETTINGS) if has_all_settings else SETTINGS[:1]
positions = read("f", 3 * point_count)
borders = {}
if open3d:
    try:
        borders.update(by_open3d(positions))
    except Exception as error:  # The other library is still tried.
        print(f"Open3D: {error}", file=sys.stderr)
if shutil.which("pcl_boundary_estimation") and shutil.which("pcl_normal_estimation"):
    try:
        borders.update(by_pcl(positions))
    except Exception as error:
        print(f"PCL: {error}", file=sys.stderr)
json.dump(borders, answer)
answer.close()
