"""named_files.py ROOT: a comment or a page of docs that names a file of the project names one that exists.

Read are the comments of C++, GLSL, CMake and shell scripts, and all of *.md but its code blocks. A name is
a word that ends in one of SUFFIXES. A path has to exist from the root or from the folder of the file that
names it, a bare name anywhere in the tree; `*` and `<word>` stand for any part of a name. Not checked are
addresses, absolute paths, headers of libraries (those that the tree includes in angle brackets), and headers
that the build makes from a shader or a script.
"""

import fnmatch
import pathlib
import posixpath
import re
import sys

SUFFIXES = "h cpp py md cmake sh gp glsl vert geom frag comp".split()
NAME = re.compile(r"(?<![\w./*<>:$~{-])(?:<\w+>|[\w*./-])*\.(?:" + "|".join(SUFFIXES) + r")(?![\w*-]|\.\w)")
CODE = re.compile(r'"(?:\\.|[^"\\\n])*"|//[^\n]*|/\*.*?\*/', re.DOTALL)
INCLUDED = re.compile(r"^\s*#\s*include\s*<([^>]+)>", re.MULTILINE)
FENCED = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
SKIPPED_FOLDERS = ("build", ".git")


def blank(text):
    return re.sub(r"[^\n]", " ", text)


def checked_text(path):
    """The file's text with everything blank but what is checked, or None for a file of another kind."""
    if path.suffix == ".md":
        return FENCED.sub(lambda match: blank(match[0]), path.read_text(encoding="utf-8"))
    if path.suffix in (".cmake", ".sh") or path.name == "CMakeLists.txt":
        return re.sub(r"^([^#\n]*)", lambda match: blank(match[0]), path.read_text(encoding="utf-8"),
                      flags=re.MULTILINE)
    if path.suffix[1:] not in ("h", "cpp", "glsl", "vert", "geom", "frag", "comp"):
        return None
    text, kept, end = path.read_text(encoding="utf-8"), [], 0
    for match in CODE.finditer(text):
        kept += [blank(text[end:match.start()]), match[0] if match[0][0] == "/" else blank(match[0])]
        end = match.end()
    return "".join(kept)


def made_by_the_build(name, files):
    """line_vert.h is made from line.vert, vtk_silhouette_script.h from vtk_silhouette.py."""
    stem = pathlib.PurePath(name).stem
    shader, _, stage = stem.rpartition("_")
    return name.endswith(".h") and (f"{shader}.{stage}" in files or stem.removesuffix("_script") + ".py" in files)


def main():
    root = pathlib.Path(sys.argv[1])
    paths = [path for entry in sorted(root.iterdir()) if entry.name not in SKIPPED_FOLDERS
             for path in ([entry] if entry.is_file() else sorted(entry.rglob("*"))) if path.is_file()]
    names = {path.name for path in paths}
    of_libraries = {name for path in paths if path.suffix in (".h", ".cpp")
                    for header in INCLUDED.findall(path.read_text(encoding="utf-8"))
                    for name in (header, pathlib.PurePath(header).name)}
    from_root = {path.relative_to(root).as_posix() for path in paths}
    found = []
    for path in paths:
        text = checked_text(path)
        for match in NAME.finditer(text or ""):
            name = match[0]
            pattern = re.sub(r"<\w+>", "*", name)
            if "/" in name:
                beside = posixpath.normpath((path.parent.relative_to(root) / pattern).as_posix())
                exists = fnmatch.filter(from_root, pattern) or fnmatch.filter(from_root, beside)
            else:
                exists = fnmatch.filter(names, pattern)
            if not exists and name not in of_libraries and not made_by_the_build(name, names):
                line = text.count("\n", 0, match.start()) + 1
                found.append(f"{path.relative_to(root)}:{line}: there is no {name}")
    print("\n".join(found))
    return 1 if found else 0


sys.exit(main())
