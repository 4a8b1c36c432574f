// rimline bench views: the best views and lights beside those of other measures.

#include <CLI/App.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "engine/tested_device.h"
#include "engine/vulkan/vulkan_instance.h"
#include "tools/bench/machine.h"
#include "tools/bench/suite_models.h"
#include "tools/bench/suites.h"
#include "tools/bench/view_experiments.h"
#include "tools/bench/views.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"
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

class ViewsSuite final : public Command {
public:
    std::string name() const override { return "views"; }
    std::string summary() const override {
        return "The best views and lights beside those of other measures";
    }

    void add_options(CLI::App& app) override {
        models_.add_to(app,
                       "stanford-bunny.obj, horse.ply, rocker-arm.obj and fandisk.obj of the "
                       "folders in RIMLINE_MODELS, or built-in shapes");
        check_option_ = add_check(app, check_);
        pictures_option_ = app.add_option("--pictures", pictures_,
                                          "Draw the experiments of thesis 4.5.4 into this folder, "
                                          "in place of the measures")
                               ->type_name("FOLDER")
                               ->group("Kind");
        up_option_ =
            add_direction(app, "--up", up_, "The up direction of --pictures")->group("Kind");
        add_device(app, device_, "gpu, cpu, an index, or a part of a name");
        app.footer(
            "The suite chooses four views by planes' votes and by other measures at 256 "
            "candidates.\n"
            "Columns of views: the share of faces whose center is seen from one of them; the "
            "least,\n"
            "mean and greatest angle between two; the angle by which the first view moves with a\n"
            "quarter of the faces, and with vertices moved by a thousandth of the radius. Columns\n"
            "of lights, at the best views: the share of visible pixels that turn away, of those "
            "in\n"
            "cast shadow too, and the mean gradient of shading.\n\n"
            "--check requires of the bunny: 5x fewer viewpoints drawn than the lattice has.\n\n"
            "Examples:\n"
            "  rimline bench views horse.ply\n"
            "  rimline bench views fandisk.obj --pictures experiments");
    }

    ExitStatus run(const Context& context) override {
        if (pictures_option_->count() > 0 && pictures_.empty())
            throw UsageError("--pictures: expected a folder, not ''");
        if (up_option_->count() > 0 && pictures_.empty())
            throw UsageError("--up: belongs to --pictures");
        if (check_option_->count() > 0 && !pictures_.empty())
            throw UsageError("--check: not together with --pictures");
        const std::vector<std::string> names =
            models_.named().empty()
                ? known_models({"stanford-bunny.obj", "horse.ply", "rocker-arm.obj", "fandisk.obj"},
                               {"shape:knot:70000", "shape:spring:20000"})
                : models_.named();
        const VulkanInstance instance;
        const TestedDevice device(instance, device_);
        Json models = Json::array();
        TargetList all_targets;
        for (const std::string& model : names) {
            const Mesh mesh = load_mesh(model, models_.subdivide(), context);
            check_has_extent(model, mesh);
            if (!pictures_.empty()) {
                about_model(model, [&] {
                    draw_view_experiments(model, mesh, device, up_, pictures_, context);
                });
                continue;
            }
            // Printed after the first model is loaded: where it cannot be read, standard output stays empty.
            if (!context.json && &model == &names.front()) {
                print_machine(this_machine());
                std::printf("%s, %s\n\n", device.facts().name.c_str(),
                            device.facts().driver.c_str());
            }
            const ViewsResult result =
                about_model(model, [&] { return bench_views(model, mesh, device, {}, context); });
            const std::vector<Target> targets = check_ ? targets_of(result) : std::vector<Target>{};
            all_targets.add(model, targets);
            if (context.json) {
                models.push_back(to_json(result));
            } else {
                print_result(result);
                print_targets(targets);
                std::printf("\n");
                std::fflush(stdout);
            }
        }
        if (context.json) {
            Json object{
                {"machine", to_json(this_machine())},
                {"device", {{"name", device.facts().name}, {"driver", device.facts().driver}}},
                {"models", std::move(models)}};
            if (check_) object["targets"] = all_targets.json();
            print_json(object);
        }
        return report_missed(all_targets.first_missed());
    }

private:
    SuiteModels models_;
    bool check_ = false;
    std::string pictures_, device_;
    std::optional<glm::vec3> up_;
    CLI::Option *check_option_ = nullptr, *pictures_option_ = nullptr, *up_option_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_views_suite() { return std::make_unique<ViewsSuite>(); }

}  // namespace rimline::tools
