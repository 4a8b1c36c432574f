"""rimline animate."""
import json
import math
import os
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import zlib

from program import (LIT_PICTURE, PROGRAM, SMALL, fail, fail_for_memory, have_device, is_count, lit_share, png_rows, png_size,
                     read_file, run, skip, succeed)


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
    # By the clock: frames follow each other, and do not count what others took.
    times = result["times_ms"]
    assert sum(frame["frame_ms"] for frame in frames) <= times["drawing"] <= times["total"], times
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
                (["--frames", "4", "--step", "5"], 4), (["--path", points, "--target", "0.2,0,0", "--frames", "3"], 3),
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


def test_no_frame_of_an_animation_is_dark_and_the_sun_turns_slowly():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "frames")
        for command in (["animate"], ["path", "--no-ratio"]):
            for model in ("shape:knot", "shape:scene:4000", "shape:terrain"):
                result = succeed(command[0], model, *command[1:], "-o", output, *LIT_PICTURE, "--frames", "16")
                shares = [lit_share(os.path.join(output, name)) for name in sorted(os.listdir(output))]
                assert len(shares) == 16 and min(shares) > 1 / 3, (command, model, shares)
                suns = result["suns"]
                assert len(suns) == 16 and all(math.isclose(math.hypot(*sun), 1, rel_tol=1e-6) for sun in suns)
                if command == ["animate"]:
                    turns = [math.degrees(math.acos(min(1, sum(a * b for a, b in zip(sun, after)))))
                             for sun, after in zip(suns, suns[1:] + suns[:1])]
                    assert 0 < max(turns) < 2 * 360 / 16, (model, turns)
        # A sun that is given stays.
        assert succeed("animate", "shape:knot:1000", "-o", output, *SMALL, "--frames", "2", "--sun", "1,2,3")["suns"] is None


def test_animate_with_a_ground_keeps_its_size_and_holds_all_shadows():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "frames")
        picture = ("--style", "toon", "--color", "white", "--lines", "off", "--background", "#00ff00", "--size", "160x120")
        for command in (["animate"], ["path", "--no-ratio"]):
            succeed(command[0], "shape:spring:4000", *command[1:], "-o", output, *picture, "--ground", "--frames", "12")
            shadows = 0
            for name in sorted(os.listdir(output)):
                rows = png_rows(os.path.join(output, name))
                border = rows[0] + rows[-1] + [row[0] for row in rows] + [row[-1] for row in rows]
                # Shadow on the green ground is a darker green.
                assert all(pixel[1] > 240 for pixel in border), (command, name)
                shadows += any(pixel[0] < 40 and pixel[1] < 200 for row in rows for pixel in row)
            # A path may look from under the ground, which is not drawn then.
            assert shadows == 12 or command[0] == "path" and shadows > 6, (command, shadows)


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


def test_frames_are_drawn_as_still_pictures():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        frames, still = os.path.join(folder, "frames"), os.path.join(folder, "still.png")
        views = ((3, 2, 4), (-4, 1, 2))
        path = os.path.join(folder, "path.txt")
        with open(path, "w") as file:
            file.writelines("%d %d %d\n" % view for view in views)
        # Its parts pass through each other, and noise makes short lines.
        for model, options in (("shape:scene", ["--style", "blueprint", "--hidden"]), ("shape:terrain:3000", []),
                               ("shape:knot:3000", ["--style", "hatch"]), ("shape:scene", ["--min-length", "40"]),
                               ("shape:scene", ["--intersections", "off"])):
            look = ["--sun", "1,1,1", "--target", "0,0,0", "--fov", "35", *SMALL, *options]
            counted = succeed("animate", model, "--path", path, "-o", frames, *look)["frames"]
            for number, view in enumerate(views):
                drawn = succeed("render", model, "--eye", "%d,%d,%d" % view, "-o", still, *look)
                assert read_file(os.path.join(frames, f"frame_{number:04}.png")) == read_file(still), (model, options)
                # With borders, which never change.
                assert counted[number]["silhouette"] <= drawn["silhouette"] and counted[number]["silhouette"] > 0
            assert counted[0]["flips"] == 0 < counted[1]["flips"]
            by_depth = succeed("animate", model, "--path", path, "--line-visibility", "depth", "-o", frames,
                               *look[:-len(options) or None])["frames"]
            for key in ("flips", "added", "removed", "silhouette"):
                assert [frame[key] for frame in counted] == [frame[key] for frame in by_depth], (model, key)
        assert "--line-visibility exact" in fail(2, "animate", "shape:box", "--line-visibility", "depth", "--min-length", "3")
        assert "deforms" in fail(2, "animate", "shape:box", "--deform", "wave", "--intersections", "off")


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
        for options in (["--step", "1", "--path", "a.txt"], ["--eye", "3,2,1", "--step", "2"], ["--wave-step", "3"],
                        ["--eye", "front", "--path", "a.txt"], ["--azimuth", "9", "--path", "a.txt"],
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


def apng_frames(data, folder):
    """The frames of an animated PNG, each as rows of pixels. Checks the chunks."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, chunks = 8, []
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        assert struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0] == zlib.crc32(kind + body)
        chunks.append((kind, body))
        at += 12 + size
    kinds = [kind for kind, _ in chunks]
    assert kinds[0] == b"IHDR" and kinds[-1] == b"IEND" and kinds.index(b"acTL") < kinds.index(b"IDAT")
    count, plays = struct.unpack(">II", dict(chunks)[b"acTL"])
    assert count == kinds.count(b"fcTL") and plays == 0
    frames, sequence = [], 0
    for kind, body in chunks:
        if kind in (b"fcTL", b"fdAT"):
            assert struct.unpack(">I", body[:4])[0] == sequence
            sequence += 1
        if kind == b"fcTL":
            frames.append((struct.unpack(">IIIIHHBB", body[4:]), []))
        elif kind in (b"IDAT", b"fdAT"):
            frames[-1][1].append(body if kind == b"IDAT" else body[4:])
    header, pictures, canvas = chunks[0][1], [], None
    for (width, height, left, top, num, den, dispose, blend), data in frames:
        assert (num, den, dispose, blend) == (1, 25, 0, 0)
        path = os.path.join(folder, "part.png")
        with open(path, "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n")
            for kind, body in ((b"IHDR", struct.pack(">II", width, height) + header[8:]), (b"IDAT", b"".join(data)), (b"IEND", b"")):
                file.write(struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)))
        part = png_rows(path)
        if canvas is None:
            canvas = [list(row) for row in part]
        for y, row in enumerate(part):
            canvas[top + y][left:left + width] = row
        pictures.append([tuple(row) for row in canvas])
    return pictures


def test_an_animated_png_has_the_frames_of_the_folder():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        points = os.path.join(folder, "points.txt")
        with open(points, "w") as file:
            file.write("3 2 1\n3 2 1.2\n3 2 1.2\n3 1 1.4\n")  # The second stands still.
        for more in ([], ["--background", "none"]):
            options = ["shape:knot:1000", *SMALL, "--path", points, "--style", "toon", *more]
            frames, film = os.path.join(folder, "frames"), os.path.join(folder, "a.apng")
            succeed("animate", *options, "-o", frames)
            assert succeed("animate", *options, "-o", film, "--fps", "25")["output"] == film
            with open(film, "rb") as file:
                data = file.read()
            shown = apng_frames(data, folder)
            assert len(shown) == 4
            for i, picture in enumerate(shown):
                drawn = png_rows(os.path.join(frames, f"frame_{i:04}.png"))
                assert picture == [tuple(row) for row in drawn], i
            os.remove(film)


def test_films_are_made_by_ffmpeg():
    have_device()
    if shutil.which("ffmpeg") is None or shutil.which("ffprobe") is None:
        skip("ffmpeg is not installed")
    encoders = subprocess.run(["ffmpeg", "-hide_banner", "-encoders"], capture_output=True, text=True, timeout=60).stdout
    with tempfile.TemporaryDirectory() as folder:
        for ending, codec, encoder in (("mp4", "h264", "libx264"), ("webm", "vp9", "libvpx-vp9"), ("gif", "gif", " gif ")):
            if encoder not in encoders:
                continue
            film = os.path.join(folder, "a." + ending)
            succeed("animate", "shape:knot:1000", "--frames", "5", "--size", "65x48", "-o", film, "--fps", "20")
            found = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                    "stream=codec_name,width,height,nb_read_frames", "-of", "csv=p=0", film],
                                   capture_output=True, text=True, timeout=60).stdout.strip().split(",")
            assert found == [codec, "65" if ending == "gif" else "64", "48", "5"], found
        assert sorted(name[:2] for name in os.listdir(folder)) == ["a."] * len(os.listdir(folder))
        # A failure leaves nothing, and says what ffmpeg said.
        os.mkdir(os.path.join(folder, "bin"))
        fake = os.path.join(folder, "bin", "ffmpeg")
        with open(fake, "w") as file:
            file.write("#!/bin/sh\necho no such encoder >&2\nexit 1\n")
        os.chmod(fake, 0o755)
        film = os.path.join(folder, "b.mp4")
        result = run("animate", "shape:box", "--frames", "3", *SMALL, "-o", film,
                     env={**os.environ, "PATH": os.path.join(folder, "bin") + ":/usr/bin:/bin"})
        assert result.returncode == 1 and film + ": ffmpeg failed: no such encoder" in result.stderr, result
        assert not [name for name in os.listdir(folder) if "b.mp4" in name]


def test_a_film_that_cannot_be_made_is_refused_before_the_work():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        film = os.path.join(folder, "a.mp4")
        result = run("animate", "shape:box", "-o", film, env={**os.environ, "PATH": folder})
        assert result.returncode == 1 and "install the package ffmpeg, or write an .apng" in result.stderr, result
        for name in ("a.png", "a.MOV", "-"):
            line = fail(2, "animate", "shape:box", "-o", os.path.join(folder, name) if name != "-" else name)
            assert "expected a folder, or a name that ends in .apng, .mp4, .gif or .webm" in line
        assert "an .mp4 is opaque" in fail(2, "animate", "shape:box", "-o", film, "--background", "none")
        assert "gone" in fail(1, "animate", "shape:box", "-o", os.path.join(folder, "gone", "a.apng"))
        fail(1, "animate", "gone.obj", "-o", os.path.join(folder, "a.apng"))
        assert os.listdir(folder) == []


def test_animations_refuse_what_has_no_effect_or_no_view():
    with tempfile.TemporaryDirectory() as folder:
        box = ("shape:box:12", "-o", os.path.join(folder, "a"), "--frames", "2")
        for command in ("animate", "path"):
            assert "--fps: belongs to a film" in fail(2, command, *box, "--fps", "3")
            assert "-o: expected a folder" in fail(2, command, *box[:1], "--frames", "2", "-o", "a.mov", "--fps", "3")
        assert "--radius: the camera looks at the center" in fail(2, "animate", *box, "--radius", "0")
        assert "not 'orbt'; did you mean 'orbit'?" in fail(2, "animate", *box, "--path", "orbt")
        assert "absent.txt: cannot open it" in fail(1, "animate", *box, "--path", os.path.join(folder, "absent.txt"))
        assert os.listdir(folder) == []


def test_animations_have_no_random_path():
    with tempfile.TemporaryDirectory() as folder:
        box = ("shape:box:12", "-o", os.path.join(folder, "a"), "--frames", "2")
        expected = "--path: expected orbit or a file of points, not 'random', which only track has"
        assert expected in fail(2, "animate", *box, "--path", "random")
        assert "expected orbit or a file of points, not ''" in fail(2, "animate", *box, "--path", "")
        assert "expected orbit, random or a file of points, not 'randm'" in fail(2, "track", "shape:box", "--path", "randm")
        assert os.listdir(folder) == []
    assert "random path" not in run("animate", "--help").stdout and "orbit, or a file" in run("animate", "--help").stdout
    assert "orbit, random, or a file" in run("track", "--help").stdout


def test_one_frame_is_counted_in_the_singular():
    assert run("track", "shape:box", "--frames", "1").stdout.startswith("1 frame\n")
    assert run("track", "shape:box", "--frames", "2").stdout.startswith("2 frames\n")
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "a")
        text = run("animate", "shape:box", "--frames", "1", "-o", output, *SMALL).stdout
        assert text.startswith(output + ": 1 frame\n"), text


def test_frames_of_an_older_run_are_not_left_among_new_ones():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "frames")
        succeed("animate", "shape:box", "--frames", "5", *SMALL, "-o", output)
        with open(os.path.join(output, "notes.txt"), "w"):
            pass
        own = os.path.join(output, "frame_12.png")  # Frames have four digits.
        open(own, "w").close()
        # Nothing is lost before there is a new frame.
        fail(1, "animate", "gone.obj", "-o", output)
        assert len(os.listdir(output)) == 7
        succeed("animate", "shape:box", "--frames", "2", *SMALL, "-o", output)
        os.remove(own)
        assert sorted(os.listdir(output)) == ["frame_0000.png", "frame_0001.png", "notes.txt"]
        succeed("views", "shape:knot:2000", "-k", "3", *SMALL, "-o", output)
        succeed("views", "shape:knot:2000", "-k", "2", *SMALL, "-o", output)
        assert sorted(os.listdir(output)) == ["contact_sheet.png", "frame_0000.png", "frame_0001.png", "notes.txt", "view_1.png",
                                              "view_2.png"]
