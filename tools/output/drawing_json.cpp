#include "tools/output/drawing_json.h"

#include <nlohmann/json.hpp>

#include "tools/options/line_kind_names.h"

namespace rimline::tools {

nlohmann::ordered_json drawing_json(const LineDrawing& drawing, const Mesh& mesh,
                                    const ViewPlace& place,
                                    const std::optional<PictureRectangle>& frame) {
    using Json = nlohmann::ordered_json;
    Json points = Json::array(), sources = Json::array(), runs = Json::array(),
         chains = Json::array(), strokes = Json::array();
    for (const LinePoint& p : drawing.points)
        points.push_back(Json::array({p.position.x, p.position.y, p.depth, p.arc}));
    for (const LineSource& source : drawing.sources) {
        if (source.edge == k_no_edge) {
            sources.push_back(nullptr);
            continue;
        }
        const auto& [v, w] = mesh.edge(source.edge).vertices;
        sources.push_back(Json::array({mesh.file_vertex(v), mesh.file_vertex(w), source.share}));
    }
    for (const LineRun& run : drawing.runs)
        runs.push_back({{"chain", run.chain},
                        {"points", Json::array({run.first_point, run.last_point})},
                        {"hidden_by", run.hidden_by},
                        {"length", run.length}});
    for (const LineChain& chain : drawing.chains)
        chains.push_back({{"id", chain.id},
                          {"kind", k_line_kind_names[std::size_t(chain.kind)]},
                          {"runs", Json::array({chain.first_run, chain.last_run})},
                          {"closed", chain.is_closed},
                          {"length", chain.length}});
    for (const LineStroke& stroke : drawing.strokes) {
        Json parts = Json::array();
        for (const StrokePart& part : drawing.parts_of(stroke))
            parts.push_back(
                Json::array({part.run, part.is_reversed, part.first_point, part.last_point}));
        strokes.push_back(
            {{"parts", std::move(parts)}, {"closed", stroke.is_closed}, {"length", stroke.length}});
    }
    Json frame_mm;
    if (frame) {
        // Upwards in the picture is downwards on the page.
        const glm::dvec2 a = place.to_mm(frame->low), b = place.to_mm(frame->high);
        frame_mm = {a.x, b.y, b.x, a.y};
    }
    return {{"page",
             {{"origin_mm", Json::array({place.origin_mm.x, place.origin_mm.y})},
              {"mm_per_unit", place.mm_per_unit},
              {"frame_mm", std::move(frame_mm)}}},
            {"points", std::move(points)},
            {"sources", std::move(sources)},
            {"runs", std::move(runs)},
            {"chains", std::move(chains)},
            {"strokes", std::move(strokes)}};
}

}  // namespace rimline::tools
