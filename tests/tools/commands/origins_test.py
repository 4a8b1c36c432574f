"""rimline origins."""
import os
import tempfile

from program import fail, have_methods, is_count, is_vector, png_rows, png_size, run, succeed


def test_origins_are_given_or_chosen():
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "groups.png")
        found = succeed("origins", "shape:knot:4000", "-k", "3", "-o", output)
        assert png_size(output) == (1400, 700)
        # Of few faces, the Hough points are dots that can be seen: the six planes of a box.
        succeed("origins", "shape:box", "-o", output)
        hough = [pixel for row in png_rows(output) for pixel in row[701:]]
    assert sum(max(pixel) - min(pixel) > 60 for pixel in hough) > 6 * 30
    assert len(found["origins"]) == 3 and all(map(is_vector, found["origins"]))
    assert sum(found["groups"]) == 4000 or sum(found["groups"]) > 3000
    assert is_count(found["sfo_edges"]) and found["box_checks"] > 0 and found["ms"] > 0
    chosen = succeed("origins", "shape:torus:4000", "--most", "2", "--viewpoints", "60")
    assert [t["origins"] for t in chosen["trials"]] == [0, 1, 2]
    assert chosen["work"] == min(t["work"] for t in chosen["trials"])
    fail(2, "origins", "shape:box", "-k", "2", "--most", "3")
    fail(2, "origins", "shape:box", "-k", "0")


def test_origins_counts_both_lists_of_the_thesis():
    have_methods()
    arguments = ("origins", "shape:knot:2000", "-k", "2", "--literal", "--viewpoints", "12")
    complete, letter, straddling = succeed(*arguments)["literal"]
    assert (complete["listing"], letter["listing"]) == ("sfo_from_any", "sfo_from_all")
    assert complete["listed_edges"] > letter["listed_edges"] == straddling["listed_edges"]
    assert complete["missed_edges"] == straddling["missed_edges"] == 0 < letter["missed_edges"]
    shown = run(*arguments).stdout
    assert f"points_and_edges, sfo_from_all: {letter['listed_edges']} edges listed" in shown


def test_a_model_without_planes_has_no_origins_and_no_field():
    with tempfile.TemporaryDirectory() as folder:
        flat = os.path.join(folder, "flat.obj")
        with open(flat, "w") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
        for command in (["origins"], ["field", "--at", "0,0,0"], ["views", "--no-ratio"]):
            assert "no face has a plane" in fail(1, command[0], flat, *command[1:]), command
    chosen = succeed("origins", "shape:box")
    assert chosen["votes"] == [None] and "the center" in run("origins", "shape:box").stdout
    for option in ("--direction", "--up"):
        assert option + ": there is no picture" in fail(2, "origins", "shape:box", option, "0,0,1")
    assert "--resolution: belongs to --slice" in fail(2, "field", "shape:box", "--at", "0,0,0", "--resolution", "64")
