"""rimline bench fields."""
from program import fail, succeed


def test_bench_fields_checks_and_then_measures():
    found = succeed("bench", "fields", "shape:knot:20000", "--rounds", "1", "--check")
    result = found["fields"][0]
    assert all(row["error"] <= row["bound"] for row in result["lattice"])
    assert result["brute_ms"] > 0 and found["targets"][0]["value"] > 0
    fail(2, "bench", "fields", "--growth")
