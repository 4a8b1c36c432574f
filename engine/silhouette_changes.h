#pragma once

// How silhouettes changed from one frame to the next, as numbers for reports.

#include <cstdint>

#include "silhouette/hough/change_set.h"

namespace rimline {

/// Changes since the previous frame. Flips and edges added or removed are 0 in a silhouette's first frame.
struct SilhouetteChanges {
    std::uint64_t edges = 0;     ///< Edges on the silhouettes now, without borders.
    std::uint64_t flips = 0;     ///< Faces that turned.
    std::uint64_t added = 0;     ///< Edges that joined.
    std::uint64_t removed = 0;   ///< Edges that left.
    TraversalCounters counters;  ///< Work on the CPU. Zero for silhouettes found on the GPU.
    /// CPU time of the frame for these silhouettes. Small where the service was ahead.
    double update_us = 0.0;

    SilhouetteChanges& operator+=(const SilhouetteChanges& other) noexcept {
        edges += other.edges;
        flips += other.flips;
        added += other.added;
        removed += other.removed;
        counters += other.counters;
        update_us += other.update_us;
        return *this;
    }
};

}  // namespace rimline
