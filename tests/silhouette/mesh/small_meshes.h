#pragma once

// Meshes small enough to count by hand.

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "silhouette/mesh/mesh_source.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline::tests {

using Indices = std::vector<std::array<std::uint32_t, 3>>;

/// Distinct positions without meaning, for meshes whose shape does not matter.
inline MeshSource with_any_positions(std::uint32_t vertex_count, Indices triangles) {
    MeshSource source;
    Random random(vertex_count);
    for (std::uint32_t v = 0; v < vertex_count; ++v) source.positions.push_back(random.in_cube());
    source.triangles = std::move(triangles);
    return source;
}

inline MeshSource tetrahedron() {
    return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
            {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
}

inline MeshSource octahedron() {
    return {
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

/// A disc around (0.3, height, 0.2), vertex 0, or the sides of a cone with that tip; the rim are the vertices from 1 on.
inline MeshSource star(std::uint32_t faces, double height) {
    MeshSource source{.positions = {{0.3, height, 0.2}}};
    for (std::uint32_t i = 0; i < faces; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / faces;
        source.positions.emplace_back(std::cos(angle), 0.0, std::sin(angle));
        source.triangles.push_back({0, 1 + (i + 1) % faces, 1 + i});
    }
    return source;
}

/// The same with a disc as its base.
inline MeshSource cone(std::uint32_t sides, double height) {
    MeshSource source = star(sides, height);
    const auto center = static_cast<std::uint32_t>(source.positions.size());
    source.positions.emplace_back(0.1, 0.0, -0.2);
    for (std::uint32_t i = 0; i < sides; ++i)
        source.triangles.push_back({center, 1 + i, 1 + (i + 1) % sides});
    return source;
}

/// `wings` triangles around the edge from (0, 0, 0) to (0, 0, 1), all running it the same way.
inline MeshSource book(std::uint32_t wings) {
    MeshSource source;
    source.positions = {{0, 0, 0}, {0, 0, 1}};
    for (std::uint32_t w = 0; w < wings; ++w) {
        source.positions.emplace_back(float(w) - 0.25f, 1.0f, 0.5f);
        source.triangles.push_back({0, 1, 2 + w});
    }
    return source;
}

/// A band of `quads` quads, two triangles each, whose end joins its beginning, upside down if twisted.
inline MeshSource band(std::uint32_t quads, bool twisted) {
    Indices triangles;
    for (std::uint32_t q = 0; q < quads; ++q) {
        const bool last = q + 1 == quads;
        const std::uint32_t low = last ? (twisted ? 1 : 0) : 2 * q + 2;
        const std::uint32_t high = last ? (twisted ? 0 : 1) : 2 * q + 3;
        triangles.push_back({2 * q, low, high});
        triangles.push_back({2 * q, high, 2 * q + 1});
    }
    return with_any_positions(2 * quads, std::move(triangles));
}

/// A grid of `rings` rings of `sides` points that closes both ways; with `mirrored` the last ring
/// joins the first in reverse, which makes a Klein bottle of the torus.
inline MeshSource closed_grid(std::uint32_t rings, std::uint32_t sides, bool mirrored) {
    Indices triangles;
    const auto vertex = [&](std::uint32_t r, std::uint32_t s) {
        const bool reversed = mirrored && r == rings;
        return r % rings * sides + (reversed ? (sides - s % sides) % sides : s % sides);
    };
    for (std::uint32_t r = 0; r < rings; ++r)
        for (std::uint32_t s = 0; s < sides; ++s) {
            triangles.push_back({vertex(r, s), vertex(r, s + 1), vertex(r + 1, s + 1)});
            triangles.push_back({vertex(r, s), vertex(r + 1, s + 1), vertex(r + 1, s)});
        }
    return with_any_positions(rings * sides, std::move(triangles));
}

/// The source with its vertices and faces in another order, and faces beginning at another corner.
inline MeshSource shuffled(const MeshSource& source, std::uint64_t seed) {
    Random random(seed);
    std::vector<std::uint32_t> place(source.positions.size());
    for (std::uint32_t v = 0; v < place.size(); ++v) place[v] = v;
    random.shuffle(place);
    MeshSource result = source;
    for (std::uint32_t v = 0; v < place.size(); ++v)
        result.positions[place[v]] = source.positions[v];
    for (auto& t : result.triangles) {
        const std::uint32_t turn = random.below(3);
        t = {place[t[turn]], place[t[(turn + 1) % 3]], place[t[(turn + 2) % 3]]};
    }
    random.shuffle(result.triangles);
    return result;
}

}  // namespace rimline::tests
