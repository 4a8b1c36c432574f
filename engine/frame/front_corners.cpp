#include "engine/frame/front_corners.h"

#include <cmath>

#include "silhouette/error.h"

namespace rimline {

std::uint32_t put_front_corners(const Mesh& mesh, const HomogeneousPoint& camera,
                                std::span<std::uint32_t> corners) {
    // Of the camera's point, the planes and the device's positions: some bits more than floats have.
    constexpr float k_error = 0x1p-18f;
    const float own = k_error * (std::abs(camera.x) + std::abs(camera.y) + std::abs(camera.z) +
                                 std::abs(camera.w) * static_cast<float>(mesh.radius()));
    const std::span<const Plane> planes = mesh.planes();
    RIMLINE_CHECK(corners.size() >= 3 * planes.size());
    std::uint32_t* next = corners.data();
    for (std::uint32_t f = 0; f < planes.size(); ++f) {
        const Plane& plane = planes[f];
        const float distance = camera.w * plane.d;
        const float value =
            (plane.nx * camera.x + plane.ny * camera.y) + plane.nz * camera.z - distance;
        next[0] = 3 * f;
        next[1] = 3 * f + 1;
        next[2] = 3 * f + 2;
        next += value >= -(own + k_error * std::abs(distance)) ? 3 : 0;
    }
    return static_cast<std::uint32_t>(next - corners.data());
}

}  // namespace rimline
