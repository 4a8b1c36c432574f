"""rimline points."""
import json
import math
import os
import struct
import tempfile

from program import fail, have_device, png_rows, png_size, run, skip, succeed


def check_points(found):
    count, numbers = found["points"], found["numbers"]
    assert len(numbers) == len(found["features"]) == count
    assert numbers == sorted(set(numbers)) and (count == 0 or numbers[-1] < found["file_points"])
    left_out = found["duplicates"] + found["dropped"] + found["unused"]
    assert count + left_out == found["file_points"]
    assert all(0.0 <= weight <= 1.0 for weight in found["features"])
    known = set(numbers)
    for name in ("border", "undecided", "silhouette"):
        assert found[name] == sorted(set(found[name])) and known.issuperset(found[name]), name
    labels = found["labels"]
    assert sum(labels.values()) == count
    assert len(found["border"]) == labels["border"] and len(found["undecided"]) == labels["undecided"]
    assert sum(found["reasons"].values()) == labels["undecided"]
    edges = found["consensus_edges"]
    assert edges == sorted(edges) and all(a < b for a, b in edges)
    on = set(found["silhouette"])
    assert all(a in on and b in on for a, b in edges)
    assert len(on) == found["silhouette_points"] and len(edges) == found["consensus_edge_count"]
    assert found["ms"] >= found["umbrellas_ms"] >= 0


def test_points_tell_borders_features_and_silhouettes_of_a_model_without_its_faces():
    found = succeed("points", "shape:terrain:8000", "--as-points", "--eye", "2,3,4")
    check_points(found)
    info = succeed("info", "shape:terrain:8000")
    assert found["points"] == info["vertices"] and found["dropped"] == found["duplicates"] == 0
    assert math.isclose(found["radius"], info["radius"]) and found["center"] == info["center"]
    truth = found["truth"]
    assert truth["border"] == info["border_edges"]
    assert truth["border"] - truth["missed"] + truth["extra"] == found["labels"]["border"]
    assert math.isclose(truth["missed_percent"], 100 * truth["missed"] / truth["border"])
    assert found["silhouette"] and found["consensus_edges"] and found["arcs"] > 0
    again = succeed("points", "shape:terrain:8000", "--as-points", "--from", "2,3,4", "--threads", "1")
    for key in ("border", "silhouette", "consensus_edges", "features", "truth"):
        assert again[key] == found[key], key
    thesis = [succeed("points", "shape:terrain:8000", "--as-points", *options)["border"] for options in
              (["--method", "thesis"], ["--omega", "30", "--omega-t", "10", "--phi", "150", "--gamma", "2"],
               ["--omega", "5"])]
    assert thesis[0] == thesis[1] != thesis[2]  # Degrees, and what is the default.
    without = succeed("points", "shape:terrain:8000", "--as-points", "--no-lists")
    assert "border" not in without and without["silhouette_points"] == 0
    closed = succeed("points", "shape:sphere:5000", "--as-points", "--direction", "1,2,3")
    check_points(closed)
    assert closed["truth"] == {"border": 0, "missed": 0, "extra": closed["labels"]["border"],
                               "missed_percent": None, "extra_percent": None}
    text = run("points", "shape:terrain:8000", "--as-points", "--eye", "2,3,4")
    assert text.returncode == 0 and "silhouette  %d points" % found["silhouette_points"] in text.stdout


def test_points_take_a_model_with_faces_only_when_told_to():
    assert "--as-points" in fail(1, "points", "shape:box")
    with tempfile.TemporaryDirectory() as d:
        obj = os.path.join(d, "a.obj")
        open(obj, "w").write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nf 1 2 3\n")
        assert "it has 1 faces" in fail(1, "points", obj)
        found = succeed("points", obj, "--as-points")
        check_points(found)
        assert found["points"] == 3 and found["unused"] == 1


def test_points_far_from_zero_equal_to_others_and_not_finite():
    with tempfile.TemporaryDirectory() as d:
        def cloud(offset):
            path = os.path.join(d, "a.xyz")
            rows = []
            for i in range(900):
                z = 1 - (2 * i + 1) / 900
                r, angle = math.sqrt(1 - z * z), i * math.pi * (3 - math.sqrt(5))
                # On a lattice on which adding the offset is exact.
                at = [round(c * 2 ** 20) / 2 ** 30 for c in (r * math.cos(angle), r * math.sin(angle), z)]
                rows.append(" ".join(repr(c + offset) for c in at))
            open(path, "w").write("\n".join(rows + [rows[7], "nan 0 0", rows[9], "0 inf 0"]) + "\n")
            return path

        def of(offset):
            return succeed("points", cloud(offset), "--drop-bad", "--eye",
                           ",".join(repr(c + offset) for c in (2 ** -9, 2 ** -10, -2 ** -9)))
        assert "a.xyz:902: point 901 is nan 0 0" in fail(1, "points", cloud(0.0))
        near, far = of(0.0), of(float(2 ** 20))
        check_points(near)
        check_points(far)
        assert near["points"] == 900 and near["duplicates"] == 2 and near["dropped"] == 2
        assert near["silhouette"] and near["silhouette"] == far["silhouette"]
        assert near["features"] == far["features"] and near["consensus_edges"] == far["consensus_edges"]


def test_points_of_hardly_any_cloud_are_undecided_with_a_reason():
    with tempfile.TemporaryDirectory() as d:
        path = os.path.join(d, "a.xyz")
        for text in ("1 2 3\n", "1 2 3\n1 2 4\n", "0 0 0\n1 1 1\n2 2 2\n3 3 3\n4 4 4\n", "1 2 3\n" * 50):
            open(path, "w").write(text)
            found = succeed("points", path, "--eye", "9,9,9")
            check_points(found)
            assert found["labels"]["undecided"] == found["points"] and found["silhouette"] == []
        open(path, "w").write("nan 1 2\n")
        assert "none of its 1 points is finite" in fail(1, "points", path, "--drop-bad")


def test_points_are_exported_with_normals_labels_and_weights():
    with tempfile.TemporaryDirectory() as d:
        path = os.path.join(d, "labels.ply")
        found = succeed("points", "shape:terrain:3000", "--as-points", "--direction", "0,1,3", "--export", path)
        assert found["export"] == path
        header, body = open(path, "rb").read().split(b"end_header\n", 1)
        record = struct.Struct("<3d3f3B2BfBI")
        assert f"element vertex {found['points']}\n".encode() in header
        rows = list(record.iter_unpack(body))
        assert len(rows) == found["points"]
        assert [row[13] for row in rows] == found["numbers"]
        assert [row[13] for row in rows if row[9] == 0] == found["border"]
        assert [row[13] for row in rows if row[12] == 1] == found["silhouette"]
        assert all(abs(row[11] - weight) < 1e-6 for row, weight in zip(rows, found["features"]))
        assert all(abs(math.hypot(*row[3:6]) - 1) < 1e-6 for row in rows if row[9] != 3)
        # What was written is a cloud again, with normals and colors.
        assert succeed("points", path)["points"] == found["points"]
        fail(1, "points", "shape:box", "--as-points", "--export", os.path.join(d, "none", "a.ply"))


def test_points_follow_a_turn_around_a_cloud():
    found = succeed("points", "shape:knot:4000", "--as-points", "--turn", "60", "--step", "2", "--verify", "--no-lists")
    turn = found["turn"]
    assert found["verified"] is True and turn["frames"] == 60 and turn["step"] == 2
    assert 0 < turn["median_us"] <= turn["p99_us"] <= turn["worst_us"]
    assert turn["changed_points"] > 0 and found["silhouette_points"] == 0
    assert "verified" not in succeed("points", "shape:box:600", "--as-points", "--turn", "3", "--no-lists")
    with tempfile.TemporaryDirectory() as d:
        path = os.path.join(d, "a.xyz")
        open(path, "w").write("1 2 3\n")
        assert succeed("points", path, "--turn", "5", "--verify")["verified"] is True


def test_points_draw_clouds():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "a.png")
        for options in ([], ["--eye", "3,2,4"], ["--eye", "3,2,4", "--target", "0,0.2,0", "--fov", "60"],
                        ["--ortho", "3"], ["--direction", "1,0,0", "--background", "#102030"], ["--up", "1,0,0"],
                        ["--from", "0,3,0", "--mode", "compare"]):
            found = succeed("points", "shape:terrain:2000", "--as-points", "-o", output, "--size", "96x64", *options)
            check_points(found)
            assert found["output"] == output and found["device"] and found["picture_ms"] > 0
            sheet = (2 * 96 + 3 * 8, 3 * 64 + 4 * 8) if "compare" in options else (96, 64)
            assert png_size(output) == sheet, options
        # The silhouette that is told is the one that is drawn: of the eye.
        told = succeed("points", "shape:knot:4000", "--as-points", "--eye", "3,2,4", "--no-lists")
        drawn = succeed("points", "shape:knot:4000", "--as-points", "--eye", "3,2,4", "--no-lists", "-o", output,
                        "--size", "96x64")
        for key in ("silhouette_points", "consensus_edge_count", "arcs"):
            assert told[key] == drawn[key] > 0
        cloud = os.path.join(folder, "a.xyz")
        open(cloud, "w").write("1 2 3\n")
        assert "nothing to draw" in fail(1, "points", cloud, "-o", output)
        fail(1, "points", cloud, "-o", os.path.join(folder, "none", "a.png"))


def test_points_draw_models_upright_and_say_from_where():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output, lying = os.path.join(folder, "a.png"), os.path.join(folder, "pyramid.obj")
        a, b, c, d, top = (-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, 0, 2)
        faces = [(a, c, b), (a, d, c), (a, b, top), (b, c, top), (c, d, top), (d, a, top)]
        for _ in range(4):
            parted = []
            for p, q, r in faces:
                pq, qr, rp = ([(x + y) / 2 for x, y in zip(*ends)] for ends in ((p, q), (q, r), (r, p)))
                parted += [(p, pq, rp), (pq, q, qr), (rp, qr, r), (pq, qr, rp)]
            faces = parted
        with open(lying, "w") as file:
            for x, y, z in sum(map(list, faces), []):
                file.write(f"v {x} {y} {z}\n")
            for i in range(len(faces)):
                file.write(f"f {3 * i + 1} {3 * i + 2} {3 * i + 3}\n")
        options = ("--as-points", "-o", output, "--size", "96x64", "--no-lists")
        found = succeed("points", lying, *options)
        assert found["up"] == [0, 0, 1] and found["up_from"] == "mesh"
        assert succeed("points", lying, "--up", "y", *options)["up"] == [0, 1, 0]
        assert succeed("points", "shape:knot:4000", *options)["up_from"] == "format"
        # The camera that is told shows the same.
        again = succeed("points", "shape:knot:4000", *options)
        rows = png_rows(output)
        given = [",".join(map(repr, again[key])) for key in ("eye", "target")]
        told = succeed("points", "shape:knot:4000", "--eye", given[0], "--target", given[1], "--fov", repr(again["fov"]),
                       *options)
        assert told["silhouette_points"] == again["silhouette_points"]
        one, other = sum(rows, []), sum(png_rows(output), [])
        assert sum(max(abs(a - b) for a, b in zip(p, q)) > 40 for p, q in zip(one, other)) < 0.01 * len(one)
        for key in ("eye", "target"):
            assert all(math.isclose(a, b, abs_tol=1e-6) for a, b in zip(told[key], again[key])), key


def test_points_are_drawn_in_views_of_the_whole_cloud():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        cloud, output = os.path.join(folder, "cloud.xyz"), os.path.join(folder, "a.png")
        write_points(cloud, sphere_points(2000))
        seen = {}
        for view in (["front"], ["right"], ["top"], ["three-quarter"], []):
            told = succeed("points", cloud, *(["--eye", *view] if view else []), "-o", output, "--size", "96x64", "--no-lists")
            way = [told["eye"][i] - told["target"][i] for i in range(3)]
            seen[tuple(view)] = [x / math.hypot(*way) for x in way]
        for view, way in ((("front",), (0, 0, 1)), (("right",), (1, 0, 0)), (("top",), (0, 1, 0))):
            assert math.dist(seen[view], way) < 0.02, (view, seen[view])
        assert seen["three-quarter",] == seen[()]
        turned = succeed("points", cloud, "--azimuth", "90", "--elevation", "0", "-o", output, "--size", "96x64", "--no-lists")
        assert abs(turned["eye"][1] - turned["target"][1]) < 0.02 * turned["eye"][0]
        assert "front, back" in fail(2, "points", cloud, "--eye", "auto", "-o", output)
        assert "give -o FILE.png, or a point" in fail(2, "points", cloud, "--eye", "front")


def test_points_on_no_surface_do_not_widen_the_picture():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output, cloud = os.path.join(folder, "a.png"), os.path.join(folder, "a.xyz")
        points = [f"{math.cos(i * 2.4) * math.sqrt(1 - z * z)} {math.sin(i * 2.4) * math.sqrt(1 - z * z)} {z}"
                  for i in range(3000) for z in [(i + 0.5) / 1500 - 1]]
        open(cloud, "w").write("\n".join([*points, "100 0 0"]) + "\n")
        found = succeed("points", cloud, "--drop-outliers", "-o", output, "--size", "96x64", "--no-lists")
        assert found["reasons"] == {"it lies on no surface": 1}
        assert all(abs(x) < 20 for x in found["eye"]), found["eye"]


def test_points_draw_lines_along_creases():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        blue = []
        for shape in ("shape:box:3000", "shape:sphere:3000"):
            output = os.path.join(folder, "a.png")
            assert run("points", shape, "--as-points", "--look", "discs", "--mode", "features", "-o", output,
                       "--size", "160x120").returncode == 0
            blue.append(sum(1 for row in png_rows(output) for p in row if p[2] > p[0] + 60))
        assert blue[0] > 200 and blue[1] == 0, blue


def test_points_draw_silently_under_validation():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "a.png")
        result = run("points", "shape:terrain:2000", "--as-points", "-o", output, "--size", "64x64", "--json",
                     "--mode", "compare", "--validate")
        if result.returncode == 1 and "vulkan-validationlayers" in result.stderr:
            skip(result.stderr.strip())
        assert result.returncode == 0, result.stderr
        assert json.loads(result.stdout)["validation_messages"] == 0


def test_points_tell_how_small_a_hole_they_can_find():
    # A lattice of squares of side 0.1: the circle around a square has a radius of 0.0707.
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "lattice.xyz")

        def holes(radius):
            kept = [(x, y) for x in range(30) for y in range(30)
                    if math.hypot(x - 14.5, y - 14.5) * 0.1 >= radius]
            with open(path, "w", encoding="utf-8") as file:
                file.writelines(f"{0.1 * x} {0.1 * y} 0\n" for x, y in kept)
            found = succeed("points", path)
            inside = [p for p in found["border"] if 5 < kept[p][0] < 24 and 5 < kept[p][1] < 24]
            limit = found["smallest_hole"]
            assert math.isclose(limit["found"], 4 * limit["median"])
            return limit["median"], len(inside)

        limit, none = holes(0.0)
        assert none == 0 and abs(limit - 2.75 * 0.0707) < 0.01
        assert holes(0.6 * limit)[1] == 0
        assert holes(1.5 * limit)[1] > 8
        # Nearly wherever a hole of the size that is told lies, in triangles as in squares.
        round_holes = 0
        for row, shear in ((0.1, 0.0), (0.1 * math.sqrt(0.75), 0.05)):
            for at in ((2.0, 2.0), (2.02, 1.97), (1.95, 2.04)):
                def rim(radius):
                    kept = [(x, y) for j in range(48) for i in range(42) for x, y in [(0.1 * i + shear * (j % 2), row * j)]
                            if math.dist((x, y), at) >= radius]
                    write_points(path, [(x, y, 0) for x, y in kept])
                    found = succeed("points", path)
                    near = [kept[p] for p in found["border"] if math.dist(kept[p], at) < radius + 0.3]
                    return found["smallest_hole"], {int(6 + 6 * math.atan2(y - at[1], x - at[0]) / math.pi) % 12
                                                    for x, y in near}
                told = rim(0.0)[0]
                round_holes += len(rim(told["found"])[1]) >= 10
                assert not rim(0.5 * told["median"])[1]
        assert round_holes >= 5
        assert succeed("points", path, "--method", "thesis")["smallest_hole"] is None
        assert "nearly all are found" in run("points", path).stdout


def test_points_of_a_coarse_cloud_are_dots_and_of_a_dense_one_discs():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "points.png")

        def drawn(*options):
            """The pixels, of which none on the picture's rim is inked."""
            succeed("points", *options, "--as-points", "-o", output, "--size", "160x120", "--no-lists")
            rows = png_rows(output)
            rim = rows[0] + rows[-1] + [row[0] for row in rows] + [row[-1] for row in rows]
            assert all(pixel == rows[0][0] for pixel in rim), options
            return [pixel for row in rows for pixel in row]

        def inked(pixels):
            return sum(pixel != pixels[0] for pixel in pixels)

        coarse, dense = drawn("shape:torus:1000"), drawn("shape:torus:12000")
        discs = drawn("shape:torus:1000", "--look", "discs")
        assert coarse == drawn("shape:torus:1000", "--look", "dots") and inked(coarse) < 0.5 * inked(discs)
        assert dense == drawn("shape:torus:12000", "--look", "discs")
    fail(2, "points", "shape:torus:1000", "--as-points", "--look", "plates")


def test_points_frame_every_mode_in_both_looks():
    have_device()
    width, height, gap = 160, 120, 8
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "points.png")

        def cells(mode, *options):
            """Of each picture its rows."""
            succeed("points", "shape:knot:500", "--as-points", "-o", output, "--size", f"{width}x{height}", "--no-lists",
                    "--mode", mode, *options)
            rows = png_rows(output)
            if mode != "compare":
                return [rows]
            return [[row[x:x + width] for row in rows[y:y + height]] for y in range(gap, 3 * (height + gap), height + gap)
                    for x in (gap, 2 * gap + width)]

        def inked(cell):
            return sum(sum(pixel) < 210 for row in cell for pixel in row)

        for mode in ("features", "compare"):
            looks = [cells(mode, "--look", look) for look in ("dots", "discs")]
            assert looks[0] == cells(mode) and looks[0][0] != looks[1][-1]
            for cell in looks[0] + looks[1]:
                rim = cell[0] + cell[-1] + [row[0] for row in cell] + [row[-1] for row in cell]
                assert all(pixel == rim[0] for pixel in rim), mode
        dots, discs = looks
        # Points and marks are no blobs, and only the normals are shown by discs.
        for look in looks:
            assert all(0 < inked(look[cell]) < 0.1 * width * height for cell in (0, 2, 3)), [inked(c) for c in look]
        assert dots[1] != discs[1] and dots[2] != discs[2] and dots[3] != discs[3] and dots[4:] == discs[4:]


def test_points_have_ink_that_stands_out_from_the_paper():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "points.png")

        def pixels(*options):
            assert run("points", "shape:torus:6000", "--as-points", "-o", output, "--size", "160x120", "--eye", "2,3,4",
                       *options).returncode == 0
            return [sum(pixel) / 3 for row in png_rows(output) for pixel in row]

        for mode in ("drawn", "features", "compare"):
            for look in ("discs", "dots"):
                options = ("--mode", mode, "--look", look)
                assert min(pixels(*options)) < 60, options
                for paper in ("#181818", "#202060"):
                    assert max(pixels(*options, "--background", paper)) > 225, (options, paper)


def write_points(path, points):
    with open(path, "w") as file:
        file.writelines("%r %r %r\n" % tuple(p) for p in points)


def sphere_points(count):
    """Evenly on the unit sphere, as a spiral."""
    turn = math.pi * (3 - math.sqrt(5))
    for i in range(count):
        z = 1 - (2 * i + 1) / count
        yield math.sqrt(1 - z * z) * math.cos(i * turn), math.sqrt(1 - z * z) * math.sin(i * turn), z


def test_points_warn_where_far_ones_cost_the_others_their_shape():
    with tempfile.TemporaryDirectory() as folder:
        cloud = os.path.join(folder, "cloud.xyz")
        for distance, warns in ((1e3, False), (1e7, True)):
            corners = ((0, 0, 0), (0.1, 0, 0), (0, 0.1, 0), (0.1, 0.1, 0))
            far = [[distance + x for x in corner] for corner in corners]
            write_points(cloud, [*sphere_points(3000), *far])
            result = run("points", cloud, "--from", "30,0,0")
            assert result.returncode == 0, result.stderr
            assert ("leave out what lies far away" in result.stderr) == warns, (distance, result.stderr)
            assert ("--drop-outliers leaves out points" in result.stderr) == warns, (distance, result.stderr)


def test_points_warn_where_few_of_them_make_the_picture_small():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        cloud, output = os.path.join(folder, "cloud.xyz"), os.path.join(folder, "cloud.png")
        for stray, options, warns in (([], [], False), ([(57, 57, 57)], [], True),
                                      ([(57, 57, 57)], ["--drop-outliers"], False)):
            write_points(cloud, [*sphere_points(3000), *stray])
            result = run("points", cloud, "-o", output, "--size", "64x48", *options)
            assert result.returncode == 0, result.stderr
            assert ("1 of its 3001 points lie so far" in result.stderr) == warns, (stray, options, result.stderr)
            assert ("--drop-outliers leaves out points" in result.stderr) == warns, result.stderr


def test_points_keep_what_they_read():
    with tempfile.TemporaryDirectory() as folder:
        cloud, labels, again = (os.path.join(folder, name) for name in ("cloud.xyz", "a.ply", "b.ply"))
        with open(cloud, "w") as file:
            file.writelines("%r %r %r %r\n" % (*p, 100 * i) for i, p in enumerate(sphere_points(400)))
        succeed("points", cloud, "--export", labels)
        told = succeed("info", labels)["cloud"]
        assert told["has_intensities"] and told["has_normals"]
        succeed("points", labels, "--export", again)
        with open(labels, "rb") as a, open(again, "rb") as b:
            # Normals are turned as the file's: all else is as before.
            assert len(a.read()) == len(b.read())
        with open(cloud) as file:
            result = run("info", "-", "--format", "xyz", "--json", stdin=file)
        assert result.returncode == 0 and json.loads(result.stdout)["cloud"]["points"] == 400, result.stderr


def test_points_refuse_options_without_an_effect():
    with tempfile.TemporaryDirectory() as folder:
        cloud, bad = os.path.join(folder, "cloud.xyz"), os.path.join(folder, "bad.xyz")
        write_points(cloud, sphere_points(200))
        assert "--subdivide: it has no faces" in fail(1, "points", cloud, "--subdivide", "1")
        assert "--subdivide: it has no faces" in fail(1, "info", cloud, "--subdivide", "1")
        for options in (["--target", "0,0,0"], ["--fov", "20"], ["--mode", "compare"], ["--look", "dots"], ["--size", "9x9"],
                        ["--background", "red"], ["--device", "cpu"], ["--validate"], ["--up", "z"], ["--azimuth", "9"]):
            assert options[0] + ": there is no picture" in fail(2, "points", cloud, *options), options
        assert "--step: belongs to --turn" in fail(2, "points", cloud, "--step", "3")
        assert "--no-lists: belongs to --json" in fail(2, "points", cloud, "--no-lists")
        assert "--format: is for standard input" in fail(2, "points", cloud, "--format", "xyz")
        assert succeed("points", cloud)["method"] == "robust" and succeed("points", cloud, "--omega", "20")["method"] == "thesis"
        with open(bad, "w") as file:
            file.write("nan 0 0\n0 inf 0\n")
        assert "none of its 2 points is finite" in fail(1, "points", bad, "--drop-bad")
