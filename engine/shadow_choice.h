#pragma once

// How each caster's volume is drawn for each light: what is shown to give the same picture, and costs
// least.
//
// Single form. Let F and B be the triangles of a mesh between the light and a point that are front and
// back by their bits. The general form counts F + B, the single form F alone, half the fill. For a mesh
// whose triangles form a closed chain (every edge is run as often one way as the other), F - B is what
// is left when the sides of the general form, which cancel, are taken away: the mesh's own winding
// number around the point, less that around the light. The points that are asked for are seen by the
// camera, and the mesh itself is drawn: no triangle of it lies between, so its winding number around
// them is that around the eye. So where neither the light nor the eye is within the mesh's bounds,
// F + B = 2F, whatever the mesh does to itself: self-intersection, inside-out parts and negative winding
// included. It holds for what is rasterized too, sample by sample and whatever the bits: the same caps,
// each at its own depth, are what cancels.
//
// Depth pass. A closed volume that is not cut by the near plane covers each sample as often from the
// front as from the back, so what passes the depth test and what fails it count alike. Of what passes,
// caps are no part: a light cap has the depth of the surface it lies on, a dark cap lies behind
// everything. So sides alone do, where the volume keeps clear of the near plane. It meets a ball around
// the eye just where its caster meets the way from the ball to the light: a segment, or a ray towards a
// directional light, as thick as the ball. The ball here holds the near rectangle, and the caster is
// its bounding box. Orthographic volumes are finite, and must end behind the far plane.
//
// Both are decided in the mesh's own coordinates, in double, with a margin over the shaders' rounding;
// a few hundred operations a pair of caster and light.
// Sources: Everitt, Kilgard 2002; Hornus et al., ZP+: correct Z-pass stencil shadows, 2005; Kim, Kim,
// Turk, Exact and Robust Shadow Volumes with Signed Multiplicities, 2008.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// Which side of the surface is counted.
enum class ShadowMethod : std::uint8_t {
    automatic,  ///< Depth pass where it is shown to be right, else depth fail.
    fail,       ///< What lies behind the surface: right for everything.
    pass,       ///< As automatic: where depth pass is not shown to be right it is not taken.
};

/// Which faces cast.
enum class ShadowForm : std::uint8_t {
    automatic,  ///< Single where it is shown to be right, else general.
    general,    ///< Every face, front or back: right for everything.
    single,     ///< As automatic: where front faces alone are not shown to be right, all cast.
};

/// What a caster and a light were given, neither automatic.
struct ShadowChoice {
    ShadowMethod method = ShadowMethod::fail;
    ShadowForm form = ShadowForm::general;
    const char* method_reason = "";  ///< A phrase that lives as long as the program.
    const char* form_reason = "";
};

/// Whether a mesh's triangles form a closed chain: every edge is run as often in one direction as in
/// the other. O(edges that are not regular).
bool is_closed_chain(const Mesh& mesh);

/// A light, in the mesh's own coordinates, from which every vertex has a direction: `light` itself, or
/// where it lies exactly on a vertex a point beside it, away from the middle by 2^-16 of the mesh's
/// greatest coordinate: a hundred roundings, so that it lies surely on one side of the planes around the
/// vertex. Silhouettes and volumes must be of the same point. O(vertices) where the light is within the
/// mesh's bounds.
HomogeneousPoint light_off_vertices(const Mesh& mesh, const HomogeneousPoint& light);

/// The camera as a choice sees it, in the mesh's own coordinates.
struct ShadowView {
    bool orthographic = false;
    glm::dvec3 eye{0.0};
    double near_reach =
        0.0;  ///< Perspective: how far the near rectangle's corners are from the eye.
    glm::dvec3 back{0.0, 0.0, 1.0};  ///< Towards the viewer, a unit vector.
    double far = 0.0;                ///< Orthographic: the far plane is where back·x is this.
};

/// Whether a perspective view's eye and near rectangle are outside a box, an orthographic view's always.
bool is_outside(const ShadowView& view, const glm::dvec3& low, const glm::dvec3& high);

/// A caster before one light.
struct ShadowCaster {
    glm::dvec3 low{0.0}, high{0.0};  ///< Bounds of all its vertices.
    bool is_closed_chain = false;
    HomogeneousPoint light{};  ///< As its bits and its volume have it.
    /// LightData.extrusion: 0 to infinity, as it must be unless the view is orthographic.
    double extrusion = 0.0;
    /// Whether a finite volume was extruded as far as it would need to be.
    bool reaches_far_enough = true;
};

/// Never a choice that is not shown to be right, whatever is wanted.
ShadowChoice choose_shadow(ShadowMethod wanted_method, ShadowForm wanted_form,
                           const ShadowView& view, const ShadowCaster& caster);

const char* name_of(ShadowMethod method);
const char* name_of(ShadowForm form);

}  // namespace rimline
