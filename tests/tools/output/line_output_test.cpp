#include "tools/output/line_output.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/tools/scratch_folder.h"
#include "tools/command.h"

using namespace rimline;
using tools::format_lines;
using tools::LineFormat;
using tools::Lines;

namespace {

struct Case {
    Mesh mesh;
    HomogeneousPoint point;
    std::vector<EdgeId> silhouette = brute_force_silhouette(mesh, point);
    std::vector<EdgeId> borders;

    Case(const MeshSource& source, HomogeneousPoint p) : mesh(source), point(p) {
        const Mesh::EdgeRange range = mesh.edges_of_class(EdgeClass::border);
        for (std::uint32_t e = range.first; e < range.last; ++e) borders.push_back(EdgeId{e});
    }
    std::string format(LineFormat format) const {
        return format_lines({mesh, point, silhouette, borders, "a title"}, format);
    }
    std::size_t line_count() const { return silhouette.size() + borders.size(); }
};

// An open mesh, so that there are borders as well.
Case terrain() {
    return Case(make_built_in_shape("terrain", 2000), HomogeneousPoint::viewpoint({3, 0.2f, 2}));
}

bool has_edge(const Mesh& mesh, std::uint32_t face, std::array<VertexId, 2> vertices) {
    const Triangle& t = mesh.triangles()[face];
    return std::ranges::count(t, vertices[0]) == 1 && std::ranges::count(t, vertices[1]) == 1;
}

std::size_t count_of(const std::string& text, const std::string& piece) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(piece, at)) != std::string::npos; ++at) ++count;
    return count;
}

}  // namespace

TEST_CASE("the file's format is that of its name's ending") {
    CHECK(tools::line_format_of("a.obj") == LineFormat::obj);
    CHECK(tools::line_format_of("some.dir/A.PLY") == LineFormat::ply);
    CHECK(tools::line_format_of(".b.svg") == LineFormat::svg);
    for (const char* name : {"", "a", "a.pdf", "obj", "a.obj.gz", "some.obj/a"})
        CHECK_THROWS_AS(tools::line_format_of(name), tools::UsageError);
}

TEST_CASE("an OBJ holds each edge once, between its own vertices, after its faces") {
    const Case c = terrain();
    REQUIRE(!c.silhouette.empty());
    REQUIRE(!c.borders.empty());
    std::istringstream text(c.format(LineFormat::obj));
    std::vector<glm::vec3> vertices;
    std::size_t lines = 0;
    std::size_t lines_before_borders = 0;
    std::istringstream comment;
    for (std::string line; std::getline(text, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            glm::vec3 p;
            words >> p.x >> p.y >> p.z;
            vertices.push_back(p);
        } else if (kind == "#") {
            comment = std::istringstream(line);
        } else if (line == "g borders") {
            lines_before_borders = lines;
        } else if (kind == "l") {
            std::size_t a = 0;
            std::size_t b = 0;
            words >> a >> b;
            const EdgeId edge = lines < c.silhouette.size()
                                    ? c.silhouette[lines]
                                    : c.borders.at(lines - c.silhouette.size());
            const auto ends = c.mesh.edge(edge).vertices;
            CHECK(vertices.at(a - 1) == c.mesh.positions()[index(ends[0])]);
            CHECK(vertices.at(b - 1) == c.mesh.positions()[index(ends[1])]);
            std::string word;
            std::uint32_t file_a = 0;
            std::uint32_t file_b = 0;
            comment >> word >> word >> file_a >> file_b >> word;
            CHECK(file_a == c.mesh.file_vertex(ends[0]));
            CHECK(file_b == c.mesh.file_vertex(ends[1]));
            std::size_t faces = 0;
            for (std::uint32_t face = 0; comment >> face; ++faces)
                CHECK(has_edge(c.mesh, face, ends));
            CHECK(faces == c.mesh.faces_of(edge).size());
            ++lines;
        }
    }
    CHECK(lines == c.line_count());
    CHECK(lines_before_borders == c.silhouette.size());
}

TEST_CASE("a PLY holds each edge with a front face and a back face") {
    const Case c = terrain();
    const std::string bytes = c.format(LineFormat::ply);
    std::istringstream text(bytes);
    std::size_t vertex_count = 0;
    std::size_t edge_count = 0;
    for (std::string line; std::getline(text, line) && line != "end_header";) {
        std::istringstream words(line);
        std::string word, element;
        words >> word >> element;
        if (word == "element") words >> (element == "vertex" ? vertex_count : edge_count);
    }
    REQUIRE(edge_count == c.line_count());
    std::vector<glm::vec3> vertices(vertex_count);
    for (glm::vec3& p : vertices) {
        std::uint32_t file_vertex = 0;
        text >> p.x >> p.y >> p.z >> file_vertex;
    }
    for (std::size_t i = 0; i < edge_count; ++i) {
        std::size_t a = 0, b = 0;
        std::int64_t face1 = 0, face2 = 0;
        int border = 0;
        text >> a >> b >> face1 >> face2 >> border;
        REQUIRE(text);
        const bool is_border = i >= c.silhouette.size();
        const EdgeId edge = is_border ? c.borders[i - c.silhouette.size()] : c.silhouette[i];
        const auto ends = c.mesh.edge(edge).vertices;
        CHECK(vertices.at(a) == c.mesh.positions()[index(ends[0])]);
        CHECK(vertices.at(b) == c.mesh.positions()[index(ends[1])]);
        CHECK(border == int{is_border});
        CHECK(has_edge(c.mesh, static_cast<std::uint32_t>(face1), ends));
        if (is_border) {
            CHECK(face2 == -1);
            continue;
        }
        CHECK(has_edge(c.mesh, static_cast<std::uint32_t>(face2), ends));
        CHECK(is_front(c.mesh.planes()[static_cast<std::size_t>(face1)], c.point));
        CHECK_FALSE(is_front(c.mesh.planes()[static_cast<std::size_t>(face2)], c.point));
    }
    std::string rest;
    text >> rest;
    CHECK(rest == "");
}

TEST_CASE("an SVG draws each line within its view box") {
    const Case c = terrain();
    const std::string text = c.format(LineFormat::svg);
    CHECK(count_of(text, "<line ") == c.line_count());
    CHECK(count_of(text, "data-faces=\"") == c.line_count());
    CHECK(count_of(text, "<g ") == count_of(text, "</g>"));
    CHECK(text.find("nan") == std::string::npos);
    CHECK(text.find("inf") == std::string::npos);
    double width = 0.0, height = 0.0;
    std::istringstream(text.substr(text.find("viewBox=\"") + 9 + 4)) >> width >> height;
    CHECK(std::max(width, height) == doctest::Approx(1000.0));
    for (const auto& [name, limit] : {std::pair(" x1=\"", width), std::pair(" y1=\"", height),
                                      std::pair(" x2=\"", width), std::pair(" y2=\"", height)})
        for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos; ++at) {
            const double value = std::stod(text.substr(at + 5));
            CHECK(value >= 0.0);
            CHECK(value <= limit);
        }
}

TEST_CASE("no lines make a whole file too, and a title cannot break out of its place") {
    const Mesh mesh{MeshSource{}};
    const HomogeneousPoint point = HomogeneousPoint::direction({0, 0, 1});
    for (const LineFormat format : {LineFormat::obj, LineFormat::ply, LineFormat::svg})
        CHECK(!format_lines({mesh, point, {}, {}, "t"}, format).empty());
    const std::string svg = format_lines({mesh, point, {}, {}, "</title>&"}, LineFormat::svg);
    CHECK(count_of(svg, "</title>") == 1);
    CHECK(svg.find("&lt;/title&gt;&amp;") != std::string::npos);
}

TEST_CASE("the OBJ and PLY that are written are files that Rimline reads") {
    const tests::ScratchFolder folder;
    const Case c = terrain();
    const std::pair<const char*, LineFormat> files[] = {{"a.obj", LineFormat::obj},
                                                        {"a.ply", LineFormat::ply}};
    for (const auto& [name, format] : files) {
        CAPTURE(name);
        tests::write_bytes(folder / name, c.format(format));
        const MeshSource read = read_mesh_file(folder / name, FaceRequirement::faces_or_points);
        CHECK(read.triangles.empty());
        CHECK(!read.positions.empty());
    }
}
