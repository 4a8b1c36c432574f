#include "tools/bench/lines_growth.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/bench/growth_sizes.h"
#include "tools/bench/lines_report.h"
#include "tools/bench/machine.h"
#include "tools/options/model_argument.h"

namespace rimline::tools {

std::vector<LinesGrowthStep> bench_lines_growth(
    const std::string& model, const LinesGrowthOptions& options,
    const std::function<void(const LinesGrowthStep&)>& on_step, const Context& context) {
    std::vector<LinesGrowthStep> steps;
    for (const GrowthSize& size :
         growth_sizes(model, options.min_faces, options.max_faces, context)) {
        const Mesh mesh = load_mesh(size.model, size.subdivide, context);
        check_has_extent(size.model, mesh);
        LinesGrowthStep step;
        step.result = about_model(
            size.model, [&] { return bench_lines(size.model, mesh, options.bench, context); });
        step.peak_bytes = peak_resident_bytes();
        on_step(step);
        steps.push_back(std::move(step));
        if (!steps.back().result.difference.empty()) break;
    }
    return steps;
}

void print_lines_growth_names() {
    std::printf("%10s %11s %8s %8s | %8s %9s | %10s %9s | %10s %8s\n", "faces", "prepare ms",
                "B/face", "MiB", "lines", "crossings", "drawing ms", "worst ms", "rays ms",
                "ratio");
}

void print_growth(const LinesGrowthStep& step) {
    const LinesResult& result = step.result;
    std::printf("%10u %11.1f %8.0f %8.0f | %8.0f %9.0f", result.faces, result.surface_ms,
                result.bytes_a_face(), static_cast<double>(step.peak_bytes) / 0x1p20,
                result.a_view(result.work.lines), result.a_view(result.work.crossings));
    if (!result.difference.empty()) {
        std::printf(" | not measured: %s", result.difference.c_str());
    } else {
        std::printf(" | %10.2f %9.2f", result.drawing.median_ms(), result.drawing.worst_ms());
        if (!result.rays.empty())
            std::printf(" | %10.2f %7.2fx", result.rays.front().times.median_ms(),
                        result.ratio_to_rays());
    }
    std::printf("\n");
    std::fflush(stdout);
}

nlohmann::ordered_json to_json(const std::string& model,
                               const std::vector<LinesGrowthStep>& steps) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const LinesGrowthStep& step : steps) {
        rows.push_back(to_json(step.result));
        rows.back()["peak_bytes"] = step.peak_bytes;
    }
    return {{"model", model}, {"sizes", std::move(rows)}};
}

}  // namespace rimline::tools
