#pragma once

// Lights as things to take hold of.
//
// A sun has no place: its handle lies on a sphere around the model, in the direction it shines from, and
// slides on that sphere. A lamp's handle is the lamp; it moves in the plane through it that faces the
// viewer, and towards or away from the eye by the wheel.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/scene.h"
#include "tools/view/screen_view.h"

namespace rimline::tools {

/// Of the sphere that suns slide on, in the model's radii: within the picture when the model is.
constexpr double k_sun_radii = 0.85;

glm::dvec3 light_handle(const Light& light, const SceneBounds& model);

/// Moves a light so that its handle is seen at `pixel`. Where the sun's sphere is not seen there, the
/// handle goes to the sphere's outline. A sun behind the model stays behind it.
void drag_light(Light& light, const SceneBounds& model, const ScreenView& view,
                const glm::dvec2& pixel);

/// Moves a lamp along the line from the eye to `factor` times its distance; a sun to the other side of
/// its sphere where `factor` is over 1 and it is on the near side, or the other way round.
void push_light(Light& light, const SceneBounds& model, const ScreenView& view, double factor);

/// A lamp where a sun's handle was, and a sun from where a lamp was.
Light as_lamp(const Light& light, const SceneBounds& model);
Light as_sun(const Light& light, const SceneBounds& model);

}  // namespace rimline::tools
