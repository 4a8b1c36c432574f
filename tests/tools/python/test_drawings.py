"""Line drawings and pictures: the same bytes as the program's, and wrong keywords."""

import os
import pathlib
import re
import subprocess
import sys
import threading
import xml.etree.ElementTree

import numpy as np
import pytest
from conftest import PROGRAM, have_device, orbit

import rimline


@pytest.fixture(scope="module")
def knot():
    return rimline.load("shape:knot:3000")


def run(*arguments):
    result = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300)
    assert result.returncode == 0, result.stderr


@pytest.mark.parametrize("keywords, options", [
    ({}, []),
    ({"eye": (3, 2, 4), "hidden": "dashed"}, ["--eye", "3,2,4", "--hidden", "dashed"]),
    ({"ortho": "auto", "lines": ["silhouette", "border"], "smooth": 0},
     ["--ortho", "auto", "--lines", "silhouette,border", "--smooth", "0"]),
    ({"page": "148x210", "margin": 5, "width": np.float32(0.5), "line_color": "red", "keep_coincident": True},
     ["--page", "148x210", "--margin", "5", "--width", "0.5", "--line-color", "red", "--keep-coincident"]),
])
@pytest.mark.parametrize("ending", [".svg", ".pdf", ".dxf"])
def test_drawings_are_those_of_the_command(knot, tmp_path, keywords, options, ending):
    if ending == ".dxf" and "line_color" in keywords:
        pytest.skip("DXF has no colors")
    page = [] if "page" in keywords else ["--page", "fit"]
    run("draw", "shape:knot:3000", *options, *page, "-o", str(tmp_path / f"command{ending}"))
    drawing = rimline.draw(knot, **keywords)
    drawing.save(tmp_path / f"python{ending}")
    saved = (tmp_path / f"python{ending}").read_bytes()
    assert saved == (tmp_path / f"command{ending}").read_bytes()
    text = {".svg": drawing.to_svg, ".pdf": drawing.to_pdf, ".dxf": drawing.to_dxf}[ending]()
    assert saved == (text if isinstance(text, bytes) else text.encode())
    if ending == ".svg":
        assert drawing._repr_svg_() == text
        xml.etree.ElementTree.fromstring(text)


def test_sizes_and_colors_may_be_numbers(knot):
    drawing = rimline.draw(knot, page=(148, 210), line_color=(1, 0.5, 0))
    assert drawing.to_svg() == rimline.draw(knot, page="148x210", line_color="#ff8000").to_svg()
    for wrong in ((255, 128, 0), (0.5, -0.1, 0), ("red", 0, 0), (0, 0, float("nan"))):
        with pytest.raises(ValueError, match="line_color: expected numbers from 0 to 1, not"):
            rimline.draw(knot, line_color=wrong)
    with pytest.raises(ValueError, match="page: "):
        rimline.draw(knot, page=(148, 210, 3))


def test_lines_have_the_colors_of_materials(tmp_path):
    model, path = tmp_path / "a.obj", tmp_path / "a.svg"
    (tmp_path / "a.mtl").write_text("newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n")
    model.write_text("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\n")
    keywords = {"eye": (1, 2, 3), "page": "a4", "line_color": "material"}
    drawn = rimline.draw(rimline.load(model), **keywords).to_svg()
    assert len(set(re.findall('stroke="(rgb[^"]*)"', drawn))) == 2
    run("draw", str(model), "--eye", "1,2,3", "--line-color", "material", "-o", str(path))
    assert drawn == path.read_text()


def test_scenes_check_their_options(knot):
    for wrong, error, message in (({"stlye": "ink"}, TypeError, "'stlye'.*did you mean 'style'"),
                                  ({"style": "oil"}, ValueError, "style: "), ({"fov": 1000}, ValueError, "fov: ")):
        with pytest.raises(error, match=message):
            rimline.Scene(knot, **wrong)
        with pytest.raises(error, match=message):
            rimline.Scene(knot).replace(**wrong)


def test_arrays_of_a_drawing_belong_together(knot):
    drawing = rimline.draw(knot, eye=(3, 2, 4), hidden="layer", smooth=0, simplify=0)
    points, runs, chains = drawing.points, drawing.runs, drawing.chains
    assert (runs[:, 1] < runs[:, 2]).all() and runs[-1, 2] == len(points) and chains[-1, 1] == len(runs)
    assert len(drawing.source_edges) == len(drawing.source_shares) == len(points)
    assert len(set(chains[:, 2].tolist())) == len(chains)
    # Points lie where their sources are, seen from the eye.
    edges, shares = drawing.source_edges, drawing.source_shares
    on_edges = edges >= 0
    ends = knot.vertices[knot.edges[edges[on_edges]]].astype(np.float64)
    places = ends[:, 0] + shares[on_edges, None] * (ends[:, 1] - ends[:, 0])
    eye = np.array([3.0, 2.0, 4.0])
    forward = knot.center - eye
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0, 1, 0])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    seen = places - eye
    depth = seen @ forward
    expected = np.stack([seen @ right / depth, seen @ up / depth, depth], axis=1)
    assert np.abs(points[on_edges, :3] - expected).max() < 1e-4
    assert drawing.report["failed_checks"] == 0
    width, height = drawing.page_mm
    for line in drawing.lines:
        assert line.kind in rimline.LINE_KINDS and line.points.shape[1] == 2
        assert line.points.min() >= 0 and (line.points <= [width, height]).all()
    assert {line.hidden for line in drawing.lines} == {True, False}
    del drawing
    assert points.shape[1] == 4 and np.isfinite(points).all()


def lengths(drawing):
    """Of visible and of hidden runs, in picture coordinates."""
    steps = np.linalg.norm(np.diff(drawing.points[:, :2], axis=0), axis=1)
    sums = [0.0, 0.0]
    for _, first, last, hidden_by in drawing.runs:
        sums[int(hidden_by > 0)] += steps[first : last - 1].sum()
    return sums


def test_chains_keep_their_ids_over_frames(knot):
    drawer, drawer_of_each = rimline.LineDrawer(knot), rimline.LineDrawer(knot)
    eyes = orbit(knot, 360)
    plain = {"smooth": 0, "simplify": 0, "stubble": 0, "gap": 0, "keep_coincident": True}
    ids = set(drawer.draw(eye=eyes[0], **plain).chains[:, 2].tolist())
    kept = 0
    for eye in eyes[1:20]:
        drawing = drawer.draw_next(eye=eye, **plain)
        fresh = drawer_of_each.draw(eye=eye, **plain)
        assert drawing.report == fresh.report and len(drawing.chains) == len(fresh.chains)
        assert lengths(drawing) == pytest.approx(lengths(fresh), rel=1e-9)
        now = set(drawing.chains[:, 2].tolist())
        kept += len(now & ids)
        ids = now
    assert kept > 15 * len(ids) / 2


@pytest.mark.parametrize("keywords, error, words", [
    ({"lines": [], "fov": 40}, ValueError, r"lines: expected a value, not \[\]"),
    ({"eye": "", "fov": 40}, ValueError, "eye: expected a value, not ''"),
    ({"colour": "red"}, TypeError, "unexpected keyword argument 'colour'"),
    ({"hiden": "dashed"}, TypeError, "did you mean 'hidden'"),
    ({"help": True}, TypeError, "unexpected"),
    ({"hidden": True}, ValueError, "^hidden: expected one of {none,dashed,layer}, not True"),
    ({"hidden": "Layer"}, ValueError, "hidden: expected one of .*, not 'Layer'; did you mean 'layer'?"),
    ({"eye": (1, 2)}, ValueError, "eye"),
    ({"eye": (1, 2, float("nan"))}, ValueError, "eye"),
    ({"eye": object()}, TypeError, "eye"),
    ({"line_color": "no-color"}, ValueError, "line_color"),
    ({"width": -1}, ValueError, "width"),
    ({"keep_coincident": "yes"}, TypeError, "keep_coincident: expected True or False, not str"),
    ({"keep_coincident": 1}, TypeError, "keep_coincident"),
    ({"eye": (1, 2)}, ValueError, r"eye: .*, not \(1, 2\)"),
    ({"eye": b"abc"}, TypeError, "eye: .*, not bytes"),
    ({"eye": (True, 2, 3)}, TypeError, "eye: .*, not True"),
    ({"width": 1j}, TypeError, "width: expected a number, not complex"),
    ({"ortho": True}, ValueError, "ortho: .*, not True"),
    ({"ortho": np.bool_(True)}, ValueError, "ortho: .*, not (np.)?True"),
    ({"scale": "1:2"}, ValueError, "orthographic"),
    ({"hidden_by": 2}, ValueError, "hidden"),
    ({"fov": 30, "ortho": "auto"}, ValueError, "ortho|fov"),
])
def test_wrong_keywords_are_errors_that_name_them(knot, keywords, error, words):
    with pytest.raises(error, match=words) as caught:
        rimline.draw(knot, **keywords)
    assert "--" not in str(caught.value)


def test_files_are_written_whole_or_not_at_all(knot, tmp_path):
    have_device()
    drawing = rimline.draw(knot)
    for name in ("drawing.txt", "drawing.json", "drawing"):
        with pytest.raises(ValueError, match=rf"path: expected .* \.svg, \.pdf or \.dxf, not '.*{name}'"):
            drawing.save(tmp_path / name)
    picture = rimline.render(knot, size=(32, 24))
    with pytest.raises(ValueError, match="path: pictures are saved as .png, not '.*picture.jpg'"):
        picture.save(tmp_path / "picture.jpg")
    for thing, name in ((drawing, "drawing.svg"), (picture, "picture.png")):
        missing = tmp_path / "missing"
        with pytest.raises(rimline.FileError, match=f"{missing}/{name}: .*there is no folder {missing}"):
            thing.save(missing / name)
        for wrong, error in (("", ValueError), ("-", ValueError), ("a\0.svg", ValueError), (3, TypeError)):
            with pytest.raises(error, match="path: "):
                thing.save(wrong)
    assert list(tmp_path.iterdir()) == []


def picture_of(array):
    return np.asarray(array).view(rimline.Picture)


def test_pictures_are_saved_as_they_are(tmp_path):
    pixels = np.random.default_rng(4).integers(0, 256, (7, 10, 4), dtype=np.uint8)
    path = os.fsencode(tmp_path / "picture.png")
    for picture in (picture_of(pixels), picture_of(pixels)[::2, ::-1], picture_of(np.asfortranarray(pixels))):
        picture.save(path)
        with open(path, "rb") as file:
            assert file.read() == picture._repr_png_() == picture_of(picture.copy())._repr_png_()
    picture_of(pixels).save(path)
    read = pytest.importorskip("matplotlib.image").imread(tmp_path / "picture.png")
    assert (np.rint(255 * read) == pixels).all()


def test_only_bytes_of_colors_are_saved(tmp_path):
    pixels = np.full((4, 5, 4), 200, dtype=np.uint8)
    for array in (pixels / 255, pixels.astype(int) + 300, np.full(pixels.shape, np.nan), pixels.astype(bool),
                  pixels.astype(np.int8)):
        with pytest.raises(TypeError, match=f"picture: expected an array of uint8, not {array.dtype}"):
            picture_of(array).save(tmp_path / "picture.png")
    for array in (pixels[0], pixels[:, :, :3], pixels[:0]):
        with pytest.raises(ValueError, match=r"picture: expected the shape \(H, W, 4\), not"):
            picture_of(array).save(tmp_path / "picture.png")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("keywords, options", [
    ({}, []),
    ({"style": "toon", "ground": True, "sun": (1, 2, 1)}, ["--style", "toon", "--ground", "--sun", "1,2,1"]),
    ({"eye": "front", "background": "none", "lines": False, "light": [(3, 4, 5), (-3, 4, 5)]},
     ["--eye", "front", "--background", "none", "--lines", "off", "--light", "3,4,5", "--light", "-3,4,5"]),
])
def test_pictures_are_those_of_the_command(knot, tmp_path, keywords, options):
    have_device()
    run("render", "shape:knot:3000", *options, "--size", "160x120", "-o", str(tmp_path / "command.png"))
    picture = rimline.render(knot, size=(160, 120), **keywords)
    assert picture.shape == (120, 160, 4) and picture.dtype == np.uint8
    assert picture._repr_png_() == (tmp_path / "command.png").read_bytes()
    picture.save(tmp_path / "python.png")
    assert (tmp_path / "python.png").read_bytes() == picture._repr_png_()
    assert sorted(os.listdir(tmp_path)) == ["command.png", "python.png"]
    assert picture[:, :, 0]._repr_png_() is None


def test_a_renderer_draws_one_mesh_after_another(knot):
    have_device()
    renderer = rimline.Renderer(validate=bool(os.environ.get("RIMLINE_VALIDATE")))
    assert renderer.device_name
    scene = rimline.Scene(knot, size=(64, 48))
    first = renderer.render(scene)
    for _ in range(20):
        # Freed meshes leave their addresses to others.
        renderer.render(rimline.load("shape:torus:2000"), size=(64, 48))
    assert (renderer.render(scene) == first).all()
    assert (renderer.render(scene.replace(color=(1, 0, 0))) == renderer.render(scene.replace(color="red"))).all()
    assert (renderer.render(scene.replace(style="toon")) != first).any()
    assert (scene.replace(style="toon").replace(style="ink").options["size"]) == "64x48"
    for wrong, error in ((32, TypeError), ((32,), ValueError), ((32, "a"), TypeError), ((32.5, 5), TypeError)):
        with pytest.raises(error, match="size: expected width and height, not"):
            renderer.render(knot, size=wrong)
    with pytest.raises(ValueError, match="sun: .*, not 'noon'"):
        renderer.render(knot, size=(64, 48), sun=[(1, 1, 1), "noon"])
    assert (renderer.render(scene.replace(ground=np.bool_(True))) == renderer.render(scene.replace(ground=True))).all()
    assert (renderer.render(scene.replace(ground=np.bool_(False))) == first).all()
    for wrong in ({"size": (0, 5)}, {"size": (20000, 5)}, {"style": "oil"}, {"palette": "none"}, {"eye": "above"}):
        with pytest.raises(ValueError):
            renderer.render(knot, **wrong)
    with pytest.raises(TypeError, match="unexpected keyword argument 'device'"):
        renderer.render(knot, device="cpu")
    with pytest.raises(TypeError):
        renderer.render(None)
    assert (renderer.render(scene) == first).all()
    assert renderer.validation_message_count in (None, 0)


def test_threads_take_turns_at_a_renderer(knot):
    have_device()
    renderer = rimline.Renderer()
    meshes = [knot, rimline.load("shape:torus:2000"), rimline.load("shape:box")]
    expected = [rimline.Renderer().render(mesh, size=(64, 48)) for mesh in meshes]
    failures = []

    def work(number):
        for turn in range(6):
            mesh = (number + turn) % 3
            if (renderer.render(meshes[mesh], size=(64, 48)) != expected[mesh]).any():
                failures.append((number, turn))

    threads = [threading.Thread(target=work, args=(number,)) for number in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures


def test_a_machine_without_the_device_is_told_so():
    have_device()
    with pytest.raises(rimline.NoDeviceError, match="no-such-device"):
        rimline.Renderer("no-such-device")
    assert all(len(device) == 3 for device in rimline.devices())


def test_drawings_have_points_where_the_locale_has_commas(tmp_path):
    made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", str(tmp_path / "de_DE.UTF-8")], capture_output=True)
    if made.returncode != 0:
        pytest.skip("localedef has no de_DE here")
    script = """
import locale, rimline
knot = rimline.load("shape:knot:3000")
def texts():
    drawing = rimline.draw(knot, eye=(2.5, 1.25, 3), gap=0.75)
    return [drawing.to_svg(), drawing.to_pdf(), drawing.to_dxf()]
before = texts()
locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
assert locale.format_string("%g", 0.5) == "0,5"
assert texts() == before
"""
    result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=300,
                            env={**os.environ, "LOCPATH": str(tmp_path), "PYTHONPATH": os.pathsep.join(sys.path)})
    assert result.returncode == 0, result.stderr


def test_options_of_the_command_are_keywords_or_named_as_its_own():
    text = (pathlib.Path(__file__).resolve().parents[3] / "docs/python.md").read_text()
    box = rimline.load("shape:box")
    for name, call in (("render", rimline.Scene), ("draw", rimline.draw)):
        own = set(re.findall(r"`(\w+)`", re.search(rf"^- of `rimline {name}`, (.*?)[;.]$", text, re.M | re.S)[1]))
        shown = subprocess.run([PROGRAM, name, "--help"], capture_output=True, text=True).stdout
        groups = re.split(r"^(\w+):$", shown, flags=re.M)[1:]
        options = [(option.replace("-", "_"), group) for group, lines in zip(groups[::2], groups[1::2])
                   for option in re.findall(r"^ +--([a-z-]+)", lines, re.M)]
        assert own <= {option for option, _ in options}
        # The others are of files and machines.
        for option, group in options:
            if group not in ("Style", "Camera", "Light", "Image", "Page", "Lines"):
                continue
            with pytest.raises((TypeError, ValueError)) as caught:
                call(box, **{option: object()})
            assert ("unexpected" in str(caught.value)) == (option in own), option
            assert call is rimline.draw or option in own or option in rimline.Scene.__doc__, option


def test_progress_of_a_picture_leaves_time_for_the_device():
    have_device()
    shares = []
    rimline.render(rimline.load("shape:knot:20000"), size=(64, 64), progress=shares.append)
    assert shares == sorted(shares) and shares[-1] == 1.0 and shares[-2] < 0.7
