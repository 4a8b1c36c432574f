#include "tools/output/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace rimline::tools {

namespace {

// Viridis, by Smith and van der Walt (CC0), at multiples of 1/16.
constexpr std::array<std::array<std::uint8_t, 3>, 17> k_viridis = {{{68, 1, 84},
                                                                    {72, 24, 106},
                                                                    {71, 45, 123},
                                                                    {66, 64, 134},
                                                                    {59, 82, 139},
                                                                    {51, 99, 141},
                                                                    {44, 114, 142},
                                                                    {38, 130, 142},
                                                                    {33, 145, 140},
                                                                    {31, 160, 136},
                                                                    {40, 174, 128},
                                                                    {63, 188, 115},
                                                                    {94, 201, 98},
                                                                    {132, 212, 75},
                                                                    {173, 220, 48},
                                                                    {216, 226, 25},
                                                                    {253, 231, 37}}};

}  // namespace

Canvas::Canvas(std::uint32_t width, std::uint32_t height, Color background)
    : picture_{width, height, std::vector<std::uint8_t>(std::size_t{width} * height * 4)} {
    fill(0, 0, this->width(), this->height(), background);
}

void Canvas::set(int x, int y, Color color) {
    if (x < 0 || y < 0 || x >= width() || y >= height()) return;
    std::uint8_t* const pixel =
        &picture_.rgba[(static_cast<std::size_t>(y) * picture_.width + x) * 4];
    pixel[0] = color.red;
    pixel[1] = color.green;
    pixel[2] = color.blue;
    pixel[3] = 255;
}

void Canvas::fill(int left, int top, int width, int height, Color color) {
    for (int y = top; y < top + height; ++y)
        for (int x = left; x < left + width; ++x) set(x, y, color);
}

void Canvas::disc(double x, double y, double radius, Color color) {
    for (int j = static_cast<int>(y - radius); j <= static_cast<int>(y + radius) + 1; ++j)
        for (int i = static_cast<int>(x - radius); i <= static_cast<int>(x + radius) + 1; ++i)
            if (std::hypot(i + 0.5 - x, j + 0.5 - y) <= radius) set(i, j, color);
}

void Canvas::line(const glm::dvec2& from, const glm::dvec2& to, double width, Color color,
                  double opacity) {
    const std::array<glm::dvec2, 2> segment{from, to};
    lines({&segment, 1}, width, color, opacity);
}

void Canvas::lines(std::span<const std::array<glm::dvec2, 2>> segments, double width, Color color,
                   double opacity) {
    const double reach = 0.5 * width + 0.5;
    const auto first = [&](double a, double b) {
        return static_cast<int>(std::floor(std::max(0.0, std::min(a, b) - reach)));
    };
    const auto last = [&](double a, double b, int size) {
        return static_cast<int>(std::min(size - 1.0, std::max(a, b) + reach));
    };
    const auto number = [&](int x, int y) {
        return static_cast<std::size_t>(y) * picture_.width + static_cast<std::size_t>(x);
    };
    // How much of each pixel is covered; where segments meet, by that which covers most.
    std::unordered_map<std::size_t, double> covered;
    for (const auto& [from, to] : segments) {
        const glm::dvec2 along = to - from;
        const double squared = glm::dot(along, along);
        for (int y = first(from.y, to.y); y <= last(from.y, to.y, height()); ++y)
            for (int x = first(from.x, to.x); x <= last(from.x, to.x, this->width()); ++x) {
                const glm::dvec2 p = glm::dvec2(x + 0.5, y + 0.5) - from;
                const double at =
                    squared > 0.0 ? std::clamp(glm::dot(p, along) / squared, 0.0, 1.0) : 0.0;
                const double share = std::min(reach - glm::distance(p, at * along), 1.0);
                if (share <= 0.0) continue;
                double& greatest = covered[number(x, y)];
                greatest = std::max(greatest, share);
            }
    }
    for (const auto& [pixel, share] : covered)
        blend(static_cast<int>(pixel % picture_.width), static_cast<int>(pixel / picture_.width),
              color, opacity * share * std::min(1.0, width));
}

void Canvas::blend(int x, int y, Color color, double opacity) {
    if (opacity <= 0.0) return;
    std::uint8_t* const pixel =
        &picture_
             .rgba[(static_cast<std::size_t>(y) * picture_.width + static_cast<std::size_t>(x)) *
                   4];
    const std::array<std::uint8_t, 3> channels{color.red, color.green, color.blue};
    for (std::size_t c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>(
            std::lround((1.0 - opacity) * pixel[c] + opacity * channels[c]));
}

void Canvas::write(int left, int top, const std::string& text, Color color, int scale) {
    struct Vertex {
        float x, y, z;
        std::uint32_t color;
    };
    // The font is of rectangles of whole dots, fewer than 30 for a character.
    std::vector<Vertex> corners(4 * (30 * text.size() + 1));
    const int boxes =
        stb_easy_font_print(0.0f, 0.0f, const_cast<char*>(text.c_str()), nullptr, corners.data(),
                            static_cast<int>(corners.size() * sizeof(Vertex)));
    for (int box = 0; box < boxes; ++box) {
        const Vertex& low = corners[static_cast<std::size_t>(4 * box)];
        const Vertex& high = corners[static_cast<std::size_t>(4 * box + 2)];
        fill(left + static_cast<int>(low.x) * scale, top + static_cast<int>(low.y) * scale,
             static_cast<int>(high.x - low.x) * scale, static_cast<int>(high.y - low.y) * scale,
             color);
    }
}

int Canvas::text_width(const std::string& text, int scale) {
    return stb_easy_font_width(const_cast<char*>(text.c_str())) * scale;
}

Color viridis_color(double share) {
    const double at = share > 0.0 ? std::min(share, 1.0) * (k_viridis.size() - 1) : 0.0;
    const auto i = std::min(static_cast<std::size_t>(at), k_viridis.size() - 2);
    const double t = at - static_cast<double>(i);
    const auto channel = [&](std::size_t c) {
        return static_cast<std::uint8_t>(
            std::lround((1.0 - t) * k_viridis[i][c] + t * k_viridis[i + 1][c]));
    };
    return {channel(0), channel(1), channel(2)};
}

void write_picture(OutputFile& file, const Canvas& canvas) {
    const std::vector<std::byte> png = encode_png(canvas.picture());
    file.write({reinterpret_cast<const char*>(png.data()), png.size()});
    file.commit();
}

}  // namespace rimline::tools
