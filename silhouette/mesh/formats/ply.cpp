// PLY: an element is a record of typed properties, and a file is a list of elements in any order.
// Only `vertex` (x, y, z and a color), `face` (vertex_indices or vertex_index, and a color) and `tristrips`
// (vertex_indices, strips separated by -1) are used. Everything else is skipped by its declared type. The names of
// colors are those of PlyElement::find_color(). They are sRGB: integers in [0, 255], or in [0, 65535] where they are
// unsigned with 16 bits, and floating-point numbers in [0, 1].

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/mesh/formats/float_of.h"
#include "silhouette/mesh/formats/ply_body.h"
#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/formats/triangulate.h"
#include "silhouette/srgb.h"

namespace rimline {

namespace {

template <typename Body>
class PlyReader {
public:
    PlyReader(const SourceFile& file, const PlyHeader& header, const LongCall& call)
        : file_(file),
          header_(header),
          elements_(file, header, call),
          triangulator_(call.stop),
          stop_(call.stop) {}

    MeshSource read() {
        vertex_count_ = header_.vertices(file_).count;
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex")
                read_vertices(element);
            else if (element.name == "face")
                read_polygons(element);
            else if (element.name == "tristrips")
                read_strips(element);
            else
                elements_.skip_elements(element);
        }
        body_.expect_end();
        std::uint64_t polygon = 0;
        for (std::size_t i = 0; i < early_polygons_.size(); i += early_polygons_[i] + 1) {
            elements_.checkpoint(polygon);
            add_polygon(std::span(early_polygons_).subspan(i + 1, early_polygons_[i]),
                        early_colors_.empty() ? k_white : early_colors_[polygon]);
            ++polygon;
        }
        if (has_face_colors_) triangle_colors_.resize(source_.triangles.size(), k_white);
        color_vertices_and_triangles(source_, vertex_colors_, triangle_colors_, stop_);
        return std::move(source_);
    }

private:
    static constexpr glm::vec3 k_white{1.0f};

    void add_polygon(std::span<const std::uint32_t> polygon, const glm::vec3& color) {
        triangulator_.triangulate(source_.positions, polygon, source_.triangles);
        if (has_face_colors_) triangle_colors_.resize(source_.triangles.size(), color);
    }

    // The channel of each property, or -1. Colors are used only if all three channels exist.
    static std::vector<int> channels_of(const PlyElement& element) {
        std::vector<int> channels(element.properties.size(), -1);
        if (const auto color = element.find_color())
            for (int c = 0; c < 3; ++c) channels[(*color)[static_cast<std::size_t>(c)]] = c;
        return channels;
    }

    void read_vertices(const PlyElement& element) {
        constexpr std::array<const char*, 3> k_axes{"x", "y", "z"};
        std::vector<int> axis_of(element.properties.size(), -1);
        for (int axis = 0; axis < 3; ++axis)
            axis_of[element.require_value(file_, k_axes[axis])] = axis;
        const std::vector<int> channel_of = channels_of(element);
        const bool has_colors = std::ranges::find(channel_of, 0) != channel_of.end();
        source_.positions.reserve(element.count);
        if (has_colors) vertex_colors_.reserve(element.count);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            elements_.checkpoint(i);
            body_.begin_element("another vertex");
            glm::vec3 position;
            glm::vec3 color;
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                const ScalarType type = element.properties[p].type;
                if (axis_of[p] >= 0)
                    position[axis_of[p]] = body_.coordinate(type, k_axes[axis_of[p]]);
                else if (channel_of[p] >= 0)
                    color[channel_of[p]] = channel(type);
                else
                    elements_.skip_property(element.properties[p]);
            }
            body_.end_element("a vertex");
            source_.positions.push_back(position);
            if (has_colors) vertex_colors_.push_back(linear_from_srgb(clamped_color(color)));
        }
        has_positions_ = true;
    }

    // sRGB, in [0, 1] in a sound file.
    float channel(ScalarType type) {
        return color_scale(type) * float_of(body_.number(type, "a color")) / 255.0f;
    }

    // Calls `read_list(count, type)` for the index list of each element, then `end(color)`, with white where
    // `channel_of` (channels_of()) has no color.
    template <typename ReadList, typename End>
    void for_each_index_list(const PlyElement& element, std::span<const int> channel_of,
                             ReadList&& read_list, End&& end) {
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
            elements_.checkpoint(i);
            body_.begin_element("another face");
            glm::vec3 color = k_white;
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                if (p == *indices)
                    read_list(elements_.list_count(element.properties[p]),
                              element.properties[p].type);
                else if (channel_of[p] >= 0)
                    color[channel_of[p]] = channel(element.properties[p].type);
                else
                    elements_.skip_property(element.properties[p]);
            }
            body_.end_element("a face");
            end(linear_from_srgb(clamped_color(color)));
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
        const std::vector<int> channel_of = channels_of(element);
        has_face_colors_ = std::ranges::find(channel_of, 0) != channel_of.end();
        if (has_face_colors_) triangle_colors_.resize(source_.triangles.size(), k_white);
        const auto read_list = [&](std::uint64_t count, ScalarType type) {
            if (count < 3)
                body_.fail("a face has " + std::to_string(count) + " corners; it needs 3 or more");
            polygon_.clear();
            for (std::uint64_t i = 0; i < count; ++i)
                polygon_.push_back(vertex_index(body_.integer(type, "a vertex index")));
        };
        for_each_index_list(element, channel_of, read_list, [&](const glm::vec3& color) {
            if (has_positions_) {
                add_polygon(polygon_, color);
                return;
            }
            early_polygons_.push_back(static_cast<std::uint32_t>(polygon_.size()));
            early_polygons_.insert(early_polygons_.end(), polygon_.begin(), polygon_.end());
            if (has_face_colors_) early_colors_.push_back(color);
        });
    }

    // Strip corners a b c d e ... are triangles abc, cbd, cde, ... Every second one is reversed.
    void read_strips(const PlyElement& element) {
        const std::vector<int> no_channels(element.properties.size(), -1);
        const auto read_list = [&](std::uint64_t count, ScalarType type) {
            std::array<std::uint32_t, 2> previous{};
            std::uint64_t length = 0;
            for (std::uint64_t i = 0; i < count; ++i) {
                elements_.checkpoint(i);
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
        };
        for_each_index_list(element, no_channels, read_list, [](const glm::vec3&) {});
        if (has_face_colors_) triangle_colors_.resize(source_.triangles.size(), k_white);
    }

    void end_strip(std::uint64_t length) {
        if (length == 1 || length == 2)
            body_.fail("a triangle strip has " + std::to_string(length) +
                       " corners; it needs 3 or more");
    }

    const SourceFile& file_;
    const PlyHeader& header_;
    PlyElements<Body> elements_;
    Body& body_ = elements_.body;
    MeshSource source_;
    std::vector<glm::vec3> vertex_colors_;  // Empty if the vertices have none.
    std::uint64_t vertex_count_ = 0;
    bool has_positions_ = false;
    std::vector<std::uint32_t> polygon_;
    // Faces that came before the vertices: count, corners, count, corners, ...
    std::vector<std::uint32_t> early_polygons_;
    std::vector<glm::vec3> early_colors_;  // Of each of them, if faces have colors.
    bool has_face_colors_ = false;
    std::vector<glm::vec3> triangle_colors_;  // Of the first triangles, if faces have colors.
    Triangulator triangulator_;
    std::stop_token stop_;
};

}  // namespace

MeshSource read_ply(const SourceFile& file, const LongCall& call) {
    const PlyHeader header = read_ply_header(file, call);
    if (header.encoding == PlyEncoding::ascii)
        return PlyReader<PlyTextBody>(file, header, call).read();
    return PlyReader<PlyBinaryBody>(file, header, call).read();
}

}  // namespace rimline
