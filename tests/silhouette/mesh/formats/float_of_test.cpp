#include "silhouette/mesh/formats/float_of.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

TEST_CASE("the nearest float of a double is infinite where IEEE 754 rounds to infinity") {
    constexpr double k_max = std::numeric_limits<float>::max();
    constexpr double k_infinity = std::numeric_limits<double>::infinity();
    constexpr double k_middle = 0x1.ffffffp127;  // Between the greatest float and the next.
    for (const double value : {0.0, 1.0, 0.1, 1e-300, 0x1p-149, 3e38, k_max})
        for (const double sign : {1.0, -1.0}) {
            CHECK(float_of(sign * value) == static_cast<float>(sign * value));
            CHECK(std::signbit(float_of(sign * value)) == (sign < 0.0));
        }
    for (const double sign : {1.0, -1.0}) {
        CHECK(float_of(sign * std::nextafter(k_middle, 0.0)) == sign * k_max);
        for (const double value : {k_middle, 1e39, 1e300, k_infinity})
            CHECK(float_of(sign * value) == sign * k_infinity);
    }
    CHECK(std::isnan(float_of(std::numeric_limits<double>::quiet_NaN())));
    const glm::vec3 v = float_of(glm::dvec3(1e300, 2.0, -1e300));
    CHECK(v == glm::vec3(float(k_infinity), 2.0f, -float(k_infinity)));
}

TEST_CASE("numbers beyond the range of floats count as infinite ones") {
    const ScratchFolder folder;
    folder.write("a.mtl", "newmtl a\nKd 1e300 0 0\n");
    const std::string square = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1e300 0\nvn 1e300 0 0\n";
    const MeshSource source = read_mesh_file(
        folder.write("a.obj", "mtllib a.mtl\n" + square + "usemtl a\nf 1/1/1 2/1/1 3/1/1\n"));
    CHECK(source.triangles.size() == 1);
    REQUIRE(source.warnings.size() >= 1);
    CHECK(has(source.warnings[0], "a channel of Kd is not a finite number"));
}
