// rimline bench engine: streams and frames on a Vulkan device.

#include <CLI/App.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "engine/tested_device.h"
#include "tools/bench/engine.h"
#include "tools/bench/engine_growth.h"
#include "tools/bench/image_space.h"
#include "tools/bench/machine.h"
#include "tools/bench/piece_rays.h"
#include "tools/bench/suite_models.h"
#include "tools/bench/suites.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"

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
    print_times("frame with lines and one sun, 1024x1024", result.timestamps, 0);
    for (const PassTime& pass : result.passes)
        std::printf("      %-44s %9.2f ms\n", pass.name.c_str(), pass.time_ms);
    std::printf("  a frame on the CPU beside the trackers\n");
    const RecordTimes& record = result.record;
    for (const auto& [light, ms] : {std::pair{"a sun", record.sun_ms},
                                    {"a lamp that rests within the bounds", record.resting_lamp_ms},
                                    {"a lamp that moves within the bounds", record.moving_lamp_ms}})
        std::printf("    %-46s %9.3f ms\n", light, ms);
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

Json to_json(const std::vector<PassTime>& passes) {
    Json array = Json::array();
    for (const PassTime& pass : passes)
        array.push_back({{"name", pass.name}, {"median_ms", pass.time_ms}});
    return array;
}

Json to_json(const RecordTimes& record) {
    return {{"sun_ms", record.sun_ms},
            {"resting_lamp_ms", record.resting_lamp_ms},
            {"moving_lamp_ms", record.moving_lamp_ms}};
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
                   {"timestamps", to_json(result.timestamps)},
                   {"passes", to_json(result.passes)},
                   {"record", to_json(result.record)},
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
            {"frame_adjacency_ms", step.adjacency_ms > 0.0 ? Json(step.adjacency_ms) : Json()},
            {"record", to_json(step.record)}};
}

void print_step(const EngineGrowthStep& step) {
    const auto device = [](const std::optional<double>& ms) { return ms.value_or(0.0); };
    std::printf("%10u %10u %9.3f %9.3f %9.3f %9.3f %9.3f %9.2f %9.2f %9.3f %9.3f\n", step.faces,
                step.silhouette, step.move_ms, step.stream_ms, device(step.stream_gpu_ms),
                step.compute_ms, device(step.compute_gpu_ms), step.lines_ms, step.adjacency_ms,
                step.record.resting_lamp_ms, step.record.moving_lamp_ms);
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
        "shape:knot, ms a frame of half a degree; gpu: by the device's timestamps; at rest and "
        "moved:\n"
        "a frame on the CPU beside the trackers, with a lamp within the bounds\n"
        "%10s %10s %9s %9s %9s %9s %9s %9s %9s %9s %9s\n",
        "faces", "silhouette", "move", "stream", "gpu", "compute", "gpu", "frame", "adjacency",
        "at rest", "moved");
}

class EngineSuite final : public Command {
public:
    std::string name() const override { return "engine"; }
    std::string summary() const override { return "Streams and frames on a Vulkan device"; }

    void add_options(CLI::App& app) override {
        models_.add_to(app,
                       "igea.ply of the folders in RIMLINE_MODELS, if there is one, and "
                       "shape:knot:70000");
        check_option_ = add_check(app, check_);
        app.add_flag("--growth", growth_,
                     "Measure the stream, compute shaders and adjacency on shape:knot at growing "
                     "sizes, in place of the models")
            ->group("Kind");
        app.add_flag(
               "--image-space", image_space_,
               "Set lines beside outlines that are found in pixels, by rays: missed and extra "
               "pixels, times")
            ->group("Kind");
        viewpoints_option_ = add_count(app, "--viewpoints", options_.viewpoints, 1, 1'000'000,
                                       "Viewpoints of the visible ratio");
        views_option_ = add_count(app, "--views", image_space_options_.views, 1, 1000,
                                  "Views in which --image-space counts pixels");
        CLI::Option* const frames = add_count(app, "--frames", options_.frames, 1, 1'000'000,
                                              "Steps of half a degree on an orbit at 2 radii");
        rounds_option_ =
            add_count(app, "--rounds", options_.rounds, 1, 1000, "Rounds of the visible ratio");
        min_option_ = add_count(app, "--least-faces", growth_options_.min_faces, 1, 1u << 28,
                                "The least size of --growth");
        max_option_ = add_count(app, "--most-faces", growth_options_.max_faces, 1, 1u << 28,
                                "The greatest size of --growth");
        for (CLI::Option* option :
             {viewpoints_option_, views_option_, frames, rounds_option_, min_option_, max_option_})
            option->group("Amount");
        add_device(app, device_, "gpu, cpu, an index, or a part of a name");
        app.footer(
            "For each model: bytes streamed a frame by step size, frames with lines by every "
            "path,\n"
            "frames with shadows, the passes by timestamps, frames on the CPU, and visible ratios. "
            "Pictures and counts are\n"
            "compared first. A ratio is the median of one way over the median of the first way.\n\n"
            "--check requires: igea streamed 1/4; closed meshes of 60,000 to 110,000 faces\n"
            "adjacency 1.8x, visible ratios on devices of the CPU type 1.4x.\n\n"
            "--image-space counts the pixels that differ from visible silhouettes by more than "
            "one pixel, or two\n"
            "where they are extra; it takes ogre, stanford-bunny, fandisk and igea of the folders "
            "in RIMLINE_MODELS.\n\n"
            "Examples:\n"
            "  rimline bench engine --check\n"
            "  rimline bench engine --image-space ogre.obj\n"
            "  rimline bench engine shape:knot:70000 --frames 8\n"
            "  rimline bench engine --growth --most-faces 10000000 --device gpu");
    }

    ExitStatus run(const Context& context) override {
        if (growth_ && !models_.named().empty())
            throw UsageError("--growth: of the engine it measures shape:knot");
        for (const CLI::Option* option : {min_option_, max_option_})
            if (!growth_ && option->count() > 0)
                throw UsageError(option->get_name() + ": belongs to --growth");
        for (const CLI::Option* option :
             std::initializer_list<const CLI::Option*>{check_option_, models_.subdivide_option()})
            if (growth_ && option->count() > 0)
                throw UsageError(option->get_name() + ": not together with --growth");
        if (growth_ && image_space_) throw UsageError("--growth: not together with --image-space");
        if (!image_space_ && views_option_->count() > 0)
            throw UsageError("--views: belongs to --image-space");
        for (const CLI::Option* option : {check_option_, viewpoints_option_, rounds_option_})
            if (image_space_ && option->count() > 0)
                throw UsageError(option->get_name() + ": not together with --image-space");
        if (image_space_ && !PieceRays::missing().empty())
            throw Error(ErrorCode::no_device,
                        "--image-space: " + std::string(PieceRays::missing()));
        const VulkanInstance instance;
        const TestedDevice device(instance, device_);
        if (growth_) return run_growth(device, context);
        return image_space_ ? run_image_space(device, context) : run_models(device, context);
    }

private:
    ExitStatus run_growth(const Device& device, const Context& context) {
        growth_options_.frames = options_.frames;
        bool has_head = context.json;
        Json array = Json::array();
        const std::vector<EngineGrowthStep> steps = bench_engine_growth(
            growth_options_, device,
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

    ExitStatus run_image_space(const Device& device, const Context& context) {
        image_space_options_.frames = options_.frames;
        std::vector<std::string> names = models_.named();
        if (names.empty())
            names = known_models({"ogre.obj", "stanford-bunny.obj", "fandisk.obj", "igea.ply"},
                                 {"shape:knot:70000"});
        Json models = Json::array();
        for (const std::string& model : names) {
            const Mesh mesh = load_mesh(model, models_.subdivide(), context);
            check_has_extent(model, mesh);
            if (!context.json && &model == &names.front()) print_machine(device);
            const ImageSpaceResult result = about_model(model, [&] {
                return bench_image_space(model, mesh, device, image_space_options_, context);
            });
            if (context.json)
                models.push_back(to_json(result));
            else
                print_result(result);
        }
        if (context.json)
            print_json({{"machine", to_json(this_machine())},
                        {"device", device_json(device)},
                        {"views", image_space_options_.views},
                        {"frames", image_space_options_.frames},
                        {"models", std::move(models)}});
        return ExitStatus::success;
    }

    ExitStatus run_models(const Device& device, const Context& context) {
        // Igea for the bytes, and a closed mesh of 70,000 faces for the rest.
        std::vector<std::string> names = models_.named();
        if (names.empty()) {
            names = known_models({"igea.ply"}, {});
            names.emplace_back("shape:knot:70000");
        }
        Json models = Json::array();
        TargetList all_targets;
        std::string failed_model;
        std::string difference;
        for (const std::string& model : names) {
            const Mesh mesh = load_mesh(model, models_.subdivide(), context);
            check_has_extent(model, mesh);
            // Printed after the first model is loaded: where it cannot be read, standard output stays empty.
            if (!context.json && &model == &names.front()) print_machine(device);
            const EngineResult result = about_model(
                model, [&] { return bench_engine(model, mesh, device, options_, context); });
            std::vector<Target> targets;
            if (check_ && result.difference.empty())
                targets = targets_of(result, device.facts().type == VK_PHYSICAL_DEVICE_TYPE_CPU);
            all_targets.add(model, targets);
            if (context.json) {
                models.push_back(to_json(result));
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
        }
        if (context.json) {
            Json object{{"machine", to_json(this_machine())}, {"device", device_json(device)},
                        {"viewpoints", options_.viewpoints},  {"frames", options_.frames},
                        {"rounds", options_.rounds},          {"models", std::move(models)}};
            if (check_) object["targets"] = all_targets.json();
            print_json(object);
        }
        return difference.empty() ? report_missed(all_targets.first_missed())
                                  : report_difference(failed_model, difference);
    }

    SuiteModels models_;
    bool check_ = false, growth_ = false, image_space_ = false;
    EngineBenchOptions options_;
    EngineGrowthOptions growth_options_;
    ImageSpaceOptions image_space_options_;
    std::string device_;
    CLI::Option *check_option_ = nullptr, *viewpoints_option_ = nullptr, *views_option_ = nullptr,
                *rounds_option_ = nullptr, *min_option_ = nullptr, *max_option_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_engine_suite() { return std::make_unique<EngineSuite>(); }

}  // namespace rimline::tools
