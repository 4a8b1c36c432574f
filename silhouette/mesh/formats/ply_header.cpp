#include "silhouette/mesh/formats/ply_header.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/formats/text_scanner.h"

namespace rimline {

namespace {

ScalarType scalar_type(const TextScanner& scanner, std::string_view token) {
    constexpr std::array<std::pair<std::string_view, ScalarType>, 16> k_names{{
        {"char", ScalarType::int8},
        {"int8", ScalarType::int8},
        {"uchar", ScalarType::uint8},
        {"uint8", ScalarType::uint8},
        {"short", ScalarType::int16},
        {"int16", ScalarType::int16},
        {"ushort", ScalarType::uint16},
        {"uint16", ScalarType::uint16},
        {"int", ScalarType::int32},
        {"int32", ScalarType::int32},
        {"uint", ScalarType::uint32},
        {"uint32", ScalarType::uint32},
        {"float", ScalarType::float32},
        {"float32", ScalarType::float32},
        {"double", ScalarType::float64},
        {"float64", ScalarType::float64},
    }};
    for (const auto& [name, type] : k_names)
        if (token == name) return type;
    scanner.fail(excerpt(token) +
                 " is not a property type; PLY has char, uchar, short, ushort, int, "
                 "uint, float and double");
}

PlyProperty read_property(TextScanner& scanner) {
    PlyProperty property{};
    const std::string_view type = scanner.token();
    if (type == "list") {
        property.count_type = scalar_type(scanner, scanner.token());
        if (*property.count_type == ScalarType::float32 ||
            *property.count_type == ScalarType::float64)
            scanner.fail("a list's count has a floating-point type; it must be an integer type");
        property.type = scalar_type(scanner, scanner.token());
    } else {
        property.type = scalar_type(scanner, type);
    }
    property.name = scanner.token();
    if (property.name.empty()) scanner.fail("the property has no name");
    scanner.expect_end_of_line("the property's name");
    return property;
}

PlyElement read_element(TextScanner& scanner) {
    PlyElement element{};
    element.line = scanner.line();
    element.name = scanner.token();
    const std::int64_t count = scanner.integer("the element's count");
    if (count < 0) scanner.fail("the element's count is negative");
    element.count = static_cast<std::uint64_t>(count);
    scanner.expect_end_of_line("the element's count");
    return element;
}

PlyEncoding read_encoding(TextScanner& scanner) {
    const std::string_view name = scanner.token();
    PlyEncoding encoding{};
    if (name == "ascii")
        encoding = PlyEncoding::ascii;
    else if (name == "binary_little_endian")
        encoding = PlyEncoding::binary_little_endian;
    else if (name == "binary_big_endian")
        encoding = PlyEncoding::binary_big_endian;
    else
        scanner.fail(excerpt(name) +
                     " is not a PLY format; there are ascii, binary_little_endian and "
                     "binary_big_endian");
    if (const std::string_view version = scanner.token(); version != "1.0")
        scanner.fail("PLY version " + excerpt(version) + " is unknown; only 1.0 is");
    scanner.expect_end_of_line("the version");
    return encoding;
}

// The names declared so far. A tree, not a hash table, so no choice of names makes it slow.
using Names = std::set<std::string>;

void add_name(const TextScanner& scanner, Names& names, const char* kind, const std::string& name) {
    if (!names.insert(name).second)
        scanner.fail(std::string(kind) + " " + excerpt(name) + " is declared twice");
}

// No element may declare more bytes than the file has. The file size then bounds the memory reserved
// for it.
void check_counts(const SourceFile& file, const PlyHeader& header) {
    std::uint64_t left = file.bytes.size() - header.body_offset;
    if (header.encoding == PlyEncoding::ascii) ++left;  // The last line may lack its end.
    for (const PlyElement& element : header.elements) {
        // In text a value takes at least a digit and a separator.
        const std::size_t size = header.encoding == PlyEncoding::ascii
                                     ? 2 * element.properties.size()
                                     : element.min_binary_size();
        if (size == 0) continue;
        if (element.count > left / size)
            bad_line(file.name, element.line,
                     std::to_string(element.count) + " elements " + excerpt(element.name) +
                         " are declared, more than the rest of the file can hold; it is truncated "
                         "or the count is wrong");
        left -= element.count * size;
    }
}

}  // namespace

bool PlyElement::has_lists() const noexcept {
    return std::any_of(properties.begin(), properties.end(),
                       [](const PlyProperty& p) { return p.is_list(); });
}

std::size_t PlyElement::min_binary_size() const noexcept {
    std::size_t size = 0;
    for (const PlyProperty& p : properties) size += size_bytes(p.count_type.value_or(p.type));
    return size;
}

std::optional<std::size_t> PlyElement::find(std::string_view property) const noexcept {
    for (std::size_t i = 0; i < properties.size(); ++i)
        if (properties[i].name == property) return i;
    return std::nullopt;
}

std::optional<std::array<std::size_t, 3>> PlyElement::find_color() const noexcept {
    using Triple = std::array<const char*, 3>;
    constexpr std::array<Triple, 3> k_triples{
        Triple{"red", "green", "blue"}, Triple{"diffuse_red", "diffuse_green", "diffuse_blue"},
        Triple{"r", "g", "b"}};
    for (const Triple& triple : k_triples) {
        std::array<std::size_t, 3> found{};
        std::size_t channels = 0;
        for (const char* channel : triple)
            if (const auto p = find(channel); p && !properties[*p].is_list())
                found[channels++] = *p;
        if (channels == 3) return found;
    }
    return std::nullopt;
}

std::size_t PlyElement::require_value(const SourceFile& file, std::string_view property) const {
    const std::optional<std::size_t> i = find(property);
    if (!i || properties[*i].is_list())
        bad_line(file.name, line,
                 "element " + excerpt(name) + " has no property " + excerpt(property));
    return *i;
}

const PlyElement* PlyHeader::find(std::string_view element) const noexcept {
    for (const PlyElement& e : elements)
        if (e.name == element) return &e;
    return nullptr;
}

const PlyElement& PlyHeader::vertices(const SourceFile& file) const {
    const PlyElement* vertices = find("vertex");
    if (!vertices) bad_line(file.name, body_line - 1, "the header declares no 'vertex'");
    if (vertices->count > k_max_file_vertices)
        throw Error(ErrorCode::too_large, file.name + ": more than 2^32 vertices");
    return *vertices;
}

PlyHeader read_ply_header(const SourceFile& file, const LongCall& call) {
    PlyHeader header{};
    const std::string_view bytes = file.text();
    TextScanner scanner(file.name, bytes);
    scanner.expect_line("'ply'");
    if (scanner.token() != "ply") scanner.fail("a PLY file begins with a line 'ply'");
    scanner.expect_end_of_line("'ply'");
    // If lines end with a single CR, a line feed after the CR of end_header is the first byte of the
    // data.
    const std::size_t newline = bytes.find_first_of("\r\n");
    const bool bare_cr = newline != std::string_view::npos && bytes[newline] == '\r' &&
                         newline + 1 < bytes.size() && bytes[newline + 1] != '\n';

    bool has_format = false;
    Names element_names;
    Names property_names;  // Of the last element.
    for (std::uint64_t i = 0;; ++i) {
        // The share must not exceed the body's first share.
        if (i % k_checkpoint_interval == 0) parse_checkpoint(call, 0.0);
        scanner.expect_line("the rest of the header, up to 'end_header',");
        const std::string_view keyword = scanner.token();
        if (keyword == "comment" || keyword == "obj_info") continue;
        if (keyword == "format") {
            if (has_format) scanner.fail("the format is declared twice");
            header.encoding = read_encoding(scanner);
            has_format = true;
        } else if (keyword == "element") {
            header.elements.push_back(read_element(scanner));
            add_name(scanner, element_names, "element", header.elements.back().name);
            property_names.clear();
        } else if (keyword == "property") {
            if (header.elements.empty()) scanner.fail("a property before any element");
            PlyElement& element = header.elements.back();
            element.properties.push_back(read_property(scanner));
            add_name(scanner, property_names, "property", element.properties.back().name);
        } else if (keyword == "end_header") {
            scanner.expect_end_of_line("'end_header'");
            break;
        } else {
            scanner.fail(excerpt(keyword) +
                         " is no word of a PLY header; 'end_header' may be missing");
        }
    }
    if (!has_format) scanner.fail("the header declares no format");
    if (bare_cr) {
        header.body_offset = std::min(scanner.offset() + 1, bytes.size());
    } else {
        scanner.skip_line();
        header.body_offset = scanner.offset();
    }
    header.body_offset += file.text_begin;
    header.body_line = scanner.line() + 1;
    check_counts(file, header);
    return header;
}

}  // namespace rimline
