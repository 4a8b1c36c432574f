#include "tools/batch/batch_page.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "silhouette/printable_text.h"
#include "tools/output/xml_text.h"

namespace rimline::tools {

namespace {

namespace fs = std::filesystem;

// A page of more pictures takes browsers minutes.
constexpr std::size_t k_max_items = 5000;

// For src and href: bytes that are no letters, digits or plain signs as %XX.
std::string url(const std::string& path) {
    constexpr std::string_view k_plain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_.~/";
    constexpr std::string_view k_digits = "0123456789ABCDEF";
    std::string escaped;
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        if (k_plain.find(c) != std::string_view::npos)
            escaped += c;
        else
            escaped += {'%', k_digits[byte / 16], k_digits[byte % 16]};
    }
    return escaped;
}

// Names of files are any bytes. HTML would show a line break as a space, and some bytes not at all.
std::string shown_text(const std::string& text) { return escaped_for_xml(printable_text(text)); }

bool is_shown(const std::string& output) {
    const std::string ending = fs::path(output).extension().string();
    constexpr std::array<std::string_view, 4> k_shown{".png", ".svg", ".apng", ".gif"};
    return std::ranges::find(k_shown, ending) != k_shown.end();
}

// The contact sheet, else the first picture.
const std::string* shown_output(const BatchPageItem& item) {
    const auto sheet = std::ranges::find_if(item.outputs, [](const std::string& output) {
        return fs::path(output).filename() == "contact_sheet.png";
    });
    const auto found =
        sheet != item.outputs.end() ? sheet : std::ranges::find_if(item.outputs, is_shown);
    return found == item.outputs.end() ? nullptr : &*found;
}

}  // namespace

std::string batch_page(const std::vector<BatchPageItem>& items, const fs::path& folder) {
    std::string page =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>Rimline "
        "batch</title>\n<style>\n"
        "body { font: 14px sans-serif; margin: 24px; background: #f7f3ea; color: #222 }\n"
        "main { display: grid; grid-template-columns: repeat(auto-fill, minmax(240px, 1fr)); gap: "
        "16px }\n"
        "figure { margin: 0; background: #fff; border: 1px solid #ddd; padding: 8px }\n"
        "img { width: 100%; aspect-ratio: 4 / 3; object-fit: contain }\n"
        "figcaption { overflow-wrap: anywhere; margin-top: 6px }\n"
        ".failed { color: #a00 }\n</style>\n";
    std::size_t failed = 0;
    for (const BatchPageItem& item : items) failed += item.error.empty() ? 0 : 1;
    page += "<h1>" + std::to_string(items.size()) + " models, " + std::to_string(failed) +
            " failed</h1>\n<main>\n";
    const std::size_t shown = std::min(items.size(), k_max_items);
    for (std::size_t i = 0; i < shown; ++i) {
        const BatchPageItem& item = items[i];
        const std::string name = shown_text(item.input);
        page += "<figure>";
        if (const std::string* output = shown_output(item)) {
            const std::string link = url(
                fs::absolute(*output).lexically_relative(fs::absolute(folder)).generic_string());
            page += "<a href=\"" + link + "\"><img loading=\"lazy\" src=\"" + link + "\" alt=\"" +
                    name + "\"></a>";
        }
        page += "<figcaption>" + name;
        if (!item.error.empty())
            page += "<br><span class=\"failed\">" + shown_text(item.error) + "</span>";
        page += "</figcaption></figure>\n";
    }
    page += "</main>\n";
    if (shown < items.size())
        page += "<p>The first " + std::to_string(shown) + " models. The manifest has all.</p>\n";
    return page + "</html>\n";
}

}  // namespace rimline::tools
