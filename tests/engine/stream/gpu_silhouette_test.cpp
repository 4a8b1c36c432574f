#include "engine/stream/gpu_silhouette.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "engine/vulkan/commands.h"
#include "shaders/silhouette_job.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/moving_face.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/models.h"
#include "tests/silhouette/hough/support/generated_meshes.h"
#include "tests/silhouette/hough/support/random_walk.h"
#include "tests/silhouette/hough/test_size.h"

namespace rimline {
namespace {

// What there is, and what changed.
struct Found {
    std::vector<std::uint32_t> words;
    std::vector<EdgeId> edges;
    std::vector<EdgeId> added, removed;
    std::vector<WordWrite> word_writes;
    std::uint32_t flips = 0;
    std::uint32_t regular = 0;
};

enum class Bits { from_planes, from_corners };

// By the rules, on the CPU; what changed is found by comparing lists.
Found expected(const Mesh& mesh, Bits bits, const HomogeneousPoint& point, const Found& before) {
    Found found;
    found.words = bits == Bits::from_planes
                      ? brute_force_face_bits(mesh, point)
                      : moving_face_bits(mesh.triangles(), mesh.positions(), point);
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
        if (is_on_silhouette(mesh, EdgeId{e}, found.words)) found.edges.push_back(EdgeId{e});
    std::ranges::set_difference(found.edges, before.edges, std::back_inserter(found.added));
    std::ranges::set_difference(before.edges, found.edges, std::back_inserter(found.removed));
    for (std::uint32_t w = 0; w < found.words.size(); ++w) {
        const std::uint32_t old = before.words.empty() ? 0 : before.words[w];
        if (found.words[w] == old) continue;
        found.word_writes.push_back({w, found.words[w]});
        found.flips += static_cast<std::uint32_t>(std::popcount(found.words[w] ^ old));
    }
    const std::uint32_t end = mesh.edges_of_class(EdgeClass::regular).last;
    found.regular = static_cast<std::uint32_t>(
        std::ranges::count_if(found.edges, [end](EdgeId edge) { return index(edge) < end; }));
    return found;
}

// A mesh on the device and one silhouette of it.
class Subject {
public:
    Subject(const DeviceContext& context, const Mesh& mesh, Bits bits)
        : context_(context),
          mesh_(mesh),
          bits_(bits),
          planes_(upload_buffer(context, mesh.planes(), "planes")),
          positions_(upload_buffer(context, mesh.positions(), "positions")),
          triangles_(upload_buffer(context, mesh.triangles(), "triangles")),
          topology_(upload_at_once(
              context, [&](UploadBatch& batch) { return SilhouetteTopology(batch, mesh); })),
          silhouette_(upload_at_once(context, [&](UploadBatch& batch) {
              return GpuSilhouette(batch, topology_,
                                   bits == Bits::from_planes
                                       ? FaceSource{.planes = planes_.address()}
                                       : FaceSource{.positions = positions_.address(),
                                                    .triangles = triangles_.address()},
                                   GpuSilhouette::Changes::listed);
          })) {}

    const GpuSilhouette& silhouette() const { return silhouette_; }

    // Reads what a run from `point` left, and compares all of it.
    void check(const HomogeneousPoint& point) {
        CAPTURE(point.x);
        CAPTURE(point.y);
        CAPTURE(point.z);
        CAPTURE(point.w);
        const Found now = expected(mesh_, bits_, point, before_);
        const auto counts = read<GpuSilhouetteCounts>(silhouette_.counts(), 1).front();
        REQUIRE(counts.silhouette == now.edges.size());
        REQUIRE(counts.regular == now.regular);
        REQUIRE(counts.added == now.added.size());
        REQUIRE(counts.removed == now.removed.size());
        REQUIRE(counts.words == now.word_writes.size());
        REQUIRE(counts.flips == now.flips);
        const auto size = static_cast<std::uint32_t>(now.edges.size());
        REQUIRE(read<std::uint32_t>(silhouette_.arguments(), 8) ==
                std::vector<std::uint32_t>{size, 1, 0, 0, 4, size, 0, 0});
        REQUIRE(read<std::uint32_t>(silhouette_.face_words(), now.words.size()) == now.words);
        REQUIRE(read<EdgeId>(silhouette_.slots(), now.edges.size()) == now.edges);
        REQUIRE(read<EdgeId>(silhouette_.added(), now.added.size()) == now.added);
        REQUIRE(read<EdgeId>(silhouette_.removed(), now.removed.size()) == now.removed);
        REQUIRE(read<WordWrite>(silhouette_.word_writes(), now.word_writes.size()) ==
                now.word_writes);
        before_ = now;
    }

    template <typename T>
    std::vector<T> read(const Buffer& buffer, std::size_t count) const {
        std::vector<T> values(count);
        read_buffer(context_, buffer, std::as_writable_bytes(std::span(values)));
        return values;
    }

private:
    const DeviceContext& context_;
    const Mesh& mesh_;
    Bits bits_;
    Buffer planes_, positions_, triangles_;
    SilhouetteTopology topology_;
    GpuSilhouette silhouette_;
    Found before_;
};

void run(const DeviceContext& context, const GpuSilhouettePass& pass,
         std::span<const SilhouetteRun> runs) {
    run_commands(context, [&](Commands commands) { pass.record(commands, runs); });
}

// Both kinds of bits, from `points` points.
void check_walk(const DeviceContext& context, const GpuSilhouettePass& pass, const Mesh& mesh,
                std::uint32_t points, std::uint64_t seed) {
    CAPTURE(seed);
    Subject planes(context, mesh, Bits::from_planes);
    Subject corners(context, mesh, Bits::from_corners);
    tests::RandomWalk walk(mesh, seed);
    for (std::uint32_t i = 0; i < points; ++i) {
        CAPTURE(i);
        const HomogeneousPoint point = walk.next();
        // Not the same point in both, so that a mix-up shows.
        const HomogeneousPoint other = walk.next();
        run(context, pass,
            std::array{SilhouetteRun{&planes.silhouette(), point},
                       SilhouetteRun{&corners.silhouette(), other}});
        planes.check(point);
        corners.check(other);
    }
}

TEST_CASE("silhouettes and change sets made on the GPU equal the CPU's on every built-in shape" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const GpuSilhouettePass pass(gpu->context());
    for (const std::string_view name : k_built_in_shapes) {
        CAPTURE(name);
        check_walk(gpu->context(), pass, Mesh(make_built_in_shape(name, 5000)), 40, 301);
    }
}

TEST_CASE("they are equal on meshes of every generated kind, far, tiny, huge and non-manifold") {
    RIMLINE_OPEN_GPU(gpu);
    const GpuSilhouettePass pass(gpu->context());
    for (std::uint32_t number = 0; number < 2 * tests::k_generated_kinds; ++number) {
        const tests::NamedSource made = tests::generated_mesh(number);
        CAPTURE(number);
        CAPTURE(made.name);
        check_walk(gpu->context(), pass, Mesh(made.source), 15, number);
    }
}

TEST_CASE("dispatches cut into rows and scans of many rounds give the same" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    // More groups of 2048 edges than the 128 that the scan sums in a round.
    const Mesh mesh(make_built_in_shape("terrain", 600'000));
    REQUIRE(mesh.edge_count() > 128 * 2048);
    const GpuSilhouettePass pass(gpu->context(), 3);
    check_walk(gpu->context(), pass, mesh, 4, 302);
}

TEST_CASE("a mesh without faces has an empty silhouette") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh{MeshSource{}};
    const GpuSilhouettePass pass(gpu->context());
    Subject subject(gpu->context(), mesh, Bits::from_corners);
    for (int i = 0; i < 2; ++i) {
        const HomogeneousPoint point = HomogeneousPoint::viewpoint({1, 2, 3});
        run(gpu->context(), pass, std::array{SilhouetteRun{&subject.silhouette(), point}});
        subject.check(point);
    }
}

TEST_CASE("change sets made on the GPU name what the tracker's name") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("knot", 20'000));
    const HoughOctree octree(mesh);
    const GpuSilhouettePass pass(gpu->context());
    const Subject subject(gpu->context(), mesh, Bits::from_planes);
    tests::RandomWalk walk(mesh, 303);
    SilhouetteTracker tracker(octree, walk.point());
    const auto run_here = [&] {
        run(gpu->context(), pass,
            std::array{SilhouetteRun{&subject.silhouette(), tracker.point()}});
    };
    run_here();
    const auto sorted = [](std::span<const EdgeId> edges) {
        std::vector<EdgeId> copy(edges.begin(), edges.end());
        std::ranges::sort(copy);
        return copy;
    };
    for (int i = 0; i < 60; ++i) {
        CAPTURE(i);
        const ChangeSet& changes = tracker.move_to(walk.next());
        run_here();
        const GpuSilhouette& silhouette = subject.silhouette();
        const auto counts = subject.read<GpuSilhouetteCounts>(silhouette.counts(), 1).front();
        REQUIRE(counts.flips == changes.flipped.size());
        REQUIRE(counts.silhouette == changes.silhouette_size);
        REQUIRE(subject.read<EdgeId>(silhouette.added(), counts.added) == sorted(changes.added));
        REQUIRE(subject.read<EdgeId>(silhouette.removed(), counts.removed) ==
                sorted(changes.removed));
        std::vector<WordWrite> words(changes.words.begin(), changes.words.end());
        std::ranges::sort(words, {}, &WordWrite::word);
        REQUIRE(subject.read<WordWrite>(silhouette.word_writes(), counts.words) == words);
    }
}

void check_model(const char* name, std::uint32_t points) {
    RIMLINE_OPEN_GPU(gpu);
    const auto path = tests::find_model(name);
    if (!path) RIMLINE_SKIP(std::string(name) + " is in no folder of RIMLINE_MODELS");
    const GpuSilhouettePass pass(gpu->context());
    check_walk(gpu->context(), pass, Mesh(read_mesh_file(*path)), tests::model_count(points), 304);
}

TEST_CASE("silhouettes made on the GPU equal the CPU's on ogre.obj") { check_model("ogre.obj", 8); }
TEST_CASE("silhouettes made on the GPU equal the CPU's on beetle-alt.obj") {
    check_model("beetle-alt.obj", 20);
}

TEST_SUITE("long") {
#define RIMLINE_MODEL_CASE(file)                                                         \
    TEST_CASE("from a thousand points the GPU's silhouettes equal the CPU's on " file) { \
        check_model(file, 1000);                                                         \
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
}

}  // namespace
}  // namespace rimline
