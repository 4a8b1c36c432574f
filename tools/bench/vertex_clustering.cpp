#include "tools/bench/vertex_clustering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <unordered_map>
#include <vector>

namespace rimline::tools {

namespace {

constexpr std::uint32_t k_max_cells = 1u << 16;

// One a vertex: the number of its cell in a grid with `cells` along the longest side.
std::vector<std::uint64_t> cells_of_vertices(const Mesh& mesh, std::uint32_t cells) {
    const glm::dvec3 low(mesh.bounds().low);
    const glm::dvec3 size = glm::dvec3(mesh.bounds().high) - low;
    double longest = std::max({size.x, size.y, size.z});
    if (longest == 0.0) longest = 1.0;  // All vertices coincide: one cell.
    std::vector<std::uint64_t> cell_of;
    cell_of.reserve(mesh.vertex_count());
    for (const glm::vec3& position : mesh.positions()) {
        std::uint64_t cell = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double share = (double{position[axis]} - low[axis]) / longest;
            const auto step = static_cast<std::uint64_t>(share * cells);
            cell = cell * k_max_cells + std::min<std::uint64_t>(step, cells - 1);
        }
        cell_of.push_back(cell);
    }
    return cell_of;
}

bool survives(const Triangle& triangle, const std::vector<std::uint64_t>& cell_of) {
    const std::uint64_t a = cell_of[index(triangle[0])];
    const std::uint64_t b = cell_of[index(triangle[1])];
    const std::uint64_t c = cell_of[index(triangle[2])];
    return a != b && b != c && c != a;
}

std::uint32_t faces_left(const Mesh& mesh, std::uint32_t cells) {
    const std::vector<std::uint64_t> cell_of = cells_of_vertices(mesh, cells);
    return static_cast<std::uint32_t>(
        std::count_if(mesh.triangles().begin(), mesh.triangles().end(),
                      [&](const Triangle& triangle) { return survives(triangle, cell_of); }));
}

}  // namespace

MeshSource cluster_vertices(const Mesh& mesh, std::uint32_t max_faces) {
    MeshSource source;
    source.up = mesh.up();
    if (mesh.face_count() == 0) return source;

    // One cell leaves no face. The number of faces grows with the grid, up to a few faces.
    std::uint32_t fits = 1;
    std::uint32_t too_fine = k_max_cells + 1;
    while (too_fine - fits > 1) {
        const std::uint32_t cells = fits + (too_fine - fits) / 2;
        (faces_left(mesh, cells) <= max_faces ? fits : too_fine) = cells;
    }

    const std::vector<std::uint64_t> cell_of = cells_of_vertices(mesh, fits);
    std::unordered_map<std::uint64_t, std::uint32_t> number_of_cell;
    std::vector<std::uint32_t> number_of;  // One a vertex.
    std::vector<glm::dvec3> sums;
    std::vector<double> counts;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        const auto [place, is_new] =
            number_of_cell.try_emplace(cell_of[v], static_cast<std::uint32_t>(sums.size()));
        if (is_new) {
            sums.emplace_back(0.0);
            counts.push_back(0.0);
        }
        number_of.push_back(place->second);
        sums[place->second] += glm::dvec3(mesh.positions()[v]);
        counts[place->second] += 1.0;
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
        source.positions.push_back(glm::vec3(sums[i] / counts[i]));
    for (const Triangle& triangle : mesh.triangles())
        if (survives(triangle, cell_of))
            source.triangles.push_back({number_of[index(triangle[0])],
                                        number_of[index(triangle[1])],
                                        number_of[index(triangle[2])]});
    return source;
}

}  // namespace rimline::tools
