"""Models in folders, and batches over them, for the tests of rimline batch."""
import json
import pathlib

from program import run

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def models(folder, count=5):
    """A folder with a subfolder of triangles of different sizes."""
    root = pathlib.Path(folder) / "models"
    (root / "more").mkdir(parents=True)
    for number in range(count):
        place = root if number % 2 == 0 else root / "more"
        (place / f"m{number}.obj").write_text(TRIANGLE.replace("1", str(number + 1), 1))
    (root / "notes.txt").write_text("no model")
    return root


def entries(path):
    return [json.loads(line) for line in pathlib.Path(path).read_text().splitlines()]


def batch(*arguments):
    """The options of the batch come before those of its subcommand."""
    result = run("batch", "--json", *arguments)
    return result, json.loads(result.stdout) if result.stdout else None


def succeed(*arguments):
    result, told = batch(*arguments)
    assert result.returncode == 0 and result.stderr == "", result.stderr
    return told
