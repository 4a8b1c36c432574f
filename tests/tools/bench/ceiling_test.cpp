#include "tools/bench/ceiling.h"

#include <doctest/doctest.h>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tools/options/track_path.h"

namespace rimline::tools {
namespace {

TEST_CASE("brute force that takes more than twice as long as the plain loop is a defect") {
    CHECK_FALSE(brute_force_ceiling(k_min_ceiling_faces - 1, 1.0, 9.0).has_value());
    CHECK(brute_force_ceiling(k_min_ceiling_faces, 100.0, 90.0)->ceiling_us ==
          doctest::Approx(200.0));
    CHECK_FALSE(brute_force_ceiling(k_min_ceiling_faces, 100.0, 199.0)->is_defect());
    CHECK(brute_force_ceiling(k_min_ceiling_faces, 100.0, 201.0)->is_defect());
}

TEST_CASE("the plain loop counts front faces and edges") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    const PlainLoop plain(mesh);
    for (const HomogeneousPoint& point : random_path(mesh, 3, 50)) {
        std::uint32_t front = 0, edges = 0;
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
            front += is_front(mesh.plane(FaceId{f}), point) ? 1u : 0u;
        CHECK(plain.count_front(point) == front);
        for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
            edges += index(mesh.faces_of(EdgeId{e})[0]) < front ? 1u : 0u;
        CHECK(plain.count_edges(front) == edges);
    }
}

}  // namespace
}  // namespace rimline::tools
