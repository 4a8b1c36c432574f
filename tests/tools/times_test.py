"""Where the time of a run went, standard input and output of all commands, and the order of messages."""
import os
import pty
import subprocess
import tempfile
import time

from program import PROGRAM, driver_ms, fail, have_device, read_file, run, skip, succeed

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nf 1 2 3\n"
KNOT = "shape:knot:60000"


def check_times(folder, commands, driver=0.0):
    for name, arguments in commands:
        begin = time.monotonic()
        result = succeed(name, *(a.replace("OUT", folder) for a in arguments))
        clock = 1000 * (time.monotonic() - begin)
        times = result["times_ms"]
        total = times.pop("total")
        assert abs(sum(times.values()) - total) < 1e-6 * total, (name, times)
        # The rest is the JSON, and the system's start and end of the program with its Vulkan driver.
        assert 0.9 * clock - 300 - driver < total < clock, (name, clock, total, times)
        assert {"reading"} <= set(times) and len(times) >= 2, (name, times)


def test_reported_times_are_the_times_that_it_took():
    with tempfile.TemporaryDirectory() as folder:
        check_times(folder, [
            ("silhouette", [KNOT, "--from", "3,2,1", "--no-edges", "-o", "OUT/a.obj"]),
            ("draw", [KNOT, "-o", "OUT/a.svg"]), ("track", [KNOT, "--frames", "10"]),
            ("light", [KNOT, "--eye", "3,2,1"]), ("origins", [KNOT, "-k", "1", "-o", "OUT/o.png"]),
            ("field", [KNOT, "--at", "0,0,0", "--slice", "z=0", "--resolution", "32", "-o", "OUT/f.png"]),
            ("points", ["shape:knot:8000", "--as-points", "--eye", "3,2,1", "--no-lists", "--export", "OUT/p.ply"]),
            ("views", ["shape:knot:8000", "--no-ratio", "-k", "2"]),
            ("path", ["shape:knot:8000", "--no-ratio", "--frames", "6"])])


def test_reported_times_of_pictures_are_the_times_that_they_took():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        small = ["--size", "96x64"]
        check_times(folder, [
            ("render", [KNOT, "--sun", "auto", "-o", "OUT/r.png", *small]),
            ("animate", ["shape:knot:8000", "--frames", "3", "-o", "OUT/frames", *small]),
            ("views", ["shape:knot:8000", "-k", "2", "-o", "OUT/views", *small]),
            ("path", ["shape:knot:8000", "--frames", "3", "-o", "OUT/path", *small]),
            ("points", ["shape:knot:8000", "--as-points", "-o", "OUT/p.png", "--no-lists", *small])], driver_ms())


def test_verbose_says_on_standard_error_where_the_time_went():
    with tempfile.TemporaryDirectory() as folder:
        for arguments in (["info", "shape:knot"], ["draw", "shape:knot", "-o", os.path.join(folder, "a.svg")],
                          ["silhouette", "shape:knot", "--from", "3,2,1"]):
            plain, told = run(*arguments), run(*arguments, "--verbose")
            assert told.returncode == 0 and plain.stderr == ""
            lines = told.stderr.splitlines()
            assert lines[0].startswith("  reading ") and lines[-1].startswith("  in all "), lines
            seconds = [float(line.split()[-2]) for line in lines]
            assert abs(sum(seconds[:-1]) - seconds[-1]) < 0.001 * len(lines), lines
            names = lambda text: [line.split()[0] for line in text.splitlines() if "time" not in line and "ms" not in line]
            assert names(told.stdout) == names(plain.stdout)
        quiet = run("info", "shape:knot", "--verbose", "--quiet")
        assert quiet.stdout == "" and "in all" in quiet.stderr
        assert "in all" in run("info", "shape:knot", "--verbose", "--json").stderr


def test_wrong_values_are_told_in_the_order_of_the_command_line():
    wrong = {"--size": "12", "--eye": "1,2", "--style": "inc", "--line-width": "0", "--sun": "0,0,0"}
    for first in wrong:
        order = [first] + [name for name in wrong if name != first]
        message = fail(2, "render", "shape:box", *(f"{name}={wrong[name]}" for name in order))
        assert message.startswith(f"rimline: error: {first}: "), (order, message)
    assert "no built-in shape" in fail(2, "render", "shape:bxo", "--size", "12")
    assert "--size" in fail(2, "render", "--size", "12", "shape:bxo")


def test_standard_input_and_output_are_those_of_a_pipe():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.obj")
        with open(path, "w") as file:
            file.write(TRIANGLE)
        def piped(*arguments):
            result = run(*arguments, "--format", "obj", input=TRIANGLE, cwd=folder, encoding="latin1")
            assert result.returncode == 0, (arguments, result.stderr)
            return result
        for name, arguments in (("info", []), ("silhouette", ["--from", "3,2,1"]), ("track", ["--frames", "3"]),
                                ("light", ["--eye", "0.3,0.3,9"]), ("field", ["--at", "0,0,0"])):
            assert piped(name, "-", *arguments).stdout != "", name
        for ending in ("svg", "pdf", "dxf", "json"):
            drawn = os.path.join(folder, "a." + ending)
            assert run("draw", path, "-o", drawn, cwd=folder).returncode == 0
            result = piped("draw", "-", "-o", "-", *([] if ending == "svg" else ["--as", ending]))
            clean = lambda text: text.replace(path, "-")
            if ending in ("svg", "json"):
                assert clean(read_file(drawn).decode("latin1")) == result.stdout, ending
            else:
                assert result.stdout[:4] == read_file(drawn).decode("latin1")[:4], ending
            assert "visible" in result.stderr  # The summary.
        for ending in ("obj", "ply", "svg"):
            lines = os.path.join(folder, "b." + ending)
            assert run("silhouette", path, "--from", "3,2,1", "--borders", "-o", lines).returncode == 0
            result = piped("silhouette", "-", "--from", "3,2,1", "--borders", "-o", "-", "--as", ending)
            assert read_file(lines).decode().replace(path, "-") == result.stdout, ending
        assert "leave out one of them" in fail(2, "draw", path, "-o", "-", "--json")
        assert "leave out one of them" in fail(2, "silhouette", path, "--from", "3,2,1", "-o", "-", "--json")


def test_points_reads_a_cloud_from_standard_input():
    with tempfile.TemporaryDirectory() as folder:
        points = "".join(f"{x * 0.1:.3f} {y * 0.1:.3f} {0.01 * x * y:.3f}\n" for x in range(20) for y in range(20))
        path = os.path.join(folder, "a.xyz")
        with open(path, "w") as file:
            file.write(points)
        from_file = run("points", path, "--eye", "3,2,5", "--json").stdout
        for name in ("xyz", "pts"):
            result = run("points", "-", "--format", name, "--eye", "3,2,5", "--json", input=points)
            assert result.returncode == 0, result.stderr
            without = lambda text: text.split('"umbrellas_ms"')[0].replace(path, "-").split('"points"')[1].split('"ms"')[0]
            assert without(result.stdout) == without(from_file)
        bad = run("points", "-", "--format", "xyz", input="1 2 nan\n" + points)
        assert bad.returncode == 1 and "standard input" in bad.stderr, bad.stderr
        assert run("points", "-", "--format", "xyz", "--drop-bad", input="1 2 nan\n" + points).returncode == 0
        assert run("points", "-", input=points).returncode == 2
        assert "its content is ply" in run("points", "-", "--format", "xyz", input="ply\nformat ascii 1.0\n").stderr


def terminal_of(*arguments):
    """What the program writes to standard error, if that is a terminal."""
    ours, theirs = pty.openpty()
    with subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.DEVNULL, stderr=theirs) as process:
        os.close(theirs)
        text = b""
        while True:
            try:
                part = os.read(ours, 65536)
            except OSError:  # The program has ended.
                break
            if not part:
                break
            text += part
    os.close(ours)
    assert process.returncode == 0, text
    return text.decode()


def test_long_work_shows_progress_on_a_terminal():
    with tempfile.TemporaryDirectory() as folder:
        shown = terminal_of("field", "shape:knot:100000", "--slice", "z=0", "--tolerance", "0", "--resolution", "256", "-o",
                            os.path.join(folder, "a.png"))
        assert "\r\x1b[Ksumming votes" in shown and "%" in shown, shown
        # The last line is erased.
        assert shown.rstrip().endswith("\x1b[K"), shown[-80:]
        assert terminal_of("info", "shape:box") == ""
        assert terminal_of("field", "shape:knot:100000", "--slice", "z=0", "--tolerance", "0", "--resolution", "256", "-o",
                           os.path.join(folder, "a.png"), "--quiet") == ""


def test_drawing_shows_progress_on_a_terminal():
    have_device()
    if next(device for device in succeed("devices")["devices"] if device["chosen"])["type"] != "CPU":
        skip("a GPU draws before there is anything to show")
    with tempfile.TemporaryDirectory() as folder:
        shown = terminal_of("render", "shape:knot", "--ground", "--size", "4000x3000", "-o", os.path.join(folder, "a.png"))
        assert "\r\x1b[Kdrawing the picture" in shown, shown
