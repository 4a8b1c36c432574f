"""rimline draw."""
import collections
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

from program import SMALL, fail, have_device, model, read_file, run, skip, succeed

SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
KINDS = ("silhouette", "border", "crease", "intersection")
# Lines as the mesh has them, in straight pieces.
PLAIN = ("--smooth", "0", "--curve", "0")
# Borders, creases, hidden lines; a surface that other surfaces pass through.
SAMPLES = (["shape:knot:3000"], ["shape:scene"], ["shape:terrain:2000", "--eye", "2,1,3"], ["shape:box", "--ortho", "auto"],
           ["shape:scene", "--views", "front,top,right,iso", "--page", "297x210"])

Line = collections.namedtuple("Line", "layer kind closed points")


def length(line):
    points = line.points + line.points[:1] if line.closed else line.points
    return sum(math.dist(a, b) for a, b in zip(points, points[1:]))


def curve_point(a, b, c, d, t):
    s = 1 - t
    return tuple(s * s * s * i + 3 * s * s * t * j + 3 * s * t * t * k + t * t * t * l for i, j, k, l in zip(a, b, c, d))


def path_points(data):
    """The points of an SVG path, and 32 of each curve."""
    pair = r"-?\d+(?:\.\d{1,3})?,-?\d+(?:\.\d{1,3})?"
    triple = f"{pair} {pair} {pair}"
    assert re.fullmatch(f"M{pair}( {pair})*(L{pair}( {pair})*|C{triple}( {triple})*)*Z?", data), data
    points = []
    for command, numbers in re.findall(r"([MLC])([^MLCZ]*)", data):
        pairs = [tuple(map(float, number.split(","))) for number in numbers.split()]
        if command != "C":
            points += pairs
            continue
        for controls in zip(pairs[::3], pairs[1::3], pairs[2::3]):
            begin = points[-1]
            points += [curve_point(begin, *controls, i / 32) for i in range(1, 33)]
    return points


def read_svg(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    lines = []
    for layer in root.findall(SVG + "g"):
        assert layer.get(INKSCAPE + "groupmode") == "layer"
        for group in layer.findall(SVG + "g"):
            name, kind = group.get("id").split("-")
            assert name == layer.get("id")
            for path_element in group.findall(SVG + "path"):
                data = path_element.get("d")
                lines.append(Line(name, kind, data.endswith("Z"), path_points(data)))
    return root, lines


def read_pdf(path):
    with open(path, "rb") as file:
        data = file.read()
    assert data.startswith(b"%PDF-1.5\n") and data.endswith(b"%%EOF\n")
    table = int(re.search(rb"startxref\n(\d+)\n%%EOF\n$", data).group(1))
    count = int(re.match(rb"xref\n0 (\d+)\n", data[table:]).group(1))
    entries = data[table:].split(b"\n", 2)[2]
    for number in range(1, count):
        entry = entries[20 * number:20 * number + 20]
        assert re.fullmatch(rb"\d{10} 00000 n \n", entry), entry
        assert data[int(entry[:10]):].startswith(b"%d 0 obj\n" % number)
    stream = re.search(rb"/Length (\d+) >>\nstream\n", data)
    content = data[stream.end():stream.end() + int(stream.group(1))]
    assert data[stream.end() + len(content):].startswith(b"endstream")
    lines, layer, points = [], "", []
    for command in content.decode().splitlines():
        if command.endswith(" BDC"):
            layer = command.split()[1][1:].lower()
        elif command.endswith(" m"):
            points = [tuple(map(float, command.split()[:2]))]
        elif command.endswith(" l"):
            points.append(tuple(map(float, command.split()[:2])))
        elif command.endswith(" c"):
            numbers = list(map(float, command.split()[:6]))
            controls = list(zip(numbers[::2], numbers[1::2]))
            begin = points[-1]
            points += [curve_point(begin, *controls, i / 32) for i in range(1, 33)]
        elif command in ("s", "S"):
            lines.append(Line(layer, None, command == "s", points))
    box = [float(x) for x in re.search(rb"/MediaBox \[0 0 (\S+) (\S+)\]", data).groups()]
    return [side / 72 * 25.4 for side in box], lines


def read_dxf(path):
    with open(path) as file:
        text = file.read().splitlines()
    pairs = [(int(code), value) for code, value in zip(text[::2], text[1::2])]
    assert len(text) % 2 == 0 and pairs[-1] == (0, "EOF") and (1, "AC1009") in pairs
    lines, entity = [], ""
    layers = [value for code, value in pairs[:pairs.index((2, "ENTITIES"))] if code == 2]
    for code, value in pairs[pairs.index((2, "ENTITIES")):]:
        if code == 0:
            entity = value
        if code == 0 and value == "VERTEX":
            lines[-1].points.append([None, None])
        elif entity == "POLYLINE" and code == 8:
            assert value in layers
            layer, kind = value.lower().split("_")
            lines.append(Line(layer, kind, False, []))
        elif entity == "POLYLINE" and code == 70:
            lines[-1] = lines[-1]._replace(closed=value == "1")
        elif entity == "VERTEX" and code in (10, 20):
            lines[-1].points[-1][code // 10 - 1] = float(value)
    return lines


def check_lengths(lines, result, hidden):
    for name in ("visible", "hidden") if hidden else ("visible",):
        drawn = [line for line in lines if line.layer == name]
        assert math.isclose(sum(map(length, drawn)), result[name + "_length"], abs_tol=1e-6)
        if any(line.kind for line in drawn):
            for kind in KINDS:
                of_kind = sum(length(line) for line in drawn if line.kind == kind)
                assert math.isclose(of_kind, result[name + "_lengths"][kind], abs_tol=1e-6)
    if not hidden:
        assert all(line.layer == "visible" for line in lines)


def bounds(lines):
    points = [point for line in lines for point in line.points]
    return [min(p[0] for p in points), min(p[1] for p in points), max(p[0] for p in points), max(p[1] for p in points)]


def is_close(a, b, tolerance):
    return len(a) == len(b) and all(abs(x - y) <= tolerance for x, y in zip(a, b))


def test_a_drawing_has_its_lines_in_millimeters_in_every_format():
    with tempfile.TemporaryDirectory() as folder:
        for sample in SAMPLES:
            size = [297.0, 210.0] if "--page" in sample else [210.0, 297.0]
            read = {}
            for hidden in ("none", "dashed", "layer"):
                for ending in ("svg", "pdf", "dxf", "json"):
                    path = os.path.join(folder, "a." + ending)
                    result = succeed("draw", *sample, *PLAIN, "--hidden", hidden, "-o", path)
                    assert result["output"] == path and result["page"] == size and result["failed_checks"] == 0
                    if ending == "svg":
                        root, read["svg"] = read_svg(path)
                        assert root.get("viewBox") == "0 0 %g %g" % tuple(size)
                        assert [root.get("width"), root.get("height")] == ["%gmm" % side for side in size]
                        labels = [layer.get(INKSCAPE + "label") for layer in root.findall(SVG + "g")]
                        assert labels == (["1 visible"] if hidden == "none" else ["2 hidden", "1 visible"])
                        assert ("dasharray" in open(path).read()) == (hidden == "dashed")
                    elif ending == "pdf":
                        box, read["pdf"] = read_pdf(path)
                        assert is_close(box, size, 1e-3)
                    elif ending == "dxf":
                        read["dxf"] = read_dxf(path)
                    if ending == "json":
                        break  # It has all strokes, also those that are nearly one.
                    check_lengths(read[ending], result, hidden != "none")
                    assert sum(line.layer == "visible" for line in read[ending]) == result["strokes"]
                # The whole drawing touches the margins of one direction and is in the middle of the page.
                for ending, lines in read.items():
                    low_x, low_y, high_x, high_y = bounds(lines)
                    assert abs(low_x + high_x - size[0]) < 0.2 and abs(low_y + high_y - size[1]) < 0.2, (sample, ending)
                    assert min(low_x, low_y) > 9.9 and min(low_x, low_y) < 10.2, (sample, ending)
                # The y axes of PDF and DXF point upwards.
                points = sorted(point for line in read["svg"] for point in line.points)
                for ending in ("pdf", "dxf"):
                    flipped = sorted((x, round(size[1] - y, 3)) for line in read[ending] for x, y in line.points)
                    assert all(is_close(a, b, 1e-9) for a, b in zip(points, flipped)) and len(points) == len(flipped)


def test_other_programs_read_the_drawings():
    readers = {"svg": ["rsvg-convert", "-f", "png", "-o"], "pdf": ["pdftocairo", "-png", "-singlefile"]}
    missing = []
    with tempfile.TemporaryDirectory() as folder:
        for ending, reader in readers.items():
            path = os.path.join(folder, "a." + ending)
            succeed("draw", "shape:scene", "--hidden", "dashed", "-o", path)
            picture = os.path.join(folder, ending + ".png")
            if not shutil.which(reader[0]):
                missing.append(reader[0])
                continue
            arguments = [picture, path] if ending == "svg" else [path, picture[:-4]]
            found = subprocess.run(reader + arguments, capture_output=True, text=True, timeout=60)
            assert found.returncode == 0 and found.stderr == "", found.stderr
            assert os.path.getsize(picture) > 2000
        path = os.path.join(folder, "a.dxf")
        result = succeed("draw", "shape:scene", "--hidden", "dashed", "-o", path)
        script = ("import ezdxf, sys\n"
                  "from ezdxf import recover\n"
                  "from ezdxf.math import Vec3\n"
                  "drawing, audit = recover.readfile(sys.argv[1])\n"
                  "assert not audit.errors and not audit.fixes and drawing.dxfversion == 'AC1009'\n"
                  "sums = {'VISIBLE': 0.0, 'HIDDEN': 0.0}\n"
                  "for line in drawing.modelspace().query('POLYLINE'):\n"
                  "    points = list(line.points()) + list(line.points())[:1 if line.is_closed else 0]\n"
                  "    sums[line.dxf.layer.split('_')[0]] += sum(Vec3(a).distance(b) for a, b in zip(points, points[1:]))\n"
                  "print(sums['VISIBLE'], sums['HIDDEN'])\n")
        pythons = [python for python in (sys.executable, "/usr/bin/python3")
                   if os.path.exists(python) and subprocess.run([python, "-c", "import ezdxf"], capture_output=True).returncode == 0]
        if pythons:
            found = subprocess.run([pythons[0], "-c", script, path], capture_output=True, text=True, timeout=60)
            assert found.returncode == 0, found.stderr
            visible, hidden = map(float, found.stdout.split())
            assert math.isclose(visible, result["visible_length"], abs_tol=1e-6)
            assert math.isclose(hidden, result["hidden_length"], abs_tol=1e-6)
        else:
            missing.append("ezdxf")
    if missing:
        skip("no " + ", ".join(missing))


def farthest(lines, others):
    """The greatest distance from a point of the lines to the others."""
    segments = [pair for line in others
                for pair in zip(line.points, line.points[1:] + (line.points[:1] if line.closed else []))]

    def distance(p, a, b):
        way = (b[0] - a[0], b[1] - a[1])
        square = way[0] ** 2 + way[1] ** 2
        share = ((p[0] - a[0]) * way[0] + (p[1] - a[1]) * way[1]) / square if square else 0
        share = min(max(share, 0), 1)
        return math.dist(p, (a[0] + share * way[0], a[1] + share * way[1]))

    return max(min(distance(point, *segment) for segment in segments) for line in lines for point in line.points)


def test_no_step_of_shaping_moves_a_line_by_more_than_its_tolerance():
    rounding = 0.002
    with tempfile.TemporaryDirectory() as folder:
        for ending, read in (("svg", read_svg), ("pdf", read_pdf)):
            path = os.path.join(folder, "a." + ending)

            def lines_of(*options):
                succeed("draw", "shape:knot:3000", "--gap", "0", "--min-length", "0", "--stubble", "0", *options, "-o", path)
                return read(path)[1]

            edges = lines_of("--smooth", "0", "--simplify", "0", "--curve", "0")
            for tolerance in (0.05, 0.3):
                for options in (["--smooth", str(tolerance), "--simplify", "0", "--curve", "0"],
                                ["--smooth", "0", "--simplify", str(tolerance), "--curve", "0"],
                                ["--smooth", "0", "--simplify", "0", "--curve", str(tolerance)]):
                    shaped = lines_of(*options)
                    assert [line.points for line in shaped] != [line.points for line in edges]
                    moved = max(farthest(shaped, edges), farthest(edges, shaped))
                    assert 0.1 * tolerance < moved < tolerance + rounding, options


def test_a_sphere_is_one_visible_loop():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.svg")
        for camera in ([], ["--ortho", "auto"], ["--views", "iso"]):
            result = succeed("draw", "shape:sphere:20000", *camera, "--hidden", "layer", "-o", path)
            _, lines = read_svg(path)
            assert [(line.layer, line.kind, line.closed) for line in lines] == [("visible", "silhouette", True)]
            assert result["hidden_length"] == 0 and abs(result["visible_length"] / (190 * math.pi) - 1) < 2e-3


def test_a_box_from_the_front_has_four_edges_and_true_lengths():
    low, high = succeed("info", "shape:box:12")["bounds"]
    width, height, depth = (b - a for a, b in zip(low, high))
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.svg")
        front = succeed("draw", "shape:box:12", "--ortho", "auto", "--eye", f"0,0,{9 * depth}", "--target", "0,0,0",
                        "--scale", "25:2", "--hidden", "layer", "-o", path)
        _, lines = read_svg(path)
        assert front["mm_per_unit"] == 12.5 and all(line.layer == "visible" for line in lines)
        assert front["hidden_length"] == 0 and abs(front["visible_length"] - 25 * (width + height)) < 0.05
        both = succeed("draw", "shape:box:12", "--ortho", "auto", "--eye", f"0,0,{9 * depth}", "--target", "0,0,0",
                       "--scale", "25:2", "--hidden", "layer", "--keep-coincident", "-o", path)
        assert abs(both["hidden_length"] + both["visible_length"] - 2 * front["visible_length"]) < 0.2
        corner = succeed("draw", "shape:box:12", "--hidden", "layer", "-o", path)
        assert corner["lines"] == 12 and corner["hidden_lengths"]["silhouette"] == 0 < corner["hidden_length"]
        silhouettes = succeed("draw", "shape:box:12", "--lines", "silhouette", "-o", path)
        assert silhouettes["lines"] == 6 and silhouettes["visible_length"] < corner["visible_length"]


def test_the_views_of_a_sheet_are_aligned_in_third_angle_projection():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.json")
        arguments = ["draw", "shape:scene", "--views", "front,top,right,left,bottom,back,iso", "--scale", "1:1", "--page", "fit", "--simplify", "0", *PLAIN]
        result = succeed(*arguments, "-o", path)
        with open(path) as file:
            drawing = json.load(file)
        boxes = {}
        for view in drawing["views"]:
            x, y = view["page"]["origin_mm"]
            assert view["page"]["mm_per_unit"] == 1 and view["orthographic"]
            boxes[view["name"]] = (x + min(p[0] for p in view["points"]), y - max(p[1] for p in view["points"]),
                                   x + max(p[0] for p in view["points"]), y - min(p[1] for p in view["points"]))
        front = boxes["front"]
        for name in ("top", "bottom"):
            assert is_close(boxes[name][::2], front[::2], 1e-3), boxes
        for name in ("right", "left", "back"):
            assert is_close(boxes[name][1::2], front[1::2], 1e-3), boxes
        # The gap between views is the margin. Where one of a column is smaller, more.
        assert boxes["top"][3] < front[1] < front[3] < boxes["bottom"][1]
        assert boxes["left"][2] < front[0] < front[2] < boxes["right"][0] < boxes["back"][0]
        assert is_close([front[0] - boxes["left"][2], boxes["bottom"][1] - front[3]], [10, 10], 1e-3)
        assert boxes["iso"][0] > front[2] and boxes["iso"][3] < front[1]
        low, high = succeed("info", "shape:scene")["bounds"]
        assert is_close([front[2] - front[0], front[3] - front[1]], [high[0] - low[0], high[1] - low[1]], 1e-4)
        assert is_close([boxes["right"][2] - boxes["right"][0]], [high[2] - low[2]], 1e-4)
        assert [view["name"] for view in result["views"]] == [view["name"] for view in drawing["views"]]
        assert [view["up"] for view in result["views"][:2]] == [[0, 1, 0], [0, 0, -1]]


def test_a_drawing_as_json_is_consistent():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.json")
        result = succeed("draw", "shape:scene", "--min-length", "0", "--stubble", "0", "-o", path)
        with open(path) as file:
            drawing = json.load(file)
        view, = drawing["views"]
        scale = view["page"]["mm_per_unit"]
        assert drawing["page_mm"] == result["page"] and scale == result["mm_per_unit"]
        assert len(view["points"]) == len(view["sources"]) and len(view["chains"]) == result["chains"]
        assert len(view["runs"]) == result["runs"] and len(view["strokes"]) == result["strokes"]
        assert len({chain["id"] for chain in view["chains"]}) == len(view["chains"])
        for number, chain in enumerate(view["chains"]):
            assert chain["kind"] in KINDS
            first, last = chain["runs"]
            assert all(run["chain"] == number for run in view["runs"][first:last]) and first < last
        parts = [part for stroke in view["strokes"] for part in stroke["parts"]]
        visible = [i for i, run in enumerate(view["runs"]) if run["hidden_by"] == 0]
        assert sorted(part[0] for part in parts) == visible
        # Whole runs, or points after those of all runs.
        runs = [view["runs"][run]["points"] for run, *_ in parts]
        cut = [points for run, (_, _, *points) in zip(runs, parts) if points != run]
        assert 0 < len(cut) < len(parts) and sum(last - first for first, last in cut) == len(view["points"]) - view["runs"][-1]["points"][1]
        # Without the gaps that strokes join.
        drawn = scale * sum(view["runs"][i]["length"] for i in visible)
        assert 0.98 < drawn / result["visible_length"] < 1.02
        for source in view["sources"]:
            assert source is None or len(source) == 3 and 0 <= source[2] <= 1
        margin = [scale * (p[axis]) * sign + origin for p in view["points"]
                  for axis, sign, origin in ((0, 1, view["page"]["origin_mm"][0]), (1, -1, view["page"]["origin_mm"][1]))]
        assert min(margin) > 9.99


def test_a_drawing_says_which_edges_it_is_made_of():
    corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    with tempfile.TemporaryDirectory() as folder:
        cube = os.path.join(folder, "cube.obj")
        with open(cube, "w") as file:
            file.writelines("v %d %d %d\n" % corner for corner in corners)
            file.writelines("f %d %d %d %d\n" % tuple(i + 1 for i in face) for face in faces)
        path = os.path.join(folder, "a.svg")
        succeed("draw", cube, "--source", "--hidden", "layer", "-o", path)
        root, lines = read_svg(path)
        elements = list(root.iter(SVG + "path"))
        edges = [tuple(sorted(map(int, edge.split("-")))) for element in elements for edge in element.get("data-edges").split()]
        assert sorted(edges) == sorted((a, a | bit) for a in range(8) for bit in (1, 2, 4) if not a & bit)
        assert all(re.fullmatch(r"\d+( \d+)*", element.get("data-chain")) for element in elements)
        # The lines are those of a drawing without sources.
        for shape in (cube, "shape:scene"):
            with_sources = succeed("draw", shape, "--source", "-o", path)
            _, lines = read_svg(path)
            without = succeed("draw", shape, "-o", path)
            _, same = read_svg(path)
            assert abs(with_sources["visible_length"] / without["visible_length"] - 1) < 1e-3
            assert sum(len(line.points) for line in lines) < 1.1 * sum(len(line.points) for line in same)
        assert "data-" not in open(path).read()


def test_hidden_lines_can_be_limited_by_what_hides_them():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.svg")
        lengths = [succeed("draw", "shape:scene", "--hidden", "dashed", "--gap", "0", "--min-length", "0", *limit, "-o", path)["hidden_length"]
                   for limit in (["--hidden-by", "1"], ["--hidden-by", "3"], ["--hidden-by", "1000"], [])]
        assert 0 < lengths[0] < lengths[1] < lengths[2] and abs(lengths[2] / lengths[3] - 1) < 0.01


def test_hidden_lines_of_surfaces_seen_edge_on_are_few():
    part = model("fandisk.obj")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.svg")
        view = ["draw", part, "--views", "right", "--hidden", "dashed", "-o", path]
        shown, all_lines = succeed(*view), succeed(*view, "--keep-coincident")
        assert shown["visible_length"] > 1000
        assert 100 < shown["hidden_length"] < 0.2 * all_lines["hidden_length"]


def test_pages_have_the_size_that_is_asked_for():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.svg")
        for page, margin in (("100x50", 5), ("420x297", 20)):
            result = succeed("draw", "shape:knot:2000", *PLAIN, "--page", page, "--margin", str(margin), "-o", path)
            low_x, low_y, high_x, high_y = bounds(read_svg(path)[1])
            width, height = map(float, page.split("x"))
            assert result["page"] == [width, height]
            assert abs(min(low_x, low_y) - margin) < 0.1 and max(high_x - width, high_y - height) < -margin + 0.1
        result = succeed("draw", "shape:knot:2000", *PLAIN, "--page", "fit", "--margin", "3", "-o", path)
        box = bounds(read_svg(path)[1])
        assert max(result["page"]) == 180
        assert is_close(box, [3, 3, result["page"][0] - 3, result["page"][1] - 3], 0.1)
        # A line of 5 mm is whole.
        result = succeed("draw", "shape:knot:2000", *PLAIN, "--page", "fit", "--margin", "0", "--width", "5", "-o", path)
        box = bounds(read_svg(path)[1])
        assert is_close(box, [2.5, 2.5, result["page"][0] - 2.5, result["page"][1] - 2.5], 0.1)
        # Each tolerance has the length on the page that is asked for.
        few = succeed("draw", "shape:knot:20000", *PLAIN, "--simplify", "1", "-o", path)
        coarse = sum(len(line.points) for line in read_svg(path)[1])
        many = succeed("draw", "shape:knot:20000", *PLAIN, "--simplify", "0", "-o", path)
        assert coarse < 0.5 * sum(len(line.points) for line in read_svg(path)[1])
        assert few["chains"] == many["chains"]
        succeed("draw", "shape:scene", "--min-length", "30", "--hidden", "layer", "-o", path)
        assert min(map(length, read_svg(path)[1])) >= 29.9


def test_a_drawing_ends_at_the_borders_of_its_picture():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.svg")
        inside = ["--eye", "0,3,0", "--target", "1,0.5,0.3"]
        for camera in (inside, [*inside, "--fov", "100"], ["--eye", "3,2,4", "--fov", "12"], ["--ortho", "1"]):
            for hidden in ("none", "layer"):
                result = succeed("draw", "shape:scene", *PLAIN, *camera, "--page", "200x150", "--hidden", hidden, "-o", path)
                _, lines = read_svg(path)
                check_lengths(lines, result, hidden == "layer")
                low_x, low_y, high_x, high_y = bounds(lines)
                assert min(low_x, low_y) >= 10 and high_x <= 190 and high_y <= 140
                assert hidden == "none" or min(low_x - 10, low_y - 10, 190 - high_x, 140 - high_y) < 1e-3
        # 1 unit is as high as the space between the margins.
        assert result["mm_per_unit"] == 130


def write_cube(folder, name="cube.obj"):
    path = os.path.join(folder, name)
    with open(path, "w") as file:
        file.writelines("v %d %d %d\n" % (x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1))
        for face in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
            file.write("f %d %d %d %d\n" % tuple(i + 1 for i in face))
    return path


def test_a_drawing_without_lines_on_its_page_is_told():
    warning = "the drawing is empty: no line of these kinds is on its page"
    with tempfile.TemporaryDirectory() as folder:
        cube = write_cube(folder)
        # Lines are beside the picture; all of them are hidden; there are none.
        for ending, read in (("svg", read_svg), ("pdf", read_pdf), ("dxf", lambda path: (None, read_dxf(path)))):
            path = os.path.join(folder, "a." + ending)
            for shape, options in ((cube, ["--ortho", "0.3"]), (cube, ["--ortho", "0.3", "--hidden", "layer"]),
                                   ("shape:sphere:20000", ["--eye", "0.3,0.1,0.1", "--fov", "5"]),
                                   ("shape:sphere:2000", ["--lines", "crease"])):
                told = run("draw", shape, *options, "--json", "-o", path)
                result = json.loads(told.stdout)
                assert read(path)[1] == [] and warning in told.stderr and told.returncode == 0, (shape, options, told.stderr)
                assert result["strokes"] == result["visible_length"] == 0
            # A stroke that leaves the picture and comes back is drawn in two pieces.
            result = succeed("draw", "shape:scene", "--ortho", "1", "-o", path)
            assert len(read(path)[1]) == result["strokes"] > 0
            # What is drawn hidden is on the page too.
            succeed("draw", "shape:scene", "--eye", "0,3,0", "--target", "1,0.5,0.3", "--hidden", "layer", "-o", path)


def test_a_drawing_as_json_says_where_its_picture_ends():
    with tempfile.TemporaryDirectory() as folder:
        whole, json_path, svg_path = (os.path.join(folder, name) for name in ("w.json", "a.json", "a.svg"))
        succeed("draw", "shape:scene", "-o", whole)
        with open(whole) as file:
            assert json.load(file)["views"][0]["page"]["frame_mm"] is None
        for camera in (["--ortho", "1"], ["--eye", "3,2,4", "--fov", "12"]):
            for path in (json_path, svg_path):
                succeed("draw", "shape:scene", *PLAIN[:2], *camera, "--page", "200x150", "-o", path)
            with open(json_path) as file:
                page = json.load(file)["views"][0]["page"]
            left, top, right, bottom = page["frame_mm"]
            assert is_close(page["frame_mm"], [10, 10, 190, 140], 1e-6), page
            low_x, low_y, high_x, high_y = bounds(read_svg(svg_path)[1])
            assert left - 1e-3 < low_x < high_x < right + 1e-3 and top - 1e-3 < low_y < high_y < bottom + 1e-3


def test_a_drawing_as_json_has_the_name_of_its_model():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.json")
        for name in ("a\nb \u00e4 \\x0a.obj", "a\udcff.obj"):
            cube = write_cube(folder, name)
            told = run("draw", cube, "--json", "-o", path)
            with open(path) as file:
                drawing = json.load(file)
            assert drawing["model"] == json.loads(told.stdout)["model"] == cube.replace("\udcff", "\\xff")


def test_vertex_numbers_of_refined_meshes_are_told():
    for arguments in (["draw"], ["silhouette"]):
        assert "--subdivide of the refined mesh" in " ".join(run(*arguments, "--help").stdout.split()), arguments


def test_the_length_of_a_page_that_fits_is_told():
    assert "fit: as large as the drawing and its margins, without --scale 180 mm on the longer side" in " ".join(
        run("draw", "--help").stdout.split())


def test_the_camera_is_that_of_render():
    cameras = ([], ["--eye", "auto"], ["--eye", "front"], ["--eye", "top"], ["--azimuth", "200", "--elevation", "15"],
               ["--eye", "left", "--fov", "20"], ["--target", "0.1,0,0"], ["--eye", "3,2,4", "--target", "0.1,0,0", "--fov", "40"])
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.svg")
        places = set()
        for shape in ("shape:knot:3000", "shape:scene"):
            drawn = [succeed("draw", shape, *camera, "-o", path)["views"][0] for camera in cameras]
            places.update(str(view["eye"]) for view in drawn)
            have_device()
            for camera, view in zip(cameras, drawn):
                picture = succeed("render", shape, *camera, *SMALL, "-o", os.path.join(folder, "a.png"))
                for key in ("eye", "target", "up"):
                    assert is_close(view[key], picture[key], 1e-5), (shape, camera, key)
        # The knot has no view of its own, and both are seen from the same point last.
        assert len(places) == 2 * len(cameras) - 2


def test_pages_have_names():
    with tempfile.TemporaryDirectory() as folder:
        drawings = {}
        for page in (None, "a4", "A4", "210x297", "letter", "215.9x279.4", "a4-landscape", "297x210"):
            path = os.path.join(folder, "a.svg")
            succeed("draw", "shape:box", "-o", path, *(["--page", page] if page else []))
            drawings[page] = read_file(path)
        assert drawings[None] == drawings["a4"] == drawings["A4"] == drawings["210x297"]
        assert drawings["letter"] == drawings["215.9x279.4"] != drawings["a4"]
        assert drawings["a4-landscape"] == drawings["297x210"] != drawings["a4"]


def test_wrong_drawings_are_told_in_plain_words():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.svg")
        box = ["draw", "shape:box", "-o", path]
        assert "expected a name that ends in .svg, .pdf, .dxf or .json, not 'a.png'" in fail(2, "draw", "shape:box", "-o", "a.png")
        assert "--lines: expected some of silhouette,border,crease,intersection, not 'edges'" in fail(2, *box, "--lines", "border,edges")
        assert "'border' is given twice" in fail(2, *box, "--lines", "border,border")
        assert "--views: expected some of front,top,right,iso,left,bottom,back, not ''" in fail(2, *box, "--views", "")
        assert "--source: only drawings in SVG" in fail(2, "draw", "shape:box", "--source", "-o", "a.dxf")
        assert "--scale: needs an orthographic view" in fail(2, *box, "--scale", "1:1")
        assert "a height from 1e-12 to 1e18, not '0'" in fail(2, *box, "--ortho", "0")
        assert "--scale: expected A:B, for example 1:10, not '3'" in fail(2, *box, "--ortho", "auto", "--scale", "3")
        assert "--scale: the drawing has" in fail(2, *box, "--ortho", "auto", "--scale", "1000:1")
        assert "--page: expected fit, a0 to a6, letter, legal, tabloid, one of these with -landscape, or WxH with both from 1 to 5000 mm, not '0x9'" in fail(2, *box, "--page", "0x9")
        assert "--margin: the margins leave no space" in fail(2, *box, "--margin", "105")
        assert "--ortho: expected auto or a height" in fail(2, *box, "--ortho", "-1")
        assert "--views: the views of a sheet" in fail(2, *box, "--views", "front", "--eye", "1,2,3")
        assert "--views: the views of a sheet" in fail(2, *box, "--views", "front", "--azimuth", "20")
        assert "--eye excludes --azimuth" in fail(2, *box, "--eye", "front", "--azimuth", "20")
        assert "--hidden-by: needs --hidden" in fail(2, *box, "--hidden-by", "2")
        assert "--hidden-width: needs --hidden" in fail(2, *box, "--hidden-width", "0.2")
        assert "--curve: only drawings in SVG and PDF" in fail(2, "draw", "shape:box", "--curve", "1", "-o", "a.dxf")
        assert "--width: only drawings in SVG and PDF" in fail(2, "draw", "shape:box", "--width", "1", "-o", "a.json")
        assert "--as: needs -o -" in fail(2, *box, "--as", "pdf")
        assert "--eye and --target are the same point" in fail(2, *box, "--eye", "1,2,3", "--target", "1,2,3")
        for page in ("nan", "xx", "1e9x5", "10x", "fits"):
            fail(2, *box, "--page", page)
        point = os.path.join(folder, "a.obj")
        with open(point, "w") as file:
            file.write("v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n")
        assert "radius" in fail(1, "draw", point, "-o", path)
        assert sorted(os.listdir(folder)) == ["a.obj"]
        with open(point, "w") as file:
            file.write("v 0 0 0\nv 0 0 1\nv 0 0 2\nf 1 2 3\n")
        assert "from here the model is a point" in fail(1, "draw", point, "--views", "front", "-o", path)
        # Seen from aside, it is a line.
        result = run("draw", point, "-o", path, "--page", "fit")
        assert result.returncode == 0 and 'id="visible"' in open(path).read(), result.stderr


def test_another_method_counts_the_same_faces_before_all_lines():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.svg")
        for arguments in (["shape:scene"], ["shape:scene", "--views", "front,top,right,left,bottom,back", "--crease", "20"],
                          ["shape:scene", "--eye", "0,3,0", "--target", "1,0.5,0.3"], ["shape:terrain:2000", "--lines", "crease"],
                          [model("rocker-arm.obj")], [model("ogre.obj"), "--lines", "silhouette,intersection"]):
            result = succeed("draw", *arguments, "--verify", "-o", path)
            found = result["verify"]
            assert found["wrong"] == found["wrong_visibility"] == found["missing_edges"] == 0 < found["samples"], arguments
            assert found["undecided"] < 0.02 * found["samples"]
            # What is written does not depend on it.
            with open(path) as file:
                verified = file.read()
            succeed("draw", *arguments, "-o", path)
            with open(path) as file:
                assert file.read() == verified


def test_machine_parts_and_scans_are_drawn():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.pdf")
        sheet = succeed("draw", model("fandisk.obj"), "--ortho", "auto", "--views", "front,top,right,iso", "--scale", "1:1", "-o", path)
        assert sheet["failed_checks"] == 0 and len(read_pdf(path)[1]) == sheet["strokes"]
        head = succeed("draw", model("igea.ply"), *PLAIN, "--hidden", "layer", "-o", path)
        assert head["failed_checks"] == head["undecided_lines"] == 0 and 0 < head["visible_length"] < head["hidden_length"]
        check_lengths(read_pdf(path)[1], head, True)
