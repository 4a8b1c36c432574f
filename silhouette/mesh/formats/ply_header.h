#pragma once

// What a PLY file's header declares: elements in order, each with its count and properties.

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
    ScalarType type;                       ///< Of the value, or of a list's items.
    std::optional<ScalarType> count_type;  ///< Of a list's count; nothing for a single value.
    bool is_list() const noexcept { return count_type.has_value(); }
};

struct PlyElement {
    std::string name;
    std::uint64_t count;
    std::uint64_t line;  ///< Where the header declares it.
    std::vector<PlyProperty> properties;

    bool has_lists() const noexcept;
    /// Bytes of one element in a binary file, lists counted as empty.
    std::size_t min_binary_size() const noexcept;
    /// The property of that name, or nothing.
    std::optional<std::size_t> find(std::string_view property) const noexcept;
    /// The property of that name; throws Error{bad_input} where there is none or it is a list.
    std::size_t require_value(const SourceFile& file, std::string_view property) const;
};

enum class PlyEncoding : std::uint8_t { ascii, binary_little_endian, binary_big_endian };

struct PlyHeader {
    PlyEncoding encoding;
    std::vector<PlyElement> elements;
    std::size_t body_offset;  ///< Where the first element's data begins.
    std::uint64_t body_line;  ///< The number of the line that begins there.

    const PlyElement* find(std::string_view element) const noexcept;
    /// The element 'vertex'. Throws Error{bad_input} where there is none, Error{too_large} where it has
    /// more than k_max_file_vertices.
    const PlyElement& vertices(const SourceFile& file) const;
};

/// Throws Error{bad_input} with the line of what is wrong, including counts that the bytes after the
/// header cannot hold; Error{cancelled} where `call` is to stop. Cost: O(header), times the logarithm of
/// how many names it holds.
PlyHeader read_ply_header(const SourceFile& file, const LongCall& call);

}  // namespace rimline
