#pragma once

// One interface for every way of finding silhouettes, so that a bench, a test or a command can ask for
// one by name and compare.
//
// A method is made for one mesh and may remember what it likes between calls. `extract` starts afresh;
// `update` may use what the last call left behind, and is only a fresh extraction for methods that have
// no way of their own to follow a moving point.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
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

struct SilhouetteMethodInfo {
    std::string_view name;  ///< As --method takes it.
    std::string_view summary;
    std::string_view source;        ///< Paper or thesis section.
    bool has_update = false;        ///< update() is more than extract().
    std::uint32_t max_origins = 0;  ///< Of SilhouetteMethodOptions::origins, how many are heeded.
    bool has_seed = false;          ///< SilhouetteMethodOptions::seed matters.
    bool directions_only = false;   ///< Viewpoints are refused, with Error{bad_input}.
    bool exact = true;              ///< Always equal to brute force; else a subset.
};

struct SilhouetteMethodOptions {
    /// For methods in Hough or dual space, within k_max_coordinate; empty: the mesh's center. A method
    /// that knows one origin only takes the first.
    std::vector<glm::dvec3> origins;
    std::uint64_t seed = 1;  ///< For randomised ones.
    LongCall call;           ///< Of the octree's build; the others are not to be stopped.
};

/// All there are.
std::span<const SilhouetteMethodInfo> silhouette_methods() noexcept;
/// Null when no method has that name.
const SilhouetteMethodInfo* find_silhouette_method(std::string_view name) noexcept;

/// `mesh` must outlive the method. Null when no method has that name.
std::unique_ptr<SilhouetteMethod> make_silhouette_method(
    std::string_view name, const Mesh& mesh, const SilhouetteMethodOptions& options = {});

}  // namespace rimline
