#include <doctest/doctest.h>

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <random>

#include "silhouette/mesh/formats/byte_scanner.h"
#include "silhouette/mesh/formats/text_scanner.h"

using namespace rimline;

TEST_CASE("A whole token is a number or nothing is") {
    for (const char* good : {"0", "-0", "1", "+1", "1.5", ".5", "5.", "1e3", "1E-3", "+1.25e+2"})
        CHECK(parse_float(good) == std::strtof(good, nullptr));
    for (const char* bad : {"", "+", "-", ".", "e5", "1e", "1x", "x", "0x10", "1,5", "--1", "+-1",
                            "1 ", " 1", "++1", "1e+-5"})
        CHECK_MESSAGE(!parse_float(bad), bad);
    for (const char* bad : {"", "+", "1.0", "1e3", "0x1", "9223372036854775808", "+-1", "1 "})
        CHECK_MESSAGE(!parse_integer(bad), bad);
    CHECK(parse_integer("-9223372036854775808") == INT64_MIN);
    CHECK(parse_integer("+7") == 7);
}

TEST_CASE("Numbers beyond float's range are infinite or zero, by which end they fall off") {
    for (const char* large : {"1e39", "1e400", "1e99999999999999999999",
                              "9999999999999999999999999"
                              "99999999999999999e0",
                              "0.1e400", "1000000e300"})
        CHECK_MESSAGE(parse_float(large) == INFINITY, large);
    for (const char* small : {"1e-60", "1e-400", "1e-99999999999999999999", "0.0001e-400",
                              "100000e-400", "0e-99999999999999999999", "0e999999999999999999999"})
        CHECK_MESSAGE(parse_float(small) == 0.0f, small);
    CHECK(parse_float("-1e400") == -INFINITY);
    const std::string tiny = "0." + std::string(500, '0') + "1";
    CHECK(parse_float(tiny) == 0.0f);
    CHECK(parse_float("1" + std::string(500, '0')) == INFINITY);
    CHECK(parse_float("1" + std::string(500, '0') + "e-500") == 1.0f);
}

TEST_CASE("Parsed floats are those of the C library, digit for digit") {
    const std::uint32_t seed = 7;
    CAPTURE(seed);
    std::mt19937 random(seed);
    for (int i = 0; i < 20000; ++i) {
        char text[64];
        const double mantissa = std::uniform_real_distribution<double>(-10, 10)(random);
        const int exponent = std::uniform_int_distribution<int>(-44, 37)(random);
        std::snprintf(text, sizeof(text), i % 2 ? "%.17ge%d" : "%.6fe%d", mantissa, exponent);
        CAPTURE(text);
        CHECK(parse_float(text) == std::strtof(text, nullptr));
    }
}

TEST_CASE("Lines end with LF, CRLF or CR and are counted alike") {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        const std::string text =
            "a b" + end + end + "  c\t" + end + "# d" + end + "e#f" + end + "g";
        TextScanner scanner("f", text, {.comment = '#'});
        REQUIRE(scanner.next_line());
        CHECK(scanner.token() == "a");
        CHECK(scanner.token() == "b");
        CHECK(scanner.token() == "");
        REQUIRE(scanner.next_line());
        CHECK(scanner.line() == 3);
        CHECK(scanner.token() == "c");
        REQUIRE(scanner.next_line());
        CHECK(scanner.line() == 5);
        CHECK(scanner.token() == "e");
        CHECK(scanner.token() == "");
        CHECK(scanner.word() == "g");
        CHECK(scanner.line() == 6);
        CHECK(scanner.word() == "");
        CHECK(!scanner.next_line());
        CHECK(scanner.remaining() == 0);
    }
}

TEST_CASE("A backslash joins lines where the rules say so, and the line number follows") {
    TextScanner scanner("f", "f 1 \\\n 2\\\r\n3 a\\b\nx \\", {.continuations = true});
    REQUIRE(scanner.next_line());
    for (const char* token : {"f", "1", "2", "3", "a\\b", ""}) CHECK(scanner.token() == token);
    CHECK(scanner.line() == 3);
    REQUIRE(scanner.next_line());
    CHECK(scanner.token() == "x");
    CHECK(scanner.token() == "");
    CHECK(!scanner.next_line());
}

TEST_CASE("Errors name the file, the line and the token") {
    TextScanner scanner("mesh.off", "1 2\nword\x01 nan 1e30");
    REQUIRE(scanner.next_line());
    REQUIRE(scanner.next_line());
    CHECK_THROWS_WITH_AS(scanner.coordinate("x"),
                         "mesh.off:2: 'word?' is not a number; x should stand here", Error);
    CHECK_THROWS_WITH_AS(scanner.coordinate("y"),
                         "mesh.off:2: y is 'nan'; only finite numbers can be used", Error);
    CHECK_THROWS_WITH_AS(scanner.coordinate("z"),
                         "mesh.off:2: z is '1e30', beyond 2^60 in size; scale the model down",
                         Error);
    CHECK_THROWS_WITH_AS(scanner.coordinate("w"), "mesh.off:2: the line ends where w should follow",
                         Error);
}

TEST_CASE("Binary values are read in either byte order and never past the end") {
    const std::string bytes("\x01\x02\x03\x04\xff", 5);
    CHECK(load_scalar(bytes.data(), ScalarType::uint32, std::endian::little) == 0x04030201);
    CHECK(load_scalar(bytes.data(), ScalarType::uint32, std::endian::big) == 0x01020304);
    CHECK(load_scalar(bytes.data() + 4, ScalarType::int8, std::endian::big) == -1);
    CHECK(load_scalar(bytes.data() + 4, ScalarType::uint8, std::endian::big) == 255);
    CHECK(load_scalar(bytes.data() + 3, ScalarType::int16, std::endian::big) == 0x4ff);
    CHECK(load_scalar(bytes.data() + 3, ScalarType::int16, std::endian::little) == -252);
    ByteScanner scanner("f", bytes, 2, std::endian::little);
    CHECK(scanner.integer(ScalarType::uint16, "a value") == 0x0403);
    CHECK_THROWS_AS(scanner.number(ScalarType::uint16, "a value"), Error);
    CHECK_THROWS_AS(scanner.skip(0xffffffffffffffffu, 8, "values"), Error);
    scanner.skip(1, 1, "a value");
    CHECK(scanner.remaining() == 0);
}

TEST_CASE("Binary coordinates are finite and within bounds") {
    const auto read = [](double value) {
        std::string bytes(8, '\0');
        std::memcpy(bytes.data(), &value, 8);
        ByteScanner scanner("f", bytes, 0, std::endian::native);
        return scanner.coordinate(ScalarType::float64, "x");
    };
    CHECK(read(0.1) == 0.1f);
    CHECK(read(0x1p60) == 0x1p60f);
    for (const double bad : {0x1.1p60, -1e300, double(INFINITY), double(NAN)})
        CHECK_THROWS_AS(read(bad), Error);
}
