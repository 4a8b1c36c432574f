#pragma once

// Processes of `rimline batch` end when the batch does, also by kill -9, so that the next batch meets none of them.

namespace rimline::tools {

/// The variable with which a parent asks for this; its value is the parent's process id.
constexpr const char* k_parent_variable = "RIMLINE_BATCH_PROCESS";

/// Asks the system for SIGTERM at the end of the parent that set the variable, and ends the program at once if that
/// was before. Does nothing without the variable.
void end_with_parent();

}  // namespace rimline::tools
