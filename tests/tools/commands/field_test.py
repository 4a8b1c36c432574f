"""rimline field."""
import os
import tempfile

from program import fail, png_rows, png_size, succeed


ONE_FACE = "OFF\n3 1 0\n-1 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"


def test_field_tells_what_one_plane_votes():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "plane.off")
        with open(path, "w", encoding="utf-8") as file:
            file.write(ONE_FACE)
        found = succeed("field", path, "--function", "origins", "--at", "0,0,0")
        assert found["planes"] == 1 and abs(found["values"][0]) < 1e-5
        peak = 0.5 * found["radius"]
        found = succeed("field", path, "--function", "origins", "--at", f"0,0,{peak}",
                        "--at", f"5,0,{-peak}", "--at", f"0,0,{2 * peak}")
        assert [round(v, 4) for v in found["values"]] == [1, 1, 0]
        found = succeed("field", path, "--function", "origins", "--discount", f"0,0,{peak}",
                        "--at", f"0,0,{peak}")
        assert found["values"][0] < 1e-4


def test_the_planes_of_a_model_that_is_inside_out_are_turned():
    with tempfile.TemporaryDirectory() as folder:
        values = {}
        corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
        for name, faces in (("out", "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"), ("in", "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n")):
            path = os.path.join(folder, name + ".obj")
            with open(path, "w", encoding="utf-8") as file:
                file.write(corners + faces)
            found = succeed("field", path, "--function", "views", "--at", "2,1,2")
            assert found["inside_out"] == (name == "in")
            values[name] = found["values"]
        assert values["in"] == values["out"]


def test_a_cut_along_an_axis_is_an_even_line():
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "slice.png")
        succeed("field", "shape:box:3000", "--function", "views", "--slice", "z=1.99", "-o", output)
        rows = png_rows(output)
        # The sides of the box, of many short segments.
        column = min(range(240, 300), key=lambda x: sum(rows[250][x]))
        tones = {rows[y][column] for y in range(235, 265)}
        assert len(tones) == 1 and sum(min(tones)) < 600, tones


def test_field_draws_slices_whole_or_not_at_all():
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "slice.png")
        found = succeed("field", "shape:knot:2000", "--function", "views", "--slice", "z=0.1", "-o",
                        output, "--resolution", "64")
        assert found["values"] == [] and found["slice"]["least"] < found["slice"]["greatest"]
        width, height = png_size(output)
        assert width > height > 64
        os.remove(output)
        line = fail(2, "field", "shape:knot:2000", "--slice", "z=7", "-o", output)
        assert "does not meet" in line
        assert os.listdir(folder) == []
    for arguments in (["--slice", "w=1", "-o", "a.png"], ["--slice", "z=", "-o", "a.png"],
                      ["--slice", "z=0"], ["-o", "a.png"], [], ["--function", "nothing"]):
        fail(2, "field", "shape:box", *arguments)
