"""dask_kills.py ROUNDS PROGRAM: dask_batch.py with a scheduler and two workers of its own.

In each round it kills the program that submits, the process of a model, a worker's process, which its nanny starts
again, and a node: the nanny with all below it. Then the merged manifest and the outputs are those of one machine.
Status 77 means skipped: no Python has `distributed`.
"""

import itertools
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROUNDS = int(sys.argv[1])
PROGRAM = os.path.abspath(sys.argv[2])
ROOT = pathlib.Path(__file__).resolve().parents[3]
FACES = (2000, *range(20000, 140000, 10000))
SUBCOMMAND = ("--", "draw", "-o", "{out}/{stem}.svg")


def python_with_dask():
    for python in (sys.executable, "/usr/bin/python3"):
        if subprocess.run([python, "-c", "import distributed"], capture_output=True, check=False).returncode == 0:
            return python
    print("SKIPPED: no Python has distributed: tools/install_packages.sh cluster")
    sys.exit(77)


def children(process):
    try:
        return [int(child) for task in pathlib.Path(f"/proc/{process}/task").iterdir()
                for child in (task / "children").read_text().split()]
    except OSError:  # It is gone.
        return []


def below(process):
    """The processes that this one started, and those that they started."""
    return [one for child in children(process) for one in (child, *below(child))]


def words(process):
    try:
        return pathlib.Path(f"/proc/{process}/cmdline").read_bytes().decode(errors="replace").split("\0")
    except OSError:
        return []


def kill(process):
    try:
        os.kill(process, signal.SIGKILL)
        return True
    except ProcessLookupError:
        return False


def until(what, answer, seconds=60):
    """The first true answer."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        if found := answer():
            return found
        time.sleep(0.02)
    raise AssertionError(f"{what} took too long")


class Cluster:
    def __init__(self, folder):
        self.folder, self.python, self.nodes = folder, python_with_dask(), {}
        # A worker that is lost counts as a failure of the task that it did.
        self.environment = {**os.environ, "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "1000",
                            "DASK_DISTRIBUTED__LOGGING__DISTRIBUTED": "warning"}
        self.log = open(folder / "dask.log", "w", encoding="utf-8")
        self.scheduler = self.start("dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard",
                                    "--scheduler-file", "scheduler.json")
        until("the scheduler", (folder / "scheduler.json").exists)
        self.address = json.loads((folder / "scheduler.json").read_text())["address"]
        for node in (1, 2):
            self.start_node(node)

    def start(self, module, *arguments):
        return subprocess.Popen([self.python, "-m", f"distributed.cli.{module}", *arguments], cwd=self.folder,
                                env=self.environment, stdout=self.log, stderr=self.log)

    def start_node(self, node):
        self.nodes[node] = self.start("dask_worker", self.address, "--nworkers", "1", "--nthreads", "1", "--no-dashboard",
                                      "--local-directory", f"node{node}", "--death-timeout", "60")

    def models(self, node):
        return [process for process in below(self.nodes[node].pid) if words(process)[:2] == ["rimline", "draw"]]

    def busy(self):
        """A node that does a model, and the process of that."""
        found = [(node, model) for node in self.nodes for model in self.models(node)]
        return random.choice(found) if found else None

    def worker(self, node):
        """The process of the node that runs tasks: the one that started a batch."""
        return next((process for process in below(self.nodes[node].pid)
                     if any(words(child)[1:2] == ["batch"] for child in children(process))), None)

    def kill_node(self, node):
        processes = [self.nodes[node].pid, *below(self.nodes[node].pid)]
        for process in processes:
            kill(process)
        self.nodes[node].wait()

    def close(self):
        for node in self.nodes:
            self.kill_node(node)
        self.scheduler.kill()
        self.scheduler.wait()
        self.log.close()

    def submit(self, *arguments, retries=20):
        return subprocess.Popen([self.python, str(ROOT / "tools/cluster/dask_batch.py"), "4", "--scheduler", self.address,
                                 "--program", PROGRAM, "--retries", str(retries), "--", *arguments], cwd=self.folder,
                                stdout=self.log, stderr=self.log)


def kills(cluster, output, killed):
    """Kills one of each and counts them. A batch that ends before, on a fast machine, has fewer to count."""
    first = cluster.submit("@list", "-o", output, *SUBCOMMAND)
    time.sleep(random.uniform(0, 3))
    if first.poll() is None:
        first.kill()
        killed["clients"] += 1
    first.wait()
    client = cluster.submit("@list", "-o", output, *SUBCOMMAND)

    def busy():
        """A node that does a model, and that model's process, after a random time. Nothing when the batch is over."""
        found = until("a model's process", lambda: cluster.busy() or client.poll() is not None)
        time.sleep(random.uniform(0, 0.2))
        return found if found is not True else (None, None)

    node, model = busy()
    killed["models"] += node is not None and kill(model)
    node, _ = busy()
    worker = node and cluster.worker(node)
    killed["workers"] += worker is not None and kill(worker)
    node, _ = busy()
    if node is not None:
        cluster.kill_node(node)
        killed["nodes"] += 1
        cluster.start_node(node)
    assert client.wait(180) == 0, "the batch failed"


def whole_once(folder, output):
    subprocess.run([sys.executable, ROOT / "tests/tools/cluster/whole_once.py", output, "expected"], cwd=folder, check=True)


def plain(folder):
    return subprocess.run([PROGRAM, "batch", "--threads", "1", "@list", "-o", "expected", *SUBCOMMAND], cwd=folder,
                          capture_output=True, check=False).returncode


def main():
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # Nothing that was started stays.
    with tempfile.TemporaryDirectory(prefix="rimline-dask.") as name:
        folder = pathlib.Path(name)
        (folder / "list").write_text("".join(f"shape:knot:{faces}\n" for faces in FACES))
        cluster = Cluster(folder)
        try:
            assert plain(folder) == 0
            killed = dict.fromkeys(("clients", "models", "workers", "nodes"), 0)
            # Tasks of a client that was killed may end later than those of the next one. So each round has a folder.
            for number in itertools.count():
                if min(killed.values()) >= ROUNDS:
                    break
                kills(cluster, f"round{number}", killed)
                whole_once(folder, f"round{number}")
                print("killed " + ", ".join(f"{n} {what}" for what, n in killed.items()) +
                      ": nothing lost, doubled or cut", flush=True)
            # The same command does again what was deleted.
            for _ in range(2):
                shutil.rmtree(folder / "again", ignore_errors=True)
                assert cluster.submit("@list", "-o", "again", *SUBCOMMAND).wait(180) == 0
                whole_once(folder, "again")
            # A model that fails is tried so often and no more, and is in the manifest once.
            (folder / "bad.obj").write_text("f 1 2 3\n")
            (folder / "list").write_text("bad.obj\nshape:box\n")
            (folder / "expected/manifest.jsonl").unlink()
            for path in (folder / "expected").glob("*.svg"):
                path.unlink()
            assert plain(folder) == 1
            assert cluster.submit("@list", "-o", "bad", *SUBCOMMAND, retries=2).wait(120) == 1
            lines = [line for path in (folder / "bad").glob("manifest.*-of-4.jsonl")
                     for line in path.read_text().splitlines() if '"input":"bad.obj"' in line]
            assert len(lines) == 3, lines
            whole_once(folder, "bad")
            # A wrong option is tried once.
            assert cluster.submit("@list", "-o", "usage", *SUBCOMMAND, "--nix", retries=2).wait(120) == 1
            lines = [line for path in (folder / "usage").glob("manifest.*-of-4.jsonl")
                     for line in path.read_text().splitlines()]
            assert len(lines) == 2, lines
        except BaseException:
            cluster.log.flush()
            sys.stderr.write((folder / "dask.log").read_text()[-4000:])
            raise
        finally:
            cluster.close()


main()
