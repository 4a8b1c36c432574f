#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "tools/output/page_line.h"

namespace rimline::tests {

/// A line of points alone.
inline tools::PageLine page_line(bool is_hidden, const std::vector<glm::dvec2>& points,
                                 bool is_closed = false, LineKind kind = LineKind::crease) {
    return {.kind = kind,
            .is_hidden = is_hidden,
            .is_closed = is_closed,
            .points = points,
            .curves = {},
            .chains = {},
            .edges = {}};
}

}  // namespace rimline::tests
