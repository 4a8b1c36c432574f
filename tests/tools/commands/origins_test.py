"""rimline origins."""
import os
import tempfile

from program import fail, is_count, is_vector, png_size, succeed


def test_origins_are_given_or_chosen():
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "groups.png")
        found = succeed("origins", "shape:knot:4000", "-k", "3", "-o", output)
        assert png_size(output) == (1400, 700)
    assert len(found["origins"]) == 3 and all(map(is_vector, found["origins"]))
    assert sum(found["groups"]) == 4000 or sum(found["groups"]) > 3000
    assert is_count(found["sfo_edges"]) and found["box_checks"] > 0 and found["ms"] > 0
    chosen = succeed("origins", "shape:torus:4000", "--most", "2", "--viewpoints", "60")
    assert [t["origins"] for t in chosen["trials"]] == [0, 1, 2]
    assert chosen["work"] == min(t["work"] for t in chosen["trials"])
    fail(2, "origins", "shape:box", "-k", "2", "--most", "3")
    fail(2, "origins", "shape:box", "-k", "0")
