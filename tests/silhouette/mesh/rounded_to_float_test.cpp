#include "silhouette/mesh/rounded_to_float.h"

#include <doctest/doctest.h>

#include <vector>

namespace rimline {
namespace {

TEST_CASE("points are rounded to float, all three coordinates of them") {
    std::vector<glm::dvec3> points;
    for (int i = 1; i < 8; ++i) points.push_back(glm::dvec3(0.1, 0.7, 0.3) * double(i) / 9.0);
    for (const glm::dvec3& point : points) {
        const std::vector<glm::dvec3> rounded{rounded_to_float(point)};
        for (int axis = 0; axis < 3; ++axis) {
            const volatile float expected = static_cast<float>(point[axis]);
            CHECK(rounded[0][axis] == double{expected});
            CHECK(rounded[0][axis] != point[axis]);
        }
    }
}

}  // namespace
}  // namespace rimline
