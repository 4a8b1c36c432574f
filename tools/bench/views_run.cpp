// The suite of views from the command line: devices, tables, objects for scripts.

#include <cstdio>
#include <nlohmann/json.hpp>

#include "engine/tested_device.h"
#include "engine/vulkan/vulkan_instance.h"
#include "tools/bench/machine.h"
#include "tools/bench/report.h"
#include "tools/bench/view_experiments.h"
#include "tools/bench/views.h"
#include "tools/options/model_argument.h"
#include "tools/output/json_vector.h"

namespace rimline::tools {

namespace {

using Json = nlohmann::ordered_json;

void print_degrees(const std::optional<double>& degrees, int width) {
    if (degrees)
        std::printf(" %*.2f\u00b0", width, *degrees);
    else
        std::printf(" %*s", width + 1, "-");
}

void print_result(const ViewsResult& result) {
    std::printf("%s: %u faces\n", result.model.c_str(), result.faces);
    std::printf("  %-32s %8s %8s %8s %8s %11s %8s\n", "views", "seen", "least", "mean", "most",
                "simplified", "noise");
    for (const ViewSet& set : result.sets) {
        std::printf("  %-32s %7.1f%% %7.1f\u00b0 %7.1f\u00b0 %7.1f\u00b0", set.name.c_str(),
                    100.0 * set.seen, set.min_apart_deg, set.mean_apart_deg, set.max_apart_deg);
        print_degrees(set.simplified_deg, 10);
        print_degrees(set.noisy_deg, 7);
        std::printf("\n");
    }
    std::printf("  %-32s %8s %8s %9s\n", "light", "away", "unlit", "contrast");
    for (const LightSet& set : result.lights)
        std::printf("  %-32s %7.1f%% %7.1f%% %9.4f\n", set.name.c_str(), 100.0 * set.away,
                    100.0 * set.unlit, set.contrast);
    std::printf("  drawn %llu viewpoints of %llu, of %llu if the whole lattice were; %.0f ms\n",
                static_cast<unsigned long long>(result.renders),
                static_cast<unsigned long long>(result.own_candidates),
                static_cast<unsigned long long>(result.lattice_candidates), result.ms);
}

Json to_json(const ViewsResult& result) {
    Json sets = Json::array();
    for (const ViewSet& set : result.sets) {
        Json eyes = Json::array();
        for (const glm::dvec3& eye : set.eyes) eyes.push_back(json_vector(eye));
        sets.push_back({{"name", set.name},
                        {"eyes", std::move(eyes)},
                        {"seen", set.seen},
                        {"least_apart_deg", set.min_apart_deg},
                        {"mean_apart_deg", set.mean_apart_deg},
                        {"most_apart_deg", set.max_apart_deg},
                        {"simplified_deg", set.simplified_deg ? Json(*set.simplified_deg) : Json()},
                        {"noisy_deg", set.noisy_deg ? Json(*set.noisy_deg) : Json()}});
    }
    Json lights = Json::array();
    for (const LightSet& set : result.lights)
        lights.push_back({{"name", set.name},
                          {"away", set.away},
                          {"unlit", set.unlit},
                          {"contrast", set.contrast}});
    return {{"model", result.model},
            {"faces", result.faces},
            {"views", std::move(sets)},
            {"lights", std::move(lights)},
            {"renders", result.renders},
            {"candidates", result.own_candidates},
            {"lattice_candidates", result.lattice_candidates},
            {"ms", result.ms}};
}

}  // namespace

ExitStatus run_bench_views(const ViewsBenchRequest& request, const Context& context) {
    const VulkanInstance instance;
    const TestedDevice device(instance, request.device);
    Json models = Json::array();
    Json targets_json = Json::array();
    std::string missed;
    for (const std::string& model : request.models) {
        const Mesh mesh = load_mesh(model, request.subdivide, context);
        check_has_extent(model, mesh);
        if (!request.pictures.empty()) {
            about_model(model, [&] {
                draw_view_experiments(model, mesh, device, request.up, request.pictures, context);
            });
            continue;
        }
        // Not before the first model is there: what cannot be read leaves standard output empty.
        if (!context.json && &model == &request.models.front()) {
            print_machine(this_machine());
            std::printf("%s, %s\n\n", device.facts().name.c_str(), device.facts().driver.c_str());
        }
        const ViewsResult result = about_model(
            model, [&] { return bench_views(model, mesh, device, request.options, context); });
        const std::vector<Target> targets =
            request.check ? targets_of(result) : std::vector<Target>{};
        if (context.json) {
            models.push_back(to_json(result));
            for (const Target& target : targets) targets_json.push_back(to_json(target, model));
        } else {
            print_result(result);
            print_targets(targets);
            std::printf("\n");
            std::fflush(stdout);
        }
        if (const std::string what = first_missed(targets); missed.empty() && !what.empty())
            missed = model + ": " + what;
    }
    if (context.json) {
        Json object{{"machine", to_json(this_machine())},
                    {"device", {{"name", device.facts().name}, {"driver", device.facts().driver}}},
                    {"models", std::move(models)}};
        if (request.check) object["targets"] = std::move(targets_json);
        print_json(object);
    }
    return report_missed(missed);
}

}  // namespace rimline::tools
