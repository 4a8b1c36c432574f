#include "tools/view/cloud_document.h"

#include <cmath>

#include "silhouette/points/feature_weights.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

PointColor srgb_bytes(const glm::vec3& linear) {
    const glm::vec3 srgb = srgb_from_linear(linear);
    PointColor color;
    for (int c = 0; c < 3; ++c)
        color[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(
            std::lround(255.0f * std::min(std::max(srgb[c], 0.0f), 1.0f)));
    return color;
}

}  // namespace

CloudDocument::CloudDocument(const CloudArgument& argument, const BeginCall& begin)
    : DocumentBase(argument.model),
      argument_(argument),
      cloud_(argument.load(begin)),
      surface_(make_part(
          begin, "finding umbrellas",
          [&](const LongCall& call) { return PointSurface(cloud_.positions(), {}, call); })),
      weights_(feature_weights(surface_, begin("weighing features"))),
      umbrellas_(make_part(begin, "indexing umbrellas",
                           [&](const LongCall& call) { return UmbrellaIndex(surface_, call); })),
      drawing_(cloud_, surface_, umbrellas_, weights_, usual_look(surface_.size())) {
    if (umbrellas_.positions().empty())
        throw Error(ErrorCode::bad_input,
                    name() + ": no point has an umbrella; there is nothing to draw");
}

const SplatCloud& CloudDocument::splats(const glm::vec3& paper,
                                        const std::optional<glm::vec3>& color,
                                        float line_width_px) {
    if (splat_line_width_px_ == line_width_px && splat_color_ == color && splat_paper_ == paper)
        return splats_;
    const std::uint64_t revision = splats_.revision + 1;
    std::optional<PointColor> surface_color;
    if (color) surface_color = srgb_bytes(*color);
    splats_ = drawing_.drawn(srgb_bytes(paper), surface_color, line_width_px);
    splats_.revision = revision;
    splat_paper_ = paper;
    splat_color_ = color;
    splat_line_width_px_ = line_width_px;
    return splats_;
}

std::vector<gpu::StrokeRecord> CloudDocument::silhouette_strokes(
    const HomogeneousPoint& point, const glm::vec3& paper, const std::optional<glm::vec3>& ink,
    float line_width_px) {
    if (!silhouette_ || silhouette_->point() != point) {
        const Stopwatch watch;
        report_ = {};
        if (silhouette_) {
            const PointSilhouette::Change change = silhouette_->move_to(point);
            report_.added = static_cast<std::uint32_t>(change.added.size());
            report_.removed = static_cast<std::uint32_t>(change.removed.size());
            report_.counters = change.counters;
        } else {
            silhouette_.emplace(umbrellas_, point);
        }
        report_.silhouette_points = silhouette_->size();
        report_.consensus_edges = static_cast<std::uint32_t>(silhouette_->consensus().size());
        report_.move_ms = watch.ms();
    }
    return drawing_.strokes(silhouette_->consensus(),
                            ink ? srgb_bytes(*ink) : cloud_colors(paper).ink, line_width_px);
}

}  // namespace rimline::tools
