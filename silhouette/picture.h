#pragma once

// A finished picture, and PNG.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rimline {

/// Rows from the top; 4 bytes a pixel: red, green, blue (sRGB), alpha.
struct Picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba;
};

/// The bytes of a PNG file without alpha. Throws Error{io} when libpng fails.
std::vector<std::byte> encode_png(const Picture& picture);

}  // namespace rimline
