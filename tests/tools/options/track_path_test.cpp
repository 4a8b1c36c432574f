#include "tools/options/track_path.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stop_token>
#include <string>

#include "silhouette/error.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/tools/scratch_folder.h"
#include "tools/command.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

std::string refusal(const tests::ScratchFolder& folder, const std::string& text) {
    const std::string name = (folder / "path.txt").string();
    tests::write_bytes(name, text);
    try {
        read_path(name, {});
    } catch (const Error& e) {
        CHECK(e.code() == ErrorCode::bad_input);
        const std::string message = e.what();
        CHECK(message.find(name + ":") == 0);
        return message.substr(name.size());
    }
    return {};
}

}  // namespace

TEST_CASE("an orbit starts on its first axis, keeps its radius and closes") {
    const Mesh mesh(make_built_in_shape("torus", 500));
    const auto points = orbit_path(mesh, {0, 1, 0}, 2.0, 45.0, 9);
    REQUIRE(points.size() == 9);
    const glm::dvec3 first = glm::dvec3(points[0].xyz()) - mesh.center();
    CHECK(first.x == doctest::Approx(2.0 * mesh.radius()));
    for (const HomogeneousPoint& point : points) {
        CHECK(glm::distance(glm::dvec3(point.xyz()), mesh.center()) ==
              doctest::Approx(2.0 * mesh.radius()));
        CHECK(double{point.y} == doctest::Approx(mesh.center().y));
    }
    CHECK(glm::distance(points[0].xyz(), points[8].xyz()) < 1e-5f * float(mesh.radius()));
    CHECK(glm::distance(points[0].xyz(), points[1].xyz()) ==
          doctest::Approx(4.0 * mesh.radius() * std::sin(std::acos(-1.0) / 8.0)));
}

TEST_CASE("an orbit beyond the range of coordinates is refused") {
    MeshSource source;
    source.positions = {{0, 0, 0}, {0x1p59f, 0, 0}, {0, 0x1p59f, 0}};
    source.triangles = {{0, 1, 2}};
    const Mesh mesh(source);
    CHECK_NOTHROW(orbit_path(mesh, {0, 1, 0}, 0.5, 1.0, 360));
    CHECK_THROWS_AS(orbit_path(mesh, {0, 1, 0}, 5.0, 1.0, 360), UsageError);
}

TEST_CASE("a random path mixes jumps, small steps, returns, vertices and directions") {
    const Mesh mesh(make_built_in_shape("knot", 500));
    const auto points = random_path(mesh, 3, 2000);
    REQUIRE(points.size() == 2000);
    std::size_t directions = 0, jumps = 0, small_steps = 0, returns = 0, vertices = 0, still = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const HomogeneousPoint& p = points[i];
        directions += p.is_direction();
        vertices += std::ranges::count(mesh.positions(), p.xyz()) > 0;
        still += p == points[i - 1];
        returns += std::find(points.begin(), points.begin() + std::ptrdiff_t(i), p) !=
                   points.begin() + std::ptrdiff_t(i);
        if (p.is_direction() || points[i - 1].is_direction()) continue;
        const double step = glm::distance(glm::dvec3(p.xyz()), glm::dvec3(points[i - 1].xyz()));
        jumps += step > mesh.radius();
        small_steps += step > 0.0 && step < 1e-2 * mesh.radius();
    }
    for (const std::size_t count : {directions, jumps, small_steps, returns, vertices, still})
        CHECK(count >= 50);
    CHECK(random_path(mesh, 3, 2000) == points);
    CHECK(random_path(mesh, 4, 2000) != points);
}

TEST_CASE("a file of points is read line by line") {
    const tests::ScratchFolder folder;
    tests::write_bytes(folder / "path.txt", "# a path\n1 2 3\n\n  4\t5 6 1\r\n0 0 -1 0\n7 8 9");
    const auto points = read_path((folder / "path.txt").string(), {});
    REQUIRE(points.size() == 4);
    CHECK(points[0] == HomogeneousPoint::viewpoint({1, 2, 3}));
    CHECK(points[1] == HomogeneousPoint::viewpoint({4, 5, 6}));
    CHECK(points[2] == HomogeneousPoint::direction({0, 0, -1}));
    CHECK(points[3] == HomogeneousPoint::viewpoint({7, 8, 9}));
}

TEST_CASE("blanks, a comma or both stand between the numbers of a point, and comments anywhere") {
    const tests::ScratchFolder folder;
    for (const char* line :
         {"1,2,3", "1, 2, 3", "1 , 2 ,3", "1,2 3", "+1,2,+3", "1,2,3,1", "  # indented\n1 2 3",
          "1 2 3 # behind", "1,2,3# close behind", "1 2 3\r# old Mac",
          "\xef\xbb\xbf"
          "1,2,3\r\n"}) {
        CAPTURE(line);
        tests::write_bytes(folder / "path.txt", line);
        const auto points = read_path((folder / "path.txt").string(), {});
        REQUIRE(points.size() == 1);
        CHECK(points[0] == HomogeneousPoint::viewpoint({1, 2, 3}));
    }
}

TEST_CASE("a path that is no regular file is refused at once, without waiting for a writer") {
    const tests::ScratchFolder folder;
    const std::string pipe = (folder / "pipe").string();
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    for (const std::string& name : {pipe, std::string("/dev/zero"), (folder / "").string()}) {
        CAPTURE(name);
        try {
            read_path(name, {});
            FAIL("it was read");
        } catch (const Error& e) {
            CHECK(e.code() == ErrorCode::io);
            CHECK(std::string(e.what()).starts_with(name + ": "));
        }
    }
}

TEST_CASE("reading a file of points stops when asked to") {
    const tests::ScratchFolder folder;
    tests::write_bytes(folder / "path.txt", "1 2 3\n");
    std::stop_source source;
    source.request_stop();
    try {
        read_path((folder / "path.txt").string(), {source.get_token(), {}});
        FAIL("it went on");
    } catch (const Error& e) {
        CHECK(e.code() == ErrorCode::cancelled);
    }
}

TEST_CASE("a file of points that is not one is refused by line") {
    const tests::ScratchFolder folder;
    for (const char* line :
         {"1 2",      "1",        "1 2 3 1 5", "1 2 x",     "1,,2,3",  ",1,2,3",
          "1,2,3,",   "1,2,3,1,", "1,2 , ,3",  ",",         "1;2;3",   "+-1 2 3",
          "1 2 nan",  "1 inf 3",  "1 2 3 2",   "1 2 3 0.5", "0 0 0 0", "1e-30 0 0 0",
          "1e19 0 0", "1 2 # 3",  "1e400 0 0"}) {
        CAPTURE(line);
        CHECK(refusal(folder, std::string("1 2 3\n") + line + "\n4 5 6\n").find(":2: ") == 0);
    }
    CHECK(refusal(folder, "").find("no points") != std::string::npos);
    CHECK(refusal(folder, "# nothing\n\n").find("no points") != std::string::npos);
    CHECK_THROWS_AS(read_path((folder / "gone.txt").string(), {}), Error);
}
