#pragma once

// A folder for several output files. It is made where it is missing, and goes again if it is left empty,
// so that what fails or is interrupted before its first file leaves nothing.

#include <filesystem>

namespace rimline::tools {

class OutputFolder {
public:
    /// Makes the folder where it is missing; the folder it lies in must be there. `what` is to be written:
    /// "frames". Throws Error{io} naming the folder.
    OutputFolder(std::filesystem::path path, const char* what);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    const std::filesystem::path& path() const noexcept { return path_; }

private:
    std::filesystem::path path_;
    bool is_own_ = false;  // It was made here.
};

}  // namespace rimline::tools
