#include "tools/input_files.h"

#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

#include "tools/command.h"

namespace rimline::tools {

namespace fs = std::filesystem;

namespace {

// The window reads models on another thread than it saves pictures.
std::mutex g_inputs_mutex;
std::vector<fs::path> g_inputs;
OutputClaim* g_first_claim = nullptr;

void check_differ(const fs::path& output, const fs::path& input) {
    if (is_same_file(output, input))
        throw UsageError(output.string() +
                         ": the model refers to this file; name another file to write");
}

// Where the mutex is held.
void check_differs_from_inputs(const fs::path& output) {
    for (const fs::path& input : g_inputs) check_differ(output, input);
}

}  // namespace

bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    return fs::equivalent(a, b, ignored);
}

void declare_inputs(std::span<const fs::path> files) {
    const std::lock_guard lock(g_inputs_mutex);
    for (const fs::path& file : files) {
        for (const OutputClaim* claim = g_first_claim; claim != nullptr; claim = claim->next_)
            check_differ(claim->path_, file);
        g_inputs.push_back(file);
    }
}

void check_is_no_input(const fs::path& path) {
    const std::lock_guard lock(g_inputs_mutex);
    check_differs_from_inputs(path);
}

void OutputClaim::take(fs::path path) {
    const std::lock_guard lock(g_inputs_mutex);
    check_differs_from_inputs(path);
    path_ = std::move(path);
    next_ = std::exchange(g_first_claim, this);
}

OutputClaim::~OutputClaim() {
    const std::lock_guard lock(g_inputs_mutex);
    for (OutputClaim** link = &g_first_claim; *link != nullptr; link = &(*link)->next_)
        if (*link == this) {
            *link = next_;
            break;
        }
}

}  // namespace rimline::tools
