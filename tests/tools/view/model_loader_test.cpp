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

TEST_SUITE_BEGIN("threads");

TEST_CASE("a model is opened beside its window and wakes it when it is there") {
    std::atomic<int> wakes{0};
    ModelLoader loader([&] { ++wakes; });
    CHECK_FALSE(loader.stage());
    loader.open("shape:torus:2000");
    const ModelLoader::Result result = wait_for(loader);
    REQUIRE(result.document.model());
    CHECK(result.error.empty());
    CHECK(result.document.model()->name() == "shape:torus:2000");
    CHECK(result.document.model()->mesh().face_count() > 500);
    CHECK(result.document.model()->face_tree().block_count() ==
          result.document.model()->octree().block_count());
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
    REQUIRE(result.document.model());
    REQUIRE(result.document.warnings().size() == 1);
    CHECK(result.document.warnings()[0].find("gone.mtl") != std::string::npos);
    loader.open("shape:box");
    CHECK(wait_for(loader).document.warnings().empty());
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
        CHECK_FALSE(result.document);
        const std::string tail = name.substr(name.find_last_of("/:") + 1);
        CHECK_MESSAGE(result.error.find(tail) != std::string::npos, result.error);
    }
    loader.open("shape:box");
    CHECK(wait_for(loader).document.model());
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
    REQUIRE_MESSAGE(result.document.cloud(), result.error);
    CHECK(result.document.name() == points);
    CHECK(result.document.cloud()->surface().size() == 400);
    loader.open(CloudArgument{.model = "shape:torus:2000", .as_points = true});
    CHECK(wait_for(loader).document.cloud());
    std::ofstream(points) << "0 0 0\n1 1 nan\n";
    loader.open(points);
    CHECK(wait_for(loader).error.find("nan") != std::string::npos);
}

TEST_CASE("opening another model drops the one before and cancelling drops all") {
    ModelLoader loader;
    for (int i = 0; i < 20; ++i) loader.open("shape:knot:200000");
    loader.open("shape:sphere:500");
    const ModelLoader::Result result = wait_for(loader);
    REQUIRE(result.document.model());
    CHECK(result.document.model()->name() == "shape:sphere:500");
    loader.open("shape:knot:200000");
    loader.cancel();
    CHECK_FALSE(loader.take());
    CHECK_FALSE(loader.stage());
}

TEST_SUITE_END();
