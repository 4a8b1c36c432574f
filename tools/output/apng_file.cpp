#include "tools/output/apng_file.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace rimline::tools {

namespace {

struct Rectangle {
    std::uint32_t left = 0, top = 0, width = 1, height = 1;
};

std::string big_endian(std::uint32_t value, int bytes) {
    std::string text;
    for (int byte = bytes - 1; byte >= 0; --byte) text += static_cast<char>(value >> (8 * byte));
    return text;
}

std::uint32_t read_big_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (const char byte : bytes.substr(0, 4)) value = value << 8 | std::uint8_t(byte);
    return value;
}

// The checksum of PNG: CRC-32 of ISO 3309.
std::uint32_t checksum(std::string_view bytes) {
    static const std::array<std::uint32_t, 256> k_table = [] {
        std::array<std::uint32_t, 256> table{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            std::uint32_t value = i;
            for (int bit = 0; bit < 8; ++bit)
                value = (value & 1) != 0 ? 0xedb88320u ^ (value >> 1) : value >> 1;
            table[i] = value;
        }
        return table;
    }();
    std::uint32_t sum = 0xffffffffu;
    for (const char byte : bytes) sum = k_table[(sum ^ std::uint8_t(byte)) & 0xff] ^ (sum >> 8);
    return ~sum;
}

std::string chunk_of(const char* type, const std::string& data) {
    const std::string body = type + data;
    return big_endian(static_cast<std::uint32_t>(data.size()), 4) + body +
           big_endian(checksum(body), 4);
}

// The smallest rectangle with all pixels that differ; one pixel if none does. The pictures have the same size.
Rectangle changed_part(const Picture& before, const Picture& after) {
    const std::size_t row_bytes = std::size_t{4} * after.width;
    std::uint32_t left = after.width, right = 0, top = after.height, bottom = 0;
    for (std::uint32_t y = 0; y < after.height; ++y) {
        const std::uint8_t* a = &before.rgba[y * row_bytes];
        const std::uint8_t* b = &after.rgba[y * row_bytes];
        if (std::equal(a, a + row_bytes, b)) continue;
        top = std::min(top, y);
        bottom = y + 1;
        for (std::uint32_t x = 0; x < after.width; ++x) {
            if (std::equal(a + 4 * x, a + 4 * x + 4, b + 4 * x)) continue;
            left = std::min(left, x);
            right = std::max(right, x + 1);
        }
    }
    if (bottom == 0) return {};
    return {left, top, right - left, bottom - top};
}

Picture part_of(const Picture& picture, const Rectangle& part) {
    Picture result{part.width, part.height, {}};
    result.has_alpha = picture.has_alpha;
    for (std::uint32_t y = 0; y < part.height; ++y) {
        const std::size_t first = 4 * (std::size_t{part.top + y} * picture.width + part.left);
        result.rgba.insert(result.rgba.end(), picture.rgba.begin() + std::ptrdiff_t(first),
                           picture.rgba.begin() + std::ptrdiff_t(first + 4 * part.width));
    }
    return result;
}

}  // namespace

ApngFile::ApngFile(const std::filesystem::path& path, const FrameSinkOptions& options)
    : FrameSink(options.finish), file_(path), fps_(options.fps) {}

void ApngFile::put(const Picture& picture, std::uint32_t number) {
    const Rectangle part =
        number == 0 ? Rectangle{0, 0, picture.width, picture.height} : changed_part(last_, picture);
    const std::vector<std::byte> encoded = encode_png(part_of(picture, part));
    std::string_view png(reinterpret_cast<const char*>(encoded.data()), encoded.size());
    constexpr std::size_t k_signature_bytes = 8;
    if (number == 0) header_ = png.substr(0, k_signature_bytes);
    png.remove_prefix(k_signature_bytes);
    frames_ += chunk_of("fcTL", big_endian(sequence_++, 4) + big_endian(part.width, 4) +
                                    big_endian(part.height, 4) + big_endian(part.left, 4) +
                                    big_endian(part.top, 4) + big_endian(1, 2) +
                                    big_endian(fps_, 2) + std::string(2, '\0'));
    // Of each chunk: the size of its data, its type, the data, a checksum.
    while (png.size() >= 12) {
        const std::uint32_t size = read_big_endian(png);
        const std::string_view type = png.substr(4, 4), chunk = png.substr(0, 12 + size);
        if (type == "IDAT" && number == 0)
            frames_ += chunk;
        else if (type == "IDAT")
            frames_ +=
                chunk_of("fdAT", big_endian(sequence_++, 4) + std::string(chunk.substr(8, size)));
        else if (number == 0 && type != "IEND")
            header_ += chunk;  // The size, and what the colors are.
        png.remove_prefix(chunk.size());
    }
    ++count_;
    last_ = picture;
}

void ApngFile::end() {
    file_.write(header_);
    file_.write(
        chunk_of("acTL", big_endian(count_, 4) + big_endian(0, 4)));  // 0: it repeats forever.
    file_.write(frames_);
    file_.write(chunk_of("IEND", {}));
    file_.commit();
}

}  // namespace rimline::tools
