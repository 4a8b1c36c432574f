#pragma once

// A folder for several output files. It is created if it is missing, and removed again if it stays empty: a
// failure before the first file leaves nothing behind.

#include <filesystem>
#include <string>

#include "tools/output/leftover.h"

namespace rimline::tools {

class OutputFolder {
public:
    /// Creates the folder if it is missing; its parent folder must exist. `what` names the content in
    /// messages: "frames". Throws Error{io} naming the folder.
    OutputFolder(std::filesystem::path path, const char* what);

    const std::filesystem::path& path() const noexcept { return path_; }

    /// Removes the files PREFIX, at least so many digits, .png: pictures of an older run, which must not be taken for
    /// ones of this run. Throws Error{io} naming a file that cannot be removed, and UsageError if one is a declared
    /// input (input_files.h).
    void remove_numbered(const std::string& prefix, std::size_t min_digits) const;

private:
    std::filesystem::path path_;
    Leftover own_;  // If it was created here.
};

}  // namespace rimline::tools
