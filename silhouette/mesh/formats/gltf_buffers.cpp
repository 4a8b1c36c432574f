#include "silhouette/mesh/formats/gltf_buffers.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace rimline {

namespace {

constexpr std::string_view k_data_scheme = "data:";

// A buffer's URI, and the beginning of its error messages.
struct BufferUri {
    const SourceFile& file;
    std::size_t number;
    std::string_view uri;

    std::string place() const { return "buffers[" + std::to_string(number) + "]: "; }
    [[noreturn]] void fail(const std::string& what) const { bad_file(file.name, place() + what); }

    // Decodes escapes such as %20.
    std::string unescaped(std::string_view text) const {
        const auto digit = [&](std::size_t at) {
            const char c = at < text.size() ? text[at] : '\0';
            if (c >= '0' && c <= '9') return c - '0';
            if (c >= 'a' && c <= 'f') return c - 'a' + 10;
            if (c >= 'A' && c <= 'F') return c - 'A' + 10;
            fail("uri " + excerpt(uri) + " has a bad escape");
        };
        std::string bytes;
        bytes.reserve(text.size());
        for (std::size_t at = 0; at < text.size(); ++at) {
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
    std::string from_base64(std::string_view text) const {
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
        for (const char c : digits) {
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

    std::string embedded() const {
        const std::size_t comma = uri.find(',');
        if (comma == std::string_view::npos)
            fail("uri " + excerpt(uri) + " is a data URI without a comma");
        const std::string bytes = unescaped(uri.substr(comma + 1));
        return uri.substr(0, comma).ends_with(";base64") ? from_base64(bytes) : bytes;
    }

    /// Below the document's folder, without "..".
    std::filesystem::path relative_path() const {
        if (uri.size() > 4096) fail("uri is longer than a path can be");
        const std::filesystem::path relative = unescaped(uri);
        const bool leaves = std::any_of(relative.begin(), relative.end(), [](const auto& part) {
            return part == ".." || part.string().find('\0') != std::string::npos;
        });
        if (relative.is_absolute() || leaves || uri.find(':') != std::string_view::npos)
            fail("uri " + excerpt(uri) + " does not name a file beside this one");
        return relative;
    }

    std::string beside(const std::filesystem::path& relative, const std::stop_token& stop) const {
        try {
            return read_source_file(file.folder / relative, {stop, {}}).bytes;
        } catch (const Error& e) {
            if (e.code() == ErrorCode::cancelled) throw;
            throw Error(e.code(), file.name + ": " + place() + e.what());
        }
    }
};

}  // namespace

GltfBuffers::GltfBuffers(const SourceFile& file, const std::vector<GltfBuffer>& buffers,
                         std::string_view binary_chunk, const std::stop_token& stop) {
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const GltfBuffer& buffer = buffers[i];
        const BufferUri source{file, i, buffer.uri};
        if (buffer.size_bytes == 0) source.fail("byteLength is 0");
        std::string_view bytes;
        std::string name = "the binary chunk";
        if (!buffer.uri.empty()) {
            name = excerpt(buffer.uri);
            if (buffer.uri.starts_with(k_data_scheme)) {
                bytes = embedded_.emplace_back(source.embedded());
                bytes_read_ += bytes.size();
            } else {
                const std::filesystem::path path = source.relative_path();
                // Without "..", a path and its normal form name the same file.
                const auto [found, is_new] = files_.try_emplace(path.lexically_normal());
                if (is_new) {
                    found->second = source.beside(path, stop);
                    bytes_read_ += found->second.size();
                }
                bytes = found->second;
            }
        } else if (i == 0 && binary_chunk.data() != nullptr) {
            bytes = binary_chunk;
        } else {
            bytes_.emplace_back();
            continue;
        }
        if (bytes.size() < buffer.size_bytes)
            source.fail("byteLength is " + std::to_string(buffer.size_bytes) + " but " + name +
                        " has only " + std::to_string(bytes.size()) + " bytes");
        bytes_.push_back(bytes.substr(0, buffer.size_bytes));
    }
}

}  // namespace rimline
