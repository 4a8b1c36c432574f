#pragma once

// How each caster's shadow volume is drawn for each light: the cheapest way that is proven to give the same
// picture.
//
// Single form. Let F and B be the triangles of a mesh between the light and a point that are front and
// back by their bits. The general form counts F + B, the single form F alone, with half the fill. Let the
// mesh's triangles form a closed chain: each edge is traversed equally often in both directions. Then the
// sides of the general form cancel, and F - B is the mesh's winding number around the point minus that
// around the light. The points in question are visible to the camera, and the mesh itself is drawn. So no
// triangle of the mesh lies between the eye and the point, and the winding number around both is the same.
// If neither the light nor the eye is within the mesh's bounds, both winding numbers are 0 and F + B = 2F.
// This includes self-intersection, inside-out parts and negative winding. It also holds for what is
// rasterized, for each sample and for any bits, because the same caps cancel, each at its own depth.
//
// Depth pass. A closed volume that is not cut by the near plane covers each sample as often from the
// front as from the back, so counting fragments that pass the depth test and those that fail it gives the
// same result. Caps never pass: a light cap has the depth of the surface it lies on, and a dark cap lies
// behind everything. So sides alone are enough, if the volume does not meet the near plane. The volume meets
// a ball around the eye exactly if the caster meets the path from the ball to the light, a segment or, for a
// directional light, a ray, as thick as the ball. Here the ball contains the near rectangle, and the caster
// is its bounding box. Orthographic volumes are finite, and must end behind the far plane; the near plane must not cut
// the caster, and may cut the volume, because depth is clamped there.
//
// One end. The rays of a point light L from all points go through infinity and meet again in L with its signs turned,
// -L. So a side is the triangle of its edge and -L, as for directional lights, whose rays meet at infinity; it is half
// as many triangles, and dark caps are not needed. What lies past infinity has a depth behind everything, to which it
// is clamped. This needs L behind the camera, so that -L is before it, and a caster that the near plane does not cut,
// because nothing is clipped there where depth is clamped. Both methods then count the same triangles.
//
// Single form and depth pass both need all faces of the mesh in the depth buffer. A mesh that fades has only the front
// ones there: it is drawn in the general form, by depth fail (engine/frame/draw_list_builder.cpp).
//
// All are decided in the mesh's own coordinates, in double, with a margin for the shaders' rounding. Cost: a
// few hundred operations for each pair of caster and light.
// Sources: Everitt, Kilgard 2002; Hornus et al., ZP+: correct Z-pass stencil shadows, 2005; Kim, Kim,
// Turk, Exact and Robust Shadow Volumes with Signed Multiplicities, 2008.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

class Mesh;

/// Which fragments are counted.
enum class ShadowMethod : std::uint8_t {
    automatic,  ///< Depth pass where it is proven right, else depth fail.
    fail,       ///< Those behind the surface. Always right.
    pass,       ///< Those before the surface: of a choice. Asked for, it is automatic.
};

/// Which faces cast.
enum class ShadowForm : std::uint8_t {
    automatic,  ///< Single where it is proven right, else general.
    general,    ///< Every face, front or back. Always right.
    single,     ///< Front faces: of a choice. Asked for, it is automatic.
};

/// The stage that makes sides of edge records. Both draw the same triangles. A driver may transform the
/// output of a geometry stage with other roundings: then a pixel on a volume's edge can fall between its
/// caps and its sides, about one in ten million, and depth pass and depth fail can differ there.
enum class SideStage : std::uint8_t {
    vertex,    ///< Vertex pulling: on every device, watertight to the last bit.
    geometry,  ///< Geometry shaders, where the device has them.
};

/// The choice for one caster and one light; neither is automatic.
struct ShadowChoice {
    ShadowMethod method = ShadowMethod::fail;
    ShadowForm form = ShadowForm::general;
    bool ends_in_one_point = false;  ///< Sides are triangles, and there are no dark caps.
    const char* method_reason = "";  ///< A phrase in static storage.
    const char* form_reason = "";
};

/// Whether a mesh's triangles form a closed chain: each edge is traversed equally often in both
/// directions. O(edges that are not regular).
bool is_closed_chain(const Mesh& mesh);

/// The camera for choose_shadow(), in the mesh's own coordinates.
struct ShadowView {
    bool orthographic = false;
    glm::dvec3 eye{0.0};
    double near_reach =
        0.0;  ///< Perspective: distance from the eye to the near rectangle's corners.
    glm::dvec3 back{0.0, 0.0, 1.0};  ///< Towards the viewer, a unit vector.
    double far = 0.0;                ///< Orthographic: the far plane is back·x = far,
    /// and the near plane back·x = near; infinite where it is before all of the scene.
    double near = std::numeric_limits<double>::infinity();
};

/// Whether a perspective view's eye and near rectangle are outside a box. Orthographic: whether the box is behind the
/// near plane.
bool is_outside(const ShadowView& view, const glm::dvec3& low, const glm::dvec3& high);

/// A caster before one light.
struct ShadowCaster {
    glm::dvec3 low{0.0}, high{0.0};  ///< Bounds of all its vertices.
    bool is_closed_chain = false;
    HomogeneousPoint
        light{};  ///< The point of its face bits and its volume. A direction is a unit vector.
    /// LightData.extrusion. 0: to infinity, as it must be unless the view is orthographic.
    double extrusion = 0.0;
    /// Whether a finite volume was extruded as far as needed.
    bool reaches_far_enough = true;
};

/// Takes the wanted method and form only where they are proven right. O(1).
ShadowChoice choose_shadow(ShadowMethod wanted_method, ShadowForm wanted_form,
                           const ShadowView& view, const ShadowCaster& caster);

/// Where the shadow of one caster from one light can change a picture (engine/frame/shadow_bounds.h): a rectangle of
/// pixels, and the depths of the surfaces in it that may lie in the shadow. Volumes are counted only there.
struct ShadowReach {
    std::int32_t x = 0, y = 0;            ///< In pixels of the picture.
    std::uint32_t width = 0, height = 0;  ///< 0: the shadow is not in the picture.
    float min_depth = 0.0f, max_depth = 1.0f;

    bool is_empty() const noexcept { return width == 0 || height == 0; }
};

const char* name_of(ShadowMethod method);
const char* name_of(ShadowForm form);

}  // namespace rimline
