#pragma once

// Projects line segments onto a picture, and maps the picture to a view box.
//
// A viewpoint gives a perspective projection towards the model's center, a direction an orthographic one. A
// perspective projection clips segments behind the viewpoint and more than 75 degrees off the axis: a line
// that passes beside the viewpoint would otherwise make the picture unboundedly large. Picture coordinates
// have y upwards, in tangents of the angle or in the model's units; the view box has y downwards.

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
    /// Up is the mesh's up axis, or another axis if the view is parallel to it.
    LineProjection(const Mesh& mesh, const HomogeneousPoint& point);

    /// The projection of the part that is not clipped, if any.
    std::optional<PictureLine> project(const glm::vec3& a, const glm::vec3& b) const;

private:
    glm::dvec3 to_camera(const glm::vec3& p) const noexcept;  // z is the depth.

    glm::dvec3 eye_, right_, up_, forward_;
    bool is_perspective_;
};

/// The map from a picture to a view box from (0, 0) to (width, height).
struct PictureFit {
    glm::dvec2 low;  // Lower left corner of the picture.
    double scale, margin, width, height;
    PictureLine to_view(const PictureLine& line) const noexcept;
};

/// The bounding box of the picture's lines.
class PictureFrame {
public:
    void include(const PictureLine& line) noexcept;
    /// The longer side of the view box has 1000 units, margins included. An empty picture gives a square.
    PictureFit fit() const noexcept;

private:
    glm::dvec2 low_{std::numeric_limits<double>::infinity()};
    glm::dvec2 high_{-std::numeric_limits<double>::infinity()};
};

}  // namespace rimline::tools
