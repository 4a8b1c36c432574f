// The octree and the tracker on real models, each a case of its own.

#include <doctest/doctest.h>

#include "silhouette/mesh/formats/mesh_file.h"
#include "tests/models.h"
#include "tests/silhouette/hough/against_brute_force.h"
#include "tests/silhouette/hough/test_size.h"
#include "tests/skip.h"

namespace rimline {
namespace {

#define RIMLINE_MODEL_CASE(file)                                                    \
    TEST_CASE("extraction and moves equal brute force on " file) {                  \
        const auto path = tests::find_model(file);                                  \
        if (!path) RIMLINE_SKIP("RIMLINE_MODELS names no folder that holds " file); \
        const Mesh mesh(read_mesh_file(*path));                                     \
        const HoughOctree octree(mesh);                                             \
        const std::uint32_t points = tests::model_count(1000);                      \
        const std::uint32_t moves = tests::model_count(400);                        \
        MESSAGE(points << " points, " << moves << " moves");                        \
        tests::check_extraction(octree, points, 71);                                \
        tests::check_walk(octree, moves, 72);                                       \
    }

RIMLINE_MODEL_CASE("alligator.obj")
RIMLINE_MODEL_CASE("beetle-alt.obj")
RIMLINE_MODEL_CASE("fandisk.obj")
RIMLINE_MODEL_CASE("horse.ply")
RIMLINE_MODEL_CASE("igea.ply")
RIMLINE_MODEL_CASE("nefertiti.obj")
RIMLINE_MODEL_CASE("ogre.obj")
RIMLINE_MODEL_CASE("rocker-arm.obj")
RIMLINE_MODEL_CASE("stanford-bunny.obj")

}  // namespace
}  // namespace rimline
