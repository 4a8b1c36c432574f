#pragma once

// A picture for plots, drawn on the CPU: rectangles, discs, lines and text.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string>

#include "silhouette/picture.h"
#include "tools/options/option_types.h"
#include "tools/output/output_file.h"

namespace rimline::tools {

class Canvas {
public:
    Canvas(std::uint32_t width, std::uint32_t height, Color background);

    int width() const noexcept { return static_cast<int>(picture_.width); }
    int height() const noexcept { return static_cast<int>(picture_.height); }

    // Coordinates are in pixels from the upper left corner. Parts outside the picture are clipped.
    void set(int x, int y, Color color);
    void fill(int left, int top, int width, int height, Color color);
    void disc(double x, double y, double radius, Color color);
    /// With round ends and smooth edges. `opacity` is in [0, 1].
    void line(const glm::dvec2& from, const glm::dvec2& to, double width, Color color,
              double opacity = 1.0);
    /// The same of many, as one: where they meet, none covers the other.
    void lines(std::span<const std::array<glm::dvec2, 2>> segments, double width, Color color,
               double opacity = 1.0);
    /// One line of ASCII. A dot of the font is `scale` pixels wide.
    void write(int left, int top, const std::string& text, Color color, int scale);
    static int text_width(const std::string& text, int scale);
    /// Of digits and capitals. Some letters go below by two dots.
    static int text_height(int scale) noexcept { return 7 * scale; }

    const Picture& picture() const noexcept { return picture_; }

private:
    void blend(int x, int y, Color color, double opacity);

    Picture picture_;
};

/// The viridis color of a number in [0, 1]; its lightness increases evenly. NaN counts as 0.
Color viridis_color(double share);

/// Writes and commits a PNG. Throws Error{io}.
void write_picture(OutputFile& file, const Canvas& canvas);

}  // namespace rimline::tools
