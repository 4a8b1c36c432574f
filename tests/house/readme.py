"""Checks README.md against the tree, so that it cannot say what is no longer so.

readme.py ROOT quotes FILE...     every FILE stands in README.md as a code block, word for word
readme.py ROOT run BIN SCRATCH    the commands of tested blocks succeed

A code block whose preceding line is the comment <!-- tested --> (invisible where the page is shown)
holds commands as a reader types them in the root: they name the program build/release/rimline. They
run here with the program of folder BIN, in a copy of the root made of links under SCRATCH, so that
what they write stays out of the tree. <!-- tested: engine --> marks commands that need a Vulkan
device, <!-- tested: models --> those that read $RIMLINE_MODELS; without, such a block is left out
and named.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

# Optional mark line, opening fence, body, closing fence.
BLOCK = re.compile(
    r"^(?:<!-- *tested(?P<mark>(?:: *[a-z ]+)?) *-->\n)?```(?P<kind>[a-z+]*)\n(?P<body>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)
MARK = re.compile(r"^\s*<!-- *tested", re.MULTILINE)


def quotes(readme, root, files):
    bodies = [block["body"] for block in BLOCK.finditer(readme)]
    missing = [name for name in files if (root / name).read_text(encoding="utf-8") not in bodies]
    for name in missing:
        print(f"README.md has no code block that equals {name}: quote the file as it is")
    return not missing


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


def run(readme, root, bin_folder, scratch, engine):
    blocks = [block for block in BLOCK.finditer(readme) if block["mark"] is not None]
    if not blocks or len(blocks) != len(MARK.findall(readme)):
        print("README.md has no tested blocks, or a mark that no code block follows on the next line")
        return False
    scratch_root(root, bin_folder, scratch)
    met = {"models": bool(os.environ.get("RIMLINE_MODELS")), "engine": engine and has_device(scratch)}
    for block in blocks:
        line = readme.count("\n", 0, block.start("body"))
        needs = block["mark"].lstrip(": ").split()
        unknown = [need for need in needs if need not in met]
        if unknown or block["kind"] != "sh":
            print(f"README.md:{line}: a tested block is a ```sh block that needs of: {', '.join(met)}")
            return False
        lacking = [need for need in needs if not met[need]]
        if lacking:
            print(f"README.md:{line}: left out, no {' and '.join(lacking)} here", flush=True)
            continue
        print(f"README.md:{line}:", flush=True)
        if subprocess.run(["bash", "-euxo", "pipefail", "-c", block["body"]], cwd=scratch).returncode:
            print(f"README.md:{line}: the last command shown failed")
            return False
    return True


def main():
    root = pathlib.Path(sys.argv[1])
    try:
        readme = (root / "README.md").read_text(encoding="utf-8")
    except OSError as error:
        print(error)
        return False
    if sys.argv[2] == "quotes":
        return quotes(readme, root, sys.argv[3:])
    return run(readme, root, pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4]),
               "--engine" in sys.argv[5:])


sys.exit(0 if main() else 1)
