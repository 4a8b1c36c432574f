// decode_jpeg(), with libjpeg.

#include <cstdio>
// After <cstdio>: it uses FILE.
#include <jpeglib.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <string>

#include "silhouette/error.h"
#include "silhouette/picture.h"

namespace rimline {

namespace {

[[noreturn]] void refuse_jpeg(const std::string& why) {
    throw Error(ErrorCode::bad_input, "JPEG: " + why);
}

// A small file can hold any number of scans over a large picture. Encoders write about ten.
constexpr int k_max_scans = 100;

// libjpeg reports an error by a call that must not return. It jumps: libjpeg is C, which exceptions cannot pass.
struct Decoder {
    jpeg_decompress_struct state{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf on_error{};
    std::array<char, JMSG_LENGTH_MAX> message{};

    static Decoder& of(j_common_ptr state) { return *static_cast<Decoder*>(state->client_data); }
    [[noreturn]] static void fail(j_common_ptr state) {
        Decoder& decoder = of(state);
        state->err->format_message(state, decoder.message.data());
        std::longjmp(decoder.on_error, 1);
    }
    // A warning (level -1) is about damaged or missing data.
    static void warn(j_common_ptr state, int level) {
        if (level < 0) fail(state);
    }
    static void check_scans(j_common_ptr state) {
        Decoder& decoder = of(state);
        if (decoder.state.input_scan_number <= k_max_scans) return;
        std::snprintf(decoder.message.data(), decoder.message.size(), "more than %d scans",
                      k_max_scans);
        std::longjmp(decoder.on_error, 1);
    }

    Decoder() {
        state.err = jpeg_std_error(&errors);
        state.client_data = this;
        errors.error_exit = fail;
        errors.emit_message = warn;
        progress.progress_monitor = check_scans;
    }
    ~Decoder() { jpeg_destroy_decompress(&state); }
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
};

// These two hold no object with a destructor, since errors jump out of them. Both return false on errors.
bool read_header(Decoder& decoder, std::span<const std::byte> bytes) {
    if (setjmp(decoder.on_error) != 0) return false;
    jpeg_create_decompress(&decoder.state);
    decoder.state.progress = &decoder.progress;
    jpeg_mem_src(&decoder.state, reinterpret_cast<const unsigned char*>(bytes.data()),
                 static_cast<unsigned long>(bytes.size()));
    jpeg_read_header(&decoder.state, TRUE);
    return true;
}

bool read_rows(Decoder& decoder, std::uint8_t* rows) {
    if (setjmp(decoder.on_error) != 0) return false;
    jpeg_decompress_struct& state = decoder.state;
    jpeg_start_decompress(&state);
    while (state.output_scanline < state.output_height) {
        JSAMPROW row = rows + std::size_t{4} * state.output_width * state.output_scanline;
        jpeg_read_scanlines(&state, &row, 1);
    }
    jpeg_finish_decompress(&state);
    return true;
}

// Adobe's CMYK is stored inverted: 255 is no ink.
void convert_from_cmyk(Picture& picture, bool is_inverted) {
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        std::uint8_t* pixel = &picture.rgba[i];
        const int key = is_inverted ? pixel[3] : 255 - pixel[3];
        for (int c = 0; c < 3; ++c)
            pixel[c] = static_cast<std::uint8_t>(
                ((is_inverted ? pixel[c] : 255 - pixel[c]) * key + 127) / 255);
        pixel[3] = 255;
    }
}

}  // namespace

Picture decode_jpeg(std::span<const std::byte> bytes) {
    if (bytes.empty()) refuse_jpeg("empty");
    Decoder decoder;
    const auto refuse = [&] { refuse_jpeg(decoder.message.data()); };
    if (!read_header(decoder, bytes)) refuse();
    jpeg_decompress_struct& state = decoder.state;
    if (std::uint64_t{state.image_width} * state.image_height > k_max_decoded_pixels)
        refuse_jpeg("more than 2^28 pixels");
    const bool is_cmyk = state.jpeg_color_space == JCS_CMYK || state.jpeg_color_space == JCS_YCCK;
    state.out_color_space = is_cmyk ? JCS_CMYK : JCS_EXT_RGBA;
    Picture picture{state.image_width, state.image_height, {}};
    picture.rgba.resize(std::size_t{4} * picture.width * picture.height);
    if (!read_rows(decoder, picture.rgba.data())) refuse();
    if (is_cmyk) convert_from_cmyk(picture, state.saw_Adobe_marker != 0);
    return picture;
}

Picture decode_picture(std::span<const std::byte> bytes) {
    constexpr std::array k_jpeg{std::byte{0xff}, std::byte{0xd8}, std::byte{0xff}};
    if (std::ranges::equal(bytes.first(std::min(bytes.size(), k_jpeg.size())), k_jpeg))
        return decode_jpeg(bytes);
    constexpr std::array k_png{std::byte{0x89}, std::byte{'P'}, std::byte{'N'}, std::byte{'G'}};
    if (std::ranges::equal(bytes.first(std::min(bytes.size(), k_png.size())), k_png))
        return decode_png(bytes);
    throw Error(ErrorCode::bad_input, "neither a PNG nor a JPEG file");
}

}  // namespace rimline
