#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/bench_figures.h"

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
    return {{"points", spread.points},          {"left_out", spread.left_out},
            {"farthest", spread.farthest},      {"percentile_99", spread.percentile_99},
            {"distances", spread.distances},    {"near_distances", spread.near_distances},
            {"sample", std::move(sample)},      {"nodes", spread.nodes},
            {"leaf_depths", spread.leaf_depths}};
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
            {"center", {data.unit.center.x, data.unit.center.y, data.unit.center.z}},
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
