#include "tools/bench/ceiling.h"

#include <doctest/doctest.h>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tools/bench/targets.h"
#include "tools/options/track_path.h"

namespace rimline::tools {
namespace {

TEST_CASE("the ceiling grows with the plain loop and is a verdict with AVX-512 alone") {
    CHECK_FALSE(brute_force_ceiling(1000, "AVX-512", 1.0, 1.0).has_value());
    CHECK(brute_force_ceiling(k_igea_faces, "AVX-512", 137.0, 400.0)->ceiling_us ==
          doctest::Approx(1.25 * 330.0));
    CHECK(brute_force_ceiling(k_bunny_faces, "AVX-512", 28.0, 100.0)->ceiling_us ==
          doctest::Approx(2.0 * 1.25 * 63.0));
    CHECK(brute_force_ceiling(k_igea_faces, "AVX-512", 137.0, 412.0)->verdict() == "ok");
    CHECK(brute_force_ceiling(k_igea_faces, "AVX-512", 137.0, 413.0)->verdict() == "defect");
    CHECK(brute_force_ceiling(k_igea_faces, "AVX2", 137.0, 413.0)->verdict() == "unknown");
    CHECK(brute_force_ceiling(k_igea_faces, "AVX2", 137.0, 412.0)->verdict() == "ok");
}

TEST_CASE("the plain loop counts the faces that brute force finds to be front") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    const PlainLoop plain(mesh);
    for (const HomogeneousPoint& point : random_path(mesh, 3, 50)) {
        std::uint32_t front = 0;
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
            front += is_front(mesh.plane(FaceId{f}), point) ? 1u : 0u;
        CHECK(plain.count_front(point) == front);
    }
}

}  // namespace
}  // namespace rimline::tools
