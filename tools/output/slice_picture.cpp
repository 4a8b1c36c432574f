#include "tools/output/slice_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <string>
#include <vector>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/mesh/brute_force.h"
#include "tools/output/plot_scale.h"

namespace rimline::tools {

namespace {

constexpr Color k_slice_paper{255, 255, 255};
constexpr Color k_slice_ink{30, 30, 30};
constexpr Color k_slice_outside{232, 232, 232};

// The round numbers along an axis.
struct AxisNumbers {
    std::vector<double> values;
    std::vector<std::string> texts;

    AxisNumbers(double low, double high) {
        if (!(high - low > 1e-12 * std::max(std::abs(low), std::abs(high)))) {
            values = {low};
            texts = {short_number(low, std::abs(low) / 100.0)};
            return;
        }
        values = round_ticks(low, high, 6);
        for (const double value : values)
            texts.push_back(short_number(value, round_step(high - low, 6)));
    }
    int width(int scale) const {
        int widest = 0;
        for (const std::string& text : texts)
            widest = std::max(widest, Canvas::text_width(text, scale));
        return widest;
    }
};

struct SliceNumbers {
    AxisNumbers right, up, bar;

    static AxisNumbers along(const SlicePicture& slice, int axis) {
        const double reach = slice.grid.extent() * slice.frame.radius;
        return {slice.frame.center[axis] - reach, slice.frame.center[axis] + reach};
    }
    SliceNumbers(const SlicePicture& slice, double least, double greatest)
        : right(along(slice, slice.grid.right())),
          up(along(slice, slice.grid.up())),
          bar(least, greatest) {}
};

// The places of a plot's parts, in pixels. Numbers have room, however long.
struct SliceLayout {
    int scale, left, top, side, right_margin;

    SliceLayout(int resolution, const SliceNumbers& numbers)
        : scale(std::max(1, resolution / 256)),
          left(std::max({44 * scale, numbers.up.width(scale) + 8 * scale,
                         numbers.right.width(scale) / 2 + scale})),
          top(20 * scale),
          side(resolution),
          right_margin(std::max(60 * scale, numbers.bar.width(scale) + 8 * scale)) {}
    int bar_left() const { return left + side + 14 * scale; }
    int bar_width() const { return 14 * scale; }
    int width() const { return bar_left() + bar_width() + right_margin; }
    int height() const { return top + side + 26 * scale; }
};

// The plot of a slice: model coordinates to pixels.
class SlicePlot {
public:
    SlicePlot(Canvas& canvas, const SlicePicture& slice, const SliceNumbers& numbers,
              const SliceLayout& layout)
        : canvas_(canvas), slice_(slice), numbers_(numbers), layout_(layout) {}

    double pixels_per_unit() const {
        return layout_.side / (2.0 * slice_.grid.extent() * slice_.frame.radius);
    }
    glm::dvec2 to_pixels(const glm::dvec3& p) const {
        const glm::dvec3 from_center = pixels_per_unit() * (p - slice_.frame.center);
        return {layout_.left + 0.5 * layout_.side + from_center[slice_.grid.right()],
                layout_.top + 0.5 * layout_.side - from_center[slice_.grid.up()]};
    }

    void draw_values(double least, double range) {
        canvas_.fill(layout_.left, layout_.top, layout_.side, layout_.side, k_slice_outside);
        for (std::size_t i = 0; i < slice_.values.size(); ++i) {
            const int square = static_cast<int>(slice_.grid.squares()[i]);
            canvas_.set(layout_.left + square % layout_.side, layout_.top + square / layout_.side,
                        viridis_color((slice_.values[i] - least) / range));
        }
    }

    void draw_color_bar(double least, double greatest) {
        const int scale = layout_.scale;
        const int left = layout_.bar_left();
        const int bar = layout_.bar_width();
        for (int row = 0; row < layout_.side; ++row)
            canvas_.fill(left, layout_.top + row, bar, 1,
                         viridis_color(1.0 - (row + 0.5) / layout_.side));
        canvas_.write(left, layout_.top - 12 * scale, slice_.unit, k_slice_ink, scale);
        const double range = greatest > least ? greatest - least : 1.0;
        int free_above = layout_.top + layout_.side + line_height();
        for (std::size_t i = 0; i < numbers_.bar.values.size(); ++i) {
            const double share = (numbers_.bar.values[i] - least) / range;
            const int y =
                layout_.top + static_cast<int>(std::lround((1.0 - share) * (layout_.side - scale)));
            canvas_.fill(left + bar, y, 3 * scale, scale, k_slice_ink);
            if (y > free_above) continue;
            canvas_.write(left + bar + 5 * scale, y - 3 * scale, numbers_.bar.texts[i], k_slice_ink,
                          scale);
            free_above = y - line_height();
        }
    }

    void draw_axes() {
        const int scale = layout_.scale;
        const int bottom = layout_.top + layout_.side;
        const auto place_of = [&](int axis, double value) {
            glm::dvec3 at = slice_.frame.center;
            at[axis] = value;
            return to_pixels(at);
        };
        // Numbers that would lie over the one before, or over the name at the axis's end, are left out.
        int free_right = 0;
        for (std::size_t i = 0; i < numbers_.right.values.size(); ++i) {
            const std::string& number = numbers_.right.texts[i];
            const int width = Canvas::text_width(number, scale);
            const int x =
                static_cast<int>(place_of(slice_.grid.right(), numbers_.right.values[i]).x);
            canvas_.fill(x, bottom, scale, 3 * scale, k_slice_ink);
            if (x - width / 2 < free_right ||
                x + width / 2 >= layout_.left + layout_.side - 8 * scale)
                continue;
            canvas_.write(x - width / 2, bottom + 6 * scale, number, k_slice_ink, scale);
            free_right = x + width / 2 + 6 * scale;
        }
        int free_above = bottom + line_height();
        for (std::size_t i = 0; i < numbers_.up.values.size(); ++i) {
            const std::string& number = numbers_.up.texts[i];
            const int y = static_cast<int>(place_of(slice_.grid.up(), numbers_.up.values[i]).y);
            canvas_.fill(layout_.left - 3 * scale, y, 3 * scale, scale, k_slice_ink);
            if (y > free_above || y <= layout_.top + 12 * scale) continue;
            canvas_.write(layout_.left - 5 * scale - Canvas::text_width(number, scale),
                          y - 3 * scale, number, k_slice_ink, scale);
            free_above = y - line_height();
        }
        canvas_.write(layout_.left + layout_.side - 5 * scale, bottom + 6 * scale,
                      axis_name(slice_.grid.right()), k_slice_ink, scale);
        canvas_.write(layout_.left - 11 * scale, layout_.top, axis_name(slice_.grid.up()),
                      k_slice_ink, scale);
        canvas_.fill(layout_.left - scale, layout_.top, scale, layout_.side + scale, k_slice_ink);
        canvas_.fill(layout_.left - scale, bottom, layout_.side + scale, scale, k_slice_ink);
        // Its number has no room in smaller plots.
        if (layout_.side < 64 * scale) return;
        draw_scale_bar(canvas_, layout_.left + 5 * scale, bottom - 5 * scale, layout_.side / 5,
                       pixels_per_unit(), "", k_slice_ink, scale);
    }

    // The lines that a viewer on the axis sees.
    void draw_model_lines(const LongCall& call) {
        if (!slice_.mesh.is_welded()) return;
        glm::dvec3 right(0.0), up(0.0);
        right[slice_.grid.right()] = 1.0;
        up[slice_.grid.up()] = 1.0;
        const glm::dvec3 eye =
            slice_.frame.center + 3.0 * slice_.frame.radius * glm::cross(right, up);
        const LineView view = LineView::orthographic(eye, slice_.frame.center, up);
        const LineSurface surface(slice_.mesh, LineSurface::Contacts::found, call);
        LineDrawer drawer(surface);
        LineOptions options;
        const double pixel = 1.0 / pixels_per_unit();
        options.min_length = 4.0 * layout_.scale * pixel;
        options.gap = pixel;
        options.stubble = 4.0 * layout_.scale * pixel;
        const LineDrawing& lines =
            drawer.draw(view, brute_force_silhouette(slice_.mesh, view.point()), options, call);
        const glm::dvec2 center = to_pixels(slice_.frame.center);
        const auto place = [&](const LinePoint& p) {
            return center + pixels_per_unit() * glm::dvec2(p.position.x, -p.position.y);
        };
        std::vector<std::array<glm::dvec2, 2>> segments;
        for (const LineStroke& stroke : lines.strokes)
            for (const StrokePart& part : lines.parts_of(stroke)) {
                const auto points = lines.points_of(part);
                for (std::size_t i = 0; i + 1 < points.size(); ++i)
                    segments.push_back({place(points[i]), place(points[i + 1])});
            }
        draw_with_halo(segments, 0.8 * layout_.scale, 0.75);
    }

    void draw_cut() {
        const double value =
            slice_.frame.center[slice_.grid.axis()] + slice_.grid.value() * slice_.frame.radius;
        std::vector<std::array<glm::dvec2, 2>> segments;
        for (const auto& [from, to] : cut_segments(slice_.mesh, slice_.grid.axis(), value))
            segments.push_back({to_pixels(from), to_pixels(to)});
        draw_with_halo(segments, 1.2 * layout_.scale, 1.0);
    }

    // The title, and the greatest value: marked in the plot, and named beside the title. Narrow plots leave out the
    // words that have no room.
    void write_title_and_greatest() {
        const auto best = static_cast<std::size_t>(std::ranges::max_element(slice_.values) -
                                                   slice_.values.begin());
        const glm::dvec2 p = to_pixels(slice_.frame.to_model(slice_.grid.points()[best]));
        draw_mark(p);
        const int scale = layout_.scale;
        const int top = layout_.top - 12 * scale;
        const int gap = 8 * scale;
        const int title_end = layout_.left + Canvas::text_width(slice_.title, scale);
        if (title_end + gap > layout_.bar_left()) return;
        canvas_.write(layout_.left, top, slice_.title, k_slice_ink, scale);
        const std::string words = "greatest";
        const int left = layout_.left + layout_.side - Canvas::text_width(words, scale);
        if (title_end + 2 * gap > left - gap) return;
        draw_mark({static_cast<double>(left - gap), layout_.top - 8.5 * scale});
        canvas_.write(left, top, words, k_slice_ink, scale);
    }

private:
    int line_height() const { return Canvas::text_height(layout_.scale) + 3 * layout_.scale; }
    static std::string axis_name(int axis) { return std::string(1, static_cast<char>('x' + axis)); }

    // Lines are dark, and so are low values.
    void draw_with_halo(std::span<const std::array<glm::dvec2, 2>> segments, double width,
                        double opacity) {
        canvas_.lines(segments, width + 1.5 * layout_.scale, k_slice_paper, 0.25);
        canvas_.lines(segments, width, k_slice_ink, opacity);
    }

    void draw_mark(const glm::dvec2& at) {
        canvas_.disc(at.x, at.y, 3.5 * layout_.scale, k_slice_ink);
        canvas_.disc(at.x, at.y, 2.5 * layout_.scale, k_slice_paper);
    }

    Canvas& canvas_;
    const SlicePicture& slice_;
    const SliceNumbers& numbers_;
    const SliceLayout& layout_;
};

}  // namespace

SliceGrid::SliceGrid(int axis, double value, double min_radius, double extent, int side)
    : axis_(axis), side_(side), value_(value), extent_(extent) {
    RIMLINE_CHECK(axis >= 0 && axis < 3 && side > 0 && extent > 0.0);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const glm::dvec3 p = center(row, column);
            const double radius = glm::length(p);
            if (radius < min_radius || radius > extent) continue;
            squares_.push_back(static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(side) +
                               static_cast<std::uint32_t>(column));
            points_.push_back(p);
        }
}

glm::dvec3 SliceGrid::center(int row, int column) const noexcept {
    glm::dvec3 p(0.0);
    p[axis_] = value_;
    p[right()] = extent_ * (2.0 * (column + 0.5) / side_ - 1.0);
    p[up()] = extent_ * (1.0 - 2.0 * (row + 0.5) / side_);
    return p;
}

std::vector<std::array<glm::dvec3, 2>> cut_segments(const Mesh& mesh, int axis, double value) {
    std::vector<std::array<glm::dvec3, 2>> segments;
    for (const Triangle& triangle : mesh.triangles()) {
        std::array<glm::dvec3, 3> p;
        std::array<bool, 3> is_above;
        for (std::size_t i = 0; i < 3; ++i) {
            p[i] = glm::dvec3(mesh.positions()[index(triangle[i])]);
            is_above[i] = p[i][axis] >= value;
        }
        std::array<glm::dvec3, 2> segment;
        std::size_t ends = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            if (is_above[i] == is_above[j]) continue;
            const double share = (value - p[i][axis]) / (p[j][axis] - p[i][axis]);
            segment[ends++] = p[i] + share * (p[j] - p[i]);
        }
        if (ends == 2) segments.push_back(segment);
    }
    return segments;
}

Canvas draw_slice(const SlicePicture& slice, const LongCall& call) {
    RIMLINE_CHECK(!slice.values.empty() && slice.values.size() == slice.grid.points().size());
    const auto [least, greatest] = std::ranges::minmax(slice.values);
    const SliceNumbers numbers(slice, least, greatest);
    const SliceLayout layout(slice.grid.side(), numbers);
    Canvas canvas(static_cast<std::uint32_t>(layout.width()),
                  static_cast<std::uint32_t>(layout.height()), k_slice_paper);
    SlicePlot plot(canvas, slice, numbers, layout);
    plot.draw_values(least, greatest > least ? greatest - least : 1.0);
    plot.draw_model_lines(call);
    plot.draw_cut();
    plot.draw_axes();
    plot.draw_color_bar(least, greatest);
    plot.write_title_and_greatest();
    return canvas;
}

}  // namespace rimline::tools
