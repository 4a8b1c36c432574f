#include "tests/silhouette/mesh/formats/sample_files.h"

using namespace rimline;
using namespace rimline::tests;

namespace {
const std::string k_square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
}

TEST_CASE(
    "OBJ: vertices keep their numbers and a material library that is missing changes no face") {
    const MeshSource source = read_text("a.obj", sample_obj());
    CHECK(source.positions == sample_positions());
    CHECK(source.triangles == sample_triangles());
}

TEST_CASE("OBJ: corners are v, v/vt, v//vn and v/vt/vn, absolute or relative") {
    const std::string parts = k_square + "vt 0 0\nvt 1 0 0\nvn 0 0 1\n";
    for (const std::string face :
         {"f 1 2 3", "f 1/1 2/2 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/-1/-1", "f -4 -3 -2",
          "f +1 2 3", "f 1/ 2// 3", "  f\t1  2\t3  # a comment", "f 1 2 3#4", "f 1 2 \\\n3",
          "f 1 \\\r\n 2 3", "# x \\\nf 1 2 3"}) {
        CAPTURE(face);
        CHECK(read_text("a.obj", parts + face + "\n").triangles == Triangles{{0, 1, 2}});
        CHECK(read_text("a.obj", parts + face).triangles == Triangles{{0, 1, 2}});
    }
}

TEST_CASE("OBJ: relative indices count back from their line, absolute ones may point ahead") {
    const std::string bytes =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nf 4 5 6\nv 0 0 1\nv 1 0 1\n"
        "v 0 1 1\nf -3 -2 -1\n";
    CHECK(read_text("a.obj", bytes).triangles == Triangles{{0, 1, 2}, {3, 4, 5}, {3, 4, 5}});
}

TEST_CASE("OBJ: lines end with LF, CRLF or CR") {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        std::string bytes;
        for (const char c : sample_obj()) bytes += c == '\n' ? end : std::string(1, c);
        CHECK(read_text("a.obj", bytes).positions == sample_positions());
        CHECK(read_text("a.obj", bytes).triangles == sample_triangles());
    }
}

TEST_CASE("OBJ: positions are correctly rounded, with weights and colors left aside") {
    const MeshSource source = read_text(
        "a.obj", "v 0.1 16777217.0000001 1e-50\nv 1 2 3 1.0\nv 1 2 3 0.5 0.5 0.5\nf 1 2 3\n");
    CHECK(source.positions[0] == glm::vec3(0.1f, 16777218.0f, 0.0f));
    CHECK(source.positions[2] == glm::vec3(1, 2, 3));
}

TEST_CASE("OBJ: a concave polygon is cut inside, not fanned") {
    // An arrow head whose first corner sees its third only from outside.
    const MeshSource source = read_text("a.obj", "v 4 0 0\nv 1 1 0\nv 0 4 0\nv 0 0 0\nf 1 2 3 4\n");
    CHECK(source.triangles == Triangles{{0, 1, 3}, {1, 2, 3}});
}

TEST_CASE("OBJ: points, lines, parameters and groups are scanned and make no faces") {
    const std::string more =
        "p 1 2\nl 1 2/1 3\nvt 0\nvp 1 1\ng\ng a b\ns 1\no\nusemtl a b\nl 4 1\n"
        "res 3 4\ncdc 1 2 3 4\n";
    CHECK(read_text("a.obj", k_square + more + "f 1 2 3\n").triangles.size() == 1);
    CHECK(read_text("a.obj", k_square + more, FaceRequirement::faces_or_points).triangles.empty());
    CHECK(has(error_of("a.obj", k_square + more, FaceRequirement::faces), "no faces: it holds 4"));
}

TEST_CASE("OBJ: what is wrong is named with its line") {
    const auto error = [](const std::string& line) {
        return error_of("a.obj", k_square + line + "\nf 1 2 3\n");
    };
    for (const char* line : {"v x 1 0",
                             "v 1 0",
                             "v",
                             "v 1 2 nan",
                             "v 1 inf 2",
                             "v 1 2 1e30",
                             "v 1 2 3 4 5",
                             "v 1 2 3 x",
                             "v 1,5 2 3",
                             "vn 1 2",
                             "vn 1 2 x",
                             "vn 1 2 3 4",
                             "vt",
                             "vt x",
                             "f 1 2",
                             "f",
                             "f 0 1 2",
                             "f 1 2 5",
                             "f 1 2 -5",
                             "f 1 2 x",
                             "f 1 2 3.0",
                             "f 1/x 2 3",
                             "f 1/1 2 3",
                             "f 1//1 2 3",
                             "f 1/0 2 3",
                             "f /1 2 3",
                             "f 1/1/1/1 2 3",
                             "f 1 2 99999999999",
                             "f 1 2 99999999999999999999",
                             "l 1",
                             "l 1 9",
                             "l 1 0",
                             "p",
                             "p 9",
                             "p x",
                             "surf 0 1 0 1",
                             "fo 1 2 3",
                             "call other.obj",
                             "bsp 1 2 3 4",
                             "bzp 1 2 3 4",
                             "cdp 1 2 3 4",
                             "nonsense",
                             "v\x01 1 2 3",
                             "f 1 2 \\"}) {
        CAPTURE(line);
        const std::string message = error(line);
        CAPTURE(message);
        CHECK(message.substr(0, 8) == (std::string(line) == "f 1 2 \\" ? "a.obj:6:" : "a.obj:5:"));
    }
    CHECK(has(error("f 1 2 5"), "index 5 is out of range; there are 4 vertices"));
    CHECK(has(error("f 0 1 2"), "index 0 in OBJ, where numbering begins at 1"));
    CHECK(has(error("v x 1 0"), "'x' is not a number"));
}

TEST_CASE("OBJ: numbers that are not used may be anything that exporters write for numbers") {
    for (const std::string line :
         {"vn nan nan nan", "vn -nan(ind) inf -inf", "vn 1e30 0 0", "vt 0 nan", "vt 1e300",
          "v 1 2 3 nan", "v 1 2 3 nan nan nan", "v 1 2 3 1e30 0 0 1"}) {
        CAPTURE(line);
        CHECK(error_of("a.obj", k_square + line + "\nf 1 2 3\n").empty());
    }
    CHECK(error_of("a.obj", k_square + "vn 0 0 up\n") ==
          "a.obj:5: 'up' is not a number; a normal's component should stand here");
    CHECK(has(error_of("a.obj", k_square + "v 1 2 3 red\n"), "a.obj:5: 'red' is not a number"));
}

TEST_CASE("OBJ: a name that ends with a backslash leaves the next line alone") {
    for (const std::string keyword : {"g", "o", "s", "usemtl", "mtllib"})
        for (const std::string end : {"\n", "\r\n", "\r"})
            for (const std::string name : {" C:\\tmp\\", " \\", "\\", " a \\ b\\"}) {
                CAPTURE(keyword);
                CAPTURE(name);
                const std::string before = k_square + keyword + name + end;
                CHECK(read_text("a.obj", before + "f 1 2 3" + end + "f 1 3 4").triangles ==
                      Triangles{{0, 1, 2}, {0, 2, 3}});
                CHECK(has(error_of("a.obj", before + "f 1 2 9" + end), "a.obj:6: index 9"));
            }
}

TEST_CASE("OBJ: the end mark of DOS may be the last byte, and only that") {
    for (const std::string end : {"\n\x1a", "\x1a"})
        CHECK(read_text("a.obj", k_square + "f 1 2 3" + end).triangles == Triangles{{0, 1, 2}});
    CHECK(has(error_of("a.obj", k_square + "f 1 2 3\n\x1a\n"), "a.obj:6: '?' is no OBJ"));
    CHECK(has(error_of("a.obj", k_square + "\x1a\nf 1 2 3\n"), "a.obj:5: '?' is no OBJ"));
}
