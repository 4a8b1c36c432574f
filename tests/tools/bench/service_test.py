"""rimline bench service."""
from program import succeed


def test_bench_runs_the_service():
    result = succeed("bench", "service", "shape:knot:2000", "shape:sphere:500", "--trackers", "4", "--frames", "20",
                     "--fps", "200", "--workers", "1")["service"]
    assert result["verified"] is True and result["workers"] == 1 and result["lost"] == 0
    assert result["posts"] == 80 and 0 < result["moves"] <= 80
