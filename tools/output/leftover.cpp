#include "tools/output/leftover.h"

#include <cerrno>
#include <cstdio>

namespace rimline::tools {

namespace {

Leftover* g_first_leftover = nullptr;  // Guarded by Leftover::mutex().

}  // namespace

std::mutex& Leftover::mutex() noexcept {
    static std::mutex mutex;
    return mutex;
}

Leftover::~Leftover() {
    const std::lock_guard lock(mutex());
    if (path_.empty()) return;
    std::remove(path_.c_str());
    disown();
}

int Leftover::rename_to(const std::filesystem::path& target) noexcept {
    const std::lock_guard lock(mutex());
    if (std::rename(path_.c_str(), target.c_str()) != 0) return errno;
    disown();
    return 0;
}

void Leftover::own(std::filesystem::path path) noexcept {
    path_ = std::move(path);
    next_ = std::exchange(g_first_leftover, this);
}

void Leftover::disown() noexcept {
    path_.clear();
    Leftover** link = &g_first_leftover;
    while (*link != this) link = &(*link)->next_;
    *link = next_;
}

void remove_leftovers() noexcept {
    const std::lock_guard lock(Leftover::mutex());
    for (const Leftover* left = g_first_leftover; left != nullptr; left = left->next_)
        std::remove(left->path_.c_str());
}

}  // namespace rimline::tools
