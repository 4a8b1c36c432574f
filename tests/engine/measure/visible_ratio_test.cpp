// Visible ratios against masks counted on the CPU, against rays, and against what is known in closed
// form.

#include "engine/measure/visible_ratio.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <random>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/measure/view_ratios.h"
#include "engine/scene.h"
#include "silhouette/field/ray_ratios.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/ray_reference.h"
#include "tests/engine/support/test_pictures.h"
#include "tests/models.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

constexpr std::uint32_t k_seed = 20060214;
constexpr double k_fov_deg = 70.6;

constexpr const char* k_models[] = {"alligator.obj",  "beetle-alt.obj", "fandisk.obj",
                                    "horse.ply",      "igea.ply",       "nefertiti.obj",
                                    "rocker-arm.obj", "ogre.obj",       "stanford-bunny.obj"};

// Calls `test` for every model that is there and for some shapes.
template <typename Test>
void for_each_model(Test&& test) {
    for (const char* name : {"scene", "spring", "knot", "terrain"}) {
        CAPTURE(name);
        test(Model(make_built_in_shape(name)), std::string(name));
    }
    for (const char* name : k_models) {
        CAPTURE(name);
        if (const auto path = find_model(name))
            test(Model(read_mesh_file(*path)), std::string(name));
        else
            MESSAGE("without ", name, ", which RIMLINE_MODELS does not have");
    }
}

double unit(std::mt19937& random) { return static_cast<double>(random() >> 8) * 0x1p-24; }

glm::dvec3 random_direction(std::mt19937& random) {
    for (;;) {
        const glm::dvec3 v(2.0 * unit(random) - 1.0, 2.0 * unit(random) - 1.0,
                           2.0 * unit(random) - 1.0);
        if (const double length = glm::length(v); length > 0.1 && length < 1.0) return v / length;
    }
}

// In the shell of thesis 4.5.3.
std::vector<glm::dvec3> shell(const Mesh& mesh, std::size_t count) {
    std::mt19937 random(k_seed);
    std::vector<glm::dvec3> eyes;
    for (std::size_t i = 0; i < count; ++i) {
        const double inner = std::sqrt(3.0);
        eyes.push_back(mesh.center() + mesh.radius() * (inner + (2.0 - inner) * unit(random)) *
                                           random_direction(random));
    }
    return eyes;
}

// Where the depth test has most to do: the center, inside, on a vertex, near a face, far away.
std::vector<glm::dvec3> awkward_eyes(const Mesh& mesh) {
    const glm::dvec3 corner(mesh.positions()[0]);
    return {mesh.center(),
            mesh.center() + glm::dvec3(0.3 * mesh.radius(), 0.0, 0.0),
            corner,
            glm::mix(mesh.center(), corner, 1.02),
            mesh.center() + glm::dvec3(0, 0, 1e3) * mesh.radius(),
            mesh.center() + glm::dvec3(0, 2.0 * mesh.radius(), 0)};
}

VisibleRatio counted(const std::vector<LinePixel>& mask) {
    const auto visible = std::ranges::count(mask, LinePixel::visible);
    const auto hidden = std::ranges::count(mask, LinePixel::hidden);
    return {static_cast<std::uint32_t>(visible), static_cast<std::uint32_t>(visible + hidden)};
}

MeshSource joined(MeshSource a, const MeshSource& b) {
    const auto offset = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (auto triangle : b.triangles) {
        for (std::uint32_t& corner : triangle) corner += offset;
        a.triangles.push_back(triangle);
    }
    return a;
}

// Of side 2, facing +z, at height z.
MeshSource plate(float z) {
    MeshSource source;
    source.positions = {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
    source.triangles = {{0, 1, 2}, {0, 2, 3}};
    return source;
}

struct LengthRatios {
    double pixels;  ///< Of the pixels that a line passes through, those where a ray sees it.
    double length;  ///< Of the lines' length on the screen.
};

// Of the samples along all silhouette edges and borders, a quarter of a pixel apart, those that rays find
// visible, an edge's own faces left out.
LengthRatios length_ratios(const Model& model, const glm::dvec3& eye, std::uint32_t side) {
    const Mesh& mesh = model.mesh;
    const HomogeneousPoint point = HomogeneousPoint::viewpoint(glm::vec3(eye));
    Scene scene;
    scene.instances.push_back({.octree = &model.octree});
    scene.camera = {.eye = glm::dvec3(point.xyz()),
                    .target = mesh.center(),
                    .up = mesh.up() == UpAxis::z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0),
                    .fov_y_deg = k_fov_deg};
    const RayReference rays(scene);
    const glm::dvec2 picture(side);
    const glm::dvec3 ahead = glm::normalize(mesh.center() - scene.camera.eye);

    std::vector<EdgeId> edges = brute_force_silhouette(mesh, point);
    const Mesh::EdgeRange borders = mesh.edges_of_class(EdgeClass::border);
    for (std::uint32_t e = borders.first; e < borders.last; ++e) edges.push_back(EdgeId{e});
    double length = 0.0;
    double seen_length = 0.0;
    std::map<int, bool> pixels;
    for (const EdgeId edge : edges) {
        const glm::dvec3& a = rays.vertex(0, mesh.edge(edge).vertices[0]);
        const glm::dvec3& b = rays.vertex(0, mesh.edge(edge).vertices[1]);
        const auto from = rays.place_of(a, picture);
        const auto to = rays.place_of(b, picture);
        if (!from || !to) continue;
        const std::span<const FaceId> own = mesh.faces_of(edge);
        const auto is_own = [&](std::size_t, FaceId face) {
            return std::ranges::find(own, face) != own.end();
        };
        const double a_near = 1.0 / glm::dot(a - scene.camera.eye, ahead);
        const double b_near = 1.0 / glm::dot(b - scene.camera.eye, ahead);
        const double edge_length = glm::distance(*from, *to);
        const int samples = std::max(1, static_cast<int>(std::ceil(4.0 * edge_length)));
        for (int s = 0; s < samples; ++s) {
            const double t = (s + 0.5) / samples;  // On the screen.
            const double along = t * b_near / ((1.0 - t) * a_near + t * b_near);
            const bool seen = !rays.is_hidden(glm::mix(a, b, along), is_own);
            length += edge_length / samples;
            if (seen) seen_length += edge_length / samples;
            const glm::dvec2 place = glm::mix(*from, *to, t);
            const int size = static_cast<int>(side);
            const auto x = static_cast<int>(std::floor(place.x));
            const auto y = static_cast<int>(std::floor(place.y));
            if (x >= 0 && y >= 0 && x < size && y < size) {
                bool& pixel = pixels[y * size + x];
                pixel = pixel || seen;
            }
        }
    }
    const auto seen_pixels = std::ranges::count_if(pixels, [](const auto& p) { return p.second; });
    return {static_cast<double>(seen_pixels) /
                static_cast<double>(std::max<std::size_t>(pixels.size(), 1)),
            length > 0.0 ? seen_length / length : 0.0};
}

TEST_CASE("a mask counted on the CPU equals the queries on every model whichever way it is done" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    constexpr VisibleRatioMethod k_ways[] = {
        {},
        {.counts_by_query = false},
        {.occluders = Occluders::all},
        {.has_separate_targets = false, .occluders = Occluders::clusters},
        {.occluders = Occluders::faces},
    };
    if (!gpu->context().features.occlusion_query_precise)
        MESSAGE("the device counts no pixels exactly; only masks are compared");
    for_each_model([&](const Model& model, const std::string& name) {
        std::vector<glm::dvec3> eyes = shell(model.mesh, 10);
        for (const glm::dvec3& eye : awkward_eyes(model.mesh)) eyes.push_back(eye);
        VisibleRatioPass pass(gpu->context(), model.octree);
        const std::vector<VisibleRatio> ratios = pass.measure(eyes);
        for (std::size_t i = 0; i < eyes.size(); ++i) {
            CAPTURE(i);
            const std::vector<LinePixel> mask = pass.mask(eyes[i]);
            CHECK(ratios[i] == counted(mask));
            CHECK(ratios[i].visible_pixels <= ratios[i].total_pixels);
            if (i > 0) continue;
            Picture picture{256, 256, {}};
            for (const LinePixel pixel : mask)
                for (int c = 0; c < 4; ++c)
                    picture.rgba.push_back(c == 3 || pixel == LinePixel::none ||
                                                   (c == 0 && pixel == LinePixel::hidden)
                                               ? 255
                                               : 0);
            save_picture("ratio_" + name, std::move(picture), {});
        }
        for (const VisibleRatioMethod& way : k_ways) {
            if (!way.has_separate_targets && !gpu->context().features.occlusion_query_precise)
                continue;
            VisibleRatioPass other(gpu->context(), model.octree, {.method = way});
            CHECK(other.measure(eyes) == ratios);
        }
    });
}

TEST_CASE("ratios by rays are those of pictures but for rounding at corners" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    for_each_model([&](const Model& model, const std::string&) {
        const RayRatios rays(model.octree);
        VisibleRatioPass pass(gpu->context(), model.octree);
        const auto compare = [&](const std::vector<glm::dvec3>& eyes, double most) {
            const std::vector<double> by_rays = rays.measure(eyes);
            const std::vector<VisibleRatio> drawn = pass.measure(eyes);
            for (std::size_t i = 0; i < eyes.size(); ++i) {
                CAPTURE(i);
                CHECK(std::abs(by_rays[i] - drawn[i].ratio()) < most);
            }
        };
        compare(shell(model.mesh, 20), 0.004);
        // Inside too, where lines pass the near plane.
        compare(awkward_eyes(model.mesh), 0.03);
    });
    const Model model(make_built_in_shape("knot", 2000));
    const std::vector<glm::dvec3> eyes = shell(model.mesh, 5);
    const std::vector<double> by_rays = RayRatios(model.octree).measure(eyes);
    const std::vector<double> chosen = ViewRatios(gpu->context(), model.octree).measure(eyes);
    for (std::size_t i = 0; i < eyes.size(); ++i) CHECK(std::abs(chosen[i] - by_rays[i]) < 0.004);
}

TEST_CASE("pictures of any side are counted the same by query and by the CPU") {
    RIMLINE_OPEN_GPU(gpu);
    if (!gpu->context().features.occlusion_query_precise)
        RIMLINE_SKIP("the device has no precise occlusion queries");
    const Model model(make_built_in_shape("knot", 2000));
    const std::vector<glm::dvec3> eyes = shell(model.mesh, 5);
    for (const std::uint32_t side : {1u, 33u, 101u, 102u}) {
        CAPTURE(side);
        VisibleRatioPass by_query(gpu->context(), model.octree, {.side_px = side});
        VisibleRatioPass by_cpu(gpu->context(), model.octree,
                                {.side_px = side, .method = {.counts_by_query = false}});
        CHECK(by_query.measure(eyes) == by_cpu.measure(eyes));
    }
}

TEST_CASE("a stop ends the making of what measures visible ratios") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(make_built_in_shape("sphere", 2000));
    std::stop_source stop;
    CHECK_NOTHROW(VisibleRatioPass(gpu->context(), model.octree, {}, stop.get_token()));
    stop.request_stop();
    CHECK_THROWS_AS(VisibleRatioPass(gpu->context(), model.octree, {}, stop.get_token()), Error);
}

// A prism over a bow tie: closed, oriented, of positive volume, and half of it inside out.
MeshSource bow_tie() {
    constexpr glm::vec2 k_outline[]{{-3.0f, -3.0f}, {-0.5f, -0.5f}, {1.5f, 1.5f},
                                    {1.5f, -1.5f},  {0.4f, -0.4f},  {-3.0f, 3.0f}};
    MeshSource source;
    for (const float z : {-1.5f, 1.5f})
        for (const glm::vec2& p : k_outline) source.positions.push_back({p, z});
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t j = (i + 1) % 6;
        source.triangles.push_back({i, j, j + 6});
        source.triangles.push_back({i, j + 6, i + 6});
    }
    constexpr std::uint32_t k_cap[][3]{{0, 1, 5}, {1, 4, 5}, {1, 2, 3}, {1, 3, 4}};
    for (const auto& [a, b, c] : k_cap) {
        source.triangles.push_back({a + 6, b + 6, c + 6});
        source.triangles.push_back({a, c, b});
    }
    return source;
}

TEST_CASE("backs hide lines where a shell that crosses itself shows them") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(bow_tie());
    REQUIRE(model.mesh.is_closed());
    REQUIRE(model.mesh.is_oriented());
    const std::vector<glm::dvec3> eyes{{10, 1, 2}, {9, 4, 3}, {8, -3, 6}, {-10, 1, 2}};
    const std::vector<VisibleRatio> ratios =
        VisibleRatioPass(gpu->context(), model.octree, {.fov_deg = k_fov_deg}).measure(eyes);
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        CAPTURE(i);
        CHECK(std::abs(ratios[i].ratio() - length_ratios(model, eyes[i], 256).pixels) < 0.05);
    }
}

TEST_CASE("the ratio is the one that rays along the edges see" * doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    double difference = 0.0;
    double length_difference = 0.0;
    std::size_t count = 0;
    for_each_model([&](const Model& model, const std::string& name) {
        const std::vector<glm::dvec3> eyes = shell(model.mesh, 3);
        const std::vector<VisibleRatio> ratios =
            VisibleRatioPass(gpu->context(), model.octree, {.fov_deg = k_fov_deg}).measure(eyes);
        double of_model = 0.0;
        for (std::size_t i = 0; i < eyes.size(); ++i) {
            const LengthRatios rays = length_ratios(model, eyes[i], 256);
            of_model += std::abs(ratios[i].ratio() - rays.pixels);
            length_difference += std::abs(ratios[i].ratio() - rays.length);
        }
        difference += of_model;
        count += eyes.size();
        MESSAGE(name, ": ", of_model / static_cast<double>(eyes.size()));
        CHECK(of_model / static_cast<double>(eyes.size()) < 0.04);
    });
    // By length it is another measure: of a zigzag finer than a pixel half the length is hidden, and
    // all of its pixels are seen.
    MESSAGE("mean difference ", difference / static_cast<double>(count), ", by length ",
            length_difference / static_cast<double>(count));
    CHECK(difference / static_cast<double>(count) < 0.02);
}

TEST_CASE("a sphere's whole rim is visible, and is a circle long") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(make_built_in_shape("sphere", 20'000));
    const double distance = 2.0;
    const std::vector<glm::dvec3> eyes{model.mesh.center() +
                                       distance * model.mesh.radius() * glm::dvec3(0, 0, 1)};
    const VisibleRatio ratio =
        VisibleRatioPass(gpu->context(), model.octree, {.fov_deg = k_fov_deg}).measure(eyes)[0];
    CHECK(ratio.ratio() > 0.995);
    // A closed curve passes through as many pixels as it crosses rows and columns: twice across and
    // twice down, each way back too.
    const double tangent = std::tan(std::asin(1.0 / distance));
    const double radius_px = 128.0 * tangent / std::tan(glm::radians(0.5 * k_fov_deg));
    CHECK(ratio.total_pixels == doctest::Approx(8.0 * radius_px).epsilon(0.03));
}

TEST_CASE("what a plate hides is hidden, and its borders are lines unless they are left out") {
    RIMLINE_OPEN_GPU(gpu);
    MeshSource box = make_built_in_shape("box");
    const Mesh measured(box);
    for (glm::vec3& position : box.positions)
        position = (position - glm::vec3(measured.center())) * float(0.3 / measured.radius());
    const Model alone(plate(1.0f));
    const Model both(joined(plate(1.0f), box));
    const std::vector<glm::dvec3> front{{0.0, 0.0, 4.0}};
    const auto measured_once = [&](const Model& model, const VisibleRatioOptions& options) {
        return VisibleRatioPass(gpu->context(), model.octree, options).measure(front)[0];
    };
    const VisibleRatio rim = measured_once(alone, {});
    CHECK(rim.total_pixels > 100);
    CHECK(rim.visible_pixels == rim.total_pixels);
    const VisibleRatio hidden = measured_once(both, {});
    CHECK(hidden.visible_pixels == rim.visible_pixels);
    CHECK(hidden.total_pixels > rim.total_pixels + 50);
    const VisibleRatio without = measured_once(both, {.has_borders = false});
    CHECK(without.visible_pixels == 0);
    CHECK(without.total_pixels == hidden.total_pixels - rim.total_pixels);
    CHECK(measured_once(alone, {.has_borders = false}).ratio() == 0.0);
}

TEST_CASE("scaling a mesh and its viewpoints by a power of two changes nothing" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    MeshSource source = make_built_in_shape("scene");
    const Model model(source);
    std::vector<glm::dvec3> eyes = shell(model.mesh, 5);
    for (glm::dvec3& eye : eyes) eye = glm::dvec3(glm::vec3(eye));
    const std::vector<VisibleRatio> ratios =
        VisibleRatioPass(gpu->context(), model.octree).measure(eyes);
    for (const float scale : {0x1p-20f, 0x1p20f}) {
        MeshSource scaled = source;
        for (glm::vec3& position : scaled.positions) position *= scale;
        std::vector<glm::dvec3> scaled_eyes = eyes;
        for (glm::dvec3& eye : scaled_eyes) eye *= double(scale);
        const Model other(scaled);
        CHECK(VisibleRatioPass(gpu->context(), other.octree).measure(scaled_eyes) == ratios);
    }
}

TEST_CASE("nothing to draw counts as zero, and no viewpoints are none") {
    RIMLINE_OPEN_GPU(gpu);
    const Model empty(MeshSource{});
    const std::vector<glm::dvec3> eyes{{1, 2, 3}, {0, 0, 0}};
    VisibleRatioPass pass(gpu->context(), empty.octree);
    CHECK(pass.measure({}).empty());
    for (const VisibleRatio& ratio : pass.measure(eyes)) {
        CHECK(ratio == VisibleRatio{});
        CHECK(ratio.ratio() == 0.0);
    }
    // Behind the viewer.
    const Model sheet(plate(0.0f));
    const std::vector<glm::dvec3> beside{{0.0, 0.0, 1e-9}, {5.0, 0.0, 0.0}};
    for (const VisibleRatio& ratio : VisibleRatioPass(gpu->context(), sheet.octree).measure(beside))
        CHECK(ratio.visible_pixels <= ratio.total_pixels);
}

TEST_CASE("a small budget takes more batches and counts the same") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(make_built_in_shape("spring", 5'000));
    const std::vector<glm::dvec3> eyes = shell(model.mesh, 40);
    const std::vector<VisibleRatio> ratios =
        VisibleRatioPass(gpu->context(), model.octree).measure(eyes);
    for (const std::uint64_t budget_bytes : {std::uint64_t{1}, std::uint64_t{7'000'000}}) {
        VisibleRatioPass pass(gpu->context(), model.octree, {.budget_bytes = budget_bytes});
        CHECK(pass.measure(eyes) == ratios);
        CHECK(pass.measure(std::span(eyes).first(3)) ==
              std::vector(ratios.begin(), ratios.begin() + 3));
    }
}

TEST_CASE(
    "a cancelled call ends and the next one is right and progress never falls and ends at one") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(make_built_in_shape("torus", 3'000));
    const std::vector<glm::dvec3> eyes = shell(model.mesh, 100);
    VisibleRatioPass pass(gpu->context(), model.octree);
    std::vector<double> shares;
    const std::vector<VisibleRatio> ratios = pass.measure(
        eyes, {.stop = {}, .progress = [&](double share) { shares.push_back(share); }});
    CHECK(std::ranges::is_sorted(shares));
    CHECK(shares.size() > 4);
    CHECK(shares.back() == 1.0);

    std::stop_source stop;
    const LongCall call{.stop = stop.get_token(), .progress = [&](double share) {
                            if (share > 0.4) stop.request_stop();
                        }};
    CHECK_THROWS_AS(pass.measure(eyes, call), Error);
    CHECK(pass.measure(eyes) == ratios);
}

TEST_CASE("a picture beyond the device's limit is an error that names it") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(make_built_in_shape("box"));
    const std::uint32_t side = gpu->context().limits.maxImageDimension2D + 1;
    VisibleRatioPass pass(gpu->context(), model.octree, {.side_px = side});
    const std::vector<glm::dvec3> eyes = shell(model.mesh, 1);
    CHECK_THROWS_WITH_AS(pass.measure(eyes), doctest::Contains("maxImageDimension2D"), Error);
}

}  // namespace
