#pragma once

// Writing pictures as PNG files.

#include "silhouette/picture.h"
#include "tools/output/output_file.h"

namespace rimline::tools {

/// Writes the picture and commits the file. Throws Error{io}.
void write_png(OutputFile& file, const Picture& picture, const LongCall& call = {});

}  // namespace rimline::tools
