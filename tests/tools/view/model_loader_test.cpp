#include "tools/view/model_loader.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include "tests/tools/scratch_folder.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

ModelLoader::Result wait_for(ModelLoader& loader) {
    for (;;) {
        if (auto result = loader.take()) return std::move(*result);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

}  // namespace

TEST_CASE("a model is opened beside its window and wakes it when it is there") {
    std::atomic<int> wakes{0};
    ModelLoader loader([&] { ++wakes; });
    CHECK_FALSE(loader.stage());
    loader.open("shape:torus:2000");
    const ModelLoader::Result result = wait_for(loader);
    REQUIRE(result.view.document.model());
    CHECK(result.error.empty());
    CHECK(result.view.document.model()->name() == "shape:torus:2000");
    CHECK(result.view.document.model()->mesh().face_count() > 500);
    CHECK(result.view.document.model()->hough_boxes().block_count() ==
          result.view.document.model()->octree().block_count());
    CHECK(wakes > 0);
    CHECK_FALSE(loader.stage());
    CHECK_FALSE(loader.take());
}

TEST_CASE("a model whose colors are missing opens with a warning") {
    tests::ScratchFolder folder;
    const std::string name = (folder / "a.obj").string();
    std::ofstream(name) << "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
    ModelLoader loader;
    loader.open(name);
    const ModelLoader::Result result = wait_for(loader);
    REQUIRE(result.view.document.model());
    REQUIRE(result.view.document.warnings().size() == 1);
    CHECK(result.view.document.warnings()[0].find("gone.mtl") != std::string::npos);
    loader.open("shape:box");
    CHECK(wait_for(loader).view.document.warnings().empty());
}

TEST_CASE("what cannot be opened is told in words that name it and the next model opens") {
    tests::ScratchFolder folder;
    const std::string broken = (folder / "broken.obj").string();
    std::ofstream(broken) << "v 0 0 0\nv 1 0 0\nf 1 2 9\n";
    ModelLoader loader;
    for (const std::string& name :
         {broken, (folder / "missing.ply").string(), std::string("shape:nonesuch")}) {
        loader.open(name);
        const ModelLoader::Result result = wait_for(loader);
        CHECK_FALSE(result.view.document);
        const std::string tail = name.substr(name.find_last_of("/:") + 1);
        CHECK_MESSAGE(result.error.find(tail) != std::string::npos, result.error);
    }
    loader.open("shape:box");
    CHECK(wait_for(loader).view.document.model());
}

TEST_CASE("a file without faces opens as a cloud and so does a model where that is asked for") {
    tests::ScratchFolder folder;
    const std::string points = (folder / "points.xyz").string();
    {
        std::ofstream out(points);
        for (int x = 0; x < 20; ++x)
            for (int y = 0; y < 20; ++y) out << x << " " << y << " " << 0.01 * x * y << "\n";
    }
    ModelLoader loader;
    loader.open(points);
    const ModelLoader::Result result = wait_for(loader);
    REQUIRE_MESSAGE(result.view.document.cloud(), result.error);
    CHECK(result.view.document.name() == points);
    CHECK(result.view.document.cloud()->surface().size() == 400);
    loader.open(std::vector<std::string>{"shape:torus:2000", "--as-points"});
    CHECK(wait_for(loader).view.document.cloud());
    std::ofstream(points) << "0 0 0\n1 1 nan\n";
    loader.open(points);
    CHECK(wait_for(loader).error.find("nan") != std::string::npos);
}

TEST_CASE(
    "a scene file opens with its camera and look, and models that have been moved as they lie") {
    tests::ScratchFolder folder;
    const std::string scene = (folder / "scene.json").string();
    std::ofstream(scene) << R"({"rimline_scene": 1, "up": "z", "models": [{"model": "shape:box"},
        {"model": "shape:sphere:500", "at": [3, 0, 0], "paint": "#c04020"}],
        "lights": [{"sun": [1, 2, 3]}],
        "cameras": {"front": {"eye": [0, -9, 2], "target": [1, 0, 0]}}, "picture": {"style": "toon"}})";
    ModelLoader loader;
    loader.open(scene);
    ModelLoader::Result result = wait_for(loader);
    REQUIRE_MESSAGE(result.view.document.model(), result.error);
    CHECK(result.kind == ModelLoader::Kind::scene);
    CHECK(result.view.camera.eye == glm::dvec3(0, -9, 2));
    CHECK(result.view.appearance.style == Style::toon);
    REQUIRE(result.view.lights.size() == 1);
    CHECK(result.view.lights[0].vector == glm::dvec3(1, 2, 3));
    CHECK_FALSE(result.view.has_chosen_sun);
    std::vector<PlacedModel> models = result.view.document.model()->models();
    REQUIRE(models.size() == 2);
    const float reach = result.view.document.model()->mesh().bounds().high.x;

    models[1].at.x += 2.0f;
    loader.arrange({.models = models, .up = {0, 0, 1}});
    const ModelLoader::Result moved = wait_for(loader);
    REQUIRE_MESSAGE(moved.view.document.model(), moved.error);
    CHECK(moved.kind == ModelLoader::Kind::arrangement);
    CHECK(moved.view.document.model()->models() == models);
    CHECK(moved.view.document.model()->mesh().bounds().high.x == doctest::Approx(reach + 2.0f));

    // No option says it.
    models[1].subdivide = 1;
    loader.arrange({.models = models, .up = {0, 0, 1}});
    const ModelLoader::Result finer = wait_for(loader);
    REQUIRE_MESSAGE(finer.view.document.model(), finer.error);
    CHECK(finer.view.document.model()->models() == models);
    CHECK(finer.view.document.model()->mesh().face_count() ==
          4 * moved.view.document.model()->mesh().face_count() - 3 * 12);

    std::ofstream(scene) << R"({"rimline_scene": 1, "models": [{"model": "shape:box", "att": 1}]})";
    loader.open(scene);
    result = wait_for(loader);
    CHECK_FALSE(result.view.document);
    CHECK_MESSAGE(result.error.find("models[0]") != std::string::npos, result.error);
    loader.open(std::vector<std::string>{"shape:box", "--nonesuch"});
    CHECK(wait_for(loader).error.find("--nonesuch") != std::string::npos);
}

TEST_CASE("opening another model drops the one before and cancelling drops all") {
    ModelLoader loader;
    for (int i = 0; i < 20; ++i) loader.open("shape:knot:200000");
    loader.open("shape:sphere:500");
    const ModelLoader::Result result = wait_for(loader);
    REQUIRE(result.view.document.model());
    CHECK(result.view.document.model()->name() == "shape:sphere:500");
    loader.open("shape:knot:200000");
    loader.cancel();
    CHECK_FALSE(loader.take());
    CHECK_FALSE(loader.stage());
}

TEST_CASE("cancelling does not wait for the load" * doctest::test_suite("plain")) {
    ModelLoader loader;
    loader.open("shape:knot:3000000");  // Takes seconds, and is not asked to stop while it is made.
    const auto start = std::chrono::steady_clock::now();
    loader.cancel();
    loader.open("shape:sphere:500");
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(1));
    const ModelLoader::Result result = wait_for(loader);
    REQUIRE(result.view.document.model());
    CHECK(result.view.document.model()->name() == "shape:sphere:500");
}
