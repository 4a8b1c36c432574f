// STL: separate triangles. The corners of facet f are vertices 3f, 3f + 1 and 3f + 2.
//
// Binary: 80 arbitrary bytes, a facet count, then 50 bytes per facet: normal, three corners, two more
// bytes, which may hold its color (stl_colors.h). Text: `solid`, facets in words, `endsolid`, any number of times. The
// normals are not used, because the order of the corners defines them. Degenerate facets often have NaN normals.

#include <limits>

#include "silhouette/mesh/formats/byte_scanner.h"
#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/formats/stl_colors.h"
#include "silhouette/mesh/formats/text_scanner.h"

namespace rimline {

namespace {

constexpr std::size_t k_header_bytes = 80;
constexpr std::size_t k_facet_bytes = 50;

void expect_word(TextScanner& scanner, std::string_view word) {
    const std::string_view found = scanner.word();
    if (equals_ignoring_case(found, word)) return;
    const std::string expected = "where '" + std::string(word) + "' should stand";
    if (found.empty()) scanner.fail("the file ends " + expected);
    scanner.fail(excerpt(found) + " " + expected);
}

void add_facet(MeshSource& source) {
    const auto first = static_cast<std::uint32_t>(source.positions.size() - 3);
    source.triangles.push_back({first, first + 1, first + 2});
}

// After the word `facet`.
void read_facet(TextScanner& scanner, BadPoints bad, MeshSource& source) {
    expect_word(scanner, "normal");
    for (int i = 0; i < 3; ++i) scanner.skip_number(scanner.word(), "a normal's component");
    expect_word(scanner, "outer");
    expect_word(scanner, "loop");
    for (int corner = 0; corner < 3; ++corner) {
        expect_word(scanner, "vertex");
        glm::vec3 position;
        for (int axis = 0; axis < 3; ++axis)
            position[axis] = scanner.coordinate(scanner.word(), "a vertex's coordinate", bad);
        source.positions.push_back(position);
    }
    expect_word(scanner, "endloop");
    expect_word(scanner, "endfacet");
    add_facet(source);
}

}  // namespace

MeshSource read_stl_text(const SourceFile& file, BadPoints bad, const LongCall& call) {
    MeshSource source;
    source.up = UpAxis::z;
    source.is_up_known = true;
    TextScanner scanner(file.name, file.text());
    for (bool first = true;; first = false) {
        const std::string_view word = scanner.word();
        if (word.empty() && !first) break;
        if (!equals_ignoring_case(word, "solid"))
            scanner.fail(excerpt(word) + " where 'solid' should stand");
        scanner.skip_line();  // Its name.
        for (;;) {
            const std::string_view inner = scanner.word();
            if (equals_ignoring_case(inner, "endsolid")) break;
            if (inner.empty()) scanner.fail("the file ends before 'endsolid'; it is truncated");
            if (!equals_ignoring_case(inner, "facet"))
                scanner.fail(excerpt(inner) + " where 'facet' or 'endsolid' should stand");
            if (source.positions.size() > k_max_file_vertices - 3)
                throw Error(ErrorCode::too_large, file.name + ": more than 2^32 vertices");
            read_facet(scanner, bad, source);
            if (source.triangles.size() % k_checkpoint_interval == 0)
                parse_checkpoint(call, scanner.share());
        }
        scanner.skip_line();
    }
    return source;
}

MeshSource read_stl_binary(const SourceFile& file, BadPoints bad, const LongCall& call) {
    MeshSource source;
    source.up = UpAxis::z;
    source.is_up_known = true;
    const std::size_t size = file.bytes.size();
    if (size < k_header_bytes + 4)
        bad_byte(file.name, size,
                 "the file ends before the facet count at byte 80; it is truncated or not STL");
    ByteScanner scanner(file.name, file.bytes, k_header_bytes, std::endian::little);
    const auto count =
        static_cast<std::uint64_t>(scanner.integer(ScalarType::uint32, "the facet count"));
    const std::uint64_t facets_bytes = count * k_facet_bytes;
    // Refused: some programs write more facets than they count, others data of their own. Readers that take such files
    // disagree on what is in them.
    if (facets_bytes < scanner.remaining())
        bad_byte(file.name, k_header_bytes + 4 + facets_bytes,
                 std::to_string(count) + " facets are declared, and too many bytes follow them: " +
                     std::to_string(scanner.remaining() - facets_bytes) +
                     "; the file is damaged or not STL");
    if (facets_bytes != scanner.remaining())
        bad_byte(file.name, k_header_bytes,
                 std::to_string(count) + " facets are declared, which take " +
                     std::to_string(k_header_bytes + 4 + facets_bytes) + " bytes; the file has " +
                     std::to_string(size) + " and is truncated, damaged or not STL");
    if (3 * count > k_max_file_vertices)
        throw Error(ErrorCode::too_large, file.name + ": more than 2^32 vertices");
    source.positions.reserve(3 * count);
    source.triangles.reserve(count);
    std::vector<std::uint16_t> attributes;
    attributes.reserve(count);
    for (std::uint64_t facet = 0; facet < count; ++facet) {
        if (facet % k_checkpoint_interval == 0) parse_checkpoint(call, scanner.share());
        scanner.skip(1, 12, "a facet's normal");
        for (int corner = 0; corner < 3; ++corner) {
            glm::vec3 position;
            for (int axis = 0; axis < 3; ++axis)
                position[axis] =
                    scanner.coordinate(ScalarType::float32, "a vertex's coordinate", bad);
            source.positions.push_back(position);
        }
        attributes.push_back(static_cast<std::uint16_t>(
            scanner.integer(ScalarType::uint16, "a facet's attributes")));
        add_facet(source);
    }
    const StlColors colors =
        stl_colors(std::string_view(file.bytes).substr(0, k_header_bytes), attributes, call.stop);
    if (!colors.warning.empty()) add_warning(source.warnings, file.name + ": " + colors.warning);
    color_vertices_and_triangles(source, {}, colors.colors, call.stop);
    return source;
}

}  // namespace rimline
