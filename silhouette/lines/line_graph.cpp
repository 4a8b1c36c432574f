#include "silhouette/lines/line_graph.h"

namespace rimline {

namespace {

// So far ahead the vertices of edges are asked for, which lie anywhere in memory.
constexpr std::uint32_t k_edges_ahead = 16;

}  // namespace

// `next` is the number of a new node.
std::uint32_t LineGraph::node_at(Place& place, std::uint32_t next) const {
    if (place.stamp != frame_number_) place = {frame_number_, next};
    return place.node;
}

void LineGraph::link(LineFrame& frame) {
    ++frame_number_;
    const LineGeometry& surface = *frame.surface;
    vertices_.resize(surface.mesh().vertex_count());
    curves_.resize(surface.curves().node_count());
    frame.nodes.resize(frame.lines.size());
    frame.node_vertices.clear();
    frame.node_curves.clear();
    for (std::uint32_t i = 0; i < frame.edge_lines; ++i) {
        if (i + k_edges_ahead < frame.edge_lines)
            for (const std::uint32_t vertex : frame.lines[i + k_edges_ahead].vertices)
                __builtin_prefetch(&vertices_[vertex]);
        for (std::size_t k = 0; k < 2; ++k) {
            const std::uint32_t vertex = frame.lines[i].vertices[k];
            const auto next = static_cast<std::uint32_t>(frame.node_vertices.size());
            const std::uint32_t node = node_at(vertices_[vertex], next);
            if (node == next) frame.node_vertices.push_back(vertex);
            frame.nodes[i][k] = node;
        }
    }
    auto count = static_cast<std::uint32_t>(frame.node_vertices.size());
    for (std::size_t i = frame.edge_lines; i < frame.lines.size(); ++i)
        for (std::size_t k = 0; k < 2; ++k) {
            const std::uint32_t node = surface.curves().segments()[frame.lines[i].source].nodes[k];
            frame.nodes[i][k] = node_at(curves_[node], count);
            if (frame.nodes[i][k] == count) ++count, frame.node_curves.push_back(node);
        }

    frame.end_begin.assign(count + 1, 0);
    for (std::size_t i = 0; i < frame.lines.size(); ++i)
        for (std::size_t k = 0; k < 2; ++k)
            if (!frame.lines[i].is_cut[k]) ++frame.end_begin[frame.nodes[i][k] + 1];
    for (std::uint32_t n = 0; n < count; ++n) frame.end_begin[n + 1] += frame.end_begin[n];
    frame.ends.resize(frame.end_begin.back());
    next_.assign(frame.end_begin.begin(), frame.end_begin.end() - 1);
    for (std::uint32_t i = 0; i < frame.lines.size(); ++i)
        for (std::uint32_t k = 0; k < 2; ++k)
            if (!frame.lines[i].is_cut[k]) frame.ends[next_[frame.nodes[i][k]]++] = 2 * i + k;
}

}  // namespace rimline
