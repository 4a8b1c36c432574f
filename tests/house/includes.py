"""Which files of the project a source includes: the part that several house tests share."""

import re

# A file of the project is included with quotes, by its path from the root.
QUOTED = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def included_headers(path):
    """The quoted includes of a file, as written, in order."""
    return QUOTED.findall(path.read_text(encoding="utf-8"))


def headers_included_by(name, *folders):
    """`name` and every header that it includes, directly or not, as names from the root.

    Each is read from the first folder that has it; one that no folder has, a generated header or a
    library's, is left out.
    """
    found, waiting = set(), [name]
    while waiting:
        header = waiting.pop()
        path = next((folder / header for folder in folders if (folder / header).is_file()), None)
        if header not in found and path:
            found.add(header)
            waiting += included_headers(path)
    return found
