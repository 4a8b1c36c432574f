#pragma once

// The open points of a set: those whose stars have gaps, and which points their gaps name.
//
// A gap is a sector whose excess (Stars::excess) is above gap_ratio. A point with a gap is open, any other is
// closed. A gap ends at two points of the ring, and its point names these two. Two open points that name
// each other are linked.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "silhouette/points/each_point.h"
#include "silhouette/points/open_point.h"
#include "silhouette/points/star_choice.h"

namespace rimline {

/// What borders are found from. Refers to all of it.
struct BorderInput {
    std::span<const glm::dvec3> points;
    const NeighborLists& neighbors;
    const Stars& stars;
    double gap_ratio;  ///< PointSurfaceOptions::gap_ratio.
};

/// Open points have places, from 0 in the order in which they opened. A point that opens stays open.
class BorderGaps {
public:
    /// Finds the gaps of all points, on all threads. What `input` refers to must outlive it.
    BorderGaps(const BorderInput& input, const CallPart& part);

    const BorderInput& input() const noexcept { return input_; }

    std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(open_.size()); }
    OpenPoint& at(std::uint32_t place) noexcept { return open_[place]; }
    const OpenPoint& at(std::uint32_t place) const noexcept { return open_[place]; }

    bool is_open(std::uint32_t point) const noexcept { return places_[point] != k_closed; }
    /// Of an open point.
    std::uint32_t place_of(std::uint32_t point) const noexcept { return places_[point]; }

    /// The points named by the open point at `place`: two for each of its first four gaps.
    std::span<const std::uint32_t> named_by(std::uint32_t place) const noexcept {
        return std::span(ends_[place].points).first(ends_[place].count);
    }
    /// Whether `point` is open and names `other`.
    bool names(std::uint32_t point, std::uint32_t other) const noexcept;
    /// The other end of the gap of the open `point` that ends at `end`.
    std::optional<std::uint32_t> other_end(std::uint32_t point, std::uint32_t end) const noexcept;

    /// Gives `point` the fan, which has gaps, and opens the point where it was closed.
    void open(std::uint32_t point, const Fan& fan);

    /// All open points, ascending. Leaves the object empty.
    std::vector<OpenPoint> take();

private:
    static constexpr std::uint32_t k_closed = 0xffffffffu;
    // Of one point, those whose ends are kept: ends take no memory of their own.
    static constexpr std::size_t k_max_gap_count = 4;
    struct Ends {
        std::array<std::uint32_t, 2 * k_max_gap_count> points;
        std::uint32_t count = 0;
    };

    BorderInput input_;
    std::vector<std::uint32_t> places_;  // Of each point; or k_closed.
    std::vector<OpenPoint> open_;
    std::vector<Ends> ends_;  // Of each open point.
};

}  // namespace rimline
