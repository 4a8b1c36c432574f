#pragma once

// Evaluates a function at many points on all threads. One thread computes each value.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/vec3.hpp>
#include <span>

#include "silhouette/error.h"

namespace rimline {

/// out[i] = value(points[i]). Calls value = make_value() once per range of points, so `value` may own
/// working memory. A value may take milliseconds: a stop is noticed after each. Reports progress a few hundred times,
/// after at least 32 points.
template <typename MakeValue>
void many_values(std::span<const glm::dvec3> points, std::span<double> out, const LongCall& call,
                 MakeValue&& make_value) {
    RIMLINE_CHECK(points.size() == out.size());
    const std::size_t batch = std::clamp<std::size_t>(points.size() / 256, 32, 256);
    const LongCall stop{call.stop, {}};
    const auto done = [&](std::size_t count) {
        return points.empty() ? 1.0
                              : static_cast<double>(count) / static_cast<double>(points.size());
    };
    for (std::size_t begin = 0; begin < points.size(); begin += batch) {
        call.checkpoint(done(begin));
        const std::size_t end = std::min(begin + batch, points.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 16),
                          [&](const tbb::blocked_range<std::size_t>& part) {
                              auto value = make_value();
                              for (std::size_t i = part.begin(); i < part.end(); ++i) {
                                  stop.checkpoint(0.0);
                                  out[i] = value(points[i]);
                              }
                          });
    }
    call.checkpoint(1.0);
}

}  // namespace rimline
