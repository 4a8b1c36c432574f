#pragma once

// An output file that appears complete or not at all.
//
// The bytes go to a temporary file without a name, which the system frees however the program ends. commit()
// gives it a name beside the target (part_name.h) and renames it to the target, which is atomic. File systems
// without such files, as NFS, get one that has the name from the beginning; it is removed unless the program is
// killed, and then by the next one that writes into the folder. If writing ends before commit(), also by an
// exception, the old file is unchanged. This protects against failures of the program, not of the power supply:
// there is no fsync.

#include <filesystem>
#include <string>
#include <string_view>

#include "tools/input_files.h"
#include "tools/output/leftover.h"

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
    /// UsageError if it is the file `model`, which is an input, or a declared input (input_files.h).
    explicit OutputFile(std::filesystem::path path, const std::filesystem::path& model = {});
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Appends bytes unchanged. Throws Error{io}.
    void write(std::string_view bytes);
    /// Puts the temporary file in the target's place. Call it once, after the last write. Throws Error{io}.
    void commit();

    const std::filesystem::path& path() const noexcept { return path_; }
    /// A name of the temporary file, for another program to write; empty if bytes are written directly. It ends
    /// with this process.
    std::filesystem::path temporary() const;

private:
    [[noreturn]] void fail(const std::string& problem, int error_number) const;
    template <typename Make>
    void make_part(Make&& make);
    void close_descriptor() noexcept;

    std::filesystem::path path_;    // The name that the caller gave.
    std::filesystem::path target_;  // The same with links resolved.
    std::filesystem::path folder_;  // Of the target. Empty if bytes are written directly.
    OutputClaim claim_;             // Of a regular file.
    Leftover part_;                 // The temporary file while it has a name.
    int descriptor_ = -1;
};

}  // namespace rimline::tools
