"""rimline info."""
import base64
import json
import math
import os
import re
import struct
import tempfile

from program import fail, is_vector, run, succeed


def test_info_counts_shapes():
    for shape in ("sphere", "torus", "knot", "box", "spring"):
        found = succeed("info", f"shape:{shape}:1000")
        assert found["closed"] is True and found["oriented"] is True, shape
        assert found["components"] == 1 and found["border_edges"] == 0
        assert found["edges"] * 2 == found["faces"] * 3
        euler = found["vertices"] - found["edges"] + found["faces"]
        assert euler == (0 if shape in ("torus", "knot") else 2), shape
        assert is_vector(found["center"]) and found["radius"] > 0
        assert len(found["bounds"]) == 2 and all(map(is_vector, found["bounds"]))
    open_mesh = succeed("info", "shape:terrain:1000")
    assert open_mesh["closed"] is False and open_mesh["border_edges"] > 0
    coarse, fine = succeed("info", "shape:box"), succeed("info", "shape:box", "--subdivide", "2")
    assert fine["faces"] == 16 * coarse["faces"] and fine["closed"] is True
    summary = run("info", "shape:box")
    assert summary.returncode == 0 and str(coarse["faces"]) in summary.stdout


def test_info_takes_every_point_of_a_cloud_as_used():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "cloud.ply")
        with open(path, "w") as file:
            file.write("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                       "property float z\nend_header\n0 0 0\n4 0 0\n-0 0 0\n4 2 0\n")
        found = succeed("info", path)
        assert (found["vertices"], found["file_vertices"], found["faces"]) == (3, 4, 0)
        assert found["center"] == [2, 1, 0] and math.isclose(found["radius"], math.sqrt(5))
        assert found["bounds"] == [[0, 0, 0], [4, 2, 0]] and found["closed"] is False
        assert path in fail(1, "silhouette", path, "--from", "1,2,3")


def test_info_measures_clouds_far_from_the_origin():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "survey.xyz")
        open(path, "w").write("500000.25 5400000 300\n500001.125 5400000 300\n500000.25 5400000.5 300\n")
        found = succeed("info", path)
        assert found["bounds"] == [[500000.25, 5400000, 300], [500001.125, 5400000.5, 300]]
        assert math.isclose(found["radius"], math.hypot(0.4375, 0.25), rel_tol=1e-9)


def test_info_tells_what_has_colors():
    head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    color = "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    faces = "element face 1\nproperty list uchar int vertex_indices\n"
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "colors.ply")
        for text, expected in (
                (head + faces + color + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n", "1, and colors of faces"),
                (head + color + faces + "end_header\n0 0 0 1 2 3\n1 0 0 4 5 6\n0 1 0 7 8 9\n3 0 1 2\n",
                 "1, and colors of vertices"),
                (head + faces + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", None)):
            with open(path, "w") as file:
                file.write(text)
            told = re.search(r"^  materials   (.*)$", run("info", path).stdout, re.M)
            assert (told and told[1]) == expected, (text, told)


def test_info_tells_what_a_cloud_is():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "cloud.ply")
        with open(path, "w") as file:
            file.write("ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
                       "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\n"
                       "property uchar blue\nend_header\n")
            for x in (0, 1, 2, 4, 7, 7):
                file.write(f"{x} 0 0 0 0 1 1 2 3\n")
        cloud = succeed("info", path)["cloud"]
        # Nearest: 1, 1, 1, 2, 3; the upper median is 1.
        assert cloud == {"points": 5, "duplicates": 1, "has_normals": True, "has_colors": True, "has_intensities": False,
                         "spacing": 1.0}, cloud
        text = run("info", path).stdout
        assert "a cloud" in text and "rimline points" in text and "each has    normals, colors" in text, text
        with open(path) as file:
            piped = run("info", "-", "--format", "ply", input=file.read())
        assert piped.returncode == 0 and piped.stdout.splitlines()[1:] == text.splitlines()[1:], piped
        far = os.path.join(folder, "far.xyz")
        with open(far, "w") as file:
            file.write("999999.243 2000000.265 5\n999999.244 2000000.266 5\n")
        text = run("info", far).stdout
        assert "0 of them repeated" in text and "bounds      999999.243,2000000.265,5 to 999999.244,2000000.266,5" in text, text
        with open(far) as file:
            piped = run("info", "-", "--format", "xyz", input=file.read())
        assert piped.stdout.splitlines()[1:] == text.splitlines()[1:], piped
    box = succeed("info", "shape:box")
    assert box["cloud"] is None and (box["up"], box["up_from"]) == ([0, 1, 0], "format")
    assert "  up          y, by the file's format\n" in run("info", "shape:box").stdout


def test_info_and_convert_say_which_textures_are_missing_or_damaged():
    with tempfile.TemporaryDirectory() as folder:
        triangle = struct.pack("<9f6f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1)
        path = os.path.join(folder, "a.gltf")
        with open(path, "w") as file:
            json.dump({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                       "buffers": [{"byteLength": len(triangle),
                                    "uri": "data:;base64," + base64.b64encode(triangle).decode()}],
                       "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
                       "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                                     {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
                       "images": [{"uri": "missing.png"}, {"uri": "broken.png"}],
                       "textures": [{"source": 0}, {"source": 1}],
                       "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}} for i in (0, 1)],
                       "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": i}
                                                  for i in (0, 1)]}]}, file)
        with open(os.path.join(folder, "broken.png"), "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n" + bytes(20))
        info = run("info", path)
        missing, broken = info.stderr.splitlines()
        assert info.returncode == 0 and "missing.png: " in missing and "; the texture is missing" in missing, info
        assert "broken.png: " in broken and "; the texture is missing" in broken, info
        convert = run("convert", path, "-o", os.path.join(folder, "a.glb"))
        missing, broken = convert.stderr.splitlines()
        assert convert.returncode == 0 and "missing.png: " in missing and "; the texture is missing" in missing, convert
        assert "broken.png: " in broken and "; it is copied as it is" in broken, convert
        # The picture is in the file then, as damaged as before.
        assert "; the texture is missing" in run("info", os.path.join(folder, "a.glb")).stderr
