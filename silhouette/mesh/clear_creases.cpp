#include "silhouette/mesh/clear_creases.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <span>

#include "silhouette/error.h"
#include "silhouette/mesh/disjoint_sets.h"
#include "silhouette/mesh/edge_convexity.h"
#include "silhouette/mesh/straightest_pairs.h"

namespace rimline {

namespace {

constexpr double k_degree = std::numbers::pi / 180.0;
constexpr double k_strong_bend_rad = 30.0 * k_degree;
constexpr double k_min_strength = 0.15;  // Of the radius of the part.
constexpr double k_min_clear_share = 0.7;
// An edge of a face hardly bends where it bends by less than this, or than this share of the crease's bend.
constexpr float k_flat_bend_rad = 3.0f * static_cast<float>(k_degree);
constexpr float k_flat_share = 0.125f;
// Cosine of 135 degrees between the ways of two edges out of a vertex: one goes on into the other.
constexpr double k_max_cos_of_ways = -0.7071067811865476;
constexpr std::uint32_t k_between_checkpoints = 1u << 17;

// The radius of the part of a mesh that a vertex belongs to: of what edges connect, as Mesh::radius() of the whole.
class PartRadii {
public:
    PartRadii(const Mesh& mesh, const LongCall& call) : whole_(mesh.radius()) {
        if (mesh.component_count() <= 1) return;
        DisjointSets parts(mesh.vertex_count());
        for (std::uint32_t e = 0; e < mesh.edge_count(); ++e) {
            if (e % k_between_checkpoints == 0) call.checkpoint(0.0);
            const Edge& edge = mesh.edge(EdgeId{e});
            parts.join(index(edge.vertices[0]), index(edge.vertices[1]));
        }
        part_ = parts.take_numbers();
        const std::span<const glm::vec3> positions = mesh.positions();
        std::vector<Bounds> bounds;
        for (std::uint32_t v = 0; v < part_.size(); ++v) {
            const glm::vec3& p = positions[v];
            if (part_[v] == bounds.size()) bounds.push_back({p, p});  // The first of its part.
            Bounds& own = bounds[part_[v]];
            own = {glm::min(own.low, p), glm::max(own.high, p)};
        }
        radii_.assign(bounds.size(), 0.0);
        for (std::uint32_t v = 0; v < part_.size(); ++v) {
            const Bounds& own = bounds[part_[v]];
            const glm::dvec3 center = 0.5 * (glm::dvec3(own.low) + glm::dvec3(own.high));
            double& radius = radii_[part_[v]];
            radius = std::max(radius, glm::distance(glm::dvec3(positions[v]), center));
        }
    }
    double of(VertexId v) const { return part_.empty() ? whole_ : radii_[part_[index(v)]]; }

private:
    double whole_;
    std::vector<std::uint32_t> part_;  // Of each vertex. Empty: there is one part.
    std::vector<double> radii_;
};

// The chains of creases. End 2 * i + k is that of crease i at its edge's vertex k.
class CreaseChains {
public:
    CreaseChains(const Mesh& mesh, std::span<const Crease> creases, const LongCall& call)
        : mesh_(mesh),
          creases_(creases),
          call_(call),
          radii_(mesh, call),
          next_(2 * creases.size(), k_no_end) {
        link();
    }

    std::vector<Crease> standing_out() {
        std::vector<std::uint8_t> is_done(creases_.size()), stands_out(creases_.size());
        std::vector<std::uint32_t> chain;
        // Open chains from their ends, then closed ones.
        for (const bool is_closed : {false, true})
            for (std::uint32_t first = 0; first < next_.size(); ++first) {
                if (first % k_between_checkpoints == 0) call_.checkpoint(0.0);
                if (is_done[first / 2] != 0 || (!is_closed && next_[first] != k_no_end)) continue;
                chain.clear();
                for (std::uint32_t end = first;;) {
                    is_done[end / 2] = 1;
                    chain.push_back(end / 2);
                    end = next_[end ^ 1u];
                    if (end == k_no_end || is_done[end / 2] != 0) break;
                }
                if (!is_strong_and_clear(chain)) continue;
                for (const std::uint32_t i : chain) stands_out[i] = 1;
            }
        std::vector<Crease> kept;
        for (std::uint32_t i = 0; i < creases_.size(); ++i)
            if (stands_out[i] != 0) kept.push_back(creases_[i]);
        return kept;
    }

private:
    static constexpr std::uint32_t k_no_end = 0xffffffffu;

    const Edge& edge_of(std::uint32_t end) const { return mesh_.edge(creases_[end / 2].edge); }
    glm::dvec3 position(VertexId v) const { return glm::dvec3(mesh_.positions()[index(v)]); }
    glm::dvec3 way_of(std::uint32_t end) const {
        const auto& vertices = edge_of(end).vertices;
        return position(vertices[1 - end % 2]) - position(vertices[end % 2]);
    }

    std::uint32_t vertex_of(std::uint32_t end) const {
        return index(edge_of(end).vertices[end % 2]);
    }

    // All ends in the order of their vertices, those at one vertex in their own.
    std::vector<std::uint32_t> ends_by_vertex() const {
        std::vector<std::uint32_t> first(mesh_.vertex_count() + 1), ends(next_.size());
        for (std::uint32_t end = 0; end < next_.size(); ++end) ++first[vertex_of(end) + 1];
        call_.checkpoint(0.0);
        std::partial_sum(first.begin(), first.end(), first.begin());
        for (std::uint32_t end = 0; end < next_.size(); ++end) ends[first[vertex_of(end)]++] = end;
        call_.checkpoint(0.0);
        return ends;
    }

    // Links the ends at each vertex in pairs, the straightest first.
    void link() {
        const std::vector<std::uint32_t> ends = ends_by_vertex();
        StraightestPairs straightest;
        std::vector<glm::dvec3> ways;
        std::uint64_t last_work = 0;
        for (std::size_t i = 0; i < ends.size();) {
            if (const std::uint64_t work = i + straightest.pairs();
                work >= last_work + k_between_checkpoints)
                call_.checkpoint(0.0), last_work = work;
            std::size_t last = i;
            ways.clear();
            for (; last < ends.size() && vertex_of(ends[last]) == vertex_of(ends[i]); ++last)
                ways.push_back(glm::normalize(way_of(ends[last])));
            straightest.each(std::span<const glm::dvec3>(ways), k_max_cos_of_ways,
                             [&](std::size_t a, std::size_t b) {
                                 next_[ends[i + a]] = ends[i + b];
                                 next_[ends[i + b]] = ends[i + a];
                             });
            i = last;
        }
    }

    bool is_clear(const Crease& crease) const {
        return std::ranges::all_of(mesh_.faces_of(crease.edge), [&](FaceId face) {
            return goes_on_flat(face, crease) || bends_one_way(face);
        });
    }

    bool goes_on_flat(FaceId face, const Crease& crease) const {
        const double flat = std::max(k_flat_bend_rad, k_flat_share * crease.bend_rad);
        return std::ranges::any_of(mesh_.edges_of(face), [&](EdgeId other) {
            return other != crease.edge && bend_of(mesh_, other) < flat;
        });
    }

    // At all edges.
    bool bends_one_way(FaceId face) const {
        const auto edges = mesh_.edges_of(face);
        const EdgeConvexity first = edge_convexity(mesh_, edges[0]);
        return (first == EdgeConvexity::convex || first == EdgeConvexity::concave) &&
               edge_convexity(mesh_, edges[1]) == first && edge_convexity(mesh_, edges[2]) == first;
    }

    bool is_strong_and_clear(const std::vector<std::uint32_t>& chain) const {
        double length = 0.0, clear = 0.0, strength = 0.0;
        for (const std::uint32_t i : chain) {
            const double own = glm::length(way_of(2 * i));
            const double bend = double{creases_[i].bend_rad} / k_strong_bend_rad;
            length += own;
            strength += own * bend * bend;
            if (is_clear(creases_[i])) clear += own;
        }
        const double radius = radii_.of(edge_of(2 * chain.front()).vertices[0]);
        return strength >= k_min_strength * radius && clear >= k_min_clear_share * length;
    }

    const Mesh& mesh_;
    std::span<const Crease> creases_;
    const LongCall& call_;
    PartRadii radii_;
    std::vector<std::uint32_t> next_;  // Of each end: the end at which the chain goes on.
};

}  // namespace

std::vector<Crease> clear_creases(const Mesh& mesh, std::span<const Crease> creases,
                                  const std::stop_token& stop) {
    const LongCall call{stop, {}};
    return CreaseChains(mesh, creases, call).standing_out();
}

std::vector<std::uint8_t> clear_crease_flags(const Mesh& mesh, float min_bend_rad,
                                             const std::stop_token& stop) {
    std::vector<std::uint8_t> flags(mesh.edge_count(), 0);
    const std::vector<Crease> creases = find_creases(mesh, min_bend_rad, stop);
    for (const Crease& crease : clear_creases(mesh, creases, stop)) flags[index(crease.edge)] = 1;
    return flags;
}

}  // namespace rimline
