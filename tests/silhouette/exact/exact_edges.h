#pragma once

// The edges of a mesh source by the positions of their ends: found without the library's mesh.

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tests/silhouette/exact/exact_numbers.h"

namespace rimline::tests {

using Position = std::array<float, 3>;
using EdgePositions = std::pair<Position, Position>;  ///< The lesser first.

inline Position position(const glm::vec3& p) { return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; }

inline FloatCorners corners_of(const MeshSource& source, std::size_t face) {
    const auto& [a, b, c] = source.triangles[face];
    return {source.positions[a], source.positions[b], source.positions[c]};
}

class ExactEdges {
public:
    struct Use {
        std::uint32_t face;
        bool is_forward;  ///< The face runs from the lesser end to the other.
    };

    explicit ExactEdges(const MeshSource& source) {
        for (std::uint32_t f = 0; f < source.triangles.size(); ++f) {
            const FloatCorners corners = corners_of(source, f);
            const std::array<Position, 3> p{position(corners[0]), position(corners[1]),
                                            position(corners[2])};
            if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
            for (std::size_t c = 0; c < 3; ++c) {
                const Position &from = p[c], &to = p[(c + 1) % 3];
                uses_[std::minmax(from, to)].push_back({f, from < to});
            }
        }
    }

    /// By the rules of EdgeClass.
    std::set<EdgePositions> silhouette(const std::vector<bool>& bits) const {
        std::set<EdgePositions> edges;
        for (const auto& [edge, uses] : uses_) {
            if (uses.size() == 1) continue;
            const bool first = bits[uses[0].face], second = bits[uses[1].face];
            const bool is_on =
                uses.size() > 2
                    ? std::ranges::any_of(uses, [&](const Use& u) { return bits[u.face] != first; })
                : uses[0].is_forward != uses[1].is_forward ? first != second
                                                           : first == second;
            if (is_on) edges.insert(edge);
        }
        return edges;
    }

    const std::map<EdgePositions, std::vector<Use>>& uses() const { return uses_; }

private:
    std::map<EdgePositions, std::vector<Use>> uses_;
};

inline std::set<EdgePositions> positions_of(const Mesh& mesh, std::span<const EdgeId> edges) {
    std::set<EdgePositions> all;
    for (const EdgeId edge : edges) {
        const auto& [v, w] = mesh.edge(edge).vertices;
        all.insert(std::minmax(position(mesh.positions()[index(v)]),
                               position(mesh.positions()[index(w)])));
    }
    return all;
}

}  // namespace rimline::tests
