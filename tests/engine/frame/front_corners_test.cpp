#include "engine/frame/front_corners.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline {
namespace {

TEST_CASE("the corners of fronts are those of all faces that a camera may see, each face whole") {
    for (const char* shape : {"knot", "box", "sphere"}) {
        const Mesh mesh(make_built_in_shape(shape, 4'000));
        for (const glm::vec3& eye :
             {glm::vec3(3, 1, 2), glm::vec3(-0.2f, 4, 0.1f), glm::vec3(0, 0, -900)})
            for (const bool is_direction : {false, true}) {
                CAPTURE(shape);
                CAPTURE(eye.x);
                CAPTURE(is_direction);
                const HomogeneousPoint camera = is_direction ? HomogeneousPoint::direction(eye)
                                                             : HomogeneousPoint::viewpoint(eye);
                std::vector<std::uint32_t> corners(3 * mesh.face_count());
                corners.resize(put_front_corners(mesh, camera, corners));
                REQUIRE(corners.size() % 3 == 0);
                std::vector<std::uint8_t> is_listed(mesh.face_count());
                for (std::size_t i = 0; i < corners.size(); i += 3) {
                    REQUIRE(corners[i] % 3 == 0);
                    CHECK(corners[i + 1] == corners[i] + 1);
                    CHECK(corners[i + 2] == corners[i] + 2);
                    is_listed[corners[i] / 3] = 1;
                }
                CHECK(std::ranges::is_sorted(corners));
                for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
                    const Plane& plane = mesh.plane(FaceId{f});
                    const double side = glm::dot(plane.normal(), glm::dvec3(camera.xyz())) -
                                        double{camera.w} * double{plane.d};
                    if (side >= 0.0) CHECK(is_listed[f] != 0);
                    if (side < -1e-4 * glm::length(glm::dvec3(camera.xyz())))
                        CHECK(is_listed[f] == 0);
                }
            }
    }
}

}  // namespace
}  // namespace rimline
