#!/usr/bin/env python3
"""The rimline program as its users call it: exit status, what is printed where, what is written.

    program_test.py PROGRAM CASE        CASE is one of the test_ functions below

Exit status 77 means skipped: a case needs a model that no folder of RIMLINE_MODELS has.
"""
import json
import math
import os
import re
import resource
import shutil
import signal
import stat
import struct
import subprocess
import sys
import tempfile
import time

PROGRAM = os.path.abspath(sys.argv[1])
COMMANDS = ("render", "animate", "info", "silhouette", "track", "views", "path", "light", "origins",
            "field", "points", "bench", "view", "devices")


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=500, **options)


def succeed(*arguments):
    """Runs with --json and returns the object."""
    result = run(*arguments, "--json")
    assert result.returncode == 0, (arguments, result.returncode, result.stderr)
    assert result.stderr == "", result.stderr  # No progress where there is no terminal.
    assert result.stdout.count("\n") == 1 and result.stdout.endswith("\n")
    return json.loads(result.stdout)


def fail(status, *arguments):
    """Runs, checks the status, that standard output is empty, and returns the one line of the error."""
    result = run(*arguments)
    assert result.returncode == status, (arguments, result.returncode, result.stderr)
    assert result.stdout == "", (arguments, result.stdout)
    lines = result.stderr.splitlines()
    assert len(lines) == 1 and lines[0].startswith("rimline: error: "), (arguments, result.stderr)
    return lines[0]


def model(name):
    for folder in os.environ.get("RIMLINE_MODELS", "").split(":"):
        path = os.path.join(folder, name)
        if folder and os.path.exists(path):
            return path
    print(f"SKIPPED: no {name} in RIMLINE_MODELS")
    sys.exit(77)


def has_methods():
    return "Not in this build:" not in run("silhouette", "--help").stdout


def have_methods():
    """Leaves the case as skipped where the program was built without the other silhouette methods."""
    if not has_methods():
        print("SKIPPED: this rimline was built without the other silhouette methods")
        sys.exit(77)


def is_count(value):
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0


def is_vector(value):
    return len(value) == 3 and all(isinstance(x, (int, float)) and math.isfinite(x) for x in value)


def check_silhouette(found):
    assert all(is_count(found[k]) for k in ("vertices", "faces", "count", "borders"))
    assert set(found["counters"]) == {"box_checks", "face_checks", "edge_checks"}
    assert found["ms"] >= 0
    edges = found["edges"]
    assert len(edges) == found["count"]
    assert edges == sorted(edges) and all(a < b for a, b in edges)
    assert len(set(map(tuple, edges))) == len(edges)


def check_track(result, frame_count):
    keys = ("flips", "added", "removed", "silhouette", "box_checks", "face_checks")
    frames, totals = result["frames"], result["totals"]
    assert len(frames) == frame_count
    for frame in frames:
        assert all(is_count(frame[k]) for k in keys) and frame["us"] >= 0
    for key in keys:
        assert totals[key] == sum(frame[key] for frame in frames), key
    assert math.isclose(totals["us"], sum(frame["us"] for frame in frames), rel_tol=1e-9)
    assert totals["max_us"] == max(frame["us"] for frame in frames)
    for before, after in zip(frames, frames[1:]):
        assert after["silhouette"] - before["silhouette"] == after["added"] - after["removed"]
    assert frames[0]["flips"] == frames[0]["added"] == frames[0]["removed"] == 0


def test_version_and_help_go_to_standard_output():
    version = run("--version")
    assert version.returncode == 0 and re.fullmatch(r"rimline \d+\.\d+\.\d+\n", version.stdout)
    help_text = run("--help")
    assert help_text.returncode == 0 and help_text.stderr == ""
    assert all(command in help_text.stdout for command in COMMANDS)


def test_every_subcommand_has_help():
    suites = [("bench", suite) for suite in ("hough", "service", "engine", "fields", "views", "points")]
    assert all("  " + suite in run("bench", "--help").stdout for _, suite in suites)
    for command in [(name,) for name in COMMANDS] + suites:
        result = run(*command, "--help")
        assert result.returncode == 0 and result.stderr == "", command
        assert "Usage: rimline " + " ".join(command) in result.stdout
        assert "--json" in result.stdout
        assert "\n\n\n" not in result.stdout
        assert all(len(line) <= 110 for line in result.stdout.splitlines()), command


def test_wrong_usage_exits_2():
    result = run()
    assert result.returncode == 2 and result.stdout == ""
    assert all(command in result.stderr for command in COMMANDS)
    box = "shape:box"
    for arguments in (
            ["frobnicate"], ["frobnicate", "--help"], ["--frobnicate"], ["info"], ["info", box, "--frobnicate"], ["info", box, box],
            ["info", "shape:cube"], ["info", "shape:box:0"], ["info", box, "--subdivide", "-1"],
            ["info", box, "--subdivide", "99"],
            ["silhouette", box], ["silhouette", "--from", "1,2,3"],
            ["silhouette", box, "--from", "1,2"], ["silhouette", box, "--from", "1,2,nan"],
            ["silhouette", box, "--from", "1,2,1e19"], ["silhouette", box, "--direction", "0,0,0"],
            ["silhouette", box, "--from", "1,2,3", "--direction", "1,0,0"],
            ["silhouette", box, "--from", "1,2,3", "--from", "1,2,3"],
            ["silhouette", box, "--from", "1,2,3", "--method", "nonsense"], ["silhouette", box, "--from", "1,2,3", "--method", "gauss"],
            ["silhouette", box, "--from", "1,2,3", "--method", "dual", "--origin", "0,0,0", "--origin", "1,0,0"],
            ["silhouette", box, "--from", "1,2,3", "--method", "brute", "--origin", "0,0,0"],
            ["silhouette", box, "--from", "1,2,3", "--seed", "3"], ["info", box, "--threads", "0"],
            ["silhouette", box, "--from", "1,2,3", "-o", "lines.pdf"], ["silhouette", box, "--from"],
            ["track", box, "--frames", "0"], ["track", box, "--frames", "2.5"], ["track", box, "--step", "x"],
            ["info", ""], ["info", "--json", "--json=maybe", box], ["help", "frobnicate"], ["--json", "frobnicate"],
            ["track", box, "--path", ""], ["track", box, "--up", "0,0,0"], ["track", box, "--radius", "-1"], ["track", box, "--radius", "inf"],
            ["points"], ["points", "shape:cube"], ["points", box, "--eye", "1,2"], ["points", box, "-k", "3"],
            ["points", box, "--as-points", "--from", "1,2,3", "--direction", "1,0,0"],
            ["points", box, "--as-points", "--method", "best"], ["points", box, "--as-points", "--omega", "90"],
            ["points", box, "--as-points", "--gap-ratio", "2", "--omega", "30"],
            ["points", box, "--as-points", "--method", "robust", "--gamma", "2"],
            ["points", box, "--as-points", "--omega", "20", "--omega-t", "25"],
            ["points", box, "--as-points", "--export", "labels.obj"], ["points", box, "--as-points", "--mode", "all"],
            ["points", box, "--as-points", "--verify"], ["points", box, "--as-points", "--turn", "0"],
            ["bench"], ["bench", "nothing"], ["bench", "fields", box, "--rounds", "0"]):
        line = fail(2, *arguments)
        assert "--help" in line, line


def test_help_and_version_stand_wherever_one_looks_for_them():
    assert run("help").stdout == run("--help").stdout != ""
    assert run("help", "track").stdout == run("track", "--help").stdout != ""
    assert "\n  rimline render " in run("help").stdout and "rimline render" in run().stderr
    for command in COMMANDS:
        result = run(command, "--version")
        assert result.returncode == 0 and result.stdout == run("--version").stdout, command
    before, after = run("--json", "info", "shape:box"), run("info", "shape:box", "--json")
    assert before.returncode == 0 and before.stdout == after.stdout


def test_wrong_usage_is_told_in_plain_words():
    view = ["silhouette", "shape:box", "--from", "1,2,3"]
    assert "--from: give it only once" in fail(2, *view, "--from", "1,2,3")
    assert "--from: expects a value" in fail(2, "silhouette", "shape:box", "--from")
    assert "--method: expected octree, literal, brute, brute-scalar, edge-buffer, dual, plane-tree, gauss, cone-tree, quadric or randomised, not 'foo'" in fail(2, *view, "--method", "foo")
    assert "--method gauss: takes directions only" in fail(2, *view, "--method", "gauss")
    assert "--origin: belongs to --method octree, literal or dual" in fail(2, *view, "--method", "brute", "--origin", "0,0,0")
    assert "several belong to --method octree" in fail(2, *view, "--method", "literal", "--origin", "0,0,0", "--origin", "1,0,0")
    assert "--seed: belongs to --method randomised" in fail(2, *view, "--seed", "3")
    assert "SUITE: expected one of {hough,service,engine,fields,views,points}, not 'foo'" in fail(2, "bench", "foo")
    assert "MODEL: expected a file or shape:NAME" in fail(2, "info", "")
    apart = succeed("silhouette", "shape:box", "--from", " 1, 2 ,+3")
    assert apart["edges"] == succeed(*view)["edges"]


def test_concave_edges_can_be_left_out():
    view = ["silhouette", "shape:torus:3000", "--from", "4,1,2"]
    every = {tuple(edge) for edge in succeed(*view)["edges"]}
    found = succeed(*view, "--no-concave")
    kept = {tuple(edge) for edge in found["edges"]}
    assert kept < every and found["count"] == len(kept) > len(every) / 3
    assert succeed("silhouette", "shape:sphere:3000", "--from", "4,1,2", "--no-concave")["count"] == succeed("silhouette", "shape:sphere:3000", "--from", "4,1,2")["count"]


def test_several_origins_track_the_same_changes():
    path = ["track", "shape:spring:3000", "--path", "random", "--frames", "60", "--seed", "5", "--verify"]
    one = succeed(*path)
    several = succeed(*path, "--origin", "0,0,0", "--origin", "0.5,0.2,-0.4")
    assert one["verified"] and several["verified"]
    for a, b in zip(one["frames"], several["frames"]):
        assert (a["flips"], a["added"], a["removed"]) == (b["flips"], b["added"], b["removed"])


def test_track_refuses_the_options_of_other_paths():
    with tempfile.TemporaryDirectory() as folder:
        points = os.path.join(folder, "points.txt")
        with open(points, "w") as file:
            file.write("1,2,3\n  # a comment\n4 5 6\n")
        track = ["track", "shape:box", "--path"]
        values = {"--radius": "7", "--step": "3", "--up": "0,1,0", "--seed": "4"}
        for path, own in (("orbit", ("--radius", "--step", "--up")), ("random", ("--seed",)), (points, ())):
            for option, value in values.items():
                if option in own:
                    check_track(succeed(*track, path, option, value, "--frames", "2"), 2)
                else:
                    owner = "random" if option == "--seed" else "orbit"
                    assert f"{option}: belongs to --path {owner}, not to --path {path}" in fail(
                        2, *track, path, option, value)
        line = fail(2, *track, points, "--frames", "3")
        assert line.startswith(f"rimline: error: --frames: {points} holds 2 points"), line
        check_track(succeed(*track, points, "--frames", "2"), 2)


def test_a_pipe_is_no_path_and_does_not_keep_the_program_waiting():
    with tempfile.TemporaryDirectory() as folder:
        pipe = os.path.join(folder, "pipe")
        os.mkfifo(pipe)
        for path in (pipe, "/dev/zero"):
            line = fail(1, "track", "shape:box", "--path", path)
            assert line.startswith(f"rimline: error: {path}: is not a regular file"), line


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))


def test_what_is_too_large_is_refused_by_its_name():
    for command in (["info"], ["silhouette", "--from", "1,2,3"], ["track"], ["bench", "fields"]):
        line = fail(1, *command, "shape:sphere:10", "--subdivide", "14")
        assert line.startswith("rimline: error: shape:sphere:10: 20 faces refined 14 times"), line
        assert "; take fewer" in line
    # The sanitizers' own memory does not fit under such a limit.
    if run("--version", preexec_fn=limit_memory).returncode != 0:
        return
    # The first does not hold the shape, the second not its mesh.
    for shape in ("shape:knot:200000000", "shape:knot:16000000"):
        for command in (["info"], ["silhouette", "--from", "1,2,3"], ["track"], ["bench", "fields"]):
            result = run(*command, shape, preexec_fn=limit_memory)
            assert result.returncode == 1, (result.returncode, result.stderr)
            assert result.stderr.startswith(f"rimline: error: {shape}: there is not enough memory"), result.stderr


def test_bad_input_exits_1_with_one_line_that_names_it():
    with tempfile.TemporaryDirectory() as folder:
        bad = os.path.join(folder, "bad.obj")
        with open(bad, "w") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 0 1 zero\nf 1 2 3\n")
        points = os.path.join(folder, "points.txt")
        with open(points, "w") as file:
            file.write("1 2 3\n1 2\n")
        gone = os.path.join(folder, "gone.obj")
        for command in (["info"], ["silhouette", "--from", "1,2,3"], ["track"], ["bench", "fields"]):
            assert gone in fail(1, *command, gone)
            assert bad + ":3" in fail(1, *command, bad, "--json")
            assert folder in fail(1, *command, folder)
        assert points + ":2" in fail(1, "track", "shape:box", "--path", points)
        assert gone in fail(1, "track", "shape:box", "--path", gone)


def test_a_model_too_small_to_be_seen_is_an_error():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "tiny.obj")
        for size in (1e-14, 1e-18, 1e-40):
            with open(path, "w") as file:
                for a in (0, 1):
                    for corner in ((a, 0, 0), (0, a, 0), (0, 0, a)):
                        file.write("v %g %g %g\n" % tuple(size * x for x in corner))
                file.write("f 1 5 4\nf 1 6 5\nf 1 4 6\nf 4 5 6\n")
            for command in (["info"], ["silhouette", "--from", "1,2,3"]):
                if size < 1e-14:
                    assert path + ": too small" in fail(1, *command, path)
                else:
                    succeed(*command, path)


def test_a_model_too_large_to_be_seen_from_around_is_an_error():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "huge.obj")
        with open(path, "w") as file:
            file.write("v 9e17 0 0\nv 0 9e17 0\nv 0 0 9e17\nv -9e17 0 0\nf 1 2 3\nf 2 4 3\n")
        assert path in fail(1, "bench", "service", path)
        assert path in fail(1, "bench", "fields", path)
        have_device()
        output = os.path.join(folder, "views")
        for command in (["views", "-o", output], ["path", "-o", output], ["bench", "views"], ["bench", "engine"]):
            assert path + ": too large" in fail(1, *command, path)


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


def test_an_output_file_is_written_whole_or_not_at_all():
    with tempfile.TemporaryDirectory() as folder:
        view = ["silhouette", "shape:box", "--from", "3,2,1", "-o"]
        nowhere = os.path.join(folder, "no", "such", "a.obj")
        assert nowhere in fail(1, *view, nowhere)
        os.mkdir(os.path.join(folder, "a.obj"))
        assert "folder" in fail(1, *view, os.path.join(folder, "a.obj"))
        assert os.listdir(folder) == ["a.obj"]
        # What fails after the output was opened leaves the old one as it was, and nothing beside it.
        old = os.path.join(folder, "b.obj")
        with open(old, "w") as file:
            file.write("old")
        fail(1, "silhouette", os.path.join(folder, "gone.obj"), "--from", "3,2,1", "-o", old)
        with open(old) as file:
            assert file.read() == "old"
        assert sorted(os.listdir(folder)) == ["a.obj", "b.obj"]
        assert run(*view, old).returncode == 0
        assert sorted(os.listdir(folder)) == ["a.obj", "b.obj"]
        assert stat.S_ISREG(os.stat(old).st_mode)


def test_a_full_disk_behind_standard_output_is_an_error():
    if not os.path.exists("/dev/full"):
        print("SKIPPED: no /dev/full")
        sys.exit(77)
    for arguments in (["info", "shape:box", "--json"], ["--help"], ["track", "--help"], ["--version"], ["info", "--version"]):
        for where in (">/dev/full", ">&-"):
            result = subprocess.run(["sh", "-c", 'exec "$0" "$@" ' + where, PROGRAM, *arguments],
                                    stderr=subprocess.PIPE, text=True, timeout=60)
            assert result.returncode == 1 and result.stderr.count("\n") == 1, (arguments, where, result)
            assert result.stderr.startswith("rimline: error: standard output: cannot write: "), result.stderr
            assert "Success" not in result.stderr, (arguments, where, result)


def read_file(path):
    with open(path, "rb") as file:
        return file.read()


def test_no_output_takes_the_place_of_the_model():
    with tempfile.TemporaryDirectory() as folder:
        obj = write_faces(os.path.join(folder, "a.obj"), TRIANGLE)
        png = os.path.join(folder, "a.png")
        os.symlink("a.obj", png)
        ply = os.path.join(folder, "a.ply")
        with open(ply, "w") as file:
            file.write("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                       "property float z\nend_header\n0 0 0\n")
        before = {path: read_file(path) for path in (obj, ply)}
        for arguments in (["silhouette", obj, "--from", "3,2,1", "-o", obj], ["field", obj, "--slice", "z=0", "-o", png],
                          ["origins", obj, "-o", png], ["points", obj, "--as-points", "-o", png],
                          ["points", ply, "--export", ply]):
            assert "is the model itself" in fail(2, *arguments), arguments
        assert {path: read_file(path) for path in (obj, ply)} == before
        assert sorted(os.listdir(folder)) == ["a.obj", "a.ply", "a.png"]


def test_an_output_is_called_as_what_it_holds():
    with tempfile.TemporaryDirectory() as folder:
        obj = write_faces(os.path.join(folder, "a.obj"), TRIANGLE)
        before = read_file(obj)
        cloud = ["points", "shape:box", "--as-points"]
        for name in (obj, os.path.join(folder, "z.txt"), ""):
            for arguments in (["field", obj, "--slice", "z=0", "-o"], ["field", obj, "--at", "0,0,0", "-o"],
                              ["origins", obj, "-o"], [*cloud, "-o"]):
                assert f"-o: expected FILE.png, not '{name}'" in fail(2, *arguments, name), arguments
            assert f"--export: expected FILE.ply, not '{name}'" in fail(2, *cloud, "--export", name)
        assert "-o: expected a name that ends in .obj, .ply or .svg, not ''" in fail(
            2, "silhouette", "shape:box", "--from", "3,2,1", "-o", "")
        # Two outputs of one name, which only what is no regular file can have, or links.
        os.symlink("both.dat", os.path.join(folder, "a.png"))
        os.symlink("both.dat", os.path.join(folder, "a.ply"))
        open(os.path.join(folder, "both.dat"), "w").close()
        for drawn, exported in (("a.png", "a.ply"), ("/dev/null", "/dev/null"), ("b.ply", "b.ply")):
            fail(2, *cloud, "-o", os.path.join(folder, drawn), "--export", os.path.join(folder, exported))
        assert read_file(obj) == before and sorted(os.listdir(folder)) == ["a.obj", "a.ply", "a.png", "both.dat"]
        drawing = ["field", "shape:box", "--slice", "z=0", "--resolution", "16", "-o", "/dev/stdout"]
        with open(os.path.join(folder, "both.dat"), "wb") as file:
            assert subprocess.run([PROGRAM, *drawing], stdout=file, timeout=60).returncode == 0
        assert png_size(os.path.join(folder, "both.dat"))[1] > 16
    # A pipe has no ending; here it has no name either.
    result = subprocess.run(["sh", "-c", '"$0" field shape:box --slice z=0 --resolution 16 --json -o /dev/stderr 2>&1 >/dev/null | cat',
                             PROGRAM], stdout=subprocess.PIPE, timeout=60)
    assert result.stdout.startswith(b"\x89PNG") and result.stdout.endswith(b"IEND\xaeB`\x82"), result.stdout[:200]


def test_pictures_are_called_as_pictures():
    have_device()
    commands = [["render", "shape:box", "-o"]]
    if "not in this build" not in run("--help").stdout:
        commands.append(["view", "shape:box", "--frames", "1", "--screenshot"])
    with tempfile.TemporaryDirectory() as folder:
        obj = write_faces(os.path.join(folder, "a.obj"), TRIANGLE)
        png = os.path.join(folder, "a.png")
        os.symlink("a.obj", png)
        before = read_file(obj)
        for command in commands:
            for name in (obj, os.path.join(folder, "w.txt"), ""):
                assert f"{command[-1]}: expected FILE.png, not '{name}'" in fail(2, *command, name)
            assert "is the model itself" in fail(2, command[0], obj, *command[2:], png)
        assert read_file(obj) == before and sorted(os.listdir(folder)) == ["a.obj", "a.png"]
        assert run("render", "shape:box", "--size", "16x16", "-o", "/dev/null").returncode == 0


def test_an_interrupt_ends_the_program_by_its_signal_and_leaves_nothing():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "lines.svg")
        for number, arguments in ((signal.SIGINT, ["track", "shape:knot:20000", "--frames", "10000000", "--verify"]),
                                  (signal.SIGTERM, ["silhouette", "shape:knot:4000", "--subdivide", "5",
                                                    "--from", "3,2,1", "-o", path])):
            process = subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            time.sleep(0.5)
            process.send_signal(number)
            out, err = process.communicate(timeout=300)
            assert process.returncode == -number, (process.returncode, err)
            assert out == "" and err == "rimline: error: cancelled\n", (out, err)
            assert os.listdir(folder) == []

        if not has_methods():
            return
        # Seconds of work without a checkpoint, which a second signal ends.
        process = subprocess.Popen([PROGRAM, "silhouette", "shape:knot:4000", "--subdivide", "5", "--method",
                                    "literal", "--from", "3,2,1", "-o", path], stdout=subprocess.DEVNULL)
        time.sleep(2.5)
        assert len(os.listdir(folder)) == 1
        process.send_signal(signal.SIGINT)
        time.sleep(0.2)
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=300) in (-signal.SIGINT, -signal.SIGTERM)
        assert os.listdir(folder) == []


def test_an_interrupt_ends_the_program_where_nothing_asks_for_it():
    with tempfile.TemporaryDirectory() as folder:
        pipe = os.path.join(folder, "pipe.svg")
        os.mkfifo(pipe)  # Opening it waits for a reader, and there is none.
        for signals in ((signal.SIGTERM,), (signal.SIGINT, signal.SIGTERM)):
            process = subprocess.Popen([PROGRAM, "silhouette", "shape:box", "--from", "3,2,1", "-o", pipe],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            time.sleep(0.5)
            for number in signals:
                process.send_signal(number)
                time.sleep(0.2)
            start = time.monotonic()
            try:
                _, err = process.communicate(timeout=60)
            finally:
                process.kill()  # Else one that hangs would outlive its test.
            assert process.returncode == -signals[-1], (process.returncode, err)
            assert err == ("rimline: error: cancelled\n" if len(signals) == 1 else ""), err
            # The second signal ends it at once; without one it had its seconds of grace.
            assert len(signals) == 1 or time.monotonic() - start < 4


def test_track_verifies_every_path():
    with tempfile.TemporaryDirectory() as folder:
        points = os.path.join(folder, "points.txt")
        with open(points, "w") as file:
            file.write("# there and back\n3 2 1\n3 2 1.01\n0 0 -1 0\n3 2 1 1\n0 0 0\n")
        for shape in ("sphere:2000", "knot:2000", "terrain:2000", "scene"):
            arguments = ["track", "shape:" + shape, "--verify"]
            orbit = succeed(*arguments, "--step", "0.5", "--frames", "40")
            check_track(orbit, 40)
            random = succeed(*arguments, "--path", "random", "--seed", "5", "--frames", "200")
            check_track(random, 200)
            listed = succeed(*arguments, "--path", points)
            check_track(listed, 5)
            check_track(succeed(*arguments, "--path", points, "--frames", "2"), 2)
            assert orbit["verified"] is random["verified"] is listed["verified"] is True
            # Back at a point, the silhouette is what it was there.
            assert listed["frames"][3]["silhouette"] == listed["frames"][0]["silhouette"]
    assert succeed("track", "shape:box")["verified"] is False
    check_track(succeed("track", "shape:box"), 360)


def test_track_shows_the_silhouettes_that_silhouette_finds():
    shape = "shape:torus:2000"
    found = succeed("info", shape)
    track = succeed("track", shape, "--frames", "8", "--up", "0,0,1", "--radius", "3")
    for i, frame in enumerate(track["frames"]):
        angle = 2 * math.pi * i / 8
        offsets = (math.cos(angle), math.sin(angle), 0)
        point = [c + 3 * found["radius"] * o for c, o in zip(found["center"], offsets)]
        view = ",".join(f"{x:.17g}" for x in point)
        silhouette = succeed("silhouette", shape, "--from", view, "--no-edges")
        # The last bit of a coordinate may differ between two ways to write the same circle.
        assert abs(silhouette["count"] - frame["silhouette"]) <= 2


BENCH_FEW = ("--rounds", "1", "--viewpoints", "10", "--frames", "10")


def test_a_build_without_the_other_methods_says_so():
    view = ["silhouette", "shape:knot:2000", "--from", "4,1,2"]
    octree, brute = (succeed(*view, "--method", name) for name in ("octree", "brute-scalar"))
    assert octree["edges"] == brute["edges"] != []
    if has_methods():
        print("SKIPPED: this rimline has the other silhouette methods")
        sys.exit(77)
    why = ": this rimline was built without the other silhouette methods; configure it with -DRIMLINE_METHODS=ON"
    assert "silhouette --method literal" + why in fail(1, *view, "--method", "literal")
    assert "origins --literal" + why in fail(1, "origins", "shape:box", "--literal")
    assert "bench hough" + why in fail(1, "bench", "hough", "shape:box", "--check")
    assert succeed("bench", "fields", "shape:knot:2000", "--rounds", "1")["machine"]["packed"] is None


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
    assert result["machine"]["cpu"] and result["machine"]["packed"] and result["machine"]["tree"]
    assert [(c["case"], c["model"]) for c in result["cases"]] == [
        (case, shape) for shape in shapes for case in ("extraction", "update", "worst")]
    baselines = {"extraction": ["octree", "packed", "scalar", "plain loop"],
                 "update": ["tracker", "packed tracker", "packed", "packed, bits only", "scalar"],
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
        assert "ceiling" not in model and "targets" not in result  # Known for two models; not asked for.
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


def test_bench_runs_the_service():
    result = succeed("bench", "service", "shape:knot:2000", "shape:sphere:500", "--trackers", "4", "--frames", "20",
                     "--fps", "200", "--workers", "1")["service"]
    assert result["verified"] is True and result["workers"] == 1 and result["lost"] == 0
    assert result["posts"] == 80 and 0 < result["moves"] <= 80


def test_bench_refuses_options_without_an_effect():
    have_methods()
    suite, service = ["bench", "hough", "shape:box"], ["bench", "service", "shape:box"]
    assert "not expected: --growth" in fail(2, *service, "--growth")
    assert "not expected: --fps" in fail(2, *suite, "--fps", "30")
    assert "--least-faces: belongs to --growth" in fail(2, *suite, "--least-faces", "10")
    assert "--check: not together with" in fail(2, *suite, "--methods", "--check")
    assert "--methods: not together with --growth" in fail(2, *suite, "--methods", "--growth")
    assert "has no size from 5 to 6 faces" in fail(
        2, "bench", "hough", "shape:knot", "--growth", "--least-faces", "5", "--most-faces", "6")


ONE_FACE = "OFF\n3 1 0\n-1 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"


def test_field_tells_what_one_plane_votes():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "plane.off")
        with open(path, "w", encoding="utf-8") as file:
            file.write(ONE_FACE)
        found = succeed("field", path, "--function", "origins", "--at", "0,0,0")
        assert found["planes"] == 1 and abs(found["values"][0]) < 1e-5
        peak = 0.86 * found["radius"]
        found = succeed("field", path, "--function", "origins", "--at", f"0,0,{peak}",
                        "--at", f"5,0,{-peak}", "--at", f"0,0,{2 * peak}")
        assert [round(v, 4) for v in found["values"]] == [1, 1, 0]
        found = succeed("field", path, "--function", "origins", "--discount", f"0,0,{peak}",
                        "--at", f"0,0,{peak}")
        assert found["values"][0] < 1e-4


def test_field_draws_slices_whole_or_not_at_all():
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "slice.png")
        found = succeed("field", "shape:knot:2000", "--function", "views", "--slice", "z=0.1", "-o",
                        output, "--resolution", "64")
        assert found["values"] == [] and found["slice"]["least"] < found["slice"]["greatest"]
        width, height = png_size(output)
        assert width > height > 64
        os.remove(output)
        line = fail(1, "field", "shape:knot:2000", "--slice", "z=7", "-o", output)
        assert "does not meet" in line
        assert os.listdir(folder) == []
    for arguments in (["--slice", "w=1", "-o", "a.png"], ["--slice", "z=", "-o", "a.png"],
                      ["--slice", "z=0"], ["-o", "a.png"], [], ["--function", "nothing"]):
        fail(2, "field", "shape:box", *arguments)


def test_origins_are_given_or_chosen():
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "groups.png")
        found = succeed("origins", "shape:knot:4000", "-k", "3", "-o", output)
        assert png_size(output) == (1400, 700)
    assert len(found["origins"]) == 3 and all(map(is_vector, found["origins"]))
    assert sum(found["groups"]) == 4000 or sum(found["groups"]) > 3000
    assert is_count(found["sfo_edges"]) and found["box_checks"] > 0 and found["ms"] > 0
    chosen = succeed("origins", "shape:torus:4000", "--most", "2", "--viewpoints", "60")
    assert [t["origins"] for t in chosen["trials"]] == [0, 1, 2]
    assert chosen["work"] == min(t["work"] for t in chosen["trials"])
    fail(2, "origins", "shape:box", "-k", "2", "--most", "3")
    fail(2, "origins", "shape:box", "-k", "0")


def test_bench_fields_checks_and_then_measures():
    found = succeed("bench", "fields", "shape:knot:20000", "--rounds", "1", "--check")
    result = found["fields"][0]
    assert all(row["error"] <= row["bound"] for row in result["lattice"])
    assert result["brute_ms"] > 0 and found["targets"][0]["value"] > 0
    fail(2, "bench", "fields", "--growth")


def have_device():
    """Leaves the case as skipped where the program was built without the engine or finds no device."""
    found = run("devices")
    if found.returncode != 0:
        # Whatever else ends the program is no reason to skip.
        assert found.returncode == 1 and found.stderr.count("\n") == 1, found.stderr
        assert "without the engine" in found.stderr or "Vulkan" in found.stderr, found.stderr
        print("SKIPPED: " + found.stderr.strip())
        sys.exit(77)


def png_size(path):
    with open(path, "rb") as file:
        header = file.read(24)
    assert header[:8] == b"\x89PNG\r\n\x1a\n", header
    return tuple(int.from_bytes(header[i:i + 4], "big") for i in (16, 20))


def check_render(result, output, size):
    assert all(is_count(result[k]) for k in ("silhouette", "shadow_edges", "bytes_streamed", "bytes_full", "bytes_uploaded",
                                                "stream_memory_bytes", "tracker_memory_bytes"))
    assert result["frame_ms"] > 0 and result["device"] and result["driver"]
    assert result["output"] == output and png_size(output) == size


def test_devices_tells_why_each_was_or_was_not_chosen():
    have_device()
    devices = succeed("devices")["devices"]
    assert [d["chosen"] for d in devices].count(True) == 1
    for device in devices:
        assert device["name"] in device["reason"] and isinstance(device["lacks"], list)
    line = fail(1, "devices", "--device", "no such device")
    assert "'no such device'" in line and devices[0]["name"] in line


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
    assert len(shapes["targets"]) == 4 and all(t["reached"] for t in shapes["targets"])
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


def test_bench_engine_compares_and_then_measures():
    have_device()
    few = ("--frames", "2", "--rounds", "1", "--viewpoints", "4")
    result = succeed("bench", "engine", "shape:knot:2000", *few)
    assert result["device"]["name"] and result["viewpoints"] == 4
    [model] = result["models"]
    assert model["verified"] is True and model["closed"] is True
    assert all(0 < b["streamed"] <= b["full"] for b in model["bytes"]), model["bytes"]
    for table in ("lines", "visible_ratios"):
        assert len(model[table]) >= 2 and model[table][0]["ratio"] == 1
        assert all(way["median_ms"] > 0 for way in model[table])
    growth = succeed("bench", "engine", "--growth", *few[:2], "--least-faces", "1000", "--most-faces", "3000")
    assert [step["verified"] for step in growth["growth"]] == [True, True]
    assert all(0 < step["move_ms"] <= step["stream_ms"] for step in growth["growth"])
    assert "not expected: --device" in fail(2, "bench", "service", "--device", "cpu")
    assert "not expected: --methods" in fail(2, "bench", "engine", "--methods")
    assert "no size from 5 to 6 faces" in fail(
        1, "bench", "engine", "--growth", "--least-faces", "5", "--most-faces", "6")
    assert run("bench", "engine", "no such file.ply").stdout == ""


def test_bench_views_sets_votes_beside_other_measures():
    have_device()
    result = succeed("bench", "views", "shape:knot:1500")["models"][0]
    names = [row["name"] for row in result["views"]]
    assert len(names) == len(set(names)) == 8 and names[0].startswith("planes' votes")
    for row in result["views"]:
        assert 0.3 < row["seen"] <= 1 and 0 < row["least_apart_deg"] <= row["mean_apart_deg"] <= row["most_apart_deg"]
    # What can be had is not had by fewer.
    greedy = next(row for row in result["views"] if "greedy" in row["name"])
    assert greedy["seen"] >= max(row["seen"] for row in result["views"]) - 0.05
    for row in result["lights"]:
        assert 0 <= row["away"] <= row["unlit"] <= 1 and row["contrast"] > 0
    assert 4 <= result["renders"] <= result["candidates"] <= result["lattice_candidates"]
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "pictures")
        succeed("bench", "views", "shape:knot:1500", "--pictures", output)
        assert len(os.listdir(output)) == 5
    assert "not expected: --pictures" in fail(2, "bench", "fields", "--pictures", "a")
    assert "--up: belongs to --pictures" in fail(2, "bench", "views", "--up", "0,0,1")
    assert "not expected: --rounds" in fail(2, "bench", "views", "--rounds", "3")
    assert "--pictures: expected a folder" in fail(2, "bench", "views", "--pictures", "")


def test_bench_takes_models_of_hardly_any_faces_and_refuses_what_is_one_point():
    have_device()
    few = ("--frames", "2", "--rounds", "1", "--viewpoints", "4")
    with tempfile.TemporaryDirectory() as folder:
        point = write_faces(os.path.join(folder, "point.obj"), ((1, 2, 3),) * 3)
        for suite in (["views"], ["views", "--pictures", os.path.join(folder, "p")], ["engine", *few]):
            assert point + ": its radius is 0" in fail(1, "bench", *suite, point)
        assert os.listdir(folder) == ["point.obj"]
        one = write_faces(os.path.join(folder, "one.obj"), TRIANGLE)
        # Without any plane, along the axis that models are bent around.
        line = write_faces(os.path.join(folder, "line.obj"), ((0, 0, 0), (0, 1, 0), (0, 2, 0)))
        for path in (one, line):
            views = succeed("bench", "views", path)["models"][0]["views"]
            # No quarter of one face is left to be seen.
            assert all(row["simplified_deg"] is None for row in views)
            assert [row["noisy_deg"] is None for row in views] == 6 * [False] + 2 * [True]
            assert run("bench", "views", path).returncode == 0
            assert succeed("bench", "engine", path, *few)["models"][0]["verified"] is True
        succeed("bench", "views", line, "--pictures", os.path.join(folder, "p"))


def test_render_without_a_model_draws_the_built_in_scene():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        result = run("render", "--size", "160x120", cwd=folder)
        assert result.returncode == 0, result.stderr
        assert png_size(os.path.join(folder, "rimline.png")) == (160, 120)
        assert os.listdir(folder) == ["rimline.png"]


def test_render_draws_every_style_camera_and_light():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "a.png")
        for options in ([], ["--style", "toon", "--ground"], ["--style", "mask", "--lines", "off"],
                        ["--style", "blueprint", "--crease", "25"], ["--style", "hatch", "--ground"],
                        ["--ortho", "3", "--hidden"], ["--eye", "3,2,4", "--target", "0,0.2,0", "--fov", "60"],
                        ["--light", "2,3,2", "--light=-2,3,1", "--sun", "0,1,0"], ["--shadows", "off"],
                        ["--up", "0,0,1"], ["--background", "#102030", "--line-width", "5"],
                        # Looking straight down, a light in the model's middle, a light at the camera.
                        ["--eye", "0,5,0"], ["--light", "0,0,0"], ["--eye", "3,2,4", "--light", "3,2,4"]):
            result = succeed("render", "shape:knot:2000", "-o", output, "--size", "96x64", *options)
            check_render(result, output, (96, 64))
            assert result["validation_messages"] is None
            assert (result["shadow_edges"] == 0) == ("--shadows" in options)


def test_render_casts_the_same_shadows_by_every_method():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        pictures = []
        for method in ("fail", "pass", "auto"):
            output = os.path.join(folder, method + ".png")
            result = succeed("render", "shape:knot:2000", "-o", output, "--size", "96x64", "--ground",
                             "--eye", "3,2.5,4", "--sun", "1,2,1", "--shadows", method)
            [shadow] = result["shadows"]
            assert shadow["instance"] == 0 and shadow["light"] == 0
            assert shadow["method"] == ("fail" if method == "fail" else "pass")
            assert shadow["form"] == "single"
            assert shadow["method_reason"] and shadow["form_reason"]
            with open(output, "rb") as file:
                pictures.append(file.read())
        assert pictures[0] == pictures[1] == pictures[2]
        # Where depth pass is not shown to be right it is not taken, whatever is asked for.
        result = succeed("render", "shape:terrain:500", "-o", output, "--size", "64x64", "--shadows", "pass",
                         "--light", "0,0.2,0", "--eye", "0.1,0.05,0.1")
        assert [(s["method"], s["form"]) for s in result["shadows"]] == [("fail", "general")]


def test_render_is_silent_under_validation():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "a.png")
        result = run("render", "shape:terrain:500", "-o", output, "--size", "64x64", "--ground", "--json",
                     "--validate")
        if result.returncode == 1 and "vulkan-validationlayers" in result.stderr:
            print("SKIPPED: " + result.stderr.strip())
            sys.exit(77)
        assert result.returncode == 0, result.stderr
        assert json.loads(result.stdout)["validation_messages"] == 0


def have_window():
    have_device()
    if "not in this build" in run("--help").stdout:
        print("SKIPPED: built without the window")
        sys.exit(77)


class Display:
    """Xvfb while the block runs; `environment` shows on it."""

    def __enter__(self):
        read, write = os.pipe()
        try:
            self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-nolisten", "tcp"], pass_fds=[write],
                                           stderr=subprocess.DEVNULL)
        except FileNotFoundError:
            print("SKIPPED: no Xvfb")
            sys.exit(77)
        os.close(write)
        with os.fdopen(read) as numbers:
            number = numbers.readline().strip()
        assert number, "Xvfb did not start"
        self.environment = {k: v for k, v in os.environ.items() if k != "WAYLAND_DISPLAY"} | {"DISPLAY": ":" + number}
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()


def test_view_shows_the_picture_that_render_draws():
    have_window()
    with tempfile.TemporaryDirectory() as folder, Display() as display:
        drawn, shown = os.path.join(folder, "drawn.png"), os.path.join(folder, "shown.png")
        for options in (["shape:knot:3000", "--ground", "--light", "2,5,1"],
                        ["shape:box", "--style", "toon", "--eye", "3,2,4", "--sun", "1,2,1", "--hidden"],
                        ["shape:torus:2000", "--ortho", "3", "--line-width", "4", "--background", "#102030"]):
            options += ["--size", "200x150"]
            assert run("render", *options, "-o", drawn).returncode == 0
            result = run("view", *options, "--no-panel", "--frames", "2", "--screenshot", shown, env=display.environment)
            assert result.returncode == 0 and result.stdout == result.stderr == "", result.stderr
            with open(drawn, "rb") as a, open(shown, "rb") as b:
                assert a.read() == b.read(), options
        result = run("view", "shape:box", "--frames", "3", "--inspect", "--silhouette-from", "2,1,0", "--size", "640x480",
                     "--screenshot", shown, env=display.environment)
        assert result.returncode == 0 and png_size(shown) == (640, 480), result.stderr


def test_view_without_a_display_says_what_to_do():
    have_window()
    with tempfile.TemporaryDirectory() as folder:
        bare = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        picture = os.path.join(folder, "a.png")
        result = run("view", "shape:box", "--frames", "1", "--screenshot", picture, env=bare)
        assert result.returncode == 1 and result.stdout == ""
        assert result.stderr.startswith("rimline: error: no display: set DISPLAY") and "rimline render" in result.stderr
        assert os.listdir(folder) == []
        assert "--frames" in fail(2, "view", "shape:box", "--screenshot", picture)
        fail(2, "view", "shape:box", "--json")


def test_a_machine_without_devices_ends_with_one_line():
    with tempfile.TemporaryDirectory() as folder:
        for variable in ("VK_ICD_FILENAMES", "VK_DRIVER_FILES"):
            result = run("render", "shape:box", "-o", os.path.join(folder, "a.png"),
                         env={**os.environ, variable: "/nonexistent"})
            assert result.returncode == 1, result
            assert result.stderr.startswith("rimline: error: there is no Vulkan device: "), result.stderr
            assert result.stderr.count("\n") == 1, result.stderr
            assert os.listdir(folder) == []


def test_render_leaves_nothing_behind_when_it_fails():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "a.png")
        for options in (["gone.obj"], ["shape:box", "--device", "nowhere"],
                        ["shape:box", "--size", "16384x16384"]):
            fail(1, "render", "-o", output, *options)
            assert os.listdir(folder) == []
        fail(1, "render", "shape:box", "-o", os.path.join(folder, "gone", "a.png"))
        for options in (["--eye", "0,0,0", "--target", "0,0,0"], ["--style", "oil"], ["--ortho", "0"], ["--crease", "9"],
                        ["--size", "0x5"], ["--sun", "0,0,0"], ["--shadows", "on"]):
            fail(2, "render", "shape:box", "-o", output, *options)
            assert os.listdir(folder) == []


def check_animate(result, output, frame_count, size):
    keys = ("flips", "added", "removed", "silhouette", "box_checks", "face_checks", "edge_checks", "shadow_edges",
            "bytes_streamed", "bytes_full")
    frames, totals = result["frames"], result["totals"]
    assert len(frames) == frame_count and result["output"] == output
    for frame in frames:
        assert all(is_count(frame[k]) for k in keys) and frame["us"] >= 0 and frame["frame_ms"] > 0
    for key in keys:
        assert totals[key] == sum(frame[key] for frame in frames), key
    assert totals["max_frame_ms"] == max(frame["frame_ms"] for frame in frames)
    for before, after in zip(frames, frames[1:]):
        assert after["silhouette"] - before["silhouette"] == after["added"] - after["removed"]
    assert frames[0]["flips"] == frames[0]["added"] == frames[0]["removed"] == 0
    assert sorted(os.listdir(output)) == [f"frame_{i:04}.png" for i in range(frame_count)]
    assert all(png_size(os.path.join(output, name)) == size for name in os.listdir(output))


SMALL = ("--size", "64x48")


def test_animate_draws_every_motion():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        points = os.path.join(folder, "points.txt")
        with open(points, "w") as file:
            # Beside, a direction, the center itself, and far away.
            file.write("3 2 1\n0 1 0.2 0\n0 0 0\n0 0 1e6\n")
        for i, (options, count) in enumerate((
                (["--frames", "4", "--step", "5"], 4), (["--path", "random", "--seed", "5", "--frames", "6"], 6),
                (["--path", points, "--style", "toon"], 4), (["--path", points, "--ortho", "3", "--frames", "2"], 2),
                (["--frames", "3", "--light-step", "30", "--ground", "--light", "2,3,1"], 3),
                (["--frames", "3", "--light-follow", "--up", "0,0,1", "--radius", "3"], 3),
                (["--frames", "4", "--deform", "wave", "--ground", "--sun", "1,2,1"], 4),
                (["--frames", "3", "--deform", "wave", "--wave-step", "-90", "--eye", "3,2,4"], 3))):
            output = os.path.join(folder, str(i))
            result = succeed("animate", "shape:knot:1000", "-o", output, *SMALL, *options)
            check_animate(result, output, count, (64, 48))
            deforms = "--deform" in options
            assert (result["totals"]["box_checks"] == 0) == deforms
            assert (result["totals"]["bytes_streamed"] == 0) == deforms
            # Something moves in every one of them.
            assert result["totals"]["flips"] > 0 or "--light-step" in options or "--ortho" in options


def test_animate_streams_what_track_finds_and_draws_what_render_draws():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "frames")
        shape = "shape:torus:3000"
        path = ["--frames", "5", "--step", "0.5", "--radius", "3"]
        animated = succeed("animate", shape, "-o", output, *SMALL, *path)["frames"]
        tracked = succeed("track", shape, *path)["frames"]
        for key in ("flips", "added", "removed", "silhouette"):
            assert [f[key] for f in animated] == [f[key] for f in tracked], key
        found = succeed("info", shape)
        eye = [found["center"][0] + 3 * found["radius"], *found["center"][1:]]
        rendered = os.path.join(folder, "a.png")
        sun = ["--sun", "1,2,3"]
        succeed("animate", shape, "-o", output, *SMALL, *path, *sun)
        succeed("render", shape, "-o", rendered, *SMALL, *sun, "--eye", ",".join(f"{x:.17g}" for x in eye))
        with open(rendered, "rb") as one, open(os.path.join(output, "frame_0000.png"), "rb") as other:
            assert one.read() == other.read()


def test_animate_is_silent_under_validation():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "frames")
        for options in ([], ["--deform", "wave"]):
            result = run("animate", "shape:terrain:500", "-o", output, "--frames", "3", "--ground", "--json",
                         "--validate", *SMALL, *options)
            if result.returncode == 1 and "vulkan-validationlayers" in result.stderr:
                print("SKIPPED: " + result.stderr.strip())
                sys.exit(77)
            assert result.returncode == 0, result.stderr
            assert json.loads(result.stdout)["validation_messages"] == 0


def test_animate_leaves_nothing_behind_when_it_fails():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "frames")
        for options in (["gone.obj"], ["shape:box", "--device", "nowhere"], ["shape:box", "--path", "gone.txt"],
                        ["shape:box", "--size", "16384x16384"]):
            fail(1, "animate", "-o", output, *options)
            assert os.listdir(folder) == []
        assert "gone" in fail(1, "animate", "shape:box", "-o", os.path.join(folder, "gone", "frames"))
        for options in (["--step", "1", "--path", "random"], ["--eye", "3,2,1", "--step", "2"], ["--wave-step", "3"],
                        ["--light-step", "1", "--light-follow"], ["--deform", "melt"], ["--frames", "0"]):
            fail(2, "animate", "shape:box", "-o", output, *options)
            assert os.listdir(folder) == []
        with open(output, "w"):
            pass
        assert "not a folder" in fail(1, "animate", "shape:box", "-o", output)


def test_an_interrupted_animation_leaves_whole_frames():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "frames")
        process = subprocess.Popen([PROGRAM, "animate", "shape:box", "--frames", "100000", "-o", output, *SMALL],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        # Some frames must be there, whatever the machine's pace.
        deadline = time.monotonic() + 200
        while (not os.path.isdir(output) or len(os.listdir(output)) < 3) and time.monotonic() < deadline:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=300)
        assert process.returncode == -signal.SIGINT, (process.returncode, err)
        assert out == "" and err == "rimline: error: cancelled\n", (out, err)
        names = sorted(os.listdir(output))
        assert len(names) >= 2 and names == [f"frame_{i:05}.png" for i in range(len(names))]
        for name in names:
            with open(os.path.join(output, name), "rb") as file:
                assert file.read().endswith(b"IEND\xaeB`\x82"), name


def check_views(result, count, weighted):
    assert len(result["views"]) == count and result["asked"] >= count and result["ms"] >= 0
    for view in result["views"]:
        assert is_vector(view["eye"])
        distance = math.dist(view["eye"], result["center"]) / result["radius"]
        assert 3 ** 0.5 - 1e-9 <= distance <= 2 + 1e-9
        if weighted:
            assert 0 <= view["visible_ratio"] <= 1
            assert math.isclose(view["score"], view["votes"] * view["visible_ratio"])
        else:
            assert view["visible_ratio"] is None and view["score"] == view["votes"]


def write_faces(path, *faces):
    with open(path, "w") as file:
        for face in faces:
            file.writelines("v %g %g %g\n" % corner for corner in face)
        file.writelines("f -%d -%d -%d\n" % (3 * i, 3 * i - 1, 3 * i - 2) for i in range(len(faces), 0, -1))
    return path


TRIANGLE = ((0, 0, 0), (1, 0, 0), (0, 1, 0))


def test_views_by_votes_alone_need_no_device():
    result = succeed("views", "shape:knot:2000", "-k", "3", "--no-ratio")
    check_views(result, 3, False)
    assert result["renders"] == 0 and not result["inside_out"]
    scores = [view["score"] for view in result["views"]]
    assert scores == sorted(scores, reverse=True)
    text = run("views", "shape:knot:2000", "-k", "3", "--no-ratio")
    assert text.returncode == 0 and text.stdout.count("  view ") == 3, text.stdout
    assert succeed("views", "shape:knot:2000", "-k", "3", "--no-ratio", "--threads", "1")["views"] == result["views"]


def test_places_far_from_the_origin_are_printed_apart_from_each_other():
    with tempfile.TemporaryDirectory() as folder:
        far = [tuple(c + 3e6 for c in corner) for corner in TRIANGLE]
        one = os.path.join(folder, "far.obj")
        with open(one, "w") as file:
            file.writelines("v %.9g %.9g %.9g\n" % corner for corner in far)
            file.write("f 1 2 3\n")

        def shown(place):
            return ",".join("%.9g" % c for c in place)
        arguments = ["views", one, "-k", "1", "--no-ratio"]
        eye = succeed(*arguments)["views"][0]["eye"]
        assert f"from {shown(eye)}  score" in run(*arguments).stdout
        arguments = ["field", one, "--slice", "z=1", "--resolution", "16", "-o", os.path.join(folder, "a.png")]
        greatest = succeed(*arguments)["slice"]["greatest_at"]
        assert f", at {shown(greatest)}\n" in run(*arguments).stdout


def test_there_are_no_more_views_than_show_something_new():
    with tempfile.TemporaryDirectory() as folder:
        one = write_faces(os.path.join(folder, "one.obj"), TRIANGLE)
        result = succeed("views", one, "-k", "4", "--no-ratio")
        check_views(result, 1, False)
        assert result["asked"] == 4
        assert "1 of 4" in run("views", one, "-k", "4", "--no-ratio").stdout
        assert "take a model with more faces" in fail(1, "path", one, "--no-ratio")
        needle = write_faces(os.path.join(folder, "needle.obj"), ((0, 0, 0), (1, 0, 0), (2, 0, 0)))
        assert needle + ": no face has a plane" in fail(1, "views", needle, "--no-ratio")
        assert needle + ": no face turns a side" in fail(1, "light", needle, "--eye", "1,2,3")


def test_views_are_drawn_from_where_they_are_and_written_together():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "views")
        result = succeed("views", "shape:scene:3000", "-k", "3", "-o", output, *SMALL, "--ground", "--sun", "auto")
        check_views(result, 3, True)
        assert 3 <= result["renders"] <= result["candidates"] and result["output"] == output
        assert sorted(os.listdir(output)) == ["contact_sheet.png", "view_1.png", "view_2.png", "view_3.png"]
        for i in (1, 2, 3):
            assert png_size(os.path.join(output, f"view_{i}.png")) == (64, 48)
        assert png_size(os.path.join(output, "contact_sheet.png")) == (8 + 2 * 72, 8 + 2 * 56)
        assert succeed("views", "shape:scene:3000", "-k", "3")["views"] == result["views"]


def test_views_leave_nothing_behind_when_they_fail():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "views")
        for options in (["gone.obj"], ["shape:box", "--device", "nowhere"], ["shape:box", "--size", "16384x16384"]):
            fail(1, "views", "-o", output, *options)
            fail(1, "path", "--frames", "3", "-o", output, *options)
            assert os.listdir(folder) == []
        for options in (["-k", "0"], ["-k", "65"], ["--sun", "up"]):
            fail(2, "views", "shape:box", "-o", output, *options)
        fail(2, "path", "shape:box", "-k", "1")
        fail(2, "light", "shape:box")
        process = subprocess.Popen([PROGRAM, "views", "shape:knot:300000", "-k", "64", "-o", output],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(2.0)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=300)
        assert process.returncode == -signal.SIGINT, (process.returncode, err)
        assert out == "" and err == "rimline: error: cancelled\n", (out, err)
        assert os.listdir(folder) == []


def test_a_path_passes_its_views_and_keeps_its_distance():
    result = succeed("path", "shape:knot:2000", "--no-ratio", "--frames", "24")
    check_views(result, 4, False)
    assert len(result["nodes"]) == 8 and len(result["samples"]) == 24
    assert result["node_views"][::2] == [0] + sorted(result["node_views"][2::2], key=result["node_views"].index)
    assert sorted(result["node_views"][::2]) == [0, 1, 2, 3] and result["node_views"][1::2] == [None] * 4
    for node, view in zip(result["nodes"], result["node_views"]):
        assert view is None or node == result["views"][view]["eye"]
    assert result["samples"][0] == result["nodes"][0]
    for sample, up in zip(result["samples"], result["ups"]):
        back = [s - c for s, c in zip(sample, result["center"])]
        assert abs(math.dist(up, (0, 0, 0)) - 1) < 1e-9 and abs(sum(u * b for u, b in zip(up, back))) < 1e-9
    assert result["min_distance"] >= (3 ** 0.5 - 1e-9) * result["radius"]
    steps = [math.dist(a, b) for a, b in zip(result["samples"], result["samples"][1:] + result["samples"][:1])]
    assert max(steps) <= 1.01 * result["length"] / 24


def test_a_path_is_drawn_through_animate():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "path")
        result = succeed("path", "shape:spring:2000", "-k", "2", "--frames", "5", "-o", output, *SMALL, "--ground",
                         "--light-follow")
        check_views(result, 2, True)
        assert sorted(os.listdir(output)) == [f"frame_{i:04}.png" for i in range(5)]
        assert all(png_size(os.path.join(output, name)) == (64, 48) for name in os.listdir(output))


def test_light_is_where_render_puts_an_auto_sun():
    eye = ["--eye", "3,2,4"]
    light = succeed("light", "shape:knot:3000", *eye)
    assert math.isclose(math.hypot(*light["sun"]), 1.0)
    assert 0 < light["score"] <= light["faces"] < 3000 and not light["sees_backs"]
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        pictures = []
        for sun in ("auto", ",".join(repr(x) for x in light["sun"]), "0,1,0"):
            output = os.path.join(folder, "a.png")
            succeed("render", "shape:knot:3000", *eye, "--sun", sun, "-o", output, *SMALL)
            with open(output, "rb") as file:
                pictures.append(file.read())
        assert pictures[0] == pictures[1] != pictures[2]


def test_the_bunny_is_counted_and_verified():
    bunny = model("stanford-bunny.obj")
    found = succeed("info", bunny)
    assert (found["vertices"], found["file_vertices"], found["faces"]) == (34834, 35947, 69451)
    assert found["border_edges"] == 223 and found["closed"] is False
    view = ["silhouette", bunny, "--from", "0.3,0.4,0.5"]
    octree, brute = succeed(*view), succeed(*view, "--method", "brute-scalar")
    check_silhouette(octree)
    assert octree["edges"] == brute["edges"]
    track = succeed("track", bunny, "--step", "0.5", "--frames", "30", "--verify")
    check_track(track, 30)
    assert track["verified"] is True


def test_igea_is_counted_and_verified():
    igea = model("igea.ply")
    found = succeed("info", igea)
    assert (found["vertices"], found["faces"], found["closed"]) == (134345, 268686, True)
    track = succeed("track", igea, "--path", "random", "--frames", "60", "--verify")
    check_track(track, 60)
    assert track["verified"] is True


def check_points(found):
    count, numbers = found["points"], found["numbers"]
    assert len(numbers) == len(found["features"]) == count
    assert numbers == sorted(set(numbers)) and (count == 0 or numbers[-1] < found["file_points"])
    left_out = found["duplicates"] + found["dropped"] + found["unused"]
    assert count + left_out == found["file_points"]
    assert all(0.0 <= weight <= 1.0 for weight in found["features"])
    known = set(numbers)
    for name in ("border", "undecided", "silhouette"):
        assert found[name] == sorted(set(found[name])) and known.issuperset(found[name]), name
    labels = found["labels"]
    assert sum(labels.values()) == count
    assert len(found["border"]) == labels["border"] and len(found["undecided"]) == labels["undecided"]
    assert sum(found["reasons"].values()) == labels["undecided"]
    edges = found["consensus_edges"]
    assert edges == sorted(edges) and all(a < b for a, b in edges)
    on = set(found["silhouette"])
    assert all(a in on and b in on for a, b in edges)
    assert len(on) == found["silhouette_points"] and len(edges) == found["consensus_edge_count"]
    assert found["ms"] >= found["umbrellas_ms"] >= 0


def test_points_tell_borders_features_and_silhouettes_of_a_model_without_its_faces():
    found = succeed("points", "shape:terrain:8000", "--as-points", "--eye", "2,3,4")
    check_points(found)
    info = succeed("info", "shape:terrain:8000")
    assert found["points"] == info["vertices"] and found["dropped"] == found["duplicates"] == 0
    assert math.isclose(found["radius"], info["radius"]) and found["center"] == info["center"]
    truth = found["truth"]
    assert truth["border"] == info["border_edges"]
    assert truth["border"] - truth["missed"] + truth["extra"] == found["labels"]["border"]
    assert math.isclose(truth["missed_percent"], 100 * truth["missed"] / truth["border"])
    assert found["silhouette"] and found["consensus_edges"] and found["arcs"] > 0
    again = succeed("points", "shape:terrain:8000", "--as-points", "--from", "2,3,4", "--threads", "1")
    for key in ("border", "silhouette", "consensus_edges", "features", "truth"):
        assert again[key] == found[key], key
    thesis = [succeed("points", "shape:terrain:8000", "--as-points", *options)["border"] for options in
              (["--method", "thesis"], ["--omega", "30", "--omega-t", "10", "--phi", "150", "--gamma", "2"],
               ["--omega", "5"])]
    assert thesis[0] == thesis[1] != thesis[2]  # Degrees, and what is the default.
    without = succeed("points", "shape:terrain:8000", "--as-points", "--no-lists")
    assert "border" not in without and without["silhouette_points"] == 0
    closed = succeed("points", "shape:sphere:5000", "--as-points", "--direction", "1,2,3")
    check_points(closed)
    assert closed["truth"] == {"border": 0, "missed": 0, "extra": closed["labels"]["border"],
                               "missed_percent": None, "extra_percent": None}
    text = run("points", "shape:terrain:8000", "--as-points", "--eye", "2,3,4")
    assert text.returncode == 0 and "silhouette  %d points" % found["silhouette_points"] in text.stdout


def test_points_take_a_model_with_faces_only_when_told_to():
    assert "--as-points" in fail(1, "points", "shape:box")
    with tempfile.TemporaryDirectory() as d:
        obj = os.path.join(d, "a.obj")
        open(obj, "w").write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nf 1 2 3\n")
        assert "it has 1 faces" in fail(1, "points", obj)
        found = succeed("points", obj, "--as-points")
        check_points(found)
        assert found["points"] == 3 and found["unused"] == 1


def test_points_far_from_zero_equal_to_others_and_not_finite():
    with tempfile.TemporaryDirectory() as d:
        def cloud(offset):
            path = os.path.join(d, "a.xyz")
            rows = []
            for i in range(900):
                z = 1 - (2 * i + 1) / 900
                r, angle = math.sqrt(1 - z * z), i * math.pi * (3 - math.sqrt(5))
                # On a lattice on which adding the offset is exact.
                at = [round(c * 2 ** 20) / 2 ** 30 for c in (r * math.cos(angle), r * math.sin(angle), z)]
                rows.append(" ".join(repr(c + offset) for c in at))
            open(path, "w").write("\n".join(rows + [rows[7], "nan 0 0", rows[9], "0 inf 0"]) + "\n")
            return path

        def of(offset):
            return succeed("points", cloud(offset), "--drop-bad", "--eye",
                           ",".join(repr(c + offset) for c in (2 ** -9, 2 ** -10, -2 ** -9)))
        assert "a.xyz:902: point 901 is nan 0 0" in fail(1, "points", cloud(0.0))
        near, far = of(0.0), of(float(2 ** 20))
        check_points(near)
        check_points(far)
        assert near["points"] == 900 and near["duplicates"] == 2 and near["dropped"] == 2
        assert near["silhouette"] and near["silhouette"] == far["silhouette"]
        assert near["features"] == far["features"] and near["consensus_edges"] == far["consensus_edges"]


def test_points_of_hardly_any_cloud_are_undecided_with_a_reason():
    with tempfile.TemporaryDirectory() as d:
        path = os.path.join(d, "a.xyz")
        for text in ("1 2 3\n", "1 2 3\n1 2 4\n", "0 0 0\n1 1 1\n2 2 2\n3 3 3\n4 4 4\n", "1 2 3\n" * 50):
            open(path, "w").write(text)
            found = succeed("points", path, "--eye", "9,9,9")
            check_points(found)
            assert found["labels"]["undecided"] == found["points"] and found["silhouette"] == []
        open(path, "w").write("nan 1 2\n")
        assert succeed("points", path, "--drop-bad")["points"] == 0


def test_points_are_exported_with_normals_labels_and_weights():
    with tempfile.TemporaryDirectory() as d:
        path = os.path.join(d, "labels.ply")
        found = succeed("points", "shape:terrain:3000", "--as-points", "--direction", "0,1,3", "--export", path)
        assert found["export"] == path
        header, body = open(path, "rb").read().split(b"end_header\n", 1)
        record = struct.Struct("<3d3f3B2BfBI")
        assert f"element vertex {found['points']}\n".encode() in header
        rows = list(record.iter_unpack(body))
        assert len(rows) == found["points"]
        assert [row[13] for row in rows] == found["numbers"]
        assert [row[13] for row in rows if row[9] == 0] == found["border"]
        assert [row[13] for row in rows if row[12] == 1] == found["silhouette"]
        assert all(abs(row[11] - weight) < 1e-6 for row, weight in zip(rows, found["features"]))
        assert all(abs(math.hypot(*row[3:6]) - 1) < 1e-6 for row in rows if row[9] != 3)
        # What was written is a cloud again, with normals and colors.
        assert succeed("points", path)["points"] == found["points"]
        fail(1, "points", "shape:box", "--as-points", "--export", os.path.join(d, "none", "a.ply"))


def test_points_follow_a_turn_around_a_cloud():
    found = succeed("points", "shape:knot:4000", "--as-points", "--turn", "60", "--step", "2", "--verify", "--no-lists")
    turn = found["turn"]
    assert found["verified"] is True and turn["frames"] == 60 and turn["step"] == 2
    assert 0 < turn["median_us"] <= turn["p99_us"] <= turn["worst_us"]
    assert turn["changed_points"] > 0 and found["silhouette_points"] == 0
    assert "verified" not in succeed("points", "shape:box:600", "--as-points", "--turn", "3", "--no-lists")
    with tempfile.TemporaryDirectory() as d:
        path = os.path.join(d, "a.xyz")
        open(path, "w").write("1 2 3\n")
        assert succeed("points", path, "--turn", "5", "--verify")["verified"] is True


def test_points_draw_clouds():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "a.png")
        for options in ([], ["--eye", "3,2,4"], ["--eye", "3,2,4", "--target", "0,0.2,0", "--fov", "60"],
                        ["--ortho", "3"], ["--direction", "1,0,0", "--background", "#102030"], ["--up", "1,0,0"],
                        ["--from", "0,3,0", "--mode", "compare"]):
            found = succeed("points", "shape:terrain:2000", "--as-points", "-o", output, "--size", "96x64", *options)
            check_points(found)
            assert found["output"] == output and found["device"] and found["picture_ms"] > 0
            sheet = (2 * 96 + 3 * 8, 3 * 64 + 4 * 8) if "compare" in options else (96, 64)
            assert png_size(output) == sheet, options
        # The silhouette that is told is the one that is drawn: of the eye.
        told = succeed("points", "shape:knot:4000", "--as-points", "--eye", "3,2,4", "--no-lists")
        drawn = succeed("points", "shape:knot:4000", "--as-points", "--eye", "3,2,4", "--no-lists", "-o", output,
                        "--size", "96x64")
        for key in ("silhouette_points", "consensus_edge_count", "arcs"):
            assert told[key] == drawn[key] > 0
        cloud = os.path.join(folder, "a.xyz")
        open(cloud, "w").write("1 2 3\n")
        assert "nothing to draw" in fail(1, "points", cloud, "-o", output)
        fail(1, "points", cloud, "-o", os.path.join(folder, "none", "a.png"))


def test_points_draw_silently_under_validation():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "a.png")
        result = run("points", "shape:terrain:2000", "--as-points", "-o", output, "--size", "64x64", "--json",
                     "--mode", "compare", "--validate")
        if result.returncode == 1 and "vulkan-validationlayers" in result.stderr:
            print("SKIPPED: " + result.stderr.strip())
            sys.exit(77)
        assert result.returncode == 0, result.stderr
        assert json.loads(result.stdout)["validation_messages"] == 0


if __name__ == "__main__":
    globals()[sys.argv[2]]()
