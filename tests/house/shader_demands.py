"""shader_demands.py CHECK FOLDER: the SPIR-V files of FOLDER can be given to every device. CHECK is one of

rounding    only those of ROUNDED declare how floats are rounded or flushed (DeviceContext::round_to_nearest_float32;
            VUID-RuntimeSpirv-shaderRoundingModeRTEFloat32-06303 and its neighbors)
workgroups  no workgroup has more invocations than every device supports (maxComputeWorkGroupInvocations)
"""

import array
import math
import pathlib
import sys

ROUNDED = {"face_bits.comp": ["RoundingModeRTE"], "silhouette_faces.comp": ["RoundingModeRTE"]}
MAX_INVOCATIONS = 128
MODES = {4459: "DenormPreserve", 4460: "DenormFlushToZero", 4461: "SignedZeroInfNanPreserve",
         4462: "RoundingModeRTE", 4463: "RoundingModeRTZ"}
LOCAL_SIZE, LOCAL_SIZE_ID = 17, 38
EXECUTION_MODE, CONSTANT, SPEC_CONSTANT, EXECUTION_MODE_ID = 16, 43, 50, 331


def demands_of(path):
    """The modes of floats, and the invocations of a workgroup (None in other stages)."""
    words = array.array("I", path.read_bytes())
    assert words[0] == 0x07230203, f"{path} is not SPIR-V"
    modes, size, constants, at = [], None, {}, 5
    while at < len(words):
        length, instruction = words[at] >> 16, words[at] & 0xffff
        operands = words[at + 1:at + length]
        if instruction == EXECUTION_MODE and operands[1] in MODES:
            modes.append(MODES[operands[1]])
        elif instruction == EXECUTION_MODE and operands[1] == LOCAL_SIZE:
            size = lambda sides=operands[2:]: sides
        elif instruction == EXECUTION_MODE_ID and operands[1] == LOCAL_SIZE_ID:
            size = lambda ids=operands[2:]: [constants[i] for i in ids]
        elif instruction in (CONSTANT, SPEC_CONSTANT):
            constants[operands[1]] = operands[2]
        at += length
    return modes, math.prod(size()) if size else None


check, folder = sys.argv[1:]
demands = {path.stem: demands_of(path) for path in pathlib.Path(folder).glob("*.spv")}
if check == "rounding":
    found = {shader: modes for shader, (modes, _) in demands.items() if modes}
    if found != ROUNDED:
        sys.exit(f"{len(demands)} shaders in {folder} declare {found}, not {ROUNDED}")
elif check == "workgroups":
    sizes = {shader: size for shader, (_, size) in demands.items() if size}
    if any((size is None) == shader.endswith(".comp") for shader, (_, size) in demands.items()):
        sys.exit(f"the sizes of workgroups are not known: {sizes}")
    if not sizes or max(sizes.values()) > MAX_INVOCATIONS:
        sys.exit(f"more than {MAX_INVOCATIONS} invocations, or no compute shader: {sizes}")
else:
    sys.exit(__doc__)
