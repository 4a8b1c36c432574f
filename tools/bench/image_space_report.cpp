// The table and the JSON of image_space.h.

#include <cstdio>

#include "tools/bench/image_space.h"

namespace rimline::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr double k_percent = 100.0;

Json to_json(const OutlineHits& hits) {
    return {{"true", hits.truth},      {"missed", hits.missed},   {"marked", hits.marked},
            {"borders", hits.borders}, {"creases", hits.creases}, {"extra", hits.extra}};
}

}  // namespace

void print_result(const ImageSpaceResult& result) {
    std::printf(
        "%s: %u faces, %s\n"
        "  %% of true pixels missed; %% of drawn pixels at borders, at creases, and extra; ms a "
        "frame\n"
        "  %-28s %8s %8s %8s %8s %8s %8s %8s\n",
        result.model.c_str(), result.faces, result.is_closed ? "closed" : "open", "", "missed",
        "borders", "creases", "extra", "frame", "cpu", "passes");
    for (const OutlineWay& way : result.ways)
        std::printf("  %-28s %8.2f %8.2f %8.2f %8.2f %8.2f %8.2f %8.2f\n", way.name.c_str(),
                    k_percent * way.hits.missed_share(), k_percent * way.hits.border_share(),
                    k_percent * way.hits.crease_share(), k_percent * way.hits.extra_share(),
                    way.frame_ms, way.cpu_ms, way.passes_ms);
    std::printf("  Sobel by its thresholds: %8s %8s %8s %8s %8s\n", "depth", "normals", "missed",
                "creases", "extra");
    for (const SobelHits& at : result.sobel)
        std::printf("                           %8.3f %8.0f %8.2f %8.2f %8.2f\n",
                    at.outline.depth_step, at.outline.normal_step_deg,
                    k_percent * at.hits.missed_share(), k_percent * at.hits.crease_share(),
                    k_percent * at.hits.extra_share());
    std::printf("\n");
    std::fflush(stdout);
}

Json to_json(const ImageSpaceResult& result) {
    Json ways = Json::array();
    for (const OutlineWay& way : result.ways)
        ways.push_back({{"name", way.name},
                        {"pixels", to_json(way.hits)},
                        {"frame_ms", way.frame_ms},
                        {"cpu_ms", way.cpu_ms},
                        {"passes_ms", way.passes_ms}});
    Json sobel = Json::array();
    for (const SobelHits& at : result.sobel)
        sobel.push_back({{"depth_step", at.outline.depth_step},
                         {"normal_step_degrees", at.outline.normal_step_deg},
                         {"pixels", to_json(at.hits)}});
    return {{"model", result.model},
            {"faces", result.faces},
            {"closed", result.is_closed},
            {"ways", std::move(ways)},
            {"sobel", std::move(sobel)}};
}

}  // namespace rimline::tools
