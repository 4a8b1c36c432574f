// What `rimline bench lines` does in a build without Embree.

#include "silhouette/error.h"
#include "tools/bench/piece_rays.h"

namespace rimline::tools {

struct PieceRays::Scene {};

std::string_view PieceRays::missing() noexcept {
    return "built without Embree 3 (Debian: libembree-dev)";
}
PieceRays::PieceRays(const Mesh&) { RIMLINE_CHECK(false); }
PieceRays::~PieceRays() = default;
void PieceRays::find_hidden(const LineView&, std::span<const LinePiece>, RayWay,
                            std::vector<std::uint8_t>&) const {}

}  // namespace rimline::tools
