#include "silhouette/mesh/lost_shape.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "silhouette/mesh/mesh_source.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline {
namespace {

// The angle by which half of the faces turn at most where a mesh is moved and its positions are rounded.
double median_turn_deg(const MeshSource& source, const glm::dvec3& offset) {
    std::vector<double> turns;
    for (const auto& triangle : source.triangles) {
        glm::dvec3 corners[3], moved[3];
        for (int i = 0; i < 3; ++i) {
            corners[i] = source.positions[triangle[i]];
            moved[i] = glm::dvec3(glm::vec3(corners[i] + offset)) - offset;
        }
        const glm::dvec3 n = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const glm::dvec3 m = glm::cross(moved[1] - moved[0], moved[2] - moved[0]);
        if (glm::length(n) > 0.0)
            turns.push_back(glm::length(m) > 0.0
                                ? std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m))
                                : glm::radians(90.0));
    }
    std::ranges::nth_element(turns, turns.begin() + std::ptrdiff_t(turns.size() / 2));
    return glm::degrees(turns[turns.size() / 2]);
}

TEST_CASE("a shape is lost where rounding turns its faces") {
    int lost = 0, kept = 0;
    for (const char* shape : {"sphere", "knot", "terrain", "box"})
        for (const std::uint32_t faces : {500u, 50000u}) {
            CAPTURE(shape);
            CAPTURE(faces);
            const MeshSource source = make_built_in_shape(shape, faces);
            const double detail = detail_size(source.positions, source.triangles);
            for (int exponent = 4; exponent < 23; ++exponent) {
                CAPTURE(exponent);
                const glm::dvec3 offset =
                    std::exp2(exponent + 0.4) * glm::normalize(glm::dvec3(1, 0.9, 0.1));
                const bool is_lost = floats_lose_shape(detail, glm::length(offset));
                const double turn = median_turn_deg(source, offset);
                ++(is_lost ? lost : kept);
                CAPTURE(turn);
                if (!is_lost) CHECK(turn < 8.0);
                // Eight times as far away. The box alone has nothing to lose: its corners lie where floats are.
                if (floats_lose_shape(8.0 * detail, glm::length(offset)) &&
                    shape != std::string("box"))
                    CHECK(turn > 5.0);
            }
        }
    CHECK(lost > 40);
    CHECK(kept > 40);
}

TEST_CASE("edges without a length do not count, nor do meshes without an extent") {
    MeshSource source = make_built_in_shape("knot", 2000);
    const double detail = detail_size(source.positions, source.triangles);
    CHECK(detail > 0.0);
    const std::size_t count = source.triangles.size();
    for (std::size_t i = 0; i < 3 * count; ++i) source.triangles.push_back({0, 0, 1});
    CHECK(detail_size(source.positions, source.triangles) == doctest::Approx(detail).epsilon(0.3));
    CHECK(detail_size({}, {}) == 0.0);
    CHECK(detail_size(source.positions, {}) == 0.0);
    const std::vector<glm::vec3> same(3, glm::vec3(5e6f));
    const std::vector<std::array<std::uint32_t, 3>> triangle{{0, 1, 2}};
    CHECK(detail_size(same, triangle) == 0.0);
    CHECK(!floats_lose_shape(0.0, 5e6));
}

}  // namespace
}  // namespace rimline
