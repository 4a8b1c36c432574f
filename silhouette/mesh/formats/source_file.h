#pragma once

// The bytes of a model file in memory, the progress of reading it, and its error messages.
//
// The whole file is read before it is parsed, so that every count in it can be compared with the actual
// size. The file is not memory-mapped, because the program would crash if a mapped file shrinks.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "silhouette/error.h"

namespace rimline {

struct SourceFile {
    std::string name;  ///< The path as the caller gave it. Every message begins with it.
    std::string bytes;
    std::filesystem::path folder;  ///< The folder of files that it refers to.
    /// Offset of the text, after a byte order mark. 0 for binary formats.
    std::size_t text_begin = 0;

    std::string_view text() const noexcept { return std::string_view(bytes).substr(text_begin); }
};

/// Reads a regular file completely. Throws Error{io} if it is missing, is not a regular file or cannot
/// be read. Reports progress up to k_read_share of the call.
SourceFile read_source_file(const std::filesystem::path& path, const LongCall& call);

/// Reading the bytes is this share of the progress. Parsing is the rest.
constexpr double k_read_share = 0.2;

/// Reports the parsed share of the file, `done` in [0, 1]. Checks for cancellation.
inline void parse_checkpoint(const LongCall& call, double done) {
    call.checkpoint(k_read_share + (1.0 - k_read_share) * done);
}

/// Elements between two checkpoints.
constexpr std::uint64_t k_checkpoint_interval = 1 << 16;

[[noreturn]] void bad_file(std::string_view name, const std::string& what);
[[noreturn]] void bad_line(std::string_view name, std::uint64_t line, const std::string& what);
[[noreturn]] void bad_byte(std::string_view name, std::uint64_t offset, const std::string& what);

/// A token of a file for a message: in quotes, shortened, with only printable ASCII characters.
std::string excerpt(std::string_view token);

}  // namespace rimline
