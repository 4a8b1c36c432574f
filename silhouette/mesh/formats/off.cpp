// OFF and its variants: [ST][C][N]OFF, then counts, then vertices, then one line per face. As in
// Geomview, numbers may be on any lines. Only a face must end its line.
//
// A vertex is x y z, then a normal (3 numbers) with N, a color (3 or 4) with C, and a texture
// coordinate (2) with ST, in this order. A face is its corner count, its corners and up to four
// color numbers. Variants with four or n coordinates, and the binary form, are rejected with an
// error that names them.

#include <algorithm>
#include <cmath>

#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/formats/text_scanner.h"
#include "silhouette/mesh/formats/triangulate.h"

namespace rimline {

namespace {

struct OffKind {
    bool texture = false, color = false, normal = false;
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
    kind.color = take("C");
    kind.normal = take("N");
    if (rest.starts_with("4") || rest.starts_with("n"))
        scanner.fail(excerpt(keyword) +
                     " has other than three coordinates a vertex, which is not "
                     "supported; convert it to OFF");
    if (rest != "OFF") scanner.fail(excerpt(keyword) + " is no kind of OFF");
    return kind;
}

// The next token of this line or of a later line.
std::string_view word_or_fail(TextScanner& scanner, const char* what) {
    const std::string_view word = scanner.word();
    if (word.empty()) scanner.fail(std::string("the file ends where ") + what + " should follow");
    return word;
}

class OffReader {
public:
    OffReader(TextScanner& scanner, OffKind kind, BadPoints bad)
        : scanner_(scanner), kind_(kind), bad_(bad) {}

    glm::vec3 read_vertex() {
        const char* const what = "another vertex's number";
        std::string_view token = word_or_fail(scanner_, what);
        const std::uint64_t line = scanner_.line();
        if (line == last_line_ && crowded_line_ == 0) crowded_line_ = line;
        const int fixed = 3 + (kind_.normal ? 3 : 0) + (kind_.texture ? 2 : 0);
        // Geomview writes four color numbers, other programs three. If a vertex has its own line,
        // the line's length tells how many.
        if (kind_.color && line != last_line_) colors_ = tokens_left() + 1 == fixed + 3 ? 3 : 4;
        glm::vec3 position;
        for (int axis = 0; axis < 3; ++axis) {
            if (axis > 0) token = word_or_fail(scanner_, what);
            position[axis] = scanner_.coordinate(token, "a vertex's coordinate", bad_);
        }
        const int more = fixed - 3 + (kind_.color ? colors_ : 0);
        for (int i = 0; i < more; ++i)
            scanner_.skip_number(word_or_fail(scanner_, what),
                                 "a vertex's normal, color or texture");
        last_line_ = scanner_.line();
        return position;
    }

    // A face must end its line, because up to four color numbers may follow its corners.
    void read_face(std::uint64_t vertex_count, std::vector<std::uint32_t>& polygon) {
        const std::int64_t corners =
            scanner_.integer(word_or_fail(scanner_, "another face"), "a face's corner count");
        if (corners < 3)
            fail("a face has " + std::to_string(corners) + " corners; it needs 3 or more");
        polygon.clear();
        for (std::int64_t i = 0; i < corners; ++i) {
            const std::int64_t v =
                scanner_.integer(word_or_fail(scanner_, "a vertex index"), "a vertex index");
            if (v < 0 || static_cast<std::uint64_t>(v) >= vertex_count)
                fail("vertex index " + std::to_string(v) + " is out of range; the file has " +
                     std::to_string(vertex_count) + " vertices, numbered from 0");
            polygon.push_back(static_cast<std::uint32_t>(v));
        }
        for (int i = 0; i < 4; ++i) {
            const std::string_view color = scanner_.token();
            if (color.empty()) return;
            scanner_.skip_number(color, "a face's color");
        }
        scanner_.expect_end_of_line("a face");
    }

private:
    int tokens_left() const {
        TextScanner ahead = scanner_;
        int count = 0;
        while (!ahead.token().empty()) ++count;
        return count;
    }

    // Undeclared colors shift all later numbers. The message then names the vertex line that is too
    // long.
    [[noreturn]] void fail(const std::string& what) const {
        scanner_.fail(crowded_line_ == 0
                          ? what
                          : what + " (line " + std::to_string(crowded_line_) +
                                " holds more than one vertex has in a file of this kind)");
    }

    TextScanner& scanner_;
    OffKind kind_;
    BadPoints bad_;
    int colors_ = 4;
    std::uint64_t last_line_ = 0;     // The line where the last vertex ended.
    std::uint64_t crowded_line_ = 0;  // The first line where one vertex ends and another begins.
};

std::uint64_t read_count(TextScanner& scanner, std::string_view token, const char* what) {
    const std::int64_t count = scanner.integer(token, what);
    if (count < 0) scanner.fail(std::string(what) + " is negative");
    return static_cast<std::uint64_t>(count);
}

}  // namespace

MeshSource read_off(const SourceFile& file, BadPoints bad, const LongCall& call) {
    TextScanner scanner(file.name, file.text(), {.comment = '#'});
    scanner.expect_line("OFF's first word");
    std::string_view token = scanner.token();
    OffKind kind;
    if (!parse_float(token)) {  // The word is optional. Without it, the counts come first.
        kind = read_kind(scanner, token);
        token = scanner.token();
        if (token == "BINARY")
            scanner.fail("binary OFF is not supported; convert it to text OFF or to PLY");
        if (token.empty()) token = word_or_fail(scanner, "the counts of vertices and faces");
    }
    const std::uint64_t vertex_count = read_count(scanner, token, "the vertex count");
    const std::uint64_t counts_line = scanner.line();
    const std::uint64_t face_count =
        read_count(scanner, word_or_fail(scanner, "the face count"), "the face count");
    // The edge count is often wrong and is not used. Some files omit it at the end of the line.
    const std::string_view edges =
        scanner.line() == counts_line ? scanner.token() : word_or_fail(scanner, "the edge count");
    if (!edges.empty()) read_count(scanner, edges, "the edge count");
    // A vertex takes at least "0 0 0" and a line's end, a face "3 0 0 0".
    const std::uint64_t bytes = scanner.remaining() + 1;
    if (vertex_count > bytes / 6 || face_count > (bytes - 6 * vertex_count) / 8)
        scanner.fail(std::to_string(vertex_count) + " vertices and " + std::to_string(face_count) +
                     " faces are more than the rest of the file can hold; it is truncated or the "
                     "counts are wrong");
    if (vertex_count > k_max_file_vertices)
        throw Error(ErrorCode::too_large, file.name + ": more than 2^32 vertices");

    OffReader reader(scanner, kind, bad);
    MeshSource source;
    source.positions.reserve(vertex_count);
    for (std::uint64_t i = 0; i < vertex_count; ++i) {
        if (i % k_checkpoint_interval == 0) parse_checkpoint(call, scanner.share());
        source.positions.push_back(reader.read_vertex());
    }
    // Polygons are not triangulated if a position is not finite.
    const bool all_finite = std::ranges::all_of(source.positions, [](const glm::vec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
    source.triangles.reserve(face_count);
    std::vector<std::uint32_t> polygon;
    Triangulator triangulator(call.stop);
    for (std::uint64_t i = 0; i < face_count; ++i) {
        if (i % k_checkpoint_interval == 0) parse_checkpoint(call, scanner.share());
        reader.read_face(vertex_count, polygon);
        if (all_finite) triangulator.triangulate(source.positions, polygon, source.triangles);
    }
    if (!scanner.word().empty())
        scanner.fail("there is more after the last face; a count at the beginning is too small");
    return source;
}

}  // namespace rimline
