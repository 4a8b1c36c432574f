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
    std::uint32_t node_of(std::vector<std::uint32_t>& stamps, std::vector<std::uint32_t>& numbers,
                          std::uint32_t place, std::uint32_t next);

    std::uint32_t frame_number_ = 0;
    // By vertex of the mesh, and by node of its curves: the frame in which it became a node, and the node.
    std::vector<std::uint32_t> vertex_stamps_, vertex_nodes_;
    std::vector<std::uint32_t> curve_stamps_, curve_nodes_;
    std::vector<std::uint32_t> next_;
};

}  // namespace rimline
