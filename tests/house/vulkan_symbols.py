"""vulkan_symbols.py NM LIBRARY: fails where the symbol table of LIBRARY has a name of a Vulkan function.

A program that loads Vulkan by itself, as with volk, defines these names as variables. A call by name would
jump into such a variable."""

import re
import subprocess
import sys

nm, library = sys.argv[1:]
names = subprocess.run([nm, library], check=True, capture_output=True, text=True).stdout
symbols = {line.split()[-1] for line in names.splitlines() if len(line.split()) >= 2}
if len(symbols) < 100:
    sys.exit(f"{library} has only {len(symbols)} symbols: is it the engine?")
if found := sorted(name for name in symbols if re.fullmatch("vk[A-Z][A-Za-z0-9]*", name)):
    sys.exit(f"{library} names {', '.join(found)}")
