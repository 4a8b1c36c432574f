#pragma once

// The manifest of a batch: a line of JSON for each model that is done.
//
//     {"input":..., "digest":..., "command":..., "status":"ok", "ms":..., "outputs":[...], "error":null, "result":{...}}
//
// A line is appended by one write when the model's outputs are there. So a batch that was killed lacks lines, but has
// none that is not true: the next one goes on with what has none. Of several lines for an input the last one counts.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "silhouette/error.h"

namespace rimline::tools {

/// What is known of a model from an earlier run.
struct BatchEntry {
    std::string digest, command, status, error;
    std::vector<std::string> outputs;
    double ms = 0.0;
    std::uint64_t begin = 0,
                  size = 0;  ///< Bytes of its line in the file, without the end of the line.
};

class BatchManifest {
public:
    /// Reads the file if it exists, and locks it for this process. A last line without end is taken off. Throws
    /// Error{io}, Error{bad_input} naming a line that is no entry, and Error{io} where another batch has the lock:
    /// with `wait` it waits for that one instead, and stops as that call does.
    explicit BatchManifest(const std::filesystem::path& path, const LongCall* wait = nullptr);
    /// Of a file that is there, to be read alone, while another batch may write it. Throws the same, but for the lock.
    static BatchManifest as_it_is(const std::filesystem::path& path);
    ~BatchManifest();
    BatchManifest(const BatchManifest&) = delete;
    BatchManifest& operator=(const BatchManifest&) = delete;

    /// Null if there is none.
    const BatchEntry* find(const std::string& input) const;
    const std::unordered_map<std::string, BatchEntry>& entries() const noexcept { return entries_; }

    /// The text of an entry's line. Throws Error{io}.
    std::string line(const BatchEntry& entry) const;

    /// Appends a line with these keys, and knows it from then on. Throws Error{io}.
    void append(const nlohmann::ordered_json& entry);

private:
    BatchManifest(const std::filesystem::path& path, const LongCall* wait, bool is_written);
    void lock(const LongCall* wait) const;
    void read(const std::string& text);
    void take(const nlohmann::ordered_json& line, std::uint64_t size);

    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;  // Of the file.
    std::unordered_map<std::string, BatchEntry> entries_;
};

}  // namespace rimline::tools
