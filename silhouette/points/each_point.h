#pragma once

// A loop over points on all threads. It reports progress and can be stopped.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>

#include "silhouette/error.h"

namespace rimline {

/// In loops on one thread: the points between two checkpoints.
constexpr std::uint32_t k_checkpoint_points = 1u << 16;

/// The part [begin, end] of a long call's progress.
struct CallPart {
    const LongCall& call;
    double begin = 0.0, end = 1.0;
};

/// Calls body(first, last) for ranges of points that together are [0, count).
template <typename Body>
void each_point(std::uint32_t count, const CallPart& part, Body&& body) {
    const std::uint32_t batch = std::max<std::uint32_t>(count / 64, 4096);
    for (std::uint32_t first = 0; first < count;) {
        part.call.checkpoint(part.begin + (part.end - part.begin) * first / count);
        const std::uint32_t last = first + std::min(batch, count - first);
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(first, last, 64),
                          [&](const tbb::blocked_range<std::uint32_t>& range) {
                              body(range.begin(), range.end());
                          });
        first = last;
    }
    part.call.checkpoint(part.end);
}

}  // namespace rimline
