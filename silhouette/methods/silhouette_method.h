#pragma once

// The interface of all methods that find silhouettes. A bench, a test or a command uses any of them in the
// same way. method_info.h lists the methods, method_registry.h makes one by its name.
//
// A method is made for one mesh and may keep state between calls. `extract` starts afresh. `update` may
// use the state that the previous call left; a method that cannot follow a moving point extracts afresh.

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

    /// Replaces `edges` by the silhouette from `point`, in no particular order, without borders. Adds its
    /// work to `counters`.
    virtual void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                         TraversalCounters& counters) = 0;
    /// The same result as `extract`. May start from the state that the previous call left.
    virtual void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                        TraversalCounters& counters) {
        extract(point, edges, counters);
    }
    /// Counters of the last call that other methods do not have.
    virtual std::vector<NamedCount> own_counts() const { return {}; }
};

}  // namespace rimline
