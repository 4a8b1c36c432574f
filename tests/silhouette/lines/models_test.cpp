// Line drawings of real models against the oracle, each model a case of its own.

#include <doctest/doctest.h>

#include "silhouette/mesh/formats/mesh_file.h"
#include "tests/models.h"
#include "tests/silhouette/lines/against_oracle.h"
#include "tests/silhouette/lines/difficult_meshes.h"
#include "tests/skip.h"

namespace rimline {
namespace {

#define RIMLINE_LINES_CASE(file, ...)                                                \
    TEST_CASE("lines are hidden where a count of faces says on " file __VA_ARGS__) { \
        const auto path = tests::find_model(file);                                   \
        if (!path) RIMLINE_SKIP("RIMLINE_MODELS names no folder that holds " file);  \
        const Mesh mesh(read_mesh_file(*path));                                      \
        tests::check_views(mesh, tests::Cameras::around, 1, 81);                     \
        tests::check_views(mesh, tests::Cameras::axes, 1, 82);                       \
    }

RIMLINE_LINES_CASE("beetle-alt.obj")
RIMLINE_LINES_CASE("fandisk.obj")
RIMLINE_LINES_CASE("ogre.obj", *doctest::test_suite("plain"))
RIMLINE_LINES_CASE("rocker-arm.obj")
RIMLINE_LINES_CASE("stanford-bunny.obj")

// 10,000 borders, 6,000 non-manifold and 9,000 inconsistent edges.
TEST_CASE("lines of a broken bunny are hidden where a count of faces says" *
          doctest::test_suite("plain")) {
    const char* file = "stanford-bunny.obj";
    const auto path = tests::find_model(file);
    if (!path) RIMLINE_SKIP("RIMLINE_MODELS names no folder that holds stanford-bunny.obj");
    const Mesh mesh(tests::broken(read_mesh_file(*path), 15));
    CHECK(mesh.edges_of_class(EdgeClass::border).size() > 9'000);
    CHECK(mesh.edges_of_class(EdgeClass::nonmanifold).size() > 5'000);
    CHECK(mesh.edges_of_class(EdgeClass::inconsistent).size() > 8'000);
    tests::check_views(mesh, tests::Cameras::around, 1, 83, 300.0);
}

TEST_SUITE("long") {
    TEST_CASE("lines are hidden where a count of faces says on all models from 21 views") {
        bool found = false;
        for (const char* file :
             {"alligator.obj", "beetle-alt.obj", "fandisk.obj", "horse.ply", "igea.ply",
              "nefertiti.obj", "ogre.obj", "rocker-arm.obj", "stanford-bunny.obj"}) {
            const auto path = tests::find_model(file);
            if (!path) continue;
            found = true;
            CAPTURE(file);
            const Mesh mesh(read_mesh_file(*path));
            for (const std::uint64_t seed : {91u, 92u}) {
                tests::check_views(mesh, tests::Cameras::around, 18, seed);
                tests::check_views(mesh, tests::Cameras::axes, 3, seed);
            }
        }
        if (!found) RIMLINE_SKIP("RIMLINE_MODELS names no folder that holds models");
    }
}

}  // namespace
}  // namespace rimline
