#pragma once

// One interface for all methods that find silhouettes, so that a bench, a test or a command can compare them.
// method_registry.h makes them by name.
//
// A method is made for one mesh and may remember what it likes between calls. `extract` starts afresh;
// `update` may use what the last call left behind, and is only a fresh extraction for methods that have
// no way of their own to follow a moving point.

#include <cstdint>
#include <string_view>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// A counter that only one method has.
struct NamedCount {
    std::string_view name;
    std::uint64_t count;
};

/// One thread at a time.
class SilhouetteMethod {
public:
    SilhouetteMethod() = default;
    SilhouetteMethod(const SilhouetteMethod&) = delete;
    SilhouetteMethod& operator=(const SilhouetteMethod&) = delete;
    virtual ~SilhouetteMethod() = default;

    /// Replaces `edges` by the silhouette from `point`, in no particular order. Borders are not among
    /// them. `counters` is added to.
    virtual void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                         TraversalCounters& counters) = 0;
    /// The same, by way of what the last call left.
    virtual void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                        TraversalCounters& counters) {
        extract(point, edges, counters);
    }
    /// What the last call counted beside the counters that all methods share.
    virtual std::vector<NamedCount> own_counts() const { return {}; }
};

}  // namespace rimline
