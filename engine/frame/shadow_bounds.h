#pragma once

// Where in the picture, and at which depths, surfaces may lie in the shadow of one caster: volumes are only counted
// there.
//
// Let C be the box of the caster, and S the set of all points whose way to the light meets C. S is convex. It is
// bounded by the faces of C that the light sees, and by the planes through the light and the edges between these and
// the other faces. For each box R of a surface, the vertices of S and R together lie on the edges of R, clipped by the
// planes of S, or on the edges of S, clipped by R. They are projected, and the reach is what lies between them, and
// where the surface itself can be in the picture (InstanceView::screen), which is less than its box.
//
// A sample outside of the reach has a surface that is not in S, where closed volumes count to zero. A scissor and
// bounds of the stored depth, which volumes do not change, leave out whole samples. So what they count elsewhere is
// the same.
//
// Everything is computed in the camera's axes, from the floats that the shaders use, and all boxes are grown by
// the shaders' rounding. If the light is within C, S is everything.

#include <array>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/frame/frame_view.h"
#include "engine/shadow_choice.h"

namespace rimline {

class ShadowBounds {
public:
    /// Holds a reference: `view` must outlive it. `has_backdrop`: surfaces lie anywhere in the picture. Many boxes
    /// are joined, so that there are at most k_max_receivers. O(instances).
    ShadowBounds(const FrameView& view, bool has_backdrop);

    /// Of instance `instance`, from light `light`. `extrusion` is LightData.extrusion. About a microsecond for each
    /// surface that may be in the shadow, less than 0.1 for others.
    ShadowReach reach_of(std::size_t instance, std::size_t light, float extrusion) const;

    static constexpr std::size_t k_max_receivers = 16;

private:
    // A box with its own axes, relative to the camera, in the camera's axes and the world's unit.
    struct Box {
        glm::dmat3 axes;  // Unit vectors, nearly at right angles.
        glm::dvec3 low, high;
        double reach;  // The distance of its farthest point from the camera.

        glm::dvec3 corner(unsigned number) const;
    };
    struct Receiver {
        Box box;
        ScreenBox screen;
        std::array<glm::dvec3, 8> corners;  // Grown by the rounding.
    };

    Box box_of(std::size_t instance) const;
    ScreenBox screen_box_of(std::size_t instance) const;
    void add_receiver(const Box& box, const ScreenBox& screen);

    const FrameView& view_;
    bool has_backdrop_;
    std::vector<Receiver> receivers_;  // Of those that are not behind the near plane.
};

}  // namespace rimline
