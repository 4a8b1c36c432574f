"""rimline bench engine."""
from program import fail, have_device, run, succeed


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
    for lamp in ("resting_lamp_ms", "moving_lamp_ms"):
        assert 0 < model["record"][lamp] < 1000, model["record"]
    assert [way["name"] for way in model["timestamps"]] == ["without timestamps", "with timestamps"]
    if model["passes"]:  # Where the device's queue has timestamps.
        surfaces = "surfaces, unlit", "surfaces, light 0"
        if model["passes"][1]["name"] == "surfaces":
            surfaces = "surfaces", "surfaces, in shadow"
        assert [p["name"] for p in model["passes"]] == [
            "silhouettes", surfaces[0], "shadow volumes, light 0", surfaces[1], "lines", "picture"]
        assert all(p["median_ms"] >= 0 for p in model["passes"])
        assert sum(p["median_ms"] for p in model["passes"]) > 0
    growth = succeed("bench", "engine", "--growth", *few[:2], "--least-faces", "1000", "--most-faces", "3000")
    assert [step["verified"] for step in growth["growth"]] == [True, True]
    assert all(0 < step["move_ms"] <= step["stream_ms"] for step in growth["growth"])
    assert "not expected: --device" in fail(2, "bench", "service", "--device", "cpu")
    assert "not expected: --methods" in fail(2, "bench", "engine", "--methods")
    assert "no size from 5 to 6 faces" in fail(
        1, "bench", "engine", "--growth", "--least-faces", "5", "--most-faces", "6")
    assert run("bench", "engine", "no such file.ply").stdout == ""


def test_bench_engine_sets_lines_beside_outlines_of_pixels():
    have_device()
    few = ("--views", "2", "--frames", "2")
    result = succeed("bench", "engine", "--image-space", "shape:scene", *few)
    assert result["views"] == 2
    [model] = result["models"]
    ways = {way["name"]: way["pixels"] for way in model["ways"]}
    assert list(ways) == ["lines by slots", "Sobel, depth and normals", "Sobel, depth alone", "thickened backs",
                          "lines of exact visibility"]
    assert len({pixels["true"] for pixels in ways.values()}) == 1
    # Normals find creases, and depth alone few of them.
    assert ways["Sobel, depth and normals"]["creases"] > 2 * max(1, ways["Sobel, depth alone"]["creases"])
    missed = {name: pixels["missed"] / pixels["true"] for name, pixels in ways.items()}
    assert missed["lines by slots"] < 0.03 and missed["lines of exact visibility"] < 0.03, missed
    assert missed["Sobel, depth and normals"] <= missed["Sobel, depth alone"], missed
    for way in model["ways"]:
        assert way["frame_ms"] > 0 and 0 < way["cpu_ms"] < way["frame_ms"], way
    # A higher threshold never finds more.
    at = {(s["depth_step"], s["normal_step_degrees"]): s["pixels"]["marked"] for s in model["sobel"]}
    assert len(at) == 12
    depths, normals = (sorted({key[k] for key in at}) for k in (0, 1))
    assert all(at[a, n] >= at[b, n] for a, b in zip(depths, depths[1:]) for n in normals)
    assert all(at[d, a] >= at[d, b] for a, b in zip(normals, normals[1:]) for d in depths)
    assert "--views: belongs to --image-space" in fail(2, "bench", "engine", "--views", "3")
    for options in (["--growth"], ["--check"], ["--rounds", "2"], ["--viewpoints", "2"]):
        assert "not together with" in fail(2, "bench", "engine", "--image-space", *options)
