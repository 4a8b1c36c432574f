#pragma once

// Handles by which the mouse moves lights.
//
// A sun has no position. Its handle lies on a sphere around the model, in the direction of the sun, and
// moves on that sphere. A lamp's handle is the lamp's position. It moves in the plane through it that is
// perpendicular to the view direction; the wheel moves it towards the eye or away.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/scene.h"
#include "tools/view/screen_view.h"

namespace rimline::tools {

/// Radius of the sphere on which suns' handles lie, in the model's radii. Below 1, so that the handles are
/// in the picture when the model is.
constexpr double k_sun_radii = 0.85;

glm::dvec3 light_handle(const Light& light, const SceneBounds& model);

/// Lamps go no farther from the model's center, in the model's radii: coordinates have a limited range.
constexpr double k_max_lamp_radii = 1000.0;

/// Where the handle is shown, in an area between two corners: a handle outside of it, or behind the eye, at its edge.
struct ShownHandle {
    glm::dvec2 pixel;
    glm::dvec2 outwards;  ///< Where it is from there; 0 if it is there.

    bool is_outside() const { return outwards != glm::dvec2(0.0); }
};
ShownHandle shown_handle(const Light& light, const SceneBounds& model, const ScreenView& view,
                         const glm::dvec2& low, const glm::dvec2& high);

/// Moves a light so that its handle is at `pixel`. A lamp behind the eye comes to the model's distance. If the sphere
/// of suns does not cover that pixel, the handle moves to the sphere's outline. A sun behind the model stays behind
/// it.
void drag_light(Light& light, const SceneBounds& model, const ScreenView& view,
                const glm::dvec2& pixel);

/// Multiplies a lamp's distance from the eye by `factor`. A sun on the near side of its sphere moves to the
/// far side if `factor` is above 1; a sun on the far side moves to the near side if it is below 1.
void push_light(Light& light, const SceneBounds& model, const ScreenView& view, double factor);

/// A lamp in the direction of a sun, and a sun in the direction of a lamp. Other lights are returned
/// unchanged.
Light as_lamp(const Light& light, const SceneBounds& model);
Light as_sun(const Light& light, const SceneBounds& model);

}  // namespace rimline::tools
