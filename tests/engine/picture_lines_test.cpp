// Lines that a caller gives an instance: as silhouette edges are drawn where all of them are seen, with dashes that go
// around corners where they are hidden.

#include "engine/picture_lines.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/lines/line_view.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

using namespace rimline::tests;

constexpr std::uint32_t k_picture_lines_size = 256;
constexpr double k_picture_lines_pixels = 128.0;  // To the unit, in a flat scene.

Scene white_scene(const Camera& camera) {
    return {.camera = camera,
            .palette = {.background = glm::vec3(1.0f),
                        .ink = glm::vec3(0.0f),
                        .shade = glm::vec3(1.0f)},
            .shadows = false};
}

// A plate that faces an orthographic camera, white on white.
MeshSource plate() {
    return {{{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

Scene flat_scene(const Model& model, const PictureLines& lines) {
    Scene scene = white_scene({.eye = {0, 0, 5}, .ortho_height = 2.0});
    scene.instances.push_back({.octree = &model.octree, .picture_lines = &lines});
    return scene;
}

Picture draw_picture_lines(const Gpu& gpu, const Scene& scene,
                           const RendererOptions& options = {}) {
    Renderer renderer(gpu.context(), options);
    return renderer.render(scene, k_picture_lines_size, k_picture_lines_size);
}

// The ink of each set of inked pixels that touch each other.
std::vector<double> inks_of_dashes(const Picture& picture) {
    std::vector<double> inks;
    std::vector<bool> is_done(picture.rgba.size() / 4);
    std::vector<std::size_t> open;
    for (std::size_t first = 0; first < is_done.size(); ++first) {
        if (is_done[first] || ink_at(picture, first) < 0.02) continue;
        inks.push_back(0.0);
        open.push_back(first);
        is_done[first] = true;
        while (!open.empty()) {
            const std::size_t pixel = open.back();
            open.pop_back();
            inks.back() += ink_at(picture, pixel);
            for (const std::size_t next :
                 {pixel - 1, pixel + 1, pixel - k_picture_lines_size, pixel + k_picture_lines_size})
                if (next < is_done.size() && !is_done[next] && ink_at(picture, next) >= 0.02) {
                    is_done[next] = true;
                    open.push_back(next);
                }
        }
    }
    return inks;
}

PictureLines one_line(std::vector<glm::dvec2> points, bool is_hidden, bool is_closed) {
    const auto count = static_cast<std::uint32_t>(points.size());
    return {std::move(points), {{0, count, is_hidden, is_closed}}};
}

TEST_CASE("lines of a caller have the pixels of silhouette edges where all of these are seen" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(make_built_in_shape("sphere", 3000));
    for (const bool orthographic : {false, true})
        for (const float width_px : {0.7f, 2.5f, 8.0f}) {
            CAPTURE(orthographic);
            CAPTURE(width_px);
            const Camera camera =
                fit_camera({.ortho_height = orthographic ? 2.2 * model.mesh.radius() : 0.0},
                           model.mesh, default_view_direction({0, 1, 0}), 1.0);
            Scene scene = white_scene(camera);
            scene.line_width_px = width_px;
            scene.instances.push_back({.octree = &model.octree});
            Renderer renderer(gpu->context());
            const Picture expected =
                renderer.render(scene, k_picture_lines_size, k_picture_lines_size);

            const LineView view = orthographic
                                      ? LineView::orthographic(camera.eye, camera.target, camera.up)
                                      : LineView::perspective(camera.eye, camera.target, camera.up);
            const SilhouetteTracker tracker(model.octree,
                                            renderer.silhouette(0, std::nullopt)->point);
            PictureLines lines;
            for (const EdgeId edge : tracker.silhouette()) {
                const auto first = static_cast<std::uint32_t>(lines.points.size());
                for (const VertexId v : model.mesh.edge(edge).vertices)
                    lines.points.push_back(
                        view.project(glm::dvec3(model.mesh.positions()[index(v)])).position);
                lines.lines.push_back({first, first + 2});
            }
            scene.instances[0].picture_lines = &lines;
            const Picture drawn =
                renderer.render(scene, k_picture_lines_size, k_picture_lines_size);
            CHECK(renderer.report().silhouette == 0);
            CHECK(renderer.report().segments == lines.lines.size());
            CHECK(ink_of(drawn) > 300.0);
            int greatest = 0;
            for (std::size_t i = 0; i < drawn.rgba.size(); ++i)
                greatest = std::max(greatest, std::abs(drawn.rgba[i] - expected.rgba[i]));
            CHECK(greatest <= 2);
        }
}

TEST_CASE("dashes of a hidden square have equal lengths around its corners too" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(plate());
    for (const double half : {0.31, 0.4, 0.57, 0.7}) {
        CAPTURE(half);
        const PictureLines lines =
            one_line({{-half, -half}, {half, -half}, {half, half}, {-half, half}}, true, true);
        Scene scene = flat_scene(model, lines);
        scene.line_width_px = 1.5f;
        CHECK(ink_of(draw_picture_lines(*gpu, scene)) == 0.0);
        scene.hidden_line_strength = 1.0f;
        const std::vector<double> inks = inks_of_dashes(draw_picture_lines(*gpu, scene));
        const double length = 8.0 * half * k_picture_lines_pixels;
        CHECK(inks.size() == std::lround(length / 11.5));
        const double mean = std::accumulate(inks.begin(), inks.end(), 0.0) / double(inks.size());
        CHECK(std::abs(mean / (1.5 * length * 7.0 / 11.5 / double(inks.size())) - 1.0) < 0.05);
        // A corner's joint has a tenth of a square pixel less than a straight dash, and where a dash ends at a
        // corner, its round end is more.
        for (const double ink : inks) CHECK(std::abs(ink - mean) < 0.08 * mean);
    }
}

TEST_CASE("a hidden line begins and ends with a whole dash whatever its length and its points" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(plate());
    for (const double length : {0.5, 0.53, 0.56, 0.59, 1.2}) {
        CAPTURE(length);
        PictureLines lines = one_line({{-0.6, 0.1}, {-0.6 + length, 0.1}}, true, false);
        Scene scene = flat_scene(model, lines);
        scene.line_width_px = 1.5f;
        scene.hidden_line_strength = 1.0f;
        const Picture whole = draw_picture_lines(*gpu, scene);
        const std::vector<double> inks = inks_of_dashes(whole);
        // The round ends of the line, half a pixel beyond the dash's, are more.
        const double middle = inks[1];
        CHECK(inks.size() >= 4);
        for (const double ink : inks) CHECK(std::abs(ink - middle) < 0.2 * middle);
        CHECK(std::abs(inks.front() - inks.back()) < 0.05 * middle);

        lines.points.insert(lines.points.begin() + 1, {-0.6 + 0.37 * length, 0.1});
        lines.lines = {{0, 3, true, false}};
        const Picture divided = draw_picture_lines(*gpu, scene);
        // Where a dash ends at a joint, the joint's round end is more.
        CHECK(std::abs(ink_of(divided) - ink_of(whole)) < 0.03 * middle);
    }
}

TEST_CASE("lines of a caller lie before all instances, each in its own color") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(plate());
    const PictureLines left = one_line({{-0.8, -0.5}, {-0.2, 0.5}}, false, false);
    const PictureLines right = one_line({{0.8, -0.5}, {0.2, 0.5}}, false, false);
    Scene scene = flat_scene(model, left);
    scene.instances[0].material.line_color = glm::vec3(1.0f, 0.0f, 0.0f);
    scene.instances.push_back({.octree = &model.octree, .picture_lines = &right});
    scene.instances[1].translation.z = -0.5;
    scene.instances.push_back({.octree = &model.octree, .has_lines = false});
    scene.instances[2].translation.z = 1.0;
    scene.line_width_px = 6.0f;
    const auto color_at = [](const Picture& picture, double x, double y) {
        const auto pixel =
            static_cast<std::size_t>((1.0 - y) * k_picture_lines_pixels) * k_picture_lines_size +
            static_cast<std::size_t>((1.0 + x) * k_picture_lines_pixels);
        return glm::ivec3(picture.rgba[4 * pixel], picture.rgba[4 * pixel + 1],
                          picture.rgba[4 * pixel + 2]);
    };
    const Picture picture = draw_picture_lines(*gpu, scene);
    CHECK(color_at(picture, -0.5, 0.0) == glm::ivec3(255, 0, 0));
    CHECK(color_at(picture, 0.5, 0.0) == glm::ivec3(0, 0, 0));
    CHECK(color_at(picture, 0.0, 0.0) == glm::ivec3(255, 255, 255));

    // The same by every path, with the silhouettes of other instances beside them.
    scene.instances[2].has_lines = true;
    scene.instances[2].translation = {0, 0, -1};
    const Picture expected = draw_picture_lines(*gpu, scene);
    for (const LinePath path : {LinePath::pulling, LinePath::all_edges, LinePath::adjacency})
        CHECK(std::ranges::equal(draw_picture_lines(*gpu, scene, {.line_path = path}).rgba,
                                 expected.rgba));
}

TEST_CASE("lines of a caller have colors of their own, a later one over those before it") {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(plate());
    PictureLines lines{
        {{-0.8, -0.5}, {0.8, -0.5}, {-0.8, 0.5}, {0.8, 0.5}, {0.0, -0.8}, {0.0, 0.8}},
        {{0, 2}, {2, 4, false, false, 1}, {4, 6, false, false, 0}},
        {{0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}}};
    Scene scene = flat_scene(model, lines);
    scene.line_width_px = 6.0f;
    const Picture picture = draw_picture_lines(*gpu, scene);
    const auto color_at = [&](double x, double y) {
        const auto pixel =
            static_cast<std::size_t>((1.0 - y) * k_picture_lines_pixels) * k_picture_lines_size +
            static_cast<std::size_t>((1.0 + x) * k_picture_lines_pixels);
        return glm::ivec3(picture.rgba[4 * pixel], picture.rgba[4 * pixel + 1],
                          picture.rgba[4 * pixel + 2]);
    };
    CHECK(color_at(0.5, -0.5) == glm::ivec3(0, 0, 0));
    CHECK(color_at(0.5, 0.5) == glm::ivec3(255, 0, 0));
    CHECK(color_at(0.0, 0.0) == glm::ivec3(0, 0, 255));
    CHECK(color_at(0.0, -0.5) == glm::ivec3(0, 0, 255));
    CHECK(color_at(0.0, 0.5) == glm::ivec3(255, 0, 0));
    // Colors that no line has cost nothing and change nothing.
    lines.colors.pop_back();
    CHECK(draw_picture_lines(*gpu, scene).rgba == picture.rgba);
    lines.lines[1].color = lines.lines[2].color = k_own_line_color;
    const Picture black = draw_picture_lines(*gpu, scene);
    lines.colors.clear();
    CHECK(draw_picture_lines(*gpu, scene).rgba == black.rgba);
}

}  // namespace
}  // namespace rimline
