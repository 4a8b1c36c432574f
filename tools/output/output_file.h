#pragma once

// An output file that appears complete or not at all.
//
// The bytes go to a temporary file in the target's folder. commit() renames it to the target, which is
// atomic. If writing ends before that, also by an exception, the old file is unchanged and the temporary
// file is removed. This protects against failures of the program, not of the power supply: there is no
// fsync.

#include <filesystem>
#include <string>
#include <string_view>

namespace rimline::tools {

struct Context;

/// Throws UsageError if `output` is standard output, where the JSON goes.
void check_output(const Context& context, const std::string& output);

class OutputFile {
public:
    /// Create it before the work, so that a bad path is reported at once. Follows symbolic links, also to
    /// files that do not exist. Writes to a device or pipe directly, and to standard output for k_standard_output;
    /// summaries go to standard error then (summary_stream.h). Throws UsageError if that is a terminal. Throws
    /// Error{io} naming `path` if its folder is missing, if it is a folder, or if it cannot be written. Throws
    /// UsageError if it is the file `model`, which is an input.
    explicit OutputFile(std::filesystem::path path, const std::filesystem::path& model = {});
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Appends bytes unchanged. Throws Error{io}.
    void write(std::string_view bytes);
    /// Renames the temporary file to the target. Call it once, after the last write. Throws Error{io}.
    void commit();

    const std::filesystem::path& path() const noexcept { return path_; }
    /// The file that commit() renames, for another program to write; empty if bytes are written directly.
    const std::filesystem::path& temporary() const noexcept { return temporary_; }

private:
    friend void remove_temporary_files() noexcept;
    [[noreturn]] void fail(const std::string& problem, int error_number) const;
    void close_descriptor() noexcept;

    std::filesystem::path path_;       // The name that the caller gave.
    std::filesystem::path target_;     // The same with links resolved.
    std::filesystem::path temporary_;  // Empty if written directly, and after commit().
    int descriptor_ = -1;
    OutputFile* next_ = nullptr;  // Next in the list of files that have a temporary file.
};

/// Whether both name the same existing file.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Removes the temporary files that are not yet committed. For a thread that ends the program while other
/// threads run, because their destructors are then not called.
void remove_temporary_files() noexcept;

}  // namespace rimline::tools
