"""abi.py LIBRARY LAYOUT NM HEADER ABI: the library has exactly the symbols and layouts that the file ABI lists.

LAYOUT is the program of abi.c. Symbols and fields may be added, and the file then too; one that changes or goes away
breaks programs, and needs another SOVERSION. `--print` in place of ABI prints the file.
"""

import pathlib
import re
import subprocess
import sys

library, layout, nm, header, abi = sys.argv[1:]


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


symbols = set()
for line in output(nm, "--dynamic", "--defined-only", library).splitlines():
    name = line.split()[-1]
    if name != "RIMLINE_1@@RIMLINE_1" and name != "RIMLINE_1":
        symbols.add(name)
found = [*output(layout).splitlines(), *sorted(f"symbol {name}" for name in symbols)]
if abi == "--print":
    print("\n".join(found))
    sys.exit(0)

faults = []
declared = set(re.findall(r"^RIMLINE_API [^;(]*?(rimline_\w+)\(", pathlib.Path(header).read_text(), re.M))
exported = {name.split("@")[0] for name in symbols}
faults += [f"{name} is declared and not exported" for name in sorted(declared - exported)]
faults += [f"{name} is exported and not declared" for name in sorted(exported - declared)]
listed = pathlib.Path(abi).read_text().splitlines()
faults += [f"changed or gone: {line}" for line in listed if line not in found]
faults += [f"new: {line}" for line in found if line not in listed]
print("\n".join(faults) or f"{len(symbols)} symbols and {len(found) - len(symbols)} numbers are as listed")
sys.exit(1 if faults else 0)
