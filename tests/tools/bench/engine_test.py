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
        assert [p["name"] for p in model["passes"]] == [
            "silhouettes", "surfaces, unlit", "shadow volumes, light 0", "surfaces, light 0", "lines", "picture"]
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
