#pragma once

// Pixels that a rasterizer decides by its roundings, found from edges in double.
//
// Rays at a pixel's center know no roundings, and rays around it do not always find what is near: a
// silhouette before something close behind it, the start of a volume inside another volume's shadow. So
// the edges are asked.
//
//   Places. Vulkan lets a device put corners on a grid, of 1/256 pixel on lavapipe
//     (subPixelPrecisionBits). Where an edge passes a center by less, either side may win the pixel.
//   Depths. The side of a shadow volume begins in the surface, at the edge that casts it, and cuts other
//     surfaces. Depths are floats with 24 bits, each interpolated over its own triangle, and the side's
//     reaches to infinity: where side and surface differ by less than 2^-20 of their distance, which of
//     them is in front is rounding. Where two sides are as near as that, and they are at every edge that
//     casts and behind every face that the light grazes, the stencil may count the one and not the other:
//     a pixel by itself, in light or in shadow.

#include <cstddef>
#include <glm/vec2.hpp>

#include "tests/engine/support/ray_reference.h"

namespace rimline::tests {

/// Whether a silhouette or border of what the camera sees passes `place` within the rasterizer's grid, not
/// hidden by the surface that is seen at `place`.
bool is_on_silhouette(const RayReference& rays, glm::dvec2 place, glm::dvec2 picture_size);

/// Whether the surface seen at `place` is cut there by a side of a shadow volume, or touched, within the
/// roundings of places and depths.
bool is_on_side(const RayReference& rays, glm::dvec2 place, glm::dvec2 picture_size);

}  // namespace rimline::tests
