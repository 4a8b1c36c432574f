#include "silhouette/field/front_side.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/mesh/ground_axes.h"
#include "silhouette/mesh/upright.h"

namespace rimline {

namespace {

constexpr int k_smoothing_rounds = 12;
constexpr int k_compared = 12;
constexpr double k_compared_elevation_deg = 10.0;
// Directions that see little, as an open shell from behind, have this share of the mean area besides.
constexpr double k_floor_share = 0.25;
constexpr double k_convention = 0.06;
constexpr double k_chance = 0.05;  // As large a harmonic comes about without a front.
constexpr double k_certain = 0.2;  // From here on nothing else counts.
constexpr double k_sided = 0.015;  // Of a symmetric mesh: enough to tell front from back.

class Detail {
public:
    Detail(const Mesh& mesh, const std::stop_token& stop) : mesh_(mesh), stop_(stop) {
        measure_faces();
        measure_bending(smoothed_normals());
    }

    /// The first harmonic over the directions around `up`, as a share of the mean.
    glm::dvec3 harmonic(const glm::dvec3& up) const {
        const auto [right, away] = ground_axes(up);
        const double elevation = glm::radians(k_compared_elevation_deg);
        std::array<glm::dvec3, k_compared> level;
        std::array<double, k_compared> area{}, bending{};
        double mean_area = 0.0;
        for (std::size_t i = 0; i < k_compared; ++i) {
            checkpoint();
            const double azimuth = 2.0 * std::numbers::pi * double(i) / k_compared;
            level[i] = std::sin(azimuth) * right - std::cos(azimuth) * away;
            const glm::vec3 towards(std::cos(elevation) * level[i] +
                                    std::sin(elevation) * glm::normalize(up));
            for (std::size_t f = 0; f < area_.size(); ++f) {
                const float cosine = std::max(glm::dot(normals_[f], towards), 0.0f);
                area[i] += cosine * area_[f];
                bending[i] += cosine * bending_[f];
            }
            mean_area += area[i] / k_compared;
        }
        glm::dvec3 harmonic(0.0);
        double mean = 0.0;
        for (std::size_t i = 0; i < k_compared; ++i) {
            const double density = bending[i] / (area[i] + k_floor_share * mean_area);
            if (!std::isfinite(density)) return glm::dvec3(0.0);
            harmonic += 2.0 / k_compared * density * level[i];
            mean += density / k_compared;
        }
        return mean > 0.0 ? harmonic / mean : glm::dvec3(0.0);
    }

private:
    void checkpoint() const { LongCall{stop_, {}}.checkpoint(0.0); }

    void measure_faces() {
        normals_.reserve(mesh_.face_count());
        area_.reserve(mesh_.face_count());
        double volume = 0.0;  // Negative if the faces are turned inwards.
        for (const Triangle& t : mesh_.triangles()) {
            const auto corner = [&](std::size_t i) {
                return glm::dvec3(mesh_.positions()[index(t[i])]) - mesh_.center();
            };
            const glm::dvec3 across = glm::cross(corner(1) - corner(0), corner(2) - corner(0)) /
                                      (mesh_.radius() * mesh_.radius());
            const double twice = glm::length(across);
            volume += glm::dot(across, corner(0)) / mesh_.radius();
            normals_.emplace_back(twice > 0.0 ? across / twice : glm::dvec3(0.0));
            area_.push_back(static_cast<float>(0.5 * twice));
        }
        if (volume < 0.0)
            for (glm::vec3& normal : normals_) normal = -normal;
    }

    template <typename Use>
    void each_regular_edge(const Use& use) const {
        const Mesh::EdgeRange regular = mesh_.edges_of_class(EdgeClass::regular);
        for (std::uint32_t e = regular.first; e < regular.last; ++e) {
            const Edge& edge = mesh_.edge(EdgeId{e});
            use(edge, index(edge.faces[0]), index(edge.faces[1]));
        }
    }

    std::vector<glm::vec3> smoothed_normals() const {
        std::vector<glm::vec3> smooth(normals_.size());
        for (std::size_t f = 0; f < smooth.size(); ++f) smooth[f] = area_[f] * normals_[f];
        std::vector<glm::vec3> sum;
        for (int round = 0; round < k_smoothing_rounds; ++round) {
            checkpoint();
            sum = smooth;
            each_regular_edge([&](const Edge&, std::size_t a, std::size_t b) {
                sum[a] += smooth[b];
                sum[b] += smooth[a];
            });
            for (glm::vec3& normal : sum) normal *= 0.25f;  // Of a face and its three neighbors.
            smooth.swap(sum);
        }
        for (glm::vec3& normal : smooth) {
            const float length = glm::length(normal);
            normal = length > 0.0f ? normal / length : glm::vec3(0.0f);
        }
        return smooth;
    }

    void measure_bending(const std::vector<glm::vec3>& smooth) {
        bending_.assign(normals_.size(), 0.0f);
        each_regular_edge([&](const Edge& edge, std::size_t a, std::size_t b) {
            const glm::vec3 along = mesh_.positions()[index(edge.vertices[1])] -
                                    mesh_.positions()[index(edge.vertices[0])];
            const float angle = std::atan2(glm::length(glm::cross(smooth[a], smooth[b])),
                                           glm::dot(smooth[a], smooth[b]));
            const float half = 0.5f * angle * glm::length(along) / float(mesh_.radius());
            bending_[a] += half;
            bending_[b] += half;
        });
    }

    const Mesh& mesh_;
    std::stop_token stop_;
    std::vector<glm::vec3> normals_;     // Of faces, outwards.
    std::vector<float> area_, bending_;  // With the radius as 1.
};

// The axis that a mesh looks along, either way, by its symmetry: across it, it is not the same, and across the other
// axis of the ground alone it is. None if it is symmetric otherwise or if `up` is no axis.
std::optional<glm::dvec3> axis_of_sight(const Mesh& mesh, const glm::dvec3& up) {
    const UprightEvidence evidence = measure_upright(mesh);
    const auto [right, away] = ground_axes(up);
    const std::array<std::array<glm::dvec3, 2>, 2> sides{{{right, away}, {away, right}}};
    for (const auto& [side, sight] : sides)
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (std::abs(side[int(axis)]) > 0.99 && is_symmetric_across_alone(evidence, axis))
                return sight;
    return std::nullopt;
}

}  // namespace

FrontSide find_front_side(const Mesh& mesh, const glm::dvec3& up, const std::stop_token& stop) {
    if (!(mesh.radius() > 0.0)) return {};
    const glm::dvec3 front = -ground_axes(up).second;
    glm::dvec3 evidence = Detail(mesh, stop).harmonic(up);
    const double size = glm::length(evidence);
    evidence = size > k_chance ? evidence * (1.0 - k_chance / size) : glm::dvec3(0.0);
    if (mesh.is_up_known() || glm::normalize(up).y > 0.99) evidence += k_convention * front;
    if (const std::optional<glm::dvec3> sight = axis_of_sight(mesh, up)) {
        const double sided = glm::dot(evidence, *sight);
        evidence =
            std::abs(sided) > k_sided ? std::copysign(k_certain, sided) * *sight : glm::dvec3(0.0);
    }
    const double length = glm::length(evidence);
    if (length == 0.0) return {};
    return {evidence / length, std::min(length / k_certain, 1.0)};
}

}  // namespace rimline
