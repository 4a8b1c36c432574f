#include "tools/output/line_output.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string_view>
#include <vector>

#include "tools/command.h"
#include "tools/output/line_projection.h"
#include "tools/output/xml_text.h"

namespace rimline::tools {

namespace {

// Appends the shortest text that is parsed to the same number.
template <typename Number>
void append_number(std::string& text, Number value) {
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    text.append(buffer.data(), end);
}

void append(std::string& text, std::string_view piece) { text += piece; }
void append(std::string& text, float value) { append_number(text, value); }
void append(std::string& text, std::uint32_t value) { append_number(text, value); }
void append(std::string& text, std::int64_t value) { append_number(text, value); }

template <typename... Pieces>
void append_all(std::string& text, const Pieces&... pieces) {
    (append(text, pieces), ...);
}

// The vertices of the edges, numbered in the order of the mesh.
struct UsedVertices {
    std::vector<VertexId> vertices;
    std::vector<std::uint32_t> number;  // By mesh vertex.
};

UsedVertices used_vertices(const Lines& lines) {
    UsedVertices used;
    used.number.assign(lines.mesh.vertex_count(), 0);
    for (const auto& edges : {lines.silhouette, lines.borders})
        for (const EdgeId edge : edges)
            for (const VertexId v : lines.mesh.edge(edge).vertices) used.number[index(v)] = 1;
    for (std::uint32_t v = 0; v < lines.mesh.vertex_count(); ++v) {
        if (used.number[v] == 0) continue;
        used.number[v] = static_cast<std::uint32_t>(used.vertices.size());
        used.vertices.push_back(VertexId{v});
    }
    return used;
}

// A front face and a back face if the edge has both; else its first two faces. The second face of a border
// edge is k_no_face.
std::array<FaceId, 2> face_pair(const Lines& lines, EdgeId edge) {
    const std::span<const FaceId> faces = lines.mesh.faces_of(edge);
    const auto front = [&](FaceId f) { return is_front(lines.mesh.plane(f), lines.point); };
    const auto first_front = std::find_if(faces.begin(), faces.end(), front);
    const auto first_back = std::find_if_not(faces.begin(), faces.end(), front);
    if (first_front != faces.end() && first_back != faces.end()) return {*first_front, *first_back};
    return {faces[0], faces.size() > 1 ? faces[1] : k_no_face};
}

std::string face_list(const Lines& lines, EdgeId edge) {
    std::string text;
    for (const FaceId face : lines.mesh.faces_of(edge))
        append_all(text, text.empty() ? "" : " ", index(face));
    return text;
}

// Calls visit(edge, is_border) for each edge, in the order of the file.
template <typename Visit>
void for_each_edge(const Lines& lines, Visit&& visit) {
    for (const EdgeId edge : lines.silhouette) visit(edge, false);
    for (const EdgeId edge : lines.borders) visit(edge, true);
}

std::string format_obj(const Lines& lines) {
    const UsedVertices used = used_vertices(lines);
    std::string text;
    append_all(
        text, "# ", lines.title, "\n",
        "# Before each line its vertices and faces as the model's file numbers them, from 0.\n");
    for (const VertexId v : used.vertices) {
        const glm::vec3& p = lines.mesh.positions()[index(v)];
        append_all(text, "v ", p.x, " ", p.y, " ", p.z, "\n");
    }
    text += "g silhouette\n";
    bool in_borders = false;
    for_each_edge(lines, [&](EdgeId edge, bool is_border) {
        if (is_border && !in_borders) text += "g borders\n";
        in_borders = is_border;
        const auto [a, b] = lines.mesh.edge(edge).vertices;
        append_all(text, "# vertices ", lines.mesh.file_vertex(a), " ", lines.mesh.file_vertex(b),
                   " faces ", face_list(lines, edge), "\nl ", used.number[index(a)] + 1, " ",
                   used.number[index(b)] + 1, "\n");
    });
    return text;
}

std::string format_ply(const Lines& lines) {
    const UsedVertices used = used_vertices(lines);
    const std::size_t edge_count = lines.silhouette.size() + lines.borders.size();
    std::string text;
    append_all(text, "ply\nformat ascii 1.0\ncomment ", lines.title, "\nelement vertex ",
               static_cast<std::int64_t>(used.vertices.size()),
               "\nproperty float x\nproperty float y\nproperty float z\n"
               "property uint file_vertex\nelement edge ",
               static_cast<std::int64_t>(edge_count),
               "\nproperty int vertex1\nproperty int vertex2\nproperty int face1\n"
               "property int face2\nproperty uchar border\nend_header\n");
    for (const VertexId v : used.vertices) {
        const glm::vec3& p = lines.mesh.positions()[index(v)];
        append_all(text, p.x, " ", p.y, " ", p.z, " ", lines.mesh.file_vertex(v), "\n");
    }
    for_each_edge(lines, [&](EdgeId edge, bool is_border) {
        const auto [a, b] = lines.mesh.edge(edge).vertices;
        const auto [face1, face2] = face_pair(lines, edge);
        append_all(text, used.number[index(a)], " ", used.number[index(b)], " ", index(face1), " ",
                   face2 == k_no_face ? std::int64_t{-1} : std::int64_t{index(face2)},
                   is_border ? " 1\n" : " 0\n");
    });
    return text;
}

std::string format_svg(const Lines& lines) {
    struct SvgLine {
        EdgeId edge;
        bool is_border;
        PictureLine line;
    };
    const LineProjection projection(lines.mesh, lines.point);
    std::vector<SvgLine> svg_lines;
    PictureFrame frame;
    for_each_edge(lines, [&](EdgeId edge, bool is_border) {
        const auto [a, b] = lines.mesh.edge(edge).vertices;
        const auto line =
            projection.project(lines.mesh.positions()[index(a)], lines.mesh.positions()[index(b)]);
        if (!line) return;
        svg_lines.push_back({edge, is_border, *line});
        frame.include(*line);
    });
    const PictureFit fit = frame.fit();

    std::string text;
    // Two decimals: the longer side has 1000 units, so this is finer than any print.
    const auto append_fixed = [&](double value) {
        std::array<char, 32> buffer;
        const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                       std::chars_format::fixed, 2)
                             .ptr;
        text.append(buffer.data(), end);
    };
    text += "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 ";
    append_fixed(fit.width);
    text += " ";
    append_fixed(fit.height);
    append_all(text, "\">\n<title>", escaped_for_xml(lines.title),
               "</title>\n<g id=\"silhouette\" fill=\"none\" stroke=\"#111\" stroke-width=\"1.5\" "
               "stroke-linecap=\"round\">\n");
    bool in_borders = false;
    for (const SvgLine& svg_line : svg_lines) {
        if (svg_line.is_border && !in_borders)
            text +=
                "</g>\n<g id=\"borders\" fill=\"none\" stroke=\"#777\" stroke-width=\"1\" "
                "stroke-linecap=\"round\">\n";
        in_borders = svg_line.is_border;
        const PictureLine line = fit.to_view(svg_line.line);
        text += "<line x1=\"";
        append_fixed(line.a.x);
        text += "\" y1=\"";
        append_fixed(line.a.y);
        text += "\" x2=\"";
        append_fixed(line.b.x);
        text += "\" y2=\"";
        append_fixed(line.b.y);
        append_all(text, "\" data-faces=\"", face_list(lines, svg_line.edge), "\"/>\n");
    }
    text += "</g>\n</svg>\n";
    return text;
}

}  // namespace

LineFormat line_format_of(const std::string& file_name) {
    std::string ending = file_name.substr(std::min(file_name.rfind('.'), file_name.size()));
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (ending == ".obj") return LineFormat::obj;
    if (ending == ".ply") return LineFormat::ply;
    if (ending == ".svg") return LineFormat::svg;
    throw UsageError("-o: expected a name that ends in .obj, .ply or .svg, not '" + file_name +
                     "'");
}

std::string format_lines(const Lines& lines, LineFormat format) {
    switch (format) {
        case LineFormat::obj: return format_obj(lines);
        case LineFormat::ply: return format_ply(lines);
        case LineFormat::svg: return format_svg(lines);
    }
    return {};
}

}  // namespace rimline::tools
