#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "silhouette/mesh/shapes/shape_makers.h"

namespace rimline {

namespace {

constexpr std::array<std::array<std::uint32_t, 3>, 20> k_icosahedron{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

std::array<glm::dvec3, 12> icosahedron_corners() {
    constexpr double g = std::numbers::phi;
    return {{{-1, g, 0},
             {1, g, 0},
             {-1, -g, 0},
             {1, -g, 0},
             {0, -1, g},
             {0, 1, g},
             {0, -1, -g},
             {0, 1, -g},
             {g, 0, -1},
             {g, 0, 1},
             {-g, 0, -1},
             {-g, 0, 1}}};
}

}  // namespace

// Numbering: 12 corners, then 30 edges of n - 1 points each, then the points inside the 20 faces.
MeshSource make_sphere(std::uint32_t faces) {
    const auto n = static_cast<std::uint32_t>(std::max(1.0, std::round(std::sqrt(faces / 20.0))));
    const std::array<glm::dvec3, 12> corners = icosahedron_corners();
    MeshSource sphere;
    sphere.positions.reserve(10 * std::size_t{n} * n + 2);
    sphere.triangles.reserve(20 * std::size_t{n} * n);
    const auto push = [&](glm::dvec3 p) {
        sphere.positions.push_back(glm::vec3(p / std::sqrt(glm::dot(p, p))));
    };
    for (const glm::dvec3& corner : corners) push(corner);

    // The first point of edge (a, b), a < b. Its points go from a to b.
    std::array<std::array<std::uint32_t, 12>, 12> edge_begin{};
    for (const auto& face : k_icosahedron)
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::uint32_t a = face[c];
            const std::uint32_t b = face[(c + 1) % 3];
            if (a > b) continue;  // The other face has a < b.
            edge_begin[a][b] = static_cast<std::uint32_t>(sphere.positions.size());
            for (std::uint32_t i = 1; i < n; ++i)
                push(double(n - i) * corners[a] + double(i) * corners[b]);
        }
    // Point i of n from corner a to corner b.
    const auto on_edge = [&](std::uint32_t a, std::uint32_t b, std::uint32_t i) {
        if (i == 0) return a;
        if (i == n) return b;
        return a < b ? edge_begin[a][b] + i - 1 : edge_begin[b][a] + (n - i) - 1;
    };

    for (const auto& [a, b, c] : k_icosahedron) {
        // Row i is parallel to bc, goes from ab to ac and has i + 1 points.
        std::vector<std::uint32_t> above{a};
        for (std::uint32_t i = 1; i <= n; ++i) {
            std::vector<std::uint32_t> row{on_edge(a, b, i)};
            for (std::uint32_t j = 1; j < i; ++j) {
                if (i == n) {
                    row.push_back(on_edge(b, c, j));
                    continue;
                }
                row.push_back(static_cast<std::uint32_t>(sphere.positions.size()));
                push(double(n - i) * corners[a] + double(i - j) * corners[b] +
                     double(j) * corners[c]);
            }
            row.push_back(on_edge(a, c, i));
            for (std::uint32_t j = 0; j < i; ++j) {
                sphere.triangles.push_back({above[j], row[j], row[j + 1]});
                if (j > 0) sphere.triangles.push_back({above[j - 1], row[j], above[j]});
            }
            above = std::move(row);
        }
    }
    return sphere;
}

}  // namespace rimline
