// decode_jpeg() and decode_picture(). The files are pictures of 16x16 pixels in one color.

#include <doctest/doctest.h>

#include <cstdlib>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/picture.h"

namespace rimline {
namespace {

constexpr std::string_view k_baseline =
    "/9j/4AAQSkZJRgABAQAAAQABAAD/"
    "2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsLEBYQERMU"
    "FRUVDA8XGBYUGBIUFRT/"
    "2wBDAQMEBAUEBQkFBQkUDQsNFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQU"
    "FBQUFBQUFBT/wAARCAAQABADAREAAhEBAxEB/8QAFQABAQAAAAAAAAAAAAAAAAAAAAf/"
    "xAAUEAEAAAAAAAAAAAAAAAAAAAAA/8QA"
    "FgEBAQEAAAAAAAAAAAAAAAAAAAcI/8QAFBEBAAAAAAAAAAAAAAAAAAAAAP/aAAwDAQACEQMRAD8Al6LtgAAAP//Z";
constexpr std::string_view k_progressive =
    "/9j/4AAQSkZJRgABAQAAAQABAAD/"
    "2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsLEBYQERMU"
    "FRUVDA8XGBYUGBIUFRT/"
    "2wBDAQMEBAUEBQkFBQkUDQsNFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQU"
    "FBQUFBQUFBT/wgARCAAQABADAREAAhEBAxEB/8QAFQABAQAAAAAAAAAAAAAAAAAAAAb/"
    "xAAWAQEBAQAAAAAAAAAAAAAAAAAABgf/"
    "2gAMAwEAAhADEAAAAZeL2AAf/8QAFBABAAAAAAAAAAAAAAAAAAAAIP/aAAgBAQABBQIf/"
    "8QAFBEBAAAAAAAAAAAAAAAAAAAAIP/a"
    "AAgBAwEBPwEf/8QAFBEBAAAAAAAAAAAAAAAAAAAAIP/aAAgBAgEBPwEf/8QAFBABAAAAAAAAAAAAAAAAAAAAIP/"
    "aAAgBAQAGPwIf"
    "/8QAFBABAAAAAAAAAAAAAAAAAAAAIP/aAAgBAQABPyEf/9oADAMBAAIAAwAAABAAD//"
    "EABQRAQAAAAAAAAAAAAAAAAAAACD/2gAI"
    "AQMBAT8QH//EABQRAQAAAAAAAAAAAAAAAAAAACD/2gAIAQIBAT8QH//EABQQAQAAAAAAAAAAAAAAAAAAACD/"
    "2gAIAQEAAT8QH//Z";
constexpr std::string_view k_gray =
    "/9j/4AAQSkZJRgABAQAAAQABAAD/"
    "2wBDAAMCAgICAgMCAgIDAwMDBAYEBAQEBAgGBgUGCQgKCgkICQkKDA8MCgsOCwkJDRENDg8Q"
    "EBEQCgwSExIQEw8QEBD/wAALCAAQABABAREA/8QAFQABAQAAAAAAAAAAAAAAAAAAAAX/"
    "xAAUEAEAAAAAAAAAAAAAAAAAAAAA/9oA"
    "CAEBAAA/AJQD/9k=";
constexpr std::string_view k_cmyk =
    "/9j/7gAOQWRvYmUAZAAAAAAC/"
    "9sAQwADAgICAgIDAgICAwMDAwQGBAQEBAQIBgYFBgkICgoJCAkJCgwPDAoLDgsJCQ0RDQ4PEBAR"
    "EAoMEhMSEBMPEBAQ/"
    "9sAQwEDAwMEAwQIBAQIEAsJCxAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQ"
    "EBAQEBAQ/8AAFAgAEAAQBAERAAIRAQMRAQQRAP/EABYAAQEBAAAAAAAAAAAAAAAAAAACCP/"
    "EABQQAQAAAAAAAAAAAAAAAAAAAAD/"
    "xAAVAQEBAAAAAAAAAAAAAAAAAAAACP/EABQRAQAAAAAAAAAAAAAAAAAAAAD/2gAOBAEAAhEDEQQAAD8AtQqCmwAAAAH/"
    "2Q==";

std::vector<std::byte> from_base64(std::string_view text) {
    constexpr std::string_view k_digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<std::byte> bytes;
    std::uint32_t group = 0;
    int bits = 0;
    for (const char c : text.substr(0, text.find('='))) {
        group = group << 6 | static_cast<std::uint32_t>(k_digits.find(c));
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes.push_back(static_cast<std::byte>(group >> bits));
    }
    return bytes;
}

// The message, or "" where the bytes are a picture. Any other exception escapes.
std::string refusal_of(std::span<const std::byte> bytes) {
    try {
        static_cast<void>(decode_picture(bytes));
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        return error.what();
    }
    return "";
}

TEST_CASE("JPEG: baseline, progressive, gray and CMYK files give their colors") {
    struct Sample {
        std::string_view text;
        int red, green, blue;
    };
    for (const Sample& sample :
         {Sample{k_baseline, 200, 60, 30}, Sample{k_progressive, 200, 60, 30},
          Sample{k_gray, 120, 120, 120}, Sample{k_cmyk, 200, 60, 30}}) {
        const Picture picture = decode_picture(from_base64(sample.text));
        CAPTURE(picture.rgba[0]);
        CAPTURE(picture.rgba[1]);
        CAPTURE(picture.rgba[2]);
        CHECK(picture.width == 16);
        CHECK(picture.height == 16);
        REQUIRE(picture.rgba.size() == 1024);
        int wrong = 0;
        for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
            wrong += std::abs(picture.rgba[i] - sample.red) > 3 ||
                     std::abs(picture.rgba[i + 1] - sample.green) > 3 ||
                     std::abs(picture.rgba[i + 2] - sample.blue) > 3 || picture.rgba[i + 3] != 255;
        CHECK(wrong == 0);
    }
}

TEST_CASE("JPEG: a file that ends early or is damaged is refused, or is still a picture") {
    const std::uint32_t seed = 5;
    CAPTURE(seed);
    std::mt19937 random(seed);
    for (const std::string_view text : {k_baseline, k_progressive, k_gray, k_cmyk}) {
        const std::vector<std::byte> bytes = from_base64(text);
        // The last two bytes mark the end, which libjpeg needs not see.
        for (std::size_t size = 0; size + 2 < bytes.size(); ++size)
            CHECK(refusal_of(std::span(bytes).first(size)) != "");
        for (int i = 0; i < 2000; ++i) {
            std::vector<std::byte> damaged = bytes;
            // A size could become one of 1 GiB, which is allowed but slow: not the start of frame.
            damaged[random() % damaged.size()] = static_cast<std::byte>(random());
            static_cast<void>(refusal_of(damaged));
        }
    }
}

TEST_CASE("JPEG: a file of many scans is refused") {
    // The progressive file with one scan, of no more information, repeated.
    const std::vector<std::byte> bytes = from_base64(k_progressive);
    std::vector<std::size_t> scans;
    for (std::size_t i = 0; i + 1 < bytes.size(); ++i)
        if (bytes[i] == std::byte{0xff} && bytes[i + 1] == std::byte{0xda}) scans.push_back(i);
    REQUIRE(scans.size() >= 3);
    const auto at = [&](std::size_t i) { return bytes.begin() + static_cast<std::ptrdiff_t>(i); };
    std::vector<std::byte> many(bytes.begin(), at(scans[1]));
    for (int i = 0; i < 200; ++i) many.insert(many.end(), at(scans[0]), at(scans[1]));
    many.insert(many.end(), at(scans[1]), bytes.end());
    CHECK(refusal_of(many) != "");
}

TEST_CASE("what is neither PNG nor JPEG is refused") {
    CHECK(refusal_of({}) == "neither a PNG nor a JPEG file");
    const std::string text = "GIF89a and more";
    CHECK(refusal_of(std::as_bytes(std::span(text))) == "neither a PNG nor a JPEG file");
}

}  // namespace
}  // namespace rimline
