// rimline bench fields: tangential distance fields.

#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/bench/fields.h"
#include "tools/bench/suite_models.h"
#include "tools/bench/suites.h"
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
        add_check(app, check_);
        add_count(app, "--rounds", options_.rounds, 1, 1000,
                  "How often each is measured; the least time counts")
            ->group("Amount");
        app.footer(
            "The suite sums a lattice of votes in clusters of planes, checks every point, and\n"
            "chooses four origins. Errors and bounds are shares of the lattice's greatest "
            "value.\n\n"
            "--check requires: igea 10x at an error of 1e-3; for other models, clusters must not\n"
            "be slower than all planes.\n\n"
            "Examples:\n"
            "  rimline bench fields igea.ply --check\n"
            "  rimline bench fields shape:knot:20000 --rounds 1");
    }

    ExitStatus run(const Context& context) override {
        MachineHeading heading;
        nlohmann::ordered_json results = nlohmann::ordered_json::array();
        TargetList all_targets;
        std::string difference;
        for (const std::string& model :
             models_.named().empty() ? usual_models() : models_.named()) {
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

private:
    SuiteModels models_;
    bool check_ = false;
    FieldBenchOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_fields_suite() { return std::make_unique<FieldsSuite>(); }

}  // namespace rimline::tools
