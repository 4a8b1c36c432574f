#pragma once

// The content of a PLY file's header: elements in order, each with its count and properties.

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "silhouette/mesh/formats/byte_scanner.h"
#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

struct PlyProperty {
    std::string name;
    ScalarType type;                       ///< Type of the value, or of a list's items.
    std::optional<ScalarType> count_type;  ///< Type of a list's count. Empty for a single value.
    bool is_list() const noexcept { return count_type.has_value(); }
};

struct PlyElement {
    std::string name;
    std::uint64_t count;
    std::uint64_t line;  ///< The header's line that declares it.
    std::vector<PlyProperty> properties;

    bool has_lists() const noexcept;
    /// Bytes of one element in a binary file with all lists empty.
    std::size_t min_binary_size() const noexcept;
    /// The property of that name, or nothing.
    std::optional<std::size_t> find(std::string_view property) const noexcept;
    /// The properties of red, green and blue, or nothing if no triple is complete: red, green, blue, otherwise
    /// diffuse_red, diffuse_green, diffuse_blue, otherwise r, g, b.
    std::optional<std::array<std::size_t, 3>> find_color() const noexcept;
    /// The property of that name. Throws Error{bad_input} if there is none or it is a list.
    std::size_t require_value(const SourceFile& file, std::string_view property) const;
};

enum class PlyEncoding : std::uint8_t { ascii, binary_little_endian, binary_big_endian };

struct PlyHeader {
    PlyEncoding encoding;
    std::vector<PlyElement> elements;
    std::size_t body_offset;  ///< Offset of the first element's data.
    std::uint64_t body_line;  ///< Number of the line at `body_offset`.

    const PlyElement* find(std::string_view element) const noexcept;
    /// The element 'vertex'. Throws Error{bad_input} if there is none, and Error{too_large} if it has
    /// more than k_max_file_vertices.
    const PlyElement& vertices(const SourceFile& file) const;
};

/// Throws Error{bad_input} with the line of the fault, also for counts that are too large for the bytes
/// after the header. Throws Error{cancelled} if `call` is stopped. Cost: O(n log m) for a header of n
/// bytes with m names.
PlyHeader read_ply_header(const SourceFile& file, const LongCall& call);

}  // namespace rimline
