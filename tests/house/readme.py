"""Checks the commands and the sample in README.md and docs/**/*.md against the tree.

readme.py ROOT quotes FILE...          every FILE is a code block of README.md, word for word
readme.py ROOT marks                   every block of commands says whether it is tested
readme.py ROOT run PAGE BIN SCRATCH    the commands of the tested blocks of PAGE succeed

A block of commands is a fenced block of language `sh`. The line before it is a comment, which the shown page
does not have:

<!-- tested -->             the commands run in a test
<!-- tested: engine -->     they need a Vulkan device
<!-- tested: models -->     they read models from the folders of RIMLINE_MODELS
<!-- not run: REASON -->    they do not run

Commands run in a copy of the root made of links, SCRATCH, so that their output stays out of the tree. The
program there is build/release/rimline, from the folder BIN. The test is skipped (exit status 77) where a block
lacks what it needs; the other blocks run first. `--engine` says that the engine was built.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

SKIPPED = 77
# The line before the block, opening fence, body, closing fence.
BLOCK = re.compile(r"^(?P<before>[^\n]*)\n```(?P<kind>[^\n]*)\n(?P<body>.*?)^```$", re.MULTILINE | re.DOTALL)
MARK = re.compile(r"<!-- *(?:tested(?:: *(?P<needs>[a-z ]+?))?|not run: *(?P<reason>\S.*?)) *-->")
MARK_LINE = re.compile(r"<!-- *(tested|not run)\b.*")
OTHER_SHELLS = ("bash", "shell", "console", "zsh", "text/sh")
INDENTED_COMMAND = re.compile(r"    (\$ )?([A-Z_]+=\S+ +)*((build/\S*/)?rimline|cmake|ctest|git|tools/\S+) \S")
NEEDS = ("engine", "models")


class Page:
    def __init__(self, root, path):
        self.name = path.relative_to(root).as_posix()
        # A first line, so that a block at the beginning has one before it.
        self.text = "\n" + path.read_text(encoding="utf-8")
        self.blocks = list(BLOCK.finditer(self.text))

    def at(self, place):
        return f"{self.name}:{self.text.count(chr(10), 0, place)}"

    def faults(self):
        inside = set()
        for block in self.blocks:
            inside.update(range(self.text.count("\n", 0, block.start("body")) - 1, self.text.count("\n", 0, block.end())))
            at, mark = self.at(block.start("body")), MARK.fullmatch(block["before"])
            if block["kind"] in OTHER_SHELLS:
                yield f"{at}: commands are blocks of language sh"
            elif block["kind"] != "sh" and MARK_LINE.match(block["before"]):
                yield f"{at}: a mark before a block that is not of language sh"
            elif block["kind"] == "sh" and not mark:
                yield f"{at}: the line before has to be <!-- tested --> or <!-- not run: REASON -->"
            elif mark and set((mark["needs"] or "").split()) - set(NEEDS):
                yield f"{at}: a tested block can need {' or '.join(NEEDS)}, not {mark['needs']}"
        marked = {self.text.count("\n", 0, block.start("before")) for block in self.blocks}
        for number, line in enumerate(self.text.split("\n")):
            if MARK_LINE.match(line) and number not in marked:
                yield f"{self.name}:{number}: no block follows the mark on the next line"
            if number not in inside and INDENTED_COMMAND.match(line):
                yield f"{self.name}:{number}: commands belong into a block of language sh"


def pages(root):
    return [Page(root, path) for path in [root / "README.md", *sorted((root / "docs").rglob("*.md"))]]


def quotes(root, files):
    bodies = [block["body"] for block in Page(root, root / "README.md").blocks]
    missing = [name for name in files if (root / name).read_text(encoding="utf-8") not in bodies]
    for name in missing:
        print(f"README.md has no code block that equals {name}: quote the file as it is")
    return 1 if missing else 0


def marks(root):
    faults = [fault for page in pages(root) for fault in page.faults()]
    print("\n".join(faults))
    return 1 if faults else 0


def scratch_root(root, bin_folder, scratch):
    shutil.rmtree(scratch, ignore_errors=True)
    (scratch / "build").mkdir(parents=True)
    for entry in root.iterdir():
        if entry.name not in ("build", ".git"):
            (scratch / entry.name).symlink_to(entry)
    (scratch / "build" / "release").symlink_to(bin_folder)


def has_device(scratch):
    return subprocess.run(["build/release/rimline", "devices"], cwd=scratch,
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0


def run(root, page, bin_folder, scratch, engine):
    scratch_root(root, bin_folder, scratch)
    met = {"models": bool(os.environ.get("RIMLINE_MODELS")), "engine": engine and has_device(scratch)}
    status = 1  # Without any block to run.
    for block in page.blocks:
        mark = MARK.fullmatch(block["before"]) if block["kind"] == "sh" else None
        if not mark or mark["reason"]:
            continue
        at = page.at(block.start("body"))
        lacking = [need for need in (mark["needs"] or "").split() if not met.get(need)]
        if lacking:
            print(f"SKIPPED: {at}: no {' and '.join(lacking)} here", flush=True)
            status = SKIPPED
            continue
        print(f"{at}:", flush=True)
        if subprocess.run(["bash", "-euxo", "pipefail", "-c", block["body"]], cwd=scratch).returncode:
            print(f"{at}: the last command shown failed")
            return 1
        status = 0 if status == 1 else status
    return status


def main():
    root, check = pathlib.Path(sys.argv[1]), sys.argv[2]
    if check == "quotes":
        return quotes(root, sys.argv[3:])
    if check == "marks":
        return marks(root)
    return run(root, Page(root, root / sys.argv[3]), pathlib.Path(sys.argv[4]), pathlib.Path(sys.argv[5]),
               "--engine" in sys.argv[6:])


sys.exit(main())
