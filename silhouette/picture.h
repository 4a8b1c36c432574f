#pragma once

// A picture, PNG and JPEG.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/error.h"

namespace rimline {

/// Rows from the top; 4 bytes a pixel: red, green, blue (sRGB), alpha.
struct Picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> rgba;
    /// Whether alpha means something: straight, not multiplied into the colors. False: the picture is opaque.
    bool has_alpha = false;
};

/// The bytes of a PNG file, with alpha if the picture has it. Throws Error{io} when libpng fails.
std::vector<std::byte> encode_png(const Picture& picture, const LongCall& call = {});

/// Files of pictures with more pixels are refused: 1 GiB of memory.
constexpr std::uint64_t k_max_decoded_pixels = std::uint64_t{1} << 28;

/// The picture in the bytes of a PNG file. All kinds of PNG are converted to 8 bits of sRGB; alpha is 255
/// where the file has none. Bytes after the end of the PNG are ignored. Throws Error{bad_input} where the
/// bytes are no PNG, are truncated or damaged, or hold more than k_max_decoded_pixels.
Picture decode_png(std::span<const std::byte> bytes);

/// The picture in the bytes of a JPEG file, baseline or progressive, in gray, color or CMYK; alpha is 255. Throws
/// Error{bad_input} where the bytes are no JPEG, are truncated or damaged, or hold more than k_max_decoded_pixels
/// or more than 100 scans.
Picture decode_jpeg(std::span<const std::byte> bytes);

/// The picture in the bytes of a PNG or JPEG file, whichever they are. Throws as the two above.
Picture decode_picture(std::span<const std::byte> bytes);

}  // namespace rimline
