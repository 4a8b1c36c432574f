#include "tools/view/light_handles.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

namespace {

// From the eye to `position`, of length 1.
glm::dvec3 ray_direction(const ScreenView& view, const glm::dvec3& position) {
    if (view.camera().is_orthographic()) return view.view_direction();
    return glm::normalize(position - view.camera().eye);
}

// From the model's center to `position`, of length 1.
glm::dvec3 direction_from_center(const glm::dvec3& position, const SceneBounds& model) {
    const glm::dvec3 offset = position - model.center;
    return glm::length(offset) > 0.0 ? glm::normalize(offset) : glm::dvec3(0, 1, 0);
}

void limit_distance(Light& lamp, const SceneBounds& model) {
    const double room = 0.5 * double{k_max_coordinate} - glm::length(model.center);
    const double limit =
        std::max(std::min(k_max_lamp_radii * model.radius, room), 2.0 * model.radius);
    const double distance = glm::distance(lamp.vector, model.center);
    if (distance > limit)
        lamp.vector = model.center + limit * direction_from_center(lamp.vector, model);
}

}  // namespace

ShownHandle shown_handle(const Light& light, const SceneBounds& model, const ScreenView& view,
                         const glm::dvec2& low, const glm::dvec2& high) {
    const glm::dvec3 handle = light_handle(light, model);
    const glm::dvec2 middle = 0.5 * (low + high);
    const auto pixel = view.pixel_of(handle);
    glm::dvec2 wanted = pixel.value_or(middle);
    if (!pixel) {
        // Behind the eye: towards the edge to which the view would have to turn.
        const glm::dvec3 way = camera_from_world(view.camera()) * (handle - view.camera().eye);
        const glm::dvec2 aside(way.x, -way.y);
        const double reach = glm::length(high - low);
        wanted += reach * (glm::length(aside) > 0.0 ? glm::normalize(aside) : glm::dvec2(0, 1));
    }
    const glm::dvec2 shown = glm::clamp(wanted, low, glm::max(low, high));
    return {.pixel = shown, .outwards = wanted - shown};
}

glm::dvec3 light_handle(const Light& light, const SceneBounds& model) {
    if (!light.directional) return light.vector;
    return model.center + k_sun_radii * model.radius * glm::normalize(light.vector);
}

void drag_light(Light& light, const SceneBounds& model, const ScreenView& view,
                const glm::dvec2& pixel) {
    const Ray ray = view.ray_through(pixel);
    const glm::dvec3 handle = light_handle(light, model);
    if (!light.directional) {
        // The handle moves in the plane (p - handle) . view direction = 0.
        const glm::dvec3 facing = view.view_direction();
        const double slope = glm::dot(ray.direction, facing);
        double distance = glm::dot(handle - ray.origin, facing) / slope;
        if (!(distance > 0.0)) distance = glm::dot(model.center - ray.origin, facing) / slope;
        if (slope > 1e-6 && distance > 0.0) light.vector = ray.origin + distance * ray.direction;
        limit_distance(light, model);
        return;
    }
    const double radius = k_sun_radii * model.radius;
    const double nearest_distance = glm::dot(model.center - ray.origin, ray.direction);
    const glm::dvec3 nearest = ray.origin + nearest_distance * ray.direction;
    const double miss = glm::distance(nearest, model.center);
    if (miss >= radius) {
        light.vector = glm::normalize(nearest - model.center);
        return;
    }
    const double half_chord = std::sqrt(radius * radius - miss * miss);
    const bool behind = glm::dot(handle - model.center, ray_direction(view, handle)) > 0.0;
    light.vector = glm::normalize(nearest + (behind ? half_chord : -half_chord) * ray.direction -
                                  model.center);
}

void push_light(Light& light, const SceneBounds& model, const ScreenView& view, double factor) {
    const glm::dvec3 handle = light_handle(light, model);
    const glm::dvec3 along = ray_direction(view, handle);
    if (!light.directional) {
        if (view.camera().is_orthographic())
            light.vector += (factor - 1.0) * model.radius * along;
        else
            light.vector = view.camera().eye + factor * (light.vector - view.camera().eye);
        limit_distance(light, model);
        return;
    }
    const glm::dvec3 from_center = handle - model.center;
    const double depth = glm::dot(from_center, along);
    if ((depth < 0.0) == (factor > 1.0))
        light.vector = glm::normalize(from_center - 2.0 * depth * along);
}

Light as_lamp(const Light& light, const SceneBounds& model) {
    if (!light.directional) return light;
    // Twice as far out as the sun's handle: most of the model is then lit from the same side as before.
    return {.vector = model.center + 2.0 * (light_handle(light, model) - model.center),
            .directional = false};
}

Light as_sun(const Light& light, const SceneBounds& model) {
    if (light.directional) return light;
    return {.vector = direction_from_center(light.vector, model), .directional = true};
}

}  // namespace rimline::tools
