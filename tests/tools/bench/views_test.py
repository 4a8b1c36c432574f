"""rimline bench views."""
import os
import tempfile

from program import fail, have_device, succeed


def test_bench_views_sets_votes_beside_other_measures():
    have_device()
    result = succeed("bench", "views", "shape:knot:1500")["models"][0]
    names = [row["name"] for row in result["views"]]
    assert len(names) == len(set(names)) == 8 and names[0].startswith("planes' votes")
    for row in result["views"]:
        assert 0.3 < row["seen"] <= 1 and 0 < row["least_apart_deg"] <= row["mean_apart_deg"] <= row["most_apart_deg"]
    # What can be had is not had by fewer.
    greedy = next(row for row in result["views"] if "greedy" in row["name"])
    assert greedy["seen"] >= max(row["seen"] for row in result["views"]) - 0.05
    for row in result["lights"]:
        assert 0 <= row["away"] <= row["unlit"] <= 1 and row["contrast"] > 0
    assert 4 <= result["renders"] <= result["candidates"] <= result["lattice_candidates"]
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "pictures")
        succeed("bench", "views", "shape:knot:1500", "--pictures", output)
        assert len(os.listdir(output)) == 5
    assert "not expected: --pictures" in fail(2, "bench", "fields", "--pictures", "a")
    assert "--up: belongs to --pictures" in fail(2, "bench", "views", "--up", "0,0,1")
    assert "not expected: --rounds" in fail(2, "bench", "views", "--rounds", "3")
    assert "--pictures: expected a folder" in fail(2, "bench", "views", "--pictures", "")
