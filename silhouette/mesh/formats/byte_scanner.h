#pragma once

// The strict scanner of the binary formats. It reads values of a given type and byte order, and
// never reads beyond the end of the bytes.

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "silhouette/mesh/formats/source_file.h"
#include "silhouette/mesh/point_source.h"

namespace rimline {

enum class ScalarType : std::uint8_t {
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    float32,
    float64
};

constexpr std::size_t size_bytes(ScalarType type) noexcept {
    switch (type) {
        case ScalarType::int8:
        case ScalarType::uint8: return 1;
        case ScalarType::int16:
        case ScalarType::uint16: return 2;
        case ScalarType::int32:
        case ScalarType::uint32:
        case ScalarType::float32: return 4;
        case ScalarType::float64: return 8;
    }
    return 0;
}

/// The value at `bytes`, which must hold all its bytes. A double represents every value of every
/// scalar type exactly.
double load_scalar(const char* bytes, ScalarType type, std::endian order) noexcept;

class ByteScanner {
public:
    /// `name` and `bytes` must outlive the scanner. It starts at `offset`, which must be within
    /// `bytes`.
    ByteScanner(std::string_view name, std::string_view bytes, std::size_t offset,
                std::endian order) noexcept
        : name_(name), bytes_(bytes), at_(offset), order_(order) {}

    /// The next value. `what` names it in errors.
    double number(ScalarType type, const char* what) {
        need(size_bytes(type), what);
        const double value = load_scalar(bytes_.data() + at_, type, order_);
        at_ += size_bytes(type);
        return value;
    }
    /// The next value as a coordinate within k_max_coordinate. BadPoints::keep also accepts values
    /// that are not finite.
    float coordinate(ScalarType type, const char* what, BadPoints bad = BadPoints::refuse);
    /// The next value as an integer, from any scalar type.
    std::int64_t integer(ScalarType type, const char* what);
    /// Skips `count` elements of `size` bytes.
    void skip(std::uint64_t count, std::size_t size, const char* what) {
        if (size != 0 && count > remaining() / size) fail_truncated(what);
        at_ += static_cast<std::size_t>(count) * size;
    }

    std::size_t offset() const noexcept { return at_; }
    std::size_t remaining() const noexcept { return bytes_.size() - at_; }
    double share() const noexcept {
        return bytes_.empty() ? 1.0 : static_cast<double>(at_) / static_cast<double>(bytes_.size());
    }
    [[noreturn]] void fail(const std::string& what) const { bad_byte(name_, at_, what); }

private:
    void need(std::size_t size, const char* what) const {
        if (remaining() < size) fail_truncated(what);
    }
    [[noreturn]] void fail_truncated(const char* what) const;

    std::string_view name_;
    std::string_view bytes_;
    std::size_t at_;
    std::endian order_;
};

}  // namespace rimline
