#include "silhouette/field/named_functions.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "silhouette/error.h"

namespace rimline {

namespace {

TangentialFunction constant(double value) { return TangentialFunction({{0.0, value}}); }

}  // namespace

TangentialFunction front_facing(double width) {
    RIMLINE_CHECK(width > 0.0);
    return TangentialFunction({{-0.5 * width, 0.0}, {0.5 * width, 1.0}});
}

TangentialFunction far_from_plane(double from, double to) {
    RIMLINE_CHECK(0.0 <= from && from < to);
    if (from == 0.0) return TangentialFunction({{-to, 1.0}, {0.0, 0.0}, {to, 1.0}});
    return TangentialFunction({{-to, 1.0}, {-from, 0.0}, {from, 0.0}, {to, 1.0}});
}

TangentialFunction near_plane(double from, double to) {
    return constant(1.0) + far_from_plane(from, to) * -1.0;
}

TangentialFunction on_silhouette(double width) { return near_plane(0.0, width); }

TangentialFunction off_silhouette(double width) { return far_from_plane(0.0, width); }

TangentialFunction far_in_front(double from, double to) {
    return constant(0.0).followed_by(far_from_plane(from, to), 0.0);
}

TangentialFunction near_in_front(double width, double from, double to) {
    RIMLINE_CHECK(0.5 * width <= from);
    return front_facing(width).followed_by(near_plane(from, to), from);
}

TangentialFunction small_viewing_angle(double reach) { return on_silhouette(0.5 * reach); }

TangentialFunction moderate_viewing_angle(double reach) {
    RIMLINE_CHECK(reach > 0.0);
    return TangentialFunction({{0.0, 0.0}, {0.5 * reach, 1.0}, {reach, 0.0}});
}

TangentialFunction large_viewing_angle(double reach) { return far_in_front(0.5 * reach, reach); }

TangentialFunction origin_function(double alpha) {
    const TangentialFunction rise = off_silhouette(0.5 * alpha);
    const TangentialFunction fall = near_plane(0.5 * alpha, alpha);
    return fall.followed_by(rise, -0.5 * alpha).followed_by(fall, 0.5 * alpha);
}

TangentialFunction view_function(double alpha, double plateau) {
    RIMLINE_CHECK(alpha > 0.0 && 0.5 * alpha < plateau);
    const TangentialFunction front = far_in_front(0.5 * alpha, plateau);
    return on_silhouette(0.5 * alpha) + front + front.reflected() * 0.25;
}

TangentialFunction light_function(double alpha) {
    RIMLINE_CHECK(alpha > 0.0);
    return TangentialFunction({{0.0, 0.0}, {0.5 * alpha, 1.0}, {alpha, 1.0 / 3.0}});
}

std::span<const NamedFunction> named_functions() {
    constexpr double k_inner = std::numbers::sqrt3;
    static const std::vector<NamedFunction> functions = {
        {"facing", "the plane's front (Figure 4.2)", front_facing(0.5), 0.0, 2.0},
        {"far", "far from the plane (4.2)", far_from_plane(0.5, 1.0), 0.0, 2.0},
        {"near", "near the plane (4.2)", near_plane(0.5, 1.0), 0.0, 2.0},
        {"silhouette", "where its edges may be on the silhouette (4.2)", on_silhouette(0.5), 0.0,
         2.0},
        {"off-silhouette", "where its edges are hardly on the silhouette", off_silhouette(0.5), 0.0,
         2.0},
        {"far-front", "far in front (4.3)", far_in_front(0.5, 1.0), 0.0, 2.0},
        {"near-front", "near but in front (4.3)", near_in_front(0.5, 0.5, 1.0), 0.0, 2.0},
        {"angle-small", "seen at a small angle (4.4)", small_viewing_angle(2.0), k_inner, 2.0},
        {"angle-moderate", "seen at about π/6 (4.4)", moderate_viewing_angle(2.0), k_inner, 2.0},
        {"angle-large", "seen at a large angle (4.4)", large_viewing_angle(2.0), k_inner, 2.0},
        {"origins", "origins of Hough spaces (4.8)", origin_function(), 0.0, 3.0},
        {"views", "viewpoints (4.10)", view_function(), k_inner, 2.0},
        {"views-far", "viewpoints, the plateau reached at 2 alpha", view_function(1.0, 2.0),
         k_inner, 2.0},
        {"light", "a light (4.18)", light_function(), k_inner, 2.0},
    };
    return functions;
}

const NamedFunction* find_named_function(std::string_view name) {
    const auto all = named_functions();
    const auto it = std::ranges::find(all, name, &NamedFunction::name);
    return it == all.end() ? nullptr : &*it;
}

}  // namespace rimline
