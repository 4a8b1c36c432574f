#include "silhouette/points/border_gaps.h"

#include <algorithm>

namespace rimline {

BorderGaps::BorderGaps(const BorderInput& input, const CallPart& part) : input_(input) {
    const Stars& stars = input.stars;
    const auto count = static_cast<std::uint32_t>(input.points.size());
    std::vector<std::uint64_t> gaps(count, 0);
    each_point(count, part, [&](std::uint32_t first, std::uint32_t last) {
        Neighborhood around;
        for (std::uint32_t i = first; i < last; ++i) {
            if (stars.reasons[i] != UndecidedReason::none || stars.is_clean[i]) continue;
            const Fan& star = stars.fans[i];
            around.assign(input.points, i, input.neighbors.of(i));
            for (std::size_t j = 0; j < star.size; ++j)
                if (stars.excess(around, i, star, j) > input.gap_ratio)
                    gaps[i] |= std::uint64_t{1} << j;
        }
    });
    places_.assign(count, k_closed);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (gaps[i] == 0) continue;
        Fan fan = stars.fans[i];
        fan.gaps = gaps[i];
        merge_gaps(fan);
        if (fan.is_umbrella()) open(i, fan);
    }
}

bool BorderGaps::names(std::uint32_t point, std::uint32_t other) const noexcept {
    if (!is_open(point)) return false;
    const auto named = named_by(place_of(point));
    return std::find(named.begin(), named.end(), other) != named.end();
}

std::optional<std::uint32_t> BorderGaps::other_end(std::uint32_t point,
                                                   std::uint32_t end) const noexcept {
    const auto named = named_by(place_of(point));
    for (std::size_t e = 0; e < named.size(); ++e)
        if (named[e] == end) return named[e ^ 1u];
    return std::nullopt;
}

void BorderGaps::open(std::uint32_t point, const Fan& fan) {
    if (!is_open(point)) {
        places_[point] = size();
        open_.push_back({point, fan, {}});
        ends_.emplace_back();
    }
    open_[places_[point]].fan = fan;
    Ends& ends = ends_[places_[point]];
    ends.count = 0;
    const auto list = input_.neighbors.of(point);
    for (std::size_t j = 0; j < fan.size && ends.count < ends.points.size(); ++j)
        if (fan.is_gap(j)) {
            ends.points[ends.count++] = list[fan.ring[j]];
            ends.points[ends.count++] = list[fan.ring[fan.next(j)]];
        }
}

std::vector<OpenPoint> BorderGaps::take() {
    std::sort(open_.begin(), open_.end(),
              [](const OpenPoint& a, const OpenPoint& b) { return a.point < b.point; });
    places_.clear();
    ends_.clear();
    return std::move(open_);
}

}  // namespace rimline
