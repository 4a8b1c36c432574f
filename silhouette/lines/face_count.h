#pragma once

// How many faces lie strictly between the eye and a point: by one ray that meets all of them.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "silhouette/lines/line_geometry.h"
#include "silhouette/lines/line_view.h"

namespace rimline {

/// Before a vertex, exactly. Faces that contain the vertex do not count. O(log faces + faces on the ray).
std::int32_t count_before_vertex(const LineGeometry& surface, const LineView& view,
                                 std::uint32_t vertex);

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
