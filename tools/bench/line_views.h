#pragma once

// The views of `rimline bench lines`: perspective cameras around a model, each drawn on a page as `draw` does.

#include <cstdint>
#include <vector>

#include "silhouette/lines/line_view.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

/// A place of the page is a quarter of a pixel of a screen.
constexpr double k_oracle_spacing_mm = 0.066;

/// The distance from an eye to the center of the mesh, in radii.
constexpr double k_eye_radii = 3.3;

struct BenchView {
    LineView view;
    double mm_per_unit;  ///< Of picture coordinates, so that the picture fills a page of A4.
};

/// The view of an eye towards the center of the mesh.
BenchView bench_view(const Mesh& mesh, const glm::dvec3& eye);

/// The first view is that of `draw`, from the same direction; the others have random directions, the same for
/// all models. Their eyes lie at 3.3 radii from the center of the mesh, which must have an extent.
std::vector<BenchView> bench_views(const Mesh& mesh, std::uint32_t count);

}  // namespace rimline::tools
