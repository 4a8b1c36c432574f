#include "silhouette/mesh/formats/gltf_uri.h"
#include "silhouette/printable_text.h"

#include <algorithm>
#include <cstdint>

namespace rimline {

void GltfUri::fail(const std::string& what) const { bad_file(file.name, place + ": " + what); }

// Decodes escapes such as %20.
std::string GltfUri::unescaped(std::string_view text, const std::stop_token& stop) const {
    const auto digit = [&](std::size_t at) {
        const char c = at < text.size() ? text[at] : '\0';
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        if (c >= 'A' && c <= 'F') return c - 'A' + 10;
        fail("uri " + excerpt(uri) + " has a bad escape");
    };
    std::string bytes;
    bytes.reserve(text.size());
    for (std::size_t at = 0, done = 0; at < text.size(); ++at, ++done) {
        if (done % k_checkpoint_interval == 0) LongCall{stop, {}}.checkpoint(0.0);
        if (text[at] != '%') {
            bytes += text[at];
            continue;
        }
        bytes += static_cast<char>(digit(at + 1) * 16 + digit(at + 2));
        at += 2;
    }
    return bytes;
}

// With or without padding to a multiple of four: exporters write both.
std::string GltfUri::from_base64(std::string_view text, const std::stop_token& stop) const {
    const auto bad = [&](const std::string& what) {
        fail("the base64 of uri " + excerpt(uri) + " " + what);
    };
    std::string_view digits = text;
    for (int i = 0; i < 2 && text.size() % 4 == 0 && digits.ends_with('='); ++i)
        digits.remove_suffix(1);
    if (digits.size() % 4 == 1) bad("ends within a byte");
    std::string bytes;
    bytes.reserve(digits.size() / 4 * 3 + 2);
    std::uint32_t group = 0;
    int bits = 0;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i % k_checkpoint_interval == 0) LongCall{stop, {}}.checkpoint(0.0);
        const char c = digits[i];
        std::uint32_t value = 0;
        if (c >= 'A' && c <= 'Z')
            value = static_cast<std::uint32_t>(c - 'A');
        else if (c >= 'a' && c <= 'z')
            value = static_cast<std::uint32_t>(c - 'a') + 26;
        else if (c >= '0' && c <= '9')
            value = static_cast<std::uint32_t>(c - '0') + 52;
        else if (c == '+' || c == '/')
            value = c == '+' ? 62 : 63;
        else
            bad("holds " + excerpt(std::string_view(&c, 1)) + ", which is no digit of it");
        group = (group << 6 | value) & 0xffff;
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += static_cast<char>(static_cast<unsigned char>(group >> bits));
    }
    return bytes;
}

std::string GltfUri::data(const std::stop_token& stop) const {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos)
        fail("uri " + excerpt(uri) + " is a data URI without a comma");
    const std::string_view text = uri.substr(comma + 1);
    const bool is_base64 = uri.substr(0, comma).ends_with(";base64");
    if (is_base64 && text.find('%') == std::string_view::npos) return from_base64(text, stop);
    const std::string bytes = unescaped(text, stop);
    return is_base64 ? from_base64(bytes, stop) : bytes;
}

std::filesystem::path GltfUri::relative_path() const {
    if (uri.size() > 4096) fail("uri is longer than a path can be");
    const std::filesystem::path relative = unescaped(uri, {});
    const bool leaves = std::any_of(relative.begin(), relative.end(), [](const auto& part) {
        return part == ".." || part.string().find('\0') != std::string::npos;
    });
    if (relative.is_absolute() || leaves || uri.find(':') != std::string_view::npos)
        fail("uri " + excerpt(uri) + " does not name a file beside this one");
    return relative;
}

std::string GltfUri::read_file(const std::filesystem::path& relative,
                               const std::stop_token& stop) const {
    try {
        return read_source_file(file.folder / relative, {stop, {}}).bytes;
    } catch (const Error& e) {
        if (e.code() == ErrorCode::cancelled) throw;
        throw Error(e.code(), file.name + ": " + place + ": " + printable_text(e.what()));
    }
}

}  // namespace rimline
