#pragma once

// Which lines of a view share a node.

#include <cstdint>
#include <vector>

#include "silhouette/lines/line_frame.h"

namespace rimline {

class LineGraph {
public:
    /// Sets nodes, node_vertices, node_curves, end_begin and ends of the frame. O(lines).
    void link(LineFrame& frame);

private:
    // The frame in which a vertex became a node, and the node.
    struct Place {
        std::uint32_t stamp = 0, node = 0;
    };
    std::uint32_t node_at(Place& place, std::uint32_t next) const;

    std::uint32_t frame_number_ = 0;
    std::vector<Place> vertices_, curves_;  // By vertex of the mesh, and by node of its curves.
    std::vector<std::uint32_t> next_;
};

}  // namespace rimline
