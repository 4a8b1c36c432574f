#include "tools/output/drawing_file.h"

#include <doctest/doctest.h>

using namespace rimline;
using tools::DrawingFormat;
using tools::PageDrawing;

namespace {

std::string decimals(double value) {
    std::string text;
    tools::append_decimals(text, value);
    return text;
}

PageDrawing made_page() {
    PageDrawing drawing{.title = "a <b> & (c)\\ \xC3\xA4",
                        .size_mm = {100.0, 50.0},
                        .lines = {},
                        .width_mm = 0.5,
                        .hidden_width_mm = 0.2,
                        .dashes_hidden = true,
                        .has_sources = false};
    drawing.lines.push_back({LineKind::border, false, true, {{1, 2}, {3, 2}, {3, 4}}, {}, {5}, {}});
    drawing.lines.push_back({LineKind::crease, true, false, {{1, 2}, {3.5, 2}}, {}, {6}, {}});
    return drawing;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("numbers have at most three decimals and no zeros at their end") {
    CHECK(decimals(0.0) == "0");
    CHECK(decimals(-0.0001) == "0");
    CHECK(decimals(1.5) == "1.5");
    CHECK(decimals(-20.0) == "-20");
    CHECK(decimals(1.23456) == "1.235");
    CHECK(decimals(1e15) == "1000000000000000");
}

TEST_CASE("the format of a drawing is the ending of its name") {
    CHECK(tools::drawing_format_of("a.svg") == DrawingFormat::svg);
    CHECK(tools::drawing_format_of("b.c/A.PDF") == DrawingFormat::pdf);
    CHECK(tools::drawing_format_of("x.dxf") == DrawingFormat::dxf);
    CHECK(tools::drawing_format_of(".json") == DrawingFormat::json);
    for (const char* name : {"", "svg", "a.png", "a.svg.gz"})
        CHECK_FALSE(tools::drawing_format_of(name));
}

TEST_CASE("an SVG has a layer for visible and one for hidden lines") {
    const std::string text = drawing_svg(made_page());
    CHECK(contains(text, "<title>a &lt;b&gt; &amp; (c)\\ \xC3\xA4</title>"));
    CHECK(contains(text, R"(width="100mm" height="50mm" viewBox="0 0 100 50")"));
    CHECK(
        contains(text, R"(<g id="visible" inkscape:groupmode="layer" inkscape:label="1 visible")"));
    CHECK(contains(text, R"(<g id="hidden" inkscape:groupmode="layer" inkscape:label="2 hidden")"));
    CHECK(contains(text, R"(stroke-dasharray="2 1")"));
    CHECK(contains(text, "<g id=\"visible-border\">\n<path d=\"M1,2 3,2 3,4Z\"/>\n</g>"));
    CHECK(contains(text, "<g id=\"hidden-crease\">\n<path d=\"M1,2 3.5,2\"/>\n</g>"));
}

TEST_CASE("an SVG without lines has the layer of visible lines") {
    PageDrawing drawing = made_page();
    drawing.lines.clear();
    const std::string text = drawing_svg(drawing);
    CHECK(contains(text, "<g id=\"visible\""));
    CHECK_FALSE(contains(text, "<g id=\"hidden\""));
}

TEST_CASE("a path of an SVG says its chains and edges if they are asked for") {
    PageDrawing drawing = made_page();
    drawing.has_sources = true;
    drawing.lines[1].chains = {6, 9};
    drawing.lines[1].edges = {{1, 2}, {2, 7}};
    CHECK(contains(drawing_svg(drawing),
                   R"(<path d="M1,2 3.5,2" data-chain="6 9" data-edges="1-2 2-7"/>)"));
}

TEST_CASE("a PDF has its y axis upwards and escapes its title") {
    const std::string text = drawing_pdf(made_page());
    CHECK(contains(text, "/Title <FEFF0061"));
    CHECK(contains(text, "1 48 m\n3 48 l\n3 46 l\ns\n"));
    CHECK(contains(text, "[2 1] 0 d"));
}

TEST_CASE("a PDF has every character of its title") {
    const auto title = [](const std::string& plain) {
        PageDrawing drawing = made_page();
        drawing.title = plain;
        const std::string text = drawing_pdf(drawing);
        const std::size_t begin = text.find("/Title ") + 7;
        return text.substr(begin, text.find(" /Producer") - begin);
    };
    CHECK(title("") == "()");
    CHECK(title("a <b> & (c)\\") == "(a <b> & \\(c\\)\\\\)");
    // An umlaut, and an emoji, which takes two units.
    CHECK(title("b\xC3\xA4r (1)") == "<FEFF006200E400720020002800310029>");
    CHECK(title("\xE2\x82\xAC\xF0\x9F\x90\xB4") == "<FEFF20ACD83DDC34>");
    CHECK(title("\xF4\x8F\xBF\xBD") == "<FEFFDBFFDFFD>");
    // Bytes that are no UTF-8: alone, cut off, of a surrogate, and beside a character.
    CHECK(title("a\xE4") == "(a\\\\xe4)");
    CHECK(title("\xF0\x9F\x90") == "(\\\\xf0\\\\x9f\\\\x90)");
    CHECK(title("\xED\xA0\x80") == "(\\\\xed\\\\xa0\\\\x80)");
    CHECK(title("\xC3\xA4\xFF") == "<FEFF00E4005C007800660066>");
    CHECK(title("a\nb") == "(a\\\\x0ab)");
}

TEST_CASE("lines have the color of their ink, and those without one that of the drawing") {
    PageDrawing drawing = made_page();
    CHECK(contains(drawing_svg(drawing), R"(fill="none" stroke="#000")"));
    drawing.color = {0, 0, 255};
    drawing.inks = {{9, 8, 7}, {51, 51, 51}};
    drawing.lines[0].ink = 0;
    drawing.lines[1].ink = 1;
    drawing.lines.push_back({LineKind::border, false, false, {{5, 5}, {6, 5}}, {}, {5}, {}});
    const std::string svg = drawing_svg(drawing);
    CHECK(contains(svg, R"x(fill="none" stroke="rgb(0,0,255)")x"));
    CHECK(contains(svg, R"x(<path d="M1,2 3,2 3,4Z" stroke="rgb(9,8,7)"/>)x"));
    CHECK(contains(svg, R"x(<path d="M1,2 3.5,2" stroke="rgb(51,51,51)"/>)x"));
    CHECK(contains(svg, R"(<path d="M5,5 6,5"/>)"));
    const std::string pdf = drawing_pdf(drawing);
    CHECK(contains(pdf, "1 J 0 0 1 RG\n0.035 0.031 0.027 RG\n1 48 m\n"));
    CHECK(contains(pdf, "s\n0 0 1 RG\n5 45 m\n"));
    CHECK(contains(pdf, "[2 1] 0 d 0 0 1 RG\n0.2 G\n1 48 m\n"));
    // Solid hidden lines are gray.
    drawing.dashes_hidden = false;
    drawing.lines[1].ink = k_no_material_ink;
    CHECK(contains(drawing_svg(drawing), R"x(stroke="rgb(128,128,128)")x"));
    CHECK(contains(drawing_pdf(drawing), "1 J 0.502 G\n1 48 m\n"));
}

TEST_CASE("characters of a title beyond ASCII are escaped in a DXF as AutoCAD reads them") {
    const auto title = [](const std::string& text) {
        PageDrawing drawing = made_page();
        drawing.title = text;
        const std::string file = drawing_dxf(drawing);
        return file.substr(4, file.find('\n', 4) - 4);
    };
    CHECK(title("Lines of a.obj") == "Lines of a.obj");
    // Of two, three and four bytes.
    CHECK(title("\xC3\xA4 \xE2\x82\xAC \xF0\x9F\x90\xB4") == R"(\U+00E4 \U+20AC \U+D83D\U+DC34)");
    // No characters.
    CHECK(title("a\nb \xFF") == R"(a\x0ab \xff)");
}

TEST_CASE("a DXF has a layer for each kind of lines that it holds") {
    const std::string text = drawing_dxf(made_page());
    CHECK(contains(text, "LAYER\n2\nVISIBLE_BORDER\n70\n0\n62\n7\n6\nCONTINUOUS\n"));
    CHECK(contains(text, "LAYER\n2\nHIDDEN_CREASE\n70\n0\n62\n7\n6\nDASHED\n"));
    CHECK_FALSE(contains(text, "VISIBLE_CREASE"));
    CHECK(contains(text, "VERTEX\n8\nHIDDEN_CREASE\n10\n3.5\n20\n48.0\n30\n0.0\n"));
}
