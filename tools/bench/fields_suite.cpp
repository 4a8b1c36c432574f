// rimline bench fields: tangential distance fields.

#include <CLI/App.hpp>
#include <cstdio>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tools/bench/alphas.h"
#include "tools/bench/fields.h"
#include "tools/bench/suite_models.h"
#include "tools/bench/suites.h"
#include "tools/bench/vertex_clustering.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

namespace {

class FieldsSuite final : public Command {
public:
    std::string name() const override { return "fields"; }
    std::string summary() const override {
        return "Tangential distance fields, against summing all planes";
    }

    void add_options(CLI::App& app) override {
        models_.add_to(app,
                       "stanford-bunny.obj and igea.ply of the folders in RIMLINE_MODELS, or "
                       "built-in shapes");
        check_option_ = add_check(app, check_);
        app.add_flag("--alphas", alphas_,
                     "Count what an extraction costs over the alpha of the votes for origins, in "
                     "place of the sums")
            ->group("Kind");
        rounds_option_ = add_count(app, "--rounds", options_.rounds, 1, 1000,
                                   "How often each is measured; the least time counts");
        viewpoints_option_ = add_count(app, "--viewpoints", alpha_options_.viewpoints, 1, 1'000'000,
                                       "Extractions of --alphas, at 1, 2 and 3 radii");
        origins_option_ = add_count(app, "--most-origins", alpha_options_.max_origins, 1, 64,
                                    "Origins of --alphas, from one on");
        faces_option_ = add_count(app, "--most-faces", max_faces_, 1, 1u << 28,
                                  "Cluster models of --alphas that have more faces");
        for (CLI::Option* option :
             {rounds_option_, viewpoints_option_, origins_option_, faces_option_})
            option->group("Amount");
        faces_option_->default_str("");
        app.footer(
            "The suite sums a lattice of votes in clusters of planes, checks every point, and\n"
            "chooses four origins. Errors and bounds are shares of the lattice's greatest "
            "value.\n\n"
            "--check requires: igea 10x at an error of 1e-3; for other models, clusters must not\n"
            "be slower than all planes.\n\n"
            "--alphas is Figure 4.9 of the thesis: for each number of origins and each alpha the\n"
            "boxes of the thesis's octrees, PBVs and EBVs apart, and of HoughOctree, means of an\n"
            "extraction. Complete extractions are compared with brute force; exit 3 if one\n"
            "differs. 'SFO from all listed' is 4.4.5 to the letter and misses edges.\n\n"
            "Examples:\n"
            "  rimline bench fields igea.ply --check\n"
            "  rimline bench fields shape:knot:20000 --rounds 1\n"
            "  rimline bench fields fandisk.obj --alphas --viewpoints 150");
    }

    ExitStatus run(const Context& context) override {
        refuse_options_of_other_kinds();
        return alphas_ ? run_alphas(context) : run_sums(context);
    }

private:
    // An option without an effect is an error: the result would not show that it was ignored.
    void refuse_options_of_other_kinds() const {
        const auto refuse = [](std::initializer_list<const CLI::Option*> options, const char* why) {
            for (const CLI::Option* option : options)
                if (option->count() > 0) throw UsageError(option->get_name() + ": " + why);
        };
        if (alphas_)
            refuse({check_option_, rounds_option_}, "not together with --alphas");
        else
            refuse({viewpoints_option_, origins_option_, faces_option_}, "belongs to --alphas");
    }

    std::vector<std::string> models() const {
        return models_.named().empty() ? usual_models() : models_.named();
    }

    ExitStatus run_alphas(const Context& context) {
        std::vector<AlphaResult> results;
        std::string difference;
        for (const std::string& model : models()) {
            Mesh mesh = load_mesh(model, models_.subdivide(), context);
            if (mesh.face_count() > max_faces_) mesh = Mesh(cluster_vertices(mesh, max_faces_));
            results.push_back(about_model(
                model, [&] { return bench_alphas(model, mesh, alpha_options_, context); }));
            const AlphaResult& result = results.back();
            if (!context.json) {
                print_result(result);
                std::fflush(stdout);
            }
            if (difference.empty() && !result.difference.empty())
                difference = model + ": " + result.difference;
        }
        const std::vector<AlphaMean> means = means_of(results);
        if (context.json) {
            nlohmann::ordered_json list = nlohmann::ordered_json::array();
            for (const AlphaResult& result : results) list.push_back(to_json(result));
            print_json({{"alphas", std::move(list)}, {"means", to_json(means)}});
        } else {
            print_means(means);
        }
        return report_difference(difference);
    }

    ExitStatus run_sums(const Context& context) {
        MachineHeading heading;
        nlohmann::ordered_json results = nlohmann::ordered_json::array();
        TargetList all_targets;
        std::string difference;
        for (const std::string& model : models()) {
            const Mesh mesh = load_suite_mesh(model, models_.subdivide(), heading, context);
            const FieldBenchResult result =
                about_model(model, [&] { return bench_fields(model, mesh, options_, context); });
            std::vector<Target> targets;
            if (check_ && result.difference.empty()) targets = targets_of(result);
            all_targets.add(model, targets);
            if (context.json) {
                results.push_back(to_json(result));
            } else {
                print_result(result);
                print_targets(targets);
                std::fflush(stdout);
            }
            if (difference.empty() && !result.difference.empty())
                difference = model + ": " + result.difference;
        }
        if (context.json) {
            nlohmann::ordered_json object{{"machine", to_json(heading.machine())},
                                          {"fields", std::move(results)}};
            if (check_) object["targets"] = all_targets.json();
            print_json(object);
        }
        return difference.empty() ? report_missed(all_targets.first_missed())
                                  : report_difference(difference);
    }

    SuiteModels models_;
    bool check_ = false, alphas_ = false;
    FieldBenchOptions options_;
    AlphaOptions alpha_options_;
    std::uint32_t max_faces_ = 0xffffffffu;
    CLI::Option *check_option_ = nullptr, *rounds_option_ = nullptr, *viewpoints_option_ = nullptr,
                *origins_option_ = nullptr, *faces_option_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_fields_suite() { return std::make_unique<FieldsSuite>(); }

}  // namespace rimline::tools
