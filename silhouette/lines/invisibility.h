#pragma once

// The invisibility of every line of a view, from the differences along lines.
//
// The invisibility of a line at an end is base(vertex) + local(end), where base counts faces before the vertex
// that are not its own. The events of a line give the difference of base between its vertices. So base is a
// potential: the lines give it for all vertices of a set of connected lines, up to one number for the set. One ray
// gives that number, and every cycle of lines is a check of all signs along it. Where a check fails, each piece of the
// lines of the set is decided by a ray of its own.

#include <cstdint>
#include <stop_token>
#include <vector>

#include "silhouette/lines/face_count.h"
#include "silhouette/lines/line_frame.h"

namespace rimline {

class Invisibility {
public:
    /// Sets first_counts of the frame; events of lines that rays decide are replaced. Throws Error{cancelled}.
    void spread(LineFrame& frame, const std::stop_token& stop = {});

private:
    void spread_edges(LineFrame& frame);
    void spread_intersections(LineFrame& frame, const std::stop_token& stop);
    bool spread_from(std::uint32_t node, std::int32_t base, LineFrame& frame);
    bool check(bool holds, LineFrame& frame);
    void fail_component(const LineFrame& frame);
    void decide_by_rays(LineFrame& frame, const std::stop_token& stop);
    void decide_by_ray_a_piece(std::uint32_t line, LineFrame& frame);

    std::vector<std::int32_t> steps_;  // Of base, along each line.
    std::vector<std::int32_t> bases_;  // By node.
    std::vector<std::uint32_t> queue_;
    VertexRays rays_;
    std::vector<std::uint32_t> first_vertices_;  // Of each set of connected edges.
    std::vector<std::uint32_t> set_of_;          // By node.
    std::vector<std::uint8_t> has_failed_;       // By line.
    std::vector<std::uint8_t> is_used_;          // By line: it gave a base, or checked one.
};

}  // namespace rimline
