#pragma once

// The sides of a shadow volume, in any order.

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "silhouette/mesh/mesh.h"

namespace rimline {

/// Sides of a volume along one edge.
struct VolumeSide {
    glm::vec3 a, b;      ///< The edge's ends.
    std::int32_t count;  ///< How many sides are drawn there.
};

/// The ends of an edge, beside each other: those of a mesh's edges lie anywhere in memory.
struct EdgePlaces {
    EdgeId edge = k_no_edge;
    glm::vec3 a{0.0f}, b{0.0f};
};

/// The sides of a silhouette and of other edges.
class VolumeSides {
public:
    explicit VolumeSides(std::span<const VolumeSide> listed) : listed_(listed) {}
    /// Also sides of the edges below `edge_end` among `edges`, `times` each.
    VolumeSides(std::span<const VolumeSide> listed, std::span<const EdgePlaces> edges,
                std::uint32_t edge_end, std::int32_t times)
        : listed_(listed), edges_(edges), edge_end_(edge_end), times_(times) {}

    /// At least the number of sides.
    std::size_t size() const noexcept { return listed_.size() + edges_.size(); }

    template <typename Visit>
    void for_each(const Visit& visit) const {
        for (const VolumeSide& side : listed_) visit(side);
        for (const EdgePlaces& places : edges_)
            if (index(places.edge) < edge_end_) visit(VolumeSide{places.a, places.b, times_});
    }

private:
    std::span<const VolumeSide> listed_;
    std::span<const EdgePlaces> edges_;
    std::uint32_t edge_end_ = 0;
    std::int32_t times_ = 0;
};

}  // namespace rimline
