#pragma once

// Lines of space onto a picture, and the picture onto a view box.
//
// A viewpoint looks at the model's center in perspective; a direction looks against itself without. What
// a perspective camera cannot show is cut away: behind it, and farther than 75 degrees off its axis,
// where a line that passes beside the viewpoint would make the picture larger than any bound. Picture
// coordinates are y up, in tangents of the angle or in the model's units; the view's are y down.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

struct PictureLine {
    glm::dvec2 a, b;
};

class LineProjection {
public:
    /// Up is the mesh's own, or another axis when it looks along that.
    LineProjection(const Mesh& mesh, const HomogeneousPoint& point);

    /// The part of the line that the picture shows, or nothing.
    std::optional<PictureLine> project(const glm::vec3& a, const glm::vec3& b) const;

private:
    glm::dvec3 to_camera(const glm::vec3& p) const noexcept;  // z is the depth.

    glm::dvec3 eye_, right_, up_, forward_;
    bool is_perspective_;
};

/// How a picture lies in a view box from (0, 0) to (width, height).
struct PictureFit {
    glm::dvec2 low;  // Of the picture.
    double scale, margin, width, height;
    PictureLine to_view(const PictureLine& line) const noexcept;
};

/// Grows with each line that the picture holds.
class PictureFrame {
public:
    void include(const PictureLine& line) noexcept;
    /// The longer side becomes 1000 units, with a margin; an empty picture a square.
    PictureFit fit() const noexcept;

private:
    glm::dvec2 low_{std::numeric_limits<double>::infinity()};
    glm::dvec2 high_{-std::numeric_limits<double>::infinity()};
};

}  // namespace rimline::tools
