#pragma once

// The surface that a set of points was sampled from, as far as each point sees it: its umbrella, a ring
// of neighbors that surround it on the surface, with a triangle between each two that follow each other
// (thesis 5.2). Umbrellas of neighbors need not agree; together they are no mesh.
//
// A sector of a ring without a triangle is a gap: the surface ends there, or turns so sharply that one
// umbrella cannot follow. A point may so have several partial umbrellas, one for each smooth patch that
// meets at it. From them every point has its label: interior, border, feature, or undecided and why.
//
// The result is a function of the set of points: the same for any number of threads and, each point
// keeping its own, for any order of the points; ties are broken by coordinates. Scaling by a power of
// two scales scale() and changes nothing else. Umbrellas are unoriented: which side is outside is not
// known.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/points/point_ids.h"
#include "silhouette/points/umbrella.h"

namespace rimline {

class PointSurface {
public:
    /// `positions` must be finite; equal ones are undecided but for one (merge them before). O(n log n),
    /// on all threads. Throws Error{too_large} from 2^31 points or 2^32 of all rings, Error{cancelled}.
    explicit PointSurface(std::span<const glm::dvec3> positions,
                          const PointSurfaceOptions& options = {}, const LongCall& call = {});

    /// As they were given.
    std::span<const glm::dvec3> positions() const noexcept { return positions_; }
    std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(positions_.size()); }

    PointLabel label(PointId point) const noexcept { return labels_[index(point)]; }
    UndecidedReason reason(PointId point) const noexcept { return reasons_[index(point)]; }
    /// How many points have the label.
    std::uint32_t count(PointLabel label) const noexcept {
        return counts_[static_cast<std::size_t>(label)];
    }

    /// How many boundary edges are not returned: a gap of one point's ends at another none of whose gaps
    /// ends at the first. What the passes over boundaries (thesis 5.2.5) have left inconsistent.
    std::uint32_t inconsistent_edge_count() const noexcept { return inconsistent_edges_; }

    /// Umbrellas are numbered point by point: those of a point are [first, last), the one that its normal
    /// comes from first. Undecided points have none, but for unconfirmed_border. Partial umbrellas of one
    /// point that end at the same ring points meet there, and turn the same way about the point.
    struct UmbrellaRange {
        std::uint32_t first, last;
        std::uint32_t size() const noexcept { return last - first; }
    };
    UmbrellaRange umbrellas_of(PointId point) const noexcept {
        return {umbrella_begin_[index(point)], umbrella_begin_[index(point) + 1]};
    }
    std::uint32_t umbrella_count() const noexcept {
        return static_cast<std::uint32_t>(gaps_.size());
    }
    Umbrella umbrella(UmbrellaId umbrella) const noexcept {
        const std::uint32_t u = index(umbrella);
        return {std::span(rings_).subspan(ring_begin_[u], ring_begin_[u + 1] - ring_begin_[u]),
                gaps_[u], normals_[u]};
    }

    /// Of length 1, of the point's first umbrella; zero where it has none. Unoriented.
    glm::dvec3 normal(PointId point) const noexcept {
        const UmbrellaRange range = umbrellas_of(point);
        return range.size() == 0 ? glm::dvec3(0.0) : normals_[range.first];
    }
    /// How far apart the surface's points lie: the median circumradius of the triangles of the point's star,
    /// of thin ones the longest edge. In the units of the positions; zero where it has no umbrella.
    double scale(PointId point) const noexcept { return scales_[index(point)]; }

private:
    void count_inconsistent_edges(const LongCall& call);

    std::vector<glm::dvec3> positions_;
    std::vector<PointLabel> labels_;
    std::vector<UndecidedReason> reasons_;
    std::vector<double> scales_;
    std::vector<std::uint32_t> umbrella_begin_;
    // Of each umbrella.
    std::vector<std::uint32_t> ring_begin_;
    std::vector<std::uint64_t> gaps_;
    std::vector<glm::dvec3> normals_;
    std::vector<PointId> rings_;
    std::array<std::uint32_t, 4> counts_{};
    std::uint32_t inconsistent_edges_ = 0;
};

}  // namespace rimline
