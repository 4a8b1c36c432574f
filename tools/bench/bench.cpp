// rimline bench: suites of measurements, each a subcommand of its own.

#include <CLI/App.hpp>
#include <algorithm>
#include <memory>
#include <vector>

#include "tools/bench/suites.h"
#include "tools/command.h"

namespace rimline::tools {

namespace {

class BenchCommand final : public Command {
public:
    std::string name() const override { return "bench"; }
    std::string summary() const override { return "Measure against baselines, checked first"; }

    void add_options(CLI::App& app) override {
        suites_.push_back({make_hough_suite()});
        suites_.push_back({make_service_suite()});
        suites_.push_back({make_engine_suite()});
        suites_.push_back({make_frames_suite()});
        suites_.push_back({make_fields_suite()});
        suites_.push_back({make_views_suite()});
        suites_.push_back({make_points_suite()});
        suites_.push_back({make_lines_suite()});
        suites_.push_back({make_edges_suite()});
        for (Suite& suite : suites_) {
            suite.app = app.add_subcommand(suite.command->name(), suite.command->summary());
            suite.command->add_options(*suite.app);
        }
        app.require_subcommand(1);
        app.footer(
            "rimline bench SUITE --help describes a suite: its options, its tables, its JSON and\n"
            "what --check requires. A suite that measures times compares its results first, and\n"
            "exits with status 3 where one differs.\n\n"
            "Without MODELS a suite takes known files from the folders of RIMLINE_MODELS, or\n"
            "built-in shapes.\n\n"
            "Examples:\n"
            "  rimline bench hough bunny.obj igea.ply --check\n"
            "  rimline bench engine --device gpu\n"
            "  rimline bench points --json");
    }

    ExitStatus run(const Context& context) override {
        const auto chosen =
            std::ranges::find_if(suites_, [](const Suite& suite) { return suite.app->parsed(); });
        RIMLINE_CHECK(chosen != suites_.end());
        return chosen->command->run(context);
    }

private:
    struct Suite {
        std::unique_ptr<Command> command;
        CLI::App* app = nullptr;
    };
    std::vector<Suite> suites_;
};

}  // namespace

std::unique_ptr<Command> make_bench_command() { return std::make_unique<BenchCommand>(); }

}  // namespace rimline::tools
