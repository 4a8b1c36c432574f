"""rimline bench points."""
import json
import os
import shutil
import subprocess

from program import fail, run, succeed


def test_bench_points_measures_borders_beside_the_gap_rule():
    found = succeed("bench", "points", "shape:sphere:4000")["points"][0]
    assert found["kind"] == "smooth" and found["border"] == 0
    methods = [count["method"] for count in found["borders"]]
    assert methods[:6] == ["robust", "thesis", "gap 90", "gap 120", "gap 150", "gap 180"]
    assert found["borders"][0]["extra"] == 0 and found["borders"][0]["found"]
    assert found["normal_error_99_deg"] < 5 and found["wrong_normals"] == found["wrong_normals_apart"] == 0
    # Open3D and PCL where they are installed, to whose rule our own comes close.
    has_open3d = any(subprocess.run([python, "-c", "import open3d"], capture_output=True).returncode == 0
                     for python in ("python3", "/usr/bin/python3") if shutil.which(python))
    assert len(methods) == 6 + 4 * has_open3d + 4 * bool(shutil.which("pcl_boundary_estimation"))
    terrain = succeed("bench", "points", "shape:terrain:4000")["points"][0]
    missed = {count["method"]: count["missed"] for count in terrain["borders"]}
    assert terrain["border"] == 180 and missed["gap 150"] > 0
    # Nothing is near it anywhere.
    assert terrain["border_wide"] == 180
    assert all(count["missed_wide"] == count["missed"] for count in terrain["borders"])
    for method in methods[6:]:
        library, neighbors, threshold = method.split()
        if neighbors == "16":
            assert abs(missed[method] - missed[f"gap {threshold}"]) <= 1, method
    # Without models of one's own there are built-in ones, and what checks nothing is no success.
    result = run("bench", "points", "--check", "--json", env={**os.environ, "RIMLINE_MODELS": ""})
    assert result.returncode == 0, result.stderr
    shapes = json.loads(result.stdout)
    assert [r["kind"] for r in shapes["points"]] == ["wide", "smooth", "smooth", "smooth"]
    assert [r["borders"][0]["found"] for r in shapes["points"]] == [True] * 4
    # Two of all wide models together, three of closed ones; one wide model alone has no share that is found.
    assert len(shapes["targets"]) == 5 and all(t["reached"] for t in shapes["targets"])
    result = run("bench", "points", "shape:box:12", "--check")
    assert result.returncode == 3 and "of which there is none" in result.stderr
    assert "not expected: --growth" in fail(2, "bench", "points", "--growth")
    # Noise moves what is measured, and the same each time.
    noisy = [succeed("bench", "points", "shape:sphere:4000", "--noise", noise)
             for noise in ("0.1", "0.1", "0.3")]
    errors = [n["points"][0]["normal_error_median_deg"] for n in noisy]
    assert [n["noise"] for n in noisy] == [0.1, 0.1, 0.3]
    assert found["normal_error_median_deg"] < errors[0] == errors[1] < errors[2]
    assert "not expected: --noise" in fail(2, "bench", "fields", "--noise", "0.1")
    # Points spread evenly have a border, too. Nothing else is measured of them.
    even = succeed("bench", "points", "shape:terrain:4000", "--even")
    assert even["even"] and not noisy[0]["even"]
    [spread] = even["points"]
    assert spread["kind"] == "wide" and 1000 < spread["points"] < terrain["points"] and spread["border"] > 100
    assert spread["borders"][0]["method"] == "robust" and spread["borders"][0]["found"]
    assert spread["normal_error_99_deg"] == 0 and spread["border_wide"] == 0
    for other in (["--check"], ["--noise", "0.1"]):
        assert "--even" in fail(2, "bench", "points", "--even", *other)
