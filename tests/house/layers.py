"""layers.py CHECK ROOT: includes go one way. CHECK is one of

layers   no file includes a file of a higher layer, or of another group of its own layer
circles  no circle of includes among the headers and sources of silhouette/, engine/ and tools/
"""

import pathlib
import sys

from includes import included_headers

# From the lowest layer to the highest. A layer is a list of groups, a group a list of folders and of
# files. A file belongs to the entry that names it, else to the longest folder that holds it. A name
# without a suffix stands for a header and its source.
LAYERS = [
    [["shaders"]],
    [["silhouette"]],
    [["silhouette/mesh"]],
    [["silhouette/hough"]],
    [["silhouette/field"], ["silhouette/points"], ["silhouette/lines"], ["silhouette/rimline"]],
    [["silhouette/methods"]],
    [["engine/vulkan"]],
    [["engine"]],
    [["engine/stream"]],
    [["engine/passes"]],
    [["engine/frame"]],
    [["engine/clouds"], ["engine/measure"]],
    [["engine/renderer"], ["engine/tested_device"]],
    [["tools/samples"]],
    [["tools/process"]],
    [["tools"]],
    [["tools/options"]],
    [["tools/output"]],
    [["tools/batch"]],
    [["tools/commands"], ["tools/bindings"]],
    [["tools/bench"]],
    [["tools/view"], ["tools/main"], ["tools/python"], ["tools/c"]],
]
# A folder that only these may include.
ONLY_FOR = {"silhouette/methods": ("silhouette/methods/", "tools/", "tests/")}

GROUPS = {entry: (rank, number)
          for rank, layer in enumerate(LAYERS) for number, group in enumerate(layer) for entry in group}


def group_of(name):
    """The layer's rank and the number of the group in it, or None outside of the layers."""
    entry = name.rsplit(".", 1)[0]
    while entry:
        if entry in GROUPS:
            return GROUPS[entry]
        entry = entry.rpartition("/")[0]
    return None


def sources(root, *folders):
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                yield path.relative_to(root).as_posix(), path


def layers(root):
    for name, path in sources(root, "shaders", "silhouette", "engine", "tools"):
        rank, number = group_of(name)
        for header in included_headers(path):
            for folder, users in ONLY_FOR.items():
                if header.startswith(folder + "/") and not name.startswith(users):
                    yield f"{name} includes {header}: only {', '.join(users)} may"
            other = group_of(header) if (root / header).is_file() else None
            if other and other[0] > rank:
                yield f"{name} includes {header} of a higher layer"
            elif other and other[0] == rank and other[1] != number:
                yield f"{name} includes {header} of a folder beside its own"


def circles(root):
    # A header and its source are one node: the name without the suffix.
    graph = {}
    for name, path in sources(root, "silhouette", "engine", "tools"):
        node = name.rsplit(".", 1)[0]
        headers = {header.rsplit(".", 1)[0] for header in included_headers(path)}
        graph.setdefault(node, set()).update(headers - {node})
    # Nodes without a way out belong to no circle, nor does what is left without one when they go.
    while ends := [node for node in graph if not graph[node] & graph.keys()]:
        for node in ends:
            del graph[node]
    # From every node that is left the walk goes on until it meets itself.
    while graph:
        walk = [min(graph)]
        while walk.count(walk[-1]) == 1:
            walk.append(min(graph[walk[-1]] & graph.keys()))
        circle = walk[walk.index(walk[-1]):]
        yield "a circle of includes: " + " -> ".join(circle)
        graph[circle[0]].discard(circle[1])
        while ends := [node for node in graph if not graph[node] & graph.keys()]:
            for node in ends:
                del graph[node]


def main():
    found = list({"layers": layers, "circles": circles}[sys.argv[1]](pathlib.Path(sys.argv[2])))
    print("\n".join(found))
    return 1 if found else 0


sys.exit(main())
