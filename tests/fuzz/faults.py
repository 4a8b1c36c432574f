"""faults.py LIBRARY PROGRAM [--runs N]

Fails allocations, writes and reads of the rimline program one by one (failing_calls.cpp), in each subcommand and in the
reader of each format. In those that need a device, which take longer, a quarter as many fail, and only allocations of
the program itself: a driver without memory ends the process (README.md, Limits). Whatever fails, the program ends with status 0, or with status 1 and one
line that says why; the old output is left as it was, and nothing else beside it. What an interrupted or a short call
delays is done again: status 0 and the same output. At most N (default 120) of the calls of each run are failed, evenly
spread.
"""
import argparse
import os
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from seeds import SEEDS  # noqa: E402

OLD_OUTPUT = b"an older file"
COMMANDS = [["info", "shape:torus:300", "--json"],
            ["silhouette", "shape:torus:300", "--from", "3,2,4", "-o", "out.svg"],
            ["draw", "shape:torus:300", "-o", "out.svg"],
            ["track", "shape:torus:300", "--frames", "20", "--json"],
            ["origins", "shape:torus:300", "-k", "2", "--json"],
            ["field", "shape:torus:300", "--slice", "z=0", "--resolution", "32", "-o", "out.png"],
            ["views", "shape:torus:300", "--no-ratio", "-k", "2", "--json"],
            ["points", "shape:torus:300", "--as-points", "--from", "3,2,4", "--json"]]
SMALL = ["shape:torus:300", "--size", "64x48"]
DEVICE_COMMANDS = [["render", *SMALL, "-o", "out.png"],
                   ["animate", *SMALL, "--frames", "2", "-o", "out.apng"],
                   ["views", "shape:torus:300", "-k", "2", "--json"],
                   ["path", "shape:torus:300", "--frames", "2", "--json"],
                   ["light", "shape:torus:300", "--eye", "3,2,4", "--json"],
                   ["points", *SMALL, "--as-points", "-o", "out.png"],
                   ["devices", "--json"]]
FORMATS = {"mesh_obj": ".obj", "mesh_ply": ".ply", "mesh_stl": ".stl", "mesh_off": ".off", "mesh_gltf": ".gltf",
           "mesh_glb": ".glb"}


class Run:
    def __init__(self, library, program, folder, command, needs_device):
        self.library, self.program, self.folder, self.command = library, program, folder, command
        self.only_own = {"RIMLINE_FAIL_OWN": "1"} if needs_device else {}
        self.output = os.path.join(folder, command[command.index("-o") + 1]) if "-o" in command else None
        self.inputs = {name for name in os.listdir(folder) if name.startswith("in")}
        self.counts = self.count()
        self.whole = self.result()

    def execute(self, **variables):
        if self.output:
            with open(self.output, "wb") as file:
                file.write(OLD_OUTPUT)
        environment = os.environ | {"LD_PRELOAD": self.library} | self.only_own | variables
        return subprocess.run([self.program, *self.command, "--threads", "2"], cwd=self.folder, env=environment,
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=60)

    def count(self):
        path = os.path.join(self.folder, "in-counts")
        result = self.execute(RIMLINE_COUNTS=path)
        assert result.returncode == 0, (self.command, result.stderr)
        self.inputs.add("in-counts")
        with open(path, encoding="ascii") as file:
            return [int(number) for number in file.read().split()]

    def result(self):
        if not self.output:
            return None
        with open(self.output, "rb") as file:
            return file.read()

    def check(self, what, must_succeed=False, **variables):
        result = self.execute(**variables)
        status, errors = result.returncode, result.stderr.decode(errors="replace")
        where = f"{what}: rimline {' '.join(self.command)}"
        if status < 0:
            sys.exit(f"{where}: {signal.Signals(-status).name}\n{errors}")
        lines = [line for line in errors.splitlines() if line.startswith("rimline: error: ")]
        if status not in (0, 1) or (status == 1) != (len(lines) == 1) or (must_succeed and status != 0):
            sys.exit(f"{where}: status {status}\n{errors}")
        others = set(os.listdir(self.folder)) - self.inputs - {self.command[self.command.index("-o") + 1] if self.output else ""}
        if others:
            sys.exit(f"{where}: {', '.join(others)} left")
        # What fails after the output is there leaves it whole.
        if self.output and self.result() not in ([self.whole] if status == 0 else [OLD_OUTPUT, self.whole]):
            sys.exit(f"{where}: status {status}, and another output")
        return status


def spread(count, runs):
    """At most `runs` numbers from 1 to `count`, evenly spread; two thirds of them in the last tenth, since every run
    begins with the same thousands of allocations, for the options of all subcommands."""
    if count <= runs:
        return range(1, count + 1)
    first = runs // 3
    last = runs - first
    return sorted({*((i + 1) * count // first for i in range(first)), *(count - i * count // (10 * last) for i in range(last))})


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("library")
    parser.add_argument("program")
    parser.add_argument("--runs", type=int, default=120)
    arguments = parser.parse_args()
    library, program = os.path.abspath(arguments.library), os.path.abspath(arguments.program)
    total = refused = 0
    cases = [(command, None, None) for command in COMMANDS]
    if subprocess.run([program, "devices"], capture_output=True).returncode == 0:
        cases += [(command, None, None) for command in DEVICE_COMMANDS]
    else:
        print("without a Vulkan device: " + ", ".join(command[0] for command in DEVICE_COMMANDS) + " are left out")
    for target, ending in FORMATS.items():
        cases += [(["silhouette", "in" + ending, "--from", "3,2,4", "-o", "out.svg"], "in" + ending, seed)
                  for seed in SEEDS[target]()]
    for command, name, seed in cases:
        with tempfile.TemporaryDirectory() as folder:
            if name:
                with open(os.path.join(folder, name), "wb") as file:
                    file.write(seed.encode() if isinstance(seed, str) else seed)
            needs_device = command in DEVICE_COMMANDS
            runs = max(arguments.runs // 4, 1) if needs_device else arguments.runs
            run = Run(library, program, folder, command, needs_device)
            allocations, writes, reads = run.counts
            for n in spread(allocations, runs):
                refused += run.check(f"allocation {n}", RIMLINE_FAIL_ALLOCATION=str(n))
                refused += run.check(f"allocations from {n} on", RIMLINE_FAIL_ALLOCATION=str(n), RIMLINE_FAIL_ON="1")
                total += 2
            for n in spread(writes, runs):
                refused += run.check(f"no space at write {n}", RIMLINE_FAIL_WRITE=str(n), RIMLINE_FAIL_HOW="full")
                for how in ("interrupted", "short"):
                    run.check(f"write {n} {how}", must_succeed=True, RIMLINE_FAIL_WRITE=str(n), RIMLINE_FAIL_HOW=how)
                total += 3
            for n in spread(reads, runs):
                for how in ("interrupted", "short"):
                    run.check(f"read {n} {how}", must_succeed=True, RIMLINE_FAIL_READ=str(n), RIMLINE_FAIL_HOW=how)
                total += 2
            print(f"{' '.join(command)}: {allocations} allocations, {writes} writes, {reads} reads", flush=True)
    if refused == 0:
        sys.exit("no call failed: is the library loaded?")
    print(f"{total} runs, of which {refused} ended with an error")


if __name__ == "__main__":
    main()
