"""seeds.py FOLDER: writes the seeds of every fuzz target, one folder each: small files that are read, and their ends.

A seed is a valid file of a format, so that the fuzzer begins where a reader is deep in its work.
"""
import base64
import json
import os
import random
import struct
import sys

TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def lines(*parts):
    return "\n".join(parts) + "\n"


def objs():
    vertices = [f"v {x} {y} {z}" for x, y, z in TETRAHEDRON]
    yield lines(*vertices, *(f"f {a + 1} {b + 1} {c + 1}" for a, b, c in FACES))
    yield lines("mtllib a.mtl", *vertices, "vt 0 0", "vn 0 0 1", "g a", "usemtl red", "f 1/1/1 2//1 3/1", "f -1 -2 -3 -4")
    yield lines(*(v + " 1 0.5 0" for v in vertices), "l 1 2", "s off", "f 1 2 \\", "3")


def plys():
    for form in ("ascii", "binary_little_endian", "binary_big_endian"):
        head = lines("ply", f"format {form} 1.0", "comment a", "element vertex 4", "property float x", "property float y",
                     "property float z", "property uchar red", "property uchar green", "property uchar blue",
                     "element face 4", "property list uchar int vertex_indices", "end_header")
        if form == "ascii":
            yield head + lines(*(f"{x} {y} {z} 255 0 9" for x, y, z in TETRAHEDRON), *(f"3 {a} {b} {c}" for a, b, c in FACES))
        else:
            order = "<" if "little" in form else ">"
            body = b"".join(struct.pack(order + "3f3B", *p, 255, 0, 9) for p in TETRAHEDRON)
            body += b"".join(struct.pack(order + "B3i", 3, *f) for f in FACES)
            yield head.encode() + body


def stls():
    facets = [[TETRAHEDRON[i] for i in face] for face in FACES]
    yield lines("solid a", *(line for f in facets for line in
                             ["facet normal 0 0 0", "outer loop", *(f"vertex {x} {y} {z}" for x, y, z in f), "endloop",
                              "endfacet"]), "endsolid a")
    yield b"a" * 80 + struct.pack("<I", 4) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *(c for p in f for c in p), 0) for f in facets)


def offs():
    vertices = [f"{x} {y} {z}" for x, y, z in TETRAHEDRON]
    yield lines("OFF", "4 4 0", *vertices, *(f"3 {a} {b} {c}" for a, b, c in FACES))
    yield lines("COFF # comment", "4 1 0", *(v + " 255 0 0 255" for v in vertices), "4 0 1 2 3 1 0 0")


def gltf_document(uri):
    positions = b"".join(struct.pack("<3f", *p) for p in TETRAHEDRON)
    indices = b"".join(struct.pack("<3H", *f) for f in FACES)
    buffer = {"byteLength": len(positions + indices)}
    if uri:
        buffer["uri"] = "data:application/octet-stream;base64," + base64.b64encode(positions + indices).decode()
    return positions + indices, {
        "asset": {"version": "2.0"}, "buffers": [buffer],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
                      {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"},
                      {"componentType": 5126, "count": 4, "type": "VEC3",
                       "sparse": {"count": 1, "indices": {"bufferView": 1, "componentType": 5123},
                                  "values": {"bufferView": 0}}}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]},
                   {"primitives": [{"attributes": {"POSITION": 2}, "mode": 5}]}],
        "nodes": [{"mesh": 0, "children": [1], "scale": [2, 1, 1]}, {"mesh": 1, "translation": [3, 0, 0]}],
        "scenes": [{"nodes": [0]}], "scene": 0}


def gltfs():
    yield json.dumps(gltf_document(True)[1])


def glbs():
    body, document = gltf_document(False)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(body), b"BIN\0") + body
    yield b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def clouds():
    yield lines(*(f"{x} {y} {0.1 * x * y}" for x in range(4) for y in range(4)))
    yield lines("# x y z i r g b nx ny nz", *(f"{x} {y} 0 0.5 255 {x} {y} 0 0 1" for x in range(3) for y in range(3)))
    yield lines("4", *(f"{x} {y} {z}" for x, y, z in TETRAHEDRON))


def scenes():
    yield json.dumps({"rimline_scene": 1, "models": [{"model": "shape:box"}]})
    yield json.dumps({"rimline_scene": 1, "up": [0, 0, 1],
                      "models": [{"model": "a.obj", "at": [1, 2, 3], "turn": ["x", 30], "scale": 2, "up": "auto"},
                                 {"model": "b.ply", "paint": "#c04020", "subdivide": 1}],
                      "lights": [{"sun": [1, 2, 3]}, {"lamp": [0, 5, 0]}],
                      "cameras": {"front": {"eye": [0, 0, 5], "target": [0, 0, 0], "fov": 30}},
                      "picture": {"style": "toon", "size": "64x64", "ground": True, "line-width": 2.5}})


def command_lines():
    for words in ("info a.obj --json", "silhouette a.obj --from 1,2,3 --direction 0,0,1 -o a.svg",
                  "draw a.obj --eye 1,2,3 --size 100x100 -o a.svg --crease 30", "track a.obj --step 0.5 --verify",
                  "origins a.obj -k 3", "field a.obj --slice z=0 -o a.png", "points a.xyz --from 1,2,3", "--help"):
        yield words.replace(" ", "\n")


def numbers():
    source = random.Random(1)
    for size in (40, 200, 1000):
        yield bytes(source.randrange(128) for _ in range(size))
        yield source.randbytes(size)


SEEDS = {"mesh_obj": objs, "mesh_ply": plys, "mesh_stl": stls, "mesh_off": offs, "mesh_gltf": gltfs, "mesh_glb": glbs,
         "point_file": clouds, "scene_file": scenes, "command_line": command_lines, "tracker": numbers, "lines": numbers,
         "umbrellas": numbers}


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for target, seeds in SEEDS.items():
        folder = os.path.join(sys.argv[1], target)
        os.makedirs(folder, exist_ok=True)
        for number, seed in enumerate(seeds()):
            data = seed.encode() if isinstance(seed, str) else seed
            with open(os.path.join(folder, f"seed_{number}"), "wb") as file:
                file.write(data)


if __name__ == "__main__":
    main()
