#pragma once

// How many threads this program can have.
//
// oneTBB starts its threads when they are first needed, some of them from other ones of its own, and gives up where
// the system refuses one. The system has fewer than processors where their number (ulimit -u, cgroups) or the
// memory for their stacks (ulimit -v) is limited.

#include <cstdint>

namespace rimline::tools {

/// The number of threads with which oneTBB works by itself.
std::uint32_t usual_threads();

/// As many threads as oneTBB may have at a time: those of --threads, else the processors that this process may use.
std::uint32_t allowed_threads();

/// At most `wanted`, at least 1, this thread among them: as many as the system starts now. Cost: some ten
/// microseconds a thread.
std::uint32_t startable_threads(std::uint32_t wanted);

/// Where the address space is limited, makes oneTBB start `count` threads now, before other data takes the
/// memory for their stacks.
void start_threads_before_memory_is_taken(std::uint32_t count);

}  // namespace rimline::tools
