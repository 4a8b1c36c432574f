// OFF and its variants: [ST][C][N]OFF, then counts, then vertices, then one line per face. As in
// Geomview, numbers may be on any lines. Only a face must end its line.
//
// A vertex is x y z, then a normal (3 numbers) with N, a color (3 or 4) with C, and a texture
// coordinate (2) with ST, in this order. NCOFF, which MeshLab writes, has the color before the normal. A face is its
// corner count, its corners and its color: nothing, three or four numbers, or one, an index of a colormap, which is
// not read. Variants with four or n coordinates, and the binary form, are rejected with an error that names them.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "silhouette/is_finite.h"
#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/mesh/formats/off_colors.h"
#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/formats/text_scanner.h"
#include "silhouette/mesh/formats/triangulate.h"

namespace rimline {

namespace {

struct OffKind {
    bool texture = false, color = false, normal = false;
    bool is_color_first = false;  // Before the normal.
    // What follows the word without a space, as in files of ModelNet: "OFF490 518 0".
    std::string_view vertex_count;
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
    kind.is_color_first = take("NC");
    kind.color = kind.is_color_first || take("C");
    kind.normal = kind.is_color_first || take("N");
    kind.texture = take("ST") || kind.texture;  // MeshLab writes it last.
    if (rest.starts_with("4") || rest.starts_with("n"))
        scanner.fail(excerpt(keyword) +
                     " has other than three coordinates a vertex, which is not "
                     "supported; convert it to OFF");
    if (!take("OFF") || (!rest.empty() && !parse_integer(rest)))
        scanner.fail(excerpt(keyword) + " is no kind of OFF");
    kind.vertex_count = rest;
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
        const auto skip = [&](int count, const char* skipped) {
            for (int i = 0; i < count; ++i)
                scanner_.skip_number(word_or_fail(scanner_, what), skipped);
        };
        if (kind_.is_color_first) read_vertex_color();
        if (kind_.normal) skip(3, "a vertex's normal");
        if (kind_.color && !kind_.is_color_first) read_vertex_color();
        if (kind_.texture) skip(2, "a vertex's texture coordinate");
        last_line_ = scanner_.line();
        return position;
    }

    // A face must end its line, because up to four color numbers may follow its corners. Returns its color.
    OffColor read_face(std::uint64_t vertex_count, std::vector<std::uint32_t>& polygon) {
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
        return read_face_color();
    }

    // In linear light, one for each vertex; white for one whose color is not used. Empty if they have none.
    std::vector<glm::vec3> vertex_colors() const {
        std::vector<glm::vec3> colors = linear(vertex_colors_, of_vertices_);
        std::ranges::replace(colors, k_no_color, glm::vec3(1.0f));
        return colors;
    }
    // The same for colors that read_face() returned.
    std::vector<glm::vec3> face_colors(std::span<const OffColor> colors) const {
        return linear(colors, of_faces_);
    }
    std::array<std::string, 2> warnings() const {
        return {of_vertices_.warning(), of_faces_.warning()};
    }

private:
    static std::vector<glm::vec3> linear(std::span<const OffColor> colors, const OffColors& list) {
        std::vector<glm::vec3> linear;
        linear.reserve(colors.size());
        for (const OffColor& color : colors) linear.push_back(list.linear(color));
        return linear;
    }

    void read_vertex_color() {
        const char* const what = "a vertex's color";
        std::array<std::string_view, 4> tokens;
        for (std::size_t i = 0; i < colors_; ++i) tokens[i] = word_or_fail(scanner_, what);
        vertex_colors_.push_back(
            of_vertices_.read(scanner_, std::span(tokens).first(colors_), what));
    }

    OffColor read_face_color() {
        const char* const what = "a face's color";
        std::array<std::string_view, 4> tokens;
        std::size_t count = 0;
        while (count < 4 && !(tokens[count] = scanner_.token()).empty()) ++count;
        scanner_.expect_end_of_line("a face");
        if (count >= 3) return of_faces_.read(scanner_, std::span(tokens).first(count), what);
        for (std::size_t i = 0; i < count; ++i) scanner_.skip_number(tokens[i], what);
        if (count == 2)
            of_faces_.warn(scanner_,
                           "a face's color has 2 numbers, not 3 or 4; such a color is not used");
        if (count == 1)
            of_faces_.warn(scanner_, excerpt(tokens[0]) +
                                         " after a face is an index of a colormap, which is not "
                                         "read; faces with one have no color of their own");
        return {};
    }

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
    std::size_t colors_ = 4;  // Numbers of a vertex's color.
    OffColors of_vertices_, of_faces_;
    std::vector<OffColor> vertex_colors_;
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
        token = kind.vertex_count.empty() ? scanner.token() : kind.vertex_count;
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
    const bool all_finite = std::ranges::all_of(source.positions, is_finite<float>);
    source.triangles.reserve(face_count);
    std::vector<std::uint32_t> polygon;
    std::vector<OffColor>
        triangle_colors;  // Of the first triangles, up to the last one that has a color.
    Triangulator triangulator(call.stop);
    for (std::uint64_t i = 0; i < face_count; ++i) {
        if (i % k_checkpoint_interval == 0) parse_checkpoint(call, scanner.share());
        const OffColor color = reader.read_face(vertex_count, polygon);
        const std::size_t first = source.triangles.size();
        if (all_finite) triangulator.triangulate(source.positions, polygon, source.triangles);
        if (color.kind == OffColor::Kind::none) continue;
        triangle_colors.resize(first);
        triangle_colors.resize(source.triangles.size(), color);
    }
    if (!scanner.word().empty())
        scanner.fail("there is more after the last face; a count at the beginning is too small");
    for (const std::string& warning : reader.warnings())
        if (!warning.empty()) add_warning(source.warnings, warning);
    if (!triangle_colors.empty()) triangle_colors.resize(source.triangles.size());
    color_vertices_and_triangles(source, reader.vertex_colors(),
                                 reader.face_colors(triangle_colors), call.stop);
    return source;
}

}  // namespace rimline
