#include "tools/options/animation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "silhouette/error.h"
#include "tools/options/three_point.h"

namespace rimline::tools {

namespace {

void check_range(const glm::dvec3& position, const char* what) {
    const glm::dvec3 reach = glm::abs(position);
    if (!(std::max({reach.x, reach.y, reach.z}) <= double{k_max_coordinate}))
        throw Error(
            ErrorCode::too_large,
            std::string(what) +
                " leaves the range of coordinates, which end at 2^60: scale the model down");
}

// v rotated about a unit axis, counterclockwise when seen from its tip (Rodrigues).
glm::dvec3 rotated_about(const glm::dvec3& v, const glm::dvec3& axis, double angle_rad) {
    return std::cos(angle_rad) * v + std::sin(angle_rad) * glm::cross(axis, v) +
           (1.0 - std::cos(angle_rad)) * glm::dot(axis, v) * axis;
}

}  // namespace

Animation::Animation(Scene first, const Mesh& mesh, Motion motion)
    : scene_(std::move(first)),
      mesh_(mesh),
      motion_(std::move(motion)),
      first_camera_(scene_.camera),
      first_lights_(scene_.lights),
      back_(glm::normalize(scene_.camera.eye - scene_.camera.target)) {
    if (!motion_.wave) return;
    scene_.instances[0].octree = nullptr;
    scene_.instances[0].deforming = &mesh;
}

Scene& Animation::at(std::uint32_t frame) {
    place_camera(frame);
    place_lights(frame);
    if (motion_.wave) {
        Wave wave = *motion_.wave;
        wave.turns += frame * motion_.wave_turns;
        scene_.instances[0].deformation = wave;
    }
    return scene_;
}

void Animation::place_camera(std::uint32_t frame) {
    if (motion_.eyes.empty()) return;
    Camera& camera = scene_.camera;
    const HomogeneousPoint& point = motion_.eyes[frame];
    const glm::dvec3 xyz(point.xyz());
    camera.eye =
        point.is_direction() ? first_camera_.target + motion_.distance * glm::normalize(xyz) : xyz;
    if (!motion_.ups.empty()) camera.up = motion_.ups[frame];
    camera.target = first_camera_.target;
    const glm::dvec3 away = camera.eye - camera.target;
    const double distance = glm::length(away);
    // At a smaller distance the view direction is rounding noise.
    if (distance > 1e-9 * motion_.distance)
        back_ = away / distance;
    else
        camera.target = camera.eye - motion_.distance * back_;
    check_range(camera.eye, "the camera");
}

void Animation::place_lights(std::uint32_t frame) {
    const std::size_t sun = scene_.lights.size() - (motion_.has_fill_and_rim ? 3 : 1);
    if (!motion_.suns.empty()) scene_.lights[sun].vector = motion_.suns[frame];
    if (motion_.lights != LightMotion::still) move_lights(frame);
    if (motion_.has_fill_and_rim) move_fill_and_rim(scene_);
}

void Animation::move_lights(std::uint32_t frame) {
    const bool turning = motion_.lights == LightMotion::turning;
    const glm::dvec3 axis = glm::normalize(first_camera_.up);
    const double angle_rad = glm::radians(frame * motion_.light_step_degrees);
    const glm::dmat3 with_camera =
        glm::transpose(camera_from_world(scene_.camera)) * camera_from_world(first_camera_);
    const auto moved = [&](const glm::dvec3& v) {
        return turning ? rotated_about(v, axis, angle_rad) : with_camera * v;
    };
    const glm::dvec3 from = turning ? mesh_.center() : first_camera_.eye;
    const glm::dvec3 to = turning ? mesh_.center() : scene_.camera.eye;
    for (std::size_t l = 0; l < first_lights_.size(); ++l) {
        const glm::dvec3& first = first_lights_[l].vector;
        const bool directional = first_lights_[l].directional;
        scene_.lights[l].vector = directional ? moved(first) : to + moved(first - from);
        check_range(scene_.lights[l].vector, "a light");
    }
}

std::vector<Shot> shots_of(const Scene& first, const Mesh& mesh, Motion motion, std::uint32_t count,
                           std::uint32_t stride) {
    motion.wave.reset();
    Animation animation(first, mesh, std::move(motion));
    std::vector<Shot> shots;
    for (std::uint32_t frame = 0; frame < count; ++frame) {
        const Scene& scene = animation.at(frame);
        if (frame % stride == 0) shots.push_back({scene.camera, scene.lights});
    }
    return shots;
}

}  // namespace rimline::tools
