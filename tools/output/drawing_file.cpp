#include "tools/output/drawing_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <utility>

namespace rimline::tools {

std::optional<DrawingFormat> drawing_format_of(const std::string& file_name) {
    std::string ending = file_name.substr(std::min(file_name.rfind('.'), file_name.size()));
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (ending == ".svg") return DrawingFormat::svg;
    if (ending == ".pdf") return DrawingFormat::pdf;
    if (ending == ".dxf") return DrawingFormat::dxf;
    if (ending == ".json") return DrawingFormat::json;
    return std::nullopt;
}

PageDrawing empty_drawing(const DrawnLines& drawn, std::string title, const glm::dvec2& size_mm) {
    return {.title = std::move(title),
            .size_mm = size_mm,
            .lines = {},
            .width_mm = drawn.width_mm,
            .hidden_width_mm = drawn.hidden_width_mm,
            .dashes_hidden = drawn.hidden == "dashed",
            .has_sources = false,
            .color = drawn.color.value_or(Color{0, 0, 0})};
}

void append_decimals(std::string& text, double value, int most_decimals) {
    std::array<char, 400> buffer;
    const char* end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                    std::chars_format::fixed, most_decimals)
                          .ptr;
    while (end[-1] == '0') --end;
    if (end[-1] == '.') --end;
    const std::string_view digits(buffer.data(), end);
    text += digits == "-0" ? "0" : digits;
}

}  // namespace rimline::tools
