"""rimline convert, read by a small reader of GLB that shares nothing with the program's."""
import json
import math
import os
import re
import struct
import tempfile
import zlib

from program import fail, read_file, run, succeed

EXTENSION = "EXT_mesh_primitive_edge_visibility"
HIDDEN, SILHOUETTE, HARD, REPEATED = range(4)


class Glb:
    def __init__(self, path):
        data = read_file(path)
        magic, version, length, json_length, json_kind = struct.unpack("<4sIII4s", data[:20])
        assert (magic, version, length, json_kind) == (b"glTF", 2, len(data), b"JSON")
        assert json_length % 4 == 0
        self.document = json.loads(data[20:20 + json_length])
        binary_length, kind = struct.unpack("<I4s", data[20 + json_length:28 + json_length])
        assert kind == b"BIN\0" and binary_length % 4 == 0
        self.binary = data[28 + json_length:]
        assert len(self.binary) == binary_length
        assert self.document["asset"]["version"] == "2.0"
        for view in self.document["bufferViews"]:
            assert view["byteOffset"] % 4 == 0 and view["byteOffset"] + view["byteLength"] <= binary_length

    def elements(self, number):
        """The elements of an accessor: tuples, or numbers."""
        accessor = self.document["accessors"][number]
        view = self.document["bufferViews"][accessor["bufferView"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[accessor["type"]]
        form = f"<{width}" + {5120: "b", 5121: "B", 5123: "H", 5125: "I", 5126: "f"}[accessor["componentType"]]
        size = struct.calcsize(form)
        stride = view.get("byteStride", size)
        assert (accessor["count"] - 1) * stride + size <= view["byteLength"]
        found = [struct.unpack_from(form, self.binary, view["byteOffset"] + i * stride) for i in range(accessor["count"])]
        return found if width > 1 else [element[0] for element in found]

    def primitives(self):
        return self.document["meshes"][0]["primitives"]

    def edges(self):
        """The class of each edge, a pair of positions, and the unit normals of those on silhouettes. Checks the rules of
        the extension."""
        codes, normals = {}, {}
        for primitive in self.primitives():
            positions = self.elements(primitive["attributes"]["POSITION"])
            indices = self.elements(primitive["indices"])
            extension = primitive["extensions"][EXTENSION]
            bits = self.elements(extension["visibility"])
            assert len(bits) == math.ceil(6 * (len(indices) // 3) / 8) and any(bits)
            pairs = self.elements(extension["silhouetteNormals"]) if "silhouetteNormals" in extension else []
            given = 0
            for i, start in enumerate(indices):
                end = indices[i + 1 if i % 3 < 2 else i - 2]
                code = bits[i // 4] >> (i % 4 * 2) & 3
                edge = tuple(sorted((positions[start], positions[end])))
                codes.setdefault(edge, []).append(code)
                if code == SILHOUETTE:
                    normals[edge] = [unit(n) for n in pairs[given:given + 2]]
                    given += 2
            assert given == len(pairs)
            assert len(indices) % 4 == 0 or bits[-1] >> (len(indices) % 4 * 2) == 0
        classes = {}
        for edge, found in codes.items():
            classes[edge] = max(min(code, HARD) for code in found)
            expected = {HIDDEN: [HIDDEN], SILHOUETTE: [SILHOUETTE], HARD: [HARD]}[classes[edge]]
            expected += [REPEATED if classes[edge] == HARD else HIDDEN] * (len(found) - 1)
            assert sorted(found) == sorted(expected), (edge, found)
        return classes, normals


def unit(vector):
    length = math.hypot(*vector)
    return tuple(c / length for c in vector)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def less(a, b):
    return tuple(x - y for x, y in zip(a, b))


def expected_edges(glb, crease_degrees):
    """Class and normals of each edge, by the positions and triangles of the file."""
    faces = {}
    for primitive in glb.primitives():
        positions = glb.elements(primitive["attributes"]["POSITION"])
        indices = glb.elements(primitive["indices"])
        for i in range(0, len(indices), 3):
            a, b, c = (positions[v] for v in indices[i:i + 3])
            normal = unit(cross(less(b, a), less(c, a)))
            for edge in ((a, b), (b, c), (c, a)):
                faces.setdefault(tuple(sorted(edge)), []).append(normal)
    classes = {}
    for edge, normals in faces.items():
        if len(normals) != 2:
            classes[edge] = HARD
            continue
        bend = math.degrees(math.atan2(math.hypot(*cross(*normals)), sum(x * y for x, y in zip(*normals))))
        classes[edge] = HARD if bend >= crease_degrees else SILHOUETTE if bend > 1e-3 else HIDDEN
    return classes, faces


def counts_of(classes):
    found = list(classes.values())
    return {"hidden": found.count(HIDDEN), "silhouette": found.count(SILHOUETTE), "hard": found.count(HARD)}


def test_convert_turns_models_to_stand_on_y():
    with tempfile.TemporaryDirectory() as folder:
        lying, path = os.path.join(folder, "pyramid.obj"), os.path.join(folder, "a.glb")
        with open(lying, "w") as file:
            file.write("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 2\n"
                       "f 1 3 2\nf 1 4 3\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n")
        for options, up, source, bounds in (((), [0, 0, 1], "mesh", [[-1, 0, -1], [1, 2, 1]]),
                                            (("--up", "y"), [0, 1, 0], "option", [[-1, -1, 0], [1, 1, 2]]),
                                            (("--up", "-x"), [-1, 0, 0], "option", None)):
            found = succeed("convert", lying, "-o", path, *options)
            assert found["up"] == up and found["up_from"] == source
            read = succeed("info", path)["bounds"]
            assert bounds is None or read == bounds
            assert sorted(high - low for low, high in zip(*read)) == [2, 2, 2]
        fail(2, "convert", lying, "-o", path, "--up", "1,1,0")
        assert succeed("convert", lying, "-o", path, "--up", "0,0,1")["up"] == [0, 0, 1]
        assert re.search(r"--up AXIS\|auto ", run("convert", "--help").stdout)


def test_convert_writes_the_class_of_every_edge():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.glb")
        for shape, crease in (("terrain:600", "25"), ("box:300", "30"), ("knot:900", "40"), ("sphere:300", "180")):
            for kind, tolerance in (("bytes", 0.012), ("floats", 1e-6)):
                found = succeed("convert", f"shape:{shape}", "-o", path, "--edges", "--crease", crease, "--normals", kind)
                glb = Glb(path)
                assert glb.document["extensionsUsed"] == [EXTENSION]
                classes, normals = glb.edges()
                expected, faces = expected_edges(glb, float(crease))
                assert classes == expected, shape
                assert found["edge_visibility"] == counts_of(classes) and found["bytes"] == os.path.getsize(path)
                assert set(normals) == {edge for edge in classes if classes[edge] == SILHOUETTE}
                for edge, pair in normals.items():
                    true = faces[edge]
                    assert min(max(map(math.dist, pair, order)) for order in (true, true[::-1])) < tolerance, edge
                assert succeed("info", path)["edge_visibility"] == counts_of(classes)
        assert all(counts_of(classes)[name] == 0 for name in ("hidden", "hard")) and len(normals) > 300


def test_convert_keeps_the_classes_of_a_file():
    with tempfile.TemporaryDirectory() as folder:
        first, second, plain = (os.path.join(folder, name) for name in ("a.glb", "b.glb", "c.glb"))
        written = succeed("convert", "shape:scene:2000", "-o", first, "--edges", "--crease", "50")
        kept = succeed("convert", first, "-o", second)
        assert kept["edge_visibility"] == written["edge_visibility"] and read_file(first) == read_file(second)
        again = succeed("convert", first, "-o", second, "--edges", "--crease", "20")
        assert again["edge_visibility"]["hard"] > written["edge_visibility"]["hard"]
        text = run("info", first).stdout
        assert f"{written['edge_visibility']['hard']} hard edges" in text, text
        assert succeed("convert", "shape:scene:2000", "-o", plain)["edge_visibility"] is None
        assert EXTENSION.encode() not in read_file(plain) and succeed("info", plain)["edge_visibility"] is None
        assert "drawn" not in run("info", plain).stdout
        faces = succeed("info", "shape:scene:2000")["faces"]
        assert all(succeed("info", path)["faces"] == faces for path in (first, second, plain))


def write_png(path):
    """A red pixel."""
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", 1, 1, 8, 2, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(b"\0\xff\0\0")) + chunk(b"IEND", b""))


def test_convert_keeps_base_colors_and_textures_and_says_what_it_leaves_out():
    with tempfile.TemporaryDirectory() as folder:
        model, textured = os.path.join(folder, "a.obj"), os.path.join(folder, "b.obj")
        with open(os.path.join(folder, "a.mtl"), "w", encoding="ascii") as file:
            file.write("newmtl red\nKd 1 0 0\nnewmtl white\nKd 1 1 1\n")
        points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\n"
        with open(model, "w", encoding="ascii") as file:
            file.write("mtllib a.mtl\n" + points + "f 1 2 3\nusemtl red\nf 1 3 4\nusemtl white\nf 1 4 2\n")
        path = os.path.join(folder, "a.glb")
        found = succeed("convert", model, "-o", path, "--edges", "--crease", "179")
        glb = Glb(path)
        colors = [material["pbrMetallicRoughness"]["baseColorFactor"] for material in glb.document["materials"]]
        assert colors == [[1, 0, 0, 1], [1, 1, 1, 1]]
        assert [primitive.get("material") for primitive in glb.primitives()] == [None, 0, 1]
        # Edges between primitives have their class in one of them.
        classes, normals = glb.edges()
        assert counts_of(classes) == found["edge_visibility"] == {"hidden": 0, "silhouette": 3, "hard": 3}
        assert len(normals) == 3
        with open(os.path.join(folder, "b.mtl"), "w", encoding="ascii") as file:
            file.write("newmtl a\nmap_Kd a.png\n")
        with open(textured, "w", encoding="ascii") as file:
            file.write("mtllib b.mtl\n" + points + "vt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n")
        result = run("convert", textured, "-o", path)
        assert result.returncode == 0 and "a.png" in result.stderr and "texture is missing" in result.stderr, result
        assert "images" not in Glb(path).document
        picture = os.path.join(folder, "a.png")
        write_png(picture)
        result = run("convert", textured, "-o", path)
        assert result.returncode == 0 and not result.stderr, result
        glb = Glb(path)
        image = glb.document["images"][0]
        view = glb.document["bufferViews"][image["bufferView"]]
        assert image["mimeType"] == "image/png"
        assert glb.binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]] == read_file(picture)
        assert glb.elements(glb.primitives()[0]["attributes"]["TEXCOORD_0"]) == [(0, 1), (1, 1), (0, 0)]
        assert succeed("info", path)["textures"] == [f"{path}: images[0]"]


def linear(srgb):
    """Of a byte."""
    c = srgb / 255
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4


def corner_colors(glb):
    """The position and the color of each corner: the base color times COLOR_0."""
    found = []
    for primitive in glb.primitives():
        positions = glb.elements(primitive["attributes"]["POSITION"])
        colors = glb.elements(primitive["attributes"]["COLOR_0"])
        assert len(colors) == len(positions)
        base = glb.document["materials"][primitive["material"]]["pbrMetallicRoughness"]["baseColorFactor"]
        for v in glb.elements(primitive["indices"]):
            found.append((positions[v], tuple(b * c for b, c in zip(base, colors[v]))))
    return found


def test_convert_keeps_colors_of_vertices_and_faces():
    """Of each format: COLOR_0 is linear, the other formats are sRGB. What is written is read again as it was."""
    points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    bytes_of_vertices = [(255, 51, 0), (0, 255, 9), (1, 2, 3), (255, 255, 255)]
    bytes_of_faces = [(200, 100, 50), (20, 40, 80)]
    faces = [(0, 1, 2), (0, 2, 3)]
    line = lambda *numbers: " ".join(map(str, numbers)) + "\n"
    vertices = "".join(line(*p, *c) for p, c in zip(points, bytes_of_vertices))
    plain = "".join(line(*p) for p in points)
    plain_faces = "".join(line(3, *f) for f in faces)
    colored_faces = "".join(line(3, *f, *c) for f, c in zip(faces, bytes_of_faces))
    channels = "property uchar {0}red\nproperty uchar {0}green\nproperty uchar {0}blue\n"
    ply = ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n{}"
           "element face 2\nproperty list uchar int vertex_indices\n{}end_header\n")
    of_vertex = lambda face, corner: bytes_of_vertices[faces[face][corner]]
    of_face = lambda face, corner: bytes_of_faces[face]
    bits = lambda color: 0x8000 | sum((c >> 3) << shift for c, shift in zip(color, (10, 5, 0)))
    stl = b" " * 80 + struct.pack("<I", 2) + b"".join(
        struct.pack("<12fH", 0, 0, 1, *(x for v in f for x in points[v]), bits(c)) for f, c in zip(faces, bytes_of_faces))
    models = (("a.off", "COFF\n4 2 0\n" + vertices + plain_faces, of_vertex),
              ("b.off", "OFF\n4 2 0\n" + plain + colored_faces, of_face),
              ("a.ply", ply.format(channels.format("diffuse_"), "") + vertices + plain_faces, of_vertex),
              ("b.ply", ply.format("", channels.format("")) + plain + colored_faces, of_face),
              ("a.obj", "".join("v " + line(*p, *c) for p, c in zip(points, bytes_of_vertices)) +
               "".join("f " + line(*(v + 1 for v in f)) for f in faces), of_vertex),
              ("a.stl", stl, lambda face, corner: [(c >> 3) * 255 / 31 for c in bytes_of_faces[face]]))
    with tempfile.TemporaryDirectory() as folder:
        first, second = os.path.join(folder, "first.glb"), os.path.join(folder, "second.glb")
        for name, text, color_of in models:
            path = os.path.join(folder, name)
            with open(path, "wb") as file:
                file.write(text if isinstance(text, bytes) else text.encode("ascii"))
            result = run("convert", path, "-o", first, "--up", "y", "--edges")
            assert result.returncode == 0 and not result.stderr, (name, result)
            found = corner_colors(Glb(first))
            assert len(found) == 6
            for i, (position, color) in enumerate(found):
                assert position == points[faces[i // 3][i % 3]], name
                expected = [linear(c) for c in color_of(i // 3, i % 3)]
                assert all(abs(c - e) < 1e-6 for c, e in zip(color, expected)), (name, i, color, expected)
            # The copies of vertices are one vertex again, and all is written as it was read.
            assert succeed("info", first)["vertices"] == 4, name
            succeed("convert", first, "-o", second)
            assert corner_colors(Glb(second)) == found and read_file(first) == read_file(second), name


def test_convert_refuses_what_it_cannot_write():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.glb")
        assert "--output" in fail(2, "convert", "shape:box")
        assert ".glb" in fail(2, "convert", "shape:box", "-o", os.path.join(folder, "a.gltf"))
        assert "--edges" in fail(2, "convert", "shape:box", "-o", path, "--crease", "30")
        fail(2, "convert", "shape:box", "-o", path, "--edges", "--crease", "0")
        fail(2, "convert", "shape:box", "-o", path, "--normals", "halves")
        fail(1, "convert", os.path.join(folder, "gone.obj"), "-o", path)
        assert not os.listdir(folder)
        succeed("convert", "shape:box", "-o", path, "--edges")
        fail(2, "convert", path, "-o", path)
        # Faults in what is read are errors with their place, and nothing is written.
        bad, output = os.path.join(folder, "bad.glb"), os.path.join(folder, "out.glb")
        whole = read_file(path)
        with open(bad, "wb") as file:
            file.write(whole.replace(b'"visibility":2', b'"visibility":1'))
        assert read_file(bad) != whole
        message = fail(1, "convert", bad, "-o", output)
        assert "bad.glb: accessors[1]: should be of type SCALAR and of bytes" in message, message
        assert not os.path.exists(output)
