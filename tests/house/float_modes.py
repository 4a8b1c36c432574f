"""float_modes.py FOLDER: of the SPIR-V files of FOLDER, only those of ALLOWED declare how floats are rounded or flushed.

A device without such a mode may not be given the module (VUID-RuntimeSpirv-shaderRoundingModeRTEFloat32-06303 and its
neighbors). Only meshes that deform may need one: DeviceContext::round_to_nearest_float32."""

import array
import pathlib
import sys

ALLOWED = {"face_bits.comp": ["RoundingModeRTE"], "silhouette_faces.comp": ["RoundingModeRTE"]}
MODES = {4459: "DenormPreserve", 4460: "DenormFlushToZero", 4461: "SignedZeroInfNanPreserve",
         4462: "RoundingModeRTE", 4463: "RoundingModeRTZ"}
EXECUTION_MODE = 16


def modes_of(path):
    words = array.array("I", path.read_bytes())
    assert words[0] == 0x07230203, f"{path} is not SPIR-V"
    found, at = [], 5
    while at < len(words):
        length, instruction = words[at] >> 16, words[at] & 0xffff
        if instruction == EXECUTION_MODE and words[at + 2] in MODES:
            found.append(MODES[words[at + 2]])
        at += length
    return found


files = sorted(pathlib.Path(sys.argv[1]).glob("*.spv"))
found = {path.stem: modes for path in files if (modes := modes_of(path))}
if found != ALLOWED:
    sys.exit(f"{len(files)} shaders in {sys.argv[1]} declare {found}, not {ALLOWED}")
