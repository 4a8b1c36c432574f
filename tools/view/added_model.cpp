#include "tools/view/added_model.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "silhouette/mesh/ground_axes.h"
#include "silhouette/mesh/rounded_to_float.h"
#include "tools/options/model_argument.h"
#include "tools/options/model_list.h"

namespace rimline::tools {

namespace {

// The space between two models, as a part of the smaller one's extent.
constexpr double k_gap = 0.15;
constexpr double k_max_ratio = 4.0;

// A box along the axes of the scene: to the right, up, and towards the viewer.
struct UprightBox {
    glm::dvec3 low{INFINITY}, high{-INFINITY};

    void add(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    double extent() const { return glm::length(high - low); }
};

UprightBox box_of(std::span<const glm::vec3> positions, const glm::dmat3& to_axes) {
    UprightBox box;
    for (const glm::vec3& position : positions) box.add(to_axes * glm::dvec3(position));
    return box;
}

glm::dvec3 axis_to_the_right(const glm::dvec3& up, const glm::dvec3& towards_viewer) {
    const glm::dvec3 right = glm::cross(up, towards_viewer);
    const auto [first, second] = ground_axes(up);
    const glm::dvec3 nearest =
        std::abs(glm::dot(right, first)) >= std::abs(glm::dot(right, second)) ? first : second;
    return glm::dot(right, nearest) >= 0.0 ? nearest : -nearest;
}

void keep_turned(PlacedModel& model, const glm::dvec3& up, const BeginCall& begin) {
    if (model.up) return;
    const MeshSource source =
        load_drawn_model(model.model, model.subdivide, begin, TexturePictures::skip, model.format);
    const glm::dvec3 own = up_of(model, source, {}, begin).up;
    if (own != up) model.up = UpChoice{glm::vec3(own)};
}

}  // namespace

std::vector<PlacedModel> place_added(const Arrangement& arrangement, const BeginCall& begin) {
    const glm::dvec3 up = glm::normalize(arrangement.up);
    const glm::dvec3 right = axis_to_the_right(up, arrangement.towards_viewer);
    const glm::dmat3 from_axes(right, up, glm::cross(right, up));
    const glm::dmat3 to_axes = glm::transpose(from_axes);
    UprightBox scene = box_of(arrangement.positions, to_axes);
    std::vector<PlacedModel> models = arrangement.models;
    if (arrangement.has_new_first) keep_turned(models.front(), up, begin);
    for (const std::string& name : arrangement.added) {
        PlacedModel model{.model = name};
        const MeshSource source = load_drawn_model(name, 0, begin, TexturePictures::skip);
        const glm::dmat3 upright = rotation_between(up_of(model, source, {}, begin).up, up);
        UprightBox box = box_of(source.positions, to_axes * upright);
        const double ratio = box.extent() / scene.extent();
        if (ratio > k_max_ratio || ratio < 1.0 / k_max_ratio)
            model.scale = std::clamp(double(float(1.0 / ratio)), k_min_scale, k_max_scale);
        box.low *= model.scale;
        box.high *= model.scale;
        const double gap = k_gap * std::min(box.high.x - box.low.x, scene.high.x - scene.low.x);
        const glm::dvec3 there(scene.high.x + gap, scene.low.y, 0.5 * (scene.low.z + scene.high.z));
        const glm::dvec3 here(box.low.x, box.low.y, 0.5 * (box.low.z + box.high.z));
        model.at = glm::vec3(from_axes * (there - here)) + 0.0f;  // No -0.
        scene.add(box.low + there - here);
        scene.add(box.high + there - here);
        models.push_back(std::move(model));
    }
    return models;
}

std::vector<std::string> view_arguments(std::span<const PlacedModel> models, const glm::dvec3& up) {
    // Before the models it belongs to the scene.
    std::vector<std::string> arguments{"--up=" + text_of(UpChoice{glm::vec3(up)})};
    for (std::string& word : arguments_of(models)) arguments.push_back(std::move(word));
    return arguments;
}

}  // namespace rimline::tools
