"""rimline silhouette."""
import os
import re
import tempfile

from program import check_silhouette, fail, have_methods, succeed


def test_concave_edges_can_be_left_out():
    view = ["silhouette", "shape:torus:3000", "--from", "4,1,2"]
    every = {tuple(edge) for edge in succeed(*view)["edges"]}
    found = succeed(*view, "--no-concave")
    kept = {tuple(edge) for edge in found["edges"]}
    assert kept < every and found["count"] == len(kept) > len(every) / 3
    assert succeed("silhouette", "shape:sphere:3000", "--from", "4,1,2", "--no-concave")["count"] == succeed("silhouette", "shape:sphere:3000", "--from", "4,1,2")["count"]


def test_a_box_has_the_silhouette_that_one_can_draw():
    low, high = succeed("info", "shape:box:12")["bounds"]
    size = [b - a for a, b in zip(low, high)]
    # Before the middle of a face its rim is the silhouette; before a corner, a hexagon.
    center = [(a + b) / 2 for a, b in zip(low, high)]
    before_face = ",".join(str(c + 10 * s * axis) for c, s, axis in zip(center, size, (0, 0, 1)))
    found = succeed("silhouette", "shape:box:12", "--from", before_face)
    check_silhouette(found)
    assert found["count"] == 4 and found["borders"] == 0
    found = succeed("silhouette", "shape:box:12", "--direction", "-1,-1,-1")
    check_silhouette(found)
    assert found["count"] == 6


def test_border_edges_need_a_file():
    view = ["silhouette", "shape:terrain:2000", "--from", "4,1,2"]
    found = succeed(*view)
    check_silhouette(found)
    assert found["borders"] > 0
    for options in ([], ["--json"]):
        assert "--borders: needs -o" in fail(2, *view, "--borders", *options)
    assert "--as: needs -o -" in fail(2, *view, "--as", "obj", "-o", "a.svg")
    with tempfile.TemporaryDirectory() as folder:
        lines = []
        for options in ([], ["--borders"]):
            path = os.path.join(folder, "a.obj")
            assert succeed(*view, *options, "-o", path)["edges"] == found["edges"]
            with open(path) as file:
                lines.append(sum(line.startswith("l ") for line in file))
        assert lines == [found["count"], found["count"] + found["borders"]]


EXACT = ("octree", "literal", "brute", "brute-scalar", "edge-buffer", "dual", "plane-tree", "gauss", "cone-tree", "quadric")


def test_all_exact_methods_find_the_same_edges():
    have_methods()
    for shape in ("torus:3000", "scene"):
        for view in (["--from", "3,2,1"], ["--direction", "0.2,-1,0.4"]):
            truth = succeed("silhouette", "shape:" + shape, *view, "--method", "brute-scalar")["edges"]
            for method in EXACT:
                if method == "gauss" and view[0] == "--from":
                    continue
                found = succeed("silhouette", "shape:" + shape, *view, "--method", method)
                assert found["method"] == method and found["edges"] == truth, (shape, view, method)
                assert "recall" not in found


def test_the_randomised_method_reports_its_recall():
    have_methods()
    view = ["silhouette", "shape:sphere:20000", "--from", "3,2,1"]
    truth = {tuple(edge) for edge in succeed(*view)["edges"]}
    found = succeed(*view, "--method", "randomised", "--seed", "7")
    edges = {tuple(edge) for edge in found["edges"]}
    assert edges <= truth and 0 < found["recall"] <= 1 and abs(found["recall"] - len(edges) / len(truth)) < 1e-9
    assert found["counters"]["random_edges"] > 0
    assert succeed(*view, "--method", "randomised", "--seed", "7")["edges"] == found["edges"]


def test_octree_and_brute_force_find_the_same_edges():
    for shape in ("torus:3000", "terrain:2000", "scene"):
        for view in (["--from", "3,2,1"], ["--from", "0,0,0"], ["--direction", "0.2,-1,0.4"]):
            octree = succeed("silhouette", "shape:" + shape, *view)
            check_silhouette(octree)
            brute = succeed("silhouette", "shape:" + shape, *view, "--method", "brute-scalar")
            moved = succeed("silhouette", "shape:" + shape, *view, "--origin", "0.5,0.25,-0.1")
            several = succeed("silhouette", "shape:" + shape, *view, "--origin", "0,0,0", "--origin", "0.5,0,0.5", "--origin", "9,9,9", "--threads", "1")
            assert octree["edges"] == brute["edges"] == moved["edges"] == several["edges"], (shape, view)
            assert brute["counters"]["face_checks"] == brute["faces"]
            short = succeed("silhouette", "shape:" + shape, *view, "--no-edges")
            assert "edges" not in short and short["count"] == octree["count"]


def test_line_files_hold_the_edges_that_are_reported():
    with tempfile.TemporaryDirectory() as folder:
        for ending in ("obj", "ply", "svg"):
            path = os.path.join(folder, "lines." + ending)
            found = succeed("silhouette", "shape:knot:2000", "--from", "4,3,2", "-o", path)
            assert found["output"] == path and found["count"] > 0
            with open(path) as file:
                text = file.read()
            if ending == "obj":
                pairs = re.findall(r"^# vertices (\d+) (\d+) faces \d+ \d+\nl \d+ \d+$", text, re.M)
                assert [sorted(map(int, pair)) for pair in pairs] == found["edges"]
            elif ending == "ply":
                assert f"element edge {found['count']}\n" in text
            else:
                assert text.count("<line ") == found["count"]
        assert sorted(os.listdir(folder)) == ["lines.obj", "lines.ply", "lines.svg"]
