#pragma once

// Where summaries for people go: to standard output, or elsewhere when that holds something else.
//
// Commands print their summaries with std::printf. The functions here replace the C stream `stdout`, not the
// descriptor, which stays standard output.

namespace rimline::tools {

/// From now on what is printed to `stdout` is dropped.
void drop_summary();

/// From now on what is printed to `stdout` goes to standard error, unless it is dropped already.
void move_summary_to_standard_error();

}  // namespace rimline::tools
