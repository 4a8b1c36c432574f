"""The pictures of docs/gallery.md and their commands.

    gallery.py draw PROGRAM     draws them into docs/gallery/ and writes docs/gallery.md
    gallery.py check PROGRAM    draws them into a temporary folder and compares: text exactly, pictures but for noise

Pictures are drawn by Mesa's lavapipe; another device rounds otherwise.
"""

import os
import pathlib
import shlex
import subprocess
import sys
import tempfile
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
# The mean difference of channels, of 255, that versions of the driver make, and the share of pixels that differ by more
# than a quarter of the range.
MEAN_DIFFERENCE = 1.0
FAR_PIXELS = 0.005

SIZE = "--size 640x480"
PICTURES = [
    ("Ink, with shadows", "scene_ink.png", f"render shape:scene --ground {SIZE}"),
    ("Toon", "knot_toon.png", f"render shape:knot:30000 --style toon --palette sea --ground --eye 2.5,2,4 {SIZE}"),
    ("Hatching", "spring_hatch.png", f"render shape:spring:20000 --style hatch --ground {SIZE}"),
    ("A blueprint with hidden lines", "scene_blueprint.png", f"render shape:scene --style blueprint --hidden {SIZE}"),
    ("A mask of light and shadow", "scene_mask.png", f"render shape:scene --style mask --ground --light 3,5,4 {SIZE}"),
    ("Three-point lighting", "torus_three_point.png",
     f"render shape:torus:20000 --style toon --lighting three-point --ground {SIZE}"),
    ("A transparent background", "spring_transparent.png",
     f"render shape:spring:20000 --background none --line-width 3 --color #e8b04a {SIZE}"),
    ("Several models in one scene", "several.png",
     f"render shape:knot:20000 shape:box --at 3,0.2,0 --turn 30 --paint #c86b5a shape:torus:8000 --at -3,0,0.5 "
     f"--paint #5a8fc8 --ground {SIZE}"),
    ("A vector drawing", "knot.svg", "draw shape:knot:20000 --eye 2,1,5 --hidden dashed --page 160x120"),
    ("A drawing sheet", "sheet.svg", "draw shape:scene --views front,top,right,iso --hidden dashed --page 160x120"),
    ("Best views", "views", "views shape:scene -k 4 --size 400x300"),
    ("Borders of a point cloud", "terrain_points.png",
     "points shape:terrain:4000 --as-points --up 0,1,0 --size 640x480"),
    ("Origins of Hough spaces", "origins.png", "origins shape:scene -k 3"),
    ("A tangential distance field", "field.png", "field shape:knot:20000 --function views --slice y=0 --resolution 480"),
]


def shown_file(name):
    return f"{name}/contact_sheet.png" if "." not in name else name


def draw(program, folder):
    for _, name, command in PICTURES:
        words = [program, *shlex.split(command, comments=False), "-o", str(folder / name)]
        result = subprocess.run(words, capture_output=True, text=True, env={**os.environ, "RIMLINE_DEVICE": "cpu"})
        if result.returncode != 0:
            sys.exit(f"gallery.py: {shlex.join(words)}: {result.stderr}")


def page():
    lines = ["# Gallery", "", "Each picture with the command that makes it. All models are built-in shapes; take a file in their",
             "place. `docs/site/gallery.py` draws this page.", ""]
    for title, name, command in PICTURES:
        lines += [f"## {title}", "", "<!-- not run: docs/site/gallery.py runs it -->", "```sh",
                  f"build/release/rimline {command.replace('#', chr(92) + '#')} -o {name}", "```", "",
                  f"![{title}](gallery/{shown_file(name)})", ""]
    return "\n".join(lines)


def pixels(path):
    """Width, height, and the bytes of the pixels of a PNG of 8 bits a channel, without interlace."""
    data = path.read_bytes()
    place, packed = 8, b""
    while place < len(data):
        size, kind = int.from_bytes(data[place : place + 4], "big"), data[place + 4 : place + 8]
        body = data[place + 8 : place + 8 + size]
        if kind == b"IHDR":
            width, height = int.from_bytes(body[:4], "big"), int.from_bytes(body[4:8], "big")
            channels = {0: 1, 2: 3, 4: 2, 6: 4}[body[9]]
        elif kind == b"IDAT":
            packed += body
        place += 12 + size
    raw, stride = zlib.decompress(packed), width * channels
    rows, before = bytearray(), bytearray(stride)
    for y in range(height):
        start = y * (stride + 1)
        kind, row = raw[start], bytearray(raw[start + 1 : start + 1 + stride])
        for x in range(stride):
            left = row[x - channels] if x >= channels else 0
            up = before[x]
            corner = before[x - channels] if x >= channels else 0
            if kind == 1:
                row[x] = (row[x] + left) & 255
            elif kind == 2:
                row[x] = (row[x] + up) & 255
            elif kind == 3:
                row[x] = (row[x] + (left + up) // 2) & 255
            elif kind == 4:
                guess = left + up - corner
                a, b, c = abs(guess - left), abs(guess - up), abs(guess - corner)
                row[x] = (row[x] + (left if a <= b and a <= c else up if b <= c else corner)) & 255
        rows += row
        before = row
    return width, height, bytes(rows)


def fault(name, kept, drawn):
    if not kept.is_file():
        return f"{name} is not checked in"
    if kept.read_bytes() == drawn.read_bytes():
        return ""
    if kept.suffix != ".png":
        return f"{name} differs"
    first, second = pixels(kept), pixels(drawn)
    if first[:2] != second[:2] or len(first[2]) != len(second[2]):
        return f"{name} has another size"
    differences = [abs(a - b) for a, b in zip(first[2], second[2]) if a != b]
    mean, far = sum(differences) / len(first[2]), sum(d > 64 for d in differences) / len(first[2])
    return f"{name} differs: {mean:.2f} in the mean" if mean > MEAN_DIFFERENCE or far > FAR_PIXELS else ""


def main():
    action, program = sys.argv[1:]
    program = str(pathlib.Path(program).resolve())
    devices = subprocess.run([program, "devices", "--json"], capture_output=True, text=True)
    if "llvmpipe" not in devices.stdout:
        print("SKIPPED: no lavapipe, which drew the gallery")
        return 77
    gallery = ROOT / "docs/gallery"
    if action == "draw":
        gallery.mkdir(exist_ok=True)
        draw(program, gallery)
        for _, name, _ in PICTURES:
            for extra in (gallery / name).glob("view_*.png") if "." not in name else ():
                extra.unlink()
        (ROOT / "docs/gallery.md").write_text(page())
        return 0
    faults = [] if (ROOT / "docs/gallery.md").read_text() == page() else ["docs/gallery.md is not what gallery.py writes"]
    with tempfile.TemporaryDirectory() as folder:
        draw(program, pathlib.Path(folder))
        for _, name, _ in PICTURES:
            file = shown_file(name)
            faults.append(fault(file, gallery / file, pathlib.Path(folder) / file))
    faults = [line for line in faults if line]
    print("\n".join(faults) or f"{len(PICTURES)} pictures are as they were")
    return 1 if faults else 0


sys.exit(main())
