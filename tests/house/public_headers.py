"""public_headers.py CHECK ROOT INCLUDE: the public headers are few, and complete.

INCLUDE is the folder include/rimline of an installed Rimline, ROOT the source tree. CHECK is one of

few       at most MAX_PUBLIC headers are installed
complete  every header of the project that an installed header includes is installed
renderer  engine/renderer.h includes at most MAX_OF_RENDERER other headers of the project
"""

import pathlib
import sys

from includes import headers_included_by, included_headers

# As many as there are today. A new public header is a decision: raise it with the list in
# tools/package/public_headers.cmake.
MAX_PUBLIC = 68
MAX_OF_RENDERER = 15


def few(root, include):
    installed = sorted(path.relative_to(include).as_posix() for path in include.rglob("*.h"))
    print(f"{len(installed)} headers are installed, at most {MAX_PUBLIC} may be")
    if len(installed) <= MAX_PUBLIC:
        return True
    print("\n".join(f"  {header}" for header in installed))
    return False


def complete(root, include):
    found = True
    for path in sorted(include.rglob("*.h")):
        for header in included_headers(path):
            if not (include / header).is_file():
                name = path.relative_to(include).as_posix()
                print(f"{name} includes {header}, which is not installed: add it to "
                      "tools/package/public_headers.cmake, or include it in a source only")
                found = False
    return found


def renderer(root, include):
    headers = sorted(headers_included_by("engine/renderer.h", include, root) - {"engine/renderer.h"})
    print(f"engine/renderer.h includes {len(headers)} headers, at most {MAX_OF_RENDERER} are allowed:")
    print("\n".join(f"  {header}" for header in headers))
    return 0 < len(headers) <= MAX_OF_RENDERER


def main():
    check, root, include = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    if not (include / "silhouette/mesh/mesh.h").is_file():
        print(f"no headers under {include}")
        return False
    return {"few": few, "complete": complete, "renderer": renderer}[check](root, include)


sys.exit(0 if main() else 1)
