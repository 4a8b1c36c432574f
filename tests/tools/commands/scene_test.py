"""Several models in one picture, and scene files."""
import json
import os
import re
import tempfile

from program import drawn_again, fail, have_device, png_rows, read_file, run, succeed, write_faces

SIZE = ("--size", "160x120")
BOX = "shape:box"


def draw(output, *arguments):
    return succeed("render", *arguments, "-o", output)


def write_scene(folder, scene, name="scene.json"):
    path = os.path.join(folder, name)
    with open(path, "w") as file:
        file.write(scene if isinstance(scene, str) else json.dumps(scene))
    return path


def test_placed_models_are_drawn_as_the_file_that_holds_them_all():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        corners = [(0, 0, 0), (1, 0, 0.5), (0, 1, 0)]
        moved = [(2 * x + 3, 2 * y, 2 * z - 1) for x, y, z in corners]
        turned = [(-y, x, z) for x, y, z in corners]  # A quarter turn about z.
        one = write_faces(os.path.join(folder, "one.obj"), corners)
        all_three = write_faces(os.path.join(folder, "all.obj"), corners, moved, turned)
        output, other = os.path.join(folder, "a.png"), os.path.join(folder, "b.png")
        for style in ("ink", "toon", "hatch", "blueprint"):
            look = (*SIZE, "--style", style, "--ground", "--up", "y", "--sun", "1,1,1")
            whole = draw(output, *look, all_three)
            # --up stands before the models: it is that of the scene.
            placed = draw(other, *look, one, one, "--at", "3,0,-1", "--scale", "2", one, "--turn", "z,90")
            assert read_file(output) == read_file(other), style
            assert whole["eye"] == placed["eye"] and whole["silhouette"] == placed["silhouette"]
            assert [m.get("at") for m in placed["models"]] == [None, [3, 0, -1], None]
        assert "models" not in whole


def test_the_frame_holds_all_models_and_they_hide_each_other():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "a.png")
        look = (*SIZE, "--style", "toon", "--shadows", "off", "--lines", "off", "--eye", "front")
        draw(output, BOX, "--paint", "#f00", BOX, "--at", "6,0,0", "--paint", "#0f0", *look)
        rows = png_rows(output)
        kinds = lambda row: ["r" if p[0] > p[1] + 40 else "g" if p[1] > p[0] + 40 else " " for p in row]
        middle = "".join(kinds(rows[60])).strip()
        assert middle.startswith("rrr") and middle.endswith("ggg") and " " in middle, middle
        # In front of the first, the second hides it, whatever the order.
        for pair in ((BOX, "--paint", "#f00", BOX, "--at", "0,0,6", "--paint", "#0f0"),
                     (BOX, "--at", "0,0,6", "--paint", "#0f0", BOX, "--paint", "#f00")):
            draw(output, *pair, *look)
            assert set(kinds(png_rows(output)[60])) == {"g", " "}
        # Lines of a hidden model are not drawn either: both boxes have the outline of the nearer one.
        ink = (*SIZE, "--shadows", "off", "--eye", "0,0,30", "--target", "0,0,0", "--fov", "20")
        draw(output, BOX, "--at", "0,0,6", "--scale", "2", *ink)
        alone = read_file(output)
        draw(output, BOX, "--at", "0,0,6", "--scale", "2", BOX, *ink)
        assert read_file(output) == alone
        draw(output, BOX, BOX, "--at", "0,0,6", "--scale", "2", *ink, "--hidden")
        assert read_file(output) != alone


def test_shadows_of_one_model_fall_on_another():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "a.png")
        look = (*SIZE, "--style", "mask", "--eye", "0,0,30", "--target", "0,0,0", "--fov", "20", "--sun", "2,0,1")
        def white(*models):
            draw(output, *models, *look)
            return sum(pixel[0] > 128 for row in png_rows(output) for pixel in row)
        # Beside the box at the right, towards the sun, another one that is higher in z shades its front.
        assert white(BOX) > white(BOX, BOX, "--at", "4,0,2") - white(BOX, "--at", "4,0,2")


def test_the_up_direction_belongs_to_each_model():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output, other = os.path.join(folder, "a.png"), os.path.join(folder, "b.png")
        corners = [(0, 0, 0), (1, 0, 0.5), (0, 1, 0)]
        upright = write_faces(os.path.join(folder, "y.obj"), corners)
        lying = write_faces(os.path.join(folder, "z.obj"), [(x, -z, y) for x, y, z in corners])
        draw(output, *SIZE, "--up", "y", upright, upright, "--up", "y", "--at", "2,0,0")
        said = draw(other, *SIZE, "--up", "y", upright, lying, "--up", "z", "--at", "2,0,0")
        assert read_file(output) == read_file(other) and said["models"][1]["up"] == [0, 0, 1]
        # Of the first model it is that of the scene.
        draw(output, *SIZE, lying, "--up", "z", upright, "--up", "y")
        draw(other, *SIZE, "--up", "z", lying, upright, "--up", "y")
        assert read_file(output) == read_file(other)
        draw(other, *SIZE, lying, "--up", "z")
        assert draw(output, *SIZE, "--up", "z", lying)["up_from"] == "option"
        assert read_file(output) == read_file(other)


def test_the_same_file_twice_is_read_once():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.obj")
        with open(path, "w") as file:
            file.write("mtllib missing.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        result = run("render", path, path, "--at", "2,0,0", *SIZE, "-o", os.path.join(folder, "a.png"))
        assert result.returncode == 0 and result.stderr.count("missing.mtl") == 1, result.stderr
        triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
        result = run("render", "-", BOX, "--at", "2,0,0", "--format", "obj", *SIZE, "-o", os.path.join(folder, "b.png"),
                     input=triangle)
        assert result.returncode == 0, result.stderr


def test_places_without_a_model_and_bad_places_are_usage_errors():
    have_device()
    assert "--at: name a MODEL before it" in fail(2, "render", "--at", "1,2,3", BOX)
    assert "--scale: name a MODEL" in fail(2, "render", "--scale", "2")
    assert "--at: give it only once for each MODEL" in fail(2, "render", BOX, "--at", "1,2,3", "--at", "1,2,3", BOX)
    assert "--up: give it only once" in fail(2, "render", BOX, "--up", "x", "--up", "y")
    assert "three numbers" in fail(2, "render", BOX, "--at", "1,2")
    assert "DEGREES" in fail(2, "render", BOX, "--turn", "1,2,3")
    assert "number from" in fail(2, "render", BOX, "--scale", "0")
    assert "COLOR" in fail(2, "render", BOX, "--paint", "redd").upper()
    assert "did you mean" in fail(2, "render", BOX, "shape:bxo")
    assert "--camera: belongs to a scene file" in fail(2, "render", BOX, "--camera", "a")
    assert "standard input can be read only once" in fail(2, "render", "-", "-", "--format", "obj")
    for options in (["render", BOX, BOX], ["render"], ["info", BOX], ["draw", "shape:box"]):
        assert "--format: is for standard input, -" in fail(2, *options, "--format", "obj"), options
    assert "missing.obj" in fail(1, "render", BOX, "missing.obj")
    assert "too large to stand before" in run("render", BOX, BOX, "--at", "1.1e18,0,0").stderr
    far = run("render", BOX, "--at", "1e6,0,0", "-o", "/dev/null", *SIZE)
    assert "shape:box: lies so far from the origin" in far.stderr, far.stderr


def test_a_picture_of_several_models_can_be_drawn_again():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output, other = os.path.join(folder, "a b.png"), os.path.join(folder, "b.png")
        cases = ([], ["--ground"], ["--eye", "top", "--ground"], ["--style", "toon", "--sun", "auto"], ["--ortho", "9"])
        for options in cases:
            told = run("render", BOX, "--paint", "#c04020", "shape:knot:2000", "--at=-2.5,0.1,0", "--turn", "x,30", "--up", "z",
                       "--scale", "0.7", *SIZE, "-o", output, *options)
            assert told.returncode == 0, told.stderr
            drawn_again(told.stdout, "  again       ", other)
            assert read_file(output) == read_file(other), options


def test_a_saved_scene_draws_the_same_picture_in_every_style():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output, other, scene = (os.path.join(folder, name) for name in ("a.png", "b.png", "scene.json"))
        models = (BOX, "--paint", "#c04020", "shape:knot:2000", "--at=-2.5,0.1,0.3", "--turn", "1,2,3,30", "--up", "z")
        cases = ([], ["--style", "toon", "--ground", "--sun", "auto"], ["--style", "hatch", "--light", "3,4.1,5"],
                 ["--style", "blueprint", "--hidden", "--palette", "sepia"],
                 ["--outline", "sobel", "--depth-step", "0.01", "--normal-step", "55.5"], ["--outline", "backs"],
                 ["--style", "toon", "--crease", "clear"],
                 ["--style", "mask", "--lines", "on"], ["--background", "none", "--ground"], ["--eye", "top", "--ground"],
                 ["--silhouette-from", "3,1.1,-2", "--hidden"], ["--silhouette-direction=-1,0.3,2", "--ground"],
                 ["--lighting", "three-point"], ["--style", "toon", "--lighting", "three-point", "--sun", "1,2,3", "--ground"],
                 ["--ortho", "8.3", "--crease", "40.5", "--line-width", "3.3", "--line-color", "navy", "--materials", "off",
                  "--intersections", "off", "--min-length", "2.5", "--shadows", "fail", "--color", "#abc"])
        for i, options in enumerate(cases):
            draw(output, *models, *SIZE, *options, "--save-scene", scene)
            # The size is in the file.
            again = os.path.join(folder, "again.json")
            said = draw(other, scene, "--save-scene", again)
            assert read_file(output) == read_file(other), options
            assert said["model"] == scene and len(said["models"]) == 2
            assert read_file(again) == read_file(scene), options
            if i % 4 == 1:
                told = run("render", scene, "-o", output)
                drawn_again(told.stdout, "  again       ", other)
                assert read_file(output) == read_file(other), options


def test_every_option_of_the_look_of_a_picture_has_a_key():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        path = write_scene(folder, {"rimline_scene": 1, "models": [{"model": BOX}], "picture": {"look": 1}})
        message = fail(1, "render", path, "-o", os.path.join(folder, "a.png"))
    keys = set(re.search(r"there are ([a-z, -]+)", message)[1].split(", "))
    sections = re.findall(r"^(Style|Light|Image):\n(.*?)(?:\n\n|\Z)", run("render", "--help").stdout, re.S | re.M)
    options = {name for _, text in sections for name in re.findall(r"^  --([a-z-]+)", text, re.M)}
    # Lights have a list of their own; the seed changes no picture.
    assert len(sections) == 3 and options - keys == {"light", "sun", "seed"} and keys <= options, (options, keys)


def test_options_go_before_what_a_scene_file_says():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        output, other = os.path.join(folder, "a.png"), os.path.join(folder, "b.png")
        scene = write_scene(folder, {
            "rimline_scene": 1, "models": [{"model": BOX}], "lights": [{"sun": [1, 2, 3]}],
            "cameras": {"front": {"eye": "front"}, "far": {"eye": [9, 9, 9], "target": [0, 1, 0], "fov": 50}},
            "picture": {"style": "toon", "ground": True, "size": "160x120"}})
        for options, plain in (((), ("--eye", "front", "--sun", "1,2,3", "--style", "toon", "--ground")),
                               (("--camera", "far"), ("--eye", "9,9,9", "--target", "0,1,0", "--fov", "50", "--sun", "1,2,3",
                                                      "--style", "toon", "--ground")),
                               (("--camera", "far", "--fov", "30", "--light", "2,3,4", "--style", "ink"),
                                ("--eye", "9,9,9", "--target", "0,1,0", "--fov", "30", "--light", "2,3,4", "--ground")),
                               (("--eye", "3,2,1",), ("--eye", "3,2,1", "--sun", "1,2,3", "--style", "toon", "--ground"))):
            draw(output, scene, *options)
            draw(other, BOX, *SIZE, *plain)
            assert read_file(output) == read_file(other), options
        studio = write_scene(folder, {"rimline_scene": 1, "models": [{"model": BOX}], "lights": [{"sun": [1, 2, 3]}],
                                      "picture": {"lighting": "three-point", "size": "160x120"}}, "studio.json")
        for options, plain in (((), ("--sun", "1,2,3", "--lighting", "three-point")),
                               (("--sun", "3,2,1"), ("--sun", "3,2,1", "--lighting", "three-point")),
                               (("--lighting", "sun"), ("--sun", "1,2,3")), (("--light", "2,3,4"), ("--light", "2,3,4"))):
            draw(output, studio, *options)
            draw(other, BOX, *SIZE, *plain)
            assert read_file(output) == read_file(other), options
        colored = write_scene(folder, {
            "rimline_scene": 1, "models": [{"model": BOX}], "lights": [{"lamp": [9, 9, 9]}, {"sun": [1, 2, 3]}],
            "picture": {"style": "toon", "palette": "sea", "outline": "sobel", "normal-step": 30, "size": "160x120"}},
            "colored.json")
        lamps = ("--light", "9,9,9", "--sun", "1,2,3")
        sobel = ("--outline", "sobel", "--normal-step", "30")
        for options, plain in ((("--style", "toon"), ("--style", "toon", "--palette", "sea", *lamps, *sobel)),
                               (("--style", "ink"), (*lamps, *sobel)), (("--style", "mask"), ("--style", "mask", *lamps, *sobel)),
                               (("--outline", "lines"), ("--style", "toon", "--palette", "sea", *lamps)),
                               (("--lighting", "three-point"), ("--style", "toon", "--palette", "sea", "--lighting",
                                                                "three-point", "--sun", "1,2,3", *sobel))):
            draw(output, colored, *options)
            draw(other, BOX, *SIZE, *plain)
            assert read_file(output) == read_file(other), options
        assert "--palette: the style toon has" in fail(2, "render", colored, "--palette", "riso")
        saved = os.path.join(folder, "saved.json")
        for options, names in (((), ["front", "far"]), (("--camera", "far"), ["far", "front"]),
                               (("--eye", "3,2,1"), ["camera", "front", "far"])):
            draw(output, scene, *options, "--save-scene", saved)
            with open(saved) as file:
                assert list(json.load(file)["cameras"]) == names, options
            draw(other, saved)
            assert read_file(output) == read_file(other), options
        assert "there are front, far" in fail(1, "render", scene, "--camera", "fro")
        assert "leave out --eye" in fail(2, "render", scene, "--camera", "far", "--eye", "1,2,3")
        assert "stands alone" in fail(2, "render", scene, BOX)
        assert "places and refines" in fail(2, "render", scene, "--at", "1,2,3")
        assert "is the model itself" in fail(2, "render", scene, "--save-scene", scene, "-o", output)
        assert "FILE.json" in fail(2, "render", BOX, "--save-scene", "a.png")


def test_paths_in_a_scene_file_begin_in_its_folder():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, "models"))
        os.mkdir(os.path.join(folder, "scenes"))
        write_faces(os.path.join(folder, "models", "a b.obj"), [(0, 0, 0), (1, 0, 0), (0, 1, 0)])
        result = run("render", "models/a b.obj", "--at", "1,0,0", "--save-scene", "scenes/s.json", *SIZE, cwd=folder)
        assert result.returncode == 0, result.stderr
        path = os.path.join(folder, "scenes", "s.json")
        with open(path) as file:
            assert json.load(file)["models"][0]["model"] == "../models/a b.obj"
        first = read_file(os.path.join(folder, "rimline.png"))
        output = os.path.join(folder, "b.png")
        draw(output, path)
        assert read_file(output) == first


def test_animate_draws_scenes():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        corners = [(0, 0, 0), (1, 0, 0.5), (0, 1, 0)]
        one = write_faces(os.path.join(folder, "one.obj"), corners)
        both = write_faces(os.path.join(folder, "both.obj"), corners, [(x + 3, y, z) for x, y, z in corners])
        scene = write_scene(folder, {"rimline_scene": 1, "up": "y", "models": [{"model": "one.obj"},
                                                                               {"model": "one.obj", "at": [3, 0, 0]}],
                                     "cameras": {"still": {"eye": [1, 1, 9]}}, "picture": {"ground": True}})
        look = ("--size", "96x64", "--frames", "3", "--step", "20")
        folders = [os.path.join(folder, name) for name in "abcd"]
        # An option goes before the file: the ground follows it.
        said = succeed("render", scene, "--up", "z", *look[:2], "-o", os.path.join(folder, "z.png"))
        assert said["ground_up"] == [0, 0, 1]
        succeed("animate", both, "--up", "y", "--ground", *look, "-o", folders[0])
        succeed("animate", "--up", "y", one, one, "--at", "3,0,0", "--ground", *look, "-o", folders[1])
        said = succeed("animate", scene, *look, "-o", folders[2])
        for frame in range(3):
            pictures = {read_file(os.path.join(f, f"frame_{frame:04}.png")) for f in folders[:3]}
            assert len(pictures) == 1, frame
        assert said["path"] == "orbit" and len(said["models"]) == 2
        assert succeed("animate", scene, "--camera", "still", "--size", "96x64", "--frames", "2", "-o",
                       folders[3])["path"] == "still"


# The second of the two faces, as a model that is placed.
BOTH = [{"model": "one.obj"}, {"model": "one.obj", "at": [0.5, 0, -1], "scale": 2}]


def write_one_and_both(folder):
    corners = [(0, 0, 0), (1, 0, 0.5), (0, 1, 0)]
    placed = [(2 * x + 0.5, 2 * y, 2 * z - 1) for x, y, z in corners]
    return (write_faces(os.path.join(folder, "one.obj"), corners),
            write_faces(os.path.join(folder, "both.obj"), corners, placed))


def test_draw_draws_the_lines_of_scenes():
    with tempfile.TemporaryDirectory() as folder:
        one, both = write_one_and_both(folder)
        scene = write_scene(folder, {"rimline_scene": 1, "up": "y",
                                     "models": BOTH,
                                     "lights": [{"sun": [1, 1, 1]}],
                                     "cameras": {"front": {"eye": "front"},
                                                 "cut": {"eye": [0, 0.5, 3], "target": [0.5, 0.5, 0], "fov": 20}},
                                     "picture": {"style": "toon", "lines": False, "hidden": True, "size": "320x80"}})
        def lines(*arguments):
            path = os.path.join(folder, "a.json")
            said = succeed("draw", *arguments, "-o", path)
            with open(path) as file:
                return json.load(file), said
        whole, _ = lines(both, "--up", "y", "--eye", "front")
        placed, said = lines("--up", "y", one, one, "--at", "0.5,0,-1", "--model-scale", "2", "--eye", "front")
        of_file, _ = lines(scene)
        assert whole["views"][0]["chains"] and said["faces"] == 2
        for drawing in (placed, of_file):
            assert [m.get("at") for m in drawing["models"]] == [None, [0.5, 0, -1]]
            assert drawing["views"] == whole["views"]
        # A camera with its own lens shows what render shows: four times as wide as high, on a page of any form.
        for page in ("a4", "100x300"):
            left, low, right, high = lines(scene, "--camera", "cut", "--page", page)[0]["views"][0]["page"]["frame_mm"]
            assert abs((right - left) / (high - low) - 4) < 1e-6
        # The views of a sheet are of the whole scene, without its cameras.
        assert [view["name"] for view in lines(scene, "--views", "front,top")[0]["views"]] == ["front", "top"]
        for words, arguments in (("--camera", (scene, "--views", "front", "--camera", "cut")),
                                 ("--camera: belongs to a scene file", (one, "--camera", "cut")),
                                 ("--paint: lines have it only with --line-color material", (one, "--paint", "red")),
                                 ("this is the model itself", (scene, "-o", scene))):
            assert words in fail(2, "draw", *arguments), arguments
        svg = os.path.join(folder, "a.svg")
        succeed("draw", one, "--paint", "#0f0", one, "--at", "2,0,0", "--line-color", "material", "-o", svg)
        assert len(set(re.findall(rb'stroke="(rgb[^"]*)"', read_file(svg)))) == 1


def test_convert_writes_scenes_as_one_mesh():
    with tempfile.TemporaryDirectory() as folder:
        one, both = write_one_and_both(folder)
        scene = write_scene(folder, {"rimline_scene": 1, "up": "y", "cameras": {"front": {"eye": "front"}},
                                     "models": BOTH})
        outputs = [os.path.join(folder, name) for name in ("a.glb", "b.glb", "c.glb")]
        succeed("convert", both, "--up", "y", "--edges", "-o", outputs[0])
        said = succeed("convert", "--up", "y", one, one, "--at", "0.5,0,-1", "--scale", "2", "--edges", "-o", outputs[1])
        assert len(said["models"]) == 2 and said["up"] == [0, 1, 0]
        succeed("convert", scene, "--edges", "-o", outputs[2])
        assert read_file(outputs[0]) == read_file(outputs[1]) == read_file(outputs[2])
        # Classes of edges in files are kept where all models have them.
        said = succeed("convert", outputs[0], outputs[0], "--at", "9,0,0", "-o", outputs[1])
        assert said["edge_visibility"]["hard"] == 2 * succeed("info", outputs[0])["edge_visibility"]["hard"]
        result = run("convert", outputs[0], one, "--at", "9,0,0", "--json", "-o", outputs[1])
        assert json.loads(result.stdout)["edge_visibility"] is None
        assert one + ": has no classes of edges; those of the other models are left out" in result.stderr
        assert "only an axis" in fail(2, "convert", "--up", "1,1,0", one, one, "--at", "1,0,0", "-o", outputs[1])


def test_bad_scene_files_are_errors_with_the_place():
    good = {"rimline_scene": 1, "models": [{"model": BOX}]}
    def changed(**keys):
        return {**good, **keys}
    cases = [
        ("", "scene.json:1:1: is not JSON"),
        ('{"rimline_scene": 1,\n "models": [}', "scene.json:2:13: is not JSON"),
        ("[1]", "is not a scene: expected an object with \"rimline_scene\": 1"),
        ({"models": [{"model": BOX}]}, "is not a scene"),
        ({"rimline_scene": 2, "models": [{"model": BOX}]}, "scene.json:rimline_scene: expected version 1, not 2"),
        ({"rimline_scene": 1}, "it needs \"models\""),
        (changed(models=[]), "scene.json:models: expected at least one model"),
        (changed(models={"a": 1}), "scene.json:models: expected a list of models"),
        (changed(modles=[]), "scene.json:modles: there is no such key here"),
        (changed(modles=[]), "did you mean 'models'"),
        (changed(models=[{"model": BOX, "att": [1, 2, 3]}]), "scene.json:models[0].att: there is no such key"),
        (changed(models=[{"at": [1, 2, 3]}]), "scene.json:models[0]: it needs a \"model\""),
        (changed(models=[{"model": BOX, "at": [1, 2]}]), "scene.json:models[0].at: expected [x, y, z], not [1,2]"),
        (changed(models=[{"model": BOX, "at": [1, 2, "3"]}]), "scene.json:models[0].at: expected [x, y, z]"),
        (changed(models=[{"model": BOX, "at": [1e30, 2, 3]}]), "scene.json:models[0].at: expected coordinates of at most"),
        (changed(models=[{"model": BOX, "turn": [0, 0, 0, 3]}]), "scene.json:models[0].turn: expected a direction"),
        (changed(models=[{"model": BOX, "turn": 400}]), "scene.json:models[0].turn: expected at most 360"),
        (changed(models=[{"model": BOX, "scale": 0}]), "scene.json:models[0].scale: expected a number from"),
        (changed(models=[{"model": BOX, "subdivide": 1.5}]), "scene.json:models[0].subdivide: expected a whole number"),
        (changed(models=[{"model": BOX, "paint": "rad"}]), "scene.json:models[0].paint: expected #rgb"),
        (changed(models=[{"model": "shape:bxo"}]), "scene.json:models[0].model: no built-in shape"),
        (changed(models=[{"model": "-"}]), "scene.json:models[0].model: a scene file cannot name standard input"),
        (changed(models=[{"model": "b.json"}]), "scene.json:models[0].model: a scene file cannot hold another"),
        (changed(models=[{"model": BOX}, {"model": "missing.obj"}]), "scene.json:models[1].model: "),
        (changed(models=[{"model": "missing.obj"}]), "missing.obj: cannot open"),
        (changed(models=[{"model": "."}]), "scene.json:models[0].model: "),
        (changed(up="w"), "scene.json:up: "),
        (changed(lights=[{"sun": [1, 2, 3], "lamp": [1, 2, 3]}]), "scene.json:lights[0]: expected one of"),
        (changed(lights=[{"sun": [0, 0, 0]}]), "scene.json:lights[0].sun: expected a direction"),
        (changed(cameras={"a": {"eye": "frnt"}}), "scene.json:cameras.a.eye: "),
        (changed(cameras={"a": {"fov": 30, "ortho": 2}}), "scene.json:cameras.a: \"fov\" excludes"),
        (changed(cameras={"a": {"fov": 300}}), "scene.json:cameras.a.fov: expected a number from 0.01 to 170"),
        (changed(cameras=[]), "scene.json:cameras: expected an object"),
        (changed(picture={"style": "inc"}), "scene.json:picture.style: expected one of {ink,toon"),
        (changed(picture={"style": 3}), "scene.json:picture.style: expected a text, not 3"),
        (changed(picture={"ground": "yes"}), "scene.json:picture.ground: expected true or false"),
        (changed(picture={"size": "12"}), "scene.json:picture.size: expected WxH"),
        (changed(picture={"lighting": "threepoint"}), "scene.json:picture.lighting: expected one of {sun,three-point"),
        (changed(picture={"crease": 5}), "scene.json:picture.crease: expected a number from 10 to 180, or clear, not '5'"),
        (changed(picture={"crease": "sharp"}), "scene.json:picture.crease: expected a number from 10 to 180, or clear"),
        (changed(picture={"crease": "30"}), "scene.json:picture.crease: expected a number or a name, not \"30\""),
        (changed(picture={"crease": True}), "scene.json:picture.crease: expected a number or a name, not true"),
        (changed(cameras={"a": {"eye": "3,2,4"}}), "scene.json:cameras.a.eye: expected [x, y, z] or a name"),
        (changed(cameras={"a": {"eye": [3, 2, 4], "target": "0,0,0"}}), "scene.json:cameras.a.target: expected [x, y, z]"),
        (changed(cameras={"a": {"eye": [3, 2, 4], "target": [3, 2, 4]}}), "scene.json:cameras.a.target: is the same point as"),
        (changed(models=[{"model": BOX, "subdivide": 1.5}]), "scene.json:models[0].subdivide: expected a whole number"),
        (changed(picture={"silhouette-from": [9, 1, 1], "silhouette-direction": [1, 1, 1]}),
         "scene.json:picture: \"silhouette-from\" excludes \"silhouette-direction\""),
        (changed(picture={"style": "toon", "palette": "riso"}), "scene.json:picture.palette: the style toon has "),
        (changed(picture={"depth-step": 0.1}), "scene.json:picture.depth-step: belongs to --outline sobel"),
        (changed(lights=[{"lamp": [9, 1, 1]}], picture={"lighting": "three-point"}), "scene.json:picture.lighting: takes one"),
        (changed(picture={"style": "mask", "color": "red"}), "scene.json:picture.color: the style mask has only"),
        (changed(picture={"silhouette-from": [9, 1, 1], "min-length": 3}), "scene.json:picture.min-length: a frozen"),
        ('{"rimline_scene": 1, "models": [{"model": "shape:box", "at": [1,2,3], "at": [1,2,3]}]}', "scene.json:models[0].at: the key \"at\" occurs twice"),
        ('{"rimline_scene": 1, "models": [], "models": []}', "scene.json:models: the key"),
        ('{"rimline_scene": 1, "models": [{"model": "shape:box", "scale": 1e999}]}', "scene.json:models[0].scale: this number is out of range"),
        ('{"lights": [{}, {"sun": [1, [2, {}], {"a": 3}, 1e999]}]}', "scene.json:lights[1].sun[3]: this number is out of range"),
        ("-1e999", "scene.json: this number is out of range"),
    ]
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "a.png")
        for scene, expected in cases:
            path = write_scene(folder, scene)
            message = fail(1, "render", path, "-o", output)
            assert expected in message and path.rsplit("/", 1)[0] in message, (scene, message)
            assert sorted(os.listdir(folder)) == ["scene.json"], scene
        assert "missing.json: cannot open" in fail(1, "render", os.path.join(folder, "missing.json"), "-o", output)
        folder_name = os.path.join(folder, "folder.json")
        os.mkdir(folder_name)
        assert "is a folder" in fail(1, "render", folder_name, "-o", output)
