"""folders.py CHECK ROOT: the folders keep their order. CHECK is one of

top     only TOP lies at the top, dot files aside; of what git has, if the tree is a repository
few     engine/ and tools/ hold at most MAX_FILES files each, folders not counted
mirror  every test lies in tests/ in a folder of the same path as the folder that it tests
"""

import pathlib
import shutil
import subprocess
import sys

TOP = ("CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "docs", "engine", "shaders", "silhouette", "tests",
       "tools")
MAX_FILES = 36
# Tests of no single folder: a Vulkan that fails on demand, exact arithmetic, the same result everywhere, and the long
# comparison of all methods.
OTHER_TESTS = (
    "tests/engine/faults",
    "tests/silhouette/exact",
    "tests/silhouette/identity",
    "tests/silhouette/methods/proof",
)


def top(root):
    if not (root / ".git").exists() or shutil.which("git") is None:
        return
    listed = subprocess.run(["git", "-c", "safe.directory=*", "ls-files", "-z"], cwd=root, capture_output=True, text=True,
                            check=True).stdout
    for name in sorted({path.split("/")[0] for path in listed.split("\0") if path}):
        if name not in TOP and not name.startswith("."):
            yield f"{name} does not belong at the top: remove it, or put it into a folder"


def few(root):
    for folder in ("engine", "tools"):
        count = sum(path.is_file() for path in (root / folder).iterdir())
        if count > MAX_FILES:
            yield f"{folder}/ holds {count} files, at most {MAX_FILES} may be: move some into a folder"


def mirror(root):
    for suffix in ("cpp", "py"):
        for path in sorted((root / "tests").rglob(f"*_test.{suffix}")):
            folder = path.parent.relative_to(root)
            if folder.as_posix() not in OTHER_TESTS and not (root / folder.relative_to("tests")).is_dir():
                yield f"{path.relative_to(root)} tests no folder: there is no {folder.relative_to('tests')}"


def main():
    found = list({"top": top, "few": few, "mirror": mirror}[sys.argv[1]](pathlib.Path(sys.argv[2])))
    print("\n".join(found))
    return 1 if found else 0


sys.exit(main())
