#pragma once

// A picture for plots, drawn on the CPU: rectangles, discs and numbers.

#include <cstdint>
#include <string>
#include <string_view>

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
    /// Characters of 5x7 dots; a dot is `scale` pixels wide. Digits, + - . and e; all others are blank.
    void write(int left, int top, std::string_view text, Color color, int scale);
    static int text_width(std::string_view text, int scale) noexcept {
        return static_cast<int>(text.size()) * 6 * scale - scale;
    }
    static int text_height(int scale) noexcept { return 7 * scale; }

    const Picture& picture() const noexcept { return picture_; }

private:
    Picture picture_;
};

/// The viridis color of a number in [0, 1]; its lightness increases evenly. NaN counts as 0.
Color viridis_color(double share);

/// A number with as many digits as distinguish steps of `step`.
std::string short_number(double value, double step);

/// Writes and commits a PNG. Throws Error{io}.
void write_picture(OutputFile& file, const Canvas& canvas);

}  // namespace rimline::tools
