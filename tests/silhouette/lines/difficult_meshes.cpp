#include "tests/silhouette/lines/difficult_meshes.h"

#include <glm/geometric.hpp>
#include <vector>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline::tests {

MeshSource broken(const MeshSource& whole, std::uint64_t seed, float size) {
    MeshSource source = whole;
    Random random(seed);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const auto& t : whole.triangles) {
        const std::uint32_t chance = random.below(100);
        if (chance < 5) continue;
        triangles.push_back(t);
        if (chance < 10) std::swap(triangles.back()[0], triangles.back()[1]);
        if (chance >= 97) triangles.push_back(t);
        if (chance == 50) {
            const auto fin = static_cast<std::uint32_t>(source.positions.size());
            source.positions.push_back(source.positions[t[0]] + 0.1f * size * random.in_cube());
            triangles.push_back({t[0], t[1], fin});
        }
    }
    source.triangles = std::move(triangles);
    return source;
}

MeshSource broken_knot(std::uint64_t seed) {
    return broken(make_built_in_shape("knot", 2000), seed);
}

MeshSource crossing_knots(std::uint32_t faces) {
    MeshSource source = make_built_in_shape("knot", faces / 2);
    const auto count = static_cast<std::uint32_t>(source.positions.size());
    // The second is turned by 90 degrees about two axes, and moved by no simple share of anything.
    for (std::uint32_t v = 0; v < count; ++v) {
        const glm::vec3 p = source.positions[v];
        source.positions.push_back(glm::vec3(p.y, p.z, p.x) + glm::vec3(0.173f, -0.119f, 0.071f));
    }
    const std::size_t triangles = source.triangles.size();
    for (std::size_t t = 0; t < triangles; ++t) {
        const auto [a, b, c] = source.triangles[t];
        source.triangles.push_back({a + count, b + count, c + count});
    }
    return source;
}

MeshSource rough_sphere(std::uint32_t faces, float height, std::uint64_t seed) {
    MeshSource source = make_built_in_shape("sphere", faces);
    Random random(seed);
    for (glm::vec3& p : source.positions) p *= 1.0f + height * random.signed_unit();
    return source;
}

}  // namespace rimline::tests
