#include "tools/batch/batch_merge.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

namespace rimline::tools {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> shard_manifests(const fs::path& folder) {
    std::vector<fs::path> paths;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("manifest.") && name.ends_with(".jsonl") &&
            name.find("-of-") != std::string::npos)
            paths.push_back(entry.path());
    }
    if (error) throw Error(ErrorCode::io, folder.string() + ": cannot read: " + error.message());
    std::ranges::sort(paths);
    return paths;
}

bool is_news(const BatchEntry* known, const BatchEntry& entry, const BatchTask& task,
             const LongCall& call) {
    if (known == nullptr || known->command != task.command) return true;
    if (known->digest != entry.digest) {
        try {
            return digest_of(task.input.model, call) == entry.digest;
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) throw;
            return entry.digest.empty();
        }
    }
    return known->status != "ok" && entry.status == "ok";
}

}  // namespace

fs::path batch_manifest_path(const fs::path& folder, const Shard& shard) {
    if (shard.count == 1) return folder / "manifest.jsonl";
    return folder / ("manifest." + std::to_string(shard.number) + "-of-" +
                     std::to_string(shard.count) + ".jsonl");
}

void merge_shards(const fs::path& folder, const std::vector<BatchTask>& tasks,
                  BatchManifest& manifest, bool waits, const LongCall& call) {
    const LongCall part{call.stop, {}};
    const std::vector<fs::path> paths = shard_manifests(folder);
    for (const fs::path& path : paths) {
        call.checkpoint(double(&path - paths.data()) / double(paths.size()));
        const BatchManifest shard(path, waits ? &part : nullptr);
        for (const BatchTask& task : tasks) {
            const BatchEntry* entry = shard.find(task.key);
            if (entry == nullptr || entry->command != task.command) continue;
            if (!is_news(manifest.find(task.key), *entry, task, part)) continue;
            manifest.append(nlohmann::ordered_json::parse(shard.line(*entry)));
        }
    }
}

}  // namespace rimline::tools
