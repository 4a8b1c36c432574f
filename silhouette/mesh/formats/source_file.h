#pragma once

// A model file's bytes in memory, how far along its reading is, and how its errors are worded.
//
// The whole file is read before anything is parsed, so that every count in it can be held against the
// bytes that are really there. It is not mapped: a file that shrinks while it is mapped ends the program.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "silhouette/error.h"

namespace rimline {

struct SourceFile {
    std::string name;  ///< As the caller gave the path: every message begins with it.
    std::string bytes;
    std::filesystem::path folder;  ///< Where the files lie that it refers to.
    /// Where its text begins: behind a byte order mark. The binary formats have none.
    std::size_t text_begin = 0;

    std::string_view text() const noexcept { return std::string_view(bytes).substr(text_begin); }
};

/// Reads all of a regular file. Throws Error{io} for one that is missing, is no regular file or cannot
/// be read. Reports progress up to k_read_share of the call.
SourceFile read_source_file(const std::filesystem::path& path, const LongCall& call);

/// Reading the bytes is this share of a load, understanding them the rest.
constexpr double k_read_share = 0.2;

/// Reports how much of the file is understood; checks for cancellation. `done` in [0, 1].
inline void parse_checkpoint(const LongCall& call, double done) {
    call.checkpoint(k_read_share + (1.0 - k_read_share) * done);
}

/// Elements between two checkpoints.
constexpr std::uint64_t k_checkpoint_interval = 1 << 16;

[[noreturn]] void bad_file(std::string_view name, const std::string& what);
[[noreturn]] void bad_line(std::string_view name, std::uint64_t line, const std::string& what);
[[noreturn]] void bad_byte(std::string_view name, std::uint64_t offset, const std::string& what);

/// A piece of a file fit for a message: shortened, and nothing in it but printable ASCII.
std::string excerpt(std::string_view token);

}  // namespace rimline
