"""suite_names.py ROOT: CTest finds each test case by its name, and those of a suite by its label.

A case with a semicolon in its name never runs under CTest, where it ends an item of a list. CTest finds the
suite of a case by asking doctest for the case of that name, and doctest splits names at commas: a case with a
comma would get no label, so scripts that choose by label would not find it.
"""

import pathlib
import re
import sys

LABELS = ("long", "threads", "plain")
# A suite begins, a suite ends, or a case has a name of one or more string literals.
PLACES = re.compile(r'TEST_SUITE(?:_BEGIN)?\("(?P<suite>[^"]*)"\)|(?P<end>^(?:TEST_SUITE_END|}))'
                    r'|TEST_CASE\w*\(\s*(?P<name>(?:"(?:[^"\\]|\\.)*"\s*)+)'
                    r'(?:\*\s*doctest::test_suite\("(?P<own>[^"]*)"\))?', re.MULTILINE)


def misnamed(path):
    text = path.read_text()
    suite = None
    for place in PLACES.finditer(text):
        if place["suite"]:
            suite = place["suite"]
        elif place["end"]:
            suite = None
        else:
            name = "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', place["name"]))
            where = f"{path}:{text.count(chr(10), 0, place.start()) + 1}"
            if ";" in name:
                yield f"{where}: a semicolon in the name of a case: {name}"
            if (place["own"] or suite) in LABELS and "," in name:
                yield f"{where}: a comma in the name of a case in suite {place['own'] or suite}: {name}"


def main():
    root = pathlib.Path(sys.argv[1])
    found = [line for path in sorted((root / "tests").rglob("*.cpp")) for line in misnamed(path)]
    print("\n".join(found))
    return 1 if found else 0


sys.exit(main())
