#!/usr/bin/env python3
"""Makes the figure and the table of docs/results/stream.md: bytes streamed a frame beside those of the whole
state, over the step of an orbit, as `rimline track` counts them. Draws with gnuplot.

    tools/figures/plot_stream.py [PROGRAM]        models from the folders of $RIMLINE_MODELS

The counts are the same on every machine. What the page says between <!-- figures: NAME --> and
<!-- end --> is replaced.
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "results" / "stream.md"
MODELS = [("bunny", "Bunny", "stanford-bunny.obj"), ("horse", "Horse", "horse.ply"),
          ("igea", "Igea", "igea.ply")]
STEPS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20]
FRAMES = 200


def find_model(file_name):
    for folder in os.environ.get("RIMLINE_MODELS", "").split(":"):
        path = pathlib.Path(folder) / file_name
        if folder and path.exists():
            return path
    sys.exit(f"plot_stream.py: {file_name} is in no folder of RIMLINE_MODELS")


def count(program, model, step):
    command = [program, "track", find_model(model), "--step", str(step), "--frames", str(FRAMES),
               "--radius", "2", "--json"]
    result = subprocess.run(command, stdout=subprocess.PIPE, check=False)
    if result.returncode != 0:
        sys.exit(f"plot_stream.py: {' '.join(map(str, command))} failed")
    totals = json.loads(result.stdout)["totals"]
    return totals["bytes_streamed"] / FRAMES, totals["bytes_full"] / FRAMES


def table(counts):
    header = ["step"] + [f"{title}, bytes | of the whole" for _, title, _ in MODELS]
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * (1 + 2 * len(MODELS))]
    for i, step in enumerate(STEPS):
        row = [f"{step}°"]
        for name, *_ in MODELS:
            streamed, full = counts[name][i]
            row += [f"{streamed:,.0f}", f"{100 * streamed / full:.1f}%"]
        lines.append("| " + " | ".join(row) + " |")
    full = " | ".join(f"{counts[name][0][1]:,.0f} | " for name, *_ in MODELS)
    return "\n".join(lines + [f"| whole, at {STEPS[0]}° | {full} |"])


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else ROOT / "build" / "release" / "rimline"
    counts = {name: [count(program, model, step) for step in STEPS] for name, _, model in MODELS}
    with tempfile.TemporaryDirectory() as folder:
        for name, *_ in MODELS:
            rows = [f"{step} {100 * streamed / full}\n"
                    for step, (streamed, full) in zip(STEPS, counts[name])]
            (pathlib.Path(folder) / f"{name}.dat").write_text("".join(rows), encoding="utf-8")
        settings = "; ".join([f"out = '{ROOT / 'docs' / 'results' / 'stream' / 'bytes.png'}'",
                              f"style = '{ROOT / 'tools' / 'figures' / 'style.gp'}'",
                              f"models = '{' '.join(m[0] for m in MODELS)}'",
                              f"titles = '{' '.join(m[1] for m in MODELS)}'"])
        subprocess.run(["gnuplot", "-e", settings, ROOT / "tools" / "figures" / "stream.gp"],
                       cwd=folder, check=True)
    page = PAGE.read_text(encoding="utf-8")
    page = re.sub(r"(<!-- figures: bytes -->\n).*?(<!-- end -->)",
                  lambda m: m[1] + table(counts) + "\n" + m[2], page, flags=re.DOTALL)
    PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
