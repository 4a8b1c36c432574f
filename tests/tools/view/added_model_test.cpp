#include "tools/view/added_model.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/mesh/ground_axes.h"
#include "tests/tools/scratch_folder.h"
#include "tools/view/view_arguments.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

const BeginCall k_silent = [](const std::string&) { return LongCall{}; };

// Of the corners of the faces in [first, last).
Bounds bounds_of_faces(const Mesh& mesh, std::size_t first, std::size_t last) {
    Bounds bounds{glm::vec3(1e30f), glm::vec3(-1e30f)};
    for (std::size_t f = first; f < last; ++f)
        for (const VertexId v : mesh.triangles()[f]) {
            bounds.low = glm::min(bounds.low, mesh.positions()[index(v)]);
            bounds.high = glm::max(bounds.high, mesh.positions()[index(v)]);
        }
    return bounds;
}

Document opened(std::span<const PlacedModel> models, const glm::dvec3& up) {
    return open_view(view_arguments(models, up), k_silent).view.document;
}

}  // namespace

TEST_CASE("a model that is added stands to the right of the others, on the same ground") {
    for (const glm::dvec3& up : {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0)}) {
        const std::vector<PlacedModel> one{{.model = "shape:torus:2000"}};
        const Document before = opened(one, up);
        const Mesh& scene = before.model()->mesh();
        const std::vector<PlacedModel> models =
            place_added({.models = one,
                         .added = {"shape:box", "shape:sphere:500"},
                         .up = up,
                         .towards_viewer = -ground_axes(up).second,
                         .positions = scene.positions()},
                        k_silent);
        REQUIRE(models.size() == 3);
        CHECK(models[0] == one[0]);
        const Document after = opened(models, up);
        const Mesh& all = after.model()->mesh();
        const std::size_t torus = scene.face_count(), box = torus + 12;
        REQUIRE(all.face_count() > box);
        CHECK(after.model()->models() == models);
        const std::array<Bounds, 3> boxes{bounds_of_faces(all, 0, torus),
                                          bounds_of_faces(all, torus, box),
                                          bounds_of_faces(all, box, all.face_count())};
        const auto left = [](const Bounds& b) { return b.low.x; };
        const auto right = [](const Bounds& b) { return b.high.x; };
        const auto base = [&](const Bounds& b) {
            return std::min(glm::dot(glm::vec3(up), b.low), glm::dot(glm::vec3(up), b.high));
        };
        for (std::size_t i = 1; i < 3; ++i) {
            CHECK(left(boxes[i]) > right(boxes[i - 1]));
            CHECK(left(boxes[i]) < right(boxes[i - 1]) + 2.0f);
            CHECK(base(boxes[i]) == doctest::Approx(base(boxes[0])).epsilon(1e-5));
        }
    }
}

TEST_CASE("what is to the right depends on where the viewer is") {
    const std::vector<PlacedModel> one{{.model = "shape:box"}};
    const Document before = opened(one, {0, 1, 0});
    const auto place_for = [&](const glm::dvec3& towards_viewer) {
        return place_added({.models = one,
                            .added = {"shape:box"},
                            .up = {0, 1, 0},
                            .towards_viewer = towards_viewer,
                            .positions = before.model()->mesh().positions()},
                           k_silent)[1]
            .at;
    };
    CHECK(place_for({0.3, 0.5, 1}).x > 1.0f);
    CHECK(place_for({0.3, -0.5, -1}).x < -1.0f);
    CHECK(place_for({2, 0.5, 1}).z < -1.0f);
    CHECK(place_for({-2, 0.5, 1}).z > 1.0f);
    CHECK(glm::length(place_for({0, 1, 0})) > 1.0f);
}

TEST_CASE("a model that is much larger or smaller is added at the size of the others") {
    tests::ScratchFolder folder;
    const std::string large = (folder / "large.obj").string();
    std::ofstream(large) << "v 0 0 0\nv 3000 0 0\nv 0 4000 0\nv 0 0 1000\n"
                            "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    const std::vector<PlacedModel> one{{.model = "shape:box"}};
    const Document before = opened(one, {0, 1, 0});
    const std::vector<PlacedModel> models =
        place_added({.models = one,
                     .added = {large, "shape:box"},
                     .up = {0, 1, 0},
                     .positions = before.model()->mesh().positions()},
                    k_silent);
    CHECK(models[1].scale < 0.01);
    CHECK(models[2].scale == 1.0);
    const Document after = opened(models, {0, 1, 0});
    const Bounds box = bounds_of_faces(after.model()->mesh(), 12, 16);
    const Bounds first = bounds_of_faces(after.model()->mesh(), 0, 12);
    CHECK(glm::distance(box.low, box.high) ==
          doctest::Approx(glm::distance(first.low, first.high)).epsilon(1e-4));
}

TEST_CASE("a model stays as it was turned when it becomes the first of the scene") {
    for (const glm::dvec3& up : {glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0)}) {
        const std::vector<PlacedModel> both{{.model = "shape:box"},
                                            {.model = "shape:knot:800", .at = {3, 1, -2}}};
        const Document before = opened(both, up);
        const std::vector<PlacedModel> one{both[1]};
        const std::vector<PlacedModel> kept =
            place_added({.models = one, .up = up, .has_new_first = true}, k_silent);
        REQUIRE(kept.size() == 1);
        // Built-in shapes stand along y.
        CHECK(kept[0].up.has_value() == (up.y == 0.0));
        const auto bounds_of_knot = [](const Document& document, std::size_t first) {
            const Mesh& mesh = document.model()->mesh();
            return bounds_of_faces(mesh, first, mesh.face_count());
        };
        const Bounds was = bounds_of_knot(before, 12), is = bounds_of_knot(opened(kept, up), 0);
        CHECK(is.low == was.low);
        CHECK(is.high == was.high);
        // As it would lie otherwise.
        const Bounds fallen = bounds_of_knot(opened(one, up), 0);
        CHECK((fallen.high == was.high) == (up.y == 1.0));
    }
}
