#include "tools/bench/growth.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/bench/growth_sizes.h"
#include "tools/bench/machine.h"
#include "tools/options/model_argument.h"

namespace rimline::tools {

namespace {

double ratio_of(const CaseResult& c) { return ratio(c.methods[1], c.methods[0]); }

nlohmann::ordered_json pair_json(const CaseResult& c) {
    if (c.methods.empty()) return nullptr;
    return {{"octree_us", c.methods[0].median_us()},
            {"brute_us", c.methods[1].median_us()},
            {"ratio", ratio_of(c)},
            {"mean_silhouette", c.mean_size},
            {"mean_flips", c.mean_flips}};
}

void print_overtaking(const std::vector<GrowthStep>& steps, CaseResult ModelResult::*which,
                      const char* name) {
    const std::optional<double> faces = overtaken_at(steps, which);
    const std::uint32_t least = steps.front().result.faces;
    if (!faces)
        std::printf("%s: brute force is faster at %u faces still\n", name,
                    steps.back().result.faces);
    else if (*faces <= least)
        std::printf("%s: the octree is faster from the least size on, %u faces\n", name, least);
    else
        std::printf("%s: the octree overtakes brute force at about %.2g faces\n", name, *faces);
}

}  // namespace

std::vector<GrowthStep> bench_growth(const std::string& model, const GrowthOptions& options,
                                     const std::function<void(const GrowthStep&)>& on_step,
                                     const Context& context) {
    std::vector<GrowthStep> steps;
    for (const GrowthSize& size :
         growth_sizes(model, options.min_faces, options.max_faces, context)) {
        const Mesh mesh = load_mesh(size.model, size.subdivide, context);
        GrowthStep step;
        step.result = about_model(
            size.model, [&] { return bench_hough(size.model, mesh, options.bench, context); });
        step.peak_bytes = peak_resident_bytes();
        on_step(step);
        steps.push_back(std::move(step));
        if (!steps.back().result.difference().empty()) break;
    }
    return steps;
}

std::optional<double> overtaken_at(const std::vector<GrowthStep>& steps,
                                   CaseResult ModelResult::*which) {
    const auto log_ratio = [&](std::size_t i) {
        return std::log(ratio_of(steps[i].result.*which));
    };
    std::size_t first = steps.size();
    while (first > 0 && log_ratio(first - 1) >= 0.0) --first;
    if (first == steps.size()) return std::nullopt;
    const double faces = steps[first].result.faces;
    if (first == 0) return faces;
    const double below = steps[first - 1].result.faces;
    const double t = -log_ratio(first - 1) / (log_ratio(first) - log_ratio(first - 1));
    return below * std::pow(faces / below, t);
}

void print_growth_names() {
    std::printf("%10s %10s %8s %8s | %10s %10s %8s | %10s %10s %8s\n", "faces", "build ms",
                "B/face", "MiB", "extraction", "brute us", "ratio", "update us", "brute us",
                "ratio");
}

void print_growth(const GrowthStep& step) {
    const ModelResult& result = step.result;
    std::printf("%10u %10.1f %8.0f %8.0f", result.faces, result.build_ms, result.bytes_a_face(),
                static_cast<double>(step.peak_bytes) / 0x1p20);
    for (const CaseResult* c : {&result.extraction, &result.update}) {
        if (c->methods.empty())
            std::printf(" | not measured: %s", c->difference.c_str());
        else
            std::printf(" | %10.2f %10.2f %7.2fx", c->methods[0].median_us(),
                        c->methods[1].median_us(), ratio_of(*c));
    }
    std::printf("\n");
    std::fflush(stdout);
}

void print_overtaking(const std::vector<GrowthStep>& steps) {
    print_overtaking(steps, &ModelResult::extraction, "extraction");
    print_overtaking(steps, &ModelResult::update, "update");
}

nlohmann::ordered_json to_json(const std::string& model, const std::vector<GrowthStep>& steps) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const GrowthStep& step : steps)
        rows.push_back({{"faces", step.result.faces},
                        {"build_ms", step.result.build_ms},
                        {"bytes_a_face", step.result.bytes_a_face()},
                        {"peak_bytes", step.peak_bytes},
                        {"verified", step.result.difference().empty()},
                        {"extraction", pair_json(step.result.extraction)},
                        {"update", pair_json(step.result.update)}});
    nlohmann::ordered_json object{{"model", model}, {"sizes", std::move(rows)}};
    if (!steps.empty() && steps.back().result.difference().empty()) {
        const auto faces = [&](CaseResult ModelResult::*which) -> nlohmann::ordered_json {
            const std::optional<double> at = overtaken_at(steps, which);
            return at ? nlohmann::ordered_json(*at) : nlohmann::ordered_json(nullptr);
        };
        object["overtaken_at_faces"] = {{"extraction", faces(&ModelResult::extraction)},
                                        {"update", faces(&ModelResult::update)}};
    }
    return object;
}

}  // namespace rimline::tools
