#include "silhouette/mesh/homogeneous_point.h"

#include <doctest/doctest.h>
#include <cmath>

namespace rimline {

TEST_CASE("a viewpoint has w 1, a direction w 0") {
    const HomogeneousPoint point = HomogeneousPoint::viewpoint({1, 2, 3});
    CHECK(point.w == 1.0f);
    CHECK_FALSE(point.is_direction());
    CHECK(point.xyz() == glm::vec3(1, 2, 3));
    const HomogeneousPoint direction = HomogeneousPoint::direction({1, 2, 3});
    CHECK(direction.w == 0.0f);
    CHECK(direction.is_direction());
    CHECK(direction.xyz() == glm::vec3(1, 2, 3));
    CHECK_FALSE(point == direction);
}

TEST_CASE("components below the limit are zero, those at it stay") {
    const float below = std::nextafter(k_min_point_component, 0.0f);
    const glm::vec3 p{below, -below, 0x1p-149f};
    CHECK(HomogeneousPoint::viewpoint(p) == HomogeneousPoint::viewpoint({0, 0, 0}));
    CHECK(HomogeneousPoint::direction(p) == HomogeneousPoint::direction({0, 0, 0}));
    const glm::vec3 at{k_min_point_component, -k_min_point_component, 0};
    CHECK(HomogeneousPoint::viewpoint(at).xyz() == at);
    CHECK(HomogeneousPoint::direction(at).xyz() == at);
}

TEST_CASE("the largest coordinates are taken as they are") {
    const glm::vec3 p{k_max_coordinate, -k_max_coordinate, 0};
    CHECK(HomogeneousPoint::viewpoint(p).xyz() == p);
}

}  // namespace rimline
