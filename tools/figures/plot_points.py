#!/usr/bin/env python3
"""Makes the figure and the tables of docs/results/points.md about perturbed points and about constants that are chosen
on one half of the models and judged on the other, as `rimline bench points` counts them. Draws with gnuplot.

    tools/figures/plot_points.py [PROGRAM]        models from the folders of $RIMLINE_MODELS

The counts are the same on every machine. What the page says between <!-- figures: NAME --> and <!-- end --> is
replaced.
"""

import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "results" / "points.md"
PICTURE = ROOT / "docs" / "results" / "points" / "perturbed.png"
AMOUNTS = {"noise": [0, 0.05, 0.1, 0.2], "outliers": [0.01, 0.05],
           "uneven": [0.5, 0.75]}
DROPPED = "ours without outliers"
SHOWN = [("robust", "ours"), (DROPPED, "ours, `--drop-outliers`"), ("thesis", "thesis"), ("gap 120", "gap rule, 120\u00b0"), ("Open3D 16 120", "Open3D, 120\u00b0"),
         ("PCL 16 120", "PCL, 120\u00b0")]
DEFAULTS = {"--gap-ratio": 2.75, "-k": 16}
DRAWN = [("robust", "ours"), (DROPPED, "ours, --drop-outliers"), ("thesis", "thesis"),
         ("gap 120", "gap rule, 120\u00b0")]
CONSTANTS = {"--gap-ratio": [2.25, 2.5, 2.75, 3, 3.5], "-k": [12, 14, 16, 18, 20]}


def bench(program, *options):
    command = [program, "bench", "points", "--json", *map(str, options)]
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    if result.returncode != 0:
        sys.exit(f"plot_points.py: {' '.join(map(str, command))} failed")
    return [r for r in json.loads(result.stdout)["points"] if r["kind"] in ("wide", "smooth")]


def measure(program, *options):
    """A run with the libraries, and beside `robust` what it gives without outliers."""
    results = bench(program, *options)
    for result, dropped in zip(results, bench(program, "--drop-outliers", "--no-libraries", *options)):
        count = next(c for c in dropped["borders"] if c["method"] == "robust")
        result["borders"].append({**count, "method": DROPPED})
    return results


def totals(results, method):
    """Missed and extra points of wide models in % of their border, and extra ones of smooth models per 1,000 points."""
    wide = [r for r in results if r["kind"] == "wide"]
    smooth = [r for r in results if r["kind"] == "smooth"]
    borders = sum(r["border"] for r in wide)
    count = [{c["method"]: c for c in r["borders"]}.get(method) for r in wide + smooth]
    if None in count:
        return None
    missed = sum(c["missed"] for c in count[:len(wide)])
    extra = sum(c["extra"] for c in count[:len(wide)])
    invented = sum(c["extra"] - c["around_holes"] for c in count[len(wide):])
    return (100 * missed / borders, 100 * extra / borders, 1000 * invented / sum(r["points"] for r in smooth))


def normals(results):
    """Wrong normals per 1,000 points: of umbrellas, and of fitted planes."""
    points = sum(r["points"] for r in results)
    return (1000 * sum(r["wrong_normals"] for r in results) / points,
            1000 * sum(r["fitted_normals"]["wrong"] for r in results) / points)


def perturbed_table(runs):
    lines = ["| | " + " | ".join(title for _, title in SHOWN) + " | wrong normals: ours, fitted |",
             "|---|" + "---|" * (len(SHOWN) + 1)]
    for (kind, amount), results in runs.items():
        name = "as they are" if amount == 0 else f"{kind} {amount:g}"
        cells = []
        for method, _ in SHOWN:
            found = totals(results, method)
            cells.append("" if found is None else "{:.1f}, {:.1f}; {:.2f}".format(*found))
        lines.append("| " + " | ".join([name, *cells, "{:.2f}, {:.2f}".format(*normals(results))]) + " |")
    return "\n".join(lines)


def draw(runs):
    with tempfile.TemporaryDirectory() as folder:
        for kind, amounts in AMOUNTS.items():
            for number, (method, _) in enumerate(DRAWN, 1):
                rows = [(amount, totals(runs[kind if amount else "noise", amount], method))
                        for amount in sorted({0, *amounts})]
                text = "".join(f"{amount} {found[0]} {found[1]}\n" for amount, found in rows if found)
                pathlib.Path(folder, f"{kind}{number}.dat").write_text(text, encoding="utf8")
        titles = " ".join(f"'{title}'" for _, title in DRAWN)
        subprocess.run(["gnuplot", "-e", f"out='{PICTURE}'; style='{ROOT}/tools/figures/style.gp'; titles=\"{titles}\"",
                        ROOT / "tools" / "figures" / "perturbed.gp"], cwd=folder, check=True)


def score(results):
    """Errors of ours in the measure of the choice: missed and extra points of wide models, extra ones of smooth ones."""
    return sum(c["missed"] + c["extra"] - c["around_holes"] for r in results for c in r["borders"]
               if c["method"] == "robust")


def halves_table(program, everything, files):
    lines = ["| constant | at each value: errors on a, b | chosen on a: errors on b | chosen on b: "
             "errors on a | default: a, b |", "|---|---|---|---|---|"]
    for option, values in CONSTANTS.items():
        scores = {}
        for value in values:
            results = everything if value == DEFAULTS[option] else bench(program, "--no-libraries", option, value, *files)
            scores[value] = {half: score([r for r in results if r["half"] == half]) for half in "ab"}
        best = {half: min(values, key=lambda value, half=half: scores[value][half]) for half in "ab"}
        default = DEFAULTS[option]
        lines.append(f"| `{option}` | " + "; ".join(f"{v:g}: {s['a']}, {s['b']}" for v, s in scores.items()) +
                     f" | {best['a']:g}: {scores[best['a']]['b']} | {best['b']:g}: {scores[best['b']]['a']} | "
                     f"{default:g}: {scores[default]['a']}, {scores[default]['b']} |")
    return "\n".join(lines)


def put(page, name, text):
    pattern = re.compile(rf"(<!-- figures: {name} -->\n).*?(<!-- end -->)", re.S)
    if not pattern.search(page):
        sys.exit(f"plot_points.py: {PAGE} has no place for {name}")
    return pattern.sub(lambda match: match.group(1) + "\n" + text + "\n\n" + match.group(2), page)


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else ROOT / "build" / "release" / "rimline"
    everything = measure(program)
    if not everything:
        sys.exit("plot_points.py: no wide or smooth model is in the folders of RIMLINE_MODELS")
    files = [r["model"] for r in everything]
    settings = [(kind, amount) for kind, amounts in AMOUNTS.items() for amount in amounts if amount]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:  # The libraries have mostly one thread.
        found = pool.map(lambda one: measure(program, f"--{one[0]}", one[1], *files), settings)
        runs = {("noise", 0): everything, **dict(zip(settings, found))}
    draw(runs)
    page = PAGE.read_text(encoding="utf8")
    page = put(page, "perturbed", perturbed_table(runs))
    page = put(page, "halves", halves_table(program, everything, files))
    PAGE.write_text(page, encoding="utf8")


if __name__ == "__main__":
    main()
