"""rimline light."""
import math
import os
import tempfile

from program import SMALL, fail, have_device, run, succeed


def test_light_is_where_render_puts_an_auto_sun():
    eye = ["--eye", "3,2,4"]
    light = succeed("light", "shape:knot:3000", *eye)
    assert math.isclose(math.hypot(*light["sun"]), 1.0, rel_tol=1e-6)
    assert 1 / 3 < light["lit"] < 2 / 3 and 0 < light["bright"] < light["lit"] and 0.5 < light["spread"] <= 1
    assert 0 < light["score"] <= light["spread"]
    voted = succeed("light", "shape:knot:3000", *eye, "--by-votes")
    assert 0 < voted["score"] <= voted["faces"] < 3000 and not voted["sees_backs"]
    assert math.isclose(math.hypot(*voted["sun"]), 1.0) and voted["sun"] != light["sun"]
    assert "--up" in fail(2, "light", "shape:box", *eye, "--by-votes", "--up", "z")
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        pictures = []
        for sun in ("auto", ",".join(repr(x) for x in light["sun"]), "0,1,0"):
            output = os.path.join(folder, "a.png")
            succeed("render", "shape:knot:3000", *eye, "--sun", sun, "-o", output, *SMALL)
            with open(output, "rb") as file:
                pictures.append(file.read())
        assert pictures[0] == pictures[1] != pictures[2]


def write_two_boxes(path, distance):
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    sides = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    with open(path, "w") as file:
        for first in (0, distance):
            file.writelines(f"v {x + first} {y} {z}\n" for x, y, z in corners)
        for first in (1, 9):
            file.writelines("f " + " ".join(str(first + i) for i in side) + "\n" for side in sides)
    return path


def test_a_model_that_is_small_in_the_picture_has_a_light():
    with tempfile.TemporaryDirectory() as folder:
        two = write_two_boxes(os.path.join(folder, "two.obj"), 100)
        # The camera looks at the middle, and sees the side of the farther box that is turned there.
        for eye, side in (("3,4,5", -1), ("60,4,5", 1)):
            found = succeed("light", two, "--eye", eye)
            assert found["lit"] > 0.5 and found["sun"][0] * side > 0, (eye, found)
        # Between the boxes, which lie beside the picture.
        far = write_two_boxes(os.path.join(folder, "far.obj"), 1000)
        assert "no face is in the picture from --eye" in fail(1, "light", far, "--eye", "500.5,0.5,3")
        assert run("light", far, "--eye", "500.5,0.5,3", "--by-votes").returncode == 0


def test_light_says_which_up_it_took():
    said = succeed("light", "shape:knot:2000", "--eye", "3,2,4", "--up", "z")
    assert said["up"] == [0, 0, 1] and said["up_from"] == "option"
    assert succeed("light", "shape:knot:2000", "--eye", "3,2,4")["up"] == [0, 1, 0]


def test_the_backs_of_one_face_and_of_two_are_told_apart():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "sheet.obj")
        for faces, words in (("f 1 2 3\n", "by 1 face that turns its back to the viewer"),
                             ("f 1 2 3\nf 2 4 3\n", "by 2 faces that turn their backs to the viewer")):
            with open(path, "w") as file:
                file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.1\n" + faces)
            assert words in run("light", path, "--eye", "0,0,-3", "--by-votes").stdout
