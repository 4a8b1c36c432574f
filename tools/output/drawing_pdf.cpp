// A PDF 1.5 file of one page. Its layers are optional content groups (ISO 32000-1, 8.11). Coordinates are in mm,
// which a matrix converts to points of 1/72 inch.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "silhouette/printable_text.h"
#include "tools/output/drawing_file.h"

namespace rimline::tools {

namespace {

constexpr double k_points_per_mm = 72.0 / 25.4;

// Objects are numbered from 1, in the order in which they are added.
class PdfObjects {
public:
    void add(std::string_view content) {
        offsets_.push_back(text_.size());
        text_ += std::to_string(offsets_.size()) + " 0 obj\n";
        text_ += content;
        text_ += "\nendobj\n";
    }
    std::string finish(std::string_view trailer) {
        const std::size_t table = text_.size();
        const std::string count = std::to_string(offsets_.size() + 1);
        text_ += "xref\n0 " + count + "\n0000000000 65535 f \n";
        for (const std::size_t offset : offsets_) {
            std::array<char, 24> entry{};
            std::snprintf(entry.data(), entry.size(), "%010zu 00000 n \n", offset);
            text_ += entry.data();
        }
        text_ += "trailer\n<< /Size " + count + " ";
        text_ += trailer;
        text_ += " >>\nstartxref\n" + std::to_string(table) + "\n%%EOF\n";
        return std::move(text_);
    }

private:
    // Bytes above 127 in a comment say that the file is binary.
    std::string text_ = "%PDF-1.5\n%\xE2\xE3\xCF\xD3\n";
    std::vector<std::size_t> offsets_;
};

std::string pdf_number(double value) {
    std::string text;
    append_decimals(text, value);
    return text;
}

// `text`, which must be UTF-8, in the digits of UTF-16BE with a byte order mark (ISO 32000-1, 7.9.2.2).
std::string pdf_utf16(std::string_view text) {
    std::string digits = "<FEFF";
    for (const char16_t unit : utf16_of(text))
        for (const std::uint32_t shift : {12u, 8u, 4u, 0u})
            digits += "0123456789ABCDEF"[unit >> shift & 15];
    return digits + ">";
}

// Control characters and bytes that are no UTF-8 become \xNN.
std::string pdf_string(std::string_view plain) {
    const std::string printable = printable_text(plain);
    const auto is_ascii = [](char c) { return static_cast<std::uint8_t>(c) < 0x80; };
    if (!std::ranges::all_of(printable, is_ascii)) return pdf_utf16(printable);
    std::string text = "(";
    for (const char c : printable) {
        if (c == '(' || c == ')' || c == '\\') text += '\\';
        text += c;
    }
    return text + ")";
}

void append_pdf_color(std::string& text, const Color& color) {
    const auto add = [&](std::uint8_t channel) {
        append_decimals(text, channel / 255.0);
        text += ' ';
    };
    const bool is_gray = color.red == color.green && color.green == color.blue;
    if (!is_gray) {
        add(color.red);
        add(color.green);
    }
    add(color.blue);
    text += is_gray ? "G\n" : "RG\n";
}

void append_pdf_layer(std::string& text, const PageDrawing& drawing, bool is_hidden) {
    const double width = is_hidden ? drawing.hidden_width_mm : drawing.width_mm;
    text += is_hidden ? "/OC /Hidden BDC\nq\n" : "/OC /Visible BDC\nq\n";
    text += pdf_number(width) + " w 1 j ";
    if (is_hidden && drawing.dashes_hidden)
        text += "0 J [" + pdf_number(k_dash_widths * width) + " " +
                pdf_number(k_dash_space_widths * width) + "] 0 d ";
    else
        text += "1 J ";
    append_pdf_color(text, drawing.layer_color(is_hidden));
    std::uint8_t ink = k_no_material_ink;
    for (const PageLine& line : drawing.lines) {
        if (line.is_hidden != is_hidden) continue;
        if (line.ink != ink) {
            ink = line.ink;
            append_pdf_color(text, ink == k_no_material_ink ? drawing.layer_color(is_hidden)
                                                            : drawing.inks[ink]);
        }
        const auto add = [&](const glm::dvec2& p, const char* operation) {
            append_decimals(text, p.x);
            text += ' ';
            append_decimals(text, drawing.size_mm.y - p.y);
            text += operation;
        };
        add(line.points[0], " m\n");
        if (line.curves.empty()) {
            for (std::size_t i = 1; i < line.points.size(); ++i) add(line.points[i], " l\n");
        } else {
            for (const CurvePiece& piece : line.curves) {
                if (!piece.is_straight) {
                    add(piece.control_1, " ");
                    add(piece.control_2, " ");
                }
                add(piece.end, piece.is_straight ? " l\n" : " c\n");
            }
        }
        text += line.is_closed ? "s\n" : "S\n";
    }
    text += "Q\nEMC\n";
}

}  // namespace

std::string drawing_pdf(const PageDrawing& drawing) {
    // Exact to a hundred-thousandth of a mm in a meter.
    std::string scale;
    append_decimals(scale, k_points_per_mm, 8);
    std::string content = "q\n" + scale + " 0 0 " + scale + " 0 0 cm\n";
    append_pdf_layer(content, drawing, true);
    append_pdf_layer(content, drawing, false);
    content += "Q\n";

    PdfObjects objects;
    objects.add(
        "<< /Type /Catalog /Pages 2 0 R /OCProperties << /OCGs [5 0 R 6 0 R] "
        "/D << /Order [5 0 R 6 0 R] /ON [5 0 R 6 0 R] >> >> >>");
    objects.add("<< /Type /Pages /Kids [3 0 R] /Count 1 >>");
    objects.add("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 " +
                pdf_number(k_points_per_mm * drawing.size_mm.x) + " " +
                pdf_number(k_points_per_mm * drawing.size_mm.y) +
                "] /Contents 4 0 R /Resources << /Properties << /Visible 5 0 R /Hidden 6 0 R >> >> "
                ">>");
    objects.add("<< /Length " + std::to_string(content.size()) + " >>\nstream\n" + content +
                "endstream");
    objects.add("<< /Type /OCG /Name (1 visible) >>");
    objects.add("<< /Type /OCG /Name (2 hidden) >>");
    objects.add("<< /Title " + pdf_string(drawing.title) + " /Producer (Rimline) >>");
    return objects.finish("/Root 1 0 R /Info 7 0 R");
}

}  // namespace rimline::tools
