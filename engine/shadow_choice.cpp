#include "engine/shadow_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "engine/shader_rounding.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

namespace {

struct Box {
    glm::dvec3 low, high;
};

Box grown(const Box& box, double by) { return {box.low - by, box.high + by}; }

bool contains(const Box& box, const glm::dvec3& point) {
    return glm::all(glm::lessThanEqual(box.low, point)) &&
           glm::all(glm::lessThanEqual(point, box.high));
}

// Whether the segment from `start` to `start + length * step` meets a box, by the slab method.
bool meets(const Box& box, const glm::dvec3& start, const glm::dvec3& step, double length) {
    double enter = 0.0;
    double leave = length;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = box.low[axis] - start[axis];
        const double high = box.high[axis] - start[axis];
        if (step[axis] == 0.0) {
            if (low > 0.0 || high < 0.0) return false;
            continue;
        }
        const double a = low / step[axis];
        const double b = high / step[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

glm::dvec3 light_vector(const ShadowCaster& caster) { return glm::dvec3(caster.light.xyz()); }

// The end of a finite volume's ray that begins at `point` of the caster. For orthographic views.
glm::dvec3 extruded(const ShadowCaster& caster, const glm::dvec3& point) {
    const glm::dvec3 light = light_vector(caster);
    if (caster.light.is_direction()) return point - caster.extrusion * light;
    return point + caster.extrusion * (point - light);
}

// By how much the caster's bounds must be grown to contain the positions that the shaders compute.
double margin_of(const Box& box, const ShadowView& view, const ShadowCaster& caster) {
    double reach =
        view.orthographic ? reach_from(box, 0.5 * (box.low + box.high)) : reach_from(box, view.eye);
    if (!caster.light.is_direction())
        reach += reach_from(box, light_vector(caster)) +
                 (view.orthographic ? 0.0 : glm::distance(view.eye, light_vector(caster)));
    return k_shader_rounding * reach;
}

// The reason why the single form is not proven right, or null.
const char* why_not_single(const Box& box, const ShadowView& view, const ShadowCaster& caster) {
    if (!caster.is_closed_chain) return "the mesh is not closed, or not consistently oriented";
    if (!caster.light.is_direction() && contains(box, light_vector(caster)))
        return "the light is within the mesh's bounds";
    if (!caster.reaches_far_enough) return "the light is too near for a finite volume";
    if (!is_outside(view, box.low, box.high)) return "the camera is within the mesh's bounds";
    return nullptr;
}

// The reason why depth pass is not proven right, or null.
const char* why_not_pass(const Box& box, const ShadowView& view, const ShadowCaster& caster) {
    if (view.orthographic) {
        // The end is an affine function of the beginning, so all ends lie between those of the corners.
        for (unsigned corner = 0; corner < 8; ++corner) {
            const glm::dvec3 start((corner & 1u) != 0 ? box.high.x : box.low.x,
                                   (corner & 2u) != 0 ? box.high.y : box.low.y,
                                   (corner & 4u) != 0 ? box.high.z : box.low.z);
            if (!(glm::dot(view.back, extruded(caster, start)) < view.far))
                return "the volume may end before the far plane";
        }
        if (!is_outside(view, box.low, box.high)) return "the near plane may cut the mesh";
        return nullptr;
    }
    const glm::dvec3 light = light_vector(caster);
    const bool meets_near =
        caster.light.is_direction()
            ? meets(grown(box, view.near_reach), view.eye, light,
                    std::numeric_limits<double>::infinity())
            : meets(grown(box, view.near_reach), view.eye, light - view.eye, 1.0);
    return meets_near ? "the volume may meet the near plane" : nullptr;
}

// The least cosine between the way from the eye to a light and the axis behind the camera: before the camera, -L is
// then at most 16 times as far from the center of the picture as the picture's distance.
constexpr double k_behind = 1.0 / 16.0;

bool ends_in_one_point(const Box& box, const ShadowView& view, const ShadowCaster& caster) {
    if (view.orthographic) return false;
    if (caster.light.is_direction()) return true;
    const glm::dvec3 to_light = light_vector(caster) - view.eye;
    if (!(glm::dot(view.back, to_light) > k_behind * glm::length(to_light))) return false;
    const glm::dvec3 nearest =
        glm::mix(box.low, box.high, glm::greaterThan(view.back, glm::dvec3(0.0)));
    return glm::dot(view.back, view.eye - nearest) > view.near_reach;
}

}  // namespace

bool is_outside(const ShadowView& view, const glm::dvec3& low, const glm::dvec3& high) {
    if (!view.orthographic) return !contains(grown({low, high}, view.near_reach), view.eye);
    const glm::dvec3 nearest = glm::mix(low, high, glm::greaterThan(view.back, glm::dvec3(0.0)));
    return glm::dot(view.back, nearest) < view.near;
}

bool is_closed_chain(const Mesh& mesh) {
    if (mesh.edges_of_class(EdgeClass::border).size() > 0) return false;
    for (std::uint32_t e = mesh.edges_of_class(EdgeClass::regular).last; e < mesh.edge_count();
         ++e) {
        const Edge& edge = mesh.edge(EdgeId{e});
        int sum = 0;
        for (const FaceId face : mesh.faces_of(EdgeId{e})) {
            const Triangle& triangle = mesh.triangles()[index(face)];
            for (std::size_t corner = 0; corner < 3; ++corner)
                if (mesh.edges_of(face)[corner] == EdgeId{e})
                    sum += triangle[corner] == edge.vertices[0] ? 1 : -1;
        }
        if (sum != 0) return false;
    }
    return true;
}

ShadowChoice choose_shadow(ShadowMethod wanted_method, ShadowForm wanted_form,
                           const ShadowView& view, const ShadowCaster& caster) {
    const Box exact{caster.low, caster.high};
    const Box box = grown(exact, margin_of(exact, view, caster));
    ShadowChoice choice{.ends_in_one_point = ends_in_one_point(box, view, caster)};
    if (wanted_form == ShadowForm::general) {
        choice.form_reason = "asked for";
    } else if (const char* reason = why_not_single(box, view, caster)) {
        choice.form_reason = reason;
    } else {
        choice.form = ShadowForm::single;
        choice.form_reason = "closed, with the light and the camera out of its bounds";
    }
    if (wanted_method == ShadowMethod::fail) {
        choice.method_reason = "asked for";
    } else if (const char* reason = why_not_pass(box, view, caster)) {
        choice.method_reason = reason;
    } else {
        choice.method = ShadowMethod::pass;
        choice.method_reason = view.orthographic ? "the volume ends behind the far plane"
                                                 : "the volume keeps clear of the near plane";
    }
    return choice;
}

const char* name_of(ShadowMethod method) {
    switch (method) {
        case ShadowMethod::automatic: return "auto";
        case ShadowMethod::fail: return "fail";
        case ShadowMethod::pass: return "pass";
    }
    std::abort();
}

const char* name_of(ShadowForm form) {
    switch (form) {
        case ShadowForm::automatic: return "auto";
        case ShadowForm::general: return "general";
        case ShadowForm::single: return "single";
    }
    std::abort();
}

}  // namespace rimline
