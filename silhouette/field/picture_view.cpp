#include "silhouette/field/picture_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>

#include "silhouette/field/best_views.h"
#include "silhouette/field/front_side.h"
#include "silhouette/mesh/any_perpendicular.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/ground_axes.h"

namespace rimline {

namespace {

constexpr int k_side = 160;        // Pixels.
constexpr double k_margin = 1.02;  // Of the picture around the bounding sphere.
constexpr int k_around = 24;       // Directions around the axis.
constexpr std::array<double, 3> k_elevations_deg{8.0, 20.0, 32.0};
constexpr double k_flat_share = 0.6;      // Of a flat mesh: height by width.
constexpr double k_flat_rise_deg = 13.0;  // It is seen from higher up.
constexpr std::size_t k_measured = 8;
constexpr double k_apart_deg = 25.0;
constexpr double k_near_best = 0.95;
constexpr double k_eye_radii = 1.9;  // In the shell of best_views.h.
constexpr double k_low_spread = 0.15;
constexpr double k_least_preference = 0.5;
constexpr double k_least_certainty = 0.1;

// Depths of the faces, greater is nearer.
class DepthBuffer {
public:
    DepthBuffer(const Mesh& mesh, const glm::dvec3& direction)
        : mesh_(mesh), back_(glm::normalize(direction)), depths_(k_side * k_side, k_empty) {
        right_ = any_perpendicular(back_);
        up_ = glm::cross(back_, right_);
        scale_ = 0.5 * k_side / (k_margin * (mesh.radius() > 0.0 ? mesh.radius() : 1.0));
        points_.reserve(mesh.vertex_count());
        for (const glm::vec3& position : mesh.positions()) {
            const glm::dvec3 p = (glm::dvec3(position) - mesh.center()) * scale_;
            points_.emplace_back(glm::dot(p, right_) + 0.5 * k_side,
                                 glm::dot(p, up_) + 0.5 * k_side, glm::dot(p, back_));
        }
        for (const Triangle& t : mesh.triangles())
            draw(points_[index(t[0])], points_[index(t[1])], points_[index(t[2])]);
    }

    double visible_share() const {
        std::uint64_t visible = 0, total = 0;
        const auto count = [&](EdgeId edge) {
            const auto& [from, to] = mesh_.edge(edge).vertices;
            const glm::vec3 a = points_[index(from)], b = points_[index(to)];
            const int steps =
                1 + static_cast<int>(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)));
            for (int i = 0; i < steps; ++i) {
                ++total;
                visible += is_visible(glm::mix(a, b, (float(i) + 0.5f) / float(steps))) ? 1 : 0;
            }
        };
        for (const EdgeId edge :
             brute_force_silhouette(mesh_, HomogeneousPoint::direction(glm::vec3(back_))))
            count(edge);
        const Mesh::EdgeRange borders = mesh_.edges_of_class(EdgeClass::border);
        for (std::uint32_t edge = borders.first; edge < borders.last; ++edge) count(EdgeId{edge});
        return total > 0 ? double(visible) / double(total) : 1.0;
    }

    double area() const {
        const auto covered = std::ranges::count_if(depths_, [](float d) { return d != k_empty; });
        const double radius = 0.5 * k_side / k_margin;
        return double(covered) / (std::numbers::pi * radius * radius);
    }

private:
    static constexpr float k_empty = -std::numeric_limits<float>::max();

    // Pixels whose center is inside.
    void draw(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        const float twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (twice == 0.0f) return;
        const auto first = [](float low) {
            return std::max(0, static_cast<int>(std::ceil(low - 0.5f)));
        };
        const auto last = [](float high) {
            return std::min(k_side - 1, static_cast<int>(std::floor(high - 0.5f)));
        };
        const int x_end = last(std::max({a.x, b.x, c.x})), y_end = last(std::max({a.y, b.y, c.y}));
        for (int y = first(std::min({a.y, b.y, c.y})); y <= y_end; ++y)
            for (int x = first(std::min({a.x, b.x, c.x})); x <= x_end; ++x) {
                const float px = float(x) + 0.5f, py = float(y) + 0.5f;
                const float v = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) / twice;
                const float w = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / twice;
                if (v < 0.0f || w < 0.0f || v + w > 1.0f) continue;
                float& depth = depths_[std::size_t(y * k_side + x)];
                depth = std::max(depth, a.z + v * (b.z - a.z) + w * (c.z - a.z));
            }
    }

    bool is_visible(const glm::vec3& point) const {
        constexpr float k_bias = 0.75f;  // In pixels.
        const int x = static_cast<int>(point.x), y = static_cast<int>(point.y);
        for (int v = y - 1; v <= y + 1; ++v)
            for (int u = x - 1; u <= x + 1; ++u) {
                if (u < 0 || v < 0 || u >= k_side || v >= k_side) return true;
                if (point.z + k_bias >= depths_[std::size_t(v * k_side + u)]) return true;
            }
        return false;
    }

    const Mesh& mesh_;
    glm::dvec3 back_, right_, up_;
    double scale_ = 1.0;
    std::vector<glm::vec3> points_;  // In pixels, as are depths.
    std::vector<float> depths_;
};

// How much of the mesh's area is seen at a low angle, for each direction: 1 along a face, 0 at 30 degrees to it. The
// mean over all directions is a quarter for any mesh. The mesh has a plane.
std::vector<double> shares_at_low_angles(const Mesh& mesh, std::span<const glm::dvec3> directions) {
    constexpr float k_low_sin = 0.5f;
    std::vector<float> areas;  // By face, in squares of the radius.
    areas.reserve(mesh.face_count());
    double total = 0.0;
    for (const Triangle& t : mesh.triangles()) {
        const auto corner = [&](int i) { return glm::dvec3(mesh.positions()[index(t[i])]); };
        const glm::dvec3 across = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
        const double area = glm::length(across) / (mesh.radius() * mesh.radius());
        areas.push_back(static_cast<float>(area));
        total += area;
    }
    std::vector<double> shares(directions.size());
    tbb::parallel_for(std::size_t{0}, directions.size(), [&](std::size_t i) {
        const glm::vec3 towards(directions[i]);
        double low = 0.0;
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            const Plane& plane = mesh.planes()[f];
            const float sine =
                std::abs(plane.nx * towards.x + plane.ny * towards.y + plane.nz * towards.z);
            low += double{areas[f] * std::max(0.0f, 1.0f - sine / k_low_sin)};
        }
        shares[i] = low / total;
    });
    return shares;
}

// Whether the mesh is lower along `up` than this share of its lesser width.
bool is_flat(const Mesh& mesh, const glm::dvec3& up) {
    const auto [right, away] = ground_axes(up);
    const std::array<glm::dvec3, 3> axes{right, away, glm::normalize(up)};
    std::array<double, 3> low{}, high{};
    for (const glm::vec3& position : mesh.positions())
        for (std::size_t i = 0; i < 3; ++i) {
            const double height = glm::dot(glm::dvec3(position) - mesh.center(), axes[i]);
            low[i] = std::min(low[i], height);
            high[i] = std::max(high[i], height);
        }
    return high[2] - low[2] < k_flat_share * std::min(high[0] - low[0], high[1] - low[1]);
}

std::vector<glm::dvec3> candidate_directions(const Mesh& mesh, const glm::dvec3& up) {
    const auto [right, away] = ground_axes(up);
    const glm::dvec3 upward = glm::normalize(up);
    std::vector<glm::dvec3> directions;
    const double rise = is_flat(mesh, up) ? k_flat_rise_deg : 0.0;
    for (const double elevation : k_elevations_deg)
        for (int i = 0; i < k_around; ++i) {
            const double azimuth = glm::radians(360.0 * i / k_around);
            const glm::dvec3 level = std::sin(azimuth) * right - std::cos(azimuth) * away;
            directions.push_back(std::cos(glm::radians(elevation + rise)) * level +
                                 std::sin(glm::radians(elevation + rise)) * upward);
        }
    return directions;
}

// Three-quarter views of the front, or where none is known also of the other side.
double likeness(const glm::dvec3& direction, const glm::dvec3& up, const FrontSide& front) {
    if (front.certainty > 0.0) return three_quarter_likeness(direction, up, front.towards);
    const glm::dvec3 away = ground_axes(up).second;
    return std::max(three_quarter_likeness(direction, up, away),
                    three_quarter_likeness(direction, up, -away));
}

}  // namespace

std::vector<Shown> measure_shown(const Mesh& mesh, std::span<const glm::dvec3> directions,
                                 const std::stop_token& stop) {
    std::vector<Shown> shown(directions.size());
    tbb::parallel_for(std::size_t{0}, directions.size(), [&](std::size_t i) {
        LongCall{stop, {}}.checkpoint(0.0);
        const DepthBuffer buffer(mesh, directions[i]);
        shown[i] = {buffer.visible_share(), buffer.area()};
    });
    return shown;
}

glm::dvec3 choose_picture_direction(const Mesh& mesh, const glm::dvec3& up, const LongCall& call) {
    // Few points: the planes are summed one by one, which needs no clusters.
    const TangentialField field =
        make_view_field(mesh, {.tolerance = 0.0}, view_function(), call.stop);
    if (field.plane_count() == 0) return three_quarter_direction(up);
    const std::vector<glm::dvec3> directions = candidate_directions(mesh, up);
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& direction : directions) points.push_back(k_eye_radii * direction);
    std::vector<double> votes(points.size());
    field.values(points, votes, {call.stop, {}});
    const FrontSide front = find_front_side(mesh, up, call.stop);
    const double least = glm::mix(1.0, k_least_preference, front.certainty);
    const std::vector<double> low = shares_at_low_angles(mesh, directions);
    const double least_low = std::ranges::min(low);
    for (std::size_t i = 0; i < votes.size(); ++i) {
        const double away = std::max(0.0, (low[i] - least_low) / k_low_spread - 1.0);
        votes[i] *= glm::mix(least, 1.0, std::max(0.0, likeness(directions[i], up, front))) *
                    std::exp(-away * away);
    }
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return votes[i]; });
    std::vector<glm::dvec3> measured;
    std::vector<double> measured_votes;
    for (const std::size_t i : order) {
        const bool is_apart = std::ranges::all_of(measured, [&](const glm::dvec3& other) {
            return glm::dot(other, directions[i]) < std::cos(glm::radians(k_apart_deg));
        });
        if (!is_apart) continue;
        measured.push_back(directions[i]);
        measured_votes.push_back(votes[i]);
        if (measured.size() == k_measured) break;
    }
    call.checkpoint(0.3);
    const std::vector<Shown> shown = measure_shown(mesh, measured, call.stop);
    call.checkpoint(1.0);
    double max_score = 0.0;
    std::vector<double> scores;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        scores.push_back(measured_votes[i] * shown[i].visible_share * std::sqrt(shown[i].area));
        max_score = std::max(max_score, scores.back());
    }
    std::size_t best = 0;
    double best_likeness = -2.0;
    const bool knows_front = front.certainty > k_least_certainty;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (scores[i] < k_near_best * max_score) continue;
        const double this_likeness =
            knows_front ? likeness(measured[i], up, front) : scores[i] / max_score;
        if (this_likeness > best_likeness) {
            best = i;
            best_likeness = this_likeness;
        }
    }
    return measured[best];
}

}  // namespace rimline
