#pragma once

// A plot of a field in a plane across a model: its values as colors, with axes in the model's own coordinates, and
// the model: its lines as seen along the axis, and where the plane cuts it.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/field/unit_planes.h"
#include "silhouette/mesh/mesh.h"
#include "tools/output/canvas.h"

namespace rimline::tools {

/// A plane across an axis, and its squares, row by row from the top.
class SliceGrid {
public:
    /// `axis`: 0, 1 or 2. `value`: of that coordinate. The others are in [-extent, extent]. All are unit
    /// coordinates (unit_planes.h). Squares count where min_radius <= distance from the center <= extent.
    SliceGrid(int axis, double value, double min_radius, double extent, int side);

    int axis() const noexcept { return axis_; }
    double value() const noexcept { return value_; }
    double extent() const noexcept { return extent_; }
    int side() const noexcept { return side_; }
    // The other axes, as numbers: they point right and up.
    int right() const noexcept { return axis_ == 0 ? 1 : 0; }
    int up() const noexcept { return axis_ == 2 ? 1 : 2; }

    /// The center of a square, which may lie beyond the grid.
    glm::dvec3 center(int row, int column) const noexcept;

    /// The squares that count, ascending, and their centers.
    const std::vector<std::uint32_t>& squares() const noexcept { return squares_; }
    const std::vector<glm::dvec3>& points() const noexcept { return points_; }

private:
    int axis_, side_;
    double value_, extent_;
    std::vector<std::uint32_t> squares_;
    std::vector<glm::dvec3> points_;
};

/// Where a plane cuts the faces of a mesh, as segments in the model's coordinates. Faces in the plane count not.
/// O(faces).
std::vector<std::array<glm::dvec3, 2>> cut_segments(const Mesh& mesh, int axis, double value);

struct SlicePicture {
    const Mesh& mesh;
    UnitFrame frame;
    const SliceGrid& grid;
    const std::vector<double>& values;  ///< Of grid.points(), not empty.
    std::string title;                  ///< Above the plot.
    std::string unit;                   ///< Of the values.
};

/// The plot. The model is drawn if its mesh is welded. O(pixels), and once a LineSurface. Throws Error{cancelled}.
Canvas draw_slice(const SlicePicture& slice, const LongCall& call = {});

}  // namespace rimline::tools
