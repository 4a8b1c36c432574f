"""whole_once.py FOLDER EXPECTED: the batch in FOLDER, merged from shards, is the one that a machine made in EXPECTED.

Each model has one line in the manifest, of the same content, command and status, and was done once by all shards
together. The same files are there with the same bytes, and no others.
"""

import collections
import json
import pathlib
import sys


def lines(path):
    text = path.read_text()
    assert text.endswith("\n") or not text, f"{path}: the last line is cut"
    return [json.loads(line) for line in text.splitlines()]


def told(folder):
    """What the manifest tells, without times and the name of the folder."""
    entries = lines(folder / "manifest.jsonl")
    doubled = [key for key, n in collections.Counter(entry["input"] for entry in entries).items() if n > 1]
    assert not doubled, f"{folder}: more than one line for {doubled}"
    return {entry["input"]: {key: json.loads(json.dumps(entry[key]).replace(f"{folder}/", "OUT/"))
                             for key in ("digest", "command", "status", "error", "outputs")} for entry in entries}


def outputs(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*")
            if path.is_file() and path.suffix not in (".jsonl", ".log")}


def main():
    folder, expected = map(pathlib.Path, sys.argv[1:])
    found, wanted = told(folder), told(expected)
    assert found.keys() == wanted.keys(), f"lost {wanted.keys() - found.keys()}, added {found.keys() - wanted.keys()}"
    for key, entry in wanted.items():
        assert found[key] == entry, f"{key}: {found[key]} is not {entry}"
    done = collections.Counter(entry["input"] for path in folder.glob("manifest.*-of-*.jsonl")
                               for entry in lines(path) if entry["status"] == "ok")
    assert all(n == 1 for n in done.values()), f"done more than once: {done}"
    assert done.keys() == {key for key, entry in wanted.items() if entry["status"] == "ok"}
    files, wanted_files = outputs(folder), outputs(expected)
    assert files.keys() == wanted_files.keys(), f"files: {files.keys() ^ wanted_files.keys()}"
    for name, data in wanted_files.items():
        assert files[name] == data, f"{folder / name} has other bytes"


main()
