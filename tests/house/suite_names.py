"""suite_names.py ROOT: cases of suites that scripts choose by label have no comma in their names.

CTest finds the suite of a case by asking doctest for the case of that name, and doctest splits names at
commas. A case with a comma would get no label, so scripts that choose by label would not find it.
"""

import pathlib
import re
import sys

LABELS = ("long", "threads")


def misnamed(path):
    suite = None
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if begin := re.match(r'TEST_SUITE(_BEGIN)?\("([^"]*)"\)', line):
            suite = begin[2]
        elif line.startswith("TEST_SUITE_END"):
            suite = None
        elif suite in LABELS and (case := re.match(r'\s*TEST_CASE\("([^"]*)', line)):
            if "," in case[1]:
                yield f"{path}:{number}: a comma in the name of a case in suite {suite}: {case[1]}"


def main():
    root = pathlib.Path(sys.argv[1])
    found = [line for path in sorted((root / "tests").rglob("*.cpp")) for line in misnamed(path)]
    print("\n".join(found))
    return 1 if found else 0


sys.exit(main())
