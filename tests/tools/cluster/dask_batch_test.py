"""What dask_batch.py submits, to a client that does it at once: dask_kills.py runs a real cluster."""

import contextlib
import importlib.util
import io
import os
import pathlib
import sys
import tempfile
import types

from program import PROGRAM

SCRIPT = pathlib.Path(__file__).resolve().parents[3] / "tools" / "cluster" / "dask_batch.py"


class Future:
    """Does a task as Dask does: again where it raises, `retries` times."""

    def __init__(self, task, arguments, retries):
        self.tries = 0
        for self.tries in range(1, retries + 2):
            try:
                self.value, self.error, self.status = task(*arguments), None, "finished"
                return
            except Exception as error:
                self.error, self.status = error, "error"

    def result(self):
        if self.error is not None:
            raise self.error
        return self.value


class Client:
    def __init__(self):
        self.futures = []

    def submit(self, task, *arguments, retries, pure):
        assert not pure
        self.futures.append(Future(task, arguments, retries))
        return self.futures[-1]

    def cancel(self, futures, force):
        assert futures == self.futures and force


def dask_batch():
    sys.modules["distributed"] = types.SimpleNamespace(Client=Client, as_completed=list, fire_and_forget=lambda _: None)
    spec = importlib.util.spec_from_file_location("dask_batch", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@contextlib.contextmanager
def run_batch(*arguments, **options):
    """In a folder of its own, with a bad.obj: the exit status, how often each shard was tried, and the lines of
    standard error."""
    client, errors, before = Client(), io.StringIO(), os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        pathlib.Path("bad.obj").write_text("f 1 2 3\n")
        try:
            with contextlib.redirect_stderr(errors):
                status = dask_batch().run_batch(client, *arguments, program=PROGRAM, **options)
            yield status, [future.tries for future in client.futures], errors.getvalue().splitlines()
        finally:
            os.chdir(before)


def refusal(*arguments, **options):
    """The error of a call that submits nothing."""
    client = Client()
    try:
        dask_batch().run_batch(client, *arguments, program=PROGRAM, **options)
    except (TypeError, ValueError) as error:
        assert client.futures == []
        return f"{type(error).__name__}: {error}"
    raise AssertionError(f"{arguments} are taken")


def test_wrong_arguments_of_a_dask_batch_are_refused_before_it_begins():
    words = ["shape:box", "--", "info"]
    assert refusal(0, words) == "ValueError: shards: expected at least 1, not 0"
    assert refusal("4", words) == "TypeError: shards: expected an integer, not str"
    assert refusal(2, words, retries=-1) == "ValueError: retries: expected at least 0, not -1"
    assert refusal(2, "shape:box -- info") == "TypeError: arguments: expected a list of words, not str"
    assert refusal(2, None) == "TypeError: arguments: expected a list of words, not NoneType"
    assert refusal(2, ["shape:box", "--", 3]) == "TypeError: arguments[2]: expected text or a path, not int"
    for wrong in (["shape:box", "info"], ["shape:box", "--"], []):
        assert refusal(2, wrong) == "ValueError: arguments: expected models, -- and a subcommand"


def test_arguments_of_a_dask_batch_may_be_paths_and_come_one_by_one():
    words = (word for word in ("shape:box", b"shape:knot:500", "-o", pathlib.Path("out"), "--", "info"))
    with run_batch(2, words) as (status, tries, errors):
        assert status == 0 and tries == [1, 1] and errors == [], errors
        assert pathlib.Path("out/manifest.jsonl").read_text().count('"status":"ok"') == 2


def test_a_dask_batch_tries_failures_again_and_wrong_usage_once():
    models = ["shape:box", "shape:knot:500", "shape:knot:600", "shape:knot:700"]
    with run_batch(2, [*models, "-o", "out", "--", "draw", "--nix", "-o", "{out}/{stem}.svg"], retries=3) as (
            status, tries, errors):
        assert status == 1 and tries == [1, 1], tries
        assert len(errors) == 2 and all("option not expected: --nix" in line for line in errors), errors
    with run_batch(2, [*models, "bad.obj", "-o", "out", "--", "info"], retries=3) as (status, tries, errors):
        assert status == 1 and sorted(tries) == [1, 4] and len(errors) == 1 and "1 of" in errors[0], (tries, errors)
