// A DXF file of AutoCAD R12 (AC1009), the version that all programs read: a code and a value, each on its line.

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "silhouette/printable_text.h"
#include "tools/options/line_kind_names.h"
#include "tools/output/drawing_file.h"

namespace rimline::tools {

namespace {

// Color numbers: 7 is black on white and white on black, 8 dark gray.
constexpr int k_dxf_foreground = 7, k_dxf_gray = 8;

std::string layer_name(const PageLine& line) {
    std::string name = line.is_hidden ? "HIDDEN_" : "VISIBLE_";
    for (const char c : k_line_kind_names[std::size_t(line.kind)])
        name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return name;
}

// R12 has ASCII. AutoCAD reads other characters as \U+ and four hexadecimal digits, one for each number of 16 bits in
// UTF-16, and so do programs that read its files.
std::string dxf_text(std::string_view text) {
    std::string ascii;
    for (const char16_t unit : utf16_of(printable_text(text))) {
        if (unit < 0x80) {
            ascii += static_cast<char>(unit);
            continue;
        }
        std::array<char, 16> escape{};
        std::snprintf(escape.data(), escape.size(), "\\U+%04X", unsigned{unit});
        ascii += escape.data();
    }
    return ascii;
}

class DxfWriter {
public:
    explicit DxfWriter(const PageDrawing& drawing) : drawing_(drawing) {}

    std::string write() {
        add(999, dxf_text(drawing_.title));
        add(999, "All lengths are in mm.");
        begin_section("HEADER");
        add(9, "$ACADVER").add(1, "AC1009");
        add(9, "$EXTMIN").add(10, 0.0).add(20, 0.0).add(30, 0.0);
        add(9, "$EXTMAX").add(10, drawing_.size_mm.x).add(20, drawing_.size_mm.y).add(30, 0.0);
        add(9, "$LIMMIN").add(10, 0.0).add(20, 0.0);
        add(9, "$LIMMAX").add(10, drawing_.size_mm.x).add(20, drawing_.size_mm.y);
        add(0, "ENDSEC");
        begin_section("TABLES");
        add_line_types();
        add_layers();
        add(0, "ENDSEC");
        begin_section("ENTITIES");
        for (const PageLine& line : drawing_.lines) add_polyline(line);
        add(0, "ENDSEC").add(0, "EOF");
        return std::move(text_);
    }

private:
    DxfWriter& add(int code, std::string_view value) {
        text_ += std::to_string(code) + "\n";
        text_ += value;
        text_ += '\n';
        return *this;
    }
    DxfWriter& add(int code, int value) { return add(code, std::to_string(value)); }
    DxfWriter& add(int code, double value) {
        std::string number;
        append_decimals(number, value);
        // A real number has a point.
        if (number.find('.') == std::string::npos) number += ".0";
        return add(code, number);
    }
    void begin_section(std::string_view name) { add(0, "SECTION").add(2, name); }

    void add_line_types() {
        const double dash = k_dash_widths * drawing_.hidden_width_mm;
        const double space = k_dash_space_widths * drawing_.hidden_width_mm;
        add(0, "TABLE").add(2, "LTYPE").add(70, 2);
        add(0, "LTYPE").add(2, "CONTINUOUS").add(70, 0).add(3, "Solid line");
        add(72, 65).add(73, 0).add(40, 0.0);
        add(0, "LTYPE").add(2, "DASHED").add(70, 0).add(3, "_ _ _ _");
        add(72, 65).add(73, 2).add(40, dash + space).add(49, dash).add(49, -space);
        add(0, "ENDTAB");
    }

    void add_layers() {
        std::vector<std::string> names;
        for (const PageLine& line : drawing_.lines) {
            const std::string name = layer_name(line);
            if (std::ranges::find(names, name) == names.end()) names.push_back(name);
        }
        std::ranges::sort(names);
        add(0, "TABLE").add(2, "LAYER").add(70, static_cast<int>(names.size()) + 1);
        add_layer("0", false);
        for (const std::string& name : names) add_layer(name, name.starts_with("HIDDEN"));
        add(0, "ENDTAB");
    }

    void add_layer(std::string_view name, bool is_hidden) {
        const bool is_dashed = is_hidden && drawing_.dashes_hidden;
        add(0, "LAYER").add(2, name).add(70, 0);
        add(62, is_hidden && !is_dashed ? k_dxf_gray : k_dxf_foreground);
        add(6, is_dashed ? "DASHED" : "CONTINUOUS");
    }

    void add_polyline(const PageLine& line) {
        const std::string layer = layer_name(line);
        add(0, "POLYLINE").add(8, layer).add(66, 1).add(70, line.is_closed ? 1 : 0);
        add(10, 0.0).add(20, 0.0).add(30, 0.0);
        for (const glm::dvec2& p : line.points)
            add(0, "VERTEX")
                .add(8, layer)
                .add(10, p.x)
                .add(20, drawing_.size_mm.y - p.y)
                .add(30, 0.0);
        add(0, "SEQEND").add(8, layer);
    }

    const PageDrawing& drawing_;
    std::string text_;
};

}  // namespace

std::string drawing_dxf(const PageDrawing& drawing) { return DxfWriter(drawing).write(); }

}  // namespace rimline::tools
