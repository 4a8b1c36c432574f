#pragma once

// What is usual instead of exact visibility: one ray for each piece of a line, from its middle to the eye, by
// Embree. The piece is hidden if the ray meets a face that is not left out.
//
// Faces at the piece itself must be left out, or rounding decides. There are three usual ways:
//   own faces   the faces that have the piece's edge
//   shortened   own faces, and what lies within a thousandth of the way before the piece
//   one-ring    all faces at both vertices of the edge

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "silhouette/lines/line_view.h"
#include "silhouette/mesh/mesh.h"
#include "tools/bench/line_pieces.h"

namespace rimline::tools {

enum class RayWay : std::uint8_t { own_faces, shortened, one_ring };

class PieceRays {
public:
    /// Why this build has no rays. Empty where it has.
    static std::string_view missing() noexcept;

    /// Builds Embree's tree. `mesh` must outlive it. Only where nothing is missing().
    explicit PieceRays(const Mesh& mesh);
    ~PieceRays();
    PieceRays(const PieceRays&) = delete;
    PieceRays& operator=(const PieceRays&) = delete;

    /// Sets 1 for each piece that is hidden from view.point(), and 0 for each other. On this thread.
    void find_hidden(const LineView& view, std::span<const LinePiece> pieces, RayWay way,
                     std::vector<std::uint8_t>& is_hidden) const;

private:
    struct Scene;
    std::unique_ptr<const Scene> scene_;
};

}  // namespace rimline::tools
