"""rimline path."""
import math
import os
import tempfile

from program import SMALL, check_views, fail, have_device, png_size, succeed


def test_a_path_passes_its_views_and_keeps_its_distance():
    result = succeed("path", "shape:knot:2000", "--no-ratio", "--frames", "24")
    check_views(result, 4, False)
    assert len(result["nodes"]) == 8 and len(result["samples"]) == 24
    assert result["node_views"][::2] == [0] + sorted(result["node_views"][2::2], key=result["node_views"].index)
    assert sorted(result["node_views"][::2]) == [0, 1, 2, 3] and result["node_views"][1::2] == [None] * 4
    for node, view in zip(result["nodes"], result["node_views"]):
        assert view is None or node == result["views"][view]["eye"]
    # But for rounding: the path passes directions and distances.
    assert math.dist(result["samples"][0], result["nodes"][0]) < 1e-14 * 64 * result["radius"]
    for sample, up in zip(result["samples"], result["ups"]):
        back = [s - c for s, c in zip(sample, result["center"])]
        assert abs(math.dist(up, (0, 0, 0)) - 1) < 1e-9 and abs(sum(u * b for u, b in zip(up, back))) < 1e-9
    assert result["min_distance"] >= (3 ** 0.5 - 1e-9) * result["radius"]
    steps = [math.dist(a, b) for a, b in zip(result["samples"], result["samples"][1:] + result["samples"][:1])]
    assert max(steps) <= 1.01 * result["length"] / 24


def test_options_of_pictures_belong_to_a_path_with_pictures():
    for options in (["--style", "toon"], ["--ground"], ["--sun", "auto"], ["--light-follow"], ["--size", "64x48"], ["--fps", "24"]):
        message = fail(2, "path", "shape:knot:2000", "--no-ratio", *options)
        assert f"{options[0]}: there are no pictures" in message, message
    assert "--device: nothing is drawn" in fail(2, "path", "shape:knot:2000", "--no-ratio", "--device", "0")


def test_a_path_is_drawn_through_animate():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "path")
        result = succeed("path", "shape:spring:2000", "-k", "2", "--frames", "5", "-o", output, *SMALL, "--ground",
                         "--light-follow")
        check_views(result, 2, True)
        assert sorted(os.listdir(output)) == [f"frame_{i:04}.png" for i in range(5)]
        assert all(png_size(os.path.join(output, name)) == (64, 48) for name in os.listdir(output))
