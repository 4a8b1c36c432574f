"""rimline view under Xvfb."""
import json
import os
import signal
import subprocess
import tempfile
import time

from program import PROGRAM, fail, have_device, png_size, run, skip


def have_window():
    have_device()
    if "not in this build" in run("--help").stdout:
        skip("built without the window")


class Display:
    """Xvfb while the block runs; `environment` shows on it."""

    def __enter__(self):
        read, write = os.pipe()
        try:
            self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x960x24",
                                            "-nolisten", "tcp"], pass_fds=[write], stderr=subprocess.DEVNULL)
        except FileNotFoundError:
            skip("no Xvfb")
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
                        ["shape:torus:2000", "--ortho", "3", "--line-width", "4", "--background", "#102030"],
                        ["shape:knot:3000", "--eye", "3,2,4", "--silhouette-from=-2,1,3", "--hidden"]):
            options += ["--size", "200x150"]
            assert run("render", *options, "-o", drawn).returncode == 0
            result = run("view", *options, "--no-panel", "--frames", "2", "--screenshot", shown, env=display.environment)
            assert result.returncode == 0 and result.stdout == result.stderr == "", result.stderr
            with open(drawn, "rb") as a, open(shown, "rb") as b:
                assert a.read() == b.read(), options
        result = run("view", "shape:box", "--frames", "3", "--inspect", "--silhouette-from", "2,1,0", "--size", "640x480",
                     "--screenshot", shown, env=display.environment)
        assert result.returncode == 0 and png_size(shown) == (640, 480), result.stderr


def test_view_shows_scenes_as_render_draws_them():
    have_window()
    with tempfile.TemporaryDirectory() as folder, Display() as display:
        drawn, shown, scene = (os.path.join(folder, name) for name in ("drawn.png", "shown.png", "scene.json"))
        two = ["shape:box", "--paint", "#c04020", "shape:knot:3000", "--at", "2.5,0,0", "--turn", "30", "--up", "z"]
        look = ["--style", "toon", "--size", "200x150"]
        # With a ground, render moves its own camera away from the shadow; the scene file has that camera.
        for drawn_from, others in ((two + look, (two + look,)), (two + look + ["--ground"], ([scene],))):
            assert run("render", *drawn_from, "-o", drawn, "--save-scene", scene).returncode == 0
            for model in others:
                result = run("view", *model, "--no-panel", "--frames", "2", "--screenshot", shown, env=display.environment)
                assert result.returncode == 0 and result.stdout == result.stderr == "", result.stderr
                with open(drawn, "rb") as a, open(shown, "rb") as b:
                    assert a.read() == b.read(), model
        with open(scene, "w") as file:
            file.write('{"rimline_scene": 1, "models": [{"model": "shape:box"}], "picture": {"palette": "sea"}}')
        result = run("view", scene, "--frames", "1", env=display.environment)
        assert result.returncode == 0 and "picture.palette: view has no --palette" in result.stderr, result.stderr
        for size, options, expected in (("160x120", [], (800, 600)), ("160x120", ["--size", "200x150"], (200, 150)),
                                        ("160x120", ["--no-panel"], (160, 120)), ("9000x600", [], (1152, 600))):
            with open(scene, "w") as file:
                json.dump({"rimline_scene": 1, "models": [{"model": "shape:box"}], "picture": {"size": size}}, file)
            result = run("view", scene, *options, "--frames", "1", "--screenshot", shown, env=display.environment)
            assert result.returncode == 0 and png_size(shown) == expected, (options, png_size(shown), result.stderr)


def test_a_signal_ends_view_without_words():
    have_window()
    with Display() as display, tempfile.TemporaryDirectory() as folder:
        for number in (signal.SIGINT, signal.SIGTERM):
            process = subprocess.Popen([PROGRAM, "view", "shape:box"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                       text=True, env=display.environment | {"XDG_STATE_HOME": folder})
            time.sleep(2.0)
            process.send_signal(number)
            out, err = process.communicate(timeout=60)
            assert process.returncode == -number and out == err == "", (process.returncode, out, err)


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
        assert "--json" not in run("view", "--help").stdout and "--quiet" in run("view", "--help").stdout
