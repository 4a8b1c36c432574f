#include "tools/options/line_page.h"

#include <CLI/App.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

#include "tools/command.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

namespace {

// Two numbers with `separator` between them, each in [low, high].
std::optional<glm::dvec2> parse_pair(std::string_view text, char separator, double low,
                                     double high) {
    const std::size_t at = text.find(separator);
    if (at == std::string_view::npos) return std::nullopt;
    const auto number = [&](std::string_view part) -> std::optional<double> {
        double value = 0.0;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
        const bool is_in_range = value >= low && value <= high;  // False for NaN.
        if (error != std::errc() || end != part.data() + part.size() || !is_in_range)
            return std::nullopt;
        return value;
    };
    const auto first = number(text.substr(0, at)), second = number(text.substr(at + 1));
    if (!first || !second) return std::nullopt;
    return glm::dvec2(*first, *second);
}

struct NamedPage {
    std::string_view name;
    glm::dvec2 size_mm;
};

// Upright: ISO 216, and those of North America.
constexpr std::array<NamedPage, 10> k_pages{{{"a0", {841.0, 1189.0}},
                                             {"a1", {594.0, 841.0}},
                                             {"a2", {420.0, 594.0}},
                                             {"a3", {297.0, 420.0}},
                                             {"a4", {210.0, 297.0}},
                                             {"a5", {148.0, 210.0}},
                                             {"a6", {105.0, 148.0}},
                                             {"letter", {215.9, 279.4}},
                                             {"legal", {215.9, 355.6}},
                                             {"tabloid", {279.4, 431.8}}}};

void parse_page(const std::string& text, LinePage& page) {
    page.size_mm.reset();
    std::string name = text;
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (name == "fit") return;
    constexpr std::string_view k_landscape = "-landscape";
    const bool is_landscape = name.ends_with(k_landscape);
    if (is_landscape) name.resize(name.size() - k_landscape.size());
    const auto named = std::ranges::find(k_pages, name, &NamedPage::name);
    if (named == k_pages.end())
        page.size_mm = parse_pair(text, 'x', 1.0, k_max_page_mm);
    else
        page.size_mm =
            is_landscape ? glm::dvec2(named->size_mm.y, named->size_mm.x) : named->size_mm;
    if (!page.size_mm)
        throw CLI::ValidationError("--page",
                                   "expected fit, a0 to a6, letter, legal, tabloid, one of these "
                                   "with -landscape, or WxH with both from 1 to 5000 mm, not '" +
                                       text + "'");
}

void parse_page_scale(const std::string& text, LinePage& page) {
    const auto ratio = parse_pair(text, ':', 1e-9, 1e9);
    if (!ratio)
        throw CLI::ValidationError("--scale", "expected A:B, for example 1:10, not '" + text + "'");
    page.mm_per_unit = ratio->x / ratio->y;
}

}  // namespace

void LinePage::add_to(CLI::App& app) {
    constexpr const char* k_group = "Page";
    app.add_option_function<std::string>(
           "--page", [this](const std::string& text) { parse_page(text, *this); },
           "Width and height in mm, or a name: a0 to a6, letter, legal, tabloid, upright, or with "
           "-landscape; fit: as large as the drawing and its margins, without --scale 180 mm on "
           "the longer side")
        ->type_name("WxH|NAME|fit")
        ->default_str("a4")
        ->group(k_group);
    add_number(app, "--margin", margin_mm, 0.0, 1000.0,
               "Empty border of the page in mm, at least half of a line's width")
        ->group(k_group);
    app.add_option_function<std::string>(
           "--scale", [this](const std::string& text) { parse_page_scale(text, *this); },
           "True to scale, for orthographic views; units of the model are mm (default: as large "
           "as the page allows)")
        ->type_name("A:B")
        ->group(k_group);
}

glm::dvec2 LinePage::space_mm() const {
    const glm::dvec2 space = *size_mm - 2.0 * margin_mm;
    if (!(space.x > 0.0 && space.y > 0.0))
        throw UsageError("--margin: the margins leave no space on the page");
    return space;
}

double LinePage::aspect() const {
    if (!size_mm) return 4.0 / 3.0;
    const glm::dvec2 space = space_mm();
    return space.x / space.y;
}

}  // namespace rimline::tools
