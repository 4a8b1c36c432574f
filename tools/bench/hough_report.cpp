#include "tools/bench/hough_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace rimline::tools {

namespace {

void print_case(const CaseResult& c) {
    std::printf("%s: %llu points, %.0f edges on the silhouette", c.name.c_str(),
                static_cast<unsigned long long>(c.points), c.mean_size);
    if (c.mean_flips > 0.0) std::printf(", %.0f faces turn a frame", c.mean_flips);
    std::printf("\n");
    if (!c.difference.empty()) {
        std::printf("  not measured: it differs from brute force: %s\n\n", c.difference.c_str());
        return;
    }
    print_row_names();
    const Times& ours = c.methods.front();
    for (const Times& times : c.methods) print_row(times, ours);
    if (c.name == "worst")
        return;  // Its baseline is ours too; print_result() prints the comparison after it.
    for (const Times& times : c.methods)
        if (!times.is_part && ratio(times, ours) < 1.0)
            std::printf("  here the %s LOSES to %s: it takes %.2f times as long\n",
                        ours.name.c_str(), times.name.c_str(), 1.0 / ratio(times, ours));
}

void print_stream(const StreamBytes& stream, double frames) {
    std::printf("  streamed: %.1f bytes a frame of %.1f, %.1f%%\n",
                static_cast<double>(stream.streamed) / frames,
                static_cast<double>(stream.full) / frames,
                100.0 * static_cast<double>(stream.streamed) / static_cast<double>(stream.full));
}

void print_vtk(const ModelResult& result) {
    const VtkResult& vtk = result.vtk;
    if (!vtk.skipped.empty()) std::printf("  VTK: skipped, %s\n", vtk.skipped.c_str());
    if (vtk.us.empty()) return;
    const double us = quantile(vtk.us, 0.5);
    std::printf("  VTK %s: %.2f us, %.2fx, in %zu frames; %.0f lines a frame, ours %.0f\n",
                vtk.version.c_str(), us, us / result.update.methods.front().median_us(),
                vtk.us.size(), vtk.mean_lines, result.vtk_mean_size);
}

void print_ceiling(const BruteForceCeiling& ceiling) {
    std::printf("  brute force: %.1f us, ceiling here %.1f us (2 plain loops): %s\n",
                ceiling.measured_us, ceiling.ceiling_us,
                ceiling.is_defect() ? "a DEFECT of the bench: its ratios flatter" : "ok");
}

}  // namespace

void print_row_names() {
    std::printf("  %-18s %10s %10s %10s %10s %9s %10s %10s %10s\n", "method", "median us",
                "mean us", "p99 us", "p99.9 us", "ratio", "boxes", "faces", "edges");
}

void print_row(const Times& times, const Times& ours) {
    const TraversalCounters work = times.mean_work();
    std::printf("  %-18s %10.2f %10.2f %10.2f %10.2f %8.2fx %10llu %10llu %10llu\n",
                times.name.c_str(), times.median_us(), times.mean_us(), times.quantile_us(0.99),
                times.quantile_us(0.999), ratio(times, ours),
                static_cast<unsigned long long>(work.box_checks),
                static_cast<unsigned long long>(work.face_checks),
                static_cast<unsigned long long>(work.edge_checks));
}

void print_result(const ModelResult& result) {
    std::printf(
        "%s: %u faces, %u edges; octree built in %.1f ms; %.0f bytes a face with a tracker\n",
        result.model.c_str(), result.faces, result.edges, result.build_ms, result.bytes_a_face());
    print_case(result.extraction);
    if (result.ceiling) print_ceiling(*result.ceiling);
    print_case(result.update);
    if (!result.update.methods.empty()) {
        print_stream(result.stream, static_cast<double>(result.update.points));
        print_vtk(result);
    }
    print_case(result.worst);
    if (const auto& worst = result.worst_update)
        std::printf(
            "  over a fresh extraction: work at most %.2fx, p99.9 %.2fx, p99.9 of frames' ratios "
            "%.2fx\n",
            worst->work, worst->p999, worst->frame_p999);
    std::printf("\n");
}

nlohmann::ordered_json to_json(const Times& times, const Times& ours) {
    const TraversalCounters work = times.mean_work();
    nlohmann::ordered_json object{{"method", times.name},
                                  {"is_part", times.is_part},
                                  {"points", times.us.size()},
                                  {"median_us", times.median_us()},
                                  {"mean_us", times.mean_us()},
                                  {"p99_us", times.quantile_us(0.99)},
                                  {"p999_us", times.quantile_us(0.999)},
                                  {"ratio", ratio(times, ours)},
                                  {"counters",
                                   {{"box_checks", work.box_checks},
                                    {"face_checks", work.face_checks},
                                    {"edge_checks", work.edge_checks}}}};
    for (const Times::OwnCount& count : times.own_counts)
        object["own_counts"][count.name] = count.mean;
    return object;
}

nlohmann::ordered_json model_json(const ModelResult& result) {
    nlohmann::ordered_json object{{"model", result.model},
                                  {"faces", result.faces},
                                  {"edges", result.edges},
                                  {"build_ms", result.build_ms},
                                  {"octree_bytes", result.octree_bytes},
                                  {"tracker_bytes", result.tracker_bytes},
                                  {"bytes_a_face", result.bytes_a_face()}};
    if (result.update.points > 0) {
        const double frames = static_cast<double>(result.update.points);
        object["bytes_streamed"] = static_cast<double>(result.stream.streamed) / frames;
        object["bytes_full"] = static_cast<double>(result.stream.full) / frames;
    }
    if (const auto& worst = result.worst_update)
        object["worst_update"] = {
            {"work", worst->work}, {"p999", worst->p999}, {"frame_p999", worst->frame_p999}};
    if (const auto& ceiling = result.ceiling)
        object["ceiling"] = {{"plain_us", ceiling->plain_us},
                             {"measured_us", ceiling->measured_us},
                             {"ceiling_us", ceiling->ceiling_us},
                             {"verdict", ceiling->is_defect() ? "defect" : "ok"}};
    if (!result.vtk.skipped.empty()) object["vtk"] = {{"skipped", result.vtk.skipped}};
    if (!result.vtk.us.empty()) {
        const double us = quantile(result.vtk.us, 0.5);
        object["vtk"] = {{"version", result.vtk.version},
                         {"frames", result.vtk.us.size()},
                         {"median_us", us},
                         {"ratio", us / result.update.methods.front().median_us()},
                         {"mean_lines", result.vtk.mean_lines},
                         {"mean_silhouette", result.vtk_mean_size}};
    }
    return object;
}

nlohmann::ordered_json cases_json(const ModelResult& result) {
    nlohmann::ordered_json cases = nlohmann::ordered_json::array();
    for (const CaseResult* c : {&result.extraction, &result.update, &result.worst}) {
        if (c->points == 0 && c->difference.empty()) continue;
        nlohmann::ordered_json methods = nlohmann::ordered_json::array();
        for (const Times& times : c->methods) methods.push_back(to_json(times, c->methods.front()));
        cases.push_back({{"case", c->name},
                         {"model", result.model},
                         {"points", c->points},
                         {"mean_silhouette", c->mean_size},
                         {"mean_flips", c->mean_flips},
                         {"verified", c->difference.empty()},
                         {"methods", std::move(methods)}});
    }
    return cases;
}

}  // namespace rimline::tools
