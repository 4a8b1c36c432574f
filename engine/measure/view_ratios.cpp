#include "engine/measure/view_ratios.h"

namespace rimline {

ViewRatios::ViewRatios(const DeviceContext& context, const HoughOctree& octree,
                       const std::stop_token& stop) {
    if (context.type == VK_PHYSICAL_DEVICE_TYPE_CPU)
        rays_.emplace(octree, RayRatios::Options{}, LongCall{stop, {}});
    else
        pass_.emplace(context, octree, VisibleRatioOptions{}, stop);
}

std::vector<double> ViewRatios::measure(std::span<const glm::dvec3> eyes,
                                        const std::stop_token& stop) {
    if (rays_) return rays_->measure(eyes, stop);
    std::vector<double> ratios;
    for (const VisibleRatio& ratio : pass_->measure(eyes, {stop, {}}))
        ratios.push_back(ratio.ratio());
    return ratios;
}

}  // namespace rimline
