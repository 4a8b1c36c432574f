"""rimline animate."""
import json
import os
import signal
import subprocess
import tempfile
import time

from program import PROGRAM, SMALL, fail, fail_for_memory, have_device, is_count, png_rows, png_size, run, skip, succeed


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
        animated = succeed("animate", shape, "-o", output, *SMALL, *path, "--azimuth", "90")["frames"]
        tracked = succeed("track", shape, *path)["frames"]  # Its orbit starts at the right.
        for key in ("flips", "added", "removed", "silhouette"):
            assert [f[key] for f in animated] == [f[key] for f in tracked], key
        found = succeed("info", shape)
        eye = [found["center"][0] + 3 * found["radius"], *found["center"][1:]]
        rendered = os.path.join(folder, "a.png")
        # Surfaces alone: lines of render have exact visibility, and those of animate are compared with depths.
        sun = ["--sun", "1,2,3", "--lines", "off"]
        succeed("animate", shape, "-o", output, *SMALL, *path, *sun, "--azimuth", "90")
        succeed("render", shape, "-o", rendered, *SMALL, *sun, "--fov", "35", "--eye", ",".join(f"{x:.17g}" for x in eye))
        one, other = (sum(png_rows(path), []) for path in (rendered, os.path.join(output, "frame_0000.png")))
        # animate leaves out the backs of solids, of which single pixels may show at silhouettes.
        assert len(one) == len(other) and sum(a != b for a, b in zip(one, other)) < len(one) // 100


def test_animate_is_silent_under_validation():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "frames")
        for options in ([], ["--deform", "wave"]):
            result = run("animate", "shape:terrain:500", "-o", output, "--frames", "3", "--ground", "--json",
                         "--validate", *SMALL, *options)
            if result.returncode == 1 and "vulkan-validationlayers" in result.stderr:
                skip(result.stderr.strip())
            assert result.returncode == 0, result.stderr
            assert json.loads(result.stdout)["validation_messages"] == 0


def test_animate_leaves_nothing_behind_when_it_fails():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "frames")
        for options in (["gone.obj"], ["shape:box", "--device", "nowhere"], ["shape:box", "--path", "gone.txt"]):
            fail(1, "animate", "-o", output, *options)
            assert os.listdir(folder) == []
        fail_for_memory("animate", "shape:box", "-o", output)
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
