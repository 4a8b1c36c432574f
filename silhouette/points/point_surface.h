#pragma once

// The surface that a set of points was sampled from, point by point: each point's umbrella (umbrella.h,
// thesis 5.2). Umbrellas of neighbors need not agree, and together they are not a mesh.
//
// An umbrella with gaps is partial. A point may have several partial umbrellas, one for each smooth patch
// that meets at it. From its umbrellas every point has its label: interior, border, feature, or undecided
// with a reason.
//
// The result depends on the set of points alone: not on the number of threads, and not on the order of the
// points (each point keeps its own umbrellas). Ties are broken by coordinates. Scaling by a power of two
// scales scale() and changes nothing else.

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
    /// `positions` must be finite. All but one of equal positions are undecided (PointCloud merges them). O(n
    /// log n) on all threads. Throws Error{too_large} from 2^31 points or 2^32 ring points on,
    /// Error{cancelled}.
    explicit PointSurface(std::span<const glm::dvec3> positions,
                          const PointSurfaceOptions& options = {}, const LongCall& call = {});

    /// The input.
    std::span<const glm::dvec3> positions() const noexcept { return positions_; }
    std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(positions_.size()); }

    PointLabel label(PointId point) const noexcept { return labels_[index(point)]; }
    UndecidedReason reason(PointId point) const noexcept { return reasons_[index(point)]; }
    /// How many points have the label.
    std::uint32_t count(PointLabel label) const noexcept {
        return counts_[static_cast<std::size_t>(label)];
    }

    /// How many boundary edges the passes over boundaries (thesis 5.2.5) have left inconsistent: a gap of one
    /// point ends at another point, and no gap of the other ends at the first.
    std::uint32_t inconsistent_edge_count() const noexcept { return inconsistent_edges_; }

    /// Umbrellas are numbered point by point: those of a point are [first, last). The point's normal is that
    /// of the first. Undecided points have none, except with unconfirmed_border. Partial umbrellas of one
    /// point that end at the same ring points meet there, and have the same sense about the point.
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

    /// The normal of the point's first umbrella, of length 1; zero where it has none. Unoriented.
    glm::dvec3 normal(PointId point) const noexcept {
        const UmbrellaRange range = umbrellas_of(point);
        return range.size() == 0 ? glm::dvec3(0.0) : normals_[range.first];
    }
    /// How far apart the surface's points lie: the lower median of the circumradii of the triangles of the
    /// point's star; of thin triangles the longest edge counts. In the units of the positions; zero without
    /// umbrella.
    double scale(PointId point) const noexcept { return scales_[index(point)]; }

private:
    void count_inconsistent_edges(const LongCall& call);

    std::vector<glm::dvec3> positions_;
    std::vector<PointLabel> labels_;
    std::vector<UndecidedReason> reasons_;
    std::vector<double> scales_;
    std::vector<std::uint32_t> umbrella_begin_;
    // By umbrella; ring_begin_ has one more.
    std::vector<std::uint32_t> ring_begin_;
    std::vector<std::uint64_t> gaps_;
    std::vector<glm::dvec3> normals_;
    std::vector<PointId> rings_;
    std::array<std::uint32_t, 4> counts_{};
    std::uint32_t inconsistent_edges_ = 0;
};

}  // namespace rimline
