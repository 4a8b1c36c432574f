#include "tools/bench/line_pieces.h"

#include <glm/common.hpp>

#include "silhouette/error.h"

namespace rimline::tools {

std::vector<LinePiece> pieces_of(const Mesh& mesh, const LineDrawing& drawing) {
    std::vector<LinePiece> pieces;
    for (const LineRun& run : drawing.runs)
        for (std::uint32_t i = run.first_point; i + 1 < run.last_point; ++i) {
            const LineSource &from = drawing.sources[i], &to = drawing.sources[i + 1];
            // Two edges meet where the edge changes.
            if (from.edge != to.edge || from.edge == k_no_edge) continue;
            const auto& vertices = mesh.edge(from.edge).vertices;
            const auto position = [&](VertexId v) {
                return glm::dvec3(mesh.positions()[index(v)]);
            };
            const double share = 0.5 * (double{from.share} + double{to.share});
            pieces.push_back({glm::mix(position(vertices[0]), position(vertices[1]), share),
                              {vertices[0], vertices[1]},
                              drawing.points[i + 1].arc - drawing.points[i].arc,
                              !run.is_visible()});
        }
    return pieces;
}

DifferingLength differing_length(std::span<const LinePiece> pieces,
                                 std::span<const std::uint8_t> is_hidden) {
    RIMLINE_CHECK(pieces.size() == is_hidden.size());
    DifferingLength length;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        length.all += pieces[i].length;
        if (pieces[i].is_hidden != (is_hidden[i] != 0)) length.differing += pieces[i].length;
    }
    return length;
}

}  // namespace rimline::tools
