#pragma once

// Names of part files: .NAME.PROCESS.N.part, beside the file NAME that they become.
//
// The number of the process tells the files of a running program from those that a killed one left behind.
// Numbers of processes are one machine's, or one container's, and folders may be shared by several: a running
// program therefore holds a lock on its part files too.

#include <filesystem>
#include <string>

namespace rimline::tools {

/// Of this process. `attempt` is N.
std::string part_name(const std::filesystem::path& target, int attempt);

/// Locks an open part file until it is closed. File systems without locks are no error.
void lock_part(int descriptor) noexcept;

/// Removes the part files in `folder` whose process has ended and that nobody has locked. Looks at each folder once
/// in the life of this process. Errors are ignored: it is not what the user asked for.
void remove_dead_parts(const std::filesystem::path& folder) noexcept;

}  // namespace rimline::tools
