#include "tools/commands/points_report.h"

#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "tools/command.h"
#include "tools/output/json_vector.h"

namespace rimline::tools {

namespace {

// Times the smallest radius of a gap: docs/results/points.md, "Narrow openings".
constexpr double k_found_ratio = 4.0;

// Upper median. Reorders `values`, which are not empty.
double middle_of(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

void add_lists(const CloudAnalysis& analysis, nlohmann::ordered_json& result) {
    result["border"] = analysis.numbers(PointLabel::border);
    result["undecided"] = analysis.numbers(PointLabel::undecided);
    nlohmann::ordered_json& silhouette = result["silhouette"] = nlohmann::ordered_json::array();
    for (const PointId p : analysis.silhouette) silhouette.push_back(analysis.number(p));
    nlohmann::ordered_json& edges = result["consensus_edges"] = nlohmann::ordered_json::array();
    for (const auto& [a, b] : analysis.consensus)
        edges.push_back({analysis.number(a), analysis.number(b)});
    result["features"] = analysis.weights;
    result["numbers"] = analysis.cloud.file_points();
}

}  // namespace

BorderTruth compare_borders(const CloudAnalysis& analysis) {
    const std::vector<std::uint32_t> border = analysis.cloud.mesh_border_points();
    BorderTruth truth{border.size(), 0, 0};
    for (const std::uint32_t p : border)
        truth.missed += analysis.surface.label(PointId{p}) != PointLabel::border;
    truth.extra = analysis.surface.count(PointLabel::border) + truth.missed - truth.border;
    return truth;
}

std::optional<double> median_scale(const PointSurface& surface) {
    std::vector<double> scales;
    for (std::uint32_t p = 0; p < surface.size(); ++p)
        if (const double scale = surface.scale(PointId{p}); scale > 0.0) scales.push_back(scale);
    if (scales.empty()) return std::nullopt;
    return middle_of(scales);
}

std::size_t count_far_points(const PointSurface& surface) {
    constexpr double k_share = 0.99, k_far = 3.0;
    std::vector<glm::dvec3> points;
    for (std::uint32_t p = 0; p < surface.size(); ++p)
        if (surface.reason(PointId{p}) != UndecidedReason::outlier)
            points.push_back(surface.positions()[p]);
    if (points.empty()) return 0;
    glm::dvec3 center;
    std::vector<double> values(points.size());
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        std::ranges::transform(points, values.begin(),
                               [&](const glm::dvec3& point) { return point[axis]; });
        center[axis] = middle_of(values);
    }
    std::ranges::transform(points, values.begin(),
                           [&](const glm::dvec3& point) { return glm::distance(point, center); });
    const auto most = values.begin() +
                      static_cast<std::ptrdiff_t>(k_share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, most);
    const double limit = k_far * *most;
    return static_cast<std::size_t>(
        std::ranges::count_if(values, [&](double distance) { return distance > limit; }));
}

std::optional<HoleLimit> hole_limit(const PointSurface& surface, double gap_ratio) {
    const std::optional<double> median = median_scale(surface);
    if (!median) return std::nullopt;
    double largest = 0.0;
    for (std::uint32_t p = 0; p < surface.size(); ++p)
        largest = std::max(largest, surface.scale(PointId{p}));
    return HoleLimit{gap_ratio * *median, gap_ratio * largest, k_found_ratio * gap_ratio * *median};
}

void print_object(const Context& context, const PointsReport& report) {
    const CloudAnalysis& analysis = report.analysis;
    const PointCloud& cloud = analysis.cloud;
    const auto count = [&](PointLabel label) { return analysis.surface.count(label); };
    nlohmann::ordered_json reasons = nlohmann::ordered_json::object();
    for (const auto& [reason, points] : analysis.reasons()) reasons[reason] = points;
    nlohmann::ordered_json result{
        {"cloud", report.cloud},
        {"points", cloud.size()},
        {"file_points", cloud.file_point_count()},
        {"duplicates", cloud.duplicate_count()},
        {"dropped", cloud.dropped_count()},
        {"unused", cloud.unused_count()},
        {"center", json_vector(cloud.center())},
        {"radius", cloud.radius()},
        {"labels",
         {{"border", count(PointLabel::border)},
          {"interior", count(PointLabel::interior)},
          {"feature", count(PointLabel::feature)},
          {"undecided", count(PointLabel::undecided)}}},
        {"reasons", std::move(reasons)},
        {"method", analysis.method},
        {"smallest_hole", nullptr},
        {"inconsistent_edges", analysis.surface.inconsistent_edge_count()},
        {"silhouette_points", analysis.silhouette.size()},
        {"consensus_edge_count", analysis.consensus.size()},
        {"arcs", analysis.arcs},
        {"ms", analysis.ms()},
        {"umbrellas_ms", analysis.umbrellas_ms},
        {"features_ms", analysis.features_ms},
        {"index_ms", analysis.index_ms},
        {"silhouette_ms", analysis.silhouette_ms}};
    if (analysis.hole_limit)
        result["smallest_hole"] = {{"median", analysis.hole_limit->median},
                                   {"largest", analysis.hole_limit->largest},
                                   {"found", analysis.hole_limit->found}};
    if (const std::optional<BorderTruth>& truth = analysis.truth) {
        const auto percent = [&](std::size_t part) -> nlohmann::ordered_json {
            if (const auto value = truth->percent(part)) return *value;
            return nullptr;
        };
        result["truth"] = {{"border", truth->border},
                           {"missed", truth->missed},
                           {"extra", truth->extra},
                           {"missed_percent", percent(truth->missed)},
                           {"extra_percent", percent(truth->extra)}};
    }
    if (const std::optional<PointTurn>& turn = analysis.turn) {
        result["turn"] = {{"frames", turn->frames},       {"step", turn->step_deg},
                          {"median_us", turn->median_us}, {"p99_us", turn->p99_us},
                          {"worst_us", turn->worst_us},   {"changed_points", turn->changed_points}};
        if (analysis.is_verified) result["verified"] = turn->differences == 0;
    }
    if (analysis.up) {
        result["up"] = json_vector(analysis.up->up);
        result["up_from"] = up_source_name(analysis.up->source);
    }
    if (!report.export_file.empty()) result["export"] = report.export_file;
    if (const std::optional<PointsPictureReport>& picture = analysis.picture) {
        nlohmann::ordered_json messages = nullptr;
        if (picture->validation_messages) messages = *picture->validation_messages;
        result["output"] = report.picture_file;
        result["device"] = picture->device;
        result["driver"] = picture->driver;
        result["validation_messages"] = std::move(messages);
        result["picture_ms"] = picture->ms;
        result["eye"] = json_vector(picture->eye);
        result["target"] = json_vector(picture->target);
        if (picture->fov_deg) result["fov"] = *picture->fov_deg;
        if (picture->ortho_height) result["ortho"] = *picture->ortho_height;
    }
    if (!report.without_lists) add_lists(analysis, result);
    print_json(context, std::move(result));
}

void print_summary(const PointsReport& report) {
    const CloudAnalysis& analysis = report.analysis;
    const PointCloud& cloud = analysis.cloud;
    const auto count = [&](PointLabel label) { return analysis.surface.count(label); };
    std::printf("%s\n", report.cloud.c_str());
    std::printf("  points      %u of %u in the file", cloud.size(), cloud.file_point_count());
    const auto left_out = [](std::uint32_t points, const char* why) {
        if (points > 0) std::printf(", %u %s", points, why);
    };
    left_out(cloud.duplicate_count(), "equal to another");
    left_out(cloud.dropped_count(), "not finite");
    left_out(cloud.unused_count(), "of no face");
    std::printf("\n  labels      %u border, %u interior, %u feature, %u undecided\n",
                count(PointLabel::border), count(PointLabel::interior), count(PointLabel::feature),
                count(PointLabel::undecided));
    for (const auto& [reason, points] : analysis.reasons())
        std::printf("              %u undecided: %s\n", points, reason);
    if (analysis.hole_limit)
        std::printf(
            "  holes       of a radius under %.3g (where points are sparsest, %.3g) are not found: "
            "they "
            "cannot be told from the points' spacing; of %.3g and more nearly all are found\n",
            analysis.hole_limit->median, analysis.hole_limit->largest, analysis.hole_limit->found);
    if (const std::optional<BorderTruth>& truth = analysis.truth) {
        std::printf("  borders     %zu true, %zu missed, %zu extra", truth->border, truth->missed,
                    truth->extra);
        if (const auto missed = truth->percent(truth->missed))
            std::printf(" (%.1f%% and %.1f%%)", *missed, *truth->percent(truth->extra));
        std::printf("\n");
    }
    const auto sharp = std::ranges::count_if(analysis.weights, [](float w) { return w >= 0.5f; });
    std::printf("  features    %td points weigh a half or more\n", sharp);
    if (analysis.has_silhouette)
        std::printf("  silhouette  %zu points, %zu consensus edges in %zu arcs\n",
                    analysis.silhouette.size(), analysis.consensus.size(), analysis.arcs);
    std::printf("  time        %.1f ms: umbrellas %.1f, features %.1f", analysis.ms(),
                analysis.umbrellas_ms, analysis.features_ms);
    if (analysis.has_silhouette)
        std::printf(", index %.1f, silhouette %.2f", analysis.index_ms, analysis.silhouette_ms);
    std::printf("\n");
    if (const std::optional<PointTurn>& turn = analysis.turn) {
        std::printf("  turn        %u frames by %g degrees: %.0f us a frame, 99%% below %.0f\n",
                    turn->frames, turn->step_deg, turn->median_us, turn->p99_us);
        if (analysis.is_verified)
            std::printf("              %u of them differ from finding it afresh\n",
                        turn->differences);
    }
    if (analysis.picture)
        std::printf("  picture     %.1f ms on %s\n", analysis.picture->ms,
                    analysis.picture->device.c_str());
    if (analysis.up) print_up(*analysis.up);
    for (const std::string& written : {report.export_file, report.picture_file})
        if (!written.empty()) std::printf("  written to  %s\n", written.c_str());
}

}  // namespace rimline::tools
