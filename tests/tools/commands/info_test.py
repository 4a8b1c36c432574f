"""rimline info."""
import math
import os
import tempfile

from program import fail, is_vector, run, succeed


def test_info_counts_shapes():
    for shape in ("sphere", "torus", "knot", "box", "spring"):
        found = succeed("info", f"shape:{shape}:1000")
        assert found["closed"] is True and found["oriented"] is True, shape
        assert found["components"] == 1 and found["border_edges"] == 0
        assert found["edges"] * 2 == found["faces"] * 3
        euler = found["vertices"] - found["edges"] + found["faces"]
        assert euler == (0 if shape in ("torus", "knot") else 2), shape
        assert is_vector(found["center"]) and found["radius"] > 0
        assert len(found["bounds"]) == 2 and all(map(is_vector, found["bounds"]))
    open_mesh = succeed("info", "shape:terrain:1000")
    assert open_mesh["closed"] is False and open_mesh["border_edges"] > 0
    coarse, fine = succeed("info", "shape:box"), succeed("info", "shape:box", "--subdivide", "2")
    assert fine["faces"] == 16 * coarse["faces"] and fine["closed"] is True
    summary = run("info", "shape:box")
    assert summary.returncode == 0 and str(coarse["faces"]) in summary.stdout


def test_info_takes_every_point_of_a_cloud_as_used():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "cloud.ply")
        with open(path, "w") as file:
            file.write("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                       "property float z\nend_header\n0 0 0\n4 0 0\n-0 0 0\n4 2 0\n")
        found = succeed("info", path)
        assert (found["vertices"], found["file_vertices"], found["faces"]) == (3, 4, 0)
        assert found["center"] == [2, 1, 0] and math.isclose(found["radius"], math.sqrt(5))
        assert found["bounds"] == [[0, 0, 0], [4, 2, 0]] and found["closed"] is False
        assert path in fail(1, "silhouette", path, "--from", "1,2,3")
