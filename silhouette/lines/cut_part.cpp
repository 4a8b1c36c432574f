#include "silhouette/lines/cut_part.h"

#include <algorithm>
#include <glm/common.hpp>

namespace rimline {

double cut_part(double begin, double end, bool is_orthographic, StrokePart& part,
                LineDrawing& drawing) {
    const std::uint32_t first = part.first_point, last = part.last_point - 1;
    // Copies, as more points are added.
    const auto add = [&](LinePoint point, LineSource source) {
        drawing.points.push_back(point);
        drawing.sources.push_back(source);
    };
    const auto add_at = [&](double at) {
        const auto i = std::min(first + static_cast<std::uint32_t>(at), last - 1);
        const double share = at - double(i - first);
        const LinePoint a = drawing.points[i], b = drawing.points[i + 1];
        // In space: in perspective, 1 / depth is linear in the picture.
        const double in_space =
            is_orthographic ? share : share * a.depth / (share * a.depth + (1.0 - share) * b.depth);
        // The segment lies on the edge of the point that it leads to, and begins on it or at its other end.
        LineSource source = drawing.sources[i + 1];
        const float from = drawing.sources[i].edge == source.edge ? drawing.sources[i].share
                           : source.share >= 0.5f                 ? 0.0f
                                                                  : 1.0f;
        source.share = glm::mix(from, source.share, static_cast<float>(in_space));
        add({glm::mix(a.position, b.position, share), glm::mix(a.depth, b.depth, in_space),
             glm::mix(a.arc, b.arc, share)},
            source);
    };
    part.first_point = static_cast<std::uint32_t>(drawing.points.size());
    add_at(begin);
    for (auto i = first + static_cast<std::uint32_t>(begin) + 1; double(i - first) < end; ++i)
        add(drawing.points[i], drawing.sources[i]);
    add_at(end);
    part.last_point = static_cast<std::uint32_t>(drawing.points.size());
    return drawing.points.back().arc - drawing.points[part.first_point].arc;
}

}  // namespace rimline
