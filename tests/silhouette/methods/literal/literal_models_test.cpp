// The literal octree and both of its updates on real models.

#include <doctest/doctest.h>

#include "silhouette/mesh/formats/mesh_file.h"
#include "tests/models.h"
#include "tests/silhouette/hough/test_size.h"
#include "tests/silhouette/methods/literal/literal_walk.h"
#include "tests/skip.h"

namespace rimline {
namespace {

#define RIMLINE_MODEL_CASE(file)                                                    \
    TEST_CASE("the literal updates equal brute force on " file) {                   \
        const auto path = tests::find_model(file);                                  \
        if (!path) RIMLINE_SKIP("RIMLINE_MODELS names no folder that holds " file); \
        const Mesh mesh(read_mesh_file(*path));                                     \
        const LiteralOctree octree(mesh);                                           \
        const std::uint32_t moves = tests::model_count(100);                        \
        MESSAGE(moves << " moves each");                                            \
        for (const LiteralUpdate update :                                           \
             {LiteralUpdate::full_traversal, LiteralUpdate::incremental})           \
            tests::check_literal_walk(octree, {update}, moves, 121);                \
    }

RIMLINE_MODEL_CASE("fandisk.obj")
RIMLINE_MODEL_CASE("igea.ply")
RIMLINE_MODEL_CASE("nefertiti.obj")
RIMLINE_MODEL_CASE("stanford-bunny.obj")

}  // namespace
}  // namespace rimline
