#include "tools/output/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "silhouette/error.h"

namespace rimline::tools {

std::uint32_t contact_sheet_columns(std::size_t pictures) {
    return static_cast<std::uint32_t>(std::ceil(std::sqrt(double(pictures))));
}

Picture make_contact_sheet(std::span<const Picture> pictures, std::uint32_t columns,
                           std::uint32_t gap, const Color& color) {
    RIMLINE_CHECK(!pictures.empty() && columns > 0);
    const std::uint32_t width = pictures[0].width;
    const std::uint32_t height = pictures[0].height;
    const auto count = static_cast<std::uint32_t>(pictures.size());
    columns = std::min(columns, count);
    const std::uint32_t rows = (count + columns - 1) / columns;
    Picture sheet{columns * (width + gap) + gap, rows * (height + gap) + gap, {}};
    sheet.has_alpha = pictures[0].has_alpha;
    sheet.rgba.resize(std::size_t{4} * sheet.width * sheet.height);
    for (std::size_t i = 0; i < sheet.rgba.size(); i += 4) {
        sheet.rgba[i] = color.red;
        sheet.rgba[i + 1] = color.green;
        sheet.rgba[i + 2] = color.blue;
        sheet.rgba[i + 3] = color.alpha;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const Picture& picture = pictures[i];
        RIMLINE_CHECK(picture.width == width && picture.height == height);
        const std::size_t left = gap + (i % columns) * std::size_t{width + gap};
        const std::size_t top = gap + (i / columns) * std::size_t{height + gap};
        const std::size_t row_bytes = std::size_t{4} * width;
        for (std::size_t row = 0; row < height; ++row)
            std::copy_n(
                picture.rgba.begin() + std::ptrdiff_t(row * row_bytes), row_bytes,
                sheet.rgba.begin() + std::ptrdiff_t(4 * ((top + row) * sheet.width + left)));
    }
    return sheet;
}

}  // namespace rimline::tools
