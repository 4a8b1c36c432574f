#include "silhouette/mesh/formats/byte_scanner.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

namespace {

template <typename T>
double load(const char* bytes, std::endian order) noexcept {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes, sizeof(T));
    if (order != std::endian::native) std::reverse(raw.begin(), raw.end());
    return static_cast<double>(std::bit_cast<T>(raw));
}

}  // namespace

double load_scalar(const char* bytes, ScalarType type, std::endian order) noexcept {
    switch (type) {
        case ScalarType::int8: return load<std::int8_t>(bytes, order);
        case ScalarType::uint8: return load<std::uint8_t>(bytes, order);
        case ScalarType::int16: return load<std::int16_t>(bytes, order);
        case ScalarType::uint16: return load<std::uint16_t>(bytes, order);
        case ScalarType::int32: return load<std::int32_t>(bytes, order);
        case ScalarType::uint32: return load<std::uint32_t>(bytes, order);
        case ScalarType::float32: return load<float>(bytes, order);
        case ScalarType::float64: return load<double>(bytes, order);
    }
    return 0.0;
}

float ByteScanner::coordinate(ScalarType type, const char* what, BadPoints bad) {
    const std::size_t place = at_;
    const double value = number(type, what);
    if (!std::isfinite(value) && bad == BadPoints::keep) return static_cast<float>(value);
    // Compared in double, because conversion of values beyond float's range is undefined.
    if (!(std::abs(value) <= static_cast<double>(k_max_coordinate)))
        bad_byte(name_, place,
                 std::string(what) + " is " +
                     (std::isfinite(value) ? "beyond 2^60 in size; scale the model down"
                                           : "not a finite number"));
    return static_cast<float>(value);
}

std::int64_t ByteScanner::integer(ScalarType type, const char* what) {
    const std::size_t place = at_;
    const double value = number(type, what);
    if (!(std::abs(value) <= 0x1p53) || value != std::floor(value))
        bad_byte(name_, place, std::string(what) + " is not an integer");
    return static_cast<std::int64_t>(value);
}

void ByteScanner::fail_truncated(const char* what) const {
    fail("the file ends, at " + std::to_string(bytes_.size()) + " bytes, within " + what +
         "; it is truncated or its counts are wrong");
}

}  // namespace rimline
