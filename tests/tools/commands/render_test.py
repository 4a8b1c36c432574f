"""rimline render."""
import json
import os
import tempfile

from program import fail, have_device, is_count, png_size, run, skip, succeed


def check_render(result, output, size):
    assert all(is_count(result[k]) for k in ("silhouette", "shadow_edges", "bytes_streamed", "bytes_full", "bytes_uploaded",
                                                "stream_memory_bytes", "tracker_memory_bytes"))
    assert result["frame_ms"] > 0 and result["device"] and result["driver"]
    assert result["output"] == output and png_size(output) == size


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
            skip(result.stderr.strip())
        assert result.returncode == 0, result.stderr
        assert json.loads(result.stdout)["validation_messages"] == 0


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
