#!/usr/bin/env python3
"""Makes the figures and tables of docs/results/hough.md: counts with the program, draws with gnuplot.

    tools/figures/plot_figures.py                 everything, from the models in the folders of $RIMLINE_MODELS
    tools/figures/plot_figures.py --keep FOLDER   keeps the counts there, and takes those that are there already

Counts are the same on every machine; a run takes some minutes. What the page says between
<!-- figures: NAME --> and <!-- end --> is replaced.
"""

import argparse
import json
import math
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "tools" / "figures"
PAGE = ROOT / "docs" / "results" / "hough.md"

# Name, title, file, options of the program. A panel of the figures is one of the first six.
MODELS = [
    ("bunny", "Bunny", "stanford-bunny.obj", []),
    ("horse", "Horse", "horse.ply", []),
    ("igea", "Igea", "igea.ply", []),
    ("nefertiti", "Nefertiti", "nefertiti.obj", []),
    ("rocker_arm", "Rocker_arm", "rocker-arm.obj", []),
    ("fandisk", "Fandisk", "fandisk.obj", []),
    ("horse_40k", "Horse,_clustered", "horse.ply", ["--most-faces", "39698"]),
]
PANELS = MODELS[:6]

# Table 4.2 of the thesis: faces, silhouette, box checks with the centroid as the one origin.
THESIS = {"bunny": (69452, 3498, 20376), "horse_40k": (39698, 2511, 16049),
          "igea": (268686, 7191, 36757)}
# Of the counts by each reading.
READ = [model for model in MODELS if model[0] in ("bunny", "igea", "rocker_arm", "fandisk")]
METHODS = [("full", "Hough, full traversal"), ("dual", "dual, full traversal"),
           ("full_octants", "Hough, full traversal by octants"),
           ("dual_octants", "dual, full traversal by octants"),
           ("as_written", "Hough, incremental as written"),
           ("incremental", "Hough, incremental, complete"), ("index", "index")]


def find_model(file_name):
    for folder in os.environ.get("RIMLINE_MODELS", "").split(":"):
        path = pathlib.Path(folder) / file_name
        if folder and path.exists():
            return path
    sys.exit(f"plot_figures.py: {file_name} is in no folder of RIMLINE_MODELS")


def counts(program, folder, model):
    name, _, file_name, options = model
    kept = folder / f"{name}.json"
    if not kept.exists():
        print(f"counting {name}", flush=True)
        command = [program, "bench", "hough", find_model(file_name), "--figures", "--json", *options]
        result = subprocess.run(command, stdout=subprocess.PIPE, check=False)
        if result.returncode != 0:
            sys.exit(f"plot_figures.py: {' '.join(map(str, command))} failed")
        kept.write_bytes(result.stdout)
    data = json.loads(kept.read_text(encoding="utf-8"))["figures"][0]
    if not data["verified"]:
        sys.exit(f"plot_figures.py: {name} differs from brute force: {data['difference']}")
    return data


def readings(program, folder, model):
    name, _, file_name, options = model
    kept = folder / f"{name}_readings.json"
    if not kept.exists():
        print(f"counting readings of {name}", flush=True)
        command = [program, "bench", "hough", find_model(file_name), "--readings", "--viewpoints", "300", "--json", *options]
        result = subprocess.run(command, stdout=subprocess.PIPE, check=False)
        if result.returncode != 0:
            sys.exit(f"plot_figures.py: {' '.join(map(str, command))} failed")
        kept.write_bytes(result.stdout)
    return json.loads(kept.read_text(encoding="utf-8"))["readings"][0]


def write_rows(path, rows):
    path.write_text("".join(" ".join(map(str, row)) + "\n" for row in rows), encoding="utf-8")


def write_histogram(path, counts_, farthest):
    step = farthest / len(counts_)
    write_rows(path, [((i + 0.5) * step, count) for i, count in enumerate(counts_)])


def write_data(folder, data):
    """One file a curve or panel."""
    bunny = data["bunny"]
    for space in ("hough", "dual"):
        write_rows(folder / f"{space}.dat", bunny[space]["sample"])
        write_histogram(folder / f"{space}_distances.dat", bunny[space]["distances"],
                        bunny[space]["farthest"] if space == "dual" else 1.0)
    for name, *_ in PANELS:
        model = data[name]
        hough, dual = model["hough"]["leaf_depths"], model["dual"]["leaf_depths"]
        depth = max(len(hough), len(dual))
        write_rows(folder / f"{name}_depths.dat",
                   [(d, *(100 * (leaves[d] if d < len(leaves) else 0) / sum(leaves)
                          for leaves in (hough, dual))) for d in range(depth)])
        write_rows(folder / f"{name}_resolutions.dat",
                   [(r["faces"], r["silhouette"], r["literal_pbv_checks"] + r["literal_ebv_checks"],
                     r["index_box_checks"]) for r in model["resolutions"]])
        orbit = model["orbit"]
        drawn = [orbit[key][what] for what in ("boxes", "faces")
                 for key in ("dual", "full", "as_written", "incremental", "index")]
        frames = len(orbit["turned"])
        write_rows(folder / f"{name}_orbit.dat",
                   [(360 * (i + 1) / frames, *row) for i, row in enumerate(zip(*drawn))])
    layout = data["horse"]["layout"]
    write_rows(folder / "layout_points.dat", layout["points"])
    write_rows(folder / "poles.dat", [(0, 0), layout["pole"]])
    for end in ("inside", "outside", "looked_at"):
        write_rows(folder / f"boxes_{end}.dat",
                   [((b[0] + b[2]) / 2, (b[1] + b[3]) / 2, b[0], b[2], b[1], b[3])
                    for b in layout["boxes"] if b[5] == end])


def draw(folder, script, picture, **variables):
    def text(value):
        return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else str(value)

    variables |= {"out": str(picture), "style": str(SCRIPTS / "style.gp")}
    settings = "; ".join(f"{name} = {text(value)}" for name, value in variables.items())
    subprocess.run(["gnuplot", "-e", settings, SCRIPTS / script], cwd=folder, check=True)


def draw_all(folder, pictures, data):
    bunny, layout = data["bunny"], data["horse"]["layout"]
    panels = {"models": " ".join(m[0] for m in PANELS), "titles": " ".join(m[1] for m in PANELS)}
    panels["titles"] = panels["titles"].replace("_", "\u00a0")
    draw(folder, "points.gp", pictures / "points.png", dual_99=bunny["dual"]["percentile_99"],
         dual_far=bunny["dual"]["farthest"])
    draw(folder, "depths.gp", pictures / "depths.png", **panels)
    draw(folder, "resolutions.gp", pictures / "resolutions.png",
         **{m: f"{m}_resolutions.dat" for m in ("igea", "bunny", "horse", "nefertiti")})
    draw(folder, "orbit.gp", pictures / "box_checks.png", first=2, rows=2, **panels)
    thesis_models = {"models": "bunny horse igea", "titles": "Bunny Horse Igea"}
    draw(folder, "orbit.gp", pictures / "face_checks.png", first=7, rows=1, **thesis_models)
    draw(folder, "block_order.gp", pictures / "block_order.png", blocks=layout["blocks"])
    pole = layout["pole"]
    draw(folder, "walk.gp", pictures / "walk.png", pole_x=pole[0], pole_y=pole[1])


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def number(value):
    return f"{value:,.0f}"


def viewpoint_mean(model, *keys):
    """Over all viewpoints, which are as dense on each sphere."""
    weights = [sphere["radius"] ** 2 for sphere in model["extraction"]]
    return sum(w * sum(sphere[key] for key in keys)
               for w, sphere in zip(weights, model["extraction"])) / sum(weights)


def table_4_2(data):
    rows = []
    for name, title, *_ in MODELS:
        model, thesis = data[name], THESIS.get(name)
        silhouette = viewpoint_mean(model, "silhouette")
        boxes = viewpoint_mean(model, "literal_pbv_checks", "literal_ebv_checks")
        rows.append([title.replace("_", " "), number(model["faces"]), number(silhouette),
                     number(thesis[1]) if thesis else "", number(boxes),
                     number(thesis[2]) if thesis else "", f"{boxes / silhouette:.2f}",
                     f"{thesis[2] / thesis[1]:.2f}" if thesis else "",
                     number(viewpoint_mean(model, "literal_all_pbv_checks",
                                           "literal_all_ebv_checks")),
                     number(viewpoint_mean(model, "index_box_checks") / 8)])
    return table(["", "faces", "silhouette", "thesis", "box checks", "thesis", "an edge", "thesis",
                  "with leaves' boxes", "nodes of the index"], rows)


def slope(points):
    """Of the least-squares line through the points' logarithms."""
    xs, ys = [math.log(x) for x, _ in points], [math.log(y) for _, y in points]
    mx, my = statistics.mean(xs), statistics.mean(ys)
    return (sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / sum((x - mx) ** 2 for x in xs))


def growth(data):
    rows = []
    for name, title, *_ in PANELS:
        steps = data[name]["resolutions"]
        boxes = [r["literal_pbv_checks"] + r["literal_ebv_checks"] for r in steps]
        rows.append([title.replace("_", " "), f"{number(steps[0]['faces'])} to {number(steps[-1]['faces'])}",
                     f"{slope([(r['faces'], r['silhouette']) for r in steps]):.2f}",
                     f"{slope([(r['faces'], b) for r, b in zip(steps, boxes)]):.2f}",
                     f"{slope([(r['silhouette'], b) for r, b in zip(steps, boxes)]):.2f}",
                     f"{boxes[0] / steps[0]['silhouette']:.1f}", f"{boxes[-1] / steps[-1]['silhouette']:.1f}"])
    return table(["", "faces", "silhouette ~ faces^", "boxes ~ faces^", "boxes ~ silhouette^",
                  "boxes an edge, first", "last"], rows)


def orbit(data, what):
    names = [(m[0], m[1].replace("_", " ")) for m in PANELS]
    rows = []
    for key, title in METHODS:
        row = [title]
        for name, _ in names:
            values = data[name]["orbit"][key][what]
            mean = statistics.mean(values)
            row.append(f"{number(mean)} ± {100 * statistics.pstdev(values) / mean:.0f}%")
        rows.append(row)
    extra = {"boxes": [("above_candidates", "*of the full traversal, above all candidates*")],
             "faces": [("turned", "*faces that turn*"),
                       ("wrong_faces", "*wrong bits after the walk as written*")]}
    for key, title in extra[what]:
        rows.append([title] + [f"{statistics.mean(data[n]['orbit'][key]):,.0f}" for n, _ in names])
    return table([""] + [title for _, title in names], rows)


def depths(data):
    def about(space):
        leaves = space["leaf_depths"]
        mean = sum(d * n for d, n in enumerate(leaves)) / sum(leaves)
        return [f"{mean:.1f}", str(len(leaves) - 1), number(space["nodes"]), f"{space['farthest']:.3g}"]

    rows = [[title.replace("_", " "), *about(data[name]["hough"]), *about(data[name]["dual"])]
            for name, title, *_ in PANELS]
    return table(["", "Hough: mean depth", "deepest", "nodes", "farthest point", "dual: mean depth",
                  "deepest", "nodes", "farthest point"], rows)


def box_tests(data):
    """Box checks by test, and over those of the thesis."""
    tests = [("exact", "exact"), ("inside_sphere", "inside by a sphere"), ("spheres", "both by a sphere"),
             ("intervals", "intervals"), ("sphere_box", "outside by the v-sphere's box"),
             ("ebv_first", "exact, EBV first")]
    rows = []
    for name, title, *_ in READ:
        counted, thesis = data[name]["box_tests"], THESIS.get(name)
        rows.append([title.replace("_", " "), number(thesis[2]) if thesis else ""]
                    + [number(counted[test]) + (f" ({counted[test] / thesis[2]:.2f})" if thesis else "")
                       for test, _ in tests])
    return table(["", "thesis"] + [title for _, title in tests], rows)


def orbits(data):
    """Box checks in dual space over those in Hough space."""
    names = [(m[0], m[1].replace("_", " ")) for m in READ]
    keys = [(o["radii"], o["step_degrees"]) for o in data[names[0][0]]["orbits"]]
    rows = []
    for i, (radii, step) in enumerate(keys):
        rows.append([f"{radii:g}", f"{step:g}°"]
                    + [f"{data[n]['orbits'][i]['dual'] / data[n]['orbits'][i]['hough']:.2f}" for n, _ in names])
    return table(["radii", "step"] + [title for _, title in names], rows)


def walk(data):
    layout = data["horse"]["layout"]
    return (f"In all of the tree, not the slice alone: {number(layout['boxes_tested'])} boxes are tested, "
            f"which settles\n{number(layout['blocks_settled'])} of {number(layout['blocks'])} blocks and leaves "
            f"{number(layout['blocks_looked_at'])} to look at.")


def write_page(data, read):
    tables = {"walk": walk(data), "table_4_2": table_4_2(data), "growth": growth(data), "boxes": orbit(data, "boxes"),
              "faces": orbit(data, "faces"), "depths": depths(data), "box_tests": box_tests(read), "orbits": orbits(read)}
    page = PAGE.read_text(encoding="utf-8")
    for name, text in tables.items():
        block = re.compile(rf"(<!-- figures: {name} -->\n).*?(<!-- end -->)", re.DOTALL)
        page, count = block.subn(lambda match: match[1] + "\n" + text + "\n\n" + match[2], page)
        if count != 1:
            sys.exit(f"plot_figures.py: {PAGE.name} has {count} places for {name}")
    PAGE.write_text(page, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--program", default=ROOT / "build/release/rimline", type=pathlib.Path)
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the counts")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        kept = options.keep or folder
        kept.mkdir(parents=True, exist_ok=True)
        data = {model[0]: counts(options.program, kept, model) for model in MODELS}
        read = {model[0]: readings(options.program, kept, model) for model in READ}
        pictures = PAGE.with_suffix("")
        pictures.mkdir(exist_ok=True)
        write_data(folder, data)
        draw_all(folder, pictures, data)
    write_page(data, read)


main()
