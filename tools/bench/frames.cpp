#include "tools/bench/frames.h"

#include <glm/geometric.hpp>
#include <numbers>

#include "engine/renderer.h"
#include "engine/sampling.h"
#include "engine/view_defaults.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/orbit.h"
#include "silhouette/mesh/ground_axes.h"
#include "silhouette/mesh/solid.h"
#include "tools/bench/engine.h"
#include "tools/options/model_argument.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

constexpr std::uint32_t k_frames_first = 2;  // Not timed.
constexpr double k_ground_radii = 8.0;
constexpr double k_frame_radians = 0.5 * std::numbers::pi / 180.0;

// A model and how its frames look.
struct FrameSubject {
    const HoughOctree& octree;
    bool is_solid;

    Scene at(std::uint32_t frame) const {
        const Mesh& mesh = octree.mesh();
        const Orbit orbit(mesh.center(), direction_of(mesh.up()), 2.0 * mesh.radius());
        Scene scene;
        scene.instances.push_back({.octree = &octree, .is_solid = is_solid});
        scene.camera = {.eye = orbit.position(k_frame_radians * frame),
                        .target = mesh.center(),
                        .up = direction_of(mesh.up()),
                        .fov_y_deg = 65.0};
        // The first frame's sun: it rests while the camera moves.
        Camera first = scene.camera;
        first.eye = orbit.position(0.0);
        scene.lights = {default_sun(first)};
        return scene;
    }
};

// Light 0 as a lamp in the same direction, so many radii from the center.
void make_lamp(Scene& scene, double radii) {
    const Mesh& mesh = scene.instances[0].octree->mesh();
    const glm::dvec3 towards = glm::normalize(scene.lights[0].vector);
    scene.lights[0] = {.vector = mesh.center() + radii * mesh.radius() * towards,
                       .directional = false};
}

class Rows {
public:
    Rows(const Device& device, const FramesBenchOptions& options,
         const std::function<void(const FrameRow&)>& on_row, const Context& context)
        : device_(device), options_(options), on_row_(on_row), context_(context) {}

    // Returns the first frame's picture; none where the row was refused.
    Picture measure(const std::string& group, const std::string& name, const FrameSubject& subject,
                    RendererOptions renderer_options,
                    const std::function<void(Scene&)>& change = {}, const SampleTests& tests = {}) {
        FrameRow row{.group = group,
                     .name = name,
                     .faces = subject.octree.mesh().face_count(),
                     .passes = {},
                     .tests = tests};
        Picture first{};
        renderer_options.pass_times = true;
        try {
            Renderer renderer(device_.context(), renderer_options);
            std::vector<double> frames_ms, records_ms;
            for (std::uint32_t frame = 0; frame < options_.frames + k_frames_first; ++frame) {
                context_.checkpoint();
                Scene scene = subject.at(frame);
                if (change) change(scene);
                Picture picture = renderer.render(scene, options_.width, options_.height);
                if (frame == 0) first = std::move(picture);
                if (frame < k_frames_first) continue;
                frames_ms.push_back(renderer.report().frame_ms);
                records_ms.push_back(renderer.report().record_ms);
                row.passes.add(renderer.report());
            }
            row.frame_ms = quantile(frames_ms, 0.5);
            row.record_ms = quantile(records_ms, 0.5);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::too_large) throw;
            row.refusal = error.what();
        }
        add(std::move(row));
        return first;
    }

    void refuse(const std::string& group, const std::string& name, std::uint32_t faces,
                const std::string& why) {
        add({.group = group,
             .name = name,
             .faces = faces,
             .refusal = why,
             .passes = {},
             .tests = {}});
    }

    std::vector<FrameRow> take() { return std::move(rows_); }

private:
    void add(FrameRow row) {
        rows_.push_back(std::move(row));
        on_row_(rows_.back());
    }

    const Device& device_;
    const FramesBenchOptions& options_;
    const std::function<void(const FrameRow&)>& on_row_;
    const Context& context_;
    std::vector<FrameRow> rows_;
};

void measure_lights(Rows& rows, const FrameSubject& subject) {
    const auto without_lines = [](Scene& scene) { scene.lines = false; };
    rows.measure("light", "no shadow", subject, {}, [&](Scene& scene) {
        without_lines(scene);
        scene.shadows = false;
    });
    rows.measure("light", "sun", subject, {}, without_lines);
    for (const int radii : {1000, 100, 10, 3, 1})
        rows.measure("light",
                     "lamp at " + std::to_string(radii) + (radii == 1 ? " radius" : " radii"),
                     subject, {}, [&](Scene& scene) {
                         without_lines(scene);
                         make_lamp(scene, radii);
                     });
}

// Rows without and with limits of shadows. Returns the first one whose picture differs.
std::string measure_limits(Rows& rows, const FrameSubject& subject, const DeviceContext& context,
                           const FramesBenchOptions& options) {
    const Mesh& mesh = subject.octree.mesh();
    const glm::dvec3 up = direction_of(mesh.up());
    const Mesh ground(make_ground(mesh, up, k_ground_radii * mesh.radius()));
    const HoughOctree ground_octree(ground);
    const auto set_on_ground = [&](Scene& scene) {
        scene.instances.push_back({.octree = &ground_octree,
                                   .has_lines = false,
                                   .casts_shadows = false,
                                   .is_solid = false,
                                   .fade_radius = 0.5 * k_ground_radii * mesh.radius(),
                                   .fade_center = mesh.center()});
    };
    const auto add_others = [&](Scene& scene) {
        const GroundAxes axes = ground_axes(up);
        for (int row = -1; row <= 1; ++row)
            for (int column = -1; column <= 1; ++column) {
                if (row == 0 && column == 0) continue;
                scene.instances.push_back(scene.instances[0]);
                scene.instances.back().translation =
                    1.6 * mesh.radius() * (double(column) * axes.first + double(row) * axes.second);
            }
        scene.camera.eye += 1.2 * (scene.camera.eye - scene.camera.target) + mesh.radius() * up;
    };
    const std::pair<const char*, std::function<void(Scene&)>> scenes[] = {
        {"", [](Scene&) {}}, {", ground", set_on_ground}, {", nine on a ground", [&](Scene& scene) {
                                                               add_others(scene);
                                                               set_on_ground(scene);
                                                           }}};
    std::string difference;
    for (const auto& [suffix, arrange] : scenes)
        for (const bool is_lamp : {false, true}) {
            const auto change = [&, &arrange = arrange](Scene& scene) {
                scene.lines = false;
                if (is_lamp) make_lamp(scene, 3.0);
                arrange(scene);
            };
            const std::string name = (is_lamp ? "lamp" : "sun") + std::string(suffix);
            Scene scene = subject.at(0);
            change(scene);
            const SampleTests tests =
                count_sample_tests(context, scene, options.width, options.height);
            const Picture everywhere = rows.measure("limits", name + ", none", subject,
                                                    {.limits_shadows = false}, change, tests);
            const Picture limited = rows.measure("limits", name, subject, {}, change, tests);
            if (difference.empty() && !limited.rgba.empty() && !everywhere.rgba.empty() &&
                draws_other_pixels(everywhere, limited))
                difference = name + ": its picture";
        }
    return difference;
}

void measure_sampling(Rows& rows, const FrameSubject& subject, const DeviceContext& context,
                      const FramesBenchOptions& options) {
    if (options.has("scale"))
        for (const std::uint32_t scale : {1u, 2u, 3u})
            rows.measure("scale", std::to_string(scale) + ", 1 sample", subject,
                         {.samples = 1, .scale = scale});
    if (!options.has("samples")) return;
    for (const std::uint32_t samples : {1u, 4u, 8u}) {
        const std::string name = std::to_string(samples) + ", scale 1";
        const std::uint32_t taken = sampling_of(context, samples, 1).samples;
        if (taken == samples)
            rows.measure("samples", name, subject, {.samples = samples, .scale = 1});
        else
            rows.refuse("samples", name, subject.octree.mesh().face_count(),
                        std::to_string(taken) + " are taken");
    }
}

// Returns the first way whose picture differs from that of the first one.
std::string measure_lines(Rows& rows, const FrameSubject& subject, const DeviceContext& context) {
    constexpr std::pair<const char*, LinePath> k_paths[] = {
        {"slots, geometry shader", LinePath::geometry},
        {"slots, vertex pulling", LinePath::pulling},
        {"all edges, geometry shader", LinePath::all_edges},
        {"all edges, quads", LinePath::quads},
        {"adjacency, geometry shader", LinePath::adjacency}};
    std::string difference;
    Picture first{};
    for (const auto& [name, path] : k_paths) {
        if (needs_geometry_shader(path) && !context.features.geometry_shader) {
            rows.refuse("lines", name, subject.octree.mesh().face_count(),
                        "the device has no geometry shaders");
            continue;
        }
        Picture picture =
            rows.measure("lines", name, subject, {.samples = 1, .scale = 1, .line_path = path},
                         [](Scene& scene) { scene.shadows = false; });
        if (first.rgba.empty())
            first = std::move(picture);
        else if (!picture.rgba.empty() && difference.empty() && draws_other_pixels(first, picture))
            difference = std::string(name) + ": its picture";
    }
    return difference;
}

void measure_growth(Rows& rows, std::uint32_t max_faces, const Context& context) {
    for (std::uint64_t decade = 10'000; decade <= max_faces; decade *= 10)
        for (const std::uint64_t faces : {decade, 3 * decade}) {
            if (faces > max_faces) return;
            const std::string model = "shape:knot:" + std::to_string(faces);
            const Mesh mesh = load_mesh(model, 0, context);
            const HoughOctree octree(mesh);
            context.checkpoint();
            rows.measure("growth", model, {octree, is_solid(mesh, {context.stop, {}})}, {});
        }
}

}  // namespace

FramesResult bench_frames(const std::string& model, const Mesh& mesh, const Device& device,
                          const FramesBenchOptions& options,
                          const std::function<void(const FrameRow&)>& on_row,
                          const Context& context) {
    FramesResult result;
    Rows rows(device, options, on_row, context);
    about_model(model, [&] {
        const HoughOctree octree(mesh);
        const FrameSubject subject{octree, is_solid(mesh, {context.stop, {}})};
        if (options.has("light")) measure_lights(rows, subject);
        if (options.has("limits"))
            result.difference = measure_limits(rows, subject, device.context(), options);
        measure_sampling(rows, subject, device.context(), options);
        if (!options.has("lines")) return;
        const std::string difference = measure_lines(rows, subject, device.context());
        if (result.difference.empty()) result.difference = difference;
    });
    if (options.has("growth")) measure_growth(rows, options.max_faces, context);
    result.rows = rows.take();
    return result;
}

}  // namespace rimline::tools
