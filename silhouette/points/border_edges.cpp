#include "silhouette/points/border_edges.h"

#include <algorithm>

namespace rimline {

namespace {

std::vector<PointEdge> edges_at_gaps(const PointSurface& surface, PointLabel label) {
    std::vector<PointEdge> directed;  // From the point whose umbrella it is.
    for (std::uint32_t p = 0; p < surface.size(); ++p) {
        if (surface.label(PointId{p}) != label) continue;
        const auto range = surface.umbrellas_of(PointId{p});
        for (std::uint32_t u = range.first; u < range.last; ++u) {
            const Umbrella umbrella = surface.umbrella(UmbrellaId{u});
            const std::size_t size = umbrella.ring.size();
            for (std::size_t j = 0; j < size; ++j)
                if (umbrella.is_gap(j) != umbrella.is_gap((j + size - 1) % size))
                    directed.push_back({PointId{p}, umbrella.ring[j]});
        }
    }
    // Two umbrellas of one point may end along the same edge.
    std::ranges::sort(directed);
    directed.erase(std::unique(directed.begin(), directed.end()), directed.end());
    std::vector<PointEdge> edges;
    for (const PointEdge& edge : directed)
        if (edge[0] < edge[1] && std::ranges::binary_search(directed, PointEdge{edge[1], edge[0]}))
            edges.push_back(edge);
    return edges;
}

}  // namespace

std::vector<PointEdge> border_edges(const PointSurface& surface) {
    return edges_at_gaps(surface, PointLabel::border);
}

std::vector<PointEdge> crease_edges(const PointSurface& surface) {
    return edges_at_gaps(surface, PointLabel::feature);
}

}  // namespace rimline
