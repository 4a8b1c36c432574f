// rimline bench hough: the octree and its tracker against brute force.

#include <CLI/App.hpp>
#include <cstdio>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tools/bench/figures.h"
#include "tools/bench/growth.h"
#include "tools/bench/hough.h"
#include "tools/bench/hough_report.h"
#include "tools/bench/hough_targets.h"
#include "tools/bench/methods.h"
#include "tools/bench/readings.h"
#include "tools/bench/suite_models.h"
#include "tools/bench/suites.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

namespace {

constexpr const char* k_hough_footer =
    "Every result is compared with brute force before anything is timed; exit 3 if one differs.\n"
    "Times are microseconds of one thread, for one point or frame, without the time that other\n"
    "programs took: the least of all rounds for each point, then the median, the mean and high\n"
    "quantiles over the points. A ratio is a method's median over that of the octree or tracker:\n"
    "above 1, ours is faster. Rounds of the methods alternate. boxes, faces and edges are the\n"
    "numbers of tests.\n\n"
    "  octree, tracker    the index, and the tracker that follows a moving point in it\n"
    "  brute force        all face bits, then all edges, by windows of 256 faces in registers\n"
    "  brute tracker      all face bits, those that flipped, their edges: the same change set\n"
    "  brute, bits only   the face bits alone: less work than any update does\n"
    "  scalar             the plain loop over faces and edges, at some of the points\n"
    "  plain loop         reads all planes and a word of each edge, and counts: the machine's "
    "speed\n"
    "  fresh tracker      on a random path with jumps: all face bits, the octree's extraction,\n"
    "                     and a change set by comparing; the cost that a worst update is\n"
    "                     compared with\n"
    "  streamed           the bytes of the changes, beside those of the whole state\n"
    "  VTK                vtkPolyDataSilhouette, the filter's update alone, where Python has it\n\n"
    "Above a million faces the amounts shrink in proportion, to 60 points at least. From 200,000\n"
    "faces on, brute force has a ceiling, twice the plain loop. A time above it is a defect of\n"
    "this bench.\n\n"
    "--check requires: brute force below its ceiling; igea extraction 4x, update 3.5x, streamed "
    "1/4,\n"
    "VTK 300x; igea with --subdivide 2 9x, update 11x; bunny, igea and igea subdivided a worst "
    "update\n"
    "of 1.5x and 200 bytes a face. For any other model and the bunny, neither may be slower than\n"
    "brute force.\n\n"
    "--json has the machine; for each model its sizes, bytes, worst update, ceiling and VTK's\n"
    "time; for each case the methods with times and counters; with --check the targets; with\n"
    "--methods the tables; with --readings the counts; with --growth the sizes, and the number of\n"
    "faces where the octree overtakes brute force.\n\n"
    "Examples:\n"
    "  rimline bench hough bunny.obj igea.ply --check\n"
    "  rimline bench hough igea.ply --subdivide 2 --json\n"
    "  rimline bench hough igea.ply --methods\n"
    "  rimline bench hough shape:knot --growth\n"
    "  rimline bench hough fandisk.obj --figures --json";

class HoughSuite final : public Command {
public:
    std::string name() const override { return "hough"; }
    std::string summary() const override {
        return "The octree and its tracker against the other methods";
    }

    void add_options(CLI::App& app) override {
        models_.add_to(app,
                       "stanford-bunny.obj and igea.ply of the folders in RIMLINE_MODELS, or "
                       "built-in shapes");
        add_kinds(app);
        add_amounts(app);
        app.footer(k_hough_footer);
    }

    ExitStatus run(const Context& context) override {
        refuse_options_of_other_kinds();
        if (growth_) return run_growth(context);
        if (figures_) return run_figures(context);
        if (readings_) return run_readings(context);
        if (methods_) return run_methods(context);
        return run_cases(context);
    }

private:
    void add_kinds(CLI::App& app) {
        constexpr const char* k_group = "Kind";
        check_option_ = add_check(app, check_);
        methods_option_ =
            app.add_flag("--methods", methods_, "Measure all methods in place of the cases");
        app.add_flag("--growth", growth_,
                     "Measure a shape at growing sizes, or a file and its subdivisions, in place "
                     "of the cases (default: shape:knot)")
            ->group(k_group);
        figures_option_ = app.add_flag("--figures", figures_,
                                       "Count the work that the thesis's figures show, in place of "
                                       "the cases; without --json a summary");
        readings_option_ = app.add_flag("--readings", readings_,
                                        "Count for each way to read what the thesis leaves open, "
                                        "in place of the cases");
        no_vtk_option_ = app.add_flag("--no-vtk", no_vtk_, "Leave VTK out where it is installed");
        for (CLI::Option* option :
             {methods_option_, figures_option_, readings_option_, no_vtk_option_})
            option->group(k_group);
    }

    void add_amounts(CLI::App& app) {
        viewpoints_option_ = add_count(
            app, "--viewpoints", amounts_.viewpoints, 1, 1'000'000,
            "Points of static extraction, at 1, 2 and 3 radii; of --growth by default 60");
        frames_option_ = add_count(app, "--frames", amounts_.frames, 1, 1'000'000,
                                   "Steps of half a degree on an orbit at 2 radii; of --growth by "
                                   "default 120");
        worst_frames_option_ = add_count(app, "--worst-frames", amounts_.worst_frames, 1, 1'000'000,
                                         "Steps of the random path");
        rounds_option_ = add_count(app, "--rounds", amounts_.rounds, 1, 1000,
                                   "How often each is measured; the least time counts");
        builds_option_ = add_count(app, "--builds", amounts_.builds, 1, 1000,
                                   "How often the octree is built; the median counts");
        min_option_ = add_count(app, "--least-faces", growth_options_.min_faces, 1, 1u << 28,
                                "The least size of --growth");
        max_option_ = add_count(app, "--most-faces", growth_options_.max_faces, 1, 1u << 28,
                                "The greatest size of --growth, where 10 million take 4.4 GB of "
                                "memory, and of --figures and --readings, there by default the "
                                "model's own");
        for (CLI::Option* option : {viewpoints_option_, frames_option_, worst_frames_option_,
                                    rounds_option_, builds_option_, min_option_, max_option_})
            option->group("Amount");
    }

    // An option without an effect is an error: the result would not show that it was ignored.
    void refuse_options_of_other_kinds() const {
        const auto refuse = [](std::initializer_list<const CLI::Option*> options, const char* why) {
            for (const CLI::Option* option : options)
                if (option->count() > 0) throw UsageError(option->get_name() + ": " + why);
        };
        if (!growth_) refuse({min_option_}, "belongs to --growth");
        if (!growth_ && !figures_ && !readings_)
            refuse({max_option_}, "belongs to --growth, --figures and --readings");
        if (growth_)
            refuse(
                {methods_option_, figures_option_, readings_option_, check_option_, no_vtk_option_,
                 worst_frames_option_, builds_option_, models_.subdivide_option()},
                "not together with --growth");
        if (methods_)
            refuse({figures_option_, readings_option_, check_option_, no_vtk_option_,
                    worst_frames_option_, builds_option_},
                   "not together with --methods");
        if (figures_)
            refuse({readings_option_, check_option_, no_vtk_option_, viewpoints_option_,
                    frames_option_, worst_frames_option_, rounds_option_, builds_option_},
                   "not together with --figures");
        if (readings_)
            refuse({check_option_, no_vtk_option_, frames_option_, worst_frames_option_,
                    rounds_option_, builds_option_},
                   "not together with --readings");
        if (growth_ && models_.named().size() > 1)
            throw UsageError("--growth: takes one model at a time");
    }

    std::vector<std::string> models() const {
        return models_.named().empty() ? usual_models() : models_.named();
    }

    ExitStatus run_cases(const Context& context) {
        amounts_.vtk = !no_vtk_;
        MachineHeading heading;
        nlohmann::ordered_json models_json = nlohmann::ordered_json::array();
        nlohmann::ordered_json cases = nlohmann::ordered_json::array();
        TargetList all_targets;
        std::string difference;
        for (const std::string& model : models()) {
            const Mesh mesh = load_suite_mesh(model, models_.subdivide(), heading, context);
            const ModelResult result =
                about_model(model, [&] { return bench_hough(model, mesh, amounts_, context); });
            std::vector<Target> targets;
            if (check_ && result.difference().empty()) targets = targets_of(result);
            all_targets.add(model, targets);
            if (context.json) {
                models_json.push_back(model_json(result));
                for (auto& c : cases_json(result)) cases.push_back(std::move(c));
            } else {
                print_result(result);
                print_targets(targets);
                if (check_) std::printf("\n");
                std::fflush(stdout);
            }
            if (difference.empty()) difference = result.difference();
        }
        if (context.json) {
            nlohmann::ordered_json object{{"machine", to_json(heading.machine())},
                                          {"viewpoints", amounts_.viewpoints},
                                          {"frames", amounts_.frames},
                                          {"worst_frames", amounts_.worst_frames},
                                          {"rounds", amounts_.rounds},
                                          {"models", std::move(models_json)},
                                          {"cases", std::move(cases)}};
            if (check_) object["targets"] = all_targets.json();
            print_json(object);
        }
        return difference.empty() ? report_missed(all_targets.first_missed())
                                  : report_difference(difference);
    }

    ExitStatus run_methods(const Context& context) {
        MachineHeading heading;
        nlohmann::ordered_json results = nlohmann::ordered_json::array();
        std::string difference;
        for (const std::string& model : models()) {
            const Mesh mesh = load_suite_mesh(model, models_.subdivide(), heading, context);
            const MethodsOptions options{amounts_.viewpoints, amounts_.frames, amounts_.rounds};
            const MethodsResult result =
                about_model(model, [&] { return bench_methods(model, mesh, options, context); });
            if (context.json)
                results.push_back(to_json(result));
            else
                print_result(result);
            if (difference.empty()) difference = result.difference;
        }
        if (context.json)
            print_json({{"machine", to_json(heading.machine())}, {"models", std::move(results)}});
        return report_difference(difference);
    }

    ExitStatus run_growth(const Context& context) {
        const std::string model = models_.named().empty() ? "shape:knot" : models_.named().front();
        growth_options_.bench = {.viewpoints = 60,
                                 .frames = 120,
                                 .worst_frames = 0,
                                 .rounds = amounts_.rounds,
                                 .builds = 1,
                                 .vtk = false};
        if (viewpoints_option_->count() > 0) growth_options_.bench.viewpoints = amounts_.viewpoints;
        if (frames_option_->count() > 0) growth_options_.bench.frames = amounts_.frames;
        MachineHeading heading;
        bool has_names = false;
        const auto on_step = [&](const GrowthStep& step) {
            if (context.json) return;
            heading.print(context);
            if (!has_names) {
                std::printf("%s\n", model.c_str());
                print_growth_names();
                has_names = true;
            }
            print_growth(step);
        };
        const std::vector<GrowthStep> steps =
            bench_growth(model, growth_options_, on_step, context);
        const std::string difference = steps.back().result.difference();
        if (context.json)
            print_json(
                {{"machine", to_json(heading.machine())}, {"growth", to_json(model, steps)}});
        else if (difference.empty())
            print_overtaking(steps);
        return report_difference(difference);
    }

    // Counts each model by count(name, mesh), and prints the results, or a list of them under `key`.
    template <typename Count, typename Print>
    ExitStatus run_counts(const char* key, const Context& context, Count&& count, Print&& print) {
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        std::string difference;
        for (const std::string& model : models()) {
            const Mesh mesh = load_mesh(model, models_.subdivide(), context);
            const auto result = about_model(model, [&] { return count(model, mesh); });
            if (context.json)
                list.push_back(to_json(result));
            else
                print(result);
            if (difference.empty()) difference = result.difference;
        }
        if (context.json) print_json({{key, std::move(list)}});
        return report_difference(difference);
    }

    ExitStatus run_figures(const Context& context) {
        FigureOptions options;
        if (max_option_->count() > 0) options.max_faces = growth_options_.max_faces;
        const auto count = [&](const std::string& model, const Mesh& mesh) {
            return bench_figures(model, mesh, options, context);
        };
        return run_counts("figures", context, count,
                          [](const FigureData& data) { print_summary(data); });
    }

    ExitStatus run_readings(const Context& context) {
        ReadingOptions options;
        if (viewpoints_option_->count() > 0) options.viewpoints = amounts_.viewpoints;
        if (max_option_->count() > 0) options.max_faces = growth_options_.max_faces;
        const auto count = [&](const std::string& model, const Mesh& mesh) {
            return bench_readings(model, mesh, options, context);
        };
        return run_counts("readings", context, count,
                          [](const Readings& readings) { print_result(readings); });
    }

    SuiteModels models_;
    bool check_ = false, methods_ = false, growth_ = false, figures_ = false, readings_ = false,
         no_vtk_ = false;
    HoughBenchOptions amounts_;
    GrowthOptions growth_options_;
    CLI::Option *check_option_ = nullptr, *methods_option_ = nullptr, *figures_option_ = nullptr,
                *readings_option_ = nullptr, *no_vtk_option_ = nullptr,
                *viewpoints_option_ = nullptr, *frames_option_ = nullptr,
                *worst_frames_option_ = nullptr, *rounds_option_ = nullptr,
                *builds_option_ = nullptr, *min_option_ = nullptr, *max_option_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_hough_suite() { return std::make_unique<HoughSuite>(); }

}  // namespace rimline::tools
