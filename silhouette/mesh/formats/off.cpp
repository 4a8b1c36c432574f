// OFF and its kin: [ST][C][N]OFF, then counts, then a line for each vertex and each face.
//
// A vertex is x y z, with N a normal (3 numbers), with C a colour (3 or 4), with ST a texture
// coordinate (2), in this order. A face is its corner count, its corners and up to four numbers of
// colour. The kinds with a fourth coordinate or n of them, and the binary form, are refused by name.

#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/formats/text_scanner.h"
#include "silhouette/mesh/formats/triangulate.h"

namespace rimline {

namespace {

struct OffKind {
    bool texture = false, colour = false, normal = false;
};

OffKind read_kind(TextScanner& scanner, std::string_view keyword) {
    OffKind kind;
    std::string_view rest = keyword;
    const auto take = [&](std::string_view prefix) {
        if (!rest.starts_with(prefix)) return false;
        rest.remove_prefix(prefix.size());
        return true;
    };
    kind.texture = take("ST");
    kind.colour = take("C");
    kind.normal = take("N");
    if (rest.starts_with("4") || rest.starts_with("n"))
        scanner.fail(excerpt(keyword) +
                     " has other than three coordinates a vertex, which is not "
                     "supported; convert it to OFF");
    if (rest != "OFF") scanner.fail(excerpt(keyword) + " is no kind of OFF");
    return kind;
}

glm::vec3 read_vertex(TextScanner& scanner, const OffKind& kind) {
    glm::vec3 position;
    for (int axis = 0; axis < 3; ++axis)
        position[axis] = scanner.coordinate("a vertex's coordinate");
    const int least = (kind.normal ? 3 : 0) + (kind.colour ? 3 : 0) + (kind.texture ? 2 : 0);
    for (int i = 0; i < least; ++i) scanner.skip_number("a vertex's normal, colour or texture");
    if (kind.colour)
        if (const std::string_view alpha = scanner.token(); !alpha.empty())
            scanner.skip_number(alpha, "a vertex's colour");
    scanner.expect_end_of_line("a vertex (the file's first word says what one holds)");
    return position;
}

void read_face(TextScanner& scanner, std::uint64_t vertex_count,
               std::vector<std::uint32_t>& polygon) {
    const std::int64_t corners = scanner.integer("a face's corner count");
    if (corners < 3)
        scanner.fail("a face has " + std::to_string(corners) + " corners; it needs 3 or more");
    polygon.clear();
    for (std::int64_t i = 0; i < corners; ++i) {
        const std::int64_t v = scanner.integer("a vertex index");
        if (v < 0 || static_cast<std::uint64_t>(v) >= vertex_count)
            scanner.fail("vertex index " + std::to_string(v) + " is out of range; the file has " +
                         std::to_string(vertex_count) + " vertices, numbered from 0");
        polygon.push_back(static_cast<std::uint32_t>(v));
    }
    for (int i = 0; i < 4; ++i) {
        const std::string_view colour = scanner.token();
        if (colour.empty()) return;
        scanner.skip_number(colour, "a face's colour");
    }
    scanner.expect_end_of_line("a face");
}

std::uint64_t read_count(TextScanner& scanner, std::string_view token, const char* what) {
    const std::int64_t count = scanner.integer(token, what);
    if (count < 0) scanner.fail(std::string(what) + " is negative");
    return static_cast<std::uint64_t>(count);
}

}  // namespace

MeshSource read_off(const SourceFile& file, const LongCall& call) {
    TextScanner scanner(file.name, file.bytes, {.comment = '#'});
    scanner.expect_line("OFF's first word");
    std::string_view token = scanner.token();
    OffKind kind;
    if (!parse_float(token)) {  // The word may be missing: then the counts come first.
        kind = read_kind(scanner, token);
        token = scanner.token();
        if (token == "BINARY")
            scanner.fail("binary OFF is not supported; convert it to text OFF or to PLY");
        if (token.empty()) {
            scanner.expect_line("the counts of vertices and faces");
            token = scanner.token();
        }
    }
    const std::uint64_t vertex_count = read_count(scanner, token, "the vertex count");
    const std::uint64_t face_count = read_count(scanner, scanner.token(), "the face count");
    if (const std::string_view edges = scanner.token(); !edges.empty())
        read_count(scanner, edges, "the edge count");  // Nobody counts edges right; it is not used.
    scanner.expect_end_of_line("the counts");
    // A vertex takes at least "0 0 0" and a line's end, a face "3 0 0 0".
    const std::uint64_t bytes = scanner.remaining() + 1;
    if (vertex_count > bytes / 6 || face_count > (bytes - 6 * vertex_count) / 8)
        scanner.fail(std::to_string(vertex_count) + " vertices and " + std::to_string(face_count) +
                     " faces are more than the rest of the file can hold; it is truncated or the "
                     "counts are wrong");
    if (vertex_count > k_max_file_vertices)
        throw Error(ErrorCode::too_large, file.name + ": more than 2^32 vertices");

    MeshSource source;
    source.positions.reserve(vertex_count);
    for (std::uint64_t i = 0; i < vertex_count; ++i) {
        if (i % k_checkpoint_interval == 0) parse_checkpoint(call, scanner.share());
        scanner.expect_line("another vertex");
        source.positions.push_back(read_vertex(scanner, kind));
    }
    source.triangles.reserve(face_count);
    std::vector<std::uint32_t> polygon;
    Triangulator triangulator;
    for (std::uint64_t i = 0; i < face_count; ++i) {
        if (i % k_checkpoint_interval == 0) parse_checkpoint(call, scanner.share());
        scanner.expect_line("another face");
        read_face(scanner, vertex_count, polygon);
        triangulator.triangulate(source.positions, polygon, source.triangles);
    }
    if (scanner.next_line())
        scanner.fail("there is more after the last face; a count at the beginning is too small");
    return source;
}

}  // namespace rimline
