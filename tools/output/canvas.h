#pragma once

// A picture to draw plots into: rectangles, discs and numbers, without a GPU.

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

    // What lies outside is left out. Rows from the top.
    void set(int x, int y, Color color);
    void fill(int left, int top, int width, int height, Color color);
    void disc(double x, double y, double radius, Color color);
    /// Letters of 5x7 dots, each `scale` pixels wide: digits, + - . and e; others are blank.
    void write(int left, int top, std::string_view text, Color color, int scale);
    static int text_width(std::string_view text, int scale) noexcept {
        return static_cast<int>(text.size()) * 6 * scale - scale;
    }
    static int text_height(int scale) noexcept { return 7 * scale; }

    const Picture& picture() const noexcept { return picture_; }

private:
    Picture picture_;
};

/// A number in [0, 1] as a color whose lightness rises evenly with it (viridis). NaN is as 0.
Color even_color(double share);

/// With so many digits that steps of `step` show.
std::string short_number(double value, double step);

/// Writes and commits a PNG. Throws Error{io}.
void write_picture(OutputFile& file, const Canvas& canvas);

}  // namespace rimline::tools
