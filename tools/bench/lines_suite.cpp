// rimline bench lines: line drawings against a ray for each piece of a line.

#include <CLI/App.hpp>
#include <cstdio>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tools/bench/lines.h"
#include "tools/bench/lines_growth.h"
#include "tools/bench/lines_orbit.h"
#include "tools/bench/lines_report.h"
#include "tools/bench/lines_targets.h"
#include "tools/bench/suite_models.h"
#include "tools/bench/suites.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

namespace {

class LinesSuite final : public Command {
public:
    std::string name() const override { return "lines"; }
    std::string summary() const override {
        return "Line drawings against a ray for each piece of a line";
    }

    void add_options(CLI::App& app) override {
        models_.add_to(app,
                       "stanford-bunny.obj and igea.ply of the folders in RIMLINE_MODELS, or "
                       "built-in shapes");
        constexpr const char* k_kind = "Kind";
        check_option_ = add_check(app, check_);
        app.add_flag("--growth", growth_,
                     "Measure a shape at growing sizes, or a file and its subdivisions, in place "
                     "of the models (default: shape:knot)")
            ->group(k_kind);
        app.add_flag("--orbit", orbit_,
                     "Measure how far lines keep their identity while a camera moves, in place "
                     "of single views")
            ->group(k_kind);
        app.add_flag("--all-lines", all_lines_,
                     "Draw creases and intersections too, and not only silhouettes and borders")
            ->group(k_kind);
        no_others_option_ = app.add_flag("--no-others", no_others_,
                                         "Leave other programs out where they are installed")
                                ->group(k_kind);
        constexpr const char* k_amount = "Amount";
        views_option_ = add_count(app, "--views", options_.views, 1, 10'000,
                                  "Views around the model; of --growth by default 5");
        min_option_ = add_count(app, "--least-faces", growth_options_.min_faces, 1, 1u << 30,
                                "Of --growth: the smallest mesh");
        max_option_ = add_count(app, "--most-faces", growth_options_.max_faces, 1, 1u << 30,
                                "Of --growth: the largest mesh");
        rounds_option_ = add_count(app, "--rounds", options_.rounds, 1, 1000,
                                   "Rounds; the least time of each view counts");
        frames_option_ =
            add_count(app, "--frames", orbit_options_.frames, 2, 100'000, "Of --orbit: frames");
        step_option_ =
            app.add_option("--step", orbit_options_.step_degrees, "Of --orbit: degrees a frame")
                ->check(CLI::Range(1e-6, 180.0))
                ->type_name("DEGREES")
                ->capture_default_str();
        for (CLI::Option* option : {views_option_, rounds_option_, min_option_, max_option_,
                                    frames_option_, step_option_})
            option->group(k_amount);
        app.footer(
            "The oracle counts the faces before each line in long double first; exit 3 where a\n"
            "count differs. Times are of one thread: the least of all rounds for each view, then\n"
            "the median and the worst of all views. A drawing finds the visibility of all lines,\n"
            "chains, coincident lines and strokes; the silhouette is given. Its shape, smooth and\n"
            "without stubble as `draw` has it, is timed apart. A ray a piece is what\n"
            "is usual instead: the lines are cut where they cross, and one ray of Embree for each\n"
            "piece decides. Its time has the rays alone. Its wrong length is where it differs "
            "from\n"
            "the drawing that the oracle checked. Creases bend by at least 40 degrees.\n\n"
            "--orbit draws each frame of an orbit fresh, and again as the next one after the "
            "frame\n"
            "before. Edges that are lines in two frames keep their id where the chains that they\n"
            "belong to have the same.\n\n"
            "Blender's Freestyle and Line Art and Open CASCADE draw the first view of the same "
            "mesh\n"
            "where they are installed. A piece has the visibility that their nearest line says, "
            "and\n"
            "is not drawn where none is near. Their times are what they say of themselves.\n\n"
            "--check requires that no sample is wrong, and that a drawing takes at most twice the\n"
            "time of the rays alone. The times of bunny (2 ms), igea (8 ms, worst 16 ms; 80 ms as "
            "a\n"
            "whole) and igea with --subdivide 2 (30 ms) are shown beside their targets.\n\n"
            "Examples:\n"
            "  rimline bench lines bunny.obj igea.ply --check\n"
            "  rimline bench lines igea.ply --subdivide 2 --json\n"
            "  rimline bench lines shape:knot --growth\n"
            "  rimline bench lines igea.ply --orbit --frames 720");
    }

    ExitStatus run(const Context& context) override {
        refuse_options_without_effect();
        options_.measures_others = !no_others_ && !growth_;
        if (all_lines_) options_.lines.kinds.fill(true);
        if (orbit_) return run_orbits(context);
        return growth_ ? run_growth(context) : run_models(context);
    }

private:
    void refuse_options_without_effect() const {
        const auto refuse = [](std::initializer_list<const CLI::Option*> options, const char* why) {
            for (const CLI::Option* option : options)
                if (option->count() > 0) throw UsageError(option->get_name() + ": " + why);
        };
        if (!growth_) refuse({min_option_, max_option_}, "belongs to --growth");
        if (growth_)
            refuse({check_option_, no_others_option_, models_.subdivide_option()},
                   "not together with --growth");
        if (!orbit_) refuse({frames_option_, step_option_}, "belongs to --orbit");
        if (orbit_)
            refuse({check_option_, no_others_option_, views_option_, rounds_option_},
                   "not together with --orbit");
        if (orbit_ && growth_) throw UsageError("--orbit: not together with --growth");
        if (growth_ && models_.named().size() > 1)
            throw UsageError("--growth: takes one model at a time");
    }

    std::vector<std::string> named_or_usual_models() const {
        return models_.named().empty() ? usual_models() : models_.named();
    }

    ExitStatus run_models(const Context& context) {
        MachineHeading heading;
        nlohmann::ordered_json models = nlohmann::ordered_json::array();
        TargetList all_targets;
        std::string difference;
        for (const std::string& model : named_or_usual_models()) {
            const Mesh mesh = load_mesh(model, models_.subdivide(), context);
            check_has_extent(model, mesh);
            heading.print(context);
            const LinesResult result =
                about_model(model, [&] { return bench_lines(model, mesh, options_, context); });
            std::vector<Target> targets;
            if (check_ && result.difference.empty()) targets = targets_of(result);
            all_targets.add(model, targets);
            if (context.json) {
                models.push_back(to_json(result));
            } else {
                print_result(result);
                print_targets(targets);
                if (check_) std::printf("\n");
                std::fflush(stdout);
            }
            if (difference.empty() && !result.difference.empty())
                difference = model + ": " + result.difference;
        }
        if (context.json) {
            nlohmann::ordered_json object{{"machine", to_json(heading.machine())},
                                          {"rounds", options_.rounds},
                                          {"models", std::move(models)}};
            if (check_) object["targets"] = all_targets.json();
            print_json(object);
        }
        return difference.empty() ? report_missed(all_targets.first_missed())
                                  : report_check(difference);
    }

    ExitStatus run_orbits(const Context& context) {
        MachineHeading heading;
        orbit_options_.lines = options_.lines;
        nlohmann::ordered_json orbits = nlohmann::ordered_json::array();
        for (const std::string& model : named_or_usual_models()) {
            const Mesh mesh = load_mesh(model, models_.subdivide(), context);
            check_has_extent(model, mesh);
            heading.print(context);
            const LinesOrbitResult result = about_model(
                model, [&] { return bench_lines_orbit(model, mesh, orbit_options_, context); });
            if (context.json)
                orbits.push_back(to_json(result));
            else
                print_orbit(result);
        }
        if (context.json)
            print_json({{"machine", to_json(heading.machine())}, {"orbits", std::move(orbits)}});
        return ExitStatus::success;
    }

    ExitStatus run_growth(const Context& context) {
        const std::string model = models_.named().empty() ? "shape:knot" : models_.named().front();
        growth_options_.bench = options_;
        growth_options_.bench.measures_threads = growth_options_.bench.measures_whole = false;
        if (views_option_->count() == 0) growth_options_.bench.views = 5;
        MachineHeading heading;
        bool has_names = false;
        const auto on_step = [&](const LinesGrowthStep& step) {
            if (context.json) return;
            heading.print(context);
            if (!has_names) {
                std::printf("%s\n", model.c_str());
                print_lines_growth_names();
                has_names = true;
            }
            print_growth(step);
        };
        const std::vector<LinesGrowthStep> steps =
            bench_lines_growth(model, growth_options_, on_step, context);
        const LinesResult& last = steps.back().result;
        if (context.json)
            print_json(
                {{"machine", to_json(heading.machine())}, {"growth", to_json(model, steps)}});
        return report_check(last.difference.empty() ? "" : last.model + ": " + last.difference);
    }

    SuiteModels models_;
    bool check_ = false, growth_ = false, orbit_ = false, all_lines_ = false, no_others_ = false;
    LinesBenchOptions options_;
    LinesGrowthOptions growth_options_;
    LinesOrbitOptions orbit_options_;
    CLI::Option *check_option_ = nullptr, *no_others_option_ = nullptr, *views_option_ = nullptr,
                *min_option_ = nullptr, *max_option_ = nullptr, *rounds_option_ = nullptr,
                *frames_option_ = nullptr, *step_option_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_lines_suite() { return std::make_unique<LinesSuite>(); }

}  // namespace rimline::tools
