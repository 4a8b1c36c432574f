#include "tools/bench/hough_targets.h"

namespace rimline::tools {

namespace {

// A zero means that the mesh has no such target.
struct Goals {
    std::uint32_t faces;
    double extraction, extraction_aim;
    double update, update_aim;
    double build_ms, build_aim_ms;
    double streamed, streamed_aim;
    double vtk, vtk_aim;
};
constexpr Goals k_goals[] = {
    {k_bunny_faces, 1.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
    {k_igea_faces, 4.0, 5.0, 3.5, 5.0, 60.0, 30.0, 1.0 / 4, 1.0 / 6, 300.0, 1000.0},
    {k_large_faces, 9.0, 15.0, 11.0, 20.0, 1200.0, 500.0, 0.0, 0.0, 0.0, 0.0},
};
constexpr Goals k_general_rule{0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
constexpr double k_worst = 1.5;
constexpr double k_worst_aim = 1.1;
constexpr double k_bytes_a_face = 200.0;
constexpr double k_bytes_a_face_aim = 100.0;

}  // namespace

std::vector<Target> targets_of(const ModelResult& result) {
    const Goals* goals = &k_general_rule;
    for (const Goals& g : k_goals)
        if (g.faces == result.faces) goals = &g;

    std::vector<Target> targets;
    const auto at_least = [&](const char* what, double value, double reach, double aim) {
        if (reach > 0.0)
            targets.push_back({.what = what, .value = value, .reach = reach, .aim = aim});
    };
    const auto at_most = [&](const char* what, double value, double reach, double aim,
                             const char* unit, bool is_time) {
        if (reach > 0.0) targets.push_back({what, value, reach, aim, true, is_time, unit});
    };
    const std::vector<Times>& extraction = result.extraction.methods;
    const std::vector<Times>& update = result.update.methods;
    if (result.ceiling)
        at_most("brute force over its ceiling",
                result.ceiling->measured_us / result.ceiling->ceiling_us, 1.0, 0.0, "x", false);
    at_least("extraction, brute force over octree", ratio(extraction[1], extraction[0]),
             goals->extraction, goals->extraction_aim);
    // The general rule holds for a mesh without its own goal for updates.
    at_least("update, brute force tracker over tracker", ratio(update[1], update[0]),
             goals->update > 0.0 ? goals->update : k_general_rule.update, goals->update_aim);
    if (goals != &k_general_rule) {
        at_most("worst update, by work, over a fresh extraction", result.worst_update->work,
                k_worst, k_worst_aim, "x", false);
        at_most("worst update, p99.9 by clock, over a fresh extraction's",
                result.worst_update->p999, k_worst, k_worst_aim, "x", false);
        at_most("memory of octree and tracker", result.bytes_a_face(), k_bytes_a_face,
                k_bytes_a_face_aim, " bytes a face", false);
    }
    at_most("bytes streamed a frame over all bytes",
            static_cast<double>(result.stream.streamed) / static_cast<double>(result.stream.full),
            goals->streamed, goals->streamed_aim, "x", false);
    if (!result.vtk.us.empty())
        at_least("update, VTK over tracker", quantile(result.vtk.us, 0.5) / update[0].median_us(),
                 goals->vtk, goals->vtk_aim);
    at_most("build of the octree", result.build_ms, goals->build_ms, goals->build_aim_ms, " ms",
            true);
    return targets;
}

}  // namespace rimline::tools
