#include "tools/output/drawing_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

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
