#include "tools/bench/image_space.h"

#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <stop_token>
#include <utility>

#include "engine/renderer.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/orbit.h"
#include "silhouette/hough/spread_viewpoints.h"
#include "silhouette/mesh/solid.h"
#include "tools/bench/pass_medians.h"
#include "tools/output/shown_lines.h"
#include "tools/progress.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

constexpr ImageSize k_mask_size{1024, 1024};
constexpr double k_view_radii = 3.0;
constexpr std::uint32_t k_untimed_frames = 2;
constexpr double k_turn_rad = 0.5 * std::numbers::pi / 180.0;
constexpr std::array k_depth_steps{0.001f, 0.004f, 0.016f};
constexpr std::array k_normal_steps_deg{20.0f, 40.0f, 60.0f, 180.0f};

struct Technique {
    const char* name;
    Outline outline{};
    bool is_exact = false;
};

std::vector<Technique> techniques() {
    return {{"lines by slots", {}},
            {"Sobel, depth and normals", {.method = OutlineMethod::sobel}},
            {"Sobel, depth alone", {.method = OutlineMethod::sobel, .normal_step_deg = 180.0f}},
            {"thickened backs", {.method = OutlineMethod::backs}},
            {"lines of exact visibility", {}, true}};
}

// The model, the camera and black ink: the picture is white elsewhere.
Scene outline_scene(const HoughOctree& octree, bool is_solid, const Camera& camera) {
    Scene scene{.camera = camera,
                .palette = {.background = glm::vec3(1.0f),
                            .ink = glm::vec3(0.0f),
                            .shade = glm::vec3(1.0f)},
                .shadows = false,
                .line_width_px = float(k_compared_width_px)};
    scene.instances.push_back({.octree = &octree, .is_solid = is_solid});
    scene.instances[0].material.shows_mesh_colors = false;
    return scene;
}

std::vector<Camera> spread_cameras(const Mesh& mesh, std::uint32_t count) {
    const glm::dvec3 up = direction_of(mesh.up());
    std::vector<Camera> cameras;
    for (const HomogeneousPoint& direction : spread_directions(count)) {
        const glm::vec3 eye(mesh.center() + k_view_radii * mesh.radius() *
                                                glm::normalize(glm::dvec3(direction.xyz())));
        cameras.push_back({.eye = eye,
                           .target = mesh.center(),
                           .up = up,
                           .fov_y_deg = 2.0 * glm::degrees(std::asin(1.02 / k_view_radii))});
    }
    return cameras;
}

PixelMask mask_of(const Picture& picture) {
    constexpr std::uint8_t k_half_covered = 188;  // Half of white's light, encoded.
    PixelMask mask(picture.width, picture.height);
    for (std::size_t i = 0; i < mask.at.size(); ++i)
        mask.at[i] = picture.rgba[4 * i] <= k_half_covered ? 1 : 0;
    return mask;
}

// A technique with its renderer.
class OutlineDrawer {
public:
    OutlineDrawer(const DeviceContext& device, const HoughOctree& octree,
                  const Technique& technique, bool pass_times, std::stop_token stop)
        : renderer_(
              device,
              {.samples = 1, .scale = 1, .pass_times = pass_times, .outline = technique.outline}) {
        if (technique.is_exact)
            lines_.emplace(octree, LineSurface::Contacts::found, LongCall{std::move(stop), {}});
    }

    Picture draw(Scene scene) {
        const auto start = std::chrono::steady_clock::now();
        lines_ms_ = 0.0;
        if (lines_) {
            scene.instances[0].picture_lines =
                lines_->draw(scene.camera, k_mask_size, {.min_length = 0.0});
            lines_ms_ = milliseconds(start);
        }
        Picture picture = renderer_.render(scene, k_mask_size.width, k_mask_size.height);
        frame_ms_ = milliseconds(start);
        return picture;
    }

    const FrameReport& report() const { return renderer_.report(); }
    double frame_ms() const { return frame_ms_; }
    double cpu_ms() const { return lines_ms_ + renderer_.report().record_ms; }

private:
    static double milliseconds(std::chrono::steady_clock::time_point start) {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
            .count();
    }

    Renderer renderer_;
    std::optional<ShownLines> lines_;
    double lines_ms_ = 0.0, frame_ms_ = 0.0;
};

class ImageSpaceBench {
public:
    ImageSpaceBench(const Mesh& mesh, const Device& device, const ImageSpaceOptions& options,
                    const Context& context)
        : octree_(mesh),
          is_solid_(is_solid(mesh, {context.stop, {}})),
          device_(device.context()),
          options_(options),
          context_(context) {}

    void count(ImageSpaceResult& result) {
        Progress progress(context_, "counting pixels of " + result.model);
        const LongCall call = progress.call();
        const std::vector<Camera> cameras = spread_cameras(octree_.mesh(), options_.views);
        std::size_t done = 0;
        const std::size_t steps =
            1 + techniques().size() + k_depth_steps.size() * k_normal_steps_deg.size();
        const auto next = [&] { call.checkpoint(double(done++) / double(steps * cameras.size())); };
        std::vector<TruePixels> truths;
        const PieceRays rays(octree_.mesh());
        for (const Camera& camera : cameras) {
            next();
            truths.push_back(find_true_pixels(octree_.mesh(), rays, camera, k_mask_size.width,
                                              k_mask_size.height));
        }
        const auto hits_of = [&](const Technique& technique) {
            OutlineDrawer drawer(device_, octree_, technique, false, context_.stop);
            OutlineHits hits;
            for (std::size_t v = 0; v < cameras.size(); ++v) {
                next();
                const Picture picture = drawer.draw(outline_scene(octree_, is_solid_, cameras[v]));
                hits += count_hits(truths[v], mask_of(picture));
            }
            return hits;
        };
        for (const Technique& technique : techniques())
            result.ways.push_back({.name = technique.name, .hits = hits_of(technique)});
        for (const float depth_step : k_depth_steps)
            for (const float normal_step_deg : k_normal_steps_deg) {
                const Outline outline{OutlineMethod::sobel, depth_step, normal_step_deg};
                result.sobel.push_back({outline, hits_of({"", outline})});
            }
    }

    void time(ImageSpaceResult& result) {
        const Mesh& mesh = octree_.mesh();
        Progress progress(context_, "timing frames of " + result.model);
        const LongCall call = progress.call();
        struct Times {
            std::unique_ptr<OutlineDrawer> drawer;
            std::vector<double> frame_ms, cpu_ms;
            PassMedians passes;
        };
        std::vector<Times> all;
        for (const Technique& technique : techniques())
            all.push_back(
                {std::make_unique<OutlineDrawer>(device_, octree_, technique, true, context_.stop),
                 {},
                 {},
                 {}});
        const Orbit orbit(mesh.center(), direction_of(mesh.up()), 2.0 * mesh.radius());
        const std::uint32_t frames = options_.frames + k_untimed_frames;
        for (std::uint32_t frame = 0; frame < frames; ++frame) {
            const Scene scene = outline_scene(octree_, is_solid_,
                                              {.eye = orbit.position(k_turn_rad * frame),
                                               .target = mesh.center(),
                                               .up = direction_of(mesh.up()),
                                               .fov_y_deg = 65.0});
            for (std::size_t turn = 0; turn < all.size(); ++turn) {
                call.checkpoint(double(frame) / frames);
                // Forwards and backwards: who comes second finds the mesh in the processor's caches.
                Times& times = all[frame % 2 == 0 ? turn : all.size() - 1 - turn];
                times.drawer->draw(scene);
                if (frame < k_untimed_frames) continue;
                times.frame_ms.push_back(times.drawer->frame_ms());
                times.cpu_ms.push_back(times.drawer->cpu_ms());
                times.passes.add(times.drawer->report());
            }
        }
        for (std::size_t w = 0; w < all.size(); ++w) {
            result.ways[w].frame_ms = quantile(all[w].frame_ms, 0.5);
            result.ways[w].cpu_ms = quantile(all[w].cpu_ms, 0.5);
            result.ways[w].passes_ms = all[w].passes.sum_ms("");
        }
    }

private:
    const HoughOctree octree_;
    bool is_solid_;
    const DeviceContext& device_;
    const ImageSpaceOptions& options_;
    const Context& context_;
};

}  // namespace

ImageSpaceResult bench_image_space(const std::string& model, const Mesh& mesh, const Device& device,
                                   const ImageSpaceOptions& options, const Context& context) {
    ImageSpaceResult result{
        .model = model, .faces = mesh.face_count(), .is_closed = mesh.is_closed()};
    ImageSpaceBench bench(mesh, device, options, context);
    context.checkpoint();
    bench.count(result);
    bench.time(result);
    return result;
}

}  // namespace rimline::tools
