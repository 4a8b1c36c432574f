#pragma once

// The visible ratios of viewpoints by what is faster: drawn on the device (visible_ratio.h), or by rays
// (silhouette/field/ray_ratios.h) where a CPU stands in for a GPU, which then takes four times as long.

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "engine/measure/visible_ratio.h"
#include "silhouette/field/ray_ratios.h"

namespace rimline {

class ViewRatios {
public:
    /// As VisibleRatioPass.
    ViewRatios(const DeviceContext& context, const HoughOctree& octree,
               const std::stop_token& stop = {});

    /// One ratio for each viewpoint, in order. Throws Error{cancelled} where `stop` is requested, and as
    /// VisibleRatioPass::measure().
    std::vector<double> measure(std::span<const glm::dvec3> eyes, const std::stop_token& stop = {});

private:
    std::optional<RayRatios> rays_;
    std::optional<VisibleRatioPass> pass_;
};

}  // namespace rimline
