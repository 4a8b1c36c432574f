#pragma once

// Results of `rimline bench hough` for tests, without a measurement.

#include <cstdint>

#include "tools/bench/hough.h"

namespace rimline::tools {

inline Times times_of(double us) { return {"made", false, {us, us, us}, {{}, {}, {}}, {}}; }

/// A model on which brute force takes `extraction` and `update` times as long as the octree and the tracker.
inline ModelResult result_of(std::uint32_t faces, double extraction, double update) {
    ModelResult result;
    result.faces = faces;
    result.extraction.methods = {times_of(10.0), times_of(10.0 * extraction)};
    result.update.methods = {times_of(3.0), times_of(3.0 * update)};
    result.octree_bytes = 100 * std::uint64_t{faces};
    result.tracker_bytes = 50 * std::uint64_t{faces};
    result.stream = {1, 5};
    result.worst_update = WorstUpdate{1.0, 1.2, 3.0};
    return result;
}

}  // namespace rimline::tools
