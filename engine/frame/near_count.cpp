#include "engine/frame/near_count.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "engine/frame/segment_crossings.h"
#include "engine/shader_rounding.h"
#include "silhouette/mesh/face_bits.h"

namespace rimline {

namespace {

// The boxes around the thick segment, and the most faces that may meet them.
constexpr int k_pieces = 64;
constexpr std::size_t k_max_faces = 4096;

// From the eye to the light, or past the mesh on the way to a directional light.
glm::dvec3 way_to_light(const HomogeneousPoint& light, const Bounds& bounds,
                        const glm::dvec3& eye) {
    if (light.is_direction())
        return 2.0 * reach_from(bounds, eye) * glm::normalize(glm::dvec3(light.xyz()));
    return glm::dvec3(light.xyz()) - eye;
}

// The faces whose boxes may be within `radius` of the segment from the eye by `way`; empty if they are too many.
std::optional<std::vector<std::uint32_t>> faces_around(const FaceTree& tree, const Bounds& bounds,
                                                       const glm::dvec3& eye, const glm::dvec3& way,
                                                       double radius) {
    // The part within the bounds.
    double first = 0.0, last = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (way[axis] == 0.0) continue;
        const double low = (bounds.low[axis] - radius - eye[axis]) / way[axis];
        const double high = (bounds.high[axis] + radius - eye[axis]) / way[axis];
        first = std::max(first, std::min(low, high));
        last = std::min(last, std::max(low, high));
    }
    std::vector<std::uint32_t> faces;
    if (!(first <= last)) return faces;
    const double slack =
        radius + 0x1p-22 * std::max(glm::length(glm::dvec3(bounds.low)),
                                    std::max(glm::length(glm::dvec3(bounds.high)), radius));
    for (int piece = 0; piece < k_pieces; ++piece) {
        const auto place = [&](int number) {
            return eye + (first + (last - first) * number / k_pieces) * way;
        };
        const glm::dvec3 a = place(piece);
        const glm::dvec3 b = place(piece + 1);
        const FaceBox box{glm::vec3(glm::min(a, b) - slack), glm::vec3(glm::max(a, b) + slack)};
        const bool has_too_many = tree.any_meeting(box, [&](std::uint32_t face) {
            faces.push_back(face);
            return faces.size() > k_max_faces;
        });
        if (has_too_many) return std::nullopt;
    }
    std::ranges::sort(faces);
    const auto repeated = std::ranges::unique(faces);
    faces.erase(repeated.begin(), repeated.end());
    return faces;
}

}  // namespace

std::optional<std::vector<std::uint32_t>> near_counts(const CountedVolume& volume,
                                                      const VolumeCount& count,
                                                      const ShadowView& view) {
    RIMLINE_CHECK(!view.orthographic);
    const Mesh& mesh = volume.caster->mesh();
    const glm::dvec3 to_light = way_to_light(volume.light, mesh.bounds(), view.eye);
    const double margin = k_shader_rounding *
                          (reach_from(mesh.bounds(), view.eye) +
                           reach_from(mesh.bounds(), view.eye + to_light) + glm::length(to_light));
    const double radius = view.near_reach + margin;
    const auto faces =
        faces_around(volume.caster->faces(), mesh.bounds(), view.eye, to_light, radius);
    if (!faces) return std::nullopt;

    const bool is_single = volume.form == ShadowForm::single;
    const std::uint32_t regular_end = mesh.edges_of_class(EdgeClass::regular).last;
    const auto part = [&](FaceId face) {
        return count.part_of.empty() ? 0 : count.part_of[index(face)];
    };
    std::vector<std::uint32_t> counts(std::max<std::size_t>(count.parts.size(), 1), 0);
    for (const std::uint32_t f : *faces) {
        const FaceId face{f};
        const Corners corners = corners_from(mesh, face, view.eye);
        const bool is_front = face_bit(volume.face_words, face);
        for (std::size_t c = 0; c < 3; ++c) {
            const EdgeId edge = mesh.edges_of(face)[c];
            if (edge == k_no_edge) return std::nullopt;
            bool casts = index(edge) >= regular_end;
            if (!casts) {
                const auto& [f0, f1] = mesh.edge(edge).faces;
                casts = face_bit(volume.face_words, f0) != face_bit(volume.face_words, f1) ||
                        part(f0) != part(f1);
            }
            if (casts && distance_between(to_light, corners[c], corners[(c + 1) % 3]) <= radius)
                return std::nullopt;
        }
        if (distance_to_triangle(glm::dvec3(0.0), corners) <= radius ||
            distance_to_triangle(to_light, corners) <= margin)
            return std::nullopt;
        const Crossing crossing = crossing_of(to_light, corners);
        if (crossing == Crossing::none) continue;
        // The volume is made by the bit.
        if (crossing == Crossing::unknown || (crossing == Crossing::from_front) != is_front)
            return std::nullopt;
        if (is_front || !is_single) ++counts[part(face)];
    }
    return counts;
}

const std::optional<std::vector<std::uint32_t>>& NearCounter::counts(const CountedVolume& volume,
                                                                     const VolumeCount& count,
                                                                     const ShadowView& view) {
    const Key key{volume.light, volume.form, view.eye, view.near_reach};
    if (key_ != key) {
        key_.reset();  // Where memory does not suffice, nothing is known.
        counts_ = near_counts(volume, count, view);
        key_ = key;
    }
    return counts_;
}

}  // namespace rimline
