"""Output files are written whole or not at all, never over the model, and named by their format."""
import base64
import json
import os
import stat
import struct
import subprocess
import tempfile
import xml.etree.ElementTree

from program import PROGRAM, TRIANGLE, fail, have_device, png_size, read_file, run, skip, succeed, write_faces


def test_an_output_file_is_written_whole_or_not_at_all():
    with tempfile.TemporaryDirectory() as folder:
        view = ["silhouette", "shape:box", "--from", "3,2,1", "-o"]
        nowhere = os.path.join(folder, "no", "such", "a.obj")
        assert nowhere in fail(1, *view, nowhere)
        os.mkdir(os.path.join(folder, "a.obj"))
        assert "folder" in fail(1, *view, os.path.join(folder, "a.obj"))
        assert os.listdir(folder) == ["a.obj"]
        # What fails after the output was opened leaves the old one as it was, and nothing beside it.
        old = os.path.join(folder, "b.obj")
        with open(old, "w") as file:
            file.write("old")
        fail(1, "silhouette", os.path.join(folder, "gone.obj"), "--from", "3,2,1", "-o", old)
        with open(old) as file:
            assert file.read() == "old"
        assert sorted(os.listdir(folder)) == ["a.obj", "b.obj"]
        assert run(*view, old).returncode == 0
        assert sorted(os.listdir(folder)) == ["a.obj", "b.obj"]
        assert stat.S_ISREG(os.stat(old).st_mode)


def test_an_output_may_have_the_longest_name():
    with tempfile.TemporaryDirectory() as folder:
        for name in ("b" * 251 + ".svg", "\u00e4" * 125 + "b.svg", "\u4e00" * 83 + "a.svg"):
            assert len(os.fsencode(name)) >= 254
            path = os.path.join(folder, name)
            for _ in range(2):
                assert run("draw", "shape:box", "-o", path).returncode == 0, name
            assert os.listdir(folder) == [name]
            os.remove(path)


def test_no_output_takes_the_place_of_the_model():
    with tempfile.TemporaryDirectory() as folder:
        obj = write_faces(os.path.join(folder, "a.obj"), TRIANGLE)
        png = os.path.join(folder, "a.png")
        os.symlink("a.obj", png)
        ply = os.path.join(folder, "a.ply")
        with open(ply, "w") as file:
            file.write("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                       "property float z\nend_header\n0 0 0\n")
        before = {path: read_file(path) for path in (obj, ply)}
        for arguments in (["silhouette", obj, "--from", "3,2,1", "-o", obj], ["field", obj, "--slice", "z=0", "-o", png],
                          ["origins", obj, "-o", png], ["points", obj, "--as-points", "-o", png],
                          ["points", ply, "--export", ply]):
            assert "is the model itself" in fail(2, *arguments), arguments
        assert {path: read_file(path) for path in (obj, ply)} == before
        assert sorted(os.listdir(folder)) == ["a.obj", "a.ply", "a.png"]


def test_no_output_takes_the_place_of_what_the_model_refers_to():
    with tempfile.TemporaryDirectory() as folder:
        at = lambda name: os.path.join(folder, name)
        for name in ("wood.png", "unused.png"):
            with open(at(name), "w") as file:
                file.write("no picture; it is not even read")
        with open(at("a.mtl"), "w") as file:
            file.write("newmtl wood\nmap_Kd wood.png\nnewmtl other\nmap_Kd unused.png\n")
        with open(at("a.obj"), "w") as file:
            file.write("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl wood\nf 1/1 2/1 3/1\n")
        os.symlink("a.mtl", at("link.svg"))
        with open(at("a.gltf"), "w") as file:
            json.dump({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                       "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
                       "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
                       "textures": [{"source": 0}], "images": [{"uri": "wood.png"}],
                       "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64," + base64.b64encode(
                           struct.pack("<15f", 0, 0, 0, 1, 0, 0, 0, 1, 0, *[0] * 6)).decode()}],
                       "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
                       "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                                      "min": [0, 0, 0], "max": [1, 1, 0]},
                                     {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}]}, file)
        names = sorted(os.listdir(folder))
        before = {name: read_file(at(name)) for name in names}
        slice_of = lambda model, name: ["field", at(model), "--slice", "z=0", "--resolution", "16", "-o", at(name)]
        for arguments in (slice_of("a.obj", "wood.png"), slice_of("a.obj", "unused.png"), slice_of("a.gltf", "wood.png"),
                          ["points", at("a.obj"), "--as-points", "-o", at("unused.png")],
                          ["points", at("a.gltf"), "--as-points", "-o", at("wood.png")],
                          ["silhouette", at("a.obj"), "--from", "3,2,1", "-o", at("link.svg")]):
            assert "the model refers to this file" in fail(2, *arguments), arguments
        assert sorted(os.listdir(folder)) == names
        assert {name: read_file(at(name)) for name in names} == before
        assert run(*slice_of("a.obj", "new.png")).returncode == 0


def test_a_failed_write_is_blamed_on_the_file():
    if not os.path.exists("/dev/full"):
        skip("no /dev/full")
    with tempfile.TemporaryDirectory() as folder:
        png, svg = os.path.join(folder, "a.png"), os.path.join(folder, "a.svg")
        for name in (png, svg):
            os.symlink("/dev/full", name)
        commands = [["field", "shape:box", "--slice", "z=0", "-o", png], ["origins", "shape:box", "-o", png],
                    ["silhouette", "shape:box", "--from", "3,2,1", "-o", svg], ["draw", "shape:box", "-o", svg]]
        for arguments in commands:
            assert fail(1, *arguments) == f"rimline: error: {arguments[-1]}: cannot write: No space left on device"


def test_names_are_escaped_where_they_are_shown():
    with tempfile.TemporaryDirectory() as folder:
        name = os.fsencode(folder) + b"/a\x1b[2J\xffb\xc3\xa4<]]>.obj"
        write_faces(name, TRIANGLE)
        shown = folder + "/a\\x1b[2J\\xffb\u00e4<]]>.obj"
        result = subprocess.run([PROGRAM, "info", name + b".gone"], capture_output=True, timeout=60)
        assert result.stderr.decode().startswith(f"rimline: error: {shown}.gone: "), result.stderr
        result = subprocess.run([PROGRAM, "info", name, "--json"], capture_output=True, timeout=60)
        said = json.loads(result.stdout.decode())["model"]
        # JSON has an escape of its own for control characters.
        assert said in (shown, shown.replace("\\x1b", "\x1b")), said
        for arguments in (["draw", name, "-o", "-"], ["silhouette", name, "--from", "3,2,1", "-o", "-"]):
            result = subprocess.run([PROGRAM, *arguments], capture_output=True, timeout=60)
            title = xml.etree.ElementTree.fromstring(result.stdout).find("{http://www.w3.org/2000/svg}title")
            assert shown in title.text, title.text
        result = subprocess.run([PROGRAM, "draw", name, "-o", "-", "--as", "json"], capture_output=True, timeout=60)
        assert json.loads(result.stdout.decode())["model"] == shown


def test_an_output_is_called_as_what_it_holds():
    with tempfile.TemporaryDirectory() as folder:
        obj = write_faces(os.path.join(folder, "a.obj"), TRIANGLE)
        before = read_file(obj)
        cloud = ["points", "shape:box", "--as-points"]
        for name in (obj, os.path.join(folder, "z.txt"), ""):
            for arguments in (["field", obj, "--slice", "z=0", "-o"], ["field", obj, "--at", "0,0,0", "-o"],
                              ["origins", obj, "-o"], [*cloud, "-o"]):
                assert f"-o: expected FILE.png, not '{name}'" in fail(2, *arguments, name), arguments
            assert f"--export: expected FILE.ply, not '{name}'" in fail(2, *cloud, "--export", name)
        assert "-o: expected a name that ends in .obj, .ply or .svg, not ''" in fail(
            2, "silhouette", "shape:box", "--from", "3,2,1", "-o", "")
        # Two outputs of one name, which only what is no regular file can have, or links.
        os.symlink("both.dat", os.path.join(folder, "a.png"))
        os.symlink("both.dat", os.path.join(folder, "a.ply"))
        open(os.path.join(folder, "both.dat"), "w").close()
        for drawn, exported in (("a.png", "a.ply"), ("/dev/null", "/dev/null"), ("b.ply", "b.ply")):
            fail(2, *cloud, "-o", os.path.join(folder, drawn), "--export", os.path.join(folder, exported))
        assert read_file(obj) == before and sorted(os.listdir(folder)) == ["a.obj", "a.ply", "a.png", "both.dat"]
        drawing = ["field", "shape:box", "--slice", "z=0", "--resolution", "16", "-o", "/dev/stdout"]
        with open(os.path.join(folder, "both.dat"), "wb") as file:
            assert subprocess.run([PROGRAM, *drawing], stdout=file, timeout=60).returncode == 0
        assert png_size(os.path.join(folder, "both.dat"))[1] > 16
    # A pipe has no ending; here it has no name either.
    result = subprocess.run(["sh", "-c", '"$0" field shape:box --slice z=0 --resolution 16 --json -o /dev/stderr 2>&1 >/dev/null | cat',
                             PROGRAM], stdout=subprocess.PIPE, timeout=60)
    assert result.stdout.startswith(b"\x89PNG") and result.stdout.endswith(b"IEND\xaeB`\x82"), result.stdout[:200]


def test_pictures_are_called_as_pictures():
    have_device()
    commands = [["render", "shape:box", "-o"]]
    if "not in this build" not in run("--help").stdout:
        commands.append(["view", "shape:box", "--frames", "1", "--screenshot"])
    with tempfile.TemporaryDirectory() as folder:
        obj = write_faces(os.path.join(folder, "a.obj"), TRIANGLE)
        png = os.path.join(folder, "a.png")
        os.symlink("a.obj", png)
        before = read_file(obj)
        for command in commands:
            for name in (obj, os.path.join(folder, "w.txt"), ""):
                assert f"{command[-1]}: expected FILE.png, not '{name}'" in fail(2, *command, name)
            assert "is the model itself" in fail(2, command[0], obj, *command[2:], png)
        assert read_file(obj) == before and sorted(os.listdir(folder)) == ["a.obj", "a.png"]
        assert run("render", "shape:box", "--size", "16x16", "-o", "/dev/null").returncode == 0


def test_places_far_from_the_origin_are_printed_apart_from_each_other():
    with tempfile.TemporaryDirectory() as folder:
        far = [tuple(100 * c + 3e6 for c in corner) for corner in TRIANGLE]
        one = os.path.join(folder, "far.obj")
        with open(one, "w") as file:
            file.writelines("v %.9g %.9g %.9g\n" % corner for corner in far)
            file.write("f 1 2 3\n")

        def shown(place):
            return ",".join("%.9g" % c for c in place)
        arguments = ["views", one, "-k", "1", "--no-ratio"]
        eye = succeed(*arguments)["views"][0]["eye"]
        assert f"from {shown(eye)}  score" in run(*arguments).stdout
        arguments = ["field", one, "--slice", "z=1", "--resolution", "16", "-o", os.path.join(folder, "a.png")]
        greatest = succeed(*arguments)["slice"]["greatest_at"]
        assert f", at {shown(greatest)}\n" in run(*arguments).stdout
