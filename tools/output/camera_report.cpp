#include "tools/output/camera_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/options/scene_file.h"
#include "tools/output/json_vector.h"
#include "tools/output/same_picture.h"

namespace rimline::tools {

std::string vector_argument(const std::string& option, const glm::dvec3& v) {
    const std::string value =
        exact_text(float(v.x)) + "," + exact_text(float(v.y)) + "," + exact_text(float(v.z));
    // A value that begins with a minus sign would look like an option.
    return option + (value.starts_with('-') ? "=" : " ") + value;
}

nlohmann::ordered_json camera_json(const Camera& camera) {
    nlohmann::ordered_json fov, ortho;
    if (camera.is_orthographic())
        ortho = camera.ortho_height;
    else
        fov = camera.fov_y_deg;
    return {{"eye", json_vector(camera.eye)},
            {"target", json_vector(camera.target)},
            {"up", json_vector(camera.up)},
            {"fov", std::move(fov)},
            {"ortho", std::move(ortho)}};
}

nlohmann::ordered_json clip_planes_json(const Scene& scene) {
    const SceneBounds bounds = bounds_of(scene);
    // The planes do not depend on the picture's aspect.
    const Projection projection = make_projection(scene.camera, 1.0, bounds.center, bounds.radius);
    if (!projection.is_orthographic()) return {{"near", projection.z[1]}, {"far", nullptr}};
    // Depth is 1 at the near plane and 0 at the far one; the viewer looks along -z.
    return {{"near", (projection.z[1] - 1.0) / projection.z[0]},
            {"far", projection.z[1] / projection.z[0]}};
}

nlohmann::ordered_json lights_json(const std::vector<Light>& lights) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    const bool is_uneven =
        std::ranges::any_of(lights, [](const Light& light) { return light.share.has_value(); });
    for (const Light& light : lights) {
        nlohmann::ordered_json entry{
            {light.directional ? "direction" : "position", json_vector(light.vector)}};
        if (is_uneven)
            entry.update({{"share", light.share.value_or(1.0f)},
                          {"casts_shadows", light.casts_shadows},
                          {"fills", light.fills}});
        list.push_back(std::move(entry));
    }
    return list;
}

nlohmann::ordered_json suns_json(const std::vector<glm::dvec3>& suns) {
    if (suns.empty()) return nullptr;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const glm::dvec3& sun : suns) list.push_back(json_vector(sun));
    return list;
}

nlohmann::ordered_json scene_camera_json(const Camera& camera) {
    nlohmann::ordered_json json{{"eye", short_vector(camera.eye)},
                                {"target", short_vector(camera.target)},
                                {"up", short_vector(camera.up)}};
    if (camera.is_orthographic())
        json["ortho"] = camera.ortho_height;
    else
        json["fov"] = camera.fov_y_deg;
    return json;
}

nlohmann::ordered_json scene_lights_json(const std::vector<Light>& lights) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Light& light : lights)
        if (light.casts_shadows)  // Others follow from these (three_point.h).
            list.push_back({{light.directional ? "sun" : "lamp", short_vector(light.vector)}});
    return list;
}

std::vector<std::string> camera_arguments(const Camera& camera, const std::vector<Light>& lights) {
    std::vector<std::string> arguments{vector_argument("--eye", camera.eye),
                                       vector_argument("--target", camera.target),
                                       vector_argument("--up", camera.up)};
    arguments.push_back(camera.is_orthographic() ? "--ortho " + exact_text(camera.ortho_height)
                                                 : "--fov " + exact_text(camera.fov_y_deg));
    for (const Light& light : lights)
        if (light.casts_shadows)  // Others follow from these (three_point.h).
            arguments.push_back(
                vector_argument(light.directional ? "--sun" : "--light", light.vector));
    return arguments;
}

}  // namespace rimline::tools
