#pragma once

// The manifests of shards, merged into the one of the whole batch.

#include <filesystem>
#include <vector>

#include "tools/batch/batch_inputs.h"
#include "tools/batch/batch_manifest.h"
#include "tools/batch/batch_task.h"

namespace rimline::tools {

/// manifest.jsonl in `folder`; of one shard of several manifest.I-of-N.jsonl.
std::filesystem::path batch_manifest_path(const std::filesystem::path& folder, const Shard& shard);

/// Appends to `manifest` what the manifests of shards in `folder`, whatever their N, have of the tasks with the
/// same command. A task that `manifest` knows gets a line only where its line is of another command or of content
/// that the model no longer has, or where it failed and the shard did it. So a merge can be repeated, and one that
/// was killed goes on. A model is read where lines differ about its content. Throws what BatchManifest throws, also
/// of a shard that runs; with `waits` it waits for that one.
void merge_shards(const std::filesystem::path& folder, const std::vector<BatchTask>& tasks,
                  BatchManifest& manifest, bool waits, const LongCall& call);

}  // namespace rimline::tools
