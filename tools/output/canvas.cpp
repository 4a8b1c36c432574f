#include "tools/output/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace rimline::tools {

namespace {

// Rows of five dots from the top. The leftmost dot is the highest bit.
struct Glyph {
    char name;
    std::array<std::uint8_t, 7> rows;
};
constexpr std::array k_glyphs = {
    Glyph{'0', {0x0e, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0e}},
    Glyph{'1', {0x04, 0x0c, 0x04, 0x04, 0x04, 0x04, 0x0e}},
    Glyph{'2', {0x0e, 0x11, 0x01, 0x02, 0x04, 0x08, 0x1f}},
    Glyph{'3', {0x1f, 0x02, 0x04, 0x02, 0x01, 0x11, 0x0e}},
    Glyph{'4', {0x02, 0x06, 0x0a, 0x12, 0x1f, 0x02, 0x02}},
    Glyph{'5', {0x1f, 0x10, 0x1e, 0x01, 0x01, 0x11, 0x0e}},
    Glyph{'6', {0x06, 0x08, 0x10, 0x1e, 0x11, 0x11, 0x0e}},
    Glyph{'7', {0x1f, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08}},
    Glyph{'8', {0x0e, 0x11, 0x11, 0x0e, 0x11, 0x11, 0x0e}},
    Glyph{'9', {0x0e, 0x11, 0x11, 0x0f, 0x01, 0x02, 0x0c}},
    Glyph{'.', {0x00, 0x00, 0x00, 0x00, 0x00, 0x0c, 0x0c}},
    Glyph{'-', {0x00, 0x00, 0x00, 0x0e, 0x00, 0x00, 0x00}},
    Glyph{'+', {0x00, 0x04, 0x04, 0x1f, 0x04, 0x04, 0x00}},
    Glyph{'e', {0x00, 0x00, 0x0e, 0x11, 0x1f, 0x10, 0x0e}},
};

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

void Canvas::write(int left, int top, std::string_view text, Color color, int scale) {
    for (const char name : text) {
        const auto glyph = std::ranges::find(k_glyphs, name, &Glyph::name);
        if (glyph != k_glyphs.end())
            for (int row = 0; row < 7; ++row)
                for (int dot = 0; dot < 5; ++dot)
                    if (glyph->rows[static_cast<std::size_t>(row)] >> (4 - dot) & 1)
                        fill(left + dot * scale, top + row * scale, scale, scale, color);
        left += 6 * scale;
    }
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

std::string short_number(double value, double step) {
    char text[32];
    if (step >= 1e5 || (step > 0.0 && step < 1e-4)) {
        std::snprintf(text, sizeof text, "%.2e", value);
    } else {
        const int digits =
            step > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(step))), 0, 6) : 2;
        std::snprintf(text, sizeof text, "%.*f", digits, value);
    }
    return text;
}

void write_picture(OutputFile& file, const Canvas& canvas) {
    const std::vector<std::byte> png = encode_png(canvas.picture());
    file.write({reinterpret_cast<const char*>(png.data()), png.size()});
    file.commit();
}

}  // namespace rimline::tools
