#include "tools/bench/lines_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/bench/piece_rays.h"

namespace rimline::tools {

namespace {

unsigned long long printable(std::uint64_t count) { return count; }

void print_view_times(const char* name, const ViewTimes& times, const LinesResult& result) {
    std::printf("  %-53s %10.2f %10.2f", name, times.median_ms(), times.worst_ms());
    if (&times != &result.extraction)
        std::printf(" %8.2fx", times.median_ms() / result.drawing.median_ms());
}

void print_check(const LineCheck& check) {
    std::printf(
        "  oracle: %llu samples, of which %llu undecided, %llu of a wrong count and %llu of wrong "
        "visibility; %llu edges missing\n",
        printable(check.samples), printable(check.undecided), printable(check.wrong),
        printable(check.wrong_visibility), printable(check.missing_edges));
}

void print_work(const LinesResult& result) {
    const LineReport& work = result.work;
    std::printf(
        "  a view: %.0f lines in %.0f chains and %.0f strokes; %.0f crossings, %.0f contacts, %.0f "
        "components\n",
        result.a_view(work.lines), result.a_view(result.chains), result.a_view(result.strokes),
        result.a_view(work.crossings), result.a_view(work.contacts),
        result.a_view(work.components));
    std::printf("  all views: %llu checks of cycles, %llu failed; %u lines decided by rays\n",
                printable(work.checks), printable(work.failed_checks), work.lines_by_rays);
}

void print_other(const OtherResult& other) {
    if (!other.skipped.empty()) {
        std::printf("  %s: skipped, %s\n", other.method.c_str(), other.skipped.c_str());
        return;
    }
    std::printf("  %s, first view: %.1f ms, %.1fx; wrong length ", other.method.c_str(), other.ms,
                other.ratio);
    if (other.errors)
        std::printf("%.3f%%, not drawn %.3f%%\n", 100.0 * other.errors->wrong_share,
                    100.0 * other.errors->missing_share);
    else
        std::printf("not measured\n");
}

void print_threads(const ThreadsResult& threads, double drawing_ms) {
    std::printf(
        "  %u threads, by the clock: one drawing %.2f ms, %.2fx; drawings in parallel %.2f ms "
        "each, %.2fx\n",
        threads.threads, threads.drawing_ms, drawing_ms / threads.drawing_ms, threads.parallel_ms,
        drawing_ms / threads.parallel_ms);
}

void print_whole(const WholeResult& whole) {
    std::printf(
        "  draw as a whole %.1f ms: contacts and trees %.1f, silhouette %.1f, drawing %.1f, page "
        "and SVG of %.0f kB %.1f\n",
        whole.all_ms, whole.surface_ms, whole.extraction_ms, whole.drawing_ms,
        1e-3 * static_cast<double>(whole.text_bytes), whole.text_ms);
}

nlohmann::ordered_json to_json(const ViewTimes& times) {
    return {{"median_ms", times.median_ms()}, {"worst_ms", times.worst_ms()}};
}

}  // namespace

void print_result(const LinesResult& result) {
    std::printf("%s: %u faces, %u views; prepared in %.1f ms, %.0f bytes a face\n",
                result.model.c_str(), result.faces, result.views, result.surface_ms,
                result.bytes_a_face());
    print_check(result.check);
    if (!result.difference.empty()) {
        std::printf("  not measured: it differs from the oracle: %s\n\n",
                    result.difference.c_str());
        return;
    }
    print_work(result);
    std::printf("  %-53s %10s %10s %9s %14s\n", "", "median ms", "worst ms", "ratio",
                "wrong length");
    print_view_times("drawing, with chains", result.drawing, result);
    std::printf(" %13.3f%%\n", 100.0 * result.wrong_share());
    print_view_times("drawing with shape, without stubble", result.shaped, result);
    std::printf("\n");
    for (const RayResult& rays : result.rays) {
        print_view_times(("a ray a piece, " + rays.name).c_str(), rays.times, result);
        std::printf(" %13.3f%%\n", 100.0 * rays.wrong_share);
    }
    print_view_times("the silhouette, by brute force", result.extraction, result);
    std::printf("\n");
    if (result.rays.empty())
        std::printf("  a ray a piece: skipped, %s\n", PieceRays::missing().data());
    else
        std::printf("  %.0f rays a view\n", result.a_view(result.pieces));
    for (const OtherResult& other : result.others) print_other(other);
    if (result.threads) print_threads(*result.threads, result.drawing.median_ms());
    if (result.whole) print_whole(*result.whole);
    std::printf("\n");
}

nlohmann::ordered_json to_json(const LinesResult& result) {
    const LineReport& work = result.work;
    nlohmann::ordered_json object{{"model", result.model},
                                  {"faces", result.faces},
                                  {"views", result.views},
                                  {"surface_ms", result.surface_ms},
                                  {"surface_bytes", result.surface_bytes},
                                  {"verified", result.difference.empty()},
                                  {"oracle",
                                   {{"samples", result.check.samples},
                                    {"undecided", result.check.undecided},
                                    {"wrong", result.check.wrong},
                                    {"wrong_visibility", result.check.wrong_visibility},
                                    {"missing_edges", result.check.missing_edges}}},
                                  {"counters",
                                   {{"lines", work.lines},
                                    {"crossings", work.crossings},
                                    {"contacts", work.contacts},
                                    {"components", work.components},
                                    {"checks", work.checks},
                                    {"failed_checks", work.failed_checks},
                                    {"lines_by_rays", work.lines_by_rays},
                                    {"undecided_lines", work.undecided_lines},
                                    {"pieces", result.pieces}}}};
    if (!result.difference.empty()) return object;
    object["counters"]["chains"] = result.chains;
    object["counters"]["strokes"] = result.strokes;
    object["extraction"] = to_json(result.extraction);
    object["drawing"] = to_json(result.drawing);
    object["drawing"]["wrong_share"] = result.wrong_share();
    object["shaped"] = to_json(result.shaped);
    nlohmann::ordered_json rays = nlohmann::ordered_json::array();
    for (const RayResult& way : result.rays) {
        nlohmann::ordered_json row{{"name", way.name}};
        row.update(to_json(way.times));
        row["ratio"] = way.times.median_ms() / result.drawing.median_ms();
        row["wrong_share"] = way.wrong_share;
        rays.push_back(std::move(row));
    }
    if (result.rays.empty())
        object["rays"] = {{"skipped", PieceRays::missing()}};
    else
        object["rays"] = std::move(rays);
    nlohmann::ordered_json others = nlohmann::ordered_json::array();
    for (const OtherResult& other : result.others) {
        nlohmann::ordered_json& row = others.emplace_back();
        row["method"] = other.method;
        if (!other.skipped.empty()) {
            row["skipped"] = other.skipped;
            continue;
        }
        row["ms"] = other.ms;
        row["ratio"] = other.ratio;
        if (!other.errors) continue;
        row["wrong_share"] = other.errors->wrong_share;
        row["missing_share"] = other.errors->missing_share;
    }
    if (!others.empty()) object["others"] = std::move(others);
    if (const auto& threads = result.threads)
        object["threads"] = {{"threads", threads->threads},
                             {"drawing_ms", threads->drawing_ms},
                             {"parallel_ms", threads->parallel_ms}};
    if (const auto& whole = result.whole)
        object["whole"] = {{"ms", whole->all_ms},
                           {"surface_ms", whole->surface_ms},
                           {"extraction_ms", whole->extraction_ms},
                           {"drawing_ms", whole->drawing_ms},
                           {"text_ms", whole->text_ms},
                           {"text_bytes", whole->text_bytes}};
    return object;
}

}  // namespace rimline::tools
