// The engine's suite from the command line: devices, tables, objects for scripts.

#include <cstdio>
#include <nlohmann/json.hpp>

#include "engine/tested_device.h"
#include "engine/vulkan/vulkan_instance.h"
#include "tools/bench/engine.h"
#include "tools/bench/engine_growth.h"
#include "tools/bench/machine.h"
#include "tools/bench/report.h"
#include "tools/options/model_argument.h"

namespace rimline::tools {

namespace {

using Json = nlohmann::ordered_json;

void print_times(const char* title, const std::vector<EngineTime>& times, std::size_t ours) {
    std::printf("  %s\n", title);
    for (const EngineTime& time : times)
        std::printf("    %-46s %9.2f ms %8.2fx\n", time.name.c_str(), time.median_ms,
                    time.median_ms / times[ours].median_ms);
}

void print_result(const EngineResult& result) {
    std::printf("%s: %u faces, %s\n", result.model.c_str(), result.faces,
                result.is_solid    ? "a solid, drawn without the backs of faces"
                : result.is_closed ? "closed"
                                   : "open");
    if (!result.difference.empty()) {
        std::printf("  not measured: %s differs\n", result.difference.c_str());
        return;
    }
    std::printf("  bytes a frame, by the step of an orbit at 2 radii\n");
    for (const StreamedBytes& bytes : result.bytes)
        std::printf("    %7.4f deg  %10.0f of %10.0f, 1/%.1f\n", bytes.step_deg, bytes.streamed,
                    bytes.full, bytes.full / bytes.streamed);
    print_times("frame with lines, 1024x1024", result.lines, 0);
    print_times("frame without lines, one sun, 1024x1024", result.shadows, 0);
    print_times("visible ratios of all viewpoints, 256x256", result.ratios, 0);
}

Json to_json(const std::vector<EngineTime>& times) {
    Json array = Json::array();
    for (const EngineTime& time : times)
        array.push_back({{"name", time.name},
                         {"median_ms", time.median_ms},
                         {"ratio", time.median_ms / times.front().median_ms}});
    return array;
}

Json to_json(const EngineResult& result) {
    Json object{{"model", result.model},
                {"faces", result.faces},
                {"closed", result.is_closed},
                {"solid", result.is_solid},
                {"verified", result.difference.empty()}};
    if (!result.difference.empty()) return object;
    Json bytes = Json::array();
    for (const StreamedBytes& b : result.bytes)
        bytes.push_back({{"step_degrees", b.step_deg}, {"streamed", b.streamed}, {"full", b.full}});
    object.update({{"bytes", std::move(bytes)},
                   {"lines", to_json(result.lines)},
                   {"shadows", to_json(result.shadows)},
                   {"visible_ratios", to_json(result.ratios)}});
    return object;
}

Json optional_json(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json to_json(const EngineGrowthStep& step) {
    return {{"faces", step.faces},
            {"silhouette", step.silhouette},
            {"verified", step.difference.empty()},
            {"move_ms", step.move_ms},
            {"stream_ms", step.stream_ms},
            {"stream_device_ms", optional_json(step.stream_gpu_ms)},
            {"compute_ms", step.compute_ms},
            {"compute_device_ms", optional_json(step.compute_gpu_ms)},
            {"frame_slots_ms", step.lines_ms},
            {"frame_adjacency_ms", step.adjacency_ms > 0.0 ? Json(step.adjacency_ms) : Json()}};
}

void print_step(const EngineGrowthStep& step) {
    const auto device = [](const std::optional<double>& ms) { return ms.value_or(0.0); };
    std::printf("%10u %10u %9.3f %9.3f %9.3f %9.3f %9.3f %9.2f %9.2f\n", step.faces,
                step.silhouette, step.move_ms, step.stream_ms, device(step.stream_gpu_ms),
                step.compute_ms, device(step.compute_gpu_ms), step.lines_ms, step.adjacency_ms);
    std::fflush(stdout);
}

ExitStatus report_difference(const std::string& model, const std::string& difference) {
    return report_check(difference.empty() ? "" : model + ": " + difference + " differs");
}

Json device_json(const Device& device) {
    return {{"name", device.facts().name}, {"driver", device.facts().driver}};
}

void print_machine(const Device& device) {
    print_machine(this_machine());
    std::printf("%s, %s\n\n", device.facts().name.c_str(), device.facts().driver.c_str());
}

void print_growth_head(const Device& device) {
    print_machine(device);
    std::printf(
        "shape:knot, ms a frame of half a degree; gpu: by the device's timestamps\n"
        "%10s %10s %9s %9s %9s %9s %9s %9s %9s\n",
        "faces", "silhouette", "move", "stream", "gpu", "compute", "gpu", "frame", "adjacency");
}

ExitStatus run_growth(const EngineBenchRequest& request, const Device& device,
                      const Context& context) {
    bool has_head = context.json;
    Json array = Json::array();
    const std::vector<EngineGrowthStep> steps = bench_engine_growth(
        request, device,
        [&](const EngineGrowthStep& step) {
            if (!has_head) print_growth_head(device);
            has_head = true;
            if (context.json)
                array.push_back(to_json(step));
            else
                print_step(step);
        },
        context);
    const std::optional<std::uint32_t> crossover = stream_overtakes_at(steps);
    if (context.json) {
        print_json({{"machine", to_json(this_machine())},
                    {"device", device_json(device)},
                    {"growth", std::move(array)},
                    {"stream_overtakes_compute_at", crossover ? Json(*crossover) : Json()}});
    } else if (crossover) {
        std::printf("the stream is faster than compute shaders from %u faces on\n", *crossover);
    } else {
        std::printf("compute shaders are faster at %u faces still\n", steps.back().faces);
    }
    return report_difference("shape:knot", steps.back().difference);
}

}  // namespace

ExitStatus run_bench_engine(const EngineBenchRequest& request, const Context& context) {
    const VulkanInstance instance;
    const TestedDevice device(instance, request.device);
    if (request.growth) return run_growth(request, device, context);

    Json models = Json::array();
    Json targets_json = Json::array();
    std::string missed;
    std::string failed_model;
    std::string difference;
    for (const std::string& model : request.models) {
        const Mesh mesh = load_mesh(model, request.subdivide, context);
        check_has_extent(model, mesh);
        // Not before the first model is there: what cannot be read leaves standard output empty.
        if (!context.json && &model == &request.models.front()) print_machine(device);
        const EngineResult result = about_model(
            model, [&] { return bench_engine(model, mesh, device, request.options, context); });
        std::vector<Target> targets;
        if (request.check && result.difference.empty()) targets = targets_of(result);
        if (context.json) {
            models.push_back(to_json(result));
            for (const Target& target : targets) targets_json.push_back(to_json(target, model));
        } else {
            print_result(result);
            print_targets(targets);
            std::printf("\n");
            std::fflush(stdout);
        }
        if (difference.empty() && !result.difference.empty()) {
            difference = result.difference;
            failed_model = model;
        }
        if (const std::string what = first_missed(targets); missed.empty() && !what.empty())
            missed = model + ": " + what;
    }
    if (context.json) {
        Json object{{"machine", to_json(this_machine())},       {"device", device_json(device)},
                    {"viewpoints", request.options.viewpoints}, {"frames", request.options.frames},
                    {"rounds", request.options.rounds},         {"models", std::move(models)}};
        if (request.check) object["targets"] = std::move(targets_json);
        print_json(object);
    }
    return difference.empty() ? report_missed(missed) : report_difference(failed_model, difference);
}

}  // namespace rimline::tools
