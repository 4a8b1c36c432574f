"""rimline bench fields."""
import json

from program import fail, have_methods, run, succeed


def test_bench_fields_checks_and_then_measures():
    ended = run("bench", "fields", "shape:knot:20000", "--rounds", "1", "--check", "--json")
    found = json.loads(ended.stdout)
    result = found["fields"][0]
    assert all(row["error"] <= row["bound"] for row in result["lattice"])
    assert result["brute_ms"] > 0 and found["targets"][0]["value"] > 0
    missed = [target["target"] for target in found["targets"] if not target["reached"]]
    assert ended.returncode == (3 if missed else 0), (found["targets"], ended.stderr)
    fail(2, "bench", "fields", "--growth")


def test_bench_fields_counts_boxes_over_alpha():
    have_methods()
    found = succeed("bench", "fields", "shape:knot:5000", "--alphas", "--viewpoints", "6", "--most-origins", "2",
                    "--most-faces", "1000")
    result = found["alphas"][0]
    assert result["verified"] is True and result["faces"] <= 1000
    assert {row["origins"] for row in result["rows"]} == {1, 2}
    for row in result["rows"]:
        complete, letter, straddling = row["literal"]
        assert complete["missed_edges"] == straddling["missed_edges"] == 0
        assert complete["box_checks"] == complete["pbv_checks"] + complete["ebv_checks"] > 0
        assert letter["listed_edges"] == straddling["listed_edges"] <= complete["listed_edges"]
    assert all(mean["models"] == 1 and mean["work"] > 0 for mean in found["means"])
    for arguments in (("--alphas", "--check"), ("--alphas", "--rounds", "2"), ("--viewpoints", "6"),
                      ("--most-origins", "2"), ("--most-faces", "100")):
        fail(2, "bench", "fields", "shape:box:12", *arguments)
