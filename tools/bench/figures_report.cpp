#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numeric>

#include "tools/bench/figures.h"
#include "tools/output/json_vector.h"

namespace rimline::tools {

namespace {

using Json = nlohmann::ordered_json;

// Five digits are more than a plot shows.
double rounded(double value) {
    if (value == 0.0) return 0.0;
    const double unit = std::pow(10.0, 4.0 - std::floor(std::log10(std::abs(value))));
    return std::round(value * unit) / unit;
}

Json spread_json(const PointSpread& spread) {
    Json sample = Json::array();
    for (const std::array<double, 3>& point : spread.sample)
        sample.push_back({rounded(point[0]), rounded(point[1]), rounded(point[2])});
    return {{"points", spread.points},       {"left_out", spread.left_out},
            {"farthest", spread.farthest},   {"percentile_99", spread.percentile_99},
            {"distances", spread.distances}, {"sample", std::move(sample)},
            {"nodes", spread.nodes},         {"leaf_depths", spread.leaf_depths}};
}

Json work_json(const ExtractionWork& work) {
    return {{"radius", work.radius},
            {"points", work.points},
            {"silhouette", work.silhouette},
            {"literal_pbv_checks", work.literal_boxes[0]},
            {"literal_ebv_checks", work.literal_boxes[1]},
            {"literal_all_pbv_checks", work.literal_all_boxes[0]},
            {"literal_all_ebv_checks", work.literal_all_boxes[1]},
            {"literal_face_checks", work.literal_faces},
            {"index_box_checks", work.index_boxes},
            {"index_face_checks", work.index_faces}};
}

Json counts_json(const OrbitWork::Counts& counts) {
    return {{"boxes", counts.boxes}, {"faces", counts.faces}};
}

Json layout_json(const LayoutPicture& layout) {
    Json points = Json::array();
    for (const LayoutPicture::Point& point : layout.points)
        points.push_back({rounded(point.x), rounded(point.y), point.block});
    Json boxes = Json::array();
    for (const LayoutPicture::Box& box : layout.boxes)
        boxes.push_back({rounded(box.low[0]), rounded(box.low[1]), rounded(box.high[0]),
                         rounded(box.high[1]), box.level, name_of(box.end)});
    return {{"pole", layout.pole},
            {"blocks", layout.blocks},
            {"blocks_settled", layout.blocks_settled},
            {"blocks_looked_at", layout.blocks_looked_at},
            {"boxes_tested", layout.boxes_tested},
            {"points", std::move(points)},
            {"boxes", std::move(boxes)}};
}

}  // namespace

void print_summary(const FigureData& data) {
    const auto mean = [](const std::vector<std::uint32_t>& counts) {
        const double sum = std::accumulate(counts.begin(), counts.end(), 0.0);
        return counts.empty() ? 0.0 : sum / static_cast<double>(counts.size());
    };
    std::printf("%s: %u faces, %u SFO edges\n", data.model.c_str(), data.faces, data.sfo_edges);
    std::printf("  extraction, means over viewpoints on spheres of unit models\n");
    std::printf("  %8s %8s %12s %12s %12s %12s\n", "radius", "points", "silhouette", "boxes",
                "faces", "index boxes");
    for (const ExtractionWork& work : data.extraction)
        std::printf("  %8.2f %8u %12.1f %12.1f %12.1f %12.1f\n", work.radius, work.points,
                    work.silhouette, work.literal_boxes[0] + work.literal_boxes[1],
                    work.literal_faces, work.index_boxes);
    std::printf("  a frame around the model, means of %zu\n", data.orbit.turned.size());
    std::printf("  %-28s %12s %12s\n", "", "boxes", "faces");
    const auto row = [&](const char* name, const OrbitWork::Counts& counts) {
        std::printf("  %-28s %12.1f %12.1f\n", name, mean(counts.boxes), mean(counts.faces));
    };
    row("full traversal", data.orbit.full);
    row("incremental, as written", data.orbit.as_written);
    row("incremental, complete", data.orbit.incremental);
    row("dual, full traversal", data.orbit.dual);
    row("index", data.orbit.index);
    std::printf("  %-28s %12s %12.1f\n\n", "faces that turn", "", mean(data.orbit.turned));
}

Json to_json(const FigureData& data) {
    Json spheres = Json::array();
    for (const ExtractionWork& work : data.extraction) spheres.push_back(work_json(work));
    Json resolutions = Json::array();
    for (const ResolutionWork& resolution : data.resolutions) {
        Json entry = work_json(resolution.work);
        entry["faces"] = resolution.faces;
        resolutions.push_back(std::move(entry));
    }
    const OrbitWork& orbit = data.orbit;
    return {{"model", data.model},
            {"faces", data.faces},
            {"edges", data.edges},
            {"sfo_edges", data.sfo_edges},
            {"center", json_vector(data.unit.center)},
            {"radius", data.unit.radius},
            {"verified", data.difference.empty()},
            {"difference", data.difference},
            {"hough", spread_json(data.hough)},
            {"dual", spread_json(data.dual)},
            {"extraction", std::move(spheres)},
            {"orbit",
             {{"full", counts_json(orbit.full)},
              {"incremental", counts_json(orbit.incremental)},
              {"as_written", counts_json(orbit.as_written)},
              {"dual", counts_json(orbit.dual)},
              {"full_octants", counts_json(orbit.full_octants)},
              {"dual_octants", counts_json(orbit.dual_octants)},
              {"index", counts_json(orbit.index)},
              {"turned", orbit.turned},
              {"wrong_faces", orbit.wrong_faces},
              {"contained", orbit.contained},
              {"above_candidates", orbit.above_candidates}}},
            {"resolutions", std::move(resolutions)},
            {"layout", layout_json(data.layout)}};
}

}  // namespace rimline::tools
