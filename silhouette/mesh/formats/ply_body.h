#pragma once

// Reads the elements of a PLY file's body in order. The text and binary encodings have the same
// operations. Unused elements and properties are skipped. An element of a text file is one line.

#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "silhouette/mesh/formats/byte_scanner.h"
#include "silhouette/mesh/formats/ply_header.h"
#include "silhouette/mesh/formats/text_scanner.h"

namespace rimline {

constexpr bool is_floating(ScalarType type) noexcept {
    return type == ScalarType::float32 || type == ScalarType::float64;
}

/// Scales a color of this type to [0, 255].
constexpr float color_scale(ScalarType type) noexcept {
    if (is_floating(type)) return 255.0f;
    return type == ScalarType::uint16 ? 255.0f / 65535.0f : 1.0f;
}

// The minimum and maximum value of a type. A floating-point type, which occurs only for indices,
// has no limit here.
constexpr std::pair<std::int64_t, std::int64_t> range_of(ScalarType type) noexcept {
    switch (type) {
        case ScalarType::int8: return {-0x80, 0x7f};
        case ScalarType::uint8: return {0, 0xff};
        case ScalarType::int16: return {-0x8000, 0x7fff};
        case ScalarType::uint16: return {0, 0xffff};
        case ScalarType::int32: return {-0x80000000ll, 0x7fffffff};
        case ScalarType::uint32: return {0, 0xffffffffll};
        case ScalarType::float32:
        case ScalarType::float64: break;
    }
    return {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()};
}

class PlyTextBody {
public:
    PlyTextBody(const SourceFile& file, const PlyHeader& header)
        : scanner_(file.name, std::string_view(file.bytes).substr(header.body_offset), {},
                   header.body_line) {}

    void begin_element(const char* what) { scanner_.expect_line(what); }
    void end_element(const char* what) { scanner_.expect_end_of_line(what); }
    float coordinate(ScalarType type, const char* what) {
        if (is_floating(type)) return scanner_.coordinate(what);
        return static_cast<float>(integer(type, what));
    }
    /// Any number, including NaN and infinities.
    double number(ScalarType type, const char* what) {
        if (is_floating(type)) return scanner_.number(what);
        return static_cast<double>(integer(type, what));
    }
    std::int64_t integer(ScalarType type, const char* what) {
        const std::int64_t value = scanner_.integer(what);
        if (const auto [min, max] = range_of(type); value < min || value > max)
            scanner_.fail(std::string(what) + " is " + std::to_string(value) +
                          ", which its declared type cannot hold; that goes from " +
                          std::to_string(min) + " to " + std::to_string(max));
        return value;
    }
    void skip(ScalarType type, std::uint64_t count, const char* what) {
        for (std::uint64_t i = 0; i < count; ++i) {
            if (is_floating(type))
                scanner_.skip_number(what);
            else
                integer(type, what);
        }
    }
    /// Whether the rest of the file could hold `count` values.
    bool could_hold(std::uint64_t count, ScalarType) const noexcept {
        return count <= scanner_.remaining() / 2 + 1;
    }
    void expect_end() {
        if (scanner_.next_line())
            scanner_.fail(
                "there is more after the last element; a count in the header is too small");
    }
    double share() const noexcept { return scanner_.share(); }
    [[noreturn]] void fail(const std::string& what) const { scanner_.fail(what); }
    /// Throws an error that names the place where the element begins.
    [[noreturn]] void fail_element(const std::string& what) const { scanner_.fail(what); }

private:
    TextScanner scanner_;
};

class PlyBinaryBody {
public:
    PlyBinaryBody(const SourceFile& file, const PlyHeader& header)
        : name_(file.name),
          bytes_(file.bytes),
          scanner_(file.name, file.bytes, header.body_offset,
                   header.encoding == PlyEncoding::binary_big_endian ? std::endian::big
                                                                     : std::endian::little) {}

    void begin_element(const char*) noexcept { element_ = scanner_.offset(); }
    void end_element(const char*) noexcept {}
    float coordinate(ScalarType type, const char* what) { return scanner_.coordinate(type, what); }
    double number(ScalarType type, const char* what) { return scanner_.number(type, what); }
    std::int64_t integer(ScalarType type, const char* what) { return scanner_.integer(type, what); }
    void skip(ScalarType type, std::uint64_t count, const char* what) {
        scanner_.skip(count, size_bytes(type), what);
    }
    bool could_hold(std::uint64_t count, ScalarType type) const noexcept {
        return count <= scanner_.remaining() / size_bytes(type);
    }
    void expect_end() {
        // Some writers add a line end after the binary data.
        const std::size_t left = scanner_.remaining();
        if (left != 0 && !(left <= 2 && bytes_.ends_with(left == 1 ? "\n" : "\r\n")))
            scanner_.fail(std::to_string(scanner_.remaining()) +
                          " bytes follow the last element; a count in the header is too small, or "
                          "the file went through a text conversion");
    }
    double share() const noexcept { return scanner_.share(); }
    [[noreturn]] void fail(const std::string& what) const { scanner_.fail(what); }
    [[noreturn]] void fail_element(const std::string& what) const {
        bad_byte(name_, element_, what);
    }

private:
    std::string_view name_;
    std::string_view bytes_;
    ByteScanner scanner_;
    std::size_t element_ = 0;
};

/// Iterates over the elements of a body. The constructor's arguments must outlive it.
template <typename Body>
struct PlyElements {
    PlyElements(const SourceFile& file, const PlyHeader& header, const LongCall& long_call)
        : call(long_call), body(file, header) {}

    const LongCall& call;
    Body body;

    /// Call it for every element, with the element's number.
    void checkpoint(std::uint64_t i) {
        if (i % k_checkpoint_interval == 0) parse_checkpoint(call, body.share());
    }

    /// The count of the next list, checked against the remaining bytes.
    std::uint64_t list_count(const PlyProperty& property) {
        const std::int64_t count = body.integer(*property.count_type, "the count of a list");
        if (count < 0) body.fail("the count of a list is negative");
        if (!body.could_hold(static_cast<std::uint64_t>(count), property.type))
            body.fail("a list of " + std::to_string(count) +
                      " is longer than the rest of the file; it is truncated or damaged");
        return static_cast<std::uint64_t>(count);
    }

    void skip_property(const PlyProperty& property) {
        const std::uint64_t count = property.is_list() ? list_count(property) : 1;
        body.skip(property.type, count, "a property's value");
    }

    void skip_elements(const PlyElement& element) {
        if (element.properties.empty()) return;  // They take no bytes and no line.
        for (std::uint64_t i = 0; i < element.count; ++i) {
            checkpoint(i);
            body.begin_element("another element");
            for (const PlyProperty& p : element.properties) skip_property(p);
            body.end_element("an element");
        }
    }
};

}  // namespace rimline
