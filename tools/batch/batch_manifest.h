#pragma once

// The manifest of a batch: a line of JSON for each model that is done.
//
//     {"input":..., "digest":..., "command":..., "status":"ok", "ms":..., "outputs":[...], "error":null, "result":{...}}
//
// A line is appended by one write when the model's outputs are there. So a batch that was killed lacks lines, but has
// none that is not true: the next one goes on with what has none. Of several lines for an input the last one counts.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <unordered_map>
#include <vector>

namespace rimline::tools {

/// What is known of a model from an earlier run.
struct BatchEntry {
    std::string digest, command, status, error;
    std::vector<std::string> outputs;
    double ms = 0.0;
};

class BatchManifest {
public:
    /// Reads the file if it exists, and locks it for this process. A last line without end is taken off. Throws
    /// Error{io}, Error{bad_input} naming a line that is no entry, and Error{io} where another batch has the lock.
    explicit BatchManifest(const std::filesystem::path& path);
    ~BatchManifest();
    BatchManifest(const BatchManifest&) = delete;
    BatchManifest& operator=(const BatchManifest&) = delete;

    /// Null if there is none.
    const BatchEntry* find(const std::string& input) const;
    const std::unordered_map<std::string, BatchEntry>& entries() const noexcept { return entries_; }

    /// Appends a line with these keys, and knows it from then on. Throws Error{io}.
    void append(const nlohmann::ordered_json& entry);

private:
    void read(const std::string& text);
    void take(const nlohmann::ordered_json& line);

    std::filesystem::path path_;
    int descriptor_ = -1;
    std::unordered_map<std::string, BatchEntry> entries_;
};

}  // namespace rimline::tools
