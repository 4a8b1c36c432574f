"""Runs the rimline program as its users do, and checks what several test files check.

run_case.py starts the cases; its first argument is the program.
"""
import json
import math
import os
import resource
import shlex
import struct
import subprocess
import sys
import time
import zlib

PROGRAM = os.path.abspath(sys.argv[1])
COMMANDS = ("render", "animate", "info", "silhouette", "draw", "track", "views", "path", "light", "origins",
            "field", "points", "convert", "batch", "bench", "view", "devices")


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=500, **options)


def succeed(*arguments):
    """Runs with --json and returns the object."""
    result = run(*arguments, "--json")
    assert result.returncode == 0, (arguments, result.returncode, result.stderr)
    assert result.stderr == "", result.stderr  # No progress where there is no terminal.
    assert result.stdout.count("\n") == 1 and result.stdout.endswith("\n")
    return json.loads(result.stdout)


def fail(status, *arguments):
    """Runs, checks the status, that standard output is empty, and returns the one line of the error."""
    result = run(*arguments)
    assert result.returncode == status, (arguments, result.returncode, result.stderr)
    assert result.stdout == "", (arguments, result.stdout)
    lines = result.stderr.splitlines()
    assert len(lines) == 1 and lines[0].startswith("rimline: error: "), (arguments, result.stderr)
    return lines[0]


def limit_memory(size):
    """For `preexec_fn`: the process gets `size` bytes of address space."""
    return lambda: resource.setrlimit(resource.RLIMIT_AS, (size, size))


def starts_within(size):
    """Whether the program starts with `size` bytes of address space: sanitizers reserve more before it begins."""
    return run("--version", preexec_fn=limit_memory(size)).returncode == 0


def fail_for_memory(*arguments):
    """Runs with 3 GiB of address space, which pictures of 16384x16384 exceed, and checks the error. Does nothing
    where the program does not start with as much."""
    limit = 3 << 30
    if not starts_within(limit):
        return
    result = run(*arguments, "--size", "16384x16384", preexec_fn=limit_memory(limit))
    assert result.returncode == 1, (arguments, result.returncode, result.stderr)
    assert result.stderr.startswith("rimline: error: ") and "picture" in result.stderr, result.stderr


def skip(reason):
    """Ends the case as skipped; `reason` names what is missing."""
    print(f"SKIPPED: {reason}")
    sys.exit(77)


def model(name):
    """The path of a real model; skips the case where no folder of RIMLINE_MODELS has it."""
    for folder in os.environ.get("RIMLINE_MODELS", "").split(":"):
        path = os.path.join(folder, name)
        if folder and os.path.exists(path):
            return path
    skip(f"{name} is in no folder of RIMLINE_MODELS")


def has_methods():
    return "Not in this build:" not in run("silhouette", "--help").stdout


def have_methods():
    """Skips the case where the program was built without the other silhouette methods."""
    if not has_methods():
        skip("built without the other silhouette methods")


def is_count(value):
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0


def is_vector(value):
    return len(value) == 3 and all(isinstance(x, (int, float)) and math.isfinite(x) for x in value)


def check_silhouette(found):
    assert all(is_count(found[k]) for k in ("vertices", "faces", "count", "borders"))
    assert set(found["counters"]) == {"box_checks", "face_checks", "edge_checks"}
    assert found["ms"] >= 0
    edges = found["edges"]
    assert len(edges) == found["count"]
    assert edges == sorted(edges) and all(a < b for a, b in edges)
    assert len(set(map(tuple, edges))) == len(edges)


def check_track(result, frame_count):
    keys = ("flips", "added", "removed", "silhouette", "box_checks", "face_checks")
    frames, totals = result["frames"], result["totals"]
    assert len(frames) == frame_count
    for frame in frames:
        assert all(is_count(frame[k]) for k in keys) and frame["us"] >= 0
    for key in keys:
        assert totals[key] == sum(frame[key] for frame in frames), key
    assert math.isclose(totals["us"], sum(frame["us"] for frame in frames), rel_tol=1e-9)
    assert totals["max_us"] == max(frame["us"] for frame in frames)
    for before, after in zip(frames, frames[1:]):
        assert after["silhouette"] - before["silhouette"] == after["added"] - after["removed"]
    assert frames[0]["flips"] == frames[0]["added"] == frames[0]["removed"] == 0


def read_file(path):
    with open(path, "rb") as file:
        return file.read()


def have_device():
    """Skips the case where the program was built without the engine or finds no device."""
    found = run("devices")
    if found.returncode != 0:
        # Any other error fails the case.
        assert found.returncode == 1 and found.stderr.count("\n") == 1, found.stderr
        assert "without the engine" in found.stderr or "Vulkan" in found.stderr, found.stderr
        skip(found.stderr.strip())


def driver_ms():
    """The time to start a program with its Vulkan driver, and to end it: of `devices`."""
    begin = time.monotonic()
    run("devices")
    return 1000 * (time.monotonic() - begin)


def png_rows(path):
    """The rows of a PNG with 8 bits a channel, each a list of pixels (tuples of channels)."""
    with open(path, "rb") as file:
        data = file.read()
    chunks, at = b"", 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", data[at + 8:at + 18])
        elif kind == b"IDAT":
            chunks += data[at + 8:at + 8 + length]
        at += 12 + length
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    assert depth == 8
    raw, stride, rows = zlib.decompress(chunks), width * channels, []
    before = bytearray(stride)
    for y in range(height):
        filtered = raw[y * (stride + 1)]
        row = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for x in range(stride):
            a = row[x - channels] if x >= channels else 0
            b, c = before[x], before[x - channels] if x >= channels else 0
            paeth = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            row[x] = (row[x] + (0, a, b, (a + b) // 2, paeth)[filtered]) & 255
        rows.append([tuple(row[x:x + channels]) for x in range(0, stride, channels)])
        before = row
    return rows


def png_size(path):
    with open(path, "rb") as file:
        header = file.read(24)
    assert header[:8] == b"\x89PNG\r\n\x1a\n", header
    return tuple(int.from_bytes(header[i:i + 4], "big") for i in (16, 20))


LIT_PICTURE = ("--style", "toon", "--color", "white", "--lines", "off", "--background", "#00ff00", "--size", "160x120")


def lit_share(path):
    """The share of the surface in a LIT_PICTURE that light reaches: what is lighter than between shade and half tone."""
    surface = [pixel for row in png_rows(path) for pixel in row if pixel[0] > 40 or pixel[1] < 240]
    return sum(pixel[0] > 190 for pixel in surface) / len(surface)


def camera_arguments(said):
    """The options of `render` that give the camera and the lights of a result."""
    text = lambda v: ",".join(f"{x:.17g}" for x in v)
    options = [f"--{name}={text(said[name])}" for name in ("eye", "target", "up")]
    options.append(f"--fov={said['fov']:.17g}" if said["fov"] is not None else f"--ortho={said['ortho']:.17g}")
    if said.get("ground_up"):
        options.append(f"--ground-up={text(said['ground_up'])}")
    for light in said.get("lights", ()):
        if not light.get("casts_shadows", True):
            continue  # Fill and rim follow from the key.
        (kind, vector) = next(iter(light.items()))
        options.append(("--sun=" if kind == "direction" else "--light=") + text(vector))
    return options


def drawn_again(stdout, prefix, output):
    """Runs the command in the line of human-readable output that begins with `prefix`, with another output file."""
    [line] = [line for line in stdout.splitlines() if line.startswith(prefix)]
    words = shlex.split(line[len(prefix):])
    assert words[:2] == ["rimline", "render"] and words[-2] == "-o", words
    result = run(*words[1:-1], output)
    assert result.returncode == 0, result.stderr
    return result.stdout


SMALL = ("--size", "64x48")


def check_views(result, count, weighted):
    assert len(result["views"]) == count and result["asked"] >= count and result["ms"] >= 0
    for view in result["views"]:
        assert is_vector(view["eye"])
        distance = math.dist(view["eye"], result["center"]) / result["radius"]
        assert 3 ** 0.5 - 1e-9 <= distance <= 2 + 1e-9
        if weighted:
            assert 0 <= view["visible_ratio"] <= 1
            assert math.isclose(view["score"], view["votes"] * view["visible_ratio"] * view["preference"])
        else:
            assert view["visible_ratio"] is None and view["score"] == view["votes"] * view["preference"]
        assert 0.5 <= view["preference"] <= 1


def write_faces(path, *faces):
    with open(path, "w") as file:
        for face in faces:
            file.writelines("v %g %g %g\n" % corner for corner in face)
        file.writelines("f -%d -%d -%d\n" % (3 * i, 3 * i - 1, 3 * i - 2) for i in range(len(faces), 0, -1))
    return path


TRIANGLE = ((0, 0, 0), (1, 0, 0), (0, 1, 0))
