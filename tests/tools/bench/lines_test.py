"""rimline bench lines."""
import json
import os
import shutil
import tempfile

from program import TRIANGLE, fail, run, succeed, write_faces

LINES_FEW = ("--views", "3", "--rounds", "1", "--no-others")
RAYS = ["own faces left out", "own faces left out, shortened by 0.001", "one-ring left out"]


def check_view_times(times):
    assert 0 < times["median_ms"] <= times["worst_ms"]


def test_bench_lines_checks_and_then_measures():
    shapes = ("shape:knot:2000", "shape:terrain:500")
    result = succeed("bench", "lines", *shapes, *LINES_FEW)
    assert result["machine"]["cpu"] and result["rounds"] == 1 and "targets" not in result
    assert [model["model"] for model in result["models"]] == list(shapes)
    for model in result["models"]:
        assert model["verified"] is True and model["views"] == 3 and model["surface_ms"] > 0
        oracle, counters = model["oracle"], model["counters"]
        assert oracle["samples"] > 0 and oracle["wrong"] == oracle["missing_edges"] == 0
        assert counters["pieces"] >= counters["lines"] > 0 and counters["chains"] >= 3
        for times in (model["extraction"], model["drawing"], model["shaped"]):
            check_view_times(times)
        if "skipped" not in model["rays"]:
            assert [rays["name"] for rays in model["rays"]] == RAYS
            for rays in model["rays"]:
                check_view_times(rays)
                assert 0 <= rays["wrong_share"] < 1
                assert abs(rays["ratio"] * model["drawing"]["median_ms"] / rays["median_ms"] - 1) < 1e-9
        whole = model["whole"]
        assert whole["text_bytes"] > 0 and whole["ms"] > 0
    # Creases are lines too.
    box = [succeed("bench", "lines", "shape:box", *LINES_FEW, *more)["models"][0]["counters"]["lines"]
           for more in ([], ["--all-lines"])]
    assert box[0] < box[1] == 3 * 12
    table = run("bench", "lines", shapes[0], *LINES_FEW)
    assert table.returncode == 0 and "oracle: " in table.stdout and "draw as a whole" in table.stdout


def test_bench_lines_ends_with_status_3_exactly_when_a_ratio_is_missed():
    result = run("bench", "lines", "shape:knot:5000", *LINES_FEW, "--check", "--json")
    targets = json.loads(result.stdout)["targets"]
    assert all(not target["is_time"] for target in targets) and targets[0]["value"] == 0
    missed = [target["target"] for target in targets if not target["reached"]]
    assert result.returncode == (3 if missed else 0), (targets, result.stderr)
    # Without models of one's own there are built-in ones.
    assert "shape:" in run("bench", "lines", "--views", "1", "--rounds", "1", "--no-others",
                           env={**os.environ, "RIMLINE_MODELS": ""}).stdout


def test_bench_lines_compares_with_other_programs_where_they_are_installed():
    (model,) = succeed("bench", "lines", "shape:knot:5000", "--views", "1", "--rounds", "1")["models"]
    has_blender = shutil.which("blender") is not None
    assert len(model["others"]) == 2 + has_blender
    for other in model["others"]:
        if "skipped" in other:
            assert not (has_blender and other["method"] == "Blender")
            continue
        assert other["ms"] > 0 and other["ratio"] > 0
        if other["method"].startswith("OCCT"):
            assert "wrong_share" not in other
            continue
        # They draw the same lines, nearly all of them right.
        assert 0 <= other["wrong_share"] < 0.05 and 0 <= other["missing_share"] < 0.05, other
    assert "others" not in succeed("bench", "lines", "shape:knot:2000", *LINES_FEW)["models"][0]


def test_bench_lines_follows_the_growth_of_a_shape():
    growth = succeed("bench", "lines", "--growth", *LINES_FEW[:-1], "--least-faces", "1000", "--most-faces",
                     "3000")["growth"]
    assert growth["model"] == "shape:knot" and len(growth["sizes"]) == 2
    for size in growth["sizes"]:
        assert size["verified"] is True and size["peak_bytes"] > 0 and "whole" not in size
        check_view_times(size["drawing"])
    table = run("bench", "lines", "shape:knot", "--growth", *LINES_FEW[:-1], "--least-faces", "1000",
                "--most-faces", "1000")
    assert table.returncode == 0 and "drawing ms" in table.stdout
    assert "--least-faces: belongs to --growth" in fail(2, "bench", "lines", "--least-faces", "10")
    assert "--check: not together with --growth" in fail(2, "bench", "lines", "--growth", "--check")


def test_bench_lines_takes_models_of_one_face_and_refuses_what_is_one_point():
    with tempfile.TemporaryDirectory() as folder:
        point = write_faces(os.path.join(folder, "point.obj"), ((1, 2, 3),) * 3)
        assert point + ": its radius is 0" in fail(1, "bench", "lines", point)
        one = write_faces(os.path.join(folder, "one.obj"), TRIANGLE)
        line = write_faces(os.path.join(folder, "line.obj"), ((0, 0, 0), (0, 1, 0), (0, 2, 0)))
        for path in (one, line):
            assert succeed("bench", "lines", path, *LINES_FEW)["models"][0]["counters"]["lines"] == 9
