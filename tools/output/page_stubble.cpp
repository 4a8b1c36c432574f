#include "tools/output/page_stubble.h"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <iterator>
#include <limits>
#include <span>

#include "silhouette/lines/picture_grid.h"

namespace rimline::tools {

namespace {

class PageStubble {
public:
    PageStubble(std::span<const PageLine> lines, double reach) : lines_(lines), reach_(reach) {
        glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
        for (std::uint32_t number = 0; number < lines.size(); ++number) {
            const std::vector<glm::dvec2>& points = lines[number].points;
            for (std::size_t i = 0; i + (lines[number].is_closed ? 0 : 1) < points.size(); ++i) {
                segments_.push_back({points[i], points[(i + 1) % points.size()], number});
                low = glm::min(low, points[i]);
                high = glm::max(high, points[i]);
            }
            low = glm::min(low, points.back());
            high = glm::max(high, points.back());
        }
        const glm::dvec2 size = high - low;
        grid_.reset(low, high,
                    std::max(2.0 * reach, (size.x + size.y) / (2.0 * double(segments_.size()))),
                    reach);
        for (std::uint32_t i = 0; i < segments_.size(); ++i)
            grid_.add(i, segments_[i].from, segments_[i].to);
        grid_.finish();
    }

    // 0 for each line that is stubble.
    std::vector<std::uint8_t> find(double stubble) {
        is_there_.assign(lines_.size(), 1);
        std::vector<std::uint32_t> order;  // The shortest first: what ends at them is stubble then.
        for (std::uint32_t i = 0; i < lines_.size(); ++i)
            if (lines_[i].is_hidden && lines_[i].length_mm() < 2.0 * stubble) order.push_back(i);
        std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return lines_[i].length_mm(); });
        for (bool goes_on = true; goes_on;) {
            goes_on = false;
            for (const std::uint32_t i : order) {
                if (is_there_[i] == 0 || lines_[i].length_mm() >= free_ends(i) * stubble) continue;
                is_there_[i] = 0;
                goes_on = true;
            }
        }
        return is_there_;
    }

private:
    struct Segment {
        glm::dvec2 from, to;
        std::uint32_t line;
    };

    int free_ends(std::uint32_t number) const {
        const PageLine& line = lines_[number];
        if (line.is_closed) return line.kind == LineKind::silhouette ? 1 : 0;
        return (is_held(line.points.front(), number) ? 0 : 1) +
               (is_held(line.points.back(), number) ? 0 : 1);
    }

    // Whether another line passes there.
    bool is_held(const glm::dvec2& place, std::uint32_t line) const {
        bool found = false;
        grid_.each_cell(place, place, [&](std::uint32_t cell) {
            for (const std::uint32_t i : grid_.segments_in(cell)) {
                const Segment& other = segments_[i];
                if (found || other.line == line || is_there_[other.line] == 0) continue;
                const glm::dvec2 way = other.to - other.from;
                const double share =
                    glm::dot(place - other.from, way) / std::max(glm::dot(way, way), 1e-300);
                const glm::dvec2 nearest =
                    glm::mix(other.from, other.to, std::clamp(share, 0.0, 1.0));
                found = glm::distance(nearest, place) <= reach_;
            }
        });
        return found;
    }

    std::span<const PageLine> lines_;
    double reach_;
    std::vector<Segment> segments_;
    std::vector<std::uint8_t> is_there_;
    PictureGrid grid_;
};

}  // namespace

void leave_out_hidden_stubble(std::vector<PageLine>& lines, std::size_t first, double stubble_mm,
                              double reach_mm) {
    const std::span<PageLine> all = std::span(lines).subspan(first);
    if (std::ranges::find(all, true, &PageLine::is_hidden) == all.end()) return;
    const std::vector<std::uint8_t> stays = PageStubble(all, reach_mm).find(stubble_mm);
    std::vector<PageLine> left;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (stays[i] != 0) left.push_back(std::move(all[i]));
    lines.erase(lines.begin() + std::ptrdiff_t(first), lines.end());
    std::ranges::move(left, std::back_inserter(lines));
}

}  // namespace rimline::tools
