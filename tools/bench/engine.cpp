#include "tools/bench/engine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

#include "engine/measure/visible_ratio.h"
#include "engine/renderer.h"
#include "engine/stream/change_stream.h"
#include "engine/view_defaults.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/orbit.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/solid.h"
#include "tools/progress.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

using Clock = std::chrono::steady_clock;

constexpr VkExtent2D k_frame_size{1024, 1024};
constexpr double k_orbit_radii = 2.0;
constexpr double k_step_deg = 0.5;
constexpr std::uint32_t k_warm_up_frames = 2;
// Two ways may differ only where they round a corner differently.
constexpr double k_max_differing_pixels = 1e-4;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

Orbit orbit_around(const Mesh& mesh) {
    return Orbit(mesh.center(), direction_of(mesh.up()), k_orbit_radii * mesh.radius());
}

// One frame of an orbit.
Scene scene_at(const HoughOctree& octree, std::uint32_t frame) {
    const Mesh& mesh = octree.mesh();
    Scene scene;
    scene.instances.push_back({.octree = &octree});
    scene.camera = {.eye = orbit_around(mesh).position(radians(k_step_deg * frame)),
                    .target = mesh.center(),
                    .up = direction_of(mesh.up()),
                    .fov_y_deg = 65.0};
    scene.shadows = false;
    return scene;
}

std::vector<StreamedBytes> stream_bytes_by_step(const HoughOctree& octree,
                                                const DeviceContext& device, std::uint32_t frames) {
    const Orbit orbit = orbit_around(octree.mesh());
    std::vector<StreamedBytes> curve;
    ChangeStream stream(device, octree.mesh(), 1);
    for (const double step_deg : {0.0625, 0.125, 0.25, 0.5, 1.0, 2.0, 4.0}) {
        StreamedBytes bytes{.step_deg = step_deg};
        SilhouetteTracker tracker(octree, orbit.viewpoint(0.0));
        stream.begin_frame(0);
        stream.resend(tracker.sequence(), tracker.silhouette(), tracker.face_words());
        for (std::uint32_t frame = 1; frame <= frames; ++frame) {
            const ChangeSet& changes = tracker.move_to(orbit.viewpoint(radians(step_deg * frame)));
            stream.begin_frame(0);
            if (!stream.apply(changes))
                stream.resend(tracker.sequence(), tracker.silhouette(), tracker.face_words());
            bytes.streamed += static_cast<double>(stream.bytes_streamed()) / frames;
            bytes.full += static_cast<double>(stream.bytes_full()) / frames;
        }
        curve.push_back(bytes);
    }
    return curve;
}

// One way to draw the picture.
struct FrameWay {
    std::string name;
    RendererOptions renderer;
    std::function<void(Scene&)> change{};  // Changes the scene that all ways draw; may be empty.
    bool draws_the_same = true;            // Whether its picture equals that of the first way.
};

// Draws frames in all ways in turn. Adds to `passes`, unless null, those of all ways. Fills `times`, or returns the
// first difference from the first way.
std::string time_frames(const std::vector<FrameWay>& ways, const HoughOctree& octree,
                        const Device& device, std::uint32_t frames,
                        const std::function<void(Scene&)>& change, std::vector<EngineTime>& times,
                        const std::string& doing, const Context& context,
                        PassMedians* passes = nullptr) {
    std::vector<std::unique_ptr<Renderer>> renderers;
    for (const FrameWay& way : ways)
        renderers.push_back(std::make_unique<Renderer>(device.context(), way.renderer));
    std::vector<std::vector<double>> taken_ms(ways.size());
    Progress progress(context, doing);
    const LongCall call = progress.call();
    for (std::uint32_t frame = 0; frame < frames + k_warm_up_frames; ++frame) {
        Scene scene = scene_at(octree, frame);
        change(scene);
        Picture first{};
        for (std::size_t turn = 0; turn < ways.size(); ++turn) {
            // Forwards and backwards: who comes second finds the mesh in the processor's caches.
            const bool is_backwards = frame >= k_warm_up_frames && frame % 2 == 1;
            const std::size_t w = is_backwards ? ways.size() - 1 - turn : turn;
            call.checkpoint(double(frame) / (frames + k_warm_up_frames));
            Scene changed = scene;
            if (ways[w].change) ways[w].change(changed);
            const Clock::time_point start = Clock::now();
            Picture picture =
                renderers[w]->render(changed, k_frame_size.width, k_frame_size.height);
            const std::chrono::duration<double, std::milli> took = Clock::now() - start;
            if (frame >= k_warm_up_frames) {
                taken_ms[w].push_back(took.count());
                if (passes) passes->add(renderers[w]->report());
            } else if (w == 0) {
                first = std::move(picture);
            } else if (ways[w].draws_the_same && draws_other_pixels(first, picture)) {
                return ways[w].name + ": its picture";
            }
        }
    }
    for (std::size_t w = 0; w < ways.size(); ++w)
        times.push_back({ways[w].name, quantile(taken_ms[w], 0.5)});
    return {};
}

std::vector<FrameWay> line_ways(const DeviceContext& device) {
    std::vector<FrameWay> ways;
    const auto add = [&](const char* name, LinePath path) {
        if (needs_geometry_shader(path) && !device.features.geometry_shader) return;
        ways.push_back({name, {.samples = 1, .scale = 1, .line_path = path}});
    };
    add("slots, geometry shader", LinePath::geometry);
    add("slots, vertex pulling", LinePath::pulling);
    add("all edges, geometry shader", LinePath::all_edges);
    add("all edges, quads", LinePath::quads);
    add("adjacency, geometry shader", LinePath::adjacency);
    // The gain from leaving out the backs of a solid.
    ways.push_back({"slots, vertex pulling, backs drawn too",
                    {.samples = 1, .scale = 1, .line_path = LinePath::pulling},
                    [](Scene& scene) { scene.instances[0].is_solid = false; }});
    return ways;
}

// The first way is the renderer's choice. All pictures are equal but those without shadows.
std::vector<FrameWay> shadow_ways(const DeviceContext& device) {
    std::vector<FrameWay> ways;
    const auto add = [&](const char* name, SideStage sides, ShadowMethod method, ShadowForm form) {
        if (sides == SideStage::geometry && !device.features.geometry_shader) return;
        ways.push_back({name, {.samples = 1, .scale = 1, .shadow_sides = sides}, [=](Scene& scene) {
                            scene.shadow_method = method;
                            scene.shadow_form = form;
                        }});
    };
    using enum ShadowForm;
    add("as chosen, vertex pulling", SideStage::vertex, ShadowMethod::automatic, automatic);
    add("depth fail, general, vertex pulling", SideStage::vertex, ShadowMethod::fail, general);
    add("depth fail, general, geometry shader", SideStage::geometry, ShadowMethod::fail, general);
    add("depth fail, single where right, vertex pulling", SideStage::vertex, ShadowMethod::fail,
        single);
    add("depth pass where right, general, vertex pulling", SideStage::vertex, ShadowMethod::pass,
        general);
    ways.push_back({"no shadows",
                    {.samples = 1, .scale = 1},
                    [](Scene& scene) { scene.shadows = false; },
                    false});
    return ways;
}

// Viewpoints in the shell of the thesis, by the golden angle.
std::vector<glm::dvec3> shell(const Mesh& mesh, std::uint32_t count) {
    std::vector<glm::dvec3> eyes;
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    for (std::uint32_t i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count;
        const double across = std::sqrt(1.0 - z * z);
        const double radius = std::sqrt(3.0) + (2.0 - std::sqrt(3.0)) * (i % 5) / 4.0;
        eyes.push_back(mesh.center() + mesh.radius() * radius *
                                           glm::dvec3(across * std::cos(golden_angle * i),
                                                      across * std::sin(golden_angle * i), z));
    }
    return eyes;
}

std::string time_ratios(const HoughOctree& octree, const Device& device,
                        const EngineBenchOptions& options, std::vector<EngineTime>& times,
                        const Context& context) {
    struct Way {
        const char* name;
        VisibleRatioMethod method;
    };
    constexpr Way k_ways[] = {
        {"as chosen for the device", {}},
        {"one target, a barrier each", {true, false, Occluders::all}},
        {"a target each", {true, true, Occluders::all}},
        {"a target each, clusters that may hide lines", {true, true, Occluders::clusters}},
        {"a target each, faces that may hide lines", {true, true, Occluders::faces}},
        {"one target, faces that may hide lines", {true, false, Occluders::faces}},
        {"pixels counted on the CPU", {false, true, Occluders::automatic}},
    };
    std::vector<std::string> names;
    std::vector<std::unique_ptr<VisibleRatioPass>> passes;
    for (const Way& way : k_ways) {
        if (!way.method.has_separate_targets && !device.context().features.occlusion_query_precise)
            continue;
        names.emplace_back(way.name);
        passes.push_back(std::make_unique<VisibleRatioPass>(
            device.context(), octree, VisibleRatioOptions{.method = way.method}));
    }
    const std::vector<glm::dvec3> eyes = shell(octree.mesh(), options.viewpoints);
    std::vector<std::vector<double>> taken_ms(passes.size());
    std::vector<VisibleRatio> first;
    Progress progress(context, "measuring visible ratios");
    const LongCall call = progress.call();
    for (std::uint32_t round = 0; round <= options.rounds; ++round)
        for (std::size_t p = 0; p < passes.size(); ++p) {
            call.checkpoint(double(round) / (options.rounds + 1));
            const Clock::time_point start = Clock::now();
            std::vector<VisibleRatio> ratios = passes[p]->measure(eyes, {.stop = call.stop});
            const std::chrono::duration<double, std::milli> took = Clock::now() - start;
            if (first.empty()) first = ratios;
            if (ratios != first) return "visible ratio, " + names[p] + ": its counts";
            if (round > 0) taken_ms[p].push_back(took.count());
        }
    for (std::size_t p = 0; p < passes.size(); ++p)
        times.push_back({names[p], quantile(taken_ms[p], 0.5)});
    return {};
}

double over(const EngineTime& baseline, const EngineTime& ours) {
    return baseline.median_ms / ours.median_ms;
}

}  // namespace

bool draws_other_pixels(const Picture& a, const Picture& b) {
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4)
        for (std::size_t c = 0; c < 3; ++c)
            if (std::abs(int{a.rgba[i + c]} - int{b.rgba[i + c]}) > 1) {
                ++differing;
                break;
            }
    return 4.0 * static_cast<double>(differing) >
           k_max_differing_pixels * static_cast<double>(a.rgba.size());
}

const EngineTime* EngineResult::find_line_path(const std::string& name) const {
    const auto found = std::ranges::find(lines, name, &EngineTime::name);
    return found == lines.end() ? nullptr : &*found;
}

EngineResult bench_engine(const std::string& model, const Mesh& mesh, const Device& device,
                          const EngineBenchOptions& options, const Context& context) {
    EngineResult result{.model = model, .faces = mesh.face_count(), .is_closed = mesh.is_closed()};
    const HoughOctree octree(mesh);
    context.checkpoint();
    result.bytes = stream_bytes_by_step(octree, device.context(), options.frames);

    result.is_solid = is_solid(mesh, {context.stop, {}});
    const auto as_solid = [&](Scene& scene) { scene.instances[0].is_solid = result.is_solid; };
    result.difference = time_frames(line_ways(device.context()), octree, device, options.frames,
                                    as_solid, result.lines, "drawing lines", context);
    if (!result.difference.empty()) return result;

    const auto with_sun = [&](Scene& scene) {
        as_solid(scene);
        scene.lines = false;
        scene.shadows = true;
        scene.lights = {default_sun(scene.camera)};
    };
    result.difference = time_frames(shadow_ways(device.context()), octree, device, options.frames,
                                    with_sun, result.shadows, "drawing shadows", context);
    if (!result.difference.empty()) return result;

    const auto with_lines = [&](Scene& scene) {
        with_sun(scene);
        scene.lines = true;
    };
    PassMedians passes;
    result.difference =
        time_frames({{"without timestamps", {.samples = 1, .scale = 1}},
                     {"with timestamps", {.samples = 1, .scale = 1, .pass_times = true}}},
                    octree, device, options.frames, with_lines, result.timestamps, "timing passes",
                    context, &passes);
    if (!result.difference.empty()) return result;
    result.passes = passes.each();

    result.record = time_recording(octree, device, options.frames, context);
    result.difference = time_ratios(octree, device, options, result.ratios, context);
    return result;
}

std::vector<Target> targets_of(const EngineResult& result, bool is_cpu) {
    std::vector<Target> targets;
    if (result.faces == k_igea_faces)
        for (const StreamedBytes& bytes : result.bytes)
            if (bytes.step_deg == k_step_deg)
                targets.push_back({.what = "bytes streamed a frame over the smallest full rewrite",
                                   .value = bytes.streamed / bytes.full,
                                   .reach = 1.0 / 4,
                                   .aim = 1.0 / 6,
                                   .less_is_better = true});
    if (!result.is_closed || result.faces < 60'000 || result.faces > 110'000) return targets;
    const EngineTime* const slots = result.find_line_path("slots, geometry shader");
    const EngineTime* const adjacency = result.find_line_path("adjacency, geometry shader");
    if (slots && adjacency)
        targets.push_back({.what = "frame with lines, adjacency over slots",
                           .value = over(*adjacency, *slots),
                           .reach = 1.8,
                           .aim = 2.5});
    const auto baseline =
        std::ranges::find(result.ratios, "one target, a barrier each", &EngineTime::name);
    // GPUs draw so few faces in about the time that the CPU needs to choose among them (docs/results/engine.md).
    if (is_cpu && baseline != result.ratios.end())
        targets.push_back({.what = "visible ratios, one target with barriers over ours",
                           .value = over(*baseline, result.ratios.front()),
                           .reach = 1.4,
                           .aim = 3.0});
    return targets;
}

}  // namespace rimline::tools
