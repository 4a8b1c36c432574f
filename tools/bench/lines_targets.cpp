#include "tools/bench/lines_targets.h"

namespace rimline::tools {

namespace {

// A zero means that the mesh has no such target.
struct LineGoals {
    std::uint32_t faces;
    double median_ms, median_aim_ms;
    double worst_ms;
    double whole_ms;
};
constexpr LineGoals k_line_goals[] = {
    {k_bunny_faces, 2.0, 1.0, 0.0, 0.0},
    {k_igea_faces, 8.0, 4.0, 16.0, 80.0},
    {k_large_faces, 30.0, 15.0, 0.0, 0.0},
};
// The rays find neither the pieces nor chains, so a drawing may take longer.
constexpr double k_rays_over_drawing = 0.5;
constexpr double k_rays_over_drawing_aim = 1.0;

}  // namespace

std::vector<Target> targets_of(const LinesResult& result) {
    std::vector<Target> targets{{.what = "samples of wrong count",
                                 .value = static_cast<double>(result.check.wrong),
                                 .less_is_better = true,
                                 .unit = ""}};
    if (!result.rays.empty())
        targets.push_back({.what = "a ray a piece over drawing",
                           .value = result.ratio_to_rays(),
                           .reach = k_rays_over_drawing,
                           .aim = k_rays_over_drawing_aim});
    const auto time_at_most = [&](const char* what, double ms, double reach, double aim) {
        if (reach > 0.0) targets.push_back({what, ms, reach, aim, true, true, " ms"});
    };
    for (const LineGoals& goals : k_line_goals) {
        if (goals.faces != result.faces) continue;
        time_at_most("drawing, median of views", result.drawing.median_ms(), goals.median_ms,
                     goals.median_aim_ms);
        time_at_most("drawing, worst of views", result.drawing.worst_ms(), goals.worst_ms, 0.0);
        if (result.whole)
            time_at_most("draw as a whole", result.whole->all_ms, goals.whole_ms, 0.0);
    }
    return targets;
}

}  // namespace rimline::tools
