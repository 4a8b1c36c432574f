#pragma once

// Finished pictures as PNG files.

#include "silhouette/picture.h"
#include "tools/output/output_file.h"

namespace rimline::tools {

/// Writes all of a file, and puts it in its place. Throws Error{io}.
void write_png(OutputFile& file, const Picture& picture);

}  // namespace rimline::tools
