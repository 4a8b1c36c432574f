#pragma once

// An output file that appears whole or not at all.
//
// The bytes go to a temporary file in the target's folder; commit() renames it over the target, which
// the system does in one step. Whatever ends the writing before that, an exception included, leaves the
// old file as it was and no temporary. (Against a failing program, not against a failing power supply:
// nothing is forced to the disk.)

#include <filesystem>
#include <string>
#include <string_view>

namespace rimline::tools {

class OutputFile {
public:
    /// Open it before the work whose result it takes, so that a bad path is known at once. Throws
    /// Error{io} naming `path` when its folder is missing, it is a folder or it may not be written, and
    /// UsageError when it is the file `model`, which is to be read. A symbolic link is followed, to where
    /// nothing is yet too; a device or pipe is written to directly.
    explicit OutputFile(std::filesystem::path path, const std::filesystem::path& model = {});
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Appends bytes, as they are. Throws Error{io}.
    void write(std::string_view bytes);
    /// Puts the file in its place. Call it once, after the last write. Throws Error{io}.
    void commit();

    const std::filesystem::path& path() const noexcept { return path_; }

private:
    friend void remove_temporary_files() noexcept;
    [[noreturn]] void fail(const std::string& doing, int error_number) const;
    void close_descriptor() noexcept;

    std::filesystem::path path_;       // As the caller named it.
    std::filesystem::path target_;     // Links resolved.
    std::filesystem::path temporary_;  // Empty when written directly, and after commit().
    int descriptor_ = -1;
    OutputFile* next_ = nullptr;  // In the list of those that have a temporary.
};

/// Whether both are names of one file, and it is there.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Removes the temporaries of all files not yet committed: for a thread that ends the program while
/// others run, so that no destructor does.
void remove_temporary_files() noexcept;

}  // namespace rimline::tools
