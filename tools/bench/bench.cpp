// rimline bench: measures, against baselines, what it has checked first.

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "tools/bench/engine_request.h"
#include "tools/bench/fields.h"
#include "tools/bench/figures.h"
#include "tools/bench/growth.h"
#include "tools/bench/hough.h"
#include "tools/bench/machine.h"
#include "tools/bench/methods.h"
#include "tools/bench/points.h"
#include "tools/bench/report.h"
#include "tools/bench/service.h"
#include "tools/bench/service_report.h"
#include "tools/bench/targets.h"
#include "tools/bench/views_request.h"
#include "tools/command.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

namespace {

constexpr const char* k_footer =
    "Every result is compared with brute force before anything is timed; exit 3 if one differs.\n"
    "Times are microseconds of one thread, for one point or frame, without what other programs\n"
    "took from it: of each point the least of all rounds, then the median, mean and high\n"
    "quantiles over the points. A ratio is a method's median over that of the octree or tracker:\n"
    "above 1, ours is faster. Rounds of the methods alternate. boxes, faces, edges are how many\n"
    "were tested.\n\n"
    "  octree, tracker    the index, and what follows a moving point in it\n"
    "  packed             brute force for wide registers: all face bits, then all edges\n"
    "  packed tracker     all face bits, those that flipped, their edges: the same change set\n"
    "  packed, bits only  the face bits alone: less than any update has to do\n"
    "  scalar             the plain loop over faces and edges, at some of the points\n"
    "  plain loop         reads all planes and counts front faces: the machine's own speed\n"
    "  fresh tracker      on a random path with jumps: all face bits, the octree's extraction,\n"
    "                     and a change set by comparing; what no update may much exceed\n"
    "  streamed           the bytes of the changes, beside those of the whole state\n"
    "  VTK                vtkPolyDataSilhouette, the filter's update alone, where Python has it\n\n"
    "Above a million faces the amounts shrink in proportion, to 60 points at least. On the bunny\n"
    "and igea, packed has a ceiling: what it took on a known machine with AVX-512, scaled by the\n"
    "plain loop; above it is a defect of this bench with AVX-512, and unknown elsewhere.\n"
    "--check asks: bunny extraction 2x; igea 5x, update 10x, streamed 1/4, VTK 300x; igea with\n"
    "--subdivide 2 15x, update 20x; on all three a worst update of 1.5x, 200 bytes a face. Of\n"
    "any other model, only that neither is slower than brute force.\n\n"
    "--json has the machine; for each model its sizes, bytes, worst update, ceiling and VTK's\n"
    "time; for each case the methods with times and counters; with --check the targets; with\n"
    "--methods the tables; with --growth the sizes, and the number of faces where the octree\n"
    "overtakes brute force.\n\n"
    "engine draws on a Vulkan device. By model: bytes streamed a frame by step size, frames with\n"
    "lines by every path, with shadows, and visible ratios, pictures and counts compared first. A\n"
    "ratio is a way's median over the first's. --check asks: igea streamed 1/4; closed meshes of\n"
    "60,000 to 110,000 faces adjacency 1.8x, visible ratios 1.4x. Its --growth has the stream,\n"
    "compute shaders and adjacency from 10,000 faces to --most-faces, there by default 300,000.\n\n"
    "views chooses four views by planes' votes and by other measures at 256 candidates: the share\n"
    "of faces whose middle is seen from one of them; the least, mean and greatest angle between\n"
    "two; by how much the first moves with a quarter of the faces, and with vertices moved by a\n"
    "thousandth of the radius. Lights at the best views: the share of visible pixels that turn\n"
    "away, those in cast shadow too, and the mean gradient of shading. --check asks of the bunny:\n"
    "5x fewer viewpoints drawn than the lattice has.\n\n"
    "fields sums a lattice of votes in clusters of planes, checked at every point, and chooses\n"
    "four origins. Errors and bounds are shares of the lattice's greatest value. --check asks of "
    "igea\n"
    "10x at an error of 1e-3; of others, that clusters are not slower than all planes.\n\n"
    "points makes umbrellas of the vertices alone of every model found in RIMLINE_MODELS, or of\n"
    "built-in shapes, and counts border points missed and extra, beside the largest gap of\n"
    "directions that PCL and Open3D go by (our own implementation, and theirs where Python\n"
    "imports open3d and pcl-tools are there), normals' errors against the mesh, and points a\n"
    "second of one thread. --check asks: four fifths of the open models whose openings span\n"
    "three spacings within 4% missed and 7% extra; smooth closed ones at most 10 extra but for\n"
    "those around holes in their samples, fandisk none.\n\n"
    "Examples:\n"
    "  rimline bench points --check\n"
    "  rimline bench fields igea.ply --check\n"
    "  rimline bench hough bunny.obj igea.ply --check\n"
    "  rimline bench hough igea.ply --subdivide 2 --json\n"
    "  rimline bench hough igea.ply --methods\n"
    "  rimline bench hough shape:knot --growth\n"
    "  rimline bench hough fandisk.obj --figures --json\n"
    "  rimline bench service igea.ply --trackers 64\n"
    "  rimline bench engine --check\n"
    "  rimline bench views horse.ply\n"
    "  rimline bench engine --growth --most-faces 10000000 --device gpu";

// In the folders of RIMLINE_MODELS.
std::optional<std::string> find_model(const std::string& file_name) {
    const char* folders = std::getenv("RIMLINE_MODELS");
    std::istringstream stream(folders ? folders : "");
    for (std::string folder; std::getline(stream, folder, ':');) {
        const std::filesystem::path path = std::filesystem::path(folder) / file_name;
        std::error_code ignored;
        if (!folder.empty() && std::filesystem::exists(path, ignored)) return path.string();
    }
    return std::nullopt;
}

// What is measured when no model is named: the field's usual ones where they are, else shapes.
std::vector<std::string> usual_models() {
    std::vector<std::string> models;
    for (const char* file_name : {"stanford-bunny.obj", "igea.ply"})
        if (const auto path = find_model(file_name)) models.push_back(*path);
    if (models.empty()) models = {"shape:knot:70000", "shape:sphere:70000", "shape:knot:270000"};
    return models;
}

ExitStatus report_difference(const std::string& difference) {
    return report_check(difference.empty() ? "" : difference + " differs from brute force");
}

class BenchCommand final : public Command {
public:
    std::string name() const override { return "bench"; }
    std::string summary() const override { return "Measure against baselines, checked first"; }

    void add_options(CLI::App& app) override {
        app.add_option("SUITE", suite_,
                       "What to measure: hough, the octree and its tracker; service, many trackers "
                       "on threads of their own; engine, streams and frames on a Vulkan device; "
                       "fields, tangential distance fields; views, the best views and lights "
                       "beside those of other measures; points, borders and normals of meshes "
                       "whose faces are thrown away")
            ->type_name("")
            ->required()
            ->check(CLI::IsMember({"hough", "service", "engine", "fields", "views", "points"}));
        app.add_option_function<std::vector<std::string>>(
               "MODELS",
               [this](const std::vector<std::string>& texts) {
                   for (const std::string& text : texts) check_model_name(text);
                   models_ = texts;
               },
               model_description() +
                   " (default: stanford-bunny.obj and igea.ply of the folders in RIMLINE_MODELS, "
                   "or built-in shapes)")
            ->type_name("");
        subdivide_option_ = add_subdivide(app, subdivide_)->group("Model");
        add_kinds(app);
        add_amounts(app);
        app.footer(k_footer);
    }

    ExitStatus run(const Context& context) override {
        refuse_options_of_others();
        machine_ = this_machine();
        if (suite_ == "service") return run_service(context);
        if (suite_ == "engine") return run_bench_engine(engine_request(), context);
        if (suite_ == "views") return run_bench_views(views_request(), context);
        if (suite_ == "fields") return run_fields(context);
        if (suite_ == "points")
            return run_bench_points(models_, subdivide_, noise_, check_, context);
        if (growth_) return run_growth(context);
        if (figures_) return run_figures(context);
        if (methods_) return run_methods(context);
        return run_hough(context);
    }

private:
    void add_kinds(CLI::App& app) {
        constexpr const char* k_group = "Kind";
        check_option_ = app.add_flag("--check", check_,
                                     "Compare the ratios with what is asked of them; exit 3 where "
                                     "one is missed");
        methods_option_ = app.add_flag("--methods", methods_,
                                       "Measure every method there is, in place of the cases");
        growth_option_ = app.add_flag("--growth", growth_,
                                      "Measure a shape at growing sizes, or a file and its "
                                      "subdivisions, in place of the cases (default: shape:knot)");
        figures_option_ = app.add_flag("--figures", figures_,
                                       "Count the work that the thesis's figures show, in place of "
                                       "the cases; without --json a summary");
        no_vtk_option_ = app.add_flag("--no-vtk", no_vtk_, "Leave VTK out where it is installed");
        for (CLI::Option* option :
             {check_option_, methods_option_, growth_option_, figures_option_, no_vtk_option_})
            option->group(k_group);
    }

    void add_amounts(CLI::App& app) {
        constexpr const char* k_group = "Amount";
        viewpoints_option_ = add_count(app, "--viewpoints", hough_.viewpoints, 1, 1'000'000,
                                       "Points of static extraction, at 1, 2 and 3 radii");
        frames_option_ = add_count(app, "--frames", hough_.frames, 1, 1'000'000,
                                   "Steps of half a degree on an orbit at 2 radii; frames of the "
                                   "service, there by default 600");
        worst_frames_option_ = add_count(app, "--worst-frames", hough_.worst_frames, 1, 1'000'000,
                                         "Steps of the random path");
        rounds_option_ = add_count(app, "--rounds", hough_.rounds, 1, 1000,
                                   "Times that each is measured; the least counts");
        builds_option_ = add_count(app, "--builds", hough_.builds, 1, 1000,
                                   "Times that the octree is built; the median counts");
        min_option_ =
            add_count(app, "--least-faces", growth_options_.min_faces, 1, 1u << 28, "Of --growth");
        max_option_ = add_count(app, "--most-faces", growth_options_.max_faces, 1, 1u << 28,
                                "Of --growth, where 10 million take 4.4 GB of memory, and of "
                                "--figures, there by default the model's own");
        trackers_option_ = add_count(app, "--trackers", service_.trackers, 1, 100'000,
                                     "Of the service: a camera and lights");
        fps_option_ = add_number(app, "--fps", service_.frames_per_second, 1.0, 10'000.0,
                                 "Of the service: frames a second");
        workers_option_ = add_count(app, "--workers", service_.workers, 0, 1024,
                                    "Of the service: threads; 0 leaves it to the machine");
        noise_option_ = add_number(app, "--noise", noise_, 0.0, 1.0,
                                   "Of points: the standard deviation by which every coordinate is "
                                   "moved, in mean lengths of the vertex's edges");
        device_option_ = app.add_option("--device", device_,
                                        "Of the engine: gpu, cpu, an index, or a part of a name");
        pictures_option_ =
            app.add_option("--pictures", pictures_,
                           "Of views: draw the experiments of thesis 4.5.4 into this "
                           "folder, in place of the measures")
                ->type_name("FOLDER");
        up_option_ = add_direction(app, "--up", up_, "Of --pictures: what is up in the models");
        for (CLI::Option* option :
             {pictures_option_, up_option_, device_option_, viewpoints_option_, frames_option_,
              worst_frames_option_, rounds_option_, builds_option_, min_option_, max_option_,
              trackers_option_, fps_option_, workers_option_, noise_option_})
            option->group(k_group);
    }

    // An option that would not be heeded is a mistake that nothing in the result shows.
    void refuse_options_of_others() const {
        const auto refuse = [](bool is_refused, const CLI::Option* option, const char* why) {
            if (is_refused && option->count() > 0)
                throw UsageError(option->get_name() + ": " + why);
        };
        const bool is_service = suite_ == "service";
        const bool is_engine = suite_ == "engine";
        const bool is_views = suite_ == "views";
        refuse(!is_views, pictures_option_, "belongs to the suite views");
        refuse(pictures_.empty(), pictures_option_, "expected a folder, not ''");
        refuse(!is_views || pictures_.empty(), up_option_, "belongs to --pictures");
        refuse(is_views && !pictures_.empty(), check_option_, "not together with --pictures");
        refuse(!is_engine && !is_views, device_option_, "belongs to the suites engine and views");
        for (const CLI::Option* option :
             {methods_option_, growth_option_, figures_option_, no_vtk_option_, viewpoints_option_,
              frames_option_, worst_frames_option_, rounds_option_, builds_option_})
            refuse(is_views, option, "belongs to other suites");
        const bool is_fields = suite_ == "fields";
        for (const CLI::Option* option :
             {methods_option_, growth_option_, figures_option_, no_vtk_option_, viewpoints_option_,
              frames_option_, worst_frames_option_, builds_option_})
            refuse(is_fields, option, "does not belong to the suite fields");
        for (const CLI::Option* option : {methods_option_, figures_option_, no_vtk_option_,
                                          worst_frames_option_, builds_option_})
            refuse(is_engine, option, "belongs to the suite hough");
        const bool is_points = suite_ == "points";
        for (const CLI::Option* option :
             {methods_option_, growth_option_, figures_option_, no_vtk_option_, viewpoints_option_,
              frames_option_, worst_frames_option_, rounds_option_, builds_option_})
            refuse(is_points, option, "does not belong to the suite points");
        refuse(!is_points, noise_option_, "belongs to the suite points");
        if (is_engine && growth_ && !models_.empty())
            throw UsageError("--growth: of the engine it measures shape:knot");
        for (const CLI::Option* option :
             {check_option_, methods_option_, growth_option_, figures_option_, no_vtk_option_,
              viewpoints_option_, worst_frames_option_, rounds_option_, builds_option_})
            refuse(is_service, option, "belongs to the suite hough");
        for (const CLI::Option* option : {trackers_option_, fps_option_, workers_option_})
            refuse(!is_service, option, "belongs to the suite service");
        refuse(!growth_, min_option_, "belongs to --growth");
        refuse(!growth_ && !figures_, max_option_, "belongs to --growth and --figures");
        refuse(growth_, methods_option_, "not together with --growth");
        refuse(growth_ || methods_, figures_option_, "not together with --growth or --methods");
        for (const CLI::Option* option :
             {check_option_, no_vtk_option_, viewpoints_option_, frames_option_,
              worst_frames_option_, rounds_option_, builds_option_})
            refuse(figures_, option, "not together with --figures");
        for (const CLI::Option* option :
             {check_option_, no_vtk_option_, worst_frames_option_, builds_option_})
            refuse(growth_ || methods_, option, "not together with --growth or --methods");
        refuse(growth_, subdivide_option_, "not together with --growth, which subdivides itself");
        if (growth_ && models_.size() > 1) throw UsageError("--growth: takes one model at a time");
    }

    // Not before the first model is there: what cannot be read leaves standard output empty.
    Mesh load(const std::string& model, const Context& context) {
        Mesh mesh = load_mesh(model, subdivide_, context);
        check_viewing_range(model, mesh);
        say_machine(context);
        return mesh;
    }
    void say_machine(const Context& context) {
        if (!context.json && !said_machine_) print_machine(machine_);
        said_machine_ = true;
    }

    std::vector<std::string> models() const { return models_.empty() ? usual_models() : models_; }

    ExitStatus run_hough(const Context& context) {
        hough_.vtk = !no_vtk_;
        nlohmann::ordered_json models_json = nlohmann::ordered_json::array();
        nlohmann::ordered_json cases = nlohmann::ordered_json::array();
        nlohmann::ordered_json targets_json = nlohmann::ordered_json::array();
        std::string difference;
        std::string missed;
        for (const std::string& model : models()) {
            const Mesh mesh = load(model, context);
            const ModelResult result =
                about_model(model, [&] { return bench_hough(model, mesh, hough_, context); });
            std::vector<Target> targets;
            if (check_ && result.difference().empty()) targets = targets_of(result);
            if (context.json) {
                models_json.push_back(model_json(result));
                for (auto& c : cases_json(result)) cases.push_back(std::move(c));
                for (const Target& target : targets) targets_json.push_back(to_json(target, model));
            } else {
                print_result(result);
                print_targets(targets);
                if (check_) std::printf("\n");
                std::fflush(stdout);
            }
            if (difference.empty()) difference = result.difference();
            const std::string what = first_missed(targets);
            if (missed.empty() && !what.empty()) missed = model + ": " + what;
        }
        if (context.json) {
            nlohmann::ordered_json object{
                {"machine", to_json(machine_)}, {"viewpoints", hough_.viewpoints},
                {"frames", hough_.frames},      {"worst_frames", hough_.worst_frames},
                {"rounds", hough_.rounds},      {"models", std::move(models_json)},
                {"cases", std::move(cases)}};
            if (check_) object["targets"] = std::move(targets_json);
            print_json(object);
        }
        return difference.empty() ? report_missed(missed) : report_difference(difference);
    }

    ExitStatus run_methods(const Context& context) {
        nlohmann::ordered_json results = nlohmann::ordered_json::array();
        std::string difference;
        for (const std::string& model : models()) {
            const Mesh mesh = load(model, context);
            const MethodsOptions options{hough_.viewpoints, hough_.frames, hough_.rounds};
            const MethodsResult result =
                about_model(model, [&] { return bench_methods(model, mesh, options, context); });
            if (context.json)
                results.push_back(to_json(result));
            else
                print_result(result);
            if (difference.empty()) difference = result.difference;
        }
        if (context.json)
            print_json({{"machine", to_json(machine_)}, {"models", std::move(results)}});
        return report_difference(difference);
    }

    ExitStatus run_growth(const Context& context) {
        const std::string model = models_.empty() ? "shape:knot" : models_.front();
        growth_options_.bench = {.viewpoints = 60,
                                 .frames = 120,
                                 .worst_frames = 0,
                                 .rounds = hough_.rounds,
                                 .builds = 1,
                                 .vtk = false};
        if (viewpoints_option_->count() > 0) growth_options_.bench.viewpoints = hough_.viewpoints;
        if (frames_option_->count() > 0) growth_options_.bench.frames = hough_.frames;
        const auto on_step = [&](const GrowthStep& step) {
            if (context.json) return;
            if (!said_machine_) {
                say_machine(context);
                std::printf("%s\n", model.c_str());
                print_growth_names();
            }
            print_growth(step);
        };
        const std::vector<GrowthStep> steps =
            bench_growth(model, growth_options_, on_step, context);
        const std::string difference = steps.back().result.difference();
        if (context.json)
            print_json({{"machine", to_json(machine_)}, {"growth", to_json(model, steps)}});
        else if (difference.empty())
            print_overtaking(steps);
        return report_difference(difference);
    }

    ExitStatus run_figures(const Context& context) {
        FigureOptions options;
        if (max_option_->count() > 0) options.max_faces = growth_options_.max_faces;
        nlohmann::ordered_json figures = nlohmann::ordered_json::array();
        std::string difference;
        for (const std::string& model : models()) {
            const Mesh mesh = load_mesh(model, subdivide_, context);
            const FigureData data =
                about_model(model, [&] { return bench_figures(model, mesh, options, context); });
            if (context.json)
                figures.push_back(to_json(data));
            else
                print_summary(data);
            if (difference.empty()) difference = data.difference;
        }
        if (context.json) print_json({{"figures", std::move(figures)}});
        return report_difference(difference);
    }

    ExitStatus run_fields(const Context& context) {
        const FieldBenchOptions options{hough_.rounds};
        nlohmann::ordered_json results = nlohmann::ordered_json::array();
        nlohmann::ordered_json targets_json = nlohmann::ordered_json::array();
        std::string difference;
        std::string missed;
        for (const std::string& model : models()) {
            const Mesh mesh = load(model, context);
            const FieldBenchResult result =
                about_model(model, [&] { return bench_fields(model, mesh, options, context); });
            std::vector<Target> targets;
            if (check_ && result.difference.empty()) targets = targets_of(result);
            if (context.json) {
                results.push_back(to_json(result));
                for (const Target& target : targets) targets_json.push_back(to_json(target, model));
            } else {
                print_result(result);
                print_targets(targets);
                std::fflush(stdout);
            }
            if (difference.empty() && !result.difference.empty())
                difference = model + ": " + result.difference;
            const std::string what = first_missed(targets);
            if (missed.empty() && !what.empty()) missed = model + ": " + what;
        }
        if (context.json) {
            nlohmann::ordered_json object{{"machine", to_json(machine_)},
                                          {"fields", std::move(results)}};
            if (check_) object["targets"] = std::move(targets_json);
            print_json(object);
        }
        return difference.empty() ? report_missed(missed) : report_difference(difference);
    }

    // Igea for the bytes, and a closed mesh of 70,000 faces for the rest.
    EngineBenchRequest engine_request() const {
        EngineBenchRequest request{.models = models_,
                                   .subdivide = subdivide_,
                                   .device = device_,
                                   .check = check_,
                                   .growth = growth_};
        if (models_.empty()) {
            if (const auto igea = find_model("igea.ply")) request.models.push_back(*igea);
            request.models.emplace_back("shape:knot:70000");
        }
        if (viewpoints_option_->count() > 0) request.options.viewpoints = hough_.viewpoints;
        if (frames_option_->count() > 0) request.options.frames = hough_.frames;
        if (rounds_option_->count() > 0) request.options.rounds = hough_.rounds;
        if (min_option_->count() > 0) request.min_faces = growth_options_.min_faces;
        if (max_option_->count() > 0) request.max_faces = growth_options_.max_faces;
        return request;
    }

    ViewsBenchRequest views_request() const {
        ViewsBenchRequest request{
            .models = models_, .subdivide = subdivide_, .device = device_, .check = check_};
        request.pictures = pictures_;
        request.up = up_;
        if (models_.empty()) {
            for (const char* file_name :
                 {"stanford-bunny.obj", "horse.ply", "rocker-arm.obj", "fandisk.obj"})
                if (const auto path = find_model(file_name)) request.models.push_back(*path);
            if (request.models.empty()) request.models = {"shape:knot:70000", "shape:spring:20000"};
        }
        return request;
    }

    ExitStatus run_service(const Context& context) {
        if (frames_option_->count() > 0) service_.frames = hough_.frames;
        const std::vector<std::string> names = models();
        std::vector<std::unique_ptr<Mesh>> meshes;
        std::vector<ServiceBenchModel> models;
        for (const std::string& name : names) {
            meshes.push_back(std::make_unique<Mesh>(load(name, context)));
            models.push_back({name, meshes.back().get()});
        }
        const ServiceResult result = bench_service(models, service_, context);
        if (context.json)
            print_json({{"machine", to_json(machine_)}, {"service", to_json(result)}});
        else
            print_result(result);
        return report_difference(result.difference);
    }

    std::string suite_;
    std::vector<std::string> models_;
    std::uint32_t subdivide_ = 0;
    bool check_ = false, methods_ = false, growth_ = false, figures_ = false, no_vtk_ = false;
    HoughBenchOptions hough_;
    GrowthOptions growth_options_;
    ServiceBenchOptions service_;
    double noise_ = 0.0;
    BenchMachine machine_;
    bool said_machine_ = false;
    std::string device_, pictures_;
    std::optional<glm::vec3> up_;
    CLI::Option *pictures_option_ = nullptr, *up_option_ = nullptr, *device_option_ = nullptr,
                *subdivide_option_ = nullptr, *check_option_ = nullptr, *methods_option_ = nullptr,
                *growth_option_ = nullptr, *figures_option_ = nullptr, *no_vtk_option_ = nullptr,
                *viewpoints_option_ = nullptr, *frames_option_ = nullptr,
                *worst_frames_option_ = nullptr, *rounds_option_ = nullptr,
                *builds_option_ = nullptr, *min_option_ = nullptr, *max_option_ = nullptr,
                *trackers_option_ = nullptr, *fps_option_ = nullptr, *workers_option_ = nullptr,
                *noise_option_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_bench_command() { return std::make_unique<BenchCommand>(); }

}  // namespace rimline::tools
