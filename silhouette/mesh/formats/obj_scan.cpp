#include "silhouette/mesh/formats/obj_scan.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "silhouette/mesh/formats/float_of.h"
#include "silhouette/mesh/formats/mtl.h"
#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/formats/text_scanner.h"

namespace rimline {

namespace {

// Statements that do not affect faces. Of the superseded ones, cdc is a curve, and res the fineness of curves and
// patches.
constexpr std::array<std::string_view, 36> k_ignored{
    "g",    "s",    "o",        "mg",       "usemtl",     "mtllib",    "usemap", "maplib", "bevel",
    "lod",  "deg",  "c_interp", "d_interp", "shadow_obj", "trace_obj", "ctech",  "stech",  "cstype",
    "bmat", "step", "curv",     "curv2",    "parm",       "trim",      "hole",   "scrv",   "sp",
    "end",  "con",  "vp",       "vw",       "t",          "csh",       "scmp",   "cdc",    "res"};
// Ignored statements that hold names. Names may be Windows paths, so a final backslash is part of
// the name.
constexpr std::array<std::string_view, 9> k_named{
    "g", "s", "o", "usemtl", "mtllib", "usemap", "maplib", "shadow_obj", "trace_obj"};
// Unsupported statements that make faces.
constexpr std::array<std::string_view, 6> k_unsupported{"surf", "fo", "call", "bsp", "bzp", "cdp"};

bool holds(std::span<const std::string_view> words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

class Scan {
public:
    // With `points`, the scan stores positions, normals and colors there and makes no statements.
    Scan(const SourceFile& file, const LongCall& call, PointSource* points = nullptr,
         BadPoints bad = BadPoints::refuse)
        : file_(file),
          call_(call),
          points_(points),
          bad_(bad),
          scanner_(file.name, text_of(file), {.comment = '#', .continuations = true}) {}

    ObjScan run() {
        for (std::uint64_t i = 1; scanner_.next_line(); ++i) {
            if (i % k_checkpoint_interval == 0) parse_checkpoint(call_, scanner_.share() / 2);
            read_statement(scanner_.token());
        }
        check_forward_references();
        if (!colors_.empty()) {
            colors_.resize(vertices_.count, missing_color());
            if (points_)
                points_->colors = point_colors(colors_);
            else
                result_.colors = std::move(colors_);
        }
        if (points_ && normals_are_points_ && normals_.count == vertices_.count)
            points_->normals = std::move(normal_values_);
        return std::move(result_);
    }

private:
    // Removes the end mark (Ctrl-Z) of DOS.
    static std::string_view text_of(const SourceFile& file) {
        std::string_view text = file.text();
        if (text.ends_with('\x1a')) text.remove_suffix(1);
        return text;
    }

    // A kind of element that indices count. `max_early` is the largest index that was used
    // before its element. The format allows this, although most files list vertices first.
    struct Numbered {
        const char* name;
        const char* number;  // The name of one of its numbers.
        std::uint64_t count = 0;
        std::int64_t max_early = 0;
        std::uint64_t line_of_max = 0;
    };

    void read_statement(std::string_view keyword) {
        if (keyword == "v")
            read_vertex();
        else if (keyword == "f")
            read_face();
        else if (keyword == "vn")
            read_normal();
        else if (keyword == "vt")
            read_uv();
        else if (keyword == "l")
            read_references("a line", 2, [](std::string_view) {});
        else if (keyword == "p")
            read_references("a point element", 1, [](std::string_view) {});
        else if (keyword == "mtllib")
            result_.libraries.push_back({std::string(scanner_.free_text()), scanner_.line()});
        else if (keyword == "usemtl" && !points_)
            use_material(scanner_.free_text());
        else if (holds(k_named, keyword))
            scanner_.skip_free_text();
        else if (holds(k_unsupported, keyword))
            scanner_.fail("the statement " + excerpt(keyword) +
                          " is not supported; export the model as polygons in one file");
        else if (!holds(k_ignored, keyword))
            scanner_.fail(excerpt(keyword) + " is no OBJ statement");
    }

    // x y z, then optionally a weight or a color (with or without alpha).
    void read_vertex() {
        if (points_)
            read_exact_position();
        else
            read_position();
        int more = 0;
        glm::vec3 color(0.0f);
        for (std::string_view t = scanner_.token(); !t.empty(); t = scanner_.token(), ++more) {
            const double value = scanner_.number(t, "a vertex's weight or color");
            if (more < 3) color[more] = float_of(value);
        }
        if (more != 0 && more != 1 && more != 3 && more != 4)
            scanner_.fail("a vertex with " + std::to_string(3 + more) +
                          " numbers; it has 3, 4 (with a weight), 6 or 7 (with a color)");
        if (vertices_.count == k_max_file_vertices)
            throw Error(ErrorCode::too_large, file_.name + ": more than 2^32 vertices");
        ++vertices_.count;
        if (more < 3) return;
        // Most files give a color to all vertices or to none.
        colors_.resize(vertices_.count, missing_color());
        colors_.back() = color;
    }

    // A point without a color is black.
    glm::vec3 missing_color() const {
        return glm::vec3(points_ ? 0.0f : std::numeric_limits<float>::quiet_NaN());
    }

    void use_material(std::string_view name) {
        const auto [entry, is_new] =
            name_numbers_.try_emplace(std::string(name), result_.material_names.size());
        if (is_new) result_.material_names.push_back({entry->first, scanner_.line()});
        result_.material_uses.push_back({result_.face_count, entry->second});
    }

    void read_position() {
        glm::vec3 position;
        result_.statements += 'v';
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view token = scanner_.token();
            position[axis] = scanner_.coordinate(token, "a vertex's coordinate");
            append_token(token);
        }
        result_.statements += '\n';
        result_.positions.push_back(position);
    }

    void read_exact_position() {
        glm::dvec3 position;
        for (int axis = 0; axis < 3; ++axis)
            position[axis] = scanner_.number("a vertex's coordinate");
        if (const std::string why = refusal(vertices_.count, position, bad_); !why.empty())
            scanner_.fail(why);
        points_->positions.push_back(position);
    }

    void read_normal() {
        if (!points_) return read_numbers(normals_, 3, 3);
        glm::vec3 normal;
        for (int axis = 0; axis < 3; ++axis)
            normal[axis] = float_of(scanner_.number(normals_.number));
        scanner_.expect_end_of_line(normals_.number);
        ++normals_.count;
        normal_values_.push_back(normal);
    }

    // u, then v and w, which may be missing.
    void read_uv() {
        if (points_) return read_numbers(textures_, 1, 3);
        glm::vec2 uv(0.0f);
        uv.x = float_of(scanner_.number(textures_.number));
        if (const std::string_view v = scanner_.token(); !v.empty()) {
            uv.y = float_of(scanner_.number(v, textures_.number));
            if (const std::string_view w = scanner_.token(); !w.empty())
                scanner_.skip_number(w, textures_.number);
        }
        scanner_.expect_end_of_line(textures_.number);
        ++textures_.count;
        result_.uvs.push_back(uv);
    }

    void read_numbers(Numbered& kind, int min_count, int max_count) {
        for (int i = 0; i < min_count; ++i) scanner_.skip_number(kind.number);
        for (int i = min_count; i < max_count; ++i) {
            const std::string_view token = scanner_.token();
            if (token.empty()) break;
            scanner_.skip_number(token, kind.number);
        }
        scanner_.expect_end_of_line(kind.number);
        ++kind.count;
    }

    void read_face() {
        if (!points_) result_.statements += 'f';
        std::uint64_t corner = result_.corner_count;
        const std::uint64_t corners = read_references("a face", 3, [&](std::string_view vertex) {
            append_token(vertex);
            if (!points_ && uv_ != 0) {
                result_.corner_uvs.resize(corner, ObjScan::k_no_uv);
                result_.corner_uvs.push_back(static_cast<std::uint32_t>(uv_ - 1));
            }
            ++corner;
        });
        if (!points_) result_.statements += '\n';
        ++result_.face_count;
        result_.corner_count += corners;
    }

    void append_token(std::string_view token) {
        if (points_) return;
        result_.statements.append(1, ' ').append(token);
    }

    template <typename TakeVertex>
    std::uint64_t read_references(const char* what, std::uint64_t min_count, TakeVertex&& take) {
        std::uint64_t count = 0;
        for (std::string_view t = scanner_.token(); !t.empty(); t = scanner_.token(), ++count)
            take(read_reference(t));
        if (count < min_count)
            scanner_.fail(std::string(what) + " has " + std::to_string(count) +
                          " corners; it needs " + std::to_string(min_count) + " or more");
        return count;
    }

    // v, v/vt, v//vn or v/vt/vn. Exporters also write v/ and v//, which mean v. Returns v.
    std::string_view read_reference(std::string_view token) {
        const std::array<Numbered*, 3> kinds{&vertices_, &textures_, &normals_};
        std::string_view rest = token;
        std::int64_t vertex = 0;
        uv_ = 0;
        for (std::size_t part = 0; part < 3; ++part) {
            const std::size_t slash = rest.find('/');
            const std::string_view digits = rest.substr(0, slash);
            if (part == 0 || !digits.empty()) {
                const std::int64_t number = check_index(*kinds[part], digits, token);
                if (part == 0) vertex = number;
                if (part == 1) uv_ = number;
                normals_are_points_ = normals_are_points_ && (part != 2 || number == vertex);
            }
            if (slash == std::string_view::npos) return token.substr(0, token.find('/'));
            rest.remove_prefix(slash + 1);
        }
        scanner_.fail(excerpt(token) + " has more than three parts; a corner is v/vt/vn");
    }

    // Returns the element's number, from 1.
    std::int64_t check_index(Numbered& kind, std::string_view digits, std::string_view token) {
        const auto index = parse_integer(digits);
        if (!index)
            scanner_.fail(excerpt(token) + " is not a corner; it should be v, v/vt or v/vt/vn");
        const auto count = static_cast<std::int64_t>(kind.count);
        // tinyobjloader's indices are 32 bits wide.
        if (*index == 0 || *index < -count || *index > 0x7fffffff)
            fail_index(*index, kind, scanner_.line());
        if (*index > count && *index > kind.max_early) {
            kind.max_early = *index;
            kind.line_of_max = scanner_.line();
        }
        return *index < 0 ? count + *index + 1 : *index;
    }

    [[noreturn]] void fail_index(std::int64_t index, const Numbered& kind,
                                 std::uint64_t line) const {
        if (index == 0) bad_line(file_.name, line, "index 0 in OBJ, where numbering begins at 1");
        bad_line(file_.name, line,
                 "index " + std::to_string(index) + " is out of range; there are " +
                     std::to_string(kind.count) + " " + kind.name +
                     (index < 0 ? " before this line" : ""));
    }

    void check_forward_references() const {
        for (const Numbered* kind : {&vertices_, &textures_, &normals_})
            if (kind->max_early > static_cast<std::int64_t>(kind->count))
                fail_index(kind->max_early, *kind, kind->line_of_max);
    }

    const SourceFile& file_;
    const LongCall& call_;
    PointSource* points_;
    BadPoints bad_;
    TextScanner scanner_;
    ObjScan result_;
    std::vector<glm::vec3> colors_;                                 // As in the file.
    std::vector<glm::vec3> normal_values_;                          // Used for points only.
    std::map<std::string, std::size_t, std::less<>> name_numbers_;  // Of material_names.
    std::int64_t uv_ = 0;  // The number of the last reference's texture coordinates, or 0.
    bool normals_are_points_ = true;  // Every normal index equals its corner's vertex index.
    Numbered vertices_{"vertices", "a vertex's coordinate"};
    Numbered textures_{"texture coordinates", "a texture coordinate"};
    Numbered normals_{"normals", "a normal's component"};
};

}  // namespace

ObjScan scan_obj(const SourceFile& file, const LongCall& call) { return Scan(file, call).run(); }

PointRecords read_obj_points(const SourceFile& file, BadPoints bad, const LongCall& call) {
    PointRecords records;
    const ObjScan scan = Scan(file, call, &records.source, bad).run();
    records.has_faces = scan.face_count > 0;
    if (!scan.libraries.empty()) {
        std::vector<std::string> colors_are_not_read;
        records.source.files =
            read_material_libraries(file, scan.libraries, call, colors_are_not_read).files;
    }
    return records;
}

}  // namespace rimline
