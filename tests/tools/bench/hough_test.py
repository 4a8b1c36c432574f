"""rimline bench hough."""
import json
import os
import tempfile

from program import fail, have_methods, run, succeed


BENCH_FEW = ("--rounds", "1", "--viewpoints", "10", "--frames", "10")


def check_bench_methods(methods):
    assert methods[0]["ratio"] == 1
    for method in methods:
        assert 0 < method["median_us"] <= method["p99_us"] <= method["p999_us"], method
        assert method["mean_us"] > 0 and method["points"] > 0
        assert abs(method["ratio"] * methods[0]["median_us"] / method["median_us"] - 1) < 1e-9


def test_bench_checks_and_then_measures():
    have_methods()
    few = (*BENCH_FEW, "--worst-frames", "40", "--builds", "1")
    shapes = ("shape:knot:2000", "shape:terrain:500")
    result = succeed("bench", "hough", *shapes, *few)
    assert result["machine"]["cpu"] and result["machine"]["instruction_set"]
    assert [(c["case"], c["model"]) for c in result["cases"]] == [
        (case, shape) for shape in shapes for case in ("extraction", "update", "worst")]
    baselines = {"extraction": ["octree", "brute force", "scalar", "plain loop"],
                 "update": ["tracker", "brute tracker", "brute force", "brute, bits only", "scalar"],
                 "worst": ["tracker", "fresh tracker"]}
    for case in result["cases"]:
        assert case["verified"] is True and case["mean_silhouette"] > 0
        assert case["points"] == (40 if case["case"] == "worst" else 10)
        assert [m["method"] for m in case["methods"]] == baselines[case["case"]]
        check_bench_methods(case["methods"])
    for model in result["models"]:
        assert model["build_ms"] > 0 and model["bytes_a_face"] > 0
        assert 0 < model["bytes_streamed"] <= model["bytes_full"]
        assert all(model["worst_update"][key] > 0 for key in ("work", "p999", "frame_p999"))
        assert "ceiling" not in model and "targets" not in result  # Too small; not asked for.
        assert "skipped" in model["vtk"] or model["vtk"]["ratio"] > 1
    assert "vtk" not in succeed("bench", "hough", shapes[0], "--no-vtk", *few)["models"][0]
    table = run("bench", "hough", shapes[0], *few)
    assert table.returncode == 0 and "median us" in table.stdout and "streamed: " in table.stdout


def test_bench_ends_with_status_3_exactly_when_a_ratio_is_missed():
    have_methods()
    missed_any = False
    # On twelve faces no index is worth its while.
    for shape in ("shape:knot:30000", "shape:box:12"):
        result = run("bench", "hough", shape, *BENCH_FEW, "--worst-frames", "5", "--no-vtk", "--check", "--json")
        targets = json.loads(result.stdout)["targets"]
        assert len(targets) == 2 and all(t["reach"] == 1 and not t["is_time"] for t in targets), targets
        assert all(t["reached"] == (t["value"] >= 1) for t in targets)
        missed = [t["target"] for t in targets if not t["reached"]]
        assert result.returncode == (3 if missed else 0), (targets, result.stderr)
        assert result.stderr == (f"rimline: error: {shape}: {missed[0]}: missed\n" if missed else "")
        missed_any = missed_any or bool(missed)
    assert missed_any


def test_bench_measures_every_method_there_is():
    have_methods()
    result = succeed("bench", "hough", "shape:knot:2000", "--methods", *BENCH_FEW)
    (model,) = result["models"]
    assert model["verified"] is True and list(model["build_ms"])[0] == "octree"
    tables = {t["table"]: {m["method"]: m for m in t["methods"]} for t in model["tables"]}
    assert list(tables) == ["extraction, viewpoints", "extraction, directions", "update, viewpoints",
                            "update, directions"]
    for table in model["tables"]:
        check_bench_methods(table["methods"])
    assert set(tables["extraction, directions"]) == set(model["build_ms"])
    assert set(model["build_ms"]) - set(tables["extraction, viewpoints"]) == {"gauss"}
    assert "brute-scalar" not in tables["update, viewpoints"] and "literal" in tables["update, viewpoints"]
    assert tables["extraction, viewpoints"]["literal"]["own_counts"]["pbv_checks"] > 0
    recalls = {m: found["recall"] for m, found in tables["extraction, viewpoints"].items()}
    assert 0 < recalls.pop("randomised") <= 1 and set(recalls.values()) == {1}


def test_bench_follows_the_growth_of_a_shape_and_of_a_file():
    have_methods()
    growth = succeed("bench", "hough", "shape:knot", "--growth", *BENCH_FEW, "--least-faces", "1000",
                     "--most-faces", "10000")["growth"]
    faces = [size["faces"] for size in growth["sizes"]]
    assert len(faces) == 3 and faces == sorted(faces) and 500 < faces[0] and faces[-1] < 20000
    for size in growth["sizes"]:
        assert size["verified"] is True and size["peak_bytes"] > 0
        for case in ("extraction", "update"):
            found = size[case]
            assert abs(found["brute_us"] / found["octree_us"] / found["ratio"] - 1) < 1e-9
    assert set(growth["overtaken_at_faces"]) == {"extraction", "update"}
    with tempfile.TemporaryDirectory() as folder:
        tetrahedron = os.path.join(folder, "tetrahedron.off")
        with open(tetrahedron, "w") as file:
            file.write("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
        sizes = succeed("bench", "hough", tetrahedron, "--growth", *BENCH_FEW, "--least-faces", "60",
                        "--most-faces", "1024")["growth"]["sizes"]
        assert [size["faces"] for size in sizes] == [64, 256, 1024]


def test_bench_counts_by_each_way_to_read_the_thesis():
    have_methods()
    result = succeed("bench", "hough", "shape:knot:3000", "--readings", "--viewpoints", "14",
                     "--most-faces", "1000")["readings"][0]
    assert result["verified"] is True and result["faces"] <= 1000
    boxes = result["box_tests"]
    assert all(count >= boxes["exact"] for test, count in boxes.items() if test != "ebv_first")
    assert {(o["radii"], o["step_degrees"]) for o in result["orbits"]} >= {(1.05, 0.5), (10, 5)}
    assert all(o["hough"] > 0 and o["dual"] > 0 for o in result["orbits"])
    for arguments in (("--readings", "--figures"), ("--readings", "--frames", "5"), ("--most-faces", "50")):
        fail(2, "bench", "hough", "shape:box:12", *arguments)
