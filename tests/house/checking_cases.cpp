// Cases for checking_cases.py: of each kind that test_main.cpp tells apart.

#include <doctest/doctest.h>

#include "tests/skip.h"

TEST_CASE("checks something") { CHECK(1 + 1 == 2); }
TEST_CASE("checks something, which is wrong") { CHECK(1 + 1 == 3); }
TEST_CASE("checks nothing") {}
TEST_CASE("checks nothing in two parts") {
    SUBCASE("one") {}
    SUBCASE("two") {}
}
TEST_CASE("checks something in one of two parts") {
    SUBCASE("one") { CHECK(true); }
    SUBCASE("two") {}
}
TEST_CASE("is skipped") { RIMLINE_SKIP("nothing is missing"); }
TEST_CASE("is skipped after a check") {
    CHECK(true);
    RIMLINE_SKIP("nothing is missing");
}
