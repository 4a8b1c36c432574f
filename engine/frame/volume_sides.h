#pragma once

// The sides of a shadow volume, in any order.

#include <algorithm>
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

/// Some sides that are listed, and those of edges of a mesh, which lie anywhere in memory. The edges' places are read
/// while what `for_each` does with the sides before them is computed, so both take the time of one.
class VolumeSides {
public:
    explicit VolumeSides(std::span<const VolumeSide> listed) : listed_(listed) {}
    /// Also sides of the edges below `edge_end` among `edges`, `times` each. `positions` are those of the mesh.
    VolumeSides(std::span<const VolumeSide> listed, std::span<const EdgeId> edges,
                std::uint32_t edge_end, const Mesh& mesh, std::span<const glm::vec3> positions,
                std::int32_t times)
        : listed_(listed),
          edges_(edges),
          edge_end_(edge_end),
          ends_(mesh.edges().data()),
          positions_(positions.data()),
          times_(times) {}

    /// At least the number of sides.
    std::size_t size() const noexcept { return listed_.size() + edges_.size(); }

    template <typename Visit>
    void for_each(const Visit& visit) const {
        for (const VolumeSide& side : listed_) visit(side);
        constexpr std::size_t k_ahead = 16;
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            if (i + 2 * k_ahead < edges_.size())
                __builtin_prefetch(&ends_[index(edges_[i + 2 * k_ahead])]);
            if (i + k_ahead < edges_.size())
                for (const VertexId vertex : ends_[index(edges_[i + k_ahead])].vertices)
                    __builtin_prefetch(&positions_[index(vertex)]);
            if (index(edges_[i]) >= edge_end_) continue;
            const auto& [a, b] = ends_[index(edges_[i])].vertices;
            visit(VolumeSide{positions_[index(a)], positions_[index(b)], times_});
        }
    }

private:
    std::span<const VolumeSide> listed_;
    std::span<const EdgeId> edges_;
    std::uint32_t edge_end_ = 0;
    const Edge* ends_ = nullptr;
    const glm::vec3* positions_ = nullptr;
    std::int32_t times_ = 0;
};

}  // namespace rimline
