#include "tools/bench/engine_growth.h"

#include <algorithm>
#include <memory>
#include <numbers>

#include "engine/renderer.h"
#include "engine/stream/change_stream.h"
#include "engine/stream/gpu_silhouette.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/orbit.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "tools/bench/gpu_time.h"
#include "tools/options/model_argument.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

constexpr std::uint32_t k_growth_side_px = 1024;
constexpr std::uint32_t k_frames_before = 2;

struct Samples {
    std::vector<double> wall_ms, device_ms;

    void add(const CommandTimes& times) {
        wall_ms.push_back(times.wall_ms);
        if (times.device_ms) device_ms.push_back(*times.device_ms);
    }
    double wall() const { return quantile(wall_ms, 0.5); }
    std::optional<double> device() const {
        if (device_ms.empty()) return std::nullopt;
        return quantile(device_ms, 0.5);
    }
};

EngineGrowthStep measure(const Mesh& mesh, const Device& device, std::uint32_t frames,
                         const Context& context) {
    EngineGrowthStep step{.faces = mesh.face_count()};
    const DeviceContext& gpu = device.context();
    const HoughOctree octree(mesh);
    context.checkpoint();
    const Orbit orbit(mesh.center(), glm::dvec3(0, 1, 0), 2.0 * mesh.radius());
    const auto angle = [](std::uint32_t frame) { return 0.5 * frame * std::numbers::pi / 180.0; };

    SilhouetteTracker tracker(octree, orbit.viewpoint(0.0));
    ChangeStream stream(gpu, mesh, 1);
    const ScatterPass scatter(gpu);
    const auto topology =
        upload_at_once(gpu, [&](UploadBatch& batch) { return SilhouetteTopology(batch, mesh); });
    const Buffer planes = upload_buffer(gpu, mesh.planes(), "planes");
    const auto silhouette = upload_at_once(gpu, [&](UploadBatch& batch) {
        return GpuSilhouette(batch, topology, {.planes = planes.address()});
    });
    const GpuSilhouettePass compute(gpu);
    const CommandTimer timer(gpu);

    std::vector<std::unique_ptr<Renderer>> renderers;
    renderers.push_back(std::make_unique<Renderer>(gpu, RendererOptions{.samples = 1, .scale = 1}));
    if (gpu.features.geometry_shader)
        renderers.push_back(std::make_unique<Renderer>(
            gpu, RendererOptions{.samples = 1, .scale = 1, .line_path = LinePath::adjacency}));

    Samples streamed, computed;
    std::vector<double> moves_ms;
    std::vector<std::vector<double>> frames_ms(renderers.size());
    for (std::uint32_t frame = 1; frame <= frames + k_frames_before; ++frame) {
        context.checkpoint();
        const bool counts = frame > k_frames_before;
        const HomogeneousPoint point = orbit.viewpoint(angle(frame));
        const Stopwatch watch;
        const ChangeSet& changes = tracker.move_to(point);
        const double move_ms = watch.ms();
        stream.begin_frame(0);
        if (!stream.apply(changes))
            stream.resend(tracker.sequence(), tracker.silhouette(), tracker.face_words());
        CommandTimes times = timer.run([&](Commands commands) {
            ChangeStream::record_before(commands);
            stream.record(commands, scatter);
            ChangeStream::record_after(commands);
        });
        times.wall_ms = watch.ms();
        const SilhouetteRun run{&silhouette, point};
        const CommandTimes compute_times =
            timer.run([&](Commands commands) { compute.record(commands, std::span(&run, 1)); });
        if (counts) {
            moves_ms.push_back(move_ms);
            streamed.add(times);
            computed.add(compute_times);
        }

        Scene scene;
        scene.instances.push_back({.octree = &octree});
        scene.camera = {
            .eye = orbit.position(angle(frame)), .target = mesh.center(), .fov_y_deg = 65.0};
        scene.shadows = false;
        for (std::size_t r = 0; r < renderers.size(); ++r) {
            const Stopwatch of_frame;
            renderers[r]->render(scene, k_growth_side_px, k_growth_side_px);
            if (counts) frames_ms[r].push_back(of_frame.ms());
        }
    }
    GpuSilhouetteCounts found;
    read_buffer(gpu, silhouette.counts(), std::as_writable_bytes(std::span(&found, 1)));
    step.silhouette = static_cast<std::uint32_t>(tracker.silhouette().size());
    if (found.silhouette != step.silhouette)
        step.difference = "the silhouette that compute shaders find";
    step.move_ms = quantile(moves_ms, 0.5);
    step.stream_ms = streamed.wall();
    step.stream_gpu_ms = streamed.device();
    step.compute_ms = computed.wall();
    step.compute_gpu_ms = computed.device();
    step.lines_ms = quantile(frames_ms[0], 0.5);
    if (renderers.size() > 1) step.adjacency_ms = quantile(frames_ms[1], 0.5);
    renderers.clear();
    step.record = time_recording(octree, device, frames, context);
    return step;
}

}  // namespace

std::vector<EngineGrowthStep> bench_engine_growth(
    const EngineGrowthOptions& options, const Device& device,
    const std::function<void(const EngineGrowthStep&)>& on_step, const Context& context) {
    std::vector<EngineGrowthStep> steps;
    for (std::uint64_t decade = 1; decade <= options.max_faces; decade *= 10)
        for (const std::uint64_t faces : {decade, 3 * decade}) {
            if (faces < options.min_faces || faces > options.max_faces) continue;
            const std::string model = "shape:knot:" + std::to_string(faces);
            const Mesh mesh = load_mesh(model, 0, context);
            steps.push_back(
                about_model(model, [&] { return measure(mesh, device, options.frames, context); }));
            on_step(steps.back());
            if (!steps.back().difference.empty()) return steps;
        }
    if (steps.empty())
        throw Error(ErrorCode::bad_input, "shape:knot: has no size from " +
                                              std::to_string(options.min_faces) + " to " +
                                              std::to_string(options.max_faces) +
                                              " faces: sizes are 1 and 3 times powers of ten");
    return steps;
}

std::optional<std::uint32_t> stream_overtakes_at(const std::vector<EngineGrowthStep>& steps) {
    std::optional<std::uint32_t> faces;
    for (auto step = steps.rbegin(); step != steps.rend() && step->stream_ms < step->compute_ms;
         ++step)
        faces = step->faces;
    return faces;
}

}  // namespace rimline::tools
