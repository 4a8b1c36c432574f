#pragma once

// Which lines go on into each other where they meet.
//
// At a node with two lines of one kind one goes on into the other. Where more meet:
//
//   silhouettes   fronts and backs around the vertex follow each other in turn. A view a little further on shows either
//                 the fronts connected or the backs, and silhouettes that do not cross. They are connected here as the
//                 smooth surface says: where its front is seen at the vertex, the two lines around each back go on into
//                 each other, else the two around each front. So chains are longer, and last over frames
//   other lines   those that bend least go on into each other; where more than a thousand meet, none

#include <glm/vec2.hpp>
#include <stop_token>
#include <vector>

#include "silhouette/lines/line_frame.h"
#include "silhouette/lines/smooth_normals.h"
#include "silhouette/mesh/straightest_pairs.h"

namespace rimline {

constexpr LineEnd k_no_end = 0xffffffffu;

class LineLinks {
public:
    /// Links the drawn lines. O(lines), and as StraightestPairs at nodes of many lines. `normals` are those of the
    /// frame. Throws Error{cancelled}.
    void find(const LineFrame& frame, SmoothNormals& normals, const std::stop_token& stop = {});
    /// The end at which a chain goes on that leaves its line at this one; k_no_end where it ends.
    LineEnd next(LineEnd end) const noexcept { return next_[end]; }

private:
    void link(LineEnd a, LineEnd b) noexcept;
    bool link_around_sectors(const LineFrame& frame, std::uint32_t vertex, SmoothNormals& normals);
    void link_best(const LineFrame& frame);

    std::vector<LineEnd> next_;
    std::vector<LineEnd> ends_;     // Of one node and kind.
    std::vector<glm::dvec2> ways_;  // Of ends_: directions in the picture, away from the node.
    StraightestPairs straightest_;
    std::vector<LineEnd> ring_;  // By link of the vertex's star, the end along its first side.
};

}  // namespace rimline
