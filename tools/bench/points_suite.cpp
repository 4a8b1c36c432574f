// rimline bench points: borders and normals of meshes without their faces.

#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "tools/bench/machine.h"
#include "tools/bench/points.h"
#include "tools/bench/suite_models.h"
#include "tools/bench/suites.h"
#include "tools/bench/targets.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"
#include "tools/options/surface_options.h"

namespace rimline::tools {

namespace {

using Kind = PointsBenchResult::Kind;
using Json = nlohmann::ordered_json;

const char* name_of(Kind kind) {
    switch (kind) {
        case Kind::wide: return "wide";
        case Kind::open: return "open";
        case Kind::smooth: return "smooth";
        case Kind::closed: return "closed";
        case Kind::unfit: return "unfit";
    }
    return "";
}

// The number of models of a kind, and of those that a method finds.
struct Tally {
    std::uint32_t all = 0, found = 0;
};
Tally tally(const std::vector<PointsBenchResult>& results, Kind kind, const std::string& method) {
    Tally tally;
    for (const PointsBenchResult& result : results)
        for (const BorderCount& count : result.counts) {
            if (result.kind != kind || count.method != method) continue;
            ++tally.all;
            tally.found += result.is_found(count);
        }
    return tally;
}

// All mesh files of the folders of RIMLINE_MODELS, sorted by name; built-in shapes where there is none.
std::vector<std::string> all_models() {
    std::vector<std::filesystem::path> paths;
    for (const std::string& folder : model_folders()) {
        std::error_code ignored;
        for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
            const std::string extension = entry.path().extension().string();
            if (extension == ".obj" || extension == ".ply" || extension == ".off" ||
                extension == ".stl")
                paths.push_back(entry.path());
        }
    }
    std::sort(paths.begin(), paths.end(), [](const auto& a, const auto& b) {
        return std::pair(a.filename(), a) < std::pair(b.filename(), b);
    });
    std::vector<std::string> models;
    for (const auto& path : paths) models.push_back(path.string());
    if (models.empty())
        models = {"shape:terrain:50000", "shape:sphere:20000", "shape:knot:20000",
                  "shape:torus:20000"};
    return models;
}

void print_perturbation(const Perturbation& perturbation) {
    if (perturbation.noise > 0.0)
        std::printf("vertices moved by %g of their mean edge\n", perturbation.noise);
    if (perturbation.outliers > 0.0)
        std::printf("%g of the vertices added as outliers\n", perturbation.outliers);
    if (perturbation.uneven > 0.0)
        std::printf("up to %g of the vertices left out\n", perturbation.uneven);
}

// Half of the models, by their names: constants chosen on one half are judged on the other. The extension does not
// count, so that a model in two formats is in one half.
const char* half_of(const std::string& model) {
    std::uint32_t hash = 2166136261u;  // FNV-1a.
    for (const char c : std::filesystem::path(model).stem().string())
        hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
    return (hash >> 16 & 1u) != 0 ? "b" : "a";
}

void print_heading() {
    std::printf("missed and extra border points; of open models in %% of their border\n");
    std::printf("%-28s %-7s %7s %6s %15s %15s %15s %15s %6s %6s %7s %7s %9s\n", "model", "kind",
                "points", "border", "robust", "thesis", "gap 90", "gap 150", "crease", "undec.",
                "median", "99%", "points/s");
}

void print_result(const PointsBenchResult& result) {
    const std::string name = std::filesystem::path(result.model).filename().string();
    if (result.kind == Kind::unfit) return;
    std::printf("%-28s %-7s %7u %6u", name.c_str(), name_of(result.kind), result.points,
                result.border);
    for (const std::size_t n : {0u, 1u, 2u, 4u}) {
        const BorderCount& count = result.counts[n];
        const char* found = result.is_found(count) ? " *" : "";
        char text[40];
        if (result.border > 0)
            std::snprintf(text, sizeof text, "%.1f %.1f%s", 100.0 * count.missed / result.border,
                          100.0 * count.extra / result.border, found);
        else
            std::snprintf(text, sizeof text, "%u%s", count.extra, found);
        std::printf(" %15s", text);
    }
    std::printf(" %6u %6u %6.2f\u00b0 %6.1f\u00b0 %9.0f\n", result.feature, result.undecided,
                result.normals.median_deg, result.normals.high_deg, result.points_per_second);
}

void print_normals(const std::vector<PointsBenchResult>& results) {
    std::uint32_t models = 0, exact = 0, wrong = 0, apart = 0;
    for (const PointsBenchResult& result : results) {
        if (result.kind != Kind::wide && result.kind != Kind::smooth) continue;
        ++models;
        exact += result.normals.median_deg <= 1.0;
        wrong += result.normals.wrong;
        apart += result.normals.wrong_apart;
    }
    std::printf(
        "normals of wide and smooth models: median error at most 1 degree in %u of %u; %u above 60 "
        "degrees from every face,\n%u of them where no other sheet is nearer than the longest "
        "edge\n",
        exact, models, wrong, apart);
}

void print_creases(const std::vector<PointsBenchResult>& results) {
    constexpr std::uint32_t k_few = 50;
    const auto has_many = [](const PointsBenchResult& result) {
        return !result.creases.empty() && result.creases[0].on >= k_few;
    };
    if (std::ranges::none_of(results, has_many)) return;
    std::printf(
        "creases: points on edges over 40\u00b0 that are labeled; their neighbors beside with "
        "weights above "
        "0.4; labeled where\nno edge turns by 25\u00b0\n%-28s %21s %21s %21s %21s %15s\n",
        "", "labeled, robust", "thesis", "heavy beside, robust", "thesis", "extra");
    for (const PointsBenchResult& result : results) {
        if (!has_many(result)) continue;
        const CreaseCount& robust = result.creases[0];
        const CreaseCount& thesis = result.creases[1];
        const auto of = [](std::uint32_t part, std::uint32_t all) {
            return std::to_string(part) + " of " + std::to_string(all);
        };
        std::printf("%-28s %21s %21s %21s %21s %7u %7u\n",
                    std::filesystem::path(result.model).filename().c_str(),
                    of(robust.labeled, robust.on).c_str(), of(thesis.labeled, thesis.on).c_str(),
                    of(robust.heavy, robust.beside).c_str(),
                    of(thesis.heavy, thesis.beside).c_str(), robust.extra, thesis.extra);
    }
}

void print_summary(const std::vector<PointsBenchResult>& results, bool is_even) {
    std::printf(
        "\n* found: at most 4%% missed and 7%% extra; closed, at most 10 extra, fandisk 0\n");
    for (const PointsBenchResult& result : results)
        if (result.kind == Kind::smooth && result.counts[0].around_holes > 0)
            std::printf(
                "%s: of %u extra points %u surround holes in its samples, and do not count\n",
                std::filesystem::path(result.model).filename().c_str(), result.counts[0].extra,
                result.counts[0].around_holes);
    for (const PointsBenchResult& result : results)
        if (!is_even && result.kind == Kind::wide && !result.is_found(result.counts[0]))
            std::printf(
                "%s: %u of %u border points missed where the opening is wide, %u of %u elsewhere\n",
                std::filesystem::path(result.model).filename().c_str(),
                result.counts[0].missed_wide, result.border_wide,
                result.counts[0].missed - result.counts[0].missed_wide,
                result.border - result.border_wide);
    if (!is_even) {
        print_normals(results);
        print_creases(results);
    }
    std::printf("%-28s %18s %18s %18s %18s\n", "found of", "wide", "other open", "smooth",
                "other closed");
    const auto fit = std::ranges::find_if(
        results, [](const PointsBenchResult& result) { return !result.counts.empty(); });
    if (fit == results.end()) return;
    for (const BorderCount& count : fit->counts) {
        std::printf("%-28s", count.method.c_str());
        for (const Kind kind : {Kind::wide, Kind::open, Kind::smooth, Kind::closed}) {
            const Tally t = tally(results, kind, count.method);
            char text[40];
            std::snprintf(text, sizeof text, "%u of %u", t.found, t.all);
            std::printf(" %18s", text);
        }
        std::printf("\n");
    }
    double points = 0.0, seconds = 0.0;
    for (const PointsBenchResult& result : results) {
        if (result.points_per_second <= 0.0) continue;
        points += result.points;
        seconds += result.points / result.points_per_second;
    }
    if (seconds > 0.0)
        std::printf("robust, one thread, all models: %.0f points a second\n", points / seconds);
}

// The models with silhouettes: a flat model has none.
std::vector<ComparedModel> compared_models(const std::vector<PointsBenchResult>& results) {
    std::vector<ComparedModel> models;
    for (const PointsBenchResult& result : results)
        if (result.silhouettes.umbrellas.truth > 0)
            models.push_back({std::filesystem::path(result.model).filename().string(),
                              name_of(result.kind), &result.silhouettes});
    return models;
}

Json to_json(const PointsBenchResult& result) {
    Json counts = Json::array();
    for (const BorderCount& count : result.counts)
        counts.push_back({{"method", count.method},
                          {"missed", count.missed},
                          {"missed_wide", count.missed_wide},
                          {"extra", count.extra},
                          {"around_holes", count.around_holes},
                          {"found", result.is_found(count)}});
    Json creases = Json::array();
    for (const CreaseCount& count : result.creases)
        creases.push_back({{"method", count.method},
                           {"on_edges", count.on},
                           {"labeled", count.labeled},
                           {"beside", count.beside},
                           {"heavy_beside", count.heavy},
                           {"extra", count.extra}});
    return {{"model", result.model},
            {"kind", name_of(result.kind)},
            {"points", result.points},
            {"border", result.border},
            {"border_wide", result.border_wide},
            {"borders", std::move(counts)},
            {"feature", result.feature},
            {"creases", std::move(creases)},
            {"undecided", result.undecided},
            {"normal_error_median_deg", result.normals.median_deg},
            {"normal_error_99_deg", result.normals.high_deg},
            {"wrong_normals", result.normals.wrong},
            {"wrong_normals_apart", result.normals.wrong_apart},
            {"fitted_normals",
             {{"error_median_deg", result.fitted_normals.median_deg},
              {"error_99_deg", result.fitted_normals.high_deg},
              {"wrong", result.fitted_normals.wrong}}},
            {"half", half_of(result.model)},
            {"silhouettes", to_json(result.silhouettes)},
            {"points_per_second", result.points_per_second}};
}

constexpr std::uint32_t k_min_models_of_share = 5;

std::vector<Target> targets_of(const std::vector<PointsBenchResult>& results) {
    std::vector<Target> targets;
    const Tally wide = tally(results, Kind::wide, "robust");
    std::uint32_t openings = 0, missed = 0, border = 0, extra = 0;
    for (const PointsBenchResult& result : results) {
        if (result.kind != Kind::wide) continue;
        openings += result.border_wide;
        missed += result.counts[0].missed_wide;
        border += result.border;
        extra += result.counts[0].extra;
    }
    if (wide.all > 0) {
        targets.push_back({.what = "missed where openings are wide",
                           .value = 100.0 * missed / openings,
                           .reach = 4.0,
                           .less_is_better = true,
                           .unit = "%"});
        targets.push_back({.what = "extra border points of open models with wide openings",
                           .value = 100.0 * extra / border,
                           .reach = 7.0,
                           .less_is_better = true,
                           .unit = "%"});
    }
    // A share of fewer says nothing: four fifths of one are all.
    if (wide.all >= k_min_models_of_share)
        targets.push_back({.what = "open models with wide openings found",
                           .value = 100.0 * wide.found / wide.all,
                           .reach = 80.0,
                           .unit = "%"});
    for (const PointsBenchResult& result : results) {
        if (result.kind != Kind::smooth) continue;
        targets.push_back(
            {.what = std::filesystem::path(result.model).filename().string() + ", extra borders",
             .value = static_cast<double>(result.charged(result.counts[0])),
             .reach = static_cast<double>(result.extra_allowed()),
             .less_is_better = true,
             .unit = ""});
    }
    return targets;
}

class PointsSuite final : public Command {
public:
    std::string name() const override { return "points"; }
    std::string summary() const override {
        return "Borders and normals of meshes without their faces";
    }

    void add_options(CLI::App& app) override {
        models_.add_to(app, "all meshes of the folders in RIMLINE_MODELS, or built-in shapes");
        add_check(app, check_);
        CLI::Option* even = app.add_flag(
            "--even", is_even_,
            "Points spread evenly over the mesh in place of its vertices, about as many");
        even->group("Amount");
        even->excludes("--check");
        add_number(app, "--noise", perturbation_.noise, 0.0, 1.0,
                   "The standard deviation by which every coordinate is moved, in mean lengths of "
                   "the vertex's edges")
            ->group("Amount")
            ->excludes(even);
        const auto add_share = [&](const char* option, double& value, const char* description) {
            add_number(app, option, value, 0.0, 1.0, description)->group("Amount")->excludes(even);
        };
        add_share("--outliers", perturbation_.outliers,
                  "Points added in the bounding box, as a share of the vertices");
        add_share("--uneven", perturbation_.uneven,
                  "Share of the vertices left out at one end of the longest axis; none at the "
                  "other");
        app.add_flag("--no-libraries", without_libraries_,
                     "Without Open3D and PCL, which take most of the time. Of noise, outliers and "
                     "uneven points they have one setting: 16 neighbors, 120 degrees")
            ->group("Amount");
        surface_.add_to(app);
        app.footer(
            "The suite makes umbrellas of the vertices alone. It counts the border points that "
            "are\n"
            "missed and the extra ones, beside the rule that PCL and Open3D use, the largest gap "
            "of\n"
            "directions (our own implementation, and theirs where Python imports open3d and\n"
            "pcl-tools are installed); the errors of normals against the mesh; and the points a\n"
            "second of one thread.\n\n"
            "--check requires: four fifths of the open models whose openings span three spacings\n"
            "have at most 4% missed and 7% extra; smooth closed models have at most 10 extra\n"
            "without those around holes in their samples; fandisk has none.\n\n"
            "Examples:\n"
            "  rimline bench points --check\n"
            "  rimline bench points shape:terrain:50000 --noise 0.05\n"
            "  rimline bench points shape:terrain:50000 --even");
    }

    ExitStatus run(const Context& context) override {
        const std::vector<PointsBenchResult> results = measure(context);
        const std::vector<Target> targets = check_ ? targets_of(results) : std::vector<Target>{};
        if (context.json) {
            Json rows = Json::array();
            for (const PointsBenchResult& result : results) rows.push_back(to_json(result));
            Json object{{"machine", to_json(this_machine())},
                        {"noise", perturbation_.noise},
                        {"outliers", perturbation_.outliers},
                        {"uneven", perturbation_.uneven},
                        {"even", is_even_},
                        {"points", std::move(rows)}};
            if (check_) {
                TargetList list;
                list.add("points", targets);
                object["targets"] = list.json();
            }
            print_json(object);
        } else {
            print_summary(results, is_even_);
            print_silhouettes(compared_models(results));
            print_targets(targets);
        }
        std::string missed = first_missed(targets);
        if (check_ && targets.empty()) missed = "wide or smooth models, of which there is none";
        return report_missed(missed);
    }

private:
    std::vector<PointsBenchResult> measure(const Context& context) const {
        const std::vector<std::string>& named = models_.named();
        std::vector<PointsBenchResult> results;
        for (const std::string& model : named.empty() ? all_models() : named) {
            std::optional<Mesh> mesh;
            try {
                mesh = load_mesh(model, models_.subdivide(), context);
            } catch (const Error& error) {
                // The folders may hold files without a mesh. A named file must have one.
                if (!named.empty() || error.code() == ErrorCode::cancelled) throw;
                continue;
            }
            if (results.empty() && !context.json) {
                print_machine(this_machine());
                if (is_even_) std::printf("points spread evenly in place of vertices\n");
                print_perturbation(perturbation_);
                print_heading();
            }
            results.push_back(about_model(model, [&] {
                return bench_points(
                    model, *mesh, {perturbation_, is_even_, without_libraries_, surface_.options()},
                    context);
            }));
            if (context.json) continue;
            print_result(results.back());
            std::fflush(stdout);
        }
        return results;
    }

    SuiteModels models_;
    bool check_ = false;
    bool is_even_ = false;
    Perturbation perturbation_;
    SurfaceOptions surface_;
    bool without_libraries_ = false;
};

}  // namespace

std::unique_ptr<Command> make_points_suite() { return std::make_unique<PointsSuite>(); }

}  // namespace rimline::tools
