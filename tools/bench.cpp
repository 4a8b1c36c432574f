// rimline bench: measures, against baselines, what it has checked first.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "silhouette/hough/baselines/brute_force_packed.h"
#include "silhouette/mesh/mesh.h"
#include "tools/bench_hough.h"
#include "tools/command.h"
#include "tools/model_argument.h"
#include "tools/option_types.h"

namespace rimline::tools {

namespace {

std::string processor_name() {
    std::ifstream cpu_info("/proc/cpuinfo");
    for (std::string line; std::getline(cpu_info, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos)
            return line.substr(colon + 2);
    }
    return "unknown";
}

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

double ratio(const MethodResult& baseline, const MethodResult& ours) {
    return baseline.median_us / ours.median_us;
}

void print_table(const CaseResult& result) {
    std::printf("%s, %s: %u faces, %.0f edges on the silhouette", result.name.c_str(),
                result.model.c_str(), result.faces, result.mean_size);
    if (result.mean_flips > 0.0) std::printf(", %.0f faces turn a frame", result.mean_flips);
    std::printf("; octree built in %.1f ms\n", result.build_ms);
    if (!result.difference.empty()) {
        std::printf("  not measured: it differs from brute force: %s\n\n",
                    result.difference.c_str());
        return;
    }
    std::printf("  %-18s %12s %12s %9s %12s %12s %12s\n", "method", "median us", "mean us", "ratio",
                "box checks", "face checks", "edge checks");
    const MethodResult& ours = result.methods.front();
    for (const MethodResult& method : result.methods)
        std::printf("  %-18s %12.2f %12.2f %8.2fx %12llu %12llu %12llu\n", method.method.c_str(),
                    method.median_us, method.mean_us, ratio(method, ours),
                    static_cast<unsigned long long>(method.counters.box_checks),
                    static_cast<unsigned long long>(method.counters.face_checks),
                    static_cast<unsigned long long>(method.counters.edge_checks));
    for (const MethodResult& method : result.methods)
        if (ratio(method, ours) < 1.0)
            std::printf("  here the %s LOSES to %s: it takes %.2f times as long\n",
                        ours.method.c_str(), method.method.c_str(), 1.0 / ratio(method, ours));
    std::printf("\n");
}

nlohmann::ordered_json to_json(const CaseResult& result) {
    nlohmann::ordered_json methods = nlohmann::ordered_json::array();
    for (const MethodResult& method : result.methods)
        methods.push_back({{"method", method.method},
                           {"median_us", method.median_us},
                           {"mean_us", method.mean_us},
                           {"ratio", ratio(method, result.methods.front())},
                           {"counters",
                            {{"box_checks", method.counters.box_checks},
                             {"face_checks", method.counters.face_checks},
                             {"edge_checks", method.counters.edge_checks}}}});
    return {{"case", result.name},
            {"model", result.model},
            {"faces", result.faces},
            {"edges", result.edges},
            {"build_ms", result.build_ms},
            {"mean_silhouette", result.mean_size},
            {"mean_flips", result.mean_flips},
            {"verified", result.difference.empty()},
            {"methods", std::move(methods)}};
}

class BenchCommand final : public Command {
public:
    std::string name() const override { return "bench"; }
    std::string summary() const override { return "Measure against baselines, checked first"; }

    void add_options(CLI::App& app) override {
        app.add_option("SUITE", suite_, "What to measure: hough, the octree and its tracker")
            ->type_name("")
            ->required()
            ->check(CLI::IsMember({"hough"}));
        app.add_option_function<std::vector<std::string>>(
               "MODELS",
               [this](const std::vector<std::string>& texts) {
                   for (const std::string& text : texts) check_model_name(text);
                   models_ = texts;
               },
               model_description() +
                   " (default: stanford-bunny.obj and igea.ply of the folders in RIMLINE_MODELS, "
                   "or "
                   "built-in shapes)")
            ->type_name("");
        add_subdivide(app, subdivide_)->group("Model");
        constexpr const char* k_group = "Amount";
        add_count(app, "--viewpoints", options_.viewpoints, 1, 1'000'000,
                  "Points of static extraction, at 1, 2 and 3 radii")
            ->group(k_group);
        add_count(app, "--frames", options_.frames, 1, 1'000'000,
                  "Steps of half a degree on an orbit at 2 radii")
            ->group(k_group);
        add_count(app, "--rounds", options_.rounds, 1, 1000,
                  "Times that each is measured; the least counts")
            ->group(k_group);
        app.footer(
            "A ratio is a method's median over that of the octree or tracker: above 1, ours is "
            "faster.\n"
            "packed is brute force laid out for wide registers, scalar the plain loop. A case "
            "whose\n"
            "results differ from scalar brute force is not measured; exit 3.\n\n"
            "Examples:\n"
            "  rimline bench hough bunny.obj igea.ply\n"
            "  rimline bench hough shape:knot:20000 --subdivide 2 --json");
    }

    ExitStatus run(const Context& context) override {
        const std::vector<std::string> models = models_.empty() ? usual_models() : models_;
        std::string instruction_set;
        nlohmann::ordered_json cases = nlohmann::ordered_json::array();
        std::string difference;
        for (const std::string& model : models) {
            const Mesh mesh = load_mesh(model, subdivide_, context);
            if (instruction_set.empty()) {
                instruction_set = PackedBruteForce(mesh).instruction_set();
                if (!context.json)
                    std::printf("%s, one thread; packed brute force uses %s\n\n",
                                processor_name().c_str(), instruction_set.c_str());
            }
            const std::vector<CaseResult> results =
                about_model(model, [&] { return bench_hough(model, mesh, options_, context); });
            for (const CaseResult& result : results) {
                if (context.json)
                    cases.push_back(to_json(result));
                else
                    print_table(result);
                if (difference.empty() && !result.difference.empty())
                    difference = result.name + ", " + result.model + ": " + result.difference;
            }
        }
        if (context.json)
            print_json({{"machine", {{"cpu", processor_name()}, {"packed", instruction_set}}},
                        {"viewpoints", options_.viewpoints},
                        {"frames", options_.frames},
                        {"rounds", options_.rounds},
                        {"cases", std::move(cases)}});
        if (difference.empty()) return ExitStatus::success;
        std::fprintf(stderr, "rimline: error: %s differs from brute force\n", difference.c_str());
        return ExitStatus::check_failed;
    }

private:
    std::string suite_;
    std::vector<std::string> models_;
    std::uint32_t subdivide_ = 0;
    HoughBenchOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_bench_command() { return std::make_unique<BenchCommand>(); }

}  // namespace rimline::tools
