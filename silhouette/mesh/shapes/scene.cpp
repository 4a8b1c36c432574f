// A scene on a round slab: a knot on a pedestal, a ball in its shadow, a ring that leans on a block,
// an arch behind them and a small ball in front. It is composed for a viewpoint in front (+z) and
// slightly above, and a light from the upper left, in the direction (-0.5, 0.9, 0.6). Shadows fall to
// the right and back by 0.87 of the height above the ground. The knot's shadow falls on the ball.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <limits>
#include <span>

#include "silhouette/mesh/shapes/circle.h"
#include "silhouette/mesh/shapes/shape_makers.h"
#include "silhouette/mesh/shapes/tube.h"

namespace rimline {

namespace {

// A part that stands on another has this gap below it. The gap is too small to be visible, but no two
// surfaces share a plane, and edges where parts meet are silhouettes that can be drawn.
constexpr double k_gap = 0.003;
constexpr double k_pedestal_height = 0.86;

struct Placement {
    glm::dmat3 rotation{1.0};
    glm::dvec3 scale{1.0};
    double x = 0.0, z = 0.0;  // Position of the part's origin.
    double rests_on = 0.0;    // Height of the support below its lowest point.
};

glm::dmat3 turned_around_y(double turns) {
    const CosSin turn = cos_sin_of_turns(turns);
    return {{turn.cos, 0.0, -turn.sin}, {0.0, 1.0, 0.0}, {turn.sin, 0.0, turn.cos}};
}

glm::dmat3 turned_around_z(double turns) {
    const CosSin turn = cos_sin_of_turns(turns);
    return {{turn.cos, turn.sin, 0.0}, {-turn.sin, turn.cos, 0.0}, {0.0, 0.0, 1.0}};
}

void place(MeshSource& scene, const MeshSource& part, const Placement& placement) {
    const auto base = static_cast<std::uint32_t>(scene.positions.size());
    const auto placed = [&](const glm::vec3& p) {
        return placement.rotation * (placement.scale * glm::dvec3(p));
    };
    double lowest = std::numeric_limits<double>::infinity();
    for (const glm::vec3& p : part.positions) lowest = std::min(lowest, placed(p).y);
    const glm::dvec3 offset(placement.x, placement.rests_on + k_gap - lowest, placement.z);
    for (const glm::vec3& p : part.positions)
        scene.positions.push_back(glm::vec3(placed(p) + offset));
    for (const auto& [a, b, c] : part.triangles)
        scene.triangles.push_back({base + a, base + b, base + c});
}

struct ProfilePoint {
    double radius, height;
};

// A surface of revolution around y with flat ends. The profile goes upwards on the outside.
MeshSource turned_profile(std::span<const ProfilePoint> profile, double faces) {
    const double rings = static_cast<double>(profile.size());
    const double sides = std::max(8.0, std::round(0.5 * faces / rings));
    const TubeGrid grid{static_cast<std::uint32_t>(rings), static_cast<std::uint32_t>(sides)};
    MeshSource shape;
    append_tube(
        shape, grid,
        [&](std::uint32_t ring, std::uint32_t side) {
            const CosSin around = cos_sin_of_turns(double(side) / grid.sides);
            const auto [radius, height] = profile[ring];
            return glm::dvec3(radius * around.sin, height, radius * around.cos);
        },
        Poles{{0.0, profile.front().height, 0.0}, {0.0, profile.back().height, 0.0}});
    return shape;
}

// A round arch in the xy plane with a rectangular section, on legs.
MeshSource arch(double faces) {
    constexpr double k_radius = 0.62;  // To the center of the section.
    constexpr double k_leg = 1.15;
    constexpr double k_half_height = 0.16;
    constexpr double k_half_depth = 0.24;
    const double bow = std::max(6.0, std::round(faces / 8.0) - 3.0);
    const auto last = static_cast<std::uint32_t>(bow) + 2;  // Ring 0 and the last are the feet.
    const auto center_line = [&](std::uint32_t ring) {
        const double along = std::clamp((double(ring) - 1.0) / bow, 0.0, 1.0);
        const CosSin angle = cos_sin_of_turns(0.5 * (1.0 - along));
        const double raised = ring == 0 || ring == last ? 0.0 : k_leg;
        const glm::dvec3 outward(angle.cos, angle.sin, 0.0);
        return std::array{k_radius * outward + glm::dvec3(0.0, raised, 0.0), outward};
    };
    MeshSource shape;
    append_tube(
        shape, {last + 1, 4},
        [&](std::uint32_t ring, std::uint32_t side) {
            const auto [center, outward] = center_line(ring);
            const double out = side < 2 ? k_half_height : -k_half_height;
            const double front = side == 1 || side == 2 ? k_half_depth : -k_half_depth;
            return center + out * outward + glm::dvec3(0.0, 0.0, front);
        },
        Poles{center_line(0)[0], center_line(last)[0]});
    return shape;
}

// The top of the slab is the ground, at height 0.
MeshSource slab(double faces) {
    constexpr double k_radius = 2.75;
    constexpr double k_thickness = 0.24;
    constexpr double k_rounding = 0.06;
    std::array<ProfilePoint, 8> profile{
        {{k_radius - k_rounding, -k_thickness}, {k_radius, k_rounding - k_thickness}}};
    for (std::uint32_t i = 0; i < 6; ++i) {
        const CosSin angle = cos_sin_of_turns(0.05 * i);
        profile[2 + i] = {k_radius - k_rounding * (1.0 - angle.cos),
                          k_rounding * (angle.sin - 1.0)};
    }
    return turned_profile(profile, faces);
}

void place_knot_on_pedestal(MeshSource& scene, double pedestal_faces, double knot_faces) {
    constexpr double k_x = -0.2;
    constexpr double k_z = 0.3;
    // Two rings at either end of the wall: the shading of the bends ends there.
    constexpr std::array<ProfilePoint, 12> k_profile{{{0.66, 0.00},
                                                      {0.66, 0.11},
                                                      {0.61, 0.16},
                                                      {0.55, 0.18},
                                                      {0.53, 0.22},
                                                      {0.53, 0.24},
                                                      {0.53, 0.66},
                                                      {0.53, 0.68},
                                                      {0.55, 0.72},
                                                      {0.60, 0.74},
                                                      {0.64, 0.78},
                                                      {0.64, k_pedestal_height - k_gap}}};
    place(scene, turned_profile(k_profile, pedestal_faces), {.x = k_x, .z = k_z});
    // The knot stands on two of its three lobes, turned slightly towards the light.
    place(scene, make_knot(static_cast<std::uint32_t>(knot_faces)),
          {.rotation = turned_around_y(0.045) * turned_around_z(-1.0 / 12.0),
           .scale = glm::dvec3(0.5),
           .x = k_x,
           .z = k_z,
           .rests_on = k_pedestal_height});
}

// The ring's rim stands on the ground at one end and touches the block's left side at the other.
void place_ring_and_block(MeshSource& scene, double ring_faces) {
    constexpr double k_x = 1.75;
    constexpr double k_z = 0.65;
    constexpr glm::dvec3 k_half_block(0.34, 0.56, 0.42);
    constexpr double k_major = 0.42;
    constexpr double k_minor = 0.13;
    const glm::dmat3 yaw = turned_around_y(0.14);
    place(scene, make_box(12), {.rotation = yaw, .scale = k_half_block, .x = k_x, .z = k_z});

    constexpr double k_lean = 0.06;  // Turns, from upright.
    const double reach = k_major * cos_sin_of_turns(k_lean).sin + k_minor;
    const glm::dvec3 beside = yaw * glm::dvec3(-k_half_block.x - reach - k_gap, 0.0, 0.06);
    place(scene, make_torus(static_cast<std::uint32_t>(ring_faces), k_major, k_minor),
          {.rotation = yaw * turned_around_z(0.25 - k_lean),
           .x = k_x + beside.x,
           .z = k_z + beside.z});
}

}  // namespace

MeshSource make_scene(std::uint32_t faces) {
    MeshSource scene = slab(0.06 * faces);
    place_knot_on_pedestal(scene, 0.096 * faces, 0.424 * faces);
    place(scene, make_sphere(static_cast<std::uint32_t>(0.16 * faces)),
          {.scale = glm::dvec3(0.44), .x = 0.85, .z = -0.65});
    place_ring_and_block(scene, 0.14 * faces);
    place(scene, arch(0.05 * faces), {.rotation = turned_around_y(-0.075), .x = -1.62, .z = -0.6});
    place(scene, make_sphere(static_cast<std::uint32_t>(0.07 * faces)),
          {.scale = glm::dvec3(0.24), .x = 0.3, .z = 1.6});
    return scene;
}

}  // namespace rimline
