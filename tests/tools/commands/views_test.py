"""rimline views."""
import math
import os
import signal
import subprocess
import tempfile
import time

from program import (PROGRAM, SMALL, TRIANGLE, camera_arguments, check_views, drawn_again, fail, fail_for_memory,
                     have_device, is_vector, png_size, read_file, run, succeed, write_faces)


def test_views_by_votes_alone_need_no_device():
    result = succeed("views", "shape:knot:2000", "-k", "3", "--no-ratio")
    check_views(result, 3, False)
    assert result["renders"] == 0 and not result["inside_out"]
    assert max(view["score"] for view in result["views"]) == result["views"][0]["score"]
    full = succeed("views", "shape:knot:2000", "-k", "3", "--no-ratio", "--below", "full")
    check_views(full, 3, False)
    assert len(succeed("views", "shape:knot:2000", "-k", "8", "--no-ratio", "--below", "full")["views"]) == 8
    assert all(view["preference"] == 1 for view in full["views"])
    text = run("views", "shape:knot:2000", "-k", "3", "--no-ratio")
    assert text.returncode == 0 and text.stdout.count("  view ") == 3, text.stdout
    assert succeed("views", "shape:knot:2000", "-k", "3", "--no-ratio", "--threads", "1")["views"] == result["views"]


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
        for options in ((), ("--by-votes",)):
            assert needle + ": no face has a plane" in fail(1, "light", needle, "--eye", "1,2,3", *options)


def test_views_are_drawn_from_where_they_are_and_written_together():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "views")
        result = succeed("views", "shape:scene:3000", "-k", "3", "-o", output, *SMALL, "--ground", "--sun", "auto")
        check_views(result, 3, True)
        assert 3 <= result["renders"] <= result["candidates"] and result["output"] == output
        times = result["times_ms"]
        assert result["ms"] <= times["choosing"] + 1 and times["drawing"] > 0 and times["total"] >= sum(times.values()) / 2 - 1e-6
        assert sorted(os.listdir(output)) == ["contact_sheet.png", "view_1.png", "view_2.png", "view_3.png"]
        for i in (1, 2, 3):
            assert png_size(os.path.join(output, f"view_{i}.png")) == (64, 48)
        assert png_size(os.path.join(output, "contact_sheet.png")) == (8 + 2 * 72, 8 + 2 * 56)
        # Light, ground and lens are of the pictures only.
        lens = ("lights", "ground_up", "target", "up", "fov")
        without = [{k: v for k, v in view.items() if k not in lens} for view in result["views"]]
        again = succeed("views", "shape:scene:3000", "-k", "3")["views"]
        assert [{k: v for k, v in view.items() if k not in lens} for view in again] == without


def test_views_say_their_cameras_and_render_draws_the_same_pictures():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output, other = os.path.join(folder, "views"), os.path.join(folder, "b.png")
        command = ("views", "shape:knot:2000", "-k", "2", "--no-ratio", "-o", output, *SMALL, "--style", "hatch", "--ground")
        for options in ([], ["--sun", "auto", "--up", "0,0,1"]):
            result = succeed(*command, *options)
            told = run(*command, *options).stdout
            for i, view in enumerate(result["views"], 1):
                assert all(is_vector(view[name]) for name in ("eye", "target", "up")) and view["lights"]
                drawn = read_file(os.path.join(output, f"view_{i}.png"))
                succeed("render", "shape:knot:2000", *SMALL, "--style", "hatch", "--ground", "-o", other,
                        *camera_arguments({**view, "ortho": None}))
                assert read_file(other) == drawn
                drawn_again(told, f"  draw {i}      ", other)
                assert read_file(other) == drawn


def test_views_leave_nothing_behind_when_they_fail():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "views")
        for options in (["gone.obj"], ["shape:box", "--device", "nowhere"]):
            fail(1, "views", "-o", output, *options)
            fail(1, "path", "--frames", "3", "-o", output, *options)
            assert os.listdir(folder) == []
        fail_for_memory("views", "shape:box", "-o", output)
        fail_for_memory("path", "shape:box", "--frames", "3", "-o", output)
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


def test_views_of_a_long_model_are_not_those_of_its_end():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "pencil.obj")
        corners = [(math.cos(i * math.pi / 12), math.sin(i * math.pi / 12)) for i in range(24)]
        with open(path, "w") as file:
            for y in (-15, 15):
                file.writelines(f"v {x} {y} {z}\n" for x, z in corners)
            file.writelines(f"f {i + 1} {i + 25} {(i + 1) % 24 + 25} {(i + 1) % 24 + 1}\n" for i in range(24))
            file.write("f " + " ".join(str(i + 1) for i in range(24)) + "\n")
            file.write("f " + " ".join(str(48 - i) for i in range(24)) + "\n")
        def shares(*options):
            """How much of the length is seen in each view: the sine of the angle to the axis."""
            eyes = [view["eye"] for view in succeed("views", path, "-k", "3", "--no-ratio", *options)["views"]]
            return [math.hypot(x, z) / math.hypot(x, y, z) for x, y, z in eyes]
        assert min(shares()) > 0.3, shares()
        assert min(shares("--below", "full")) < 0.1


def test_views_are_written_into_a_folder():
    for name in ("-", ""):
        assert "folder" in fail(2, "views", "shape:box", "-o", name)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "views.png")
        assert "not of a PNG file" in fail(2, "views", "shape:box", "-o", path) and not os.path.exists(path)
