// The real models, against the counts their collection's notes give.

#include <chrono>

#include "silhouette/mesh/mesh.h"
#include "tests/models.h"
#include "tests/silhouette/mesh/formats/scratch_file.h"
#include "tests/skip.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

struct Known {
    const char* name;
    std::size_t file_vertices, faces;
    std::uint32_t border_edges;
    bool closed;
};

void check_model(const Known& known) {
    const auto path = find_model(known.name);
    if (!path) RIMLINE_SKIP(std::string("no ") + known.name + " in RIMLINE_MODELS");
    const auto begin = std::chrono::steady_clock::now();
    const MeshSource source = read_mesh_file(*path);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
    MESSAGE(std::string(known.name) << ": read in " << time.count() << " ms");
    CHECK(source.positions.size() == known.file_vertices);
    CHECK(source.triangles.size() == known.faces);
    CHECK(is_sound(source));
    const Mesh mesh(source);
    CHECK(mesh.edges_of_class(EdgeClass::border).size() == known.border_edges);
    CHECK(mesh.is_closed() == known.closed);
    CHECK(mesh.is_oriented());
}

}  // namespace

TEST_CASE("The bunny is read whole") {
    check_model({"stanford-bunny.obj", 35947, 69451, 223, false});
    if (const auto path = find_model("stanford-bunny.obj"))
        CHECK(Mesh(read_mesh_file(*path)).vertex_count() == 34834);
}
TEST_CASE("Igea, one triangle strip, is read whole") {
    check_model({"igea.ply", 134345, 268686, 0, true});
}
TEST_CASE("The horse is read whole") { check_model({"horse.ply", 48485, 96966, 0, true}); }
TEST_CASE("Nefertiti is read whole") { check_model({"nefertiti.obj", 49971, 99938, 0, true}); }
TEST_CASE("The fandisk is read whole") { check_model({"fandisk.obj", 6475, 12946, 0, true}); }
TEST_CASE("The rocker arm is read whole") {
    check_model({"rocker-arm.obj", 10044, 20088, 0, true});
}
TEST_CASE("The beetle is read whole") {
    check_model({"beetle-alt.obj", 19887, 38656, 1136, false});
}
TEST_CASE("The ogre is read whole") {
    // 236 border edges by the file's indices; 9 pairs of its vertices lie at the same place.
    check_model({"ogre.obj", 62194, 124008, 200, false});
    if (const auto path = find_model("ogre.obj"))
        CHECK(Mesh(read_mesh_file(*path)).component_count() == 44);
}
TEST_CASE("The alligator is read whole") { check_model({"alligator.obj", 3208, 5981, 433, false}); }
