#!/usr/bin/env python3
"""Makes the figures and tables of docs/results/views.md with the program; draws the path with gnuplot.

    tools/figures/plot_views.py [--program PROGRAM] [--only tables|pictures|path]

Models are those of the folders of $RIMLINE_MODELS. Pictures and tables come out alike on the same device.
What the page says between <!-- figures: NAME --> and <!-- end --> is replaced.
"""

import argparse
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "results" / "views.md"
PICTURES = ROOT / "docs" / "results" / "views"
# Title, file, up axis.
MODELS = [("Bunny", "stanford-bunny.obj", "0,1,0"), ("Horse", "horse.ply", "0,0,1"),
          ("Rocker arm", "rocker-arm.obj", "0,1,0"), ("Fandisk", "fandisk.obj", "0,1,0")]
# From where the path is looked at: towards the viewer.
PATH_VIEW = (0.75, 0.9, 0.5)


def find_model(file_name):
    for folder in os.environ.get("RIMLINE_MODELS", "").split(":"):
        path = pathlib.Path(folder) / file_name
        if folder and path.exists():
            return path
    sys.exit(f"plot_views.py: {file_name} is in no folder of RIMLINE_MODELS")


def run(program, *arguments):
    command = [program, *map(str, arguments)]
    result = subprocess.run(command, stdout=subprocess.PIPE, check=False)
    if result.returncode != 0:
        sys.exit(f"plot_views.py: {' '.join(map(str, command))} failed")
    return result.stdout


def replace(name, text):
    page = PAGE.read_text(encoding="utf-8")
    page, count = re.subn(rf"(<!-- figures: {name} -->\n).*?(<!-- end -->)",
                          lambda m: m[1] + text + "\n" + m[2], page, flags=re.DOTALL)
    if count != 1:
        sys.exit(f"plot_views.py: {PAGE} has no place for {name}")
    PAGE.write_text(page, encoding="utf-8")


def degrees(value):
    return "" if value is None else f"{value:.1f}°"


def tables(program):
    views, lights, work = [], [], []
    for title, file_name, _ in MODELS:
        model = json.loads(run(program, "bench", "views", find_model(file_name), "--json"))["models"][0]
        views += ["", f"| {title}, {model['faces']:,} faces | faces seen | least apart | mean | most | "
                  "first view, a quarter of the faces | 0.1% noise |", "|---|---|---|---|---|---|---|"]
        for row in model["views"]:
            views.append(f"| {row['name']} | {100 * row['seen']:.1f}% | {row['least_apart_deg']:.0f}° | "
                         f"{row['mean_apart_deg']:.0f}° | {row['most_apart_deg']:.0f}° | "
                         f"{degrees(row['simplified_deg'])} | {degrees(row['noisy_deg'])} |")
        for i, row in enumerate(model["lights"]):
            lights.append(f"| {'' if i else title} | {row['name']} | {100 * row['away']:.1f}% | "
                          f"{100 * row['unlit']:.1f}% | {row['contrast']:.4f} |")
        work.append(f"| {title} | {model['renders']} | {model['candidates']} | {model['lattice_candidates']} | "
                    f"{model['lattice_candidates'] / model['renders']:.0f}x |")
    replace("measures", "\n".join(views[1:]))
    replace("lights", "\n".join(["| | light | turned away | unlit, cast shadows too | contrast |", "|---|---|---|---|---|",
                                 *lights]))
    replace("work", "\n".join(["| | measured | candidates | lattice, view by view | fewer |",
                               "|---|---|---|---|---|", *work]))


def pictures(program):
    for title, file_name, up in MODELS:
        if title in ("Horse", "Fandisk"):
            run(program, "bench", "views", find_model(file_name), "--pictures", PICTURES, "--up", up)
    shown = set(re.findall(r"\(views/(.*?\.png)\)", PAGE.read_text(encoding="utf-8")))
    for picture in PICTURES.glob("*.png"):
        if picture.name not in shown:
            picture.unlink()


def read_lines(path):
    """The edges of an OBJ that `rimline silhouette` wrote, as pairs of points."""
    points, edges = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["l"]:
            edges.append((int(words[1]) - 1, int(words[2]) - 1))
    return [(points[a], points[b]) for a, b in edges]


def path(program):
    model = find_model("horse.ply")
    found = json.loads(run(program, "path", model, "-k", "4", "--frames", "720", "--json"))
    length = math.hypot(*PATH_VIEW)
    back = tuple(x / length for x in PATH_VIEW)
    flat = math.hypot(back[0], back[1])
    right = (-back[1] / flat, back[0] / flat, 0.0)
    up = (back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2],
          back[0] * right[1] - back[1] * right[0])

    def place(point):
        p = [(a - c) / found["radius"] for a, c in zip(point, found["center"])]
        return tuple(sum(a * b for a, b in zip(p, axis)) for axis in (right, up, back))

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        lines = folder / "lines.obj"
        run(program, "silhouette", model, "--direction", ",".join(map(str, PATH_VIEW)), "--no-edges", "-o", lines)
        (folder / "model.dat").write_text("".join(
            "%g %g\n%g %g\n\n" % (*place(a)[:2], *place(b)[:2]) for a, b in read_lines(lines)))
        samples = [place(sample) for sample in found["samples"]]
        votes = found["sample_votes"]
        closed = list(zip(samples, votes)) + [(samples[0], votes[0])]
        (folder / "path.dat").write_text("".join(
            "%g %g %g %g\n" % (*p, v) for p, v in closed))
        shares = [min(range(len(samples)), key=lambda i: math.dist(samples[i], place(node))) / len(samples)
                  for node in found["nodes"]]
        most = max(votes + found["node_votes"])
        rows = ["%g %g %g %g %d\n" % (*place(node)[:2], share, vote / most, 0 if view is None else view + 1)
                for node, share, vote, view in zip(found["nodes"], shares, found["node_votes"], found["node_views"])]
        (folder / "nodes.dat").write_text("".join(rows))
        (folder / "votes.dat").write_text("".join(
            "%g %g\n" % (i / len(samples), v / most) for i, (_, v) in enumerate(closed)))
        settings = "; ".join([f"out = '{PICTURES / 'path.png'}'", f"style = '{ROOT / 'tools' / 'figures' / 'style.gp'}'"])
        subprocess.run(["gnuplot", "-e", settings, ROOT / "tools" / "figures" / "path.gp"], cwd=folder, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=ROOT / "build" / "release" / "rimline")
    parser.add_argument("--only", choices=("tables", "pictures", "path"))
    options = parser.parse_args()
    PICTURES.mkdir(exist_ok=True)
    for name, make in (("tables", tables), ("pictures", pictures), ("path", path)):
        if options.only in (None, name):
            make(options.program)


if __name__ == "__main__":
    main()
