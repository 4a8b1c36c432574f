#include "tools/output/drawing_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <map>
#include <string>

#include "silhouette/error.h"
#include "tools/command.h"

namespace rimline::tools {

namespace {

constexpr double k_min_view_gap_mm = 5.0;

// Columns, or rows: the greatest extent of each in picture coordinates, and where it begins in mm.
struct Tracks {
    struct Track {
        double extent = 0.0;
        double begin_mm = 0.0;
    };
    std::map<int, Track> tracks;

    void include(int track, double extent) {
        tracks[track].extent = std::max(tracks[track].extent, extent);
    }
    double extent() const {
        double sum = 0.0;
        for (const auto& [number, track] : tracks) sum += track.extent;
        return sum;
    }
    double gaps_mm(double gap_mm) const { return gap_mm * static_cast<double>(tracks.size() - 1); }
    void place(double begin_mm, double mm_per_unit, double gap_mm) {
        for (auto& [number, track] : tracks) {
            track.begin_mm = begin_mm;
            begin_mm += track.extent * mm_per_unit + gap_mm;
        }
    }
    double middle_mm(int number, double mm_per_unit) const {
        const Track& track = tracks.at(number);
        return track.begin_mm + 0.5 * mm_per_unit * track.extent;
    }
};

std::string in_mm(const glm::dvec2& size) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.5g x %.5g mm", size.x, size.y);
    return text.data();
}

}  // namespace

DrawingPage place_views(const LinePage& paper, std::span<const ViewCell> cells) {
    Tracks columns, rows;
    for (const ViewCell& cell : cells) {
        columns.include(cell.column, cell.high.x - cell.low.x);
        rows.include(cell.row, cell.high.y - cell.low.y);
    }
    const double gap = std::max(paper.margin_mm, k_min_view_gap_mm);
    const glm::dvec2 extent(columns.extent(), rows.extent());
    const glm::dvec2 gaps(columns.gaps_mm(gap), rows.gaps_mm(gap));
    if (!(std::max(extent.x, extent.y) > 0.0))
        throw Error(ErrorCode::bad_input, "from here the model is a point: choose another --eye");

    const glm::dvec2 space =
        (paper.size_mm ? paper.space_mm() : glm::dvec2(k_fitted_page_mm - 2.0 * paper.margin_mm)) -
        gaps;
    double scale = 0.0;
    if (paper.mm_per_unit) {
        scale = *paper.mm_per_unit;
        const glm::dvec2 size = scale * extent + gaps;
        // A drawing as large as the space fits, whatever the rounding of its size.
        const glm::dvec2 allowed = (space + gaps) * (1.0 + 1e-6);
        if (paper.size_mm && (size.x > allowed.x || size.y > allowed.y))
            throw UsageError("--scale: the drawing has " + in_mm(size) +
                             ", the page has space for " + in_mm(space + gaps) +
                             "; take a smaller scale, a larger --page or --page fit");
    } else {
        if (!(space.x > 0.0 && space.y > 0.0))
            throw UsageError("--page: the margins leave no space for the views");
        // An extent of 0 does not limit the scale.
        scale = std::min(space.x / extent.x, space.y / extent.y);
    }
    const glm::dvec2 size = scale * extent + gaps;
    DrawingPage page{paper.size_mm.value_or(glm::ceil((size + 2.0 * paper.margin_mm) * 1e3) * 1e-3),
                     {}};
    if (page.size_mm.x > k_max_page_mm || page.size_mm.y > k_max_page_mm)
        throw UsageError("--scale: the drawing has " + in_mm(size) +
                         ", too large for a page; take a smaller scale");
    const glm::dvec2 begin = 0.5 * (page.size_mm - size);
    columns.place(begin.x, scale, gap);
    rows.place(begin.y, scale, gap);
    for (const ViewCell& cell : cells) {
        const glm::dvec2 middle = 0.5 * (cell.low + cell.high);
        page.views.push_back({{columns.middle_mm(cell.column, scale) - scale * middle.x,
                               rows.middle_mm(cell.row, scale) + scale * middle.y},
                              scale});
    }
    return page;
}

}  // namespace rimline::tools
