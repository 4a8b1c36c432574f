#include <chrono>

#include "silhouette/mesh/formats/ply_header.h"
#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

std::string ply(const std::string& elements, const std::string& body,
                const std::string& format = "ascii") {
    return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n" + body;
}

const std::string k_vertices = "property float x\nproperty float y\nproperty float z\n";
const std::string k_face = "property list uchar int vertex_indices\n";

}  // namespace

TEST_CASE("PLY: the three encodings hold the same model") {
    for (const std::string& bytes : {sample_ply_text(), sample_ply_binary(std::endian::little),
                                     sample_ply_binary(std::endian::big)}) {
        const MeshSource source = read_text("a.ply", bytes);
        CHECK(source.positions == sample_positions());
        CHECK(source.triangles == sample_triangles());
        CHECK(source.up == UpAxis::y);
    }
}

TEST_CASE("PLY: every type is read, by either of its names, as a coordinate, count and index") {
    const std::array<std::array<const char*, 2>, 8> names{{{"char", "int8"},
                                                           {"uchar", "uint8"},
                                                           {"short", "int16"},
                                                           {"ushort", "uint16"},
                                                           {"int", "int32"},
                                                           {"uint", "uint32"},
                                                           {"float", "float32"},
                                                           {"double", "float64"}}};
    const auto add = [](Bytes& bytes, std::size_t type, int value) {
        switch (type) {
            case 0: bytes.add(static_cast<std::int8_t>(value)); break;
            case 1: bytes.add(static_cast<std::uint8_t>(value)); break;
            case 2: bytes.add(static_cast<std::int16_t>(value)); break;
            case 3: bytes.add(static_cast<std::uint16_t>(value)); break;
            case 4: bytes.add(static_cast<std::int32_t>(value)); break;
            case 5: bytes.add(static_cast<std::uint32_t>(value)); break;
            case 6: bytes.add(static_cast<float>(value)); break;
            default: bytes.add(static_cast<double>(value));
        }
    };
    for (const std::endian order : {std::endian::little, std::endian::big})
        for (std::size_t type = 0; type < 8; ++type)
            for (const char* name : names[type]) {
                CAPTURE(name);
                // Counts are integers: a floating-point index type takes a uchar count.
                const std::string count = type < 6 ? name : "uchar";
                Bytes bytes(order);
                bytes.add_text("ply\nformat ");
                bytes.add_text(order == std::endian::big ? "binary_big_endian"
                                                         : "binary_little_endian");
                bytes.add_text(" 1.0\nelement vertex 3\n");
                for (const char* axis : {"x", "y", "z"})
                    bytes.add_text(std::string("property ") + name + " " + axis + "\n");
                bytes.add_text("element face 1\nproperty list " + count + " " + name +
                               " vertex_index\nend_header\n");
                const std::vector<glm::vec3> positions{{1, 2, 3}, {100, 0, 5}, {7, 8, 127}};
                for (const glm::vec3& p : positions)
                    for (int axis = 0; axis < 3; ++axis)
                        add(bytes, type, static_cast<int>(p[axis]));
                add(bytes, type < 6 ? type : 1, 3);
                for (const int corner : {2, 0, 1}) add(bytes, type, corner);
                const MeshSource source = read_text("a.ply", bytes.str());
                CHECK(source.positions == positions);
                CHECK(source.triangles == Triangles{{2, 0, 1}});
            }
}

TEST_CASE("PLY: faces may stand before the vertices, concave ones too") {
    const std::string elements = "element face 2\n" + k_face + "element vertex 5\n" + k_vertices;
    // An arrow head whose corner 2 is reflex, then a triangle.
    const std::string body = "4 0 1 2 3\n3 0 1 4\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n0 0 1\n";
    const MeshSource source = read_text("a.ply", ply(elements, body));
    CHECK(source.triangles == Triangles{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}});
}

TEST_CASE("PLY: strips turn every other triangle and start anew after -1") {
    const std::string body = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n11 0 1 2 3 4 -1 -1 4 3 2 -1\n";
    const MeshSource source =
        read_text("a.ply", ply("element vertex 5\n" + k_vertices +
                                   "element tristrips 1\nproperty list int int vertex_indices\n",
                               body));
    CHECK(source.triangles == Triangles{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 2}});
    CHECK(
        has(error_of("a.ply", ply("element vertex 5\n" + k_vertices +
                                      "element tristrips 1\nproperty list int int vertex_indices\n",
                                  "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n5 0 1 -1 2 3\n")),
            "a.ply:15: a triangle strip has 2 corners"));
}

TEST_CASE("PLY: points only are welcome where faces are not needed") {
    const std::string bytes = ply("element vertex 2\n" + k_vertices, "1 2 3\n4 5 6\n");
    const MeshSource source = read_text("a.ply", bytes, FaceRequirement::faces_or_points);
    CHECK(source.positions == std::vector<glm::vec3>{{1, 2, 3}, {4, 5, 6}});
    CHECK(error_of("a.ply", bytes, FaceRequirement::faces) ==
          "a.ply: no faces: it holds 2 points only; a model with faces is needed");
}

TEST_CASE("PLY: headers with CRLF and with CR lead to the right first byte") {
    for (const std::string end : {"\r\n", "\r"}) {
        std::string header =
            "ply\nformat binary_little_endian 1.0\nobj_info x\nelement vertex 1\n" + k_vertices +
            "end_header\n";
        std::string with_ends;
        for (const char c : header) with_ends += c == '\n' ? end : std::string(1, c);
        // The first byte of the data looks like the end of a line.
        float x = 0.0f;
        const std::uint32_t bits = 0x3f80000au;
        std::memcpy(&x, &bits, 4);
        Bytes bytes;
        bytes.add_text(with_ends).add(x).add(2.0f).add(3.0f);
        const MeshSource source = read_text("a.ply", bytes.str(), FaceRequirement::faces_or_points);
        CHECK(source.positions == std::vector<glm::vec3>{{x, 2, 3}});
    }
}

TEST_CASE("PLY: what is wrong is named with its line or byte") {
    const std::string two = "element vertex 2\n" + k_vertices;
    const std::string mesh = "element vertex 3\n" + k_vertices + "element face 1\n" + k_face;
    const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
    const auto error = [](const std::string& bytes) { return error_of("a.ply", bytes); };
    CHECK(has(error(ply(two, "1 2 3\n4 x 6\n")), "a.ply:9: 'x' is not a number"));
    CHECK(has(error(ply(two, "1 2 3\n4 nan 6\n")), "a.ply:9: y is 'nan'"));
    CHECK(has(error(ply(two, "1 2 3\n4 -inf 6\n")), "a.ply:9: y is '-inf'"));
    CHECK(has(error(ply(two, "1 2 3\n4 5 1e19\n")), "a.ply:9: z is '1e19', beyond 2^60"));
    CHECK(has(error(ply(two, "1.25 2 3\n4 5\n")), "a.ply:9: the line ends where z"));
    CHECK(has(error(ply(two, "1 2 3\n4 5 6 7\n")), "a.ply:9: '7' after a vertex"));
    CHECK(has(error(ply(two, "1 2 3\n4 5 6\n7 8 9\n")), "a.ply:10: there is more"));
    CHECK(has(error(ply(mesh, points + "3 0 1 3\n")), "a.ply:13: vertex index 3 is out of range"));
    CHECK(
        has(error(ply(mesh, points + "3 0 1 -1\n")), "a.ply:13: vertex index -1 is out of range"));
    CHECK(has(error(ply(mesh, points + "2 0 1\n")), "a.ply:13: a face has 2 corners"));
    CHECK(has(error(ply(mesh, points + "3 0 1 1.5\n")), "a.ply:13: '1.5' is not an integer"));
    CHECK(has(error(ply(mesh, points + "-3 0 1 2\n")), "a.ply:13: the count of a list is -3"));
    CHECK(has(error(ply(mesh, points + "255 0 1 2\n")), "a.ply:13: a list of 255"));
    CHECK(has(error(ply("element vertex 4000000000\n" + k_vertices, "1 2 3\n")),
              "a.ply:3: 4000000000 elements 'vertex'"));
    CHECK(has(error(ply("element vertex -1\n" + k_vertices, "")), "a.ply:3: the element's count"));
    CHECK(has(error(ply("element vertex 1\nproperty float x\nproperty float y\n", "1 2\n")),
              "a.ply:3: element 'vertex' has no property 'z'"));
    CHECK(has(error(ply("property float x\n", "")), "a.ply:3: a property before any element"));
    CHECK(has(error(ply("element vertex 1\nproperty real x\n", "")), "a.ply:4: 'real' is not"));
    CHECK(has(error(ply(two + "elephant 3\n", "")), "a.ply:7: 'elephant' is no word"));
    CHECK(has(error(ply(two, "", "ascii_art")), "a.ply:2: 'ascii_art' is not a PLY format"));
    CHECK(has(error("ply\nend_header\n"), "a.ply:2: the header declares no format"));
    CHECK(has(error("ply\nformat ascii 1.0\nelement vertex 0\n"), "a.ply:3: the file ends"));
    // Elements that take no bytes must take no time and no memory.
    CHECK(has(error(ply("element nothing 4000000000000000\nelement face 4000000000000\n" + two,
                        "1 2 3\n4 5 6\n")),
              "a.ply:4: element 'face' has no list property"));

    Bytes bytes;
    bytes.add(0.0f).add(1.0f).add(NAN);
    const std::string one = "element vertex 1\n" + k_vertices;
    const std::string header = ply(one, "", "binary_little_endian");
    CHECK(has(error(header + bytes.str()),
              "byte " + std::to_string(header.size() + 8) + ": z is not a finite number"));
    CHECK(has(error(header + std::string(13, '\0')),
              "byte " + std::to_string(header.size() + 12) + ": 1 bytes follow"));
}

TEST_CASE("PLY: a number in text that its declared integer type cannot hold is an error") {
    const std::string three = "element vertex 3\n" + k_vertices;
    const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
    const auto error = [](const std::string& bytes) { return error_of("a.ply", bytes); };
    const std::string bytes_for_xyz =
        "element vertex 1\nproperty uchar x\nproperty char y\nproperty ushort z\n";
    const auto at = [](const std::string& bytes) {
        return read_text("a.ply", bytes, FaceRequirement::faces_or_points).positions.at(0);
    };
    CHECK(at(ply(bytes_for_xyz, "255 -128 65535\n")) == glm::vec3(255, -128, 65535));
    CHECK(error(ply(bytes_for_xyz, "300 0 0\n")) ==
          "a.ply:8: x is 300, which its declared type cannot hold; that goes from 0 to 255");
    CHECK(has(error(ply(bytes_for_xyz, "30.5 0 0\n")), "a.ply:8: '30.5' is not an integer"));
    CHECK(has(error(ply(bytes_for_xyz, "3 128 0\n")), "a.ply:8: y is 128"));
    CHECK(has(error(ply(bytes_for_xyz, "3 0 -1\n")), "a.ply:8: z is -1"));
    // Values that are stepped over, counts and indices too.
    const std::string red = "element vertex 1\n" + k_vertices + "property uchar red\n";
    CHECK(error(ply(red, "1 2 3 255\n")).empty());
    CHECK(has(error(ply(red, "1 2 3 256\n")), "a.ply:9: a property's value is 256"));
    CHECK(has(error(ply(red, "1 2 3 0.5\n")), "a.ply:9: '0.5' is not an integer"));
    const std::string face = "element face 1\nproperty list uchar char vertex_indices\n";
    CHECK(error(ply(three + face, points + "3 0 1 2\n")).empty());
    CHECK(has(error(ply(three + face, points + "259 0 1 2\n")), "the count of a list is 259"));
    CHECK(has(error(ply(three + face, points + "3 0 1 258\n")), "a vertex index is 258"));
}

TEST_CASE("PLY: one line's end may follow binary data, and nothing else") {
    const std::string good = sample_ply_binary(std::endian::little);
    for (const std::string end : {"\n", "\r\n"}) {
        const MeshSource source = read_text("a.ply", good + end);
        CHECK(source.positions == sample_positions());
        CHECK(source.triangles == sample_triangles());
    }
    for (const std::string end : {"\r", " ", "\n\n", "\n\r", "\r\n\n", "x\n"}) {
        CAPTURE(end.size());
        CHECK(has(error_of("a.ply", good + end), " bytes follow the last element"));
    }
}

TEST_CASE("PLY: a name is declared once, and a header of many names takes no long time") {
    const std::string two = "element vertex 2\n" + k_vertices;
    const auto error = [](const std::string& bytes) { return error_of("a.ply", bytes); };
    CHECK(error(ply(two + "property char y\n", "")) == "a.ply:7: property 'y' is declared twice");
    CHECK(error(ply(two + "element face 0\n" + k_face + "element vertex 1\n", "")) ==
          "a.ply:9: element 'vertex' is declared twice");
    // Two elements may have properties of the same name.
    CHECK(error(ply(two + "element other 0\n" + k_vertices, "1 2 3\n4 5 6\n")).empty());

    std::string properties = two + "element wide 0\n";
    std::string elements = two;
    for (int i = 0; i < 150000; ++i) {
        properties.append("property char p").append(std::to_string(i)).append("\n");
        elements.append("element e").append(std::to_string(i)).append(" 0\n");
    }
    const auto begin = std::chrono::steady_clock::now();
    CHECK(error(ply(properties, "1 2 3\n4 5 6\n")).empty());
    CHECK(error(ply(elements, "1 2 3\n4 5 6\n")).empty());
    CHECK(error(ply(properties + "property char p7\n", "")) ==
          "a.ply:150008: property 'p7' is declared twice");
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    MESSAGE("headers of 150,000 names: " << took.count() << " s");
    CHECK(took.count() < 10.0);

    std::stop_source stop;
    stop.request_stop();
    const SourceFile file{"a.ply", ply(two, ""), {}, 0};
    CHECK_THROWS_WITH_AS(read_ply_header(file, {stop.get_token(), {}}), "cancelled", Error);
}
