#include "tools/output/group_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/hough/hough_point.h"
#include "tools/output/plot_scale.h"

namespace rimline::tools {

namespace {

constexpr Color k_white{255, 255, 255};
constexpr Color k_black{25, 25, 25};

// The axes of the view: right, up and towards the viewer.
struct View {
    glm::dvec3 right, up, towards;
    View(const glm::dvec3& direction, const glm::dvec3& up_axis)
        : towards(glm::normalize(direction)) {
        const glm::dvec3 other =
            std::abs(towards.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
        const glm::dvec3 side = glm::cross(up_axis, towards);
        right = glm::normalize(glm::length(side) > 1e-6 ? side : glm::cross(other, towards));
        up = glm::cross(towards, right);
    }
    glm::dvec3 operator()(const glm::dvec3& p) const {
        return {glm::dot(right, p), glm::dot(up, p), glm::dot(towards, p)};
    }
};

Color shaded(Color color, double light) {
    const auto channel = [&](std::uint8_t c) {
        return static_cast<std::uint8_t>(std::clamp(c * light, 0.0, 255.0));
    };
    return {channel(color.red), channel(color.green), channel(color.blue)};
}

// A square of the canvas that shows [-extent, extent]², with a depth buffer.
class Panel {
public:
    Panel(Canvas& canvas, int left, int side, double extent)
        : canvas_(canvas),
          left_(left),
          side_(side),
          scale_(0.5 * side / extent),
          depth_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side),
                 -std::numeric_limits<double>::infinity()) {}

    void triangle(const std::array<glm::dvec3, 3>& corners, Color color) {
        std::array<glm::dvec3, 3> p;
        for (std::size_t i = 0; i < 3; ++i) p[i] = to_pixels(corners[i]);
        const double area = cross(p[0], p[1], p[2].x, p[2].y);
        if (area == 0.0) return;
        const auto [low_x, high_x] = std::minmax({p[0].x, p[1].x, p[2].x});
        const auto [low_y, high_y] = std::minmax({p[0].y, p[1].y, p[2].y});
        for (int y = first(low_y); y <= last(high_y); ++y)
            for (int x = first(low_x); x <= last(high_x); ++x) {
                const double a = cross(p[1], p[2], x + 0.5, y + 0.5) / area;
                const double b = cross(p[2], p[0], x + 0.5, y + 0.5) / area;
                const double c = 1.0 - a - b;
                if (std::min({a, b, c}) < 0.0) continue;
                set(x, y, a * p[0].z + b * p[1].z + c * p[2].z, color);
            }
    }

    // One of `count` dots, that are the larger the fewer they are: at least a pixel.
    void dot(const glm::dvec3& at, Color color, std::size_t count) {
        const glm::dvec3 p = to_pixels(at);
        if (std::abs(p.x) > 1e6 || std::abs(p.y) > 1e6) return;
        const int center_x = static_cast<int>(std::floor(p.x));
        const int center_y = static_cast<int>(std::floor(p.y));
        const double radius = side_ * std::min(0.007, 0.1 / std::sqrt(static_cast<double>(count)));
        const int reach = static_cast<int>(radius);
        for (int y = center_y - reach; y <= center_y + reach; ++y)
            for (int x = center_x - reach; x <= center_x + reach; ++x)
                if (x >= 0 && y >= 0 && x < side_ && y < side_ &&
                    std::hypot(x - center_x, y - center_y) <= std::max(0.5, radius))
                    set(x, y, p.z, color);
    }

    // Ignores the depth buffer.
    void marker(const glm::dvec3& at, Color color, const std::string& name) {
        const glm::dvec3 p = to_pixels(at);
        canvas_.disc(left_ + p.x, p.y, 0.018 * side_, k_black);
        canvas_.disc(left_ + p.x, p.y, 0.013 * side_, color);
        const int size = text_scale();
        canvas_.write(left_ + static_cast<int>(p.x + 0.018 * side_) + 2 * size,
                      static_cast<int>(p.y) - 4 * size, name, k_black, size);
    }

    // A title, the axes of the view, and a bar in the model's units, of which `radius` are one of the panel's.
    void annotate(const std::string& title, const View& view, double radius) {
        const int size = text_scale();
        const int gap = 8 * size;
        canvas_.write(left_ + gap, gap, title, k_black, size);
        draw_scale_bar(canvas_, left_ + gap, side_ - gap, side_ / 5, scale_ / radius, "", k_black,
                       size);
        draw_axis_cross(canvas_, left_ + side_ - 30 * size, side_ - 30 * size,
                        {view({1, 0, 0}), view({0, 1, 0}), view({0, 0, 1})}, 16.0 * size, k_black,
                        size);
    }

private:
    int text_scale() const { return std::max(1, side_ / 350); }
    glm::dvec3 to_pixels(const glm::dvec3& p) const {
        return {0.5 * side_ + scale_ * p.x, 0.5 * side_ - scale_ * p.y, p.z};
    }
    static double cross(const glm::dvec3& a, const glm::dvec3& b, double x, double y) {
        return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
    }
    int first(double low) const { return static_cast<int>(std::clamp(low - 0.5, 0.0, 1e6)); }
    int last(double high) const { return static_cast<int>(std::clamp(high, -1.0, side_ - 1.0)); }
    void set(int x, int y, double depth, Color color) {
        double& nearest = depth_[static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                                 static_cast<std::size_t>(x)];
        if (depth <= nearest) return;
        nearest = depth;
        canvas_.set(left_ + x, y, color);
    }

    Canvas& canvas_;
    int left_, side_;
    double scale_;
    std::vector<double> depth_;
};

}  // namespace

Color group_color(std::size_t group) {
    // The palette of Okabe and Ito, which people with color blindness can distinguish.
    constexpr std::array<Color, 8> k_colors = {{{230, 159, 0},
                                                {86, 180, 233},
                                                {0, 158, 115},
                                                {204, 121, 167},
                                                {240, 228, 66},
                                                {0, 114, 178},
                                                {213, 94, 0},
                                                {150, 150, 150}}};
    return k_colors[group % k_colors.size()];
}

Canvas draw_groups(const HoughOctree& octree, const glm::dvec3& towards_viewer,
                   const glm::dvec3& up, int side) {
    RIMLINE_CHECK(glm::length(towards_viewer) > 0.0 && side > 0);
    const Mesh& mesh = octree.mesh();
    const double radius = mesh.radius() > 0.0 ? mesh.radius() : 1.0;
    const View view(towards_viewer, up);
    const std::vector<std::uint32_t> groups = octree.face_groups();
    const auto to_unit = [&](const glm::dvec3& p) { return (p - mesh.center()) / radius; };

    // The left square shows all origins, the right one all Hough points.
    double model_extent = 1.05;
    for (const glm::dvec3& origin : octree.origins())
        model_extent = std::max(model_extent, 1.1 * glm::length(to_unit(origin)));
    std::vector<double> lengths;
    for (std::size_t f = 0; f < groups.size(); ++f)
        if (groups[f] != HoughOctree::k_no_group)
            lengths.push_back(
                glm::length(hough_point(mesh.planes()[f], octree.origins()[groups[f]]).position) /
                radius);
    std::ranges::sort(lengths);
    const double hough_extent =
        lengths.empty() || lengths.back() == 0.0 ? 1.0 : 1.05 * lengths.back();

    Canvas canvas(static_cast<std::uint32_t>(2 * side), static_cast<std::uint32_t>(side), k_white);
    Panel model(canvas, 0, side, model_extent);
    Panel hough(canvas, side, side, hough_extent);
    for (std::size_t f = 0; f < groups.size(); ++f) {
        const std::uint32_t group = groups[f];
        if (group == HoughOctree::k_no_group) continue;
        const Plane& plane = mesh.planes()[f];
        const glm::dvec3 normal = view({plane.nx, plane.ny, plane.nz});
        std::array<glm::dvec3, 3> corners;
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = view(to_unit(glm::dvec3(mesh.positions()[index(mesh.triangles()[f][i])])));
        // Open meshes show both sides of their faces.
        const double light =
            0.35 + 0.75 * std::max(0.0, std::abs(glm::dot(normal, glm::dvec3(0.3, 0.4, 0.87))));
        model.triangle(corners, shaded(group_color(group), light));
        const glm::dvec3 at = view(hough_point(plane, octree.origins()[group]).position / radius);
        const double nearness = 0.5 + 0.5 * at.z / hough_extent;
        hough.dot(at, shaded(group_color(group), 0.55 + 0.45 * nearness), lengths.size());
    }
    for (std::size_t i = 0; i < octree.origins().size(); ++i)
        model.marker(view(to_unit(octree.origins()[i])), group_color(i), std::to_string(i + 1));
    hough.marker(glm::dvec3(0.0), k_white, "0");
    model.annotate("faces, by their origin", view, radius);
    hough.annotate("Hough points, from their origin", view, radius);
    canvas.fill(side, 0, 1, side, {200, 200, 200});
    return canvas;
}

}  // namespace rimline::tools
