#include <algorithm>
#include <cmath>
#include <numbers>

#include "silhouette/mesh/shapes/circle.h"
#include "silhouette/mesh/shapes/shape_makers.h"
#include "silhouette/mesh/shapes/tube.h"

namespace rimline {

namespace {

constexpr double k_turns = 4.0;
constexpr double k_radius = 0.8;
constexpr double k_rise = 0.55;  // Per turn. The gap between coils is a third of it.
constexpr double k_wire_radius = 0.18;

// The helix in closed form. `outward` and `binormal` are perpendicular to the tangent.
struct HelixFrame {
    glm::dvec3 point, tangent, outward, binormal;
};

HelixFrame helix_at(double turns) {
    const CosSin around = cos_sin_of_turns(turns);
    const double across = 2.0 * std::numbers::pi * k_radius;
    const double length = std::sqrt(across * across + k_rise * k_rise);
    const glm::dvec3 outward(around.sin, 0.0, around.cos);
    const glm::dvec3 forward(around.cos, 0.0, -around.sin);
    const glm::dvec3 up(0.0, 1.0, 0.0);
    return {k_radius * outward + k_rise * (turns - 0.5 * k_turns) * up,
            (across * forward + k_rise * up) / length, outward,
            (across * up - k_rise * forward) / length};
}

}  // namespace

MeshSource make_spring(std::uint32_t faces) {
    // Each rounded end adds the area of a tube that is one tube radius long.
    const double across = 2.0 * std::numbers::pi * k_radius;
    const double length =
        k_turns * std::sqrt(across * across + k_rise * k_rise) + 2.0 * k_wire_radius;
    const TubeGrid whole =
        tube_grid(0.5 * faces, length / (2.0 * std::numbers::pi * k_wire_radius), {29, 3});
    const std::uint32_t sides = whole.sides;
    // Rings of a rounded end, without the one shared with the tube. The pole is not a ring.
    const std::uint32_t cap_rings = sides < 6 ? 0 : (sides + 2) / 4 - 1;
    const std::uint32_t body = std::max(whole.rings, 29 + 2 * cap_rings) - 2 * cap_rings;
    const std::uint32_t rings = body + 2 * cap_rings;

    MeshSource spring;
    HelixFrame frame{};
    double radius = 0.0;
    append_tube(
        spring, {rings, sides},
        [&](std::uint32_t ring, std::uint32_t side) {
            if (side == 0) {
                const double last = body - 1;
                const double along = double(ring) - cap_rings;
                frame = helix_at(k_turns * std::clamp(along / last, 0.0, 1.0));
                const double beyond = along < 0.0 ? along : std::max(along - last, 0.0);
                const CosSin latitude = cos_sin_of_turns(0.25 * beyond / (cap_rings + 1));
                frame.point += k_wire_radius * latitude.sin * frame.tangent;
                radius = k_wire_radius * latitude.cos;
            }
            const CosSin section = cos_sin_of_turns(double(side) / sides);
            return frame.point +
                   radius * (section.cos * frame.outward - section.sin * frame.binormal);
        },
        Poles{helix_at(0.0).point - k_wire_radius * helix_at(0.0).tangent,
              helix_at(k_turns).point + k_wire_radius * helix_at(k_turns).tangent});
    return spring;
}

}  // namespace rimline
