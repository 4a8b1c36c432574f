#!/usr/bin/env python3
"""Makes the figures and tables of docs/results/field.md from what the program says. Draws curves with gnuplot.

    tools/figures/plot_fields.py [PROGRAM]        models from the folders of $RIMLINE_MODELS
    tools/figures/plot_fields.py --alphas FILE    only what α does, from the counts that FILE has, or will have

Counts and slices are the same on every machine, but for rounding; a run takes some minutes, the counts over α
half an hour. What the page says between <!-- figures: NAME --> and <!-- end --> is replaced.
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
PAGE = ROOT / "docs" / "results" / "field.md"
OUT = ROOT / "docs" / "results" / "field"
PROGRAM = str(ROOT / "build" / "release" / "rimline")

FUNCTIONS = ["facing", "far", "near", "silhouette", "off-silhouette", "far-front", "near-front",
             "angle-small", "angle-moderate", "angle-large", "origins", "views", "views-far", "light"]
ANGLES = ["angle-small", "angle-moderate", "angle-large"]

# Title, file, faces of the thesis's model, its boxes with the centroid, origins, its boxes with those,
# its time for finding them in seconds.
MODELS = [("Horse", "horse.ply", 39698, 16049, 3, 6884, 532),
          ("Bunny", "stanford-bunny.obj", 69452, 20376, 3, 9073, 1009),
          ("Igea", "igea.ply", 268686, 36757, 4, 20268, 4592)]
OTHERS = [("Nefertiti", "nefertiti.obj"), ("Rocker arm", "rocker-arm.obj"),
          ("Fandisk", "fandisk.obj")]
# Of the counts over alpha; models with more faces are clustered to as many as the thesis's horse has.
# All are in the tables, the first ALPHA_PANELS are drawn. Those above --most-faces are clustered.
ALPHA_PANELS = 3
ALPHA_MODELS = [("Fandisk", "fandisk.obj"), ("Rocker arm", "rocker-arm.obj"), ("Horse, clustered", "horse.ply"),
                ("Alligator", "alligator.obj"), ("Beetle", "beetle-alt.obj"), ("Ogre, clustered", "ogre.obj"),
                ("Bunny, clustered", "stanford-bunny.obj"), ("Nefertiti, clustered", "nefertiti.obj"),
                ("Igea, clustered", "igea.ply")]
ALPHA_COUNTS = ("--viewpoints", 60, "--most-faces", 39698)

# One face in the plane z = 0: the field around it is the function itself.
ONE_FACE = "OFF\n3 1 0\n-1 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"


def find_model(file_name):
    for folder in os.environ.get("RIMLINE_MODELS", "").split(":"):
        path = pathlib.Path(folder) / file_name
        if folder and path.exists():
            return str(path)
    sys.exit(f"plot_fields.py: {file_name} is in no folder of RIMLINE_MODELS")


def ask(*arguments):
    command = [PROGRAM, *map(str, arguments), "--json"]
    result = subprocess.run(command, stdout=subprocess.PIPE, check=False)
    if result.returncode != 0:
        sys.exit(f"plot_fields.py: {' '.join(command)} failed")
    return json.loads(result.stdout)


def point(vector):
    return ",".join(f"{x:.9g}" for x in vector)


def gnuplot(script, folder):
    subprocess.run(["gnuplot", "-e", script], cwd=folder, check=True)


def style(out, wide, high):
    return f"out = '{out}'; wide = {wide}; high = {high}; load '{ROOT / 'tools/figures/style.gp'}'; "


def plot_functions(plane, folder):
    distances = [i / 50 for i in range(-150, 151)]
    radius = ask("field", plane, "--at", "0,0,0")["radius"]
    panels = []
    for name in FUNCTIONS:
        at = [a for s in distances for a in ("--at", f"0,0,{s * radius:.9g}")]
        values = ask("field", plane, "--function", name, *at)["values"]
        rows = "".join(f"{s} {v}\n" for s, v in zip(distances, values))
        (folder / f"{name}.dat").write_text(rows, encoding="utf-8")
        panels.append(f"set title '{name}'; plot '{name}.dat' using 1:2 with lines lw 3 lc rgb blue")
    gnuplot(style(OUT / "functions.png", 2000, 1880)
            + "unset key; set xrange [-3:3]; set yrange [-0.1:1.15]; set xtics 1; set ytics 0.5; "
            + "set format y '%g'; set multiplot layout 4,4; " + "; ".join(panels), folder)


def draw_slices(plane):
    for name in ANGLES:
        ask("field", plane, "--function", name, "--slice", "x=0", "-o", OUT / f"{name}.png",
            "--resolution", 256)
    horse = find_model("horse.ply")
    for name in ("origins", "views", "views-far", "light"):
        ask("field", horse, "--function", name, "--slice", "x=0", "-o", OUT / f"horse_{name}.png",
            "--resolution", 384)


def draw_discounts(plane):
    """Figure 4.1: one plane and all planes, before and after the first peak has had its votes."""
    horse = find_model("horse.ply")
    peak = point(ask("origins", horse, "-k", 1)["origins"][0])
    ask("field", plane, "--slice", "x=0", "-o", OUT / "one_plane.png", "--resolution", 256)
    first = ask("field", plane, "--slice", "x=0", "-o", OUT / "one_plane_discounted.png",
                "--resolution", 256, "--discount", "0,0.5,0.5")
    assert first["slice"]["greatest"] < 1.0
    ask("field", horse, "--slice", "x=0", "-o", OUT / "all_planes.png", "--resolution", 256)
    ask("field", horse, "--slice", "x=0", "-o", OUT / "all_planes_discounted.png", "--resolution",
        256, "--discount", peak)


def count_alphas(kept):
    """What `rimline bench fields --alphas` counts, by title of the model, and the means over models."""
    if not kept.exists():
        files = [find_model(file_name) for _, file_name in ALPHA_MODELS]
        kept.write_text(json.dumps(ask("bench", "fields", "--alphas", *ALPHA_COUNTS, *files)), encoding="utf-8")
    found = json.loads(kept.read_text(encoding="utf-8"))
    return dict(zip([title for title, _ in ALPHA_MODELS], found["alphas"])), found["means"]


def row_of(model, origins, alpha):
    rows = [row for row in model["rows"] if (row["origins"], row["alpha"]) == (origins, alpha)]
    return rows[0] if rows else None


def plot_alphas(models, folder):
    """Figure 4.9, in its colors, with two origins, each model over its own center's boxes."""
    panels = []
    for title, model in list(models.items())[:ALPHA_PANELS]:
        center = model["center"]["literal"][0]["box_checks"]
        index = model["center"]["box_checks"]
        rows = [row for row in model["rows"] if row["origins"] == 2 and row["alpha"] <= 3.44]
        name = title.replace(" ", "_").replace(",", "") + ".dat"
        (folder / name).write_text("".join(
            f"{row['alpha']} {row['literal'][0]['pbv_checks'] / center} {row['literal'][0]['ebv_checks'] / center} "
            f"{row['literal'][0]['box_checks'] / center} {row['box_checks'] / index}\n" for row in rows),
            encoding="utf-8")
        curves = ", ".join(f"'{name}' using 1:{column} with linespoints lc rgb {color} pt 7 ps 0.5 title '{what}'"
                           for column, color, what in ((2, "green", "PBV"), (3, "blue", "EBV"), (4, "red", "total"),
                                                       (5, "amber", "HoughOctree")))
        panels.append(f"set title '{title}'; plot {curves}, 1 lc rgb gray dt 2 notitle")
    gnuplot(style(OUT / "alpha.svg", 1800, 640)
            + "set xlabel 'alpha'; set xrange [0.3:3.5]; set yrange [0:1.8]; set format y '%.1f'; "
            + "set key top right; set multiplot layout 1,3; " + "; ".join(panels), folder)


def alphas_table(means):
    """Geometric means over the models, of boxes and work over those of the center."""
    alphas = sorted({mean["alpha"] for mean in means})
    counts = sorted({mean["origins"] for mean in means})
    lines = ["| α | " + " | ".join(f"boxes, {k}" for k in counts) + " | "
             + " | ".join(f"work, {k}" for k in counts) + " |", "|---" * (1 + 2 * len(counts)) + "|"]
    for alpha in alphas:
        cells = [next((f"{m[key]:.2f}" for m in means if (m["alpha"], m["origins"]) == (alpha, k)), "")
                 for key in ("literal_boxes", "work") for k in counts]
        lines.append(f"| {alpha:.2f} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def least_table(models):
    """By model: the least boxes and work over α, and those of three values of α, with two origins."""
    shown = (1.0, 1.72, 3.44)
    lines = ["| model | boxes: center | " + " | ".join(f"α = {a}" for a in shown) + " | least, at α | work: center | "
             + " | ".join(f"α = {a}" for a in shown) + " | least, at α |", "|---" * 11 + "|"]
    for title, model in models.items():
        rows = [row for row in model["rows"] if row["origins"] == 2]
        if not rows:
            continue  # Alligator is flat: one origin.
        cells = [title]
        for value in (lambda row: row["literal"][0]["box_checks"], lambda row: row["work"]):
            cells.append(number(value(model["center"])))
            cells += [number(value(row)) if row else "" for row in (row_of(model, 2, a) for a in shown)]
            least = min(rows, key=value, default=None)
            cells.append(f"{number(value(least))}, {least['alpha']:g}" if least else "")
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def lists_table(models):
    """Edges SFO from any and from all of their origins, at the thesis's α."""
    lines = ["| model | origins | listed: SFO from any | from all | PBV and EBV: from any | from all | edge tests: from "
             "any | from all | missed, from all | twice |", "|---" * 10 + "|"]
    for title, model in models.items():
        for row in filter(None, (row_of(model, origins, 1.72) for origins in (2, 3))):
            complete, letter = row["literal"][0], row["literal"][1]
            lines.append(f"| {title} | {row['origins']} | " + " | ".join(
                f"{number(complete[key])} | {number(letter[key])}"
                for key in ("listed_edges", "box_checks", "edge_checks"))
                + f" | {letter['missed_edges']:.1f} | {letter['repeated_edges']:.1f} |")
    return "\n".join(lines)


def number(value):
    return f"{value:,.0f}"


def origins_table():
    lines = ["| model | faces | origins | SFO edges | boxes | edges | work |",
             "|---|---|---|---|---|---|---|"]
    for title, file_name in [m[:2] for m in MODELS] + OTHERS:
        path = find_model(file_name)
        faces = ask("info", path)["faces"]
        found = ask("origins", path, "--most", 5)
        for trial in found["trials"]:
            count = str(trial["origins"]) if trial["origins"] else "center"
            best = "**" if trial["work"] == found["work"] else ""
            lines.append(f"| {title} | {number(faces)} | {count} | {number(trial['sfo_edges'])} | "
                         f"{number(trial['box_checks'])} | {number(trial['edge_checks'])} | "
                         f"{best}{number(trial['work'])}{best} |")
            title, faces = "", math.nan
            lines[-1] = lines[-1].replace("nan", "")
    return "\n".join(lines)


def thesis_table():
    lines = ["| model | faces, thesis | faces, here | origins | time, thesis | time, here | "
             "boxes, thesis: centroid | optimized | its octrees, here: center | optimized | "
             "straddling: center | optimized | HoughOctree: center | optimized |",
             "|---" * 14 + "|"]
    alpha = ("--alpha", 1.72)  # The thesis's.
    for title, file_name, faces, center, count, optimized, seconds in MODELS:
        path = find_model(file_name)
        trials = ask("origins", path, "--most", count, "--literal", *alpha)["trials"]
        found = ask("origins", path, "-k", count, "--literal", *alpha)
        boxes = [number(tried["literal"][way]["box_checks"])
                 for way in (0, 2) for tried in (trials[0], found)]
        lines.append(f"| {title} | {number(faces)} | {number(ask('info', path)['faces'])} | {count} | "
                     f"{seconds // 60}m{seconds % 60:02}s | {found['ms'] / 1000:.2f} s | "
                     f"{number(center)} | {number(optimized)} | {' | '.join(boxes)} | "
                     f"{number(trials[0]['box_checks'])} | {number(found['box_checks'])} |")
    return "\n".join(lines)


def fill(tables):
    page = PAGE.read_text(encoding="utf-8")
    for name, table in tables.items():
        page, count = re.subn(rf"(<!-- figures: {name} -->\n).*?(<!-- end -->)",
                              lambda m, text=table: m[1] + text + "\n" + m[2], page, flags=re.DOTALL)
        if count != 1:
            sys.exit(f"plot_fields.py: {PAGE.name} has {count} places for {name}")
    PAGE.write_text(page, encoding="utf-8")


def draw_alphas(kept, folder):
    models, means = count_alphas(kept)
    plot_alphas(models, folder)
    fill({"alphas": alphas_table(means), "least": least_table(models), "lists": lists_table(models)})


def main():
    global PROGRAM
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program", nargs="?", default=PROGRAM)
    parser.add_argument("--alphas", type=pathlib.Path, metavar="FILE", help="counts over alpha, and nothing else")
    options = parser.parse_args()
    PROGRAM = options.program
    OUT.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        draw_alphas(options.alphas or folder / "alphas.json", folder)
        if options.alphas:
            return
        plane = folder / "plane.off"
        plane.write_text(ONE_FACE, encoding="utf-8")
        plot_functions(plane, folder)
        draw_slices(plane)
        draw_discounts(plane)
    ask("origins", find_model("horse.ply"), "-k", 3, "--up", "0,0,1", "--direction", "0.9,0.6,0.4",
        "-o", OUT / "groups.png")
    fill({"origins": origins_table(), "thesis": thesis_table()})


if __name__ == "__main__":
    main()
