#include "tools/output/contact_sheet.h"

#include <doctest/doctest.h>

#include <vector>

using namespace rimline;
using namespace rimline::tools;

namespace {

Picture plain(std::uint32_t width, std::uint32_t height, std::uint8_t value) {
    return {width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height, value)};
}

std::uint8_t red_at(const Picture& picture, std::uint32_t x, std::uint32_t y) {
    return picture.rgba[4 * (std::size_t{y} * picture.width + x)];
}

TEST_CASE("a contact sheet has its pictures in reading order with a gap around each") {
    const std::vector<Picture> pictures = {plain(3, 2, 10), plain(3, 2, 20), plain(3, 2, 30)};
    const Picture sheet = make_contact_sheet(pictures, 2, 1, {250, 0, 0});
    REQUIRE(sheet.width == 9);
    REQUIRE(sheet.height == 7);
    for (std::uint32_t y = 0; y < sheet.height; ++y)
        for (std::uint32_t x = 0; x < sheet.width; ++x) {
            const bool is_gap = x % 4 == 0 || y % 3 == 0;
            const std::uint32_t number = 2 * (y / 3) + x / 4;
            CHECK(red_at(sheet, x, y) == (is_gap || number == 3 ? 250 : 10 * (number + 1)));
        }
}

TEST_CASE("a contact sheet is no wider than its pictures fill") {
    const std::vector<Picture> one = {plain(5, 4, 1)};
    const Picture sheet = make_contact_sheet(one, 4, 2, {0, 0, 0});
    CHECK(sheet.width == 9);
    CHECK(sheet.height == 8);
    CHECK(contact_sheet_columns(1) == 1);
    CHECK(contact_sheet_columns(4) == 2);
    CHECK(contact_sheet_columns(5) == 3);
    CHECK(contact_sheet_columns(9) == 3);
}

}  // namespace
