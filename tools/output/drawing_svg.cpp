#include <string>
#include <string_view>

#include "silhouette/printable_text.h"
#include "tools/options/line_kind_names.h"
#include "tools/output/drawing_file.h"
#include "tools/output/xml_text.h"

namespace rimline::tools {

namespace {

class SvgWriter {
public:
    explicit SvgWriter(const PageDrawing& drawing) : drawing_(drawing) {}

    std::string write() {
        add(R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width=")");
        add(drawing_.size_mm.x).add("mm\" height=\"").add(drawing_.size_mm.y);
        add("mm\" viewBox=\"0 0 ").add(drawing_.size_mm.x).add(" ").add(drawing_.size_mm.y);
        add("\">\n<title>").add(escaped_for_xml(printable_text(drawing_.title))).add("</title>\n");
        // Visible lines lie above hidden ones.
        add_layer(true);
        add_layer(false);
        add("</svg>\n");
        return std::move(text_);
    }

private:
    SvgWriter& add(std::string_view text) {
        text_ += text;
        return *this;
    }
    SvgWriter& add(double value) {
        append_decimals(text_, value);
        return *this;
    }
    SvgWriter& add(const glm::dvec2& point) { return add(point.x).add(",").add(point.y); }
    void add_layer(bool is_hidden) {
        const std::string_view name = is_hidden ? "hidden" : "visible";
        const double width = is_hidden ? drawing_.hidden_width_mm : drawing_.width_mm;
        bool is_open = false;
        for (std::size_t kind = 0; kind < k_line_kinds; ++kind) {
            bool has_kind = false;
            for (const PageLine& line : drawing_.lines) {
                if (line.is_hidden != is_hidden || line.kind != static_cast<LineKind>(kind))
                    continue;
                if (!is_open) open_layer(name, width, is_hidden);
                is_open = true;
                if (!has_kind)
                    add("<g id=\"").add(name).add("-").add(k_line_kind_names[kind]).add("\">\n");
                has_kind = true;
                add_path(line);
            }
            if (has_kind) add("</g>\n");
        }
        // The layer of visible lines is always there.
        if (!is_open && !is_hidden) open_layer(name, width, is_hidden);
        if (is_open || !is_hidden) add("</g>\n");
    }

    void open_layer(std::string_view name, double width, bool is_hidden) {
        add("<g id=\"").add(name).add("\" inkscape:groupmode=\"layer\" inkscape:label=\"");
        add(is_hidden ? "2 " : "1 ").add(name).add("\" fill=\"none\" stroke=\"");
        add_color(drawing_.layer_color(is_hidden));
        add("\" stroke-width=\"").add(width).add("\" stroke-linejoin=\"round\" stroke-linecap=\"");
        if (is_hidden && drawing_.dashes_hidden)
            add("butt\" stroke-dasharray=\"")
                .add(k_dash_widths * width)
                .add(" ")
                .add(k_dash_space_widths * width);
        else
            add("round");
        add("\">\n");
    }

    void add_color(const Color& color) {
        if (color.red == 0 && color.green == 0 && color.blue == 0)
            add("#000");
        else
            add("rgb(")
                .add(std::to_string(color.red))
                .add(",")
                .add(std::to_string(color.green))
                .add(",")
                .add(std::to_string(color.blue))
                .add(")");
    }

    void add_path(const PageLine& line) {
        add("<path d=\"M");
        if (line.curves.empty()) {
            for (std::size_t i = 0; i < line.points.size(); ++i)
                add(i > 0 ? " " : "").add(line.points[i]);
        } else {
            add(line.points[0]);
            char command = 'M';
            for (const CurvePiece& piece : line.curves) {
                const char next = piece.is_straight ? 'L' : 'C';
                // The same command again need not be said.
                text_ += next == command ? ' ' : next;
                command = next;
                if (!piece.is_straight) add(piece.control_1).add(" ").add(piece.control_2).add(" ");
                add(piece.end);
            }
        }
        if (line.is_closed) add("Z");
        if (line.ink != k_no_material_ink) {
            add("\" stroke=\"");
            add_color(drawing_.inks[line.ink]);
        }
        if (drawing_.has_sources) {
            add("\" data-chain=\"");
            for (std::size_t i = 0; i < line.chains.size(); ++i)
                add(i > 0 ? " " : "").add(std::to_string(line.chains[i]));
            add("\" data-edges=\"");
            for (std::size_t i = 0; i < line.edges.size(); ++i)
                add(i > 0 ? " " : "")
                    .add(std::to_string(line.edges[i][0]))
                    .add("-")
                    .add(std::to_string(line.edges[i][1]));
        }
        add("\"/>\n");
    }

    const PageDrawing& drawing_;
    std::string text_;
};

}  // namespace

std::string drawing_svg(const PageDrawing& drawing) { return SvgWriter(drawing).write(); }

}  // namespace rimline::tools
