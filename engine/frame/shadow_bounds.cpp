#include "engine/frame/shadow_bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <span>
#include <utility>

#include "engine/frame/scene_data.h"
#include "engine/frame/silhouette_points.h"
#include "engine/shader_rounding.h"
#include "silhouette/mesh/rounded_to_float.h"

namespace rimline {

namespace {

// Of k_shader_rounding, without its margin.
constexpr double k_rounding_per_slack = 1.0 / 16.0;
// Of the arithmetic here, relative to the size of everything.
constexpr double k_tolerance = 0x1p-40;
// Rasterizers round positions to 1/16 of a pixel or less, and a pixel belongs to a triangle by its samples.
constexpr double k_slack_px = 1.5;
// Of the interpolation of depths: of a surface that reaches to the near plane, whose depth is 1, and of any other.
constexpr double k_absolute_depth_slack = 4e-6;
constexpr double k_relative_depth_slack = 1e-3;

// The corners at both ends of the edges of a box. Bit a of a corner's number: it is high along axis a.
constexpr std::array<std::pair<unsigned, unsigned>, 12> k_edges{{{0, 1},
                                                                 {2, 3},
                                                                 {4, 5},
                                                                 {6, 7},
                                                                 {0, 2},
                                                                 {1, 3},
                                                                 {4, 6},
                                                                 {5, 7},
                                                                 {0, 4},
                                                                 {1, 5},
                                                                 {2, 6},
                                                                 {3, 7}}};

double axis_of(const glm::dvec3& v, int axis) { return v[axis]; }

glm::dvec3 unit_axis(int axis) {
    glm::dvec3 unit(0.0);
    unit[axis] = 1.0;
    return unit;
}

// The part of a line that several half spaces leave: from `first` to `last`.
struct Piece {
    double first, last;

    // Keeps where start + t * step <= 0.
    void clip(double start, double step) {
        if (step > 0.0) {
            last = std::min(last, -start / step);
        } else if (step < 0.0) {
            first = std::max(first, -start / step);
        } else if (start > 0.0) {
            last = -std::numeric_limits<double>::infinity();
        }
    }
    bool is_empty() const { return !(first <= last); }
};

// The points of space where normal . x <= offset.
struct HalfSpace {
    glm::dvec3 normal;
    double offset;
};

// S of the header, in the camera's axes.
class ShadowSpace {
public:
    // The box and the light are in the box's own axes, relative to the camera. `light` is a point or, with w = 0, a
    // direction.
    ShadowSpace(const glm::dmat3& axes, const glm::dvec3& low, const glm::dvec3& high,
                const glm::dvec4& light, double tolerance)
        : tolerance_(tolerance) {
        const glm::dvec3 towards(light);
        for (unsigned corner = 0; corner < 8; ++corner) {
            const glm::dvec3 point((corner & 1u) != 0 ? high.x : low.x,
                                   (corner & 2u) != 0 ? high.y : low.y,
                                   (corner & 4u) != 0 ? high.z : low.z);
            corners_[corner] = axes * point;
            rays_[corner] = axes * (point * light.w - towards);
        }
        // By axis and side: whether the light sees the face.
        std::array<std::array<bool, 2>, 3> sees{};
        for (int axis = 0; axis < 3; ++axis)
            for (const int side : {0, 1}) {
                const double sign = side == 0 ? -1.0 : 1.0;
                const double offset = sign * axis_of(side == 0 ? low : high, axis);
                bool& seen = sees[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)];
                seen = sign * axis_of(towards, axis) > offset * light.w;
                is_everything_ = is_everything_ && !seen;
                if (seen) add(axes * (sign * unit_axis(axis)), offset);
            }
        const glm::dvec3 middle = 0.5 * (low + high);
        for (int along = 0; along < 3; ++along)
            for (const unsigned sides : {0u, 1u, 2u, 3u}) {
                const int a = (along + 1) % 3;
                const int b = (along + 2) % 3;
                if (sees[static_cast<std::size_t>(a)][sides & 1u] ==
                    sees[static_cast<std::size_t>(b)][sides >> 1u])
                    continue;
                glm::dvec3 start = low;
                start[a] = (sides & 1u) != 0 ? high[a] : low[a];
                start[b] = sides >> 1u != 0 ? high[b] : low[b];
                glm::dvec3 normal = glm::cross(unit_axis(along), towards - start * light.w);
                const double length = glm::length(normal);
                if (!(length > 0.0)) continue;
                normal /= glm::dot(normal, middle - start) > 0.0 ? -length : length;
                add(axes * normal, glm::dot(normal, start));
            }
    }

    bool is_everything() const { return is_everything_; }
    const std::array<glm::dvec3, 8>& corners() const { return corners_; }
    /// From each corner away from the light, without end.
    const std::array<glm::dvec3, 8>& rays() const { return rays_; }

    /// Whether all of the points lie beyond one of its planes.
    bool excludes(const std::array<glm::dvec3, 8>& points) const {
        return std::any_of(planes_.begin(), planes_.begin() + count_, [&](const HalfSpace& plane) {
            return std::ranges::all_of(points, [&](const glm::dvec3& point) {
                return glm::dot(plane.normal, point) > plane.offset;
            });
        });
    }

    Piece clip(const glm::dvec3& start, const glm::dvec3& step, Piece piece) const {
        for (std::size_t p = 0; p < count_; ++p)
            piece.clip(glm::dot(planes_[p].normal, start) - planes_[p].offset,
                       glm::dot(planes_[p].normal, step));
        return piece;
    }

private:
    void add(const glm::dvec3& normal, double offset) {
        planes_[count_++] = {normal, offset + tolerance_};
    }

    double tolerance_;
    std::array<glm::dvec3, 8> corners_{}, rays_{};
    std::array<HalfSpace, 9> planes_{};  // At most three faces and six edges.
    std::size_t count_ = 0;
    bool is_everything_ = true;
};

ShadowReach whole_picture(const FrameView& view) {
    return {.width = view.size.width, .height = view.size.height};
}

// Collects what projected points lie between.
class PictureReach {
public:
    // `slack` is the shaders' rounding with its margin.
    PictureReach(const FrameView& view, double slack)
        : view_(view),
          picture_(view.size.width, view.size.height),
          plane_(view.projection.is_orthographic() ? 0.0 : 0.5 * view.projection.z[1]),
          is_uncertain_(slack * k_rounding_per_slack > plane_) {}

    /// Points of a convex set, homogeneous: that includes all of its vertices. Of that, what is in `screen`.
    void include(std::span<const glm::dvec4> points, const ScreenBox& screen) {
        bool is_behind = false;
        Part part;
        for (const glm::dvec4& point : points) {
            if (distance_before(point) > 0.0)
                add(part, point);
            else
                is_behind = true;
        }
        if (part.is_empty()) return;
        if (is_behind) {
            if (is_uncertain_) {
                is_everywhere_ = true;
                return;
            }
            // Where its edges, and more lines between its points, meet the plane.
            for (const glm::dvec4& point : points) {
                const double before = distance_before(point);
                if (!(before > 0.0)) continue;
                for (const glm::dvec4& other : points)
                    if (const double behind = distance_before(other); !(behind > 0.0))
                        add(part, point + before / (before - behind) * (other - point));
            }
        }
        const ScreenBox seen{glm::max(part.box.low, screen.low) - k_slack_px,
                             glm::min(part.box.high, screen.high) + k_slack_px};
        if (!(seen.low.x < seen.high.x && seen.low.y < seen.high.y)) return;
        all_.box.join(seen);
        all_.near = std::max(all_.near, part.near);
        all_.far = std::min(all_.far, part.far);
    }

    ShadowReach reach() const {
        if (is_everywhere_) return whole_picture(view_);
        const glm::dvec2 low = glm::max(glm::floor(all_.box.low), glm::dvec2(0.0));
        const glm::dvec2 high = glm::min(glm::ceil(all_.box.high), picture_);
        if (!(low.x < high.x && low.y < high.y)) return {};
        const auto slack = [](double depth) {
            return k_absolute_depth_slack + k_relative_depth_slack * std::abs(depth);
        };
        return {
            .x = static_cast<std::int32_t>(low.x),
            .y = static_cast<std::int32_t>(low.y),
            .width = static_cast<std::uint32_t>(high.x - low.x),
            .height = static_cast<std::uint32_t>(high.y - low.y),
            .min_depth = static_cast<float>(std::clamp(all_.far - slack(all_.far), 0.0, 1.0)),
            .max_depth = static_cast<float>(std::clamp(all_.near + slack(all_.near), 0.0, 1.0))};
    }

private:
    // Of the picture, and of the depths in it.
    struct Part {
        ScreenBox box{};
        double near = -std::numeric_limits<double>::infinity();
        double far = std::numeric_limits<double>::infinity();

        bool is_empty() const { return !(far <= near); }
    };

    // From a plane at half of the near plane's distance, so that rounding does not matter. Orthographic: everything
    // is before it.
    double distance_before(const glm::dvec4& point) const {
        const Projection& projection = view_.projection;
        return projection.is_orthographic() ? 1.0 : projection.w[0] * point.z - plane_ * point.w;
    }

    void add(Part& part, const glm::dvec4& point) const {
        const Projection& projection = view_.projection;
        const double z = projection.z[0] * point.z + projection.z[1] * point.w;
        const double w = projection.w[0] * point.z + projection.w[1] * point.w;
        const glm::dvec2 ndc = projection.scale * glm::dvec2(point) / w + projection.shift;
        const glm::dvec2 place = (0.5 * ndc + 0.5) * picture_;
        part.box.join({place, place});
        part.near = std::max(part.near, z / w);
        part.far = std::min(part.far, z / w);
    }

    const FrameView& view_;
    glm::dvec2 picture_;
    double plane_;
    bool is_uncertain_;
    bool is_everywhere_ = false;
    Part all_;
};

// The vertices of S, where it is not limited by surfaces: each corner, and the end of its ray, at infinity where
// `extrusion` is 0.
std::array<glm::dvec4, 16> vertices_of(const ShadowSpace& space, double extrusion) {
    std::array<glm::dvec4, 16> points;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const glm::dvec3& ray = space.rays()[corner];
        points[corner] = {space.corners()[corner], 1.0};
        points[8 + corner] = extrusion == 0.0
                                 ? glm::dvec4(ray, 0.0)
                                 : glm::dvec4(space.corners()[corner] + extrusion * ray, 1.0);
    }
    return points;
}

}  // namespace

glm::dvec3 ShadowBounds::Box::corner(unsigned number) const {
    return axes * glm::dvec3((number & 1u) != 0 ? high.x : low.x,
                             (number & 2u) != 0 ? high.y : low.y,
                             (number & 4u) != 0 ? high.z : low.z);
}

ShadowBounds::Box ShadowBounds::box_of(std::size_t instance) const {
    const SceneInstance& placed = view_.scene.instances[instance];
    const CasterBox box = caster_box(placed);
    // As instance_data() has them.
    const glm::dvec3 camera = rounded_to_float(point_in_object(placed, view_.scene.camera.eye));
    const glm::dmat3 axes = rounded_to_float(view_.eye_from_world * placed.rotation);
    const glm::dvec3 low = placed.scale * (box.low - camera);
    const glm::dvec3 high = placed.scale * (box.high - camera);
    return {axes, low, high, glm::length(glm::max(glm::abs(low), glm::abs(high)))};
}

ScreenBox ShadowBounds::screen_box_of(std::size_t instance) const {
    const std::optional<ScreenBox>& screen = view_.instances[instance].screen;
    return screen ? *screen : ScreenBox::everywhere();
}

void ShadowBounds::add_receiver(const Box& box, const ScreenBox& screen) {
    Receiver receiver{box, screen, {}};
    const double slack = k_shader_rounding * box.reach;
    receiver.box.low -= slack;
    receiver.box.high += slack;
    for (unsigned corner = 0; corner < 8; ++corner)
        receiver.corners[corner] = receiver.box.corner(corner);
    const Projection& projection = view_.projection;
    const double near = projection.z[1];
    if (!projection.is_orthographic() &&
        std::ranges::all_of(receiver.corners, [&](const glm::dvec3& corner) {
            return projection.w[0] * corner.z <= near;
        }))
        return;
    receivers_.push_back(receiver);
}

ShadowBounds::ShadowBounds(const FrameView& view, bool has_backdrop)
    : view_(view), has_backdrop_(has_backdrop) {
    if (has_backdrop) return;
    const std::size_t count = view.scene.instances.size();
    if (count <= k_max_receivers) {
        for (std::size_t i = 0; i < count; ++i) add_receiver(box_of(i), screen_box_of(i));
        return;
    }
    const std::size_t joined = (count + k_max_receivers - 1) / k_max_receivers;
    for (std::size_t first = 0; first < count; first += joined) {
        Box all{glm::dmat3(1.0), glm::dvec3(std::numeric_limits<double>::infinity()),
                glm::dvec3(-std::numeric_limits<double>::infinity()), 0.0};
        ScreenBox screen;
        for (std::size_t i = first; i < std::min(first + joined, count); ++i) {
            screen.join(screen_box_of(i));
            const Box box = box_of(i);
            for (unsigned corner = 0; corner < 8; ++corner) {
                all.low = glm::min(all.low, box.corner(corner));
                all.high = glm::max(all.high, box.corner(corner));
            }
            all.reach = std::max(all.reach, box.reach);
        }
        add_receiver(all, screen);
    }
}

ShadowReach ShadowBounds::reach_of(std::size_t instance, std::size_t light, float extrusion) const {
    const Box caster = box_of(instance);
    const HomogeneousPoint& point = view_.instances[instance].lights[light].point;
    const SceneInstance& placed = view_.scene.instances[instance];
    const glm::dvec3 camera = rounded_to_float(point_in_object(placed, view_.scene.camera.eye));
    const glm::dvec4 from =
        point.is_direction() ? glm::dvec4(glm::dvec3(point.xyz()), 0.0)
                             : glm::dvec4(placed.scale * (glm::dvec3(point.xyz()) - camera), 1.0);
    // A direction's is a length in the instance's coordinates.
    const double length = (point.is_direction() ? placed.scale : 1.0) * double{extrusion};
    // Volumes are wrong by their vertices' error times their length over the distance from the light: growing the
    // box widens them alike. Their length is at most the reach of the receiver and of the caster together.
    double all_reach = caster.reach;
    for (const Receiver& receiver : receivers_) all_reach = std::max(all_reach, receiver.box.reach);
    if (!point.is_direction()) all_reach = std::max(all_reach, glm::length(glm::dvec3(from)));
    const double slack = 4.0 * k_shader_rounding * all_reach;
    const ShadowSpace space(caster.axes, caster.low - slack, caster.high + slack, from,
                            k_tolerance * all_reach);
    if (space.is_everything() && has_backdrop_) return whole_picture(view_);
    PictureReach reach(view_, slack);
    if (has_backdrop_) {
        reach.include(vertices_of(space, length), ScreenBox::everywhere());
        return reach.reach();
    }
    const double tolerance = k_tolerance * all_reach;
    const auto clip_by = [&](const Box& box, const glm::dvec3& from_eye, const glm::dvec3& by_eye,
                             Piece piece) {
        const glm::dmat3 box_from_eye = glm::transpose(box.axes);
        const glm::dvec3 start = box_from_eye * from_eye;
        const glm::dvec3 step = box_from_eye * by_eye;
        for (int axis = 0; axis < 3; ++axis) {
            piece.clip(start[axis] - box.high[axis] - tolerance, step[axis]);
            piece.clip(box.low[axis] - tolerance - start[axis], -step[axis]);
        }
        return piece;
    };
    std::vector<glm::dvec4> points;
    const auto add_ends = [&](const glm::dvec3& start, const glm::dvec3& step, const Piece& piece) {
        if (piece.is_empty()) return;
        points.emplace_back(start + piece.first * step, 1.0);
        points.emplace_back(start + piece.last * step, 1.0);
    };
    for (const Receiver& receiver : receivers_) {
        if (space.excludes(receiver.corners)) continue;
        points.clear();
        for (const auto& [a, b] : k_edges) {
            const glm::dvec3 step = receiver.corners[b] - receiver.corners[a];
            add_ends(receiver.corners[a], step, space.clip(receiver.corners[a], step, {0.0, 1.0}));
        }
        if (!space.is_everything()) {
            for (const auto& [a, b] : k_edges) {
                const glm::dvec3 step = space.corners()[b] - space.corners()[a];
                add_ends(space.corners()[a], step,
                         clip_by(receiver.box, space.corners()[a], step, {0.0, 1.0}));
            }
            for (std::size_t corner = 0; corner < 8; ++corner)
                add_ends(space.corners()[corner], space.rays()[corner],
                         clip_by(receiver.box, space.corners()[corner], space.rays()[corner],
                                 {0.0, std::numeric_limits<double>::infinity()}));
        }
        reach.include(points, receiver.screen);
    }
    return reach.reach();
}

}  // namespace rimline
