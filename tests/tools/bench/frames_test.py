"""rimline bench frames."""
from program import fail, have_device, run, succeed

FEW = ("shape:knot:2000", "--size", "64x48", "--frames", "1")


def test_bench_frames_measures_one_change_at_a_time():
    have_device()
    result = succeed("bench", "frames", *FEW, "--most-faces", "10000")
    assert result["device"]["name"] and result["device"]["driver"] and result["verified"] is True
    assert (result["width"], result["height"], result["frames"]) == (64, 48, 1)
    rows = {(row["group"], row["name"]): row for row in result["rows"]}
    assert {group for group, _ in rows} == {"light", "limits", "scale", "samples", "lines", "growth"}
    lamps = [f"lamp at {radii} radi{'us' if radii == 1 else 'i'}" for radii in (1, 3, 10, 100, 1000)]
    for name in ("no shadow", "sun", *lamps):
        assert ("light", name) in rows, name
    measured = [row for row in result["rows"] if "refusal" not in row]
    assert len(measured) > 12
    for row in measured:
        assert row["frame_ms"] >= row["record_ms"] > 0, row
        assert row["passes_ms"] <= row["frame_ms"], row
    volumes = {row["name"]: [p["name"] for p in row["passes"] if p["name"].startswith("shadow volumes")]
               for row in measured if row["group"] == "light" and row["passes"]}
    assert all(found == ([] if name == "no shadow" else ["shadow volumes, light 0"])
               for name, found in volumes.items()), volumes
    # Rectangles hold less than the drawn area, and with depths even less.
    for row in measured:
        if row["group"] == "limits":
            tests = row["sample_tests"]
            assert tests["drawn_area"] >= tests["rectangle"] >= tests["depth"] > 0, row
    assert ("growth", "shape:knot:10000") in rows and ("growth", "shape:knot:30000") not in rows
    # The engine takes 4 samples at most.
    assert rows["samples", "8, scale 1"]["refusal"].endswith("are taken")


def test_bench_frames_prints_one_table_under_the_name_of_the_device():
    have_device()
    result = run("bench", "frames", *FEW, "--most-faces", "1")
    assert result.returncode == 0, result.stderr
    device = next(d for d in succeed("devices")["devices"] if d["chosen"])
    assert f"{device['name']}, {device['driver']}\n" in result.stdout
    heads = [line for line in result.stdout.splitlines() if line.split()[:2] == ["faces", "frame"]]
    assert len(heads) == 1
    assert "growth" not in result.stdout and "lamp at 3 radii" in result.stdout
    assert "'nowhere'" in fail(1, "bench", "frames", *FEW, "--device", "nowhere")
    assert run("bench", "frames", "no such file.ply").returncode == 1
