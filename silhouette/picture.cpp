#include "silhouette/picture.h"

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <utility>

namespace rimline {

namespace {

[[noreturn]] void refuse_png(const std::string& why) {
    throw Error(ErrorCode::bad_input, "PNG: " + why);
}

std::uint32_t big_endian(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (const std::byte byte : bytes.first(4))
        value = value << 8 | std::to_integer<std::uint32_t>(byte);
    return value;
}

// Checks that all chunks are there, to the last: libpng does not read on to it. Of each chunk:
//
//     [ size of data, 4 bytes | type, 4 | data | checksum, 4 ]
void check_png_is_whole(std::span<const std::byte> bytes) {
    constexpr std::array<std::uint8_t, 8> k_signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    constexpr std::uint32_t k_end_type = 0x49454e44;  // IEND
    for (std::size_t i = 0; i < k_signature.size(); ++i) {
        if (i == bytes.size() && i > 0) refuse_png("truncated");
        if (i == bytes.size() || std::to_integer<std::uint8_t>(bytes[i]) != k_signature[i])
            refuse_png("not a PNG file");
    }
    std::span<const std::byte> rest = bytes.subspan(k_signature.size());
    for (bool is_end = false; !is_end;) {
        if (rest.size() < 12) refuse_png("truncated");
        const std::size_t chunk_size = std::size_t{12} + big_endian(rest);
        if (rest.size() < chunk_size) refuse_png("truncated");
        is_end = big_endian(rest.subspan(4)) == k_end_type;
        rest = rest.subspan(chunk_size);
    }
}

// Writes a PNG file to memory.
class PngWriter {
public:
    PngWriter() {
        png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, this, &fail, [](auto, auto) {});
        info_ = png_create_info_struct(png_);
        if (info_ == nullptr) {
            png_destroy_write_struct(&png_, nullptr);
            throw std::bad_alloc();
        }
        png_set_write_fn(png_, this, &append, nullptr);
    }
    ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    /// Calls work(png, info). libpng may leave it by longjmp(): it must own nothing.
    template <typename Work>
    void run(const Work& work) {
        if (setjmp(png_jmpbuf(png_)) == 0) return work(png_, info_);
        if (failure_) std::rethrow_exception(failure_);
        throw Error(ErrorCode::io, std::string("PNG: ") + message_.data());
    }
    std::vector<std::byte>& bytes() { return bytes_; }

private:
    [[noreturn]] static void fail(png_structp png, const char* message) {
        auto& self = *static_cast<PngWriter*>(png_get_error_ptr(png));
        std::snprintf(self.message_.data(), self.message_.size(), "%s", message);
        png_longjmp(png, 1);
    }
    static void append(png_structp png, std::uint8_t* data, std::size_t size) {
        auto& self = *static_cast<PngWriter*>(png_get_io_ptr(png));
        try {
            const auto* begin = reinterpret_cast<const std::byte*>(data);
            self.bytes_.insert(self.bytes_.end(), begin, begin + size);
        } catch (...) {
            self.failure_ = std::current_exception();
        }
        if (self.failure_) png_error(png, "");  // No exception may pass through libpng.
    }

    png_structp png_;
    png_infop info_;
    std::vector<std::byte> bytes_;
    std::exception_ptr failure_;
    std::array<char, 64> message_;
};

}  // namespace

std::vector<std::byte> encode_png(const Picture& picture, const LongCall& call) {
    RIMLINE_CHECK(picture.rgba.size() == std::size_t{4} * picture.width * picture.height);
    PngWriter writer;
    writer.run([&](png_structp png, png_infop info) {
        png_set_IHDR(png, info, picture.width, picture.height, 8,
                     picture.has_alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                     PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
        png_write_info(png, info);
        if (!picture.has_alpha) png_set_filler(png, 0, PNG_FILLER_AFTER);  // Leaves out alpha.
    });
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        call.checkpoint(double(y) / picture.height);
        const std::uint8_t* row = &picture.rgba[std::size_t{4} * picture.width * y];
        writer.run([&](png_structp png, png_infop) { png_write_row(png, row); });
    }
    writer.run([](png_structp png, png_infop info) { png_write_end(png, info); });
    call.checkpoint(1.0);
    return std::move(writer.bytes());
}

Picture decode_png(std::span<const std::byte> bytes) {
    check_png_is_whole(bytes);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0)
        refuse_png(image.message);
    Picture picture{image.width, image.height, {}};
    picture.has_alpha = (image.format & PNG_FORMAT_FLAG_ALPHA) != 0;
    if (std::uint64_t{image.width} * image.height > k_max_decoded_pixels) {
        png_image_free(&image);
        refuse_png("more than 2^28 pixels");
    }
    image.format = PNG_FORMAT_RGBA;
    try {
        picture.rgba.resize(PNG_IMAGE_SIZE(image));
    } catch (...) {
        png_image_free(&image);
        throw;
    }
    // Frees what it holds, also where it fails.
    if (png_image_finish_read(&image, nullptr, picture.rgba.data(), 0, nullptr) == 0)
        refuse_png(image.message);
    return picture;
}

}  // namespace rimline
