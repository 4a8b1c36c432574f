"""rimline batch: every model once, whole, and never missing."""

import fcntl
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import tempfile
import time
import urllib.parse

from batches import TRIANGLE, batch, entries, models, succeed
from program import PROGRAM, fail, have_device, run, skip, starts_within


def test_every_model_of_a_folder_gets_one_line_and_its_outputs():
    with tempfile.TemporaryDirectory() as folder:
        root, out = models(folder), f"{folder}/out"
        told = succeed(str(root), "-o", out, "--", "draw", "-o", "{out}/{path}.svg")
        assert (told["models"], told["done"], told["skipped"], told["failed"]) == (5, 5, 0, 0)
        lines = entries(f"{out}/manifest.jsonl")
        assert sorted(line["input"] for line in lines) == sorted(
            str(root / name) for name in ("m0.obj", "m2.obj", "m4.obj", "more/m1.obj", "more/m3.obj"))
        for line in lines:
            assert line["status"] == "ok" and line["error"] is None and line["digest"].startswith("fnv1a64:")
            assert line["ms"] > 0 and line["result"]["faces"] == 1
            assert [os.path.getsize(output) > 100 for output in line["outputs"]] == [True]
        assert len({line["digest"] for line in lines}) == 5
        assert os.path.exists(f"{out}/more/m1.svg")


def test_a_batch_goes_on_where_it_was():
    with tempfile.TemporaryDirectory() as folder:
        root, out = models(folder), f"{folder}/out"
        arguments = (str(root), "-o", out, "--", "draw", "-o", "{out}/{path}.svg")
        succeed(*arguments)
        assert succeed(*arguments)["skipped"] == 5
        # An output that is gone, a model that changed, and a new one are done again.
        os.remove(f"{out}/m0.svg")
        (root / "m2.obj").write_text(TRIANGLE.replace("1", "9", 1))
        (root / "m9.obj").write_text(TRIANGLE)
        told = succeed(*arguments)
        assert (told["done"], told["skipped"]) == (3, 3)
        assert os.path.exists(f"{out}/m0.svg")
        # Another command is another thing to do.
        assert succeed(*arguments, "--smooth", "0")["done"] == 6
        # A line that was cut off, as by a full disk, counts as none.
        manifest = pathlib.Path(f"{out}/manifest.jsonl")
        manifest.write_bytes(manifest.read_bytes()[:-20])
        told = succeed(*arguments, "--smooth", "0")
        assert (told["done"], told["skipped"]) == (1, 5)
        assert all(json.loads(line) for line in manifest.read_text().splitlines())


def test_failures_are_recorded_and_cost_one_model():
    with tempfile.TemporaryDirectory() as folder:
        root, out = models(folder), f"{folder}/out"
        (root / "bad.obj").write_text("v 0 0 0\nf 1 2 3\n")
        (root / "cloud.xyz").write_text("0 0 0\n1 1 1\n")
        result, told = batch(str(root), "-o", out, "--", "info")
        assert result.returncode == 1 and result.stderr.startswith("rimline: error: 1 of 7 models failed: ")
        assert (told["done"], told["failed"], told["kinds"]) == (6, 1, {"failed": 1})
        assert told["failures"] == [f"{root}/bad.obj:2: {told['failures'][0].split(': ', 1)[1]}"]
        line = next(line for line in entries(f"{out}/manifest.jsonl") if line["status"] == "failed")
        assert "bad.obj:2: " in line["error"] and line["outputs"] == [] and line["result"] is None
        # It is not tried again unless asked for.
        result, told = batch(str(root), "-o", out, "--", "info")
        assert (result.returncode, told["skipped"], told["failed"], told["failed_before"]) == (1, 6, 0, 1)
        assert told["failures"] == [] and told["failures_before"][0].startswith(f"{root}/bad.obj:2: ")
        result = run("batch", str(root), "-o", out, "--", "info")
        assert "  before      1 failed; --retry does them again\n    " + told["failures_before"][0] in result.stdout
        assert result.stderr.endswith(" says why; --retry does what failed again\n"), result.stderr
        result, told = batch(str(root), "-o", out, "--retry", "--", "info")
        assert (result.returncode, told["skipped"], told["failed"]) == (1, 6, 1)


def test_time_is_limited():
    with tempfile.TemporaryDirectory() as folder:
        out = f"{folder}/out"
        result, told = batch("shape:knot:1000000", "shape:box", "-o", out, "--timeout", "2", "--jobs", "1",
                             "--threads", "1", "--", "origins")
        assert result.returncode == 1 and told["kinds"] == {"timeout": 1}
        status = {line["input"]: line["status"] for line in entries(f"{out}/manifest.jsonl")}
        assert status == {"shape:knot:1000000": "timeout", "shape:box": "ok"}


def test_memory_is_limited():
    if not starts_within(300 << 20):
        skip("the program does not start with 300 MiB of memory, as under sanitizers")
    with tempfile.TemporaryDirectory() as folder:
        result, told = batch("shape:knot:5000000", "-o", f"{folder}/memory", "--memory", "300", "--", "info")
        assert result.returncode == 1 and told["failed"] == 1
        assert "memory" in entries(f"{folder}/memory/manifest.jsonl")[0]["error"]


def test_shards_share_the_models():
    with tempfile.TemporaryDirectory() as folder:
        root, out = models(folder, 20), f"{folder}/out"
        seen = []
        for shard in range(1, 4):
            told = succeed(str(root), "-o", out, "--shard", f"{shard}/3", "--", "info")
            lines = entries(f"{out}/manifest.{shard}-of-3.jsonl")
            assert len(lines) == told["models"] == told["done"]
            seen += [line["input"] for line in lines]
        assert len(seen) == len(set(seen)) == 20
        # Shards do not overwrite each other's outputs.
        for shard in ("1/3", "2/3", "3/3"):
            assert "would both write" in fail(2, "batch", str(root), "-o", out, "--shard", shard, "--", "draw", "-o", "{out}/one.svg")
        # Other models do not move a model to another shard.
        (root / "a.obj").write_text(TRIANGLE)
        for shard in range(1, 4):
            assert succeed(str(root), "-o", out, "--shard", f"{shard}/3", "--", "info")["done"] <= 1


def test_wrong_command_lines_are_usage_errors():
    with tempfile.TemporaryDirectory() as folder:
        root, out = str(models(folder)), f"{folder}/out"
        assert "no subcommand" in fail(2, "batch", root)
        os.mkdir(f"{folder}/empty")
        assert "no model" in fail(1, "batch", f"{folder}/empty", "-o", out, "--", "info")
        # Before the work.
        assert "none" in fail(1, "batch", root, "-o", out, "--page", f"{folder}/none/a.html", "--", "draw", "-o",
                              "{out}/{stem}.svg")
        assert not os.path.exists(f"{out}/m0.svg")
        # The first model of a pattern is no page.
        assert "--page: expected a name that ends in .html" in fail(2, "batch", "-o", out, "--page", f"{root}/m0.obj", root, "--", "info")
        assert pathlib.Path(f"{root}/m0.obj").read_text() == TRIANGLE
        assert "no subcommand" in fail(2, "batch", root, "--")
        assert "a second -- " in fail(2, "batch", root, "-o", out, "--", "info", "--", "x")
        assert "not 'bench'" in fail(2, "batch", root, "--", "bench")
        assert "not 'batch'" in fail(2, "batch", root, "--", "batch")
        assert "MODELS" in fail(2, "batch", "--", "info")
        assert "--shard" in fail(2, "batch", root, "--shard", "3/2", "--", "info")
        assert "--shard" in fail(2, "batch", root, "--shard", "0/2", "--", "info")
        assert "would both write" in fail(2, "batch", root, "-o", out, "--", "draw", "-o", "{out}/one.svg")
        assert "--colour" in fail(2, "batch", root, "-o", out, "--", "render", "--colour", "red", "-o", "{out}/{stem}.png")
        assert "there is no such file or folder" in fail(1, "batch", f"{folder}/missing", "-o", out, "--", "info")
        assert "there is no such list" in fail(1, "batch", f"@{folder}/missing", "-o", out, "--", "info")
        pathlib.Path(f"{folder}/file").write_text("")
        assert "cannot make this folder" in fail(1, "batch", root, "-o", f"{folder}/file", "--", "info")
        pathlib.Path(f"{folder}/odd").mkdir()
        pathlib.Path(f"{folder}/odd/manifest.jsonl").write_text('{"a": 1}\n')
        assert "manifest.jsonl:1: no entry" in fail(1, "batch", root, "-o", f"{folder}/odd", "--", "info")


def test_a_dry_run_does_nothing_and_estimates():
    with tempfile.TemporaryDirectory() as folder:
        root, out = models(folder), f"{folder}/out"
        result = run("batch", str(root), "-o", out, "--dry-run", "--", "draw", "-o", "{out}/{path}.svg")
        assert result.returncode == 0 and not os.path.exists(out)
        assert f"rimline draw {root}/more/m1.obj -o {out}/more/m1.svg\n" in result.stdout
        os.rename(root / "m0.obj", root / "m 0.obj")
        told = run("batch", str(root), "-o", out, "--dry-run", "--", "info")
        assert f"rimline info '{root}/m 0.obj'\n" in told.stdout
        os.rename(root / "m 0.obj", root / "m0.obj")
        # As a shell takes them, whatever the names.
        names = [f"{folder}/" + os.fsdecode(name) for name in (b"a\xff.obj", b"n\nl'\\.obj")]
        for name in names:
            pathlib.Path(name).write_text(TRIANGLE)
        told = run("batch", *names, "-o", out, "--dry-run", "--", "info")
        for name, command in zip(names, told.stdout.splitlines()):
            command = command.replace("rimline", PROGRAM, 1)
            shown = subprocess.run(["bash", "-c", command + " --json"], capture_output=True, text=True, check=True).stdout
            assert json.loads(shown)["faces"] == 1, name
        assert result.stdout.count("\n") == 5 and "5 of 5 models left to do" in result.stderr
        succeed(str(root / "more"), "-o", out, "--", "info")
        told = succeed(str(root), "-o", out, "--dry-run", "--", "info")
        assert told["models"] == 5 and told["left"] == 3 and told["estimate_s"] > 0
        # One model at a time takes as long as it did, however many could run. Other subcommands have other times.
        took_s = 1e-3 * sum(line["ms"] for line in entries(f"{out}/manifest.jsonl")) / 2
        told = succeed(str(root), "-o", out, "--dry-run", "--jobs", "16", "--", "info")
        assert abs(told["estimate_s"] - took_s) < 1e-9 * took_s + 1e-6
        assert succeed(str(root), "-o", out, "--dry-run", "--", "draw", "-o", "{out}/{stem}.svg")["estimate_s"] is None


def test_the_page_shows_pictures_and_failures():
    with tempfile.TemporaryDirectory() as folder:
        root, out = models(folder, 2), f"{folder}/out"
        (root / "b&d <1>.obj").write_text("f 1 2 3\n")
        run("batch", str(root), "-o", out, "--page", f"{folder}/all.html", "--", "draw", "-o", "{out}/{path}.svg")
        page = pathlib.Path(f"{folder}/all.html").read_text()
        assert "3 models, 1 failed" in page and 'src="out/m0.svg"' in page and "b&amp;d &lt;1&gt;.obj" in page
        assert page.count("<figure>") == 3 and page.count("<img") == 2


def test_pictures_of_the_page_are_files_whatever_their_names():
    with tempfile.TemporaryDirectory() as folder:
        root = models(folder, 1)
        for name in (b"bad\xff.obj", b"new\nline.obj", b"a&%3F#.obj"):
            (root / os.fsdecode(name)).write_text(TRIANGLE)
        batch = ["batch", str(root), "-o", f"{folder}/out", "--page", f"{folder}/all.html", "--", "draw", "-o", "{out}/{stem}.svg"]
        for _ in range(2):  # The second one has all.
            run(*batch)
            page = pathlib.Path(f"{folder}/all.html").read_text("utf-8")
            links = re.findall('src="([^"]*)"', page)
            assert len(links) == 4
            for link in links:
                assert os.path.isfile(os.fsencode(folder) + b"/" + urllib.parse.unquote_to_bytes(link)), link


def test_names_of_any_bytes_are_shown_once_and_as_text():
    with tempfile.TemporaryDirectory() as folder:
        root = models(folder, 1)
        for name in (b"new\nline.obj", b"bad\xff.obj", b"a<b>.obj"):
            (root / os.fsdecode(name)).write_text("f 1 2 3\n")
        (root / "plain.obj").write_text("f 1 2 3\n")
        told = run("batch", str(root), "-o", f"{folder}/out", "--page", f"{folder}/all.html", "--", "info")
        for name, once in (("plain.obj", "plain.obj:1: "), ("a<b>.obj", "a<b>.obj:1: "), ("bad", "bad\\xff.obj:1: "), ("new", "new line.obj:1: ")):
            [line] = [line for line in told.stdout.splitlines() if name in line]
            assert once in line and line.count(name) == 1, line
        page = pathlib.Path(f"{folder}/all.html").read_text("utf-8")
        assert "/new\\x0aline.obj" in page and "/bad\\xff.obj" in page and "/a&lt;b&gt;.obj" in page
        assert "\nline" not in page


def test_killed_batches_lose_nothing_and_double_nothing():
    with tempfile.TemporaryDirectory() as folder:
        root, out = models(folder, 24), f"{folder}/out"
        arguments = ["batch", "--json", str(root), "-o", out, "--jobs", "2", "--", "draw", "-o", "{out}/{path}.svg"]
        manifest = pathlib.Path(out, "manifest.jsonl")
        for wait_s in (0.05, 0.1, 0.15, 0.2, 0.1, 0.05, None):  # None: until a model is done.
            process = subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            if wait_s is None:
                while process.poll() is None and not (manifest.exists() and b"\n" in manifest.read_bytes()):
                    time.sleep(0.01)
            else:
                time.sleep(wait_s)
            process.send_signal(signal.SIGKILL)
            process.wait()
            for path in pathlib.Path(out).rglob("*.svg"):
                assert path.read_text().endswith("</svg>\n"), f"{path} is not whole"
        told = json.loads(run(*arguments).stdout)
        assert told["done"] + told["skipped"] == 24 and told["failed"] == 0 and told["skipped"] > 0
        lines = entries(manifest)
        assert len({line["input"] for line in lines}) == len(lines) == 24
        assert sorted(path.stem for path in pathlib.Path(out).rglob("*.svg")) == sorted(f"m{i}" for i in range(24))
        assert not list(pathlib.Path(out).rglob(".*.part"))


def test_processes_end_with_their_batch():
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.Popen([PROGRAM, "batch", "shape:knot:8000000", "-o", folder, "--jobs", "1", "--", "info"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        children = f"/proc/{process.pid}/task/{process.pid}/children"
        while not pathlib.Path(children).read_text():
            time.sleep(0.01)
        child = int(pathlib.Path(children).read_text().split()[0])
        time.sleep(0.1)
        process.send_signal(signal.SIGKILL)
        process.wait()
        deadline = time.monotonic() + 5
        while not has_ended(child):
            assert time.monotonic() < deadline
            time.sleep(0.01)


def has_ended(process):
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] == "Z"
    except OSError:  # It is gone, or goes now.
        return True


def test_a_usage_error_of_one_model_costs_that_model():
    with tempfile.TemporaryDirectory() as folder:
        root = models(folder)
        (root / "at.obj").write_text("v 0 0 0\nv 2 0 0\nv 0 2 0\nv 2 2 2\nf 1 2 3\nf 2 3 4\n")
        result, told = batch(str(root), "-o", f"{folder}/out", "--jobs", "1", "--", "draw", "--eye", "1,1,1", "-o",
                             "{out}/{path}.svg")
        assert result.returncode == 1 and told["kinds"] == {"usage": 1} and told["done"] == 5, (result, told)


def test_usage_errors_of_some_models_do_not_end_a_batch_that_is_tried_again():
    with tempfile.TemporaryDirectory() as folder:
        # At its true scale each of the first three needs more than a page, and says how much.
        sides = [900, 700, 800, *range(1, 9)]
        for number, side in enumerate(sides):
            text = f"v 0 0 0\nv {side} 0 0\nv 0 {side} 0\nv 0 0 {side}\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n"
            pathlib.Path(f"{folder}/m{number:02}.obj").write_text(text)
        arguments = (folder, "-o", f"{folder}/out", "--jobs", "1", "--retry", "--", "draw", "--ortho", "auto", "--scale",
                     "1:1", "-o", "{out}/{stem}.svg")
        for _ in range(2):
            result, told = batch(*arguments)
            assert result.returncode == 1 and told["kinds"] == {"usage": 3}, result.stderr
        assert told["skipped"] == 8 and told["done"] == 0
        # What says the same of all is wrong for all. What failed before comes last, so that the others are tried.
        same = (folder, "-o", f"{folder}/same", "--jobs", "1", "--retry", "--", "draw", "--scale", "1:1", "-o",
                "{out}/{stem}.svg")
        assert "of the subcommand: " in fail(2, "batch", *same)
        assert len(entries(f"{folder}/same/manifest.jsonl")) == 3
        assert "of the subcommand: " in fail(2, "batch", *same)
        lines = entries(f"{folder}/same/manifest.jsonl")
        assert [pathlib.Path(line["input"]).stem for line in lines] == [f"m0{i}" for i in range(6)]


def test_temporary_files_are_where_the_environment_says():
    with tempfile.TemporaryDirectory() as folder:
        words = [PROGRAM, "batch", "shape:box", "-o", f"{folder}/out", "--", "info"]
        result = subprocess.run(words, capture_output=True, text=True, env={**os.environ, "TMPDIR": f"{folder}/none"})
        assert result.returncode == 1 and "cannot make a temporary file" in result.stderr, result
        result = subprocess.run(words, capture_output=True, text=True, env={**os.environ, "TMPDIR": folder})
        assert result.returncode == 0 and os.listdir(folder) == ["out"], result


def test_a_dry_run_says_what_is_left_while_the_batch_runs():
    with tempfile.TemporaryDirectory() as folder:
        out = f"{folder}/out"
        succeed("shape:box", "-o", out, "--", "info")
        with open(f"{out}/manifest.jsonl", "r+b") as manifest:
            fcntl.flock(manifest, fcntl.LOCK_EX)
            manifest.seek(0, os.SEEK_END)
            manifest.write(b'{"input": "shape:kn')  # As a batch may be about to write.
            manifest.flush()
            before = pathlib.Path(f"{out}/manifest.jsonl").read_bytes()
            told = succeed("shape:box", "shape:torus:200", "-o", out, "--dry-run", "--", "info")
            assert told["left"] == 1 and told["commands"] == [["rimline", "info", "shape:torus:200"]], told
            assert pathlib.Path(f"{out}/manifest.jsonl").read_bytes() == before


def test_two_batches_do_not_write_one_manifest():
    with tempfile.TemporaryDirectory() as folder:
        out = f"{folder}/out"
        process = subprocess.Popen([PROGRAM, "batch", "shape:knot:8000000", "-o", out, "--", "info"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not os.path.exists(f"{out}/manifest.jsonl"):
            time.sleep(0.01)
        time.sleep(0.1)
        assert "another batch writes it" in fail(1, "batch", "shape:box", "-o", out, "--", "info")
        process.send_signal(signal.SIGINT)
        assert process.wait(10) in (-signal.SIGINT, 1)
        assert entries(f"{out}/manifest.jsonl") == []


def test_a_batch_can_wait_for_another():
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.Popen([PROGRAM, "batch", "shape:knot:3000000", "-o", folder, "--", "info"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not children_of(process.pid):
            time.sleep(0.01)
        assert succeed("shape:box", "-o", folder, "--wait", "--", "info")["done"] == 1
        assert process.wait(10) == 0
        assert len(entries(f"{folder}/manifest.jsonl")) == 2


def children_of(process):
    return pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split()


def test_shards_merge_to_the_manifest_of_one_machine():
    with tempfile.TemporaryDirectory() as folder:
        root, out = models(folder, 12), f"{folder}/out"
        (root / "bad.obj").write_text("f 1 2 3\n")
        command = ("--", "draw", "-o", "{out}/{path}.svg")
        for shard in ("1/3", "2/3"):
            batch(str(root), "-o", out, "--shard", shard, *command)
        result, told = batch(str(root), "-o", out, "--merge", *command)
        assert result.returncode == 1 and "models are left to do" in result.stderr and 0 < told["left"] < 13, told
        assert told["done"] + told["failed"] + told["left"] == 13
        batch(str(root), "-o", out, "--shard", "3/3", *command)
        # A line of another command, and of content that the model had before.
        succeed(f"{root}/m0.obj", "-o", out, "--", "info")
        (root / "m2.obj").write_text(TRIANGLE.replace("1", "9", 1))
        for shard in ("1/2", "2/2"):
            batch(str(root), "-o", out, "--shard", shard, *command)
        sizes = set()
        for _ in range(2):  # Again it adds nothing.
            result, told = batch(str(root), "-o", out, "--merge", "--page", f"{folder}/all.html", *command)
            assert (result.returncode, told["done"], told["failed"], told["left"]) == (1, 12, 1, 0), told
            assert result.stderr.startswith("rimline: error: 1 of 13 models failed: ")
            lines = {line["input"]: line for line in entries(f"{out}/manifest.jsonl")}
            sizes.add(os.path.getsize(f"{out}/manifest.jsonl"))
        assert len(sizes) == 1
        told = batch(str(root), "-o", out, *command)[1]
        assert (told["done"], told["skipped"], told["failed_before"]) == (0, 12, 1), told
        batch(str(root), "-o", f"{folder}/one", *command)
        for line in entries(f"{folder}/one/manifest.jsonl"):
            found = json.loads(json.dumps(lines[line["input"]]).replace(f"{folder}/out", f"{folder}/one"))
            assert all(found[key] == line[key] for key in ("digest", "command", "status", "outputs", "error"))
            assert (found["result"] is None) == (line["result"] is None)
        assert "13 models, 1 failed" in pathlib.Path(f"{folder}/all.html").read_text()
        # An output that is gone is left to do.
        os.remove(f"{out}/m4.svg")
        assert batch(str(root), "-o", out, "--merge", *command)[1]["left"] == 1
        assert "--merge" in fail(2, "batch", str(root), "--merge", "--shard", "1/2", *command)
        assert "--merge" in fail(2, "batch", str(root), "--merge", "--dry-run", *command)


def test_a_shard_that_succeeds_takes_the_place_of_a_failure():
    with tempfile.TemporaryDirectory() as folder:
        out = f"{folder}/out"
        command = ("--", "silhouette", "--from", "3,2,1", "--no-edges")
        for shard in ("1/2", "2/2"):
            batch("shape:knot:300000", "-o", out, "--shard", shard, "--timeout", "0.02", *command)
        assert batch("shape:knot:300000", "-o", out, "--merge", *command)[1]["kinds"] == {"timeout": 1}
        for shard in ("1/2", "2/2"):
            succeed("shape:knot:300000", "-o", out, "--shard", shard, "--retry", *command)
        assert succeed("shape:knot:300000", "-o", out, "--merge", *command)["done"] == 1
        assert [line["status"] for line in entries(f"{out}/manifest.jsonl")] == ["timeout", "ok"]


def test_threads_are_those_of_all_models_together():
    with tempfile.TemporaryDirectory() as folder:
        for options, models_at_a_time, threads in ((("--threads", "6", "--jobs", "2"), 2, "3"),
                                                   (("--threads", "1"), 1, "1")):
            process = subprocess.Popen([PROGRAM, "batch", "shape:knot:5000000", "shape:knot:5000001", "-o", folder,
                                        *options, "--", "info"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while len(children := children_of(process.pid)) < models_at_a_time:
                time.sleep(0.01)
            time.sleep(0.1)
            assert len(children_of(process.pid)) == models_at_a_time
            words = pathlib.Path(f"/proc/{children[0]}/cmdline").read_text().split("\0")
            assert words[words.index("--threads") + 1] == threads, words
            process.send_signal(signal.SIGTERM)
            process.wait()


def test_memory_is_limited_from_the_first_moment():
    with tempfile.TemporaryDirectory() as folder:
        shapes = [f"shape:box:{faces}" for faces in range(12, 32)]
        told = batch(*shapes, "-o", f"{folder}/few", "--memory", "1", "--", "info")[1]
        assert told["kinds"] == {"crashed": 20}, told


def test_all_files_that_are_asked_for_are_outputs():
    with tempfile.TemporaryDirectory() as folder:
        cloud, out = f"{folder}/cloud.xyz", f"{folder}/out"
        pathlib.Path(cloud).write_text("".join(f"{x} {y} {0.1 * x * y}\n" for x in range(12) for y in range(12)))
        arguments = (cloud, "-o", out, "--", "points", "--export={out}/more/{stem}.ply")
        assert succeed(*arguments)["done"] == 1
        assert entries(f"{out}/manifest.jsonl")[0]["outputs"] == [f"{out}/more/cloud.ply"]
        assert succeed(*arguments)["skipped"] == 1
        os.remove(f"{out}/more/cloud.ply")
        assert succeed(*arguments)["done"] == 1
        assert "would both write" in fail(2, "batch", cloud, "shape:box", "-o", out, "--", "render", "-o",
                                          "{out}/{stem}.png", "--save-scene", "{out}/one.json")


def test_pictures_of_several_models_are_drawn_at_a_time():
    have_device()
    with tempfile.TemporaryDirectory() as folder:
        out = f"{folder}/out"
        told = succeed("shape:box", "shape:knot:2000", "-o", out, "--jobs", "2", "--", "views", "-k", "2",
                       "--size", "64x64", "-o", "{out}/{stem}")
        assert told["done"] == 2
        for line in entries(f"{out}/manifest.jsonl"):
            assert [os.path.basename(output) for output in line["outputs"]] == ["contact_sheet.png", "view_1.png",
                                                                               "view_2.png"]


def test_a_failure_is_one_whatever_the_parent_does_with_signals():
    with tempfile.TemporaryDirectory() as folder:
        bad = os.path.join(folder, "bad.obj")
        pathlib.Path(bad).write_text("f 1 2 3\n")
        result = subprocess.run([PROGRAM, "batch", bad, "-o", f"{folder}/out", "--", "info"], capture_output=True,
                                text=True, preexec_fn=lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN))
        assert result.returncode == 1, result
        assert [line["status"] for line in entries(f"{folder}/out/manifest.jsonl")] == ["failed"]


def test_as_many_models_run_at_a_time_as_the_system_allows():
    with tempfile.TemporaryDirectory() as folder:
        shapes = [f"shape:sphere:{100 + i}" for i in range(10)]
        def few_files():
            resource.setrlimit(resource.RLIMIT_NOFILE, (24, 24))
        result = subprocess.run([PROGRAM, "batch", "--jobs", "10", *shapes, "-o", f"{folder}/out", "--", "info"],
                                capture_output=True, text=True, preexec_fn=few_files)
        assert result.returncode == 0, result
        assert {line["status"] for line in entries(f"{folder}/out/manifest.jsonl")} == {"ok"}


def test_threads_of_the_subcommand_are_given_once():
    with tempfile.TemporaryDirectory() as folder:
        for threads in (["--threads", "1"], ["--threads=1"]):
            assert succeed("shape:box", "-o", f"{folder}/out", "--", "info", *threads)["done"] == 1
