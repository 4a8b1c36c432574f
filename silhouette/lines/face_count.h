#pragma once

// How many faces lie strictly between the eye and a point: by a ray that meets all of them.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/lines/line_geometry.h"
#include "silhouette/lines/line_view.h"
#include "silhouette/mesh/face_tree_segments.h"

namespace rimline {

/// Before vertices, exactly. Reuses its memory.
class VertexRays {
public:
    /// The number of each vertex, valid until the next call. Faces that contain the vertex do not count.
    /// O(vertices · log faces + faces on the rays).
    std::span<const std::int32_t> count_before(const LineGeometry& surface, const LineView& view,
                                               std::span<const std::uint32_t> vertices);

private:
    FaceTree::Segments rays_;
    std::vector<std::int32_t> counts_;
};

struct RayCount {
    std::int32_t count;
    bool is_sure;  ///< No face passes so near to the point or the ray that doubles cannot tell.
};
/// Before any point, in double. Faces for which `is_own(face)` holds do not count.
template <typename IsOwn>
RayCount count_before_point(const LineGeometry& surface, const LineView& view,
                            const glm::dvec3& point, IsOwn&& is_own);

/// Whether any face lies at a place of the picture, or so near to it that doubles cannot tell. O(log faces) mostly.
bool is_covered(const LineGeometry& surface, const LineView& view, const glm::dvec2& place);

/// The end of a ray from a point to the eye: the eye, or for a direction a point outside of the mesh.
glm::dvec3 ray_end(const LineGeometry& surface, const LineView& view, const glm::dvec3& point);

/// Whether a ray meets a face: 1 or 0, and whether that is sure.
RayCount meets_face(const LineGeometry& surface, const LineView& view, const glm::dvec3& point,
                    std::uint32_t face);

template <typename IsOwn>
RayCount count_before_point(const LineGeometry& surface, const LineView& view,
                            const glm::dvec3& point, IsOwn&& is_own) {
    RayCount all{0, true};
    surface.tree().each_along(ray_end(surface, view, point), point, [&](std::uint32_t face) {
        if (is_own(face)) return;
        const RayCount one = meets_face(surface, view, point, face);
        all.count += one.count;
        all.is_sure = all.is_sure && one.is_sure;
    });
    return all;
}

}  // namespace rimline
