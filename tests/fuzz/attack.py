"""attack.py [--minutes M] [--seed N] [--keep FOLDER] PROGRAM

Attacks the rimline program from outside: files of every format with random faults, limits of memory, and signals.
Whatever happens it must end by itself, with status 0, or with status 1 and one line that says why, never by a crash;
and it leaves its output whole or, where it failed, as it was before, and no other file beside it.

Prints what it has tried; ends with status 1 at the first fault, and keeps the file and the command that show it.
"""
import argparse
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from seeds import SEEDS  # noqa: E402

FORMATS = {"mesh_obj": ".obj", "mesh_ply": ".ply", "mesh_stl": ".stl", "mesh_off": ".off", "mesh_gltf": ".gltf",
           "mesh_glb": ".glb", "point_file": ".xyz"}
MESH_COMMANDS = [["info", "FILE", "--json"], ["silhouette", "FILE", "--from", "3,2,4", "-o", "out.svg"],
                 ["draw", "FILE", "-o", "out.svg"], ["track", "FILE", "--frames", "5", "--json"],
                 ["convert", "FILE", "-o", "out.glb", "--edges"], ["field", "FILE", "--at", "1,2,3", "--json"]]
CLOUD_COMMANDS = [["info", "FILE", "--json"], ["points", "FILE", "--from", "3,2,4", "--json"]]
LARGE_COMMANDS = [["info", "shape:knot:200000"], ["silhouette", "shape:knot:200000", "--from", "3,2,4", "-o", "out.svg"],
                  ["draw", "shape:knot:100000", "-o", "out.svg"], ["track", "shape:knot:100000", "--frames", "2000"],
                  ["field", "shape:knot:50000", "--slice", "z=0", "-o", "out.png"], ["points", "shape:knot:50000", "--as-points",
                                                                  "--from", "3,2,4"]]
SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGPIPE, signal.SIGXFSZ, signal.SIGKILL]
TIME_LIMIT_S = 60
END_LIMIT_S = 5
CRASHES = {signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGILL}
OLD_OUTPUT = b"an older file"


class Fault(Exception):
    pass


def seeds_of(target):
    return [seed.encode() if isinstance(seed, str) else seed for seed in SEEDS[target]()]


def words_of(target):
    """What the fuzz target of the same format inserts."""
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "dictionaries")
    name = {"mesh_glb": "gltf", "point_file": "xyz"}.get(target, target.removeprefix("mesh_"))
    with open(os.path.join(folder, name + ".dict"), encoding="ascii") as file:
        quoted = re.findall(r'^"(.*)"$', file.read(), re.MULTILINE)
    return [word.encode().decode("unicode_escape").encode("latin-1") for word in quoted]


def mutated(data, words, source):
    data = bytearray(data)
    for _ in range(source.choice([1, 1, 2, 4, 16])):
        if not data:
            break
        at = source.randrange(len(data))
        end = min(len(data), at + source.choice([1, 2, 4, 16, 200]))
        kind = source.randrange(8)
        if kind == 0:
            data[at] ^= 1 << source.randrange(8)
        elif kind == 1:
            data[at:end] = source.randbytes(end - at)
        elif kind == 2:
            del data[at:end]
        elif kind == 3:
            del data[at:]
        elif kind == 4:
            data[at:at] = data[at:end] * source.choice([1, 2, 100])
        elif kind == 5:
            data[at:at] = source.choice(words)
        elif kind == 6:
            number = source.choice([b"-1", b"0", b"4294967295", b"99999999999999999999", b"1e309", b"nan", b"1e-320", b"2.5"])
            digits = list(re.finditer(rb"[0-9]+", bytes(data)))
            if digits:
                chosen = source.choice(digits)
                data[chosen.start():chosen.end()] = number
        else:
            data[at:end] = bytes(end - at)
    return bytes(data)


class Attack:
    def __init__(self, program, source, folder):
        self.program, self.source, self.folder = os.path.abspath(program), source, folder
        self.runs = {"files": 0, "limits": 0, "signals": 0}
        self.command = []

    def start(self, command, **options):
        """Begins in an empty folder; `command` names its input and output relative to it."""
        self.command = command
        return subprocess.Popen([self.program, *command], cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, **options)

    @staticmethod
    def ended(process, limit_s=TIME_LIMIT_S):
        """The status and what went to standard error."""
        try:
            _, errors = process.communicate(timeout=limit_s)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            raise Fault(f"no end within {limit_s} s") from None
        return process.returncode, errors

    def prepare(self, command):
        for name in os.listdir(self.folder):
            os.remove(os.path.join(self.folder, name))
        self.output = os.path.join(self.folder, command[command.index("-o") + 1]) if "-o" in command else None
        if self.output:
            with open(self.output, "wb") as file:
                file.write(OLD_OUTPUT)

    def check(self, status, errors, may_fail_to_start=False):
        if -status in CRASHES:
            raise Fault(f"a crash: {signal.Signals(-status).name}")
        lines = [line for line in errors.decode(errors="replace").splitlines() if line.startswith("rimline: error: ")]
        if status == 1 and len(lines) != 1:
            raise Fault(f"status 1 with {len(lines)} errors: {errors[:400]!r}")
        # The loader of the system says 127 where memory does not suffice for the libraries.
        if status not in (0, 1) and not (may_fail_to_start and status in (126, 127)):
            raise Fault(f"status {status}: {errors[:400]!r}")
        self.check_files(status == 0)

    def check_files(self, has_succeeded):
        for name in os.listdir(self.folder):
            if name.endswith(".part"):
                raise Fault(f"{name} is left")
        if not self.output:
            return
        with open(self.output, "rb") as file:
            output = file.read()
        if has_succeeded and output == OLD_OUTPUT:
            raise Fault("success, and no new output")
        # A program that is ended after it has written its output leaves it.
        if self.output.endswith(".glb"):
            is_whole = output[:4] == b"glTF" and int.from_bytes(output[8:12], "little") == len(output)
        else:
            is_whole = output.endswith(b"</svg>\n" if self.output.endswith(".svg") else b"IEND\xaeB`\x82")
        if output != OLD_OUTPUT and not is_whole:
            raise Fault("the output is neither the old one nor whole")

    def attack_with_a_file(self):
        target = self.source.choice(sorted(FORMATS))
        name = "in" + FORMATS[target]
        commands = CLOUD_COMMANDS if target == "point_file" else MESH_COMMANDS
        command = [name if word == "FILE" else word for word in self.source.choice(commands)]
        self.prepare(command)
        data = mutated(self.source.choice(seeds_of(target)), words_of(target), self.source)
        with open(os.path.join(self.folder, name), "wb") as file:
            file.write(data)
        process = self.start(command)
        self.check(*self.ended(process))
        self.runs["files"] += 1

    def attack_with_a_limit(self):
        command = self.source.choice(LARGE_COMMANDS)
        self.prepare(command)
        limit = self.source.randrange(20, 700) << 20
        process = self.start(command, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        try:
            self.check(*self.ended(process), may_fail_to_start=True)
        except Fault as fault:
            raise Fault(f"{fault}, at {limit >> 20} MB") from None
        self.runs["limits"] += 1

    def attack_with_a_signal(self):
        command = self.source.choice(LARGE_COMMANDS)
        self.prepare(command)
        process = self.start(command)
        chosen = self.source.choice(SIGNALS)
        time.sleep(self.source.random() * 0.6)
        process.send_signal(chosen)
        try:
            # It may have ended before, or in the middle of its start.
            status, _ = self.ended(process, END_LIMIT_S)
            if -status in CRASHES:
                raise Fault(f"a crash: {signal.Signals(-status).name}")
            self.check_files(status == 0)
        except Fault as fault:
            raise Fault(f"{chosen.name}: {fault}") from None
        self.runs["signals"] += 1


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[1], formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--minutes", type=float, default=1.0)
    parser.add_argument("--seed", type=int, default=None, help="to repeat a run (default: from the clock)")
    parser.add_argument("--keep", default="attack-fault", help="the folder for what shows a fault")
    parser.add_argument("program")
    arguments = parser.parse_args()
    seed = int(time.time()) if arguments.seed is None else arguments.seed
    source = random.Random(seed)
    end = time.monotonic() + 60.0 * arguments.minutes
    with tempfile.TemporaryDirectory() as folder:
        attack = Attack(arguments.program, source, folder)
        kinds = [attack.attack_with_a_file] * 6 + [attack.attack_with_a_limit, attack.attack_with_a_signal]
        while time.monotonic() < end:
            try:
                source.choice(kinds)()
            except Fault as fault:
                shutil.rmtree(arguments.keep, ignore_errors=True)
                shutil.copytree(folder, arguments.keep)
                print(f"seed {seed}: {fault}\n  in {arguments.keep}: rimline {' '.join(attack.command)}")
                return 1
        counts = ", ".join(f"{count} {kind}" for kind, count in attack.runs.items())
        print(f"seed {seed}: no fault in {sum(attack.runs.values())} runs: {counts}")
        return 0


if __name__ == "__main__":
    sys.exit(main())
