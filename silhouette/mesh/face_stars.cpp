#include "silhouette/mesh/face_stars.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "silhouette/mesh/opposite_corner.h"

namespace rimline {

namespace {

// More than the errors of directions that are found in doubles and rounded to floats.
constexpr double k_margin = 0x1p-22;

// Contains the directions from a corner of a triangle to its other points: an arc of a great circle of less than half
// a turn, which its chord misses by less than its height.
FaceBox directions_from(const glm::dvec3& center, const glm::dvec3& a, const glm::dvec3& b) {
    const double length_a = glm::length(a - center), length_b = glm::length(b - center);
    constexpr float k_far = std::numeric_limits<float>::infinity();
    if (!(length_a > 0.0 && length_b > 0.0)) return {glm::vec3(-k_far), glm::vec3(k_far)};
    const glm::dvec3 u = (a - center) / length_a, v = (b - center) / length_b;
    const double margin = 1.0 - 0.5 * glm::length(u + v) + k_margin;
    return {glm::vec3(glm::min(u, v) - margin), glm::vec3(glm::max(u, v) + margin)};
}

// Of a face with that corner.
FaceBox directions_from(const Mesh& mesh, std::uint32_t face, VertexId corner) {
    const Triangle& t = mesh.triangles()[face];
    const auto at = [&](VertexId vertex) { return glm::dvec3(mesh.positions()[index(vertex)]); };
    const std::size_t k = t[0] == corner ? 0 : (t[1] == corner ? 1 : 2);
    return directions_from(at(corner), at(t[(k + 1) % 3]), at(t[(k + 2) % 3]));
}

}  // namespace

bool meet_in_corner_only(const Mesh& mesh, std::uint32_t face, std::uint32_t other) {
    VertexId corner{};
    int shared = 0;
    for (const VertexId vertex : mesh.triangles()[face])
        if (has_corner(mesh.triangles()[other], vertex)) corner = vertex, ++shared;
    return shared == 1 &&
           !directions_from(mesh, face, corner).meets(directions_from(mesh, other, corner));
}

FaceStars::Star FaceStars::star_of_block(const Mesh& mesh, std::span<const std::uint32_t> faces) {
    Star star;
    for (const VertexId vertex : mesh.triangles()[faces.front()])
        if (std::ranges::all_of(faces, [&](std::uint32_t face) {
                return has_corner(mesh.triangles()[face], vertex);
            }))
            star.center = index(vertex);
    if (star.center == k_none) return star;
    for (const std::uint32_t face : faces)
        star.directions.include(directions_from(mesh, face, VertexId{star.center}));
    return star;
}

FaceStars::Star FaceStars::joined(const Star& a, const Star& b) {
    if (a.center != b.center) return {};
    Star star = a;
    star.directions.include(b.directions);
    return star;
}

// Points of a star lie on one side of the plane if its directions do, and only its center lies in it. Rounding moves the
// plane by less than k_off_plane of the distance of the centers, which is crossed within the (k_off_plane / k_beside)th
// part of it around each of them: never by both in one point.
bool FaceStars::are_apart(const Star& a, const Star& b) const noexcept {
    if (a.center == k_none || b.center == k_none) return false;
    if (a.center == b.center) return !a.directions.meets(b.directions);
    constexpr double k_off_plane = 1e-12, k_beside = 1e-6, k_least_turn = 1e-3;
    const auto middle = [](const Star& star) {
        return 0.5 * (glm::dvec3(star.directions.low) + glm::dvec3(star.directions.high));
    };
    const auto reach = [](const Star& star, const glm::dvec3& normal) {
        return 0.5 * glm::dot(glm::dvec3(star.directions.high) - glm::dvec3(star.directions.low),
                              glm::abs(normal));
    };
    const glm::dvec3 between =
        glm::dvec3(mesh_.positions()[b.center]) - glm::dvec3(mesh_.positions()[a.center]);
    const double distance = glm::length(between);
    if (!(distance > 0.0)) return false;
    const glm::dvec3 axis = between / distance;
    // Seen along the axis.
    const auto middle_across = [&](const Star& star) {
        const glm::dvec3 across = middle(star) - axis * glm::dot(middle(star), axis);
        return across / glm::length(across);
    };
    glm::dvec3 normal = middle_across(b) - middle_across(a);
    const double length = glm::length(normal);
    if (!(length > k_least_turn)) return false;
    normal /= length;
    return std::abs(glm::dot(normal, axis)) < k_off_plane &&
           glm::dot(normal, middle(a)) + reach(a, normal) < -k_beside &&
           glm::dot(normal, middle(b)) - reach(b, normal) > k_beside;
}

FaceStars::FaceStars(const Mesh& mesh, const FaceTree& tree, const std::stop_token& stop)
    : mesh_(mesh) {
    constexpr std::uint32_t k_block = FaceTree::k_block_faces;
    const std::uint32_t faces = mesh.face_count();
    std::vector<Star> blocks((faces + k_block - 1) / k_block);
    tbb::parallel_for(
        tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(blocks.size()), 1024),
        [&](const auto& run) {
            LongCall{stop, {}}.checkpoint(0.0);
            for (std::uint32_t i = run.begin(); i < run.end(); ++i)
                blocks[i] = star_of_block(
                    mesh,
                    tree.order().subspan(i * k_block, std::min(k_block, faces - i * k_block)));
        });
    if (std::ranges::all_of(blocks, [](const Star& star) { return star.center == k_none; })) return;
    nodes_ = tree.values_of_nodes<Star>(
        [&](const FaceTree::Node& block) { return blocks[block.block()]; }, joined);
}

}  // namespace rimline
