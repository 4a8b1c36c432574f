"""rimline light."""
import math
import os
import tempfile

from program import SMALL, have_device, succeed


def test_light_is_where_render_puts_an_auto_sun():
    eye = ["--eye", "3,2,4"]
    light = succeed("light", "shape:knot:3000", *eye)
    assert math.isclose(math.hypot(*light["sun"]), 1.0, rel_tol=1e-6)
    assert 1 / 3 < light["lit"] < 2 / 3 and 0 < light["bright"] < light["lit"] and 0.5 < light["spread"] <= 1
    assert 0 < light["score"] <= light["spread"]
    voted = succeed("light", "shape:knot:3000", *eye, "--by-votes")
    assert 0 < voted["score"] <= voted["faces"] < 3000 and not voted["sees_backs"]
    assert math.isclose(math.hypot(*voted["sun"]), 1.0) and voted["sun"] != light["sun"]
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        pictures = []
        for sun in ("auto", ",".join(repr(x) for x in light["sun"]), "0,1,0"):
            output = os.path.join(folder, "a.png")
            succeed("render", "shape:knot:3000", *eye, "--sun", sun, "-o", output, *SMALL)
            with open(output, "rb") as file:
                pictures.append(file.read())
        assert pictures[0] == pictures[1] != pictures[2]
