#include "silhouette/points/point_cloud.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <tuple>

#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

using namespace rimline;

namespace {

std::vector<std::uint32_t> list(std::span<const std::uint32_t> numbers) {
    return {numbers.begin(), numbers.end()};
}

}  // namespace

TEST_CASE("Of equal positions the first stands for all, with its normal and color") {
    PointSource source;
    source.positions = {{1, 0, 0}, {0.0, 2, 0}, {1, 0, 0}, {-0.0, 2, 0}, {1, 0, 1e-300}};
    source.normals = {{0, 0, 3}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, -2, 0}};
    source.colors = {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}, {5, 5, 5}};
    source.intensities = {-1.0f, 2.0f, 3.0f, 4.0f, 5.5f};
    const PointCloud cloud(source);
    CHECK(cloud.size() == 3);
    CHECK(list(cloud.file_points()) == std::vector<std::uint32_t>{0, 1, 4});
    CHECK(cloud.file_point_count() == 5);
    CHECK(cloud.duplicate_count() == 2);
    CHECK(cloud.dropped_count() == 0);
    CHECK(cloud.normals()[0] == glm::vec3(0, 0, 1));
    CHECK(cloud.normals()[1] == glm::vec3(0, 0, 0));
    CHECK(cloud.normals()[2] == glm::vec3(0, -1, 0));
    CHECK(cloud.colors()[2] == PointColor{5, 5, 5});
    CHECK(std::ranges::equal(cloud.intensities(), std::array{-1.0f, 2.0f, 5.5f}));
}

TEST_CASE("Positions that are not finite are left out and counted") {
    PointSource source;
    source.positions = {{NAN, 0, 0}, {1, 2, 3}, {0, INFINITY, 0}, {1, 2, 3}, {0, 0, -INFINITY}};
    const PointCloud cloud(source);
    CHECK(cloud.size() == 1);
    CHECK(cloud.dropped_count() == 3);
    CHECK(cloud.duplicate_count() == 1);
    CHECK(cloud.file_point(0) == 1);
    CHECK(cloud.center() == glm::dvec3(1, 2, 3));
    CHECK(cloud.radius() == 0.0);
}

TEST_CASE("No points, and none that can be used, are an empty cloud") {
    CHECK(PointCloud(PointSource{}).size() == 0);
    PointSource source;
    source.positions = {{NAN, NAN, NAN}};
    source.triangles = {{0, 0, 0}};
    const PointCloud cloud(source);
    CHECK(cloud.size() == 0);
    CHECK(cloud.triangles().empty());
    CHECK(cloud.radius() == 0.0);
}

TEST_CASE("Of a mesh the points are the vertices that faces use, and its borders are known") {
    PointSource source;
    source.positions = {{9, 9, 9}, {0, 0, 0},     {1, 0, 0}, {1, 1, 0},
                        {0, 1, 0}, {0.5, 0.5, 0}, {1, 0, 0}};
    // A fan around 5, closed but for one triangle, one corner of which is split in two.
    source.triangles = {{5, 1, 2}, {5, 6, 3}, {5, 3, 4}, {3, 3, 4}};
    const PointCloud cloud(source);
    CHECK(cloud.size() == 5);
    CHECK(cloud.unused_count() == 1);
    CHECK(cloud.duplicate_count() == 1);
    CHECK(cloud.triangles().size() == 3);
    CHECK(list(cloud.file_points()) == std::vector<std::uint32_t>{1, 2, 3, 4, 5});
    CHECK(cloud.mesh_border_points() == std::vector<std::uint32_t>{0, 1, 2, 3, 4});
}

TEST_CASE("Border points are those of the mesh's own border edges") {
    for (const char* name : {"terrain", "sphere", "scene", "spring"}) {
        CAPTURE(name);
        const MeshSource mesh_source = make_built_in_shape(name, 3000);
        const Mesh mesh(mesh_source);
        std::vector<std::uint32_t> expected;
        const Mesh::EdgeRange borders = mesh.edges_of_class(EdgeClass::border);
        for (std::uint32_t e = borders.first; e < borders.last; ++e)
            for (const VertexId v : mesh.edge(EdgeId{e}).vertices)
                expected.push_back(mesh.file_vertex(v));
        std::ranges::sort(expected);
        expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
        const PointCloud cloud(points_of(mesh_source));
        std::vector<std::uint32_t> found;
        for (const std::uint32_t p : cloud.mesh_border_points())
            found.push_back(cloud.file_point(p));
        CHECK(found == expected);
        CHECK(cloud.size() == mesh.vertex_count());
        CHECK(cloud.center() == mesh.center());
        CHECK(cloud.radius() == mesh.radius());
    }
}

TEST_CASE("A million positions on a small lattice are merged as sorting them would") {
    PointSource source;
    std::mt19937 random(5);
    std::uniform_int_distribution<int> coordinate(-40, 40);
    for (int i = 0; i < 1'000'000; ++i)
        source.positions.emplace_back(1e6 + 1e-3 * coordinate(random), 1e-3 * coordinate(random),
                                      coordinate(random));
    std::vector<glm::dvec3> sorted = source.positions;
    const auto less = [](const glm::dvec3& a, const glm::dvec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::ranges::sort(sorted, less);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    const PointCloud cloud(source);
    CHECK(cloud.size() == sorted.size());
    CHECK(cloud.duplicate_count() == 1'000'000 - sorted.size());
    std::vector<glm::dvec3> found(cloud.positions().begin(), cloud.positions().end());
    std::ranges::sort(found, less);
    CHECK(found == sorted);
}
