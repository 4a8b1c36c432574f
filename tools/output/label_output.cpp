#include "tools/output/label_output.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/geometric.hpp>

namespace rimline::tools {

namespace {

template <typename Value>
void append_raw(std::string& bytes, Value value) {
    auto raw = std::bit_cast<std::array<char, sizeof(Value)>>(value);
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(raw);
    bytes.append(raw.data(), raw.size());
}

}  // namespace

PointColor label_color(PointLabel label) {
    switch (label) {
        case PointLabel::border: return {230, 120, 20};
        case PointLabel::interior: return {150, 150, 150};
        case PointLabel::feature: return {40, 80, 180};
        case PointLabel::undecided: return {200, 40, 40};
    }
    return {};
}

glm::dvec3 oriented_normal(const PointCloud& cloud, const PointSurface& surface, PointId point) {
    const glm::dvec3 normal = surface.normal(point);
    if (cloud.normals().empty()) return normal;
    return glm::dot(normal, glm::dvec3(cloud.normals()[index(point)])) < 0.0 ? -normal : normal;
}

std::string format_labels(const LabeledPoints& points) {
    const PointCloud& cloud = points.cloud;
    const PointSurface& surface = points.surface;
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\n"
        "comment label: 0 border, 1 interior, 2 feature, 3 undecided\n"
        "comment reason of undecided points: 1 alone, 2 coincident, 3 isolated, 4 collinear, "
        "5 no normal, 6 outlier, 7 unconfirmed border\nelement vertex " +
        std::to_string(cloud.size()) +
        "\nproperty double x\nproperty double y\nproperty double z\n"
        "property float nx\nproperty float ny\nproperty float nz\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
        "property uchar label\nproperty uchar reason\nproperty float weight\n"
        "property uchar silhouette\nproperty uint number\n" +
        (cloud.intensities().empty() ? "" : "property float intensity\n") + "end_header\n";
    bytes.reserve(bytes.size() + std::size_t{50} * cloud.size());
    for (std::uint32_t i = 0; i < cloud.size(); ++i) {
        const PointId point{i};
        for (int axis = 0; axis < 3; ++axis) append_raw(bytes, cloud.positions()[i][axis]);
        const glm::dvec3 normal = oriented_normal(cloud, surface, point);
        for (int axis = 0; axis < 3; ++axis) append_raw(bytes, static_cast<float>(normal[axis]));
        const PointLabel label = surface.label(point);
        const PointColor color = cloud.colors().empty() ? label_color(label) : cloud.colors()[i];
        for (const std::uint8_t channel : color) append_raw(bytes, channel);
        append_raw(bytes, static_cast<std::uint8_t>(label));
        append_raw(bytes, static_cast<std::uint8_t>(surface.reason(point)));
        append_raw(bytes, points.weights[i]);
        append_raw(bytes,
                   static_cast<std::uint8_t>(std::ranges::binary_search(points.silhouette, point)));
        append_raw(bytes, cloud.file_point(i));
        if (!cloud.intensities().empty()) append_raw(bytes, cloud.intensities()[i]);
    }
    return bytes;
}

}  // namespace rimline::tools
