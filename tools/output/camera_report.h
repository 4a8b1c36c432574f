#pragma once

// What a picture was drawn with, in JSON and as the options of `render`. Both give the numbers completely: `render`
// with these draws the same picture, byte for byte.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/scene.h"

namespace rimline::tools {

/// `eye target up`, `fov` in degrees or `ortho`, the height of an orthographic picture; the other one is null.
nlohmann::ordered_json camera_json(const Camera& camera);
/// `near far`: the distances from the eye of the planes between which the scene is drawn. Far is null in a
/// perspective picture, which has none. They follow from the scene, and near may be negative in an orthographic
/// picture.
nlohmann::ordered_json clip_planes_json(const Scene& scene);
/// A list of objects with `position` or `direction`, from the scene towards the light; with three-point
/// lighting with `share` and `casts_shadows` too.
nlohmann::ordered_json lights_json(const std::vector<Light>& lights);

/// The camera and the lights of a scene file (scene_file.h). They must be rounded to float (picture_scene.h).
nlohmann::ordered_json scene_camera_json(const Camera& camera);
nlohmann::ordered_json scene_lights_json(const std::vector<Light>& lights);
/// The directions of the sun of an animation that is chosen, one for each frame; null if there are none.
nlohmann::ordered_json suns_json(const std::vector<glm::dvec3>& suns);

/// An option and its value. `v` must be rounded to float.
std::string vector_argument(const std::string& option, const glm::dvec3& v);

/// The options --eye, --target, --up, --fov or --ortho, and --light or --sun for each light but those of
/// three-point lighting that follow from its sun. Camera and lights must be rounded to float (picture_scene.h).
std::vector<std::string> camera_arguments(const Camera& camera, const std::vector<Light>& lights);

}  // namespace rimline::tools
