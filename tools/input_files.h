#pragma once

// Which files are inputs, so that no output takes their place.
//
// The model itself is known when the program starts; each output is compared with it (output_file.h). What the
// model refers to, its textures and material libraries, is known only when it has been read: after the first
// outputs were opened, and before others.

#include <filesystem>
#include <span>

namespace rimline::tools {

/// Whether both name the same existing file.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// The model refers to `files`, from now on until the program ends. Throws UsageError if one of them is claimed.
void declare_inputs(std::span<const std::filesystem::path> files);

/// Throws UsageError if `path` is one of these files, by whatever name.
void check_is_no_input(const std::filesystem::path& path);

/// A file that is going to be written, while this object lives.
class OutputClaim {
public:
    OutputClaim() = default;
    ~OutputClaim();
    OutputClaim(const OutputClaim&) = delete;
    OutputClaim& operator=(const OutputClaim&) = delete;

    /// Throws UsageError if `path` is a declared input. Call it once.
    void take(std::filesystem::path path);

private:
    friend void declare_inputs(std::span<const std::filesystem::path> files);

    std::filesystem::path path_;
    OutputClaim* next_ = nullptr;
};

}  // namespace rimline::tools
