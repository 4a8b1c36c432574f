#include "silhouette/mesh/clear_creases.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <random>
#include <utility>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

std::vector<Crease> clear_creases_of(const Mesh& mesh, double degrees) {
    return clear_creases(mesh, find_creases(mesh, static_cast<float>(glm::radians(degrees))));
}

// A field of n x n squares whose heights come from `height`.
template <typename Height>
MeshSource field(int n, Height&& height) {
    MeshSource source;
    for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x)
            source.positions.emplace_back(float(x), float(y), height(x, y));
    const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            source.triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
            source.triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
        }
    return source;
}

TEST_CASE("all edges of machine parts stand out") {
    for (const char* name : {"box", "scene"}) {
        CAPTURE(name);
        const Mesh mesh(make_built_in_shape(name));
        CHECK(clear_creases_of(mesh, 30.0).size() ==
              find_creases(mesh, static_cast<float>(glm::radians(30.0))).size());
    }
}

// `n` houses in a row, boxes with a pyramid on top.
MeshSource houses(int n) {
    MeshSource source;
    for (int i = 0; i < n; ++i) {
        const auto first = static_cast<std::uint32_t>(source.positions.size());
        for (const float y : {0.0f, 1.0f})
            for (const auto& [x, z] :
                 {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}})
                source.positions.emplace_back(x + 4.0f * float(i), y, z);
        source.positions.emplace_back(4.0f * float(i), 2.0f, 0.0f);
        source.triangles.push_back({first + 0, first + 1, first + 2});
        source.triangles.push_back({first + 0, first + 2, first + 3});
        for (const std::uint32_t a : {0u, 1u, 2u, 3u}) {
            const std::uint32_t b = (a + 1) % 4;
            source.triangles.push_back({first + a, first + a + 4, first + b + 4});
            source.triangles.push_back({first + a, first + b + 4, first + b});
            source.triangles.push_back({first + a + 4, first + 8, first + b + 4});
        }
    }
    return source;
}

TEST_CASE("all edges of polyhedra stand out") {
    for (const int n : {1, 4}) {
        CAPTURE(n);
        CHECK(clear_creases_of(Mesh(houses(n)), 30.0).size() == 16 * std::size_t(n));
    }
    CHECK(clear_creases_of(Mesh(tests::tetrahedron()), 30.0).size() == 6);
    CHECK(clear_creases_of(Mesh(tests::octahedron()), 30.0).size() == 12);
}

TEST_CASE("edges of a part stand out however far the other parts lie") {
    const MeshSource box = make_built_in_shape("box");
    for (const float apart : {4.0f, 300.0f, 30000.0f}) {
        CAPTURE(apart);
        MeshSource source = box;
        const auto first = static_cast<std::uint32_t>(box.positions.size());
        for (const glm::vec3& p : box.positions)
            source.positions.push_back(p + glm::vec3(apart, 0.0f, 0.0f));
        for (const auto& t : box.triangles)
            source.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
        CHECK(clear_creases_of(Mesh(source), 30.0).size() == 24);
    }
}

TEST_CASE("a ridge through a field stands out, whatever the field is made of") {
    for (const int n : {4, 40}) {
        CAPTURE(n);
        const Mesh mesh(field(n, [&](int x, int) { return -0.5f * std::abs(float(x - n / 2)); }));
        CHECK(clear_creases_of(mesh, 30.0).size() == std::size_t(n));
    }
}

TEST_CASE("the edges of a rough surface do not stand out") {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> any(-0.4f, 0.4f);
    const Mesh mesh(field(60, [&](int, int) { return any(random); }));
    const std::size_t rough = find_creases(mesh, static_cast<float>(glm::radians(30.0))).size();
    CHECK(rough > 1000);
    CHECK(clear_creases_of(mesh, 30.0).size() < rough / 50);
}

TEST_CASE(
    "a step is a crease at any length where it is sharp, and only where it is long where not") {
    const auto dent = [](int length, float depth) {
        return field(60, [=](int x, int y) {
            return std::abs(x - 30) <= length && y == 30 ? -depth : 0.0f;
        });
    };
    // 30 squares are the mesh's radius by 0.7.
    CHECK(clear_creases_of(Mesh(dent(0, 0.6f)), 30.0).empty());
    CHECK(clear_creases_of(Mesh(dent(10, 0.6f)), 30.0).size() >= 20);
}

TEST_CASE("the creases that stand out keep their order, and meshes without any have none") {
    const Mesh mesh(make_built_in_shape("scene"));
    const std::vector<Crease> creases = clear_creases_of(mesh, 30.0);
    CHECK(std::ranges::is_sorted(creases, std::ranges::greater(), &Crease::bend_rad));
    CHECK(clear_creases(Mesh(MeshSource{}), {}).empty());
    CHECK(clear_creases_of(Mesh(make_built_in_shape("sphere", 5000)), 30.0).empty());
}

}  // namespace
}  // namespace rimline
