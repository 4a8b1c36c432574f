#pragma once

// Standard input, output and error of a program that was started without one of them.

namespace rimline::tools {

/// Opens /dev/null in place of each of the descriptors 0 to 2 that is closed, so that no file that is opened later
/// gets its number: what any library writes to standard error would come to stand in that file. Reading from a
/// standard input, and writing to the standard output, that is missing still fails with EBADF.
void open_missing_standard_descriptors() noexcept;

}  // namespace rimline::tools
