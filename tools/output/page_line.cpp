#include "tools/output/page_line.h"

#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rimline::tools {

glm::dvec2 rounded_to_um(const glm::dvec2& mm) { return glm::round(mm * 1e3) / 1e3; }

double PageLine::length_mm() const {
    double length = is_closed ? glm::distance(points.back(), points.front()) : 0.0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        length += glm::distance(points[i], points[i + 1]);
    return length;
}

}  // namespace rimline::tools
