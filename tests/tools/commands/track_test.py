"""rimline track."""
import json
import math
import os
import subprocess
import tempfile

from program import PROGRAM, check_track, fail, read_file, succeed


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


def test_the_axis_of_an_orbit_may_be_that_along_which_the_model_stands():
    with tempfile.TemporaryDirectory() as folder:
        pyramid = os.path.join(folder, "pyramid.obj")
        with open(pyramid, "w") as file:
            file.write("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 2\nf 1 4 3 2\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n")
        track = ["track", pyramid, "--frames", "40"]
        flips = [[frame["flips"] for frame in succeed(*track, *up)["frames"]]
                 for up in (["--up", "auto"], ["--up", "z"], ["--up", "y"], [])]
        assert flips[3] == flips[0] == flips[1] != flips[2]
        assert "x, y, z, -x, -y, -z, auto, not 'q'" in fail(2, *track, "--up", "q")
        output = os.path.join(folder, "a.png")
        pictures = []
        for up in (["--up", "auto"], ["--up", "z"], ["--up", "y"], []):
            succeed("origins", pyramid, "-k", "1", *up, "-o", output)
            pictures.append(read_file(output))
        assert pictures[3] == pictures[0] == pictures[1] != pictures[2]


def test_frames_are_not_kept_as_json():
    count = 200_000
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen([PROGRAM, "track", "shape:box", "--frames", str(count), "--step", "1", "--json"],
                                   stdout=output)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        assert process.returncode == 0
        output.seek(0)
        check_track(json.load(output), count)
    # The frames take 80 bytes each, and twenty times as much as JSON.
    assert usage.ru_maxrss < 100_000, usage.ru_maxrss
