"""What follows -- in a batch, and the places in it."""
import os
import pathlib
import shutil
import tempfile

from batches import TRIANGLE, entries, models, succeed
from program import fail, run


def test_the_ending_of_a_model_is_a_place():
    with tempfile.TemporaryDirectory() as folder:
        root, out = models(folder, 1), f"{folder}/out"
        shutil.copy(root / "m0.obj", root / "m0.OBJ")
        (root / "no.stl").write_text(TRIANGLE)
        succeed(str(root), "shape:box", "-o", out, "--", "draw", "-o", "{out}/{path}.{ext}.svg")
        assert {os.path.basename(output) for line in entries(f"{out}/manifest.jsonl") for output in line["outputs"]} == {
            "m0.obj.svg", "m0.OBJ.svg", "no.stl.svg", "shape_box..svg"}


def test_advice_for_two_models_of_one_output_gives_each_its_own():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name in ("a/m.obj", "b/m.obj", "b/m.ply"):
            (root / name).parent.mkdir(exist_ok=True)
            (root / name).write_text(TRIANGLE)

        def advice(models, output):
            words = fail(2, "batch", *models, "-o", f"{folder}/out", "--", "draw", "-o", output)
            assert "would both write" in words, words
            return words.split(".svg: ", 1)[1].split(" (see ")[0]

        both = [f"{root}/a/m.obj", f"{root}/b/m.obj"]
        kinds = [f"{root}/b/m.obj", f"{root}/b/m.ply"]
        assert advice(both, "{out}/{stem}.svg") == "use {path} in it in place of {stem}"
        assert advice(both, "{out}/all.svg") == "use {path} in it"
        assert advice(kinds, "{out}/{stem}.svg") == "use {ext} in it too, as {stem}.{ext}"
        assert advice(kinds, "{out}/{path}.svg") == "use {ext} in it too, as {path}.{ext}"
        # Both are m.obj within the folders that are named.
        folders = [f"{root}/a", f"{root}/b"]
        assert advice(folders, "{out}/{path}.{ext}.svg").startswith("name one folder above both")
        # What is advised does it.
        arguments = ("-o", f"{folder}/out", "--", "draw", "-o")
        assert succeed(*both, *arguments, "{out}/{path}.svg")["done"] == 2
        assert succeed(*kinds, *arguments, "{out}/{path}.{ext}.svg")["done"] == 2


def test_no_output_is_a_model_of_the_batch():
    with tempfile.TemporaryDirectory() as folder:
        root = models(folder)
        (root / "m0_2.glb").write_text("a model")
        # Not of another shard either.
        for shard in ((), ("--shard", "1/2"), ("--shard", "2/2"), ("--dry-run",)):
            line = fail(2, "batch", str(root), "-o", f"{folder}/out", *shard, "--", "convert", "-o", str(root) + "/{stem}_2.glb")
            assert "m0_2.glb is a model of this batch, which" in line and "m0.obj would write" in line, line
        assert (root / "m0_2.glb").read_text() == "a model" and not os.path.exists(f"{folder}/out")


def test_words_in_braces_that_are_no_places_are_errors():
    for place in ("{steem}", "{Stem}", "{OUT}", "{stem2}", "{my_stem}"):
        words = fail(2, "batch", "shape:box", "--", "draw", "-o", place + ".svg")
        assert f"{place} in '{place}.svg': expected {{stem}}, {{name}}, {{path}}, {{ext}} or {{out}}" in words, words


def test_a_missing_divider_is_told():
    with tempfile.TemporaryDirectory() as folder:
        for arguments in (["shape:box", "draw", "-o", "x.svg"], ["shape:box", "-o", folder, "draw", "--ortho", "auto"],
                          ["shape:box", "shape:knot:2000", "info"]):
            words = fail(2, "batch", *arguments)
            assert "-- is missing before the subcommand '" in words and "rimline batch --help" in words, words
        # The value of an option, a folder of the batch's models, and help.
        assert "no subcommand" in fail(2, "batch", "shape:box", "-o", "views")
        os.mkdir(f"{folder}/draw")
        assert "no subcommand" in run("batch", "draw", cwd=folder).stderr
        assert run("batch", "shape:box", "draw", "--help").stdout == run("batch", "--help").stdout


def test_outputs_that_are_missing_are_advised_with_the_ending_that_is_written():
    for subcommand, output in (("render", "{out}/{path}.png"), ("draw", "{out}/{path}.svg"), ("animate", "{out}/{path}:"),
                               ("convert", "{out}/{path}.glb")):
        assert f"{subcommand} needs -o, as -o {output}" in fail(2, "batch", "shape:box", "--", subcommand)


def test_standard_output_is_no_output_of_a_batch():
    for arguments in (["draw", "-o", "-"], ["draw", "-o-"], ["silhouette", "--from", "3,2,1", "--output=-"]):
        words = fail(2, "batch", "shape:box", "--", *arguments)
        assert "standard output is no output of a batch: name one for each model, as -o {out}/{path}." in words, words


def test_errors_of_the_subcommand_name_its_help():
    with tempfile.TemporaryDirectory() as folder:
        out = ("-o", f"{folder}/out")
        words = fail(2, "batch", "shape:box", *out, "--", "draw", "--lines", "ink", "-o", "{out}/{stem}.svg")
        assert words.endswith(" (see rimline draw --help)") and words.count("--help") == 1, words
        assert fail(2, "batch", "shape:box", *out, "--", "draw", "--help").endswith(" (see rimline draw --help)")
        assert fail(2, "batch", "shape:box", *out, "--", "bench").endswith(" (see rimline batch --help)")
