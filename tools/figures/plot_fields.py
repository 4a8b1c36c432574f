#!/usr/bin/env python3
"""Makes the figures and tables of docs/results/field.md from what the program says. Draws curves with gnuplot.

    tools/figures/plot_fields.py [PROGRAM]        models from the folders of $RIMLINE_MODELS

Counts and slices are the same on every machine, but for rounding; a run takes some minutes. What the page
says between <!-- figures: NAME --> and <!-- end --> is replaced.
"""

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
PROGRAM = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build" / "release" / "rimline")

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
ALPHAS = [0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 1.72, 1.8, 2.0, 2.2, 2.4, 2.6, 2.8, 3.0]

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


def plot_alpha(folder):
    """Figure 4.9: work over alpha, of an extraction with two origins."""
    rows = []
    for alpha in ALPHAS:
        row = [alpha]
        for model in ("horse.ply", "rocker-arm.obj"):
            found = ask("origins", find_model(model), "-k", 2, "--alpha", alpha, "--literal")
            row += [found["box_checks"], found["sfo_edges"], found["edge_checks"]]
            row += [literal["box_checks"] for literal in found["literal"]]
        rows.append(" ".join(map(str, row)) + "\n")
    (folder / "alpha.dat").write_text("".join(rows), encoding="utf-8")
    # Boxes, SFO edges, edges; the thesis's boxes by its own culling and by straddling.
    kinds = (("red", "boxes, HoughOctree"), ("green", "SFO edges"), ("blue", "edges, HoughOctree"),
             ("dark-red", "boxes, the thesis\'\'s: PBV and EBV"), ("orange", "boxes, the thesis\'\'s: straddling"))
    panels = []
    for first, title in ((2, "Horse, two origins"), (7, "Rocker arm, two origins")):
        curves = ", ".join(
            f"'alpha.dat' using 1:{first + i} with linespoints lc rgb '{color}' pt 7 title '{what}'"
            for i, (color, what) in enumerate(kinds))
        panels.append(f"set title '{title}'; plot {curves}")
    gnuplot(style(OUT / "alpha.png", 2000, 800)
            + "set xlabel 'alpha'; set yrange [0:*]; set key at graph 0.95, 0.41; set multiplot layout 1,2; "
            + "; ".join(panels), folder)


def number(value):
    return f"{value:,.0f}"


def origins_table():
    lines = ["| model | faces | origins | SFO edges | boxes | edges | work | µs |",
             "|---|---|---|---|---|---|---|---|"]
    for title, file_name in [m[:2] for m in MODELS] + OTHERS:
        path = find_model(file_name)
        faces = ask("info", path)["faces"]
        found = ask("origins", path, "--most", 5, "--time")
        for trial in found["trials"]:
            count = str(trial["origins"]) if trial["origins"] else "center"
            best = "**" if trial["work"] == found["work"] else ""
            lines.append(f"| {title} | {number(faces)} | {count} | {number(trial['sfo_edges'])} | "
                         f"{number(trial['box_checks'])} | {number(trial['edge_checks'])} | "
                         f"{best}{number(trial['work'])}{best} | {trial['us']:.0f} |")
            title, faces = "", math.nan
            lines[-1] = lines[-1].replace("nan", "")
    return "\n".join(lines)


def thesis_table():
    lines = ["| model | faces, thesis | faces, here | origins | time, thesis | time, here | "
             "boxes, thesis: centroid | optimized | its octrees, here: center | optimized | "
             "straddling: center | optimized | HoughOctree: center | optimized |",
             "|---" * 14 + "|"]
    for title, file_name, faces, center, count, optimized, seconds in MODELS:
        path = find_model(file_name)
        trials = ask("origins", path, "--most", count, "--literal")["trials"]
        found = ask("origins", path, "-k", count, "--literal")
        boxes = [number(tried["literal"][culling]["box_checks"])
                 for culling in (0, 1) for tried in (trials[0], found)]
        lines.append(f"| {title} | {number(faces)} | {number(ask('info', path)['faces'])} | {count} | "
                     f"{seconds // 60}m{seconds % 60:02}s | {found['ms'] / 1000:.2f} s | "
                     f"{number(center)} | {number(optimized)} | {' | '.join(boxes)} | "
                     f"{number(trials[0]['box_checks'])} | {number(found['box_checks'])} |")
    return "\n".join(lines)


def main():
    OUT.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        plane = folder / "plane.off"
        plane.write_text(ONE_FACE, encoding="utf-8")
        plot_functions(plane, folder)
        draw_slices(plane)
        draw_discounts(plane)
        plot_alpha(folder)
    ask("origins", find_model("horse.ply"), "-k", 3, "--up", "0,0,1", "--direction", "0.9,0.6,0.4",
        "-o", OUT / "groups.png")
    page = PAGE.read_text(encoding="utf-8")
    for table_name, table in (("origins", origins_table()), ("thesis", thesis_table())):
        page = re.sub(rf"(<!-- figures: {table_name} -->\n).*?(<!-- end -->)",
                      lambda m, text=table: m[1] + text + "\n" + m[2], page, flags=re.DOTALL)
    PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
