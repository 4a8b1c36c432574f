#include "tools/process/thread_limit.h"

#include <sys/resource.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace rimline::tools {

std::uint32_t usual_threads() {
    return static_cast<std::uint32_t>(std::max(tbb::this_task_arena::max_concurrency(), 1));
}

std::uint32_t allowed_threads() {
    const std::size_t threads =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return static_cast<std::uint32_t>(std::max<std::size_t>(threads, 1));
}

std::uint32_t startable_threads(std::uint32_t wanted) {
    std::atomic<bool> may_end = false;
    std::vector<std::thread> threads;
    try {
        // All live at the same time, as oneTBB's do.
        while (threads.size() + 1 < wanted)
            threads.emplace_back([&may_end] { may_end.wait(false); });
    } catch (const std::system_error&) {
    } catch (const std::bad_alloc&) {
    }
    may_end = true;
    may_end.notify_all();
    for (std::thread& thread : threads) thread.join();
    return static_cast<std::uint32_t>(threads.size()) + 1;
}

void start_threads_before_memory_is_taken(std::uint32_t count) {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || count < 2) return;
    // Each task waits for the others, so that no thread takes two; not for long, as oneTBB promises no threads.
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
    std::atomic<std::uint32_t> arrived = 0;
    tbb::parallel_for(
        std::uint32_t{0}, count,
        [&](std::uint32_t) {
            ++arrived;
            while (arrived < count && std::chrono::steady_clock::now() < end)
                std::this_thread::yield();
        },
        tbb::static_partitioner());
}

}  // namespace rimline::tools
