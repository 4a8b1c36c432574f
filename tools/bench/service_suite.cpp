// rimline bench service: many trackers on threads of their own.

#include <CLI/App.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "tools/bench/service.h"
#include "tools/bench/service_report.h"
#include "tools/bench/suite_models.h"
#include "tools/bench/suites.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

namespace {

class ServiceSuite final : public Command {
public:
    std::string name() const override { return "service"; }
    std::string summary() const override {
        return "Many trackers on threads of their own, at a steady frame rate";
    }

    void add_options(CLI::App& app) override {
        models_.add_to(app,
                       "stanford-bunny.obj and igea.ply of the folders in RIMLINE_MODELS, or "
                       "built-in shapes");
        for (CLI::Option* option :
             {add_count(app, "--trackers", options_.trackers, 1, 100'000,
                        "How many trackers: a camera and lights"),
              add_count(app, "--frames", options_.frames, 1, 1'000'000, "How many frames"),
              add_number(app, "--fps", options_.frames_per_second, 1.0, 10'000.0,
                         "Frames a second"),
              add_count(app, "--workers", options_.workers, 0, 1024,
                        "Threads of the service; 0 takes as many as the machine has")})
            option->group("Amount");
        app.footer(
            "One thread plays the renderer: at the beginning of each frame it takes all change\n"
            "sets and posts where every point is. The first frames are compared with brute force.\n"
            "The tables have the processor time of the workers, beside the same moves in a loop "
            "on\n"
            "one thread, and the times of posting, of taking, and from post to publication.\n\n"
            "Examples:\n"
            "  rimline bench service igea.ply --trackers 64\n"
            "  rimline bench service shape:knot:70000 --fps 120 --workers 2 --json");
    }

    ExitStatus run(const Context& context) override {
        MachineHeading heading;
        std::vector<std::unique_ptr<Mesh>> meshes;
        std::vector<ServiceBenchModel> models;
        for (const std::string& name : models_.named().empty() ? usual_models() : models_.named()) {
            meshes.push_back(std::make_unique<Mesh>(
                load_suite_mesh(name, models_.subdivide(), heading, context)));
            models.push_back({name, meshes.back().get()});
        }
        const ServiceResult result = bench_service(models, options_, context);
        if (context.json)
            print_json({{"machine", to_json(heading.machine())}, {"service", to_json(result)}});
        else
            print_result(result);
        return report_difference(result.difference);
    }

private:
    SuiteModels models_;
    ServiceBenchOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_service_suite() { return std::make_unique<ServiceSuite>(); }

}  // namespace rimline::tools
