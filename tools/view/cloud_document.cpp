#include "tools/view/cloud_document.h"

#include <chrono>
#include <cmath>

#include "silhouette/points/feature_weights.h"

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

CloudDocument::CloudDocument(const CloudArgument& cloud, const BeginCall& begin)
    : name_(cloud.model),
      cloud_(cloud.load(begin)),
      surface_(about_model(
          name_, [&] { return PointSurface(cloud_.positions(), {}, begin("finding umbrellas")); })),
      weights_(feature_weights(surface_, begin("weighing features"))),
      umbrellas_(
          about_model(name_, [&] { return UmbrellaIndex(surface_, begin("indexing umbrellas")); })),
      drawing_(cloud_, surface_, umbrellas_, weights_) {
    if (umbrellas_.positions().empty())
        throw Error(ErrorCode::bad_input,
                    name_ + ": no point has an umbrella; there is nothing to draw");
}

const SplatCloud& CloudDocument::drawn(const std::optional<glm::vec3>& color, float line_width_px) {
    if (drawn_width_px_ == line_width_px && drawn_color_ == color) return drawn_;
    const std::uint64_t revision = drawn_.revision + 1;
    std::optional<PointColor> clay;
    if (color) clay = srgb_bytes(*color);
    drawn_ = drawing_.drawn(clay, line_width_px);
    drawn_.revision = revision;
    drawn_color_ = color;
    drawn_width_px_ = line_width_px;
    return drawn_;
}

std::vector<gpu::StrokeRecord> CloudDocument::follow(const HomogeneousPoint& point,
                                                     const std::optional<glm::vec3>& ink,
                                                     float line_width_px) {
    if (!silhouette_ || silhouette_->point() != point) {
        const auto start = std::chrono::steady_clock::now();
        report_ = {};
        if (silhouette_) {
            const PointSilhouette::Change change = silhouette_->move_to(point);
            report_.joined = static_cast<std::uint32_t>(change.added.size());
            report_.left = static_cast<std::uint32_t>(change.removed.size());
            report_.counters = change.counters;
        } else {
            silhouette_.emplace(umbrellas_, point);
        }
        report_.silhouette_points = silhouette_->size();
        report_.consensus_edges = static_cast<std::uint32_t>(silhouette_->consensus().size());
        report_.move_ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                .count();
    }
    return drawing_.strokes(silhouette_->consensus(), ink ? srgb_bytes(*ink) : k_cloud_ink,
                            line_width_px);
}

}  // namespace rimline::tools
