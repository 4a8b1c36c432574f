// PLY: an element is a record of typed properties, and a file is a list of elements in any order.
// Only `vertex` (x, y, z), `face` (vertex_indices or vertex_index) and `tristrips` (vertex_indices,
// strips separated by -1) are understood; everything else is stepped over by its declared type.

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <span>
#include <utility>

#include "silhouette/mesh/formats/byte_scanner.h"
#include "silhouette/mesh/formats/ply_header.h"
#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/formats/text_scanner.h"
#include "silhouette/mesh/formats/triangulate.h"

namespace rimline {

namespace {

bool is_floating(ScalarType type) noexcept {
    return type == ScalarType::float32 || type == ScalarType::float64;
}

// The least and the greatest value of a type, which is a floating-point one only where indices are.
std::pair<std::int64_t, std::int64_t> range_of(ScalarType type) noexcept {
    switch (type) {
        case ScalarType::int8: return {-0x80, 0x7f};
        case ScalarType::uint8: return {0, 0xff};
        case ScalarType::int16: return {-0x8000, 0x7fff};
        case ScalarType::uint16: return {0, 0xffff};
        case ScalarType::int32: return {-0x80000000ll, 0x7fffffff};
        case ScalarType::uint32: return {0, 0xffffffffll};
        case ScalarType::float32:
        case ScalarType::float64: break;
    }
    return {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()};
}

// The two encodings behind one set of operations. An element of a text file is a line.

class TextBody {
public:
    TextBody(const SourceFile& file, const PlyHeader& header)
        : scanner_(file.name, std::string_view(file.bytes).substr(header.body_offset), {},
                   header.body_line) {}

    void begin_element(const char* what) { scanner_.expect_line(what); }
    void end_element(const char* what) { scanner_.expect_end_of_line(what); }
    float coordinate(ScalarType type, const char* what) {
        if (is_floating(type)) return scanner_.coordinate(what);
        return static_cast<float>(integer(type, what));
    }
    std::int64_t integer(ScalarType type, const char* what) {
        const std::int64_t value = scanner_.integer(what);
        if (const auto [least, most] = range_of(type); value < least || value > most)
            scanner_.fail(std::string(what) + " is " + std::to_string(value) +
                          ", which its declared type cannot hold; that goes from " +
                          std::to_string(least) + " to " + std::to_string(most));
        return value;
    }
    void skip(ScalarType type, std::uint64_t count, const char* what) {
        for (std::uint64_t i = 0; i < count; ++i) {
            if (is_floating(type))
                scanner_.skip_number(what);
            else
                integer(type, what);
        }
    }
    /// Whether the rest of the file could hold `count` values.
    bool could_hold(std::uint64_t count, ScalarType) const noexcept {
        return count <= scanner_.remaining() / 2 + 1;
    }
    void expect_end() {
        if (scanner_.next_line())
            scanner_.fail(
                "there is more after the last element; a count in the header is too small");
    }
    double share() const noexcept { return scanner_.share(); }
    [[noreturn]] void fail(const std::string& what) const { scanner_.fail(what); }

private:
    TextScanner scanner_;
};

class BinaryBody {
public:
    BinaryBody(const SourceFile& file, const PlyHeader& header)
        : bytes_(file.bytes),
          scanner_(file.name, file.bytes, header.body_offset,
                   header.encoding == PlyEncoding::binary_big_endian ? std::endian::big
                                                                     : std::endian::little) {}

    void begin_element(const char*) noexcept {}
    void end_element(const char*) noexcept {}
    float coordinate(ScalarType type, const char* what) { return scanner_.coordinate(type, what); }
    std::int64_t integer(ScalarType type, const char* what) { return scanner_.integer(type, what); }
    void skip(ScalarType type, std::uint64_t count, const char* what) {
        scanner_.skip(count, size_bytes(type), what);
    }
    bool could_hold(std::uint64_t count, ScalarType type) const noexcept {
        return count <= scanner_.remaining() / size_bytes(type);
    }
    void expect_end() {
        // Some writers end the last line, though the data has none.
        const std::size_t left = scanner_.remaining();
        if (left != 0 && !(left <= 2 && bytes_.ends_with(left == 1 ? "\n" : "\r\n")))
            scanner_.fail(std::to_string(scanner_.remaining()) +
                          " bytes follow the last element; a count in the header is too small, or "
                          "the file went through a text conversion");
    }
    double share() const noexcept { return scanner_.share(); }
    [[noreturn]] void fail(const std::string& what) const { scanner_.fail(what); }

private:
    std::string_view bytes_;
    ByteScanner scanner_;
};

template <typename Body>
class PlyReader {
public:
    PlyReader(const SourceFile& file, const PlyHeader& header, const LongCall& call)
        : file_(file), header_(header), call_(call), body_(file, header) {}

    MeshSource read() {
        const PlyElement* vertices = header_.find("vertex");
        if (!vertices)
            bad_line(file_.name, header_.body_line - 1, "the header declares no 'vertex'");
        if (vertices->count > k_max_file_vertices)
            throw Error(ErrorCode::too_large, file_.name + ": more than 2^32 vertices");
        vertex_count_ = vertices->count;
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex")
                read_vertices(element);
            else if (element.name == "face")
                read_polygons(element);
            else if (element.name == "tristrips")
                read_strips(element);
            else
                skip_elements(element);
        }
        body_.expect_end();
        for (std::size_t i = 0; i < early_polygons_.size(); i += early_polygons_[i] + 1)
            triangulator_.triangulate(source_.positions,
                                      std::span(early_polygons_).subspan(i + 1, early_polygons_[i]),
                                      source_.triangles);
        return std::move(source_);
    }

private:
    void checkpoint(std::uint64_t i) {
        if (i % k_checkpoint_interval == 0) parse_checkpoint(call_, body_.share());
    }

    std::uint64_t list_count(const PlyProperty& property) {
        const std::int64_t count = body_.integer(*property.count_type, "the count of a list");
        if (count < 0) body_.fail("the count of a list is negative");
        if (!body_.could_hold(static_cast<std::uint64_t>(count), property.type))
            body_.fail("a list of " + std::to_string(count) +
                       " is longer than the rest of the file; it is truncated or damaged");
        return static_cast<std::uint64_t>(count);
    }

    void skip_property(const PlyProperty& property) {
        const std::uint64_t count = property.is_list() ? list_count(property) : 1;
        body_.skip(property.type, count, "a property's value");
    }

    void skip_elements(const PlyElement& element) {
        if (element.properties.empty()) return;  // They take no bytes and no line.
        for (std::uint64_t i = 0; i < element.count; ++i) {
            checkpoint(i);
            body_.begin_element("another element");
            for (const PlyProperty& p : element.properties) skip_property(p);
            body_.end_element("an element");
        }
    }

    void read_vertices(const PlyElement& element) {
        constexpr std::array<const char*, 3> k_axes{"x", "y", "z"};
        std::vector<int> axis_of(element.properties.size(), -1);
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = element.find(k_axes[axis]);
            if (!i || element.properties[*i].is_list())
                bad_line(file_.name, element.line,
                         std::string("element 'vertex' has no property '") + k_axes[axis] + "'");
            axis_of[*i] = axis;
        }
        source_.positions.reserve(element.count);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            checkpoint(i);
            body_.begin_element("another vertex");
            glm::vec3 position;
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                if (axis_of[p] < 0)
                    skip_property(element.properties[p]);
                else
                    position[axis_of[p]] =
                        body_.coordinate(element.properties[p].type, k_axes[axis_of[p]]);
            }
            body_.end_element("a vertex");
            source_.positions.push_back(position);
        }
        has_positions_ = true;
    }

    // Calls `read_list(count, type)` for the index list of each element.
    template <typename ReadList>
    void for_each_index_list(const PlyElement& element, ReadList&& read_list) {
        const auto plural = element.find("vertex_indices");
        const auto singular = element.find("vertex_index");
        if (plural && singular)
            bad_line(file_.name, element.line,
                     "element " + excerpt(element.name) +
                         " has both vertex_indices and vertex_index; remove one");
        const auto indices = plural ? plural : singular;
        if (!indices || !element.properties[*indices].is_list()) {
            if (element.count == 0) return;
            bad_line(file_.name, element.line,
                     "element " + excerpt(element.name) + " has no list property 'vertex_indices'");
        }
        for (std::uint64_t i = 0; i < element.count; ++i) {
            checkpoint(i);
            body_.begin_element("another face");
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                if (p == *indices)
                    read_list(list_count(element.properties[p]), element.properties[p].type);
                else
                    skip_property(element.properties[p]);
            }
            body_.end_element("a face");
        }
    }

    std::uint32_t vertex_index(std::int64_t i) {
        if (i < 0 || static_cast<std::uint64_t>(i) >= vertex_count_)
            body_.fail("vertex index " + std::to_string(i) + " is out of range; the file has " +
                       std::to_string(vertex_count_) + " vertices, numbered from 0");
        return static_cast<std::uint32_t>(i);
    }

    void read_polygons(const PlyElement& element) {
        if (!element.properties.empty()) source_.triangles.reserve(element.count);
        for_each_index_list(element, [&](std::uint64_t count, ScalarType type) {
            if (count < 3)
                body_.fail("a face has " + std::to_string(count) + " corners; it needs 3 or more");
            polygon_.clear();
            for (std::uint64_t i = 0; i < count; ++i)
                polygon_.push_back(vertex_index(body_.integer(type, "a vertex index")));
            if (has_positions_) {
                triangulator_.triangulate(source_.positions, polygon_, source_.triangles);
            } else {
                early_polygons_.push_back(static_cast<std::uint32_t>(count));
                early_polygons_.insert(early_polygons_.end(), polygon_.begin(), polygon_.end());
            }
        });
    }

    // Strip corners a b c d e ... are triangles abc, cbd, cde, ...: every other one is turned round.
    void read_strips(const PlyElement& element) {
        for_each_index_list(element, [&](std::uint64_t count, ScalarType type) {
            std::array<std::uint32_t, 2> previous{};
            std::uint64_t length = 0;
            for (std::uint64_t i = 0; i < count; ++i) {
                if (i % k_checkpoint_interval == 0) parse_checkpoint(call_, body_.share());
                const std::int64_t value = body_.integer(type, "a vertex index");
                if (value == -1) {
                    end_strip(length);
                    length = 0;
                    continue;
                }
                const std::uint32_t corner = vertex_index(value);
                if (length >= 2) {
                    const bool turned = length % 2 == 1;
                    source_.triangles.push_back(
                        {previous[turned ? 1 : 0], previous[turned ? 0 : 1], corner});
                }
                previous = {previous[1], corner};
                ++length;
            }
            end_strip(length);
        });
    }

    void end_strip(std::uint64_t length) {
        if (length == 1 || length == 2)
            body_.fail("a triangle strip has " + std::to_string(length) +
                       " corners; it needs 3 or more");
    }

    const SourceFile& file_;
    const PlyHeader& header_;
    const LongCall& call_;
    Body body_;
    MeshSource source_;
    std::uint64_t vertex_count_ = 0;
    bool has_positions_ = false;
    std::vector<std::uint32_t> polygon_;
    // Faces that came before the vertices: count, corners, count, corners, ...
    std::vector<std::uint32_t> early_polygons_;
    Triangulator triangulator_;
};

}  // namespace

MeshSource read_ply(const SourceFile& file, const LongCall& call) {
    const PlyHeader header = read_ply_header(file);
    if (header.encoding == PlyEncoding::ascii)
        return PlyReader<TextBody>(file, header, call).read();
    return PlyReader<BinaryBody>(file, header, call).read();
}

}  // namespace rimline
